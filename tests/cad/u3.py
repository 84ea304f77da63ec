# SPDX-License-Identifier: AGPL-3.0-or-later
"""Numbers of ERCOFTAC's test case U3, for its drawing (ubaldi.py, which names the sources) and for the flow that is
held against it (tests/bench/verify.py)."""
import math

SPEED = 2000  # rpm
RADIUS = 0.21  # m: of the wheel's outlet
WIDTH = 40.4  # mm: from casing to hub
TIP_SPEED = SPEED * math.pi / 30 * RADIUS  # U2, m/s
FLOW_COEFFICIENT = 0.0475  # 4 Q / (pi D2^2 U2)
HEAD_COEFFICIENT = 0.65  # 2 g H / U2^2, of the rise of total pressure
