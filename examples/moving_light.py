# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a shot of 24 frames in which the light goes round and an object turns and moves:

    blender -b --factory-startup --python-exit-code 3 -P examples/moving_light.py -- OUT.blend

A head turns as it slides between a column and a ring on a plain floor, while the one large light
travels a third of a circle: brush strokes and penumbrae have to follow both.
"""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402  (after the path, with the module that needs it)

import scene_tools as tools  # noqa: E402

FRAMES = 24


def key_every_frame(item, place):
    """Key location and rotation from `place(share)`, share running from 0 to 1, on every frame."""
    for frame in range(1, FRAMES + 1):
        location, turn = place((frame - 1) / (FRAMES - 1))
        item.location = location
        item.rotation_euler = turn
        item.keyframe_insert("location", frame=frame)
        item.keyframe_insert("rotation_euler", frame=frame)


def build_head():
    bpy.ops.mesh.primitive_monkey_add(size=1.7)
    head = bpy.context.object
    head.name = head.data.name = "Head"
    subdivision = head.modifiers.new("Subdivision", 'SUBSURF')
    subdivision.levels = subdivision.render_levels = 2
    for polygon in head.data.polygons:
        polygon.use_smooth = True
    head.data.materials.append(tools.material("Terracotta", (0.55, 0.20, 0.10)))
    key_every_frame(head, lambda share: (
        (-0.9 + 1.5 * share, -0.5 - 0.5 * share, 0.86 + 0.25 * math.sin(math.pi * share)),
        (math.radians(-12), 0.0, math.radians(-35 + 80 * share))))


def build_column():
    outline = [(0.0, 0.0), (0.46, 0.0), (0.46, 0.10), (0.36, 0.18), (0.30, 0.30), (0.28, 1.0),
               (0.26, 1.9), (0.30, 2.05), (0.42, 2.15), (0.42, 2.28), (0.0, 2.28)]
    column = tools.revolve("Column", tools.smooth_curve(outline, 6),
                           tools.material("Chalk", (0.70, 0.66, 0.56)))
    column.location = (-2.0, 0.9, 0)


def build_ring():
    bpy.ops.mesh.primitive_torus_add(major_radius=0.75, minor_radius=0.13, major_segments=96,
                                     minor_segments=32, location=(2.1, 0.7, 0.88),
                                     rotation=(math.radians(90), 0, math.radians(25)))
    ring = bpy.context.object
    ring.name = ring.data.name = "Ring"
    for polygon in ring.data.polygons:
        polygon.use_smooth = True
    ring.data.materials.append(tools.material("Verdigris", (0.10, 0.36, 0.29), 0.5))


def build_step():
    step = tools.box("Step", (-0.55, -0.55, 0), (0.55, 0.55, 0.3),
                     tools.material("Slate", (0.22, 0.26, 0.34)))
    step.location = (1.9, -0.85, 0)
    step.rotation_euler = (0, 0, math.radians(20))


def main():
    path = tools.output_path()
    scene = tools.empty_scene(640, 360, 16, "Moving Light")
    scene.frame_start, scene.frame_end = 1, FRAMES
    tools.set_world((0.50, 0.60, 0.75), 0.30)
    tools.plane("Floor", [(-30, -30, 0), (30, -30, 0), (30, 30, 0), (-30, 30, 0)],
                tools.material("Floor Paint", (0.55, 0.50, 0.40), 0.9))
    build_column()
    build_ring()
    build_step()
    build_head()
    key = tools.point_light("Key", (0, 0, 0), 0.35, 1500, (1.0, 0.90, 0.75))
    key_every_frame(key, lambda share: (
        (4.6 * math.cos(math.radians(200 + 120 * share)),
         4.6 * math.sin(math.radians(200 + 120 * share)), 4.4), (0.0, 0.0, 0.0)))
    tools.camera((0.0, -9.0, 3.6), (0.0, 0.1, 0.75), 44)
    scene.frame_set(1)
    tools.save(path)


main()
