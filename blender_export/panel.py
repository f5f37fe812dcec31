# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the render properties, its settings, and the add-on's registration."""

import atexit

import bpy
from bpy.props import (BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty,
                       StringProperty)

from . import compat, operators, preview
from .arguments import MOST_LINE_MASKS, MOST_SAMPLES


class KagefudeSettings(bpy.types.PropertyGroup):
    light: PointerProperty(
        name="Light", type=bpy.types.Object, poll=lambda _, item: item.type == 'LIGHT',
        description="Light to take shadow masks from; empty for all lights that cast shadows")
    masks: EnumProperty(
        name="Masks", default='disc:9', description="Where on the light the shadow masks lie",
        items=(('disc:9', "Disc of 9", "Centre and ring of eight: the best soft shadows"),
               ('disc:17', "Disc of 17", "For shadows thinner than their shift from mask to mask"),
               ('disc:33', "Disc of 33", "For wires and twigs before a wide light"),
               ('disc:5', "Disc of 5", "Centre and ring of four"),
               ('line', "Line", "Along a tube light, or across the view of the subject"),
               ('pair', "Pair", "Two on the axis to the subject; not for suns"),
               ('trace', "Traced", "No masks: the light's own soft shadow, traced and noisy")))
    trace_count: IntProperty(name="Samples", default=64, min=1, max=MOST_SAMPLES,
                             description="Samples a pixel of the traced shadow")
    masks_by: EnumProperty(
        name="Masks by", default='auto', description="How the masks are rendered",
        items=(('auto', "Automatic", "The fastest way that is right for each light"),
               ('layers', "Layers", "A view layer for each mask: right for everything"),
               ('groups', "Light Groups", "A light group for each mask, many samples"),
               ('occlusion', "Occlusion Rays", "All masks in one sample, before Blender 5.1"),
               ('raycast', "Raycast", "All masks in one sample, from Blender 5.1 on")))
    line_count: IntProperty(name="Masks on the Line", default=5, min=2, max=MOST_LINE_MASKS)
    offset_auto: BoolProperty(
        name="Offset from Light", default=True,
        description="Work the masks' offset out from the light's own size")
    offset: FloatProperty(
        name="Offset", default=0.2, min=0.0001, soft_max=10.0,
        description="Distance of the outermost masks from the light's centre, in world units; "
                    "for a sun the tangent of the angle")
    frames: EnumProperty(
        name="Frames", default='CURRENT',
        items=(('CURRENT', "Current", "The current frame"),
               ('SCENE', "Scene Range", "From the scene's start to its end"),
               ('LIST', "List", "A list such as 1-24, 1-24x2 or 1,5,9")))
    frame_list: StringProperty(name="List", default="1-24",
                               description="Frames such as 1-24, 1-24x2 or 1,5,9")
    output: StringProperty(
        name="Output", default="//kagefude/shot.####.exr", subtype='FILE_PATH',
        options=compat.relative_path_options(),
        description="Where to write; #### becomes the frame number")
    use_truth: BoolProperty(
        name="Traced Truth", default=False,
        description="Also trace each light at its real size, to compare with")
    use_casters: BoolProperty(
        name="Casters", default=False,
        description="Also write the shapes that cast shadows, to move or add lights in the comp")
    truth_samples: IntProperty(name="Samples", default=512, min=1, max=65536)
    scale: IntProperty(
        name="Scale", default=1, min=1, max=8,
        description="Render so many times the resolution, for smoother edges after comping")
    depth_size: IntProperty(name="Depth Map Size", default=1024, min=16, max=16384,
                            subtype='PIXEL', description="Side of the light-depth maps")
    program: StringProperty(
        name="Program", default="kagefude", subtype='FILE_PATH', options=compat.relative_path_options(),
        description="The kagefude program: a name that the system finds, or a path")
    look: StringProperty(
        name="Look", subtype='FILE_PATH', options=compat.relative_path_options(),
        description="The look (.toml) that previews are painted with")
    preview_percentage: IntProperty(
        name="Size", default=50, min=10, max=100, subtype='PERCENTAGE',
        description="Share of the render's size that previews have")


class _InRenderProperties:
    bl_space_type = 'PROPERTIES'
    bl_region_type = 'WINDOW'
    bl_context = "render"

    def column_layout(self):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout


class KAGEFUDE_PT_export(_InRenderProperties, bpy.types.Panel):
    bl_idname = "KAGEFUDE_PT_export"
    bl_label = "kagefude"
    bl_options = {'DEFAULT_CLOSED'}

    def draw(self, context):
        settings = context.scene.kagefude
        layout = self.column_layout()
        column = layout.column()
        column.prop(settings, "light")
        column.prop(settings, "masks")
        if settings.masks == 'line':
            column.prop(settings, "line_count")
        if settings.masks == 'trace':
            column.prop(settings, "trace_count")
        else:
            column.prop(settings, "masks_by")
        column.prop(settings, "offset_auto")
        if not settings.offset_auto:
            column.prop(settings, "offset")
        column = layout.column()
        column.prop(settings, "frames")
        if settings.frames == 'LIST':
            column.prop(settings, "frame_list")
        column.prop(settings, "output")
        column.prop(settings, "scale")
        column.prop(settings, "depth_size")
        column = layout.column()
        column.prop(settings, "use_casters")
        column.prop(settings, "use_truth")
        if settings.use_truth:
            column.prop(settings, "truth_samples")
        self._draw_export(context)

    def _draw_export(self, context):
        percent = context.window_manager.kagefude_percent
        if percent < 0:
            self.layout.operator("kagefude.export", icon='RENDER_STILL')
            return
        row = self.layout.row()
        row.label(text=f"Exporting: {percent} %")
        row.operator("kagefude.cancel", icon='CANCEL')


class KAGEFUDE_PT_preview(_InRenderProperties, bpy.types.Panel):
    bl_idname = "KAGEFUDE_PT_preview"
    bl_parent_id = "KAGEFUDE_PT_export"
    bl_label = "Preview"

    def draw(self, context):
        settings = context.scene.kagefude
        layout = self.column_layout()
        column = layout.column()
        column.prop(settings, "look")
        column.prop(settings, "program")
        column.prop(settings, "preview_percentage")
        row = layout.row()
        row.operator("kagefude.preview", icon='IMAGE_DATA')
        row.operator("kagefude.live", icon='URL')


CLASSES = (KagefudeSettings, KAGEFUDE_PT_export, KAGEFUDE_PT_preview, *operators.CLASSES)


def register():
    for item in CLASSES:
        bpy.utils.register_class(item)
    bpy.types.Scene.kagefude = PointerProperty(type=KagefudeSettings)
    # State of a running export: it belongs to the session, not to the file.
    bpy.types.WindowManager.kagefude_percent = IntProperty(default=-1, options={'SKIP_SAVE'})
    bpy.types.WindowManager.kagefude_cancel = BoolProperty(options={'SKIP_SAVE'})
    atexit.register(preview.Live.close)


def unregister():
    preview.Live.close()
    atexit.unregister(preview.Live.close)
    del bpy.types.WindowManager.kagefude_cancel
    del bpy.types.WindowManager.kagefude_percent
    del bpy.types.Scene.kagefude
    for item in reversed(CLASSES):
        bpy.utils.unregister_class(item)
