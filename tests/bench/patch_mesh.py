#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Compares the patch mesher with gmsh (frontal, Delaunay) on a flat square, uniform and graded, on one core.

patch_mesh.py [--build build] [EDGE_LENGTH ...]"""
import argparse
import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]


def gmsh_angles(mesh_file):
    """Least angle of each triangle of an MSH 2.2 file, sorted, in degrees."""
    lines = mesh_file.read_text().split("\n")
    first = lines.index("$Nodes") + 2
    nodes = {}
    for line in lines[first:first + int(lines[first - 1])]:
        number, x, y, _ = line.split()
        nodes[number] = (float(x), float(y))
    first = lines.index("$Elements") + 2
    angles = []
    for line in lines[first:first + int(lines[first - 1])]:
        words = line.split()
        if words[1] != "2":
            continue
        corner = [nodes[n] for n in words[-3:]]
        least = 180.0
        for i in range(3):
            a, b, c = corner[i], corner[(i + 1) % 3], corner[(i + 2) % 3]
            u, v = (b[0] - a[0], b[1] - a[1]), (c[0] - a[0], c[1] - a[1])
            angle = math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
            least = min(least, math.degrees(abs(angle)))
        angles.append(least)
    return sorted(angles)


def run_gmsh(folder, title, algorithm, length, graded):
    side = 20 if graded else round(1 / length)
    # The lesser of two lengths, for gmsh's MathEval has no minimum.
    near = f"({length} + 0.2*Abs(Sqrt((x-0.5)^2 + (y-0.5)^2) - 0.3))"
    field = f"(0.05 + {near} - Abs(0.05 - {near}))/2"
    geo = folder / "square.geo"
    geo.write_text("Point(1)={0,0,0};Point(2)={1,0,0};Point(3)={1,1,0};Point(4)={0,1,0};\n"
                   "Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};\n"
                   f"Transfinite Line{{1:4}}={side + 1};Curve Loop(1)={{1,2,3,4}};Plane Surface(1)={{1}};\n"
                   "Mesh.CharacteristicLengthExtendFromBoundary=0;Mesh.CharacteristicLengthFromPoints=0;\n"
                   + (f'Field[1]=MathEval;Field[1].F="{field}";Background Field=1;\n' if graded else
                      f"Mesh.CharacteristicLengthMax={length};Mesh.CharacteristicLengthMin={length};\n"))
    mesh = folder / "square.msh"
    done = subprocess.run(["gmsh", "-2", "-nt", "1", "-algo", algorithm, "-format", "msh2", "-o", str(mesh),
                           str(geo)], check=True, capture_output=True, text=True)
    seconds = float(re.search(r"Done meshing 2D \(Wall [\d.e-]+s, CPU ([\d.e-]+)s\)", done.stdout).group(1))
    angles = gmsh_angles(mesh)
    print(f"{title:24s} {len(angles):9d} {len(angles) / max(seconds, 1e-9):12.0f} {angles[0]:6.1f} "
          f"{angles[len(angles) // 100]:6.1f} {sum(angles) / len(angles):6.1f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lengths", nargs="*", type=float, default=[0.01, 0.003], metavar="EDGE_LENGTH")
    parser.add_argument("--build", type=Path, default=SOURCE / "build")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = folder / "patch_mesh"
        subprocess.run(["cc", "-std=gnu11", "-O2", f"-I{SOURCE}", str(SOURCE / "tests/bench/patch_mesh.c"),
                        "-o", str(program), str(options.build / "mesher/libcutwater_mesher_room.a"),
                        str(options.build / "pipeline/libcutwater_pipeline.a"), "-lstdc++", "-lgmp", "-lmpfr", "-lm"],
                       check=True)
        for graded in (0, 1):
            for length in options.lengths:
                print(f"{'graded' if graded else 'uniform'} square, edge length {length}\n"
                      f"{'':24s} {'triangles':>9s} {'per second':>12s} {'least':>6s} {'1 %':>6s} "
                      f"{'mean':>6s}  (least angle)")
                sys.stdout.flush()
                subprocess.run([str(program), str(length), str(graded)], check=True)
                if shutil.which("gmsh"):
                    run_gmsh(folder, "gmsh frontal", "front2d", length, graded)
                    run_gmsh(folder, "gmsh Delaunay", "del2d", length, graded)


if __name__ == "__main__":
    main()
