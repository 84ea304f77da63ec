#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""cases.py [NAME ...] [--cells 300k 1M] [--ranks 2] [--bin build/bin] [--work DIR] [--mesh-only]

All pumps of cases/, or those named, at each of the asked numbers of cells (their own unless others are given), one
after the other: cells made, passes, layers, least dihedral angle, mean aspect of the tetrahedra, and what OpenFOAM's
checkMesh says (-allGeometry -allTopology).

first   wall faces whose first height is within 10 % of its target, %
last    of the wall faces that can reach it, those whose last layer has 0.5 to 1.5 times the height of the tetrahedron
        on it, %; in brackets the share of all wall faces that can
least   the same of the patch that has the fewest, and its name (patches where less than 100 faces can are left out)
beside  how much greater the mean aspect of the tetrahedra beside dividing planes is than that of the others, %

Every run is removed before the next one begins. With --mesh-only nothing is exported, and checkMesh not asked."""
import argparse
import json
import re
import tempfile
from pathlib import Path

from programs import MPIRUN, SOURCE, execute


def judged(run):
    """The failed checks of checkMesh in a few words, or that there are none."""
    text = execute("checkMesh", "-allGeometry", "-allTopology", "-case", run / "export/openfoam").text
    if "Mesh OK." in text:
        return "Mesh OK"
    return "; ".join(line.strip(" *") for line in re.findall(r"^ *\*\*\*.*", text, re.M))


def percent(part, whole):
    return f"{100 * part / whole:.2f}" if whole else "-"


def last_layers(patches):
    """Shares of the last layers that fit their tetrahedra, in all, and in the patch with the fewest."""
    faces = sum(p["wall_faces"] for p in patches)
    within = sum(p["last_layer_within_reach_faces"] for p in patches)
    fair = sum(p["last_layer_within_reach_fair_faces"] for p in patches)
    shares = [(p["last_layer_within_reach_fair_faces"] / p["last_layer_within_reach_faces"], p["patch"])
              for p in patches if p["last_layer_within_reach_faces"] >= 100]
    least = f"{100 * min(shares)[0]:.1f} {min(shares)[1]}" if shares else "-"
    return f"{percent(fair, within)} ({percent(within, faces)})", least


def table_row(name, run, told):
    record = json.loads((run / "mesh/record.json").read_text())
    results = record["results"]
    domains = results["domains"]
    patches = [patch for domain in domains for patch in domain["layer_coverage"]]
    first = percent(sum(p["first_height_met_faces"] for p in patches), sum(p["wall_faces"] for p in patches))
    last, least = last_layers(patches)

    def of_domains(key, form):
        return " / ".join(form.format(domain[key]) for domain in domains)

    beside = []
    for domain in domains:
        near, apart = domain["tetrahedra_beside_planes"], domain["tetrahedra_apart"]
        beside.append(f"{100 * (near['aspect_mean'] / apart['aspect_mean'] - 1):+.1f}")
    print(f"{name:10}{results['asked_cells']:>12,}{results['cells']:>12,}{results['passes']:>7}  {first:>6}  {last:>15}"
          f"  {least:22} {of_domains('least_dihedral_deg', '{:.1f}'):>12} "
          f"{of_domains('tetrahedron_aspect_mean', '{:.2f}'):>12} {' / '.join(beside):>12}  {told}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--cells", nargs="*", default=[None])
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--bin", type=Path, default=SOURCE / "build/bin")
    parser.add_argument("--work", type=Path)
    parser.add_argument("--mesh-only", action="store_true")
    options = parser.parse_args()
    cases = SOURCE / "cases"
    names = options.names or sorted(path.parent.name for path in cases.glob("*/case.yaml"))
    print(f"{'case':10}{'asked':>12}{'made':>12}{'passes':>7}  {'first':>6}  {'last':>15}  {'least':22} "
          f"{'dihedral':>12} {'aspect':>12} {'beside':>12}  checkMesh", flush=True)
    for cells in options.cells:
        for name in names:
            with tempfile.TemporaryDirectory(dir=options.work) as folder:
                run = Path(folder) / "run"
                stage = ["--case", cases / name / "case.yaml", "--run", run]
                many = stage + (["--cells", cells] if cells else [])
                execute(options.bin / "cutwater-geometry", *stage)
                execute(*MPIRUN, options.ranks, options.bin / "cutwater-mesh", *many)
                if not options.mesh_only:
                    execute(*MPIRUN, options.ranks, options.bin / "cutwater-export", *many)
                table_row(name, run, "" if options.mesh_only else judged(run))


main()
