# SPDX-License-Identifier: AGPL-3.0-or-later
"""The same bytes whatever the number of ranks; and a run that was killed goes on to the same bytes."""
import os
import shutil
import signal
import time
import unittest

from cutwater import CELLS, RUN, digests, done, start, with_geometry


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


class Resume(unittest.TestCase):
    def test_a_killed_run_called_again_ends_in_the_same_bytes(self):
        run = with_geometry("resume")
        mesh = run / "mesh"
        process = start("mesh", run, cells=CELLS, ranks=2)
        deadline = time.monotonic() + 900
        while not list(mesh.glob("*.h5")) and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        self.assertFalse((mesh / "manifest.json").exists(), "killed too late: the run was over")
        self.assertTrue(list(mesh.glob("*.h5")), "no region was whole")
        time.sleep(1)  # ranks end when they see their mpirun gone
        done(self, "mesh", run, cells=CELLS, ranks=2)
        self.assertEqual(digests(mesh), digests(RUN / "mesh"))
        shutil.rmtree(run)

    def test_a_second_call_makes_no_region_again(self):
        run = with_geometry("again")
        shutil.copytree(RUN / "mesh", run / "mesh")
        before = {path.name: path.stat().st_mtime_ns for path in (run / "mesh").glob("*.h5")}
        done(self, "mesh", run, cells=CELLS, ranks=2)
        after = {path.name: path.stat().st_mtime_ns for path in (run / "mesh").glob("*.h5")}
        self.assertEqual(after, before)
        shutil.rmtree(run)


if __name__ == "__main__":
    unittest.main()
