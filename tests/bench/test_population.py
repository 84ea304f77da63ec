# SPDX-License-Identifier: AGPL-3.0-or-later
"""12 random pumps by their duty alone and 12 with options, through all stages: what the geometry accepts is meshed and
written, and judged good."""
import sys
import unittest

import population
from cutwater import BIN, SOURCE, WORK, said

COUNT = 12


class Population(unittest.TestCase):
    def judge(self, *words):
        program = SOURCE / "tests/bench/population.py"
        line = [sys.executable, "-B", program, COUNT, "--strict", *words, "--bin", BIN, "--work", WORK / "population"]
        said(self, line, timeout=7000)

    def test_duty_only(self):
        self.judge()

    def test_with_options(self):
        self.judge("--options")

    def test_messages_are_grouped_without_their_numbers(self):
        first, second = (population.cause(f"/a/duty-1-{n}.yaml:{n}:3: {n}.5 mm at (1e-{n}, -2, 3)", f"duty-1-{n}")
                         for n in (3, 14))
        self.assertEqual(first, second)

    def test_prisms_explain_what_the_exporter_counted(self):
        names = ("skew_faces_of_prisms", "small_weight_faces_of_prisms", "small_volume_ratio_faces_of_prisms",
                 "twisted_faces", "high_aspect_ratio_prisms", "small_determinant_prisms")
        zones = [dict(zip(names, counts)) for counts in ((3, 0, 5, 2, 0, 24), (4, 12, 1, 0, 9, 0))]
        lines = (("Max skewness = 9.1, {} highly skew faces detected which may impair the quality of the results", 7),
                 ("Faces with small interpolation weight (< 0.05) found, number of faces: {}", 12),
                 ("Faces with small volume ratio (< 0.01) found, number of faces: {}", 6),
                 ("Error in face tets: {} faces with low quality or negative volume decomposition tets.", 2),
                 ("High aspect ratio cells found, Max aspect ratio: 6050.8319, number of cells {}", 9),
                 ("Cells with small determinant (< 0.001) found, number of cells: {}", 24))
        for line, count in lines:
            self.assertTrue(population.prisms_explain(line.format(count), zones, False), line)
            self.assertFalse(population.prisms_explain(line.format(count + 1), zones, False), line)
            self.assertTrue(population.prisms_explain(line.format(count + 1), zones, True), line)
            self.assertFalse(population.prisms_explain(line.format(count - 1), zones, True), line)
        self.assertFalse(population.prisms_explain("Concave cells found, number of cells: 7", zones, True))


if __name__ == "__main__":
    unittest.main()
