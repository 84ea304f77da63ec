# SPDX-License-Identifier: AGPL-3.0-or-later
"""The stage `solve`: when a made-up history counts as settled, and a real flow on a small mesh: killed, gone on with, its
result beside the energy balance, and what is told where it cannot be solved."""
import importlib.util
import math
import shutil
import signal
import subprocess
import sys
import time
import unittest

from cutwater import BIN, ENVIRONMENT, PAPER, SOURCE, done, fresh, record

spec = importlib.util.spec_from_file_location("solve", SOURCE / "pipeline/solve.py")
solve = importlib.util.module_from_spec(spec)
spec.loader.exec_module(solve)

CELLS = 20000


def history(value, count=1000, step=10):
    return {i: {"head_m": value(i), "torque_n_m": 2 * value(i)} for i in range(step, count + 1, step)}


class Settled(unittest.TestCase):
    def test_what_is_left_of_a_geometric_way_is_known(self):
        # Means of windows of a decay to 12 are 12 - c q^k: 12 - the last one is left, exactly.
        for q in (0.1, 0.5, 0.9):
            means = [12 - 3 * q**k for k in range(3)]
            self.assertAlmostEqual(solve.left_of_way(means), 12 - means[2], places=9)

    def test_means_to_and_fro_count_by_their_last_change(self):
        self.assertAlmostEqual(solve.left_of_way([10, 12, 11]), 1)
        self.assertAlmostEqual(solve.left_of_way([10, 10, 10]), 0)
        self.assertAlmostEqual(solve.left_of_way([10, 10, 11]), 1)

    def test_a_slow_drift_is_not_taken_for_rest(self):
        # A drift with a constant rate has a change from window to window that does not fall: it never settles.
        drift = history(lambda i: 10 + 1e-4 * i)
        self.assertGreater(solve.settled(drift, 100, 0.001)[1], 0.0009)
        self.assertFalse(solve.settled(history(lambda i: 12 - 3 * math.exp(-i / 800)), 100, 0.003)[0])
        self.assertTrue(solve.settled(history(lambda i: 12 - 3 * math.exp(-i / 80)), 100, 0.003)[0])

    def test_three_windows_are_needed(self):
        self.assertEqual(solve.settled(history(lambda i: 10, count=250), 100, 0.003), (False, math.inf))
        self.assertTrue(solve.settled(history(lambda i: 10, count=310), 100, 0.003)[0])


class Flow(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pump = fresh("solve") / "run"
        for stage in ("geometry", "mesh", "export"):
            done(cls(), stage, cls.pump, cells=CELLS)

    def runTest(self):  # setUpClass needs an instance
        pass

    def line(self, *more):
        return [sys.executable, SOURCE / "pipeline/solve.py", "--case", PAPER, "--run", self.pump, "--ranks", "1", "--bin",
                BIN, *more]

    def call(self, *more, **options):
        return subprocess.run([str(word) for word in self.line(*more)], env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)

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
        result = self.call()
        self.assertEqual(result.returncode, 0, result.stdout)
        log = (self.pump / "solve/steady/log.simpleFoam").read_text()
        self.assertEqual(log.count("\nTime = 50\n"), 1, "begun anew")
        found = record(self.pump, "solve")["results"]
        self.assertTrue(found["settled"])
        # More power goes in by the shaft than comes out as head, and not ten times as much.
        self.assertGreater(found["hydraulic_efficiency"], 0.1)
        self.assertLess(found["hydraulic_efficiency"], 1)
        power = found["torque_n_m"] * 1450 * math.pi / 30
        self.assertAlmostEqual(found["shaft_power_w"] / power, 1, places=9)
        self.assertAlmostEqual(found["hydraulic_efficiency"] * power / (998.2 * 9.80665 * 25 / 3600 * found["head_m"]), 1,
                               places=6)
        rows = (self.pump / "solve/history.csv").read_text().splitlines()
        self.assertEqual(len(rows) - 1, len(found["history"]["iteration"]))
        self.assertEqual(found["iterations"], found["history"]["iteration"][-1])
        # Called again there is nothing to do.
        again = self.call()
        self.assertEqual(again.returncode, 0, again.stdout)
        self.assertEqual(record(self.pump, "solve")["results"], found)

    def test_what_is_missing_is_told_in_one_line(self):
        result = self.call("--run", self.pump.parent / "none")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"^cutwater-solve: error: .*export/openfoam: no case; make it first.*\n$")
        poor = {**ENVIRONMENT, "PATH": "/nonexistent"}
        result = subprocess.run([str(word) for word in self.line()], env=poor, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, check=False)
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
