# SPDX-License-Identifier: AGPL-3.0-or-later
"""A machine that no generator made (tests/measure/turned_zones.cpp), through mesher and exporter and before the judges:
zones in an order of their own, the third of which turns, two inlets and outlets, a plane of symmetry, and a cone, a
plane and a cylinder as interfaces."""
import re
import unittest

from cutwater import BIN, PAPER, done, fresh, read_json, record, said
from judges import cgns_is_sound, failed_checks, reports

CELLS = 60000
ITERATIONS = 10  # the first report of head and flows
PAIRS = [["casing_in", "cone"], ["eye", "pipe_end"], ["ring_in", "casing_out"]]


class Model(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_folder = fresh("model") / "run"
        said(cls(), [BIN / "turned_zones", PAPER, cls.run_folder])
        for name in ("mesh", "export", "report"):
            done(cls(), name, cls.run_folder, cells=CELLS, ranks=2)
        cls.export = record(cls.run_folder, "export")["results"]
        cls.foam = cls.run_folder / "export/openfoam"

    def test_1_the_zones_keep_their_order(self):
        manifest = read_json(self.run_folder, "mesh/manifest.json")
        self.assertEqual([domain["name"] for domain in manifest["domains"]], ["casing", "pipe", "wheel", "ring"])
        self.assertEqual([domain["rotating"] for domain in manifest["domains"]], [False, False, True, False])
        # Rings of quarter circles, exact: pi (R^2 - r^2) h, and a frustum.
        volumes = {"pipe": 40 ** 2 * 40, "ring": (110 ** 2 - 90 ** 2) * 20,
                   "wheel": (50 ** 2 + 50 * 40 + 40 ** 2) * 20 / 3}
        for name, units in volumes.items():
            self.assertAlmostEqual(self.export[name]["solid_volume_m3"] / (3.141592653589793e-9 * units), 1, delta=1e-6)
            self.assertAlmostEqual(self.export[name]["volume_m3"] / self.export[name]["solid_volume_m3"], 1, delta=0.02)

    def test_2_both_sides_of_each_interface_have_one_area(self):
        self.assertEqual([pair["patches"] for pair in self.export["interfaces"]], PAIRS)
        for pair in self.export["interfaces"]:
            self.assertAlmostEqual(pair["areas_m2"][0] / pair["areas_m2"][1], 1, delta=1e-3, msg=pair)

    def test_3_cgns(self):
        told = cgns_is_sound(self, self.run_folder / "export/pump.cgns", 4)
        self.assertIn('checking connectivity "casing_to_ring"', told)
        self.assertIn("BCSymmetryPlane", told)
        self.assertEqual(len(re.findall("checking rotating coordinates", told)), 1)

    def test_4_cfx(self):
        text = (self.run_folder / "export/cfx/steady.ccl").read_text()
        domains = dict(re.findall(r"^  DOMAIN: (\w+)\n(.*?)^  END\n", text, re.M | re.S))
        self.assertEqual([name for name, block in domains.items() if "Option = Rotating\n" in block], ["WHEEL"])
        flows = [float(re.search(rf"BOUNDARY: {name}\n(?:.*\n)*?.*Mass Flow Rate = (\S+) ", text)[1])
                 for name in ("out_left", "out_right")]
        self.assertAlmostEqual(flows[1] / flows[0], 3, delta=1e-6)
        self.assertIn("BOUNDARY: middle\n      Boundary Type = SYMMETRY", domains["CASING"])
        self.assertIn("(massFlow()@in_a + massFlow()@in_b)", text)

    def test_5_openfoam_solves_it(self):
        for case, times in (("", ITERATIONS), ("transient", 2)):
            control = self.foam / case / "system/controlDict"
            text = re.sub(r"^writeInterval .*", f"writeInterval {times};", control.read_text(), flags=re.M)
            step = 1 if not case else float(re.search(r"^deltaT +([\d.e-]+)", text, re.M)[1])
            control.write_text(re.sub(r"^endTime .*", f"endTime {times * step};", text, flags=re.M))
        said(self, ["./Allrun"], self.foam, timeout=600)
        checked = (self.foam / "log.checkMesh").read_text()
        # So coarse a mesh may have a face or two of small weight, of which the exporter has told.
        light = sum(count for zone in self.export.values() if isinstance(zone, dict)
                    for key, count in zone.items() if "small_weight_faces" in key)
        self.assertLessEqual(light, 2)
        told_of = ("small determinant", f"small interpolation weight (< 0.05) found, number of faces: {light}")
        faults = failed_checks(checked)
        self.assertEqual([fault for fault in faults if not any(told in fault for told in told_of)], [], checked)
        told = (self.foam / "log.simpleFoam").read_text()
        weights = [float(value) for value in re.findall(r"sum\(weights\) min:(\S+)", told)]
        self.assertEqual(len(weights), 6)
        self.assertGreater(min(weights), 0.7)
        flows = {name: list(reports(self.foam, name, "surfaceFieldValue.dat"))[-1][-1]
                 for name in ("flowInlet", "flowOutlet")}
        self.assertAlmostEqual(flows["flowOutlet"] * 3600 / 25, 1, delta=1e-6)
        self.assertAlmostEqual(-flows["flowInlet"] / flows["flowOutlet"], 1, delta=0.05)

    def test_6_the_report_does_without_a_design(self):
        page = (self.run_folder / "report/index.html").read_text()
        self.assertIn("from solids to mesh", page)
        for heading in ("Derived dimensions", "Design drawings"):
            self.assertNotIn(heading, page)
        for heading in (">Wheel</th>", "Prism layers", "D<sub>2</sub>&#8239;=&#8239;100&#8239;mm"):
            self.assertIn(heading, page)


if __name__ == "__main__":
    unittest.main()
