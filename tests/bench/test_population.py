# SPDX-License-Identifier: AGPL-3.0-or-later
"""12 random pumps by their duty alone and 12 with options, through all stages: what the geometry accepts is meshed and
written, and judged good by all rules of --strict."""
import sys
import unittest

from cutwater import BIN, SOURCE, WORK, said

COUNT = 12


class Population(unittest.TestCase):
    def judge(self, *words):
        program = SOURCE / "tests/bench/population.py"
        line = [sys.executable, "-B", program, COUNT, "--strict", *words, "--bin", BIN, "--work", WORK / "population"]
        said(self, line, timeout=7000)

    def test_duty_only(self):
        self.judge()

    def test_with_options(self):
        self.judge("--options")


if __name__ == "__main__":
    unittest.main()
