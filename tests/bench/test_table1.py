# SPDX-License-Identifier: AGPL-3.0-or-later
"""Table 1 at a small size: one domain alone, with as many cells and regions as asked."""
import io
import json
import os
import subprocess
import sys
import unittest
from contextlib import redirect_stdout
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import runs
import table1
from cutwater import BIN, SOURCE, fresh

CELLS = os.environ.get("CUTWATER_TABLE1_CELLS")
REGIONS = 6


class Alone(unittest.TestCase):
    def setUp(self):
        self.folder = fresh("table1-alone")
        (self.folder / "all").mkdir()
        patches = {"rotor": [("hub", "wall"), ("rotor_interface", "interface"), ("inlet", "inlet")],
                   "stator": [("stator_interface", "interface"), ("interface", "wall")]}
        model = {"domains": [{"name": name, "patches": [{"name": patch, "kind": kind} for patch, kind in listed]}
                             for name, listed in patches.items()],
                 "interfaces": [{"patches": ["rotor_interface", "stator_interface"]}], "flow": {}}
        (self.folder / "all/model.json").write_text(json.dumps(model))
        rows = [f"{name},{face},{patch},{kind},{patch}_1" for name, listed in patches.items()
                for face, (patch, kind) in enumerate(listed, 1)]
        (self.folder / "all/faces.csv").write_text("\n".join(["domain,face,patch,kind,name", *rows]) + "\n")

    def alone(self, domain):
        with mock.patch.object(runs, "execute") as execute:
            runs.domain_alone(Path("bin"), self.folder / "all", domain, self.folder / domain)
        execute.assert_called_once_with(Path("bin/seal_files"), self.folder / domain)
        return json.loads((self.folder / domain / "model.json").read_text()), (self.folder / domain / "faces.csv")

    def test_interfaces_are_outlets_and_nothing_else_changes(self):
        model, faces = self.alone("rotor")
        self.assertEqual([one["name"] for one in model["domains"]], ["rotor"])
        self.assertEqual(model["interfaces"], [])
        self.assertEqual(model["domains"][0]["patches"],
                         [{"name": "hub", "kind": "wall"},
                          {"name": "rotor_interface", "kind": "outlet", "flow_share": 1.0},
                          {"name": "inlet", "kind": "inlet"}])
        self.assertEqual(faces.read_text(), "domain,face,patch,kind,name\nrotor,1,hub,wall,hub_1\n"
                                            "rotor,2,rotor_interface,outlet,rotor_interface_1\n"
                                            "rotor,3,inlet,inlet,inlet_1\n")

    def test_a_name_is_no_kind(self):
        _, faces = self.alone("stator")
        self.assertIn("stator,2,interface,wall,interface_1\n", faces.read_text())

    def test_another_name_is_refused(self):
        with self.assertRaisesRegex(SystemExit, "no domain is called 'casing'"):
            self.alone("casing")


class Asked(unittest.TestCase):
    def missed(self, cells, regions):
        run = fresh("table1-asked")
        (run / "mesh").mkdir()
        listed = [{"tetrahedra": cells / regions, "prisms": 0} for _ in range(regions)]
        (run / "mesh/manifest.json").write_text(json.dumps({"domains": [{"regions": listed}]}))
        with redirect_stdout(io.StringIO()):
            return table1.missed(SimpleNamespace(cells="300k"), "proposed", run, "rotor", REGIONS)

    def test_cells_within_2_percent_and_all_regions(self):
        self.assertEqual(self.missed(305400, REGIONS), [])
        self.assertEqual(self.missed(306600, REGIONS), ["rotor, proposed: cells"])
        self.assertEqual(self.missed(300000, 5), ["rotor, proposed: 5 regions for 6"])


class Small(unittest.TestCase):
    @unittest.skipUnless(CELLS, "CUTWATER_TABLE1_CELLS names no number of cells")
    def test_all_rows(self):
        done = subprocess.run([sys.executable, "-B", SOURCE / "tests/bench/table1.py", "--cells", CELLS,
                               "--regions", str(REGIONS), "--build", BIN.parent, "--algorithms"], text=True,
                              capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for row in ("rotor, serial", f"rotor, proposed, {REGIONS} regions", f"rotor, Chew, {REGIONS} regions",
                    "rotor, Chew, one"):
            self.assertIn(f"\n{row} ", done.stdout)


if __name__ == "__main__":
    unittest.main()
