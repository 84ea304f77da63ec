#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""A wheel with two eyes: the water comes along the shaft from both sides. Drawn about the x axis."""
import math

import draw


def pump():
    half = [(101, -8), (62, -14), ((37, -39), (62, -39)), (37, -90), (14, -90), (14, -50), ((50, 0), (50, -36))]
    water = draw.revolved((101, 8), half[:1] + half[1:-1] + [(14, 50)] + [(14, 90), (37, 90), (37, 39)] +
                          [((62, 14), (62, 39)), (101, 8)])
    blade = draw.lofted([draw.profile(z, 40, 97, 20, 26, 4, 0) for z in (-45, 45)], ruled=True)
    draw.cut(water, draw.copies(blade, 6))
    draw.casing(101, 16, 155, 50, 0, 23, 240)
    draw.OCC.rotate(draw.OCC.getEntities(3), 0, 0, 0, 0, 1, 0, math.pi / 2)


CAD = """  axis: {direction: [1, 0, 0]}
  domains:
    rotor:  {inside_mm: [-80, 0, 20], rotating: true}
    stator: {inside_mm: [0, 120, 0]}
"""

if __name__ == "__main__":
    draw.main("double_suction", pump, CAD, flow=50)
