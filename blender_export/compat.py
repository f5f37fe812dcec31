# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that differs between Blender versions, in one place (measured on 3.4, 4.3 and 5.2).

Where it can be asked, a capability is asked for and not a number.
"""

import math
import os

import bpy

# Names of a Render Layers node's outputs -> the pass's name in our files, which is that of 3.4.
PASS_OF_SOCKET = {
    "Image": "Combined", "Object Index": "IndexOB", "Material Index": "IndexMA",
    "Diffuse Direct": "DiffDir", "Diffuse Indirect": "DiffInd", "Diffuse Color": "DiffCol",
    "Glossy Direct": "GlossDir", "Glossy Indirect": "GlossInd", "Glossy Color": "GlossCol",
    "Transmission Direct": "TransDir", "Transmission Indirect": "TransInd",
    "Transmission Color": "TransCol", "Volume Direct": "VolumeDir", "Volume Indirect": "VolumeInd",
    "Subsurface Direct": "SubsurfaceDir", "Subsurface Indirect": "SubsurfaceInd",
    "Subsurface Color": "SubsurfaceCol", "Emission": "Emit", "Environment": "Env",
    "Ambient Occlusion": "AO"}


# Lights ---------------------------------------------------------------------------------------

def has_shadow_pass():
    """Cycles dropped its Shadow pass in 3.5; the switch stayed, but the pass is empty."""
    return bpy.app.version < (3, 5, 0)


def enable_mask_pass(view_layer):
    """Turn on the pass that tells lit from hidden; returns (pass, threshold or None).

    With one light of size 0 and one sample the Shadow pass is exactly 0 or 1. Where it is gone,
    the direct diffuse light is above 0 exactly where the light is seen.
    """
    if has_shadow_pass():
        view_layer.use_pass_shadow = True
        return "Shadow", None
    view_layer.use_pass_diffuse_direct = True
    return "DiffDir", 0.0


def casts_shadow(light):
    """Whether Cycles lets this light data cast shadows: its own switch before 5.0, then the light's."""
    settings = getattr(light, "cycles", None)
    own = getattr(settings, "cast_shadow", None)
    return bool(getattr(light, "use_shadow", True) if own is None else own)


def set_casts_shadow(light, casts):
    settings = getattr(light, "cycles", None)
    set_if_known(settings, cast_shadow=casts)
    set_if_known(light, use_shadow=casts)


def light_output(light, kind, radius):
    """(energy, colour) of light data as they were set in 3.4; later versions added factors to both.

    An area light gives 4 / pi times as much from 4.0 on (measured in 4.3 and 5.2). From 4.5: exposure in stops, the colour of a temperature, and "Normalize": off, a light gives off more the
    larger it is. The factors of that are measured in 5.2: 4 pi r^2 for a point or spot (4 without a
    size), the area for an area light, pi sin^2 of half its angle for a sun (1 without one). `radius`
    is that of the light's state: world units, of an area's equal circle, a sun's tangent.
    """
    energy, color = light.energy * 2.0 ** getattr(light, "exposure", 0.0), tuple(light.color)
    if getattr(light, "use_temperature", False):
        color = tuple(one * other for one, other in zip(color, light.temperature_color))
    if not getattr(light, "normalize", True):
        energy *= _size_gain(kind, radius)
    if kind == "area" and bpy.app.version >= (4, 0, 0):
        energy *= 4.0 / math.pi
    return energy, color


def _size_gain(kind, radius):
    if kind == "area":
        return math.pi * radius * radius
    if kind == "sun":
        return math.pi * radius * radius / (1.0 + radius * radius) if radius > 0.0 else 1.0
    return 4.0 * math.pi * radius * radius if radius > 0.0 else 4.0


def copy_light_linking(source, lamp):
    """Let `lamp` light and be hidden by the same objects as the light object `source` (4.0 on)."""
    linking = getattr(source, "light_linking", None)
    if linking:
        lamp.light_linking.receiver_collection = linking.receiver_collection
        lamp.light_linking.blocker_collection = linking.blocker_collection


def has_light_linking(light):
    """Whether the light object picks the objects that it lights or that hide it (4.0 on)."""
    linking = getattr(light, "light_linking", None)
    return bool(linking and (linking.receiver_collection or linking.blocker_collection))


# Passes ---------------------------------------------------------------------------------------

def pass_name(socket_name):
    return PASS_OF_SOCKET.get(socket_name, socket_name)


def output_socket(node, wanted):
    """The node's enabled output for the pass `wanted`, or None."""
    for socket in node.outputs:
        if socket.enabled and pass_name(socket.name) == wanted:
            return socket
    return None


# Compositor -----------------------------------------------------------------------------------

def compositor_tree(scene):
    """An empty compositor for the scene: a node group of its own from 5.0, part of it before."""
    # The graphics card, the default since 4.2, needs a display driver and may round to half floats.
    set_if_known(scene.render, compositor_device='CPU', compositor_precision='FULL')
    if hasattr(scene, "compositing_node_group"):
        scene.compositing_node_group = bpy.data.node_groups.new(scene.name, 'CompositorNodeTree')
        return scene.compositing_node_group
    scene.use_nodes = True
    scene.node_tree.nodes.clear()
    return scene.node_tree


def has_compositing(scene):
    """Whether the file composites its picture; from 5.0 `use_nodes` is always on, whatever it does."""
    if hasattr(scene, "compositing_node_group"):
        return scene.compositing_node_group is not None
    return scene.use_nodes


def remove_compositor(scene):
    """Leave a scene, and copies that are made of it, without compositing."""
    if hasattr(scene, "compositing_node_group"):
        scene.compositing_node_group = None
    else:
        if scene.node_tree:
            # Nodes whose passes come and go leave memory behind, which Blender ends with an error for.
            scene.node_tree.nodes.clear()
        scene.use_nodes = False


def math_node(tree, operation):
    """A Math node of the compositor, which shares the shaders' node from 5.0."""
    own = hasattr(bpy.types, "CompositorNodeMath")
    node = tree.nodes.new('CompositorNodeMath' if own else 'ShaderNodeMath')
    node.operation = operation
    return node


def first_channel_of_colour(tree, socket):
    """A value socket that carries the red channel of `socket`."""
    node = tree.nodes.new('CompositorNodeSeparateColor')
    tree.links.new(socket, node.inputs[0])
    return node.outputs[0]


class LayerFile:
    """A File Output node that writes its inputs as layers of one float multilayer EXR of one part."""

    def __init__(self, tree, codec='ZIP'):
        self.tree = tree
        self.node = tree.nodes.new('CompositorNodeOutputFile')
        form = self.node.format
        # The kinds of file are sorted by medium from 5.0, and only those of the medium can be set.
        set_if_known(form, media_type='MULTI_LAYER_IMAGE')
        form.file_format, form.color_depth, form.exr_codec = 'OPEN_EXR_MULTILAYER', '32', codec
        set_if_known(form, use_exr_interleave=True)
        self.names = []

    def add(self, socket, name):
        """Write what `socket` carries as the layer `name`."""
        if hasattr(self.node, "file_output_items"):
            item = self.node.file_output_items.new(socket.type.replace('VALUE', 'FLOAT'), name)
            if socket.type == 'VECTOR':
                # Motion vectors have four values.
                four = socket.bl_idname.endswith("4D")
                item.vector_socket_dimensions = 4 if four else 3
            place = self.node.inputs[len(self.names)]
        else:
            if self.names:
                self.node.layer_slots.new(name)
            else:
                # The slot of a new node; removing it would leak and make Blender end with an error.
                self.node.layer_slots[0].name = name
            place = self.node.inputs[-1]
        self.tree.links.new(socket, place)
        self.names.append(name)

    def set_path(self, path):
        """Where the next render writes; Blender puts frame number and ending behind `path`."""
        if hasattr(self.node, "base_path"):
            self.node.base_path = path
        else:
            self.node.directory, self.node.file_name = os.path.split(path)


# Animation ------------------------------------------------------------------------------------

def action_curves(action):
    """The curves of an action, which lie in layers from 5.0; none of None."""
    if action is None:
        return []
    if hasattr(action, "fcurves"):
        return list(action.fcurves)
    return [curve for layer in action.layers for strip in layer.strips
            for bag in strip.channelbags for curve in bag.fcurves]


# Panel ----------------------------------------------------------------------------------------

def relative_path_options():
    """Options of a path property that takes `//`; Blender shows it in red without them from 4.5."""
    known = "is_path_supports_blend_relative" in bpy.types.Property.bl_rna.properties
    return {'PATH_SUPPORTS_BLEND_RELATIVE'} if known else set()


# Sampling and shaders -------------------------------------------------------------------------

def use_tabulated_sampler(settings):
    """Take random numbers from a table, as `scrambling_distance` needs; its name changed in 3.5."""
    for name in ('TABULATED_SOBOL', 'PROGRESSIVE_MULTI_JITTER'):
        try:
            settings.sampling_pattern = name
            return
        except TypeError:
            continue


def hide_from_raycast(item, hidden):
    """Let the Raycast node pass through the object, where this Blender can."""
    set_if_known(item, visible_raycast=not hidden)


def has_raycast_node():
    """The shader node Raycast came with 5.1."""
    return hasattr(bpy.types, "ShaderNodeRaycast")


# Anything -------------------------------------------------------------------------------------

def set_if_known(holder, **values):
    """Set the properties that this Blender has; the others belong to other versions."""
    for name, value in values.items():
        if hasattr(holder, name):
            setattr(holder, name, value)


def has_denoiser():
    """Debian's Blender is built without OpenImageDenoise and then fails where denoising is on."""
    try:
        import _cycles
    except ImportError:
        return False
    return bool(getattr(_cycles, "with_openimagedenoise", False))


# Materials ------------------------------------------------------------------------------------

def displaces(material):
    """Whether the material's displacement moves the surface; the setting was Cycles' own until 4.1."""
    method = getattr(material, "displacement_method", None) or material.cycles.displacement_method
    return method != 'BUMP'


def picks_half_seen():
    """Whether data passes of what is partly see-through take it or what is behind it at random, as from
    5.0 on; before, they take what is at least half opaque."""
    return bpy.app.version >= (5, 0, 0)


def add_number_output(group, name):
    _add_number(group, name, 'OUTPUT')


def add_number_input(group, name):
    _add_number(group, name, 'INPUT')


def _add_number(group, name, way):
    """One more place of a node group; groups got an interface of their own in 4.0."""
    if hasattr(group, "interface"):
        group.interface.new_socket(name, in_out=way, socket_type='NodeSocketFloat')
    else:
        (group.outputs if way == 'OUTPUT' else group.inputs).new('NodeSocketFloat', name)
