# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a shot of 24 frames in which a character walks:

    blender -b --factory-startup --python-exit-code 3 -P examples/walk.py -- OUT.blend

One skinned mesh with an armature, a shape key that breathes and hair; a cloak that the armature
carries and a wave moves; leaves and stones strewn over the floor as instances. Brush strokes have
to stay on all of it.
"""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402  (after the path, with the module that needs it)
from mathutils import Vector  # noqa: E402

import scene_tools as tools  # noqa: E402

FRAMES = 24       # one cycle: two steps
STRIDE = 1.4      # of the cycle, along y
BONES = {         # name: (parent, from, to); left is +x
    "Hips": (None, (0, 0, 0.92), (0, 0, 1.10)),
    "Chest": ("Hips", (0, 0, 1.10), (0, 0, 1.46)),
    "Head": ("Chest", (0, 0, 1.50), (0, 0, 1.86)),
    "Thigh.L": ("Hips", (0.11, 0, 0.92), (0.11, 0, 0.50)),
    "Shin.L": ("Thigh.L", (0.11, 0, 0.50), (0.11, 0, 0.04)),
    "Thigh.R": ("Hips", (-0.11, 0, 0.92), (-0.11, 0, 0.50)),
    "Shin.R": ("Thigh.R", (-0.11, 0, 0.50), (-0.11, 0, 0.04)),
    "Arm.L": ("Chest", (0.25, 0, 1.40), (0.31, 0, 1.12)),
    "Hand.L": ("Arm.L", (0.31, 0, 1.12), (0.33, 0.04, 0.84)),
    "Arm.R": ("Chest", (-0.25, 0, 1.40), (-0.31, 0, 1.12)),
    "Hand.R": ("Arm.R", (-0.31, 0, 1.12), (-0.33, 0.04, 0.84))}


def limbs(side):
    """Rods of one leg and one arm: (x, y, z, radius)."""
    return [[(side * 0.11, 0, 0.98, 0.12), (side * 0.11, 0, 0.5, 0.085), (side * 0.11, 0, 0.12, 0.06),
             (side * 0.11, 0, 0.06, 0.06)],
            [(side * 0.11, -0.07, 0.05, 0.055), (side * 0.11, 0.17, 0.045, 0.05)],
            [(side * 0.16, 0, 1.40, 0.075), (side * 0.26, 0, 1.38, 0.07), (side * 0.31, 0, 1.12, 0.055),
             (side * 0.33, 0.04, 0.86, 0.045), (side * 0.335, 0.05, 0.78, 0.055)]]


def build_body(surface, hair):
    rods = [[(0, 0, 0.88, 0.15), (0, 0, 1.05, 0.15), (0, 0, 1.25, 0.18), (0, 0, 1.42, 0.17),
             (0, 0, 1.50, 0.08), (0, 0, 1.56, 0.07), (0, 0.01, 1.60, 0.12), (0, 0.01, 1.72, 0.155),
             (0, 0, 1.82, 0.13), (0, 0, 1.88, 0.06)]] + limbs(1) + limbs(-1)
    rough = tools.tube("Rough", rods, surface, 16)
    remesh = rough.modifiers.new("Remesh", 'REMESH')
    remesh.mode, remesh.voxel_size = 'VOXEL', 0.022
    smooth = rough.modifiers.new("Smooth", 'SMOOTH')
    smooth.factor, smooth.iterations = 0.5, 6
    whole = rough.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = bpy.data.meshes.new_from_object(whole)
    bpy.data.objects.remove(rough)
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    mesh.materials.clear()
    mesh.materials.append(surface)
    mesh.materials.append(hair)
    body = bpy.data.objects.new("Walker", mesh)
    bpy.context.scene.collection.objects.link(body)
    return body


def build_bones():
    data = bpy.data.armatures.new("Bones")
    bones = bpy.data.objects.new("Bones", data)
    bpy.context.scene.collection.objects.link(bones)
    bpy.context.view_layer.objects.active = bones
    bpy.ops.object.mode_set(mode='EDIT')
    for name, (parent, start, end) in BONES.items():
        bone = data.edit_bones.new(name)
        bone.head, bone.tail = start, end
        bone.parent = data.edit_bones[parent] if parent else None
    bpy.ops.object.mode_set(mode='OBJECT')
    return bones


def distance_to(point, start, end):
    start, end = Vector(start), Vector(end)
    along = max(0.0, min(1.0, (point - start).dot(end - start) / (end - start).length_squared))
    return (point - start.lerp(end, along)).length


def skin(body, bones):
    """Every point is held by the bones near it."""
    groups = {name: body.vertex_groups.new(name=name) for name in BONES}
    for vertex in body.data.vertices:
        shares = {name: 1 / (0.02 + distance_to(vertex.co, start, end)) ** 6
                  for name, (_, start, end) in BONES.items()}
        total = sum(shares.values())
        for name, share in shares.items():
            if share > 0.01 * total:
                groups[name].add([vertex.index], share / total, 'REPLACE')
    body.parent = bones
    body.modifiers.new("Armature", 'ARMATURE').object = bones


def breathe(body):
    """A shape key that widens chest and belly."""
    body.shape_key_add(name="Basis")
    key = body.shape_key_add(name="Breath")
    for number, point in enumerate(key.data):
        vertex = body.data.vertices[number]
        away = (vertex.co - Vector((0, 0.1, 1.25))).length
        point.co = vertex.co + vertex.normal * 0.05 * math.exp(-(away / 0.16) ** 2)
    for frame in range(1, FRAMES + 1):
        key.value = 0.5 - 0.5 * math.cos(2 * math.pi * (frame - 1) / FRAMES)
        key.keyframe_insert("value", frame=frame)


def grow_hair(body):
    scalp = body.vertex_groups.new(name="Scalp")
    for vertex in body.data.vertices:
        if vertex.co.z > 1.74 and vertex.co.y < 0.08:
            scalp.add([vertex.index], 1.0, 'REPLACE')
    system = body.modifiers.new("Hair", 'PARTICLE_SYSTEM').particle_system
    system.vertex_group_density = scalp.name
    hair = system.settings
    hair.type, hair.count, hair.hair_length = 'HAIR', 900, 0.16
    hair.material, hair.root_radius, hair.tip_radius = 2, 1.6, 0.4
    hair.use_advanced_hair, hair.object_align_factor = True, (0, -0.03, -0.02)


def build_cloak(bones, surface):
    """Hangs from the shoulders behind the back, carried by the chest, and waves."""
    rows, columns = 28, 24
    points = []
    for row in range(rows + 1):
        down = row / rows
        for column in range(columns + 1):
            angle = math.pi * (0.02 + 0.96 * column / columns)
            wide = 0.27 + 0.16 * down
            points.append((wide * math.cos(angle), -(0.19 + 0.20 * down) * math.sin(angle) + 0.03,
                           1.45 - 0.85 * down))
    faces = [[row * (columns + 1) + column, row * (columns + 1) + column + 1,
              (row + 1) * (columns + 1) + column + 1, (row + 1) * (columns + 1) + column]
             for row in range(rows) for column in range(columns)]
    cloak = tools.mesh_object("Cloak", points, faces, [surface])
    cloak.vertex_groups.new(name="Chest").add(range(len(points)), 1.0, 'REPLACE')
    loose = cloak.vertex_groups.new(name="Loose")
    for number in range(len(points)):
        loose.add([number], (number // (columns + 1) / rows) ** 1.5, 'REPLACE')
    wave = cloak.modifiers.new("Wave", 'WAVE')
    wave.use_normal, wave.use_x, wave.use_y, wave.use_cyclic = True, True, False, True
    wave.height, wave.width, wave.narrowness, wave.speed = 0.10, 0.30, 3.0, 0.05
    wave.vertex_group, wave.time_offset = loose.name, -40
    cloak.modifiers.new("Armature", 'ARMATURE').object = bones
    cloak.parent = bones


def walk(bones):
    for frame in range(1, FRAMES + 1):
        turn = 2 * math.pi * (frame - 1) / FRAMES
        bones.location = (0, STRIDE * ((frame - 1) / FRAMES - 0.5), 0.02 * math.cos(2 * turn) - 0.02)
        bones.keyframe_insert("location", frame=frame)
        angles = {"Chest": -0.06, "Head": 0.05 + 0.03 * math.sin(2 * turn)}
        for side, phase in (("L", turn), ("R", turn + math.pi)):
            angles[f"Thigh.{side}"] = 0.06 + 0.42 * math.sin(phase)
            angles[f"Shin.{side}"] = -0.12 - 0.75 * max(0.0, math.cos(phase)) ** 2
            angles[f"Arm.{side}"] = -0.38 * math.sin(phase)
            angles[f"Hand.{side}"] = 0.35 - 0.2 * math.sin(phase)
        for name, angle in angles.items():
            bone = bones.pose.bones[name]
            bone.rotation_mode = 'XYZ'
            bone.rotation_euler = (angle, 0, 0)
            bone.keyframe_insert("rotation_euler", frame=frame)


def build_leaf():
    points, faces = [], []
    for row in range(7):
        along = row / 6
        wide = 0.055 * math.sin(math.pi * min(1.0, along + 0.06)) ** 0.8
        for side in (-1, 0, 1):
            points.append((0.03 * abs(side) + 0.05 * along ** 2, side * wide, 0.24 * (along - 0.5)))
    for row in range(6):
        for side in range(2):
            low = 3 * row + side
            faces.append([low, low + 1, low + 4, low + 3])
    return tools.mesh_object("Leaf", points, faces, [tools.material("Leaf", (0.42, 0.20, 0.04))])


def build_pebble():
    outline = [(0.0, -0.05), (0.06, -0.04), (0.09, 0.0), (0.06, 0.04), (0.0, 0.05)]
    return tools.revolve("Pebble", tools.smooth_curve(outline, 4),
                         tools.material("Pebble", (0.30, 0.32, 0.36)), 24)


def strew(floor, thing, count, seed):
    thing.location = (0, 0, -5)  # the original lies out of sight
    system = floor.modifiers.new(thing.name, 'PARTICLE_SYSTEM').particle_system
    system.seed = seed
    spread = system.settings
    spread.type, spread.count, spread.use_advanced_hair = 'HAIR', count, True
    spread.render_type, spread.instance_object = 'OBJECT', thing
    spread.particle_size, spread.size_random, spread.hair_length = 1.0, 0.4, 1.0
    spread.use_rotations, spread.rotation_mode = True, 'GLOB_Z'
    spread.phase_factor_random, spread.rotation_factor_random = 2.0, 0.06


def build_floor():
    tools.plane("Ground", [(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)],
                tools.material("Earth", (0.40, 0.36, 0.28)))
    strewn = tools.plane("Strewn", [(-1.6, -2.0, 0.03), (1.5, -2.0, 0.03), (1.5, 2.0, 0.03),
                                    (-1.6, 2.0, 0.03)], tools.material("Bare", (0.4, 0.36, 0.28)))
    strewn.show_instancer_for_render = False
    strew(strewn, build_leaf(), 110, 3)
    strew(strewn, build_pebble(), 40, 8)


def main():
    path = tools.output_path()
    scene = tools.empty_scene(640, 400, 8, "Walk")
    scene.frame_start, scene.frame_end = 1, FRAMES
    tools.set_world((0.55, 0.65, 0.80), 0.25)
    bones = build_bones()
    body = build_body(tools.material("Skin", (0.62, 0.38, 0.24)),
                      tools.material("Hair", (0.12, 0.06, 0.03)))
    skin(body, bones)
    breathe(body)
    grow_hair(body)
    build_cloak(bones, tools.material("Cloth", (0.30, 0.05, 0.07)))
    walk(bones)
    build_floor()
    sun = bpy.data.lights.new("Sun", 'SUN')
    sun.energy, sun.angle = 3.2, 0.06
    lamp = bpy.data.objects.new("Sun", sun)
    lamp.rotation_euler = (0.1, 0.75, 0)
    scene.collection.objects.link(lamp)
    tools.camera((4.6, 1.9, 1.5), (0, 0.05, 0.88), 50)
    scene.frame_set(1)
    tools.save(path)


main()
