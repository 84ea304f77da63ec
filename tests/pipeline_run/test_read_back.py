# SPDX-License-Identifier: AGPL-3.0-or-later
"""The pump of the shared run, read back from its STEP file as somebody's CAD: the same domains and patches by their
names alone, the same six passages, and nearly the same mesh, through all stages."""
import json
import shutil
import unittest

from cutwater import CELLS, PAPER, RUN, done, fresh, record

CAD = """cad:
  files: [pump.step]
  domains:
    rotor:  {solid: 1, rotating: true}
    stator: {solid: 2}

"""


def model(run):
    """Of the model between the stages: what has to be the same whether a design or a file made the pump."""
    read = json.loads((run / "geometry/model.json").read_text())
    patches = {(domain["name"], domain["rotating"], patch["name"], patch["kind"])
               for domain in read["domains"] for patch in domain["patches"]}
    return patches, [sorted(interface["patches"]) for interface in read["interfaces"]], read["flow"]["blade_count"]


class ReadBack(unittest.TestCase):
    def test_the_file_makes_the_pump_that_was_written(self):
        run = fresh("read-back")
        text = PAPER.read_text()
        case = run / "case.yaml"
        case.write_text(text[:text.index("impeller:")] + CAD + text[text.index("walls:"):])
        shutil.copy(RUN / "geometry/pump.step", run)
        done(self, "geometry", run, case=case)
        self.assertEqual(model(run), model(RUN))
        rows = (run / "geometry/faces_sheet.csv").read_text().splitlines()
        faces = (run / "geometry/faces.csv").read_text().splitlines()
        self.assertEqual(len(rows), len(faces))
        for name in ("mesh", "export", "report"):
            done(self, name, run, case=case, cells=CELLS, ranks=2)
        cells = [sum(domain["tetrahedra"] + domain["prisms"]
                     for domain in record(folder, "mesh")["results"]["domains"]) for folder in (run, RUN)]
        self.assertLess(abs(cells[0] / cells[1] - 1), 0.02)
        self.assertTrue((run / "report/index.html").is_file())
        shutil.rmtree(run)


if __name__ == "__main__":
    unittest.main()
