# SPDX-License-Identifier: AGPL-3.0-or-later
"""The triangles of the walls at sizes from small to large: partition planes, wherever a size puts them, leave none
that is flatter than the cells may be, for prisms and tetrahedra over it would be flat too."""
import math
import os
import unittest

from cutwater import command, said, surface, with_geometry

SIZES = os.environ["CUTWATER_SIZES"].split()
LEAST = 12  # degrees; as of the tetrahedra in tests/bench/population.py


def least_angle(corners):
    """The angle of a triangle that faces its shortest side, degrees."""
    short, middle, long = sorted(math.dist(corners[k], corners[k - 1]) for k in range(3))
    cosine = (middle**2 + long**2 - short**2) / (2 * middle * long)
    return math.degrees(math.acos(max(-1.0, min(1.0, cosine))))


class WallAngles(unittest.TestCase):
    def test_no_size_leaves_flat_triangles(self):
        run = with_geometry("wall-angles")
        for size in SIZES:
            said(self, command("mesh", run, cells=size, ranks=2) + ["--stop-after", "surface", "--vtk"])
            for domain in ("rotor", "stator"):
                path = run / f"mesh/{domain}-surface.vtk"
                with self.subTest(size=size, domain=domain):
                    points, triangles = surface(path)
                    places = ([points[corner] for corner in triangle] for triangle in triangles)
                    angle, where = min((least_angle(corners), corners) for corners in places)
                    print(f"{size} {domain}: {angle:.1f} degrees")
                    self.assertGreaterEqual(angle, LEAST, f"at {where[0]} m")
                path.unlink()


if __name__ == "__main__":
    unittest.main()
