# SPDX-License-Identifier: GPL-3.0-or-later
import unittest

from paths import exporter

whole_shot, subject = exporter("whole_shot"), exporter("subject")


def cube(name, middle, half=1.0):
    corners = [tuple(m + half * s for m, s in zip(middle, signs))
               for signs in ((x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1))]
    return subject.Thing(name, corners, False)


def sample(seen, **things):
    made = {name: cube(name, middle) for name, middle in things.items()}
    return whole_shot.FrameSample(made, set(seen), (0.0, -10.0, 0.0), (0.0, 1.0, 0.0), {})


class SampledFrames(unittest.TestCase):
    def test_short_shots_are_looked_at_whole(self):
        self.assertEqual(whole_shot.sampled_frames(1, 4), [1, 2, 3, 4])
        self.assertEqual(whole_shot.sampled_frames(7, 7), [7])
        self.assertEqual(whole_shot.sampled_frames(9, 2), [9])

    def test_long_ones_evenly_with_both_ends(self):
        self.assertEqual(whole_shot.sampled_frames(1, 17), [1, 3, 5, 7, 9, 11, 13, 15, 17])
        frames = whole_shot.sampled_frames(-100, 1_000_000)
        self.assertEqual((len(frames), frames[0], frames[-1]), (9, -100, 1_000_000))
        self.assertEqual(frames, sorted(set(frames)))


class Subject(unittest.TestCase):
    def test_what_is_seen_in_few_frames_does_not_count(self):
        samples = [sample(["box"], box=(0, 0, 0), ball=(20 - k, 0, 0)) for k in range(6)]
        samples += [sample(["box", "ball"], box=(0, 0, 0), ball=(14 - k, 0, 0)) for k in range(3)]
        found = whole_shot.measure(1, 9, samples)
        self.assertEqual(found.subject.center, (0.0, 0.0, 0.0))
        self.assertAlmostEqual(found.subject.radius, 3 ** 0.5)
        self.assertEqual(found.distance, 10.0)

    def test_what_is_seen_in_most_counts_in_all(self):
        samples = [sample(["box"] if k < 2 else ["box", "ball"], box=(0, 0, 0), ball=(4, 0, 0))
                   for k in range(5)]
        found = whole_shot.measure(1, 5, samples)
        self.assertEqual(found.subject.center, (2.0, 0.0, 0.0))
        self.assertEqual(found.centers, [(2.0, 0.0, 0.0)] * 5)

    def test_a_flight_past_many_things_takes_those_seen_most(self):
        samples = [sample([name], a=(0, 0, 0), b=(50, 0, 0), c=(100, 0, 0))
                   for name in ("a", "b", "b", "c", "c", "d")]
        self.assertEqual(whole_shot.subject_names(samples), {"b", "c"})

    def test_an_empty_shot_has_a_subject_without_size(self):
        found = whole_shot.measure(1, 1, [sample([])])
        self.assertEqual((found.subject.center, found.subject.radius), ((0.0, 0.0, 0.0), 0.0))

    def test_distance_is_0_where_the_subject_is_never_ahead(self):
        self.assertEqual(whole_shot.measure(1, 1, [sample(["a"], a=(0, -30, 0))]).distance, 0.0)


class Aim(unittest.TestCase):
    def test_a_lamp_that_stays_is_aimed_at_the_whole_shot(self):
        centers = [(x, 0.0, 0.0) for x in (0.0, 1.0, 2.0)]
        aim = whole_shot.aim_of((1.0, 0.0, 0.0), centers, [(0.0, 0.0, 5.0)] * 3)
        self.assertEqual(aim.center((9.0, 9.0, 9.0)), (1.0, 0.0, 0.0))

    def test_a_lamp_that_goes_round_is_aimed_at_what_stands(self):
        places = [(5.0, 0.0, 1.0), (0.0, 5.0, 1.0), (-5.0, 0.0, 1.0)]
        aim = whole_shot.aim_of((0.0, 0.0, 0.0), [(0.0, 0.0, 0.0)] * 3, places)
        self.assertFalse(aim.travels)

    def test_a_lamp_that_goes_along_keeps_its_direction(self):
        centers = [(x, 0.0, 0.0) for x in (0.0, 50.0, 100.0)]
        places = [(x, -1.0, 3.0) for x in (0.0, 50.0, 100.0)]
        aim = whole_shot.aim_of((50.0, 0.0, 0.0), centers, places)
        self.assertEqual(aim.center((20.0, -1.0, 3.0)), (20.0, 0.0, 0.0))


if __name__ == "__main__":
    unittest.main()
