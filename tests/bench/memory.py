#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""memory.py [CELLS ...] [--ranks 1 2 4 8 16 32] [--bin build/bin] [--case FILE] [--work DIR]

Memory of the mesher and of the exporter over the number of ranks, on one machine (8M 100M 145M unless others are
given), in MB: at the peak of all ranks together, of the largest rank, and that of all over the ranks. It is looked at
ten times a second as the system counts it for each rank (Pss in /proc/PID/smaps_rollup): what several ranks share
counts on each of them by its part. A run is removed before the next one begins.

The last lines are a model: what a host holds once, whatever its ranks (surfaces, layers and the work on them; it grows
with the cells to the power 2/3), and what each rank has for itself (the program, CAD, size field, plan and curves, and
the region in its hands, which grow with the cells of a region). Both come from a line through the mesher's peaks of
each size over its ranks, and what they give for 1,000 million cells on 64 ranks of one machine is said last."""
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from programs import ENVIRONMENT, execute, options_of
from runs import BIN, PAPER_CASE, record, stage_line, with_key

LARGE, LARGE_RANKS = 1e9, 64


def shares_of(program):
    """Bytes of each process of the program, with its part of what it shares."""
    found = []
    for folder in Path("/proc").iterdir():
        try:
            if folder.name.isdigit() and os.readlink(folder / "exe") == str(program):
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
            shares = shares_of(program)
            together, largest = max(together, sum(shares)), max(largest, *shares, 0)
            time.sleep(0.1)
        if child.returncode:
            said.seek(0)
            sys.exit(f"memory: {' '.join(map(str, line))}:\n{said.read()[-2000:]}")
    return together, largest


def line_through(points):
    """Least squares: value at 0 and slope; a single point is all slope."""
    count = len(points)
    mean_x, mean_y = sum(x for x, _ in points) / count, sum(y for _, y in points) / count
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / spread if count > 1 else mean_y / mean_x
    return mean_y - slope * mean_x, slope


def main():
    parser = options_of(__doc__, bin=BIN, case=PAPER_CASE)
    parser.add_argument("cells", nargs="*", default=["8M", "100M", "145M"])
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4, 8, 16, 32])
    parser.add_argument("--work", type=Path)
    options = parser.parse_args()
    programs = options.bin.resolve()
    print("MB; peaks of the mesher | of the exporter (CGNS alone)")
    print(f"{'cells':>12} {'ranks':>6}" + 2 * f" {'all ranks':>10} {'largest':>8} {'a rank':>8}")
    model = []
    with tempfile.TemporaryDirectory(prefix="cutwater-memory-", dir=options.work) as folder:
        case = Path(folder) / "case.yaml"
        case.write_text(with_key(options.case.read_text(), "export", "formats", "[cgns]"))
        geometry = Path(folder) / "geometry"
        execute(*stage_line(programs, "geometry", case, geometry))
        for cells in options.cells:
            peaks = []
            for ranks in options.ranks:
                run = Path(folder) / "run"
                shutil.copytree(geometry, run)
                row = [watch(stage_line(programs, stage, case, run, cells, ranks),
                             (programs / f"cutwater-{stage}").resolve())
                       for stage in ("mesh", "export")]
                made = record(run)["results"]
                count = sum(domain[kind] for domain in made["domains"] for kind in ("tetrahedra", "prisms"))
                regions = sum(len(domain["region_list"]) for domain in made["domains"])
                peaks.append((ranks, row[0][0]))
                columns = (f" {together / 1e6:>10.0f} {largest / 1e6:>8.0f} {together / ranks / 1e6:>8.0f}"
                           for together, largest in row)
                print(f"{count:>12,} {ranks:>6}" + "".join(columns), flush=True)
                shutil.rmtree(run)
            once, own = line_through(peaks)
            model.append((count, regions, once, own))
            print(f"{'':12} once {once / 1e6:.0f} MB, and {own / 1e6:.0f} MB a rank", flush=True)
    if len(model) < 2:
        return
    count, regions, once, _ = model[-1]
    base, of_region = line_through([(count_ / regions_, own_) for count_, regions_, _, own_ in model])
    once *= (LARGE / count) ** (2 / 3)
    a_rank = base + of_region * LARGE / regions + once / LARGE_RANKS
    print(f"model: {LARGE:,.0f} cells in {regions} regions: once {once / 1e6:,.0f} MB, and "
          f"{(base + of_region * LARGE / regions) / 1e6:.0f} MB a rank: {a_rank / 2**30:.2f} GiB a rank on "
          f"{LARGE_RANKS} ranks of one machine")


main()
