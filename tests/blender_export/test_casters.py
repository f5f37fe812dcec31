# SPDX-License-Identifier: GPL-3.0-or-later
import os
import tempfile
import unittest
from types import SimpleNamespace

from paths import exporter

casters = exporter("casters")


class Column(list):
    """A Blender collection of which one property can be read at once."""

    def foreach_get(self, _, flat):
        flat[:] = type(flat)(flat.typecode, [number for row in self for number in row])


def mesh(places, triangles):
    return SimpleNamespace(vertices=Column(places), loop_triangles=Column(triangles),
                           calc_loop_triangles=lambda: None)


class Item(SimpleNamespace):
    def to_mesh(self):
        return self.shape

    def to_mesh_clear(self):
        pass


def instance(name, shape, x, **more):
    item = Item(name=name, type='MESH', hide_render=False, visible_shadow=True, shape=shape,
                original=SimpleNamespace(name_full=name),
                data=SimpleNamespace(as_pointer=lambda: id(shape), is_editmode=False,
                                     **vars(shape)))
    for key, value in more.items():
        setattr(item, key, value)
    matrix = [[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    return SimpleNamespace(object=item, matrix_world=matrix)


TRIANGLE = mesh([(0, 0, 0), (1, 0, 0), (0, 0.1, 0)], [(0, 1, 2)])


class Names:
    """Names as they are."""
    def of(self, item):
        return item.name


class Casters(unittest.TestCase):
    def test_single_floats_come_back_exactly(self):
        lines = casters.obj_text(TRIANGLE).splitlines()
        self.assertEqual(lines, ["v 0 0 0", "v 1 0 0", "v 0 0.100000001 0", "f 1 2 3"])

    def test_a_mesh_without_faces_is_none(self):
        self.assertIsNone(casters.obj_text(mesh([(0, 0, 0)], [])))

    def test_instances_share_a_file_and_what_throws_no_shadow_is_left_out(self):
        hidden = instance("Hidden", TRIANGLE, 0, visible_shadow=False)
        lamp = instance("Lamp", TRIANGLE, 0, type='LIGHT')
        empty = instance("Empty", mesh([], []), 0)
        with tempfile.TemporaryDirectory() as folder:
            graph = SimpleNamespace(object_instances=[instance("B", TRIANGLE, 2), hidden, lamp,
                                                      empty, instance("A", TRIANGLE, 1)])
            entries = casters.CasterFiles(folder, "shot.").write(graph, Names())
            self.assertEqual([entry["object"] for entry in entries], ["A", "B"])
            self.assertEqual(entries[0]["file"], entries[1]["file"])
            self.assertEqual(os.listdir(os.path.join(folder, "shot.casters")),
                             [os.path.basename(entries[0]["file"])])
            self.assertEqual(entries[1]["world_from_object"][0], [1.0, 0.0, 0.0, 2.0])


    def test_the_evaluated_mesh_is_cut_as_the_renderer_cuts_it(self):
        """A copy may have its quads cut along the other diagonal; only edit mode needs one."""
        quad = [(0, 0, 0), (1, 0, 0), (1, 1, 0.5), (0, 1, 0)]
        rendered, copied = mesh(quad, [(0, 1, 2), (0, 2, 3)]), mesh(quad, [(0, 1, 3), (1, 2, 3)])
        item = instance("Quad", rendered, 0).object
        item.shape = copied
        self.assertEqual(casters.evaluated_text(item), casters.obj_text(rendered))
        item.data.is_editmode = True
        self.assertEqual(casters.evaluated_text(item), casters.obj_text(copied))
        item.data.is_editmode, item.type = False, 'CURVE'
        self.assertEqual(casters.evaluated_text(item), casters.obj_text(copied))


if __name__ == "__main__":
    unittest.main()
