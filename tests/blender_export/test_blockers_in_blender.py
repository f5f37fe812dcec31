# SPDX-License-Identifier: GPL-3.0-or-later
"""What blocks light in the masks: as in the artist's own materials, held against traced visibility."""

import unittest

from blender_case import BlenderCase

# A card over a ground, seen from above, under a small lamp: its shadow lies on the ground beside it.
STAGE = """
scene = start(48, 48)
ground()
card = tools.plane("Card", [(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)], tools.material("Leaf", (0.2, 0.5, 0.1)))
light("Key", 'POINT', (-3, 0, 5), energy=300, shadow_soft_size=0.1)
tools.camera((0, 0, 12), (0, 0, 0), 50)
leaf = card.active_material.node_tree
shader, output = leaf.nodes["Principled BSDF"], leaf.nodes["Material Output"]
"""

# A hole in the card, on the side of positive x.
HOLE = """
place = leaf.nodes.new('ShaderNodeTexCoord')
split = leaf.nodes.new('ShaderNodeSeparateXYZ')
left = leaf.nodes.new('ShaderNodeMath')
left.operation = 'LESS_THAN'
leaf.links.new(place.outputs["Object"], split.inputs[0])
leaf.links.new(split.outputs["X"], left.inputs[0])
left.inputs[1].default_value = 0.0
"""

ALPHA = HOLE + 'leaf.links.new(left.outputs[0], shader.inputs["Alpha"])\n'

MIX = HOLE + """
hole, mix = leaf.nodes.new('ShaderNodeBsdfTransparent'), leaf.nodes.new('ShaderNodeMixShader')
leaf.links.new(left.outputs[0], mix.inputs[0])
leaf.links.new(hole.outputs[0], mix.inputs[1])
leaf.links.new(shader.outputs[0], mix.inputs[2])
leaf.links.new(mix.outputs[0], output.inputs["Surface"])
"""

GROUP = HOLE + """
inside = bpy.data.node_groups.new("Cut", 'ShaderNodeTree')
if hasattr(inside, "interface"):
    inside.interface.new_socket("Left", in_out='INPUT', socket_type='NodeSocketFloat')
    inside.interface.new_socket("Shader", in_out='OUTPUT', socket_type='NodeSocketShader')
else:
    inside.inputs.new('NodeSocketFloat', "Left")
    inside.outputs.new('NodeSocketShader', "Shader")
begin, end = inside.nodes.new('NodeGroupInput'), inside.nodes.new('NodeGroupOutput')
white, hole, mix = (inside.nodes.new(kind) for kind in
                    ('ShaderNodeBsdfDiffuse', 'ShaderNodeBsdfTransparent', 'ShaderNodeMixShader'))
inside.links.new(begin.outputs[0], mix.inputs[0])
inside.links.new(hole.outputs[0], mix.inputs[1])
inside.links.new(white.outputs[0], mix.inputs[2])
inside.links.new(mix.outputs[0], end.inputs[0])
group = leaf.nodes.new('ShaderNodeGroup')
group.node_tree = inside
leaf.links.new(left.outputs[0], group.inputs[0])
leaf.links.new(group.outputs[0], output.inputs["Surface"])
card.data.materials.append(card.active_material.copy())
"""

FOG = """
fog = leaf.nodes.new('ShaderNodeVolumePrincipled')
fog.inputs["Density"].default_value = 3.0
leaf.links.new(fog.outputs[0], output.inputs["Volume"])
leaf.links.remove(output.inputs["Surface"].links[0])
card.data.materials[0] = GREY
box("Fog", (-1, -1, 0.5), (1, 1, 1.5), bpy.data.materials["Leaf"])
bpy.data.objects.remove(card)
"""

MOVED = """
bpy.context.view_layer.objects.active = card
up = leaf.nodes.new('ShaderNodeCombineXYZ')
up.inputs[1].default_value = 2.0
leaf.links.new(up.outputs[0], output.inputs["Displacement"])
settings = card.active_material
if hasattr(settings, "displacement_method"): settings.displacement_method = 'DISPLACEMENT'
else: settings.cycles.displacement_method = 'DISPLACEMENT'
"""


class Blockers(BlenderCase):
    def export_masks(self, lines, number=1):
        """(first mask, its lamp's place, all pixels, notes) of the stage with more lines."""
        name = f"out{number}/s"
        said = self.export(self.build(STAGE + lines, f"case{number}.blend"), "--frames", "1",
                           "--masks", "line:2", output=name + ".####.exr")
        pixels = self.pixels(1, name)
        sample = self.document(1, name)["lights"][0]["masks"]["samples"][0]
        return pixels[sample["layer"] + ".V"], sample["position"], pixels, self.notes(said)

    def check_shadow(self, lines, number, low, high):
        """The ground is hidden exactly where the way to the lamp meets x, y from low to high at z = 1."""
        mask, lamp, pixels, _ = self.export_masks(lines, number)
        hidden = 0
        for row, values in enumerate(mask):
            for column, value in enumerate(values):
                self.assertIn(value, (0.0, 1.0))
                place = [pixels[f"data.Position.{axis}"][row][column] for axis in "XYZ"]
                if place[2] > 0.5:
                    self.assertTrue(low[0] < place[0] < high[0] and low[1] < place[1] < high[1])
                    continue
                met = [p + (a - p) / lamp[2] for p, a in zip(place, lamp)][:2]
                inside = min(min(m - l, h - m) for m, l, h in zip(met, low, high))
                if abs(inside) > 0.01:
                    self.assertEqual(value, float(inside < 0.0), (row, column))
                hidden += value == 0.0
        self.assertGreater(hidden, 30)

    def test_a_whole_card_casts_itself(self):
        self.check_shadow("", 1, (-1, -1), (1, 1))

    def test_cut_cards_cast_what_is_left_of_them(self):
        for number, lines in enumerate((ALPHA, MIX, GROUP), 1):
            with self.subTest(number):
                self.check_shadow(lines, number, (-1, -1), (0, 1))

    def test_displaced_surfaces_cast_where_they_are(self):
        self.check_shadow(MOVED, 1, (-1, 1), (1, 3))

    def test_fog_is_no_box_and_opaque_things_keep_their_masks_beside_it(self):
        mask, _, pixels, notes = self.export_masks(FOG)
        # Nor does it hide or darken what the data shows behind it.
        self.assertLess(max(abs(z) for row in pixels["data.Position.Z"] for z in row), 1e-5)
        self.assertEqual(len({z for row in pixels["data.Depth.V"] for z in row}), 1)
        reds = {red for row in pixels["data.DiffCol.R"] for red in row}
        # A newer Principled shader keeps a part that falls with the angle for its gloss.
        self.assertTrue(0.48 < min(reds) and max(reds) < 0.501)
        self.assertEqual({value for row in mask for value in row}, {1.0})
        self.assertIn("volumes cast no shadow in the masks: Fog", notes)
        beside = FOG.replace("bpy.data.objects.remove(card)", "")
        self.check_shadow(beside, 2, (-1, -1), (1, 1))


if __name__ == "__main__":
    unittest.main()
