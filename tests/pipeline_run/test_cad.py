# SPDX-License-Identifier: AGPL-3.0-or-later
"""The pumps of tests/cad, drawn with the OpenCASCADE kernel of gmsh as a designer would draw them: each from its STEP
file through all stages to the start of a flow. CUTWATER_DRAWINGS names them, CUTWATER_DRAWING_CELLS the size. That of
cases/own-cad is one."""
import os
import re
import sys
import unittest

from cutwater import SOURCE, done, execute, fresh, pass_over_without_gmsh, read_json, record, said
from judges import CHECK_MESH, continuity_errors, failed_checks, flow_begins, interfaces_are_covered

DRAWINGS = os.environ["CUTWATER_DRAWINGS"].split()
CELLS = int(os.environ["CUTWATER_DRAWING_CELLS"])
ITERATIONS = 20
# Of a drawing: rotating and standing domains, and pairs that touch.
ROTATING = {"rotor"}
DOMAINS = {"diffuser": ["rotor", "diffuser", "casing"], "side_chamber": ["rotor", "chamber", "casing"]}
PAIRS = {"diffuser": 2, "side_chamber": 2}
# Equal passages, of which one is meshed; 1: fillets differ.
PASSAGES = {"volute": 6, "diffuser": 7, "semi_open": 6, "side_chamber": 6, "fillets": 1, "double_suction": 6,
            "own_cad": 6}
# Of a face of an interface, what the other side covers at least: facets of a ring gap as wide as an edge part more.
COVERED = {"side_chamber": 0.95}
# What checkMesh may say of sound cells: thin prisms; layers in wedges; layers in gaps narrower than the cells.
ALLOWED = "small determinant|Max skewness|small interpolation weight|small volume ratio"
MOST_SKEW = 10
MOST_BARE, MOST_TAPERED = 0.001, 0.01  # of the wall faces of a domain: without layers, and where these taper
# Its neck is wider than the wheel: walls go on from the interface, and no column stands beside it.
FLUSH, FLUSH_TAPERED = "volute", 0.25


class Drawn(unittest.TestCase):
    def through(self, name):
        run = fresh(f"cad-{name}")
        said(self, [sys.executable, SOURCE / "tests/cad" / f"{name}.py", run])
        for stage in ("geometry", "mesh", "export", "report"):
            done(self, stage, run, case=run / "case.yaml", cells=CELLS, ranks=2)
        return run

    def meshed(self, name, run):
        model = read_json(run, "geometry/model.json")
        self.assertEqual([domain["name"] for domain in model["domains"]], DOMAINS.get(name, ["rotor", "stator"]))
        self.assertEqual({domain["name"] for domain in model["domains"] if domain["rotating"]}, ROTATING)
        kinds = [patch["kind"] for domain in model["domains"] for patch in domain["patches"]]
        self.assertEqual((kinds.count("inlet"), kinds.count("outlet")), (1, 1))
        domains = record(run, "mesh")["results"]["domains"]
        cells = record(run, "mesh")["results"]["cells"]
        self.assertLess(abs(cells / CELLS - 1), 0.02)
        self.assertEqual(domains[0]["equal_passages"], PASSAGES[name])
        for domain in domains:
            self.assertGreater(domain["prism_least_scaled_jacobian"], 0)
            self.assertGreater(domain["least_dihedral_deg"], 0)
            for wall in domain["layer_coverage"]:
                self.assertGreater(wall["wall_faces"], 0, wall["patch"])
        pairs = record(run, "export")["results"]["interfaces"]
        self.assertEqual(len(pairs), PAIRS.get(name, 1))
        for pair in pairs:
            self.assertAlmostEqual(pair["areas_m2"][0] / pair["areas_m2"][1], 1, delta=0.01, msg=pair)

    def checked(self, name, case):
        told = execute(CHECK_MESH, case).stdout
        for line in failed_checks(told):
            self.assertRegex(line, ALLOWED)
        self.assertLess(float(re.search(r"Max skewness = ([\d.]+)", told)[1]), MOST_SKEW)
        interfaces_are_covered(self, told, COVERED.get(name, 0.98))

    def solved(self, case):
        told = flow_begins(self, case, ITERATIONS)
        second = "omega" if "Solving for omega" in told else "epsilon"  # by the model of turbulence
        for field in ("Ux", "Uy", "Uz", "p", "k", second):
            values = [float(v) for v in re.findall(rf"Solving for {field}, Initial residual = (\S+),", told)]
            self.assertLess(values[-1], 0.3 * max(values), field)
        error = continuity_errors(self, told)
        self.assertEqual(len(error), ITERATIONS)
        self.assertLess(error[-1], error[0])

    def covered(self, name, run):
        """Layers stand on each face that the record counts, but where they taper to nothing: of that it warns."""
        made = record(run, "mesh")
        for domain in made["results"]["domains"]:
            walls = domain["layer_coverage"]
            faces, without, tapered = (sum(wall[key] for wall in walls) for key in (
                "wall_faces", "without_layers_faces", "thinned_by_taper_faces"))
            layered = domain["prisms"] / domain["layers"]
            self.assertLessEqual(layered, faces - without, domain["name"])
            self.assertGreaterEqual(layered, faces - tapered, domain["name"])
            self.assertLessEqual(without, MOST_BARE * faces, domain["name"])
            self.assertLessEqual(tapered, (FLUSH_TAPERED if name == FLUSH else MOST_TAPERED) * faces, domain["name"])
        remedies = re.findall(r"layers taper to nothing at .*; (\w+) ", "\n".join(made["warnings"]))
        self.assertEqual([remedy for remedy in remedies if remedy == "let"], ["let"] if name == FLUSH else [])

    def test_each_is_meshed_and_its_flow_begins(self):
        for name in DRAWINGS:
            with self.subTest(name):
                run = self.through(name)
                self.meshed(name, run)
                self.covered(name, run)
                self.checked(name, run / "export/openfoam")
                self.solved(run / "export/openfoam")


if __name__ == "__main__":
    pass_over_without_gmsh()
    unittest.main()
