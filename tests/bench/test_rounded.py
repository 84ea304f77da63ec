# SPDX-License-Identifier: AGPL-3.0-or-later
"""The solids of tests/cad/rounded.py through the bench of CAD solids, with edges 20 times as long as their fillets are
wide. These go with the corners in which they meet: were they meshed, needles would stand along them."""
import json
import sys
import unittest

from cutwater import SOURCE, execute, fresh, pass_over_without_gmsh

CELLS = 30000


class Rounded(unittest.TestCase):
    def test_each_is_meshed_as_if_it_had_no_fillets(self):
        folder = fresh("rounded")
        drawn = execute([sys.executable, "-B", SOURCE / "tests/cad/rounded.py", folder])
        self.assertEqual(drawn.returncode, 0, drawn.stdout)
        names = sorted(path.name for path in folder.glob("*.step"))
        self.assertGreaterEqual(len(names), 10)
        bench = execute([sys.executable, "-B", SOURCE / "tests/bench/cad.py", folder, "--cells", CELLS, "--no-hxt",
                         "--out", folder / "out"])
        self.assertEqual(bench.returncode, 0, bench.stdout)
        rows = json.loads((folder / "out/rows.json").read_text())
        self.assertEqual(sorted(rows), [f"{name} 1" for name in names])
        for name, row in rows.items():
            with self.subTest(name):
                self.assertEqual(row["cause"], "meshed")
                self.assertGreater(row["dihedral"], 15)
                self.assertGreater(row["full"], 95)
                self.assertLess(abs(row["cells"] / CELLS - 1), 0.02)


if __name__ == "__main__":
    pass_over_without_gmsh()
    unittest.main()
