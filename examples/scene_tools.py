# SPDX-License-Identifier: GPL-3.0-or-later
"""Small builders shared by the example scenes: meshes, materials, light, camera, saving."""

import math
import os
import sys

import bpy
from mathutils import Vector


def output_path():
    """The .blend named after ``--`` on Blender's command line."""
    rest = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if len(rest) != 1:
        print("Error: give exactly one file to write after --, as in `-- out.blend`",
              file=sys.stderr, flush=True)
        raise SystemExit(2)
    return os.path.abspath(rest[0])


def chosen_scene(scenes):
    """(name, .blend) after ``--`` on Blender's command line; the name is one of `scenes`."""
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if len(words) != 2 or words[0] not in scenes:
        print(f"Error: give a scene ({', '.join(scenes)}) and a file to write after --",
              file=sys.stderr, flush=True)
        raise SystemExit(2)
    return words[0], os.path.abspath(words[1])


def empty_scene(width, height, samples, name):
    """Clear the factory scene and set up Cycles for a quick beauty render."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.name = name
    scene.render.engine = 'CYCLES'
    scene.cycles.device = 'CPU'
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.render.resolution_x = width
    scene.render.resolution_y = height
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = 'Standard'
    return scene


def set_world(colour, strength):
    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*colour, 1.0)
    background.inputs["Strength"].default_value = strength
    bpy.context.scene.world = world


def material(name, colour, roughness=0.65):
    """A matte coloured surface; `colour` is linear RGB."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    made.diffuse_color = (*colour, 1.0)
    return made


def mesh_object(name, vertices, faces, materials, smooth=True, face_materials=None):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.update()
    for item in materials:
        mesh.materials.append(item)
    for number, polygon in enumerate(mesh.polygons):
        polygon.use_smooth = smooth
        if face_materials:
            polygon.material_index = face_materials[number]
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def smooth_curve(points, steps):
    """Catmull-Rom through `points` (tuples of any length), `steps` pieces between each two."""
    padded = [points[0], *points, points[-1]]
    curve = []
    for before, start, end, after in zip(padded, padded[1:], padded[2:], padded[3:]):
        for step in range(steps):
            t = step / steps
            curve.append(tuple(
                0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t
                       + (3 * b - a - 3 * c + d) * t * t * t)
                for a, b, c, d in zip(before, start, end, after)))
    curve.append(tuple(points[-1]))
    return curve


def revolve(name, profile, surface, segments=96):
    """Turn a profile of (radius, height) round the z axis; radius 0 closes to a point."""
    vertices, rings = [], []
    for radius, height in profile:
        if radius < 1e-6:
            rings.append([len(vertices)] * segments)
            vertices.append((0.0, 0.0, height))
            continue
        first = len(vertices)
        rings.append(list(range(first, first + segments)))
        for step in range(segments):
            angle = 2 * math.pi * step / segments
            vertices.append((radius * math.cos(angle), radius * math.sin(angle), height))
    faces = []
    for low, high in zip(rings, rings[1:]):
        for step in range(segments):
            after = (step + 1) % segments
            corners = [low[step], low[after], high[after], high[step]]
            faces.append(list(dict.fromkeys(corners)))
    return mesh_object(name, vertices, faces, [surface])


def tube(name, paths, surface, sides=12):
    """Round rods along `paths`: lists of (x, y, z, radius); the ends are closed."""
    vertices, faces = [], []
    for path in paths:
        centres = [Vector(point[:3]) for point in path]
        first = len(vertices)
        side = Vector((1, 0, 0))
        for number, point in enumerate(path):
            ahead = centres[min(number + 1, len(path) - 1)] - centres[max(number - 1, 0)]
            side = (side - ahead * (side.dot(ahead) / ahead.length_squared)).normalized()
            other = ahead.normalized().cross(side)
            for step in range(sides):
                angle = 2 * math.pi * step / sides
                vertices.append(centres[number]
                                + (side * math.cos(angle) + other * math.sin(angle)) * point[3])
        for ring in range(len(path) - 1):
            low = first + ring * sides
            for step in range(sides):
                after = (step + 1) % sides
                faces.append([low + step, low + after, low + sides + after, low + sides + step])
        faces.append(list(range(first, first + sides))[::-1])
        last = first + (len(path) - 1) * sides
        faces.append(list(range(last, last + sides)))
    return mesh_object(name, [tuple(v) for v in vertices], faces, [surface])


BOX_FACES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]


def box_corners(low, high):
    (x0, y0, z0), (x1, y1, z1) = low, high
    return [(x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0),
            (x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)]


def box(name, low, high, surface):
    return mesh_object(name, box_corners(low, high), BOX_FACES, [surface], smooth=False)


def plane(name, corners, surface):
    return mesh_object(name, corners, [[0, 1, 2, 3]], [surface], smooth=False)


def point_light(name, position, radius, power, colour=(1.0, 1.0, 1.0)):
    data = bpy.data.lights.new(name, 'POINT')
    data.shadow_soft_size = radius
    data.energy = power
    data.color = colour
    made = bpy.data.objects.new(name, data)
    made.location = position
    bpy.context.scene.collection.objects.link(made)
    return made


def camera(position, target, lens):
    made = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    made.data.lens = lens
    made.location = position
    made.rotation_euler = (Vector(target) - Vector(position)).to_track_quat('-Z', 'Y').to_euler()
    bpy.context.scene.collection.objects.link(made)
    bpy.context.scene.camera = made
    return made


def save(path):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    bpy.ops.wm.save_as_mainfile(filepath=path, compress=True)
    print(f"saved {path}", flush=True)
