#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""region_rule.py [NAME ...] [--cells 300k 1M] [--build build/experiment] [--ranks 2]

The rule of region numbers in all pumps of cases/, or those named, at each number of cells: what it does to the
interfaces of each domain, and the tetrahedra beside them with it and without. BUILD is configured with
-DCUTWATER_EXPERIMENT=ON; build/bin has the program that judges the meshes (`fill`).

rule       the mesher as it is
without    planned interfaces without new points, and no candidate dropped in their spheres. They keep the planned
           points but are triangulated anew, as constrained Delaunay triangulations: what the rule starts from
triangles  of the planned interfaces, periodic images included
spheres    those of them with candidates of the owner in their spheres
centres    inserted into the interfaces
left       triangles that still have candidates in their spheres, which both sides drop
missing    boundary triangles of the regions, layer tops included, that their Delaunay mesh did not have
beside     tetrahedra with a corner on a partition plane. All columns after it are of these: mean of longest over
           shortest edge, share with more than 2, %, the greatest, least dihedral angle, mean and least mean ratio"""
import tempfile
from pathlib import Path

from ablate import policy_of
from programs import SOURCE, execute, options_of
from runs import BIN, cases_named, record, stage_line
from table1 import regions_of, shapes

# The numbers of mesher/policy_table.h that make each way.
WAYS = {"rule": {}, "without": {"interface_sphere": 0}}


def run_mesher(options, case, run, cells, setting, *more):
    """Runs the mesher with these numbers."""
    execute("env", policy_of(run, setting),
            *stage_line(options.build / "bin", "mesh", case, run, cells, options.ranks), *more)


def row(program, name, way, run, domain):
    rule = domain["region_rule"]
    missing = sum(region["recovered_triangles"] for region in domain["region_list"])
    beside = shapes(program, regions_of(run / "mesh", domain["name"]))["beside"]
    return (f"{name:10} {domain['name']:10} {way:8}{domain['regions']:8}{rule['planned_triangles']:10}"
            f"{rule['encroached_triangles']:8}{rule['inserted_centres']:8}{rule['left_triangles']:5}{missing:8}"
            f"{beside.count:8}{beside.mean:8.3f}{sum(beside.classes[2:]):7.2f}{beside.most:6.2f}{beside.least:7.2f}"
            f"{beside.ratio:8.4f}{beside.worst:7.3f}")


def main():
    parser = options_of(__doc__, build=SOURCE / "build/experiment", ranks=2)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--cells", nargs="*", default=["300k", "1M"])
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="cutwater-rule-") as folder:
        program = BIN / "fill"
        for cells in options.cells:
            print(f"{cells:10} {'domain':10} {'way':8}{'regions':>8}{'triangles':>10}{'spheres':>8}{'centres':>8}"
                  f"{'left':>5}{'missing':>8}{'beside':>8}{'aspect':>8}{'>2':>7}{'most':>6}{'angle':>7}{'ratio':>8}"
                  f"{'least':>7}")
            for name, case in cases_named(options.names):
                run = Path(folder) / f"{name}-{cells}"
                execute(*stage_line(options.build / "bin", "geometry", case, run))
                rows = []
                for way, setting in WAYS.items():
                    run_mesher(options, case, run, cells, setting)
                    rows.append([row(program, name, way, run, domain) for domain in record(run)["results"]["domains"]])
                print("\n".join(line for of_domain in zip(*rows) for line in of_domain), flush=True)


if __name__ == "__main__":
    main()
