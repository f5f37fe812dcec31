# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the small scene that the exporter is checked on: all four kinds of light, and the traps.

    blender -b --factory-startup -P make_check_scene.py -- OUT.blend
"""

import math
import os
import sys

import bpy

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(REPOSITORY, "examples"))

import scene_tools as tools  # noqa: E402


def add_light(name, kind, position, turn, **settings):
    data = bpy.data.lights.new(name, kind)
    for key, value in settings.items():
        setattr(data, key, value)
    light = bpy.data.objects.new(name, data)
    light.location, light.rotation_euler = position, turn
    bpy.context.scene.collection.objects.link(light)


def add_objects():
    ground = tools.plane("Ground", [(-6, -6, 0), (6, -6, 0), (6, 6, 0), (-6, 6, 0)],
                         tools.material("Grey", (0.4, 0.4, 0.4)))
    ball = tools.revolve("Ball", [(0.8 * math.sin(math.pi * k / 32), 0.8 - 0.8 * math.cos(math.pi * k / 32))
                                  for k in range(33)], tools.material("Mirror", (0.9, 0.9, 0.9), 0.0), 48)
    ball.active_material.node_tree.nodes["Principled BSDF"].inputs["Metallic"].default_value = 1.0
    box = tools.box("Box", (-0.5, -0.5, 0), (0.5, 0.5, 1.2), tools.material("Lamp", (0.8, 0.3, 0.2)))
    box.location = (1.6, 0.4, 0)
    box.pass_index = 7
    glow = box.active_material.node_tree.nodes["Principled BSDF"].inputs
    # Blender 4 calls it otherwise, and starts with a strength of 0.
    (glow.get("Emission") or glow["Emission Color"]).default_value = (1.0, 0.5, 0.2, 1.0)
    glow["Emission Strength"].default_value = 1.0
    hidden = tools.box("Not Rendered", (-3, -3, 3), (3, 3, 3.2), tools.material("Unused", (1, 0, 0)))
    hidden.hide_render = True
    late = tools.box("Late", (-3, 2, 0), (-2.4, 2.6, 0.6), tools.material("Blue", (0.1, 0.2, 0.7)))
    for frame, hide in ((1, True), (3, False)):
        late.hide_render = hide
        late.keyframe_insert("hide_render", frame=frame)
    late.hide_viewport = True
    mark = bpy.data.objects.new("Reference Top", None)
    bpy.context.scene.collection.objects.link(mark)
    mark.parent = ball
    mark.location = (0, 0, 1.6)
    for frame, x in ((1, -1.4), (3, -1.0)):
        ball.location = (x, 0.0, 0.0)
        ball.keyframe_insert("location", frame=frame)
    return ground


def add_lights():
    point = tools.point_light("Point.001 key", (-3.0, -2.0, 4.0), 0.3, 500)
    point.data.use_nodes = False
    add_light("Spot", 'SPOT', (3.0, -2.5, 4.5), (math.radians(38), 0, math.radians(45)),
              energy=800, shadow_soft_size=0.25, spot_size=math.radians(60), spot_blend=0.2)
    add_light("Sun", 'SUN', (0, 0, 5), (math.radians(40), 0, math.radians(-60)),
              energy=2, angle=math.radians(6))
    add_light("Area", 'AREA', (0.0, 3.5, 4.0), (math.radians(-42), 0, 0), energy=300,
              shape='RECTANGLE', size=1.5, size_y=0.3)


def main():
    path = tools.output_path()
    scene = tools.empty_scene(128, 128, 2, "Check")
    tools.set_world((0.5, 0.6, 0.8), 0.5)
    add_objects()
    add_lights()
    camera = tools.camera((0.0, -7.5, 4.2), (0.2, 0.0, 0.5), 45)
    camera.data.dof.use_dof = True
    camera.data.dof.aperture_fstop = 0.2
    scene.render.use_motion_blur = True
    scene.frame_start, scene.frame_end = 1, 3
    scene.frame_set(2)
    tools.save(path)


main()
