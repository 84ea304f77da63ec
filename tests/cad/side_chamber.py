#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""A wheel whose back shroud, 4 mm thick, turns in a side chamber: a domain of its own that stands still, with turning
walls, and that opens into the casing through a ring gap of 1 mm round the shroud."""
import draw

GAP, BACK, FAR = 1, 4, 10  # width of the gap; the two sides of the chamber


def pump():
    blade = draw.lofted([draw.profile(z, 42, 97, 20, 26, 3, 0) for z in (-40, 5)], ruled=True)
    draw.cut(draw.wheel_water(), draw.copies(blade, 6))
    rim = 101 + GAP
    draw.revolved((20, BACK), [(101, BACK), (101, 0), (rim, 0), (rim, FAR), (20, FAR), (20, BACK)])
    lip = draw.revolved((rim, -1), [(106, -1), (106, 0), (rim, 0), (rim, -1)])
    draw.cut(draw.casing(101, 9, 145, 40, -4.5, 18, 220), lip)


CAD = """  domains:
    rotor:   {inside_mm: [0, 0, -80], rotating: true}
    chamber: {inside_mm: [0, 60, 7]}
    casing:  {inside_mm: [0, 120, -4.5]}
  patches:
    back:  {near_mm: [0, 60, 4], turns: true, walls: hub_shroud}
    rim:   {near_mm: [0, 101, 2], turns: true, walls: hub_shroud}
    shaft: {near_mm: [0, 20, 7], turns: true, walls: hub_shroud}
"""

if __name__ == "__main__":
    draw.main("side_chamber", pump, CAD)
