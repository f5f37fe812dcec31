# SPDX-License-Identifier: GPL-3.0-or-later
"""A light at one frame, read from Blender, and the lamps that stand in for it in masks and truth."""

import math
from dataclasses import dataclass

import bpy
from mathutils import Matrix, Vector

from . import compat, vectors
from .export_scenes import PREFIX
from .light_emission import node_emission

TYPES = {'POINT': "point", 'SPOT': "spot", 'SUN': "sun", 'AREA': "area"}


@dataclass
class LightState:
    name: str
    kind: str               # "point", "spot", "sun" or "area"
    position: tuple
    direction: tuple        # unit; the way the light's own -Z looks
    radius: float           # world units; sun: tangent of half its angle
    half_length: float      # of the longer side of an area, otherwise the radius
    surface_axes: tuple     # of an area, the longer side first; None otherwise
    cone: tuple             # (full angle, blend) of a spot; None otherwise
    color: tuple            # with that of the light's nodes
    energy: float           # as it is in this frame: with its nodes' strength, 0 where it is hidden
    casts_shadow: bool
    narrowed: bool          # whether an area light has a spread of less than 180 degrees
    unknown_node: str       # name of a node of the light that could not be followed, or None
    world_from_light: Matrix


def read_light(evaluated, name):
    """The state of an evaluated light object, called `name` in what is written."""
    data, matrix = evaluated.data, evaluated.matrix_world.copy()
    rotation = matrix.to_quaternion()
    radius, half_length, axes = _size(data, matrix, rotation)
    cone = (data.spot_size, data.spot_blend) if data.type == 'SPOT' else None
    emission = node_emission(data)
    energy, color = compat.light_output(data, TYPES[data.type], radius)
    hidden = evaluated.hide_render or not getattr(evaluated, "visible_diffuse", True)
    return LightState(
        name, TYPES[data.type], tuple(matrix.translation), tuple(rotation @ Vector((0, 0, -1))),
        radius, half_length, axes, cone,
        tuple(one * other for one, other in zip(color, emission.color)),
        0.0 if hidden else energy * emission.strength, compat.casts_shadow(data),
        data.type == 'AREA' and data.spread < 0.999 * math.pi, emission.unknown, matrix)


def _size(data, matrix, rotation):
    if data.type == 'SUN':
        tangent = math.tan(min(0.5 * data.angle, 0.49 * math.pi))
        return tangent, tangent, None
    if data.type != 'AREA':
        return data.shadow_soft_size, data.shadow_soft_size, None
    scale = matrix.to_scale()
    square = data.shape in {'SQUARE', 'DISK'}
    width = data.size * abs(scale.x)
    height = (data.size if square else data.size_y) * abs(scale.y)
    # Circle of equal area: a rectangle's w h, an ellipse's pi w h / 4.
    area = width * height * (math.pi / 4 if data.shape in {'DISK', 'ELLIPSE'} else 1.0)
    axes = [tuple(rotation @ Vector(axis)) for axis in ((1, 0, 0), (0, 1, 0))]
    if height > width:
        axes.reverse()
    return math.sqrt(area / math.pi), 0.5 * max(width, height), tuple(axes)


def area_extents(evaluated):
    """(shape, half the longer side, half the shorter) of an evaluated area light in the world."""
    data, scale = evaluated.data, evaluated.matrix_world.to_scale()
    square = data.shape in {'SQUARE', 'DISK'}
    sides = data.size * abs(scale.x), (data.size if square else data.size_y) * abs(scale.y)
    shape = "ellipse" if data.shape in {'DISK', 'ELLIPSE'} else "rectangle"
    return shape, 0.5 * max(sides), 0.5 * min(sides)


def travel_direction(state, subject_center):
    """Unit direction from the light to its subject; a sun's and an area's own direction."""
    if state.kind in ("sun", "area"):
        return state.direction
    return vectors.normalize(vectors.subtract(subject_center, state.position), state.direction)


def new_mask_lamp(light, kind, name):
    """A lamp of size 0. An area shines to one side only, as a spot of 180 degrees does."""
    data = bpy.data.lights.new(PREFIX + name, {'point': 'POINT', 'sun': 'SUN'}.get(kind, 'SPOT'))
    data.energy = 1.0 if kind == "sun" else 1000.0
    if kind == "sun":
        data.angle = 0.0
    else:
        data.shadow_soft_size = 0.0
    return _new_lamp(light, name, data)


def place_mask_lamp(lamp, state, position, direction):
    """Put a mask's lamp at its place; `direction` is a sun's, None for the others."""
    if direction is not None:
        turn = Vector(direction).to_track_quat('-Z', 'Y')
    else:
        turn = state.world_from_light.to_quaternion()
    lamp.matrix_world = Matrix.Translation(position) @ turn.to_matrix().to_4x4()
    if lamp.data.type == 'SPOT':
        angle, blend = state.cone or (math.pi, 0.0)
        lamp.data.spot_size, lamp.data.spot_blend = angle, blend


def new_truth_lamp(light, name, shadow):
    """The light itself at its real size, in plain white, with or without shadows."""
    data = light.data.copy()
    data.animation_data_clear()
    data.name = PREFIX + name
    data.use_nodes = False
    data.color = (1.0, 1.0, 1.0)
    data.energy = 1.0 if data.type == 'SUN' else 1000.0
    compat.set_casts_shadow(data, shadow)
    return _new_lamp(light, name, data)


def _new_lamp(light, name, data):
    lamp = bpy.data.objects.new(PREFIX + name, data)
    compat.copy_light_linking(light, lamp)
    return lamp


def place_truth_lamp(lamp, state, evaluated):
    lamp.matrix_world = state.world_from_light
    for name in ("shadow_soft_size", "angle", "shape", "size", "size_y", "spread", "spot_size",
                 "spot_blend"):
        if hasattr(evaluated.data, name):
            setattr(lamp.data, name, getattr(evaluated.data, name))
