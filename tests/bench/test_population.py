# SPDX-License-Identifier: AGPL-3.0-or-later
"""12 random pumps by their duty alone and 12 with options, through all stages: what the geometry accepts is meshed and
written, and judged good."""
import sys
import unittest

import population
from cutwater import BIN, SOURCE, WORK, execute

COUNT = 12


class Population(unittest.TestCase):
    def judge(self, *words):
        program = SOURCE / "tests/bench/population.py"
        line = [sys.executable, "-B", program, COUNT, "--strict", *words, "--bin", BIN, "--work", WORK / "population"]
        told = execute(line, timeout=7000)
        self.assertEqual(told.returncode, 0, told.stdout)

    def test_duty_only(self):
        self.judge()

    def test_with_options(self):
        self.judge("--options")

    def test_messages_are_grouped_without_their_numbers(self):
        first, second = (population.cause(f"/a/duty-1-{n}.yaml:{n}:3: {n}.5 mm at (1e-{n}, -2, 3)", f"duty-1-{n}")
                         for n in (3, 14))
        self.assertEqual(first, second)

    def test_prisms_explain_what_the_exporter_counted(self):
        zones = [{"skew_faces_of_prisms": 3, "small_weight_faces_of_prisms": 0},
                 {"skew_faces_of_prisms": 4, "small_weight_faces_of_prisms": 12}]
        weight = "Faces with small interpolation weight (< 0.05) found, number of faces: {}"
        skew = "Max skewness = 9.1, {} highly skew faces detected which may impair the quality of the results"
        for line, told in ((weight.format(12), True), (weight.format(13), False), (skew.format(7), True),
                           (skew.format(3), False), ("Concave cells found, number of cells: 7", False)):
            self.assertEqual(population.prisms_explain(line, zones), told, line)


if __name__ == "__main__":
    unittest.main()
