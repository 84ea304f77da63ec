#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""ablate.py [--pumps 8 | --only I ...] [--cases paper ...] [--sizes 150k 600k] [--in-turn] [--factor 1.1]
          [--numbers NAME ...] [--part together | off | singly] [--work DIR] [--bin BUILD/bin] [--jobs 2] [--limit 120]

What each number of the mesher's policy does, over the first random pumps (random_pumps.py) and the named cases at each
size, or with --in-turn each pump at one of the sizes, in turn. BUILD is configured with -DCUTWATER_EXPERIMENT=ON.
Geometry is made once a pump; the mesher runs on one rank.

In the first table all numbers are moved at once, each by the factor to one side or the other, in a screening design
(screening.py), and in its opposite for half of the meshes. A row tells a number's effects: the mean with the number
times the factor, less the mean with it divided. The last column calls a number idle where no effect is 2.5 standard
errors or more, else it names those that are. In the second each number that can be switched off is, alone. A row tells
the differences to the pumps as they are.

--part makes one of the tables; singly: the second, in which each number is also moved alone, down and up.

A move stops at the value that switches a number off; whole numbers move by 1 at least. A run that ends with an error
is a failure, and has the means of its mesh in the other columns. DIR keeps results.jsonl, one line a run: a second call
with the same programs does only what is missing."""
import hashlib
import json
import math
import re
import shutil
import statistics
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

import random_pumps
from programs import ENVIRONMENT, SOURCE, execute, options_of
from runs import quality, record, rows_before, run_tasks, stage_line
from screening import design, effects, opposite, standard_error

# Of a run: key, heading, format. Time is that of the processor in tasks of the mesher, relative to the pump's mean.
FIGURES = (("failed", "failures %", "{:+.2f}", 100), ("dihedral", "dihedral deg", "{:+.2f}", 1),
           ("aspect", "aspect %", "{:+.2f}", 100), ("first_height", "first h. %", "{:+.2f}", 100),
           ("even", "even %", "{:+.2f}", 100), ("count", "count %", "{:+.2f}", 100),
           ("passes", "passes", "{:+.3f}", 1), ("time", "time %", "{:+.1f}", 100))
Mesh = namedtuple("Mesh", "name cells case geometry rows")  # rows: of the screening design
CLEAR = 2.5  # standard errors: one of 80 columns of noise is past them


def arguments(words=None):
    parser = options_of(__doc__, pumps=8, seed=1, factor=1.1, in_turn=False, jobs=2,
                        work=SOURCE / "build/ablate", bin=SOURCE / "build/experiment/bin")
    parser.add_argument("--only", type=int, nargs="*", metavar="I", help="these random pumps instead of the first")
    parser.add_argument("--cases", nargs="*", default=["paper"])
    parser.add_argument("--sizes", nargs="+", default=["150k", "600k"])
    parser.add_argument("--numbers", nargs="*")
    parser.add_argument("--part", choices=("together", "off", "singly"))
    parser.add_argument("--limit", type=float, default=120, help="seconds of a run; past it the run has failed")
    return parser.parse_args(words)


def policy_numbers(text):
    """name: (type, value, value that switches it off or None) of NUMBER(type, name, value, off, unit, meaning)."""
    row = r'NUMBER\(\s*(\w+), (\w+), ([-\w.+]+), ([-\w.+]+), "'
    return {name: (kind, float(value), None if off == "none" else float(off))
            for kind, name, value, off in re.findall(row, text)}


def moved(number, factor):
    """A number times the factor, no farther than where it is switched off."""
    kind, value, off = number
    there = value * factor
    if off is not None and min(value, there) <= off <= max(value, there):
        there = off
    if kind == "int64_t":
        there = round(there)
        if there == value and value != off:
            there = value + (1 if factor > 1 else -1)
    return there


def moved_together(numbers, factor, rows):
    """(label, {name: value}) of each run of the screening design."""
    return [(f"row {index}", {name: moved(numbers[name], factor**row[k]) for k, name in enumerate(numbers)})
            for index, row in enumerate(rows)]


def moved_alone(numbers, factor):
    """(label, {name: value}) of the pumps as they are, with each number moved by the factor, if any, and off."""
    single = [("as it is", {})]
    for name, number in numbers.items():
        if factor:
            single += [(f"{name}/{side}", {name: moved(number, by)})
                       for side, by in (("down", 1 / factor), ("up", factor))]
        if number[2] is not None:
            single.append((f"{name}/off", {name: number[2]}))
    return single


def figures_of(run):
    """The figures of one mesh, from the mesher's record."""
    results = record(run)["results"]
    shares = quality(results)
    return {"failed": 0, "dihedral": min(domain["least_dihedral_deg"] for domain in results["domains"]),
            **shares, "aspect": math.log(shares["aspect"]), "time": math.log(results["processor_seconds"]),
            "count": abs(results["cells"] / results["asked_cells"] - 1), "passes": results["passes"]}


def policy_of(run, setting):
    """What the environment of an experimental mesher says for these numbers, in a file of the run."""
    policy = run / "policy"
    policy.write_text("".join(f"{name} {value:.17g}\n" for name, value in setting.items()))
    return f"CUTWATER_POLICY={policy}"


def figures_with(options, mesh, setting):
    """Figures of a mesh with these numbers."""
    with tempfile.TemporaryDirectory(dir=options.work) as folder:
        run = Path(folder)
        (run / "geometry").symlink_to(mesh.geometry / "geometry")
        done = execute("env", policy_of(run, setting), "timeout", options.limit,
                       *stage_line(options.bin, "mesh", mesh.case, run, mesh.cells), check=False)
        if done.status:
            told = re.findall(r"error: (.*)", done.text)
            return {"failed": 1, "message": told[0][:200] if told else f"status {done.status}"}
        return figures_of(run)


def pumps_of(options):
    """(name, case file, folder of its geometry) of each pump that has one."""
    found = [(name, SOURCE / "cases" / name / "case.yaml") for name in options.cases]
    (options.work / "cases").mkdir(parents=True, exist_ok=True)
    for index in options.only or range(1, options.pumps + 1):
        name = f"duty-{options.seed}-{index}"
        path = options.work / "cases" / f"{name}.yaml"
        path.write_text(random_pumps.case_text(name, random_pumps.pump(options.seed, index, False)))
        found.append((name, path))
    made = []
    for name, case in found:
        folder = options.work / "geometry" / name
        if not (folder / "geometry/record.json").exists():
            shutil.rmtree(folder, ignore_errors=True)
            execute(*stage_line(options.bin, "geometry", case, folder), check=False)
        if (folder / "geometry/record.json").exists():
            made.append((name, case, folder))
    return made


def meshes_of(pumps, sizes, in_turn, rows):
    """Each pump at each size, or at one of them; the rows and their opposite in turn, at every size alike."""
    pairs = [(pump, size) for k, pump in enumerate(pumps)
             for size in ([sizes[k % len(sizes)]] if in_turn else sizes)]
    return [Mesh(name, cells, case, folder, opposite(rows) if m // len(sizes) % 2 else rows)
            for m, ((name, case, folder), cells) in enumerate(pairs)]


def run_all(options, work):
    """Figures by (mesh's name, cells, label) of (mesh, label, setting), those of earlier calls among them."""
    digest = hashlib.sha256((options.bin / "cutwater-mesh").read_bytes()).hexdigest()[:16]
    path = options.work / "results.jsonl"
    before = rows_before(path)
    results, waiting = {}, []

    def row(key, place, mesh, setting):
        return {"key": key, "place": place, "figures": figures_with(options, mesh, setting)}

    for mesh, label, setting in work:
        text = json.dumps([digest, mesh.case.read_text(), mesh.cells, sorted(setting.items())])
        key = hashlib.sha256(text.encode()).hexdigest()[:20]
        place = (mesh.name, mesh.cells, label)
        if key in before:
            results[place] = before[key]["figures"]
        else:
            waiting.append((row, key, place, mesh, setting))
    for number, left, made in run_tasks(path, waiting, options.jobs):
        results[made["place"]] = made["figures"]
        if number % 50 == 0:
            print(f"ablate: {number} of {len(waiting)}, {left:.0f} min left", file=sys.stderr, flush=True)
    return results


def responses(results, mesh, labels, key):
    """A mesh's figure at each label, where it failed its mean over the others; None where it has none."""
    values = [results[mesh.name, mesh.cells, label].get(key) for label in labels]
    known = [value for value in values if value is not None]
    return [statistics.fmean(known) if value is None else value for value in values] if known else None


def table_of(results, meshes, labels, turned):
    """For each figure the means over all meshes of what `turned` makes of a mesh and its figure at each label."""
    table = []
    for key, _, _, _ in FIGURES:
        found = [(mesh, responses(results, mesh, labels, key)) for mesh in meshes]
        found = [turned(mesh, values) for mesh, values in found if values]
        table.append([statistics.fmean(column) for column in zip(*found)])
    return table


def print_heading():
    print(f"{'':24}{'value':>10}" + "".join(f"{heading:>14}" for _, heading, _, _ in FIGURES))


def print_row(name, value, row, last=""):
    print(f"{name:24}{value:>10}" + "".join(f"{form.format(scale * x):>14}"
                                            for x, (_, _, form, scale) in zip(row, FIGURES)) + "  " + last)


def print_screening(numbers, table):
    """table: for each figure the effects of all columns."""
    errors = [standard_error(column[len(numbers):]) for column in table]
    print_heading()
    print_row("standard error", "", errors)
    for k, (name, number) in enumerate(numbers.items()):
        row = [column[k] for column in table]
        clear = [heading for x, error, (_, heading, _, _) in zip(row, errors, FIGURES)
                 if abs(x) >= CLEAR * error and x != 0]
        print_row(name, f"{number[1]:g}", row, ", ".join(clear) or "idle")


def print_singly(labels, table):
    print_heading()
    for m, label in enumerate(labels[1:], 1):
        print_row(label, "", [column[m] - column[0] for column in table])


def main():
    options = arguments()
    options.work, options.bin = options.work.resolve(), options.bin.resolve()
    ENVIRONMENT.pop("CUTWATER_POLICY", None)
    listed = policy_numbers((SOURCE / "mesher/policy_table.h").read_text())
    unknown = set(options.numbers or ()) - set(listed)
    if unknown:
        sys.exit(f"ablate.py: no number {min(unknown)}; there are {', '.join(listed)}")
    numbers = {name: listed[name] for name in options.numbers or listed}
    rows = design(len(numbers)) if options.part in (None, "together") else []
    pumps = pumps_of(options)
    meshes = meshes_of(pumps, options.sizes, options.in_turn, rows)
    alone = moved_alone(numbers, options.factor if options.part == "singly" else None)
    alone = [] if options.part == "together" else alone
    work = [(mesh, label, setting) for mesh in meshes
            for label, setting in moved_together(numbers, options.factor, mesh.rows) + alone]
    results = run_all(options, work)
    failed = sum(figures["failed"] for figures in results.values())
    if failed == len(work):
        sys.exit(f"ablate.py: no mesh was made: {next(iter(results.values()))['message']}")
    print(f"{len(numbers)} numbers, factor {options.factor:g}; {len(pumps)} pumps at {', '.join(options.sizes)} cells"
          f"{' in turn' if options.in_turn else ''}: {' '.join(name for name, _, _ in pumps)}; "
          f"{len(rows) + len(alone)} settings, {failed} meshes failed of {len(work)}\n")
    if rows:
        labels = [f"row {index}" for index in range(len(rows))]
        print_screening(numbers, table_of(results, meshes, labels, lambda mesh, values: effects(mesh.rows, values)))
        print()
    if alone:
        print("Moved, and switched off, each alone:\n" if options.part == "singly" else "Switched off, each alone:\n")
        labels = [label for label, _ in alone]
        print_singly(labels, table_of(results, meshes, labels, lambda mesh, values: values))


if __name__ == "__main__":
    main()
