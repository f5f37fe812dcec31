# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the headless exporter on a copy of the open file, so that the open scene stays as it is."""

import glob
import os
import queue
import re
import shutil
import subprocess
import tempfile
import threading

import bpy

from . import arguments, output_names

_PROGRESS = re.compile(r"Progress: (\d+)%")
# Blender's line above a Python traceback, and the sentence that ends one.
_TRACEBACK = "Error: Python:"
_RAISED = re.compile(r"[\w.]*(Error|Exception)(: .*)?")
_NOTE = "note: "
SECONDS_TO_END = 5.0


class BackgroundExport:
    """A started export. Call `poll` now and then; it ends in `finished`, with `error` if it failed."""

    def __init__(self, words):
        """Check the words (UsageError), save the copy, and start Blender on it."""
        options = arguments.parse_arguments(words)
        self._names = output_names.parse_output(options.output, len(options.frames))
        self.percent, self.status, self.error, self.finished = 0, "Starting", None, False
        self.notes = []
        self._in_traceback = False
        self._folder = tempfile.mkdtemp(prefix="kagefude-")
        copy = os.path.join(self._folder, "shot.blend")
        try:
            bpy.ops.wm.save_as_mainfile(filepath=copy, copy=True, check_existing=False)
            script = os.path.join(os.path.dirname(os.path.realpath(__file__)), "export_aovs.py")
            self._process = subprocess.Popen(
                [bpy.app.binary_path, "-b", copy, "--python-exit-code", "3", "-P", script, "--",
                 *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                text=True, encoding="utf-8", errors="replace")
        except Exception:
            shutil.rmtree(self._folder, ignore_errors=True)
            raise
        self._lines = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def poll(self):
        """Take in what Blender has said; returns True once the export has ended."""
        while not self.finished:
            try:
                line = self._lines.get_nowait()
            except queue.Empty:
                return False
            if line is None:
                self._end(self._process.wait())
            else:
                self._take(line.strip())
        return True

    def cancel(self):
        """Stop Blender and remove what is half written."""
        if self.finished:
            return
        self._process.terminate()
        try:
            self._process.wait(SECONDS_TO_END)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        for part in glob.glob(self._names.parts_pattern()):
            os.remove(part)
        self.error = "cancelled"
        self._end(1)

    def reports(self, output):
        """What an operator reports at the end, as (kind, words): the notes, then how it went.

        Blender's status bar shows the last of them for some seconds, its Info editor all.
        """
        notes = [('WARNING', note) for note in self.notes]
        if self.error == "cancelled":
            return [*notes, ('WARNING', "Export cancelled")]
        if self.error:
            return [*notes, ('ERROR', f"Export failed: {self.error}")]
        if not notes:
            return [('INFO', f"Exported to {output}")]
        count = f"{len(notes)} note{'s' if len(notes) > 1 else ''}"
        return [*notes, ('WARNING', f"Exported to {output}, with {count} (see the Info editor)")]

    def _read(self):
        for line in self._process.stdout:
            self._lines.put(line)
        self._lines.put(None)

    def _take(self, line):
        found = _PROGRESS.fullmatch(line)
        if found:
            self.percent = int(found[1])
        elif line.startswith(_TRACEBACK):
            self._in_traceback = True
        elif self._in_traceback and _RAISED.fullmatch(line):
            self.error, self._in_traceback = self.error or line, False
        elif line.startswith("Error:"):
            self.error = self.error or line[len("Error:"):].strip()
        elif line.startswith("frame "):
            self.status = line
        elif line.startswith(_NOTE) and line[len(_NOTE):] not in self.notes:
            self.notes.append(line[len(_NOTE):])

    def _end(self, status):
        self.finished = True
        if status == 0:
            self.error = None
        elif not self.error:
            self.error = f"Blender ended with status {status}"
        shutil.rmtree(self._folder, ignore_errors=True)
