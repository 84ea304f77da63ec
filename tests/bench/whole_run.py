#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""whole_run.py [--cells 1M] [--ranks 2] [--repeat 3] [--bin build/bin] [--case cases/paper/case.yaml]

Speed of a whole run, from the case file to CGNS, OpenFOAM and CFX, in cells a second, beside gmsh's fastest
tetrahedra (`gmsh -3 -algo hxt -nt RANKS`) on the same solids, at the same number of cells, on the same cores. The runs
alternate, so that both see the same machine. gmsh reads pump.step, meshes, and writes its own binary file; it makes no
layers, no interface, no solver's case. Its mesh size is found beforehand by trial runs that do not count."""
import os
import shutil
import statistics
import tempfile
from pathlib import Path

from programs import execute, gmsh, gmsh_first_size, options_of, size_for
from runs import BIN, PAPER_CASE, record, stage_line

NEAR = 0.05  # of the number of cells, between the two


def cutwater(options, run):
    """Seconds by stage, and the cells made."""
    shutil.rmtree(run, ignore_errors=True)
    seconds = {stage: execute(*stage_line(options.bin, stage, options.case, run, options.cells, options.ranks)).wall
               for stage in ("geometry", "mesh", "export")}
    return seconds, record(run)["results"]["cells"]


def main():
    options = options_of(__doc__, cells="1M", repeat=3, bin=BIN, case=PAPER_CASE, ranks=2).parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run = folder / "run"
        _, cells = cutwater(options, run)
        first = gmsh_first_size(run / "geometry", cells)
        step = folder / "pump.step"
        shutil.copy(run / "geometry/pump.step", step)

        def hxt(size):
            return gmsh(step, size, "hxt", folder, threads=options.ranks, mesh=folder / "gmsh.msh")

        size = size_for(cells, first, 3, NEAR, lambda size: hxt(size).tetrahedra)
        ours, theirs = [], []
        for _ in range(options.repeat):
            ours.append(cutwater(options, run))
            theirs.append(hxt(size))
    print(f"{'run':<4}{'program':<20}{'cells':>12}{'seconds':>10}{'cells/s':>10}  by stage")
    for number, ((stages, made), other) in enumerate(zip(ours, theirs), 1):
        whole = sum(stages.values())
        parts = ", ".join(f"{stage} {value:.1f}" for stage, value in stages.items())
        print(f"{number:<4}{'cutwater, whole run':<20}{made:>12,}{whole:>10.1f}{made / whole:>10,.0f}  {parts}")
        print(f"{number:<4}{'gmsh -algo hxt':<20}{other.tetrahedra:>12,}{other.wall:>10.1f}"
              f"{other.tetrahedra / other.wall:>10,.0f}")
    ratios = [(made / sum(stages.values())) / (other.tetrahedra / other.wall)
              for (stages, made), other in zip(ours, theirs)]
    print(f"cutwater against gmsh, cells a second: {statistics.median(ratios):.2f} times (median of {len(ratios)}; "
          f"{min(ratios):.2f} to {max(ratios):.2f}); {options.ranks} ranks, {options.ranks} threads, "
          f"{os.cpu_count()} cores, load before {os.getloadavg()[2]:.1f}")


main()
