# SPDX-License-Identifier: AGPL-3.0-or-later
"""pump.cgns before CGNS's own cgnscheck, and before gmsh, which reads it with its own code."""
import re
import unittest

from cutwater import RUN, execute, record

PUMP = RUN / "export/pump.cgns"


class Cgns(unittest.TestCase):
    def test_cgnscheck_has_nothing_to_say(self):
        result = execute(["cgnscheck", "-v", PUMP])
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("checking complete", result.stdout)
        complaints = [line for line in result.stdout.splitlines() if re.search("ERROR|WARNING", line)]
        self.assertEqual(complaints, [])
        # It has read both zones.
        self.assertEqual(len(re.findall(r'^reading zone "?\w+', result.stdout, re.M)), 2, result.stdout)

    def test_the_file_is_plain_hdf5_with_two_zones(self):
        listing = execute(["cgnslist", PUMP]).stdout
        sizes = [domain["points"] for domain in record(RUN, "mesh")["results"]["domains"]]
        self.assertEqual(len(sizes), 2)
        for name in ("rotor", "stator", "rotor_interface", "stator_interface", "ZoneGridConnectivity"):
            self.assertIn(name, listing)


if __name__ == "__main__":
    unittest.main()
