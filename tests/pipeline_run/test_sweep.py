# SPDX-License-Identifier: AGPL-3.0-or-later
"""The table of a sweep: order and index of made-up results whose order is known, and the table of a real run."""
import csv
import json
import math
import random
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from cutwater import CELLS, RUN, SOURCE, WORK, execute, fresh, record, said

sys.path.insert(0, str(SOURCE / "pipeline"))
import needs  # noqa: E402
import stage_files  # noqa: E402
import sweep  # noqa: E402
import sweep_plot  # noqa: E402


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

    def test_any_sizes_have_their_order(self):
        some = random.Random(1)
        cases = [[2e5, 1e6, 2e6], [5e5, 2e6, 3e6], [1e5, 1e6, 2e6]]
        cases += [sorted(10**some.uniform(4, 9) for _ in range(3)) for _ in range(500)]
        for cells in cases:
            if min(cells[1] / cells[0], cells[2] / cells[1]) < 1.1:
                continue
            for true in (0.7, 1, 2, 3):
                sizes = [(count / cells[0])**(-1 / 3) for count in cells]
                order, limit, _ = sweep.convergence(sizes, [10 + 3 * h**true for h in sizes])
                self.assertAlmostEqual(order, true, delta=1e-6, msg=cells)
                self.assertAlmostEqual(limit, 10, delta=1e-6, msg=cells)

    def test_changes_that_do_not_fall_with_the_size_have_no_order(self):
        # Linear in the logarithm of the size: order 0.
        self.assertIsNone(sweep.convergence([4, 2, 1], [3.0, 2.0, 1.0]))
        self.assertIsNone(sweep.convergence([4, 2, 1], [2.5, 2.0, 1.0]))
        self.assertAlmostEqual(sweep.convergence([4, 2, 1], [3.5, 2.0, 1.0])[0], math.log2(1.5))

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

    @staticmethod
    def solved_runs(name, models=(["k-epsilon"],) * 3):
        """Three of them in a folder, whose meshes have these models: of turbulence, and the walls that are resolved."""
        folder = fresh(name)
        for name, cells, head, (model, *walls) in zip("abc", (100000, 300000, 900000), (10.4, 10.2, 10.1), models):
            results = record(RUN, "mesh")["results"] | {"cells": cells}
            export = {"seconds": 1,
                      "results": {"test_head_m": 10, "turbulence_model": model, "resolved_walls": walls}}
            written = {"mesh": record(RUN, "mesh") | {"results": results}, "export": export,
                       "solve": {"made_from": stage_files.of_export(export), "warnings": [],
                                 "results": {"head_m": head, "torque_n_m": 7.0, "hydraulic_efficiency": None,
                                             "y_plus": {"hub": {"most": 41.5}}}}}
            for stage, text in written.items():
                (folder / name / stage).mkdir(parents=True)
                (folder / name / stage / "record.json").write_text(json.dumps(text))
        return folder

    def test_flows_of_different_models_have_no_order(self):
        sst = "k-omega SST"
        for models, told in (((["k-epsilon"], [sst, "hub"], [sst, "hub"]),
                              "k-epsilon with 0 resolved walls on a; k-omega SST with 1 resolved walls on b, c"),
                             (([sst, "hub"], [sst, "hub"], [sst, "hub", "shroud"]),
                              "SST with 1 resolved walls on a, b; k-omega SST with 2 resolved walls on c")):
            folder = self.solved_runs("sweep_models", models)
            runs = [folder / name for name in "abc"]
            said_here = said(self, [sys.executable, SOURCE / "pipeline/sweep.py", folder / "sweep.csv", *runs])
            self.assertRegex(said_here, "^no order and no grid convergence index: ")
            self.assertIn(told, said_here.splitlines()[0])
            self.assertNotIn("extrapolated", said_here + (folder / "sweep.svg").read_text())
            said(self, [sys.executable, SOURCE / "pipeline/compare.py", folder])
            page = (folder / "index.html").read_text()
            self.assertIn(f"{told}.</p>", page)
            self.assertRegex(page, "<th>observed order</th>(<td></td>){2}(<td>&ndash;</td>){3}")

    def test_runs_that_were_solved_are_drawn_with_what_was_measured(self):
        folder = self.solved_runs("sweep_drawn")
        table = folder / "sweep.csv"
        told = said(self, [sys.executable, SOURCE / "pipeline/sweep.py", table, *(folder / name for name in "cab")])
        # Equal ratios of cells: the order is ln(0.2 / 0.1) / ln(3^(1/3)), and as far again is left beyond the finest.
        self.assertRegex(told, r"head_m +order 1\.89, extrapolated 10, grid convergence index 1\.24 %")
        self.assertRegex(told, r"torque_n_m +does not converge")
        self.assertEqual([row["y_plus_most"] for row in csv.DictReader(table.open())], ["41.5"] * 3)
        root = ElementTree.parse(folder / "sweep.svg").getroot()
        words = [element.text for element in root.iter() if element.tag.endswith("text")]
        self.assertIn("measured 10", words)
        self.assertEqual(sum(element.tag.endswith("circle") for element in root.iter()), 6)

    def test_points_lie_where_their_values_are(self):
        text = "\n".join(sweep_plot.chart("x", [1e4, 1e5, 1e6], [1, 2, 3], [], 0))
        x, y = zip(*((float(a), float(b)) for a, b in re.findall(r'cx="([\d.]+)" cy="([\d.]+)"', text)))
        self.assertAlmostEqual(x[1] - x[0], x[2] - x[1], delta=0.11)
        self.assertAlmostEqual(y[0] - y[1], y[1] - y[2], delta=0.11)
        self.assertGreater(y[0], y[1])

    def test_what_a_sweep_needs_is_told_and_refused_where_it_is_not_there(self):
        counts = [needs.read_count(text) for text in ("500k", "1.5M", "20000", "40K", "3e6")]
        self.assertEqual(counts, [500000, 1500000, 20000, 40000, 3000000])

        def call(*words):
            return subprocess.run([sys.executable, SOURCE / "pipeline/needs.py", *words], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True, check=False)
        told = call(WORK / "not/there/yet", "100k", "200k")
        self.assertEqual((told.returncode, told.stdout), (0, ""))
        self.assertRegex(told.stderr, r"^2 runs, 300,000 cells: about 0\.0\d+ GB of the .* GB free on the disk, .*\n$")
        self.assertRegex(call(WORK, "2G", "2000G").stderr, r"needs: error: .* make room, or ask for fewer cells\n$")
        self.assertEqual(call(WORK, "2000G").returncode, 1)
        self.assertIn(" on the disk, 0.47 GB of ", call(WORK, "8M").stderr)
        self.assertIn(" on the disk, 1.8 GB of ", call(WORK, "--ranks", "16", "8M").stderr)
        for more in ((), ("--solve",)):
            alone = call(WORK, *more)
            self.assertEqual(alone.returncode, 1)
            self.assertRegex(alone.stderr, r"^needs: error: no number of cells and no --case that has one; .*\n$")
        self.assertRegex(call(WORK, "1.5.5M").stderr, r"^needs: error: '1\.5\.5M' is no number of cells; allowed: .*")

    def test_the_memory_of_the_mesher_is_about_what_was_measured(self):
        for cells, ranks, measured in ((8e6, 2, 0.47e9), (8e6, 16, 1.8e9), (100e6, 1, 0.9e9), (100e6, 16, 3e9)):
            self.assertLess(abs(needs.mesher_memory(cells, ranks) / measured - 1), 0.02, (cells, ranks))
        # 100 bytes for each cell of a region; none has more cells than the mesh.
        self.assertEqual(needs.mesher_memory(8e6, 3, 4e6) - needs.mesher_memory(8e6, 3, 1e6), 3 * 3e6 * 100)
        self.assertEqual(needs.rank_memory(3e6, 4e6), needs.rank_memory(3e6, 3e6))
        table = (SOURCE / "mesher/policy_table.h").read_text()
        policy = dict(re.findall(r"^NUMBER\(double, (\w+), ([\d.e]+)", table, re.M))
        self.assertEqual([needs.REGION_CELLS, needs.REGIONS_MOST, needs.REGION_CELLS_MOST],
                         [float(policy[name]) for name in ("region_cells", "regions_most", "region_cells_most")])
        self.assertEqual(needs.rank_memory(1e9), needs.rank_memory(1e9, 2e6))

    def test_formats_and_cells_are_found_however_yaml_has_them(self):
        case = fresh("needs_case") / "case.yaml"
        both = ["cgns", "fluent"]
        for text, formats, cells, *more in (
                ("export:\n  formats: [cgns, fluent]\ncgns:\n  integers: 64\n", both, "1M"),
                ("export:\n  formats:\n    - cgns\n    - fluent\nopenfoam: {processors: 2}\n", both, "1M"),
                ("export: {formats: [cgns,\n  fluent]}\nmesh: {cells: 2M, fill: kernel}\n", both, "2M"),
                ("export:\n  formats: fluent  # alone\nmesh:\n  cells_per_region: 9000\n  cells: 30K # all\n",
                 ["fluent"], "30K", 9000),
                ("mesh: {cells_per_region: 1.5M, cells: 8M}\n", list(needs.FORMATS), "8M", 1500000),
                ("mesh:\r\n  cells: 5e7\r\n", list(needs.FORMATS), "5e7"),
                ("operating_points: {flow_shares: [1]}\n", list(needs.FORMATS), "1M", None, 1),
                ("operating_points:\n  flow_rates_m3_per_h: [15,\n    20.5, 3e1]\n", list(needs.FORMATS), "1M", None,
                 3),
                ("operating_points:\n  flow_shares:\n  - 0.8\n  - 1  # design\nmesh: {cells: 2M}\n",
                 list(needs.FORMATS), "2M", None, 2)):
            case.write_bytes(text.encode())
            found = needs.case_says(case)
            self.assertEqual((list(found[0]), *found[1:]), (formats, [cells], *more, *(None, 4)[len(more):]), text)

    def test_the_table_of_the_documents_is_that_of_the_script(self):
        command = re.search(r"`pipeline/(needs.py --table [^`]+)`", (SOURCE / "docs/cluster.md").read_text())[1].split()
        told = said(self, [sys.executable, SOURCE / "pipeline" / command[0], *command[1:]])
        self.assertIn(told, (SOURCE / "docs/cluster.md").read_text())

    def test_the_parts_of_a_run_on_the_disk_are_about_what_is_told(self):
        cells = record(RUN, "mesh")["results"]["cells"]
        for stage, expected in (("mesh", needs.disk_of("mesh", cells)), ("export", needs.export_disk(cells))):
            self.assertLess(abs(needs.size_of(RUN / stage) / expected - 1), 0.33, stage)

    def test_a_run_is_told_what_it_needs_by_its_formats_and_refused(self):
        case = WORK / "needs.yaml"
        case.parent.mkdir(parents=True, exist_ok=True)
        text = (SOURCE / "cases/paper/case.yaml").read_text()

        def call(formats, *cells):
            case.write_text(text + formats)
            return execute([sys.executable, SOURCE / "pipeline/needs.py", WORK, "--case", case, *cells])
        self.assertEqual((call("").returncode, call("").stdout), (0, ""))  # a small one
        *disk, code_saturne = [
            float(re.search(r"about ([\d.]+) GB", call(formats, "100M").stdout)[1])
            for formats in ("export: {formats: [cgns]}\n", "", "export:\n  formats: [cfx, fluent]\n",
                            "export: {formats: [code_saturne]}\n")]
        self.assertEqual(disk, sorted(disk))
        self.assertEqual(code_saturne, disk[0])  # it reads pump.cgns
        self.assertLess(2 * disk[0], disk[1])
        memory = [float(re.search(r"disk, ([\d.]+) GB of", call(f"mesh: {{cells_per_region: {of_region}}}\n", "--ranks",
                                                               "4", "20M").stdout)[1])
                  for of_region in ("300k", "4M")]
        self.assertAlmostEqual(memory[1] - memory[0], 4 * 3.7e6 * 100e-9, delta=0.06)
        self.assertIn("make room, or ask for fewer cells", call("export: {formats: cgns}\n", "2000G").stdout)
        self.assertEqual(call("", "2000G").returncode, 1)

    def test_a_sweep_is_told_what_its_cases_need_and_what_its_runs_have_is_free(self):
        folder, files = fresh("needs_sweep"), []
        for name, formats in (("all", ""), ("few", "export: {formats: [cgns]}\nmesh: {cells_per_region: 4M}\n")):
            files.append(folder / "cases" / name / "case.yaml")
            files[-1].parent.mkdir(parents=True)
            files[-1].write_text(f"name: {name}\n{formats}")

        def told(*words):
            text = execute([sys.executable, SOURCE / "pipeline/needs.py", folder, "--sweep", *words]).stdout
            return [float(re.search(pattern, text)[1]) for pattern in
                    (r"about ([\d.]+) GB", r" of the ([\d.e+]+) GB free", r"disk, ([\d.]+) GB of")]
        both = told("--case", files[0], "--case", files[1], "8M", "20M")
        each = [told("--case", file, "8M", "20M") for file in files]
        self.assertAlmostEqual(both[0], each[0][0] + each[1][0], delta=0.02)
        self.assertLess(2 * each[1][0], each[0][0])
        self.assertEqual(both[2], each[1][2])
        self.assertGreater(each[1][2], each[0][2] + 0.5)
        solving = told("--solve", "--case", files[1], "8M", "20M")
        # 500 bytes a cell, and the starts: mesh, pump.cgns and flow of 1M, 2.5M, 125k, 312k and 39k cells.
        started = [told("--case", files[1], start)[0] for start in ("1M", "2.5M", "125k", "312500", "39062")]
        self.assertAlmostEqual(solving[0] - each[1][0], 14 + sum(started) + 500 * 3.977e-3, delta=0.1)
        curve = told("--curve", "--case", files[1], "8M", "20M")
        self.assertAlmostEqual(curve[0] - solving[0], 3 * 14, delta=0.1)  # of four points one is the operating point
        self.assertEqual(curve[2], solving[2])
        self.assertEqual(solving[2], 40)
        few = told("--solve", "--ranks", "64", "--case", files[1], "30k")  # the ranks of the mesher need more
        self.assertAlmostEqual(few[2], needs.mesher_memory(30e3, 64, 4e6) / 1e9, delta=0.06)
        written = folder / "few-20M/mesh"
        written.mkdir(parents=True)
        with open(written / "a", "wb") as file:
            file.truncate(10**13)  # of holes
        self.assertGreater(told("--case", files[1], "8M", "20M")[1] - each[1][1], 9000)
        self.assertLess(told("--case", files[0], "8M", "20M")[1] - each[0][1], 1000)

    def test_records_are_digested_as_the_stages_do(self):
        for stage in ("geometry", "mesh"):
            text = (RUN / stage / "record.json").read_bytes()
            self.assertEqual(stage_files.digest(text[:text.rindex(b',\n  "digest": "')]), json.loads(text)["digest"])
        geometry = stage_files.files_digest(record(RUN, "geometry"))
        self.assertEqual(record(RUN, "mesh")["made_from"], {"geometry": geometry})
        text = stage_files.sealed({"stage": "solve", "results": {}})
        self.assertEqual(list(json.loads(text)), ["stage", "results", "digest"])
        self.assertEqual(stage_files.digest(text[:text.rindex(',\n  "digest"')].encode()), json.loads(text)["digest"])

    def test_table_of_a_run(self):
        table = WORK / "sweep.csv"
        table.parent.mkdir(parents=True, exist_ok=True)
        self.assertIn(RUN.name, said(self, [sys.executable, SOURCE / "pipeline/sweep.py", table, RUN]))
        rows = list(csv.DictReader(table.open()))
        self.assertEqual([row["run"] for row in rows], [RUN.name])
        self.assertAlmostEqual(int(rows[0]["cells"]) / CELLS, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
