# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes built by a few lines of Python and exported with the Blender that is installed."""

import json
import os
import shutil
import subprocess
import tempfile
import unittest

from exr_pixels import read_exr
from paths import REPOSITORY

BLENDER = shutil.which("blender")

# What every scene starts from: names for the lines that build it.
_HEAD = f"""
import math, sys, bpy
sys.path.insert(0, {os.path.join(REPOSITORY, "examples")!r})
import scene_tools as tools
GREY = None

def start(width=32, height=32):
    global GREY
    scene = tools.empty_scene(width, height, 1, "Case")
    GREY = tools.material("Grey", (0.5, 0.5, 0.5))
    return scene

def ground():
    return tools.plane("Ground", [(-6, -6, 0), (6, -6, 0), (6, 6, 0), (-6, 6, 0)], GREY)

def box(name, low, high, surface=None):
    return tools.box(name, low, high, surface or GREY)

def light(name, kind, place, turn=(0, 0, 0), **settings):
    data = bpy.data.lights.new(name, kind)
    for key, value in settings.items():
        setattr(data, key, value)
    made = bpy.data.objects.new(name, data)
    made.location, made.rotation_euler = place, [math.radians(angle) for angle in turn]
    bpy.context.scene.collection.objects.link(made)
    return made

def key(holder, name, **values):
    for frame, value in values.items():
        setattr(holder, name, value)
        holder.keyframe_insert(name, frame=int(frame[1:]))
"""


def blender(*words):
    return subprocess.run([BLENDER, "-b", *words], capture_output=True, text=True, timeout=600)


def blender_says(expression):
    """Whether an expression about bpy holds in the installed Blender."""
    said = blender("--factory-startup", "--python-expr",
                   f"import bpy; print('answer', bool({expression}))").stdout
    return "answer True" in said


@unittest.skipUnless(BLENDER, "Blender is not installed")
class BlenderCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="kagefude-case-")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def build(self, lines, name="case.blend"):
        """A .blend of the scene that the lines build."""
        shot = self.path(name)
        code = _HEAD + lines + f"\nbpy.ops.wm.save_as_mainfile(filepath={shot!r})\n"
        script = self.path(name + ".py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(code)
        made = blender("--factory-startup", "--python-exit-code", "1", "-P", script)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        return shot

    def run_export(self, shot, *words, output="out/s.####.exr"):
        script = os.path.join(REPOSITORY, "blender_export", "export_aovs.py")
        return blender(shot, "--python-exit-code", "3", "-P", script, "--",
                       "--output", self.path(output), "--depth-size", "16", *words)

    def export(self, shot, *words, output="out/s.####.exr"):
        """What Blender said; the export must succeed and say nothing that farms take for an error."""
        result = self.run_export(shot, *words, output=output)
        said = result.stdout + result.stderr
        self.assertEqual(result.returncode, 0, said)
        self.assertNotIn("error", said.lower())
        return said

    def document(self, frame, output="out/s"):
        with open(self.path(f"{output}.{frame:04}.json"), encoding="utf-8") as file:
            return json.load(file)

    def pixels(self, frame, output="out/s"):
        return read_exr(self.path(f"{output}.{frame:04}.exr"))[0]

    def notes(self, said):
        return [line[len("note: "):] for line in said.splitlines() if line.startswith("note: ")]
