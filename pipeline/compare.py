#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""compare.py FOLDER: one page, FOLDER/index.html, that sets the finished runs in a folder side by side: what was asked
differently, mesh, times, and the solved flow, each with a link to the report of the run.

Where at least two runs were solved, head, torque and efficiency are drawn over the cells, a line for each pump, with
the measured head. Runs of one pump are a sweep: a table tells their refinement and, of three, what sweep.py does of the
three finest: order, extrapolated value, grid convergence index. Characteristic curves are drawn over each other."""
import html
import json
import os
import sys

import sweep
import sweep_plot
from whole_file import write_whole

STYLE = """body{margin:0 auto;padding:30px 40px;max-width:1400px;color:#1f2933;background:#fff;
font:15px/1.5 'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;font-variant-numeric:tabular-nums}
h1{font-size:30px;font-weight:600;margin:0 0 6px}h2{font-size:20px;font-weight:600;margin:40px 0 8px}
p{color:#5f6c7b;margin:4px 0 14px}a{color:#0b5c8a}.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:14px}th,td{padding:4px 22px 4px 0;border-bottom:1px solid #dde3e9;
text-align:left;white-space:nowrap;vertical-align:bottom}td,thead th+th{text-align:right}thead th{border-color:#1f2933}
tbody th{font-weight:400;color:#5f6c7b}tr.part th{font-weight:600;color:#1f2933;padding-top:18px}
.charts{display:flex;flex-wrap:wrap;gap:10px 30px}svg{max-width:100%;height:auto}
.key{display:flex;flex-wrap:wrap;gap:2px 18px;margin:6px 0}
.key i{display:inline-block;width:11px;height:11px;margin-right:6px}
tr.last th,tr.last td{border-color:#1f2933}@media(max-width:600px){body{padding:14px}h1{font-size:24px}}
"""


def read_run(run):
    """What the page tells of a run."""
    records = {stage: sweep.read_record(run, stage) for stage in ("geometry", "mesh", "export", "report")}
    records["solve"] = sweep.solve_record(run)
    return {"name": os.path.basename(os.path.normpath(run)), "records": records, "row": sweep.row_of(run),
            "case": records["mesh"].get("case", {})}


def runs_in(folder):
    """The folders of finished meshes in a folder, by name."""
    return sorted(path for name in os.listdir(folder)
                  if os.path.exists(os.path.join(path := os.path.join(folder, name), "mesh/record.json")))


def differing(runs):
    """(key, values of the runs) of what the cases of the runs do not have alike."""
    keys = list(dict.fromkeys(key for run in runs for key in run["case"]))
    found = [(key, [run["case"].get(key) for run in runs]) for key in keys]
    return [(key, values) for key, values in found if any(value != values[0] for value in values)]


def shown(value, form):
    return "&ndash;" if value is None else html.escape(str(value) if isinstance(value, str) else format(value, form))


def of_row(key):
    return lambda run: run["row"].get(key)


def of_record(stage, key, scale=1):
    def read(run):
        results = (run["records"][stage] or {}).get("results", {})
        return results[key] * scale if isinstance(results.get(key), (int, float)) else None
    return read


def whole_time(run):
    return sum(run["records"][stage]["seconds"] for stage in ("geometry", "mesh", "export") if run["records"][stage])


def settled(run):
    solve = run["records"]["solve"]
    return None if not solve else "yes" if solve["results"].get("settled") else "no"


def resolved_walls(run):
    walls = run["row"].get("resolved_walls")
    return None if walls is None else len(walls.split())


def warning_count(run):
    return sum(len(record.get("warnings", [])) for record in run["records"].values() if record)


CURVE = {"head_m": ("Head, m", 1), "shaft_power_w": ("Shaft power, kW", 1e-3),
         "hydraulic_efficiency": ("Hydraulic efficiency, %", 100),
         "npsh_inception_m": ("NPSH at inception, m", 1)}  # of the points of a curve; with the unit of the chart
LEAST_RATIO = 1.1  # of mesh sizes, below which an order says nothing; Celik et al. ask for 1.3

PARTS = {
    "Mesh": [("cells", of_row("cells"), ",d"), ("tetrahedra", of_row("tetrahedra"), ",d"),
             ("prisms", of_row("prisms"), ",d"), ("regions", of_row("regions"), "d"),
             ("first height met, %", of_row("first_height_met_percent"), ".1f"),
             ("longest/shortest edge of tetrahedra, mean", of_row("tetrahedron_aspect_mean"), ".3f"),
             ("least dihedral angle, deg", of_row("least_dihedral_deg"), ".1f")],
    "Flow": [("head predicted by the design, m", of_record("geometry", "predicted_head_m"), ".2f"),
             ("head solved, m", of_row("head_m"), ".3f"), ("torque, N m", of_row("torque_n_m"), ".3f"),
             ("hydraulic efficiency, %", of_row("hydraulic_efficiency_percent"), ".1f"),
             ("turbulence model", of_row("turbulence_model"), ""), ("resolved walls", resolved_walls, "d"),
             ("greatest y+", of_row("y_plus_most"), ".1f"), ("iterations", of_record("solve", "iterations"), "d"),
             ("settled", settled, "")],
    "Run": [("geometry to export, s", whole_time, ".1f"), ("mesher, s", of_row("mesh_s"), ".1f"),
            ("memory of the mesher, MB", of_row("mesh_memory_mb"), ".0f"), ("ranks", of_record("mesh", "ranks"), "d"),
            ("warnings", warning_count, "d")],
}


def table(runs):
    yield "<div class=\"wide\"><table><thead><tr><th></th>"
    for run in runs:
        name = html.escape(run["name"])
        yield f"<th><a href=\"{name}/report/index.html\">{name}</a></th>" if run["records"]["report"] else \
            f"<th>{name}</th>"
    yield "</tr></thead><tbody>"
    parts = {"Case": [(key, values, "") for key, values in differing(runs)]}
    for part, rows in PARTS.items():
        parts[part] = [(name, [read(run) for run in runs], form) for name, read, form in rows]
    for part, rows in parts.items():
        filled = [row for row in rows if any(value is not None for value in row[1])]
        if filled:
            yield f"<tr class=\"part\"><th colspan=\"{1 + len(runs)}\">{part}</th></tr>"
        for name, values, form in filled:
            cells = "".join(f"<td>{shown(value, form)}</td>" for value in values)
            yield f"<tr><th>{html.escape(name)}</th>{cells}</tr>"
    yield "</tbody></table></div>"


def sweeps(runs):
    """The solved runs of each pump (all keys of the case alike), coarse to fine, with its name."""
    found = {}
    for run in sorted((run for run in runs if "head_m" in run["row"]), key=lambda run: run["row"]["cells"]):
        found.setdefault(json.dumps(run["case"], sort_keys=True), []).append(run)
    for family in found.values():
        common = os.path.commonprefix([run["name"] for run in family]).rstrip("-_.")
        yield common or family[0]["name"], family


def measured_head(family):
    return next((head for run in family if (head := of_record("export", "test_head_m")(run))), None)


def converged(family, key):
    """What sweep.py finds of the three finest runs that have the quantity; None where there are no three of them,
    where they are too alike, or where their models differ."""
    last = sweep.finest([run["row"] for run in family], key)
    sizes = [row["cells"]**(-1 / 3) for row in last]
    near = any(coarse < LEAST_RATIO * fine for coarse, fine in zip(sizes, sizes[1:]))
    if len(last) < 3 or near or sweep.models_apart(last):
        return None
    return sweep.convergence(sizes, [row[key] for row in last])


def sweep_rows(family):
    """The rows of the table of a sweep: (words at the head, values)."""
    keys = [*sweep.NAMES, "y_plus_most"]
    for coarse, run in zip([None, *family], family):
        row = run["row"]
        ratio = (row["cells"] / coarse["row"]["cells"])**(1 / 3) if coarse else None
        yield run["name"], [shown(row["cells"], ",d"), shown(ratio, ".3f"),
                            *(shown(row.get(key), ".4g" if key != "y_plus_most" else ".1f") for key in keys)]
    found = [converged(family, key) for key in sweep.NAMES]
    if len(family) > 2:
        for k, (name, form) in enumerate((("observed order", ".2f"), ("extrapolated", ".4g"),
                                          ("grid convergence index of the finest", ".2%"))):
            yield name, ["", "", *(shown(one and one[k], form) for one in found), ""]
    if measured_head(family):
        yield "measured", ["", "", *(shown(measured_head(family), ".4g") if key == "head_m" else "" for key in keys)]


def sweep_table(name, family):
    heads = ["cells", "ratio", *sweep.NAMES.values(), "greatest y+"]
    yield f"<h3>{html.escape(name)}</h3>"
    if models := sweep.models_apart(sweep.finest([run["row"] for run in family], "head_m")):
        yield f"<p>No order and no grid convergence index: {html.escape(models)}.</p>"
    yield "<div class=\"wide\"><table><thead><tr><th></th>"
    yield "".join(f"<th>{head}</th>" for head in heads) + "</tr></thead><tbody>"
    for k, (words, values) in enumerate(sweep_rows(family)):
        kind = " class=\"last\"" if k + 1 == len(family) else ""  # of the runs
        cells = "".join(f"<td>{value}</td>" for value in values)
        yield f"<tr{kind}><th>{html.escape(words)}</th>{cells}</tr>"
    yield "</tbody></table></div>"


def drawn(heading, names, charts):
    """Charts beside each other below a heading, with one key for all where there are several lines."""
    yield f"<h2>{heading}</h2>"
    if len(names) > 1:
        yield "<div class=\"key\">" + "".join(f"<span><i style=\"background:{sweep_plot.colour(k)}\"></i>"
                                             f"{html.escape(name)}</span>" for k, name in enumerate(names)) + "</div>"
    yield "<div class=\"charts\">" + "".join(sweep_plot.svg(sweep_plot.lines(*chart, 0)) for chart in charts) + "</div>"


def sweep_part(runs):
    """Solved quantities over the cells, where there are two of them at different numbers of cells."""
    found, charts = list(sweeps(runs)), []
    heads = {head for _, family in found if (head := measured_head(family))}
    for key, name in sweep.NAMES.items():
        series = [list(zip(*((run["row"]["cells"], run["row"][key]) for run in family if key in run["row"])))
                  or [(), ()] for _, family in found]
        if len({cells for line, _ in series for cells in line}) < 2:
            continue
        marks = [(head, f"measured {head:g}") for head in sorted(heads)] if key == "head_m" else []
        one = converged(found[0][1], key) if len(found) == 1 else None
        charts.append((name, "cells", series, marks + ([(one[1], f"extrapolated {one[1]:.5g}")] if one else [])))
    if charts:
        yield from drawn("Solved flow over the cells", [name for name, _ in found], charts)
        yield ("<p>Ratio: of the mesh sizes of a run and the one before it. Order, extrapolated value and grid "
               "convergence index are of the three finest runs of a pump, after Celik et al. (2008); "
               f"&ndash;: not monotonous, ratios below {LEAST_RATIO}, or other models of turbulence and walls.</p>")
        for name, family in found:
            if len(family) > 1:
                yield from sweep_table(name, family)


def curve_of(run):
    curve = run["records"]["solve"]["results"].get("curve", []) if run["records"]["solve"] else []
    return curve if len(curve) > 1 else []


def curve_part(runs):
    """Characteristic curves over each other, each point that has a value."""
    with_curve, charts = [run for run in runs if curve_of(run)], []
    for key, (name, unit) in CURVE.items():
        series = [list(zip(*((point["flow_m3_per_h"], unit * point[key]) for point in curve_of(run)
                             if point.get(key) is not None))) or [(), ()] for run in with_curve]
        if any(flows for flows, _ in series):
            charts.append((name, "flow rate, m3/h", series, []))
    if charts:
        yield from drawn("Characteristic curves", [run["name"] for run in with_curve], charts)


def page(folder, runs):
    name = html.escape(os.path.basename(os.path.abspath(folder)))
    lines = ["<!DOCTYPE html>", "<html lang=\"en\"><head><meta charset=\"utf-8\">",
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">",
             f"<title>Cutwater: runs of {name}</title><style>\n{STYLE}</style></head><body>",
             f"<h1>{len(runs)} runs of {name}</h1>",
             "<p>Of the case the keys that shape the pump, where they are not alike in all runs. The names lead to the "
             "reports of the runs.</p>",
             *table(runs), *sweep_part(runs), *curve_part(runs)]
    return "\n".join(lines + ["</body></html>", ""])


def main(folder):
    if not os.path.isdir(folder):
        sys.exit(f"compare: error: {folder}: no such folder; allowed: a folder of runs, such as runs")
    found = runs_in(folder)
    if not found:
        sys.exit(f"compare: error: {folder}: holds no run with a mesh; make one first (make -C cases NAME, or "
                 "cutwater NAME)")
    try:
        runs = [read_run(run) for run in found]
        write_whole(os.path.join(folder, "index.html"), page(folder, runs))
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"compare: error: {folder}: {type(error).__name__}: {error}")
    print(f"{os.path.join(folder, 'index.html')}  {len(runs)} runs side by side")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.splitlines()[0])
    main(sys.argv[1])
