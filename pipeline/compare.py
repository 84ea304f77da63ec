#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""compare.py FOLDER: one page, FOLDER/index.html, that sets the finished runs in a folder side by side: what was asked
differently, mesh, times, and the solved flow, each with a link to the report of the run. Charts show head, torque and
efficiency over the cells where at least two runs were solved."""
import html
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
svg{max-width:100%;height:auto}@media(max-width:600px){body{padding:14px}h1{font-size:24px}}
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


def warning_count(run):
    return sum(len(record.get("warnings", [])) for record in run["records"].values() if record)


PARTS = {
    "Mesh": [("cells", of_row("cells"), ",d"), ("tetrahedra", of_row("tetrahedra"), ",d"),
             ("prisms", of_row("prisms"), ",d"), ("regions", of_row("regions"), "d"),
             ("first height met, %", of_row("first_height_met_percent"), ".1f"),
             ("longest/shortest edge of tetrahedra, mean", of_row("tetrahedron_aspect_mean"), ".3f"),
             ("least dihedral angle, deg", of_row("least_dihedral_deg"), ".1f")],
    "Flow": [("head predicted by the design, m", of_record("geometry", "predicted_head_m"), ".2f"),
             ("head solved, m", of_row("head_m"), ".3f"), ("torque, N m", of_row("torque_n_m"), ".3f"),
             ("hydraulic efficiency, %", of_row("hydraulic_efficiency_percent"), ".1f"),
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


def charts(runs):
    """Solved quantities over the cells, where there are two of them at different numbers of cells."""
    for key, name in sweep.NAMES.items():
        points = sorted((run["row"]["cells"], run["row"][key]) for run in runs if key in run["row"])
        if len({cells for cells, _ in points}) > 1:
            yield (name, *map(list, zip(*points)), [])


def page(folder, runs):
    name = html.escape(os.path.basename(os.path.abspath(folder)))
    drawn = list(charts(runs))
    lines = ["<!DOCTYPE html>", "<html lang=\"en\"><head><meta charset=\"utf-8\">",
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">",
             f"<title>Cutwater: runs of {name}</title><style>\n{STYLE}</style></head><body>",
             f"<h1>{len(runs)} runs of {name}</h1>",
             "<p>Of the case the keys that shape the pump, where they are not alike in all runs. The names lead to the "
             "reports of the runs.</p>",
             *table(runs)]
    if drawn:
        lines += ["<h2>Solved flow over the cells</h2>", sweep_plot.picture(drawn)]
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
