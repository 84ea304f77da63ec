# SPDX-License-Identifier: AGPL-3.0-or-later
"""The triangles of the walls at sizes from small to large: partition planes, wherever a size puts them, leave none
that is flatter than the cells may be, for prisms and tetrahedra over it would be flat too."""
import math
import os
import unittest

from cutwater import command, execute, with_geometry

SIZES = os.environ["CUTWATER_SIZES"].split()
LEAST = 12  # degrees; as of the tetrahedra in tests/bench/population.py


def triangles(path):
    """Triangles of a surface that the mesher has drawn, as corners (m)."""
    with open(path) as lines:
        place = next(line for line in lines if line.startswith("POINTS"))
        point = [tuple(map(float, next(lines).split())) for _ in range(int(place.split()[1]))]
        faces = next(line for line in lines if line.startswith("POLYGONS"))
        for _ in range(int(faces.split()[1])):
            yield [point[int(corner)] for corner in next(lines).split()[1:]]


def least_angle(corners):
    """The angle of a triangle that faces its shortest side, degrees."""
    short, middle, long = sorted(math.dist(corners[k], corners[k - 1]) for k in range(3))
    cosine = (middle**2 + long**2 - short**2) / (2 * middle * long)
    return math.degrees(math.acos(max(-1.0, min(1.0, cosine))))


class WallAngles(unittest.TestCase):
    def test_no_size_leaves_flat_triangles(self):
        run = with_geometry("wall-angles")
        for size in SIZES:
            result = execute(command("mesh", run, cells=size, ranks=2) + ["--stop-after", "surface", "--vtk"])
            self.assertEqual(result.returncode, 0, result.stdout)
            for path in sorted((run / "mesh").glob("*-surface.vtk")):
                with self.subTest(size=size, domain=path.stem):
                    angle, where = min((least_angle(corners), corners) for corners in triangles(path))
                    print(f"{size} {path.stem}: {angle:.1f} degrees")
                    self.assertGreaterEqual(angle, LEAST, f"at {where[0]} m")
                path.unlink()


if __name__ == "__main__":
    unittest.main()
