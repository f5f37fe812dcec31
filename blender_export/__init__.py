# SPDX-License-Identifier: GPL-3.0-or-later
"""Exports what kagefude comps: data passes, hard shadow masks, light-depth maps and a JSON per frame.

The parts that need Blender are only loaded when the add-on is turned on, so that the rest can be
imported, and tested, by plain Python.
"""

bl_info = {
    "name": "kagefude export",
    "author": "The kagefude authors",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Render > kagefude",
    "description": "Renders the passes, shadow masks and light-depth maps that kagefude comps",
    "category": "Import-Export",
}


def register():
    from . import panel
    panel.register()


def unregister():
    from . import panel
    panel.unregister()
