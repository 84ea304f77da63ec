# SPDX-License-Identifier: AGPL-3.0-or-later
"""What population.py takes up from an earlier call, and what it says of results that are given here."""
import contextlib
import io
import unittest
from unittest import mock

import population

REFUSED = "table: 3 mm is too much: lower impeller.outlet_width_mm; tried: impeller.outlet_width_mm: 2 works"


def good(index, options, **figures):
    return {"index": index, "options": options, "verdict": "good", "bad": [], "figures": figures}


def failed(index, options, stage="geometry", status=6, message=REFUSED):
    return {"index": index, "options": options, "verdict": "failed", "stage": stage, "status": status,
            "message": message, "figures": {}}


class Rules(unittest.TestCase):
    def setUp(self):
        self.installed = {"cgnscheck", "checkMesh"}
        which = mock.patch("population.shutil.which", lambda name: name if name in self.installed else None)
        which.start()
        self.addCleanup(which.stop)

    def key(self, *words, index=3):
        return population.row_key(population.arguments(list(words)), index, "programs", "case")

    def broken(self, results, *words):
        return population.broken_rules(population.arguments(list(words)), results)

    def test_a_row_is_taken_up_only_with_what_its_verdict_follows_from(self):
        one = self.key()
        self.assertEqual(one, self.key("100", "--jobs", "1", "--strict"))
        for words in (("--check-mesh", "1"), ("--limit", "60"), ("--ranks", "2"), ("--cells", "300k"),
                      ("--until", "mesh")):
            self.assertNotEqual(one, self.key(*words), words)
        self.assertEqual(one, self.key("--check-mesh", "2"))  # which leaves pump 3 as it was
        eighth = self.key(index=8)
        self.assertNotEqual(one, eighth)
        self.installed = {"cgnscheck"}
        self.assertEqual(one, self.key())
        self.assertNotEqual(eighth, self.key(index=8))
        self.installed = {"checkMesh"}
        self.assertNotEqual(one, self.key())

    def test_good_pumps_and_few_refusals_break_no_rule(self):
        self.assertEqual(self.broken([good(1, False), good(2, False)]), [])
        results = [good(index, True) for index in range(1, 50)] + [failed(50, True)]
        self.assertEqual(self.broken(results, "--options"), [])

    def test_each_rule_is_named(self):
        many = [good(index, True) for index in range(1, 200)]
        for result, rule in (({**good(200, True), "verdict": "bad"}, "a pump is bad: pumps 200"),
                             (failed(200, True, "mesh", 8), "a pump fails after the geometry: pumps 200")):
            self.assertEqual(self.broken(many + [result], "--options"), [rule])
        for end in ({"status": -11}, {"status": 124}, {"status": 1}, {"message": "no section meets the wall"},
                    {"message": f"a fault of the program, please report it; {REFUSED}"}):
            self.assertEqual(self.broken(many + [failed(200, True, **end)], "--options"),
                             ["the geometry ends with no refusal that names a key: pumps 200"], end)
        self.assertEqual(self.broken([good(1, False), failed(2, False)]),
                         ["a pump by its duty alone fails: pumps 2"])
        lines = self.broken(many[:48] + [failed(49, True)], "--options")
        self.assertEqual(lines, ["98.0 % of the pumps with options are good; asked: 98 %"])

    def test_a_missing_validator_is_a_rule_where_it_has_a_say(self):
        self.installed = set()
        pumps = [good(index, False) for index in range(1, 9)]
        self.assertEqual(self.broken(pumps), ["cgnscheck is not installed", "checkMesh is not installed"])
        self.assertEqual(self.broken(pumps[:7]), ["cgnscheck is not installed"])
        self.assertEqual(self.broken(pumps, "--until", "mesh"), [])

    def test_volume_ratios_have_a_verdict_where_nothing_was_told_before(self):
        results = [good(1, True, even=0.97, volume_ratio=9.0, layers_told=False),
                   good(2, True, even=0.97, volume_ratio=12.0, layers_told=False),
                   good(3, True, even=0.2, volume_ratio=80.0, layers_told=True), failed(4, True)]
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            population.print_ratios(results)
        told, others = said.getvalue().splitlines()[-2:]
        self.assertEqual(told.split()[-4:], ["1", "0", "0", "80.0"])
        self.assertEqual(others.split()[-7:], ["2", "2", "1", "12.0", "1", "miss", "it"])

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
            self.assertTrue(population.prisms_explain(line.format(count), zones), line)
            self.assertFalse(population.prisms_explain(line.format(count + 1), zones), line)
            self.assertFalse(population.prisms_explain(line.format(count - 1), zones), line)
        self.assertFalse(population.prisms_explain("Concave cells found, number of cells: 7", zones))


if __name__ == "__main__":
    unittest.main()
