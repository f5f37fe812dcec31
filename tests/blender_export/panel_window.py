# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside a Blender with a window: shows the add-on's panel and writes down what it is at.

    blender SHOT.blend -P panel_window.py -- STATE.json

Nothing else is in the render properties, so that the panel stands at their top; the mouse and the
keyboard of panel_window.sh do the rest.
"""

import itertools
import json
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paths import exporter  # noqa: E402

STATE = sys.argv[-1]
ticks = itertools.count()
opened = False
exports = {"started": 0, "ended": 0, "said": ""}


def hide_other_panels():
    for kind in list(bpy.types.Panel.__subclasses__()):
        if getattr(kind, "bl_context", "") == "render" and kind.__name__ != "KAGEFUDE_PT_export":
            try:
                bpy.utils.unregister_class(kind)
            except RuntimeError:
                pass  # a base class, which was never registered


def show_properties():
    """Make the largest area show the render properties; returns its window and its panels' region."""
    window = bpy.context.window_manager.windows[0]
    area = max(window.screen.areas, key=lambda area: area.width * area.height)
    # Setting them again, even to the same, would take the mouse away from what it is pressing.
    if area.type != 'PROPERTIES':
        area.type = 'PROPERTIES'
    if area.spaces.active.context != 'RENDER':
        area.spaces.active.context = 'RENDER'
    return window, next(region for region in area.regions if region.type == 'WINDOW')


def tell_when_opened(panel):
    """Blender draws the insides of open panels only."""
    draw = panel.draw

    def draw_and_tell(self, context):
        global opened
        opened = True
        draw(self, context)
    panel.draw = draw_and_tell


def count_exports():
    """Tell how many exports were started and what was reported of those that have ended.

    One that fails may be over before anybody has looked at its progress.
    """
    background = exporter("background_export").BackgroundExport
    start, report = background.__init__, background.reports

    def start_and_count(self, words):
        start(self, words)
        exports["started"] += 1

    def report_and_tell(self, output):
        said = report(self, output)
        exports["ended"] += 1
        exports["said"] = said[-1][1]
        return said
    background.__init__, background.reports = start_and_count, report_and_tell


def write_state(window, region):
    settings = window.scene.kagefude
    state = {"ticks": next(ticks), "opened": opened, **exports,
             "percent": bpy.context.window_manager.kagefude_percent, "masks": settings.masks,
             "frames": settings.frames, "frame_list": settings.frame_list,
             "output": settings.output, "dirty": bpy.data.is_dirty,
             "left": region.x, "top": window.height - region.y - region.height,
             "width": region.width}
    with open(STATE + ".part", "w", encoding="utf-8") as file:
        json.dump(state, file)
    os.replace(STATE + ".part", STATE)


def watch():
    try:
        write_state(*show_properties())
    except TypeError:
        pass  # an area knows its tabs only once it has been drawn
    return 0.2


bpy.context.preferences.view.show_splash = False
tell_when_opened(exporter("panel").KAGEFUDE_PT_export)
count_exports()
exporter("panel").register()
hide_other_panels()
bpy.app.timers.register(watch, first_interval=1.0)
