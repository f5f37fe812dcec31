# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that differs between Blender versions, in one place (3.4 measured; 4.x by its notes)."""

import bpy

# Names of a Render Layers node's outputs -> the pass's name in our files.
PASS_OF_SOCKET = {"Image": "Combined", "Diffuse Color": "DiffCol", "Diffuse Direct": "DiffDir",
                  "Object Index": "IndexOB", "Material Index": "IndexMA"}


def has_shadow_pass():
    """Cycles dropped its Shadow pass in Blender 4.0."""
    return bpy.app.version < (4, 0, 0)


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


def pass_name(socket_name):
    return PASS_OF_SOCKET.get(socket_name, socket_name)


def output_socket(node, wanted):
    """The node's enabled output for the pass `wanted`, or None."""
    for socket in node.outputs:
        if socket.enabled and pass_name(socket.name) == wanted:
            return socket
    return None


def first_channel_of_colour(tree, socket):
    """A value socket that carries the red channel of `socket`."""
    if bpy.app.version < (3, 3, 0):
        node = tree.nodes.new('CompositorNodeSepRGBA')
    else:
        node = tree.nodes.new('CompositorNodeSeparateColor')
    tree.links.new(socket, node.inputs[0])
    return node.outputs[0]


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
