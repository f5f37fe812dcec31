# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the exporter importable from its place in the repository."""

import importlib
import os
import sys

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
if REPOSITORY not in sys.path:
    sys.path.insert(0, REPOSITORY)


def exporter(name):
    """A module of the exporter."""
    return importlib.import_module(f"blender_export.{name}")
