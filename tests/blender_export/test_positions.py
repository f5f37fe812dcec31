# SPDX-License-Identifier: GPL-3.0-or-later
import math
import random
import unittest

from paths import exporter

vectors, mask_positions = exporter("vectors"), exporter("mask_positions")
light_offset, errors = exporter("light_offset"), exporter("errors")
Arrangement = exporter("arguments").Arrangement

PAIR, LINE, DISC = Arrangement("pair", 2), Arrangement("line", 5), Arrangement("disc", 9)


class Positions(unittest.TestCase):
    def assertNear(self, found, expected, places=9):
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, places)

    def positions(self, arrangement, centre, travel, offset, surface=None):
        places = mask_positions.places_on_light(arrangement, travel, surface)
        return [mask_positions.mask_position(centre, places, place, offset)
                for place in places.places]

    def test_pair_lies_on_the_axis_the_farther_first(self):
        # 000 eq. 3.1, 3.2: L = (0,0,10), G = (0,0,2): P = (0,0,1), L +- 0.5 P.
        found = self.positions(PAIR, (0, 0, 10), (0.0, 0.0, -1.0), 0.5)
        self.assertNear(found[0], (0, 0, 10.5))
        self.assertNear(found[1], (0, 0, 9.5))

    def test_line_is_level_and_evenly_spaced(self):
        found = self.positions(LINE, (0, 0, 5), (0.0, 1.0, 0.0), 2.0)
        self.assertNear(found[0], (2, 0, 5))
        self.assertNear(found[1], (1, 0, 5))
        self.assertNear(found[2], (0, 0, 5))
        self.assertNear(found[4], (-2, 0, 5))

    def test_line_follows_the_longer_side_of_an_area(self):
        found = self.positions(LINE, (1, 2, 3), (0.0, 0.0, -1.0), 1.5, ((0, 1, 0), (1, 0, 0)))
        self.assertNear(found[0], (1, 0.5, 3))
        self.assertNear(found[4], (1, 3.5, 3))

    def test_disc_has_its_centre_first_and_its_ring_at_the_offset(self):
        centre, travel = (1.0, 2.0, 3.0), vectors.normalize((1.0, -2.0, -0.5))
        found = self.positions(DISC, centre, travel, 0.3)
        self.assertNear(found[0], centre)
        self.assertEqual(len(found), 9)
        for place in found[1:]:
            away = vectors.subtract(place, centre)
            self.assertAlmostEqual(vectors.length(away), 0.3)
            self.assertAlmostEqual(vectors.dot(away, travel), 0.0)

    def test_larger_discs_contain_smaller_ones_and_stay_on_the_light(self):
        centre, travel = (1.0, 2.0, 3.0), vectors.normalize((1.0, -2.0, -0.5))
        largest = self.positions(Arrangement("disc", 65), centre, travel, 0.3)
        for count in (9, 17, 33, 65):
            found = self.positions(Arrangement("disc", count), centre, travel, 0.3)
            self.assertEqual(found, largest[:count])
            self.assertEqual(len(set(found)), count)
            for place in found:
                self.assertLess(vectors.length(vectors.subtract(place, centre)), 0.3 + 1e-9)

    def test_ring_runs_counter_clockwise_seen_from_the_subject(self):
        # Seen from the subject means looking against `travel`: turns about +travel are
        # counter-clockwise for an eye that the light travels towards.
        chance = random.Random(1)
        for surface in (None, ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))):
            for _ in range(50):
                travel = vectors.normalize(tuple(chance.uniform(-1, 1) for _ in range(3)))
                if surface:
                    travel = (0.0, 0.0, math.copysign(1.0, travel[2]))
                ring = self.positions(DISC, (0, 0, 0), travel, 1.0, surface)[1:]
                for here, after in zip(ring, ring[1:] + ring[:1]):
                    turn = vectors.cross(here, after)
                    self.assertAlmostEqual(vectors.dot(turn, travel), math.sin(math.pi / 4))

    def test_axes_are_an_exact_frame_for_every_direction(self):
        chance = random.Random(2)
        travels = [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
        travels += [vectors.normalize(tuple(chance.uniform(-1, 1) for _ in range(3)))
                    for _ in range(100)]
        for travel in travels:
            for arrangement in (LINE, DISC):
                places = mask_positions.places_on_light(arrangement, travel)
                self.assertAlmostEqual(vectors.length(places.u_axis), 1.0)
                self.assertNear(vectors.cross(places.u_axis, places.v_axis), travel)

    def test_disc_does_not_jump_where_the_light_passes_overhead(self):
        before = mask_positions.places_on_light(DISC, vectors.normalize((0.001, 0.0, -1.0)))
        after = mask_positions.places_on_light(DISC, vectors.normalize((-0.001, 0.0, -1.0)))
        self.assertLess(vectors.length(vectors.subtract(before.u_axis, after.u_axis)), 0.01)

    def test_sun_masks_are_directions_at_the_tangent(self):
        places = mask_positions.places_on_light(DISC, (0.0, 0.0, -1.0))
        tangent = math.tan(math.radians(5))
        for place in places.places[1:]:
            direction = mask_positions.mask_direction((0.0, 0.0, -1.0), places, place, tangent)
            self.assertAlmostEqual(vectors.length(direction), 1.0)
            self.assertAlmostEqual(math.degrees(math.acos(-direction[2])), 5.0)

    def test_sun_mask_travels_away_from_its_place_on_the_sun(self):
        places = mask_positions.places_on_light(DISC, (0.0, 0.0, -1.0))
        direction = mask_positions.mask_direction((0.0, 0.0, -1.0), places, (1.0, 0.0), 0.1)
        self.assertLess(vectors.dot(direction, places.u_axis), 0.0)


class AutoOffset(unittest.TestCase):
    def offset(self, kind, radius=0.3, half_length=1.2, distance=10.0, subject=2.0):
        return light_offset.auto_offset(kind, radius, half_length, distance, subject)

    def test_disc_and_line_take_the_lights_own_size(self):
        self.assertEqual(self.offset("disc"), 0.3)
        self.assertEqual(self.offset("line"), 1.2)

    def test_pair_is_r_d_over_x(self):
        self.assertAlmostEqual(self.offset("pair"), 0.3 * 10 / 2)

    def test_pair_stays_outside_the_subject(self):
        self.assertAlmostEqual(self.offset("pair", radius=5.0), 4.0)   # half of 10 - 2
        self.assertAlmostEqual(self.offset("pair", radius=5.0, distance=1.0), 0.25)
        self.assertAlmostEqual(self.offset("pair", subject=0.0), 5.0)

    def test_a_light_that_shrinks_to_a_point_keeps_its_masks_apart(self):
        for kind in ("disc", "line", "pair"):
            offset = self.offset(kind, radius=0.0, half_length=0.0)
            self.assertTrue(0.0 < offset < 1e-3, (kind, offset))

    def test_masks_follow_the_shape_of_an_area(self):
        for shape in ("ellipse", "rectangle"):
            area = {"shape": shape, "half_u": 1.25, "half_v": 0.2}
            self.assertEqual(light_offset.area_offsets(0.5, area), (1.25, 0.2))


class OnRectangle(unittest.TestCase):
    def shape(self, count, half_u, half_v):
        found = mask_positions.on_rectangle(count, half_u, half_v)
        self.assertEqual(found.count, count)
        return (found.columns, found.rows) if found.kind == "grid" else found.kind

    def test_rows_and_columns_follow_the_sides(self):
        self.assertEqual(self.shape(9, 0.4, 0.4), (3, 3))
        self.assertEqual(self.shape(9, 0.75, 0.15), (4, 2))
        self.assertEqual(self.shape(5, 0.75, 0.15), (2, 2))
        self.assertEqual(self.shape(17, 0.4, 0.4), (4, 4))
        self.assertEqual(self.shape(17, 0.75, 0.15), (8, 2))
        self.assertEqual(self.shape(33, 1.5, 0.4), (11, 3))
        self.assertEqual(self.shape(65, 0.4, 0.4), (8, 8))

    def test_a_very_narrow_one_is_a_line(self):
        for count in (5, 9, 17, 33, 65):
            self.assertEqual(self.shape(count, 1.25, 0.0), "line")
            self.assertEqual(self.shape(count, 1.25, 0.025), "line")
            self.assertNotEqual(self.shape(count, 1.25, 0.1), "line")

    def test_a_grid_has_its_centre_first_and_its_corners_next(self):
        corners = {(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)}
        for count in (5, 9, 17, 33, 65):
            for half_v in (1.0, 0.3, 0.1):
                arrangement = mask_positions.on_rectangle(count, 1.0, half_v)
                places = mask_positions.places_on_light(arrangement, (0.0, 0.0, -1.0)).places
                self.assertEqual(len(places), count)
                self.assertEqual(len(set(places)), count)
                self.assertEqual(places[0], (0.0, 0.0))
                self.assertEqual(set(places[1:5]), corners)
                for axis in (0, 1):
                    self.assertAlmostEqual(sum(place[axis] for place in places), 0.0)
                    self.assertLessEqual(max(abs(place[axis]) for place in places), 1.0)


if __name__ == "__main__":
    unittest.main()
