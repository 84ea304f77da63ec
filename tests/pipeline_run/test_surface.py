# SPDX-License-Identifier: AGPL-3.0-or-later
"""The surface mesh of the shared run against the exact geometry: nodes on it, angles, cells across narrow places."""
import unittest

from cutwater import BIN, CELLS, RUN, rows_said

CELLS_ACROSS = 3  # mesh.cells_across_gap of the case
LEAST_ANGLE = 20 if CELLS >= 1000000 else 10  # degrees; a coarse triangle beside a cut may be sharper


class Surface(unittest.TestCase):
    def test_nodes_and_angles(self):
        patches = rows_said(self, [BIN / "surface_shape", RUN / "geometry", RUN / "mesh"])
        self.assertEqual({row["domain"] for row in patches}, {"rotor", "stator"})
        for row in patches:
            with self.subTest(row["patch"]):
                self.assertLess(float(row["distance_m"]), 1e-7)
                self.assertGreaterEqual(float(row["least"]), LEAST_ANGLE)
        triangles = sum(int(row["triangles"]) for row in patches)
        mean = sum(float(row["mean"]) * int(row["triangles"]) for row in patches) / triangles
        self.assertGreater(mean, 52)
        self.assertLess(sum(int(row["below20"]) for row in patches), 1e-3 * triangles)

    def test_cells_across(self):
        pairs = rows_said(self, [BIN / "cells_across", RUN / "geometry", RUN / "mesh", 12])
        found = {(row["from"], row["to"]) for row in pairs}
        self.assertIn(("hub", "shroud"), found)
        self.assertIn(("tongue", "stator_interface"), found)
        for row in pairs:
            with self.subTest(f"{row['from']} to {row['to']}"):
                self.assertGreaterEqual(int(row["cells"]), CELLS_ACROSS)


if __name__ == "__main__":
    unittest.main()
