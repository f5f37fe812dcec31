# SPDX-License-Identifier: GPL-3.0-or-later
"""The artist's scene as the exporter sees it: what renders, with which ids, lit by which lights.

All changes made here stay in the memory of the exporting Blender, which never saves.
"""

import bpy

from . import animation
from .errors import ExportError, nearest

GEOMETRY = {'MESH', 'CURVE', 'CURVES', 'SURFACE', 'FONT', 'META', 'VOLUME', 'POINTCLOUD'}
HIGHEST_INDEX = 32767


def active_view_layer(scene):
    """The first view layer that renders."""
    for view_layer in scene.view_layers:
        if view_layer.use:
            return view_layer
    raise ExportError(f"scene '{scene.name}' has no view layer that is used for rendering")


def rendered_objects(view_layer):
    """Objects in collections that render, in the view layer, by name; their own switch may be animated."""
    found = {}

    def visit(layer_collection):
        if layer_collection.exclude or layer_collection.collection.hide_render:
            return
        for item in layer_collection.collection.objects:
            found[item.name_full] = item
        for child in layer_collection.children:
            visit(child)

    visit(view_layer.layer_collection)
    return [found[name] for name in sorted(found)]


def evaluate_as_rendered(objects, view_layer):
    """Let evaluation see what a render sees: view layer, collections, modifiers, subdivision."""
    if bpy.context.window:
        bpy.context.window.view_layer = view_layer
    for collection in bpy.data.collections:
        collection.hide_viewport = collection.hide_render
    _open_eyes(view_layer.layer_collection)
    for item in objects:
        item.hide_set(False, view_layer=view_layer)
        for modifier in item.modifiers:
            modifier.show_viewport = modifier.show_render
            if modifier.type in {'SUBSURF', 'MULTIRES'}:
                modifier.levels = modifier.render_levels


def go_to_frame(scene, objects, frame, subframe=0.0):
    """Evaluate `frame` with the objects' own switches, which may be animated, as a render sees them."""
    for item in objects:
        # What is hidden is not evaluated, and would never learn that it appears.
        if animation.is_animated(item, "hide_render"):
            item.hide_viewport = False
    scene.frame_set(frame, subframe=subframe)
    for item in objects:
        # A light that is off is still asked where it is.
        item.hide_viewport = item.hide_render and item.type != 'LIGHT'


def _open_eyes(layer_collection):
    layer_collection.hide_viewport = False
    for child in layer_collection.children:
        _open_eyes(child)


def lights_asked_for(objects, names, unique):
    """The named lights, or all that there are; ExportError names what there is."""
    lights = {unique.of(item): item for item in objects if item.type == 'LIGHT'}
    for name in names:
        if name not in lights:
            known = ", ".join(sorted(lights)) or "none"
            raise ExportError(f"there is no light '{name}' that renders (lights: {known})"
                              f"{nearest(name, list(lights))}")
    if names:
        return [lights[name] for name in dict.fromkeys(names)]
    return [item for item in lights.values() if not _is_portal(item.data)]


def _is_portal(light):
    return getattr(getattr(light, "cycles", None), "is_portal", False)


def refuse_instanced_lights(objects):
    """Lights inside collection instances cannot be kept out of the masks."""
    for item in objects:
        source = item.instance_collection if item.instance_type == 'COLLECTION' else None
        for inner in source.all_objects if source else ():
            if inner.type == 'LIGHT' and not inner.hide_render:
                raise ExportError(f"light '{inner.name}' lies inside the collection instance "
                                  f"'{item.name}' and would shine into every mask; use Object > "
                                  f"Apply > Make Instances Real, or turn the light off")


def give_distinct_indices(items):
    """Give every object or material an index of its own above 0.

    An index that the artist set and that nothing else has is kept.
    """
    taken = [item.pass_index for item in items]
    unique = {index for index in taken if index > 0 and taken.count(index) == 1}
    free = (index for index in range(1, HIGHEST_INDEX + 1) if index not in unique)
    for item in items:
        if item.pass_index not in unique:
            index = next(free, None)
            if index is None:
                raise ExportError(f"more than {HIGHEST_INDEX} objects or materials cannot have "
                                  f"distinct indices")
            item.pass_index = index


def all_geometry():
    """Every object that can appear in a render, also as an instance, in the order of their names."""
    return sorted((item for item in bpy.data.objects if item.type in GEOMETRY),
                  key=lambda item: item.name_full)
