#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""population.py [N] [--options] [--seed 1] [--only I ...] [--cells 150k] [--work DIR] [--bin build/bin] [--jobs 2]

Random pumps 1 to N (or --only some of them) through all stages, each judged; random_pumps.py says what is drawn. The
first is the duty alone (flow, head, speed, fluid); with --options most other keys of the case file are drawn too.

A pump is good when every stage ends with status 0 and
- its cells are within 2 % of those asked;
- no tetrahedron of a region has a dihedral angle under 12 degrees, or under what the region's boundary allows;
- the first height is met on 99 % of the faces of the walls, but where the mesher has said before that it does not fit
  the passage (first_height_from "fitted"), and beside edges of the wall of which it has said that they are too sharp;
- cgnscheck has no error, and checkMesh (-allGeometry -allTopology; every 8th pump, --check-mesh) no failed check
  but those of prisms that the exporter has warned of: prisms of a small determinant or a high aspect ratio, and faces
  of prisms with a high skewness, a small interpolation weight or a small volume ratio, or twisted.

Progress goes to the standard error. At the end: failures by stage and cause, numbers in the message as #, each with the
command that repeats one; then quantiles of the quality of all pumps that were meshed; then how many of them keep the
volumes of neighbours across the layer top within 4 on 95 % of its faces and within 10 on all, those apart of which the
mesher has said before that there are too few or too many layers. No pump is bad for that.

DIR keeps cases/ and results.jsonl, one line a pump; a second call with the same programs, limit, ranks and external
validators does only what is missing. Meshes are removed once judged (--keep: they stay, in DIR/runs).

With --strict the status is 1, and a line names the rule, where a pump is bad or fails after the geometry; where one by
its duty alone fails at all; where the geometry ends with anything but a refusal that names a key of the case; where
under 98 % of the pumps with options are good; or where cgnscheck or checkMesh is missing."""
import hashlib
import re
import shutil
import sys
import time
from collections import defaultdict

import random_pumps
from programs import SOURCE, execute, options_of
from runs import BIN, failed_checks, quality, record, rows_before, run_tasks, stage_line

STAGES = ("geometry", "mesh", "export")
COUNT_OFF = 0.02
LEAST_DIHEDRAL = 12.0  # degrees
FIRST_HEIGHT_MET = 0.99
RATIO_FAIR, RATIO_MOST, RATIO_SHARE = 4, 10, 0.95  # of the volumes across the layer top
GOOD_SHARE = 0.98  # least, of pumps with options
LAYERS_CROWD = r"^mesh\.cells \d+ for walls\.layer_count \d+.* leaves edges"
LAYERS_LACK = r"^\w+: \d+ of the \d+ layers that lead "
REFUSALS = (3, 6, 7)  # statuses of pipeline/status.h: wrong input, no design, no geometry
TIMED_OUT = "ran past the limit"
FIGURES = (("sharpest edge of the fluid, degrees", "fluid_edge", "{:.1f}"),
           ("sharpest edge of the walls, degrees", "wall_edge", "{:.1f}"),
           ("sharpest corner of a face, degrees", "corner", "{:.1f}"), ("cells over asked", "count", "{:.3f}"),
           ("least dihedral, degrees", "dihedral", "{:.1f}"),
           ("dihedral over its bound", "dihedral_over_bound", "{:.2f}"), ("mean aspect", "aspect", "{:.2f}"),
           ("greatest aspect", "aspect_most", "{:.1f}"), ("first height met", "first_height", "{:.3f}"),
           ("walls whose first height fits, share", "fit", "{:.2f}"),
           (f"layer top with volumes within {RATIO_FAIR}, share", "even", "{:.3f}"),
           ("greatest volume ratio across it", "volume_ratio", "{:.0f}"),
           ("greatest non-orthogonality, degrees", "non_orthogonality", "{:.1f}"), ("passes", "passes", "{:.0f}"),
           ("retries", "retries", "{:.0f}"), ("seconds", "seconds", "{:.1f}"))


def arguments(words=None):
    parser = options_of(__doc__, options=False, seed=1, cells="150k", work=SOURCE / "build/population", bin=BIN, jobs=2,
                        ranks=1, keep=False, strict=False)
    parser.add_argument("count", nargs="?", type=int, default=24, metavar="N")
    parser.add_argument("--only", type=int, nargs="+", metavar="I")
    parser.add_argument("--until", choices=STAGES, default=STAGES[-1], help="the last stage to run")
    parser.add_argument("--limit", type=float, default=600, help="seconds of a stage")
    parser.add_argument("--check-mesh", type=int, default=8, metavar="K", help="every K-th pump; 0: none")
    return parser.parse_args(words)


def programs_digest(folder):
    whole = hashlib.sha256()
    for stage in STAGES:
        whole.update((folder / f"cutwater-{stage}").read_bytes())
    return whole.hexdigest()[:16]


def repeat_command(options, index):
    words = ["tests/bench/population.py", *(["--options"] if options.options else []), f"--seed {options.seed}",
             f"--cells {options.cells}", "--check-mesh 1", f"--only {index}", "--keep"]
    return " ".join(words)


def run_stage(options, stage, case, run):
    line = stage_line(options.bin, stage, case, run, options.cells, options.ranks)
    return execute("timeout", options.limit, *line, check=False)


def stage_error(stage, done):
    """What a stage that failed said in its error line."""
    if done.status == 124:
        return TIMED_OUT
    told = [line for line in done.text.splitlines() if line.startswith(f"cutwater-{stage}: error: ")]
    if not told:
        return f"status {done.status} without a line that says why"
    more = f" (and {len(told) - 1} more lines)" if len(told) > 1 else ""
    return told[0].split(": error: ", 1)[1] + more


def cause(message, name):
    """A message without what differs from pump to pump."""
    message = re.sub(r"\S*/(\S+)", r"\1", message).replace(f"{name}.yaml", "case.yaml")
    message = re.sub(r"(?<![A-Za-z0-9_])[-+]?\d[\d.,]*(e[-+]?\d+)?", "#", message)
    return message[:300]


def judge_solids(run, figures):
    """The sharpest edges and the sharpest corner of the solids."""
    measured = record(run, "geometry")["results"]["measured"]
    for figure, key in (("fluid_edge", "sharpest_edge_of_fluid"), ("wall_edge", "sharpest_edge_of_wall"),
                        ("corner", "sharpest_corner")):
        figures[figure] = min(measured[domain][key]["angle_deg"] for domain in ("rotor", "stator"))


def judge_mesh(run, figures):
    """Fills in the figures of the mesher's record; what is bad of them."""
    made = record(run)
    results = made["results"]
    domains = results["domains"]
    regions = [region for domain in domains for region in domain["region_list"] if region["tetrahedra"]]
    walls = [wall for domain in domains for wall in domain["layer_coverage"]]
    faces = sum(wall["wall_faces"] for wall in walls)
    margin, worst = min((region["least_dihedral_deg"] - min(LEAST_DIHEDRAL, region["least_dihedral_allowed_deg"]),
                         number) for number, region in enumerate(regions))
    worst = regions[worst]
    figures.update(quality(results) | {
        "cells": results["cells"], "count": results["cells"] / results["asked_cells"], "passes": results["passes"],
        "retries": results["retries"],
        "dihedral": min(region["least_dihedral_deg"] for region in regions),
        "dihedral_over_bound": min(region["least_dihedral_deg"] / region["least_dihedral_allowed_deg"]
                                   for region in regions),
        "aspect_most": max(domain["tetrahedron_aspect_max"] for domain in domains),
        "volume_ratio": max(wall["volume_ratio_greatest"] for wall in walls),
        "full_thickness": sum(wall["full_thickness_faces"] for wall in walls) / faces,
        "warnings": made["warnings"]})
    fit = [(wall, domain["sharp_edge_deg"]) for domain in domains for wall in domain["layer_coverage"]
           if wall["first_height_from"] != "fitted"]
    fit_faces = sum(wall["wall_faces"] for wall, _ in fit)
    figures["fit"] = fit_faces / faces
    met = sum(wall["first_height_met_faces"] + (wall["first_height_missed_by_sharpness_faces"] if told_sharp else 0)
              for wall, told_sharp in fit)
    fit_met = met / fit_faces if fit else 1
    bad = []
    if abs(figures["count"] - 1) > COUNT_OFF:
        bad.append(f"count {100 * (figures['count'] - 1):+.1f} % off")
    figures["layers_told"] = any(re.search(f"{LAYERS_CROWD}|{LAYERS_LACK}", text) for text in results["headlines"])
    if margin < 0:
        bad.append(f"least dihedral {worst['least_dihedral_deg']:.2f} degrees "
                   f"(the boundary allows {worst['least_dihedral_allowed_deg']:.1f})")
    if fit_met < FIRST_HEIGHT_MET:
        bad.append(f"first height met on {100 * fit_met:.1f} %")
    return bad


def prisms_explain(line, zones):
    """Whether a failed check is of prisms and their faces alone, all of which the exporter has told of."""
    for pattern, key in ((r"(\d+) highly skew faces", "skew_faces_of_prisms"),
                         (r"small interpolation weight .*number of faces: (\d+)", "small_weight_faces_of_prisms"),
                         (r"small volume ratio .*number of faces: (\d+)", "small_volume_ratio_faces_of_prisms"),
                         (r"Error in face tets: (\d+) faces", "twisted_faces"),
                         (r"small determinant .*number of cells: (\d+)", "small_determinant_prisms"),
                         (r"High aspect ratio cells .*number of cells (\d+)", "high_aspect_ratio_prisms")):
        counted = re.search(pattern, line)
        if counted:
            return int(counted[1]) == sum(zone[key] for zone in zones)
    return False


def validators(options, index):
    """The external validators that judge the files of a pump."""
    if options.until != "export":
        return []
    return ["cgnscheck"] + ["checkMesh"] * bool(options.check_mesh and index % options.check_mesh == 0)


def judge_files(run, validators, figures):
    """What the exporter's record and these external validators say against the files, as far as they are installed."""
    results = record(run, "export")["results"]
    zones = [zone for zone in results.values() if isinstance(zone, dict) and "greatest_non_orthogonality_deg" in zone]
    figures["non_orthogonality"] = max(zone["greatest_non_orthogonality_deg"] for zone in zones)
    bad = []
    if "cgnscheck" in validators and shutil.which("cgnscheck"):
        errors = re.findall(r"^.*ERROR.*", execute("cgnscheck", run / "export/pump.cgns", check=False).text, re.M)
        bad += [f"cgnscheck: {errors[0].strip()}"] if errors else []
    if "checkMesh" in validators and shutil.which("checkMesh"):
        failed = failed_checks(run)
        figures["check_mesh"] = failed or ["Mesh OK"]
        bad += [f"checkMesh: {line}" for line in failed
                if not prisms_explain(line, zones)]
    return bad


def run_pump(options, index, result, case):
    run = options.work / "runs" / result["name"]
    shutil.rmtree(run, ignore_errors=True)
    began = time.monotonic()
    bad = []
    for stage in STAGES:
        done = run_stage(options, stage, case, run)
        result["seconds_by_stage"][stage] = round(done.wall, 2)
        if done.status:
            result.update(verdict="failed", stage=stage, status=done.status, message=stage_error(stage, done))
            break
        if stage == "geometry":
            judge_solids(run, result["figures"])
        if stage == "mesh":
            bad += judge_mesh(run, result["figures"])
        if stage == "export":
            bad += judge_files(run, validators(options, index), result["figures"])
        if stage == options.until:
            break
    if "verdict" not in result:
        result["figures"]["seconds"] = round(time.monotonic() - began, 2)
        result.update(verdict="bad" if bad else "good", bad=bad)
    if not options.keep:
        shutil.rmtree(run, ignore_errors=True)
    return result


def pump_case(options, index):
    """Name and file of a pump's case."""
    name = f"{'options' if options.options else 'duty'}-{options.seed}-{index}"
    path = options.work / "cases" / f"{name}.yaml"
    text = random_pumps.case_text(name, random_pumps.pump(options.seed, index, options.options))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return name, path, text


def row_key(options, index, digest, text):
    """Of all that a pump's verdict follows from."""
    installed = [name for name in validators(options, index) if shutil.which(name)]
    said = f"{digest} {options.cells} {options.until} {options.limit} {options.ranks} {installed} {text}"
    return hashlib.sha256(said.encode()).hexdigest()[:16]


def run_all(options):
    """The results of all asked pumps, those of earlier calls with the same key among them."""
    path, digest = options.work / "results.jsonl", programs_digest(options.bin)
    before = rows_before(path)
    asked = options.only or range(1, options.count + 1)
    results, waiting = {}, []
    for index in asked:
        name, case, text = pump_case(options, index)
        key = row_key(options, index, digest, text)
        if key in before and not options.keep:
            results[index] = before[key]
        else:
            result = {"key": key, "name": name, "index": index, "options": options.options, "seed": options.seed,
                      "cells": options.cells, "case": str(case), "seconds_by_stage": {}, "figures": {}}
            waiting.append((run_pump, options, index, result, case))
    for number, left, result in run_tasks(path, waiting, options.jobs):
        results[result["index"]] = result
        print(f"population: {number} of {len(waiting)}, {left:.0f} min left: {result['name']} {told(result)}",
              file=sys.stderr, flush=True)
    return [results[index] for index in asked]


def told(result):
    if result["verdict"] == "failed":
        return f"fails in {result['stage']}: {result['message']}"
    return "; ".join([result["verdict"], *result["bad"]])


def print_failures(options, results):
    groups = defaultdict(list)
    for result in results:
        if result["verdict"] == "failed":
            text = f"status {result['status']}: {cause(result['message'], result['name'])}"
            groups[result["stage"], text].append(result)
        for line in result.get("bad", ()):
            groups["judged bad", cause(line, result["name"])].append(result)
    order = (*STAGES, "judged bad")
    for (stage, text), group in sorted(groups.items(), key=lambda item: (order.index(item[0][0]), -len(item[1]))):
        print(f"{stage:<11}{len(group):>4}  {text}")
        print(f"{'':17}pumps {' '.join(str(result['index']) for result in group[:20])}"
              f"{' ...' if len(group) > 20 else ''}; {repeat_command(options, group[0]['index'])}")


def print_quantiles(results):
    meshed = [result["figures"] for result in results if result["figures"]]
    shares = (0, 0.05, 0.25, 0.5, 0.75, 0.95, 1)
    print(f"\n{'':44}" + "".join(f"{name:>9}" for name in ("least", "5 %", "25 %", "median", "75 %", "95 %", "most")))
    for text, key, form in FIGURES:
        values = sorted(figures[key] for figures in meshed if key in figures)
        if values:
            print(f"{text:44}" + "".join(f"{form.format(values[round(share * (len(values) - 1))]):>9}"
                                         for share in shares))


def print_ratios(results):
    """How many meshes keep the volumes across the layer top within the limits, and the largest ratio."""
    meshed = [result["figures"] for result in results if "even" in result["figures"]]
    heads = "meshes", f"{RATIO_FAIR} on {RATIO_SHARE:.0%}", f"and {RATIO_MOST}", "largest"
    print(f"\n{'volumes across the layer top':44}{heads[0]:>9}{heads[1]:>11}{heads[2]:>9}{heads[3]:>9}")
    for text, told in (("too few or too many layers told before", True), ("the others", False)):
        of = [figures for figures in meshed if figures["layers_told"] == told]
        fair = [figures for figures in of if figures["even"] >= RATIO_SHARE]
        within = [figures for figures in fair if figures["volume_ratio"] <= RATIO_MOST]
        verdict = "" if told or not of else "  held" if len(within) == len(of) else f"  {len(of) - len(within)} miss it"
        largest = format(max(figures["volume_ratio"] for figures in of), ".1f") if of else "-"
        print(f"{text:44}{len(of):9}{len(fair):11}{len(within):9}{largest:>9}{verdict}")


def is_refusal(result):
    """Whether a failure of the geometry is a refusal that names a key of the case."""
    message = result["message"]
    # A key without its section is no word of another meaning where it has an underscore.
    named = any(f"{section}.{key}" in message or ("_" in key and re.search(rf"\b{key}\b", message))
                for section, key in random_pumps.schema())
    return result["status"] in REFUSALS and named and "a fault of the program" not in message


def broken_rules(options, results):
    """What --strict holds against the results, a line each."""
    def pumps(found):
        return "pumps " + " ".join(str(result["index"]) for result in found)

    failed = [result for result in results if result["verdict"] == "failed"]
    asked = {name for result in results for name in validators(options, result["index"])}
    good = sum(result["verdict"] == "good" for result in results)
    rules = [("a pump is bad", [result for result in results if result["verdict"] == "bad"]),
             ("a pump fails after the geometry", [result for result in failed if result["stage"] != "geometry"]),
             ("a pump by its duty alone fails", [result for result in failed if not result["options"]]),
             ("the geometry ends with no refusal that names a key",
              [result for result in failed if result["stage"] == "geometry" and not is_refusal(result)])]
    lines = [f"{rule}: {pumps(found)}" for rule, found in rules if found]
    if options.options and good < GOOD_SHARE * len(results):
        lines.append(f"{100 * good / len(results):.1f} % of the pumps with options are good; asked: "
                     f"{100 * GOOD_SHARE:.0f} %")
    return lines + [f"{name} is not installed" for name in sorted(asked) if not shutil.which(name)]


def main():
    options = arguments()
    options.work = options.work.resolve()
    options.bin = options.bin.resolve()
    (options.work / "cases").mkdir(parents=True, exist_ok=True)
    results = run_all(options)
    verdicts = [result["verdict"] for result in results]
    stages = [result.get("stage") for result in results]
    by_stage = ", ".join(f"{stages.count(stage)} fail in {stage}" for stage in STAGES)
    print(f"{len(results)} pumps, {'with options' if options.options else 'duty only'}, seed {options.seed}, "
          f"{options.cells} cells: {verdicts.count('good')} good, {verdicts.count('bad')} judged bad, {by_stage}\n")
    for judge in (name for name in ("cgnscheck", "checkMesh") if not shutil.which(name)):
        print(f"not judged by {judge}, which is not installed (pipeline/packages.sh check)\n")
    print_failures(options, results)
    print_quantiles(results)
    print_ratios(results)
    broken = broken_rules(options, results) if options.strict else []
    for line in broken:
        print(f"population: --strict: {line}")
    sys.exit(bool(broken))


if __name__ == "__main__":
    main()
