# SPDX-License-Identifier: AGPL-3.0-or-later
"""Bad input and failing runs through the real programs: one line, an exit status, nothing half-written."""
import os
import shutil
import signal
import socket
import time
import unittest
from pathlib import Path

from cutwater import (CELLS, RUN, changed_case, digests, done, error_lines, fresh, left_behind, ranks_of, record,
                      said_until, seal, stage, start, with_geometry)

QUICK = 150000  # cells: in one pass, and quicker than fewer
# What is changed in the case of the paper, and what the one line must hold.
BAD = [
    ("outlet_diameter_mm: 200", "outlet_diameter_kg: 0.2", "outlet_diameter_kg"),
    ("outlet_diameter_mm: 200", "outlet_diameter_mm: 20000", "out of range"),
    ("outlet_diameter_mm: 200", "outlet_diameter_mm: two", "outlet_diameter_mm"),
    ("outlet_diameter_mm: 200", "outlet_diameter_mm: 200\n  outlet_diameter_mm: 201", "outlet_diameter_mm"),
    ("outlet_diameter_mm: 200", "outlet_diametre_mm: 200", "outlet_diametre_mm"),
    ("outlet_diameter_mm: 200", "outlet_diameter_mm: .nan", "outlet_diameter_mm"),
    ("inlet_diameter_mm: 74", "inlet_diameter_mm: 220", "contradicts impeller.outlet_diameter_mm"),
    ("blade_count: 6", "blade_count: 6.5", "blade_count"),
    ("base_diameter_mm: 204", "base_diameter_mm: 190", "contradicts impeller.outlet_diameter_mm"),
    ("name: paper", "name: ../paper", "name"),
    ("impeller:", "impeler:", "impeler"),
    ("walls:", "walls: {", "case.yaml"),
]


def files_of(folder):
    """All but the log, which tells of the failure."""
    return [str(path) for path in Path(folder).rglob("*") if path.is_file() and path.parent.name != "log"]


class BadInput(unittest.TestCase):
    def one_line(self, result, name, run):
        self.assertNotEqual(result.returncode, 0)
        self.assertLess(result.returncode, 128, result.stdout)
        self.assertEqual(len(error_lines(result.stdout, name)), 1, result.stdout)
        self.assertEqual(len(result.stdout.strip().splitlines()), 1, result.stdout)
        self.assertEqual(files_of(run), [])

    def test_case_files(self):
        for number, (old, new, told) in enumerate(BAD):
            with self.subTest(new):
                folder = fresh(f"bad-{number}")
                result = stage("geometry", folder / "run", case=changed_case(folder, (old, new)))
                self.one_line(result, "geometry", folder / "run")
                self.assertIn("case.yaml", result.stdout)
                self.assertIn(told, result.stdout)

    def test_every_stage_refuses_a_bad_case_before_it_works(self):
        for name in ("geometry", "mesh", "export", "report"):
            with self.subTest(name):
                folder = fresh(f"bad-{name}")
                case = changed_case(folder, ("blade_count: 6", "blade_count: 60"))
                result = stage(name, folder / "run", case=case, ranks=3)
                self.one_line(result, name, folder / "run")
                self.assertIn("blade_count", result.stdout)

    def test_no_case_file(self):
        folder = fresh("bad-none")
        self.one_line(stage("geometry", folder / "run", case=folder / "no.yaml"), "geometry", folder / "run")
        self.one_line(stage("geometry", folder / "run", case=folder), "geometry", folder / "run")

    def test_a_pipe_as_case_file(self):
        # Without a writer it would hold whoever opens it.
        for name in ("geometry", "mesh", "export", "report"):
            folder = fresh(f"bad-pipe-{name}")
            os.mkfifo(folder / "case.yaml")
            result = stage(name, folder / "run", case=folder / "case.yaml", ranks=2)
            self.one_line(result, name, folder / "run")
            self.assertIn("no plain file; allowed: a case file", result.stdout)

    def test_cells(self):
        for cells in ("many", "-5", "12", "1e99", "1.5"):
            folder = fresh("bad-cells")
            result = stage("mesh", folder / "run", cells=cells, ranks=2)
            self.one_line(result, "mesh", folder / "run")
            self.assertIn("--cells", result.stdout)

    def test_a_stage_without_the_one_before(self):
        for name in ("mesh", "export", "report"):
            with self.subTest(name):
                folder = fresh(f"bad-order-{name}")
                self.one_line(stage(name, folder / "run", ranks=2), name, folder / "run")

    def test_a_broken_solid(self):
        for file, old, new in (("rotor.brep", None, ""), ("stator.brep", None, "DBRep_DrawableShape\n\n7\n"),
                               ("stator.brep", "\nTShapes ", "\nTShape "),
                               ("model.json", '"rotor_interface"', '"no_interface"'),
                               ("faces.csv", "rotor,1,", "rotor,999,"), ("faces.csv", ",wall,", ",wal,")):
            with self.subTest(f"{file} {new}"):
                run = with_geometry("bad-solid")
                path = run / "geometry" / file
                path.write_text(new if old is None else path.read_text().replace(old, new, 1))
                seal(self, run / "geometry")
                result = stage("mesh", run, cells=CELLS, ranks=2)
                self.assertNotEqual(result.returncode, 0)
                self.assertEqual(len(error_lines(result.stdout, "mesh")), 1, result.stdout)
                for line in result.stdout.splitlines():
                    self.assertTrue(line.startswith("cutwater-mesh: "), "the words of a library: " + line)
                self.assertFalse((run / "mesh/manifest.json").exists())

    def test_a_folder_of_another_pump(self):
        run = with_geometry("bad-origin")
        (run / "mesh").mkdir()
        shutil.copy(RUN / "mesh/record.json", run / "mesh")
        case = changed_case(run, ("outlet_width_mm: 8", "outlet_width_mm: 9"))
        for name in ("mesh", "export", "report"):
            with self.subTest(name):
                result = stage(name, run, case=case, cells=CELLS, ranks=2)
                self.assertEqual(result.returncode, 3, result.stdout)
                self.assertEqual(len(result.stdout.strip().splitlines()), 1, result.stdout)
                self.assertIn(f"cutwater-{name}: error: {run}/geometry: made with impeller.outlet_width_mm: 8, "
                              "the case file has 9; allowed: the same pump, run cutwater-geometry", result.stdout)
        done(self, "geometry", run, case=case)
        result = stage("export", run, case=case, ranks=2)
        self.assertEqual(len(error_lines(result.stdout, "export")), 1, result.stdout)
        self.assertIn(f"{run}/mesh: made with impeller.outlet_width_mm: 8", result.stdout)

    def test_keys_that_the_pump_does_not_follow_from(self):
        # The geometry has the same bytes, and one that was made before is taken.
        run = fresh("other-mesh-keys")
        case = changed_case(run, ("layer_count: 5", "layer_count: 3"), ("cells: 1000000", f"cells: {QUICK}"),
                            ("time_step_deg: 1", "time_step_deg: 2"))
        done(self, "geometry", run, case=case)
        self.assertEqual(digests(run / "geometry"), digests(RUN / "geometry"))
        shutil.rmtree(run / "geometry")
        shutil.copytree(RUN / "geometry", run / "geometry")
        done(self, "mesh", run, case=case, ranks=2)

    def test_more_regions_than_the_cells_are_for(self):
        run = with_geometry("many-regions")
        case = changed_case(run, ("\nmesh:", "\nmesh:\n  least_regions: 1000"))
        warned = [line for line in done(self, "mesh", run, case=case, cells=QUICK, ranks=2).stdout.splitlines()
                  if "mesh.least_regions is 1000" in line]
        self.assertEqual(len(warned), 2, "a line for each domain")
        for domain in record(run, "mesh")["results"]["domains"]:
            self.assertGreaterEqual(domain["regions"], 4)
            # One for 5000 cells, and a whole one in each passage.
            self.assertLessEqual(domain["regions"], QUICK / 5000 + 6)


class Failures(unittest.TestCase):
    def test_a_folder_that_cannot_be_written(self):
        # A file where the folder should be: also root cannot write there. Told before any work is done.
        for name in ("geometry", "mesh", "export", "report"):
            with self.subTest(name):
                run = with_geometry(f"blocked-{name}")
                (run / "mesh").mkdir()
                for file in ("record.json", "manifest.json"):
                    shutil.copy(RUN / "mesh" / file, run / "mesh")
                shutil.rmtree(run / name, ignore_errors=True)
                (run / name).write_text("")
                result = stage(name, run, cells=CELLS, ranks=3)
                self.assertEqual(result.returncode, 4)
                self.assertEqual(result.stdout.strip(), f"cutwater-{name}: error: {run / name}: is not a folder")

    def test_a_second_stage_in_the_folder(self):
        """It ends in one line that names the holder, whose files, log and end stay as they would have been."""
        run = with_geometry("locked")
        holder = start("mesh", run, cells="20M", ranks=2)
        said_until(self, holder, "size field")
        text = (run / "log/mesh.log").read_text()
        for name in ("mesh", "geometry", "report"):
            with self.subTest(name):
                result = stage(name, run, ranks=2)
                self.assertEqual(result.returncode, 4, result.stdout)
                self.assertEqual(len(result.stdout.strip().splitlines()), 1, result.stdout)
                self.assertRegex(result.stdout, f"cutwater-{name}: error: {run}: cutwater-mesh on host "
                                 f"{socket.gethostname()}, process ({'|'.join(map(str, ranks_of(holder.pid)))}) works")
        self.assertIsNone(holder.poll())
        self.assertTrue((run / "log/mesh.log").read_text().startswith(text))
        os.kill(holder.pid, signal.SIGTERM)
        _, text = holder.communicate(timeout=60)
        self.assertIn("stopped from outside", error_lines(text, "mesh")[0])

    def test_a_run_that_is_stopped_says_so_once(self):
        run = with_geometry("stopped")
        process = start("mesh", run, cells="2M", ranks=3)
        said_until(self, process, "size field")
        os.kill(process.pid, signal.SIGTERM)
        _, text = process.communicate(timeout=60)
        self.assertGreater(process.returncode, 0)
        self.assertEqual(len(error_lines(text, "mesh")), 1, text)
        self.assertIn("stopped from outside", error_lines(text, "mesh")[0])
        self.assertEqual(files_of(run / "mesh"), [])
        self.assertEqual(sorted(path.name for path in (run / "log").iterdir()), ["mesh.log", "run.lock"])

    def test_a_killed_rank_ends_the_run(self):
        run = with_geometry("killed")
        process = start("mesh", run, cells="2M", ranks=3)
        victim = None
        deadline = time.monotonic() + 60
        while victim is None and time.monotonic() < deadline:
            time.sleep(0.1)
            ranks = ranks_of(process.pid)
            victim = ranks[-1] if len(ranks) == 3 else None
        self.assertIsNotNone(victim, "three ranks did not start")
        time.sleep(2)
        os.kill(victim, signal.SIGKILL)
        _, text = process.communicate(timeout=300)
        self.assertNotEqual(process.returncode, 0)
        self.assertEqual(len(error_lines(text, "mesh")), 1, text)
        self.assertIn("a rank was killed", error_lines(text, "mesh")[0])
        self.assertFalse((run / "mesh/manifest.json").exists())
        self.assertFalse((run / "mesh/record.json").exists())
        self.assertEqual(left_behind(ranks), [])


if __name__ == "__main__":
    unittest.main()
