# SPDX-License-Identifier: AGPL-3.0-or-later
"""The table of a sweep: order and index of made-up results whose order is known, and the table of a real run."""
import csv
import importlib.util
import subprocess
import sys
import unittest

from cutwater import CELLS, RUN, SOURCE, WORK

spec = importlib.util.spec_from_file_location("sweep", SOURCE / "pipeline/sweep.py")
sweep = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sweep)


class Sweep(unittest.TestCase):
    def test_order_of_known_results(self):
        for true in (0.7, 1, 2, 3.2):
            sizes = [1.0, 0.7, 0.55]
            order, limit, index = sweep.convergence(sizes, [10 + 0.3 * h**true for h in sizes])
            self.assertAlmostEqual(order, true, places=6)
            self.assertAlmostEqual(limit, 10, places=6)
            # 1.25 times what the extrapolation changes, over the finest value.
            finest = 10 + 0.3 * sizes[2]**true
            self.assertAlmostEqual(index, 1.25 * (finest - 10) / finest, places=8)

    def test_the_worked_example_of_the_source(self):
        # Celik et al., table 1, second column: 18000, 8000, 4500 cells in two dimensions; 6.063, 5.972, 5.863.
        sizes = [4500**-0.5, 8000**-0.5, 18000**-0.5]
        order, limit, index = sweep.convergence(sizes, [5.863, 5.972, 6.063])
        self.assertAlmostEqual(order, 1.53, delta=0.02)
        self.assertAlmostEqual(limit, 6.1685, delta=1e-3)
        self.assertAlmostEqual(100 * index, 2.2, delta=0.1)

    def test_results_that_swing_have_no_order(self):
        self.assertIsNone(sweep.convergence([3, 2, 1], [1.0, 1.2, 1.1]))
        self.assertIsNone(sweep.convergence([3, 2, 1], [1.0, 1.0, 1.0]))

    def test_table_of_a_run(self):
        table = WORK / "sweep.csv"
        table.parent.mkdir(parents=True, exist_ok=True)
        result = subprocess.run([sys.executable, SOURCE / "pipeline/sweep.py", table, RUN], stdout=subprocess.PIPE,
                                text=True, check=True)
        self.assertIn(RUN.name, result.stdout)
        rows = list(csv.DictReader(table.open()))
        self.assertEqual([row["run"] for row in rows], [RUN.name])
        self.assertAlmostEqual(int(rows[0]["cells"]) / CELLS, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
