# SPDX-License-Identifier: GPL-3.0-or-later
"""What keeps a light's masks from being taken by rays of a shader node, which meet everything as
plain opaque surfaces and know nothing of light linking."""

from dataclasses import dataclass

import bpy
from mathutils import Vector

from . import compat, mask_materials, sight_nodes, smooth_faces

ROUND_SUN = 0.02   # radians to spare round the masks of a sun


@dataclass
class Obstacle:
    words: str
    speaks: bool = True   # False: of no concern to someone who asked for `auto`


def of_rays(by, light, objects, turn=None):
    """Why rays are wrong for the light among the objects, or None."""
    if compat.has_light_linking(light):
        return Obstacle("its light linking is known to lamps only")
    if turn and light.data.type == 'SUN':
        toward = light.matrix_world.to_quaternion() @ Vector((0.0, 0.0, 1.0))
        if toward.angle(sight_nodes.blind_toward(turn)) < 0.5 * light.data.angle + ROUND_SUN:
            return Obstacle("the Ambient Occlusion node cannot be aimed where this sun stands")
    for item in objects:
        words = _of_object(by, item)
        if words:
            return Obstacle(f"object '{item.name}' {words}")
    return None


def of_coarse_faces(objects, radius):
    """Why rays give other masks than lamps on a subject of `radius`, or None."""
    item = smooth_faces.coarse_object(objects, radius, bpy.context.evaluated_depsgraph_get())
    return item and Obstacle(f"object '{item.name}' has coarse faces that are shaded smooth, where "
                             f"rays and lamps see different things")


def _of_object(by, item):
    if item.type in {'CURVES', 'POINTCLOUD'}:
        return "is made of hair or points"
    if item.type == 'VOLUME':
        return "is a volume"
    if any(system.settings.type == 'HAIR' and system.settings.render_type == 'PATH'
           for system in item.particle_systems):
        return "has hair"
    if by != "groups" and not item.visible_shadow:
        return "casts no shadow, which rays of a shader node cannot tell to the pixel"
    for slot in item.material_slots:
        if slot.material and mask_materials.blocks_otherwise(slot.material):
            return f"has the material '{slot.material.name}', which has holes, displacement or fog"
    return None
