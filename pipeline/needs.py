#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""needs.py FOLDER [--solve | --curve] [--sweep] [--case FILE]... [--ranks N] CELLS...: tells what runs of so many cells
need of disk and memory, before they start, and ends with 1 where FOLDER's disk does not have it. CELLS as 500000, 500k
or 2M. With --case the formats of the export, the cells of a region and the points of the curve are those of the case,
and its number of cells where none is given; what the run in FOLDER has on the disk already counts as free, and a small
one says nothing. With --sweep a run of each case and each number is meant, in FOLDER/NAME-CELLS with NAME from
cases/NAME/case.yaml, and what they need is told however small. --ranks: of the mesher on this machine, 2 unless given.
--solve: the flow is solved too, with its start (solve/coarse.py); --curve: at each point of the curve, of which the
operating point is taken for one. needs.py --table CELLS...: prints a row of a table for each number.

The figures are those of the paper's pump with 5 and 15 layers, 0.3 to 100 million cells (tests/bench/scale.py prints
them, tests/bench/memory.py the memory over the ranks); layers and size change them by a third."""
import argparse
import os
import re
import shutil
import sys
from pathlib import Path
from typing import NamedTuple, Sequence

sys.path.append(str(Path(__file__).resolve().parent / "solve"))
from coarse import start_cells  # noqa: E402  (pipeline/solve/coarse.py)

# Bytes on the disk: a cell's, and those that go with the area of the walls, by cells to the power 2/3.
DISK = {"mesh": (22, 1250), "cgns": (22, 1000), "openfoam": (76, 0), "fluent": (200, 0)}
FORMATS = ("cgns", "openfoam", "cfx")  # where a case asks for none
CURVE_POINTS = 4                       # the same
SOLVED_BYTES_A_CELL = 500              # the case, in parts and whole, with the fields of two times
# Bytes of memory of the mesher. Of a host, whatever its ranks: at least, and by cells to the power 2/3, for the
# surfaces. Of a rank: at least, and by cells of the region that it fills.
HOST_MEMORY, RANK_MEMORY = (170e6, 2700), (68e6, 100)
# mesher/policy_table.h: cells of a region at least, regions of a mesh at most, until a region would have so many cells.
REGION_CELLS, REGIONS_MOST, REGION_CELLS_MOST = 270e3, 140, 2e6
SOLVE_MEMORY, SOLVE_MEMORY_A_CELL = 0.3e9, 2000
UNITS = {"k": 10**3, "K": 10**3, "M": 10**6, "G": 10**9}
SMALL = 10**9  # bytes of disk below which a run says nothing


def read_count(text):
    try:
        return round(float(text[:-1]) * UNITS[text[-1]] if text[-1] in UNITS else float(text))
    except ValueError:
        sys.exit(f"needs: error: '{text}' is no number of cells; allowed: 500000, 500k or 2M")


def memory_of_machine():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def disk_of(part, cells):
    return DISK[part][0] * cells + DISK[part][1] * cells ** (2 / 3)


def export_disk(cells, formats=FORMATS):
    with_cgns = set(formats) | ({"cgns"} if {"cfx", "code_saturne"} & set(formats) else set())  # they read pump.cgns
    return sum(disk_of(part, cells) for part in with_cgns if part in DISK)


def run_disk(cells, formats=FORMATS, flows=0):
    """flows: how many of them are solved."""
    start = start_cells(cells) if flows else 0
    return (disk_of("mesh", cells) + export_disk(cells, formats) + flows * cells * SOLVED_BYTES_A_CELL +
            (run_disk(start, formats, 1) if start else 0))


def host_memory(cells):
    return HOST_MEMORY[0] + HOST_MEMORY[1] * cells ** (2 / 3)


def rank_memory(cells, of_region=None):
    """of_region: cells that a case asks for in one."""
    region = min(of_region, cells) if of_region else min(max(REGION_CELLS, cells / REGIONS_MOST), REGION_CELLS_MOST)
    return RANK_MEMORY[0] + RANK_MEMORY[1] * region


def mesher_memory(cells, ranks, of_region=None):
    """Of a host."""
    return host_memory(cells) + ranks * rank_memory(cells, of_region)


def existing(folder):
    while not os.path.isdir(folder):
        folder = os.path.dirname(os.path.abspath(folder))
    return folder


def size_of(folder):
    return sum(path.lstat().st_size for path in Path(folder).rglob("*") if path.is_file())


def row(text):
    """What a run of so many cells needs, in a row of a table."""
    cells = read_count(text)
    values = (disk_of("mesh", cells), disk_of("cgns", cells), export_disk(cells),
              run_disk(cells, flows=1) - run_disk(cells), host_memory(cells), rank_memory(cells),
              SOLVE_MEMORY + cells * SOLVE_MEMORY_A_CELL)
    return f"| {text} | " + " | ".join(f"{value / 1e9:,.2g}" if value < 1e11 else f"{value / 1e9:,.0f}"
                                       for value in values) + " |"


def case_says(path):
    """Formats, cells, cells of a region and number of the curve's points of a case file, as far as it has them; the
    schema has judged or will judge it."""
    text = re.sub(r"#.*", "", Path(path).read_text(encoding="utf-8"))
    formats = re.search(r"\bformats:\s*(\[[^]]*\]|(?:\s*-\s*[\w\"']+)+|[\w\"']+)", text)
    cells, of_region = (re.search(rf"\b{key}:\s*([\d.]+(?:[kKMG]|e\d+)?)(?=[\s,}}]|$)", text)
                        for key in ("cells", "cells_per_region"))
    points = re.search(r"\bflow_(?:shares|rates_\w+):\s*(\[[^]]*\]|(?:\s*-\s*[\d.e]+)+)", text)
    return ((re.findall(r"[a-z_]+", formats[1]) if formats else FORMATS), ([cells[1]] if cells else ["1M"]),
            read_count(of_region[1]) if of_region else None,
            len(re.findall(r"[\d.e]+", points[1])) if points else CURVE_POINTS)


class Run(NamedTuple):
    """What is known of a run before it starts."""
    cells: int
    formats: Sequence[str] = FORMATS
    of_region: float | None = None  # cells of a region
    points: int = CURVE_POINTS
    folder: Path | None = None


def runs_of(folder, sizes, options):
    """The runs that the words mean."""
    for case in options.case:
        formats, of_case, of_region, points = case_says(case)
        for text in sizes or of_case:
            run = Path(folder, f"{Path(case).parent.name}-{text}") if options.sweep else Path(folder)
            yield Run(read_count(text), formats, of_region, points, run)
    if not options.case:
        yield from (Run(read_count(text)) for text in sizes)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="+")
    solved = parser.add_mutually_exclusive_group()
    solved.add_argument("--solve", action="store_true")
    solved.add_argument("--curve", action="store_true")
    parser.add_argument("--sweep", action="store_true")
    parser.add_argument("--case", action="append", default=[])
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--table", action="store_true")
    options = parser.parse_intermixed_args()
    if options.table:
        print("| cells | disk: mesh, GB | CGNS alone, GB | export, GB | solved flow, GB | "
              "memory: mesher, a host, GB | and each rank, GB | OpenFOAM, GB |")
        print("|---|---|---|---|---|---|---|---|")
        print("\n".join(row(text) for text in options.words))
        return
    folder, *sizes = options.words
    if not sizes and not options.case:
        sys.exit("needs: error: no number of cells and no --case that has one; allowed: 500000, 500k or 2M")
    runs = list(runs_of(folder, sizes, options))
    cells = [run.cells for run in runs]
    disk = sum(run_disk(run.cells, run.formats, run.points if options.curve else options.solve) for run in runs)
    memory = max(mesher_memory(run.cells, options.ranks, run.of_region) for run in runs)
    if options.solve or options.curve:
        memory = max(memory, SOLVE_MEMORY + max(cells) * SOLVE_MEMORY_A_CELL)
    if options.case and not options.sweep and disk < SMALL:
        return
    free = shutil.disk_usage(existing(folder)).free + sum(map(size_of, {run.folder for run in runs} - {None}))
    told = f"{len(cells)} runs, {sum(cells):,} cells" if len(cells) > 1 else f"{cells[0]:,} cells"
    print(f"{told}: about {disk / 1e9:.3g} GB of the {free / 1e9:.3g} GB free on the "
          f"disk, {memory / 1e9:.2g} GB of {memory_of_machine() / 1e9:.3g} GB of memory", file=sys.stderr)
    if disk > free:
        sys.exit(f"needs: error: {folder}: the disk has {free / 1e9:.3g} GB free, the runs need about {disk / 1e9:.3g} "
                 "GB; make room, or ask for fewer cells")
    if memory > memory_of_machine():
        print("needs: warning: this machine has less memory; the largest runs may end for want of it", file=sys.stderr)


if __name__ == "__main__":
    main()
