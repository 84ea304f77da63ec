# SPDX-License-Identifier: AGPL-3.0-or-later
"""The paper's pump with root fillets, at few cells: fillets narrower than half an edge are left out, which log, record
and headline tell, and the mesh is as sound as without them. Cells enough show them."""
import re
import shutil
import unittest

from cutwater import changed_case, command, done, execute, fresh, read_json, record, said

COARSE = 150000
RADIUS = 0.5  # mm


class NarrowFaces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pump = fresh("fillets")
        fillets = f"  root_fillet_radius_mm: {RADIUS}\n"
        cls.case = changed_case(cls.pump, ("  blade_count: 6 ", f"{fillets}  blade_count: 6 "))
        done(cls(), "geometry", cls.pump, case=cls.case)

    def copy(self, name):
        """A run folder with the geometry of the pump."""
        folder = fresh(name)
        shutil.copytree(self.pump / "geometry", folder / "geometry")
        return folder, self.case

    def test_few_cells_leave_fillets_out(self):
        folder, case = self.copy("narrow-faces")
        told = done(self, "mesh", folder, case=case, cells=COARSE).stdout
        results = record(folder, "mesh")["results"]
        rotor, stator = results["domains"]
        self.assertGreater(rotor["left_out"]["faces"], 0)
        self.assertEqual(rotor["left_out"]["faces"] % rotor["equal_passages"], 0)
        self.assertEqual(rotor["equal_passages"], 6)
        self.assertEqual(stator["left_out"], {"faces": 0, "widest_m": 0})
        # The arc between walls at 60 to 120 degrees: between a half and twice the radius.
        self.assertGreater(rotor["left_out"]["widest_m"], 0.5e-3 * RADIUS)
        self.assertLess(rotor["left_out"]["widest_m"], 3e-3 * RADIUS)
        headline = [text for text in results["headlines"] if "are left out" in text]
        self.assertEqual(len(headline), 1, results["headlines"])
        self.assertIn(f"rotor: {rotor['left_out']['faces']} narrow faces of blade_", headline[0])
        self.assertIn(headline[0], told)
        self.assertGreater(min(domain["least_dihedral_deg"] for domain in results["domains"]), 12)
        self.assertLess(abs(results["cells"] / COARSE - 1), 0.02)
        for domain in results["domains"]:
            self.assertLess(abs(domain["volume_error"]), 0.03)
        done(self, "export", folder, case=case)

        other, _ = self.copy("narrow-faces-ranks")
        done(self, "mesh", other, case=case, cells=COARSE, ranks=2)
        self.assertEqual(*(read_json(run, "mesh/manifest.json")["domains"] for run in (folder, other)))

    def test_as_many_cells_as_told_show_them(self):
        folder, case = self.copy("shown-faces")
        told = execute(command("mesh", folder, case=case, cells=COARSE) + ["--stop-after", "size"]).stdout
        enough = int(re.search(r"left out.* mesh.cells (\d+) shows them", told).group(1))
        self.assertGreater(enough, COARSE)
        told = said(self, command("mesh", folder, case=case, cells=enough) + ["--stop-after", "size"])
        self.assertNotIn("left out", told)


if __name__ == "__main__":
    unittest.main()
