# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds one of the scenes in which edges are measured against the same picture painted large:

    blender -b --factory-startup --python-exit-code 3 -P tests/quality/edge_scenes.py -- NAME OUT.blend

machine has creases, steps and slots in one object, foliage leaves and twigs a pixel wide, and the
rims are smooth things, struts and a grid before nothing but a sky of one colour, a sky that turns
from one colour to another, and a film without sky.
"""

import math
import os
import random
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "examples"))

import bpy  # noqa: E402  (after the path, with the modules that need it)

import scene_tools as tools  # noqa: E402


def floor():
    tools.plane("Floor", [(-8, -8, 0), (8, -8, 0), (8, 8, 0), (-8, 8, 0)],
                tools.material("Floor", (0.5, 0.45, 0.4)))


def light():
    tools.point_light("Key", (-3.6, -3.0, 5.0), 0.3, 900)


def joined(name, things):
    """One object of several: its edges are then its own."""
    bpy.ops.object.select_all(action='DESELECT')
    for thing in things:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = things[0]
    bpy.ops.object.join()
    bpy.context.object.name = name
    return bpy.context.object


def machine():
    """A hard surface: every edge is inside one object."""
    floor()
    steel = tools.material("Steel", (0.35, 0.4, 0.45))
    parts = [tools.box(f"Step {n}", (-1.5, -0.9 + 0.3 * n, 0.25 * n), (1.5, 1.2, 0.25 * n + 0.25), steel)
             for n in range(4)]
    parts += [tools.box(f"Slat {n}", (-1.3 + 0.27 * n, 0.5, 1.0), (-1.2 + 0.27 * n, 1.0, 1.7), steel)
              for n in range(10)]
    bpy.ops.mesh.primitive_cylinder_add(vertices=12, radius=0.4, depth=0.9, location=(0.9, -0.3, 1.1),
                                        rotation=(0.5, 0.3, 0.2))
    bpy.context.object.data.materials.append(steel)
    parts.append(bpy.context.object)
    made = joined("Machine", parts)
    made.rotation_euler = (0, 0, 0.35)
    light()
    tools.camera((2.6, -6.4, 4.0), (0.0, 0.1, 0.75), 62)


def foliage():
    floor()
    dice = random.Random(4)
    leaves, faces = [], []
    for _ in range(260):
        x, y, z = dice.uniform(-1.4, 1.4), dice.uniform(-0.7, 0.7), dice.uniform(0.5, 2.1)
        turn, tilt, size = dice.uniform(0, 6.3), dice.uniform(-0.7, 0.7), dice.uniform(0.10, 0.22)
        along = (math.cos(turn) * math.cos(tilt), math.sin(turn) * math.cos(tilt), math.sin(tilt))
        across = (-math.sin(turn) * 0.35, math.cos(turn) * 0.35, 0.0)
        first = len(leaves)
        for a, b in ((0, 0), (0.5, 1), (1, 0), (0.5, -1)):
            leaves.append(tuple(p + size * (a * u + b * 0.5 * v)
                                for p, u, v in zip((x, y, z), along, across)))
        faces.append((first, first + 1, first + 2, first + 3))
    tools.mesh_object("Leaves", leaves, faces, [tools.material("Leaf", (0.15, 0.4, 0.1))], smooth=False)
    twigs = []
    for n in range(14):
        x = -1.3 + 0.2 * n
        twigs.append([(x, 0.0, 0.0, 0.02), (x + dice.uniform(-0.3, 0.3), dice.uniform(-0.4, 0.4), 2.1, 0.008)])
    tools.tube("Twigs", twigs, tools.material("Twig", (0.3, 0.2, 0.1)), sides=8)
    light()
    tools.camera((1.2, -6.0, 2.6), (0.0, 0.0, 1.0), 58)


def rim(world):
    """Orange things before a blue sky: a rim of the rendered things shows at once in other paint."""
    orange = tools.material("Orange", (0.9, 0.35, 0.05))
    bpy.ops.mesh.primitive_monkey_add(size=1.5, location=(-0.9, 0, 0.1), rotation=(0, 0, -0.5))
    head = bpy.context.object
    head.name = "Head"
    head.modifiers.new("Smooth", 'SUBSURF').render_levels = 2
    for polygon in head.data.polygons:
        polygon.use_smooth = True
    head.data.materials.append(orange)
    bpy.ops.mesh.primitive_torus_add(location=(1.2, 0.2, 0.3), rotation=(1.2, 0.4, 0), major_radius=0.7,
                                     minor_radius=0.16)
    bpy.context.object.name = "Ring"
    bpy.context.object.data.materials.append(orange)
    struts = [[(-2.2 + 0.28 * n, 0.5, -1.2, 0.02), (-1.9 + 0.3 * n, 0.5, 1.3, 0.05)] for n in range(14)]
    tools.tube("Struts", struts, orange, sides=12)
    light()
    tools.camera((0, -7.5, 0.3), (0, 0, 0.05), 60)
    world()


def one_sky():
    tools.set_world((0.25, 0.5, 0.9), 1.0)


def turning_sky():
    tools.set_world((0.25, 0.5, 0.9), 1.0)
    tree = bpy.context.scene.world.node_tree
    place = tree.nodes.new("ShaderNodeTexCoord")
    cut = tree.nodes.new("ShaderNodeSeparateXYZ")
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[1].position = 0.35, 0.65
    ramp.color_ramp.elements[0].color = (0.9, 0.7, 0.3, 1)
    ramp.color_ramp.elements[1].color = (0.05, 0.2, 0.7, 1)
    tree.links.new(place.outputs["Window"], cut.inputs[0])
    tree.links.new(cut.outputs["Y"], ramp.inputs[0])
    tree.links.new(ramp.outputs[0], tree.nodes["Background"].inputs["Color"])


def no_sky():
    bpy.context.scene.render.film_transparent = True


SCENES = {"machine": machine, "foliage": foliage, "rim_constant": lambda: rim(one_sky),
          "rim_gradient": lambda: rim(turning_sky), "rim_transparent": lambda: rim(no_sky)}


def main():
    name, path = tools.chosen_scene(SCENES)
    tools.empty_scene(480, 270, 32, "Edges")
    SCENES[name]()
    tools.save(path)


main()
