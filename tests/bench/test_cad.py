# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the bench of CAD solids counts: of which solids, and against what is asked of them."""
import os
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

import cad
from cutwater import SOURCE

FOLDER = Path("file.step.d")


def rows_of(text):
    return [(number, row and row["cause"]) for _, number, _, _, row in cad.listed_solids(FOLDER, text)]


def meshed(**other):
    return {"cause": "meshed", "cells": 100, "seconds": 3, "dihedral": 15, "allowed": 30, "full": 99, "bare": 0,
            "sound": True, **other}


class Solids(unittest.TestCase):
    def test_solids_and_refusals_are_counted(self):
        self.assertEqual(rows_of("solid 1 faces 6 volume 8e3\nsolid 2 refused: face 3 folds\n\nended 0\n"),
                         [("1", None), ("2", "not healed")])

    def test_a_file_that_is_not_read_or_sewn_is_one_of_its_own(self):
        for end, cause in (("cutwater: error: a.stp: is not a STEP file\n\nended 3", "not read or not sewn"),
                           ("cutwater: error: a.brep: holds no solid, and its 5 faces do not close\n\nended 3",
                            "not read or not sewn"),
                           ("\nended 10", "not read or not sewn"), ("\nended -11", "crashed"),
                           ("\nended timeout", "timeout")):
            self.assertEqual(rows_of(end + "\n"), [("0", cause)], end)
        self.assertEqual(rows_of("solid 1 faces 6 volume 8e3\n\nended -6\n"), [("1", None), ("0", "crashed")])

    def test_a_file_without_a_face_holds_no_solid(self):
        for said in ("holds no solid and no face; allowed: solids", "holds no shape; allowed: solids"):
            self.assertEqual(rows_of(f"cutwater: error: a.stp: {said}\n\nended 3\n"), [])

    def test_shapes_of_a_freecad_file_that_are_empty_are_none(self):
        with tempfile.TemporaryDirectory() as name:
            path = Path(name, "drawing.FCStd")
            with zipfile.ZipFile(path, "w") as archive:
                archive.writestr("PartShape.brp", "DBRep_DrawableShape")
                archive.writestr("PartShape1.brp", "")
                archive.writestr("Document.xml", "<xml/>")
            self.assertEqual([plain.name for plain in cad.plain_files(path, Path(name))],
                             ["drawing.FCStd.PartShape.brep"])

    def test_what_all_had_stands_beside_what_is_asked(self):
        rows = [meshed(), meshed(dihedral=9, allowed=14), meshed(dihedral=9, allowed=16), meshed(bare=1.5),
                meshed(seconds=61), meshed(sound=False), {"cause": "crashed"}, {"cause": "timeout"},
                {"cause": "not read or not sewn"}, {"cause": cad.NO_SOLID}]
        self.assertEqual([line[1:] for line in cad.asked_and_had(rows)],
                         [("9", "5"), ("6", "5"), ("95%", "83.3%"), ("0", "2"), ("0", "1")])


class Section(unittest.TestCase):
    def test_without_a_folder_the_section_is_passed_over(self):
        page = SOURCE / "docs/measurements.md"
        before = page.read_bytes()
        with tempfile.TemporaryDirectory() as folder:
            for value in ("", f"{folder}/none"):
                done = subprocess.run([sys.executable, "-B", SOURCE / "tests/bench/measurements.py", "cad"], text=True,
                                      env={**os.environ, "CUTWATER_CAD": value}, capture_output=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stderr, r"^measurements: cad: passed over: CUTWATER_CAD .*\n$")
        self.assertEqual(page.read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
