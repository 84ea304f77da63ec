# SPDX-License-Identifier: AGPL-3.0-or-later
"""The cases of verify.py and how their runs are made."""
import argparse
import time
import unittest
from unittest import mock

import programs
import verify
from cutwater import fresh


class Runs(unittest.TestCase):
    def setUp(self):
        self.bench = verify.Bench(argparse.Namespace(runs=fresh("verify"), small=True))

    def said(self, *words, **variables):
        """What make would do."""
        def execute(*line):
            return programs.execute(*line, "-n", "-B")
        with mock.patch.object(verify, "execute", execute):
            return self.bench.make(*words, **variables)

    def test_runs_are_made_by_the_rules_of_the_cases(self):
        run = self.bench.case("tried", verify.case_text("paper", outlet_width_mm=7))
        case = self.bench.folder / "cases/tried/case.yaml"
        self.assertIn("  outlet_width_mm: 7\n", case.read_text())
        self.assertEqual(run, self.bench.folder / "runs/tried")
        stages = f"--case {case} --run {run}"
        told = self.said(run, "solve", CELLS=40000)
        for stage in ("geometry", "mesh", "export", "report"):
            self.assertIn(f"{programs.SOURCE}/build/bin/cutwater-{stage} {stages} --cells 40000", told)
        self.assertRegex(told, rf"solve\.py {stages} .* --most 100 ")
        told = self.said(run, "faces")
        self.assertIn(f"cutwater-geometry {stages}", told)
        self.assertNotIn("cutwater-mesh --case", told)
        told = self.said(run, "sweep", SWEEP="40k 60k", SOLVE=1)
        self.assertIn(f"sweep.py {run}-sweep.csv {run}-40k {run}-60k\n", told)

    def test_a_case_is_written_where_it_is_another_one(self):
        case = self.bench.case("tried", "name: one\n").parents[1] / "cases/tried/case.yaml"
        written = case.stat().st_mtime_ns
        time.sleep(0.02)
        self.bench.case("tried", "name: one\n")
        self.assertEqual(case.stat().st_mtime_ns, written)
        self.bench.case("tried", "name: two\n")
        self.assertGreater(case.stat().st_mtime_ns, written)


if __name__ == "__main__":
    unittest.main()
