# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes shader expressions: each call adds one node to a tree and returns the socket of its value."""


class ShaderWords:
    """Vectors and numbers of a material, as sockets; tuples and floats stand for themselves."""

    def __init__(self, tree):
        self.tree = tree
        geometry = tree.nodes.new('ShaderNodeNewGeometry').outputs
        self.position, self.normal = geometry["Position"], geometry["Normal"]
        self.face_normal = geometry["True Normal"]

    def constant(self):
        """A vector node whose `inputs[0..2]` may be set later; its output is the vector."""
        return self.tree.nodes.new('ShaderNodeCombineXYZ')

    def minus(self, first, second):
        return self._vector('SUBTRACT', first, second)

    def cross(self, first, second):
        return self._vector('CROSS_PRODUCT', first, second)

    def unit(self, vector):
        return self._vector('NORMALIZE', vector)

    def times(self, vector, factor):
        node = self._node('ShaderNodeVectorMath', 'SCALE', vector)
        self._fill(node.inputs["Scale"], factor)
        return node.outputs["Vector"]

    def dot(self, first, second):
        return self._node('ShaderNodeVectorMath', 'DOT_PRODUCT', first, second).outputs["Value"]

    def length(self, vector):
        return self._node('ShaderNodeVectorMath', 'LENGTH', vector).outputs["Value"]

    def number(self, operation, first, second):
        """A Math node: 'MULTIPLY', 'MINIMUM', 'GREATER_THAN' and so on."""
        return self._node('ShaderNodeMath', operation, first, second).outputs["Value"]

    def write(self, socket, name):
        """Put a number into the AOV `name`."""
        node = self.tree.nodes.new('ShaderNodeOutputAOV')
        # The AOV's name was the node's own until 4.2.
        if hasattr(node, "aov_name"):
            node.aov_name = name
        else:
            node.name = name
        self.tree.links.new(socket, node.inputs["Value"])

    def _vector(self, operation, *values):
        return self._node('ShaderNodeVectorMath', operation, *values).outputs["Vector"]

    def _node(self, kind, operation, *values):
        node = self.tree.nodes.new(kind)
        node.operation = operation
        for socket, value in zip(node.inputs, values):
            self._fill(socket, value)
        return node

    def _fill(self, socket, value):
        if isinstance(value, (float, tuple)):
            socket.default_value = value
        else:
            self.tree.links.new(value, socket)
