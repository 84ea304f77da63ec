# SPDX-License-Identifier: AGPL-3.0-or-later
"""OpenCASCADE's check of the arguments of boolean operations finds nothing in the solids of the shipped cases that are
designed and of 24 random pumps with options. Random pumps that are refused do not count."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from cutwater import BIN, SOURCE

sys.path.insert(0, str(SOURCE / "tests/bench"))
import random_pumps  # noqa: E402

PUMPS, REFUSED = 24, 77


class BooleanArguments(unittest.TestCase):
    def is_built(self, case):
        """Whether the pump of the case is built; it has no fault then."""
        done = subprocess.run([BIN / "geometry_test_boolean_ready", case], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        self.assertIn(done.returncode, (0, REFUSED), f"{case}:\n{done.stdout}")
        return done.returncode == 0

    def test_shipped_cases(self):
        for case in sorted((SOURCE / "cases").glob("*/case.yaml")):
            if "\ncad:" in case.read_text():
                continue
            with self.subTest(case=case.parent.name):
                self.assertTrue(self.is_built(case))

    def test_random_pumps(self):
        index = built = 0
        with tempfile.TemporaryDirectory() as folder:
            while built < PUMPS:
                index += 1
                name = f"options-1-{index}"
                case = Path(folder) / f"{name}.yaml"
                case.write_text(random_pumps.case_text(name, random_pumps.pump(1, index, True)))
                built += 1
                with self.subTest(pump=name):
                    built -= not self.is_built(case)


if __name__ == "__main__":
    unittest.main()
