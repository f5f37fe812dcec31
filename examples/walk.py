# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a shot of 24 frames in which a character walks:

    blender -b --factory-startup --python-exit-code 3 -P examples/walk.py -- OUT.blend

A child in a waving cloak (walker.py: one skinned mesh, an armature, a shape key, hair) crosses an
autumn meadow in low sun; leaves, grass and stones are instances. Brush strokes have to stay on all
of it.
"""

import math
import os
import random
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402  (after the path, with the modules that need it)
from mathutils import Vector  # noqa: E402

import scene_tools as tools  # noqa: E402
import walker  # noqa: E402

FRAMES = 24       # one cycle: two steps
EYE, LOOKED_AT = Vector((3.5, 3.1, 0.95)), Vector((0, 0.0, 0.80))
BACK = Vector((LOOKED_AT.x - EYE.x, LOOKED_AT.y - EYE.y, 0)).normalized()
RIGHT = Vector((BACK.y, -BACK.x, 0))


def behind(right, back, up=0.0):
    """A place so far to the right of the character, behind it and above it, as the camera sees it."""
    return RIGHT * right + BACK * back + Vector((0, 0, up))


def build_leaf(name, colour):
    points, faces = [], []
    for row in range(7):
        along = row / 6
        wide = 0.040 * math.sin(math.pi * min(1.0, along + 0.06)) ** 0.8
        for side in (-1, 0, 1):
            points.append((0.02 * abs(side) + 0.04 * along ** 2, side * wide, 0.15 * (along - 0.5)))
    for row in range(6):
        for side in range(2):
            low = 3 * row + side
            faces.append([low, low + 1, low + 4, low + 3])
    return tools.mesh_object(name, points, faces, [tools.material(name, colour)])


def build_grass():
    """A tuft of bent blades; its x is up, as particles stand along x."""
    chance = random.Random(2)
    points, faces = [], []
    for _ in range(11):
        turn, lean = chance.uniform(0, 2 * math.pi), chance.uniform(0.04, 0.16)
        tall, wide = chance.uniform(0.10, 0.24), chance.uniform(0.008, 0.013)
        across = Vector((0, -math.sin(turn), math.cos(turn)))
        out = Vector((0, math.cos(turn), math.sin(turn)))
        first = len(points)
        for row in range(5):
            along = row / 4
            middle = Vector((tall * along, 0, 0)) + out * (0.03 + lean * along ** 2)
            half = across * wide * (1 - 0.95 * along)
            points += [tuple(middle - half), tuple(middle + half)]
        faces += [[first + 2 * row, first + 2 * row + 1, first + 2 * row + 3, first + 2 * row + 2]
                  for row in range(4)]
    return tools.mesh_object("Grass", points, faces, [tools.material("Grass", (0.20, 0.24, 0.06))])


def build_pebble():
    outline = [(0.0, -0.03), (0.04, -0.025), (0.06, 0.0), (0.04, 0.025), (0.0, 0.03)]
    return tools.revolve("Pebble", tools.smooth_curve(outline, 4),
                         tools.material("Pebble", (0.30, 0.32, 0.36)), 24)


def strew(floor, thing, count, seed, upright=0.05, size=1.0):
    thing.location = (0, 0, -5)  # the original lies out of sight
    system = floor.modifiers.new(thing.name, 'PARTICLE_SYSTEM').particle_system
    system.seed = seed
    spread = system.settings
    spread.type, spread.count, spread.use_advanced_hair = 'HAIR', count, True
    spread.render_type, spread.instance_object = 'OBJECT', thing
    spread.particle_size, spread.size_random, spread.hair_length = size, 0.4, 1.0
    spread.use_rotations, spread.rotation_mode = True, 'GLOB_Z'
    spread.phase_factor_random, spread.rotation_factor_random = 2.0, upright


def height(x, y):
    """Of the meadow: flat where the character walks, rolling behind it."""
    back = max(0.0, BACK.x * x + BACK.y * y - 1.0)
    return 0.10 * min(back, 3.0) * (0.6 + 0.4 * math.sin(0.9 * x - 0.7 * y)) * min(1.0, back)


def patch(name, low, high, across, surface, lift=0.0):
    """A piece of the meadow between two places (right, back)."""
    points = []
    for row in range(across + 1):
        for column in range(across + 1):
            place = behind(low[0] + (high[0] - low[0]) * column / across,
                           low[1] + (high[1] - low[1]) * row / across)
            points.append((place.x, place.y, height(place.x, place.y) + lift))
    step = across + 1
    faces = [[row * step + column, row * step + column + 1, (row + 1) * step + column + 1,
              (row + 1) * step + column] for row in range(across) for column in range(across)]
    return tools.mesh_object(name, points, faces, [surface])


def build_meadow(leaves):
    patch("Meadow", (-14, -5), (14, 11), 60, tools.material("Meadow", (0.30, 0.28, 0.10)))
    bare = tools.material("Bare", (0.4, 0.36, 0.28))
    near = patch("Strewn", (-2.2, -2.3), (2.4, 2.4), 12, bare, 0.02)
    for number, leaf in enumerate(leaves):
        strew(near, leaf, 75, 3 + number, 0.10)
    strew(near, build_pebble(), 26, 8)
    grass = build_grass()
    far = patch("Grown", (-5, 0.75), (5, 7.5), 24, bare, 0.0)
    for ground, count, seed in ((near, 80, 5), (far, 380, 6)):
        strew(ground, grass, count, seed, 0.02)
    for ground in (near, far):
        ground.show_instancer_for_render = False


def build_tree(place, tall, crown, leaf, seed):
    bark = bpy.data.materials.get("Bark") or tools.material("Bark", (0.14, 0.09, 0.07))
    base = height(place.x, place.y) - 0.1
    chance = random.Random(seed)
    bend = chance.uniform(-0.25, 0.25)
    trunk = [(place.x + RIGHT.x * bend * t * t, place.y + RIGHT.y * bend * t * t, base + tall * t,
              0.05 + 0.16 * (1 - t) ** 2) for t in (step / 8 for step in range(9))]
    tools.tube(f"Trunk {seed}", [trunk], bark, 20)
    top = Vector(trunk[-1][:3])
    balls = [(top + RIGHT * crown * r + Vector((0, 0, crown * u)), crown * s)
             for r, u, s in ((0, 0.2, 0.8), (-0.7, -0.1, 0.6), (0.7, -0.05, 0.62), (0.1, 0.75, 0.55))]
    mass = tools.tube(f"Crown {seed}", [walker.ball(c, r) for c, r in balls],
                      tools.material(f"Crown {seed}", (0.4, 0.18, 0.05)), 28)
    mass.modifiers.new("Leaves", 'PARTICLE_SYSTEM')
    spread = mass.particle_systems[0].settings
    spread.type, spread.count, spread.use_advanced_hair = 'HAIR', 800, True
    spread.render_type, spread.instance_object, spread.hair_length = 'OBJECT', leaf, 1.0
    spread.particle_size, spread.size_random = 2.9, 0.5
    spread.use_rotations, spread.rotation_mode = True, 'NOR'
    spread.phase_factor_random, spread.rotation_factor_random = 2.0, 0.35


def build_sky():
    """A screen far behind that leans over as it rises: bright above the horizon, deep at the top."""
    rows, columns = 24, 12
    points = [tuple(behind(40 * (column / columns - 0.5), 15 - 3.2 * (row / rows) ** 2, 9 * row / rows - 1))
              for row in range(rows + 1) for column in range(columns + 1)]
    step = columns + 1
    faces = [[row * step + column + 1, row * step + column, (row + 1) * step + column,
              (row + 1) * step + column + 1] for row in range(rows) for column in range(columns)]
    tools.mesh_object("Sky", points, faces, [tools.material("Sky", (0.4, 0.5, 0.6))])


def main():
    path = tools.output_path()
    scene = tools.empty_scene(640, 400, 2, "Walk")
    scene.frame_start, scene.frame_end = 1, FRAMES
    tools.set_world((0.55, 0.65, 0.80), 0.25)
    walker.build(FRAMES)
    leaves = [build_leaf("Leaf Red", (0.45, 0.10, 0.03)), build_leaf("Leaf Gold", (0.60, 0.36, 0.06)),
              build_leaf("Leaf Brown", (0.25, 0.12, 0.05))]
    build_meadow(leaves)
    build_tree(behind(-2.5, 5.0), 2.3, 1.1, leaves[1], 1)
    build_tree(behind(2.9, 6.5), 2.7, 1.3, leaves[0], 2)
    build_sky()
    sun = bpy.data.lights.new("Sun", 'SUN')
    sun.energy, sun.angle = 3.2, 0.06
    lamp = bpy.data.objects.new("Sun", sun)
    lamp.rotation_euler = (RIGHT * 0.62 - BACK * 0.58 + Vector((0, 0, 0.50))).to_track_quat('Z', 'Y').to_euler()
    scene.collection.objects.link(lamp)
    tools.camera(EYE, LOOKED_AT, 46)
    scene.frame_set(1)
    tools.save(path)


main()
