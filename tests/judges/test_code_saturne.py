# SPDX-License-Identifier: AGPL-3.0-or-later
"""The code_saturne case before code_saturne: its preprocessor, its joining of the interface, its solver. From SETTLED
iterations on its head is held against OpenFOAM's on the same mesh."""
import csv
import math
import os
import re
import shutil
import sys
import unittest

from cutwater import BIN, ENVIRONMENT, PAPER, SOURCE, done, execute, fresh, record, said

ITERATIONS = int(os.environ.get("CUTWATER_ITERATIONS", 6))
CELLS = int(os.environ.get("CUTWATER_SATURNE_CELLS", 60000))
SETTLED = 300


class CodeSaturne(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_folder = fresh(f"code_saturne-{CELLS}-{ITERATIONS}") / "run"
        cls.paper = cls.run_folder.parent / "case.yaml"
        cls.paper.write_text(PAPER.read_text() + "\nexport: {formats: [openfoam, code_saturne]}\n")
        for stage in ("geometry", "mesh", "export"):
            done(cls(), stage, cls.run_folder, case=cls.paper, cells=CELLS)
        cls.case = cls.run_folder / "export/code_saturne"

    def test_1_what_is_missing_is_told_in_one_line(self):
        result = execute(["./run"], self.case, environment={**ENVIRONMENT, "CODE_SATURNE_PROGRAMS": "/nonexistent"})
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stdout, r"^run: error: code_saturne is not there; install it .*\n$")

    def test_2_it_solves_the_pump(self):
        numbers = self.case / "SRC/pump.h"
        numbers.write_text(re.sub(r"PUMP_ITERATIONS \d+", f"PUMP_ITERATIONS {ITERATIONS}", numbers.read_text()))
        said(self, ["./run", 1], self.case, timeout=7000)
        self.mesh_is_whole()
        with open(self.case / "head.csv", encoding="utf-8") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        self.assertEqual([row["iteration"] for row in rows], list(range(1, ITERATIONS + 1)))
        # The head still swings through zero while the flow starts; the torque does not.
        self.assertTrue(all(math.isfinite(row["head_m"]) for row in rows), rows)
        self.assertGreater(rows[-1]["torque_n_m"], 0)
        if ITERATIONS >= SETTLED:
            self.heads_agree(rows)

    @unittest.skipIf(ITERATIONS >= SETTLED, "takes long")
    def test_3_a_call_for_more_iterations_goes_on(self):
        head = self.case / "head.csv"
        before = head.read_text()
        # As a run would leave it that was killed after its last checkpoint.
        head.write_text(before + f"{ITERATIONS + 1},99,99\n{ITERATIONS + 2},9")
        numbers = self.case / "SRC/pump.h"
        numbers.write_text(numbers.read_text().replace(f"ITERATIONS {ITERATIONS} ", f"ITERATIONS {ITERATIONS + 1} "))
        said(self, ["./run", 1], self.case)
        after = head.read_text()
        self.assertTrue(after.startswith(before))
        self.assertRegex(after[len(before):], rf"^{ITERATIONS + 1},-?[\d.]+,[\d.]+\n$")

    @unittest.skipIf(ITERATIONS >= SETTLED, "takes long")
    def test_4_laminar_flow_has_no_turbulence(self):
        """Oil of 1000 cSt on the same mesh, as a case is written where the flow along all walls is laminar."""
        for name in ("checkpoint", "restart"):
            shutil.rmtree(self.case / name, ignore_errors=True)
        numbers = self.case / "SRC/pump.h"
        text = numbers.read_text()
        for key, value in (("TURBULENCE", "CS_TURB_NONE"), ("KINEMATIC_VISCOSITY", "1e-3"), ("ITERATIONS", "3")):
            text, found = re.subn(rf"PUMP_{key} \S+", f"PUMP_{key} {value}", text)
            self.assertEqual(found, 1, key)
        numbers.write_text(text)
        said(self, ["./run", 1], self.case)
        with open(self.case / "head.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["iteration"] for row in rows], ["1", "2", "3"])
        self.assertTrue(all(math.isfinite(float(value)) for row in rows for value in row.values()), rows)

    def mesh_is_whole(self):
        """Every cell and every face of a wall has come along, the sides of the interface are gone but for slivers, and
        the flow is that of the case."""
        mesh = record(self.run_folder, "mesh")["results"]
        told = (self.case / "log.preprocess").read_text()
        counts = {name: int(count) for name, count in
                  re.findall(r'Group "(\w+)"\n  Number of (?:cells|boundary faces) +: +(\d+)', told)}
        self.assertEqual({name: counts[name.upper()] for name in ("rotor", "stator")},
                         {domain["name"]: sum(domain[kind] for kind in ("tetrahedra", "prisms"))
                          for domain in mesh["domains"]})
        patches = {patch["name"]: patch["triangles"] + patch["quads"]
                   for patch in record(self.run_folder, "export")["results"]["patches"]}
        self.assertEqual({name: counts[name] for name in patches}, patches)
        log = (self.case / "run_solver.log").read_text(errors="replace")
        # The interfaces have come back from the plane in which they are joined.
        volume = float(re.search(r'Volume zone "cells"(?:\n.*){2}\n +Volume += +(\S+)', log)[1])
        self.assertAlmostEqual(volume / sum(domain["mesh_volume_m3"] for domain in mesh["domains"]), 1, delta=5e-4)
        ends = ("inlet", "outlet", "rotor_interface", "stator_interface")
        rows = re.findall(r"^(Inlet|Smooth wall|Symmetry|Free outlet) +\d+ +(\d+) +(\S+)$", log, re.M)
        last = {name: (int(count), float(flow)) for name, count, flow in rows[-8:]}
        self.assertEqual(last["Smooth wall"][0], sum(patches.values()) - sum(patches[end] for end in ends))
        self.assertAlmostEqual(last["Inlet"][1], -25 / 3600 * 998.2, delta=1e-5)
        self.assertLess(abs(last["Symmetry"][1]), 1e-3 * abs(last["Inlet"][1]))

    def heads_agree(self, rows):
        shutil.rmtree(self.run_folder / "solve", ignore_errors=True)
        said(self, [sys.executable, SOURCE / "pipeline/solve/solve.py", "--case", self.paper, "--run",
                    self.run_folder, "--ranks", 1, "--bin", BIN], timeout=7000)
        other = record(self.run_folder, "solve")["results"]
        window = rows[-100:]
        head = sum(row["head_m"] for row in window) / len(window)
        torque = sum(row["torque_n_m"] for row in window) / len(window)
        print(f"{other['cells']:,} cells: head {head:.3f} m by code_saturne ({ITERATIONS} iterations), "
              f"{other['head_m']:.3f} m by OpenFOAM ({other['iterations']}); torque {torque:.3f} and "
              f"{other['torque_n_m']:.3f} N m")
        self.assertAlmostEqual(head / other["head_m"], 1, delta=0.03)
        self.assertAlmostEqual(torque / other["torque_n_m"], 1, delta=0.05)


if __name__ == "__main__":
    unittest.main()
