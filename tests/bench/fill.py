#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Compares the ways to fill a closed surface: our kernel, TetGen behind the same call, and Gmsh's HXT.

Use, from the top of the source:
  tests/bench/fill.py BUILD_DIR [--ring EDGE_LENGTH ...] [--run RUN_DIR ...] [--regions NAME ...] [--repeat N]
Surfaces are a ring with a void, for each edge length in m (of 0.26 m across), and the inner boundaries of the
regions that a run of the mesher left in RUN_DIR/mesh. Seconds are user time of one core, the least of N runs
in turn; memory is the peak less what stood before. HXT chooses its own number of tetrahedra.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]


def compile_program(build, folder):
    program = folder / "fill"
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "hdf5-openmpi", "libfyaml", "jansson"],
                           check=True, capture_output=True, text=True).stdout.split()
    subprocess.run(["mpicc", "-std=c11", "-D_GNU_SOURCE", "-O2", "-ffp-contract=off", f"-I{SOURCE}",
                    str(SOURCE / "tests/bench/fill.c"), "-o", str(program),
                    str(build / "mesher/libcutwater_mesher_room.a"),
                    str(build / "pipeline/libcutwater_pipeline.a"), "-ltet", *flags, "-lgmp", "-lmpfr",
                    "-lstdc++", "-lm"], check=True)
    return program


def run_ours(program, way, surface):
    """triangles, tets, seconds, bytes a tet, aspect mean, aspect max, least dihedral"""
    done = subprocess.run([str(program), way, str(surface)], capture_output=True, text=True)
    if done.returncode:
        return done.stderr.strip().split("\n")[-1]
    words = done.stdout.split()
    return [int(words[0]), int(words[1]), float(words[2]), float(words[4]), *map(float, words[5:8])]


def run_gmsh(folder, surface, shells, *options, algorithm="hxt"):
    mesh = folder / "hxt.msh"
    script = folder / "hxt.geo"
    loops = "".join(f"Surface Loop({k}) = {{{k}}};\n" for k in range(1, shells + 1))
    numbers = ", ".join(str(k) for k in range(1, shells + 1))
    script.write_text(f'Merge "{surface}";\n{loops}Volume(1) = {{{numbers}}};\nMesh.SaveAll = 1;\n')
    mesh.unlink(missing_ok=True)
    child = subprocess.Popen(["gmsh", *options, "-nt", "1", "-algo", algorithm, "-format", "msh2", "-o",
                              str(mesh), str(script)],
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    text = child.stdout.read()
    _, status, use = os.wait4(child.pid, 0)
    child.returncode = status
    return text, use.ru_maxrss * 1024, mesh


def run_hxt(program, folder, surface, shells):
    _, before, _ = run_gmsh(folder, surface, shells, "-2")
    text, peak, mesh = run_gmsh(folder, surface, shells, "-3")
    seconds = re.search(r"Done meshing 3D \(Wall [\d.e-]+s, CPU ([\d.e-]+)s\)", text)
    if not seconds or not mesh.exists():
        return "failed"
    words = subprocess.run([str(program), "quality", str(mesh)], check=True, capture_output=True,
                           text=True).stdout.split()
    tets = int(words[1])
    if tets == 0:
        return "failed"
    return [int(words[0]), tets, float(seconds.group(1)), max(0, peak - before) / tets,
            *map(float, words[2:5])]


def compare(program, folder, title, surface, shells, repeat):
    ways = [("kernel", lambda: run_ours(program, "kernel", surface)),
            ("tetgen", lambda: run_ours(program, "tetgen", surface))]
    if shutil.which("gmsh"):
        ways.append(("hxt", lambda: run_hxt(program, folder, surface, shells)))
    best = {}
    for _ in range(repeat):
        for name, way in ways:
            row = way()
            if name not in best or isinstance(best[name], str) or \
                    (not isinstance(row, str) and row[2] < best[name][2]):
                best[name] = row
    for name, _ in ways:
        row = best[name]
        if isinstance(row, str):
            print(f"{title:22s} {'':8s} {name:7s} {row}", flush=True)
            continue
        triangles, tets, seconds, size, mean, most, least = row
        print(f"{title:22s} {triangles:8d} {name:7s} {tets:9d} {seconds:8.3f} {tets / seconds:9.0f} "
              f"{size:6.0f} {mean:6.3f} {most:6.2f} {least:6.2f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--ring", type=float, nargs="*", default=[0.003, 0.002])
    parser.add_argument("--run", type=Path, nargs="*", default=[])
    parser.add_argument("--regions", nargs="*", help="names such as rotor-0001; all by default")
    parser.add_argument("--repeat", type=int, default=1)
    words = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = compile_program(words.build, folder)
        print(f"{'surface':22s} {'facets':>8s} {'way':7s} {'tets':>9s} {'seconds':>8s} {'tets/s':>9s} "
              f"{'B/tet':>6s} {'aspect':>6s} {'max':>6s} {'least':>6s}", flush=True)
        surface = folder / "surface.msh"
        for edge in words.ring:
            subprocess.run([str(program), "ring", str(edge), str(surface)], check=True)
            compare(program, folder, f"ring {edge}", surface, 2, words.repeat)
        for run in words.run:
            for region in sorted((run / "mesh").glob("*.h5")):
                if words.regions and region.stem not in words.regions:
                    continue
                subprocess.run([str(program), "region", str(region), str(surface)], check=True)
                compare(program, folder, region.stem, surface, 1, words.repeat)


if __name__ == "__main__":
    sys.exit(main())
