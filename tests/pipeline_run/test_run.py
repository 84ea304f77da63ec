# SPDX-License-Identifier: AGPL-3.0-or-later
"""The run of the paper's pump at a small size, by all stages in turn: the other tests of whole runs look at it."""
import os
import shutil
import unittest
from unittest import mock

from cutwater import BIN, CELLS, ENVIRONMENT, RUN, WORK, done, record, said

ORDER = WORK / f"sync_order-{CELLS}.txt"  # what the stages brought to the disk and renamed: tests/sync_order.c
SYNC_LIBRARY = os.environ.get("CUTWATER_SYNC_LIBRARY")  # none where sanitizers must be the first library


class Run(unittest.TestCase):
    def test_1_all_stages(self):
        shutil.rmtree(RUN, ignore_errors=True)
        ORDER.unlink(missing_ok=True)
        watched = {"LD_PRELOAD": SYNC_LIBRARY, "CUTWATER_SYNC_ORDER": str(ORDER)} if SYNC_LIBRARY else {}
        with mock.patch.dict(ENVIRONMENT, watched):
            done(self, "geometry", RUN)
            done(self, "mesh", RUN, cells=CELLS, ranks=2)
            done(self, "export", RUN, cells=CELLS, ranks=2)
            done(self, "report", RUN, cells=CELLS)
        for name in ("geometry/rotor.brep", "geometry/stator.brep", "geometry/faces.csv", "geometry/pump.step",
                     "geometry/design.json", "mesh/manifest.json", "export/pump.cgns",
                     "export/openfoam/constant/polyMesh/faces", "export/cfx/steady.ccl", "report/index.html"):
            self.assertGreater((RUN / name).stat().st_size, 100, name)

    def test_2_records_tell_what_was_done(self):
        for name in ("geometry", "mesh", "export", "report"):
            told = record(RUN, name)
            self.assertEqual(told["stage"], name)
            self.assertGreater(told["seconds"], 0)
            self.assertGreater(told["peak_memory_bytes"], 10e6)
            self.assertTrue(told["steps"])
            self.assertLessEqual(sum(step["seconds"] for step in told["steps"]), 1.01 * told["seconds"])

    def test_3_nothing_half_written_stays(self):
        known = {".brep", ".csv", ".step", ".json", ".svg", ".png", ".h5"}
        for folder in ("geometry", "mesh"):
            for path in (RUN / folder).iterdir():
                self.assertIn(path.suffix, known, path)

    def test_4_help(self):
        for name in ("geometry", "mesh", "export", "report"):
            self.assertIn(f"usage: cutwater-{name} --case FILE --run DIR",
                          said(self, [BIN / f"cutwater-{name}", "--help"]))

    @unittest.skipUnless(SYNC_LIBRARY, "sanitizers allow no library before their own")
    def test_5_files_are_on_the_disk_before_they_have_their_names(self):
        named, awaited = [], {}
        for line in ORDER.read_text().splitlines():
            process, event, *words = line.split(maxsplit=4)
            if event == "synced":
                awaited.pop((process, words[0]), None)
            elif not words[2].startswith(str(RUN)):
                continue  # of mpirun
            else:
                self.assertEqual(words[0], "on-disk", line)
                self.assertNotIn((process, words[1]), awaited)
                named.append(words[2][len(str(RUN)) + 1:])
                awaited[process, words[1]] = line  # until the folder with the name is on the disk too
        self.assertFalse(awaited)
        regions = {f"mesh/{path.name}" for path in (RUN / "mesh").glob("*.h5")}
        self.assertLessEqual(regions | {"geometry/rotor.brep", "geometry/pump.step", "geometry/faces.csv",
                                        "geometry/model.json", "geometry/record.json", "mesh/manifest.json",
                                        "mesh/record.json", "export/pump.cgns", "export/openfoam", "export/cfx",
                                        "export/record.json", "report/index.html"}, set(named))


if __name__ == "__main__":
    unittest.main()
