# SPDX-License-Identifier: AGPL-3.0-or-later
"""The same bytes where the ranks of a host share no memory, and one line that says so: where the system allows no
segment as large, and where each rank has segments of its own, whose numbers others have for theirs. Ends with 77,
skipped, where no such IPC namespaces can be made."""
import sys
import unittest

from cutwater import CELLS, RUN, command, digests, execute, with_geometry, within

RANKS = 3
APART = ["unshare", "--ipc", "sh", "-c"]
SMALL = [*APART, 'echo 4096 > /proc/sys/kernel/shmmax && exec "$@"', "sh"]
# Segments of others in the places of those that rank 0 makes.
OTHERS = [*APART, 'test "$OMPI_COMM_WORLD_RANK$PMI_RANK" = 0 || for i in 1 2 3 4 5 6 7 8; '
          'do ipcmk -M 4096 > /dev/null; done; exec "$@"', "sh"]


class SharedMemory(unittest.TestCase):
    def expect_copies(self, name, before, inside):
        run = with_geometry(f"shared-memory-{name}")
        result = execute([*before, *within(inside, command("mesh", run, cells=CELLS, ranks=RANKS))])
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(result.stdout.count("the system shares no memory between the ranks"), 1, result.stdout)
        self.assertEqual(digests(run / "mesh"), digests(RUN / "mesh"))

    def test_segments_too_small(self):
        self.expect_copies("small", SMALL, [])

    def test_ranks_with_segments_of_their_own(self):
        self.expect_copies("apart", [], OTHERS)


if __name__ == "__main__":
    if execute([*SMALL, "true"]).returncode:
        print("no IPC namespaces: skipped")
        sys.exit(77)
    unittest.main()
