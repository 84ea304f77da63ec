#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Table 1 of the paper again, with time and messages beside the shapes of the tetrahedra.

  tests/bench/table1.py [--cells 2M] [--regions 24] [--build build] [--case cases/paper/case.yaml] [--domains rotor]
    [--ranks 2] [--radius R] [--ratio B] [--algorithms del3d hxt] [--limit 3600]

Each domain is meshed alone, with --cells cells: prisms and tetrahedra, within 2 %. --regions is what the rows of
several regions are divided into; the paper ran on up to 24 cores, a region each.

The rows of several regions have the same walls, layers and partition planes. Those of one region have walls and layers
of their own, for as many cells: no curve of a partition plane cuts their walls. The impeller is meshed whole, since the
other rows have no periodic images.

  serial       one region, one rank, by the mesher
  proposed     the mesher's regions, by the rule of region numbers
  Chew         the same regions by Delaunay refinement, interfaces split from both sides (L. P. Chew, N. Chrisochoides,
               F. Sukup, 1997; tests/measure/chew_points.h) to about as many tetrahedra, and the fill's improvement
  Chew, one    that refinement in one region: what it makes where there are no interfaces
  Gmsh         its own sizes, inside the layer top of the serial row

The classes are shares of the tetrahedra by longest over shortest edge, %. `beside` are the tetrahedra with a corner on
a partition plane, `apart` the others. Seconds are of the processor, summed over the ranks, from the finished surfaces
to the finished tetrahedra (`wall`: by the clock; Gmsh: its own steps). Messages and bytes are those between regions,
each on a rank of its own; `sent`, those between the ranks of this run. The mesher itself sends the refined interfaces
to all ranks. Fails where the mean ratio of the tetrahedra beside is worse in the mean than that of the others by more
than 5 %, or that of the proposed mesh worse than that of the serial one by more than 2 %, or where a mesh has
another number of cells or regions than asked."""
import json
import shutil
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

from fill import run_gmsh
from programs import MPIRUN, SOURCE, execute, gmsh_steps, options_of
from runs import PAPER_CASE, domain_alone, needs, with_key

CLASSES = ["1-1.5", "1.5-2", "2-3", "3-4", "4-5", "5-7", "7-10", ">10"]
PAPER = {"paper, serial (Gmsh)": ([4.5, 43.3, 32.2, 8.5, 7.3, 3.5, 0.7], 2.90, 8.6),
         "paper, proposed": ([4.0, 43.1, 30.5, 10.1, 8.2, 3.0, 1.1], 2.98, 8.8),
         "paper, Chew": ([3.0, 40.1, 31.2, 11.5, 7.6, 4.1, 1.5], 3.12, 9.4)}

NEAR = 0.02  # of the asked number of cells
REGION_MOST = "4M"  # cells: the most that the case allows, so that --regions decides

Shapes = namedtuple("Shapes", "count classes mean most least greatest ratio worst")


def shapes(program, files):
    """By group: number, shares of the classes in %, mean and greatest aspect, angles, mean ratio mean and least."""
    result = {}
    for line in execute(program, "shape", *files).text.splitlines():
        name, *words = line.split()
        count = int(words[0])
        result[name] = Shapes(count, [100 * int(word) / max(count, 1) for word in words[1:9]], *map(float, words[9:]))
    return result


def seconds_of(figures):
    return figures["interface_seconds"] + figures["refine_seconds"] + figures["fill_seconds"]


def print_row(title, row, figures=None, gmsh=None):
    if row.count == 0:
        return
    text = (f"{title:24s} {row.count:9d} " + " ".join(f"{share:6.2f}" for share in row.classes) +
            f" {row.most:6.2f} {row.mean:6.3f} {row.least:7.2f} {row.greatest:7.2f} {row.ratio:7.4f} {row.worst:6.3f}")
    if figures:
        text += (f" {seconds_of(figures):8.1f} {figures['wall_seconds']:7.1f} {figures['messages']:8d} "
                 f"{figures['bytes']:10d} {figures['sent_messages']:6d} {figures['sent_bytes']:9d}")
    if gmsh is not None:
        text += f" {gmsh:8.1f}"
    print(text, flush=True)


def print_head():
    print(f"{'':24s} {'tets':>9s} " + " ".join(f"{label:>6s}" for label in CLASSES) +
          f" {'max':>6s} {'mean':>6s} {'least':>7s} {'most':>7s} {'ratio':>7s} {'worst':>6s} {'seconds':>8s} "
          f"{'wall':>7s} {'messages':>8s} {'bytes':>10s} {'sent':>6s} {'bytes':>9s}")
    for title, (classes, mean, most) in PAPER.items():
        print(f"{title:24s} {'':9s} " + " ".join(f"{share:6.2f}" for share in classes) +
              f" {'':6s} {most:6.2f} {mean:6.3f}")


def mesh(options, case, folder, geometry, ranks, domain, *more):
    """The run of a case, and what both ways took in the domain; what an earlier domain has left is taken up."""
    if not folder.exists():
        folder.mkdir()
        shutil.copytree(geometry, folder / "geometry")
    execute(*MPIRUN, ranks, options.build / "bin/chew", "--case", case, "--run", folder, "--cells", options.cells,
            "--domain", domain, "--ratio", options.ratio,
            *(("--radius", options.radius) if options.radius else ()), *more)
    return json.loads((folder / f"chew/{domain}.json").read_text())


def missed(options, title, run, domain, regions):
    """Prints how many cells and regions a mesh has; what is not as asked."""
    listed = json.loads((run / "mesh/manifest.json").read_text())["domains"][0]["regions"]
    cells = sum(region[kind] for region in listed for kind in ("tetrahedra", "prisms"))
    off = cells / needs.read_count(options.cells) - 1
    print(f"  {title}: {cells:,} cells, {100 * off:+.2f} % off those asked; regions: {len(listed)}", flush=True)
    return [f"{domain}, {title}: {what}" for what, wrong in
            (("cells", abs(off) > NEAR), (f"{len(listed)} regions for {regions}", len(listed) != regions)) if wrong]


def regions_of(folder, domain):
    return sorted(folder.glob(f"{domain}-*.h5"))


def print_way(title, figures, radius=None):
    """Where the seconds of a row went, and what its interfaces came to."""
    print(f"  {title}: {figures['interface_seconds']:.1f} s at interfaces, {figures['refine_seconds']:.1f} s for inner "
          f"points, {figures['fill_seconds']:.1f} s to fill; {figures['rounds']} rounds; {figures['inserted']} "
          f"interface points, {figures['refused']} triangles still encroached" +
          (f"; radius {radius:.3f} h" if radius else ""))


def compare(title, here, there):
    """Shares by which one row differs from another."""
    print(f"  {title}: mean aspect {100 * (here.mean / there.mean - 1):+.2f} %, mean ratio "
          f"{100 * (here.ratio / there.ratio - 1):+.2f} %, greatest aspect {here.most:.2f} for {there.most:.2f}, least "
          f"angle {here.least:.2f} for {there.least:.2f}")


VERDICT = (  # what, of figures, shapes by group and shapes of one region, and which is better
    ("seconds a million tetrahedra", lambda of, *_: 1e6 * seconds_of(of) / of["tetrahedra"], min),
    ("  of these at interfaces", lambda of, *_: 1e6 * of["interface_seconds"] / of["tetrahedra"], min),
    ("rounds", lambda of, *_: of["rounds"], min),
    ("messages", lambda of, *_: of["messages"], min),
    ("bytes", lambda of, *_: of["bytes"], min),
    ("mean aspect", lambda _, shape, one: shape["all"].mean, min),
    ("mean aspect beside partition planes", lambda _, shape, one: shape["beside"].mean, min),
    ("mean aspect beside over apart", lambda _, shape, one: shape["beside"].mean / shape["apart"].mean, min),
    ("mean aspect over that of one region", lambda _, shape, one: shape["all"].mean / one.mean, min),
    ("greatest aspect", lambda _, shape, one: shape["all"].most, min),
    ("mean ratio", lambda _, shape, one: shape["all"].ratio, max),
    ("mean ratio beside partition planes", lambda _, shape, one: shape["beside"].ratio, max),
    ("least mean ratio", lambda _, shape, one: shape["all"].worst, max),
    ("least angle, degrees", lambda _, shape, one: shape["all"].least, max),
)


def print_verdict(rule, chew):
    """Where the rule wins over Chew's algorithm in the same regions, and where it does not."""
    print(f"  {'':40s} {'proposed':>10s} {'Chew':>10s}  better")
    for title, value, better in VERDICT:
        here, there = value(*rule), value(*chew)
        winner = "neither" if here == there else "proposed" if better(here, there) == here else "Chew"
        print(f"  {title:40s} {here:10.5g} {there:10.5g}  {winner}")


def gmsh_rows(options, folder, program, domain, surface):
    for algorithm in options.algorithms:
        run, made = run_gmsh(folder, surface, 1, None, "-3", "-algo", algorithm, limit=options.limit)
        if not made.exists():
            print(f"{domain}, Gmsh {algorithm}: no mesh in {options.limit} s, or none at all: "
                  f"{' '.join(run.text.split()[-12:])}", flush=True)
            continue
        steps = gmsh_steps(run.text)
        print_row(f"{domain}, Gmsh {algorithm}", shapes(program, [made])["all"],
                  gmsh=steps.get("meshing 3D", 0) + steps.get("optimizing mesh", 0))


def table(options, folder, program, case, geometry, domain):
    """Prints the rows of a domain; what falls short."""
    serial, numbered = folder / "serial", folder / "numbered"
    alone = mesh(options, case, serial, geometry, 1, domain, "--undivided")
    both = mesh(options, case, numbered, geometry, options.ranks, domain)
    one, many = regions_of(serial / "mesh", domain), regions_of(numbered / "mesh", domain)
    failures = (missed(options, "serial", serial, domain, 1) +
                missed(options, "proposed", numbered, domain, options.regions))
    by_one = shapes(program, one)["all"]
    by_rule, by_chew = shapes(program, many), shapes(program, regions_of(numbered / "chew", domain))
    print_row(f"{domain}, serial", by_one, alone["rule"])
    for title, row, figures in (("proposed", by_rule, both["rule"]), ("Chew", by_chew, both["chew"])):
        print_row(f"{domain}, {title}, {len(many)} regions", row["all"], figures)
        print_row("  beside partition planes", row["beside"])
        print_row("  apart from them", row["apart"])
    chew_one = shapes(program, regions_of(serial / "chew", domain))["all"]
    print_row(f"{domain}, Chew, one", chew_one, alone["chew"])
    execute(program, "region", one[0], folder / "surface.msh")
    gmsh_rows(options, folder, program, domain, folder / "surface.msh")
    print_way("serial", alone["rule"])
    print_way("proposed", both["rule"])
    print_way("Chew", both["chew"], both["radius"])
    print_way("Chew, one", alone["chew"], alone["radius"])
    print_verdict((both["rule"], by_rule, by_one), (both["chew"], by_chew, chew_one))
    for title, here, there, most in (("beside partition planes against the others", by_rule["beside"],
                                      by_rule["apart"], 0.05),
                                     ("proposed against serial", by_rule["all"], by_one, 0.02)):
        compare(title, here, there)
        if 1 - here.ratio / there.ratio > most:
            failures.append(f"{domain}: {title}")
    return failures


def main():
    parser = options_of(__doc__, cells="2M", regions=24, build=SOURCE / "build", case=PAPER_CASE, ranks=2)
    parser.add_argument("--domains", nargs="*", default=["rotor"])
    parser.add_argument("--radius", type=float, help="of Chew's spheres, in h; else as many tetrahedra as proposed")
    parser.add_argument("--ratio", type=float, default=1.4, help="of these to the shortest edge")
    parser.add_argument("--algorithms", nargs="*", default=["del3d", "hxt"], help="of Gmsh: del3d, front3d, hxt")
    parser.add_argument("--limit", type=int, default=3600, help="seconds for a run of Gmsh")
    options = parser.parse_args()
    failures = []
    with tempfile.TemporaryDirectory(prefix="cutwater-table1-") as name:
        folder = Path(name)
        program = options.build / "bin/fill"
        execute(options.build / "bin/cutwater-geometry", "--case", options.case, "--run", folder / "first")
        case = folder / "case.yaml"
        text = options.case.read_text()
        for key, value in (("periodic_impeller", "false"), ("least_regions", options.regions),
                           ("cells_per_region", REGION_MOST)):
            text = with_key(text, "mesh", key, value)
        case.write_text(text)
        print_head()
        for domain in options.domains:
            own = folder / domain
            domain_alone(options.build / "bin", folder / "first/geometry", domain, own / "geometry")
            failures += table(options, own, program, case, own / "geometry", domain)
    for failure in failures:
        print(f"worse than allowed: {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
