#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""A ring of nine diffuser vanes between a wheel of seven cylindrical blades and a concentric casing: three domains."""
import draw


def pump():
    blade = draw.lofted([draw.profile(z, 42, 97, 20, 26, 3, 0) for z in (-40, 5)], ruled=True)
    draw.cut(draw.wheel_water(), draw.copies(blade, 7))
    ring = draw.revolved((101, -9), [(150, -9), (150, 0), (101, 0), (101, -9)])
    vane = draw.lofted([draw.profile(z, 106, 145, -9, -22, 3, 0) for z in (-12, 3)], ruled=True)
    draw.cut(ring, draw.copies(vane, 9))
    draw.casing(150, 9, 195, 40, -4.5, 18, 260)


CAD = """  domains:
    rotor:    {inside_mm: [0, 0, -80], rotating: true}
    diffuser: {inside_mm: [0, 103, -4.5]}
    casing:   {inside_mm: [0, 170, -4.5]}
"""

if __name__ == "__main__":
    draw.main("diffuser", pump, CAD)
