# SPDX-License-Identifier: AGPL-3.0-or-later
"""The page that sets runs side by side: of made-up records, whose words and numbers are known."""
import json
import subprocess
import sys
import unittest
from html.parser import HTMLParser

from cutwater import SOURCE, fresh

sys.path.insert(0, str(SOURCE / "pipeline"))
import stage_files  # noqa: E402

DOMAIN = {"tetrahedra": 60, "prisms": 40, "regions": 3, "tetrahedron_aspect_mean": 1.5, "least_dihedral_deg": 14.2,
          "layer_coverage": [{"wall_faces": 10, "first_height_met_faces": 9}]}


class Rows(HTMLParser):
    """The rows of the tables of a page, as lists of words; whether each element that is opened is closed."""

    def __init__(self):
        super().__init__()
        self.rows, self.open, self.links = [], [], []

    def handle_starttag(self, tag, attrs):
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag == "a":
            self.links.append(dict(attrs)["href"])
        if tag not in ("meta", "path", "circle", "rect", "polyline"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in ("path", "circle", "rect", "polyline"):
            assert self.open.pop() == tag, tag

    def handle_data(self, data):
        if self.open and self.open[-1] in ("td", "th", "a") and self.rows:
            self.rows[-1][-1] += data.strip()


def write(run, head, speed, cells):
    records = {"mesh": {"case": {"name": "a <b>", "speed_rpm": speed}, "seconds": 3, "peak_memory_bytes": 2e6,
                        "warnings": ["x"], "results": {"cells": cells, "ranks": 2, "domains": [DOMAIN]}},
               "geometry": {"seconds": 1, "warnings": [], "results": {"predicted_head_m": 12}},
               "report": {"warnings": []}}
    if head:
        records["solve"] = {"warnings": ["y"], "results": {"head_m": head, "torque_n_m": 7, "iterations": 300,
                            "hydraulic_efficiency": 0.8, "settled": True, "y_plus": {"hub": {"most": 31}}},
                            "made_from": stage_files.of_export({})}
    for stage, record in records.items():
        (run / stage).mkdir(parents=True)
        (run / stage / "record.json").write_text(json.dumps(record))


def call(folder):
    return subprocess.run([sys.executable, SOURCE / "pipeline/compare.py", folder], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False)


class Compare(unittest.TestCase):
    def test_runs_stand_side_by_side(self):
        folder = fresh("compare")
        write(folder / "one", 11.5, 1450, 1000)
        write(folder / "two", 12.25, 1500, 8000)
        write(folder / "unsolved", None, 1450, 100)
        write(folder / "stale", 11.5, 1450, 4000)  # exported anew since it was solved
        (folder / "stale/export").mkdir()
        (folder / "stale/export/record.json").write_text(json.dumps({"files": {"pump.cgns": "1"}, "seconds": 1}))
        (folder / "no_run").mkdir()
        result = call(folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        text = (folder / "index.html").read_text()
        page = Rows()
        page.feed(text)
        self.assertEqual(page.open, [])
        rows = {row[0]: row[1:] for row in page.rows}
        self.assertEqual(rows[""], ["one", "stale", "two", "unsolved"])
        self.assertEqual(rows["speed_rpm"], ["1450", "1450", "1500", "1450"])
        self.assertNotIn("name", rows)  # alike in all
        self.assertEqual(rows["cells"], ["1,000", "4,000", "8,000", "100"])
        self.assertEqual(rows["head solved, m"], ["11.500", "–", "12.250", "–"])
        self.assertEqual(rows["settled"], ["yes", "–", "yes", "–"])
        self.assertEqual(rows["first height met, %"], ["90.0"] * 4)
        self.assertEqual(rows["warnings"], ["2", "1", "2", "1"])
        self.assertEqual(page.links, [f"{name}/report/index.html" for name in rows[""]])
        self.assertEqual(text.count("<circle"), 6)  # two runs in each of three charts
        self.assertNotIn("src=", text)
        self.assertIn("<p>Of the case the keys that shape the pump, where", text)  # records have no others

    def test_wrong_folders_are_told(self):
        folder = fresh("compare_empty")
        self.assertRegex(call(folder / "none").stderr, r"^compare: error: .*no such folder; allowed: .*\n$")
        self.assertRegex(call(folder).stderr, r"^compare: error: .*holds no run with a mesh; make one .*\n$")
        write(folder / "one", 11.5, 1450, 1000)
        (folder / "one/solve/record.json").write_text("{")
        self.assertRegex(call(folder).stderr, r"^compare: error: .*\n$")
        self.assertFalse((folder / "index.html").exists())


if __name__ == "__main__":
    unittest.main()
