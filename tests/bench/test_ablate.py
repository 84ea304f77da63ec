# SPDX-License-Identifier: AGPL-3.0-or-later
"""The screening design by its definition, its estimates on responses whose effects are known, and the moves of the
numbers of the policy."""
import math
import random
import unittest

from ablate import FIGURES, meshes_of, moved, moved_alone, moved_together, policy_numbers, responses, table_of
from cutwater import SOURCE
from screening import DUMMIES_LEAST, design, effects, opposite, paley_order, standard_error

FACTORS = (1, 5, 15, 50, 60)


def product(rows, *columns):
    return sum(math.prod(row[k] for k in columns) for row in rows)


class Design(unittest.TestCase):
    def test_orders_of_paley(self):
        # 3, 7, 11, 19, 23, 59 are primes; 15, 27, 35, 39, 51 and 55 are not.
        self.assertEqual([paley_order(least) for least in (2, 5, 12, 14, 21, 25, 49)], [4, 8, 12, 20, 24, 32, 60])

    def test_it_is_a_hadamard_matrix_but_for_a_column(self):
        for factors in FACTORS:
            rows = design(factors)
            columns = range(len(rows[0]))
            self.assertGreaterEqual(len(columns), factors + DUMMIES_LEAST)
            self.assertEqual(len(rows), len(columns) + 1)
            self.assertEqual([product(rows, k) for k in columns], [0 for _ in columns])
            self.assertFalse([pair for pair in ((j, k) for k in columns for j in range(k)) if product(rows, *pair)])

    def test_folded_over_main_effects_are_clear_of_pairs(self):
        rows = design(5) + opposite(design(5))
        columns = range(len(rows[0]))
        self.assertFalse([(i, j, k) for k in columns for j in range(k) for i in range(j) if product(rows, i, j, k)])


class Effects(unittest.TestCase):
    def test_known_effects_are_found_beside_interactions_of_two(self):
        wanted = [0.5 * k for k in range(12)] + [0] * (len(design(12)[0]) - 12)
        found = []
        for rows in (design(12), opposite(design(12))):
            response = [7 + sum(effect / 2 * level for effect, level in zip(wanted, row)) + 3 * row[1] * row[2] -
                        5 * row[4] * row[11] for row in rows]
            found.append(effects(rows, response))
        for one, other, effect in zip(*found, wanted):
            self.assertAlmostEqual((one + other) / 2, effect, places=12)

    def test_the_standard_error_is_that_of_the_noise(self):
        # Of a mean of n/2 values less that of n/2 others: sigma 2 / sqrt(n), known within a few of its 1 / sqrt(2 k).
        rows, draw = design(60), random.Random(5)
        estimate = standard_error(effects(rows, [draw.gauss(10, 3) for _ in rows])[:60])
        self.assertAlmostEqual(estimate * math.sqrt(len(rows)) / 2 / 3, 1, delta=3 / math.sqrt(120))

    def test_a_failure_takes_the_mean_of_its_mesh(self):
        results = {("a", "60k", "x"): {"failed": 0, "aspect": 1}, ("a", "60k", "y"): {"failed": 1},
                   ("a", "60k", "z"): {"failed": 0, "aspect": 2}, ("b", "60k", "x"): {"failed": 0, "aspect": 4},
                   ("b", "60k", "y"): {"failed": 0, "aspect": 5}, ("b", "60k", "z"): {"failed": 0, "aspect": 6}}
        meshes = meshes_of([("a", None, None), ("b", None, None)], ["60k"], False, [[1], [-1]])
        self.assertEqual(responses(results, meshes[0], "xyz", "aspect"), [1, 1.5, 2])
        table = table_of(results, meshes, "xyz", lambda mesh, values: values)
        self.assertEqual([table[[key for key, *_ in FIGURES].index(key)] for key in ("aspect", "failed")],
                         [[2.5, 3.25, 4], [0, 0.5, 0]])

    def test_every_size_has_both_halves_of_the_design(self):
        pumps = [(name, None, None) for name in "abcdefgh"]
        for in_turn, count in ((False, 16), (True, 8)):
            meshes = meshes_of(pumps, ["1k", "2k"], in_turn, [[1], [-1]])
            self.assertEqual(len({(mesh.name, mesh.cells) for mesh in meshes}), count)
            halves = [(mesh.cells, mesh.rows[0][0]) for mesh in meshes]
            self.assertEqual({half: halves.count(half) for half in halves},
                             {(cells, level): count // 4 for cells in ("1k", "2k") for level in (1, -1)})


class Moves(unittest.TestCase):
    def test_numbers_are_read_as_they_stand(self):
        text = 'NUMBER(double, one, 0.5, none, "h",\n       "a thing")\nNUMBER(\n    int64_t, two, 3, 0, "1", "x")'
        self.assertEqual(policy_numbers(text), {"one": ("double", 0.5, None), "two": ("int64_t", 3, 0)})

    def test_every_number_of_the_mesher_is_read(self):
        text = (SOURCE / "mesher/policy_table.h").read_text()
        self.assertEqual(len(policy_numbers(text)), sum(line.startswith("NUMBER(") for line in text.splitlines()))

    def test_a_move_stops_where_the_number_is_off(self):
        self.assertAlmostEqual(moved(("double", 0.8, None), 1.25), 1)
        self.assertEqual(moved(("double", 0.95, 1), 1.25), 1)
        self.assertAlmostEqual(moved(("double", 0.95, 1), 1 / 1.25), 0.76)
        self.assertEqual(moved(("double", 0.95, 0), 1.25), 0.95 * 1.25)

    def test_whole_numbers_move_by_one_at_least(self):
        self.assertEqual([moved(("int64_t", 2, 0), factor) for factor in (1.25, 1 / 1.25)], [3, 1])
        self.assertEqual([moved(("int64_t", 100, None), factor) for factor in (1.25, 1 / 1.25)], [125, 80])

    def test_each_number_is_moved_and_taken_away_alone(self):
        numbers = {"one": ("double", 0.5, None), "two": ("int64_t", 3, 0)}
        off = {"as it is": {}, "two/off": {"two": 0}}
        self.assertEqual(dict(moved_alone(numbers, None)), off)
        self.assertEqual(dict(moved_alone(numbers, 2)), {**off, "one/down": {"one": 0.25}, "one/up": {"one": 1},
                                                         "two/down": {"two": 2}, "two/up": {"two": 6}})

    def test_all_numbers_move_at_once_by_the_design(self):
        rows = design(1)
        settings = moved_together({"one": ("double", 0.5, None)}, 2, rows)
        self.assertEqual([setting["one"] for _, setting in settings], [0.5 * 2.0**row[0] for row in rows])


if __name__ == "__main__":
    unittest.main()
