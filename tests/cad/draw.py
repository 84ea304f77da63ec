# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the drawings of this folder share: pieces of pumps in the OpenCASCADE kernel of gmsh, in millimetres, as a
designer would draw the water in a CAD program. The axis is z, the water comes from -z, the wheel turns by the right
hand.

Each drawing is a program: NAME.py FOLDER writes FOLDER/pump.step and FOLDER/case.yaml."""
import math
import pathlib
import sys

import gmsh

OCC = gmsh.model.occ


def polar(r, angle, z):
    return r * math.cos(angle), r * math.sin(angle), z


def lines_and_arcs(start, pieces):
    """A closed outline in the plane y = 0: each piece is the next (r, z), or ((r, z), centre) of an arc to it, or
    ((r, z), centre, end of the long axis) of an arc of an ellipse."""
    first = here = OCC.addPoint(start[0], 0, start[1])
    curves = []
    for number, piece in enumerate(pieces):
        (r, z), *places = piece if isinstance(piece[0], tuple) else (piece,)
        there = first if number == len(pieces) - 1 else OCC.addPoint(r, 0, z)
        through = [here, *(OCC.addPoint(place[0], 0, place[1]) for place in places), there]
        curves.append((OCC.addLine, OCC.addCircleArc, OCC.addEllipseArc)[len(places)](*through))
        here = there
    return OCC.addPlaneSurface([OCC.addCurveLoop(curves)])


def revolved(start, pieces):
    """The body that an outline makes when it goes round the axis once."""
    face = lines_and_arcs(start, pieces)
    return [(3, tag) for dim, tag in OCC.revolve([(2, face)], 0, 0, 0, 0, 0, 1, 2 * math.pi) if dim == 3]


def profile(z, r1, r2, beta1, beta2, thickness, turn):
    """A blade's outline at a height: one closed spline round the camber line, with round ends. The blade angle goes
    evenly from beta1 to beta2, degrees; the blade leans back. `turn`: angle of the tail, degrees."""
    count = 10
    radius = [r1 + (r2 - r1) * i / count for i in range(count + 1)]
    slope = [1 / math.tan(math.radians(beta1 + (beta2 - beta1) * i / count)) for i in range(count + 1)]
    angle = [math.radians(turn)]
    for i in range(count, 0, -1):
        step = radius[i] - radius[i - 1]
        angle.insert(0, angle[0] + step * (slope[i] / radius[i] + slope[i - 1] / radius[i - 1]) / 2)
    outline = []

    def add(i, degrees):
        """The point of the outline in this direction from point i of the camber line, counted from its tangent."""
        x, y, _ = polar(radius[i], angle[i], z)
        at = angle[i] + math.atan2(-slope[i], 1) + math.radians(degrees)
        outline.append(OCC.addPoint(x + thickness / 2 * math.cos(at), y + thickness / 2 * math.sin(at), z))

    for i in range(count + 1):
        add(i, 90)
    for degrees in (45, 0, -45):
        add(count, degrees)
    for i in range(count, -1, -1):
        add(i, -90)
    for degrees in (-135, 180, 135):
        add(0, degrees)
    return OCC.addWire([OCC.addSpline(outline + outline[:1])])


def lofted(wires, ruled=False):
    return [(3, tag) for dim, tag in OCC.addThruSections(wires, makeSolid=True, makeRuled=ruled) if dim == 3]


def copies(bodies, count):
    """The bodies `count` times round the axis."""
    made = list(bodies)
    for i in range(1, count):
        copy = OCC.copy(bodies)
        OCC.rotate(copy, 0, 0, 0, 0, 0, 1, 2 * math.pi * i / count)
        made += copy
    return made


def cut(body, tools):
    return OCC.cut(body, tools)[0]


def fused(body, tools):
    return OCC.fuse(body, tools)[0]


def kind(face):
    return gmsh.model.getType(2, face)


def middle(edge):
    """Radius, height, x and y of the middle of an edge."""
    low, high = gmsh.model.getParametrizationBounds(1, edge)
    x, y, z = gmsh.model.getValue(1, edge, [(low[0] + high[0]) / 2])
    return math.hypot(x, y), z, x, y


def filleted(body, radius, chosen):
    """The body with rounded edges: those that `chosen(kinds of the two faces, (r, z, x, y) of the middle)` takes."""
    OCC.synchronize()
    edges = []
    for _, edge in gmsh.model.getEntities(1):
        faces = gmsh.model.getAdjacencies(1, edge)[0]
        if len(faces) == 2 and chosen(sorted(kind(face) for face in faces), middle(edge)):
            edges.append(edge)
    return OCC.fillet([tag for _, tag in body], edges, [radius])


def wheel_water(radius=101, width=9, nose=-26):
    """The water between hub and shroud of a radial wheel with an eye of 74 mm, down to a suction pipe: the hub has a
    flat nose."""
    return revolved((0, nose), [(12, nose), ((38, 0), (38, nose)), (radius, 0), (radius, -width), (62, -14),
                                ((37, -39), (62, -39)), (37, -90), (0, -90), (0, nose)])


def casing(r1, neck, r2, width, middle, exit_radius, length):
    """A concentric casing: a neck `neck` wide from r1, a ring out to r2, fused with a pipe that leaves it along +y."""
    ring = revolved((r1, middle - neck / 2), [
        (r1 + 5, middle - neck / 2), (r1 + 5, middle - width / 2), (r2, middle - width / 2), (r2, middle + width / 2),
        (r1 + 5, middle + width / 2), (r1 + 5, middle + neck / 2), (r1, middle + neck / 2), (r1, middle - neck / 2)])
    pipe = [(3, OCC.addCylinder(r2 - exit_radius - 1, 0, middle, 0, length, 0, exit_radius))]
    bore = [(3, OCC.addCylinder(0, 0, middle - width, 0, 0, 2 * width, r1 + 5))]
    return fused(ring, cut(pipe, bore))


CASE = """# SPDX-License-Identifier: AGPL-3.0-or-later
# The drawing {name} of tests/cad.
name: {name}

operating_point:
  flow_rate_m3_per_h: {flow}
  head_m: {head}
  speed_rpm: {speed}
{fluid}
cad:
  files: [pump.step]
{cad}
walls:
  y_plus_blade: {y_plus}
  y_plus_hub_shroud: {y_plus}
  y_plus_volute: {y_plus}
  y_plus_pipe: {y_plus}
  layer_count: {layers}
  growth_ratio: {growth}

mesh:
  cells: {cells}
"""


def main(name, draw, cad, flow=25, head=10, speed=1450, cells=300000, fluid="", y_plus=30, layers=4, growth=1.3):
    """Draws into the folder of the command line. `draw` returns the bodies, in the order of their numbers in `cad`."""
    if len(sys.argv) != 2:
        sys.exit(f"usage: {name}.py FOLDER")
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    draw()
    OCC.synchronize()
    gmsh.write(str(folder / "pump.step"))
    gmsh.finalize()
    (folder / "case.yaml").write_text(CASE.format(name=name, flow=flow, head=head, speed=speed, fluid=fluid, cad=cad,
                                                   cells=cells, y_plus=y_plus, layers=layers, growth=growth))
