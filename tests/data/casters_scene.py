# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the scene of the frame in casters/:

    blender -b --factory-startup --python-exit-code 3 -P tests/data/casters_scene.py -- OUT.blend
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples"))

import bpy  # noqa: E402  (after the path, with the modules that need it)

import scene_tools as tools  # noqa: E402


def matte(name):
    return tools.material(name, (0.7, 0.7, 0.7))


def main():
    path = tools.output_path()
    tools.empty_scene(96, 54, 1, "Casters")
    tools.plane("Floor", [(-6, -6, 0), (6, -6, 0), (6, 6, 0), (-6, 6, 0)], matte("Floor"))
    tools.box("Box", (0.5, -0.2, 0.0), (1.5, 0.8, 1.1), matte("Box"))
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2, radius=0.6, location=(-0.9, 0.1, 0.8))
    ball = bpy.context.object
    ball.name = ball.data.name = "Ball"
    ball.data.materials.append(matte("Ball"))
    tools.point_light("Key", (-2.8, -2.0, 4.2), 0.3, 600)
    tools.camera((0.4, -6.4, 4.2), (0.4, 0.1, 0.3), 45)
    tools.save(path)


main()
