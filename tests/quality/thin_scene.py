# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a row of what is hard to paint, from the left: fur, cut and soft leaves, cards of half and of a
third opacity, fog, fire, a box of both surface and fog, glass; before them a wire and a word.

    blender -b --factory-startup --python-exit-code 3 -P tests/quality/thin_scene.py -- OUT.blend
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "examples"))

import bpy  # noqa: E402  (after the path, with the module that needs it)

import scene_tools as tools  # noqa: E402


def ball(name, x, radius, surface):
    outline = [(radius * math.sin(math.pi * step / 16) if 0 < step < 16 else 0.0,
                radius - radius * math.cos(math.pi * step / 16)) for step in range(17)]
    made = tools.revolve(name, outline, surface, 32)
    made.location = (x, 0, 0)
    return made


def build_fur():
    fur = ball("Fur", -4.2, 0.5, tools.material("Pelt", (0.5, 0.25, 0.1)))
    settings = fur.modifiers.new("Fur", 'PARTICLE_SYSTEM').particle_system.settings
    settings.type, settings.count, settings.hair_length = 'HAIR', 400, 0.16
    settings.child_type, settings.rendered_child_count = 'INTERPOLATED', 20
    settings.root_radius, settings.tip_radius, settings.clump_factor = 0.6, 0.0, 0.5


def leaf_material(name, colour, soft):
    """A leaf's outline as alpha over the card's own x and z, sharp or fading over `soft` units."""
    made = tools.material(name, colour)
    tree = made.node_tree
    split = tree.nodes.new('ShaderNodeSeparateXYZ')
    tree.links.new(tree.nodes.new('ShaderNodeTexCoord').outputs["Object"], split.inputs[0])

    def number(operation, *values):
        node = tree.nodes.new('ShaderNodeMath')
        node.operation = operation
        for place, value in zip(node.inputs, values):
            if isinstance(value, float):
                place.default_value = value
            else:
                tree.links.new(value, place)
        return node.outputs[0]
    away = number('POWER', number('ABSOLUTE', number('DIVIDE', split.outputs["Z"], 0.45)), 2.0)
    inside = number('SUBTRACT', number('MULTIPLY', 0.24, number('SUBTRACT', 1.0, away)),
                    number('ABSOLUTE', split.outputs["X"]))
    alpha = number('DIVIDE', inside, soft) if soft else number('GREATER_THAN', inside, 0.0)
    clamp = tree.nodes.new('ShaderNodeClamp')
    tree.links.new(alpha, clamp.inputs[0])
    tree.links.new(clamp.outputs[0], tree.nodes["Principled BSDF"].inputs["Alpha"])
    return made


def veil(name, alpha):
    made = tools.material(name, (0.5, 0.1, 0.1))
    made.node_tree.nodes["Principled BSDF"].inputs["Alpha"].default_value = alpha
    return made


def card(name, place, surface, turn=(0, 0, 0)):
    made = tools.plane(name, [(-.3, 0, -.45), (.3, 0, -.45), (.3, 0, .45), (-.3, 0, .45)], surface)
    made.location, made.rotation_euler = place, turn


def build_cards():
    leaf = leaf_material("Leaf", (0.2, 0.45, 0.08), 0.0)
    card("Leaf", (-2.9, 0, 0.5), leaf, (0.2, 0.3, 0.4))
    card("Leaf Back", (-2.5, 0.4, 0.9), leaf, (-0.2, -0.5, -0.3))
    card("Soft Leaf", (-1.8, 0, 0.55), leaf_material("Soft Leaf", (0.45, 0.2, 0.05), 0.12))
    card("Half", (-1.1, 0, 0.55), veil("Half", 0.5))
    card("Third", (-0.4, 0, 0.55), veil("Third", 0.3))


def fog_material(name, density, glow, surface):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    if not surface:
        tree.nodes.remove(tree.nodes["Principled BSDF"])
    volume = tree.nodes.new('ShaderNodeVolumePrincipled')
    volume.inputs["Density"].default_value = density
    volume.inputs["Emission Strength"].default_value = glow
    tree.links.new(volume.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    return made


def build_volumes():
    for name, place, width, density, glow, surface in (
            ("Fog", 0.1, 0.8, 3.0, 0.0, False), ("Fire", 1.2, 0.6, 0.5, 2.0, False),
            ("Milk", 2.1, 0.6, 1.0, 0.0, True)):
        tools.box(name, (place, -0.3, 0), (place + width, 0.3, 0.9),
                  fog_material(name, density, glow, surface))
    glass = bpy.data.materials.new("Glass")
    glass.use_nodes = True
    tree = glass.node_tree
    tree.links.new(tree.nodes.new('ShaderNodeBsdfGlass').outputs[0],
                   tree.nodes["Material Output"].inputs["Surface"])
    ball("Glass", 3.5, 0.4, glass)


def build_curves():
    word = bpy.data.curves.new("Word", 'FONT')
    word.body, word.extrude, word.size = "Ag", 0.06, 0.7
    wire = bpy.data.curves.new("Wire", 'CURVE')
    wire.dimensions, wire.bevel_depth = '3D', 0.05
    spline = wire.splines.new('BEZIER')
    spline.bezier_points.add(2)
    for point, place in zip(spline.bezier_points, ((-3.4, -1.3, 0.1), (-2.6, -1.3, 0.4),
                                                   (-1.8, -1.3, 0.1))):
        point.co = place
        point.handle_left_type = point.handle_right_type = 'AUTO'
    for curve, place, turn, colour in ((word, (2.4, -1.3, 0), math.pi / 2, (0.4, 0.1, 0.3)),
                                       (wire, (0, 0, 0), 0.0, (0.1, 0.3, 0.3))):
        curve.materials.append(tools.material(curve.name, colour))
        made = bpy.data.objects.new(curve.name, curve)
        made.location, made.rotation_euler = place, (turn, 0, 0)
        bpy.context.scene.collection.objects.link(made)


def main():
    path = tools.output_path()
    scene = tools.empty_scene(720, 240, 8, "Thin")
    scene.cycles.max_bounces = 4
    tools.set_world((0.55, 0.65, 0.80), 0.3)
    tools.plane("Ground", [(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)],
                tools.material("Earth", (0.4, 0.36, 0.28)))
    tools.plane("Wall", [(-9, 3, 0), (9, 3, 0), (9, 3, 9), (-9, 3, 9)],
                tools.material("Wall", (0.3, 0.36, 0.4)))
    build_fur()
    build_cards()
    build_volumes()
    build_curves()
    sun = bpy.data.lights.new("Sun", 'SUN')
    sun.energy, sun.angle = 3.0, 0.06
    lamp = bpy.data.objects.new("Sun", sun)
    lamp.rotation_euler = (0.8, 0.35, 0.2)
    scene.collection.objects.link(lamp)
    tools.camera((-0.3, -9.6, 1.9), (-0.3, 0, 0.45), 36)
    tools.save(path)


main()
