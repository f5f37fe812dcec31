# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON beside a frame: what the image cannot say. `frame.schema.json` describes every property."""

import json
import os

from mathutils import Vector

from . import rest_pass, schema_check
from .errors import ExportError
from .light_view import rigid_inverse
from .murmur3 import cryptomatte_hex
from .shot import GEOMETRY
from .subject import Thing, is_flat

VERSION = 1
REFERENCE_PREFIX = "reference"


def rows(matrix):
    return [[float(value) for value in row] for row in matrix]


def numbers(vector):
    return [float(value) for value in vector]


def describe_objects(depsgraph, names, unpainted=()):
    """(JSON entries, things for the subject) of every object with geometry at the evaluated frame.

    Those of `unpainted` are marked. An object that is only there as instances is described by its first instance.
    """
    entries, things = {}, []
    for instance in depsgraph.object_instances:
        item = instance.object
        name = names.of(item)
        if name in entries:
            entries[name]["instanced"] = True
        if item.type not in GEOMETRY or name in entries or item.hide_render \
                or (item.type == 'MESH' and not item.data.polygons):
            continue
        matrix = instance.matrix_world.copy()
        low, high = (tuple(pick(corner[axis] for corner in item.bound_box) for axis in range(3))
                     for pick in (min, max))
        entry = _object_entry(item, names, matrix, low, high)
        if instance.is_instance:
            entry["instanced"] = True
        if item.original in unpainted:
            entry["painted"] = False
        entries[name] = entry
        things.append(Thing(name, [tuple(matrix @ Vector(corner)) for corner in item.bound_box],
                            entry["flat"]))
    return [entries[name] for name in sorted(entries)], things


def _object_entry(item, names, matrix, low, high):
    middle = (Vector(low) + Vector(high)) * 0.5
    marks = _reference_marks(item)
    entry = {
        "name": names.of(item), "index": item.pass_index, "crypto": cryptomatte_hex(item.name),
        "world_from_object": rows(matrix), "bounds": {"min": numbers(low), "max": numbers(high)},
        "reference_point": marks[0] if marks else numbers(matrix @ middle),
        "reference_points": marks,
        "materials": [names.of(slot.material) for slot in item.material_slots
                      if slot.material and slot.material.name != rest_pass.PLAIN],
        "flat": is_flat(low, high)}
    rest = rest_pass.bounds(item)
    if rest:
        entry["rest_bounds"] = {"min": numbers(rest[0]), "max": numbers(rest[1])}
    return entry


def _reference_marks(item):
    """World places of the object's child empties named `reference…`, by name."""
    marks = [child for child in item.original.children
             if child.type == 'EMPTY' and child.name.lower().startswith(REFERENCE_PREFIX)]
    return [numbers(child.matrix_world.translation)
            for child in sorted(marks, key=lambda child: child.name)]


def describe_materials(materials, names):
    return [{"name": names.of(material), "index": material.pass_index,
             "crypto": cryptomatte_hex(material.name)} for material in materials]


def describe_camera(view):
    world = view.world_from_camera
    return {"type": view.kind, "position": numbers(world.translation),
            "direction": numbers(world.to_quaternion() @ Vector((0, 0, -1))),
            "camera_from_world": rows(world.inverted()),
            "clip_from_camera": rows(view.clip_from_camera)}


def describe_depth_map(view, file_name, channel, size):
    return {"file": file_name, "channel": channel, "resolution": [size, size],
            "projection": view.projection, "light_from_world": rows(rigid_inverse(view.world_from_light)),
            "clip_from_light": rows(view.clip_from_light)}


def check(document):
    """ExportError where the document breaks the schema that ships with the exporter."""
    path = os.path.join(os.path.dirname(__file__), "frame.schema.json")
    with open(path, encoding="utf-8") as file:
        schema = json.load(file)
    problem = schema_check.first_problem(document, schema)
    if problem:
        raise ExportError(f"frame {document.get('frame')}: the JSON to be written breaks its "
                          f"schema: {problem}")


def text(document):
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
