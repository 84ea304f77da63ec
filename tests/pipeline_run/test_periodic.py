# SPDX-License-Identifier: AGPL-3.0-or-later
"""The periodic impeller: periodic images in the shared run, their files as checkpoints, and the way back to the whole
impeller where the case asks for it or the passages are not equal."""
import shutil
import unittest

from cutwater import CELLS, RUN, changed_case, digests, done, read_json, record, seal, with_geometry

PASSAGES = 6


def rotor(run):
    return record(run, "mesh")["results"]["domains"][0]


def whole(test, run):
    """The run has a rotor that was meshed whole, with the count that was asked."""
    mesh = record(run, "mesh")["results"]
    test.assertEqual(rotor(run)["equal_passages"], 1)
    test.assertTrue(all(region["copy_of"] == region["region"] for region in rotor(run)["region_list"]))
    test.assertAlmostEqual(mesh["cells"] / CELLS, 1, delta=0.02)


class Periodic(unittest.TestCase):
    def test_regions_are_turned_copies(self):
        self.assertEqual(rotor(RUN)["equal_passages"], PASSAGES)
        regions = {region["region"]: region for region in rotor(RUN)["region_list"]}
        copies = [region for region in regions.values() if region["copy_of"] != region["region"]]
        firsts = {region["copy_of"] for region in copies}
        self.assertEqual(len(copies), (PASSAGES - 1) * len(firsts))
        for copy in copies:
            for kind in ("tetrahedra", "prisms"):
                self.assertEqual(copy[kind], regions[copy["copy_of"]][kind])

    def test_the_rule_of_region_numbers_divides_all_passages_alike(self):
        rule = rotor(RUN)["region_rule"]
        self.assertGreater(rule["planned_triangles"], 0)
        for key, count in rule.items():
            self.assertEqual(count % PASSAGES, 0, key)
        self.assertEqual(rule["final_triangles"], rule["planned_triangles"] + 2 * rule["inserted_centres"])

    def test_lost_files_come_back_as_they_were(self):
        regions = rotor(RUN)["region_list"]
        copies = [region["region"] for region in regions if region["copy_of"] != region["region"]]
        first = next(region["copy_of"] for region in regions if region["region"] == copies[0])
        for lost in ((copies[1],), (first, copies[-1])):
            run = with_geometry("lost")
            shutil.copytree(RUN / "mesh", run / "mesh")
            for region in lost:
                (run / f"mesh/rotor-{region:04d}.h5").unlink()
            done(self, "mesh", run, cells=CELLS, ranks=2)
            self.assertEqual(digests(run / "mesh"), digests(RUN / "mesh"), lost)
            shutil.rmtree(run)

    def test_the_case_may_ask_for_the_whole_impeller(self):
        run = with_geometry("whole")
        case = changed_case(run, ("\nmesh:\n", "\nmesh:\n  periodic_impeller: false\n"))
        result = done(self, "mesh", run, case=case, cells=CELLS, ranks=2)
        self.assertNotIn("passages", result.stdout)
        whole(self, run)
        shutil.rmtree(run)

    def test_unequal_passages_are_meshed_whole(self):
        run = with_geometry("unequal")
        table = run / "geometry/faces.csv"
        rows = table.read_text().splitlines()
        changed = [row.replace(",blade_pressure,wall,", ",blade_suction,wall,")
                   if row.endswith(",blade_pressure_2") else row for row in rows]
        self.assertNotEqual(rows, changed)
        table.write_text("\n".join(changed) + "\n")
        seal(self, run / "geometry")
        result = done(self, "mesh", run, cells=CELLS, ranks=2)
        lines = [line for line in result.stdout.splitlines() if "passages" in line]
        self.assertEqual(lines, ["cutwater-mesh: rotor: no equal passages; it is meshed whole"])
        whole(self, run)
        self.assertEqual(read_json(run, "mesh/manifest.json")["domains"][0]["name"], "rotor")
        shutil.rmtree(run)


if __name__ == "__main__":
    unittest.main()
