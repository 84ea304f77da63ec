# SPDX-License-Identifier: AGPL-3.0-or-later
"""When a made-up history counts as settled, how long it is until then, and what a line of progress tells of it."""
import math
import sys
import unittest
from unittest import mock

from cutwater import SOURCE

sys.path.insert(0, str(SOURCE / "pipeline/solve"))
import foam  # noqa: E402
import settling  # noqa: E402
from settling import Rest  # noqa: E402


def history(value, count=1000, step=10):
    return {i: {"head_m": value(i), "torque_n_m": 2 * value(i)} for i in range(step, count + 1, step)}


class Settled(unittest.TestCase):
    def test_what_is_left_of_a_geometric_way_is_known(self):
        # Means of windows of a decay to 12 are 12 - c q^k: 12 - the last one is left, exactly.
        for q in (0.1, 0.5, 0.9):
            means = [12 - 3 * q**k for k in range(3)]
            self.assertAlmostEqual(settling.left_of_way(means), 12 - means[2], places=9)

    def test_means_to_and_fro_count_by_their_last_change(self):
        self.assertAlmostEqual(settling.left_of_way([10, 12, 11]), 1)
        self.assertAlmostEqual(settling.left_of_way([10, 10, 10]), 0)
        self.assertAlmostEqual(settling.left_of_way([10, 10, 11]), 1)

    def test_a_slow_drift_is_not_taken_for_rest(self):
        # A drift with a constant rate has a change from window to window that does not fall: it never settles.
        drift = history(lambda i: 10 + 1e-4 * i)
        self.assertGreater(settling.settled(drift, Rest(0.001))[1], 0.0009)
        self.assertFalse(settling.settled(history(lambda i: 12 - 3 * math.exp(-i / 800)), Rest(0.003))[0])
        self.assertTrue(settling.settled(history(lambda i: 12 - 3 * math.exp(-i / 80)), Rest(0.003))[0])

    def test_a_slow_way_behind_a_quick_one_is_seen(self):
        # At first the quick part alone changes the means of long windows.
        def value(i):
            return 12 - 3 * math.exp(-i / 40) - 0.6 * math.exp(-i / 200)

        for count in range(310, 2000, 10):
            if settling.settled(history(value, count), Rest(0.003))[0]:
                break
        self.assertLess(12 - value(count), 2 * 0.003 * 12)
        self.assertLess(count, 1000)

    def test_three_windows_are_needed(self):
        self.assertEqual(settling.settled(history(lambda i: 10, count=250), Rest(0.003)), (False, math.inf))
        self.assertTrue(settling.settled(history(lambda i: 10, count=310), Rest(0.003))[0])

    def test_what_is_no_number_has_not_settled(self):
        self.assertEqual(settling.settled(history(lambda i: math.nan), Rest(0.003)), (False, math.inf))
        table = history(lambda i: 10.0)
        table[1000]["torque_n_m"] = math.nan
        self.assertEqual(settling.settled(table, Rest(0.003)), (False, math.inf))


class LastMean(unittest.TestCase):
    def test_the_last_window_counts_where_it_has_the_quantity(self):
        table = history(lambda i: float(i), count=200)
        table[150]["other"], table[200]["other"], table[100]["other"] = 1, 3, 1000
        self.assertEqual(settling.last_mean(table, "other"), 2)
        self.assertAlmostEqual(settling.last_mean(table, "head_m"), 155)
        self.assertIsNone(settling.last_mean(table, "none"))


class NearNoHead(unittest.TestCase):
    def test_the_design_head_counts_where_the_head_is_near_none(self):
        # 2 cm of scatter from window to window, about a head of 5 mm; the torque is steady.
        table = {i: {"head_m": 0.005 + 0.01 * (-1)**(i // 100), "torque_n_m": 3.0} for i in range(10, 1001, 10)}
        self.assertFalse(settling.settled(table, Rest(0.003))[0])
        done, left = settling.settled(table, Rest(0.003, 10))
        self.assertTrue(done)
        self.assertAlmostEqual(left, 0.02 / 10, delta=1e-3)

    def test_a_head_above_the_design_counts_by_itself(self):
        table = history(lambda i: 20 + 1e-4 * i)
        self.assertEqual(settling.settled(table, Rest(0.003, 10)), settling.settled(table, Rest(0.003)))


class Left(unittest.TestCase):
    def test_a_geometric_way_settles_when_it_is_told(self):
        for decay in (100, 200, 400):
            def value(i, decay=decay):
                return 12 - 3 * math.exp(-i / decay)
            rest = Rest(0.003)
            told = 400 + settling.iterations_left(history(value, 400), rest)
            done = next(count for count in range(310, 4000, 10) if settling.settled(history(value, count), rest)[0])
            self.assertAlmostEqual(told, done, delta=15 + 0.05 * (done - 400))  # the head still rises
            self.assertEqual(settling.iterations_left(history(value, done), rest), 0)

    def test_there_is_none_without_a_rate(self):
        rest = Rest(0.003)
        self.assertIsNone(settling.iterations_left(history(lambda i: 10, count=250), rest))
        self.assertIsNone(settling.iterations_left(history(lambda i: 1 + 1e-2 * i), rest))

    def test_progress_tells_the_rate_and_both_residuals(self):
        for value, time_left in ((lambda i: 12 - 3 * math.exp(-i / 200), "about 2 min"),
                                 (lambda i: 1 + 1e-2 * i, "at most 15 min")):
            table, told = history(value, 400), []
            table[400] |= {"residual_p": 3e-3, "residual_u": 2e-4}
            with mock.patch.object(foam, "say", told.append):
                foam.progress(table, 4000, 4, Rest(0.003), "flow")
            self.assertIn("N m, residuals: p 3.0e-03, U 2.0e-04; ", told[0])
            self.assertTrue(told[0].endswith(f"; {time_left} left"), told[0])


class Falls(unittest.TestCase):
    def test_a_residual_falls_or_has_come_to_rest(self):
        for value, falls in ((lambda i: math.exp(-i / 500), True), (lambda i: 1e-3 + math.exp(-i / 50), False),
                             (lambda i: 1e-3 * (1 + 0.5 * math.sin(i)), False), (lambda i: 1e-6 * i, False)):
            table = {i: {"residual_p": value(i)} if i % 20 else {} for i in range(10, 1001, 10)}
            self.assertIs(settling.falls(table, "residual_p"), falls)
        self.assertIsNone(settling.falls({i: {"residual_p": 1} for i in range(10, 300, 10)}, "residual_p"))
        self.assertIsNone(settling.falls({i: {} for i in range(10, 1001, 10)}, "residual_p"))


if __name__ == "__main__":
    unittest.main()
