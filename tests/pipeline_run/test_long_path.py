# SPDX-License-Identifier: AGPL-3.0-or-later
"""A run folder with a path of 900 characters: all stages run in it on two ranks, and the export writes the bytes that
it writes where the same run has a short path."""
import unittest

from cutwater import digests, done, fresh

CELLS = 150000  # in one pass, and quicker than fewer
LENGTH = 900


class LongPath(unittest.TestCase):
    def test_the_same_bytes(self):
        top = fresh("long-path")
        long = top
        while len(str(long)) < LENGTH:
            long /= "a" * min(200, LENGTH - len(str(long)))
        for stage in ("geometry", "mesh", "export", "report"):
            done(self, stage, long, cells=CELLS, ranks=2)
        written = digests(long / "export")
        self.assertIn("pump.cgns", written)
        short = long.rename(top / "short")
        done(self, "export", short, cells=CELLS, ranks=2)
        self.assertEqual(digests(short / "export"), written)


if __name__ == "__main__":
    unittest.main()
