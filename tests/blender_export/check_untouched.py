# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender with a shot open: an export leaves all that the open file holds as it was.

    blender -b SHOT.blend --python-exit-code 1 -P check_untouched.py -- OUTPUT WORDS...
"""

import os
import sys
import time

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paths import exporter  # noqa: E402

LIMIT_SECONDS = 300
# Of the program and its windows, made anew from the file, or how it lies in memory.
NOT_OF_THE_FILE = {"window_managers", "screens", "workspaces", "all_ids", "rna_type", "bl_rna",
                   "depsgraph", "storage_type",
                   "uv_sculpt"}  # reading it ends Blender 4.3


def file_state():
    """{path: value} of every property of every datablock; other datablocks by name only."""
    state, seen = {}, set()
    for part in bpy.data.bl_rna.properties:
        if part.type == 'COLLECTION' and part.identifier not in NOT_OF_THE_FILE:
            for item in getattr(bpy.data, part.identifier):
                _add(state, seen, f"{part.identifier}[{item.name_full}]", item)
    return state


def _add(state, seen, path, item):
    # Many things point back to what they are part of.
    place = item.as_pointer(), item.bl_rna.identifier
    state[path] = item.bl_rna.identifier
    if place in seen:
        return
    seen.add(place)
    known = item.bl_rna.properties
    for key in item.keys() if isinstance(item, (bpy.types.ID, bpy.types.ViewLayer)) else ():
        if key not in known:
            state[f"{path}[{key!r}]"] = str(item[key])
    for part in known:
        if part.identifier not in NOT_OF_THE_FILE:
            _add_property(state, seen, f"{path}.{part.identifier}", item, part)


def _add_property(state, seen, path, item, part):
    value = getattr(item, part.identifier, None)
    if part.type == 'COLLECTION':
        state[path] = len(value)
        for number, inner in enumerate(value):
            _add_inner(state, seen, f"{path}[{number}]", inner)
    elif part.type == 'POINTER':
        _add_inner(state, seen, path, value)
    else:
        state[path] = tuple(value) if getattr(part, "is_array", False) else value


def _add_inner(state, seen, path, value):
    # Trees of materials, lights and worlds belong to them and to nothing else.
    own = isinstance(value, bpy.types.NodeTree) and value.is_embedded_data
    if isinstance(value, bpy.types.ID) and not own:
        state[path] = (value.bl_rna.identifier, value.name_full)
    elif value is None:
        state[path] = None
    elif hasattr(value, "bl_rna"):
        _add(state, seen, path, value)


def main():
    output, *words = sys.argv[sys.argv.index("--") + 1:]
    exporter("panel").register()
    before = file_state()
    for name in ("materials", "lights", "worlds"):
        trees = [path for path in before if path.startswith(name) and ".node_tree.nodes[" in path]
        assert trees, f"no nodes of {name} are looked at"
    assert any(".cycles.samples" in path for path in before), "no settings of Cycles are looked at"
    export = exporter("background_export").BackgroundExport(["--output", output, *words])
    start = time.monotonic()
    while not export.poll():
        assert time.monotonic() - start < LIMIT_SECONDS, "the export does not end"
        time.sleep(0.05)
    assert export.error is None, export.error
    after = file_state()
    changed = [path for path in before.keys() | after.keys() if before.get(path) != after.get(path)]
    assert not changed, [(path, before.get(path), after.get(path)) for path in sorted(changed)[:20]]
    print(f"untouched: {len(before)} properties", flush=True)


main()
