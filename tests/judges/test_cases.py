# SPDX-License-Identifier: AGPL-3.0-or-later
"""Cases and sizes whose layers are hard at corners of blade and hub: no check of OpenFOAM's fails, no tetrahedron is
flat, and the first height holds. In every case the rule of region numbers gives both sides of an interface one mesh."""
import unittest

from cutwater import SOURCE, digests, done, execute, fresh, interfaces_agree, record, rule_on_all_regions
from judges import CHECK_MESH, failed_checks

# Cells; None: the case's own.
CASES = (("splitters", None), ("splitters", 300000), ("nq24", None), ("ns40", None), ("ns40", 300000),
         ("ns100", 1000000), ("ns200", None), ("ns200", 1000000), ("paper", 8000000))
LEAST_DIHEDRAL = 12  # degrees


class Cases(unittest.TestCase):
    def judge(self, name, cells):
        run, case = fresh(f"case-{name}"), SOURCE / f"cases/{name}/case.yaml"
        done(self, "geometry", run, case=case)
        for stage in ("mesh", "export"):
            done(self, stage, run, case=case, cells=cells, ranks=2)
        told = execute(CHECK_MESH, run / "export/openfoam").stdout
        self.assertEqual(failed_checks(told), [])
        self.assertIn("Mesh OK.", told)
        for domain in record(run, "mesh")["results"]["domains"]:
            self.assertGreaterEqual(domain["least_dihedral_deg"], LEAST_DIHEDRAL, domain["name"])
            faces = sum(patch["wall_faces"] for patch in domain["layer_coverage"])
            met = sum(patch["first_height_met_faces"] for patch in domain["layer_coverage"])
            self.assertGreaterEqual(met, 0.99 * faces, domain["name"])

    def test_coarse(self):
        """Any pump of the library is meshed where edges are wider than the noses of its blades."""
        for case in sorted((SOURCE / "cases").glob("*/case.yaml")):
            with self.subTest(case.parent.name):
                run = fresh("case-coarse")
                done(self, "geometry", run, case=case)
                done(self, "mesh", run, case=case, cells=300000, ranks=2)
                domains = record(run, "mesh")["results"]["domains"]
                for domain in domains:
                    self.assertGreaterEqual(domain["least_dihedral_deg"], LEAST_DIHEDRAL, domain["name"])
                interfaces_agree(self, run)
                print("\n".join(f"{case.parent.name}: {line}" for line in rule_on_all_regions(self, run)), flush=True)
                # Regions that are made again have no neighbour at work that could send them anything.
                made = digests(run / "mesh")
                for domain in domains:
                    last = max(region["copy_of"] for region in domain["region_list"])
                    (run / f"mesh/{domain['name']}-{last:04d}.h5").unlink()
                done(self, "mesh", run, case=case, cells=300000, ranks=2)
                self.assertEqual(digests(run / "mesh"), made)

    def test_no_check_fails(self):
        for name, cells in CASES:
            with self.subTest(name):
                self.judge(name, cells)


if __name__ == "__main__":
    unittest.main()
