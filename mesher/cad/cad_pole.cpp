// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/cad_pole.h"

#include <algorithm>
#include <cmath>

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>

namespace {

// Shares of the face's extent in a parameter.
const double SAME = 1e-7;                                 // within which parameters are one
const double NEAR = 1e-3;                                 // from the pole, where the directions out of it are taken
const double LEAST = 1e-6;                                // from the pole, where derivatives are taken
const double LEAST_ANGLE = 0.05, MOST_ANGLE = 1.9 * M_PI; // rad, between the sides at the pole, as they are drawn
enum { PARTS = 64 };

} // namespace

void CwCadPole::to_plane(double uv[2]) const {
  const double away = inward * (uv[1 - around] - pole), angle = rate * (uv[around] - middle);
  const bool there = away <= SAME * smallest / LEAST;
  uv[0] = there ? 0 : away * std::cos(angle);
  uv[1] = there ? 0 : away * std::sin(angle);
}

void CwCadPole::to_surface(double st[2]) const {
  const double away = std::hypot(st[0], st[1]), angle = away > 0 ? std::atan2(st[1], st[0]) : 0;
  st[around] = middle + angle / rate;
  st[1 - around] = pole + inward * away;
}

void CwCadPole::keep_off(double st[2]) const {
  const double away = std::hypot(st[0], st[1]);
  if (away >= smallest) return;
  const double by = away > 0 ? smallest / away : 0;
  st[0] = away > 0 ? by * st[0] : smallest;
  st[1] = by * st[1];
}

void CwCadPole::derive(const double st[2], gp_Vec first[2], CwCadSecond *second) const {
  const double away = std::hypot(st[0], st[1]), c = st[0] / away, s = st[1] / away;
  const gp_Vec along = first[around] / rate, out = first[1 - around] * inward;
  if (second) { // the chain rule for polar coordinates
    const gp_Vec oo = around ? second->uu : second->vv, aa = (around ? second->vv : second->uu) / (rate * rate),
                 ao = second->uv * inward / rate;
    const gp_Vec round = (aa / away + out) / away, mixed = (ao - along / away) / away;
    second->uu = oo * (c * c) - mixed * (2 * s * c) + round * (s * s);
    second->vv = oo * (s * s) + mixed * (2 * s * c) + round * (c * c);
    second->uv = (oo - round) * (s * c) + mixed * (c * c - s * s);
  }
  first[0] = out * c - along * (s / away);
  first[1] = out * s + along * (c / away);
}

bool cw_cad_pole_find(const TopoDS_Face &face, const GeomAdaptor_Surface &surface,
                      const TopTools_IndexedMapOfShape &vertices, CwCadPole &pole) {
  double range[2][2];
  BRepTools::UVBounds(face, range[0][0], range[0][1], range[1][0], range[1][1]);
  const double extent[2] = {range[0][1] - range[0][0], range[1][1] - range[1][0]};
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
    const TopoDS_Edge &edge = TopoDS::Edge(at.Current());
    double first, last;
    if (!BRep_Tool::Degenerated(edge)) continue;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (curve.IsNull()) return false;
    const gp_XY begin = curve->Value(first).XY(), end = curve->Value(last).XY();
    const double run[2] = {std::fabs(end.X() - begin.X()), std::fabs(end.Y() - begin.Y())};
    const bool moves[2] = {run[0] > SAME * extent[0], run[1] > SAME * extent[1]};
    if (!moves[0] && !moves[1]) continue;
    if (pole.is || (moves[0] && moves[1])) return false;
    const int around = moves[0] ? 0 : 1, other = 1 - around;
    pole.is = true;
    pole.around = around;
    pole.pole = begin.Coord(other + 1);
    pole.inward = pole.pole - range[other][0] < range[other][1] - pole.pole ? 1 : -1;
    pole.middle = (begin.Coord(around + 1) + end.Coord(around + 1)) / 2;
    pole.vertex = vertices.FindIndex(TopExp::FirstVertex(edge)) - 1;
    pole.smallest = LEAST * extent[other];
    const double low = std::min(begin.Coord(around + 1), end.Coord(around + 1));
    double turned = 0;
    gp_Vec before;
    for (int i = 0; i <= PARTS; i++) {
      double uv[2];
      uv[around] = low + run[around] * i / PARTS;
      uv[other] = pole.pole;
      const gp_Pnt tip = surface.Value(uv[0], uv[1]);
      uv[other] += pole.inward * NEAR * extent[other];
      const gp_Vec direction(tip, surface.Value(uv[0], uv[1]));
      if (i > 0 && direction.Magnitude() > 0 && before.Magnitude() > 0) turned += direction.Angle(before);
      before = direction;
    }
    pole.rate = std::clamp(turned, LEAST_ANGLE, MOST_ANGLE) / run[around] * (around ? pole.inward : -pole.inward);
  }
  return true;
}
