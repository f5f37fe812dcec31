# SPDX-License-Identifier: GPL-3.0-or-later
"""What an artist may expect of the export and does not get, each said once, with what to do."""

from . import compat


def ignored_settings(scene, view_layer):
    """Notes on settings of the file that the export leaves out; ask before they are switched off."""
    render = scene.render
    notes = []
    if render.use_border:
        notes.append("the render border is ignored: the whole frame is rendered")
    if render.use_multiview:
        notes.append("stereo is ignored: one view is rendered, that of the camera itself; export "
                     "each eye's camera on its own")
    others = [other.name for other in scene.view_layers if other.use and other != view_layer]
    if others:
        notes.append(f"only the view layer '{view_layer.name}' is rendered, not "
                     f"{', '.join(others)}")
    if view_layer.use_pass_mist:
        notes.append("the Mist pass is not written; data.Depth has the distance")
    if render.use_compositing and compat.has_compositing(scene):
        notes.append("the file's compositing is not applied to the beauty")
    if render.use_sequencer and scene.sequence_editor and _strips(scene.sequence_editor):
        notes.append("the file's video sequence is ignored")
    return notes


def scene_notes(scene, view_layer, options):
    """Notes on the beauty beside the sharp data, and on the size of the frames."""
    notes = []
    render, camera = scene.render, scene.camera
    if camera and camera.type == 'CAMERA' and camera.data.dof.use_dof:
        notes.append("the beauty has depth of field, but data, masks and paint are sharp: switch "
                     "it off and blur the comp by data.Depth")
    if render.use_motion_blur:
        notes.append("the beauty has motion blur, but data, masks and paint are sharp: switch it "
                     "off and blur the comp by data.Vector")
    if options.scale > 1:
        notes.append(f"frames are {render.resolution_x}x{render.resolution_y} pixels, "
                     f"{options.scale} times the shot's own; output.scale = {options.scale} in "
                     "the look writes the comp at the shot's size")
    return notes


def _strips(editor):
    return editor.strips_all if hasattr(editor, "strips_all") else editor.sequences_all
