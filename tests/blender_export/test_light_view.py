# SPDX-License-Identifier: GPL-3.0-or-later
import math
import random
import unittest

from paths import exporter

light_view, vectors, subject = exporter("light_view"), exporter("vectors"), exporter("subject")


def multiply(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def project(view, point):
    light = multiply(light_view.rigid_inverse(view.world_from_light), (*point, 1.0))
    clip = multiply(view.clip_from_light, light)
    return [clip[axis] / clip[3] for axis in range(3)], -light[2]


def cloud(count, seed):
    chance = random.Random(seed)
    return [tuple(chance.uniform(-1, 1) for _ in range(3)) for _ in range(count)]


class LightView(unittest.TestCase):
    def test_every_framed_point_is_inside_the_map(self):
        points = cloud(200, 1)
        for position in ((5.0, 0.0, 0.0), (0.0, 0.0, 5.0), (0.0, 0.0, -5.0), (3.0, -2.0, 4.0)):
            view = light_view.perspective_view(position, points, points)
            self.assertFalse(view.cut)
            for point in points:
                place, depth = project(view, point)
                self.assertTrue(all(-1.0 <= value <= 1.0 for value in place), place)
                self.assertGreater(depth, 0.0)
            self.assertLess(view.extent, math.radians(50))

    def test_a_point_straight_ahead_is_in_the_middle_at_its_planar_depth(self):
        view = light_view.perspective_view((0.0, 0.0, 5.0), [(0.0, 0.0, 1.0)], [(0.0, 0.0, 1.0)])
        place, depth = project(view, (0.0, 0.0, 1.0))
        self.assertAlmostEqual(place[0], 0.0)
        self.assertAlmostEqual(place[1], 0.0)
        self.assertAlmostEqual(depth, 4.0)

    def test_orthographic_frames_points_and_starts_before_the_casters(self):
        points, caster = cloud(100, 2), (0.0, 0.0, 30.0)
        view = light_view.orthographic_view((0.0, 0.0, -1.0), points, points, [caster])
        for point in [*points, caster]:
            place, depth = project(view, point)
            self.assertTrue(all(-1.0 <= value <= 1.0 for value in place), place)
            self.assertGreater(depth, view.near)
        self.assertAlmostEqual(view.extent, 2.0 * light_view.MARGIN, 1)

    def test_the_narrower_of_framed_and_visible_is_taken(self):
        near, wide = [(0.1, 0.0, 0.0), (-0.1, 0.0, 0.0)], [(4.0, 0.0, 0.0), (-4.0, 0.0, 0.0)]
        one = light_view.perspective_view((0.0, 0.0, 5.0), near, wide)
        other = light_view.perspective_view((0.0, 0.0, 5.0), wide, near)
        self.assertAlmostEqual(one.extent, other.extent)

    def test_a_light_among_the_points_says_that_it_cannot_show_all(self):
        points = cloud(300, 3)
        view = light_view.perspective_view((0.0, 0.0, 0.0), points, points)
        self.assertTrue(view.cut)
        self.assertEqual(view.extent, light_view.WIDEST)

    def test_a_spots_cone_limits_the_map(self):
        points = cloud(100, 4)
        cone = ((0.0, 0.0, -1.0), math.radians(10))
        view = light_view.perspective_view((0.0, 0.0, 4.0), points, points, cone)
        self.assertAlmostEqual(view.extent, math.radians(10) * light_view.MARGIN)

    def test_rigid_inverse(self):
        matrix = light_view.look_along((1.0, 2.0, 3.0), vectors.normalize((1.0, 1.0, -0.3)))
        inverse = light_view.rigid_inverse(matrix)
        for row in range(4):
            column = [matrix[k][row] for k in range(4)]
            expected = [float(k == row) for k in range(4)]
            for found, wanted in zip(multiply(inverse, column), expected):
                self.assertAlmostEqual(found, wanted)


def thing(name, low, high):
    corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
               for z in (low[2], high[2])]
    return subject.Thing(name, corners, subject.is_flat(low, high))


class Subject(unittest.TestCase):
    def setUp(self):
        self.cup = thing("Cup", (-1, -1, 0), (1, 1, 2))
        self.pear = thing("Pear", (3, -1, 0), (5, 1, 2))
        self.jar = thing("Jar", (0, 3, 0), (1, 4, 2))
        self.floor = thing("Floor", (-50, -50, 0), (50, 50, 0))
        self.room = thing("Room", (-9, -9, 0), (9, 9, 5))

    def test_flat_is_under_two_percent_of_the_largest_extent(self):
        self.assertTrue(subject.is_flat((0, 0, 0), (10, 10, 0.19)))
        self.assertFalse(subject.is_flat((0, 0, 0), (10, 10, 0.21)))

    def test_floors_and_rooms_are_not_part_of_the_subject(self):
        names = [item.name for item in subject.standing_things(
            [self.cup, self.pear, self.jar, self.floor, self.room])]
        self.assertEqual(names, ["Cup", "Pear", "Jar"])

    def test_a_lone_floor_is_its_own_subject(self):
        identity = [[float(a == b) for a in range(4)] for b in range(4)]
        self.assertEqual(subject.subject_things([self.floor], identity), [self.floor])

    def test_things_outside_the_frustum_are_not_in_view(self):
        identity = [[float(a == b) for a in range(4)] for b in range(4)]
        self.assertTrue(subject.in_view(thing("A", (0.5, 0, 0), (3, 1, 1)), identity))
        self.assertFalse(subject.in_view(thing("B", (8, 0, 0), (9, 1, 1)), identity))

    def test_bounding_sphere_of_a_box(self):
        sphere = subject.bounding_sphere(self.cup.corners)
        self.assertEqual(sphere.center, (0, 0, 1))
        self.assertAlmostEqual(sphere.radius, math.sqrt(3))
        self.assertEqual(subject.bounding_sphere([]).radius, 0.0)


if __name__ == "__main__":
    unittest.main()
