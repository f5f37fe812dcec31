# SPDX-License-Identifier: GPL-3.0-or-later
import math
import unittest
from types import SimpleNamespace as Fake

from paths import exporter

emission = exporter("light_emission")


def socket(value=0.0, source=None, name="Value"):
    links = [Fake(from_node=source[0], from_socket=source[1])] if source else []
    return Fake(default_value=value, links=links, is_linked=bool(links), name=name)


def node(kind, mute=False, **inputs):
    return Fake(bl_idname=kind, name=kind, mute=mute, inputs=inputs)


def lamp(shader, use_nodes=True):
    surface = socket(source=(shader, socket())) if shader else socket()
    output = Fake(inputs={"Surface": surface})
    return Fake(use_nodes=use_nodes, node_tree=Fake(get_output_node=lambda target: output))


def emitter(strength, color=None):
    return node('ShaderNodeEmission', Strength=strength, Color=color or socket((1.0, 1.0, 1.0, 1.0)))


class NodeEmission(unittest.TestCase):
    def test_without_nodes_the_settings_stand(self):
        self.assertEqual(emission.node_emission(lamp(emitter(socket(0.2)), use_nodes=False)),
                         emission.Emission(1.0, (1.0, 1.0, 1.0)))

    def test_strength_and_color_are_factors(self):
        found = emission.node_emission(lamp(emitter(socket(0.25), socket((1.0, 0.5, 0.0, 1.0)))))
        self.assertEqual((found.strength, found.color, found.unknown),
                         (0.25, (1.0, 0.5, 0.0), None))

    def test_no_shader_is_no_light(self):
        self.assertEqual(emission.node_emission(lamp(None)).strength, 0.0)
        muted = emitter(socket(1.0))
        muted.mute = True
        self.assertEqual(emission.node_emission(lamp(muted)).strength, 0.0)

    def test_values_and_falloff_and_sums_are_followed(self):
        value = node('ShaderNodeValue')
        falloff = node('ShaderNodeLightFalloff', Strength=socket(3.0))
        times = Fake(bl_idname='ShaderNodeMath', name="Math", mute=False, operation='MULTIPLY',
                     use_clamp=False, inputs=[
                         socket(source=(value, socket(0.5))),
                         socket(source=(falloff, socket(name='Quadratic')))])
        self.assertEqual(
            emission.node_emission(lamp(emitter(socket(source=(times, socket()))))).strength, 1.5)

    def test_what_cannot_be_followed_is_named_and_counts_as_1(self):
        noise = node('ShaderNodeTexNoise')
        found = emission.node_emission(lamp(emitter(socket(source=(noise, socket())))))
        self.assertEqual((found.strength, found.unknown), (1.0, 'ShaderNodeTexNoise'))


class WorldRadiance(unittest.TestCase):
    @staticmethod
    def world(shader):
        return lamp(shader)

    def test_one_background_is_its_colour_times_its_strength(self):
        sky = node('ShaderNodeBackground', Strength=socket(2.0), Color=socket((0.1, 0.2, 0.4, 1.0)))
        for found, wanted in zip(emission.world_radiance(self.world(sky)), (0.2, 0.4, 0.8)):
            self.assertAlmostEqual(found, wanted)

    def test_without_nodes_it_is_the_worlds_own_colour(self):
        plain = Fake(use_nodes=False, node_tree=None, color=(0.05, 0.06, 0.07))
        self.assertEqual(emission.world_radiance(plain), (0.05, 0.06, 0.07))

    def test_no_world_and_no_shader_are_dark(self):
        self.assertEqual(emission.world_radiance(None), (0.0, 0.0, 0.0))
        self.assertEqual(emission.world_radiance(self.world(None)), (0.0, 0.0, 0.0))

    def test_what_differs_by_direction_is_not_known(self):
        picture = node('ShaderNodeTexEnvironment')
        sky = node('ShaderNodeBackground', Strength=socket(1.0),
                   Color=socket(source=(picture, socket())))
        self.assertIsNone(emission.world_radiance(self.world(sky)))
        self.assertIsNone(emission.world_radiance(self.world(node('ShaderNodeMixShader'))))


class Emits(unittest.TestCase):
    @staticmethod
    def tree(*nodes):
        return Fake(nodes=nodes)

    def test_emission_shaders_in_groups_too(self):
        self.assertFalse(emission.emits(None))
        self.assertFalse(emission.emits(self.tree(node('ShaderNodeBsdfDiffuse'))))
        glow = self.tree(emitter(socket(1.0)))
        self.assertTrue(emission.emits(glow))
        group = node('ShaderNodeGroup')
        group.node_tree = glow
        self.assertTrue(emission.emits(self.tree(group)))
        group.mute = True
        self.assertFalse(emission.emits(self.tree(group)))

    def test_a_principled_shader_of_either_name_with_strength_and_colour(self):
        black, orange = (0.0, 0.0, 0.0, 1.0), (1.0, 0.5, 0.2, 1.0)
        for name in ("Emission", "Emission Color"):
            for color, strength, wanted in ((black, 1.0, False), (orange, 0.0, False),
                                            (orange, 1.0, True)):
                shader = node('ShaderNodeBsdfPrincipled',
                              **{name: socket(color), "Emission Strength": socket(strength)})
                self.assertEqual(emission.emits(self.tree(shader)), wanted, (name, color, strength))


class Irradiance(unittest.TestCase):
    """Against what Cycles gives a white diffuse plane, whose radiance is E / pi."""

    def test_measured_values(self):
        down, below = (0.0, 0.0, -1.0), (0.0, 0.0, 0.0)
        for kind, power, radiance in (("sun", 1.0, 0.318), ("point", 100.0, 0.101),
                                      ("area", 100.0, 0.318)):
            found = emission.irradiance(kind, power, (0.0, 0.0, 5.0), down, None, below)
            self.assertAlmostEqual(found / math.pi, radiance, 3, kind)

    def test_an_area_shines_forward_and_by_the_cosine(self):
        place, down = (0.0, 0.0, 5.0), (0.0, 0.0, -1.0)
        ahead = emission.irradiance("area", 100.0, place, down, None, (0.0, 0.0, 0.0))
        aslant = emission.irradiance("area", 100.0, place, down, None, (4.0, 0.0, 2.0))
        self.assertAlmostEqual(aslant / ahead, 0.6)
        self.assertEqual(emission.irradiance("area", 100.0, place, down, None, (0, 0, 9.0)), 0.0)

    def test_a_spot_ends_at_its_cone(self):
        def at(x):
            return emission.irradiance("spot", 100.0, (0.0, 0.0, 5.0), (0.0, 0.0, -1.0),
                                       (math.radians(60), 0.5), (x, 0.0, 0.0))
        self.assertAlmostEqual(at(0.0), 100.0 / (4.0 * math.pi * 25.0))
        self.assertEqual(at(3.0), 0.0)
        self.assertGreater(at(2.0), at(2.7))


if __name__ == "__main__":
    unittest.main()
