# SPDX-License-Identifier: AGPL-3.0-or-later
"""The same bytes whatever the number of ranks; and a run that was killed goes on to the same bytes."""
import os
import shutil
import signal
import time
import unittest

from cutwater import (CELLS, RUN, command, digests, done, error_lines, execute, left_behind, on_a_small_disk, ranks_of,
                      record, regions, start, with_geometry)


def page_of(run):
    return (run / "report/index.html").read_bytes()


class Ranks(unittest.TestCase):
    def test_mesh_is_the_same(self):
        expected = digests(RUN / "mesh")
        self.assertGreater(len(expected), 8)
        for ranks in (1, 3):
            run = with_geometry(f"ranks-{ranks}")
            done(self, "mesh", run, cells=CELLS, ranks=ranks)
            self.assertEqual(digests(run / "mesh"), expected, f"{ranks} ranks against 2")
            shutil.rmtree(run)

    def test_export_is_the_same(self):
        expected = digests(RUN / "export")
        for ranks in (1, 3):
            run = with_geometry(f"export-{ranks}")
            os.symlink(RUN / "mesh", run / "mesh")
            done(self, "export", run, cells=CELLS, ranks=ranks)
            self.assertEqual(digests(run / "export"), expected, f"{ranks} ranks against 2")
            shutil.rmtree(run)

    def test_report_is_the_same(self):
        run = with_geometry("report")
        for stage in ("mesh", "export"):
            os.symlink(RUN / stage, run / stage)
        pages = []
        for ranks in (1, 2, 3):
            done(self, "report", run, cells=CELLS, ranks=ranks)
            pages.append(page_of(run))
        self.assertEqual(execute(command("report", run, cells=CELLS)[-7:]).returncode, 0, "without mpirun")
        pages.append(page_of(run))
        self.assertEqual([page == pages[0] for page in pages], [True] * 4, "1, 2, 3 ranks and without mpirun")
        shutil.rmtree(run)


def first_region(run, process):
    """Waits until a region is whole; whether one is before the run is over."""
    deadline = time.monotonic() + 900
    while not regions(run) and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    return bool(regions(run))


class Resume(unittest.TestCase):
    def setUp(self):
        # A run whose first pass misses the asked count makes all regions once more, with other bytes.
        self.assertEqual(record(RUN, "mesh")["results"]["passes"], 1, f"{CELLS} cells do not come in one pass")

    def goes_on(self, run, ranks=2):
        """The run is called again and ends in the bytes of the whole run; no region that was whole is made again."""
        mesh = run / "mesh"
        self.assertFalse((mesh / "manifest.json").exists(), "stopped too late: the run was over")
        whole = {path.name: path.stat().st_mtime_ns for path in regions(run)}
        self.assertTrue(whole, "no region was whole")
        for name in whole:  # what bears a final name is whole
            self.assertEqual((mesh / name).read_bytes(), (RUN / "mesh" / name).read_bytes(), name)
        done(self, "mesh", run, cells=CELLS, ranks=ranks)
        self.assertEqual(digests(mesh), digests(RUN / "mesh"))
        self.assertEqual({name: (mesh / name).stat().st_mtime_ns for name in whole}, whole)
        shutil.rmtree(run)

    def test_a_killed_run_called_again_ends_in_the_same_bytes(self):
        run = with_geometry("resume")
        process = start("mesh", run, cells=CELLS, ranks=2)
        self.assertTrue(first_region(run, process))
        ranks = ranks_of(process.pid)
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        self.assertEqual(left_behind(ranks), [])  # ranks end when they see their mpirun gone
        self.goes_on(run)

    def test_a_run_with_a_killed_rank_called_again(self):
        run = with_geometry("resume-rank")
        process = start("mesh", run, cells=CELLS, ranks=2)
        self.assertTrue(first_region(run, process))
        ranks = ranks_of(process.pid)
        self.assertEqual(len(ranks), 2)
        os.kill(ranks[1], signal.SIGKILL)
        _, text = process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertEqual(len(error_lines(text, "mesh")), 1, text)
        self.assertEqual(left_behind(ranks), [])
        self.goes_on(run, ranks=3)

    def test_a_run_on_a_full_disk_called_again(self):
        size = sum(path.stat().st_size for path in (RUN / "mesh").iterdir())
        run = with_geometry("resume-full")
        result = on_a_small_disk(self, "mesh", run, size // 2, cells=CELLS, ranks=2)
        self.assertNotEqual(result.returncode, 0)
        self.assertEqual(len(error_lines(result.stdout, "mesh")), 1, result.stdout)
        self.assertIn(str(run / "mesh"), error_lines(result.stdout, "mesh")[0])
        self.goes_on(run)

    def test_a_second_call_makes_no_region_again(self):
        run = with_geometry("again")
        shutil.copytree(RUN / "mesh", run / "mesh")
        before = {path.name: path.stat().st_mtime_ns for path in regions(run)}
        done(self, "mesh", run, cells=CELLS, ranks=2)
        after = {path.name: path.stat().st_mtime_ns for path in regions(run)}
        self.assertEqual(after, before)
        shutil.rmtree(run)


if __name__ == "__main__":
    unittest.main()
