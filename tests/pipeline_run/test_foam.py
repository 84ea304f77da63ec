# SPDX-License-Identifier: AGPL-3.0-or-later
"""How an OpenFOAM case is divided and its solver run: how it is asked to end, that it ends with its caller, and what is
told where it fails."""
import itertools
import math
import os
import subprocess
import sys
import time
import unittest
from pathlib import Path
from unittest import mock

from cutwater import SOURCE, fresh, left_behind

sys.path.insert(0, str(SOURCE / "pipeline/solve"))
import foam  # noqa: E402
import reports  # noqa: E402
import settling  # noqa: E402


def history(value, count=1000, step=10):
    return {i: {"head_m": value(i), "torque_n_m": 2 * value(i)} for i in range(step, count + 1, step)}


class Stop(unittest.TestCase):
    # A solver that takes no notice of its settings when they change for the first time, as OpenFOAM within 10 s.
    SOLVER = """if 1:
        import os, time
        seen, changes = os.stat("system/controlDict").st_mtime_ns, 0
        open("started", "w").close()
        while changes < 2:
            time.sleep(0.01)
            now = os.stat("system/controlDict").st_mtime_ns
            changes, seen = changes + (now != seen), now
    """

    def test_a_solver_is_asked_to_end_until_it_does(self):
        case = fresh("solve_stop")
        (case / "system").mkdir(parents=True)
        (case / "system/controlDict").write_text("stopAt endTime;\n")
        asked = []
        tables = itertools.chain([history(lambda i: 10.0, 990)], itertools.repeat(history(lambda i: 10.0)))

        def set_entry(folder, file, *words):
            asked.append(words)
            (folder / file).touch()

        child = subprocess.Popen([sys.executable, "-c", self.SOLVER], cwd=case)
        while not (case / "started").exists():
            time.sleep(0.01)
        with mock.patch.multiple(foam, LOOK_EVERY=0.1, set_entry=set_entry), \
                mock.patch.object(reports, "history", mock.Mock(side_effect=tables)):
            foam.watch(child, case, 4000, settling.Rest(0.003), "flow")
        self.assertEqual((child.returncode, asked), (0, [("stopAt", "writeNow")]))


class Killed(unittest.TestCase):
    SOLVER = "#!/bin/sh\necho $$ >> started\nexec sleep 600\n"
    CALLER = ("import foam, os, pathlib, sys\nfoam.set_entry = lambda *_: None\n"
              "case, ranks = pathlib.Path(sys.argv[1]), int(sys.argv[2])\n"
              "foam.ENVIRONMENT['PATH'] = f\"{case}:{os.environ['PATH']}\"\n"
              "foam.run_solver(case, ranks, 4000, None, 'flow') if ranks else foam.call(case, 'log', 'simpleFoam')\n")

    def test_what_it_has_started_ends_with_it(self):
        for ranks, count in ((0, 1), (1, 1), (2, 2)):  # a program that is called; the solver; the same under mpirun
            case = fresh("solve_killed")
            (case / "simpleFoam").write_text(self.SOLVER)
            (case / "simpleFoam").chmod(0o755)
            started = case / "started"
            caller = subprocess.Popen([sys.executable, "-B", "-c", self.CALLER, case, str(ranks)],
                                      cwd=SOURCE / "pipeline/solve", stdin=subprocess.DEVNULL)
            while caller.poll() is None and (not started.exists() or started.read_text().count("\n") < count):
                time.sleep(0.02)
            caller.kill()
            caller.wait()
            solvers = [int(word) for word in started.read_text().split()]
            self.assertEqual(len(solvers), count)
            self.assertEqual(left_behind(solvers), [], f"{ranks} ranks")


class Divergence(unittest.TestCase):
    def watch(self, *tables):
        """Watches a solver that ends by itself, and reports these, one at each look."""
        child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(0.5)"])
        left = list(tables)
        try:
            with mock.patch.object(foam, "LOOK_EVERY", 0.01), \
                    mock.patch.object(reports, "history", lambda _: left.pop(0) if len(left) > 1 else left[0]):
                foam.watch(child, Path("case"), 4000, settling.Rest(0.003), "flow")
        finally:
            child.wait()

    def test_a_flow_that_diverges_is_told(self):
        for bad in (math.nan, 1e7):
            with self.assertRaisesRegex(foam.Trouble, "iteration 30: see case/log.simpleFoam; the flow div"):
                self.watch({}, history(lambda i: 10, 20), history(lambda i, bad=bad: bad if i == 30 else 10, 30))

    def test_one_that_goes_on_is_not_ended_by_what_was_reported_before(self):
        before = history(lambda i: math.nan if i == 150 else 10, 150)
        self.watch(before, before, before, history(lambda i: 10, 100), history(lambda i: 10, 110))

    def test_its_end_is_no_result(self):
        table = history(lambda i: math.nan if i == 4000 else 10, 4000)
        with mock.patch.multiple(foam, set_entry=lambda *_: None, solved=lambda _: 4000), \
                mock.patch.object(reports, "history", lambda _: table):
            with self.assertRaisesRegex(foam.Trouble, "iteration 4000: see .*; the flow diverges"):
                foam.iterate(Path("case"), 1, 4000, settling.Rest(0.003), "flow")

    def test_only_a_floating_point_exception_is_taken_for_it(self):
        head = "Build  : OPENFOAM=1912\ntrapFpe: Floating point exception trapping enabled (FOAM_SIGFPE).\n"
        case = fresh("solve_failed")
        program = case / "simpleFoam"
        for words, told, diverges in (
                ("", "simpleFoam ended with -9: see ", False),
                ("#1  Foam::sigFpe::sigHandler(int) at ??:?\n", "simpleFoam ended with -9: see ", True),
                ("--> FOAM FATAL ERROR :\n    no x\n", "ended with -9, --> FOAM FATAL ERROR: see ", False),
                ("", "simpleFoam ended with -9: see ", False)):  # the log holds those before
            program.write_text(f"#!/bin/sh\ncat << 'END'\n{head}{words}END\nkill -9 $$\n")
            program.chmod(0o755)
            with mock.patch.multiple(foam, LOOK_EVERY=0.01, set_entry=lambda *_: None, ENVIRONMENT={
                    **foam.ENVIRONMENT, "PATH": f"{case}:{foam.ENVIRONMENT['PATH']}"}):
                with self.assertRaises(foam.Trouble) as caught:
                    foam.run_solver(case, 1, 4000, settling.Rest(0.003), "flow")
            self.assertIn(told, str(caught.exception))
            self.assertEqual("relaxationFactors" in str(caught.exception), diverges, words)


class Divided(unittest.TestCase):
    def test_a_case_is_divided_by_the_method_of_its_release(self):
        case, call = fresh("solve_method"), foam.call
        parts = SOURCE / "export/templates/openfoam_parts"
        for method, entries in (("hierarchical", {"numberOfSubdomains": "3", "coeffs/n": "( 3 1 1 )"}),  # v1912
                                ("scotch", {"numberOfSubdomains": "3"})):                               # v2406
            (case / "system").mkdir(parents=True, exist_ok=True)
            text = "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class dictionary;\n    object a;\n}\n"
            text += "numberOfSubdomains 2;\n" + (parts / method).read_text().replace("@processors@", "2")
            (case / "system/decomposeParDict").write_text(text)
            with mock.patch.object(foam, "call", lambda folder, log, *line:
                                   call(folder, log, *line) if line[0] == "foamDictionary" else None):
                foam.divide(case, 3)
            for entry, value in entries.items():
                call(case, "log.value", "foamDictionary", "-entry", entry, "-value", "system/decomposeParDict")
                self.assertEqual((case / "log.value").read_text().splitlines()[-1], value, method)


if __name__ == "__main__":
    unittest.main()
