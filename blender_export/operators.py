# SPDX-License-Identifier: GPL-3.0-or-later
"""The Export, Preview, Live and Cancel buttons."""

import os

import bpy

from . import preview
from .background_export import BackgroundExport
from .errors import UsageError
from .export_words import export_words

SECONDS_BETWEEN_LOOKS = 0.25


class _Exports:
    """Runs an export beside the window, and what a button does with what it wrote."""

    _export = None
    _after = None
    _timer = None
    _unsaved = False

    @classmethod
    def poll(cls, context):
        return context.window_manager.kagefude_percent < 0

    def execute(self, context):
        self._unsaved = bpy.data.is_dirty
        try:
            self._export = BackgroundExport(self.words(context))
        except (UsageError, OSError, RuntimeError) as problem:
            self.report({'ERROR'}, str(problem))
            return {'CANCELLED'}
        manager = context.window_manager
        manager.kagefude_percent, manager.kagefude_cancel = 0, False
        self._timer = manager.event_timer_add(SECONDS_BETWEEN_LOOKS, window=context.window)
        manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        manager = context.window_manager
        if manager.kagefude_cancel:
            self.cancel(context)
        if event.type != 'TIMER' and not self._export.finished:
            return {'PASS_THROUGH'}
        self._keep_unsaved()
        if not self._export.poll():
            self._tell(context, self._export.percent, f"{self._export.status}, {self._export.percent} %")
            return {'PASS_THROUGH'}
        if self._export.error:
            return self._finish(context, None)
        try:
            return self._go_on(context)
        except (UsageError, OSError, RuntimeError) as problem:
            return self._finish(context, str(problem))

    def _go_on(self, context):
        if self._after is None:
            self._after = self.after(context)
        if self._after and not self._after.poll():
            self._tell(context, 100, "painting")
            return {'PASS_THROUGH'}
        if self._after and self._after.error:
            return self._finish(context, self._after.error)
        self.end(context, self._after)
        return self._finish(context, None)

    def after(self, _context):
        """A process that follows, with `poll`, `cancel` and `error`; False for none."""
        return False

    def end(self, context, after):
        """All went well."""

    def _keep_unsaved(self):
        """Saving the copy makes Blender 3 forget, an event later, that the open file has changes."""
        if self._unsaved and not bpy.data.is_dirty:
            bpy.ops.ed.undo_push(message="kagefude export")
        self._unsaved = False

    def cancel(self, _context):
        """The button, or Blender closes or loads another file."""
        self._export.cancel()
        if self._after:
            self._after.cancel()

    def _tell(self, context, percent, words):
        context.window_manager.kagefude_percent = percent
        context.workspace.status_text_set(f"kagefude: {words}")
        _redraw(context)

    def _finish(self, context, problem):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.kagefude_percent = -1
        context.workspace.status_text_set(None)
        _redraw(context)
        for kind, words in self._export.reports(self.written(context)):
            self.report({kind}, words)
        if problem:
            self.report({'ERROR'}, problem)
        return {'CANCELLED'} if self._export.error or problem else {'FINISHED'}


class KAGEFUDE_OT_export(_Exports, bpy.types.Operator):
    """Render the passes, shadow masks and light-depth maps in a second Blender, on a copy of this file"""
    bl_idname = "kagefude.export"
    bl_label = "Export"

    def words(self, context):
        settings = context.scene.kagefude
        if settings.output.startswith("//") and not bpy.data.filepath:
            raise UsageError("Save the file first, or give the output an absolute path")
        output = os.path.abspath(bpy.path.abspath(settings.output))
        return export_words(settings, context.scene, output)

    def written(self, context):
        return context.scene.kagefude.output


class _Previews(_Exports):
    def words(self, context):
        settings = context.scene.kagefude
        preview.program(settings), preview.look(settings)  # said before the rendering, not after it
        return preview.preview_words(settings, context.scene)

    def written(self, context):
        return preview.frame_file(context.scene)


class KAGEFUDE_OT_preview(_Previews, bpy.types.Operator):
    """Export the current frame small, paint it with the look, and show it in an Image Editor"""
    bl_idname = "kagefude.preview"
    bl_label = "Preview"

    def after(self, context):
        return preview.Comp(context.scene.kagefude, context.scene)

    def end(self, context, after):
        preview.show(context, after.picture)


class KAGEFUDE_OT_live(_Previews, bpy.types.Operator):
    """Export the current frame small, and open the page on which every setting of the look is a knob"""
    bl_idname = "kagefude.live"
    bl_label = "Live"

    def end(self, context, _after):
        preview.Live.open(context.scene.kagefude, context.scene)


class KAGEFUDE_OT_cancel(bpy.types.Operator):
    """Stop the export that is running"""
    bl_idname = "kagefude.cancel"
    bl_label = "Cancel"

    def execute(self, context):
        context.window_manager.kagefude_cancel = True
        return {'FINISHED'}


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == 'PROPERTIES':
                area.tag_redraw()


CLASSES = (KAGEFUDE_OT_export, KAGEFUDE_OT_preview, KAGEFUDE_OT_live, KAGEFUDE_OT_cancel)
