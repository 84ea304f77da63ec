# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the bench of memory says of peaks that are known: how much less a rank of many holds, and the model."""
import io
import os
import subprocess
import sys
import unittest
from contextlib import redirect_stdout

import memory
from memory import MANY, Point, fit, modelled, print_less, print_model, shares_of

RANKS = (1, 2, 4, 8, 16, 32)
TRUE = (7e7, 100, 4e3, 2e4)  # of "largest": a rank, a cell of a region, a cell^(2/3), that over the ranks


def point(cells, regions, ranks, stretch=1):
    """With the peaks that TRUE gives, `stretch` times."""
    bare = Point(cells, regions, ranks, None, None)
    largest = stretch * sum(value * term for value, term in zip(TRUE, memory.TERMS["largest"](bare)))
    together = ranks * (7e7 + 100 * cells / regions) + 3e4 * cells ** (2 / 3)
    return bare._replace(together={stage: together for stage in memory.STAGES},
                         largest={stage: largest for stage in memory.STAGES})


def said(function, *arguments):
    text = io.StringIO()
    with redirect_stdout(text):
        function(*arguments)
    return text.getvalue()


def points(cells, regions, stretch=1):
    return [point(cells, regions, ranks, stretch) for ranks in RANKS]


KNOWN = points(8e6, 30) + points(38e6, 140) + points(145e6, 140)


class Model(unittest.TestCase):
    def test_it_finds_the_coefficients(self):
        for had, wanted in zip(fit(KNOWN, "largest", "mesh"), TRUE):
            self.assertAlmostEqual(had / wanted, 1, places=6)
        held = point(1e8, 140, 16)
        self.assertAlmostEqual(modelled(fit(KNOWN, "largest", "mesh"), "largest", held) / held.largest["mesh"], 1)
        self.assertAlmostEqual(modelled(fit(KNOWN, "together", "mesh"), "together", held) / held.together["mesh"], 1)

    def test_no_coefficient_is_below_0(self):
        falling = [one._replace(largest={"mesh": 1e9 * (8e6 / one.cells)}) for one in KNOWN]
        self.assertGreaterEqual(min(fit(falling, "largest", "mesh")), 0)

    def test_the_size_held_out_stands_beside_its_model(self):
        lines = said(print_model, KNOWN, points(1e8, 140, stretch=0.8)).splitlines()
        self.assertEqual(sum("not fitted" in line and "(+25 %)" in line for line in lines), 2 * len(RANKS))

    def test_the_large_run_is_judged(self):
        few = [one._replace(largest={stage: 2e8 for stage in memory.STAGES}) for one in KNOWN]
        self.assertIn("asked 1 GiB a rank: met", said(print_model, few, []))
        much = [one._replace(largest={stage: 3 * one.largest[stage] for stage in memory.STAGES}) for one in KNOWN]
        self.assertIn("in 500 regions on 64 ranks", said(print_model, much, []))
        self.assertIn("asked 1 GiB a rank: missed", said(print_model, much, []))


class Less(unittest.TestCase):
    def test_the_largest_of_many_ranks_beside_one_alone(self):
        for times, verdict in ((3.1, "met"), (2.9, "missed")):
            rows = [Point(1, 1, ranks, None, {stage: bytes_ for stage in memory.STAGES})
                    for ranks, bytes_ in ((1, times * 1e8), (MANY, 1e8))]
            self.assertEqual(said(print_less, rows).count(f"holds {times:.2f} times less than 1 alone; asked 3: "
                                                          f"{verdict}\n"), 2)
        self.assertEqual(said(print_less, rows[:1]), "")


class Watched(unittest.TestCase):
    def test_only_own_processes_count(self):
        program = os.path.realpath(sys.executable)
        child = subprocess.Popen([program, "-c", "import sys; print(flush=True); sys.stdin.read()"],
                                 stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        child.stdout.readline()
        self.assertEqual(len(shares_of(program, os.getpid())), 1)
        self.assertEqual(shares_of(program, child.pid), [])
        child.communicate()


if __name__ == "__main__":
    unittest.main()
