# SPDX-License-Identifier: AGPL-3.0-or-later
"""The case whose pipes are zones of their own, through all stages and before the judges of CGNS and OpenFOAM."""
import os
import re
import shutil
import unittest

from cutwater import SOURCE, WORK, done, execute, fresh, record

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
        test = cls("test_every_zone_is_meshed_and_written")
        for name in ("geometry", "mesh", "export", "report"):
            done(test, name, RUN, case=CASE, cells=CELLS)

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
        result = execute(["cgnscheck", "-v", RUN / "export/pump.cgns"])
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual([line for line in result.stdout.splitlines() if re.search("ERROR|WARNING", line)], [])
        self.assertEqual(len(re.findall(r'^reading zone "?\w+', result.stdout, re.M)), 4)
        for here, there in PAIRS:
            for name in (f"{here}_to_{there}", f"{there}_to_{here}"):
                self.assertIn(f'checking connectivity "{name}"', result.stdout)

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
        self.assertIn("Mesh OK.", told, "\n".join(re.findall(r"^ \*\*\*.*$", told, re.M)))
        self.assertRegex(told, r"Number of regions: 4\b")
        strict = execute(["checkMesh", "-allGeometry", "-allTopology"], case).stdout
        for line in re.findall(r"^ \*\*\*(.*)$", strict, re.M):
            self.assertIn("small determinant", line)
        weights = re.findall(r"AMI: Patch (source|target) sum\(weights\) min:(\S+) max:(\S+)", strict)
        self.assertEqual(len(weights), 6, strict[-2000:])
        for side, least, most in weights:
            self.assertGreater(float(least), 0.98, side)
            self.assertLess(float(most), 1.02, side)
        self.assertEqual((case / "constant/polyMesh/cellZones").read_bytes().count(b"cellZone;"), 4)
        execute(["foamDictionary", "-entry", "endTime", "-set", ITERATIONS, "system/controlDict"], case)
        result = execute(["simpleFoam"], case, timeout=3000)
        self.assertEqual(result.returncode, 0, result.stdout[-3000:])
        self.assertNotRegex(result.stdout, r"\bnan\b|FOAM FATAL|sigFpe::sigHandler")
        error = re.findall(r"continuity errors : sum local = (\S+),", result.stdout)
        self.assertEqual(len(error), ITERATIONS)
        self.assertLess(float(error[-1]), 10 * float(error[0]))
        if ITERATIONS < 50:
            return
        flow = {name: float(value) for name, value in re.findall(r"sum\((\w+)\) of phi = (\S+)", result.stdout)}
        for here, there in (("rotor_to_suction", "suction_to_rotor"), ("stator_to_discharge", "discharge_to_stator"),
                            ("rotor_interface", "stator_interface")):
            self.assertAlmostEqual(-flow[here] / flow[there], 1, delta=0.01)
        self.assertAlmostEqual(flow["suction_to_rotor"] * 3600 / 25, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
