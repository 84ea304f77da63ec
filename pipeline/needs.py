#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""needs.py FOLDER [--solve] CELLS...: tells what runs of so many cells need of disk and memory, before they start, and
ends with 1 where FOLDER's disk does not have it. CELLS as 500000, 500k or 2M. needs.py --table CELLS...: prints a row
of a table for each number.

The figures are those of the paper's pump with 5 and 15 layers, 0.3 to 8 million cells, on 2 ranks (tests/bench/scale.py
prints them); layers and size change them by a third."""
import os
import shutil
import sys

BYTES_A_CELL = {"mesh": 36, "export": 120}  # on the disk
SOLVED_BYTES_A_CELL = 500                   # the case, in parts and whole, with the fields of two times
MEMORY_AT_LEAST = 0.3e9                     # bytes, of both ranks of the mesher
MEMORY_A_CELL = {"mesh": 16, "solve": 2000}  # bytes of memory beyond that
UNITS = {"k": 10**3, "M": 10**6, "G": 10**9}


def read_count(text):
    return round(float(text[:-1]) * UNITS[text[-1]]) if text[-1] in UNITS else int(text)


def memory_of_machine():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def existing(folder):
    while not os.path.isdir(folder):
        folder = os.path.dirname(os.path.abspath(folder))
    return folder


def row(text):
    """What a run of so many cells needs, in a row of a table."""
    cells = read_count(text)
    disk = [cells * bytes_a_cell for bytes_a_cell in (*BYTES_A_CELL.values(), SOLVED_BYTES_A_CELL)]
    memory = [MEMORY_AT_LEAST + cells * bytes_a_cell for bytes_a_cell in MEMORY_A_CELL.values()]
    return f"| {text} | " + " | ".join(f"{value / 1e9:,.2g}" if value < 1e11 else f"{value / 1e9:,.0f}"
                                       for value in disk + memory) + " |"


def main(words):
    if words[0] == "--table":
        print("| cells | disk: mesh, GB | export, GB | solved flow, GB | memory: mesher, all ranks, GB | "
              "OpenFOAM, GB |")
        print("|---|---|---|---|---|---|")
        print("\n".join(row(text) for text in words[1:]))
        return
    solve = "--solve" in words
    folder, *sizes = [word for word in words if word != "--solve"]
    cells = [read_count(text) for text in sizes]
    disk = sum(cells) * (sum(BYTES_A_CELL.values()) + (SOLVED_BYTES_A_CELL if solve else 0))
    memory = MEMORY_AT_LEAST + max(cells) * MEMORY_A_CELL["solve" if solve else "mesh"]
    free = shutil.disk_usage(existing(folder)).free
    print(f"{len(cells)} runs, {sum(cells):,} cells: about {disk / 1e9:.2g} GB of the {free / 1e9:.3g} GB free on the "
          f"disk, {memory / 1e9:.2g} GB of {memory_of_machine() / 1e9:.3g} GB of memory", file=sys.stderr)
    if disk > free:
        sys.exit(f"needs: error: {folder}: the disk has {free / 1e9:.3g} GB free, the runs need about {disk / 1e9:.2g} "
                 "GB; make room, or ask for fewer cells")
    if memory > memory_of_machine():
        print("needs: warning: this machine has less memory; the largest runs may end for want of it", file=sys.stderr)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__.splitlines()[0])
    main(sys.argv[1:])
