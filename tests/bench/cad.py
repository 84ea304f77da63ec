#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Solids of any CAD files through the mesher: each closed solid as a domain of its own, all its faces walls with five
layers, beside gmsh's HXT without layers on the same faces.

    tests/bench/cad.py [FOLDER...] [--cells N] [--limit S] [--only WORD] [--most N] [--jobs 2] [--no-hxt] [--brief]
                       [--out DIR]

FOLDER holds STEP (.step, .stp), IGES (.iges, .igs), B-rep (.brep, .rle) and FreeCAD's files (.FCStd, which hold
B-reps), also gzipped, at any depth. Debian has them in occt-misc, gmsh-doc, netgen-doc and freecad-common: the table of
docs/measurements.md is of these four, unpacked into one folder (`apt-get download PACKAGE`, `dpkg -x FILE.deb FOLDER`).
Many more are in kicad-packages3d.
Solids of as many faces and the same volume count once. They are read, healed and divided as those of a case
(tests/measure/cad_solids.cpp). Without FOLDER it is that of CUTWATER_CAD.

At the end: solids by what became of them, and what is asked of all beside what they had; --brief leaves out the line of
each. A file that cannot be read, or whose faces do not close, counts as a solid; one without solid and face does not.

DIR/rows.json holds what is done: a call with the same DIR goes on. Times are those of the processor."""
import collections
import concurrent.futures
import gzip
import json
import os
import pathlib
import re
import shutil
import signal
import statistics
import sys
import tempfile
import zipfile

from programs import SOURCE, execute, options_of
from runs import record

BIN = pathlib.Path(os.environ.get("CUTWATER_BIN", SOURCE / "build/bin"))
LIMIT = 60  # s of the processor
LEAST_DIHEDRAL, LEAST_SHARE = 10, 0.6  # degrees, or of what the boundary allows
FAIR_SHARE = 0.95  # of the meshes, that have such angles
MOST_BARE = 1  # % of the wall, without layers
NO_SOLID = "no closed solid"

CASE = """name: solid
operating_point: {flow_rate_m3_per_h: 25, head_m: 10, speed_rpm: 1450}
impeller: {}
volute: {}
walls: {layer_count: 5, growth_ratio: 1.2, first_height_volute_um: 200}
"""

# Of the tetrahedra that HXT makes of the solid, with edges for about so many: number and least dihedral angle.
GMSH = r"""
import sys, gmsh, numpy
path, cells = sys.argv[1], float(sys.argv[2])
gmsh.initialize(); gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.occ.importShapes(path); gmsh.model.occ.synchronize()
volume = sum(gmsh.model.occ.getMass(3, tag) for _, tag in gmsh.model.getEntities(3))
size = (volume / (0.118 * cells)) ** (1 / 3)
for name, value in (("Mesh.MeshSizeMax", size), ("Mesh.MeshSizeMin", size / 20), ("Mesh.MeshSizeFromCurvature", 12),
                    ("Mesh.CharacteristicLengthMax", size), ("Mesh.Algorithm3D", 10), ("General.NumThreads", 1)):
    try: gmsh.option.setNumber(name, value)
    except Exception: pass
gmsh.model.mesh.generate(3)
tags, x, _ = gmsh.model.mesh.getNodes(); place = {t: i for i, t in enumerate(tags)}; x = numpy.array(x).reshape(-1, 3)
_, nodes = gmsh.model.mesh.getElementsByType(4)
t = numpy.array([place[n] for n in nodes]).reshape(-1, 4)
normal = []
for f in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)):
    n = numpy.cross(x[t[:, f[1]]] - x[t[:, f[0]]], x[t[:, f[2]]] - x[t[:, f[0]]])
    normal.append(n / numpy.maximum(numpy.linalg.norm(n, axis=1), 1e-300)[:, None])
least = min(numpy.degrees(numpy.pi - numpy.arccos(numpy.clip((a * b).sum(1), -1, 1))).min()
            for i, a in enumerate(normal) for b in normal[:i])
print(len(t), round(float(least), 1))
"""


def run(line, seconds):
    """How a program ended ("timeout" where it took more of the processor), what it said, and its seconds there."""
    done = execute(*line, check=False, processor=seconds)
    over = done.processor >= seconds or done.status == -signal.SIGXCPU
    return ("timeout" if over else done.status), done.text, done.processor


def files(folder):
    endings = re.compile(r"\.(step|stp|iges|igs|brep|rle|fcstd)(\.gz)?$", re.I)
    return sorted(path for path in pathlib.Path(folder).rglob("*") if endings.search(path.name))


def gmsh_row(solid, cells, limit):
    code, said, _ = run(["/usr/bin/python3", "-c", GMSH, solid, cells], limit)
    words = said.split()
    if code != 0 or len(words) < 2:
        return "timeout" if code == "timeout" else "failed"
    return [int(words[-2]), float(words[-1])]


def mesh(folder, case, cells, limit):
    """What becomes of one solid: its cause, and what is measured or said."""
    code, said, seconds = run([BIN / "cutwater-mesh", "--case", case, "--run", folder, "--cells", cells], limit)
    if code == "timeout":
        return {"cause": "timeout", "shown": f"over {limit} s"}
    if code != 0:
        error = re.findall(r"cutwater-mesh: error: (.*)", said)
        return {"cause": "refused" if error else "crashed", "shown": (error[-1] if error else f"exit {code}")[:150]}
    results = record(folder)["results"]
    domain = results["domains"][0]
    layers = domain["layer_coverage"][0]
    row = {"cells": results["cells"], "seconds": round(seconds, 1), "dihedral": domain["least_dihedral_deg"],
           "allowed": domain["least_dihedral_allowed_deg"],
           "full": 100 * layers["full_thickness_faces"] / max(layers["wall_faces"], 1),
           "tapered": 100 * layers["thinned_by_taper_faces"] / max(layers["wall_faces"], 1),
           "bare": 100 * layers["without_layers_faces"] / max(layers["wall_faces"], 1),
           "sound": domain["prism_least_scaled_jacobian"] > 0 and domain["least_cell_volume_m3"] > 0}
    row["cause"] = "meshed" + ("" if is_fair(row) else ", flat tetrahedra")
    row["cause"] += "" if row["bare"] <= MOST_BARE else ", bare walls"
    return row


def is_fair(row):
    """Whether the least dihedral angle of a mesh is as large as asked."""
    return row["dihedral"] >= min(LEAST_DIHEDRAL, LEAST_SHARE * row["allowed"])


def one(task, options):
    """The row of one solid."""
    folder, case, refused = task
    if refused:
        return refused
    row = mesh(folder, case, options.cells, options.limit)
    if options.hxt:
        row["hxt"] = gmsh_row(folder / "geometry/part.brep", options.cells, options.limit)
    shutil.rmtree(folder / "mesh", ignore_errors=True)
    return row


def shown(name, row):
    text = f"{name:44s} {row.get('faces', 0):4d} faces  {row['cause']}: " + row.get("shown", "")
    if "cells" in row:
        text += (f"{row['cells']:7d} cells {row['seconds']:5.1f} s, dihedral {row['dihedral']:4.1f} of "
                 f"{row['allowed']:4.1f}, full {row['full']:5.1f} %, "
                 f"tapered {row['tapered']:4.1f} %, bare {row['bare']:.1f} %")
    if "hxt" in row:
        text += "  hxt " + (row["hxt"] if isinstance(row["hxt"], str) else f"{row['hxt'][0]:7d} {row['hxt'][1]:5.1f}")
    return text


def plain_files(path, work):
    """A file unpacked: name and path of what OpenCASCADE reads."""
    name = re.sub(r"\.gz$", "", path.name)
    if name.lower().endswith(".fcstd"):
        if not zipfile.is_zipfile(path):
            return
        with zipfile.ZipFile(path) as archive:
            for part in sorted(archive.namelist()):
                if part.endswith((".brp", ".brep")) and archive.getinfo(part).file_size > 0:  # FreeCAD keeps empty ones
                    plain = work / f"{name}.{pathlib.Path(part).stem}.brep"
                    plain.write_bytes(archive.read(part))
                    yield plain
    else:
        plain = work / name
        plain.write_bytes(gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes())
        yield plain


def listed_solids(folder, text):
    """Folder, number, faces, volume and (where there is one) row of refusal of each solid that cad_solids told of; a
    file that it did not read to the end is one more."""
    found = []
    for line in text.splitlines():
        made = re.match(r"solid (\d+) faces (\d+) volume (\S+)", line)
        refused = re.match(r"solid (\d+) refused: (.*)", line)
        ended = re.match(r"ended (timeout|-?\d+)$", line)
        if made:
            found.append((folder, made[1], int(made[2]), made[3], None))
        elif refused:
            found.append((folder, refused[1], 0, refused[2], {"cause": "not healed", "shown": refused[2][:150]}))
        elif ended and ended[1] != "0":
            error = re.findall(r"^cutwater\S*: error: (?:\S+: )?(.*)", text, re.M)
            if error and re.match("holds no (solid and no face|shape);", error[-1]):
                continue
            cause = "timeout" if ended[1] == "timeout" else "crashed" if ended[1][0] == "-" else "not read or not sewn"
            shown = error[-1] if error else f"reading ended with {ended[1]}"
            found.append((folder, "0", 0, str(folder), {"cause": cause, "shown": shown[:150]}))
    return found


def solids_of(path, work, case, limit):
    """The solids of a file, made where they are not there."""
    found = []
    for plain in plain_files(path, work):
        folder = plain.with_name(plain.name + ".d")
        listed = folder / "solids.txt"
        if not listed.exists():
            folder.mkdir(exist_ok=True)
            code, said, _ = run([BIN / "cad_solids", case, plain, folder], limit)
            listed.write_text(said + f"\nended {code}\n")
        plain.unlink()
        found += listed_solids(folder, listed.read_text())
    return found


def asked_and_had(rows):
    """What is asked of all solids, and what they had."""
    solids = [row for row in rows if row["cause"] != NO_SOLID]
    made = [row for row in solids if "cells" in row]
    causes = collections.Counter(row["cause"] for row in solids)
    slow = causes["timeout"] + sum(row["seconds"] > LIMIT for row in made)
    fair = sum(map(is_fair, made)) / len(made) if made else 0
    # The record tells no width of the gap at a bare face: all of the wall counts, also gaps with no room for two cells.
    # What tapers has its layers.
    return (("closed solids meshed without an invalid cell", str(len(solids)), str(sum(row["sound"] for row in made))),
            ("meshes with layers on 99 % of all wall, narrow gaps too", str(len(made)),
             str(sum(row["bare"] <= MOST_BARE for row in made))),
            (f"least dihedral {LEAST_DIHEDRAL} degrees, or {LEAST_SHARE} of its bound", f"{FAIR_SHARE:.0%}",
             f"{fair:.1%}"),
            (f"solids that take over {LIMIT} s", "0", str(slow)),
            ("solids at which a program crashed", "0", str(causes["crashed"])))


def summary(rows):
    for cause, count in collections.Counter(row["cause"] for row in rows).most_common():
        print(f"{count:4d} {cause}")
    made = [row for row in rows if "cells" in row]
    others = [row["hxt"][1] for row in rows if isinstance(row.get("hxt"), list)]
    if made:
        full = sum(row["full"] >= 95 for row in made)
        middle, slowest = statistics.median(row["dihedral"] for row in made), max(row["seconds"] for row in made)
        print(f"{len(made)} meshed: median of the least dihedral {middle:.1f}; layers of full thickness on 95 % in "
              f"{full}; slowest {slowest:.0f} s")
    if others:
        middle = statistics.median(others)
        print(f"{len(others)} meshed by HXT without layers: median of the least dihedral {middle:.1f}")
    print(f"\n{'':58}{'asked':>8}{'had':>8}")
    for text, asked, had in asked_and_had(rows):
        print(f"{text:58}{asked:>8}{had:>8}")


def main():
    parser = options_of(__doc__, cells=150000, jobs=2, brief=False)
    parser.add_argument("folder", nargs="*", default=list(filter(None, [os.environ.get("CUTWATER_CAD")])))
    parser.add_argument("--only", default="", help="files with this in their name")
    parser.add_argument("--most", type=int, default=8, help="solids of a file")
    parser.add_argument("--limit", type=int, default=LIMIT, help="seconds of the processor for a solid")
    parser.add_argument("--no-hxt", dest="hxt", action="store_false", help="without gmsh beside it")
    parser.add_argument("--out", help="folder that the table stays in, to go on from")
    options = parser.parse_args()
    if not options.folder:
        parser.error("no FOLDER; allowed: a folder of CAD files, or CUTWATER_CAD names one")
    work = pathlib.Path(options.out or tempfile.mkdtemp(prefix="cad-"))
    work.mkdir(parents=True, exist_ok=True)
    case = work / "case.yaml"
    case.write_text(CASE)
    table = work / "rows.json"
    rows = json.loads(table.read_text()) if table.exists() else {}
    seen, tasks = set(), {}
    for path in (path for folder in options.folder for path in files(folder)):
        if options.only not in path.name:
            continue
        solids = solids_of(path, work, case, options.limit)
        if not solids:
            rows[path.name] = {"cause": NO_SOLID}
        taken = 0
        for folder, number, faces, volume, refused in solids:
            if (faces, volume) in seen or taken == options.most:
                continue
            seen.add((faces, volume))
            taken += 1
            name = f"{folder.name[:-2]} {number}"
            if name not in rows:
                tasks[name] = (faces, (folder / number, case, refused))
    print(f"{len(seen)} solids, {len(tasks)} to do", file=sys.stderr, flush=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        futures = {pool.submit(one, task, options): (name, faces) for name, (faces, task) in tasks.items()}
        for future in concurrent.futures.as_completed(futures):
            name, faces = futures[future]
            rows[name] = {**future.result(), "faces": faces}
            print(shown(name, rows[name]), file=sys.stderr, flush=True)
            part = table.with_suffix(".part")
            part.write_text(json.dumps(rows, indent=1))
            part.replace(table)
    for name in () if options.brief else sorted(rows):
        print(shown(name, rows[name]))
    summary(list(rows.values()))
    if not options.out:
        shutil.rmtree(work)


if __name__ == "__main__":
    main()
