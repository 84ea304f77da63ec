# SPDX-License-Identifier: AGPL-3.0-or-later
"""pump.cgns before cgnscheck, cgnslist, VTK's reader and code_saturne's preprocessor: as the shared run has it, with
64-bit integers, and with the vendor profile."""
import re
import unittest

import vtk_mesh
from cutwater import CELLS, PAPER, RUN, done, fresh, record, said
from judges import cgns_is_sound

PUMP = RUN / "export/pump.cgns"
RESULTS = record(RUN, "export")["results"]
ZONES = {name: RESULTS[name] for name in ("rotor", "stator")}
PATCHES = [patch for patch in RESULTS["patches"] if patch["triangles"] + patch["quads"]]
PREPROCESSOR = "/usr/lib/code_saturne/cs_preprocess"
# VTK cuts the quads of neighbouring cells along diagonals that need not agree.
SIZE_TOLERANCE = 2e-3


class Cgns(unittest.TestCase):
    def test_cgnslist_shows_both_zones(self):
        listing = said(self, ["cgnslist", PUMP])
        for name in ("rotor", "stator", "rotor_interface", "stator_interface", "ZoneGridConnectivity"):
            self.assertIn(name, listing)

    def test_the_standard_is_kept(self):
        self.readers_agree(PUMP, prisms_are_vtks=False)

    def test_readers_take_integers_of_64_bits(self):
        self.readers_agree(self.exported("{integers: 64}"), prisms_are_vtks=False)

    def test_the_vendor_profile_has_the_prisms_of_vtk(self):
        self.readers_agree(self.exported("{profile: vendor}"), prisms_are_vtks=True)

    def exported(self, keys):
        """pump.cgns of the shared run's mesh, with these keys."""
        run = fresh("cgns_" + "_".join(re.findall(r"\w+", keys)))
        for stage in ("geometry", "mesh"):
            (run / stage).symlink_to(RUN / stage)
        case = run / "case.yaml"
        case.write_text(f"{PAPER.read_text()}\nexport: {{formats: cgns}}\ncgns: {keys}\n")
        done(self, "export", run, case=case, cells=CELLS)
        return run / "export/pump.cgns"

    def readers_agree(self, path, prisms_are_vtks):
        cgns_is_sound(self, path, 2)
        shown = vtk_mesh.read(path)
        self.assertEqual(shown.keys(), {f"pump/{name.upper()}/Internal" for name in ZONES} |
                         {f"pump/{patch['domain'].upper()}/Patches/{patch['name']}" for patch in PATCHES})
        for name, zone in ZONES.items():
            self.vtk_shows_zone(shown[f"pump/{name.upper()}/Internal"], zone, 1 if prisms_are_vtks else -1)
        for patch in PATCHES:
            self.vtk_shows_patch(shown[f"pump/{patch['domain'].upper()}/Patches/{patch['name']}"], patch)
        turned = sum(zone["prisms"] for zone in ZONES.values()) if prisms_are_vtks else 0
        self.assertEqual(self.turned_by_code_saturne(path), [str(turned)] if turned else [])

    def vtk_shows_zone(self, shown, zone, sign_of_prisms):
        tetrahedra, prisms = shown[vtk_mesh.TETRAHEDRON], shown[vtk_mesh.WEDGE]
        self.assertEqual((len(tetrahedra), len(prisms)), (zone["tetrahedra"], zone["prisms"]))
        volumes = tetrahedra + [sign_of_prisms * volume for volume in prisms]
        self.assertGreater(min(volumes), 0)
        self.assertAlmostEqual(sum(volumes) / zone["volume_m3"], 1, delta=SIZE_TOLERANCE)

    def vtk_shows_patch(self, shown, patch):
        triangles, quads = shown[vtk_mesh.TRIANGLE], shown[vtk_mesh.QUAD]
        self.assertEqual((len(triangles), len(quads)), (patch["triangles"], patch["quads"]), patch["name"])
        self.assertAlmostEqual(sum(triangles + quads) / patch["area_m2"], 1, delta=SIZE_TOLERANCE, msg=patch["name"])

    def turned_by_code_saturne(self, path):
        """Numbers of cells, by type, that code_saturne finds inside out by the standard, of a file that it has read."""
        told = said(self, [PREPROCESSOR, "--reorient", "--grp-cel", "zone", "--out", fresh("cgns_read") / "mesh", path])
        counts = {name: int(count) for name, count in
                  re.findall(r'Group "(\w+)"\n  Number of (?:cells|boundary faces) +: +(\d+)', told)}
        self.assertEqual(counts, {name.upper(): zone["tetrahedra"] + zone["pyramids"] + zone["prisms"]
                                  for name, zone in ZONES.items()} |
                         {patch["name"]: patch["triangles"] + patch["quads"] for patch in PATCHES})
        return re.findall(r"(\d+) elements of type \w+ had to be re-oriented", told)


if __name__ == "__main__":
    unittest.main()
