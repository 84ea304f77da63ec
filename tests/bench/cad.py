#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Solids of any CAD files through the mesher: each closed solid as a domain of its own, all its faces walls with five
layers, beside gmsh's HXT without layers on the same faces.

    tests/bench/cad.py FOLDER [--cells N] [--only WORD] [--keep DIR]

FOLDER holds STEP (.step, .stp, .step.gz) and B-rep files (.brep, .rle), at any depth: OpenCASCADE's samples are in
/usr/share/opencascade/data of Debian's occt-misc, gmsh's demos in its gmsh-doc. Solids of as many faces
and the same volume count once. Healing is ShapeFix and the division of closed faces (tests/measure/cad_solids.cpp);
solids that it leaves invalid, or with degenerate edges, are listed but not meshed."""
import argparse
import collections
import gzip
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

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
    """What a program said and how it ended; "timeout" where it did not."""
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
    try:
        result = subprocess.run([str(word) for word in line], env=environment, stdin=subprocess.DEVNULL, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds, errors="replace")
        return result.returncode, result.stdout
    except subprocess.TimeoutExpired as late:
        return "timeout", (late.stdout or b"").decode(errors="replace")


def files(folder):
    endings = re.compile(r"\.(step|stp|brep|rle)(\.gz)?$", re.I)
    return sorted(path for path in pathlib.Path(folder).rglob("*") if endings.search(path.name))


def gmsh_row(solid, cells):
    code, said = run(["/usr/bin/python3", "-c", GMSH, solid, cells], MOST_SECONDS)
    words = said.split()
    if code != 0 or len(words) < 2:
        return "hxt timeout" if code == "timeout" else "hxt failed"
    return f"hxt {int(words[-2]):7d} {float(words[-1]):5.1f}"


def mesh(folder, case, cells):
    """The cause, and what is shown, of one solid."""
    started = time.time()
    code, said = run([BIN / "cutwater-mesh", "--case", case, "--run", folder, "--cells", cells], MOST_SECONDS)
    seconds = time.time() - started
    if code == "timeout":
        return "timeout", f"over {MOST_SECONDS} s"
    if code != 0:
        error = re.findall(r"cutwater-mesh: error: (.*)", said)
        return ("refused" if error else "crashed"), (error[-1] if error else f"exit {code}")[:150]
    results = json.loads((folder / "mesh/record.json").read_text())["results"]
    domain = results["domains"][0]
    layers = domain["layer_coverage"][0]
    least, allowed = domain["least_dihedral_deg"], domain["least_dihedral_allowed_deg"]
    bare = re.search(r"faces, (\S+) % of the wall, carry no layers", said)
    full = 100 * layers["full_thickness_faces"] / max(layers["wall_faces"], 1)
    cause = "meshed" if least >= min(LEAST_DIHEDRAL, LEAST_SHARE * allowed) else "meshed, flat tetrahedra"
    if bare:
        cause += ", bare walls"
    return cause, (f"{results['cells']:7d} cells {seconds:5.1f} s, dihedral {least:4.1f} of {allowed:4.1f}, full "
                   f"{full:5.1f} %" + (f", bare {bare[1]} %" if bare else ""))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--cells", type=int, default=150000)
    parser.add_argument("--only", default="", help="files with this in their name")
    parser.add_argument("--keep", help="folder that the runs stay in")
    options = parser.parse_args()
    work = pathlib.Path(options.keep or tempfile.mkdtemp(prefix="cad-"))
    work.mkdir(parents=True, exist_ok=True)
    case = work / "case.yaml"
    case.write_text(CASE)
    seen, causes = set(), collections.Counter()
    for path in files(options.folder):
        if options.only not in path.name:
            continue
        name = re.sub(r"\.gz$", "", path.name)
        plain = work / name
        plain.write_bytes(gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes())
        code, said = run([BIN / "cad_solids", case, plain, work / (name + ".d")], MOST_SECONDS)
        solids = re.findall(r"^solid (\d+) faces (\d+) valid (\d) degenerate (\d+) volume (\S+)", said, re.M)
        if not solids:
            causes["no closed solid"] += 1
            print(f"{name:36s} no closed solid", flush=True)
        for number, faces, valid, degenerate, volume in solids:
            folder = work / (name + ".d") / number
            solid = folder / "geometry/part.brep"
            if (faces, volume) in seen:
                continue
            seen.add((faces, volume))
            if valid != "1" or degenerate != "0":
                cause, shown = (("not healed", "invalid") if valid != "1" else
                                ("poles", f"{degenerate} degenerate edges"))
                beside = ""
            else:
                cause, shown = mesh(folder, case, options.cells)
                beside = gmsh_row(solid, options.cells)
            causes[cause] += 1
            print(f"{name + ' ' + number:36s} {faces:>4s} faces  {cause}: {shown}  {beside}", flush=True)
            shutil.rmtree(folder / "mesh", ignore_errors=True)
    for cause, count in causes.most_common():
        print(f"{count:4d} {cause}")
    if not options.keep:
        shutil.rmtree(work)


if __name__ == "__main__":
    sys.exit(main())
