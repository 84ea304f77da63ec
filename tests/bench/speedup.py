#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Table 2 of the paper again: time, speed-up and parallel efficiency of the mesher.

  tests/bench/speedup.py [--cells 2M] [--repeat 1] [--case FILE] [--bin build/bin] [--ranks 6 12 ...] [--record FILE]

1 and 2 ranks are measured on this machine, in turn, --repeat times; the least counts, of the run and of each task. All
further rows are a model, marked so: the processor seconds of each task of the run on one rank (so that what else runs on
the machine does not count) are replayed step by step through the mesher's own rule (largest predicted cost first, each rank takes the next task when it is free; a step starts when the one
before has ended on all ranks). What no task accounts for (start of the programs, reading the geometry, taking up results,
numbering) is done by every rank and gains nothing. The model knows no network and no shared memory bus; the row of 2
ranks, measured and modelled, tells how far it holds here.

`waiting` is the efficiency if regions waited for the fills of their smaller-numbered neighbours, as section 2.3 reads,
in place of the rule's own step. --record models a record.json of a one-rank run that is there, without measuring."""

import argparse
import heapq
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAPER = {6: 81.13, 12: 75.92, 18: 60.94, 24: 51.04}  # efficiency, %
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
EVERY_RANK = "on every rank"


def mesh(arguments, geometry, ranks):
    """One run in a fresh folder; seconds and the record."""
    with tempfile.TemporaryDirectory(prefix="cutwater-speedup-") as run:
        shutil.copytree(geometry, pathlib.Path(run) / "geometry")
        begun = time.monotonic()
        subprocess.run(["mpirun", "-q", "--oversubscribe", "-n", str(ranks), arguments.bin / "cutwater-mesh", "--case",
                        arguments.case, "--run", run, "--cells", arguments.cells], check=True, env=ENVIRONMENT,
                       stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        seconds = time.monotonic() - begun
        return seconds, json.loads((pathlib.Path(run) / "mesh/record.json").read_text())


def replay(tasks, ranks):
    """Time until the last of the tasks (predicted cost, seconds) ends on `ranks` ranks."""
    free = [0.0] * ranks
    for _, seconds in sorted(tasks, key=lambda task: -task[0]):
        heapq.heappush(free, heapq.heappop(free) + seconds)
    return max(free)


def replay_waiting(tasks, before, ranks):
    """The same where task i may start when all of before[i] have ended: largest first among those that are ready."""
    left = [set(names) for names in before]
    ready = [(-tasks[i][0], i) for i in range(len(tasks)) if not left[i]]
    heapq.heapify(ready)
    running, now, free = [], 0.0, ranks
    while ready or running:
        while ready and free:
            task = heapq.heappop(ready)[1]
            heapq.heappush(running, (now + tasks[task][1], task))
            free -= 1
        now, ended = heapq.heappop(running)
        free += 1
        for i, names in enumerate(left):
            if ended in names:
                names.remove(ended)
                if not names:
                    heapq.heappush(ready, (-tasks[i][0], i))
    return now


def smaller_neighbours(record):
    """For each task of the step "regions" the tasks of its neighbours of smaller number."""
    before, start = [], 0
    for domain in record["results"]["domains"]:
        number = {region["region"]: region["number"] for region in domain["region_list"]}
        pairs = domain["adjacent_regions"]
        for region in sorted(number):
            others = [b if a == region else a for a, b in pairs if region in (a, b)]
            before.append({start + other - 1 for other in others if number[other] < number[region]})
        start += len(number)
    return before


def depth(before):
    """Regions in the longest chain of those that would wait for one another."""
    length = {}

    def of(task):
        if task not in length:
            length[task] = 1 + max((of(other) for other in before[task]), default=0)
        return length[task]

    return max(map(of, range(len(before))))


class Model:
    """Steps of the run on one rank: name, seconds without a task, tasks (cost, seconds)."""

    def __init__(self, runs):
        records = [record for _, record in runs]
        seconds = min(record["results"]["processor_seconds"] for record in records)
        self.record = records[0]
        self.steps = []
        for several in zip(*(record["results"]["tasks"] for record in records)):
            assert len({step["step"] for step in several}) == 1
            times = [min(values) for values in zip(*(step["task_seconds"] for step in several))]
            rest = min(step["seconds"] - sum(step["task_seconds"]) for step in several)
            self.steps.append((several[0]["step"], max(rest, 0), list(zip(several[0]["task_cost"], times))))
        self.before = smaller_neighbours(self.record)
        known = sum(rest + sum(seconds for _, seconds in tasks) for _, rest, tasks in self.steps)
        self.everywhere = max(seconds - known, 0)
        self.one = known + self.everywhere

    def parts(self, ranks, waiting=False):
        """Seconds by the name of the step."""
        parts = {EVERY_RANK: self.everywhere}
        for name, rest, tasks in self.steps:
            if waiting and name == "region rule":
                continue
            seconds = replay_waiting(tasks, self.before, ranks) if waiting and name == "regions" else replay(tasks, ranks)
            parts[name] = parts.get(name, 0) + seconds
            parts[EVERY_RANK] += rest
        return parts

    def total(self, ranks, waiting=False):
        return sum(self.parts(ranks, waiting).values())


def print_table(model, ranks_asked, measured):
    record = model.record["results"]
    regions = sum(domain["regions"] for domain in record["domains"])
    print(f"{record['cells']:,} cells in {regions} regions, {record['passes']} passes; colours "
          f"{', '.join(str(domain['colours']) for domain in record['domains'])}; were fills to wait, chains of "
          f"{depth(model.before)} regions")
    print("ranks   seconds  speed-up  efficiency %  paper %  waiting %")
    for ranks, seconds in measured.items():
        print(f"{ranks:5d}  {seconds:8.2f}  {measured[1] / seconds:8.2f}  {100 * measured[1] / seconds / ranks:12.2f}"
              f"{'':20s}  measured")
    for ranks in [2] + ranks_asked:
        seconds, waiting = model.total(ranks), model.total(ranks, True)
        paper = f"{PAPER[ranks]:7.2f}" if ranks in PAPER else "      -"
        print(f"{ranks:5d}  {seconds:8.2f}  {model.one / seconds:8.2f}  {100 * model.one / seconds / ranks:12.2f}  "
              f"{paper}  {100 * model.total(1, True) / waiting / ranks:9.2f}  model")


def print_losses(model, ranks_asked):
    """What stands in the way: seconds of each step beyond its share, in % of the time of all."""
    one = model.parts(1)
    print("\nloss of efficiency by step, % (model)")
    print(f"{'step':16s} {'1 rank, s':>9s} " + " ".join(f"{ranks:6d}" for ranks in ranks_asked))
    for name in one:
        losses = []
        for ranks in ranks_asked:
            parts = model.parts(ranks)
            losses.append(100 * (parts[name] - one[name] / ranks) / sum(parts.values()))
        print(f"{name:16s} {one[name]:9.2f} " + " ".join(f"{loss:6.1f}" for loss in losses))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", default="2M")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--case", type=pathlib.Path, default=SOURCE / "cases/paper/case.yaml")
    parser.add_argument("--bin", type=pathlib.Path, default=SOURCE / "build/bin")
    parser.add_argument("--ranks", type=int, nargs="*", default=[6, 12, 18, 24, 48, 96, 256, 1024])
    parser.add_argument("--record", type=pathlib.Path)
    arguments = parser.parse_args()
    measured = {}
    if arguments.record:
        record = json.loads(arguments.record.read_text())
        if record["results"]["ranks"] != 1:
            sys.exit(f"speedup: {arguments.record}: a run on {record['results']['ranks']} ranks; one is asked for")
        model = Model([(None, record)])
    else:
        ones, twos = [], []
        with tempfile.TemporaryDirectory(prefix="cutwater-speedup-") as run:
            subprocess.run([arguments.bin / "cutwater-geometry", "--case", arguments.case, "--run", run], check=True,
                           stderr=subprocess.DEVNULL)
            for _ in range(arguments.repeat):
                ones.append(mesh(arguments, pathlib.Path(run) / "geometry", 1))
                twos.append(mesh(arguments, pathlib.Path(run) / "geometry", 2))
        measured = {1: min(seconds for seconds, _ in ones),
                    2: min(seconds for seconds, _ in twos)}
        model = Model(ones)
    print_table(model, arguments.ranks, measured)
    print_losses(model, [ranks for ranks in arguments.ranks if ranks <= 96])
    return 0


if __name__ == "__main__":
    sys.exit(main())
