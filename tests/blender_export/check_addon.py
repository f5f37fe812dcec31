# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender with a shot open: the add-on exports a copy and leaves the open file alone.

    blender -b SHOT.blend --python-exit-code 1 -P check_addon.py -- OUTPUT
"""

import os
import sys
import time

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from paths import exporter  # noqa: E402

LIMIT_SECONDS = 300


def open_file_state():
    objects = {item.name: (item.pass_index, item.hide_viewport, [list(row) for row in item.matrix_world])
               for item in bpy.data.objects}
    scenes = {scene.name: (scene.frame_current, scene.cycles.samples, scene.render.resolution_x,
                           [layer.name for layer in scene.view_layers]) for scene in bpy.data.scenes}
    counts = {name: len(getattr(bpy.data, name))
              for name in ("objects", "materials", "lights", "cameras", "collections", "worlds")}
    return objects, scenes, counts, bpy.data.filepath, bpy.data.is_dirty


def wait_for(export):
    start = time.monotonic()
    while not export.poll():
        assert time.monotonic() - start < LIMIT_SECONDS, "the export does not end"
        time.sleep(0.05)


def check_panel(settings):
    words = exporter("export_words").export_words(settings, bpy.context.scene, "a.####.exr")
    options = exporter("arguments").parse_arguments(words)
    assert options.frames == [bpy.context.scene.frame_current], options
    assert (options.masks.kind, options.masks.count, options.offset) == ("disc", 9, None), options
    assert not options.casters, options
    settings.use_casters = True
    settings.frames, settings.masks, settings.offset_auto = 'SCENE', 'line', False
    settings.light = bpy.data.objects["Spot"]
    words = exporter("export_words").export_words(settings, bpy.context.scene, "a.####.exr")
    options = exporter("arguments").parse_arguments(words)
    assert options.frames == [1, 2, 3] and options.lights == ["Spot"], options
    assert (options.masks.kind, options.masks.count) == ("line", 5), options
    assert options.casters, options
    assert abs(options.offset - 0.2) < 1e-6, options
    settings.scale = 2
    options = exporter("arguments").parse_arguments(
        exporter("preview").preview_words(settings, bpy.context.scene))
    assert options.frames == [bpy.context.scene.frame_current], options
    assert (options.scale, options.percentage) == (1, 50), options
    settings.scale = 1


def check_environment():
    """Blender's own colour configuration is not handed on, that of the studio is."""
    preview = exporter("preview")
    before = os.environ.pop("OCIO", None)
    assert "OCIO" not in preview.environment()
    os.environ["OCIO"] = os.path.join(bpy.utils.system_resource('DATAFILES'), "colormanagement", "config.ocio")
    assert "OCIO" not in preview.environment(), os.environ["OCIO"]
    os.environ["OCIO"] = "/studio/config.ocio"
    assert preview.environment()["OCIO"] == "/studio/config.ocio"
    del os.environ["OCIO"]
    if before is not None:
        os.environ["OCIO"] = before


def check_export(output):
    background = exporter("background_export").BackgroundExport
    before = open_file_state()
    export = background(["--output", output, "--frames=2", "--light=Spot", "--masks", "pair",
                         "--casters"])
    wait_for(export)
    assert export.error is None, export.error
    assert export.percent == 100, export.percent
    folders = [name for name in os.listdir(os.path.dirname(output)) if name.endswith(".casters")]
    assert len(folders) == 1, folders
    meshes = os.listdir(os.path.join(os.path.dirname(output), folders[0]))
    assert meshes and all(name.endswith(".obj") for name in meshes), meshes
    failing = background(["--output", output, "--frames=2", "--light=Spott"])
    wait_for(failing)
    assert "did you mean 'Spot'" in failing.error, failing.error
    check_traceback(background)
    check_reports(background)
    stopped = background(["--output", output, "--frames=1-1000", "--light=Spot"])
    stopped.cancel()
    assert stopped.finished and stopped.error == "cancelled"
    assert open_file_state() == before, "the open file was changed"
    left = [name for name in os.listdir(os.path.dirname(output)) if ".part" in name]
    assert not left, left


def check_traceback(background):
    """Of a traceback the sentence that ends it is shown, not its first line."""
    ended = background(["--output", "/nowhere/a.####.exr", "--frames=2", "--light=Spott"])
    wait_for(ended)
    ended.error = None
    for line in ("Error: Python: Traceback (most recent call last):", 'File "a.py", line 1',
                 "AttributeError: 'NoneType' object has no attribute 'use_chaining'",
                 "Error: script failed, file: 'a.py', exiting."):
        ended._take(line)
    assert ended.error == "AttributeError: 'NoneType' object has no attribute 'use_chaining'", \
        ended.error


def check_reports(background):
    """What the exporter noted stays after the export, each once; no words of a command line."""
    ended = background(["--output", "/nowhere/a.####.exr", "--frames=2", "--light=Sun",
                        "--masks", "pair"])
    wait_for(ended)
    (kind, words), = ended.reports("//a.exr")
    assert kind == 'ERROR' and words.startswith("Export failed: light 'Sun' is a sun"), words
    assert "--" not in words, words
    ended.error = None
    assert ended.reports("//a.exr") == [('INFO', "Exported to //a.exr")], ended.reports("//a.exr")
    for line in ("note: light 'Spot' has no size", "frame 2 (2 of 2)",
                 "note: light 'Spot' has no size", "note: volumes cast no shadow"):
        ended._take(line)
    assert ended.reports("//a.exr") == [
        ('WARNING', "light 'Spot' has no size"), ('WARNING', "volumes cast no shadow"),
        ('WARNING', "Exported to //a.exr, with 2 notes (see the Info editor)")], \
        ended.reports("//a.exr")
    ended.error = "cancelled"
    assert ended.reports("//a.exr")[-1] == ('WARNING', "Export cancelled")


def main():
    addon = exporter("panel")
    addon.register()
    check_environment()
    check_export(sys.argv[-1])
    check_panel(bpy.context.scene.kagefude)
    addon.unregister()
    assert not hasattr(bpy.types.Scene, "kagefude")
    print("add-on checked", flush=True)


main()
