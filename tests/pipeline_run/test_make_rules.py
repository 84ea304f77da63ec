# SPDX-License-Identifier: AGPL-3.0-or-later
"""The make rules with stages that only note their call: what runs when, and what a failing stage does."""
import json
import os
import re
import shutil
import sys
import tempfile
import time
import unittest
from pathlib import Path

from cutwater import SOURCE, execute, without_make

sys.path.insert(0, str(SOURCE / "pipeline"))
import stage_files  # noqa: E402

STAGES = ("geometry", "mesh", "export", "report")
STAGE = """#!/bin/sh
# NAME ARGUMENTS...: notes its call and writes what the stage would write last.
name=${0##*/cutwater-}
echo "$name $*" >> %(calls)s
if [ -e %(fail)s ] && [ "$(cat %(fail)s)" = "$name" ]; then echo "cutwater-$name: error: asked to fail" >&2; exit 8; fi
while [ "$1" != --run ]; do shift; done
mkdir -p "$2/$name"
case $name in
geometry) results='"predicted_head_m": 12' ;;
mesh) results='"cells": 5, "asked_cells": 5, "ranks": 2, "headlines": ["laminar flow"],
  "domains": [%(domain)s]' ;;
*) results= ;;
esac
echo "{\\"seconds\\": 1, \\"peak_memory_bytes\\": 1, \\"warnings\\": [], \\"results\\": {$results}}" \\
  > "$2/$name/record.json"
echo > "$2/$name/index.html"
"""
LAUNCHER = """#!/bin/sh
# Notes its name and arguments, and starts one rank of the program behind them.
echo "${0##*/} $*" >> %(launches)s
while [ "${1#%(bin)s/cutwater-}" = "$1" ]; do shift; done
exec "$@"
"""
DOMAIN = json.dumps({"name": "rotor", "regions": 4, "tetrahedra": 0, "prisms": 5, "layer_coverage": [],
                     "volume_error": -0.001, "least_cell_volume_m3": 1e-12})
MAKEFILE = """
ROOT := %(source)s
BIN := %(bin)s
include $(ROOT)/pipeline/run.mk
FORCE:
$(eval $(call cutwater_run,pump,%(case)s,%(run)s,$(CELLS)))
"""


class MakeRules(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        folder = Path(self.holder.name)
        self.calls, self.failing = folder / "calls", folder / "fail"
        self.case, self.run_folder, self.bin = folder / "case.yaml", folder / "runs/pump", folder / "bin"
        self.bin.mkdir()
        self.case.write_text("name: pump\n")
        for name in STAGES:
            program = self.bin / f"cutwater-{name}"
            program.write_text(STAGE % {"calls": self.calls, "fail": self.failing, "domain": DOMAIN})
            program.chmod(0o755)
        self.launches = folder / "launches"
        for name in ("mpirun", "srun"):
            (self.bin / name).write_text(LAUNCHER % {"launches": self.launches, "bin": self.bin})
            (self.bin / name).chmod(0o755)
        self.makefile = folder / "Makefile"
        self.makefile.write_text(MAKEFILE % {"source": SOURCE, "bin": self.bin, "case": self.case,
                                             "run": self.run_folder})

    def tearDown(self):
        self.holder.cleanup()

    def make(self, *words):
        """Calls make; gives its result and the stages that ran."""
        self.calls.write_text("")
        time.sleep(0.02)  # file times must differ
        self.launches.write_text("")
        result = execute(["make", "-f", self.makefile, "pump", *words], self.holder.name,
                         environment=without_make(self.bin))
        return result, [line.split()[0] for line in self.calls.read_text().splitlines()]

    def test_all_stages_in_turn_and_then_none(self):
        result, ran = self.make()
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(ran, list(STAGES))
        self.assertNotIn("--cells", self.calls.read_text())
        result, ran = self.make()
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(ran, [])
        self.assertIn("5 (+0.0 % of the 5 asked)", result.stdout)
        self.assertIn("12.00 m predicted", result.stdout)
        self.assertIn("note       laminar flow", result.stdout)
        self.assertIn("report/index.html", result.stdout)

    def test_memory_is_told_for_the_ranks_of_this_machine(self):
        for words, told in (((), "--ranks 2"), (("NP=5",), "--ranks 5")):
            self.assertRegex(self.make("-n", *words)[0].stdout, rf"needs\.py .* {told}")
        hosts = self.case.with_name("hosts")
        hosts.write_text("node01 slots=24\n")
        for words in (("LAUNCHER=srun -n 256",), (f"HOSTS={hosts}", "NP=48")):
            self.assertNotRegex(self.make("-n", *words)[0].stdout, r"needs\.py .*--ranks")

    def test_a_flow_that_was_solved_on_another_export_is_not_told(self):
        self.make()
        (self.run_folder / "solve").mkdir()
        solved = {"warnings": [], "results": {"headline": "head 9 m"}}
        for made_from, told in ((stage_files.of_export({}), "head 9 m"),
                                (stage_files.of_export({"files": {"a": "1"}}), "on another export; solve it again")):
            (self.run_folder / "solve/record.json").write_text(json.dumps({**solved, "made_from": made_from}))
            self.assertIn(f"solved     {told}\n", self.make()[0].stdout)

    def test_another_count_leaves_the_geometry(self):
        self.make("CELLS=100k")
        self.assertEqual(self.calls.read_text().count("--cells 100k"), 4)
        self.assertEqual(self.make("CELLS=100k")[1], [])
        self.assertEqual(self.make("CELLS=200k")[1], ["mesh", "export", "report"])
        self.assertEqual(self.make()[1], ["mesh", "export", "report"])

    def test_a_changed_input_of_the_geometry_begins_anew(self):
        drawing = self.case.with_name("pump.Step")
        drawing.write_text("a drawing")
        self.assertEqual(self.make()[1], list(STAGES))
        record = self.run_folder / "geometry/record.json"
        times = record.stat()
        record.write_text(json.dumps({"stage": "geometry", "results": {"predicted_head_m": 12},
                                      "inputs": {str(drawing): "0f", "/none/other.brep": "1e"}, "files": {}}, indent=2))
        os.utime(record, ns=(times.st_atime_ns, times.st_mtime_ns))
        self.assertEqual(self.make()[1], [])
        drawing.write_text("another drawing")
        self.assertEqual(self.make()[1], list(STAGES))

    def test_another_case_in_the_same_folder_begins_anew(self):
        other = self.case.with_name("other.yaml")
        other.write_text("name: other\n")  # older than all that the first run makes
        time.sleep(0.02)
        self.assertEqual(self.make()[1], list(STAGES))
        self.makefile.write_text(self.makefile.read_text().replace(str(self.case), str(other)))
        self.assertEqual(self.make()[1], list(STAGES))
        self.assertEqual(self.make()[1], [])

    def test_a_folder_that_cannot_be_made_is_told_before_anything_runs(self):
        self.run_folder.parent.mkdir()
        self.run_folder.write_text("")
        result, ran = self.make()
        self.assertEqual(ran, [])
        self.assertEqual(result.returncode, 2)
        self.assertIn(f"{self.run_folder}", result.stdout.splitlines()[0])
        self.assertEqual(len(result.stdout.splitlines()), 2, "beside its line only make's own")

    def test_other_ranks_change_nothing(self):
        self.make("NP=1")
        self.assertEqual(self.make("NP=3")[1], [])

    def launched(self, *words):
        """How a run starts the mesher; exporter and report the same way."""
        result, ran = self.make(*words)
        self.assertEqual((result.returncode, ran), (0, list(STAGES)), result.stdout)
        lines = [line.partition(f" {self.bin}/cutwater-") for line in self.launches.read_text().splitlines()]
        self.assertEqual([line[2].split()[:2] for line in lines], [[name, "--case"] for name in STAGES[1:]])
        shutil.rmtree(self.run_folder)
        starts = {line[0] for line in lines}
        self.assertEqual(len(starts), 1, starts)
        return starts.pop()

    def test_who_starts_the_ranks(self):
        hosts = self.makefile.with_name("hosts")
        hosts.write_text("localhost slots=3\n")
        self.assertEqual(self.launched(), "mpirun -q --oversubscribe --bind-to none -n 2")
        self.assertEqual(self.launched("NP=5"), "mpirun -q --oversubscribe --bind-to none -n 5")
        self.assertEqual(self.launched(f"HOSTS={hosts}"), f"mpirun -q --hostfile {hosts}")
        self.assertEqual(self.launched(f"HOSTS={hosts}", "NP=2"), f"mpirun -q --hostfile {hosts} -n 2")
        self.assertEqual(self.launched("LAUNCHER=srun -n 256 --exclusive"), "srun -n 256 --exclusive")

    def test_a_new_case_or_program_runs_what_depends_on_it(self):
        self.make()
        time.sleep(0.02)
        self.case.write_text("name: pump\n# other\n")
        self.assertEqual(self.make()[1], list(STAGES))
        for index, name in enumerate(STAGES):
            time.sleep(0.02)
            (self.bin / f"cutwater-{name}").touch()
            self.assertEqual(self.make()[1], list(STAGES[index:]))

    def test_a_failing_stage_stops_and_is_tried_again(self):
        self.failing.write_text("mesh")
        result, ran = self.make()
        self.assertEqual(ran, ["geometry", "mesh"])
        self.assertNotEqual(result.returncode, 0)
        lines = result.stdout.strip().splitlines()
        self.assertEqual(lines[0], "cutwater-mesh: error: asked to fail")
        self.assertEqual(len(lines), 2, "beside the stage's line only make's own")
        self.failing.unlink()
        self.assertEqual(self.make()[1], ["mesh", "export", "report"])


class FrontDoor(unittest.TestCase):
    def make(self, *words):
        return execute(["make", "-C", SOURCE, "-n", "-B", *words], environment=without_make())

    def test_options_reach_the_stages(self):
        told = self.make("paper", "CELLS=2M", "NP=3", "OUT=/nowhere/run").stdout
        self.assertIn(f"-n 3 {SOURCE}/build/bin/cutwater-mesh --case {SOURCE}/cases/paper/case.yaml --run /nowhere/run "
                      "--cells 2M", told)

    def test_parts_and_sections_reach_the_benches(self):
        self.assertIn("tests/bench/verify.py heads ubaldi\n", self.make("verify", "PARTS=heads ubaldi").stdout)
        self.assertIn("tests/bench/measurements.py scale\n", self.make("measurements", "SECTIONS=scale").stdout)

    def test_the_flow_is_solved_by_the_ranks_of_this_machine(self):
        told = self.make("solve", "LAUNCHER=srun -n 64", "NP=6").stdout
        self.assertIn(f"srun -n 64 {SOURCE}/build/bin/cutwater-mesh", told)
        self.assertIn("--ranks 6", told)

    def test_the_most_iterations_reach_the_solver_of_the_flow(self):
        self.assertRegex(self.make("solve", "MOST=8000").stdout, r"solve\.py .* --most 8000 ")
        self.assertRegex(self.make("-C", "cases", "paper-curve", "MOST=20").stdout, r"solve\.py .* --most 20 --curve")
        self.assertNotIn("--most", self.make("solve").stdout)

    def test_what_a_solved_flow_needs_is_told(self):
        for words, solved in ((["paper"], []), (["solve"], ["--solve"]), (["curve"], ["--curve"]),
                              (["-C", "cases", "ns40"], []), (["-C", "cases", "ns40-curve"], ["--curve"]),
                              (["-C", "cases", "ns40-sweep", "SWEEP=40k"], []),
                              (["-C", "cases", "ns40-sweep", "SWEEP=40k", "SOLVE=1"], ["--solve"])):
            lines = re.findall(r".*needs\.py .*", self.make(*words).stdout)
            self.assertEqual([re.findall("--solve|--curve", line) for line in lines], [solved], words)

    def test_a_wrong_variable_is_refused_before_anything_runs(self):
        for words, told in ((["CELLS=abc"], "CELLS is 'abc'; allowed: a number of cells as 500000 or 500k or 2M"),
                            (["CELLS=2m"], "CELLS is '2m'"), (["CELLS=1 2"], "CELLS is '1 2'"),
                            (["CELLS=1'"], "CELLS is '1''"), (["NP=0"], "NP is '0'; allowed: a number of ranks from 1"),
                            (["NP=two"], "NP is 'two'"), (["NP="], "NP is ''"),
                            (["HOSTS=none"], "HOSTS is '%s/none'; allowed: a file with a line 'NAME slots" % SOURCE),
                            (["HOSTS=README.md", "LAUNCHER=srun"], "HOSTS is for mpirun, and LAUNCHER is given"),
                            (["NP=4", "LAUNCHER=srun"], "NP is for mpirun, and LAUNCHER is given; allowed: the number"),
                            (["JOBS=0"], "JOBS is '0'"),
                            (["MOST=all"], "MOST is 'all'; allowed: a number of iterations from 1 on"),
                            (["MOST=0"], "MOST is '0'"),
                            (["OUT="], "OUT is ''; allowed: one folder, without blanks"), (["OUT=a b"], "OUT is 'a b'"),
                            (["OUT=R&D"], "OUT is 'R&D'; allowed: one folder, without blanks, of letters, d"),
                            (["OUT=a:b"], "OUT is 'a:b'"), (["OUT=it's"], "OUT is 'it's'"),
                            (["CELL=2M"], "CELL is no variable of this project; allowed: BUILD CELLS "),
                            (["BUILD=a b"], "BUILD is 'a b'"), (["-C", "cases", "SWEEP=100k x"], "SWEEP is 'x'"),
                            (["-C", "cases", "OUT="], "OUT is ''"),
                            (["-C", "cases", "ns40-solve", "OUT=x"], "but there are several: ns40 paper"),
                            (["-C", "cases", "paper-sweep", "OUT=x"], "there are several: paper paper-sweep"),
                            (["-C", "cases", "SOLVE=0"], "SOLVE is '0'; allowed: 1 where a sweep solves"),
                            (["-C", "cases", "nothing"], "no case is called 'nothing'; allowed: ")):
            with self.subTest(words):
                result = self.make("paper", *words)
                self.assertEqual(result.returncode, 2, result.stdout)
                told_lines = [line for line in result.stdout.splitlines() if "ing directory" not in line]
                self.assertEqual(len(told_lines), 1, result.stdout)
                self.assertIn(told, told_lines[0])

    def test_cases_by_name(self):
        told = self.make("-C", "cases", "paper").stdout
        self.assertIn(f"--run {SOURCE}/runs/paper", told)
        told = self.make("-C", "cases", "paper", "OUT=elsewhere").stdout
        self.assertIn(f"--case {SOURCE}/cases/paper/case.yaml --run {SOURCE}/elsewhere", told)
        self.assertNotIn("overriding", told, "rules of another case for the same folder")
        told = self.make("-C", "cases", "paper-sweep", "SWEEP=100k 200k").stdout
        for cells in ("100k", "200k"):
            self.assertIn(f"--run {SOURCE}/runs/paper-{cells} --cells {cells}", told)
        self.assertRegex(told, "(?m)^2 runs, 300,000 cells: ")

    def test_sweeps_into_a_folder(self):
        told = self.make("-C", "cases", "paper-sweep", "ns40-sweep", "SWEEP=100k 200k", "OUT=/nowhere").stdout
        self.assertRegex(told, "(?m)^4 runs, 600,000 cells: ")
        for name in ("paper", "ns40"):
            for cells in ("100k", "200k"):
                self.assertIn(f"--run /nowhere/{name}-{cells} --cells {cells}", told)
            self.assertIn(f"sweep.py /nowhere/{name}-sweep.csv /nowhere/{name}-100k /nowhere/{name}-200k\n", told)
        self.assertNotIn(f"{SOURCE}/runs", told)


class Installed(unittest.TestCase):
    """The make rules in a prefix, called from another folder."""

    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.here = Path(self.holder.name) / "here"

    def tearDown(self):
        self.holder.cleanup()

    def make(self, prefix, *words):
        share = Path(self.holder.name) / prefix
        for name in ("cases/Makefile", "cases/paper/case.yaml", "pipeline/require.mk", "pipeline/run.mk"):
            (share / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCE / name, share / name)
        rules = (SOURCE / "pipeline/installed.mk.in").read_text().replace("@CUTWATER_BIN_FROM_SHARE@", "bin")
        (share / "pipeline/build.mk").write_text(rules)
        self.here.mkdir(exist_ok=True)
        return execute(["make", "-f", share / "cases/Makefile", *words], self.here, environment=without_make())

    def test_cases_with_odd_names_are_left_out_and_told(self):
        self.assertEqual(self.make("prefix").stdout, "paper\n")
        for name in ("mine", "my case", "R&D", "it's", "50%"):
            (self.here / "cases" / name).mkdir(parents=True)
            (self.here / "cases" / name / "case.yaml").write_text("")
        lines = self.make("prefix").stdout.splitlines()
        self.assertEqual([line for line in lines if "warning" not in line], ["mine", "paper"])
        self.assertEqual(sorted(line.split("'; ")[0].split("' is left out")[0] for line in lines if "warning" in line),
                         sorted(f"cases: warning: '{name}" for name in ("my case", "R&D", "it's", "50%")))
        self.assertIn("no case is called 'my case'; allowed: mine paper, ", self.make("prefix", "my case").stdout)

    def test_an_odd_prefix_is_refused(self):
        for prefix in ("my pump", "R&D", "it's"):
            result = self.make(prefix, "paper")
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertRegex(result.stdout, rf"\*\*\* Cutwater lies in '.*{prefix}.*'; allowed: a path without blanks")
            self.assertEqual(len(result.stdout.splitlines()), 1, result.stdout)


if __name__ == "__main__":
    unittest.main()
