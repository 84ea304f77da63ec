#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""measurements.py [SECTION ...] [--list] [--write-only]

Makes docs/measurements.md from the benches' own output. Each section is one command of tests/bench; all of them take
hours, so sections may be named to be measured anew (--list tells them). The page keeps the others, and marks those
that were measured on older sources (page.py). With --write-only nothing is measured."""
import argparse
import os
import platform
import re
import shlex
import subprocess
import sys
import time
from collections import namedtuple
from pathlib import Path

from page import SOURCE, Page, stamp

Section = namedtuple("Section", "title command text")

ABLATE = "tests/bench/ablate.py --pumps 29 --sizes 150k 600k --in-turn"
SECTIONS = {
    "scale": Section(
        "One pump, from 0.3 to 8 million cells", "tests/bench/scale.py 300k 1M 3M 8M --judge",
        "The paper's pump. `balance` is the cells of a region over their mean; `aspect` the mean of longest over "
        "shortest edge of the tetrahedra."),
    "scale_20M": Section("20 million cells", "tests/bench/scale.py 20M --judge", "The same; checkMesh takes 20 GB."),
    "large": Section(
        "100 and 145 million cells, killed and called again", "tests/bench/scale.py 100M 145M --kill",
        "The mesher is run again, all ranks are killed when half of the regions are whole, and it is called once more: "
        "its files must have the same bytes."),
    "scale_1G": Section(
        "A thousand million cells", "tests/bench/scale.py 1G --formats cgns --report --audit",
        "With CGNS alone and the report; the audit reads pump.cgns by HDF5 alone."),
    "cases": Section(
        "All cases at their own sizes", "tests/bench/cases.py",
        "The options print what the columns mean (`tests/bench/cases.py --help`)."),
    "cases_1M": Section("All cases at 300,000 and 1 million cells", "tests/bench/cases.py --cells 300k 1M", ""),
    "population": Section(
        "500 pumps by flow, head and speed", "tests/bench/population.py 500",
        "Drawn at random over the whole range of the case file (`tests/bench/population.py --help`)."),
    "population_options": Section(
        "500 pumps with options", "tests/bench/population.py 500 --options --check-mesh 1",
        "The same with blade counts, splitters, fillets, shafts, sections, zones and y+ targets drawn too."),
    "cad": Section(
        "Solids of CAD files of others", "tests/bench/cad.py --brief",
        "Each closed solid as a domain of its own, all its faces walls with five layers, beside gmsh's HXT without "
        "layers. The files are those of Debian's occt-misc, gmsh-doc, netgen-doc and freecad-common "
        "(`tests/bench/cad.py --help`). The environment variable CUTWATER_CAD names their folder; without it the "
        "section is passed over."),
    "ablation": Section(
        "What each number of the policy does", f"{ABLATE} --part together",
        "Effects of the numbers of `mesher/policy_table.h` on failures, quality, layers, count and time, by a "
        "screening design (`tests/bench/ablate.py --help`). Needs `make programs BUILD=build/experiment "
        "OPTIONS=-DCUTWATER_EXPERIMENT=ON`; takes hours, so it is measured only where it is named."),
    "ablation_off": Section(
        "What each number of the policy does: without it", f"{ABLATE} --part off",
        "The same pumps with each number switched off that can be, alone."),
    "region_rule": Section(
        "With the rule of region numbers and without it", "tests/bench/region_rule.py",
        "What the rule does to the interfaces of each case, and the tetrahedra beside them "
        "(`tests/bench/region_rule.py --help`). Needs the experimental build of `tests/bench/ablate.py`; measured only "
        "where it is named."),
    "rule_picture": Section(
        "The rule of region numbers at one place", "tests/bench/rule_picture.py",
        "Makes the picture of the rule in [mesher.md](mesher.md#region-rule). Needs the same build; "
        "measured only where it is named."),
    "table1": Section(
        "Table 1 of the paper: shapes of the tetrahedra, time and messages", "tests/bench/table1.py --cells 21M",
        "The paper's water body, the rotor alone, in six ways (`tests/bench/table1.py --help` says what rows and "
        "columns mean). Chew's algorithm runs on the mesher's own regions, layers and size field; its interfaces are "
        "split by the limits of distance that the rule has, and the lines round them stay as they are, as with the "
        "rule."),
    "table2": Section(
        "Table 2 of the paper: speed-up over ranks", "tests/bench/speedup.py --cells 21M --repeat 3",
        "1 and 2 ranks by the clock, in turn, the least of three; all further rows are a model, marked so, with "
        "messages of 2 us and 10 GB/s."),
    "table2_145M": Section(
        "Speed-up over ranks at 145 and 1,000 million cells", "tests/bench/speedup.py --cells 145M --scaled 1G",
        "The same; the table of 1,000 million cells is a model of task times that are scaled, not measured."),
    "memory": Section(
        "Memory of a rank", "tests/bench/memory.py",
        "Of mesher and exporter on 1 to 32 ranks of this machine, and a model that one size is held out of "
        "(`tests/bench/memory.py --help`)."),
    "whole_run": Section(
        "The whole run beside gmsh's HXT", "tests/bench/whole_run.py --cells 8M",
        "Geometry to CGNS and OpenFOAM, layers included, beside `gmsh -3 -algo hxt` on the same solids and cores, in "
        "turn; gmsh makes no layers, no interface and no solver's case."),
    "fill": Section(
        "Filling regions", "tests/bench/fill.py build --ring 0.0018 0.0009 --cores 1 --equal",
        "The kernel, TetGen behind the same call, and gmsh's HXT with as many cells (`hxt, =`), one core each, in "
        "turn."),
    "patch_mesh": Section("Triangles on a square", "tests/bench/patch_mesh.py", "Beside gmsh, one core."),
    "surface": Section("Triangles on the pump's walls", "tests/bench/surface.py --cells 2M", "Beside gmsh, one core."),
    "boundaries": Section(
        "500 random boundaries", "build/bin/mesher_test_hard_boundaries 500 1 1",
        "How the boundary of each was recovered; each fill is proven sound."),
    "periodic": Section("One passage beside the whole impeller", "tests/bench/periodic.py --cells 1M",
                        "Processor seconds on one rank."),
}

# What needs another build, and the largest.
ONLY_NAMED = {"ablation", "ablation_off", "region_rule", "rule_picture", "scale_1G"}
FOLDERS = {"cad": "CUTWATER_CAD"}  # of what is not in the repository, by the environment variable that names it
HEAD = """<!-- SPDX-License-Identifier: AGPL-3.0-or-later -->
<!-- Made by tests/bench/measurements.py (`make measurements`): change that, not this page. -->
# Measurements

Each section is the output of one command, on the commit that stands beside it. Terms stand in
[glossary.md](glossary.md), the method in [mesher.md](mesher.md). The machine is shared: compare programs within a
table, not seconds between tables.
"""
PAGE = Page(SOURCE / "docs/measurements.md", HEAD, {name: section.command for name, section in SECTIONS.items()},
            'make measurements SECTIONS="..."')


def machine():
    cpu = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{os.cpu_count()} cores ({cpu[1] if cpu else platform.machine()}), {memory:.0f} GiB"


def is_there(name):
    """Whether the folder that a section needs is there; if not, a line says so."""
    variable = FOLDERS.get(name)
    folder = os.environ.get(variable) if variable else SOURCE
    if folder and Path(folder).is_dir():
        return True
    print(f"measurements: {name}: passed over: {variable} names no folder; allowed: {variable}=FOLDER, of CAD files",
          file=sys.stderr, flush=True)
    return False


def measure(name):
    """Runs a section's command; the section as it stands in the page."""
    section = SECTIONS[name]
    print(f"measurements: {name}: {section.command}", file=sys.stderr, flush=True)
    began = time.monotonic()
    done = subprocess.run(shlex.split(section.command), cwd=SOURCE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          text=True)
    if done.returncode:
        sys.exit(f"measurements: {section.command} ended with {done.returncode}; the page is as it was")
    took = f"{machine()}, {(time.monotonic() - began) / 60:.0f} minutes"
    return PAGE.section(name, section.title, section.text, f"{stamp(section.command)}, {took}:",
                        f"```\n{done.stdout.rstrip()}\n```")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sections", nargs="*", metavar="SECTION")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--write-only", action="store_true", help="makes the page from what was measured before")
    options = parser.parse_args()
    if options.list:
        for name, section in SECTIONS.items():
            print(f"{name:20} {section.command}")
        return
    unknown = set(options.sections) - set(SECTIONS)
    if unknown:
        sys.exit(f"measurements: no section is called '{min(unknown)}'; allowed: {', '.join(SECTIONS)}")
    if options.write_only:
        PAGE.write({})
        return
    for name in options.sections or (name for name in SECTIONS if name not in ONLY_NAMED):
        if is_there(name):
            PAGE.write({name: measure(name)})


if __name__ == "__main__":
    main()
