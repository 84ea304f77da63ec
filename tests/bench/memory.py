#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""memory.py [CELLS ...] [--held-out 100M] [--ranks 1 2 4 8 16 32] [--bin build/bin] [--case FILE] [--work DIR]

Memory of the mesher and of the exporter over the number of ranks, on one machine (8M 38M 100M 145M unless others are
given), in MB: at the peak of all ranks together, of the largest rank, and that of all over the ranks. There may be more
ranks than cores. It is looked at ten times a second as the system counts it for each rank (Pss in
/proc/PID/smaps_rollup): what several ranks share counts on each of them by its part. A run is removed before the next
one begins. Beside each size: by how much less the largest of 16 ranks holds than one alone; asked are 3 times.

The last lines are a model of the largest rank and of all together:

  largest  = A + B n / regions + C n^(2/3) + D n^(2/3) / ranks
  together = ranks (A + B n / regions) + C n^(2/3)

n: cells. A: the program, CAD, plan, curves; B: the region in its hands; C: what one rank of a host holds for all while
it works on walls and layers; D: what they share when it is made. Coefficients are those of the least
squares of relative errors; one below 0 is left out. The sizes but --held-out are fitted, three at least, and what the
model says there stands beside what was measured. It then tells what 1,000 million cells need on 64 ranks of one
machine, in the regions that the mesher makes of them; 1 GiB a rank is asked."""
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections import namedtuple
from pathlib import Path

from programs import ENVIRONMENT, execute, made_folder, options_of
from runs import BIN, PAPER_CASE, needs, record, stage_line, with_key

LARGE, LARGE_RANKS, LARGE_ASKED = 1e9, 64, 2**30  # bytes a rank
MANY, TIMES = 16, 3  # ranks, of which the largest is asked to hold so many times less than one alone
SIZES = 3  # at least, to tell the terms of the model apart
STAGES = {"mesh": "mesher", "export": "exporter"}

# Of a run: bytes of all ranks together and of the largest, by stage.
Point = namedtuple("Point", "cells regions ranks together largest")
# How each figure of a Point is made up, term by term.
TERMS = {"largest": lambda of: (1, of.cells / of.regions, of.cells ** (2 / 3), of.cells ** (2 / 3) / of.ranks),
         "together": lambda of: (of.ranks, of.ranks * of.cells / of.regions, of.cells ** (2 / 3))}


def shares_of(program, parent):
    """Bytes of each process of the program that this one has started, with its part of what it shares."""
    found = []
    for folder in Path("/proc").iterdir():
        try:
            if not folder.name.isdigit() or os.readlink(folder / "exe") != str(program):
                continue
            if int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1]) == parent:
                text = (folder / "smaps_rollup").read_text()
                found.append(1024 * int(text.split("Pss:")[1].split()[0]))
        except (OSError, IndexError):
            continue  # it has ended
    return found


def watch(line, program):
    """Runs a line to its end; the peaks of all its processes and of the largest."""
    together = largest = 0
    with tempfile.TemporaryFile(mode="w+") as said:
        child = subprocess.Popen([str(word) for word in line], env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=said,
                                 stderr=subprocess.STDOUT, text=True)
        while child.poll() is None:
            shares = shares_of(program, child.pid)
            together, largest = max(together, sum(shares)), max(largest, *shares, 0)
            time.sleep(0.1)
        if child.returncode:
            said.seek(0)
            sys.exit(f"memory: {' '.join(map(str, line))}:\n{said.read()[-2000:]}")
    if not largest:
        sys.exit(f"memory: {program} ended before it was looked at; more cells take longer")
    return together, largest


def solve(matrix, right):
    """Gauss' elimination with pivots; None where the matrix is singular."""
    rows, count = [[*row, value] for row, value in zip(matrix, right)], len(right)
    for k in range(count):
        best = max(range(k, count), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        if abs(rows[k][k]) < 1e-12:
            return None
        for i in range(count):
            if i != k:
                rows[i] = [a - rows[i][k] / rows[k][k] * b for a, b in zip(rows[i], rows[k])]
    return [rows[k][-1] / rows[k][k] for k in range(count)]


def fit(points, figure, stage):
    """The coefficients of the terms of a figure, none below 0; the last of terms that the points cannot tell apart is
    left out."""
    rows = [[term / getattr(point, figure)[stage] for term in TERMS[figure](point)] for point in points]
    scale = [math.sqrt(sum(value * value for value in column)) for column in zip(*rows)]
    kept = list(range(len(scale)))
    while True:
        columns = [[row[k] / scale[k] for row in rows] for k in kept]
        made = solve([[math.fsum(a * b for a, b in zip(one, other)) for other in columns] for one in columns],
                     [math.fsum(column) for column in columns])
        if made and min(made) >= 0:
            return [made[kept.index(k)] / scale[k] if k in kept else 0 for k in range(len(scale))]
        kept.pop(made.index(min(made)) if made else -1)


def modelled(coefficients, figure, point):
    return sum(value * term for value, term in zip(coefficients, TERMS[figure](point)))


def print_less(points):
    """Of one size: by how much less the largest of many ranks holds."""
    by_ranks = {point.ranks: point for point in points}
    if not {1, MANY} <= set(by_ranks):
        return
    for stage, title in STAGES.items():
        times = by_ranks[1].largest[stage] / by_ranks[MANY].largest[stage]
        print(f"{'':12} {title}: the largest of {MANY} ranks holds {times:.2f} times less than 1 alone; asked {TIMES}: "
              f"{'met' if times >= TIMES else 'missed'}", flush=True)


def print_model(points, held_out):
    """Fitted to all sizes but one, which is modelled; then the large run."""
    known = [point for point in points if point not in held_out]
    large = Point(LARGE, math.ceil(LARGE / needs.REGION_CELLS_MOST), LARGE_RANKS, None, None)
    for stage, title in STAGES.items():
        made = {figure: fit(known, figure, stage) for figure in TERMS}
        for point in held_out:
            pairs = [(modelled(made[figure], figure, point), getattr(point, figure)[stage])
                     for figure in ("together", "largest")]
            print(f"{title}, {point.cells:,} cells on {point.ranks} ranks, not fitted: " + "; ".join(
                f"{name} {said / 1e6:,.0f} MB for {had / 1e6:,.0f} ({100 * (said / had - 1):+.0f} %)"
                for name, (said, had) in zip(("all ranks", "largest"), pairs)))
        most = modelled(made["largest"], "largest", large)
        parts = ", ".join(f"{value * term / 1e6:,.0f}" for value, term in zip(made["largest"], TERMS["largest"](large)))
        print(f"{title}, model of {LARGE:,.0f} cells in {large.regions} regions on {LARGE_RANKS} ranks of one machine: "
              f"largest {most / 2**30:.2f} GiB (MB of A, B, C, D: {parts}), all "
              f"{modelled(made['together'], 'together', large) / 2**30:.1f} GiB; asked {LARGE_ASKED / 2**30:.0f} GiB a "
              f"rank: {'met' if most <= LARGE_ASKED else 'missed'}")


def measure(options, case, geometry, run, cells, ranks):
    """A run and its row; the point."""
    shutil.copytree(geometry, run)
    programs = options.bin.resolve()
    row = {stage: watch(stage_line(programs, stage, case, run, cells, ranks),
                        (programs / f"cutwater-{stage}").resolve()) for stage in STAGES}
    domains = record(run)["results"]["domains"]
    point = Point(sum(domain[kind] for domain in domains for kind in ("tetrahedra", "prisms")),
                  sum(len(domain["region_list"]) for domain in domains), ranks,
                  *({stage: row[stage][k] for stage in STAGES} for k in (0, 1)))
    columns = (f" {together / 1e6:>10.0f} {largest / 1e6:>8.0f} {together / ranks / 1e6:>8.0f}"
               for together, largest in row.values())
    print(f"{point.cells:>12,} {ranks:>6}" + "".join(columns), flush=True)
    shutil.rmtree(run)
    return point


def main():
    parser = options_of(__doc__, held_out="100M", bin=BIN, case=PAPER_CASE)
    parser.add_argument("cells", nargs="*", default=["8M", "38M", "100M", "145M"])
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4, 8, 16, 32])
    parser.add_argument("--work", type=made_folder)
    options = parser.parse_args()
    print("MB; peaks of the mesher | of the exporter (CGNS alone)")
    print(f"{'cells':>12} {'ranks':>6}" + 2 * f" {'all ranks':>10} {'largest':>8} {'a rank':>8}")
    known, held_out = [], []
    with tempfile.TemporaryDirectory(prefix="cutwater-memory-", dir=options.work) as folder:
        case = Path(folder) / "case.yaml"
        case.write_text(with_key(options.case.read_text(), "export", "formats", "[cgns]"))
        geometry = Path(folder) / "geometry"
        execute(*stage_line(options.bin, "geometry", case, geometry))
        for cells in options.cells:
            points = [measure(options, case, geometry, Path(folder) / "run", cells, ranks) for ranks in options.ranks]
            print_less(points)
            is_held = needs.read_count(cells) == needs.read_count(options.held_out)
            (held_out if is_held else known).extend(points)
    if len({point.cells for point in known}) >= SIZES:
        print_model(known + held_out, held_out)


if __name__ == "__main__":
    main()
