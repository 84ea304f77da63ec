#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""rule_picture.py [--cells 2M] [--domain rotor] [--build build/experiment] [--ranks 2]

Makes docs/mesher-rule.svg, Figure 3 of the paper from a run of its pump: of all places on the interfaces of a domain
the one with most inserted centres, as planned (the mesher without the rule, region_rule.py) and by the rule. BUILD is
configured with -DCUTWATER_EXPERIMENT=ON."""
import math
import sys
import tempfile
from pathlib import Path

from ablate import policy_numbers
from programs import SOURCE, execute, options_of
from region_rule import WAYS, run_mesher
from runs import PAPER_CASE, stage_line

WIDTH, HEIGHT, MARGIN, HEAD = 400, 310, 10, 30  # px: of a view, between them, above them
WINDOW = 3.2  # half width of a view, in radii of the largest sphere
COLOURS = {"kept": "#f1efe9", "divided": "#f2c36b", "made": "#a8d1ee"}
RED = "#b03a2e"


def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [x / math.hypot(*a) for x in a]


def interfaces(path):
    """The triangles on partition planes in the file of the stage, each the sorted places of its corners."""
    words = path.read_text().split()
    points, polygons, faces = (words.index(name) for name in ("POINTS", "POLYGONS", "face"))
    numbers = list(map(float, words[points + 3:points + 3 + 3 * int(words[points + 1])]))
    places = list(zip(numbers[0::3], numbers[1::3], numbers[2::3]))
    count = int(words[polygons + 1])
    corners = list(map(int, words[polygons + 3:polygons + 3 + 4 * count]))
    return {tuple(sorted(places[corner] for corner in corners[4 * t + 1:4 * t + 4]))
            for t, face in enumerate(words[faces + 5:faces + 5 + count]) if face == "-1"}


def circle(triangle):
    """Centre and radius of the circumscribed circle."""
    u, v = (subtract(x, triangle[0]) for x in triangle[1:])
    uu, uv, vv = dot(u, u), dot(u, v), dot(v, v)
    p, q = vv * (uu - uv), uu * (vv - uv)
    centre = [x + (p * d + q * e) / (2 * (uu * vv - uv * uv)) for x, d, e in zip(triangle[0], u, v)]
    return centre, math.dist(triangle[0], centre)


def view(place, title, triangles, circles, dots, letters):
    """One view: triangles by their colours, circles (centre, radius), dots, letters by point; place: of a point, px."""
    drawn = [f'<text y="-10">{title}</text>',
             f'<svg width="{WIDTH}" height="{HEIGHT}"><g stroke="#444444" stroke-linejoin="round">']
    for triangle, colour in triangles:
        corners = " ".join("{:.1f},{:.1f}".format(*place(x)) for x in triangle)
        drawn.append(f'<polygon points="{corners}" fill="{colour}"/>')
    drawn.append(f'</g><g stroke="{RED}" fill="none">')
    for centre, radius in circles:
        (x, y), (edge, _) = place(centre), place(centre, radius)
        drawn.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{edge - x:.1f}"/>')
    drawn.append(f'</g><g fill="{RED}">')
    drawn += ['<circle cx="{:.1f}" cy="{:.1f}" r="3.5"/>'.format(*place(x)) for x in dots]
    drawn.append("</g>")
    for x, letter in letters.items():
        right, down = place(x)
        drawn.append(f'<text x="{right + 6:.1f}" y="{down - 6:.1f}">{letter}</text>')
    return [*drawn, "</svg>"]


def picture(planned, refined):
    """The place with most inserted centres, as planned and as refined."""
    centres = {x for triangle in refined for x in triangle} - {x for triangle in planned for x in triangle}
    divided = [(centre, radius) for centre, radius in map(circle, sorted(planned - refined))
               if any(math.dist(centre, x) < 1e-6 * radius for x in centres)]
    if not divided:
        sys.exit("rule_picture: the rule has divided no triangle")
    half = WINDOW * max(radius for _, radius in divided)
    densest = max(sorted(centres), key=lambda x: sum(math.dist(x, other) < half for other in centres))
    a, b, c = next(triangle for triangle in sorted(refined) if densest in triangle)
    normal = unit(cross(subtract(b, a), subtract(c, a)))
    along = unit(cross([0, 0, 1] if abs(normal[2]) < 0.9 else [1, 0, 0], normal))
    across = cross(normal, along)

    def near(x, reach):
        return math.dist(x, densest) < reach and abs(dot(subtract(x, densest), normal)) < 1e-6 * half

    dots = sorted(x for x in centres if near(x, 3 * half))
    shown = [x for x in dots if near(x, half)]
    letters = dict(zip(shown, "PQRSTUVWXYZ"))
    middle = [sum(coordinates) / len(shown) for coordinates in zip(*shown)]

    def place(x, right=0):
        d = subtract(x, middle)
        scale = WIDTH / (2 * half)
        return [WIDTH / 2 + scale * (dot(d, along) + right), HEIGHT / 2 - scale * dot(d, across)]

    def coloured(triangles, others, other):
        return [(triangle, COLOURS["kept" if triangle in others else other]) for triangle in sorted(triangles)
                if all(near(x, 3 * half) for x in triangle)]

    factor = policy_numbers((SOURCE / "mesher/policy_table.h").read_text())["interface_sphere"][1]
    circles = [(centre, factor * radius) for centre, radius in divided if near(centre, 3 * half)]
    left = view(place, "planned, with the spheres that hold new points", coloured(planned, refined, "divided"),
                circles, dots, letters)
    right = view(place, "inserted by the lower number, taken by the higher", coloured(refined, planned, "made"), [],
                 dots, letters)
    width, height = 2 * WIDTH + 3 * MARGIN, HEIGHT + HEAD + MARGIN
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
        'font-family="Helvetica, Arial, sans-serif" font-size="13">',
        '<rect width="100%" height="100%" fill="#ffffff"/>',
        f'<g transform="translate({MARGIN} {HEAD})">', *left, "</g>",
        f'<g transform="translate({WIDTH + 2 * MARGIN} {HEAD})">', *right, "</g>", "</svg>", ""])


def main():
    options = options_of(__doc__, cells="2M", domain="rotor", build=SOURCE / "build/experiment", ranks=2).parse_args()
    with tempfile.TemporaryDirectory(prefix="cutwater-rule-") as name:
        run = Path(name)
        execute(*stage_line(options.build / "bin", "geometry", PAPER_CASE, run))
        found = {}
        for way in ("without", "rule"):
            run_mesher(options, PAPER_CASE, run, options.cells, WAYS[way], "--stop-after", "interfaces", "--vtk")
            found[way] = interfaces(run / f"mesh/{options.domain}-interfaces.vtk")
    (SOURCE / "docs/mesher-rule.svg").write_text(picture(found["without"], found["rule"]))
    planned, refined = found["without"], found["rule"]
    print(f"docs/mesher-rule.svg: {options.domain}, {len(planned)} interface triangles as planned, {len(refined)} by "
          f"the rule; {len(planned - refined)} of the planned ones were divided or turned")


if __name__ == "__main__":
    main()
