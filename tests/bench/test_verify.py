# SPDX-License-Identifier: AGPL-3.0-or-later
"""The cases of verify.py and how their runs are made, and the page that it and measurements.py write."""
import argparse
import time
import unittest
from unittest import mock

import page
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


class Written(unittest.TestCase):
    def setUp(self):
        self.path = fresh("page") / "page.md"
        self.page = page.Page(self.path, "# Page\n", {"a": "bench a", "b": "bench b", "c": "bench c"}, "make page")

    def write(self, digest, *names):
        with mock.patch.object(page, "sources_digest", lambda command: f"{digest}{command[-1]}"):
            self.page.write({name: self.page.section(name, f"Section {name}", "", f"Of {digest}.", "```\nx\n\ny\n```")
                             for name in names})
        return self.path.read_text()

    def test_sections_stay_while_their_sources_do(self):
        text = self.write("1", "c", "a")
        self.assertEqual(text, "# Page\n\n<!-- section a 1a -->\n## Section a\n\nOf 1.\n\n```\nx\n\ny\n```\n\n"
                               "<!-- section c 1c -->\n## Section c\n\nOf 1.\n\n```\nx\n\ny\n```\n\n"
                               "<!-- missing -->\nNot made on these sources: b (`make page`).\n")
        self.assertEqual(self.write("1"), text)
        self.assertEqual(self.write("1", "b").count("<!-- missing -->"), 0)
        text = self.write("2", "b")
        self.assertEqual(text.count("## Section"), 1)
        self.assertIn("Of 2.", text)
        self.assertIn("Not made on these sources: a, c (`make page`).", text)

    def test_the_sources_of_a_section(self):
        read = []
        with mock.patch.object(page, "run_text", lambda *line: read.append(line) or ""):
            for command in ("tests/bench/verify.py heads", "tests/bench/table1.py --cells 21M", "build/bin/x 500"):
                page.sources_digest(command)
        verify, table1, tests = read
        self.assertLessEqual({"tests/bench/foam_read.py", "tests/bench/verify.mk", "tests/cad"}, set(verify))
        self.assertNotIn(":(exclude)export", verify)
        self.assertLessEqual({"tests/bench/fill.py", "tests/measure/chew*", ":(exclude)export"}, set(table1))
        self.assertNotIn("tests/bench/foam_read.py", table1)
        self.assertLessEqual({"tests/mesher", ":(exclude)export", ":(exclude)pipeline/report"}, set(tests))


if __name__ == "__main__":
    unittest.main()
