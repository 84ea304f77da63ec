#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""A closed wheel of five lofted, twisted blades, with fillets of 1.5 mm at their roots in the hub, in a concentric
casing."""
import draw


def pump():
    blade = draw.lofted([draw.profile(z, r1, 98, beta, 27, 4, turn)
                         for z, r1, beta, turn in ((-40, 41, 19, 0), (-20, 36, 22, 2), (5, 31, 26, 4))])
    wheel = draw.cut(draw.wheel_water(103), draw.copies(blade, 5))
    draw.filleted(wheel, 1.5, lambda kinds, at: kinds.count("BSpline surface") == 1 and -3 < at[1] and at[0] < 101)
    draw.casing(103, 9, 145, 40, -4.5, 18, 220)


CAD = """  domains:
    rotor:  {inside_mm: [0, 0, -80], rotating: true}
    stator: {inside_mm: [0, 110, -4.5]}
"""

if __name__ == "__main__":
    draw.main("fillets", pump, CAD)
