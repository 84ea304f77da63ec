#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Table 2 of the paper again: time, speed-up and parallel efficiency of the mesher.

1 and 2 ranks are measured, in turn, on this machine. More ranks are a model, marked so: the times of the one-rank run are
replayed through the mesher's own rule of distribution (largest predicted cost first, each rank takes the next task when it
is free). Steps with one task a domain, and the background with hardly more, gain from two ranks at most; steps whose single
tasks are not recorded are divided evenly; reading the geometry is done by every rank and gains nothing."""

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


def mesh(arguments, geometry, ranks):
    """One run in a fresh folder; seconds and the record."""
    with tempfile.TemporaryDirectory(prefix="cutwater-speedup-") as run:
        shutil.copytree(geometry, pathlib.Path(run) / "geometry")
        begun = time.monotonic()
        subprocess.run(["mpirun", "-q", "--oversubscribe", "-n", str(ranks), arguments.bin / "cutwater-mesh", "--case",
                        arguments.case, "--run", run, "--cells", arguments.cells], check=True, env=ENVIRONMENT,
                       stderr=subprocess.DEVNULL)
        seconds = time.monotonic() - begun
        return seconds, json.loads((pathlib.Path(run) / "mesh/record.json").read_text())


def replay(tasks, ranks):
    """Time until the last of the tasks (predicted cost, seconds) ends on `ranks` ranks."""
    free = [0.0] * ranks
    for _, seconds in sorted(tasks, key=lambda task: -task[0]):
        heapq.heappush(free, heapq.heappop(free) + seconds)
    return max(free)


def modelled(seconds, record, ranks):
    """Time of the run on `ranks` ranks, from the record of the run on one."""
    regions = [(region["predicted_share"], region["seconds"])
               for domain in record["results"]["domains"] for region in domain["region_list"]]
    passes = record["results"]["passes"]
    total, known = 0.0, 0.0
    for step in record["steps"]:
        known += step["seconds"]
        if step["name"] == "geometry":
            total += step["seconds"]
        elif step["name"] == "regions":
            continue
        else:
            total += step["seconds"] / min(ranks, 2 if step["unit"] == "parts" else step["items"])
    measured = sum(step["seconds"] for step in record["steps"] if step["name"] == "regions") / passes
    scale = measured / sum(task[1] for task in regions)
    total += passes * scale * replay(regions, ranks)
    return total + (seconds - known)  # what no step accounts for is done by every rank


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", default="2M")
    parser.add_argument("--case", type=pathlib.Path, default=SOURCE / "cases/paper/case.yaml")
    parser.add_argument("--bin", type=pathlib.Path, default=SOURCE / "build/bin")
    parser.add_argument("--ranks", type=int, nargs="*", default=[6, 12, 18, 24, 48, 96, 256, 1024])
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="cutwater-speedup-") as run:
        subprocess.run([arguments.bin / "cutwater-geometry", "--case", arguments.case, "--run", run], check=True,
                       stderr=subprocess.DEVNULL)
        geometry = pathlib.Path(run) / "geometry"
        one, record = mesh(arguments, geometry, 1)
        two, _ = mesh(arguments, geometry, 2)
    cells = record["results"]["cells"]
    regions = sum(domain["regions"] for domain in record["results"]["domains"])
    print(f"{cells:,} cells in {regions} regions, {record['results']['passes']} passes")
    print("ranks   seconds  speed-up  efficiency %  paper %")
    print(f"    1  {one:8.2f}      1.00        100.00           measured")
    print(f"    2  {two:8.2f}  {one / two:8.2f}  {50 * one / two:12.2f}           measured")
    for ranks in arguments.ranks:
        seconds = modelled(one, record, ranks)
        paper = f"{PAPER[ranks]:7.2f}" if ranks in PAPER else "      -"
        print(f"{ranks:5d}  {seconds:8.2f}  {one / seconds:8.2f}  {100 * one / seconds / ranks:12.2f}  {paper}  model")
    return 0


if __name__ == "__main__":
    sys.exit(main())
