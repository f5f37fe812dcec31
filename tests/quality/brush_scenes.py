# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds one of the shots in which the strokes' hold is measured:

    blender -b --factory-startup --python-exit-code 3 -P tests/quality/brush_scenes.py -- NAME OUT.blend

Each moves one thing only: the light (orbit), an object (turning), the camera's lens (zoom).
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "examples"))

import bpy  # noqa: E402  (after the path, with the module that needs it)

import scene_tools as tools  # noqa: E402

FRAMES = 24
WIDTH, HEIGHT = 480, 270


def smooth(made):
    for polygon in made.data.polygons:
        polygon.use_smooth = True
    return made


def named(name, colour):
    made = bpy.context.object
    made.name = made.data.name = name
    made.data.materials.append(tools.material(name + " Paint", colour))
    return made


def head(place):
    bpy.ops.mesh.primitive_monkey_add(size=1.7, location=place,
                                      rotation=(math.radians(-12), 0, math.radians(-20)))
    made = smooth(named("Head", (0.55, 0.20, 0.10)))
    subdivision = made.modifiers.new("Subdivision", 'SUBSURF')
    subdivision.levels = subdivision.render_levels = 2
    return made


def stage():
    """A ball, a head, a torus and a column on a floor before a wall, one large light, a camera."""
    scene = tools.empty_scene(WIDTH, HEIGHT, 4, "Brush")
    scene.frame_start, scene.frame_end = 1, FRAMES
    tools.set_world((0.50, 0.60, 0.75), 0.30)
    tools.plane("Floor", [(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)],
                tools.material("Floor Paint", (0.55, 0.50, 0.40), 0.9))
    tools.plane("Wall", [(-9, 3, 0), (9, 3, 0), (9, 3, 8), (-9, 3, 8)],
                tools.material("Wall Paint", (0.45, 0.48, 0.5), 0.9))
    bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, radius=0.75,
                                         location=(-1.75, -0.5, 0.75))
    smooth(named("Ball", (0.70, 0.66, 0.56)))
    bpy.ops.mesh.primitive_torus_add(major_radius=0.7, minor_radius=0.22, major_segments=96,
                                     minor_segments=32, location=(1.9, -0.6, 0.92),
                                     rotation=(math.radians(80), 0, math.radians(25)))
    smooth(named("Ring", (0.10, 0.36, 0.29)))
    outline = [(0.0, 0.0), (0.46, 0.0), (0.46, 0.10), (0.36, 0.18), (0.30, 0.30), (0.28, 1.0),
               (0.26, 1.9), (0.30, 2.05), (0.42, 2.15), (0.42, 2.28), (0.0, 2.28)]
    column = tools.revolve("Column", tools.smooth_curve(outline, 6),
                           tools.material("Chalk", (0.70, 0.66, 0.56)))
    column.location = (-0.9, 1.2, 0)
    face = head((0.2, -0.7, 0.86))
    lamp = tools.point_light("Key", (-3.4, -3.6, 4.6), 0.3, 1500, (1.0, 0.90, 0.75))
    tools.camera((0.0, -8.0, 3.2), (0.0, 0.0, 0.85), 44)
    return lamp, face, scene.camera


def key_every_frame(owner, name, value):
    """Keys a property to value(share) on every frame; share runs from 0 to 1."""
    for frame in range(1, FRAMES + 1):
        setattr(owner, name, value((frame - 1) / (FRAMES - 1)))
        owner.keyframe_insert(name, frame=frame)


def orbit():
    """The light goes round a quarter of a circle; nothing else moves."""
    lamp, _, _ = stage()
    key_every_frame(lamp, "location", lambda share: (
        5.0 * math.cos(math.radians(225 + 90 * share)),
        5.0 * math.sin(math.radians(225 + 90 * share)), 4.6))


def turning():
    """The head turns by 60 degrees as it moves and rises; light and camera stand still."""
    _, face, _ = stage()
    key_every_frame(face, "location", lambda share: (
        -0.3 + 1.0 * share, -0.7 - 0.4 * share, 0.9 + 0.25 * math.sin(math.pi * share)))
    key_every_frame(face, "rotation_euler", lambda share: (
        math.radians(-12), 0.0, math.radians(-30 + 60 * share)))


def zoom():
    """The lens goes from 40 to 100 mm: the picture grows 2.5 times."""
    _, _, eye = stage()
    key_every_frame(eye.data, "lens", lambda share: 40.0 * 2.5 ** share)


SCENES = {build.__name__: build for build in (orbit, turning, zoom)}


def main():
    name, path = tools.chosen_scene(SCENES)
    SCENES[name]()
    bpy.context.scene.frame_set(1)
    tools.save(path)


main()
