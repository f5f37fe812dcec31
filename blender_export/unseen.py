# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that a view layer shows otherwise than as themselves: not to the camera, cut, see-through."""


def hide_indirect(view_layer):
    """Keep what its collection makes indirect only from the camera of every other layer too."""
    for item in _objects_where(view_layer, "indirect_only"):
        item.visible_camera = False


def unpainted_objects(view_layer):
    """Holdouts, which are cut, and shadow catchers, behind which the picture shows."""
    held = _objects_where(view_layer, "holdout")
    return held | {item for item in view_layer.objects
                   if getattr(item, "is_holdout", False) or getattr(item, "is_shadow_catcher", False)}


def _objects_where(view_layer, flag):
    """Objects in collections that have the flag in this view layer, themselves or from above."""
    found = set()

    def visit(layer_collection, inherited):
        on = inherited or getattr(layer_collection, flag)
        if on:
            found.update(layer_collection.collection.objects)
        for child in layer_collection.children:
            visit(child, on)

    visit(view_layer.layer_collection, False)
    return found
