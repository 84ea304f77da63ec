# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the benchmarks read of solved OpenFOAM cases: binary fields and meshes as this machine writes them, and surfaces
that were sampled as ASCII VTK."""
import array
import math
import re
from bisect import bisect_left


def latest(case):
    """The folder of the case's latest time."""
    times = [path for path in case.iterdir() if re.fullmatch(r"\d+(\.\d+)?(e-?\d+)?", path.name)]
    return max(times, key=lambda path: float(path.name))


def numbers(data, at, kind, count):
    values = array.array(kind)
    values.frombytes(data[at:at + count * values.itemsize])
    return values, at + count * values.itemsize


def lists(path, kinds):
    """The lists of a binary file, one after the other: "d" of scalars, "i" of labels, "3d" of vectors."""
    data = path.read_bytes()
    at = data.index(b"}") + 1
    for kind in kinds:
        found = re.compile(rb"\s(\d+)\s*\(").search(data, at)
        times = 3 if kind == "3d" else 1
        values, at = numbers(data, found.end(), kind[-1], times * int(found[1]))
        yield values


def patch_values(path):
    """Patch: the values of its faces, of a volScalarField; those of patches with one value for all are left out."""
    data, found = path.read_bytes(), {}
    start = data.index(b"boundaryField")
    for match in re.finditer(rb"\n    (\w+)\n    \{[^{}]*?value\s+nonuniform List<scalar>\s+(\d+)\s*\(", data[start:]):
        found[match[1].decode()] = numbers(data, start + match.end(), "d", int(match[2]))[0]
    return found


def area(corners):
    total = [0, 0, 0]
    for b, c in zip(corners[1:], corners[2:]):
        u, v = ([p[k] - corners[0][k] for k in range(3)] for p in (b, c))
        for k in range(3):
            total[k] += (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]) / 2
    return math.hypot(*total)


def patch_areas(case):
    """Patch: the areas of its faces, m2, of the case's mesh."""
    mesh = case / "constant/polyMesh"
    points, = lists(mesh / "points", ["3d"])
    starts, labels = lists(mesh / "faces", ["i", "i"])
    found = {}
    for name, count, first in re.findall(r"\n    (\w+)\n    \{.*?nFaces\s+(\d+);.*?startFace\s+(\d+);",
                                         (mesh / "boundary").read_text(), re.S):
        found[name] = [area([points[3 * p:3 * p + 3] for p in labels[starts[f]:starts[f + 1]]])
                       for f in range(int(first), int(first) + int(count))]
    return found


def sampled(path):
    """(area, middle, {field: value}) of each polygon of a VTK file of surfaces."""
    words = path.read_text().split()
    at = words.index("POINTS")
    points = [tuple(map(float, words[k:k + 3])) for k in range(at + 3, at + 3 + 3 * int(words[at + 1]), 3)]
    at = words.index("POLYGONS")
    count, at, polygons = int(words[at + 1]), at + 3, []
    for _ in range(count):
        corners = [points[int(word)] for word in words[at + 1:at + 1 + int(words[at])]]
        polygons.append((area(corners), [sum(p[k] for p in corners) / len(corners) for k in range(3)], {}))
        at += 1 + int(words[at])
    at = words.index("FIELD", words.index("CELL_DATA"))
    fields, at = int(words[at + 2]), at + 3
    for _ in range(fields):
        name, size = words[at], int(words[at + 1])
        at += 4
        for polygon in polygons:
            polygon[2][name] = tuple(map(float, words[at:at + size]))
            at += size
    return polygons


def ring_means(path, low, high):
    """Radial and tangential velocity on a cylinder about z between two heights, weighted by area."""
    whole = radial = tangential = 0
    for face, (x, y, z), values in sampled(path):
        u, r = values["U"], math.hypot(x, y)
        if low < z < high:
            whole += face
            radial += face * (u[0] * x + u[1] * y) / r
            tangential += face * (u[1] * x - u[0] * y) / r
    return radial / whole, tangential / whole


def radial_means(path, radii):
    """The mean of p over the faces whose radius is nearest to each of the radii, by rings that meet midway; NAN where
    there are none."""
    ends = [(a + b) / 2 for a, b in zip(radii, radii[1:])]
    whole, sums = [0.0] * len(radii), [0.0] * len(radii)
    for face, (x, y, _), values in sampled(path):
        ring = bisect_left(ends, math.hypot(x, y))
        whole[ring] += face
        sums[ring] += face * values["p"][0]
    return [total / size if size else math.nan for total, size in zip(sums, whole)]
