# SPDX-License-Identifier: AGPL-3.0-or-later
"""The exported case before OpenFOAM: its checkMesh, the weights of its AMI, and its solver.

CUTWATER_ITERATIONS tells how far simpleFoam goes; from CONVERGED on it must converge, to the head of this pump."""
import os
import re
import shutil
import unittest

from cutwater import CELLS, RUN, execute, fresh, read_json, record, said
from judges import (CHECK_MESH, continuity_errors, failed_checks, flow_begins, interfaces_are_covered, reports,
                    set_iterations)

ITERATIONS = int(os.environ.get("CUTWATER_ITERATIONS", 5))
CONVERGED = 200


class OpenFoam(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = fresh(f"openfoam-{CELLS}-{ITERATIONS}") / "case"
        shutil.copytree(RUN / "export/openfoam", cls.case)
        cls.check = execute(CHECK_MESH, cls.case).stdout

    def test_1_no_check_fails(self):
        self.assertIn("Mesh OK.", self.check, failed_checks(self.check))

    def test_2_it_is_the_mesh_of_the_mesher(self):
        mesh = record(RUN, "mesh")["results"]
        told = dict(re.findall(r"^ +(points|cells|prisms|tetrahedra|pyramids): +(\d+)$", self.check, re.M))
        self.assertEqual(int(told["cells"]), mesh["cells"])
        for kind in ("tetrahedra", "prisms"):
            self.assertEqual(int(told[kind]), sum(domain[kind] for domain in mesh["domains"]))
        self.assertEqual(int(told["points"]), sum(domain["points"] for domain in mesh["domains"]))
        self.assertRegex(self.check, r"Number of regions: 2\b")

    def test_2_the_exporter_measures_as_checkmesh_does(self):
        told = float(re.search(r"non-orthogonality Max: (\S+)", self.check)[1])
        results = record(RUN, "export")["results"]
        greatest = max(results[domain]["greatest_non_orthogonality_deg"] for domain in ("rotor", "stator"))
        self.assertAlmostEqual(greatest, told, delta=1e-4 * told)
        counts = {kind: sum(results[domain][f"{kind}_of_prisms"] + results[domain][f"other_{kind}"]
                            for domain in ("rotor", "stator")) for kind in ("skew_faces", "small_weight_faces")}
        skew = re.search(r"(\d+) highly skew faces", self.check)
        light = re.search(r"small interpolation weight \(< 0\.05\) found, number of faces: (\d+)", self.check)
        self.assertEqual(counts, {"skew_faces": int(skew[1]) if skew else 0,
                                  "small_weight_faces": int(light[1]) if light else 0})
        for keys, words in ((("small_volume_ratio_faces_of_prisms", "other_small_volume_ratio_faces"),
                             r"small volume ratio .*number of faces: (\d+)"),
                            (("small_determinant_prisms", "other_small_determinant_cells"),
                             r"small determinant .*number of cells: (\d+)"),
                            (("high_aspect_ratio_prisms",), r"High aspect ratio cells .*number of cells (\d+)")):
            told = re.search(words, self.check)
            self.assertEqual(sum(results[domain][key] for domain in ("rotor", "stator") for key in keys),
                             int(told[1]) if told else 0, keys)

    def test_3_every_face_of_the_interface_meets_the_other_side(self):
        self.assertEqual(set(interfaces_are_covered(self, self.check)), {"source", "target"}, self.check[-2000:])

    def solve(self):
        """What the solver says: of a few iterations on one rank, or of as many as converge, by the case's script on
        two."""
        if ITERATIONS < CONVERGED:
            return flow_begins(self, self.case, ITERATIONS)
        set_iterations(self.case, ITERATIONS)
        self.summary = said(self, ["./Allrun", 2], self.case, timeout=3500)
        self.assertTrue((self.case / str(ITERATIONS) / "U").is_file(), "the ranks' results are not put together")
        return (self.case / "log.simpleFoam").read_text()

    def test_4_the_solver_runs(self):
        told = self.solve()
        self.assertEqual(len(re.findall(r"^Time = ", told, re.M)), ITERATIONS)
        error = continuity_errors(self, told)
        self.assertLess(error[-1], 10 * error[0])
        if ITERATIONS >= CONVERGED:
            self.converges(told)
            self.pumps()

    def converges(self, told):
        last = {}
        for name in ("Ux", "Uy", "Uz", "p", "k", "epsilon"):
            values = [float(value) for value in re.findall(rf"Solving for {name}, Initial residual = (\S+),", told)]
            last[name] = values[-1]
            self.assertLess(values[-1], 0.02, name)
            self.assertLess(values[-1], 0.2 * max(values), name)
        print("residuals " + ", ".join(f"{name} {value:.1e}" for name, value in last.items()))

    def pumps(self):
        """Head, torque and flows of the last report."""
        design = read_json(RUN, "geometry/design.json")
        heads = [row[1] for row in reports(self.case, "head", "fieldValueDelta.dat")]
        # Between the head that the pump is designed for and the one that the correlations predict for its blades, which
        # know no volute; a coarse mesh and a run that has not settled may miss either by a tenth.
        self.assertGreater(min(heads[-5:]), 0.9 * design["head_m"], heads)
        self.assertLess(max(heads[-5:]), 1.1 * design["predicted_head_m"], heads)
        torque = list(reports(self.case, "torque", "moment.dat"))
        self.assertLess(torque[-1][3], 0, "the water must resist the turning impeller")
        efficiency = float(re.search(r"hydraulic efficiency (\S+) %", self.summary)[1])
        self.assertGreater(efficiency, 60)
        self.assertLess(efficiency, 95)
        flow = {name: list(reports(self.case, name, "surfaceFieldValue.dat"))[-1][1]
                for name in ("flowInlet", "flowOutlet", "flowRotorInterface", "flowStatorInterface")}
        asked = design["flow_rate_m3_per_s"]
        self.assertAlmostEqual(-flow["flowInlet"] / asked, 1, delta=0.02)
        self.assertAlmostEqual(flow["flowOutlet"] / asked, 1, delta=1e-6)
        self.assertAlmostEqual(flow["flowRotorInterface"] / asked, 1, delta=0.02)
        self.assertAlmostEqual(-flow["flowRotorInterface"] / flow["flowStatorInterface"], 1, delta=0.005)
        print(f"head {heads[-1]:.2f} m after {ITERATIONS} iterations on {CELLS} cells; asked {design['head_m']:.2f} m, "
              f"predicted {design['predicted_head_m']:.2f} m; efficiency {efficiency:.1f} %")


if __name__ == "__main__":
    unittest.main()
