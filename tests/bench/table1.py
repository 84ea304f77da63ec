#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Table 1 of the paper again: shapes of the tetrahedra of the serial mesh (one region a domain), of the mesh by region
numbers, and of Gmsh's own Delaunay method on the surfaces that the serial mesh was filled from.

  tests/bench/table1.py [--cells 2M] [--build build] [--case cases/paper/case.yaml] [--algorithm del3d]

The classes are shares of the tetrahedra by longest over shortest edge. `beside` are the tetrahedra with a corner on a
partition plane, `apart` the others. Fails where the mean ratio of those beside is worse in the mean than that of the
others by more than 5 %, or that of the mesh by region numbers worse than that of the serial one by more than 2 %."""
import argparse
import shutil
import sys
import tempfile
from pathlib import Path

from fill import compile_program, run_gmsh
from programs import MPIRUN, SOURCE, execute

CLASSES = ["1-1.5", "1.5-2", "2-3", "3-4", "4-5", "5-7", "7-10", ">10"]
PAPER = {"paper, serial (Gmsh)": ([4.5, 43.3, 32.2, 8.5, 7.3, 3.5, 0.7], 2.90, 8.6),
         "paper, proposed": ([4.0, 43.1, 30.5, 10.1, 8.2, 3.0, 1.1], 2.98, 8.8),
         "paper, Chew": ([3.0, 40.1, 31.2, 11.5, 7.6, 4.1, 1.5], 3.12, 9.4)}
DOMAINS = ("rotor", "stator")


def shapes(program, files):
    """By group: number, shares of the classes in %, mean and greatest aspect, angles, mean ratio mean and least."""
    result = {}
    for line in execute(program, "shape", *files).text.splitlines():
        name, *words = line.split()
        count = int(words[0])
        result[name] = (count, [100 * int(word) / max(count, 1) for word in words[1:9]], *map(float, words[9:]))
    return result


def print_row(title, row):
    count, classes, mean, most, least, greatest, ratio, worst = row
    if count == 0:
        return
    print(f"{title:26s} {count:9d} " + " ".join(f"{share:6.2f}" for share in classes) +
          f" {most:6.2f} {mean:6.3f} {least:7.2f} {greatest:7.2f} {ratio:7.4f} {worst:6.3f}", flush=True)


def mesh(options, case, folder, geometry, ranks):
    folder.mkdir()
    shutil.copytree(geometry, folder / "geometry")
    execute(*MPIRUN, ranks, options.build / "bin/cutwater-mesh", "--case", case, "--run", folder, "--cells",
            options.cells)
    return folder / "mesh"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", default="2M")
    parser.add_argument("--build", type=Path, default=SOURCE / "build")
    parser.add_argument("--case", type=Path, default=SOURCE / "cases/paper/case.yaml")
    parser.add_argument("--algorithm", default="del3d", help="of Gmsh: del3d, front3d, hxt")
    options = parser.parse_args()
    failures = []
    with tempfile.TemporaryDirectory(prefix="cutwater-table1-") as name:
        folder = Path(name)
        program = compile_program(options.build, folder)
        text = options.case.read_text()
        if "\nmesh:\n" not in text:
            sys.exit(f"table1: {options.case}: no mesh section")
        case = folder / "serial.yaml"
        serially = "\nmesh:\n  least_regions: 1\n  cells_per_region: 4000000\n  periodic_impeller: false\n"
        case.write_text(text.replace("\nmesh:\n", serially, 1))
        execute(options.build / "bin/cutwater-geometry", "--case", options.case, "--run", folder / "first")
        serial = mesh(options, case, folder / "serial", folder / "first/geometry", 1)
        numbered = mesh(options, options.case, folder / "numbered", folder / "first/geometry", 2)
        print(f"{'':26s} {'tets':>9s} " + " ".join(f"{label:>6s}" for label in CLASSES) +
              f" {'max':>6s} {'mean':>6s} {'least':>7s} {'most':>7s} {'ratio':>7s} {'worst':>6s}")
        for title, (classes, mean, most) in PAPER.items():
            print(f"{title:26s} {'':9s} " + " ".join(f"{share:6.2f}" for share in classes) +
                  f" {'':6s} {most:6.2f} {mean:6.3f}")
        found = {}
        for domain in DOMAINS:
            one, many = sorted(serial.glob(f"{domain}-*.h5")), sorted(numbered.glob(f"{domain}-*.h5"))
            if len(one) != 1:
                sys.exit(f"table1: the serial {domain} has {len(one)} regions; take fewer cells")
            found[domain] = shapes(program, one)["all"], shapes(program, many)
            print_row(f"{domain}, serial", found[domain][0])
            print_row(f"{domain}, {len(many)} regions", found[domain][1]["all"])
            print_row("  beside partition planes", found[domain][1]["beside"])
            print_row("  apart from them", found[domain][1]["apart"])
            execute(program, "region", one[0], folder / "surface.msh")
            run, made = run_gmsh(folder, folder / "surface.msh", 1, None, "-3", "-algo", options.algorithm)
            if not made.exists():
                sys.exit(f"table1: Gmsh failed on the {domain}:\n{run.text[-1000:]}")
            print_row(f"{domain}, Gmsh {options.algorithm}", shapes(program, [made])["all"])
            all_of, by_region = found[domain]
            comparisons = (("beside partition planes against the others", by_region["beside"], by_region["apart"],
                            0.05),
                           ("by region numbers against the serial mesh", by_region["all"], all_of, 0.02))
            for label, here, there, most in comparisons:
                aspect, ratio = here[2] / there[2] - 1, 1 - here[6] / there[6]
                print(f"  {label}: mean aspect {100 * aspect:+.2f} %, mean ratio {-100 * ratio:+.2f} %")
                if ratio > most:
                    failures.append(f"{domain}: {label}")
    for failure in failures:
        print(f"worse than allowed: {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
