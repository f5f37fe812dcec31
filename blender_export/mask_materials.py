# SPDX-License-Identifier: GPL-3.0-or-later
"""What of the artist's materials decides where light is blocked: holes, displacement, volumes.

Masks are rendered in plain white. Where every material is opaque one white override does it. Where
some are not, the override would make cards of leaves and boxes of fog; then each material keeps its
own output, and switches to white where a view layer says so: the part that is seen through is left
out, displacement stays. Volumes go from the data as well: a ray that scatters in fog ends there, and
the surface behind it would be missing from its pixel. Cycles folds the switches away, so that layers
which do not say so render as before, bit for bit.
"""

from . import compat

# Custom properties of a view layer, and the attributes that read them.
SWITCH = "kagefude_mask"
CLEAR = "kagefude_clear"     # no fog
THROUGH = "kagefude through"  # output of node groups: share of light that passes
MOST_LEAVES = 128             # transparent surfaces behind each other
# Data passes of a view layer take a surface from an alpha of one half on; so do masks.
OPAQUE_BELOW = 0.500001
WHOLE_BELOW = 1e-6


def blocks_otherwise(material):
    """Whether the material blocks light otherwise than its undisplaced mesh would."""
    tree = material.node_tree
    output = tree.get_output_node('CYCLES') if material.use_nodes and tree else None
    if output is None:
        return False
    if output.inputs["Volume"].is_linked or not output.inputs["Surface"].is_linked:
        return True
    if output.inputs["Displacement"].is_linked and compat.displaces(material):
        return True
    return _is_seen_through(output.inputs["Surface"])


def shows(material):
    """Whether data passes surely take the material's surface where it is hit: a float or a socket of its
    tree, 1 or 0. They go on through what is less than half opaque, or through any part at random."""
    tree = material.node_tree
    output = tree.get_output_node('CYCLES')
    if output is None or not _is_seen_through(output.inputs["Surface"]):
        return 1.0
    through = _through(tree, output.inputs["Surface"])
    limit = WHOLE_BELOW if compat.picks_half_seen() else OPAQUE_BELOW
    if isinstance(through, float):
        return float(through < limit)
    return _math(tree, 'LESS_THAN', through, limit)


def is_volume_only(item):
    """Whether an object is nothing but fog, which has no surface that could block or be painted."""
    if item.type == 'VOLUME':
        return True
    materials = [slot.material for slot in item.material_slots]
    return bool(materials) and all(material and _has_volume_alone(material)
                                   for material in materials)


def caster_notes(objects):
    """What the casters' triangles do not say, one line a kind."""
    cut = sorted(item.name for item in objects if not is_volume_only(item) and any(
        slot.material and blocks_otherwise(slot.material) for slot in item.material_slots))
    return [f"casters are the meshes without the holes, fog and displacement of their materials: "
            f"{', '.join(cut)}"] if cut else []


def keep_what_blocks(view_layers, override, objects):
    """Let the view layers that carry `override` show what blocks light; returns notes.

    No layer shows fog. `objects` are all that may render. Where none of their materials blocks
    otherwise than a plain surface, all stays as it is.
    """
    materials = {slot.material for item in objects for slot in item.material_slots
                 if slot.material}
    fogs = sorted(item.name for item in objects if is_volume_only(item))
    if not fogs and not any(blocks_otherwise(material) for material in materials):
        return []
    for material in materials:
        _add_switch(material)
    for view_layer in view_layers:
        view_layer[CLEAR] = 1.0
        if view_layer.material_override == override:
            view_layer.material_override = None
            view_layer[SWITCH] = 1.0
            # Kept data would keep the switch as the layer before has it.
            view_layer.id_data.render.use_persistent_data = False
            cycles = view_layer.id_data.cycles
            cycles.transparent_max_bounces = max(cycles.transparent_max_bounces, MOST_LEAVES)
    return [f"volumes cast no shadow in the masks: {', '.join(fogs)}"] if fogs else []


def _has_volume_alone(material):
    tree = material.node_tree
    output = tree.get_output_node('CYCLES') if material.use_nodes and tree else None
    return output is not None and output.inputs["Volume"].is_linked \
        and not output.inputs["Surface"].is_linked


def _is_seen_through(socket, seen=()):
    node = _source(socket)[0]
    if node is None or node in seen:
        return False
    if node.bl_idname == 'ShaderNodeBsdfTransparent':
        return True
    if node.bl_idname == 'ShaderNodeBsdfPrincipled':
        alpha = node.inputs["Alpha"]
        return alpha.is_linked or alpha.default_value < 1.0
    inner = _group_result(node)
    if inner is not None and _is_seen_through(inner, (*seen, node)):
        return True
    return any(_is_seen_through(place, (*seen, node)) for place in node.inputs
               if place.type == 'SHADER')


def _add_switch(material):
    """Make the material white and cut where the view layer asks for it."""
    tree = material.node_tree
    output = tree.get_output_node('CYCLES') if material.use_nodes and tree else None
    if output is None:
        return
    ask = _ask(tree, SWITCH)
    surface = output.inputs["Surface"]
    through = _through(tree, surface) if surface.is_linked else 1.0
    _switch(tree, ask, surface, _mask_surface(tree, through))
    if output.inputs["Volume"].is_linked:
        _switch(tree, _ask(tree, CLEAR), output.inputs["Volume"], None)
    bumps = output.inputs["Displacement"]
    if bumps.is_linked and not compat.displaces(material):
        # They bend shading only, and a mask knows no shading.
        flat = tree.nodes.new('ShaderNodeVectorMath')
        flat.operation = 'SCALE'
        tree.links.new(bumps.links[0].from_socket, flat.inputs[0])
        tree.links.new(_math(tree, 'SUBTRACT', 1.0, ask.outputs["Fac"]), flat.inputs["Scale"])
        tree.links.new(flat.outputs[0], bumps)


def _ask(tree, name):
    node = tree.nodes.new('ShaderNodeAttribute')
    node.attribute_type, node.attribute_name = 'VIEW_LAYER', name
    return node


def _switch(tree, ask, place, instead):
    mix = tree.nodes.new('ShaderNodeMixShader')
    tree.links.new(ask.outputs["Fac"], mix.inputs[0])
    if place.is_linked:
        tree.links.new(place.links[0].from_socket, mix.inputs[1])
    if instead is not None:
        tree.links.new(instead, mix.inputs[2])
    tree.links.new(mix.outputs[0], place)


def _mask_surface(tree, through):
    white = tree.nodes.new('ShaderNodeBsdfDiffuse')
    white.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    if isinstance(through, float) and through < OPAQUE_BELOW:
        return white.outputs[0]
    hole = tree.nodes.new('ShaderNodeBsdfTransparent')
    hole.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    if isinstance(through, float):
        return hole.outputs[0]
    mix = tree.nodes.new('ShaderNodeMixShader')
    tree.links.new(_math(tree, 'LESS_THAN', through, OPAQUE_BELOW), mix.inputs[0])
    tree.links.new(hole.outputs[0], mix.inputs[1])
    tree.links.new(white.outputs[0], mix.inputs[2])
    return mix.outputs[0]


def _through(tree, socket):
    """Share of light that passes what feeds a shader input: a float, or a socket of `tree`."""
    node, output = _source(socket)
    kind = node.bl_idname if node and not node.mute else None
    if kind == 'ShaderNodeBsdfTransparent':
        return _grey(tree, node.inputs["Color"])
    if kind == 'ShaderNodeBsdfPrincipled':
        return _math(tree, 'SUBTRACT', 1.0, _number(node.inputs["Alpha"]))
    if kind == 'ShaderNodeMixShader':
        first, second = (_through(tree, node.inputs[number]) for number in (1, 2))
        rise = _math(tree, 'SUBTRACT', second, first)
        return _math(tree, 'ADD', first, _math(tree, 'MULTIPLY', rise, _number(node.inputs[0])))
    if kind == 'ShaderNodeAddShader':
        return _math(tree, 'ADD', *(_through(tree, node.inputs[number]) for number in (0, 1)))
    inner = _group_result(node, output) if kind else None
    if inner is None:
        return 0.0
    if THROUGH in node.outputs:  # another material uses the group as well
        return node.outputs[THROUGH]
    result = _through(node.node_tree, inner)
    if isinstance(result, float):
        return result
    compat.add_number_output(node.node_tree, THROUGH)
    return _bring_out(node, result)


def _bring_out(node, result):
    """Give a group's value to the tree that the group's node stands in."""
    group = next(inner for inner in node.node_tree.nodes
                 if inner.bl_idname == 'NodeGroupOutput' and inner.is_active_output)
    node.node_tree.links.new(result, group.inputs[THROUGH])
    return node.outputs[THROUGH]


def _group_result(node, output=None):
    """The input of a group's own output node behind one of the group node's shader outputs."""
    if node is None or node.bl_idname != 'ShaderNodeGroup' or node.node_tree is None:
        return None
    group = next((inner for inner in node.node_tree.nodes
                  if inner.bl_idname == 'NodeGroupOutput' and inner.is_active_output), None)
    if group is None:
        return None
    shaders = [place for place in group.inputs if place.type == 'SHADER']
    named = [place for place in shaders if output and place.identifier == output.identifier]
    return next(iter(named or shaders), None)


def _source(socket):
    while socket.is_linked:
        link = socket.links[0]
        if link.from_node.bl_idname != 'NodeReroute':
            return link.from_node, link.from_socket
        socket = link.from_node.inputs[0]
    return None, None


def _number(socket):
    return _source(socket)[1] or float(socket.default_value)


def _grey(tree, socket):
    color = _source(socket)[1]
    if color is None:
        return sum(socket.default_value[:3]) / 3.0
    grey = tree.nodes.new('ShaderNodeRGBToBW')
    tree.links.new(color, grey.inputs[0])
    return grey.outputs[0]


_PLAIN = {'ADD': lambda a, b: a + b, 'SUBTRACT': lambda a, b: a - b, 'MULTIPLY': lambda a, b: a * b}


def _math(tree, operation, first, second):
    if isinstance(first, float) and isinstance(second, float):
        return _PLAIN[operation](first, second)
    node = tree.nodes.new('ShaderNodeMath')
    node.operation = operation
    for place, value in zip(node.inputs, (first, second)):
        if isinstance(value, float):
            place.default_value = value
        else:
            tree.links.new(value, place)
    return node.outputs[0]
