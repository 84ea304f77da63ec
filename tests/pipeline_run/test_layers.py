# SPDX-License-Identifier: AGPL-3.0-or-later
"""The layers of the shared run at places that are hard for them, and their last layers against the tetrahedra.
Modules without a test of their own that it runs: layer_coverage."""
import re
import shutil
import unittest

from cutwater import BIN, PAPER, RUN, changed_case, done, record, rows_said, with_geometry

# Least share of the columns with their first height within 10 %. In front of the trailing edge the interface leaves
# 1 mm for five layers of 0.22 mm; the tongue is bent from one coarse triangle to the next.
FIRST = {"trailing_edge": 90, "trailing_edge_hub": 90, "trailing_edge_shroud": 90, "tongue": 90}
THICKNESS = {"neck": 0.9, "step": 0.9, "tongue": 0.9, "volute_corner": 0.9}  # mm, least; 0.6 is five layers at 0.7
QUICK = 150000  # cells: in one pass, and quicker than fewer
PLACES = {"trailing_edge", "trailing_edge_hub", "trailing_edge_shroud", "neck", "step", "tongue", "volute_corner"}


class Layers(unittest.TestCase):
    def test_hard_places(self):
        rows = rows_said(self, [BIN / "layer_places", RUN / "geometry", RUN / "mesh"])
        self.assertEqual({row["place"] for row in rows}, PLACES)
        for row in rows:
            name = row["place"]
            with self.subTest(name):
                self.assertGreater(int(row["columns"]), 20)
                self.assertEqual(float(row["covered_%"]), 100)
                self.assertGreaterEqual(float(row["first_%"]), FIRST.get(name, 99))
                self.assertGreater(float(row["jacobian"]), 0.05)
                self.assertGreater(float(row["thickness_mm"]), THICKNESS.get(name, 0.4))

    def test_last_layer(self):
        patches = [patch for domain in record(RUN, "mesh")["results"]["domains"] for patch in domain["layer_coverage"]]

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
        case = changed_case(folder, ("y_plus_volute: 30", "first_height_volute_um: 40"))
        done(self, "mesh", folder, case=case, cells=QUICK)
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


class AskedWalls(unittest.TestCase):
    """Whole small runs of the paper's pump with other walls."""

    def run_with(self, name, walls, viscosity="1.004e-6", cells=QUICK):
        """Meshes the pump with these lines in the section of the walls. Gives results, patches and what was told."""
        folder = with_geometry(name)
        case = folder / "case.yaml"
        text = PAPER.read_text().replace("1.004e-6", viscosity, 1)
        case.write_text(re.sub(r"\nwalls:\n(  .*\n)+", "\nwalls:\n  roughness_um: 0\n" + walls, text, count=1))
        if "1.004e-6" not in case.read_text():  # a pump for another fluid
            done(self, "geometry", folder, case=case)
        told = done(self, "mesh", folder, case=case, cells=cells).stdout
        results = record(folder, "mesh")["results"]
        shutil.rmtree(folder / "mesh")
        return results, [patch | {"layers": domain["layers"]} for domain in results["domains"]
                         for patch in domain["layer_coverage"]], told

    def share(self, patches, *keys):
        return sum(patch[key] for patch in patches for key in keys) / sum(patch["wall_faces"] for patch in patches)

    def test_water_with_all_left_open(self):
        results, patches, _ = self.run_with("walls-open", "")
        self.assertEqual({patch["first_height_from"] for patch in patches}, {"auto"})
        for patch in patches:
            # In the log layer, or as much as six layers that grow by 1.3 leave of 0.35 of the passage; the trailing
            # edge stands 1 mm before the interface: layers as tall as the first fill 0.6 of that.
            roomy = 0.35 * patch["passage_width_m"] * 0.3 / (1.3 ** 6 - 1)
            if patch["patch"] == "blade_trailing_edge":
                roomy = min(roomy, 0.6e-3 / patch["layers"])
            if abs(patch["first_height_target_m"] / roomy - 1) > 1e-6:
                self.assertLess(patch["first_height_target_m"], roomy)
                self.assertGreaterEqual(patch["y_plus"], 30 * (1 - 1e-9))
            self.assertLessEqual(patch["y_plus"], 300 * (1 + 1e-9))
        self.assertGreater(min(patch["layers"] for patch in patches), 2)
        self.assertLess(self.share(patches, "thin_last_layer_faces", "thick_last_layer_faces"), 0.06)
        self.assertLess(self.share(patches, "volume_ratio_over_10_faces"), 0.004)
        self.assertGreater(self.share(patches, "first_height_met_faces"), 0.97)
        # On edges so long, layers beside blades are lower than the tetrahedra want; nothing else is to be told.
        self.assertEqual([text for text in results["headlines"] if "volumes change by more than 4" not in text], [])

    def test_oil_flows_laminar(self):
        """1000 cSt: the passage of 8 mm between hub and shroud, with w = 6 m/s, has a Reynolds number below 100."""
        results, patches, told = self.run_with("walls-oil", "", viscosity="1e-3")
        laminar = [text for text in results["headlines"] if "laminar" in text]
        self.assertEqual(len(laminar), 2, results["headlines"])  # rotor and stator
        lines = told.splitlines()
        first_told = next(i for i, line in enumerate(lines) if "laminar" in line)
        self.assertLess(first_told, next(i for i, line in enumerate(lines) if "size seeds" in line))
        for patch in patches:
            self.assertEqual(patch["first_height_from"], "laminar")
            self.assertLess(patch["passage_reynolds"], 2300)
            self.assertIsNone(patch["y_plus"])
            share = 0.02 * patch["passage_width_m"]
            if patch["patch"] == "blade_trailing_edge":  # 1 mm before the interface
                share = min(share, 0.6e-3 / patch["layers"])
            self.assertAlmostEqual(patch["first_height_target_m"], share, places=9)
        hub = next(patch for patch in patches if patch["patch"] == "hub")
        self.assertAlmostEqual(hub["passage_width_m"], 0.008, places=6)
        self.assertLess(hub["passage_reynolds"], 100)
        self.assertGreater(self.share(patches, "first_height_met_faces"), 0.97)
        # The layers of trailing edges, which have their first height, are thin for the edges of so few cells.
        self.assertLess(self.share(patches, "thin_last_layer_faces", "thick_last_layer_faces"), 0.09)

    def test_y_plus_that_does_not_fit(self):
        walls = "".join(f"  y_plus_{group}: 400\n" for group in ("blade", "hub_shroud", "volute", "pipe"))
        results, patches, told = self.run_with("walls-400", walls)
        hub = next(patch for patch in patches if patch["patch"] == "hub")
        self.assertEqual(hub["first_height_from"], "fitted")
        self.assertLess(hub["y_plus"], 400)
        self.assertGreater(hub["first_height_asked_m"], hub["first_height_target_m"])
        self.assertLess(2 * 3 * hub["first_height_target_m"], 0.7 * hub["passage_width_m"])
        fitted = next(text for text in results["headlines"] if text.startswith("rotor: first heights of which"))
        self.assertIn(f"walls.y_plus_hub_shroud: {hub['y_plus']:.3g}", fitted)
        self.assertIn(fitted, told)
        self.assertGreater(self.share(patches, "first_height_met_faces"), 0.9)

    def test_resolved_walls(self):
        """Few cells leave no room for the layers of resolved walls; as many as the headline tells have it."""
        walls = "".join(f"  y_plus_{group}: 0.5\n" for group in ("blade", "hub_shroud", "volute", "pipe"))
        results, patches, told = self.run_with("walls-resolved", walls)
        self.assertEqual({patch["first_height_from"] for patch in patches}, {"asked"})
        self.assertGreater(self.share(patches, "first_height_met_faces"), 0.98)
        self.assertGreater(min(domain["least_dihedral_deg"] for domain in results["domains"]), 12)
        few = [text for text in results["headlines"] if "layers that lead from the first height" in text]
        self.assertEqual(len(few), 2, results["headlines"])  # rotor and stator
        made, needed, cells = re.search(r"rotor: (\d+) of the (\d+) layers.* mesh.cells (\S+) has", few[0]).groups()
        self.assertEqual({patch["layers"] for patch in patches}, {int(made)})
        self.assertGreater(int(needed), 15)
        lines = told.splitlines()
        first_told = next(i for i, line in enumerate(lines) if few[0] in line)
        self.assertLess(first_told, next(i for i, line in enumerate(lines) if "decomposition" in line))

        results, patches, _ = self.run_with("walls-resolved", walls, cells=int(1.1 * float(cells)))
        self.assertEqual([text for text in results["headlines"] if "layers that lead" in text], [])
        self.assertGreater(min(patch["layers"] for patch in patches), 15)
        self.assertGreater(self.share(patches, "first_height_met_faces"), 0.98)
        self.assertLess(self.share(patches, "thin_last_layer_faces", "thick_last_layer_faces"), 0.06)


if __name__ == "__main__":
    unittest.main()
