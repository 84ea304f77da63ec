#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""The pump of ERCOFTAC's test case U3, tested in air at the University of Genova: an unshrouded wheel of seven
untwisted blades before a diffuser of twelve vanes, which opens into the atmosphere.

Blades, vanes and operating point: J. F. Combes, "Test case U3: centrifugal pump with a vaned diffuser", ERCOFTAC
Seminar and Workshop on Turbomachinery Flow Prediction VI, Aussois, 1998, tables 1 and 2, after M. Ubaldi, P. Zunino,
G. Barigozzi and A. Cattanei, "An experimental investigation of stator induced unsteadiness on centrifugal impeller
outflow", ASME Journal of Turbomachinery 118, 1996, pp. 41-54. Eye, bend and nose of the hub, of which both give a
drawing alone, and the ring behind the vanes: the case of OpenFOAM's turbomachinery interest group (M. Petit, M. Page,
M. Beaudoin and H. Nilsson, "The ERCOFTAC centrifugal pump OpenFOAM case-study", 3rd IAHR Meeting on Cavitation and
Dynamic Problems in Hydraulic Machinery, Brno, 2009)."""
import math

import draw
import u3

# Sides of a blade and of a vane: radius, mm, and angle, degrees, from the nose on. The wheel turns to lesser angles.
BLADE = (
    "120.00 0.00  120.48 1.61  121.06 3.21  121.74 4.79  122.50 6.36  123.36 7.91  124.31 9.43  128.31 13.62 "
    "132.58 17.67  136.86 21.65  141.13 25.60  145.40 29.50  149.67 33.37  153.94 37.21  158.22 41.01  162.49 44.79 "
    "166.77 48.52  171.05 52.22  175.33 55.87  179.61 59.47  183.89 63.02  188.17 66.52  192.45 69.95  196.74 73.31 "
    "201.02 76.61 | 203.83 77.59  206.67 78.52  209.53 79.42",
    "120.00 0.00  122.76 1.16  124.91 2.79  126.76 4.10  128.71 5.40  130.77 6.69  132.95 7.96  137.43 11.86 "
    "141.73 15.98  146.03 20.04  150.33 24.05  154.63 28.03  158.92 31.96  163.22 35.86  167.52 39.72  171.81 43.54 "
    "176.11 47.33  180.40 51.06  184.69 54.75  188.98 58.39  193.27 61.97  197.56 65.49  201.85 68.95  206.13 72.34 "
    "210.42 75.66 | 210.34 77.00  210.36 78.23  210.47 79.33")
VANE = (
    "220.07 0.00  221.65 -1.53  223.29 -3.05  224.96 -4.55  226.69 -6.04  228.45 -7.52  230.25 -8.98  232.10 -10.42 "
    "233.98 -11.85  237.85 -14.67  241.85 -17.43  245.97 -20.14  250.20 -22.79  254.52 -25.39  258.94 -27.93 "
    "263.43 -30.43  267.99 -32.88  272.60 -35.28  277.26 -37.63  281.96 -39.95  286.69 -42.22  291.45 -44.45 "
    "296.22 -46.65  300.99 -48.81  305.77 -50.94  310.55 -53.03  315.31 -55.09  320.06 -57.13  324.78 -59.13 "
    "328.30 -60.62",
    "223.94 0.26  225.74 -1.21  227.72 -2.67  229.87 -4.13  232.19 -5.57  234.69 -7.01  237.37 -8.42  239.73 -9.84 "
    "241.60 -11.26  245.43 -14.07  249.41 -16.82  253.50 -19.52  257.71 -22.17  262.01 -24.76  266.41 -27.31 "
    "270.88 -29.80  275.42 -32.25  280.02 -34.66  284.67 -37.02  289.36 -39.34  294.08 -41.62  298.83 -43.86 "
    "303.60 -46.06  308.37 -48.23  313.15 -50.37  317.93 -52.47  322.70 -54.54  327.45 -56.59  332.17 -58.60 "
    "335.70 -60.10")
WIDTH = u3.WIDTH  # Blades go from wall to wall; those tested end 0.4 mm before the casing
INTERFACE, OUTLET = 215.25, 365  # mm: radii, the first midway between blades and vanes


def outline(sides, z):
    """The sides as splines from one corner to the next, one out and one back, with lines between their ends. Angles are
    turned round, since the wheel turns by the right hand here."""
    at, curves, ends = {}, [], []

    def point(place):
        if place not in at:
            at[place] = draw.OCC.addPoint(*draw.polar(place[0], -math.radians(place[1]), z))
        return at[place]

    def join(places):
        if len(set(places)) > 1:
            curves.append(draw.OCC.addSpline([point(place) for place in places]))

    for side, step in zip(sides, (1, -1)):
        stretches, last = [], []
        for text in side.split("|"):
            numbers = [float(word) for word in text.split()]
            last = last[-1:] + list(zip(numbers[::2], numbers[1::2]))
            stretches.append(last[::step])
        ends += [stretches[::step][0][0], stretches[::step][-1][-1]]
        if step < 0:
            join([ends[1], ends[2]])
        for places in stretches[::step]:
            join(places)
    join([ends[3], ends[0]])
    return draw.OCC.addPlaneSurface([draw.OCC.addCurveLoop(curves)])


def body(sides, low, high):
    raised = draw.OCC.extrude([(2, outline(sides, low))], 0, 0, high - low)
    return [(dim, tag) for dim, tag in raised if dim == 3]


def wheel_water():
    """From the pipe of 184 mm round the bend of the casing, which begins at the height 0, and the hub, whose bend goes
    over into a nose, half an ellipse."""
    below, nose = -59.6, -72.6
    return draw.revolved((0, nose), [
        ((9, below), (0, below), (0, nose)), ((109, WIDTH), (109, below)), (INTERFACE, WIDTH), (INTERFACE, 0), (117, 0),
        ((92, -25), (117, -25)), (92, -250), (0, -250), (0, nose)])


def pump():
    draw.cut(wheel_water(), draw.copies(body(BLADE, 0, WIDTH), 7))
    ring = draw.revolved((INTERFACE, 0), [(OUTLET, 0), (OUTLET, WIDTH), (INTERFACE, WIDTH), (INTERFACE, 0)])
    draw.cut(ring, draw.copies(body(VANE, 0, WIDTH), 12))


FLOW = u3.FLOW_COEFFICIENT * u3.TIP_SPEED * math.pi * (2 * u3.RADIUS)**2 / 4 * 3600  # m3/h
HEAD = u3.HEAD_COEFFICIENT * u3.TIP_SPEED**2 / (2 * 9.80665)  # m
FLUID = """
fluid:                           # air at 25 degrees Celsius
  density_kg_per_m3: 1.2
  kinematic_viscosity_m2_per_s: 1.55e-5
"""
CAD = """  domains:
    rotor:  {inside_mm: [0, 0, -200], rotating: true}
    stator: {inside_mm: [350, 0, 20]}
  patches:                       # the casing stands still before the wheel
    suction_pipe: {near_mm: [90.166, 18.278, -150]}
    bend:         {near_mm: [97.3425, 19.7328, -7.3223], walls: hub_shroud, turns: false}
    casing:       {near_mm: [131.064, 91.772, 0], walls: hub_shroud, turns: false}
    outlet:       {near_mm: [357.725, 72.515, 20], kind: outlet}
"""

if __name__ == "__main__":
    draw.main("ubaldi", pump, CAD, round(FLOW, 1), round(HEAD, 2), u3.SPEED, 500000, FLUID, "auto", "auto")
