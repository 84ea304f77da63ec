# SPDX-License-Identifier: AGPL-3.0-or-later
"""What a stage does where it is not given what it needs: room on the disk, size of a file, memory, or its life. It ends
with one line and an exit status that is not 0, leaves nothing under a final name that is not whole, and called again
without the limit ends in the bytes of a run that had none. CUTWATER_LIMITS tells how many limits of each kind are
tried, spread over what the stage uses, CUTWATER_KILLS how many ranks are killed at random moments (seed 1)."""
import os
import random
import shutil
import signal
import time
import unittest

from cutwater import (command, digests, done, error_lines, execute, fresh, left_behind, on_a_small_disk, ranks_of,
                      stage, start, within)

LIMITS = int(os.environ.get("CUTWATER_LIMITS", 2))
KILLS = int(os.environ.get("CUTWATER_KILLS", 0))
CELLS = 150000  # in one pass, and quicker than fewer
STAGES = ("geometry", "mesh", "export", "report")


def limited(limit, line):
    """The line of a stage under a limit of the shell; of one under mpirun the limit is the rank's."""
    return within(["sh", "-c", f'{limit}; exec "$@"', "sh"], line)


def size_of(path):
    return sum(entry.stat().st_size for entry in path.rglob("*") if entry.is_file())


class Limits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = fresh("limits-whole") / "run"
        for name in STAGES:
            done(cls(), name, cls.whole, cells=CELLS)

    def before(self, name):
        """A run folder in which all stages before this one are done."""
        run = fresh("limits") / "run"
        for earlier in STAGES[:STAGES.index(name)]:
            shutil.copytree(self.whole / earlier, run / earlier, symlinks=True)
        return run

    def ended_well(self, name, run, result, words):
        """A failed stage told why in one line, and left nothing that the next one would take for whole."""
        self.assertGreater(result.returncode, 0, f"{name}: {words}: {result.stdout}")
        self.assertEqual(len(error_lines(result.stdout, name)), 1, f"{name}: {words}: {result.stdout}")
        self.assertFalse((run / name / "record.json").exists(), f"{name}: {words}")
        for path, digest in digests(run / name).items() if name != "mesh" else ():  # whose may be of an earlier pass
            if not path.endswith(".part") and ".part/" not in path:
                self.assertEqual(digest, digests(self.whole / name).get(path), f"{name}: {words}: {path}")

    def goes_on(self, name, run, words):
        done(self, name, run, cells=CELLS)
        if name != "report":  # its page tells times
            self.assertEqual(digests(run / name), digests(self.whole / name), f"{name}: {words}")

    def shares(self):
        return [(k + 0.5) / LIMITS for k in range(LIMITS)]

    def test_files_of_a_limited_size(self):
        for name in STAGES:
            largest = max(path.stat().st_size for path in (self.whole / name).rglob("*") if path.is_file())
            for share in self.shares():
                with self.subTest(stage=name, share=share):
                    run, blocks = self.before(name), int(share * largest / 512)
                    result = execute(limited(f"ulimit -f {blocks}", command(name, run, cells=CELLS)))
                    self.ended_well(name, run, result, f"files of {512 * blocks} bytes")
                    self.goes_on(name, run, f"files of {512 * blocks} bytes")

    def test_a_full_disk(self):
        for name in STAGES:
            for share in self.shares():
                with self.subTest(stage=name, share=share):
                    run = self.before(name)
                    size = max(int(share * size_of(self.whole / name)), 8192)
                    result = on_a_small_disk(self, name, run, size, cells=CELLS)
                    self.ended_well(name, run, result, f"a disk of {size} bytes")
                    self.goes_on(name, run, f"a disk of {size} bytes")

    def test_little_memory(self):
        """A stage that is refused memory says so; none crashes. In 64 MB none works: MPI asks for as much alone, and
        OpenCASCADE's libraries are larger."""
        for name in STAGES:
            refused = 0
            for megabytes in (64, *(int(90 + 300 * share) for share in self.shares())):
                with self.subTest(stage=name, megabytes=megabytes):
                    run = self.before(name)
                    result = execute(limited(f"ulimit -v {1024 * megabytes}", command(name, run, cells=CELLS)))
                    if result.returncode == 0:
                        continue
                    refused += 1
                    self.assertTrue(0 < result.returncode < 128, f"{name}: {megabytes} MB: ended by a signal\n"
                                                                 f"{result.stdout}")
                    told = error_lines(result.stdout, name)
                    if told:  # else a library could not be loaded: then the program has not begun
                        self.assertEqual(len(told), 1, result.stdout)
                        self.assertRegex(told[0], "memory|MPI", f"{megabytes} MB")
            self.assertGreater(refused, 0, name)

    def test_killed_ranks(self):
        chance = random.Random(1)
        for kill in range(KILLS):
            ranks, run = chance.choice((2, 4, 8)), self.before("mesh")
            delay = chance.uniform(0.05, 4)
            with self.subTest(kill=kill, ranks=ranks, delay=delay):
                process = start("mesh", run, cells=CELLS, ranks=ranks)
                time.sleep(delay)
                alive = ranks_of(process.pid)
                if alive:
                    os.kill(chance.choice(alive), signal.SIGKILL)
                process.communicate(timeout=120)
                self.assertEqual(left_behind(alive), [])
                self.assertEqual(stage("mesh", run, cells=CELLS, ranks=2).returncode, 0)
                self.assertEqual(digests(run / "mesh"), digests(self.whole / "mesh"))


if __name__ == "__main__":
    unittest.main()
