# SPDX-License-Identifier: AGPL-3.0-or-later
"""The case whose pipes are zones of their own, through all stages and before the judges of CGNS and OpenFOAM."""
import os
import re
import shutil
import unittest

from cutwater import SOURCE, WORK, done, execute, fresh, record
from judges import CHECK_MESH, cgns_is_sound, continuity_errors, failed_checks, flow_begins, interfaces_are_covered

CASE = SOURCE / "cases/zones/case.yaml"
RUN = WORK / "zones"
CELLS = 300000
ITERATIONS = int(os.environ.get("CUTWATER_ITERATIONS", 5))
PAIRS = [["rotor", "stator"], ["rotor", "suction"], ["stator", "discharge"]]
ZONES = ["rotor", "stator", "suction", "discharge"]


class Zones(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(RUN, ignore_errors=True)
        for name in ("geometry", "mesh", "export", "report"):
            done(cls(), name, RUN, case=CASE, cells=CELLS)

    def test_every_zone_is_meshed_and_written(self):
        domains = record(RUN, "mesh")["results"]["domains"]
        self.assertEqual([domain["name"] for domain in domains], ZONES)
        cells = sum(domain["tetrahedra"] + domain["prisms"] for domain in domains)
        self.assertAlmostEqual(cells / CELLS, 1, delta=0.02)
        for domain in domains:
            # The chords of round pipes at this size; the coarsest, in the discharge, cut off 1 %.
            self.assertLess(abs(domain["volume_error"]), 0.015, domain["name"])
            for wall in domain["layer_coverage"]:
                self.assertGreater(wall["wall_faces"], 0, wall["patch"])
        export = record(RUN, "export")["results"]
        for name in ZONES:
            self.assertGreater(export[name]["prisms"], 0)

    def test_both_sides_of_an_interface_have_one_area(self):
        pairs = record(RUN, "export")["results"]["interfaces"]
        self.assertEqual([pair["domains"] for pair in pairs], PAIRS)
        for pair in pairs[1:]:
            # The discs have the same polygon as rim: only rounding is left.
            self.assertAlmostEqual(pair["areas_m2"][0] / pair["areas_m2"][1], 1, delta=2e-4, msg=pair)

    def test_the_page_lists_the_zones(self):
        page = (RUN / "report/index.html").read_text()
        for word in (">Suction</th>", ">Discharge</th>", "All zones", "Regions of the pipes", "outlet pipe"):
            self.assertIn(word, page)

    def test_cgns(self):
        told = cgns_is_sound(self, RUN / "export/pump.cgns", 4)
        for here, there in PAIRS:
            for name in (f"{here}_to_{there}", f"{there}_to_{here}"):
                self.assertIn(f'checking connectivity "{name}"', told)

    def test_cfx(self):
        for name in ("steady.ccl", "transient.ccl"):
            text = (RUN / "export/cfx" / name).read_text()
            self.assertNotRegex(text, "@[a-z_]+@")  # a key without its value
            self.assertEqual(len(re.findall(r"^  DOMAIN: ", text, re.M)), 4)
            depth = 0
            for line in text.splitlines():
                depth += bool(re.match(r"\s*[A-Z][A-Z &1-9]*:( [^=]*)?$", line)) - (line.strip() == "END")
                self.assertGreaterEqual(depth, 0, line)
            self.assertEqual(depth, 0, name)
        text = (RUN / "export/cfx/steady.ccl").read_text()
        self.assertEqual(len(re.findall(r"^  DOMAIN INTERFACE: ", text, re.M)), 3)
        self.assertEqual(text.count("Boundary Type = INTERFACE"), 6)
        self.assertEqual(text.count("Option = Rotating\n"), 1)

    def test_openfoam(self):
        case = fresh(f"zones-openfoam-{ITERATIONS}") / "case"
        shutil.copytree(RUN / "export/openfoam", case)
        told = execute(["checkMesh"], case).stdout
        self.assertIn("Mesh OK.", told, failed_checks(told))
        self.assertRegex(told, r"Number of regions: 4\b")
        strict = execute(CHECK_MESH, case).stdout
        for line in failed_checks(strict):
            self.assertIn("small determinant", line)
        self.assertEqual(len(interfaces_are_covered(self, strict)), 6, strict[-2000:])
        self.assertEqual((case / "constant/polyMesh/cellZones").read_bytes().count(b"cellZone;"), 4)
        told = flow_begins(self, case, ITERATIONS)
        error = continuity_errors(self, told)
        self.assertEqual(len(error), ITERATIONS)
        self.assertLess(error[-1], 10 * error[0])
        if ITERATIONS < 50:
            return
        flow = {name: float(value) for name, value in re.findall(r"sum\((\w+)\) of phi = (\S+)", told)}
        for here, there in (("rotor_to_suction", "suction_to_rotor"), ("stator_to_discharge", "discharge_to_stator"),
                            ("rotor_interface", "stator_interface")):
            self.assertAlmostEqual(-flow[here] / flow[there], 1, delta=0.01)
        self.assertAlmostEqual(flow["suction_to_rotor"] * 3600 / 25, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
