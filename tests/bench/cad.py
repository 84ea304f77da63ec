#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Solids of any CAD files through the mesher: each closed solid as a domain of its own, all its faces walls with five
layers, beside gmsh's HXT without layers on the same faces.

    tests/bench/cad.py FOLDER... [--cells N] [--only WORD] [--most N] [--jobs 2] [--out DIR]

FOLDER holds STEP (.step, .stp, .step.gz) and B-rep files (.brep, .rle), at any depth: OpenCASCADE's samples are in
/usr/share/opencascade/data of Debian's occt-misc, gmsh's demos in its gmsh-doc, parts of circuits in its
kicad-packages3d. Solids of as many faces and the same volume count once. Healing is ShapeFix and the division of closed
faces (tests/measure/cad_solids.cpp); solids that it leaves invalid, or with degenerate edges, are listed but not
meshed.

DIR/rows.json holds what is done: a call with the same DIR goes on. Times are those of the processor."""
import argparse
import collections
import concurrent.futures
import gzip
import json
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("CUTWATER_BIN", SOURCE / "build/bin"))
MOST_SECONDS = 150
LEAST_DIHEDRAL, LEAST_SHARE = 10, 0.6  # degrees, or of what the boundary allows

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
    """What a program said, how it ended ("timeout" where it took more of the processor), and its seconds there."""
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))

    with tempfile.TemporaryFile() as said:
        child = subprocess.Popen([str(word) for word in line], env=environment, stdin=subprocess.DEVNULL, stdout=said,
                                 stderr=subprocess.STDOUT, preexec_fn=limit)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read().decode(errors="replace")
    took = used.ru_utime + used.ru_stime
    return ("timeout" if took >= seconds else child.returncode), text, took


def files(folder):
    endings = re.compile(r"\.(step|stp|brep|rle)(\.gz)?$", re.I)
    return sorted(path for path in pathlib.Path(folder).rglob("*") if endings.search(path.name))


def gmsh_row(solid, cells):
    code, said, _ = run(["/usr/bin/python3", "-c", GMSH, solid, cells], MOST_SECONDS)
    words = said.split()
    if code != 0 or len(words) < 2:
        return "timeout" if code == "timeout" else "failed"
    return [int(words[-2]), float(words[-1])]


def mesh(folder, case, cells):
    """What becomes of one solid: its cause, and what is measured or said."""
    code, said, seconds = run([BIN / "cutwater-mesh", "--case", case, "--run", folder, "--cells", cells], MOST_SECONDS)
    if code == "timeout":
        return {"cause": "timeout", "shown": f"over {MOST_SECONDS} s"}
    if code != 0:
        error = re.findall(r"cutwater-mesh: error: (.*)", said)
        return {"cause": "refused" if error else "crashed", "shown": (error[-1] if error else f"exit {code}")[:150]}
    results = json.loads((folder / "mesh/record.json").read_text())["results"]
    domain = results["domains"][0]
    layers = domain["layer_coverage"][0]
    row = {"cells": results["cells"], "seconds": round(seconds, 1), "dihedral": domain["least_dihedral_deg"],
           "allowed": domain["least_dihedral_allowed_deg"],
           "full": 100 * layers["full_thickness_faces"] / max(layers["wall_faces"], 1)}
    bare = re.search(r"faces, (\S+) % of the wall, carry no layers", said)
    row["bare"] = float(bare[1]) if bare else 0
    flat = row["dihedral"] < min(LEAST_DIHEDRAL, LEAST_SHARE * row["allowed"])
    row["cause"] = "meshed" + (", flat tetrahedra" if flat else "") + (", bare walls" if row["bare"] else "")
    return row


def one(task):
    """The row of one solid."""
    folder, case, cells, valid, degenerate = task
    solid = folder / "geometry/part.brep"
    if valid != "1":
        return {"cause": "not healed", "shown": "invalid"}
    if degenerate != "0":
        return {"cause": "poles", "shown": f"{degenerate} degenerate edges"}
    row = mesh(folder, case, cells)
    row["hxt"] = gmsh_row(solid, cells)
    shutil.rmtree(folder / "mesh", ignore_errors=True)
    return row


def shown(name, row):
    text = f"{name:44s} {row.get('faces', 0):4d} faces  {row['cause']}: " + row.get("shown", "")
    if "cells" in row:
        text += (f"{row['cells']:7d} cells {row['seconds']:5.1f} s, dihedral {row['dihedral']:4.1f} of "
                 f"{row['allowed']:4.1f}, full {row['full']:5.1f} %, bare {row['bare']:.1f} %")
    if "hxt" in row:
        text += "  hxt " + (row["hxt"] if isinstance(row["hxt"], str) else f"{row['hxt'][0]:7d} {row['hxt'][1]:5.1f}")
    return text


def solids_of(path, work, case):
    """Name, number and sort of the solids of a file, made where they are not there."""
    name = re.sub(r"\.gz$", "", path.name)
    folder = work / (name + ".d")
    listed = folder / "solids.txt"
    if not listed.exists():
        plain = work / name
        plain.write_bytes(gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes())
        folder.mkdir(exist_ok=True)
        listed.write_text(run([BIN / "cad_solids", case, plain, folder], MOST_SECONDS)[1])
        plain.unlink()
    found = re.findall(r"^solid (\d+) faces (\d+) valid (\d) degenerate (\d+) volume (\S+)", listed.read_text(), re.M)
    return name, folder, found


def summary(rows):
    for cause, count in collections.Counter(row["cause"] for row in rows).most_common():
        print(f"{count:4d} {cause}")
    made = [row for row in rows if "cells" in row]
    others = [row["hxt"][1] for row in rows if isinstance(row.get("hxt"), list)]
    if made:
        fair = sum(row["dihedral"] >= min(LEAST_DIHEDRAL, LEAST_SHARE * row["allowed"]) for row in made)
        layers = sum(row["full"] + row["bare"] >= 99 for row in made)
        middle, slowest = statistics.median(row["dihedral"] for row in made), max(row["seconds"] for row in made)
        print(f"{len(made)} meshed: median of the least dihedral {middle:.1f}, fair in {fair}; full layers on 99 % in "
              f"{layers}; slowest {slowest:.0f} s")
    if others:
        middle = statistics.median(others)
        print(f"{len(others)} meshed by HXT without layers: median of the least dihedral {middle:.1f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="+")
    parser.add_argument("--cells", type=int, default=150000)
    parser.add_argument("--only", default="", help="files with this in their name")
    parser.add_argument("--most", type=int, default=8, help="solids of a file")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", help="folder that the table stays in, to go on from")
    options = parser.parse_args()
    work = pathlib.Path(options.out or tempfile.mkdtemp(prefix="cad-"))
    work.mkdir(parents=True, exist_ok=True)
    case = work / "case.yaml"
    case.write_text(CASE)
    table = work / "rows.json"
    rows = json.loads(table.read_text()) if table.exists() else {}
    seen, tasks = set(), {}
    for path in [path for folder in options.folder for path in files(folder)]:
        if options.only not in path.name:
            continue
        name, folder, solids = solids_of(path, work, case)
        if not solids:
            rows[name] = {"cause": "no closed solid"}
        taken = 0
        for number, faces, valid, degenerate, volume in solids:
            if (faces, volume) in seen or taken == options.most:
                continue
            seen.add((faces, volume))
            taken += 1
            if f"{name} {number}" not in rows:
                tasks[f"{name} {number}"] = (int(faces), (folder / number, case, options.cells, valid, degenerate))
    print(f"{len(seen)} solids, {len(tasks)} to do", flush=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        futures = {pool.submit(one, task): (name, faces) for name, (faces, task) in tasks.items()}
        for future in concurrent.futures.as_completed(futures):
            name, faces = futures[future]
            rows[name] = {**future.result(), "faces": faces}
            print(shown(name, rows[name]), flush=True)
            part = table.with_suffix(".part")
            part.write_text(json.dumps(rows, indent=1))
            part.replace(table)
    for name in sorted(rows):
        print(shown(name, rows[name]))
    summary(list(rows.values()))
    if not options.out:
        shutil.rmtree(work)


if __name__ == "__main__":
    sys.exit(main())
