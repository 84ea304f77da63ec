#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""A volute swept through circles that grow round the wheel, fused with its neck and with the cone of the outlet; the
tongue between them is rounded. The neck is wider than the outlet of the wheel, whose six blades are
cylindrical."""
import math

import draw
from draw import OCC

TONGUE = 1  # mm, radius


def circle(r, angle, x, radius):
    """A circle across the way round the axis: its centre at radius x, in the half plane at this angle."""
    curve = OCC.addCircle(x, 0, 0, radius)
    OCC.rotate([(1, curve)], x, 0, 0, 1, 0, 0, math.pi / 2)
    OCC.translate([(1, curve)], 0, r, -4.5)
    OCC.rotate([(1, curve)], 0, 0, 0, 0, 0, 1, math.radians(angle))
    return OCC.addWire([curve])


def pump():
    blade = draw.lofted([draw.profile(z, 42, 97, 20, 26, 4, 0) for z in (-40, 5)], ruled=True)
    draw.cut(draw.wheel_water(width=9), draw.copies(blade, 6))
    radius = [4 + 14 * i / 12 for i in range(13)]
    spiral = draw.lofted([circle(0, 4 + (360 - 4) * i / 12, 106 + r, r) for i, r in enumerate(radius)])
    cone = draw.lofted([circle(y, 0, 124, r) for y, r in ((0, 18), (200, 25))], ruled=True)
    neck = draw.revolved((101, -10.5), [(111, -10.5), (111, 1.5), (101, 1.5), (101, -10.5)])
    bore = [(3, OCC.addCylinder(0, 0, -30, 0, 0, 60, 101))]
    volute = draw.cut(draw.fused(neck, spiral + cone), bore)
    kinds = ["BSpline surface", "Unknown"]  # the spiral and the cone
    return draw.filleted(volute, TONGUE, lambda of, at: of == kinds and 105 < at[0] < 120)


CAD = """  domains:
    rotor:  {inside_mm: [0, 0, -80], rotating: true}
    stator: {inside_mm: [0, 103, -4.5]}
"""

if __name__ == "__main__":
    draw.main("volute", pump, CAD)
