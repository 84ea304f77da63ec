# SPDX-License-Identifier: AGPL-3.0-or-later
"""No call of MPI with a count that grows with the mesh: every stage goes through with messages of some thousand bytes,
and ends where it hands MPI more at once (tests/message_limit.c); and the files are the same."""
import os
import shutil
import unittest

from cutwater import CELLS, RUN, command, digests, said, with_geometry, within

LIMIT = os.environ["CUTWATER_MESSAGE_LIMIT"]


class Messages(unittest.TestCase):
    def limited(self, stage, run):
        said(self, within(["env", f"LD_PRELOAD={LIMIT}"], command(stage, run, cells=CELLS, ranks=3)))

    def test_every_stage_with_small_messages(self):
        run = with_geometry("messages")
        for stage in ("mesh", "export"):
            self.limited(stage, run)
            self.assertEqual(digests(run / stage), digests(RUN / stage), stage)
        self.limited("report", run)
        shutil.rmtree(run)


if __name__ == "__main__":
    unittest.main()
