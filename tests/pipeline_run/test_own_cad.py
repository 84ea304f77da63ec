# SPDX-License-Identifier: AGPL-3.0-or-later
"""cases/own-cad is what tests/cad/own_cad.py draws."""
import sys
import unittest

from cutwater import SOURCE, fresh, pass_over_without_gmsh, said


def solids(path):
    """Volume, and sum of the areas of faces, of each solid in a STEP file."""
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.occ.importShapes(str(path))
    gmsh.model.occ.synchronize()
    found = [(gmsh.model.occ.getMass(*body),
              sum(gmsh.model.occ.getMass(*face) for face in gmsh.model.getBoundary([body], oriented=False)))
             for body in gmsh.model.getEntities(3)]
    gmsh.finalize()
    return found


class OwnCad(unittest.TestCase):
    def test_the_case_is_the_drawing(self):
        drawn, kept = fresh("own-cad-drawn"), SOURCE / "cases/own-cad"
        said(self, [sys.executable, SOURCE / "tests/cad/own_cad.py", drawn])
        self.assertEqual((drawn / "case.yaml").read_text(), (kept / "case.yaml").read_text())
        self.assertEqual(len(solids(kept / "pump.step")), 2)
        for made, of in zip(solids(drawn / "pump.step"), solids(kept / "pump.step"), strict=True):
            for value, other in zip(made, of):
                self.assertAlmostEqual(value / other, 1, delta=1e-9)


if __name__ == "__main__":
    pass_over_without_gmsh()
    unittest.main()
