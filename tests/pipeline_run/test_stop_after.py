# SPDX-License-Identifier: AGPL-3.0-or-later
"""A mesher that ends after a stage: what it writes of each product, beside the finished mesh of the shared run."""
import re
import shutil
import unittest

from cutwater import CELLS, RUN, SOURCE, command, error_lines, execute, record, said, surface, with_geometry


def open_edges(corners):
    """Edges that are in one triangle alone."""
    once = set()
    for a, b, c in corners:
        for edge in ((a, b), (b, c), (c, a)):
            once ^= {tuple(sorted(edge))}
    return once


class StopAfter(unittest.TestCase):
    def stopped(self, stage):
        run = with_geometry(f"stop-{stage}")
        told = said(self, command("mesh", run, cells=CELLS, ranks=2) + ["--stop-after", stage, "--vtk"])
        self.assertIn(f"ended after the stage {stage}, as asked", told)
        self.assertEqual([path.name for path in (run / "mesh").glob("*.json") if path.name != "pass.json"], [])
        self.assertEqual(list((run / "mesh").glob("*.h5")), [])
        return run

    def test_each_stage_shows_what_it_made(self):
        whole = record(RUN, "mesh")["results"]
        self.assertEqual((whole["passes"], whole["retries"]), (1, 0))  # else it is another attempt that is stopped
        for stage in ("surface", "layers", "interfaces"):
            run = self.stopped(stage)
            for domain in whole["domains"]:
                places, corners = surface(run / f"mesh/{domain['name']}-{stage}.vtk")
                self.assertLess(max(map(max, corners)), len(places))
                if stage == "interfaces":
                    continue
                # One column of prisms over each; the walls end where open patches begin.
                self.assertEqual(len(corners) * domain["layers"], domain["prisms"])
                self.assertGreater(len(open_edges(corners)), 0)
            shutil.rmtree(run)

    def test_stages_before_the_surface(self):
        """Wanted edge lengths are finite, the surface lies in all regions, and curves end at their corners."""
        whole = record(RUN, "mesh")["results"]
        for stage, field in (("size", "size_m"), ("decomposition", "region"), ("curves", "wall")):
            run = self.stopped(stage)
            for domain in whole["domains"]:
                text = (run / f"mesh/{domain['name']}-{stage}.vtk").read_text()
                values = text[text.index(f"SCALARS {field} "):].split("LOOKUP_TABLE default\n")[1].split("SCALARS")[0]
                values = [float(value) for value in values.split()]
                self.assertEqual(len(values), int(re.search(r"CELL_DATA (\d+)", text)[1]))
                if stage == "size":
                    self.assertGreater(min(values), 0)
                    self.assertLess(max(values), 0.1)
                elif stage == "decomposition":
                    self.assertEqual(set(values), set(range(domain["regions"])))
                else:
                    self.assertEqual(set(values), {0, 1})
            shutil.rmtree(run)

    def test_the_record_calls_stages_as_the_documents_do(self):
        text = (SOURCE / "docs/mesher.md").read_text()
        others = re.search(r"record have other names for two stages:([^.]*)\.", text)[1]
        names = re.findall(r"^\| ([a-z ]+) \|", text, re.M) + re.findall(r"\*([a-z ]+)\*", others)
        for step in record(RUN, "mesh")["steps"]:
            self.assertIn(step["name"], names)

    def test_another_stage_is_refused(self):
        run = with_geometry("stop-unknown")
        result = execute(command("mesh", run, cells=CELLS) + ["--stop-after", "fill"])
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertEqual(error_lines(result.stdout, "mesh"), [
            "cutwater-mesh: error: --stop-after: fill is no stage; allowed: size, decomposition, curves, surface, "
            "layers, interfaces"])
        shutil.rmtree(run)


if __name__ == "__main__":
    unittest.main()
