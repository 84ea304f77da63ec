# SPDX-License-Identifier: AGPL-3.0-or-later
"""What is read of OpenFOAM's files, by files of a mesh that is known by hand: a wedge 2 m long, its slope 3 : 4."""
import array
import math
import unittest

import foam_read
from cutwater import fresh

HEADER = 'FoamFile\n{\n    version 2.0;\n    format binary;\n    class %s;\n    arch "LSB;label=32;scalar=64";\n}\n\n'
POINTS = [(0, 0, 0), (4, 0, 0), (0, 3, 0), (0, 0, 2), (4, 0, 2), (0, 3, 2)]
FACES = [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [0, 3, 5, 2]]
PATCHES = {"ends": (2, 0), "floor": (1, 2), "slope": (1, 3), "back": (1, 4)}  # faces, first one


def listed(kind, values, count):
    return f"\n{count}\n(".encode() + array.array(kind, values).tobytes() + b")\n"


class Read(unittest.TestCase):
    def setUp(self):
        self.case = fresh("foam_read")
        mesh = self.case / "constant/polyMesh"
        mesh.mkdir(parents=True)
        (mesh / "points").write_bytes((HEADER % "vectorField").encode() +
                                      listed("d", [x for point in POINTS for x in point], len(POINTS)))
        starts = [sum(map(len, FACES[:k])) for k in range(len(FACES) + 1)]
        (mesh / "faces").write_bytes((HEADER % "faceCompactList").encode() + listed("i", starts, len(starts)) +
                                     listed("i", [p for face in FACES for p in face], starts[-1]))
        (mesh / "boundary").write_text(f"{len(PATCHES)}\n(\n" + "".join(
            f"    {name}\n    {{\n        type            wall;\n        inGroups        1(wall);\n"
            f"        nFaces          {count};\n        startFace       {first};\n    }}\n"
            for name, (count, first) in PATCHES.items()) + ")\n")

    def test_areas_of_patches(self):
        areas = foam_read.patch_areas(self.case)
        self.assertEqual({name: list(values) for name, values in areas.items()},
                         {"ends": [6, 6], "floor": [8], "slope": [10], "back": [6]})

    def test_values_of_patches_and_the_latest_time(self):
        for name in ("0", "90", "100", "2.5e-3", "constant"):
            (self.case / name).mkdir(exist_ok=True)
        path = foam_read.latest(self.case) / "yPlus"
        self.assertEqual(path.parent.name, "100")
        path.write_bytes((HEADER % "volScalarField").encode() + b"internalField   uniform 0;\n\nboundaryField\n{\n"
                         b"    ends\n    {\n        type            calculated;\n        value           nonuniform "
                         b"List<scalar> " + listed("d", [1.5, 2.5], 2) + b";\n    }\n"
                         b"    floor\n    {\n        type            calculated;\n        value           uniform 7;\n"
                         b"    }\n    slope\n    {\n        type            calculated;\n        value           "
                         b"nonuniform List<scalar> " + listed("d", [9], 1) + b";\n    }\n}\n")
        found = foam_read.patch_values(path)
        self.assertEqual({name: list(values) for name, values in found.items()}, {"ends": [1.5, 2.5], "slope": [9]})

    def test_means_over_surfaces(self):
        # Two squares of a ring of radius 2 and 4 m: what turns with 3 rad/s there, and comes out with 1 and 5 m/s.
        lines = ["# vtk DataFile Version 2.0", "ring", "ASCII", "DATASET POLYDATA"]
        points, values = [], []
        for r, half, out in ((2, 0.5, 1), (4, 1, 5)):
            points += [(r, y, z) for y, z in ((-half, -half), (half, -half), (half, half), (-half, half))]
            values.append((out, 3 * r, 0.25))
        lines += [f"POINTS {len(points)} float"] + [" ".join(map(str, point)) for point in points]
        lines += ["POLYGONS 2 10", "4 0 1 2 3", "4 4 5 6 7", "CELL_DATA 2", "FIELD attributes 2", "U 3 2 float"]
        lines += [" ".join(map(str, value)) for value in values] + ["p 1 2 float", "11 13"]
        path = self.case / "ring.vtk"
        path.write_text("\n".join(lines) + "\n")
        radial, tangential = foam_read.ring_means(path, -2, 2)
        self.assertAlmostEqual(radial, (1 * 1 + 4 * 5) / 5)  # by their areas of 1 and 4 m2
        self.assertAlmostEqual(tangential, (1 * 6 + 4 * 12) / 5)
        means = foam_read.radial_means(path, [1.9, 2.9, 3.9])
        self.assertEqual((means[0], means[2]), (11, 13))
        self.assertTrue(math.isnan(means[1]))


if __name__ == "__main__":
    unittest.main()
