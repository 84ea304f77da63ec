# SPDX-License-Identifier: AGPL-3.0-or-later
"""Random damage to the files of a run, through the real programs. Either the stage ends in the bytes of an undamaged
run, or in one line and an exit status that is not 0; never in another mesh.

CUTWATER_DAMAGES says how many; each has the seed that it is named by."""
import os
import random
import shutil
import unittest

from cutwater import PAPER, WORK, changed_case, digests, done, error_lines, fresh, record, regions, seal, stage

CELLS = 150000  # in one pass, and quicker than fewer
DAMAGES = int(os.environ.get("CUTWATER_DAMAGES", 60))
WHOLE = WORK / "damage-whole"  # an undamaged run
OTHER = WORK / "damage-other"  # one of a pump that differs a little
# The stages that read what lies in a folder.
READERS = {"geometry": ("mesh", "export", "report"), "mesh": ("export", "report"), "export": ("report",)}


def make_run(folder, case):
    for name, options in (("geometry", {}), ("mesh", {"cells": CELLS, "ranks": 2}), ("export", {"ranks": 2})):
        done(unittest.TestCase(), name, folder, case=case, **options)


def flip(data, dice, other):
    place = dice.randrange(len(data))
    data[place] ^= 1 << dice.randrange(8)


def zero(data, dice, other):
    size = dice.choice((64, 512, 4096))
    while True:
        place = dice.randrange(len(data))
        if any(data[place:place + size]):
            break
    data[place:place + size] = bytes(len(data[place:place + size]))


def cut(data, dice, other):
    del data[dice.randrange(len(data)):]


def grow(data, dice, other):
    data += dice.randbytes(dice.randrange(1, 5000))


def shuffle(data, dice, other):
    """Two pieces change their places."""
    size = min(256, len(data) // 4)
    while True:
        one, two = sorted(dice.sample(range(0, len(data) - size), 2))
        if two - one >= size and data[one:one + size] != data[two:two + size]:
            break
    data[one:one + size], data[two:two + size] = data[two:two + size], data[one:one + size]


def swap(data, dice, other):
    """The file of another run."""
    data[:] = other


def move(data, dice, other):
    """A number of eight bytes becomes another one of about its size, as a point does that is moved."""
    place = 8 * dice.randrange(len(data) // 8)
    data[place:place + 2] = bytes((byte + dice.randrange(1, 256)) % 256 for byte in data[place:place + 2])


DAMAGE = (flip, zero, cut, grow, shuffle, swap, move)


def damage(path, dice, other):
    """Damages a file in a random way; says which."""
    before = path.read_bytes()
    while True:
        how = dice.choice(DAMAGE)
        data = bytearray(before)
        how(data, dice, other.read_bytes())
        if data != before:
            break
    path.unlink()  # it may be a link to the undamaged one
    path.write_bytes(data)
    return f"{path.name}: {how.__name__}"


def copy_run(name):
    """A run of links to the files of the undamaged one: no stage writes into a file that is there."""
    run = fresh(name)
    shutil.copytree(WHOLE, run, copy_function=os.link, dirs_exist_ok=True)
    return run


class Damage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        other = changed_case(fresh("damage-cases"), ("layer_count: 5", "layer_count: 4"),
                             ("outlet_width_mm: 8", "outlet_width_mm: 8.5"))
        make_run(fresh(WHOLE.name), PAPER)
        make_run(fresh(OTHER.name), other)
        cls.mesh = digests(WHOLE / "mesh")
        cls.export = digests(WHOLE / "export")

    def one_line(self, result, name, told):
        self.assertGreater(result.returncode, 0, told)
        self.assertLess(result.returncode, 128, told)
        self.assertEqual(len(error_lines(result.stdout, name)), 1, f"{told}\n{result.stdout}")
        self.assertEqual(result.stdout.strip().splitlines()[-1], error_lines(result.stdout, name)[0], told)

    def test_what_a_stage_reads(self):
        """Files that cannot be made again by the stage that reads them."""
        files = [path.relative_to(WHOLE) for folder in READERS for path in sorted((WHOLE / folder).iterdir())
                 if path.is_file() and path.name != "pass.json"]
        # Each once, then at random.
        for seed in range(DAMAGES):
            dice = random.Random(seed)
            name = files[seed] if seed < len(files) else dice.choice(files)
            readers = READERS[name.parts[0]]
            reader = readers[0] if seed < len(files) else dice.choice(readers)
            run = copy_run("damage-read")
            told = f"seed {seed}: {damage(run / name, dice, OTHER / name)}, read by {reader}"
            with self.subTest(told):
                result = stage(reader, run, cells=CELLS, ranks=dice.choice((1, 2)))
                self.one_line(result, reader, told)
                self.assertIn(f"{run}/{name.parts[0]}", result.stdout, told)

    def test_checkpoints(self):
        """Damaged and lost region files are made again, each with a line, and so is the state of the passes."""
        for seed in range(max(1, DAMAGES // 30)):
            dice = random.Random(1000 + seed)
            run = copy_run("damage-checkpoint")
            told, changed, lost = f"seed {1000 + seed}:", [], []
            for path in regions(run):
                if dice.random() < 0.2:
                    path.unlink()
                    lost.append(path.name)
                elif dice.random() < 0.8:
                    neighbour = dice.choice([other for other in regions(WHOLE) if other.name != path.name])
                    told += " " + damage(path, dice, neighbour)
                    if "swap" not in told.split()[-1]:  # such a file is whole, and that of another region
                        changed.append(path.name)
            if dice.random() < 0.5 and (run / "mesh/pass.json").exists():
                told += " " + damage(run / "mesh/pass.json", dice, OTHER / "mesh/pass.json")
            with self.subTest(told):
                done(self, "mesh", run, cells=CELLS, ranks=dice.choice((1, 2, 3)))
                self.assertEqual(digests(run / "mesh"), self.mesh, told)
                warned = "".join(record(run, "mesh")["warnings"])
                for name in changed:
                    self.assertIn(name, warned, told)
                for name in lost:
                    self.assertNotIn(name, warned, told)

    def test_a_stage_that_was_made_again(self):
        """Whole files that later ones were not made from, whatever the time stamps say: those of a clock that went
        back and forth are among them."""
        for folder, readers in (("geometry", ("export", "report")), ("mesh", ("report",))):
            for reader in readers:
                run = copy_run("damage-again")
                kept = {name: (run / name / "record.json").read_bytes() for name in ("mesh", "export")}
                changed = run / folder / ("design.json" if folder == "geometry" else "manifest.json")
                text = changed.read_text()
                changed.unlink()
                changed.write_text(text + "\n")
                seal(self, run / folder)
                later = [name for name in kept if name != folder]
                for name in later:
                    (run / name / "record.json").write_bytes(kept[name])
                dice = random.Random(folder + reader)
                for path in sorted(run.rglob("*")):
                    os.utime(path, (dice.randrange(2 ** 31), dice.randrange(2 ** 31)))
                result = stage(reader, run, cells=CELLS, ranks=2)
                self.one_line(result, reader, folder)
                self.assertIn(f"{run}/{later[0]}: was made from other files than lie in {run}/{folder}", result.stdout)

    def test_a_clock_that_goes_back(self):
        """No stage looks at time stamps: a run is gone on with, and taken, whatever they are."""
        run = copy_run("damage-clock")
        regions(run)[0].unlink()
        dice = random.Random(1)
        for path in sorted(run.rglob("*")):
            os.utime(path, (dice.randrange(2 ** 31), dice.randrange(2 ** 31)))
        done(self, "mesh", run, cells=CELLS, ranks=2)
        self.assertEqual(digests(run / "mesh"), self.mesh)
        done(self, "export", run, cells=CELLS, ranks=2)
        self.assertEqual(digests(run / "export"), self.export)
        done(self, "report", run, cells=CELLS)

if __name__ == "__main__":
    unittest.main()
