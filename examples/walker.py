# SPDX-License-Identifier: GPL-3.0-or-later
"""The character of examples/walk.py: a child in a cloak. One skinned mesh of several shells (skin,
tunic, trousers, boots, scarf, face), an armature that walks, a shape key that breathes, hair in
locks, and a cloak that the armature carries and a wave moves."""

import math

import bpy
from mathutils import Matrix, Vector

import scene_tools as tools

STRIDE = 0.86     # of one cycle of two steps, along y
BONES = {         # name: (parent, from, to); left is +x
    "Hips": (None, (0, 0, 0.52), (0, 0, 0.70)),
    "Chest": ("Hips", (0, 0, 0.70), (0, 0, 0.96)),
    "Head": ("Chest", (0, 0, 1.00), (0, 0, 1.45)),
    "Thigh.L": ("Hips", (0.09, 0, 0.52), (0.09, 0.01, 0.28)),
    "Shin.L": ("Thigh.L", (0.09, 0.01, 0.28), (0.09, 0, 0.06)),
    "Thigh.R": ("Hips", (-0.09, 0, 0.52), (-0.09, 0.01, 0.28)),
    "Shin.R": ("Thigh.R", (-0.09, 0.01, 0.28), (-0.09, 0, 0.06)),
    "Arm.L": ("Chest", (0.15, 0, 0.92), (0.24, 0, 0.72)),
    "Hand.L": ("Arm.L", (0.24, 0, 0.72), (0.28, 0.05, 0.50)),
    "Arm.R": ("Chest", (-0.15, 0, 0.92), (-0.24, 0, 0.72)),
    "Hand.R": ("Arm.R", (-0.24, 0, 0.72), (-0.28, 0.05, 0.50))}
SURFACES = {      # material: its colour, should the beauty be wanted
    "Skin": (0.72, 0.42, 0.28), "Tunic": (0.16, 0.30, 0.30), "Trousers": (0.12, 0.12, 0.20),
    "Boots": (0.16, 0.08, 0.04), "Scarf": (0.75, 0.50, 0.12), "Hair": (0.20, 0.08, 0.04),
    "Eye": (0.02, 0.02, 0.03), "Glint": (0.9, 0.9, 0.9)}

HEAD = ("Head",)
SIDES = 28        # of every shell


def ball(centre, radius, along=(0, 0, 1), length=1.0):
    """Rod of a closed ball, `length` times as long as thick."""
    centre, along = Vector(centre), Vector(along).normalized()
    steps = [math.pi * step / 10 for step in range(11)]
    return [(*(centre - along * radius * length * math.cos(angle)),
             max(0.0005, radius * math.sin(angle))) for angle in steps]


def limb(side):
    """Shells of one leg, one arm and half a face: (material, rod, bones that hold it)."""
    x, letter = side * 0.09, "L" if side > 0 else "R"
    leg, arm = (f"Thigh.{letter}", f"Shin.{letter}"), ("Chest", f"Arm.{letter}", f"Hand.{letter}")
    return [
        ("Trousers", [(x, 0, 0.56, 0.085), (x, 0.005, 0.42, 0.085), (x, 0.01, 0.28, 0.075),
                      (x, 0, 0.17, 0.075), (x, 0, 0.13, 0.06)], leg),
        ("Boots", [(x, 0, 0.23, 0.06), (x, 0, 0.225, 0.088), (x, 0, 0.20, 0.084), (x, 0, 0.12, 0.068),
                   (x, 0.0, 0.06, 0.066), (x, 0, 0.01, 0.05)], leg),
        ("Boots", ball((x, 0.055, 0.048), 0.056, (0, 1, 0), 1.9), leg[1:]),
        ("Tunic", [(side * 0.08, 0, 0.93, 0.05), (side * 0.15, 0, 0.925, 0.068),
                   (side * 0.205, 0, 0.82, 0.066), (side * 0.24, 0, 0.72, 0.068),
                   (side * 0.262, 0.025, 0.63, 0.078), (side * 0.268, 0.03, 0.60, 0.082),
                   (side * 0.268, 0.03, 0.602, 0.05)], arm),
        ("Skin", [(side * 0.255, 0.02, 0.64, 0.04)] + ball((side * 0.28, 0.045, 0.55), 0.052,
                                                          (side * 0.15, 0.2, -1), 1.25)[3:],
         arm[2:]),
        ("Skin", ball((side * 0.222, -0.015, 1.19), 0.045, (0, 0.2, 1), 1.3), HEAD),
        ("Eye", ball((side * 0.088, 0.196, 1.175), 0.027, (0, 0, 1), 1.5), HEAD),
        ("Glint", ball((side * 0.088 + 0.008, 0.220, 1.192), 0.008), HEAD),
        ("Hair", [(side * 0.125, 0.186, 1.246, 0.004), (side * 0.09, 0.213, 1.256, 0.009),
                  (side * 0.055, 0.222, 1.250, 0.005)], HEAD)]


def shells():
    head = [(0, 0.02, 1.015, 0.02), (0, 0.03, 1.03, 0.09), (0, 0.02, 1.075, 0.16),
            (0, 0.005, 1.14, 0.207), (0, 0, 1.22, 0.225), (0, 0, 1.30, 0.218), (0, 0, 1.38, 0.18),
            (0, 0, 1.43, 0.12), (0, 0, 1.455, 0.02)]
    cap = [(0, -0.10, 1.03, 0.02), (0, -0.085, 1.06, 0.14), (0, -0.06, 1.14, 0.205),
           (0, -0.046, 1.22, 0.238), (0, -0.036, 1.30, 0.240), (0, 0.008, 1.375, 0.206),
           (0, 0.006, 1.44, 0.136), (0, 0, 1.478, 0.02)]
    tunic = [(0, 0, 0.47, 0.12), (0, 0, 0.42, 0.215), (0, 0, 0.43, 0.222), (0, 0, 0.52, 0.198),
             (0, 0, 0.64, 0.172), (0, 0, 0.78, 0.172), (0, 0, 0.90, 0.150), (0, 0, 0.98, 0.08)]
    belt = [(0, 0, 0.605, 0.15), (0, 0, 0.61, 0.186), (0, 0, 0.645, 0.184), (0, 0, 0.65, 0.15)]
    turn = [2 * math.pi * step / 24 for step in range(25)]
    scarf = [(0.115 * math.cos(a), 0.105 * math.sin(a) + 0.01, 0.985 + 0.02 * math.sin(a), 0.058)
             for a in turn]
    tail = [(0.06, 0.11, 0.97, 0.035), (0.075, 0.175, 0.90, 0.05), (0.08, 0.19, 0.80, 0.055),
            (0.085, 0.185, 0.71, 0.06), (0.085, 0.185, 0.70, 0.02)]
    mouth = [(-0.028, 0.217, 1.098, 0.003), (0, 0.219, 1.091, 0.006), (0.028, 0.217, 1.098, 0.003)]
    trunk = ("Hips", "Chest")
    return [("Skin", head, HEAD), ("Hair", cap, HEAD), ("Boots", belt, trunk[:1]),
            ("Tunic", tunic, trunk + ("Thigh.L", "Thigh.R")), ("Scarf", scarf, ("Chest", "Head")),
            ("Scarf", tail, trunk[1:]), ("Eye", mouth, HEAD),
            ("Skin", ball((0, 0.226, 1.145), 0.016), HEAD)] + limb(1) + limb(-1)


def build_body():
    """The mesh, and the bones that hold each of its points."""
    surfaces = [tools.material(name, colour) for name, colour in SURFACES.items()]
    names = list(SURFACES)
    parts = [(names.index(name), tools.smooth_curve(rod, 4), held) for name, rod, held in shells()]
    body = tools.tube("Walker", [rod for _, rod, _ in parts], surfaces[0], SIDES)
    for surface in surfaces[1:]:
        body.data.materials.append(surface)
    polygons, holders = iter(body.data.polygons), []
    for material, rod, held in parts:
        for _ in range(SIDES * (len(rod) - 1) + 2):
            next(polygons).material_index = material
        holders += [held] * (SIDES * len(rod))
    return body, holders


def build_bones():
    data = bpy.data.armatures.new("Bones")
    bones = bpy.data.objects.new("Bones", data)
    bpy.context.scene.collection.objects.link(bones)
    bpy.context.view_layer.objects.active = bones
    bpy.ops.object.mode_set(mode='EDIT')
    for name, (parent, start, end) in BONES.items():
        bone = data.edit_bones.new(name)
        bone.head, bone.tail = start, end
        bone.parent = data.edit_bones[parent] if parent else None
    bpy.ops.object.mode_set(mode='OBJECT')
    return bones


def distance_to(point, start, end):
    start, end = Vector(start), Vector(end)
    along = max(0.0, min(1.0, (point - start).dot(end - start) / (end - start).length_squared))
    return (point - start.lerp(end, along)).length


def skin(body, holders, bones):
    """Every point is held by its shell's bones, the nearer ones more."""
    groups = {name: body.vertex_groups.new(name=name) for name in BONES}
    for vertex, names in zip(body.data.vertices, holders):
        shares = {name: 1 / (0.03 + distance_to(vertex.co, *BONES[name][1:])) ** 4 for name in names}
        total = sum(shares.values())
        for name, share in shares.items():
            groups[name].add([vertex.index], share / total, 'REPLACE')
    body.parent = bones
    body.modifiers.new("Armature", 'ARMATURE').object = bones


def breathe(body, frames):
    """A shape key that widens chest and belly."""
    body.shape_key_add(name="Basis")
    key = body.shape_key_add(name="Breath")
    for number, point in enumerate(key.data):
        vertex = body.data.vertices[number]
        away = (vertex.co - Vector((0, 0.1, 0.8))).length
        point.co = vertex.co + vertex.normal * 0.03 * math.exp(-(away / 0.14) ** 2)
    for frame in range(1, frames + 1):
        key.value = 0.5 - 0.5 * math.cos(2 * math.pi * (frame - 1) / frames)
        key.keyframe_insert("value", frame=frame)


def grow_hair(body):
    """Thick locks: a mane blown back, and a fringe over the brow."""
    hair = list(SURFACES).index("Hair")
    own = {number for polygon in body.data.polygons if polygon.material_index == hair
           for number in polygon.vertices}
    places = {number: body.data.vertices[number].co for number in own}
    mane = [number for number, place in places.items()
            if place.z > 1.10 and place.y < (0.08 if place.z > 1.25 else -0.03)]
    fringe = [number for number, place in places.items() if place.z > 1.345 and place.y > 0.06]
    locks(body, "Mane", mane, 230, 0.20, (0, -0.028, -0.030), hair)
    locks(body, "Fringe", fringe, 30, 0.10, (0, 0.006, -0.032), hair)
    bpy.context.scene.cycles_curves.shape = 'THICK'


def locks(body, name, points, count, length, pull, material):
    group = body.vertex_groups.new(name=name)
    group.add(points, 1.0, 'REPLACE')
    system = body.modifiers.new(name, 'PARTICLE_SYSTEM').particle_system
    system.vertex_group_density, system.seed = name, 4
    settings = system.settings
    settings.type, settings.count, settings.hair_length = 'HAIR', count, length
    settings.hair_step, settings.display_step, settings.render_step = 8, 5, 5
    settings.material, settings.radius_scale = material + 1, 1.0
    settings.root_radius, settings.tip_radius, settings.shape = 0.046, 0.0, 0.25
    settings.use_advanced_hair, settings.factor_random = True, 0.014
    settings.normal_factor, settings.object_align_factor = 0.018, pull


def build_cloak(bones):
    """Hangs from the shoulders behind the back in folds, carried by the chest, and waves."""
    rows, columns = 36, 64
    points = []
    for row in range(rows + 1):
        down = row / rows
        for column in range(columns + 1):
            angle = math.pi * (-0.12 + 1.24 * column / columns)
            fold = 1 + 0.16 * down ** 1.2 * math.cos(10 * angle)
            wide, deep = 0.20 + 0.34 * down ** 0.9, 0.15 + 0.52 * down
            points.append((wide * fold * math.cos(angle), -deep * fold * math.sin(angle) - 0.01 - 0.07 * down,
                           0.99 - 0.08 * math.cos(angle) ** 2 * (1 - down) - 0.74 * down))
    faces = [[row * (columns + 1) + column, row * (columns + 1) + column + 1,
              (row + 1) * (columns + 1) + column + 1, (row + 1) * (columns + 1) + column]
             for row in range(rows) for column in range(columns)]
    cloak = tools.mesh_object("Cloak", points, faces, [tools.material("Cloth", (0.42, 0.06, 0.06)),
                                                       tools.material("Lining", (0.28, 0.10, 0.16))])
    cloak.vertex_groups.new(name="Chest").add(range(len(points)), 1.0, 'REPLACE')
    loose = cloak.vertex_groups.new(name="Loose")
    for number in range(len(points)):
        loose.add([number], (number // (columns + 1) / rows) ** 1.5, 'REPLACE')
    wave = cloak.modifiers.new("Wave", 'WAVE')
    wave.use_normal, wave.use_x, wave.use_y, wave.use_cyclic = True, True, False, True
    wave.height, wave.width, wave.narrowness, wave.speed = 0.09, 0.30, 3.0, 0.05
    wave.vertex_group, wave.time_offset = loose.name, -40
    cloak.modifiers.new("Armature", 'ARMATURE').object = bones
    thick = cloak.modifiers.new("Solidify", 'SOLIDIFY')
    thick.thickness, thick.material_offset, thick.offset = 0.012, 1, 1.0
    cloak.parent = bones


def walk(bones, frames):
    """One cycle, keyed on every frame; +y is ahead."""
    for frame in range(1, frames + 1):
        share = (frame - 1) / frames
        turn = 2 * math.pi * share
        bones.location = (0, STRIDE * (share - 0.5), 0.018 * math.cos(2 * turn) - 0.018)
        bones.keyframe_insert("location", frame=frame)
        angles = {"Hips": (0, 0, 0.10 * math.sin(turn)), "Chest": (-0.05, 0, -0.18 * math.sin(turn)),
                  "Head": (0.05 + 0.03 * math.sin(2 * turn), 0.04 * math.sin(turn), 0.06 * math.sin(turn))}
        for side, phase, out in (("L", turn, 1), ("R", turn + math.pi, -1)):
            angles[f"Thigh.{side}"] = (0.08 + 0.48 * math.sin(phase), 0, 0)
            angles[f"Shin.{side}"] = (-0.10 - 0.80 * max(0.0, math.cos(phase)) ** 2, 0, 0)
            angles[f"Arm.{side}"] = (-0.42 * math.sin(phase), 0, out * 0.06)
            angles[f"Hand.{side}"] = (0.40 - 0.22 * math.sin(phase), 0, 0)
        for name, (swing, roll, twist) in angles.items():
            bone = bones.pose.bones[name]
            bone.rotation_mode = 'QUATERNION'
            # Turned about the character's own axes, whichever way the bone points.
            rest = bone.bone.matrix_local.to_3x3()
            turned = (Matrix.Rotation(twist, 3, 'Z') @ Matrix.Rotation(roll, 3, 'Y')
                      @ Matrix.Rotation(swing, 3, 'X'))
            bone.rotation_quaternion = (rest.inverted() @ turned @ rest).to_quaternion()
            bone.keyframe_insert("rotation_quaternion", frame=frame)


def build(frames):
    bones = build_bones()
    body, holders = build_body()
    skin(body, holders, bones)
    breathe(body, frames)
    grow_hair(body)
    build_cloak(bones)
    walk(bones, frames)
