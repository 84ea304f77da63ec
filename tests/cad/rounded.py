#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""rounded.py FOLDER: solids of about 100 mm with fillets of 0.15 mm along all their edges, or chamfers, which meet in
their corners, as CAD programs leave them on castings: FOLDER/NAME.step each."""
import math
import pathlib
import sys

import gmsh

import draw

OCC = draw.OCC
SMALL = 0.15  # mm


def prism(sides, top=1.0):
    """On a regular polygon; at the top so many times as wide."""
    loops = []
    for z, radius in ((0, 40), (50, 40 * top)):
        points = [OCC.addPoint(*draw.polar(radius, 2 * math.pi * i / sides, z)) for i in range(sides)]
        loops.append(OCC.addCurveLoop([OCC.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]))
    return OCC.addThruSections(loops, makeSolid=True, makeRuled=True)


def box(x, y, z, *sizes):
    return [(3, OCC.addBox(x, y, z, *sizes))]


def block():
    return box(0, 0, 0, 100, 60, 40)


def filleted(body, chosen=lambda kinds, at: True, radius=SMALL):
    return draw.filleted(body, radius, chosen)


def chamfered(body):
    OCC.synchronize()
    edges = [tag for _, tag in gmsh.model.getEntities(1)]
    beside = [gmsh.model.getAdjacencies(1, edge)[0][0] for edge in edges]
    return OCC.chamfer([tag for _, tag in body], edges, beside, [SMALL])


def above(kinds, at):
    return at[1] > 10


def upright_at_the_origin(kinds, at):
    return at[0] < 1 and 10 < at[1] < 30


SOLIDS = {
    "prism_3": lambda: filleted(prism(3)),
    "prism_5": lambda: filleted(prism(5)),
    "frustum": lambda: filleted(prism(4, 0.5)),
    "notched": lambda: filleted(draw.cut(block(), box(50, 30, -1, 60, 60, 60))),
    "corner": lambda: filleted(draw.cut(block(), box(50, 30, 20, 60, 60, 60))),
    "pocket": lambda: filleted(draw.cut(block(), box(30, 20, 20, 40, 20, 40))),
    "boss": lambda: filleted(draw.fused(block(), [(3, OCC.addCylinder(50, 30, 20, 0, 0, 40, 12))])),
    "some_edges": lambda: filleted(block(), above),
    "one_wide": lambda: filleted(filleted(block(), upright_at_the_origin, 8)),
    "chamfered": lambda: chamfered(block()),
}

if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for name, make in SOLIDS.items():
        gmsh.model.add(name)
        make()
        OCC.synchronize()
        gmsh.write(str(pathlib.Path(sys.argv[1]) / f"{name}.step"))
        gmsh.model.remove()
