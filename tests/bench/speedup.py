#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Table 2 of the paper again: time, speed-up and parallel efficiency of the mesher.

  tests/bench/speedup.py [--cells 2M] [--scaled 1G] [--repeat 1] [--case FILE] [--bin build/bin] [--ranks 6 12 ...]
    [--record FILE [--smaller FILE]] [--check RANKS] [--gmsh [del3d | hxt]]

1 and 2 ranks are measured on this machine, in turn, --repeat times; the least counts, of the run and of each task. All
further rows are a model, marked so: the processor seconds of each task of the run on one rank (so that what else runs
on the machine does not count) are replayed schedule by schedule through the mesher's own rule (largest predicted cost
first, with what waits for it, each rank takes the next task when it is free and waits where that one comes after
another; a schedule starts when the one before has ended on all ranks).
What no task accounts for is done by every rank, or by one on each host while the others wait, and gains nothing. Where
domains are worked on side by side, ranks are grouped as the mesher does it and the longest group counts. Messages
and bytes are those of the busiest rank, each message at 2 us and 10 GB/s, as the record of the run tells them
(tests/bench/network.py). The model knows no memory bus and no file system; the row of 2 ranks, measured and modelled,
and --check tell how far it holds here.

Exporter and report: 1 and 2 ranks by the clock; further rows from what the second rank saved in each of their steps.

--scaled CELLS: one more table, for so many cells. Its task times are not measured but scaled, each step's by the power
of the cells between this run and one with an eighth of the cells (tests/bench/scaled_run.py). --cells is 2M or more
then: coarser pumps have no layers.

`asked` is what the project asks for: 95 % on 2 ranks by the clock; with 1,000 million cells 90 % on 12, 85 % on 24 and
70 % on 256.

--check RANKS runs the mesher on so many ranks, more than there are cores too, and sets the processor seconds of the
longest rank beside the model, step by step, and the messages that Open MPI has counted beside those of the model.
--cells-per-region takes the place of the case's.

`efficiency` is that against the mesher itself on one rank. The paper's T1, though, is the time of serial Gmsh for as
many cells, so that a mesher faster than Gmsh has more than 100 % of it on few cores. --gmsh measures that T1 here:
processor seconds of gmsh's own steps, without reading the STEP file and writing, on one core, on the same solids for as
many tetrahedra as the run has cells, by its Delaunay mesher unless `hxt` is named; `by paper` is the efficiency T1 / (N
TN) with it. Gmsh makes tetrahedra of one size and no layers.

`waiting` is the efficiency if regions waited for the fills of their smaller-numbered neighbours, as section 2.3 reads,
in place of the rule's own step. --record models a record.json of a one-rank run that is there, without measuring; with
--scaled, --smaller is that of a run with fewer cells."""
import heapq
import json
import shutil
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

import network
from programs import execute, gmsh, gmsh_first_size, options_of, size_for
from runs import BIN, PAPER_CASE, needs, record, seconds_by_step, stage_line, with_key
from scaled_run import TASKS, growths, with_cells

MESSAGES = "messages"
PAPER = {6: 81.13, 12: 75.92, 18: 60.94, 24: 51.04}  # efficiency, %
ASKED = {2: 95}  # efficiency, %, by the clock
ASKED_SCALED, LARGE = {12: 90, 24: 85, 256: 70}, 1e9  # by the model, with so many cells
STAGES = {"export": "exporter", "report": "report"}
SMALLER = 8  # times fewer cells, from which --scaled is scaled

# Seconds of the mesher by the clock, its record, and of the other stages seconds by step; what Open MPI counted.
Made = namedtuple("Made", "seconds record stages sent")


def make(arguments, geometry, ranks, cells=None, stages=(), count=False):
    """One run in a fresh folder."""
    with tempfile.TemporaryDirectory(prefix="cutwater-speedup-") as name:
        run, by_stage = Path(name), {}
        shutil.copytree(geometry, run / "geometry")
        line = stage_line(arguments.bin, "mesh", arguments.case, run, cells or arguments.cells, ranks)
        seconds = execute(line[0], *(network.counting(run) if count else []), *line[1:]).wall
        for stage in stages:
            execute(*stage_line(arguments.bin, stage, arguments.case, run, ranks=ranks))
            by_stage[stage] = seconds_by_step(record(run, stage))
        return Made(seconds, record(run), by_stage, network.counted(run))


def group_sides(cost, own, least_ranks, ranks):
    """The groups of sides, each with its ranks: the mesher's own rule (cw_groups_divide)."""
    best, least = None, None
    for groups in range(1, max(2, min(len(cost), ranks // least_ranks) + 1)):
        sides, work = [[] for _ in range(groups)], [0.0] * groups
        for side in sorted(range(len(cost)), key=lambda side: -cost[side]):
            group = work.index(min(work))
            sides[group].append(side)
            work[group] += cost[side]
        ranks_of = [least_ranks] * groups if groups > 1 else [ranks]
        while sum(ranks_of) < ranks:
            longest = max(range(groups), key=lambda group: work[group] / ranks_of[group])
            ranks_of[longest] += 1
        seconds = max(work[group] * (own + (1 - own) / ranks_of[group]) for group in range(groups))
        if best is None or seconds < least:
            best, least = list(zip(sides, ranks_of)), seconds
    return best


def replay(tasks, ranks):
    """Time until the last of the tasks (predicted cost, seconds, index of the task it waits for or -1) ends on `ranks`
    ranks: first the largest, with what waits for it."""
    free, ended, cost = [0.0] * ranks, {-1: 0.0}, [task[0] for task in tasks]
    for i in reversed(range(len(tasks))):
        if tasks[i][2] >= 0:
            cost[tasks[i][2]] += cost[i]
    for i in sorted(range(len(tasks)), key=lambda i: -cost[i]):
        _, seconds, after = tasks[i]
        ended[i] = max(heapq.heappop(free), ended[after]) + seconds
        heapq.heappush(free, ended[i])
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


def smaller_neighbours(results):
    """For each task of the step "regions" but periodic images, in order, those of its neighbours of smaller number.
    Where passages are copies of one another none waits."""
    before = []
    for domain in results["domains"]:
        firsts = [region for region in domain["region_list"] if region["copy_of"] == region["region"]]
        start, number = len(before), {region["region"]: region["number"] for region in firsts}
        before += [set() for _ in firsts]
        if len(firsts) < len(domain["region_list"]):
            continue
        for a, b in domain["adjacent_regions"]:
            low, high = (a, b) if number[a] < number[b] else (b, a)
            before[start + high - 1].add(start + low - 1)
    return before


def of_all(before, tasks):
    """The same for all tasks of the step: a periodic image waits for its first."""
    firsts = [i for i, task in enumerate(tasks) if task[2] < 0]
    waits = [{task[2]} for task in tasks]
    for first, names in zip(firsts, before):
        waits[first] = {firsts[name] for name in names}
    return waits


def depth(before):
    """Regions in the longest chain of those that would wait for one another."""
    length = {}

    def of(task):
        if task not in length:
            length[task] = 1 + max((of(other) for other in before[task]), default=0)
        return length[task]

    return max(map(of, range(len(before))))


def add(seconds, more):
    for name, value in more.items():
        seconds[name] = seconds.get(name, 0) + value


class Account:
    """What ranks do together: seconds of what every rank does, by part, the lists of tasks (cost, seconds), and of each
    list their number, whether they are asked for, and bytes of results; the least of several runs."""

    def __init__(self, several):
        self.parts, self.steps, self.sent = {}, [], []
        for runs in zip(*(account["tasks"] for account in several)):
            assert len({step["step"] for step in runs}) == 1
            times = [min(values) for values in zip(*(step["task_seconds"] for step in runs))]
            cost = runs[0]["task_cost"] or [0] * len(times)
            after = [int(task) for task in runs[0]["task_after"]] or [-1] * len(times)
            self.steps.append((runs[0]["step"], list(zip(cost, times, after))))
            self.sent.append((len(times), bool(runs[0]["task_cost"]), runs[0]["bytes"]))
        for runs in zip(*(account["every_rank"] for account in several)):
            assert len({part["part"] for part in runs}) == 1
            add(self.parts, {runs[0]["part"]: min(part["seconds"] for part in runs)})

    def seconds(self, ranks, before=None):
        """By name. before: of the regions, which wait for them (smaller_neighbours)."""
        seconds = dict(self.parts)
        for name, tasks in self.steps:
            if before and name == "region rule":
                continue
            waits = before and name == "regions"
            add(seconds, {name + TASKS: replay_waiting(tasks, of_all(before, tasks), ranks) if waits
                          else replay(tasks, ranks)})
        add(seconds, {MESSAGES: network.seconds(self.traffic(ranks))})
        return seconds

    def traffic(self, ranks):
        return network.total(network.of_schedule(*sent, ranks) for sent in self.sent)


def longest_groups(sides, ranks, seconds_of):
    """Seconds by name of the group that takes longest, of all steps that go on side by side. sides: as in the record;
    seconds_of(step, side, ranks): by name, of one side."""
    seconds = {}
    for step, entry in enumerate(sides):
        groups = []
        for members, ranks_of in group_sides([side["cost"] for side in entry["side"]], entry["own"],
                                             entry["least_ranks"], ranks):
            groups.append({})
            for side in members:
                add(groups[-1], seconds_of(step, side, ranks_of))
        add(seconds, max(groups, key=lambda group: sum(group.values())))
    return seconds


class Model:
    """The run on one rank: what all ranks do together, and side by side."""

    def __init__(self, results):
        """results: of the records of one run or several."""
        self.results = results[0]
        self.together = Account([result["together"] for result in results])
        self.sides = results[0]["side_by_side"]
        self.accounts = [[Account(sides) for sides in zip(*(step["side"] for step in several))]
                         for several in zip(*(result["side_by_side"] for result in results))]
        self.before = smaller_neighbours(self.results)
        self.one = self.total(1)

    def seconds(self, ranks, waiting=False):
        """By name: parts, and steps with " (tasks)"."""
        seconds = self.together.seconds(ranks, self.before if waiting else None)
        add(seconds, longest_groups(self.sides, ranks, lambda step, side, of: self.accounts[step][side].seconds(of)))
        add(seconds, {MESSAGES: network.seconds(network.between_hosts(self.results["cells"], ranks))})
        return seconds

    def traffic(self, ranks):
        """Of the busiest rank: all domains' messages are counted, though groups of ranks send but their own."""
        sides = [account for accounts in self.accounts for account in accounts]
        return network.total([*(account.traffic(ranks) for account in [self.together, *sides]),
                              network.between_hosts(self.results["cells"], ranks)])

    def total(self, ranks, waiting=False):
        return sum(self.seconds(ranks, waiting).values())


def serial_gmsh(arguments, cells):
    """Processor seconds of gmsh on one core for about so many tetrahedra; its size is looked for with an eighth of
    them."""
    with tempfile.TemporaryDirectory(prefix="cutwater-speedup-") as name:
        folder = Path(name)
        geometry, runs = folder / "geometry", []
        execute(*stage_line(arguments.bin, "geometry", arguments.case, folder))

        def make(size):
            runs.append(gmsh(geometry / "pump.step", size, arguments.gmsh, folder))
            return runs[-1].tetrahedra

        few = size_for(cells / 8, gmsh_first_size(geometry, cells / 8), 3, 0.05, make)
        size_for(cells, few / 2, 3, 0.1, make)
        run = runs[-1]
    seconds = sum(run.steps.values())
    print(f"gmsh -algo {arguments.gmsh} -nt 1: {run.tetrahedra:,} tetrahedra in {seconds:.1f} processor seconds "
          f"({run.processor:.1f} with reading), {run.peak / 2**30:.1f} GiB")
    return seconds


def table_line(ranks, seconds, one, rest, asked, kind):
    """A row; `rest`: waiting, by paper, paper, messages and MB as they are printed."""
    efficiency = 100 * one / seconds / ranks
    wanted = f"{asked[ranks]:7.2f}" if ranks in asked else f"{'-':>7s}"
    print(f"{ranks:5d}  {seconds:8.2f}  {one / seconds:8.2f}  {efficiency:12.2f}  {wanted}  {rest:48s}  {kind}")


def print_table(model, ranks_asked, measured, serial, kind="model"):
    """`measured`: seconds by ranks; `serial`: processor seconds of serial gmsh, or None."""
    results = model.results
    regions = sum(domain["regions"] for domain in results["domains"])
    print(f"{results['cells']:,} cells in {regions} regions, {results['passes']} passes; colours "
          f"{', '.join(str(domain['colours']) for domain in results['domains'])}; were fills to wait, chains of "
          f"{depth(model.before)} regions")
    print(f"each message {1e6 * network.LATENCY:.0f} us and {network.BANDWIDTH / 1e9:.0f} GB/s; messages and MB of the "
          "busiest rank")
    print("ranks   seconds  speed-up  efficiency %  asked %  waiting %  by paper %  paper %  messages       MB")
    for ranks, seconds in measured.items():
        table_line(ranks, seconds, measured[1], "", ASKED, "measured")
    for ranks in [2] + ranks_asked:
        seconds, waiting, sent = model.total(ranks), model.total(ranks, True), model.traffic(ranks)
        paper = f"{PAPER[ranks]:7.2f}" if ranks in PAPER else f"{'-':>7s}"
        by_paper = f"{100 * serial / seconds / ranks:10.1f}" if serial else f"{'-':>10s}"
        rest = (f"{100 * model.total(1, True) / waiting / ranks:9.2f}  {by_paper}  {paper}  {sent.messages:8d} "
                f"{sent.bytes / 1e6:8.1f}")
        table_line(ranks, seconds, model.one, rest, ASKED_SCALED if results["cells"] >= LARGE else {}, kind)


def stage_seconds(one, two, ranks):
    """Of a stage on so many ranks, from seconds by step on 1 and 2: what the second rank saved goes with 1 / ranks."""
    saved = {name: min(max(2 * (seconds - two[name]), 0), seconds) for name, seconds in one.items()}
    return sum(one[name] - saved[name] * (1 - 1 / ranks) for name in one)


def print_stages(ones, twos, ranks_asked, kind="model"):
    """Rows of exporter and report. ones, twos: seconds by stage and step."""
    for stage in ones:
        one, two = sum(ones[stage].values()), sum(twos[stage].values())
        print(f"\n{STAGES[stage]}")
        for ranks, seconds in ((1, one), (2, two)) if kind == "model" else ():
            table_line(ranks, seconds, one, "", ASKED, "measured")
        for ranks in ranks_asked:
            table_line(ranks, stage_seconds(ones[stage], twos[stage], ranks), one, "", {}, kind)


def least_stages(several):
    """The least seconds of each step of several runs."""
    return {stage: {name: min(made.stages[stage][name] for made in several) for name in steps}
            for stage, steps in several[0].stages.items()}


def scaled_stages(small, large, given, ratio, factor):
    """`given`, seconds by stage and step, with `factor` times the cells: as they grew from `small` to `large`."""
    by = {stage: growths(small[stage], large[stage], ratio, factor) for stage in given}
    return {stage: {name: by[stage][name] * seconds for name, seconds in steps.items()}
            for stage, steps in given.items()}


def print_losses(model, ranks_asked):
    """What stands in the way: seconds of each step beyond its share, in % of the time of all."""
    print("\nloss of efficiency, % (model)")
    print(f"{'':34s} {'1 rank, s':>9s} " + " ".join(f"{ranks:6d}" for ranks in ranks_asked))
    at = {ranks: model.seconds(ranks) for ranks in ranks_asked}
    for name, seconds in sorted(model.seconds(1).items(), key=lambda item: -item[1]):
        if seconds < 5e-4 * model.one:
            continue
        losses = [100 * (at[ranks].get(name, 0) - seconds / ranks) / sum(at[ranks].values()) for ranks in ranks_asked]
        print(f"{name:34s} {seconds:9.2f} " + " ".join(f"{loss:6.1f}" for loss in losses))


def most_of(account):
    """Processor seconds of the rank with most, by name."""
    seconds = {}
    for part in account["every_rank"]:
        add(seconds, {part["part"]: part["most"]})
    for step in account["tasks"]:
        add(seconds, {step["step"] + TASKS: step["most"]})
    return seconds


def print_check(model, made):
    """The model beside a run on more ranks: of each step the processor seconds of the rank with most, schedule by
    schedule, side by side those of the longest group. Such a run may have more ranks than cores: a rank that waits
    sleeps."""
    results = made.record["results"]
    ranks, sides = results["ranks"], results["side_by_side"]
    modelled, measured = model.seconds(ranks), most_of(results["together"])
    add(measured, longest_groups(sides, ranks, lambda step, side, of: most_of(sides[step]["side"][side])))
    print(f"\nthe longest rank of {ranks}, processor seconds         model  measured")
    for name in sorted({**modelled, **measured}, key=lambda name: -modelled.get(name, 0)):
        row = modelled.get(name, 0), measured.get(name, 0)
        if max(row) >= 1e-3 * model.one:
            print(f"{name:50s} {row[0]:9.2f} {row[1]:9.2f}")
    print(f"{'all':50s} {sum(modelled.values()):9.2f} {sum(measured.values()):9.2f}")
    sent = model.traffic(ranks)
    print(f"{'messages of the busiest rank':50s} {sent.messages:9d} {made.sent.messages:9d}")
    print(f"{'MB of the busiest rank':50s} {sent.bytes / 1e6:9.1f} {made.sent.bytes / 1e6:9.1f}")


def results_of(path):
    """Of a record.json of one rank."""
    made = json.loads(path.read_text())["results"]
    if made["ranks"] != 1:
        sys.exit(f"speedup: {path}: a run on {made['ranks']} ranks; one is asked for")
    return made


def print_scaled(arguments, small, large, ones, twos):
    """The table for more cells: of records' results; small: Made or results alone; ones, twos: of the larger run."""
    made = with_cells(small.record["results"] if isinstance(small, Made) else small, large,
                      needs.read_count(arguments.scaled))
    kind = f"model of task times scaled from {large['cells']:,} cells"
    print(f"\n{arguments.scaled} cells: {kind}")
    print_table(Model([made]), arguments.ranks, {}, None, kind="scaled model")
    if ones:
        ratio = large["cells"] / small.record["results"]["cells"], made["cells"] / large["cells"]
        print_stages(*(scaled_stages(small.stages, ones, of, *ratio) for of in (ones, twos)), arguments.ranks,
                     kind="scaled model")


def measure(arguments):
    """Runs on 1 and 2 ranks, that of --check, and a smaller one for --scaled."""
    ones, twos, check, small = [], [], None, None
    with tempfile.TemporaryDirectory(prefix="cutwater-speedup-") as name:
        run = Path(name)
        if arguments.cells_per_region:
            text = with_key(arguments.case.read_text(), "mesh", "cells_per_region", arguments.cells_per_region)
            arguments.case = run / "case.yaml"
            arguments.case.write_text(text)
        execute(*stage_line(arguments.bin, "geometry", arguments.case, run))
        for _ in range(arguments.repeat):
            ones.append(make(arguments, run / "geometry", 1, stages=STAGES))
            twos.append(make(arguments, run / "geometry", 2, stages=STAGES))
        if arguments.check:
            check = make(arguments, run / "geometry", arguments.check, count=True)
        if arguments.scaled:
            fewer = needs.read_count(arguments.cells) // SMALLER
            small = make(arguments, run / "geometry", 1, cells=fewer, stages=STAGES)
    return ones, twos, check, small


def main():
    parser = options_of(__doc__, cells="2M", repeat=1, case=PAPER_CASE, bin=BIN)
    parser.add_argument("--ranks", type=int, nargs="*", default=[6, 12, 18, 24, 48, 96, 256, 1024])
    parser.add_argument("--record", type=Path)
    parser.add_argument("--smaller", type=Path)
    parser.add_argument("--scaled")
    parser.add_argument("--check", type=int)
    parser.add_argument("--cells-per-region")
    parser.add_argument("--gmsh", nargs="?", const="del3d", choices=["del3d", "hxt"])
    arguments = parser.parse_args()
    measured, check, stages = {}, None, ({}, {})
    if arguments.record:
        if arguments.scaled and not arguments.smaller:
            sys.exit("speedup: --scaled asks for --smaller too, a record.json of fewer cells")
        results = [results_of(arguments.record)]
        small = results_of(arguments.smaller) if arguments.smaller else None
    else:
        ones, twos, check, small = measure(arguments)
        measured = {ranks: min(made.seconds for made in runs) for ranks, runs in ((1, ones), (2, twos))}
        stages = least_stages(ones), least_stages(twos)
        results = [made.record["results"] for made in ones]
    model = Model(results)
    serial = serial_gmsh(arguments, results[0]["cells"]) if arguments.gmsh else None
    print_table(model, arguments.ranks, measured, serial)
    print_losses(model, [ranks for ranks in arguments.ranks if ranks <= 96])
    print_stages(*stages, arguments.ranks)
    if check:
        print_check(model, check)
    if arguments.scaled:
        print_scaled(arguments, small, results[0], *stages)


if __name__ == "__main__":
    main()
