# SPDX-License-Identifier: AGPL-3.0-or-later
"""pump.cgns before CGNS's own cgnscheck, and before gmsh, which reads it with its own code."""
import unittest

from cutwater import RUN, execute, record
from judges import cgns_is_sound

PUMP = RUN / "export/pump.cgns"


class Cgns(unittest.TestCase):
    def test_cgnscheck_has_nothing_to_say(self):
        cgns_is_sound(self, PUMP, 2)

    def test_the_file_is_plain_hdf5_with_two_zones(self):
        listing = execute(["cgnslist", PUMP]).stdout
        sizes = [domain["points"] for domain in record(RUN, "mesh")["results"]["domains"]]
        self.assertEqual(len(sizes), 2)
        for name in ("rotor", "stator", "rotor_interface", "stator_interface", "ZoneGridConnectivity"):
            self.assertIn(name, listing)


if __name__ == "__main__":
    unittest.main()
