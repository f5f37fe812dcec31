# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader nodes that tell whether a surface point sees a place on a light: a hard shadow mask as an AOV.

One camera sample carries as many masks as there are places, at one ray each. Two nodes can do it:
Raycast (from 5.1), and Ambient Occlusion with a sampler whose turn is known (see sampler_probe).

The answers agree with a lamp of size 0 on white diffuse: 0 where the shading normal faces away,
outside a spot's cone and behind an area light. On smooth-shaded faces that turn away from the
light while their shading normal still faces it, Cycles lets the ray begin on the smooth surface
that the faces stand for; here the ray is bent until it just leaves the face, which sees the same
but for the few pixels where another caster's edge crosses there.
"""

import math

import bpy
from mathutils import Vector

from .shader_words import ShaderWords

LONG = 1e9         # length of a normal beside which the part of a ray along T is nothing
GRAZING = 1e-3     # sine of the angle at which a bent ray leaves its face
SHORT = 1.0 - 1e-5  # rays end this share of the way, so that what touches the light does not count
FAR = 1e7          # length of a ray to a sun


class Sight:
    """A node group that writes every place's visibility; places are set frame by frame.

    It stands in a white material of its own, or in each of the artist's materials.
    """

    def __init__(self, ask):
        """`ask(words, toward, length, wanted)` is the socket of a ray's answer, 1 where it is free.

        `toward` is a vector socket, `length` how many of it the ray may go, and the ray may be
        left out where the socket `wanted` is 0.
        """
        self.group, self.ask = bpy.data.node_groups.new("kagefude sight", 'ShaderNodeTree'), ask
        self.words = ShaderWords(self.group)
        self._on = self.group.nodes.new('ShaderNodeValue').outputs[0]
        self.switch(1.0)

    def put_into(self, material):
        material.node_tree.nodes.new('ShaderNodeGroup').node_tree = self.group

    def switch(self, value):
        """With 0 no rays are sent, and all places count as hidden."""
        self._on.default_value = value

    def add(self, kind, aov):
        """One more place on a light of `kind`, written into the AOV; returns its Place."""
        place = Place(self.words, kind)
        wanted = self.words.number('MULTIPLY', place.wanted, self._on)
        self.words.write(self.words.number('MULTIPLY', wanted, self.ask(
            self.words, place.toward, place.length, wanted)), aov)
        return place


def can_stand_in(objects):
    """Whether the materials of all objects can hold the group and say what plain white would.

    Not where a face may have no material, which nothing can be put into, and not where bumps turn
    the normal that a mask knows nothing of.
    """
    return all(_holds(item) for item in objects if not _is_faceless(item))


def _is_faceless(item):
    return item.type == 'MESH' and not item.data.polygons and not item.modifiers


def _holds(item):
    # Geometry nodes may make faces of any material, or of none.
    if not item.material_slots or any(modifier.type == 'NODES' for modifier in item.modifiers):
        return False
    return all(_is_plain(slot.material) for slot in item.material_slots)


def _is_plain(material):
    tree = material.node_tree if material and material.use_nodes else None
    output = tree.get_output_node('CYCLES') if tree else None
    return output is not None and output.inputs["Surface"].is_linked \
        and not output.inputs["Displacement"].is_linked


class Place:
    """The nodes of one place: what the ray goes toward, how far, and where it is needed at all."""

    def __init__(self, words, kind):
        self.kind, self.centre = kind, words.constant()
        centre = self.centre.outputs[0]
        self.length = FAR if kind == "sun" else SHORT
        straight = centre if kind == "sun" else words.minus(centre, words.position)
        self.wanted = words.number('GREATER_THAN', words.dot(words.normal, straight), 0.0)
        if kind in ("spot", "area"):
            self.wanted = words.number('MULTIPLY', self.wanted, self._in_cone(words, straight))
        lift = words.number('SUBTRACT', words.dot(words.face_normal, straight),
                            words.number('MULTIPLY', words.length(straight), GRAZING))
        below = words.number('MINIMUM', lift, 0.0)
        self.toward = words.minus(straight, words.times(words.face_normal, below))

    def put(self, position, direction, state):
        """Move the place: `position` of a light, `direction` in which a sun's light travels."""
        _set(self.centre, position if direction is None else [-value for value in direction])
        if self.kind in ("spot", "area"):
            _set(self.axis, state.direction)
            angle = state.cone[0] if state.cone else math.pi
            self.cosine.inputs[1].default_value = math.cos(0.5 * angle)

    def _in_cone(self, words, straight):
        self.axis = words.constant()
        along = words.dot(straight, words.times(self.axis.outputs[0], -1.0))
        self.cosine = words.number('MULTIPLY', words.length(straight), 0.0).node
        return words.number('GREATER_THAN', along, self.cosine.outputs[0])


def ask_raycast(words, toward, length, wanted):
    """The same by the Raycast node, which leaves the length to us and wants a unit direction."""
    node = words.tree.nodes.new('ShaderNodeRaycast')
    reach = words.number('MULTIPLY', wanted, length)
    if length == SHORT:
        reach = words.number('MULTIPLY', reach, words.length(toward))
    words.tree.links.new(words.position, node.inputs["Position"])
    words.tree.links.new(words.unit(toward), node.inputs["Direction"])
    words.tree.links.new(reach, node.inputs["Length"])
    return words.number('SUBTRACT', 1.0, node.outputs["Is Hit"])


def ask_occlusion(turn):
    """The same by the Ambient Occlusion node, for the sampler's `turn`.

    The node is given the normal n = w - s w x T for a ray along w, with s = d_y / d_z: then its
    ray is (d_y n x T + d_z n) LONG = d_z (1 + s^2) LONG w, and lengths count in that.
    """
    unit = turn.height * (1.0 + turn.slope ** 2) * LONG

    def ask(words, toward, length, wanted):
        across = words.unit(words.cross((1.0, 1.0, 1.0), toward))
        back = words.times(words.cross(toward, across), turn.slope)
        node = words.tree.nodes.new('ShaderNodeAmbientOcclusion')
        node.samples, node.only_local, node.inside = 1, False, False
        words.tree.links.new(words.times(words.minus(toward, back), LONG), node.inputs["Normal"])
        # A distance of 0 saves the ray.
        words.tree.links.new(words.number('MULTIPLY', wanted, length / unit), node.inputs["Distance"])
        return node.outputs["AO"]

    return ask


def blind_toward(turn):
    """The unit direction toward a light, near which the Ambient Occlusion node cannot be aimed.

    The turn leads toward (1, 1, 1) or away from it, and no normal is turned into the directions
    that lie within it round the end that it leads away from.
    """
    return Vector((1.0, 1.0, 1.0)).normalized() * (-1.0 if turn.slope > 0.0 else 1.0)


def _set(node, values):
    for socket, value in zip(node.inputs, values):
        socket.default_value = value
