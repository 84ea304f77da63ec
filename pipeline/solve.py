#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""solve.py --case FILE --run RUN [--ranks 2] [--bin build/bin] [--most 4000] [--within 0.003] [--fresh]

Solves the steady flow (frozen rotor) of a finished run with OpenFOAM until head and torque have settled, into RUN/solve:

  coarse/       the same pump with an eighth of the cells, made and solved first the same way, for the start of the fine
  steady/       the OpenFOAM case: its latest time holds the solved fields
  history.csv   head, torque and residuals by iteration
  record.json   what came out

A quantity has settled when what is left of its way is less than WITHIN of it. What is left is estimated from the means of
the last three windows of iterations by Aitken's delta-squared process (A. C. Aitken, 1926): with the changes d1, d2 from
window to window and q = d2 / d1, d2 q / (1 - q) is left where 0 < q < 1; else, where the means go to and fro, d2 counts.
A window is as long as fluid takes from inlet to outlet in iterations, but no less than WINDOW_LEAST of them, so that a
slow drift is not taken for rest. Where residuals of p stay above 1e-4 the steady equations have no such state, and means
and scatter of the last window are the result.

A killed call goes on where it was; other files of the export begin anew. A flow that has not settled after MOST iterations
is told as such, in the headline and as a warning of the record."""
import argparse
import csv
import json
import math
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

WINDOW_LEAST = 100     # iterations
LOOK_EVERY = 2.0       # s between looks at the solver's reports
COARSE_SHARE = 8       # the start has an eighth of the cells: half the resolution along each axis
COARSE_LEAST = 30000   # cells; meshes of less start from rest
FINE_WITHIN = 3        # a start need not have settled more closely than this times WITHIN
GRAVITY = 9.80665      # m/s2, standard
RESIDUAL_ASKED = 1e-4   # of p, as the paper has it
HISTORY = ("iteration", "head_m", "torque_n_m", "residual_p", "residual_u")
PROGRAMS = ("simpleFoam", "decomposePar", "reconstructPar", "mapFields", "foamDictionary", "renumberMesh")
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
               "WM_PROJECT_DIR": os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam")}


class Trouble(Exception):
    """Ends the stage with one line."""


def say(text):
    print(f"cutwater-solve: {text}", file=sys.stderr, flush=True)


def read_record(run, stage):
    path = run / stage / "record.json"
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise Trouble(f"{path}: {error}; run the stage `{stage}` first (make does)") from error


def write_whole(path, text):
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    part.write_text(text)
    part.replace(path)


def call(folder, log, *line):
    """Runs a program to its end, its words into folder/log.NAME."""
    words = [str(word) for word in line]
    with open(folder / log, "w", encoding="utf-8") as out:
        status = subprocess.run(words, cwd=folder, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=out,
                                stderr=subprocess.STDOUT, check=False).returncode
    if status:
        raise Trouble(f"{words[0]} ended with {status}: see {folder / log}")


def set_entry(folder, file, entry, value):
    subprocess.run(["foamDictionary", "-entry", entry, "-set", str(value), file], cwd=folder, env=ENVIRONMENT,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)


# The case -------------------------------------------------------------------------------------------------------------

def times(folder):
    """The times that a case folder has fields of, ascending."""
    found = [path.name for path in folder.iterdir() if path.is_dir() and re.fullmatch(r"\d+(\.\d+)?", path.name)]
    return sorted(found, key=float)


def prepare(run, ranks, coarse):
    """The case folder, decomposed and with its start; as an earlier call left it where that was of the same export."""
    case, export = run / "solve/steady", run / "export"
    mark = json.dumps({"export": read_record(run, "export")["results"], "ranks": ranks}, sort_keys=True)
    kept = case / "made_from.json"
    if kept.exists() and kept.read_text() == mark:
        return case
    shutil.rmtree(case, ignore_errors=True)
    case.mkdir(parents=True)
    for name in ("0", "system"):
        shutil.copytree(export / "openfoam" / name, case / name)
    shutil.copytree(export / "openfoam/constant", case / "constant", ignore=shutil.ignore_patterns("polyMesh"))
    (case / "constant/polyMesh").symlink_to((export / "openfoam/constant/polyMesh").resolve())
    if coarse:
        call(case, "log.mapFields", "mapFields", coarse.resolve(), "-consistent", "-sourceTime", "latestTime", "-mapMethod",
             "mapNearest")
    if ranks > 1:
        set_entry(case, "system/decomposeParDict", "numberOfSubdomains", ranks)
        set_entry(case, "system/decomposeParDict", "coeffs/n", f"({ranks} 1 1)")
        call(case, "log.decomposePar", "decomposePar", "-force")
        call(case, "log.renumberMesh", "mpirun", "-n", ranks, "renumberMesh", "-parallel", "-overwrite")
    write_whole(kept, mark)
    return case


# What the solver reports ----------------------------------------------------------------------------------------------

def columns(case, name, file):
    """Rows (iteration, words) of a function object's files, those of later starts after the others."""
    rows = {}
    folder = case / "postProcessing" / name
    for start in sorted(folder.iterdir(), key=lambda path: float(path.name)) if folder.is_dir() else ():
        for path in sorted(start.glob(file)):
            for line in path.read_text().splitlines():
                words = line.replace("(", " ").replace(")", " ").split()
                if words and not line.startswith("#"):
                    rows[int(float(words[0]))] = words[1:]
    return rows


def history(case):
    """By iteration: head (m), torque (N m), and the initial residuals of p and of U (their greatest)."""
    heads, torques = columns(case, "head", "fieldValueDelta.dat"), columns(case, "torque", "moment.dat")
    table = {}
    for iteration in sorted(heads.keys() & torques.keys()):
        try:
            table[iteration] = {"head_m": float(heads[iteration][0]), "torque_n_m": -float(torques[iteration][2])}
        except (ValueError, IndexError):
            continue  # a line that is being written
    residuals = residual_columns(case)
    for iteration, row in table.items():
        row.update(residuals.get(iteration, {}))
    return table


def residual_columns(case):
    found = {}
    folder = case / "postProcessing/solverInfo"
    for start in sorted(folder.iterdir(), key=lambda path: float(path.name)) if folder.is_dir() else ():
        for path in start.glob("solverInfo.dat"):
            names = []
            for line in path.read_text().splitlines():
                words = line.lstrip("# ").split()
                if line.startswith("#"):
                    names = words if words and words[0] == "Time" else names
                elif len(words) == len(names):
                    row = dict(zip(names, words))
                    found[int(float(row["Time"]))] = {
                        "residual_p": float(row["p_initial"]),
                        "residual_u": max(float(row[f"U{axis}_initial"]) for axis in "xyz")}
    return found


def windows(table, key, length):
    """Means of the last three windows, oldest first, and the scatter (half the range) of the last; None before that."""
    iterations = sorted(table)
    if not iterations or iterations[-1] - iterations[0] < 3 * length:
        return None
    last, means = iterations[-1], []
    for back in (2, 1, 0):
        part = [table[i][key] for i in iterations if last - (back + 1) * length < i <= last - back * length]
        if not part:
            return None
        means.append(sum(part) / len(part))
    return means, (max(part) - min(part)) / 2


def left_of_way(means):
    """How far a quantity has still to go, from three means."""
    first, second = means[1] - means[0], means[2] - means[1]
    ratio = second / first if first else 0.0
    if not 0 < ratio < 1:
        return abs(second)
    return abs(second * ratio / (1 - ratio))


def settled(table, length, within):
    """(whether head and torque have settled, share of its way that either has left at the most)."""
    worst = 0.0
    for key in ("head_m", "torque_n_m"):
        found = windows(table, key, length)
        if not found:
            return False, math.inf
        worst = max(worst, left_of_way(found[0]) / max(abs(found[0][-1]), 1e-300))
    return worst <= within, worst


# The run --------------------------------------------------------------------------------------------------------------

def stop_solver(child):
    """Ends the solver and all its ranks."""
    try:
        os.killpg(child.pid, signal.SIGTERM)
        child.wait(20)
    except (ProcessLookupError, subprocess.TimeoutExpired):
        try:
            os.killpg(child.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        child.wait()


def progress(table, most, length, began, first, name):
    iteration = max(table)
    row = table[iteration]
    rate = (iteration - first) / max(time.monotonic() - began, 1e-3)
    left = settled(table, length, 0)[1]
    way = f"{100 * left:.2f} % of its way left" if math.isfinite(left) else "before the third window"
    residual = f", p {row['residual_p']:.1e}" if "residual_p" in row else ""
    minutes = (most - iteration) / rate / 60 if rate > 0 else math.inf
    say(f"{name}: iteration {iteration} of {most} at most, {rate:.2f} a second: head {row['head_m']:.3f} m, torque "
        f"{row['torque_n_m']:.4g} N m{residual}; {way}; at most {minutes:.0f} min left")


def iterate(case, ranks, most, within, length, name):
    """Runs the solver until it has settled or `most` iterations are done; its history."""
    set_entry(case, "system/controlDict", "endTime", most)
    set_entry(case, "system/controlDict", "stopAt", "endTime")
    table = history(case)
    if settled(table, length, within)[0]:
        return table
    first, began, told = max(table, default=0), time.monotonic(), time.monotonic()
    line = ["mpirun", "-q", "--bind-to", "none", "-n", str(ranks), "simpleFoam", "-parallel"] if ranks > 1 else [
        "simpleFoam"]
    stopping = False
    with open(case / "log.simpleFoam", "a", encoding="utf-8") as out:
        child = subprocess.Popen(line, cwd=case, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=out,
                                 stderr=subprocess.STDOUT, start_new_session=True)
        try:
            while child.poll() is None:
                time.sleep(LOOK_EVERY)
                table = history(case)
                if table and any(not math.isfinite(row["head_m"]) or abs(row["head_m"]) > 1e6 for row in table.values()):
                    raise Trouble(f"the flow diverges at iteration {max(table)}: see {case / 'log.simpleFoam'}; try "
                                  "walls.y_plus targets that fit the mesh, more cells, or relaxationFactors of U 0.5 in "
                                  f"{case / 'system/fvSolution'}")
                if table and max(table) > first and time.monotonic() - told > 10:
                    progress(table, most, length, began, first, name)
                    told = time.monotonic()
                if not stopping and settled(table, length, within)[0]:
                    set_entry(case, "system/controlDict", "stopAt", "writeNow")
                    stopping = True
        except BaseException:
            stop_solver(child)
            raise
    if child.returncode:
        tail = [text for text in (case / "log.simpleFoam").read_text().splitlines() if text.strip()]
        fatal = next((text for text in reversed(tail) if "FOAM FATAL" in text or "Floating" in text), "")
        raise Trouble(f"simpleFoam ended with {child.returncode} {fatal}: see {case / 'log.simpleFoam'}; a flow that "
                      "diverges wants more cells or smaller relaxationFactors in system/fvSolution")
    return history(case)


def write_history(path, table):
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    with open(part, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, HISTORY)
        writer.writeheader()
        writer.writerows({"iteration": iteration, **row} for iteration, row in sorted(table.items()))
    part.replace(path)


def y_plus(case):
    """Least, mean and greatest y+ of each wall, of the last report."""
    rows = {}
    folder = case / "postProcessing/yPlus"
    for start in sorted(folder.iterdir(), key=lambda path: float(path.name)) if folder.is_dir() else ():
        for line in (start / "yPlus.dat").read_text().splitlines():
            words = line.split()
            if words and not line.startswith("#") and len(words) >= 5:
                rows[words[1]] = {"least": float(words[2]), "most": float(words[3]), "mean": float(words[4])}
    return rows


def result_of(run, case, table, length, within):
    """What came out, as record.json keeps it."""
    entered = read_record(run, "export")["case"]
    density, flow = entered["fluid.density_kg_per_m3"], entered["operating_point.flow_rate_m3_per_h"] / 3600
    omega = entered["operating_point.speed_rpm"] * math.pi / 30
    done, left = settled(table, length, within)
    heads, torques = windows(table, "head_m", length), windows(table, "torque_n_m", length)
    last = table[max(table)]
    rows = [{"iteration": iteration, **row} for iteration, row in sorted(table.items())]
    head = heads[0][-1] if heads else last["head_m"]
    torque = torques[0][-1] if torques else last["torque_n_m"]
    power = torque * omega
    return {"settled": done, "iterations": max(table), "window_iterations": length,
            "left_of_way": left if math.isfinite(left) else None, "within": within,
            "head_m": head, "head_scatter_m": heads[1] if heads else None,
            "torque_n_m": torque, "torque_scatter_n_m": torques[1] if torques else None, "shaft_power_w": power,
            "hydraulic_efficiency": density * GRAVITY * flow * head / power if power > 0 else None,
            "residual_p": last.get("residual_p"), "residual_u": last.get("residual_u"),
            "cells": read_record(run, "export")["results"]["cells"], "y_plus": y_plus(case),
            "history": {key: [row[key] if key in row else None for row in rows] for key in HISTORY}}


def record_of(result, seconds):
    """record.json, in the form of the other stages."""
    warnings = []
    if not result["settled"]:
        warnings.append(f"head and torque have not settled after {result['iterations']} iterations; the result is the "
                        "mean of the last window: go on with a larger --most, or look at the transient run")
    if result["residual_p"] and result["residual_p"] > RESIDUAL_ASKED:
        warnings.append(f"the residual of p is {result['residual_p']:.1e} where head and torque have come to rest: the "
                        f"steady equations leave an unsteadiness; it scatters the head by {result['head_scatter_m']:.2g} m")
    peak = 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    return {"stage": "solve", "seconds": seconds, "peak_memory_bytes": peak, "steps": [
        {"name": "iterations", "seconds": seconds, "items": result["iterations"], "unit": "iterations"}],
        "warnings": warnings, "results": result}


def coarse_start(run, options, cells):
    """The solved case with an eighth of the cells, or None where the mesh is too small for one."""
    asked = cells // COARSE_SHARE
    if asked < COARSE_LEAST:
        return None
    coarse = run / "solve/coarse"
    coarse.mkdir(parents=True, exist_ok=True)
    if not (coarse / "geometry").exists():
        (coarse / "geometry").symlink_to((run / "geometry").resolve())
    for stage in ("mesh", "export"):
        if (coarse / stage / "record.json").exists():
            continue
        call(coarse, f"log.{stage}", "mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n", options.ranks,
             Path(options.bin) / f"cutwater-{stage}", "--case", options.case.resolve(), "--run", coarse.resolve(), "--cells", asked)
    return solve(coarse, options, FINE_WITHIN * options.within, f"start with {asked:,} cells")


def solve(run, options, within, name):
    """Solves a run; its case folder, whose latest time holds the fields of all ranks."""
    began = time.monotonic()
    cells = read_record(run, "export")["results"]["cells"]
    (run / "solve").mkdir(exist_ok=True)
    coarse = coarse_start(run, options, cells)
    case = prepare(run, options.ranks, coarse)
    length = WINDOW_LEAST
    table = iterate(case, options.ranks, options.most, within, length, name)
    if options.ranks > 1:
        call(case, "log.reconstructPar", "reconstructPar", "-latestTime")
    write_history(run / "solve/history.csv", table)
    record = record_of(result_of(run, case, table, length, within), time.monotonic() - began)
    write_whole(run / "solve/record.json", json.dumps(record, indent=1) + "\n")
    return case


def headline(result):
    scatter = f" +- {result['head_scatter_m']:.2g}" if result["head_scatter_m"] else ""
    state = "settled" if result["settled"] else "NOT settled"
    efficiency = (f", hydraulic efficiency {100 * result['hydraulic_efficiency']:.1f} %"
                  if result["hydraulic_efficiency"] else "")
    return (f"{state} after {result['iterations']} iterations: head {result['head_m']:.3f}{scatter} m, torque "
            f"{result['torque_n_m']:.4g} N m, shaft power {result['shaft_power_w']:.4g} W{efficiency}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", type=Path, required=True)
    parser.add_argument("--run", type=Path, required=True)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--bin", type=Path, default=Path(__file__).resolve().parents[1] / "build/bin")
    parser.add_argument("--most", type=int, default=4000)
    parser.add_argument("--within", type=float, default=0.003)
    parser.add_argument("--fresh", action="store_true", help="forgets what an earlier call solved")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends the solver too
    try:
        missing = [name for name in PROGRAMS if not shutil.which(name)]
        if missing:
            raise Trouble(f"{missing[0]} is not there; install OpenFOAM (Debian: apt-get install openfoam)")
        if not (options.run / "export/openfoam/system").is_dir():
            raise Trouble(f"{options.run}/export/openfoam: no case; make it first (make -C cases NAME)")
        if options.fresh:
            shutil.rmtree(options.run / "solve", ignore_errors=True)
        solve(options.run, options, options.within, options.run.name)
        result = read_record(options.run, "solve")["results"]
    except Trouble as error:
        sys.exit(f"cutwater-solve: error: {error}")
    except KeyboardInterrupt:
        sys.exit("cutwater-solve: stopped; call it again to go on")
    say(headline(result))


if __name__ == "__main__":
    main()
