# SPDX-License-Identifier: AGPL-3.0-or-later
"""Similar pumps: all lengths times s, the speed over it, the flow rate times its square, the viscosity times s, so that
every dimensionless number is the same. The mesh is the same for any s, coordinates s times each other: to the last bit
where s is a power of two, else but for their rounding. CUTWATER_SIMILAR_EVERY=n takes every n-th power and factor."""
import json
import os
import shutil
import unittest

from cutwater import BIN, done, fresh, read_json, record, said, seal

CELLS = int(os.environ["CUTWATER_SIMILAR_CELLS"])
ASKED_OFF = 0.02  # of the cells
DIHEDRAL_GOOD = 12  # degrees
EVERY = int(os.environ.get("CUTWATER_SIMILAR_EVERY", 1))
POWERS = (-3, -2, -1, 1, 2, 3)[::EVERY]
SOLID_POWERS = (-3, 3)[::EVERY]
FACTORS = (0.075, 0.1, 3, 10, 20, 25)[::EVERY]  # D2 from 15 mm to 5 m

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


class Similar(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.one = similar(1, "1")
        cls().meshed(cls.one)

    def meshed(self, run, stages=("geometry", "mesh")):
        for stage in stages:
            done(self, stage, run, case=run / "case.yaml", cells=CELLS, ranks=2)

    def expect_same(self, run, factor):
        said(self, [BIN / "similar_meshes", self.one, run, factor, "rotor", "stator"])

    def test_powers_of_two_give_the_same_bits(self):
        for power in POWERS:
            with self.subTest(power=power):
                run = similar(2.0 ** power, f"2^{power}")
                self.meshed(run)
                self.expect_same(run, 2.0 ** power)
                shutil.rmtree(run)

    def test_so_do_solids_in_another_unit(self):
        """The B-rep itself 8 times as large or small, in the unit of the pump that it is made from."""
        for power in SOLID_POWERS:
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
                self.expect_same(run, 2.0 ** power)
                shutil.rmtree(run)

    def test_any_size_gives_the_same_mesh_but_for_rounding(self):
        for factor in FACTORS:
            with self.subTest(factor=factor):
                run = similar(factor, f"{factor}")
                self.meshed(run, ["geometry", "mesh", "export"])
                self.expect_same(run, factor)
                shutil.rmtree(run)

    def test_the_mesh_is_good(self):
        results = record(self.one, "mesh")["results"]
        self.assertLess(abs(results["cells"] / CELLS - 1), ASKED_OFF)
        self.assertGreater(min(domain["least_dihedral_deg"] for domain in results["domains"]), DIHEDRAL_GOOD)


if __name__ == "__main__":
    unittest.main()
