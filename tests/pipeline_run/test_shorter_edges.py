# SPDX-License-Identifier: AGPL-3.0-or-later
"""A pump of tests/bench/random_pumps.py whose first mesh is poor, so that it gets shorter edges there: a run that is
killed in such a round goes on with its places, and ends in the bytes of one that nobody killed, on another number of
ranks too."""
import os
import signal
import sys
import unittest

from cutwater import SOURCE, digests, done, fresh, left_behind, ranks_of, record, said_until, start

sys.path.insert(0, str(SOURCE / "tests/bench"))
import random_pumps  # noqa: E402

CELLS = 150000
PUMP = (1, 50, True)  # seed, number, with options: 13 layers, where edges are longer than its passages are wide
ROUND = "made again with shorter edges there"


class ShorterEdges(unittest.TestCase):
    def pump(self, name):
        run = fresh(f"shorter-{name}")
        case = run / "case.yaml"
        case.write_text(random_pumps.case_text("shorter", random_pumps.pump(*PUMP)))
        done(self, "geometry", run, case=case)
        return run, {"case": case, "cells": CELLS}

    def kill_in_a_round(self, run, options):
        mesher = start("mesh", run, ranks=2, **options)
        said_until(self, mesher, ROUND)
        ranks = ranks_of(mesher.pid)
        os.killpg(mesher.pid, signal.SIGKILL)
        mesher.communicate()
        self.assertEqual(left_behind(ranks), [])

    def test_a_killed_run_ends_in_the_same_bytes(self):
        whole, options = self.pump("whole")
        self.assertIn(ROUND, done(self, "mesh", whole, ranks=2, **options).stdout)
        self.assertGreater(record(whole, "mesh")["results"]["retries"], 0)
        killed, options = self.pump("killed")
        self.kill_in_a_round(killed, options)
        told = done(self, "mesh", killed, ranks=1, **options).stdout
        self.assertIn("of an earlier run", told)
        self.assertEqual(digests(killed / "mesh", "[!.]*.h5"), digests(whole / "mesh", "[!.]*.h5"))


if __name__ == "__main__":
    unittest.main()
