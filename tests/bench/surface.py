#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""surface.py [--cells 2M] [--repeat 3] [--bin build/bin] [--case cases/paper/case.yaml]

The surface mesh beside gmsh's frontal and Delaunay ones (`gmsh -2 -nt 1 -algo front2d | del2d`) on the same STEP file,
at about the same number of triangles, on one core: triangles a second, and their least angles (least, 1 %, mean). The
runs alternate. Cutwater's triangles follow a graded size field (curvature, gaps, patches), gmsh's here one size and
curvature. Cutwater's rate is that of its step `surface`, passes that correct the count included."""
import math
import statistics
import struct
import tempfile
from pathlib import Path

from programs import execute, gmsh, options_of, size_for
from runs import BIN, PAPER_CASE, record, stage_line

NEAR = 0.1  # of the number of triangles, between the two


def cutwater(options, run):
    """Seconds of the surface steps and triangles made by them, on one rank."""
    execute("mpirun", "-q", "-n", 1, options.bin / "cutwater-mesh", "--case", options.case, "--run", run,
            "--cells", options.cells)
    made = record(run)
    seconds = [step["seconds"] for step in made["steps"] if step["name"] == "surface"]
    walls = sum(wall["wall_faces"] for domain in made["results"]["domains"] for wall in domain["layer_coverage"])
    return sum(seconds), walls * len(seconds), walls


def shape(options, run):
    """Least, 1 % (of the worst patch) and mean of the least angles of our triangles on walls."""
    said = execute(options.bin / "surface_shape", run / "geometry", run / "mesh").text
    rows = [line.split() for line in said.splitlines()[1:]]
    count = sum(int(row[2]) for row in rows)
    return (min(float(row[3]) for row in rows), sum(float(row[4]) * int(row[2]) for row in rows) / count,
            sum(float(row[5]) * int(row[2]) for row in rows) / count)


def walls(step, size, algorithm, folder):
    """gmsh's triangles; their mesh in gmsh.msh."""
    return gmsh(step, size, algorithm, folder, dimension=2, mesh=folder / "gmsh.msh",
                more=("-clcurv", 18, "-format", "msh22"))


def least_angles(mesh):
    """The least angles of the triangles of a binary MSH 2.2 file, sorted, degrees."""
    data = mesh.read_bytes()
    at = data.index(b"$Nodes\n") + 7
    end = data.index(b"\n", at)
    count = int(data[at:end])
    nodes = {number: (x, y, z) for number, x, y, z in struct.iter_unpack("<iddd", data[end + 1:end + 1 + 28 * count])}
    at = data.index(b"$Elements\n") + 10
    at = data.index(b"\n", at) + 1
    corners = {15: 1, 1: 2, 2: 3}
    angles = []
    while data[at:at + 12] != b"$EndElements" and data[at + 1:at + 13] != b"$EndElements":
        kind, number, tags = struct.unpack_from("<iii", data, at)
        size_of = 4 * (1 + tags + corners[kind])
        at += 12
        if kind == 2:
            places = (at + i * size_of + 4 * (1 + tags) for i in range(number))
            angles += [least_angle([nodes[n] for n in struct.unpack_from("<iii", data, place)]) for place in places]
        at += number * size_of
    return sorted(angles)


def least_angle(x):
    """Least angle of a triangle, degrees."""
    least = 180.0
    for i in range(3):
        u = [q - p for p, q in zip(x[i], x[(i + 1) % 3])]
        v = [q - p for p, q in zip(x[i], x[(i + 2) % 3])]
        cosine = sum(a * b for a, b in zip(u, v)) / math.sqrt(sum(a * a for a in u) * sum(b * b for b in v))
        least = min(least, math.degrees(math.acos(max(-1.0, min(1.0, cosine)))))
    return least


def main():
    options = options_of(__doc__, cells="2M", repeat=3, bin=BIN, case=PAPER_CASE).parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run = folder / "run"
        step = run / "geometry/pump.step"
        execute(*stage_line(options.bin, "geometry", options.case, run))
        rates = {"cutwater": [], "front2d": [], "del2d": []}
        shapes = {}
        counts = {}
        size = None
        for _ in range(options.repeat):
            seconds, made, counts["cutwater"] = cutwater(options, run)
            rates["cutwater"].append(made / seconds)
            shapes["cutwater"] = shapes.get("cutwater") or shape(options, run)
            size = size or size_for(counts["cutwater"], 1.0, 2, NEAR,
                                    lambda size: walls(step, size, "del2d", folder).triangles)
            for algorithm in ("front2d", "del2d"):
                made = walls(step, size, algorithm, folder)
                angles = least_angles(folder / "gmsh.msh")
                counts[algorithm] = made.triangles
                rates[algorithm].append(made.triangles / made.steps["meshing 2D"])
                shapes[algorithm] = (angles[0], angles[len(angles) // 100], sum(angles) / len(angles))
    print(f"{'':10s} {'triangles':>10s} {'per second':>11s} {'least':>6s} {'1 %':>6s} {'mean':>6s}")
    for name, title in (("cutwater", "cutwater"), ("front2d", "frontal"), ("del2d", "Delaunay")):
        least, low, mean = shapes[name]
        print(f"{title:10s} {counts[name]:10,d} {statistics.median(rates[name]):11,.0f} {least:6.1f} {low:6.1f} "
              f"{mean:6.1f}")


if __name__ == "__main__":
    main()
