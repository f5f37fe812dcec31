# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the still life that the README comps:

    blender -b --factory-startup --python-exit-code 3 -P examples/still_life.py -- OUT.blend

A vase with twigs, a book, a bowl, fruit and a jar of brushes on a table, lit by one large point
light from the left, so that long shadows with wide penumbrae cross the table. The pear and the
brushes stand before such a penumbra: the place where a careless search draws halos.
"""

import math
import os
import random
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import scene_tools as tools  # noqa: E402  (needs the path above)


def build_stage():
    table = tools.material("Tablecloth", (0.62, 0.47, 0.28), 0.9)
    wall = tools.material("Plaster", (0.24, 0.31, 0.32), 0.95)
    tools.box("Table", (-6, -2.6, -0.2), (6, 3.0, 0), table)
    tools.plane("Wall", [(-9, 3.4, -4), (9, 3.4, -4), (9, 3.4, 8), (-9, 3.4, 8)], wall)


def build_vase():
    glaze = tools.material("Teal Glaze", (0.045, 0.22, 0.25), 0.35)
    outline = [(0.0, 0.0), (0.30, 0.0), (0.36, 0.05), (0.58, 0.42), (0.62, 0.72), (0.46, 1.08),
               (0.22, 1.34), (0.17, 1.52), (0.20, 1.68), (0.29, 1.78)]
    inside = [(0.26, 1.78), (0.17, 1.67), (0.14, 1.52), (0.14, 1.30), (0.0, 1.25)]
    vase = tools.revolve("Vase", tools.smooth_curve(outline, 8) + tools.smooth_curve(inside, 4),
                         glaze)
    vase.location = (-1.25, 0.75, 0)
    return vase


def build_twigs():
    bark = tools.material("Bark", (0.17, 0.085, 0.045), 0.8)
    chance = random.Random(4)
    paths = []
    for lean, turn, height in ((0.62, 0.5, 1.15), (0.34, 2.4, 1.35), (0.50, 5.6, 0.95)):
        top = (lean * height * math.cos(turn), lean * height * math.sin(turn) * 0.5, height)
        stem = [(top[0] * t * t, top[1] * t * t, top[2] * t, 0.026 * (1 - 0.7 * t))
                for t in (step / 10 for step in range(11))]
        paths.append(stem)
        for joint in (4, 6, 8):
            x, y, z, radius = stem[joint]
            angle = turn + chance.uniform(-2.2, 2.2)
            length = chance.uniform(0.25, 0.45)
            paths.append([(x + length * t * math.cos(angle), y + length * t * math.sin(angle) * 0.5,
                           z + length * t * 0.9, radius * 0.75 * (1 - 0.6 * t))
                          for t in (0, 0.25, 0.5, 0.75, 1.0)])
    twigs = tools.tube("Twigs", paths, bark)
    twigs.location = (-1.25, 0.75, 1.35)


def build_book():
    cover = tools.material("Red Cloth", (0.42, 0.055, 0.04), 0.75)
    pages = tools.material("Paper", (0.80, 0.74, 0.60), 0.9)
    parts = [((0, 0, 0), (1.5, 1.05, 0.035), 0), ((0.02, 0.03, 0.035), (1.46, 1.02, 0.225), 1),
             ((0, 0, 0.225), (1.5, 1.05, 0.26), 0), ((-0.035, 0, 0), (0, 1.05, 0.26), 0)]
    vertices, faces, surfaces = [], [], []
    for low, high, surface in parts:
        first = len(vertices)
        vertices += tools.box_corners(low, high)
        faces += [[first + corner for corner in face] for face in tools.BOX_FACES]
        surfaces += [surface] * len(tools.BOX_FACES)
    book = tools.mesh_object("Book", vertices, faces, [cover, pages], False, surfaces)
    book.location = (0.75, 0.35, 0)
    book.rotation_euler = (0, 0, math.radians(-16))


def build_fruit():
    pear_skin = tools.material("Pear Skin", (0.52, 0.50, 0.08), 0.55)
    orange_skin = tools.material("Orange Peel", (0.80, 0.27, 0.03), 0.6)
    plum_skin = tools.material("Plum Skin", (0.13, 0.035, 0.11), 0.45)
    stalk = tools.material("Stalk", (0.12, 0.07, 0.03), 0.8)
    outline = [(0.0, 0.02), (0.14, 0.0), (0.31, 0.12), (0.36, 0.32), (0.29, 0.54), (0.17, 0.72),
               (0.13, 0.86), (0.08, 0.94), (0.0, 0.95)]
    pear = tools.revolve("Pear", tools.smooth_curve(outline, 8), pear_skin)
    pear.location = (-0.02, -0.62, 0)
    pear.rotation_euler = (math.radians(5), math.radians(6), 0)
    stem = tools.tube("Pear Stalk", [[(0, 0, 0.90, 0.022), (0.01, 0, 1.0, 0.018),
                                      (0.05, 0, 1.10, 0.024)]], stalk)
    stem.parent = pear
    for name, place, radius, skin in (("Orange", (1.50, 0.72, 0.26), 0.34, orange_skin),
                                      ("Plum", (-2.05, -0.72, 0), 0.24, plum_skin),
                                      ("Small Plum", (-1.52, -1.02, 0), 0.21, plum_skin)):
        steps = [math.pi * step / 48 for step in range(49)]
        ball = [(radius * math.sin(a), radius * (1 - 0.96 * math.cos(a)) - radius * 0.04)
                for a in steps]
        tools.revolve(name, ball, skin).location = place


def build_bowl():
    china = tools.material("China", (0.72, 0.74, 0.70), 0.4)
    outline = [(0.0, 0.03), (0.20, 0.0), (0.24, 0.05), (0.46, 0.20), (0.60, 0.44), (0.64, 0.47)]
    inside = [(0.61, 0.47), (0.54, 0.40), (0.40, 0.20), (0.18, 0.10), (0.0, 0.09)]
    bowl = tools.revolve("Bowl", tools.smooth_curve(outline, 8) + tools.smooth_curve(inside, 8),
                         china)
    bowl.location = (-2.75, 0.45, 0)


def build_brush_jar():
    clay = tools.material("Clay", (0.48, 0.20, 0.10), 0.8)
    wood = tools.material("Brush Wood", (0.68, 0.42, 0.16), 0.5)
    hair = tools.material("Brush Hair", (0.09, 0.06, 0.05), 0.9)
    outline = [(0.0, 0.0), (0.27, 0.0), (0.29, 0.03), (0.30, 0.30), (0.28, 0.56), (0.30, 0.62)]
    inside = [(0.27, 0.62), (0.25, 0.55), (0.26, 0.10), (0.0, 0.06)]
    jar = tools.revolve("Jar", tools.smooth_curve(outline, 6) + tools.smooth_curve(inside, 6), clay)
    jar.location = (2.45, -0.55, 0)
    handles, tips = [], []
    for lean_x, lean_y, length in ((-0.30, 0.10, 1.28), (0.05, 0.22, 1.45), (0.34, -0.06, 1.20)):
        def at(t, radius):
            return (lean_x * (t - 0.35), lean_y * (t - 0.35), 0.08 + length * t, radius)
        handles.append([at(0, 0.02), at(0.4, 0.028), at(0.8, 0.034), at(0.86, 0.03)])
        tips.append([at(0.86, 0.036), at(0.92, 0.046), at(0.98, 0.026), at(1.02, 0.004)])
    for name, paths, surface in (("Brush Handles", handles, wood), ("Brush Tips", tips, hair)):
        tools.tube(name, paths, surface, 16).location = jar.location


def main():
    path = tools.output_path()
    tools.empty_scene(960, 540, 32, "Still Life")
    tools.set_world((0.42, 0.55, 0.75), 0.22)
    build_stage()
    build_vase()
    build_twigs()
    build_book()
    build_fruit()
    build_bowl()
    build_brush_jar()
    tools.point_light("Key", (-4.7, 0.1, 4.4), 0.34, 1900, (1.0, 0.86, 0.68))
    tools.camera((0.0, -8.2, 3.7), (-0.05, 0.3, 1.0), 43)
    tools.save(path)


main()
