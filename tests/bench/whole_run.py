# SPDX-License-Identifier: AGPL-3.0-or-later
"""whole_run.py [--cells 1M] [--ranks 2] [--repeat 3] [--bin build/bin] [--case cases/paper/case.yaml]

Speed of a whole run, from the case file to CGNS, OpenFOAM and CFX, in cells a second, beside gmsh's fastest
tetrahedra (`gmsh -3 -algo hxt -nt RANKS`) on the same solids, at the same number of cells, on the same cores. The runs
alternate, so that both see the same machine. gmsh reads pump.step, meshes, and writes its own binary file; it makes no
layers, no interface, no solver's case. Its mesh size is found beforehand by trial runs that do not count."""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
MPIRUN = ["mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n"]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
NEAR = 0.05  # of the number of cells, between the two


def timed(line):
    """Seconds and output of a command; ends the benchmark where it fails."""
    began = time.monotonic()
    result = subprocess.run([str(word) for word in line], env=ENVIRONMENT, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)
    if result.returncode:
        sys.exit(f"whole_run: {' '.join(str(word) for word in line)}:\n{result.stdout[-2000:]}")
    return time.monotonic() - began, result.stdout


def cutwater(options, run):
    """Seconds by stage, and the cells made."""
    shutil.rmtree(run, ignore_errors=True)
    seconds = {}
    for stage in ("geometry", "mesh", "export"):
        line = [options.bin / f"cutwater-{stage}", "--case", options.case, "--run", run]
        if stage != "geometry":
            line = MPIRUN + [options.ranks] + line + ["--cells", options.cells]
        seconds[stage], _ = timed(line)
    return seconds, json.loads((run / "mesh/record.json").read_text())["results"]["cells"]


def gmsh(options, step, size, folder):
    """Seconds and tetrahedra of gmsh with this largest size (mm)."""
    seconds, _ = timed(["gmsh", "-3", "-algo", "hxt", "-nt", options.ranks, "-clmax", f"{size:.6g}", step, "-bin",
                           "-o", folder / "gmsh.msh"])
    count = folder / "count.geo"
    count.write_text('Printf("tetrahedra %.0f", Mesh.NbTetrahedra);')
    _, text = timed(["gmsh", "-", folder / "gmsh.msh", count])
    return seconds, int(re.search(r"^tetrahedra (\d+)", text, re.M).group(1))


def gmsh_size(options, step, cells, folder, volume):
    """The size at which gmsh makes about this many tetrahedra."""
    size = (8 * volume / cells) ** (1 / 3)
    for _ in range(8):
        _, made = gmsh(options, step, size, folder)
        print(f"whole_run: gmsh -clmax {size:.4g} mm makes {made:,} tetrahedra", file=sys.stderr)
        if abs(made / cells - 1) <= NEAR:
            return size
        size *= (made / cells) ** (1 / 3)
    sys.exit(f"whole_run: no size of gmsh gives {cells} cells")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", default="1M")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--bin", type=Path, default=SOURCE / "build/bin")
    parser.add_argument("--case", type=Path, default=SOURCE / "cases/paper/case.yaml")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run = folder / "run"
        seconds, cells = cutwater(options, run)
        design = json.loads((run / "geometry/design.json").read_text())
        step = folder / "pump.step"
        shutil.copy(run / "geometry/pump.step", step)
        volume = 1e9 * (design["rotor_volume_m3"] + design["stator_volume_m3"])
        size = gmsh_size(options, step, cells, folder, volume)
        ours, theirs = [], []
        for _ in range(options.repeat):
            ours.append(cutwater(options, run))
            theirs.append(gmsh(options, step, size, folder))
    print(f"{'run':<4}{'program':<20}{'cells':>12}{'seconds':>10}{'cells/s':>10}  by stage")
    for number, ((stages, made), (gmsh_seconds, gmsh_cells)) in enumerate(zip(ours, theirs), 1):
        whole = sum(stages.values())
        parts = ", ".join(f"{stage} {value:.1f}" for stage, value in stages.items())
        print(f"{number:<4}{'cutwater, whole run':<20}{made:>12,}{whole:>10.1f}{made / whole:>10,.0f}  {parts}")
        print(f"{number:<4}{'gmsh -algo hxt':<20}{gmsh_cells:>12,}{gmsh_seconds:>10.1f}{gmsh_cells / gmsh_seconds:>10,.0f}")
    ratios = [(made / sum(stages.values())) / (gmsh_cells / gmsh_seconds)
              for (stages, made), (gmsh_seconds, gmsh_cells) in zip(ours, theirs)]
    print(f"cutwater against gmsh, cells a second: {statistics.median(ratios):.2f} times (median of {len(ratios)}; "
          f"{min(ratios):.2f} to {max(ratios):.2f}); {options.ranks} ranks, {options.ranks} threads, "
          f"{os.cpu_count()} cores, load before {os.getloadavg()[2]:.1f}")


main()
