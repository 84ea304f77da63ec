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


if __name__ == "__main__":
    unittest.main()
