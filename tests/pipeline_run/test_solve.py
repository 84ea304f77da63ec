# SPDX-License-Identifier: AGPL-3.0-or-later
"""The stage `solve`: what is read of the solver's reports, from where a flow starts, and a real one on a small mesh:
killed, gone on with, its result beside the energy balance, its curve, its page in a browser, and what is told where it
cannot be solved. CUTWATER_MOST ends each flow after as many iterations; without it flows settle."""
import csv
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path
from unittest import mock

import browser
from cutwater import BIN, CELLS, ENVIRONMENT, PAPER, SOURCE, done, execute, fresh, record, said, with_stages

sys.path.insert(0, str(SOURCE / "pipeline/solve"))
import foam  # noqa: E402
import reports  # noqa: E402
import settling  # noqa: E402
import solve  # noqa: E402
import stage_files  # noqa: E402

MOST = os.environ.get("CUTWATER_MOST")  # more than 100, the iterations of the first fields, and less than settle


def history(value, count=1000, step=10):
    return {i: {"head_m": value(i), "torque_n_m": 2 * value(i)} for i in range(step, count + 1, step)}


class Reports(unittest.TestCase):
    @staticmethod
    def write(case, name, start, file, text):
        folder = case / "postProcessing" / name / start
        folder.mkdir(parents=True, exist_ok=True)
        (folder / file).write_text(text)

    def test_files_of_later_starts_go_before_and_unfinished_lines_do_not_count(self):
        case = fresh("solve_reports")

        def write(*given):
            self.write(case, *given)

        write("head", "0", "fieldValueDelta.dat", "# head\n# Time\tsubtract(totalHead)\n10\t1.5\n20\t2.5\n30\t9\n")
        write("head", "20", "fieldValueDelta.dat", "# Time\n30\t3.5\n40\t")
        moment = "# Time\ttotal_x\n10\t(0 0 -7) (0 0 0) (0 0 0)\n20\t(0 0 -8) (0 0 0) (0 0 0)\n30\t(0 0 -9) (0 0 0)\n"
        write("torque", "0", "moment.dat", moment)
        names = "# Solver info\n# Time\tU_solver\tUx_initial\tUy_initial\tUz_initial\tp_initial\n"
        write("solverInfo", "0", "solverInfo.dat", names + "10\tsmooth\t1e-3\t3e-3\t2e-3\t5e-2\n20\tsmooth\t1e-3\n")
        write("leastPressure", "0", "fieldMinMax.dat", "# Field minima and maxima\n# Time\tmin(p)\n10\t-98.0665\t3\n")
        self.assertEqual(reports.history(case), {
            10: {"head_m": 1.5, "torque_n_m": 7, "npsh_inception_m": 98.0665 / 9.80665,
                 "residual_p": 5e-2, "residual_u": 3e-3},
            20: {"head_m": 2.5, "torque_n_m": 8}, 30: {"head_m": 3.5, "torque_n_m": 9}})
        self.assertEqual(reports.history(case / "none"), {})

    def test_a_solver_that_started_again_goes_before_the_one_that_was_stopped(self):
        case = fresh("solve_again")

        def write(start, end, values):
            heads = "# Time\n" + "".join(f"{iteration}\t{head}\n" for iteration, head in values)
            moments = "# Time\n" + "".join(f"{iteration}\t(0 0 -{head}) (0 0 0)\n" for iteration, head in values)
            self.write(case, "head", start, f"fieldValueDelta{end}.dat", heads)
            self.write(case, "torque", start, f"moment{end}.dat", moments)

        def heads():
            return {iteration: row["head_m"] for iteration, row in reports.history(case).items()}

        # Stopped at 30, before the first fields: OpenFOAM keeps the file, and begins another one beside it.
        write("0", "", [(10, 1), (20, 2), (30, 3)])
        write("0", "_0", [(10, 5)])
        self.assertEqual(heads(), {10: 5})
        write("0", "_0", [(iteration, 5) for iteration in range(10, 160, 10)])
        # Stopped at 150, with fields of 100.
        write("100", "", [])
        self.assertEqual(heads(), {iteration: 5 for iteration in range(10, 110, 10)})
        write("100", "", [(110, 7)])
        self.assertEqual(max(heads()), 110)
        self.write(case, "yPlus", "100", "yPlus.dat", "# Time\tpatch\n200\thub\t1\t9\t5\n")
        self.write(case, "yPlus", "100", "yPlus_100.dat", "# Time\tpatch\n200\thub\t2\t8\t4\n")
        self.assertEqual(reports.y_plus(case), {"hub": {"least": 2, "most": 8, "mean": 4}})

    def test_a_solver_that_ended_by_itself_has_converged(self):
        case = fresh("solve_converged")
        self.assertFalse(reports.converged(case))
        log, start, end = case / "log.simpleFoam", "Starting time loop\n", "SIMPLE solution converged in 9 iterations\n"
        for text, converged in ((start + "Time = 10\n", False), (start + end, True), (start + end + start, False)):
            log.write_text(text)
            self.assertIs(reports.converged(case), converged)


class Case(unittest.TestCase):
    def exported(self, name, method="scotch"):
        """A run with an exported case."""
        run = fresh(name) / "run"
        for folder in ("system", "constant/polyMesh"):
            (run / "export/openfoam" / folder).mkdir(parents=True)
        (run / "export/openfoam/system/decomposeParDict").write_text(f"method {method};")
        self.fields(run / "export/openfoam", 0, ("U", "p", "epsilon", "omega"))
        return run

    def test_a_run_that_is_moved_keeps_its_mesh(self):
        run = self.exported("solve_moved")
        (run / "export/openfoam/constant/polyMesh/points").write_text("here")
        foam.prepare(run / "export/openfoam", run / "solve/steady", 1, {}, lambda: None)
        moved = run.rename(run.with_name("moved"))
        self.assertEqual((moved / "solve/steady/constant/polyMesh/points").read_text(), "here")

    @staticmethod
    def fields(folder, iteration, names=("U", "p", "omega")):
        """Written as OpenFOAM writes them."""
        (folder / str(iteration) / "uniform").mkdir(parents=True, exist_ok=True)
        for name in (*names, "uniform/time"):
            (folder / str(iteration) / name).write_bytes(b"as many as cells\n\n// " + 73 * b"*" + b" //\n")

    def prepared(self, run, ranks, start, failing=False):
        """Prepares a case for the ranks; the programs that were called."""
        called = []

        def call(folder, log, *line):
            called.append(" ".join(map(str, line)))
            if line[0] == "reconstructPar" and failing:
                raise foam.Trouble("as the test has it")
            if line[0] == "reconstructPar":
                self.fields(folder, line[2])
            if line[0] == "decomposePar":
                for part in range(ranks):
                    self.fields(folder / f"processor{part}", max(foam.times(folder), default=0))

        with mock.patch.multiple(foam, call=call, set_entry=lambda *_: None):
            foam.prepare(run / "export/openfoam", run / "solve/steady", ranks, {}, start)
        parts = sorted(path.name for path in (run / "solve/steady").glob("processor*"))
        self.assertEqual(parts, [f"processor{part}" for part in range(ranks)] if ranks > 1 else [])
        return [line for line in called if "foamDictionary" not in line and "renumberMesh" not in line]

    def test_other_ranks_go_on_from_the_latest_fields(self):
        run = self.exported("solve_ranks", "hierarchical")
        case, divided = run / "solve/steady", "decomposePar -force -latestTime -copyUniform"
        start = mock.Mock(return_value=None)
        self.assertEqual(self.prepared(run, 2, start), [divided])
        self.assertEqual(self.prepared(run, 2, start), [])
        for part in (0, 1):
            for iteration in (100, 200, 300):
                self.fields(case / f"processor{part}", iteration)
        os.truncate(case / "processor1/300/p", 50)
        self.assertEqual(self.prepared(run, 3, start), ["reconstructPar -time 200", divided])
        self.assertEqual(foam.times(case / "processor2"), [200])
        self.assertEqual(self.prepared(run, 1, start), [])  # they are together already
        self.assertEqual(foam.times(case), [200])
        self.assertEqual(self.prepared(run, 2, start), [divided])
        start.assert_called_once_with()
        # What fails for another reason leaves the fields where they are.
        for part in (0, 1):
            for iteration in (400, 500):
                self.fields(case / f"processor{part}", iteration)
        with self.assertRaises(foam.Trouble):
            self.prepared(run, 1, start, failing=True)
        self.assertEqual(foam.times(case / "processor0"), [500, 400, 200])
        (run / "export/openfoam/system/fvSchemes").write_text("other")
        self.assertEqual(self.prepared(run, 2, start), [divided])
        self.assertEqual((start.call_count, foam.times(case)), (2, []))

    def test_fields_that_a_killed_solver_has_not_finished_are_dropped(self):
        run = self.exported("solve_unfinished")
        case, start = run / "solve/steady", mock.Mock(return_value=None)
        for ranks in (1, 2):
            self.prepared(run, ranks, start)
            parts = [case / f"processor{part}" for part in range(ranks)] if ranks > 1 else [case]
            last = parts[-1] / "300"
            for unfinished in (lambda: os.truncate(last / "omega", 90), lambda: os.truncate(last / "U", 0),
                               lambda: (last / "p").unlink(), lambda: shutil.rmtree(last),
                               lambda: [(part / "300/p").unlink() for part in parts],
                               lambda: [(part / "300/omega").unlink() for part in parts],
                               lambda: [(part / f"300/{name}").unlink() for part in parts for name in ("U", "p")]):
                for part in parts:
                    for iteration in (100, 200, 300):
                        self.fields(part, iteration)
                self.assertEqual(self.prepared(run, ranks, start), [])
                self.assertEqual([max(foam.times(part)) for part in parts], [300] * ranks)
                unfinished()
                self.assertEqual(self.prepared(run, ranks, start), [])
                self.assertEqual([max(foam.times(part)) for part in parts], [200] * ranks)
                self.assertFalse(any((part / "300").exists() for part in parts))
            for part in parts:
                (part / "100/p").unlink()  # not looked at: the solver goes on from 200
            self.prepared(run, ranks, start)
            self.assertEqual([foam.times(part)[:2] for part in parts], [[200, 100]] * ranks)
        start.assert_called_once_with()

    def test_a_coarse_start_finds_its_geometry(self):
        folder = fresh("solve_coarse") / "run"
        (folder / "geometry").mkdir(parents=True)
        (folder / "solve/coarse").mkdir(parents=True)
        (folder / "solve/coarse/geometry").symlink_to("/nowhere")  # as the folder was moved
        options = mock.Mock(ranks=1, bin="bin", case=Path("case.yaml"))
        run = mock.Mock(options=options, folder=folder, cells=10**6, rest=settling.Rest(0.003))
        with mock.patch.object(foam, "call"), mock.patch.multiple(solve, Run=mock.Mock(), solve_design=mock.Mock()):
            solve.coarse_start(run)
        self.assertTrue((folder.rename(folder.with_name("moved")) / "solve/coarse/geometry").is_dir())

    def test_a_flow_starts_from_rest_where_no_coarse_one_can_be_had(self):
        folder = fresh("solve_no_coarse") / "run"
        (folder / "geometry").mkdir(parents=True)
        run = mock.Mock(options=mock.Mock(ranks=1, bin="bin", case=Path("case.yaml")), folder=folder,
                        rest=settling.Rest(0.003))
        for cells, told in ((10**6, ["starts from rest, for there is no start with 125,000 cells: mpirun ended"]),
                            (10**5, [])):
            run.cells, said_here = cells, []
            with mock.patch.object(foam, "call", mock.Mock(side_effect=foam.Trouble("mpirun ended"))), \
                    mock.patch.object(solve, "say", said_here.append):
                self.assertIsNone(solve.coarse_start(run))
            self.assertEqual([text for text in said_here if "cells: mesh" not in text], told)

    def test_a_killed_solver_goes_on_from_its_fields_and_not_from_its_reports(self):
        case = fresh("solve_behind")
        ran, reported = [], history(lambda i: 10.0, 390)

        def run_solver(*_):
            ran.append(foam.solved(case))
            reported.update(history(lambda i: 10.0, 400))
            for folder in places:
                (folder / "400").mkdir(parents=True)
                (folder / "400/U").write_text("")

        for ranks, places in ((1, [case]), (2, [case / "processor0", case / "processor1"])):
            for folder in (case, *places):  # together the fields of 200, in parts those of 300
                for iteration in (200, 300) if folder in places else (200,):
                    (folder / str(iteration)).mkdir(parents=True, exist_ok=True)
                    (folder / str(iteration) / "U").write_text("")
            with mock.patch.multiple(foam, set_entry=lambda *_: None, call=mock.Mock(), run_solver=run_solver), \
                    mock.patch.object(reports, "history", lambda _: dict(reported)):
                # Of 300 iterations there are not yet three windows.
                self.assertEqual(max(foam.iterate(case, ranks, 4000, settling.Rest(0.003), "flow")), 400)
            shutil.rmtree(case)
            reported = history(lambda i: 10.0, 390)
        self.assertEqual(ran, [300, 300])


class Words(unittest.TestCase):
    def test_the_residual_is_warned_of_only_where_the_flow_has_settled(self):
        results = {"iterations": 9, "residual_p": 0.5, "head_scatter_m": None}
        for settled, words in ((True, "the residual of p is 5.0e-01"), (False, "go on with a larger MOST, or")):
            found = solve.warnings_of({**results, "settled": settled}, "q0700")
            self.assertEqual(len(found), 1, found)
            self.assertIn(words, found[0])

    def test_a_state_is_denied_only_where_the_residual_has_come_to_rest(self):
        results = {"settled": True, "iterations": 9, "residual_p": 5e-4, "head_scatter_m": 0.1}
        for falls, denied in ((False, True), (True, False), (None, False)):
            (found,) = solve.warnings_of({**results, "residual_p_falls": falls}, "q0700")
            self.assertIn("5.0e-04, above 0.0001, where the run was stopped as head and torque had settled", found)
            self.assertEqual("no such state" in found, denied)

    def test_what_cannot_be_solved_is_told_in_one_line(self):
        run = fresh("solve_words")
        (run / "export").mkdir()
        (run / "export/record.json").write_text("{}")
        line = [sys.executable, SOURCE / "pipeline/solve/solve.py", "--case", PAPER, "--run", run]
        self.assertRegex(execute(line).stdout, r"^cutwater-solve: error: .*no case; let export.formats of .*\n$")
        (run / "export/openfoam/system").mkdir(parents=True)
        (run / "log").write_text("in the place of a folder")
        self.assertRegex(execute(line).stdout, r"^cutwater-solve: error: .*File exists.*\n$")

    def test_an_export_of_another_mesh_is_told(self):
        run = fresh("solve_stale")
        case = {"fluid.density_kg_per_m3": 998.2, "operating_point.flow_rate_m3_per_h": 25,
                "operating_point.head_m": 10, "operating_point.speed_rpm": 1450}
        mesh = {"files": {"manifest.json": "12"}}
        records = {"mesh": mesh, "export": {"results": {"cells": 4}, "case": case, "files": {"pump.cgns": "34"},
                                            "made_from": {"mesh": stage_files.files_digest(mesh)}}}
        for stage, written in records.items():
            (run / stage).mkdir()
            (run / stage / "record.json").write_text(stage_files.sealed(written))
        self.assertEqual(solve.Run(run, None, 0.003).made_from, {"export": stage_files.digest(b'{"pump.cgns":"34"}')})
        (run / "mesh/record.json").write_text(stage_files.sealed({"files": {"manifest.json": "56"}}))
        with self.assertRaisesRegex(foam.Trouble, "/export: was made from other files than lie in .*/mesh; run cutw"):
            solve.Run(run, None, 0.003)

    def test_a_terminal_that_goes_ends_it_but_not_under_nohup(self):
        text = ("import os, signal, solve\nsolve.heed_signals()\ntry:\n    os.kill(os.getpid(), signal.SIGHUP)\n"
                "    print('went on')\nexcept KeyboardInterrupt:\n    print('ended')\n")
        for before, told in (([], "ended"), (["nohup"], "went on")):
            said_here = said(self, [*before, sys.executable, "-B", "-c", text], SOURCE / "pipeline/solve")
            self.assertEqual(said_here.splitlines()[-1], told)


class Flow(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pump = with_stages("solve/run", "geometry", "mesh")
        cls.case = cls.pump.parent / "case.yaml"
        cls.case.write_text(PAPER.read_text() + "\noperating_points:\n  flow_shares: [0.7, 1]\n")
        done(cls(), "export", cls.pump, case=cls.case, cells=CELLS)

    def line(self, *more):
        return [sys.executable, SOURCE / "pipeline/solve/solve.py", "--case", self.case, "--run", self.pump, "--ranks",
                "1", "--bin", BIN, *(["--most", MOST] if MOST else []), *more]

    def call(self, *more, **options):
        return execute(self.line(*more), **options)

    def test_a_flow_that_was_killed_goes_on_and_obeys_the_energy_balance(self):
        shutil.rmtree(self.pump / "solve", ignore_errors=True)
        child = subprocess.Popen([str(word) for word in self.line()], env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        written = self.pump / "solve/steady/100"  # fields of 100 iterations
        while not (written / "p").exists() and child.poll() is None:
            time.sleep(0.2)
        child.send_signal(signal.SIGTERM)
        self.assertNotEqual(child.wait(), 0)
        self.assertFalse((self.pump / "solve/record.json").exists())
        said(self, self.line())
        log = (self.pump / "solve/steady/log.simpleFoam").read_text()
        self.assertEqual(log.count("\nTime = 50\n"), 1, "begun anew")
        found = record(self.pump, "solve")["results"]
        self.assertEqual(found["settled"], not MOST)
        self.assertEqual(record(self.pump, "solve")["made_from"], stage_files.of_export(record(self.pump, "export")))
        # More power goes in by the shaft than comes out as head, and not ten times as much.
        self.assertGreater(found["hydraulic_efficiency"], 0.1)
        self.assertLess(found["hydraulic_efficiency"], 1)
        power = found["torque_n_m"] * 1450 * math.pi / 30
        self.assertAlmostEqual(found["shaft_power_w"] / power, 1, places=9)
        useful = 998.2 * 9.80665 * 25 / 3600 * found["head_m"]
        self.assertAlmostEqual(found["hydraulic_efficiency"] * power / useful, 1, places=6)
        rows = (self.pump / "solve/history.csv").read_text().splitlines()
        self.assertEqual(len(rows) - 1, len(found["history"]["iteration"]))
        self.assertEqual(found["iterations"], found["history"]["iteration"][-1])
        # Called again there is nothing to do but the points of the curve. Of a radial pump whose blades lean back the
        # head falls with the flow, and the power rises.
        said(self, self.line("--curve"))
        curve = record(self.pump, "solve")["results"].pop("curve")
        self.assertEqual({**record(self.pump, "solve")["results"], "curve": []}, found)
        self.assertEqual([point["point"] for point in curve], ["q0700", "q1000"])
        self.assertEqual(curve[1]["head_m"], found["head_m"])
        self.assertGreater(curve[0]["head_m"], curve[1]["head_m"])
        self.assertLess(curve[0]["shaft_power_w"], curve[1]["shaft_power_w"])
        # Cavitation begins where the pressure is least, below the one at the inlet by more than the speed there makes.
        self.assertGreater(curve[1]["npsh_inception_m"], 0.5)
        self.assertLess(curve[1]["npsh_inception_m"], 100)
        with open(self.pump / "solve/curve.csv", encoding="utf-8") as file:
            for row, flow in zip(csv.DictReader(file), (17.5, 25), strict=True):
                self.assertAlmostEqual(float(row["flow_m3_per_h"]), flow, places=9)
        # A call for the operating point alone keeps the curve, and the report shows it.
        said(self, self.line())
        self.assertEqual(record(self.pump, "solve")["results"]["curve"], curve)
        pages = []
        for ranks in (1, 3):
            done(self, "report", self.pump, case=self.case, cells=CELLS, ranks=ranks)
            pages.append((self.pump / "report/index.html").read_text())
        self.assertIn("Characteristic curve", pages[0])
        # Of each wall the faces in all ranges of y+ are all faces.
        rows = re.findall(r"<tr><td>[^<]*((?:</td><td class=\"n\">[^<]*){8})</td></tr>", pages[0].split("<h3>y+ of")[1])
        self.assertGreater(len(rows), 5)
        for row in rows:
            shares = re.findall(r"([0-9.]+) %", row)
            self.assertEqual(len(shares), 5, row)
            self.assertAlmostEqual(sum(map(float, shares)), 100, delta=0.3, msg=row)
        self.assertTrue(pages[0] == pages[1], "1 rank and 3")
        self.shows_the_flow(pages[0])

    def shows_the_flow(self, text):
        """History, curve and fields are in the page, and the picture that turns has their colours."""
        for title in ("Residuals", "Pressure on the walls", "y+ on the walls", "Relative velocity on the middle plane",
                      "Relative velocity at mid-span", "Relative velocity near the hub",
                      "Relative velocity near the shroud"):
            self.assertRegex(text, rf"<figcaption><b>{re.escape(title)}\.</b>")
        self.assertEqual(text.count("The design predicts one point"), 3)  # in the charts of the curve
        self.assertNotIn("Not drawn", text.split("<h3>Fields</h3>")[1])
        if not browser.THERE:
            return print(f"the page is not opened: {browser.MISSING}")
        narrow = browser.fits_a_phone(self, self.pump / "report/index.html", self.pump.parent / "page.html",
                                      browser.COLOURS)
        told = narrow["told"]
        self.assertEqual(list(told), ["patches", "pressure", "y+"])
        self.assertEqual(len({seen["sum"] for seen in told.values()}), 3)
        self.assertEqual([seen["bars"] for seen in told.values()], [0, 1, 1])
        self.assertEqual(len({seen["ink"] for seen in told.values()}), 1)

    def test_few_iterations_leave_whole_fields(self):
        few = fresh("solve_few") / "run"
        shutil.copytree(self.pump, few, ignore=shutil.ignore_patterns("solve"))
        said(self, self.line("--run", few, "--most", 15))  # no multiple of what lies between two reports or two fields
        found = record(few, "solve")["results"]
        self.assertEqual((found["iterations"], found["settled"]), (20, False))
        self.assertTrue((few / "solve/steady/20/U").exists())
        # Other ranks go on from there.
        for ranks, most in ((2, 40), (3, 60), (1, 80)):
            told = said(self, self.line("--run", few, "--most", most, "--ranks", ranks))
            self.assertIn(f"ranks: {ranks} in the place of ", told)
            self.assertEqual(record(few, "solve")["results"]["iterations"], most)
            self.assertTrue((few / f"solve/steady/{most}/U").exists())
        log = (few / "solve/steady/log.simpleFoam").read_text()
        self.assertEqual([log.count(f"\nTime = {iteration}\n") for iteration in (15, 25, 45, 65)], [1] * 4)

    def test_what_is_missing_is_told_in_one_line(self):
        result = self.call("--run", self.pump.parent / "none")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"^cutwater-solve: error: .*export/openfoam: no case; make it first.*\n$")
        result = self.call(environment={**ENVIRONMENT, "PATH": "/nonexistent"})
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"^cutwater-solve: error: \w+ is not there; install OpenFOAM.*\n$")

    def test_a_solver_that_fails_is_told_with_its_log(self):
        broken = fresh("solve_broken") / "run"
        shutil.copytree(self.pump, broken, ignore=shutil.ignore_patterns("solve"))
        dictionary = broken / "export/openfoam/system/fvSchemes"
        dictionary.write_text(dictionary.read_text().replace("steadyState", "steadyStat"))
        result = self.call("--run", broken)
        self.assertEqual(result.returncode, 1)
        self.assertIn("log.simpleFoam", result.stdout)
        self.assertFalse((broken / "solve/record.json").exists())


if __name__ == "__main__":
    unittest.main()
