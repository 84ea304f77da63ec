# SPDX-License-Identifier: AGPL-3.0-or-later
"""The page that sets runs side by side: of made-up records, whose words and numbers are known; in a browser too."""
import json
import subprocess
import sys
import unittest
from html.parser import HTMLParser

import browser
from cutwater import SOURCE, fresh

sys.path.insert(0, str(SOURCE / "pipeline"))
import compare  # noqa: E402
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


def write(run, head, speed, cells, curve=(), test_head=None):
    records = {"mesh": {"case": {"name": "a <b>", "speed_rpm": speed}, "seconds": 3, "peak_memory_bytes": 2e6,
                        "warnings": ["x"], "results": {"cells": cells, "ranks": 2, "domains": [DOMAIN]}},
               "geometry": {"seconds": 1, "warnings": [], "results": {"predicted_head_m": 12}},
               "report": {"warnings": []}}
    if head:
        records["solve"] = {"warnings": ["y"], "results": {"head_m": head, "torque_n_m": 7, "iterations": 300,
                            "hydraulic_efficiency": 0.8, "settled": True, "y_plus": {"hub": {"most": 31}},
                            "curve": curve},
                            "made_from": stage_files.of_export({})}
    if test_head:
        records["export"] = {"seconds": 1, "results": {"test_head_m": test_head}}
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

    def test_runs_of_one_pump_are_a_sweep(self):
        # The heads of test_sweep.py, whose order is ln 2 / ln(3^(1/3)); torque and efficiency do not change.
        folder = fresh("compare_sweep")
        point = {"flow_m3_per_h": 20, "head_m": 11, "shaft_power_w": 800, "hydraulic_efficiency": None}
        more = {"flow_m3_per_h": 25, "head_m": 10, "shaft_power_w": 900, "hydraulic_efficiency": None}
        for name, cells, head in (("p-1", 100000, 10.4), ("p-3", 300000, 10.2), ("p-9", 900000, 10.1)):
            write(folder / name, head, 1450, cells, [point, more] if name != "p-1" else [], test_head=10)
        write(folder / "<other>", 9, 1500, 300000, [point])  # one point is no curve
        self.assertEqual(call(folder).stderr, "")
        text = (folder / "index.html").read_text()
        page = Rows()
        page.feed(text)
        self.assertEqual(page.open, [])
        rows = {row[0]: row[1:] for row in page.rows}
        self.assertEqual(rows["p-3"], ["300,000", "1.442", "10.2", "7", "80", "31.0"])
        self.assertEqual(rows["observed order"], ["", "", "1.89", "–", "–", ""])
        self.assertEqual(rows["extrapolated"], ["", "", "10", "–", "–", ""])
        self.assertEqual(rows["grid convergence index of the finest"], ["", "", "1.24%", "–", "–", ""])
        self.assertEqual(rows["measured"], ["", "", "10", "", "", ""])
        self.assertEqual(text.count(">measured 10</text>"), 1)
        # Of each pump the points over the cells, three charts; then two curves of two points, of head and power.
        self.assertEqual(text.count("<circle"), 3 * 4 + 2 * 2 * 2)
        self.assertEqual(text.count("</svg>"), 3 + 2)
        self.assertEqual([key.split("<")[0] for key in text.split("</i>")[1:]], ["p", "&lt;other&gt;", "p-3", "p-9"])

    def test_meshes_that_are_alike_have_no_order(self):
        runs = [{"row": {"cells": cells, "head_m": head}} for cells, head in
                ((100000, 10.4), (300000, 10.2), (300000, 10.1))]
        self.assertIsNone(compare.converged(runs, "head_m"))
        runs[2]["row"]["cells"] = 900000
        self.assertIsNotNone(compare.converged(runs, "head_m"))

    @unittest.skipUnless(browser.THERE, browser.MISSING)
    def test_the_page_fits_a_phone(self):
        folder = fresh("compare_browser")
        points = [{"flow_m3_per_h": flow, "head_m": 14 - flow / 10} for flow in (15, 20, 25)]
        for k in range(6):
            write(folder / f"pump-with-a-long-name-{k}", 10 + 0.1 * k, 1450 + k // 3, 100000 * 2**k, points, 10)
        self.assertEqual(call(folder).stderr, "")
        browser.fits_a_phone(self, folder / "index.html", folder / "page.html", browser.END)

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
