# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside a Blender with a window: presses Preview, then Live, and writes down what came of them.

    blender SHOT.blend -P preview_window.py -- KAGEFUDE LOOK STATE.json
"""

import json
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paths import exporter  # noqa: E402

PROGRAM, LOOK, STATE = sys.argv[-3:]
state = {"step": "start", "longest": 0.0}
steps = iter(("preview", "shown", "live", "lived"))


def tell():
    with open(STATE + ".part", "w", encoding="utf-8") as file:
        json.dump(state, file)
    os.replace(STATE + ".part", STATE)


def press(operator):
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window, area=window.screen.areas[0]):
        return sorted(operator('INVOKE_DEFAULT'))


def shown():
    """Size of the picture that an Image Editor shows, and how many windows there are."""
    image = bpy.data.images.get("kagefude preview")
    spaces = [area.spaces.active for window in bpy.context.window_manager.windows
              for area in window.screen.areas if area.type == 'IMAGE_EDITOR']
    seen = image is not None and any(space.image == image for space in spaces)
    return list(image.size) if seen else None


def step():
    if bpy.context.window_manager.kagefude_percent >= 0:
        return 0.2
    if os.path.exists(STATE + ".quit"):
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            bpy.ops.wm.quit_blender()
        return None
    name = next(steps, None)
    if name == "preview":
        state["pressed"] = press(bpy.ops.kagefude.preview)
    elif name == "shown":
        state["size"], state["dirty"] = shown(), bpy.data.is_dirty
    elif name == "live":
        state["pressed_live"] = press(bpy.ops.kagefude.live)
    elif name == "lived":
        running = exporter("preview").Live.running
        state["process"] = running.pid if running and running.poll() is None else None
    state["step"] = name or "done"
    tell()
    return 1.0


bpy.context.preferences.view.show_splash = False
exporter("panel").register()
settings = bpy.context.scene.kagefude
settings.program, settings.look, settings.masks = PROGRAM, LOOK, 'disc:5'
settings.depth_size = 64
bpy.app.timers.register(step, first_interval=2.0)
