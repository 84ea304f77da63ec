#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""solve.py --case FILE --run RUN [--curve] [--ranks 2] [--bin build/bin] [--most 4000] [--within 0.003] [--fresh]

Solves the steady flow (frozen rotor) of a finished run with OpenFOAM until head and torque have settled (settling.py),
into RUN/solve:

  coarse/       the same pump with an eighth of the cells, made and solved first the same way, for the start of the fine
  steady/       the OpenFOAM case: its latest time holds the solved fields
  history.csv   head, torque and residuals by iteration
  record.json   what came out

With --curve it then solves the points of the characteristic curve that the case names (operating_points), each from its
solved neighbour, into RUN/solve/points/NAME, and writes curve.csv and, into record.json, the curve.

A run is stopped where head and torque have settled, though the residual of p may be above 1e-4 then; where that no
longer falls the steady equations have no such state on that mesh. Means and scatter of the last window are the result.
A killed call goes on where it was, on other ranks too; other files of the export begin anew. A flow that has not
settled after MOST iterations is told as such, in the headline and as a warning of the record."""
import argparse
import csv
import fcntl
import io
import json
import math
import os
import resource
import shutil
import signal
import socket
import sys
import time
from pathlib import Path

import foam
import reports
import settling
import stage_files
from coarse import start_cells
from foam import Trouble, say

FINE_WITHIN = 3        # a start need not have settled more closely than this times WITHIN
RESIDUAL_ASKED = 1e-4  # of p, as the paper has it
HISTORY = ("iteration", "head_m", "torque_n_m", "residual_p", "residual_u")
CURVE = ("point", "flow_m3_per_h", "flow_share", "head_m", "head_scatter_m", "torque_n_m", "shaft_power_w",
         "hydraulic_efficiency", "npsh_inception_m", "settled", "iterations", "residual_p", "residual_p_falls")


def read_record(run, stage):
    path = run / stage / "record.json"
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise Trouble(f"{path}: {error}; run the stage `{stage}` first (make does)") from error


def lock(run):
    """Takes the run folder as the other stages do (pipeline/run_lock.h); the lock dies with this process."""
    (run / "log").mkdir(exist_ok=True)
    file = open(run / "log/run.lock", "a+", encoding="utf-8")
    try:
        fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        file.seek(0)
        holder = file.readline().strip() or "another process"
        raise Trouble(f"{run}: {holder} works in this folder; wait until it ends, or give another --run") from error
    file.truncate(0)
    file.write(f"cutwater-solve on host {socket.gethostname()}, process {os.getpid()}\n")
    file.flush()
    return file


def table_text(names, rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, names, extrasaction="ignore")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


class Run:
    """A finished run of the pipeline, and how it is to be solved."""

    def __init__(self, folder, options, within):
        self.folder, self.options = folder, options
        self.export = read_record(folder, "export")
        self.made_from = stage_files.of_export(self.export)
        for stage, digest in self.export.get("made_from", {}).items():
            if digest != stage_files.files_digest(read_record(folder, stage)):
                raise Trouble(f"{folder}/export: was made from other files than lie in {folder}/{stage}; run "
                              "cutwater-export again (make does)")
        self.cells = self.export["results"]["cells"]
        entered = self.export["case"]
        self.density = entered["fluid.density_kg_per_m3"]
        self.flow_m3_per_h = entered["operating_point.flow_rate_m3_per_h"]
        self.omega = entered["operating_point.speed_rpm"] * math.pi / 30
        self.rest = settling.Rest(within, entered["operating_point.head_m"])

    def solve(self, source, case, name, start):
        """Solves the exported case `source` in the folder `case`; its history."""
        foam.prepare(source, case, self.options.ranks, self.export["files"], start)
        return foam.iterate(case, self.options.ranks, self.options.most, self.rest, name)

    def outcome(self, case, table, flow_m3_per_h):
        """What the flow of a case came to, as the record keeps it."""
        last = table[max(table)]
        found = {key: settling.windows(table, key) for key in ("head_m", "torque_n_m")}
        mean = {key: found[key][0][-1] if found[key] else last[key] for key in found}
        done, left = settling.settled(table, self.rest)
        power = mean["torque_n_m"] * self.omega
        useful = self.density * reports.GRAVITY * flow_m3_per_h / 3600 * mean["head_m"]
        return {"settled": done or reports.converged(case), "iterations": max(table),
                "window_iterations": settling.WINDOW, "left_of_way": left if math.isfinite(left) else None,
                "within": self.rest.within, "head_m": mean["head_m"],
                "head_scatter_m": found["head_m"][1] if found["head_m"] else None,
                "torque_n_m": mean["torque_n_m"],
                "torque_scatter_n_m": found["torque_n_m"][1] if found["torque_n_m"] else None, "shaft_power_w": power,
                "hydraulic_efficiency": useful / power if power > 0 else None,
                "npsh_inception_m": settling.last_mean(table, "npsh_inception_m"),
                "residual_p": last.get("residual_p"), "residual_u": last.get("residual_u"),
                "residual_p_falls": settling.falls(table, "residual_p")}


def coarse_start(run):
    """The solved case of the same pump with an eighth of the cells, made anew; None where the mesh is too small, or
    where that cannot be had: a case may allow no such mesh."""
    asked = start_cells(run.cells)
    if not asked:
        return None
    try:
        return solve_coarse(run, asked)
    except (Trouble, OSError) as error:
        say(f"starts from rest, for there is no start with {asked:,} cells: {error}")
        return None


def solve_coarse(run, asked):
    """The case of the same pump with so many cells, made and solved."""
    options = run.options
    coarse = run.folder / "solve/coarse"
    coarse.mkdir(parents=True, exist_ok=True)
    foam.link(coarse / "geometry", run.folder / "geometry")
    for stage in ("mesh", "export"):
        say(f"start with {asked:,} cells: {stage}")
        foam.call(coarse, f"log.{stage}", *foam.mpirun(options.ranks, Path(options.bin).resolve() / f"cutwater-{stage}",
                                                       "--case", options.case.resolve(), "--run", coarse.resolve(),
                                                       "--cells", asked))
    solve_design(Run(coarse, options, FINE_WITHIN * run.rest.within), f"start with {asked:,} cells")
    return coarse / "solve/steady"


def solve_design(run, name):
    """Solves the operating point; its history."""
    return run.solve(run.folder / "export/openfoam", run.folder / "solve/steady", name, lambda: coarse_start(run))


def solve_curve(run, design):
    """Solves the other points, outwards from the operating point, whose history `design` is, each from its solved
    neighbour; a row for each."""
    solved, rows = {1.0: run.folder / "solve/steady"}, []
    for point in sorted(run.export["results"]["operating_points"], key=lambda point: abs(point["flow_share"] - 1)):
        name, share = point["name"], point["flow_share"]
        if name == "q1000":  # the operating point, or by a rounded unit so near to it
            table, solved[share] = design, solved[1.0]
        else:
            nearest = solved[min(solved, key=lambda other, share=share: abs(other - share))]
            solved[share] = run.folder / "solve/points" / name
            table = run.solve(run.folder / "export/openfoam/points" / name, solved[share], f"{run.folder.name} {name}",
                              lambda start=nearest: start)
        rows.append({"point": name, **point, **run.outcome(solved[share], table, point["flow_m3_per_h"])})
        say(f"{name}: {headline(rows[-1])}")
    return sorted(rows, key=lambda row: row["flow_share"])


def warnings_of(results, name):
    found = []
    if not results["settled"]:
        found.append(f"{name}: head and torque have not settled after {results['iterations']} iterations; the result "
                     "is the mean of the last window: go on with a larger MOST, or look at the transient run")
    elif results["residual_p"] and results["residual_p"] > RESIDUAL_ASKED:
        at_rest = results.get("residual_p_falls") is False
        found.append(f"{name}: the residual of p is {results['residual_p']:.1e}, above {RESIDUAL_ASKED:g}, where the "
                     "run was stopped as head and torque had settled; " + (
                         "it no longer falls: the steady equations have no such state on this mesh, which scatters the "
                         f"head by {results['head_scatter_m'] or 0:.2g} m" if at_rest else
                         "it may fall further: --within 0.001 of pipeline/solve/solve.py goes on"))
    return found


def earlier(run):
    """The record that an earlier call wrote of the same export, or one of nothing."""
    path = run.folder / "solve/record.json"
    record = read_record(run.folder, "solve") if path.exists() else {}
    return record if record.get("made_from") == run.made_from else {"seconds": 0, "results": {"curve": []}}


def write_results(run, table, seconds, curve):
    """history.csv, curve.csv and record.json, the last in the form of the other stages."""
    folder = run.folder / "solve"
    rows = [{"iteration": iteration, **row} for iteration, row in sorted(table.items())]
    results = run.outcome(folder / "steady", table, run.flow_m3_per_h)
    warnings = warnings_of(results, "operating point")
    for point in curve:
        warnings += warnings_of(point, point["point"]) if point["point"] != "q1000" else []
    results |= {"headline": headline(results), "cells": run.cells, "y_plus": reports.y_plus(folder / "steady"),
                "history": {key: [row.get(key) for row in rows] for key in HISTORY},
                "curve": [{key: point.get(key) for key in CURVE} for point in curve]}
    peak = 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    steps = [{"name": "iterations", "seconds": seconds, "items": results["iterations"], "unit": "iterations"}]
    record = {"stage": "solve", "seconds": seconds, "peak_memory_bytes": peak, "steps": steps, "warnings": warnings,
              "results": results, "made_from": run.made_from}
    foam.write_whole(folder / "history.csv", table_text(HISTORY, rows))
    if curve:
        foam.write_whole(folder / "curve.csv", table_text(CURVE, curve))
    foam.write_whole(folder / "record.json", stage_files.sealed(record))
    return results


def headline(results):
    scatter = f" +- {results['head_scatter_m']:.2g}" if results["head_scatter_m"] else ""
    efficiency = (f", hydraulic efficiency {100 * results['hydraulic_efficiency']:.1f} %"
                  if results["hydraulic_efficiency"] else "")
    return (f"{'head and torque settled' if results['settled'] else 'NOT settled'} after {results['iterations']} "
            f"iterations: head {results['head_m']:.3f}{scatter} m, torque {results['torque_n_m']:.4g} N m, shaft power "
            f"{results['shaft_power_w']:.4g} W{efficiency}")


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", type=Path, required=True)
    parser.add_argument("--run", type=Path, required=True)
    parser.add_argument("--curve", action="store_true", help="also the points of the characteristic curve")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--bin", type=Path, default=Path(__file__).resolve().parents[2] / "build/bin")
    parser.add_argument("--most", type=int, default=4000, help="iterations of each flow")
    parser.add_argument("--within", type=float, default=0.003, help="share of the way that may be left")
    parser.add_argument("--fresh", action="store_true", help="forgets what an earlier call solved")
    return parser.parse_args()


def heed_signals():
    """What ends this process ends the solver too, which has a session of its own; under nohup a hang-up does not."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler)


def main():
    options, began = parse(), time.monotonic()
    heed_signals()
    try:
        foam.require_programs()
        if not (options.run / "export/openfoam/system").is_dir():
            exported = (options.run / "export/record.json").exists()
            raise Trouble(f"{options.run}/export/openfoam: no case; " + (
                "let export.formats of the case have openfoam" if exported else "make it first (make -C cases NAME)"))
        if (options.run / "export/openfoam/processor0").is_dir():
            raise Trouble(f"{options.run}/export/openfoam: the mesh is divided; run its Allrun, or export it whole "
                          "(openfoam.processors: 1)")
        held = lock(options.run)
        if options.fresh:
            shutil.rmtree(options.run / "solve", ignore_errors=True)
        (options.run / "solve").mkdir(exist_ok=True)
        run = Run(options.run, options, options.within)
        before = earlier(run)
        design = solve_design(run, options.run.name)
        seconds = before["seconds"] + time.monotonic() - began
        say(write_results(run, design, seconds, before["results"]["curve"])["headline"])
        if options.curve:
            curve = solve_curve(run, design)
            write_results(run, design, before["seconds"] + time.monotonic() - began, curve)
        held.close()
    except (Trouble, OSError) as error:
        sys.exit(f"cutwater-solve: error: {error}")
    except KeyboardInterrupt:
        sys.exit("cutwater-solve: stopped; call it again to go on")


if __name__ == "__main__":
    main()
