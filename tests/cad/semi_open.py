#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""A semi-open wheel: six lofted blades that end 0.5 mm before the casing, which stands still."""
import draw

GAP = 0.5


def pump():
    blade = draw.lofted([draw.profile(z, r1, 97, beta, 27, 3, turn)
                         for z, r1, beta, turn in ((-40, 40, 20, 0), (-20, 36, 22, 2), (5, 33, 25, 4))])
    below = draw.revolved((0, 10), [(110, 10), (110, -9 + GAP), (101, -9 + GAP), (62, -14 + GAP),
                                    ((37 - GAP, -39), (62, -39)), (0, -39), (0, 10)])
    blades = draw.OCC.intersect(draw.copies(blade, 6), below)[0]
    draw.cut(draw.wheel_water(), blades)
    draw.casing(101, 9, 145, 40, -4.5, 18, 220)


CAD = """  domains:
    rotor:  {inside_mm: [0, 0, -80], rotating: true}
    stator: {inside_mm: [0, 110, -4.5]}
"""

if __name__ == "__main__":
    draw.main("semi_open", pump, CAD)
