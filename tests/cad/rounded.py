#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""rounded.py FOLDER: solids of about 100 mm with fillets of 0.15 mm along all their edges, or chamfers, which meet in
their corners, as CAD programs leave them on castings: FOLDER/NAME.step each."""
import math
import pathlib
import sys

import gmsh

OCC = gmsh.model.occ
SMALL = 0.15  # mm


def prism(sides, top=1.0):
    """On a regular polygon; at the top so many times as wide."""
    loops = []
    for z, radius in ((0, 40), (50, 40 * top)):
        turns = [2 * math.pi * i / sides for i in range(sides)]
        points = [OCC.addPoint(radius * math.cos(turn), radius * math.sin(turn), z) for turn in turns]
        loops.append(OCC.addCurveLoop([OCC.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]))
    return OCC.addThruSections(loops, makeSolid=True, makeRuled=True)[0][1]


def block(*more):
    """A box, less or with another body: the name of the operation, what makes that body, and its sizes."""
    box = OCC.addBox(0, 0, 0, 100, 60, 40)
    for operation, make, *sizes in more:
        box = operation([(3, box)], [(3, make(*sizes))])[0][0][1]
    return box


def edges():
    OCC.synchronize()
    return [tag for _, tag in gmsh.model.getEntities(1)]


def filleted(solid, which=slice(None), radius=SMALL):
    return OCC.fillet([solid], edges()[which], [radius])[0][1]


def chamfered(solid):
    beside = [gmsh.model.getAdjacencies(1, edge)[0][0] for edge in edges()]
    OCC.chamfer([solid], edges(), beside, [SMALL])


SOLIDS = {
    "prism_3": lambda: filleted(prism(3)),
    "prism_5": lambda: filleted(prism(5)),
    "frustum": lambda: filleted(prism(4, 0.5)),
    "notched": lambda: filleted(block((OCC.cut, OCC.addBox, 50, 30, -1, 60, 60, 60))),
    "corner": lambda: filleted(block((OCC.cut, OCC.addBox, 50, 30, 20, 60, 60, 60))),
    "pocket": lambda: filleted(block((OCC.cut, OCC.addBox, 30, 20, 20, 40, 20, 40))),
    "boss": lambda: filleted(block((OCC.fuse, OCC.addCylinder, 50, 30, 20, 0, 0, 40, 12))),
    "some_edges": lambda: filleted(block(), slice(7)),
    "one_wide": lambda: filleted(filleted(block(), slice(1), 8)),
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
