#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""The pump of docs/own-cad.md and cases/own-cad: a closed wheel of six blades between plane walls, in a concentric
casing. Its edges are lines, circles and one spline, so that its STEP file is small."""
import draw


def pump():
    water = draw.revolved((0, -26), [(12, -26), ((38, 0), (38, -26)), (101, 0), (101, -9), (62, -9),
                                     ((37, -34), (62, -34)), (37, -90), (0, -90), (0, -26)])
    outline = draw.OCC.addPlaneSurface([draw.profile(-9, 64, 97, 22, 26, 4, 0)])
    blade = [body for body in draw.OCC.extrude([(2, outline)], 0, 0, 9) if body[0] == 3]
    draw.cut(water, draw.copies(blade, 6))
    draw.casing(101, 9, 145, 40, -4.5, 18, 220)


CAD = """  domains:
    rotor:  {inside_mm: [0, 0, -80], rotating: true}
    stator: {inside_mm: [0, 110, -4.5]}
  patches:
    inlet: {near_mm: [0, 0, -90]}
    discharge: {near_mm: [126, 180, 13.5]}
    outlet: {near_mm: [126, 220, -4.5]}
"""

if __name__ == "__main__":
    draw.main("own_cad", pump, CAD, cells=150000, y_plus=60, layers="auto", growth=1.2)
