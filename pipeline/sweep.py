# SPDX-License-Identifier: AGPL-3.0-or-later
"""sweep.py TABLE.csv RUN RUN...: sets the runs of a sweep side by side, coarse to fine, and writes TABLE.csv.

Where runs were solved it draws head, torque and efficiency over the cells into TABLE.svg, with the measured head of the
case (operating_point.test_head_m) and the extrapolated values as broken lines. Of three or more solved runs the three
finest also give, for each quantity, the observed order of convergence, the value extrapolated to no mesh size at all,
and the grid convergence index of the finest mesh, after Celik et al., J. Fluids Eng. 130 (2008) 078001, with the safety
factor 1.25. Where the three differ in the turbulence model or in the walls that the layers resolve there is none of
this, and the first line says so: their flows differ in more than the mesh size."""
import csv
import io
import json
import math
import os
import re
import subprocess
import sys

import stage_files
import sweep_plot
from whole_file import write_whole

SAFETY = 1.25
SOLVED = {"head_m": r"^head +([-\d.e+]+) m", "torque_n_m": r"^shaft torque +([-\d.e+]+) N m",
          "hydraulic_efficiency_percent": r"^hydraulic efficiency +([-\d.e+]+) %"}
NAMES = {"head_m": "Head, m", "torque_n_m": "Torque, N m", "hydraulic_efficiency_percent": "Hydraulic efficiency, %"}


def read_record(run, stage):
    path = os.path.join(run, stage, "record.json")
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def solve_record(run):
    """That of the solved flow; None where it was solved on another export than lies there."""
    record, export = read_record(run, "solve"), read_record(run, "export") or {}
    return record if record and record.get("made_from") == stage_files.of_export(export) else None


def solved(run):
    """What the flow came to, by the stage `solve`, or what the solver reported last, as far as either was run."""
    record = solve_record(run)
    if record:
        result = record["results"]
        walls = result["y_plus"].values()
        found = {"head_m": result["head_m"], "torque_n_m": result["torque_n_m"],
                 "y_plus_most": max((wall["most"] for wall in walls), default=None)}
        if result["hydraulic_efficiency"]:
            found["hydraulic_efficiency_percent"] = 100 * result["hydraulic_efficiency"]
        return {name: value for name, value in found.items() if value is not None}
    case = os.path.join(run, "export/openfoam")
    if not os.path.isdir(os.path.join(case, "postProcessing")):
        return {}
    text = subprocess.run(["sh", os.path.join(case, "summary")], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True, check=False).stdout
    found = {name: re.search(pattern, text, re.M) for name, pattern in SOLVED.items()}
    return {name: float(match.group(1)) for name, match in found.items() if match}


def row_of(run):
    record = read_record(run, "mesh")
    result = record["results"]
    domains = result["domains"]
    tetrahedra = sum(domain["tetrahedra"] for domain in domains)
    walls = [wall for domain in domains for wall in domain["layer_coverage"]]
    return {"run": os.path.basename(os.path.normpath(run)), "cells": result["cells"], "tetrahedra": tetrahedra,
            "prisms": sum(domain["prisms"] for domain in domains),
            "regions": sum(domain["regions"] for domain in domains),
            "first_height_met_percent": 100 * sum(wall["first_height_met_faces"] for wall in walls) /
                                        sum(wall["wall_faces"] for wall in walls),
            "tetrahedron_aspect_mean": sum(domain["tetrahedron_aspect_mean"] * domain["tetrahedra"]
                                           for domain in domains) / max(tetrahedra, 1),
            "least_dihedral_deg": min(domain["least_dihedral_deg"] for domain in domains),
            "mesh_s": record["seconds"], "mesh_memory_mb": record["peak_memory_bytes"] / 1e6, **flow_model(run),
            **solved(run)}


def flow_model(run):
    """How the exported cases of a run model turbulence and walls."""
    results = (read_record(run, "export") or {}).get("results", {})
    if "turbulence_model" not in results:
        return {}
    return {"turbulence_model": results["turbulence_model"], "resolved_walls": " ".join(results["resolved_walls"])}


def models_apart(rows):
    """In words the models of turbulence and walls of the runs; None where all have one."""
    found = {}
    for row in rows:
        found.setdefault((row.get("turbulence_model"), row.get("resolved_walls", "")), []).append(row)
    return None if len(found) < 2 else "; ".join(
        f"{model} with {len(walls.split())} resolved walls on {', '.join(row['run'] for row in alike)}"
        for (model, walls), alike in found.items())


def order_of(ratio, coarse, fine):
    """The order at which three meshes have changes in the `ratio` of the coarse pair's to the fine pair's, from the
    logarithms of their refinement ratios; None where none above 0 has. It is the root of equations 5a and 5b of the
    source, whose iteration to a fixed point diverges where coarse > 2 fine; their difference rises with the order, from
    ln(coarse / fine) - ln(ratio) at 0."""
    wanted = math.log(ratio)
    if wanted <= math.log(coarse / fine):
        return None
    low, high = 0.0, (wanted + max(math.log(fine / coarse), 0)) / coarse
    while low < (order := (low + high) / 2) < high:
        if order * coarse + math.log(math.expm1(-order * coarse) / math.expm1(-order * fine)) < wanted:
            low = order
        else:
            high = order
    return high


def convergence(sizes, values):
    """Order, extrapolated value and relative index of the finest of three meshes, coarse to fine; None where the values
    do not converge monotonously. `sizes` are mesh sizes in any unit, each below the one before."""
    e32, e21 = values[0] - values[1], values[1] - values[2]
    if e21 == 0 or e32 / e21 <= 0:
        return None
    fine = math.log(sizes[1] / sizes[2])
    order = order_of(e32 / e21, math.log(sizes[0] / sizes[1]), fine)
    if order is None:
        return None
    left = math.expm1(order * fine)
    return order, values[2] - e21 / left, SAFETY * abs(e21 / values[2]) / left


def test_head(runs):
    """The measured head of the case, None without one."""
    return read_record(runs[0], "export")["results"].get("test_head_m")


def finest(rows, name):
    """Of the runs, coarse to fine, the three finest that have the quantity."""
    return [row for row in rows if name in row][-3:]


def tell(rows):
    if models := models_apart(finest(rows, "head_m")):
        print(f"no order and no grid convergence index: {models}")
    print(f"{'run':20s} {'cells':>12s} {'ratio':>6s} {'first height':>12s} {'dihedral':>9s} {'mesh':>8s} {'memory':>8s}"
          f" {'head':>9s} {'efficiency':>10s} {'y+ most':>7s}")
    for row in rows:
        ratio = f"{row['refinement_ratio']:.3f}" if row["refinement_ratio"] else "-"
        head = f"{row['head_m']:.4f} m" if "head_m" in row else "-"
        efficiency = f"{row['hydraulic_efficiency_percent']:.2f} %" if "hydraulic_efficiency_percent" in row else "-"
        most = f"{row['y_plus_most']:.1f}" if "y_plus_most" in row else "-"
        print(f"{row['run']:20s} {row['cells']:12,d} {ratio:>6s} {row['first_height_met_percent']:10.1f} % "
              f"{row['least_dihedral_deg']:5.1f} deg {row['mesh_s']:6.1f} s {row['mesh_memory_mb']:5.0f} MB {head:>9s} "
              f"{efficiency:>10s} {most:>7s}")


def charts_of(rows, measured):
    """Prints what the three finest runs extrapolate to; a chart for each solved quantity."""
    charts = []
    for name in SOLVED:
        solved_rows = [row for row in rows if name in row]
        last = finest(rows, name)
        marks = [(measured, f"measured {measured:g}")] if measured and name == "head_m" else []
        if len(last) == 3 and not models_apart(last):
            found = convergence([row["cells"]**(-1 / 3) for row in last], [row[name] for row in last])
            print(f"{name:30s} " + (f"order {found[0]:.2f}, extrapolated {found[1]:.5g}, grid convergence index "
                                    f"{100 * found[2]:.2f} %" if found else "does not converge monotonously"))
            if found:
                marks.append((found[1], f"extrapolated {found[1]:.5g}"))
        if solved_rows:
            cells = [row["cells"] for row in solved_rows]
            charts.append((NAMES[name], cells, [row[name] for row in solved_rows], marks))
    return charts


def main(table, runs):
    rows = sorted((row_of(run) for run in runs), key=lambda row: row["cells"])
    for coarse, fine in zip([None] + rows, rows):
        fine["refinement_ratio"] = (fine["cells"] / coarse["cells"])**(1 / 3) if coarse else ""
    names = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, names)
    writer.writeheader()
    writer.writerows(rows)
    write_whole(table, text.getvalue())
    tell(rows)
    charts = charts_of(rows, test_head(runs))
    made = [(table, "the table")]
    if charts:
        drawing = os.path.splitext(table)[0] + ".svg"
        write_whole(drawing, sweep_plot.picture(charts))
        made.append((drawing, "head, torque and efficiency over the cells"))
    for path, words in made:
        shown = os.path.relpath(path)
        print(f"{path if shown.startswith('..') else shown}  {words}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__.splitlines()[0])
    main(sys.argv[1], sys.argv[2:])
