#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""pictures.py [--bin build/bin]

Makes the pictures of docs/own-cad.md anew, of cases/own-cad: docs/own-cad.svg is FreeCAD's drawing of the solids in its
STEP file (freecadcmd, Debian's freecad), docs/own-cad-faces.svg two views of the geometry stage's picture of numbered
faces."""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CASE = SOURCE / "cases/own-cad"
VIEW = 560  # side of a view in faces_NAME.svg, px

# Edges of each solid as they are seen, hidden ones left out, side by side.
FREECAD = r"""
import os, Part, TechDraw
from FreeCAD import Vector
shape = Part.Shape()
shape.read(os.environ["STEP_FILE"])
views, left = [], 0
for solid, name in zip(shape.Solids, ("rotor", "stator")):
    visible = TechDraw.projectEx(solid, Vector(1, 0.7, 0.5))[:5]
    box = Part.makeCompound([part for part in visible if not part.isNull()]).BoundBox
    lines = TechDraw.projectToSVG(solid, Vector(1, 0.7, 0.5))
    views.append((name, lines, left - box.XMin, box))
    left += box.XLength + 30
height = max(view[3].YLength for view in views) + 20
with open(os.environ["SVG_FILE"], "w") as out:
    out.write('<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d" viewBox="-10 -10 %.0f %.0f">\n'
              % (1.6 * left, 1.6 * (height + 20), left, height + 20))
    out.write('<rect x="-10" y="-10" width="100%" height="100%" fill="#ffffff"/>\n')
    for name, lines, shift, box in views:
        out.write('<g transform="translate(%.1f %.1f)">%s</g>\n' % (shift, box.YMax, lines))
        out.write('<text x="%.0f" y="%.0f" font-family="sans-serif" font-size="9" text-anchor="middle">%s</text>\n'
                  % (shift + box.Center.x, height, name))
    out.write("</svg>\n")
"""


def two_views(svg):
    """Of the eight views of numbered faces the first from outside and the same with the near faces taken away."""
    kept = []
    for line in svg.splitlines():
        at = re.match(r'<(?:image|text|line|path|circle)[^>]*? x="([\d.]+)" y="([\d.]+)"', line)
        if at and float(at[1]) < VIEW:
            right = float(at[2]) >= VIEW + 34
            if not right or float(at[2]) < 2 * VIEW + 34:
                moved = f'x="{float(at[1]) + VIEW * right:g}" y="{float(at[2]) - VIEW * right:g}"'
                kept.append(re.sub(r'x="[\d.]+" y="[\d.]+"', moved, line, count=1))
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * VIEW}" height="{VIEW}" viewBox="0 34 {2 * VIEW} '
            f'{VIEW}" font-family="Helvetica, Arial, sans-serif" font-size="13">')
    return "\n".join([head, '<rect y="34" width="100%" height="100%" fill="#ffffff"/>', *kept, "</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=SOURCE / "build/bin")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        subprocess.run([options.bin / "cutwater-geometry", "--case", CASE / "case.yaml", "--run", folder], check=True)
        (SOURCE / "docs/own-cad-faces.svg").write_text(two_views((folder / "geometry/faces_rotor.svg").read_text()))
        (folder / "drawing.py").write_text(FREECAD)
        drawing = SOURCE / "docs/own-cad.svg"
        drawing.unlink(missing_ok=True)
        subprocess.run(["freecadcmd", folder / "drawing.py"], check=True, stdin=subprocess.DEVNULL,
                       env={**os.environ, "STEP_FILE": str(CASE / "pump.step"), "SVG_FILE": str(drawing)})
        if not drawing.exists():
            sys.exit("pictures: FreeCAD has drawn nothing")


if __name__ == "__main__":
    main()
