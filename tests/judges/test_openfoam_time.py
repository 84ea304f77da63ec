# SPDX-License-Identifier: AGPL-3.0-or-later
"""The turning rotor in time before OpenFOAM: the transient case from the steady one, and the large eddy simulation from
that with either subgrid model, on the mesh of the shared run, for CUTWATER_STEPS steps of one degree each."""
import cmath
import math
import os
import re
import sys
import unittest

from cutwater import SOURCE, execute, with_stages
from judges import SOLVER_FAILED, reports

sys.path.insert(0, str(SOURCE / "tests/bench"))
import foam_read  # noqa: E402

STEPS = int(os.environ.get("CUTWATER_STEPS", 4))
TURN = 60 / 1450  # s
BLADES = 6


class InTime(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = with_stages(f"openfoam-time-{STEPS}", "export") / "export/openfoam"

    def set(self, folder, **entries):
        """Not by foamDictionary, which would write the time step anew, to six digits."""
        path = folder / "system/controlDict"
        text = path.read_text()
        for entry, value in entries.items():
            text, found = re.subn(rf"(?m)^{entry} .*", f"{entry} {value};", text)
            self.assertEqual(found, 1, entry)
        path.write_text(text)

    def solve(self, folder, *words):
        """The case's own script; the last line of a run too short for a report is no failure."""
        result = execute(["./Allrun", 2, *words], folder, timeout=3500)
        log = (folder / "log.pimpleFoam").read_text()
        self.assertNotRegex(log, SOLVER_FAILED, log[-3000:])
        self.assertTrue(log.rstrip().endswith("Finalising parallel run"), result.stdout + log[-3000:])
        return result.stdout

    def turned(self, folder):
        """Degrees that the rotor's first point has turned since the steady case, and those of the last of the
        stator."""
        files = (self.case / "constant/polyMesh/points", foam_read.latest(folder) / "polyMesh/points")
        (before,), (now,) = (foam_read.lists(file, ["3d"]) for file in files)
        self.assertEqual(len(before), len(now))
        return [math.degrees(cmath.phase(complex(*now[k:k + 2]) / complex(*before[k:k + 2]))) % 360 for k in (0, -3)]

    def test_1_transient_then_eddies(self):
        self.set(self.case, endTime=20, writeInterval=20)
        self.assertIn("head", execute(["./Allrun", 2], self.case).stdout)
        transient, les = self.case / "transient", self.case / "les"
        self.set(transient, endTime=f"{STEPS / 360 * TURN:.10g}", writeInterval=STEPS // 2)
        self.assertIn("starts from iteration 20 of the steady run", self.solve(transient))
        self.assertAlmostEqual(float(foam_read.latest(transient).name) / TURN * 360, STEPS, places=3)
        self.assertAlmostEqual(self.turned(transient)[0], STEPS % 360, places=2)
        self.assertAlmostEqual(min(self.turned(transient)[1], 360 - self.turned(transient)[1]), 0, places=6)
        # The eddies go on where the rotor stands, by as many steps, and once more when called again.
        script = les / "Allrun"
        script.write_text(re.sub(r"\$turns \* \S+", f"$turns * {STEPS / 360 * TURN:.10g}", script.read_text()))
        self.set(les, writeInterval=STEPS // 2)
        for more in (2, 3):
            self.solve(les, 1)
            self.assertAlmostEqual(self.turned(les)[0], more * STEPS % 360, places=2)
        for name in ("UMean", "UPrime2Mean", "pMean", "pPrime2Mean"):
            self.assertTrue((foam_read.latest(les) / name).exists(), name)
        # What comes into each zone goes out of it, at every report; between them the interpolation of AMI is not exact.
        for ends in (("flowInlet", "flowRotorInterface"), ("flowStatorInterface", "flowOutlet")):
            rows = list(zip(*(reports(les, name, "surfaceFieldValue.dat") for name in ends)))
            self.assertGreaterEqual(len(rows), STEPS // 10)  # of few steps none
            for (time, into), (_, out) in rows:
                self.assertAlmostEqual(-into / out, 1, delta=0.002, msg=f"{ends} at {time} s")
        if STEPS >= 360:
            self.passes_the_tongue(les)
            return
        model = les / "constant/turbulenceProperties"
        text = re.sub(r"(?m)^(    LESModel +)\w+;", r"\1WALE;", model.read_text())
        model.write_text(re.sub(r"(?m)^(    delta +)\w+;", r"\1cubeRootVol;", text))
        self.solve(les, 1)
        self.assertRegex((les / "log.pimpleFoam").read_text(), "model WALE\nSelecting LES delta type cubeRootVol")

    def passes_the_tongue(self, les):
        """Of the parts of the tongue's pressure in the last turn that come once a turn or oftener, the blades' is the
        greatest, and the phase averages and planes are there."""
        pressure = [row[1] for row in reports(les, "pressure_tongue", "surfaceFieldValue.dat")][-360:]
        part = [abs(sum(p * cmath.exp(-2j * math.pi * k * i / 360) for i, p in enumerate(pressure)))
                for k in range(1, 31)]
        self.assertEqual(1 + part.index(max(part)), BLADES, part)
        self.assertTrue((foam_read.latest(les) / "UMean_phase").exists())
        planes = list((les / "postProcessing/planes").glob("*/middle.vtp"))
        planes += list((les / "postProcessing/planes").glob("*/*middle*.vtk"))
        self.assertGreaterEqual(len(planes), 2 * 360 // (360 // BLADES) - 1)


if __name__ == "__main__":
    unittest.main()
