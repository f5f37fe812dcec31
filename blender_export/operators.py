# SPDX-License-Identifier: GPL-3.0-or-later
"""The Export and Cancel buttons."""

import os

import bpy

from .background_export import BackgroundExport
from .errors import UsageError
from .export_words import export_words

SECONDS_BETWEEN_LOOKS = 0.25


class KAGEFUDE_OT_export(bpy.types.Operator):
    """Render the passes, shadow masks and light-depth maps in a second Blender, on a copy of this file"""
    bl_idname = "kagefude.export"
    bl_label = "Export"

    _export = None
    _timer = None
    _unsaved = False

    @classmethod
    def poll(cls, context):
        return context.window_manager.kagefude_percent < 0

    def execute(self, context):
        settings = context.scene.kagefude
        if settings.output.startswith("//") and not bpy.data.filepath:
            self.report({'ERROR'}, "Save the file first, or give the output an absolute path")
            return {'CANCELLED'}
        output = os.path.abspath(bpy.path.abspath(settings.output))
        self._unsaved = bpy.data.is_dirty
        try:
            self._export = BackgroundExport(export_words(settings, context.scene, output))
        except (UsageError, OSError, RuntimeError) as problem:
            self.report({'ERROR'}, str(problem))
            return {'CANCELLED'}
        manager = context.window_manager
        manager.kagefude_percent, manager.kagefude_cancel = 0, False
        self._timer = manager.event_timer_add(SECONDS_BETWEEN_LOOKS, window=context.window)
        manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        manager = context.window_manager
        if manager.kagefude_cancel:
            self._export.cancel()
        if event.type != 'TIMER' and not self._export.finished:
            return {'PASS_THROUGH'}
        self._keep_unsaved()
        if not self._export.poll():
            manager.kagefude_percent = self._export.percent
            context.workspace.status_text_set(
                f"kagefude: {self._export.status}, {self._export.percent} %")
            _redraw(context)
            return {'PASS_THROUGH'}
        return self._finish(context)

    def _keep_unsaved(self):
        """Saving the copy makes Blender 3 forget, an event later, that the open file has changes."""
        if self._unsaved and not bpy.data.is_dirty:
            bpy.ops.ed.undo_push(message="kagefude export")
        self._unsaved = False

    def cancel(self, context):
        """Blender closes or loads another file."""
        self._export.cancel()

    def _finish(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.kagefude_percent = -1
        context.workspace.status_text_set(None)
        _redraw(context)
        for kind, words in self._export.reports(context.scene.kagefude.output):
            self.report({kind}, words)
        return {'CANCELLED'} if self._export.error else {'FINISHED'}


class KAGEFUDE_OT_cancel(bpy.types.Operator):
    """Stop the export that is running"""
    bl_idname = "kagefude.cancel"
    bl_label = "Cancel"

    def execute(self, context):
        context.window_manager.kagefude_cancel = True
        return {'FINISHED'}


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == 'PROPERTIES':
                area.tag_redraw()


CLASSES = (KAGEFUDE_OT_export, KAGEFUDE_OT_cancel)
