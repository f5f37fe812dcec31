# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene whose compositor writes the layers of the others."""

import bpy

from . import compat
from .errors import ExportError
from .export_scenes import PREFIX, resolution
from .seen_points import OBJECT, POSITION


class Writer:
    """A scene whose compositor gathers layers of other scenes into one multilayer EXR."""

    def __init__(self, like, name):
        self.scene = bpy.data.scenes.new(PREFIX + name)
        render = self.scene.render
        render.resolution_x, render.resolution_y = resolution(like)
        render.resolution_percentage = 100
        render.use_stamp_date = render.use_stamp_filename = render.use_stamp_render_time = False
        self.tree = compat.compositor_tree(self.scene)
        self._sources, self._values = {}, {}
        self.file, self.seen_file = compat.LayerFile(self.tree), None

    @property
    def names(self):
        return self.file.names

    def _source_of(self, scene, layer_name):
        """The one node for a layer that many readings share."""
        key = scene.name, layer_name
        if key not in self._sources:
            self._sources[key] = self.source(scene, layer_name)
        return self._sources[key]

    def source(self, scene, layer_name):
        node = self.tree.nodes.new('CompositorNodeRLayers')
        node.scene = scene
        node.layer = layer_name
        return node

    def add(self, socket, name):
        self.file.add(socket, name)

    def add_pass(self, node, pass_name, name):
        self.add(self._pass(node, pass_name), name)

    def keep_for_seen_points(self, node, masks):
        """Write what SeenPoints reads into a file of its own: passes of `node`, and layers added before."""
        self.seen_file = compat.LayerFile(self.tree, 'NONE')
        for name in (OBJECT, POSITION):
            self.seen_file.add(self._pass(node, name), name)
        for name in masks:
            self.seen_file.add(self._values[name], name)

    def _pass(self, node, pass_name):
        socket = compat.output_socket(node, pass_name)
        if socket is None:
            raise ExportError(f"Blender gives no {pass_name} pass for layer '{node.layer}'")
        return socket

    def add_reading(self, layer, reading):
        """One channel, as `reading` says."""
        value = self._first_channel(reading, reading.view_layer)
        if reading.threshold is not None:
            value = self._calculated('GREATER_THAN', value, reading.threshold)
        if reading.share_of:
            # 0 divided by 0, where no light arrives, is 0 to the compositor.
            whole = self._first_channel(reading, reading.share_of)
            value = self._calculated('DIVIDE', value, whole)
        self._values[layer] = value
        self.add(value, layer)

    def _first_channel(self, reading, view_layer):
        socket = self._pass(self._source_of(reading.scene, view_layer), reading.pass_name)
        return socket if socket.type == 'VALUE' else \
            compat.first_channel_of_colour(self.tree, socket)

    def _calculated(self, operation, first, second):
        node = compat.math_node(self.tree, operation)
        self.tree.links.new(first, node.inputs[0])
        if isinstance(second, float):
            node.inputs[1].default_value = second
        else:
            self.tree.links.new(second, node.inputs[1])
        return node.outputs[0]
