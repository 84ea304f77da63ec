# SPDX-License-Identifier: AGPL-3.0-or-later
"""The layers of the shared run at places that are hard for them, and their last layers against the tetrahedra."""
import json
import unittest

from cutwater import BIN, PAPER, RUN, done, execute, record, with_geometry

# Least share of the columns with their first height within 10 %. In front of the trailing edge the interface leaves
# 1 mm for five layers of 0.22 mm; the tongue is bent from one coarse triangle to the next.
FIRST = {"trailing_edge": 90, "trailing_edge_hub": 90, "trailing_edge_shroud": 90, "tongue": 90}
THICKNESS = {"neck": 0.9, "step": 0.9, "tongue": 0.9, "volute_corner": 0.9}  # mm, least; 0.6 is five layers at 0.7
PLACES = {"trailing_edge", "trailing_edge_hub", "trailing_edge_shroud", "neck", "step", "tongue", "volute_corner"}


class Layers(unittest.TestCase):
    def test_hard_places(self):
        folder = RUN / "mesh"
        result = execute([BIN / "layer_places", RUN / "geometry", folder, RUN])
        self.assertEqual(result.returncode, 0, result.stdout)
        head, *lines = result.stdout.splitlines()
        rows = [dict(zip(head.split(), line.split())) for line in lines]
        self.assertEqual({row["place"] for row in rows}, PLACES)
        for row in rows:
            name = row["place"]
            with self.subTest(name):
                self.assertGreater(int(row["columns"]), 20)
                self.assertEqual(float(row["covered_%"]), 100)
                self.assertGreaterEqual(float(row["first_%"]), FIRST.get(name, 99))
                self.assertGreater(float(row["jacobian"]), 0.05)
                self.assertGreater(float(row["thickness_mm"]), THICKNESS.get(name, 0.4))
                picture = (RUN / f"layers_{name}.svg").read_text()
                self.assertGreater(picture.count("<path"), 20)

    def test_last_layer(self):
        results = json.loads((RUN / "mesh" / "record.json").read_text())["results"]
        patches = [patch for domain in results["domains"] for patch in domain["layer_coverage"]]

        def total(key):
            return sum(patch[key] for patch in patches)

        faces = total("wall_faces")
        uneven = total("thin_last_layer_faces") + total("thick_last_layer_faces")
        self.assertLess(total("volume_ratio_over_10_faces"), uneven)
        self.assertGreater(total("first_height_met_faces"), 0.995 * faces)
        self.assertEqual(total("thin_prisms"), 0)
        for patch in patches:
            with self.subTest(patch["patch"]):
                self.assertGreaterEqual(patch["volume_ratio_greatest"], patch["volume_ratio_95_percent"])
                self.assertEqual(patch["volume_ratio_greatest"] > 10, patch["volume_ratio_over_10_faces"] > 0)

    def test_thin_prisms(self):
        """First layers of 1/100 of the edges in the volute: the user is told where, and how much would spare them."""
        folder = with_geometry("thin-prisms")
        case = folder / "case.yaml"
        case.write_text(PAPER.read_text().replace("y_plus_volute: 30", "first_height_volute_um: 40", 1))
        done(self, "mesh", folder, case=case, cells=100000)
        results, warnings = (record(folder, "mesh")[key] for key in ("results", "warnings"))
        coverage = results["domains"][1]["layer_coverage"]
        thin = {patch["patch"]: patch["thin_prisms"] for patch in coverage}
        self.assertGreater(thin["volute"], 1000)
        told = [line for line in warnings if line.startswith(f"stator: {sum(thin.values())} prisms")]
        self.assertEqual(len(told), 1, warnings)
        self.assertIn(f"volute {thin['volute']}", told[0])
        worst = max((patch for patch in coverage if patch["thin_prisms"]), key=lambda p: p["thin_prisms_height_wanted"])
        place = ", ".join(f"{1e3 * c:.3f}" for c in worst["thinnest_prism_at_m"])
        self.assertIn(f"the thinnest at ({place}) mm", told[0])


if __name__ == "__main__":
    unittest.main()
