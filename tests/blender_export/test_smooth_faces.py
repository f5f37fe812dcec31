# SPDX-License-Identifier: GPL-3.0-or-later
import math
import unittest
from types import SimpleNamespace
from unittest import mock

from paths import exporter

smooth_faces = exporter("smooth_faces")


class Mesh(SimpleNamespace):
    """Compared by what it is, as Blender's are."""
    __hash__, __eq__ = object.__hash__, object.__eq__


class Item(Mesh):
    modifiers = ()
    matrix_world = SimpleNamespace(to_scale=lambda: (1.0, 1.0, 1.0))

    def evaluated_get(self, _):
        return self


def tube(sides, length=2.0, caps_turn=0.0, domain='POINT', name="Tube"):
    """A tube of radius 1; its ends' normals lean outward by `caps_turn`."""
    mesh = Mesh(vertices=[], edges=[], polygons=[], loops=[], corner_normals=[],
                normals_domain=domain)
    for end in (0, 1):
        for side in range(sides):
            angle, lean = 2.0 * math.pi * side / sides, caps_turn * (2 * end - 1)
            mesh.vertices.append(SimpleNamespace(
                co=(math.cos(angle), math.sin(angle), end * length),
                normal=(math.cos(lean) * math.cos(angle), math.cos(lean) * math.sin(angle),
                        math.sin(lean))))
            mesh.edges.append(SimpleNamespace(
                vertices=(end * sides + side, end * sides + (side + 1) % sides)))
    for side in range(sides):
        mesh.edges.append(SimpleNamespace(vertices=(side, sides + side)))
        start = len(mesh.loops)
        mesh.polygons.append(SimpleNamespace(loop_indices=range(start, start + 4)))
        for vertex in (side, (side + 1) % sides, sides + (side + 1) % sides, sides + side):
            mesh.loops.append(SimpleNamespace(vertex_index=vertex))
            mesh.corner_normals.append(SimpleNamespace(vector=mesh.vertices[vertex].normal))
    return Item(name=name, type='MESH', data=mesh)


def coarse(*items, radius=1.0):
    found = smooth_faces.coarse_object(items, radius, None)
    return found and found.name


class SmoothFaces(unittest.TestCase):
    def test_an_edge_bulges_by_a_quarter_of_its_length_times_the_turn_of_its_normal(self):
        angle = math.radians(60.0)
        place = (math.cos(angle), math.sin(angle), 0.0)
        self.assertAlmostEqual(smooth_faces.leap([(((1.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
                                                   (place, place))]), 0.25)
        self.assertAlmostEqual(smooth_faces.leap([(((1.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
                                                   ((1.0, 0.0, 9.0), (1.0, 0.0, 0.0)))]), 0.0)

    def test_few_sides_are_coarse_and_many_are_fine(self):
        self.assertEqual(coarse(tube(256), tube(16, name="Sixteen")), "Sixteen")
        self.assertIsNone(coarse(tube(256)))

    def test_faces_that_are_shaded_flat_never_are(self):
        self.assertIsNone(coarse(tube(4, domain='FACE')))

    def test_normals_of_corners_are_looked_at_where_a_mesh_has_them(self):
        """A sharp edge, or normals of the artist's own."""
        self.assertEqual(coarse(tube(16, domain='CORNER')), "Tube")
        sharp = tube(4, domain='CORNER')
        for number, normal in enumerate(sharp.data.corner_normals):
            angle = 0.5 * math.pi * (number // 4 + 0.5)
            normal.vector = (math.cos(angle), math.sin(angle), 0.0)
        self.assertIsNone(coarse(sharp))

    def test_ends_shaded_smooth_make_a_long_tube_coarse_whatever_its_sides(self):
        self.assertEqual(coarse(tube(256, caps_turn=math.radians(30.0))), "Tube")

    def test_things_that_share_a_mesh_are_looked_at_once_whatever_their_size(self):
        small, large = tube(256), tube(256, name="Large")
        large.data = small.data
        large.matrix_world = SimpleNamespace(to_scale=lambda: (1.0, 1.0, -100.0))
        looked = mock.PropertyMock(return_value='POINT')
        del small.data.normals_domain
        with mock.patch.object(Mesh, "normals_domain", looked, create=True):
            self.assertIsNone(coarse(small, small))
            once = looked.call_count
            self.assertEqual(coarse(small, large), "Large")
        self.assertEqual(looked.call_count, 2 * once)

    def test_a_modifier_makes_a_shape_of_its_own(self):
        plain, bent = tube(256), tube(256, name="Bent")
        bent.data, evaluated = plain.data, tube(16)
        bent.modifiers = (SimpleNamespace(type='DECIMATE'),)
        bent.evaluated_get = lambda _: evaluated
        self.assertEqual(coarse(plain, bent), "Bent")

    def test_each_level_of_subdivision_is_a_quarter(self):
        def subdivided(levels, **more):
            made = tube(16)  # 0.038 of its radius
            made.modifiers = (SimpleNamespace(**{
                "type": 'SUBSURF', "show_render": True, "render_levels": levels,
                "subdivision_type": 'CATMULL_CLARK', **more}),)
            return coarse(made)
        self.assertEqual(subdivided(3), "Tube")
        self.assertIsNone(subdivided(4))
        self.assertEqual(subdivided(4, show_render=False), "Tube")
        self.assertEqual(subdivided(4, subdivision_type='SIMPLE'), "Tube")

    def test_what_is_small_in_the_shot_is_fine(self):
        self.assertIsNone(coarse(tube(16), radius=100.0))
        small = tube(16)
        small.matrix_world = SimpleNamespace(to_scale=lambda: (0.01, 0.01, 0.01))
        self.assertIsNone(coarse(small))

    def test_a_coarse_part_of_a_mesh_of_many_edges_is_found(self):
        many, part = tube(2 * smooth_faces.LOOKED_AT), tube(16).data
        start = len(many.data.vertices)
        many.data.vertices.extend(part.vertices)
        many.data.edges.extend(SimpleNamespace(
            vertices=[start + number for number in edge.vertices]) for edge in part.edges)
        self.assertEqual(coarse(many), "Tube")

    def test_things_without_faces_are_passed_over(self):
        self.assertIsNone(coarse(tube(0),
                                 Item(name="Light", type='LIGHT')))
        bare = Item(name="Text", type='FONT', data=None, to_mesh=lambda: None, to_mesh_clear=lambda: None)
        self.assertIsNone(coarse(bare))


if __name__ == "__main__":
    unittest.main()
