# SPDX-License-Identifier: AGPL-3.0-or-later
"""Built with MPICH (libmpich-dev, mpich): mesher and exporter give the bytes that they give with the
MPI of the tests. Ends with 77, skipped, where these packages are missing."""
import shutil
import sys
import unittest

from cutwater import PAPER, SOURCE, WORK, command, digests, done, execute, fresh, said

CELLS = 150000  # in one pass, and quicker than fewer
BUILD = WORK.parent / "mpich"


class Mpich(unittest.TestCase):
    def test_the_same_bytes(self):
        for line in (["cmake", "-S", SOURCE, "-B", BUILD, "-DCUTWATER_TESTS=OFF", "-DMPI_C_COMPILER=mpicc.mpich"],
                     ["cmake", "--build", BUILD, "-j", 2, "--target", "cutwater-mesh", "cutwater-export"]):
            said(self, line, timeout=3000)
        linked = execute(["ldd", BUILD / "bin/cutwater-export"]).stdout
        self.assertIn("libmpich.so", linked)
        self.assertNotIn("libmpi.so", linked)
        top = fresh("mpich-runs")
        for stage in ("geometry", "mesh", "export"):
            done(self, stage, top / "other", cells=CELLS, ranks=2)
        shutil.copytree(top / "other/geometry", top / "mpich/geometry")
        for stage in ("mesh", "export"):
            line = [BUILD / f"bin/cutwater-{stage}", *command(stage, top / "mpich", case=PAPER, cells=CELLS)[-6:]]
            said(self, ["mpiexec.mpich", "-n", 2, *line])
            self.assertEqual(digests(top / "mpich" / stage), digests(top / "other" / stage))


if __name__ == "__main__":
    missing = [name for name in ("mpicc.mpich", "mpiexec.mpich") if not shutil.which(name)]
    if missing:
        print(f"{', '.join(missing)} missing: skipped")
        sys.exit(77)
    unittest.main()
