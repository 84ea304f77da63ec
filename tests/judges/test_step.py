# SPDX-License-Identifier: AGPL-3.0-or-later
"""pump.step before another program: gmsh reads two solids with the designed volumes and the right extent."""
import collections
import math
import re
import unittest

import gmsh

from cutwater import RUN, read_json


class Step(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.design = read_json(RUN, "geometry/design.json")
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
        gmsh.model.occ.importShapes(str(RUN / "geometry/pump.step"))
        gmsh.model.occ.synchronize()

    @classmethod
    def tearDownClass(cls):
        gmsh.finalize()

    def test_two_solids_with_the_designed_volumes(self):
        solids = gmsh.model.getEntities(3)
        self.assertEqual(len(solids), 2)
        volumes = [gmsh.model.occ.getMass(*solid) * 1e-9 for solid in solids]
        for volume, name in zip(volumes, ("rotor", "stator")):
            self.assertAlmostEqual(volume / self.design[f"{name}_volume_m3"], 1, delta=1e-4, msg=name)

    def test_extent(self):
        low = gmsh.model.getBoundingBox(3, 1)
        radius = self.design["interface_radius_m"] * 1e3
        for axis in (0, 1):
            self.assertAlmostEqual(low[axis], -radius, delta=0.01)
            self.assertAlmostEqual(low[3 + axis], radius, delta=0.01)

    def test_the_interface_lies_on_both_sides(self):
        # Each solid has its own faces there; together twice the cylinder.
        area = 2 * math.pi * self.design["interface_radius_m"] * 1e3 * 8
        for solid in gmsh.model.getEntities(3):
            on_cylinder = 0
            for _, face in gmsh.model.getBoundary([solid], oriented=False):
                box = gmsh.model.occ.getCenterOfMass(2, face)
                if gmsh.model.getType(2, face) != "Cylinder" or abs(box[2]) > 0.01:
                    continue
                low, high = gmsh.model.getParametrizationBounds(2, face)
                point = gmsh.model.getValue(2, face, [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2])
                if abs(math.hypot(point[0], point[1]) - self.design["interface_radius_m"] * 1e3) < 1e-3:
                    on_cylinder += gmsh.model.occ.getMass(2, face)
            self.assertAlmostEqual(on_cylinder / area, 1, delta=1e-4)

    def test_every_face_bears_the_name_of_its_patch(self):
        text = (RUN / "geometry/pump.step").read_text()
        rows = [row.split(",") for row in (RUN / "geometry/faces.csv").read_text().splitlines()[1:]]
        named = collections.Counter(re.findall(r"ADVANCED_FACE\('([^']*)'", text))
        self.assertEqual(named, collections.Counter(row[2] for row in rows))

    def test_gmsh_shows_the_patch_of_every_face(self):
        gmsh.model.add("faces")
        gmsh.model.occ.importShapes(str(RUN / "geometry/pump_faces.step"))
        gmsh.model.occ.synchronize()
        shown = collections.Counter(gmsh.model.getEntityName(*face).split("/")[-1]
                                    for face in gmsh.model.getEntities(2))
        rows = [row.split(",") for row in (RUN / "geometry/faces.csv").read_text().splitlines()[1:]]
        self.assertEqual(len(gmsh.model.getEntities(3)), 2)
        self.assertEqual(shown, collections.Counter(row[2] for row in rows))
        gmsh.model.remove()


if __name__ == "__main__":
    unittest.main()
