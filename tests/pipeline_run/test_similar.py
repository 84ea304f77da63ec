# SPDX-License-Identifier: AGPL-3.0-or-later
"""Similar pumps: all lengths times s, the speed over it, the flow rate times its square, the viscosity times s, so that
every dimensionless number is the same. Where s is a power of two the mesh is the same to the last bit; for any s it is
the same but for what rounding does to it."""
import json
import os
import shutil
import statistics
import unittest

from cutwater import BIN, done, fresh, read_json, record, said, seal

CELLS = int(os.environ["CUTWATER_SIMILAR_CELLS"])
# How far rounding may move the figures of a pump from the median of all. It moves small meshes more: below half a
# million cells it may choose another plane. The least angle is that of a single tetrahedron: in regions of 2000 the
# search for it ends wherever chance leads it, above what is called good.
SMALL = CELLS < 500000
ASKED_OFF = 0.02  # from the asked count, as of any mesh
COUNT_OFF = 2 * ASKED_OFF if SMALL else 0.005
MET_OFF = 0.002
ASPECT_OFF = 0.03 if SMALL else 0.02
DIHEDRAL_OFF = 3.5 if SMALL else 2.5  # degrees
DIHEDRAL_GOOD = 12
POWERS = (-3, -2, -1, 1, 2, 3)
FACTORS = (0.075, 0.1, 3, 10, 20, 25)  # D2 from 15 mm to 5 m

LENGTHS = {  # mm; all of them, so that no correlation and no series of standard sizes has a say
    "impeller": {"inlet_diameter_mm": 74, "outlet_diameter_mm": 200, "outlet_width_mm": 8, "hub_diameter_mm": 24,
                 "hub_nut_length_mm": 14, "hub_nut_flat_diameter_mm": 7, "axial_length_mm": 33.5,
                 "leading_edge_radius_hub_mm": 39, "leading_edge_radius_shroud_mm": 47,
                 "leading_edge_thickness_mm": 2.8, "blade_thickness_mm": 4, "trailing_edge_thickness_mm": 2,
                 "trailing_edge_bevel_mm": 1.25, "suction_pipe_length_mm": 55},
    "volute": {"base_diameter_mm": 210, "inlet_width_mm": 16.5, "tongue_radius_mm": 1.75, "tongue_gap_mm": 7,
               "diffuser_length_mm": 105, "outlet_diameter_mm": 50, "discharge_pipe_length_mm": 100}}
NUMBERS = {
    "impeller": {"priority": "wrap", "blade_count": 6, "wrap_angle_deg": 71, "inlet_blade_angle_deg": 31,
                 "hub_pole_radial": 2.369, "shroud_pole_axial": 0.067, "shroud_pole_radial": 0.8},
    "volute": {"side_wall_angle_deg": 20}}


def similar(s, name):
    """A run folder with the case of the pump s times as large, and its geometry."""
    run = fresh(f"similar-{CELLS}/{name}")
    tables = {"operating_point": {"flow_rate_m3_per_h": 25 * s * s, "head_m": 10, "speed_rpm": 1450 / s},
              "fluid": {"kinematic_viscosity_m2_per_s": 1.004e-6 * s}}
    for table in ("impeller", "volute"):
        tables[table] = {**NUMBERS[table], **{key: mm * s for key, mm in LENGTHS[table].items()}}
    tables["volute"]["throat_area_mm2"] = 890 * s * s
    lines = ["name: similar"]
    for table, keys in tables.items():
        lines += [f"{table}:"] + [f"  {key}: {value}" for key, value in keys.items()]
    (run / "case.yaml").write_text("\n".join(lines) + "\n")
    return run


def figures(run):
    results = record(run, "mesh")["results"]
    domains = results["domains"]
    layers = [patch for domain in domains for patch in domain["layer_coverage"]]
    faces = sum(patch["wall_faces"] for patch in layers)
    return {"cells": [results["cells"]], "dihedral": [domain["least_dihedral_deg"] for domain in domains],
            "aspect": [domain["tetrahedron_aspect_mean"] for domain in domains],
            "met": [sum(patch["first_height_met_faces"] for patch in layers) / faces]}


class Similar(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.one = similar(1, "1")
        cls().meshed(cls.one)

    def meshed(self, run, stages=("geometry", "mesh")):
        for stage in stages:
            done(self, stage, run, case=run / "case.yaml", cells=CELLS, ranks=2)

    def expect_same(self, run, power):
        said(self, [BIN / "similar_meshes", self.one, run, power, "rotor", "stator"])

    def test_powers_of_two_give_the_same_bits(self):
        for power in POWERS:
            with self.subTest(power=power):
                run = similar(2.0 ** power, f"2^{power}")
                self.meshed(run)
                self.expect_same(run, power)
                shutil.rmtree(run)

    def test_so_do_solids_in_another_unit(self):
        """The B-rep itself 8 times as large or small, in the unit of the pump that it is made from."""
        for power in (-3, 3):
            with self.subTest(power=power):
                run = similar(2.0 ** power, f"solid-2^{power}")
                self.meshed(run, ["geometry"])
                model, one = (read_json(folder, "geometry/model.json") for folder in (run, self.one))
                (run / "geometry/model.json").write_text(json.dumps({**model, "unit_m": one["unit_m"]}))
                for domain in ("rotor", "stator"):
                    solid = f"geometry/{domain}.brep"
                    said(self, [BIN / "scaled_solid", self.one / solid, run / solid, power])
                seal(self, run / "geometry")
                self.meshed(run, ["mesh"])
                self.expect_same(run, power)
                shutil.rmtree(run)

    def test_any_size_gives_the_same_mesh_but_for_rounding(self):
        got = {1: figures(self.one)}
        for factor in FACTORS:
            run = similar(factor, f"{factor}")
            self.meshed(run, ["geometry", "mesh", "export"])
            got[factor] = figures(run)
            shutil.rmtree(run)
        usual = {key: [statistics.median(column) for column in zip(*(one[key] for one in got.values()))]
                 for key in got[1]}
        for factor, one in got.items():
            with self.subTest(factor=factor):
                off = {key: [abs(here - there) for here, there in zip(one[key], usual[key])] for key in one}
                self.assertLess(off["cells"][0], COUNT_OFF * usual["cells"][0])
                self.assertLess(abs(one["cells"][0] / CELLS - 1), ASKED_OFF)
                self.assertLess(off["met"][0], MET_OFF)
                for here, there in zip(off["aspect"], usual["aspect"]):
                    self.assertLess(here, ASPECT_OFF * there)
                self.assertGreater(min(one["dihedral"]), DIHEDRAL_GOOD)
                self.assertLess(max(off["dihedral"]), DIHEDRAL_OFF)


if __name__ == "__main__":
    unittest.main()
