# SPDX-License-Identifier: AGPL-3.0-or-later
"""Chew's algorithm on the regions of a small rotor (tests/measure/chew.c): on 1, 2 and 3 ranks the same files, and the
same figures but for times and what is sent between ranks. The program ends in an error where a region has a fault or
the two sides of an interface are not the same triangles."""
import json
import shutil
import unittest

from cutwater import BIN, changed_case, digests, done, fresh, said

CELLS, REGIONS = 200000, 4
OF_RANKS = ("interface_seconds", "refine_seconds", "fill_seconds", "wall_seconds", "sent_messages", "sent_bytes")


class Chew(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = fresh("chew")
        keys = f"\nmesh:\n  periodic_impeller: false\n  least_regions: {REGIONS}\n"
        cls.case = changed_case(cls.folder, ("\nmesh:\n", keys))
        cls.made = cls.folder / "first"
        cls.made.mkdir()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def chew(self, ranks):
        """Figures and digests of the regions; the mesher's own are taken up where they are there."""
        run = self.made
        said(self, ["mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n", ranks, BIN / "chew", "--case",
                    self.case, "--run", run, "--cells", CELLS])
        return json.loads((run / "chew/rotor.json").read_text()), digests(run / "chew", "*.h5")

    def test_any_number_of_ranks_makes_the_same(self):
        done(self, "geometry", self.made, case=self.case)
        first, files = self.chew(1)
        chew, rule = first["chew"], first["rule"]
        self.assertEqual(len(files), REGIONS)
        self.assertEqual((chew["sent_messages"], rule["sent_messages"]), (0, 0))
        self.assertGreater(chew["inserted"], 0)
        self.assertGreater(chew["rounds"], 1)
        self.assertEqual(chew["messages"] % chew["rounds"], 0)  # one each way in each round
        self.assertAlmostEqual(chew["tetrahedra"] / rule["tetrahedra"], 1, delta=0.3)
        for ranks in (2, 3):
            again, others = self.chew(ranks)
            self.assertEqual(others, files)
            self.assertGreater(again["chew"]["sent_messages"], 0)
            for way in ("rule", "chew"):
                for key in set(chew) - set(OF_RANKS):
                    self.assertEqual(again[way][key], first[way][key], (way, key))


if __name__ == "__main__":
    unittest.main()
