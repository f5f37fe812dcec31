# SPDX-License-Identifier: GPL-3.0-or-later
"""What the exporter asks each Blender, with stand-ins for what the versions offer."""

import importlib.util
import math
import os
import sys
import unittest
from types import SimpleNamespace as Fake
from unittest import mock

import paths


class Node:
    """A compositor node with as many inputs as are asked for."""

    def __init__(self, kind, version):
        self.kind, self.outputs, self.format = kind, ["first"], Fake(
            file_format="", color_depth="", exr_codec="")
        self.inputs = ["socket 0", "socket 1"]
        if kind != 'CompositorNodeOutputFile':
            return
        if version >= (5, 0, 0):
            self.format.media_type, self.format.use_exr_interleave = "IMAGE", False
            self.directory = self.file_name = ""
            self.items, self.inputs = [], ["extension"]
            self.file_output_items = Fake(new=self._new_item)
        else:
            self.base_path, self.inputs = "", ["Image"]
            self.layer_slots = Slots(self)

    def _new_item(self, kind, name):
        self.items.append(Fake(kind=kind, name=name, vector_socket_dimensions=None))
        self.inputs.insert(-1, name)
        return self.items[-1]


class Slots(list):
    def __init__(self, node):
        super().__init__([Fake(name="Image")])
        self.node = node

    def new(self, name):
        self.append(Fake(name=name))
        self.node.inputs.append(name)


class Tree:
    def __init__(self, version):
        self.made, self.joined = [], []
        self.nodes = Fake(new=lambda kind: self.made.append(Node(kind, version)) or self.made[-1],
                          clear=self.made.clear)
        self.links = Fake(new=lambda start, end: self.joined.append((start, end)))


def blender(version):
    """The part of bpy that the module looks at, as this version has it."""
    types = Fake() if version >= (5, 0, 0) else Fake(CompositorNodeMath=object)
    groups = Fake(new=lambda name, kind: Tree(version))
    return Fake(app=Fake(version=version), types=types, data=Fake(node_groups=groups))


def scene_of(version):
    render = Fake(compositor_device='GPU', compositor_precision='AUTO') \
        if version >= (4, 2, 0) else Fake()
    if version >= (5, 0, 0):
        return Fake(name="scene", render=render, compositing_node_group="the artist's")
    return Fake(name="scene", render=render, use_nodes=False, node_tree=Tree(version))


def compat_of(version):
    """The module as this Blender would load it; nothing else gets to see it."""
    path = os.path.join(paths.REPOSITORY, "blender_export", "compat.py")
    spec = importlib.util.spec_from_file_location("compat_under_test", path)
    module = importlib.util.module_from_spec(spec)
    with mock.patch.dict(sys.modules, {"bpy": blender(version)}):
        spec.loader.exec_module(module)
    return module


OLD, MIDDLE, NEW = (3, 4, 1), (4, 3, 2), (5, 2, 2)


class Masks(unittest.TestCase):
    def test_the_shadow_pass_is_read_only_where_cycles_fills_it(self):
        for version, wanted in ((OLD, ("Shadow", None)), ((3, 5, 0), ("DiffDir", 0.0)),
                                (MIDDLE, ("DiffDir", 0.0)), (NEW, ("DiffDir", 0.0))):
            layer = Fake(use_pass_shadow=False, use_pass_diffuse_direct=False)
            self.assertEqual(compat_of(version).enable_mask_pass(layer), wanted)
            self.assertEqual(layer.use_pass_shadow, wanted[0] == "Shadow")
            self.assertEqual(layer.use_pass_diffuse_direct, wanted[0] == "DiffDir")

    def test_passes_of_both_families_have_one_name(self):
        compat = compat_of(NEW)
        old = [Fake(enabled=True, name="DiffDir"), Fake(enabled=False, name="IndexOB")]
        new = [Fake(enabled=True, name="Diffuse Direct"), Fake(enabled=True, name="Object Index")]
        self.assertIs(compat.output_socket(Fake(outputs=old), "DiffDir"), old[0])
        self.assertIs(compat.output_socket(Fake(outputs=new), "DiffDir"), new[0])
        self.assertIs(compat.output_socket(Fake(outputs=new), "IndexOB"), new[1])
        self.assertIsNone(compat.output_socket(Fake(outputs=old), "IndexOB"))
        self.assertEqual(compat.pass_name("Position"), "Position")


class Lights(unittest.TestCase):
    def test_cycles_own_switch_of_shadows_rules_while_there_is_one(self):
        compat = compat_of(NEW)
        for light, wanted in (
                (Fake(use_shadow=False, cycles=Fake(cast_shadow=True)), True),
                (Fake(use_shadow=True, cycles=Fake(cast_shadow=False)), False),
                (Fake(use_shadow=False, cycles=Fake()), False), (Fake(use_shadow=True), True)):
            self.assertEqual(compat.casts_shadow(light), wanted)
            compat.set_casts_shadow(light, not wanted)
            self.assertEqual(compat.casts_shadow(light), not wanted)

    def test_linking_is_copied_where_lights_have_it(self):
        compat = compat_of(MIDDLE)
        source = Fake(light_linking=Fake(receiver_collection="a", blocker_collection="b"))
        lamp = Fake(light_linking=Fake(receiver_collection=None, blocker_collection=None))
        compat.copy_light_linking(source, lamp)
        self.assertEqual(lamp.light_linking, source.light_linking)
        compat.copy_light_linking(Fake(), Fake())

    def test_energy_and_color_of_lights_without_the_new_factors_are_their_own(self):
        light = Fake(energy=12.0, color=(1.0, 0.5, 0.25))
        self.assertEqual(compat_of(OLD).light_output(light, "point", 0.3), (12.0, (1.0, 0.5, 0.25)))

    def test_an_area_light_of_4_0_is_one_of_more_watts(self):
        """Radiance of a white plane that it faces, as measured in 3.4.1, 4.3.2 and 5.2.2."""
        light = Fake(energy=60.0, color=(1.0, 1.0, 1.0))
        old, *new = (compat_of(version).light_output(light, "area", 0.05)[0]
                     for version in (OLD, MIDDLE, NEW))
        self.assertEqual(old, 60.0)
        for watts in new:
            self.assertAlmostEqual(watts / old, 5.0669 / 3.9793, 3)

    def test_exposure_temperature_and_size_count(self):
        compat = compat_of(NEW)
        light = Fake(energy=10.0, color=(1.0, 0.5, 1.0), exposure=2.0, use_temperature=True,
                     temperature_color=(2.0, 1.0, 0.5), normalize=True)
        self.assertEqual(compat.light_output(light, "point", 1.0), (40.0, (2.0, 0.5, 0.5)))
        light.normalize, light.exposure = False, 0.0
        # Ratios measured in Blender 5.2.2: point of radius 0.5, none, area 0.5 x 0.6, sun of 40 degrees.
        for kind, radius, ratio in (("point", 0.5, 3.141593), ("spot", 0.0, 4.0),
                                    ("area", math.sqrt(0.3 / math.pi), 0.3 * 4.0 / math.pi),
                                    ("sun", math.tan(math.radians(20)), 0.3675), ("sun", 0.0, 1.0)):
            self.assertAlmostEqual(compat.light_output(light, kind, radius)[0], 10.0 * ratio, 3)


class Compositor(unittest.TestCase):
    def test_every_version_gets_an_empty_compositor_on_the_cpu(self):
        for version in (OLD, MIDDLE, NEW):
            scene = scene_of(version)
            tree = compat_of(version).compositor_tree(scene)
            self.assertIs(getattr(scene, "compositing_node_group", None)
                          or scene.node_tree, tree)
            self.assertTrue(getattr(scene, "use_nodes", True))
            self.assertEqual(getattr(scene.render, "compositor_device", 'CPU'), 'CPU')
            self.assertEqual(getattr(scene.render, "compositor_precision", 'FULL'), 'FULL')
        self.assertFalse(hasattr(scene_of(OLD).render, "compositor_device"))

    def test_compositing_counts_where_there_is_some(self):
        for version in (OLD, NEW):
            scene, compat = scene_of(version), compat_of(version)
            scene.use_nodes = True
            if hasattr(scene, "compositing_node_group"):
                scene.compositing_node_group = None
            else:
                scene.use_nodes = False
            self.assertFalse(compat.has_compositing(scene))
            compat.compositor_tree(scene)
            self.assertTrue(compat.has_compositing(scene))

    def test_a_copied_scene_loses_its_compositing(self):
        for version in (OLD, NEW):
            scene = scene_of(version)
            scene.use_nodes = True
            compat_of(version).remove_compositor(scene)
            self.assertTrue(getattr(scene, "compositing_node_group", 1) is None
                            or not scene.use_nodes)

    def test_math_nodes_are_the_compositors_own_until_it_shares_the_shaders(self):
        for version, kind in ((OLD, 'CompositorNodeMath'), (MIDDLE, 'CompositorNodeMath'),
                              (NEW, 'ShaderNodeMath')):
            node = compat_of(version).math_node(Tree(version), 'DIVIDE')
            self.assertEqual((node.kind, node.operation), (kind, 'DIVIDE'))

    def test_layers_are_joined_in_their_order(self):
        sockets = [Fake(type='RGBA', bl_idname='NodeSocketColor'),
                   Fake(type='VALUE', bl_idname='NodeSocketFloat'),
                   Fake(type='VECTOR', bl_idname='NodeSocketVector4D')]
        for version in (OLD, MIDDLE, NEW):
            tree = Tree(version)
            file = compat_of(version).LayerFile(tree)
            for number, socket in enumerate(sockets):
                file.add(socket, f"layer {number}")
            self.assertEqual(file.names, ["layer 0", "layer 1", "layer 2"])
            self.assertEqual([start for start, _ in tree.joined], sockets)
            self.assertEqual([end for _, end in tree.joined],
                             [*(["layer 0"] if version >= (5, 0, 0) else ["Image"]),
                              "layer 1", "layer 2"])
            form = file.node.format
            self.assertEqual((form.file_format, form.color_depth, form.exr_codec),
                             ('OPEN_EXR_MULTILAYER', '32', 'ZIP'))

    def test_blender_5_is_told_the_medium_the_kinds_and_one_part(self):
        file = compat_of(NEW).LayerFile(Tree(NEW))
        for kind, name in (('VALUE', "a"), ('VECTOR', "b")):
            file.add(Fake(type=kind, bl_idname='NodeSocketVector'), name)
        file.add(Fake(type='VECTOR', bl_idname='NodeSocketVector4D'), "c")
        self.assertEqual([(item.kind, item.vector_socket_dimensions) for item in file.node.items],
                         [('FLOAT', None), ('VECTOR', 3), ('VECTOR', 4)])
        self.assertEqual(file.node.format.media_type, 'MULTI_LAYER_IMAGE')
        self.assertTrue(file.node.format.use_exr_interleave)

    def test_the_path_is_set_where_the_version_keeps_it(self):
        path = os.path.join("folder", ".shot.part")
        old, new = (compat_of(version).LayerFile(Tree(version)) for version in (OLD, NEW))
        old.set_path(path)
        new.set_path(path)
        self.assertEqual(old.node.base_path, path)
        self.assertEqual((new.node.directory, new.node.file_name), ("folder", ".shot.part"))


class Panel(unittest.TestCase):
    def test_relative_paths_are_declared_where_blender_asks(self):
        for names, wanted in (((), set()), (("is_path_supports_blend_relative",),
                                            {'PATH_SUPPORTS_BLEND_RELATIVE'})):
            compat = compat_of(OLD)
            compat.bpy.types.Property = Fake(bl_rna=Fake(properties=names))
            self.assertEqual(compat.relative_path_options(), wanted)


class Animation(unittest.TestCase):
    def test_curves_are_found_in_flat_and_in_layered_actions(self):
        compat = compat_of(NEW)
        layered = Fake(layers=[Fake(strips=[Fake(channelbags=[Fake(fcurves=["a"]),
                                                              Fake(fcurves=["b", "c"])])])])
        self.assertEqual(compat.action_curves(layered), ["a", "b", "c"])
        self.assertEqual(compat.action_curves(Fake(fcurves=("a", "b"))), ["a", "b"])
        self.assertEqual(compat.action_curves(None), [])


if __name__ == "__main__":
    unittest.main()
