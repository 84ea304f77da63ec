# SPDX-License-Identifier: AGPL-3.0-or-later
"""Generated pumps, read back from their STEP file as somebody's CAD: by names alone the same domains and patches,
groups of walls, what turns, and passages; with the speeds along the walls, which only the design knows, nearly the same
mesh, through all stages. CUTWATER_READ_BACK names cases of cases/; without it the pump is that of the shared run."""
import os
import re
import shutil
import unittest

from cutwater import CELLS, PAPER, RUN, SOURCE, done, fresh, read_json, record

NAMES = os.environ.get("CUTWATER_READ_BACK", "").split()
ASKED = ("name", "operating_point", "fluid", "walls", "mesh")  # sections that say what is asked of any pump
CELLS_OFF = 0.02  # of those of the generated pump, at most
ANGLES = 0.8  # of those of the generated pump, at least: both meshes have a worst cell of their own


def as_cad(case, model):
    """The text of a case whose pump is pump.step."""
    sections = re.split(r"^(?=[a-z_]+:)", case, flags=re.M)
    domains = "".join(f"    {of['name']}: {{solid: {of['name']}, rotating: {str(of['rotating']).lower()}}}\n"
                      for of in model["domains"])
    return "".join(part for part in sections if part.split(":")[0] in ASKED) + (
        "\ncad:\n  files: [pump.step]\n  domains:\n" + domains)


def speeds(model):
    """The end of that text: the speeds that the first layers follow from."""
    return "  patches:\n" + "".join(
        f"    {of['name']}: {{faces: [{of['name']}], velocity_m_per_s: {of['flow']['speed_m_per_s']!r}}}\n"
        for domain in model["domains"] for of in domain["patches"] if "flow" in of)


def parts(run):
    """What has to be the same whether a design or a file made the pump."""
    model = read_json(run, "geometry/model.json")
    same = ("name", "kind", "group", "size", "turns", "monitored")
    patches = {(domain["name"], domain["rotating"], *(patch.get(key) for key in same))
               for domain in model["domains"] for patch in domain["patches"]}
    return patches, [sorted(interface["patches"]) for interface in model["interfaces"]], model["flow"]["blade_count"]


def meshed(run):
    """Cells, and the least dihedral angle of each domain, deg."""
    domains = record(run, "mesh")["results"]["domains"]
    return sum(d["tetrahedra"] + d["prisms"] for d in domains), {d["name"]: d["least_dihedral_deg"] for d in domains}


class ReadBack(unittest.TestCase):
    def read_back(self, name, case, made):
        run = fresh(f"read-back-{name}")
        read, model = run / "case.yaml", read_json(made, "geometry/model.json")
        read.write_text(as_cad(case.read_text(), model))
        shutil.copy(made / "geometry/pump.step", run)
        done(self, "geometry", run, case=read)
        self.assertEqual(parts(run), parts(made))
        rows = (run / "geometry/faces_sheet.csv").read_text().splitlines()
        faces = (run / "geometry/faces.csv").read_text().splitlines()
        self.assertEqual(len(rows), len(faces))
        read.write_text(read.read_text() + speeds(model))
        done(self, "geometry", run, case=read)
        self.assertEqual(parts(run), parts(made))
        for stage in ("mesh", "export", "report"):
            done(self, stage, run, case=read, cells=CELLS, ranks=2)
        cells, angles = meshed(run)
        made_cells, made_angles = meshed(made)
        print(f"{name}: {cells} cells for {made_cells}, least dihedral angles {angles} for {made_angles}")
        self.assertLess(abs(cells / made_cells - 1), CELLS_OFF)
        for domain, angle in made_angles.items():
            self.assertGreater(angles[domain], ANGLES * angle)
        self.assertTrue((run / "report/index.html").is_file())
        shutil.rmtree(run)

    def test_the_file_makes_the_pump_that_was_written(self):
        if not NAMES:
            self.read_back("paper", PAPER, RUN)
        for name in NAMES:
            with self.subTest(name):
                case, made = SOURCE / f"cases/{name}/case.yaml", fresh(f"made-{name}")
                for stage in ("geometry", "mesh"):
                    done(self, stage, made, case=case, cells=CELLS, ranks=2)
                self.read_back(name, case, made)
                shutil.rmtree(made)


if __name__ == "__main__":
    unittest.main()
