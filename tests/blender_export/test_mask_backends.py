# SPDX-License-Identifier: GPL-3.0-or-later
"""Every way to render masks against view layers, pixel by pixel, and what falls back to them."""

import unittest

from blender_case import BlenderCase, blender_says
from exr_pixels import read_exr

# A ball shaded smooth, boxes, a thin rod and all kinds of light; one light moves in frame 2. The
# camera stands askew, or a shadow's edge would run along a whole row of pixels' centres.
SCENE = """
start(96, 72)
ground()
box("Box", (0.3, -0.8, 0), (1.1, 0.0, 1.2))
box("Slab", (-1.9, 0.8, 1.0), (0.2, 1.5, 1.1))
tools.tube("Rod", [[(-1.5, -1.5, 0.0, 0.04), (-1.2, -1.2, 2.0, 0.04)]], GREY)
ball = tools.revolve("Ball", [(0.6 * math.sin(math.pi * k / 24), 0.6 - 0.6 * math.cos(math.pi * k / 24))
                              for k in range(25)], GREY, 36)
ball.location = (-0.9, -0.4, 0.0)
key(light("Point", 'POINT', (-3, -2, 4), energy=500, shadow_soft_size=0.3), "location",
    f1=(-3, -2, 4), f2=(-2, -3, 4))
light("Spot", 'SPOT', (3, -2.5, 4.5), (38, 0, 45), energy=800, shadow_soft_size=0.25,
      spot_size=math.radians(40), spot_blend=0.2)
light("Sun", 'SUN', (0, 0, 5), (40, 0, -60), energy=2, angle=math.radians(6))
light("Area", 'AREA', (0, 3.5, 2.0), (-62, 0, 0), energy=300, shape='RECTANGLE', size=1.5, size_y=0.3)
tools.camera((0.23, -6.5, 4.2), (0.0, 0.0, 0.5), 50)
"""


def bpy_has_light_linking():
    return blender_says("hasattr(bpy.types.Object, 'light_linking') or "
                        "'light_linking' in bpy.types.Object.bl_rna.properties")


def has_raycast():
    return blender_says("hasattr(bpy.types, 'ShaderNodeRaycast')")


def rays():
    """The rays of this Blender's shader nodes."""
    return "raycast" if has_raycast() else "occlusion"


class MaskBackends(BlenderCase):
    def masks(self, output, frame=1):
        """({layer: values}, {light: backend}) of an exported frame."""
        pixels, document = self.pixels(frame, output), self.document(frame, output)
        lights = [light for light in document["lights"] if "masks" in light]
        layers = {sample["layer"]: [value for row in pixels[sample["layer"] + ".V"] for value in row]
                  for light in lights for sample in light["masks"]["samples"]}
        return layers, {light["name"]: light["masks"]["by"] for light in lights}

    def exported(self, shot, by, *words, frame=1):
        said = self.export(shot, "--masks", "disc:5", "--masks-by", by, *words,
                           output=f"{by}/s.####.exr")
        layers, ways = self.masks(f"{by}/s", frame)
        return layers, ways, said

    def assert_close(self, found, wanted, share):
        """Only 0 and 1, and in at most `share` of a mask's pixels another value than wanted."""
        self.assertEqual(set(found), set(wanted))
        for layer, values in wanted.items():
            self.assertEqual(set(found[layer]), {0.0, 1.0}, layer)
            wrong = sum(a != b for a, b in zip(found[layer], values))
            self.assertLessEqual(wrong, share * len(values), layer)

    def test_every_way_gives_the_masks_of_layers_in_every_frame(self):
        shot = self.build(SCENE)
        frames = ("--frames", "1-2")
        _, ways, _ = self.exported(shot, "layers", *frames)
        self.assertEqual(set(ways.values()), {"layers"})
        _, ways, said = self.exported(shot, rays(), *frames)
        self.assertEqual(set(ways.values()), {rays()})
        self.assertEqual(self.notes(said), [])
        _, ways, _ = self.exported(shot, "groups", *frames)
        self.assertEqual(set(ways.values()), {"groups"})
        for frame in (1, 2):
            wanted, _ = self.masks("layers/s", frame)
            # Rays differ where smooth faces turn away, groups where an edge goes through a pixel's
            # centre, round which their samples lie.
            self.assert_close(self.masks(f"{rays()}/s", frame)[0], wanted, 1e-3)
            self.assert_close(self.masks("groups/s", frame)[0], wanted, 1e-3)
            self.assert_same_depth_maps(frame)
        self.assertNotEqual(self.masks(f"{rays()}/s", 1)[0]["mask.Point.0"],
                            self.masks(f"{rays()}/s", 2)[0]["mask.Point.0"])

    def assert_same_depth_maps(self, frame):
        """By rays and by layers; their views differ a little, as what the masks hide does."""
        for light in self.document(frame, "layers/s")["lights"]:
            one, other = ([value for row in read_exr(self.path(f"{way}/{light['depth_map']['file']}"))[0]
                           [light["depth_map"]["channel"]] for value in row]
                          for way in ("layers", rays()))
            alike = sum(abs(a - b) < 0.02 * b for a, b in zip(one, other))
            self.assertGreater(alike, 0.9 * len(one), light["name"])

    def test_auto_takes_layers_where_there_is_no_raycast_node(self):
        said = self.export(self.build(SCENE + """
for name in ("Rod", "Ball"):
    bpy.data.objects.remove(bpy.data.objects[name])
"""), "--masks", "disc:5", "--light", "Point")
        self.assertEqual(self.masks("out/s")[1], {"Point": "raycast" if has_raycast() else "layers"})
        self.assertEqual(self.notes(said), [])

    def test_auto_takes_layers_where_coarse_faces_are_shaded_smooth(self):
        said = self.export(self.build(SCENE), "--masks", "disc:5", "--light", "Point")
        self.assertEqual(self.masks("out/s")[1], {"Point": "layers"})
        self.assertEqual(self.notes(said), [
            "the masks of light 'Point' are rendered by layers instead of raycast: object 'Ball' has "
            "coarse faces that are shaded smooth, where rays and lamps see different things"]
            if has_raycast() else [])

    def test_faces_without_a_material_and_bumps_have_the_masks_of_layers(self):
        """Nothing can be put into no material, and a bump turns a normal that no mask may know."""
        for lines in (
                """
bare = box("Bare", (1.5, -1.8, 0), (2.2, -1.0, 0.8))
bare.data.materials.clear()
""",
                """
half = box("Half", (1.5, -1.8, 0), (2.2, -1.0, 0.8))
half.data.materials.append(None)
for polygon in half.data.polygons:
    polygon.material_index = polygon.index % 2
""",
                """
bumpy = tools.material("Bumpy", (0, 1, 0))
nodes, links = bumpy.node_tree.nodes, bumpy.node_tree.links
output = next(node for node in nodes if node.bl_idname == 'ShaderNodeOutputMaterial')
bump, noise = nodes.new('ShaderNodeDisplacement'), nodes.new('ShaderNodeTexNoise')
bump.inputs["Scale"].default_value = 3.0
links.new(noise.outputs["Fac"], bump.inputs["Height"])
links.new(bump.outputs[0], output.inputs["Displacement"])
if hasattr(bumpy, "displacement_method"):
    bumpy.displacement_method = 'BUMP'
else:
    bumpy.cycles.displacement_method = 'BUMP'
box("Bumpy", (1.5, -1.8, 0), (2.2, -1.0, 0.8), bumpy)
"""):
            shot = self.build(SCENE + lines)
            wanted, _, _ = self.exported(shot, "layers", "--light", "Point")
            found, ways, _ = self.exported(shot, rays(), "--light", "Point")
            self.assertEqual(set(ways.values()), {rays()})
            self.assert_close(found, wanted, 1e-3)

    def ways(self, lines, by=None):
        """({light: backend}, notes) of the scene with more lines, by rays."""
        shot = self.build(SCENE + lines)
        said = self.export(shot, "--masks", "disc:5", "--masks-by", by or rays(), "--light", "Spot",
                           "--light", "Sun")
        return self.masks("out/s")[1], [note for note in self.notes(said) if "masks of light" in note]

    def assert_layers(self, lines, words, lights=("Spot", "Sun"), by=None):
        ways, notes = self.ways(lines, by)
        self.assertEqual({light for light, way in ways.items() if way == "layers"}, set(lights))
        self.assertEqual(len(notes), len(lights), notes)
        for light, note in zip(sorted(lights), notes):
            self.assertIn(f"light '{light}' are rendered by layers", note)
            self.assertIn(words, note)

    def test_what_can_be_seen_through_falls_back(self):
        self.assert_layers("""
leaf = tools.material("Leaf", (0, 1, 0))
leaf.node_tree.nodes["Principled BSDF"].inputs["Alpha"].default_value = 0.5
box("Tree", (2, 2, 0), (3, 3, 1), leaf)
""", "object 'Tree' has the material 'Leaf', which has holes")

    def test_displacement_falls_back(self):
        self.assert_layers("""
bark = tools.material("Bark", (0, 1, 0))
nodes = bark.node_tree.nodes
output = next(node for node in nodes if node.bl_idname == 'ShaderNodeOutputMaterial')
bark.node_tree.links.new(nodes.new('ShaderNodeDisplacement').outputs[0], output.inputs["Displacement"])
if hasattr(bark, "displacement_method"):
    bark.displacement_method = 'DISPLACEMENT'
else:
    bark.cycles.displacement_method = 'DISPLACEMENT'
box("Tree", (2, 2, 0), (3, 3, 1), bark)
""", "'Bark', which has holes, displacement")

    def test_hair_and_volumes_fall_back(self):
        self.assert_layers("""
fur = box("Fur", (2, 2, 0), (3, 3, 1))
bpy.context.view_layer.objects.active = fur
bpy.ops.object.particle_system_add()
fur.particle_systems[0].settings.type = 'HAIR'
fur.particle_systems[0].settings.count = 10
""", "object 'Fur' has hair")
        self.assert_layers("""
fog = bpy.data.objects.new("Fog", bpy.data.volumes.new("Fog"))
bpy.context.scene.collection.objects.link(fog)
""", "object 'Fog' is a volume")

    def test_light_linking_falls_back_for_that_light_alone(self):
        self.assert_layers("""
if hasattr(bpy.data.objects["Spot"], "light_linking"):
    bpy.data.objects["Spot"].light_linking.blocker_collection = bpy.data.collections.new("Blockers")
    bpy.data.objects["Spot"].light_linking.blocker_collection.objects.link(bpy.data.objects["Box"])
""", "light linking", ("Spot",) if bpy_has_light_linking() else ())

    def test_what_this_blender_lacks_falls_back_and_is_said(self):
        if has_raycast():
            self.assert_layers("", "Ambient Occlusion node cannot be aimed", by="occlusion")
        else:
            self.assert_layers("", "no Raycast node (5.1 has)", by="raycast")

    def test_objects_that_cast_no_shadow_fall_back(self):
        """Rays that pass them start anew behind them, and missed 14 of 6912 pixels."""
        shot = self.build(SCENE + """
for name in ("Slab", "Ball"):
    bpy.data.objects[name].visible_shadow = False
bpy.data.objects["Box"].visible_camera = False
""")
        wanted, _, _ = self.exported(shot, "layers")
        found, ways, _ = self.exported(shot, rays())
        self.assertEqual(set(ways.values()), {"layers"})
        self.assert_close(found, wanted, 0)

    def test_traced_shadows_in_place_of_masks(self):
        shot = self.build(SCENE)
        self.export(shot, "--masks", "trace:16", "--truth", "16", "--light", "Point")
        light = self.document(1)["lights"][0]
        self.assertNotIn("masks", light)
        self.assertEqual(light["traced"], {"layer": "traced.Point", "samples": 16})
        pixels = self.pixels(1)
        self.assertEqual(pixels["traced.Point.V"], pixels["truth.Point.V"])
        self.assertGreater(len({value for row in pixels["traced.Point.V"] for value in row}), 5)


if __name__ == "__main__":
    unittest.main()
