# SPDX-License-Identifier: GPL-3.0-or-later
"""What a light gives off in one frame: its settings times its nodes, and what arrives of it.

Only nodes whose value is the same all over the light are followed; what cannot be followed is
named, and counts as 1.
"""

import math
from dataclasses import dataclass

from . import vectors

LUMINANCE = (0.2126, 0.7152, 0.0722)
_MATHS = {'ADD': lambda a, b: a + b, 'SUBTRACT': lambda a, b: a - b,
          'MULTIPLY': lambda a, b: a * b, 'DIVIDE': lambda a, b: a / b if b else 0.0,
          'MINIMUM': min, 'MAXIMUM': max}


@dataclass
class Emission:
    strength: float          # factor on the light's energy
    color: tuple             # factor on the light's colour
    unknown: str = None      # name of a node that could not be followed


def node_emission(data):
    """Emission of an evaluated light's nodes; strength 1 in white where it uses none."""
    if not data.use_nodes or data.node_tree is None:
        return Emission(1.0, (1.0, 1.0, 1.0))
    output = data.node_tree.get_output_node('CYCLES')
    if output is None or not output.inputs["Surface"].is_linked:
        return Emission(0.0, (1.0, 1.0, 1.0))
    shader = _source(output.inputs["Surface"])[0]
    if shader is None or shader.mute:
        return Emission(0.0, (1.0, 1.0, 1.0))
    if shader.bl_idname != 'ShaderNodeEmission':
        return Emission(1.0, (1.0, 1.0, 1.0), shader.name)
    return _shader_emission(shader)


def world_radiance(world):
    """Radiance of an evaluated world that is the same from everywhere; None where it is not known to
    be: only one Background is followed."""
    if world is None:
        return (0.0, 0.0, 0.0)
    if not world.use_nodes or world.node_tree is None:
        return tuple(world.color)
    output = world.node_tree.get_output_node('CYCLES')
    if output is None or not output.inputs["Surface"].is_linked:
        return (0.0, 0.0, 0.0)
    shader = _source(output.inputs["Surface"])[0]
    if shader is None or shader.mute:
        return (0.0, 0.0, 0.0)
    if shader.bl_idname != 'ShaderNodeBackground':
        return None
    found = _shader_emission(shader)
    return None if found.unknown else tuple(found.strength * value for value in found.color)


def emits(tree):
    """Whether any shader of a material's nodes may give off light."""
    if tree is None:
        return False
    for node in tree.nodes:
        if node.mute:
            continue
        if node.bl_idname == 'ShaderNodeEmission' or (
                node.bl_idname == 'ShaderNodeGroup' and emits(node.node_tree)):
            return True
        strength = node.inputs.get("Emission Strength")
        # Until 4.0 the colour was called otherwise.
        color = node.inputs.get("Emission Color") or node.inputs.get("Emission")
        if strength and color and (strength.is_linked or strength.default_value > 0.0) and (
                color.is_linked or max(tuple(color.default_value)[:3]) > 0.0):
            return True
    return False


def _shader_emission(shader):
    unknown = []
    strength = _value(shader.inputs["Strength"], unknown)
    color = _value(shader.inputs["Color"], unknown)
    if isinstance(color, float):
        color = (color, color, color)
    if not isinstance(strength, float):
        strength = sum(a * b for a, b in zip(strength, LUMINANCE))
    return Emission(max(strength, 0.0), tuple(max(value, 0.0) for value in color),
                    unknown[0] if unknown else None)


def irradiance(kind, power, position, direction, cone, point):
    """What arrives at `point` on a surface that faces the light, where nothing is in the way.

    `power` in watts, of a sun watts per square metre; `direction` is the way the light looks;
    `cone` = (full angle, blend) of a spot. As measured in Cycles: a sun gives its power, point and
    spot P / (4 pi d^2), an area P cos / (4 d^2) on its front side only.
    """
    if kind == "sun":
        return power
    way = vectors.subtract(point, position)
    distance2 = max(vectors.dot(way, way), 1e-12)
    along = vectors.dot(vectors.normalize(way, direction), direction)
    if kind == "area":
        return power * max(along, 0.0) / (4.0 * distance2)
    share = _cone_share(along, cone) if cone else 1.0
    return power * share / (4.0 * math.pi * distance2)


def luminance(color):
    return sum(a * b for a, b in zip(color, LUMINANCE))


def _cone_share(along, cone):
    """Cycles' spot falloff: smooth over the share `blend` of the cone, in its own slope measure."""
    angle, blend = cone
    edge = math.cos(0.5 * angle)
    if along <= edge:
        return 0.0
    step = (along - edge) / max((1.0 - edge) * blend, 1e-6)
    step = min(step, 1.0)
    return step * step * (3.0 - 2.0 * step)


def _source(socket):
    """(node, its output) that feeds an input, through reroutes; (None, None) where nothing does."""
    while socket.is_linked:
        link = socket.links[0]
        if link.from_node.bl_idname != 'NodeReroute':
            return link.from_node, link.from_socket
        socket = link.from_node.inputs[0]
    return None, None


def _value(socket, unknown):
    """A float or an RGB triple."""
    node, output = _source(socket)
    if node is None:
        return _plain(socket.default_value)
    if node.bl_idname in {'ShaderNodeValue', 'ShaderNodeRGB'}:
        return _plain(output.default_value)
    if node.bl_idname == 'ShaderNodeLightFalloff' and output.name == 'Quadratic':
        return _value(node.inputs["Strength"], unknown)
    if node.bl_idname == 'ShaderNodeMath' and node.operation in _MATHS:
        parts = [_value(node.inputs[number], unknown) for number in (0, 1)]
        if all(isinstance(part, float) for part in parts):
            result = _MATHS[node.operation](*parts)
            return min(max(result, 0.0), 1.0) if node.use_clamp else result
    unknown.append(node.name)
    return 1.0


def _plain(value):
    try:
        return tuple(float(number) for number in value)[:3]
    except TypeError:
        return float(value)
