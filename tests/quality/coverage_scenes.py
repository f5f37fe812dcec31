# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds one of the six scenes of the coverage comparison:

    blender -b --factory-startup --python-exit-code 3 -P coverage_scenes.py -- SCENE WIDTH HEIGHT OUT.blend
"""

import math
import random
import sys

import bpy


def add_mesh(name, vertices, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    item = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(item)
    return item


def ground(size=8):
    return add_mesh("Ground", [(-size, -size, 0), (size, -size, 0), (size, size, 0),
                               (-size, size, 0)], [(0, 1, 2, 3)])


def open_meshes():
    """A bowl without thickness, sheets that stand on the ground, loose triangles in the air."""
    ground()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12, radius=1, location=(-1, 0, 1.4))
    bowl = bpy.context.object
    bowl.rotation_euler = (0.5, 0.3, 0)
    keep = [p.vertices[:] for p in bowl.data.polygons if p.center.z < 0.2]
    places = [v.co[:] for v in bowl.data.vertices]
    bowl.data.clear_geometry()
    bowl.data.from_pydata(places, [], keep)
    for i in range(3):
        x = 1 + 0.7 * i
        add_mesh(f"Sheet{i}", [(x, -1, 0), (x + 0.5, 0.6, 0), (x + 0.4, 0.7, 1.3), (x, -0.9, 1.1)],
                 [(0, 1, 2, 3)])
    chance = random.Random(5)
    corners = []
    for _ in range(40):
        middle = [chance.uniform(-3, 3), chance.uniform(-2, 2.5), chance.uniform(2.2, 3)]
        corners += [[c + chance.uniform(-0.4, 0.4) for c in middle] for _ in range(3)]
    add_mesh("Loose", corners, [(i, i + 1, i + 2) for i in range(0, len(corners), 3)])


def concave():
    """A monkey and a torus on the ground."""
    ground()
    bpy.ops.mesh.primitive_monkey_add(size=2, location=(-1.2, 0, 1.1), rotation=(-0.6, 0, 0.4))
    bpy.ops.mesh.primitive_torus_add(major_radius=0.9, minor_radius=0.3, location=(1.4, 0.2, 1),
                                     rotation=(1.1, 0.2, 0))


def contact():
    """Boxes and a wedge that stand on the ground and on each other."""
    ground()
    bpy.ops.mesh.primitive_cube_add(size=1.4, location=(-1.2, 0, 0.7), rotation=(0, 0, 0.5))
    bpy.ops.mesh.primitive_cube_add(size=0.6, location=(-1.2, 0, 1.7), rotation=(0, 0, 0.2))
    add_mesh("Wedge", [(0.5, -0.8, 0), (2.3, -0.6, 0), (2.0, 0.9, 0), (0.6, 0.8, 0), (1.4, 0, 1.2)],
             [(3, 2, 1, 0), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])


def behind_camera():
    """A lattice over and behind the camera whose shadow falls before it."""
    ground(16)
    for i in range(7):
        bpy.ops.mesh.primitive_cube_add(size=1, location=(-4.5 + 1.5 * i, -9, 8))
        bpy.context.object.scale = (0.3, 9, 0.2)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.8, location=(0.5, 1, 0.8))


def inside_volume():
    """The camera looks out from under a roof that stands between it and the light."""
    ground(16)
    add_mesh("Roof", [(-5, -12, 6.5), (5, -12, 6.5), (4, 1, 7.0), (-4, 0, 6.8)], [(0, 1, 2, 3)])
    bpy.ops.mesh.primitive_cone_add(radius1=0.9, depth=1.8, location=(1.5, 0.5, 0.9))


def many_triangles():
    """204,800 triangles: bumpy spheres over the ground."""
    ground()
    for i in range(4):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=160, ring_count=161, radius=0.8,
                                             location=(-2.1 + 1.4 * i, 0.4 * (i % 2), 1 + 0.3 * i))
        for vertex in bpy.context.object.data.vertices:
            x, y, z = vertex.co
            vertex.co *= 1 + 0.08 * math.sin(9 * x + i) * math.sin(11 * y) * math.sin(10 * z)


SCENES = {"open_meshes": (open_meshes, (3, -1.5, 6)), "concave": (concave, (-2.5, -2, 5)),
          "contact": (contact, (-3, 2.5, 4)), "behind_camera": (behind_camera, (0.5, -11, 16)),
          "inside_volume": (inside_volume, (0.3, -7, 14)), "many_triangles": (many_triangles, (2, -2, 7))}


def main(name, width, height, path):
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item)
    build, light = SCENES[name]
    build()
    scene = bpy.context.scene
    lamp = bpy.data.lights.new("Key", 'POINT')
    lamp.shadow_soft_size, lamp.energy = 0, 1000
    key = bpy.data.objects.new("Key", lamp)
    key.location = light
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0, -7.5, 4.5)
    camera.rotation_euler = (math.radians(62), 0, 0)
    camera.data.lens = 40
    for item in (key, camera):
        scene.collection.objects.link(item)
    scene.camera = camera
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = 1
    scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
    scene.render.resolution_percentage = 100
    bpy.ops.wm.save_as_mainfile(filepath=path)


main(*sys.argv[sys.argv.index("--") + 1:])
