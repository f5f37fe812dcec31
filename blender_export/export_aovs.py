# SPDX-License-Identifier: GPL-3.0-or-later
"""Headless export; run it with Blender:

    blender -b SHOT.blend --python-exit-code 3 -P blender_export/export_aovs.py -- \\
        --output DIR/shot.####.exr [--frames 1-24] [--light NAME ...] [--masks disc:9] ...

Ends with status 0 when all is written, 2 where the command line is wrong, 3 where the scene cannot
be exported; then one line that begins with `Error:` says why.
"""

import importlib
import os
import sys

_HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.dirname(_HERE))
_PACKAGE = os.path.basename(_HERE)


def _module(name):
    return importlib.import_module(f"{_PACKAGE}.{name}")


def _say(line):
    print(line, flush=True)


def main(words):
    errors = _module("errors")
    try:
        options = _module("arguments").parse_arguments(words)
        _module("export_job").ExportJob(options, _say).run()
    except errors.UsageError as problem:
        print(f"Error: {problem}", file=sys.stderr, flush=True)
        return 2
    except errors.ExportError as problem:
        print(f"Error: {problem}", file=sys.stderr, flush=True)
        return 3
    return 0


if __name__ == "__main__":
    _status = main(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    if _status:
        sys.exit(_status)
