# SPDX-License-Identifier: GPL-3.0-or-later
"""The Rest pass: where surfaces rest, whatever deforms, has no material or is an instance."""

import unittest

from blender_case import BlenderCase, blender_says

EVERYTHING = """
scene = start(40, 40)
ground()
rising = box("Rising", (-0.5, -0.5, 0), (0.5, 0.5, 0.6))
rising.location = (-1.5, 0, 0)
rising.shape_key_add(name="Basis")
up = rising.shape_key_add(name="Up")
for point in up.data:
    point.co.z += 0.5
up.value = 1.0
bare = box("Bare", (-0.5, -0.5, 0), (0.5, 0.5, 0.6))
bare.data.materials.clear()
bare.location = (1.5, 0, 0)
aside = bpy.data.collections.new("Aside")
leaf = box("Leaf", (-0.3, -0.3, 0), (0.3, 0.3, 0.3))
scene.collection.objects.unlink(leaf)
aside.objects.link(leaf)
for name, place in (("One", (-0.6, -2, 0)), ("Two", (0.6, -2, 0))):
    shown = bpy.data.objects.new(name, None)
    shown.instance_type, shown.instance_collection, shown.location = 'COLLECTION', aside, place
    scene.collection.objects.link(shown)
light("Key", 'POINT', (-2, -2, 4), energy=300, shadow_soft_size=0.3)
tools.camera((0, -7, 5), (0, 0, 0), 50)
"""

# Cards with holes stand before the ground and a box that deforms, one behind the other.
SEEN_THROUGH = """
scene = start(48, 48)
ground()
rising = box("Rising", (-0.5, -0.5, 0), (0.5, 0.5, 0.6))
rising.shape_key_add(name="Basis")
up = rising.shape_key_add(name="Up")
for point in up.data:
    point.co.z += 0.5
up.value = 1.0

def card(name, y, alpha):
    surface = tools.material(name, (0.2, 0.5, 0.1))
    made = tools.plane(name, [(-0.9, 0, -0.9), (0.9, 0, -0.9), (0.9, 0, 0.9), (-0.9, 0, 0.9)], surface)
    made.location = (0, y, 1)
    shader = surface.node_tree.nodes["Principled BSDF"]
    if isinstance(alpha, float):
        shader.inputs["Alpha"].default_value = alpha
        return surface.node_tree
    tree = surface.node_tree
    split, left = tree.nodes.new('ShaderNodeSeparateXYZ'), tree.nodes.new('ShaderNodeMath')
    tree.links.new(tree.nodes.new('ShaderNodeTexCoord').outputs["Object"], split.inputs[0])
    tree.links.new(split.outputs["X"], left.inputs[0])
    left.operation, left.inputs[1].default_value = 'LESS_THAN', -0.2
    tree.links.new(left.outputs[0], shader.inputs["Alpha"])
    return tree

card("Leaf", -1.5, "cut")
mixed = card("Mixed", -2.5, 1.0)
hole, mix = mixed.nodes.new('ShaderNodeBsdfTransparent'), mixed.nodes.new('ShaderNodeMixShader')
mix.inputs[0].default_value = 1.0
output = mixed.nodes["Material Output"]
mixed.links.new(output.inputs["Surface"].links[0].from_socket, mix.inputs[1])
mixed.links.new(hole.outputs[0], mix.inputs[2])
mixed.links.new(mix.outputs[0], output.inputs["Surface"])
light("Key", 'POINT', (-2, -4, 4), energy=300, shadow_soft_size=0.3)
tools.camera((0, -7, 2), (0, 0, 0.8), 50)
"""

GHOST = """
card("Ghost", -2.0, 0.3)
"""


class Rest(BlenderCase):
    def test_every_object_shows_where_it_rests(self):
        self.export(self.build(EVERYTHING), "--frames", "1", "--masks", "disc:5")
        document, pixels = self.document(1), self.pixels(1)
        objects = {item["name"]: item for item in document["objects"]}
        moves = {"Ground": (0, 0, 0), "Rising": (-1.5, 0, 0.5), "Bare": (1.5, 0, 0)}
        for name, move in moves.items():
            self.check_places(objects[name]["index"], move, pixels)
        corners = objects["Rising"]["rest_bounds"]
        for corner, wanted in (("min", (-0.5, -0.5, 0.0)), ("max", (0.5, 0.5, 0.6))):
            for value, other in zip(corners[corner], wanted):
                self.assertAlmostEqual(value, other, 6)
        self.assertNotIn("rest_bounds", objects["Bare"])
        self.assertEqual(objects["Bare"]["materials"], [])
        self.check_instances(objects["Leaf"], pixels)
        self.assertFalse(any("instanced" in objects[name] for name in moves))

    def test_what_is_seen_through_holes_rests_as_it_does_elsewhere(self):
        self.export(self.build(SEEN_THROUGH), "--frames", "1", "--masks", "disc:5")
        pixels = self.pixels(1)
        objects = {item["name"]: item["index"] for item in self.document(1)["objects"]}
        for name, move in (("Ground", (0, 0, 0)), ("Rising", (0, 0, 0.5)), ("Leaf", (0, -1.5, 1))):
            self.check_places(objects[name], move, pixels)
            self.assertEqual(len({one for *_, one in self.places(objects[name], pixels)}), 1)

    def test_what_is_seen_through_a_ghost_rests_as_it_does_elsewhere_or_says_nothing(self):
        shot = self.build(SEEN_THROUGH + GHOST)
        for by in ("auto", "layers"):
            self.export(shot, "--frames", "1", "--masks", "disc:5", "--masks-by", by)
            self.check_seen_through_a_ghost(self.pixels(1))

    def check_seen_through_a_ghost(self, pixels):
        objects = {item["name"]: item["index"] for item in self.document(1)["objects"]}
        picks = blender_says("bpy.app.version >= (5, 0, 0)")
        for name, move in (("Ground", (0, 0, 0)), ("Rising", (0, 0, 0.5)), ("Leaf", (0, -1.5, 1))):
            seen = self.places(objects[name], pixels)
            told = [place for place in seen if not picks or any(place[1])]
            self.assertGreater(len(told), 0.5 * len(seen))
            for position, rest, _ in told:
                for axis in range(3):
                    self.assertAlmostEqual(position[axis], rest[axis] + move[axis], 4)

    def places(self, index, pixels):
        """(position, rest, random) of every pixel of an object."""
        found = []
        for y, row in enumerate(pixels["data.IndexOB.V"]):
            for x, value in enumerate(row):
                if value == float(index):
                    found.append((
                        [pixels[f"data.Position.{axis}"][y][x] for axis in "XYZ"],
                        [pixels[f"data.Rest.{axis}"][y][x] for axis in "RGB"],
                        pixels["data.InstanceRandom.V"][y][x]))
        return found

    def check_places(self, index, move, pixels):
        seen = self.places(index, pixels)
        self.assertGreater(len(seen), 10)
        for position, rest, _ in seen:
            for axis in range(3):
                self.assertAlmostEqual(position[axis], rest[axis] + move[axis], 4)

    def check_instances(self, leaf, pixels):
        self.assertTrue(leaf["instanced"])
        left, right = set(), set()
        for position, rest, random in self.places(leaf["index"], pixels):
            side = -0.6 if position[0] < 0 else 0.6
            (left if side < 0 else right).add(random)
            self.assertAlmostEqual(position[0], rest[0] + side, 4)
            self.assertAlmostEqual(position[1], rest[1] - 2, 4)
        self.assertEqual((len(left), len(right), len(left & right)), (1, 1, 0))


if __name__ == "__main__":
    unittest.main()
