# SPDX-License-Identifier: AGPL-3.0-or-later
"""summary.py RUN: names the files of a whole run and its headline figures, all read from the records of its stages."""
import json
import os
import sys

import stage_files


def read(run, stage):
    with open(os.path.join(run, stage, "record.json"), encoding="utf-8") as file:
        return json.load(file)


def size_of(path):
    """Bytes of a file, or of all files of a folder."""
    if not os.path.isdir(path):
        return os.path.getsize(path)
    return sum(os.path.getsize(os.path.join(folder, name)) for folder, _, names in os.walk(path) for name in names)


def shown_size(size):
    for unit in ("B", "kB", "MB"):
        if size < 1000:
            return f"{size:.0f} {unit}"
        size /= 1000
    return f"{size:.2f} GB"


def shown_time(seconds):
    return f"{seconds:.1f} s" if seconds < 100 else f"{seconds / 60:.1f} min"


def files(run):
    what = [("geometry/pump.step", "both solids with named faces, for any CAD program"),
            ("geometry/design.json", "every derived dimension"),
            ("mesh", "the mesh by regions"),
            ("export/pump.cgns", "the mesh with patches and interface, CGNS"),
            ("export/openfoam", "the OpenFOAM case: ./Allrun"),
            ("export/cfx", "the CFX set-up on pump.cgns"),
            ("export/fluent", "the mesh for Fluent"),
            ("export/code_saturne", "the code_saturne case on pump.cgns: ./run"),
            ("solve", "the solved flow: steady/ is the OpenFOAM case"),
            ("solve/curve.csv", "head, power and efficiency over the flow rate"),
            ("report/index.html", "the report")]
    for name, text in what:
        path = os.path.join(run, name)
        if os.path.exists(path):
            shown = os.path.relpath(path)
            yield path if shown.startswith("..") else shown, shown_size(size_of(path)), text


def mesh_lines(result):
    domains = result["domains"]
    cells, asked = result["cells"], result["asked_cells"]
    tets = sum(domain["tetrahedra"] for domain in domains)
    yield "cells", (f"{cells:,} ({100 * (cells / asked - 1):+.1f} % of the {asked:,} asked): {tets:,} tetrahedra, "
                    f"{sum(domain['prisms'] for domain in domains):,} prisms")
    yield "regions", " + ".join(f"{domain['regions']} {domain['name']}" for domain in domains)
    if tets:
        mean = sum(domain["tetrahedron_aspect_mean"] * domain["tetrahedra"] for domain in domains) / tets
        yield "tetrahedra", (f"longest/shortest edge {mean:.2f} mean, "
                             f"{max(domain['tetrahedron_aspect_max'] for domain in domains):.2f} most; least dihedral "
                             f"angle {min(domain['least_dihedral_deg'] for domain in domains):.1f} degrees")
    walls = [wall for domain in domains for wall in domain["layer_coverage"]]
    faces = sum(wall["wall_faces"] for wall in walls)
    if faces:
        first = sum(wall["first_height_met_faces"] for wall in walls)
        full = sum(wall["full_thickness_faces"] for wall in walls)
        jumps = sum(wall["thin_last_layer_faces"] + wall["thick_last_layer_faces"] for wall in walls)
        counts = sorted({domain["layers"] for domain in domains})
        yield "layers", (f"{' or '.join(map(str, counts))} on {faces:,} wall faces; first height as asked on "
                         f"{100 * first / faces:.1f} %, full thickness on {100 * full / faces:.1f} %; volumes change "
                         f"by up to 4 across the layer top on {100 * (1 - jumps / faces):.1f} %")
    yield "volume", ", ".join(f"{domain['name']} {100 * domain['volume_error']:+.3f} %" for domain in domains) + \
        " from its solid; least cell " + f"{1e9 * min(domain['least_cell_volume_m3'] for domain in domains):.2g} mm3"


def solved_line(run):
    """The solved flow in one line, and the record's warnings; nothing where the run was not solved."""
    if not os.path.exists(os.path.join(run, "solve/record.json")):
        return [], []
    record = read(run, "solve")
    if record.get("made_from") != stage_files.of_export(read(run, "export")):
        return [("solved", "on another export; solve it again")], []
    return [("solved", record["results"]["headline"])], [("solve", warning) for warning in record["warnings"]]


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: summary.py RUN")
    run = sys.argv[1]
    try:
        record = {stage: read(run, stage) for stage in ("geometry", "mesh", "export", "report")}
        head = record["geometry"]["results"].get("predicted_head_m")  # none of solids from elsewhere
        lines = [("head", f"{head:.2f} m predicted by the design")] if head else []
        lines += mesh_lines(record["mesh"]["results"])
        lines += [("note", text) for stage in ("mesh", "export")
                  for text in record[stage]["results"].get("headlines", [])]
        seconds = {stage: record[stage]["seconds"] for stage in record}
        whole = sum(seconds[stage] for stage in ("geometry", "mesh", "export"))
        lines.append(("time", ", ".join(f"{stage} {shown_time(value)}" for stage, value in seconds.items()) +
                      f"; {record['mesh']['results']['cells'] / whole:,.0f} cells a second to CGNS with "
                      f"{record['mesh']['results']['ranks']} ranks"))
        lines.append(("memory", ", ".join(f"{stage} {shown_size(record[stage]['peak_memory_bytes'])}"
                                          for stage in record)))
        warnings = [(stage, text) for stage in record for text in record[stage]["warnings"]]
        line, more = solved_line(run)
        lines[1:1] = line
        warnings += more
        made = list(files(run))
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"summary: error: {run}: {type(error).__name__}: {error}")
    for name, text in lines:
        print(f"{name:<11}{text}")
    if warnings:
        print(f"{'warnings':<11}{len(warnings)}, see the report; the first: {warnings[0][0]}: {warnings[0][1]}")
    widths = [max(len(row[column]) for row in made) for column in (0, 1)]
    for path, size, text in made:
        print(f"{path:<{widths[0]}}  {size:>{widths[1]}}  {text}")


main()
