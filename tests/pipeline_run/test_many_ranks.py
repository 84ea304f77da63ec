# SPDX-License-Identifier: AGPL-3.0-or-later
"""The same bytes on six ranks as on one, at a size where a rank changes from one domain to the other between steps."""
import shutil
import unittest

from cutwater import digests, done, with_geometry


class ManyRanks(unittest.TestCase):
    def test_mesh_is_the_same(self):
        expected = None
        for ranks in (1, 6):
            run = with_geometry(f"many-ranks-{ranks}")
            done(self, "mesh", run, cells="3M", ranks=ranks)
            made = digests(run / "mesh")
            self.assertGreater(len(made), 8)
            self.assertEqual(made, expected or made, f"{ranks} ranks against 1")
            expected = made
            shutil.rmtree(run)


if __name__ == "__main__":
    unittest.main()
