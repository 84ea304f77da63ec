# SPDX-License-Identifier: AGPL-3.0-or-later
"""pump.cgns before CGNS's own cgnscheck and cgnslist."""
import unittest

from cutwater import RUN, said
from judges import cgns_is_sound

PUMP = RUN / "export/pump.cgns"


class Cgns(unittest.TestCase):
    def test_cgnscheck_has_nothing_to_say(self):
        cgns_is_sound(self, PUMP, 2)

    def test_cgnslist_shows_both_zones(self):
        listing = said(self, ["cgnslist", PUMP])
        for name in ("rotor", "stator", "rotor_interface", "stator_interface", "ZoneGridConnectivity"):
            self.assertIn(name, listing)


if __name__ == "__main__":
    unittest.main()
