#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Compares the patch mesher with gmsh (frontal, Delaunay) on a flat square, uniform and graded, on one core.

patch_mesh.py [--build build] [EDGE_LENGTH ...]"""
import shutil
import tempfile
from pathlib import Path

from programs import SOURCE, execute, gmsh_steps, options_of
from surface import least_angles


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
    done = execute("gmsh", "-2", "-nt", 1, "-algo", algorithm, "-bin", "-format", "msh22", "-o", mesh, geo)
    seconds = gmsh_steps(done.text)["meshing 2D"]
    angles = least_angles(mesh)
    print(f"{title:24s} {len(angles):9d} {len(angles) / max(seconds, 1e-9):12.0f} {angles[0]:6.1f} "
          f"{angles[len(angles) // 100]:6.1f} {sum(angles) / len(angles):6.1f}", flush=True)


def main():
    parser = options_of(__doc__, build=SOURCE / "build")
    parser.add_argument("lengths", nargs="*", type=float, default=[0.01, 0.003], metavar="EDGE_LENGTH")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = options.build / "bin/patch_mesh"
        for graded in (0, 1):
            for length in options.lengths:
                print(f"{'graded' if graded else 'uniform'} square, edge length {length}\n"
                      f"{'':24s} {'triangles':>9s} {'per second':>12s} {'least':>6s} {'1 %':>6s} "
                      f"{'mean':>6s}  (least angle)")
                print(execute(program, length, graded).text, end="", flush=True)
                if shutil.which("gmsh"):
                    run_gmsh(folder, "gmsh frontal", "front2d", length, graded)
                    run_gmsh(folder, "gmsh Delaunay", "del2d", length, graded)


if __name__ == "__main__":
    main()
