# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a walking character, its rigid copy (the same pose, moved as the walker moves), or three
stones that move alike: one real object and two instances of a collection.

    blender -b --factory-startup --python-exit-code 3 -P tests/quality/skin_scenes.py -- \
        walk|rigid|instances OUT.blend [MODEL.glb]

Without a model the character is built here: one skinned mesh of a body, four legs, a neck and a
tail. A model (../shared/data/characters/fox.glb) is imported, with the action that has Walk in its
name, and scaled to about two units.
"""

import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "examples"))

import bpy  # noqa: E402  (after the path, with the module that needs it)

import scene_tools as tools  # noqa: E402

FRAMES = 24
POSE = 5         # of the rigid copy
LIMBS = {        # name: (from, to) along y and z, and the side x
    "FrontLeft": ((0.62, 0.9), (0.62, 0.0), 0.16), "FrontRight": ((0.62, 0.9), (0.62, 0.0), -0.16),
    "HindLeft": ((-0.62, 0.9), (-0.62, 0.0), 0.16), "HindRight": ((-0.62, 0.9), (-0.62, 0.0), -0.16),
    "Neck": ((0.7, 1.0), (1.25, 1.35), 0.0), "Tail": ((-0.75, 1.05), (-1.55, 0.85), 0.0)}
SWING = {"FrontLeft": (0.5, 0.0), "FrontRight": (0.5, math.pi), "HindLeft": (0.45, math.pi),
         "HindRight": (0.45, 0.0), "Neck": (0.12, 1.0), "Tail": (0.35, 2.0)}


def rod(start, end, side, thick, steps=12):
    (y0, z0), (y1, z1) = start, end
    return [(side, y0 + (y1 - y0) * step / steps, z0 + (z1 - z0) * step / steps, thick)
            for step in range(steps + 1)]


def built():
    """The skinned mesh and its armature; each limb is held by its bone, faded in at the root."""
    rods = {"Body": rod((-0.85, 0.98), (0.85, 0.98), 0.0, 0.28)}
    rods.update({name: rod(*limb, 0.11) for name, limb in LIMBS.items()})
    mesh = tools.tube("Walker", list(rods.values()), tools.material("Fur", (0.55, 0.30, 0.15)), 20)
    data = bpy.data.armatures.new("Bones")
    bones = bpy.data.objects.new("Bones", data)
    bpy.context.scene.collection.objects.link(bones)
    bpy.context.view_layer.objects.active = bones
    bpy.ops.object.mode_set(mode='EDIT')
    for name, ((y0, z0), (y1, z1), side) in {"Body": ((-0.85, 0.98), (0.85, 0.98), 0.0),
                                             **LIMBS}.items():
        bone = data.edit_bones.new(name)
        bone.head, bone.tail = (side, y0, z0), (side, y1, z1)
    bpy.ops.object.mode_set(mode='OBJECT')
    groups = {name: mesh.vertex_groups.new(name=name) for name in rods}
    each = len(mesh.data.vertices) // len(rods)
    for place, name in enumerate(rods):
        for number in range(each):
            share = 1.0 if name == "Body" else min(1.0, (number // 20) / 4)
            vertex = [place * each + number]
            groups[name].add(vertex, share, 'REPLACE')
            if share < 1.0:
                groups["Body"].add(vertex, 1.0 - share, 'REPLACE')
    mesh.parent = bones
    mesh.modifiers.new("Armature", 'ARMATURE').object = bones
    for name, (size, phase) in SWING.items():
        bone = bones.pose.bones[name]
        bone.rotation_mode = 'XYZ'
        for frame in range(1, FRAMES + 1):
            bone.rotation_euler = (size * math.sin(2 * math.pi * (frame - 1) / FRAMES + phase), 0, 0)
            bone.keyframe_insert("rotation_euler", frame=frame)
    return mesh, bones


def imported(path):
    import numpy
    for name in ("bool", "int", "float"):  # the importer of 3.4 wants what numpy dropped
        if name not in numpy.__dict__:
            setattr(numpy, name, getattr(__import__("builtins"), name))
    bpy.ops.import_scene.gltf(filepath=path)
    bones = next(item for item in bpy.data.objects if item.type == 'ARMATURE')
    for track in list(bones.animation_data.nla_tracks):
        bones.animation_data.nla_tracks.remove(track)
    bones.animation_data.action = next(a for a in bpy.data.actions if "Walk" in a.name)
    mesh = next(item for item in bpy.data.objects if item.find_armature())
    for item in list(bpy.data.objects):
        if item.type == 'MESH' and item != mesh:
            bpy.data.objects.remove(item)
    root = bpy.data.objects.new("Root", None)
    bpy.context.scene.collection.objects.link(root)
    bones.parent = root
    root.scale = (0.02,) * 3
    return mesh, root, bones


def stone(name, surface):
    outline = [(0.0, -0.5), (0.35, -0.42), (0.5, -0.1), (0.42, 0.25), (0.2, 0.5), (0.0, 0.55)]
    return tools.revolve(name, tools.smooth_curve(outline, 8), surface, 48)


def instances():
    """Three things that turn and rise alike, side by side along y; returns them."""
    surface = tools.material("Stone", (0.4, 0.4, 0.4))
    real, original = stone("Real", surface), stone("Original", surface)
    collection = bpy.data.collections.new("Stones")
    bpy.context.scene.collection.objects.unlink(original)
    collection.objects.link(original)
    things = [real]
    for name in ("First", "Second"):
        empty = bpy.data.objects.new(name, None)
        empty.instance_type, empty.instance_collection = 'COLLECTION', collection
        bpy.context.scene.collection.objects.link(empty)
        things.append(empty)
    for lane, thing in zip((-1.5, 0.0, 1.5), things):
        for frame, share in ((1, 0.0), (FRAMES, 1.0)):
            thing.location = (0, lane, 0.5 + 0.8 * share)
            thing.rotation_euler = (0.4, 0.2, 0.3 + 1.2 * share)
            thing.keyframe_insert("location", frame=frame)
            thing.keyframe_insert("rotation_euler", frame=frame)
    return things


def walker(path):
    if path:
        _, mover, bones = imported(path)
    else:
        _, bones = built()
        mover = bones
    for frame, place in ((1, 0.36), (FRAMES, -0.36)):
        mover.location = (0, place, 0)
        mover.keyframe_insert("location", frame=frame)
    return mover, bones


def main():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    if len(words) not in (2, 3) or words[0] not in ("walk", "rigid", "instances"):
        print("Error: give walk, rigid or instances, and a file to write, after --",
              file=sys.stderr, flush=True)
        raise SystemExit(2)
    scene = tools.empty_scene(640, 400, 4, "Skin")
    scene.frame_start, scene.frame_end = 1, FRAMES
    bones = mover = None
    if words[0] == "instances":
        movers = instances()
    else:
        mover, bones = walker(words[2] if len(words) == 3 else "")
        movers = [mover]
    for thing in movers:
        for curve in thing.animation_data.action.fcurves:
            for point in curve.keyframe_points:
                point.interpolation = 'LINEAR'
    scene.frame_set(POSE)
    if words[0] == "rigid":
        freeze(bones, mover)
    sun = bpy.data.lights.new("Sun", 'SUN')
    sun.energy, sun.angle = 3, 0.05
    lamp = bpy.data.objects.new("Sun", sun)
    lamp.rotation_euler = (0.7, 0.4, 0)
    scene.collection.objects.link(lamp)
    tools.camera((7, -0.6, 1.5), (0, 0, 0.8), 62)
    tools.save(os.path.abspath(words[1]))


def freeze(bones, mover):
    """Stops every bone where it is; the armature's own move goes on."""
    action = bones.animation_data.action
    if bones is not mover:
        bones.animation_data.action = None
        return
    for curve in list(action.fcurves):
        if curve.data_path.startswith("pose."):
            action.fcurves.remove(curve)


main()
