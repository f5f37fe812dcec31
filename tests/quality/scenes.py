# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds one of the scenes in which shadow methods are measured against traced truth:

    blender -b --factory-startup --python-exit-code 3 -P tests/quality/scenes.py -- NAME OUT.blend

Each stresses one thing. All but `heads` are small, so that a truth of 512 samples a pixel stays quick.
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "examples"))

import bpy  # noqa: E402  (after the path, with the modules that need it)
from mathutils import Vector  # noqa: E402

import scene_tools as tools  # noqa: E402

SIDE = 256
MOVING_SIDE = 144
MOVING_FRAMES = 12


def matte(name):
    return tools.material(name, (0.7, 0.7, 0.7))


def stage(side=SIDE, light=(-2.6, -2.2, 5.0), radius=0.3, eye=(1.2, -6.0, 4.6),
          target=(0.45, 0.1, 0.3), lens=72):
    """A floor and a back wall, one point light of a given radius, and the camera."""
    scene = tools.empty_scene(side, side, 1, "Quality")
    tools.plane("Floor", [(-8, -8, 0), (8, -8, 0), (8, 8, 0), (-8, 8, 0)], matte("Floor"))
    tools.plane("Wall", [(-8, 3, 0), (8, 3, 0), (8, 3, 8), (-8, 3, 8)], matte("Wall"))
    lamp = tools.point_light("Key", light, radius, 600)
    tools.camera(eye, target, lens)
    return scene, lamp


def ball(name, place, radius, surface):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=radius, location=place)
    made = bpy.context.object
    made.name = made.data.name = name
    for polygon in made.data.polygons:
        polygon.use_smooth = True
    made.data.materials.append(surface)
    return made


def rod(start, end, radius):
    """A path for tools.tube."""
    return [(*start, radius), (*end, radius)]


def ball_and_box():
    """The plain case: wide and narrow penumbrae, contact, a shadow that climbs another object."""
    stage()
    ball("Ball", (-0.5, -0.3, 0.6), 0.6, matte("Ball"))
    tools.box("Box", (0.7, 0.3, 0.0), (1.6, 1.2, 0.9), matte("Box"))


def fence():
    """Rods about as thick as the shift between the shadows of neighbouring masks."""
    stage(target=(0.45, 0.15, 0.4), lens=68)
    along = [(0.3 * n - 1.2, 0.05 * n - 0.5) for n in range(9)]
    bars = [rod((x, y, 0.0), (x, y, 1.3), 0.05) for x, y in along]
    bars += [rod((*along[0], z), (*along[-1], z), 0.05) for z in (0.35, 1.1)]
    tools.tube("Fence", bars, matte("Fence"), sides=16)


def wires():
    """Wires much thinner than the shift between the shadows of neighbouring masks."""
    stage(target=(0.45, 0.15, 0.4), lens=68)
    ends = [(-1.2, -0.5), (1.2, -0.1)]
    posts = [rod((x, y, 0.0), (x, y, 1.3), 0.06) for x, y in ends]
    lines = [rod((*ends[0], z), (*ends[1], z), 0.015) for z in (0.3, 0.6, 0.9, 1.2)]
    tools.tube("Wires", posts + lines, matte("Wires"), sides=16)


def column():
    """A tall column: the penumbra widens from contact to the wall, and lies on its own flank."""
    stage(light=(-3.0, -2.6, 4.2), eye=(2.2, -6.4, 4.0), target=(0.8, 0.6, 1.05), lens=52)
    outline = [(0.0, 0.0), (0.5, 0.0), (0.5, 0.15), (0.38, 0.22), (0.34, 0.4), (0.30, 2.3),
               (0.36, 2.45), (0.5, 2.5), (0.5, 2.65), (0.0, 2.65)]
    made = tools.revolve("Column", tools.smooth_curve(outline, 6), matte("Column"), 128)
    made.location = (-0.4, 0.0, 0.0)


def ring():
    """A ring over a step: a hole in the shadow, which falls on two heights."""
    stage()
    tools.box("Step", (0.2, -2.0, 0.0), (3.0, 3.0, 0.5), matte("Step"))
    bpy.ops.mesh.primitive_torus_add(major_radius=0.6, minor_radius=0.12, major_segments=96,
                                     minor_segments=32, location=(-0.2, -0.2, 1.2),
                                     rotation=(math.radians(25), math.radians(-15), 0))
    bpy.context.object.name = "Ring"
    bpy.context.object.data.materials.append(matte("Ring"))
    for polygon in bpy.context.object.data.polygons:
        polygon.use_smooth = True


def head():
    """A subdivided head that shadows itself."""
    stage(eye=(0.6, -4.6, 2.9), target=(0.25, 0.1, 0.75), lens=62)
    bpy.ops.mesh.primitive_monkey_add(size=1.8, location=(0.0, 0.0, 0.95),
                                      rotation=(math.radians(-15), 0, math.radians(15)))
    made = bpy.context.object
    made.name = made.data.name = "Head"
    subdivision = made.modifiers.new("Subdivision", 'SUBSURF')
    subdivision.levels = subdivision.render_levels = 3
    for polygon in made.data.polygons:
        polygon.use_smooth = True
    made.data.materials.append(matte("Head"))


def crossing():
    """Two blockers at different heights whose shadows cross."""
    stage()
    tools.box("Beam", (-1.6, -0.5, 0.75), (1.4, -0.3, 0.95), matte("Beam"))
    tools.box("Plank", (-0.5, -1.8, 1.45), (-0.25, 1.6, 1.6), matte("Plank"))
    tools.tube("Posts", [rod((-1.5, -0.4, 0), (-1.5, -0.4, 0.8), 0.08),
                         rod((1.3, -0.4, 0), (1.3, -0.4, 0.8), 0.08)], matte("Posts"))


def foreground():
    """Objects before the penumbra: they must not cut the shadow behind them."""
    stage()
    tools.box("Slab", (-1.1, -0.4, 0.9), (0.5, 0.8, 1.1), matte("Slab"))
    tools.tube("Poles", [rod((x, -2.6, 0.0), (x + 0.25, -2.4, 2.6), 0.05) for x in
                         (0.35, 0.62, 0.95, 1.3)], matte("Poles"), sides=16)


def large_light():
    """A light far larger than the blocker, whose umbra ends above the floor."""
    stage(radius=0.8, target=(0.3, 0.0, 0.2), lens=85)
    ball("Pea", (-0.3, -0.3, 0.75), 0.13, matte("Pea"))
    ball("Marble", (0.7, 0.2, 0.13), 0.13, matte("Marble"))
    tools.box("Peg", (0.3, -1.1, 0.0), (0.42, -0.98, 0.5), matte("Peg"))


def lamp_shape(shape, length, width):
    """The ball and the box under an area lamp whose longer side lies level, across the light."""
    scene, lamp = stage(side=192)
    lamp.data = bpy.data.lights.new("Key", 'AREA')
    lamp.data.shape, lamp.data.size, lamp.data.size_y, lamp.data.energy = shape, length, width, 600
    ahead = Vector((0.2, 0.2, 0.0)) - lamp.location
    lamp.rotation_euler = ahead.to_track_quat('-Z', 'X').to_euler()  # its x level
    ball("Ball", (-0.5, -0.3, 0.6), 0.6, matte("Ball"))
    tools.box("Box", (0.7, 0.3, 0.0), (1.6, 1.2, 0.9), matte("Box"))


def disk_lamp():
    lamp_shape('DISK', 0.8, 0.8)


def ellipse_lamp():
    lamp_shape('ELLIPSE', 2.5, 0.4)


def square_lamp():
    lamp_shape('SQUARE', 0.8, 0.8)


def rectangle_lamp():
    lamp_shape('RECTANGLE', 1.5, 0.3)


def tube_lamp():
    """So long and narrow that it is nearly a line."""
    lamp_shape('RECTANGLE', 2.5, 0.05)


def heads():
    """A million triangles: what a mask costs where the geometry does (for cost.sh)."""
    scene, _ = stage(lens=40, eye=(1.2, -6.0, 4.6))
    scene.render.resolution_x, scene.render.resolution_y = 480, 270
    surface = matte("Head")
    for number in range(4):
        bpy.ops.mesh.primitive_monkey_add(
            size=1.2, location=(1.3 * number - 1.8, 0.3 * (number % 2), 0.7),
            rotation=(math.radians(-15), 0, math.radians(15 - 10 * number)))
        made = bpy.context.object
        made.name = made.data.name = f"Head {number}"
        subdivision = made.modifiers.new("Subdivision", 'SUBSURF')
        subdivision.levels, subdivision.render_levels = 1, 4
        for polygon in made.data.polygons:
            polygon.use_smooth = True
        made.data.materials.append(surface)


def moving():
    """A light that travels past a ball and a box, for the change of the error between frames."""
    scene, lamp = stage(side=MOVING_SIDE)
    ball("Ball", (-0.5, -0.3, 0.6), 0.6, matte("Ball"))
    tools.box("Box", (0.7, 0.3, 0.0), (1.6, 1.2, 0.9), matte("Box"))
    scene.frame_start, scene.frame_end = 1, MOVING_FRAMES
    for frame in range(1, MOVING_FRAMES + 1):
        lamp.location.x = -2.6 + 0.04 * (frame - 1)
        lamp.keyframe_insert("location", frame=frame)
    scene.frame_set(1)


SCENES = {build.__name__: build for build in (
    ball_and_box, column, head, fence, ring, crossing, foreground, large_light, wires, moving, heads,
    disk_lamp, ellipse_lamp, square_lamp, rectangle_lamp, tube_lamp)}


def main():
    name, path = tools.chosen_scene(SCENES)
    SCENES[name]()
    tools.save(path)


main()
