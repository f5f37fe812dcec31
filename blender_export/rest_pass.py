# SPDX-License-Identifier: GPL-3.0-or-later
"""The Rest pass: where each pixel's surface point lies in its object while nothing deforms it.

Strokes laid on rest positions stay on skin that walks. Meshes that deform have them as an attribute,
which Blender makes when asked to (`add_rest_position_attribute`: before shape keys and modifiers; it
survives subdivision). What does not deform rests where it is seen, in its own space. Both hold for
instances too, which share their object's space; so that they do not repeat each other, a number that
differs from instance to instance travels along (Object Info's Random).

The node group that writes both AOVs stands in each of the artist's materials, so holes and
displacement are as they render. Cycles adds up what a ray meets on its way to the surface that its
other passes take; so what may not be that writes 0. Materials and attributes are changed in the exporting Blender only,
which never saves.
"""

from array import array

import bpy

from . import compat, mask_materials

REST, RANDOM = "Rest", "InstanceRandom"
FLAG = "kagefude_rest"         # custom property of an object: it has the attribute
ATTRIBUTE = "rest_position"
SHOWS = "Shows"                # input of the node group: 1 where the surface is sure to be the pixel's
PLAIN = "kagefude plain"       # material of faces that have none, which renders as none does

# Modifiers that move what is there. Others keep places or make new geometry.
DEFORMING = {
    'ARMATURE', 'CAST', 'CLOTH', 'CORRECTIVE_SMOOTH', 'CURVE', 'DISPLACE', 'HOOK',
    'LAPLACIANDEFORM', 'LAPLACIANSMOOTH', 'LATTICE', 'MESH_CACHE', 'MESH_DEFORM',
    'MESH_SEQUENCE_CACHE', 'NODES', 'SHRINKWRAP', 'SIMPLE_DEFORM', 'SMOOTH', 'SOFT_BODY',
    'SURFACE_DEFORM', 'WARP', 'WAVE'}


def deforms(item):
    """Whether an object is a mesh whose points shape keys or modifiers move."""
    if item.type != 'MESH':
        return False
    return item.data.shape_keys is not None or any(
        modifier.type in DEFORMING and modifier.show_render for modifier in item.modifiers)


def prepare(objects):
    """Let every object show where it rests; returns the AOVs that hold it, as (name, type)."""
    group = _group()
    for item in objects:
        _give_materials(item)
        if deforms(item):
            item.add_rest_position_attribute = True
            item[FLAG] = 1.0
    for material in {slot.material for item in objects for slot in item.material_slots}:
        if material and material.use_nodes and material.node_tree:
            _put_into(material, group)
    return [(REST, 'COLOR'), (RANDOM, 'VALUE')]


def _put_into(material, group):
    tree = material.node_tree
    node = tree.nodes.new('ShaderNodeGroup')
    node.node_tree = group
    shows = mask_materials.shows(material)
    if isinstance(shows, float):
        node.inputs[SHOWS].default_value = shows
    else:
        tree.links.new(shows, node.inputs[SHOWS])


def bounds(item):
    """(lowest, highest) corner of a deforming mesh's points at rest in object space; else None."""
    item = item.original
    if not deforms(item) or not item.data.vertices:
        return None
    keys = item.data.shape_keys
    points = keys.reference_key.data if keys else item.data.vertices
    places = array('f', [0.0]) * (3 * len(points))
    points.foreach_get("co", places)
    return tuple(tuple(pick(places[axis::3]) for axis in range(3)) for pick in (min, max))


def _give_materials(item):
    """Nothing can be written for a face without a material."""
    slots = getattr(item.data, "materials", None)
    if slots is None or item.type == 'VOLUME':
        return
    if not item.material_slots:
        slots.append(_plain())
    for slot in item.material_slots:
        if slot.material is None:
            slot.material = _plain()


def _plain():
    material = bpy.data.materials.get(PLAIN)
    if material is None:
        material = bpy.data.materials.new(PLAIN)
        material.use_nodes = True
        nodes = material.node_tree.nodes
        nodes.clear()
        shader = nodes.new('ShaderNodeBsdfDiffuse')
        shader.inputs["Color"].default_value = (0.8, 0.8, 0.8, 1.0)
        material.node_tree.links.new(shader.outputs[0],
                                     nodes.new('ShaderNodeOutputMaterial').inputs["Surface"])
    return material


def _group():
    """Rest is flag * attribute + (1 - flag) * place: exactly one of the two, where the surface shows."""
    tree = bpy.data.node_groups.new("kagefude rest", 'ShaderNodeTree')
    compat.add_number_input(tree, SHOWS)
    new, link = tree.nodes.new, tree.links.new
    shows = new('NodeGroupInput').outputs[SHOWS]
    flag, rest = new('ShaderNodeAttribute'), new('ShaderNodeAttribute')
    flag.attribute_type, flag.attribute_name = 'OBJECT', FLAG
    rest.attribute_type, rest.attribute_name = 'GEOMETRY', ATTRIBUTE
    seen = new('ShaderNodeTexCoord').outputs["Object"]
    not_flag = new('ShaderNodeMath')
    not_flag.operation = 'SUBTRACT'
    not_flag.inputs[0].default_value = 1.0
    link(flag.outputs["Fac"], not_flag.inputs[1])
    total = new('ShaderNodeVectorMath')
    total.operation = 'ADD'
    for place, factor, vector in ((0, flag.outputs["Fac"], rest.outputs["Vector"]),
                                  (1, not_flag.outputs[0], seen)):
        part = new('ShaderNodeVectorMath')
        part.operation = 'SCALE'
        link(vector, part.inputs[0])
        link(factor, part.inputs["Scale"])
        link(part.outputs[0], total.inputs[place])
    shown, random = new('ShaderNodeVectorMath'), new('ShaderNodeMath')
    shown.operation, random.operation = 'SCALE', 'MULTIPLY'
    link(total.outputs[0], shown.inputs[0])
    link(shows, shown.inputs["Scale"])
    link(shown.outputs[0], _aov(tree, REST).inputs["Color"])
    link(new('ShaderNodeObjectInfo').outputs["Random"], random.inputs[0])
    link(shows, random.inputs[1])
    link(random.outputs[0], _aov(tree, RANDOM).inputs["Value"])
    return tree


def _aov(tree, name):
    node = tree.nodes.new('ShaderNodeOutputAOV')
    # The AOV's name was the node's own until 4.2.
    if hasattr(node, "aov_name"):
        node.aov_name = name
    else:
        node.name = name
    return node
