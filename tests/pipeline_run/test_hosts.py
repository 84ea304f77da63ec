# SPDX-License-Identifier: AGPL-3.0-or-later
"""Mesher and exporter over three hosts with addresses of their own, by mpirun's defaults: the bytes of one host. Ends
with 77, skipped, where such hosts cannot be made."""
import sys
import unittest
from pathlib import Path

from cutwater import ENVIRONMENT, command, digests, done, execute, fresh

COUNT, CELLS = 3, 40000
HOSTS = Path(__file__).with_name("hosts.sh")
TOP = fresh("hosts")


def on_hosts(*line):
    return execute([HOSTS, COUNT, TOP, "mpirun", "-q", "--hostfile", TOP / "hosts", *line], timeout=1000)


class Hosts(unittest.TestCase):
    def test_the_ranks_are_on_hosts_of_their_own(self):
        self.assertEqual(sorted(on_hosts("hostname").stdout.split()), [f"cutwater{k + 1}" for k in range(COUNT)])

    def test_the_same_bytes(self):
        for stage in ("geometry", "mesh", "export"):
            done(self, stage, TOP / "one", cells=CELLS, ranks=2)
        done(self, "geometry", TOP / "several", cells=CELLS)
        for stage in ("mesh", "export"):
            line = command(stage, TOP / "several", cells=CELLS)
            result = on_hosts(*line[line.index("-n") + 2:])
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertEqual(digests(TOP / "several" / stage), digests(TOP / "one" / stage))


if __name__ == "__main__":
    ENVIRONMENT["OMPI_MCA_plm_rsh_agent"] = str(TOP / "agent")
    if execute([HOSTS, COUNT, TOP, "true"]).returncode == 77:
        print("no namespaces: skipped")
        sys.exit(77)
    unittest.main()
