#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""cases.py [NAME ...] [--cells 300k 1M] [--ranks 2] [--bin build/bin] [--work DIR] [--mesh-only]

All pumps of cases/, or those named, at each of the asked numbers of cells (their own unless others are given), one
after the other: cells made, passes, layers, least dihedral angle, mean aspect of the tetrahedra, and what OpenFOAM's
checkMesh says (-allGeometry -allTopology).

first   wall faces whose first height is within 10 % of its target, %
layers  of prisms, of each domain
even    faces of the layer top across which volumes change by no more than 4, %; in brackets the greatest change
worst   patch with the fewest of them, of those with 100 faces or more
beside  how much greater the mean aspect of the tetrahedra beside partition planes is than that of the others, %

Every run is removed before the next one begins. With --mesh-only nothing is exported, and checkMesh not asked."""
import tempfile
from pathlib import Path

from programs import execute, made_folder, options_of
from runs import BIN, cases_named, failed_checks, quality, record, stage_line


def table_row(name, run, told):
    results = record(run)["results"]
    domains, shares = results["domains"], quality(results)
    patches = [patch for domain in domains for patch in domain["layer_coverage"]]
    even = f"{100 * shares['even']:.2f} ({max(p['volume_ratio_greatest'] for p in patches):.1f})"
    large = [(1 - (p["thin_last_layer_faces"] + p["thick_last_layer_faces"]) / p["wall_faces"], p["patch"])
             for p in patches if p["wall_faces"] >= 100]
    worst = f"{100 * min(large)[0]:.1f} {min(large)[1]}" if large else "-"

    def of_domains(key, form):
        return " / ".join(form.format(domain[key]) for domain in domains)

    beside = []
    for domain in domains:
        near, apart = domain["tetrahedra_beside_planes"], domain["tetrahedra_apart"]
        beside.append(f"{100 * (near['aspect_mean'] / apart['aspect_mean'] - 1):+.1f}")
    print(f"{name:10}{results['asked_cells']:>12,}{results['cells']:>12,}{results['passes']:>7}"
          f"{of_domains('layers', '{}'):>16}  {100 * shares['first_height']:>6.2f}  {even:>15}  {worst:22} "
          f"{of_domains('least_dihedral_deg', '{:.1f}'):>12} "
          f"{of_domains('tetrahedron_aspect_mean', '{:.2f}'):>12} {' / '.join(beside):>12}  {told}", flush=True)


def main():
    parser = options_of(__doc__, ranks=2, bin=BIN, mesh_only=False)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--cells", nargs="*", default=[None])
    parser.add_argument("--work", type=made_folder)
    options = parser.parse_args()
    print(f"{'case':10}{'asked':>12}{'made':>12}{'passes':>7}{'layers':>16}  {'first':>6}  {'even':>15}  {'worst':22} "
          f"{'dihedral':>12} {'aspect':>12} {'beside':>12}  checkMesh", flush=True)
    for cells in options.cells:
        for name, case in cases_named(options.names):
            with tempfile.TemporaryDirectory(dir=options.work) as folder:
                run = Path(folder) / "run"
                for stage in ("geometry", "mesh") + ("export",) * (not options.mesh_only):
                    execute(*stage_line(options.bin, stage, case, run, cells, options.ranks))
                table_row(name, run, "" if options.mesh_only else "; ".join(failed_checks(run)) or "Mesh OK")


main()
