# SPDX-License-Identifier: GPL-3.0-or-later
"""What Preview and Live do with an exported frame: kagefude's own process, and where its picture shows."""

import os
import shutil
import subprocess
import tempfile

import bpy

from .errors import UsageError
from .export_words import export_words

IMAGE = "kagefude preview"
FRAME = "preview.####.exr"


def folder():
    """A folder of this Blender's session; Blender removes it when it ends."""
    made = os.path.join(bpy.app.tempdir or tempfile.gettempdir(), "kagefude_preview")
    os.makedirs(made, exist_ok=True)
    return made


def program(settings):
    """The path of kagefude; UsageError where there is none."""
    named = settings.program
    found = shutil.which(bpy.path.abspath(named) if named.startswith("//") else named)
    if not found:
        raise UsageError(f"kagefude is not found as '{settings.program}': set Program in the panel")
    return found


def look(settings):
    """The look's absolute path; UsageError where there is none."""
    path = bpy.path.abspath(settings.look)
    if not settings.look or not os.path.isfile(path):
        raise UsageError(f"There is no look '{settings.look}': set Look in the panel to a .toml file")
    return os.path.abspath(path)


def environment():
    """What the program is started with: as Blender was, but without the colour configuration of its own
    that Blender 5 names in OCIO. The same look is to come out as on the command line, and an older
    OpenColorIO cannot read it."""
    words = dict(os.environ)
    if words.get("OCIO") and words["OCIO"].startswith(_own_data()):
        del words["OCIO"]
    return words


def _own_data():
    return bpy.utils.system_resource('DATAFILES') or os.path.join(bpy.utils.resource_path('LOCAL'), "datafiles")


def preview_words(settings, scene):
    """Words that export the current frame, small, for a preview."""
    words = export_words(settings, scene, os.path.join(folder(), FRAME), frames=str(scene.frame_current))
    return [*words, "--scale", "1", "--percentage", str(settings.preview_percentage)]


def frame_file(scene):
    return os.path.join(folder(), FRAME.replace("####", f"{scene.frame_current:04d}"))


class Comp:
    """A started `kagefude comp` of one frame into a PNG. Call `poll` now and then."""

    def __init__(self, settings, scene):
        self.picture = os.path.join(folder(), "preview.png")
        # A file, for a pipe that nobody empties would stop the program.
        self._said = tempfile.TemporaryFile()
        self._process = subprocess.Popen(
            [program(settings), "comp", look(settings), frame_file(scene), "-o", self.picture,
             "--progress", "none", "--set", "output.scale=1"],
            env=environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=self._said)
        self.error = None

    def poll(self):
        """True once it has ended; `error` then holds its last sentence if it failed."""
        status = self._process.poll()
        if status is None:
            return False
        if status != 0 and not self.error:
            self._said.seek(0)
            lines = self._said.read().decode("utf-8", "replace").strip().splitlines()
            self.error = lines[-1] if lines else f"kagefude ended with status {status}"
        return True

    def cancel(self):
        self.error = "Preview cancelled"
        self._process.terminate()
        self._process.wait()


class Live:
    """`kagefude live` on the previewed frame; it opens the browser itself. It ends when Blender does,
    even by a crash: its standard input is a pipe whose other end only Blender has."""
    running = None
    shown = None

    @classmethod
    def open(cls, settings, scene):
        """Start it, or leave it where it already shows this frame: it watches the files."""
        wanted = (program(settings), look(settings), frame_file(scene))
        if cls.running and cls.running.poll() is None:
            if cls.shown == wanted:
                return
            cls.close()
        cls.running, cls.shown = subprocess.Popen(
            [wanted[0], "live", *wanted[1:], "--until-closed"], env=environment(),
            stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL), wanted

    @classmethod
    def close(cls):
        if cls.running and cls.running.poll() is None:
            cls.running.terminate()
            cls.running.wait()
        cls.running = cls.shown = None


def show(context, picture):
    """The picture in an Image Editor: one that is open, or a new window."""
    image = bpy.data.images.get(IMAGE)
    if image:
        image.filepath = picture
        image.reload()
    else:
        image = bpy.data.images.load(picture)
        image.name = IMAGE
    space = _image_space(context)
    if space is None:
        bpy.ops.wm.window_new()
        areas = context.window_manager.windows[-1].screen.areas
        area = max(areas, key=lambda area: area.width * area.height)
        area.type = 'IMAGE_EDITOR'
        space = area.spaces.active
    space.image = image


def _image_space(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == 'IMAGE_EDITOR' and area.ui_type == 'IMAGE_EDITOR':
                return area.spaces.active
    return None
