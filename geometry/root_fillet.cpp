// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/root_fillet.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/bspline_fit.hpp"
#include "geometry/root_fillet_size.h"
#include "geometry/solid.hpp"

namespace {

const double largest_mitre = 1.6; // length of the mitre at a corner over L
const double settles = 0.15;      // share of a patch over which it takes its own size from that of its end

struct Vector {
  double m, t; // downstream along the wall and in the sense of theta, m
};
double dot(const Vector &a, const Vector &b) {
  return a.m * b.m + a.t * b.t;
}

class Fillets {
public:
  Fillets(const CwDesign *from, const CwMeridian *section, const CwBladeShape *of, int on)
      : design(from), meridian(section), shape(of), wall(on) {}
  // Normals, tangent lengths and angles of a patch; `left`: the fluid lies to the left of the outline; `round`:
  // an edge that turns by half a circle.
  void normals(const CwBladePatch &patch, bool left, bool round);
  // Lets size and angle of a side begin and end at rest, as those of round edges do: a rate that jumps there would
  // be a kink across the fillet.
  void rest_at_ends(const CwBladePatch &side);
  // Feet of the patch, with the mitres to the neighbours at its begin and end. `straight`: a facet, whose foot is
  // the line between them.
  void feet(CwBladePatch &patch, bool straight, const Fillets *before, bool before_end, const Fillets *after,
            bool after_end) const;

private:
  const CwDesign *design;
  const CwMeridian *meridian;
  const CwBladeShape *shape;
  int wall;
  std::vector<CwFilletPlace> place;
  std::vector<Vector> normal;
  std::vector<double> length, angle;

  Vector mitre(size_t i, const Fillets *other, bool other_end) const;
};

void Fillets::normals(const CwBladePatch &patch, bool left, bool round) {
  const size_t count = patch.u.size();
  const int j = wall == CW_HUB ? 0 : CW_SPAN_POINTS - 1;
  std::vector<gp_Pnt2d> outline;
  for (size_t i = 0; i < count; i++) {
    const CwBladePoint &point = patch.points[i * CW_SPAN_POINTS + j];
    outline.push_back(gp_Pnt2d(point.q, point.theta));
  }
  const Handle(Geom2d_BSplineCurve) curve = cw_bspline_curve_2d(patch.u, outline);
  const CwBladeSection &on = shape->section[j];
  const CwBladeSection &off = shape->section[wall == CW_HUB ? 1 : CW_SPAN_POINTS - 2];
  for (size_t i = 0; i < count; i++) {
    gp_Pnt2d point;
    gp_Vec2d by_u;
    curve->D1(patch.u[i], point, by_u);
    place.push_back(cw_root_fillet_place(meridian, &on, &off, point.X()));
    const CwFilletPlace &here = place.back();
    const double m = by_u.X() * here.speed, t = by_u.Y() * here.radius, size = std::hypot(m, t);
    normal.push_back(left ? Vector{-t / size, m / size} : Vector{t / size, -m / size});
  }
  // Round an edge the normal turns at once from rest: taken as it is it would kink the length of the fillet.
  const double turn = std::atan2(normal[0].m * normal[count - 1].t - normal[0].t * normal[count - 1].m,
                                 dot(normal[0], normal[count - 1]));
  const Vector &middle = normal[count / 2];
  const double sense = normal[0].m * middle.t - normal[0].t * middle.m > 0 ? 1 : -1;
  const double whole = turn * sense > 0 ? turn : turn + sense * 2 * M_PI;
  for (size_t i = 0; i < count; i++) {
    const double f = round ? whole * cw_smooth_step((patch.u[i] - patch.u[0]) / (patch.u[count - 1] - patch.u[0])) : 0;
    const Vector &from = normal[round ? 0 : i];
    angle.push_back(cw_root_fillet_angle(&place[i], from.m * std::cos(f) - from.t * std::sin(f),
                                         from.m * std::sin(f) + from.t * std::cos(f)));
    length.push_back(cw_root_fillet_length(design, &on, patch.points[i * CW_SPAN_POINTS + j].q, angle.back()));
  }
}

void Fillets::rest_at_ends(const CwBladePatch &side) {
  for (std::vector<double> *value : {&length, &angle}) {
    const double first = value->front(), last = value->back();
    for (size_t i = 0; i < side.u.size(); i++) {
      const double f = (side.u[i] - side.u.front()) / (side.u.back() - side.u.front());
      double &own = (*value)[i];
      own = first + cw_smooth_step(f / settles) * (own - first);
      own = last + cw_smooth_step((1 - f) / settles) * (own - last);
    }
  }
}

// Where the feet of two neighbours meet. The neighbour gives its last or first point.
Vector Fillets::mitre(size_t i, const Fillets *other, bool other_end) const {
  const size_t k = other_end ? other->normal.size() - 1 : 0;
  const Vector &a = normal[i], &b = other->normal[k];
  const double l = 0.5 * (length[i] + other->length[k]);
  Vector sum = {a.m + b.m, a.t + b.t};
  const double size = std::sqrt(dot(sum, sum)); // twice the cosine of half the corner's angle
  const double scale = l * std::min(2 / size, largest_mitre) / size;
  return {sum.m * scale, sum.t * scale};
}

void Fillets::feet(CwBladePatch &patch, bool straight, const Fillets *before, bool before_end, const Fillets *after,
                   bool after_end) const {
  const size_t count = patch.u.size(), last = count - 1;
  const Vector begin = mitre(0, before, before_end), end = mitre(last, after, after_end);
  const size_t kb = before_end ? before->normal.size() - 1 : 0, ka = after_end ? after->normal.size() - 1 : 0;
  const double first_u = patch.u.front(), range = patch.u.back() - first_u;
  for (size_t i = 0; i < count; i++) {
    const double f = (patch.u[i] - first_u) / range;
    const double wb = straight ? 1 - f : 1 - cw_smooth_step(f / settles),
                 we = straight ? f : 1 - cw_smooth_step((1 - f) / settles);
    const auto ends = [&](double own, double at_begin, double own_begin, double at_end, double own_end) {
      return straight ? at_begin * wb + at_end * we : own + wb * (at_begin - own_begin) + we * (at_end - own_end);
    };
    const Vector shift = {
        ends(length[i] * normal[i].m, begin.m, length[0] * normal[0].m, end.m, length[last] * normal[last].m),
        ends(length[i] * normal[i].t, begin.t, length[0] * normal[0].t, end.t, length[last] * normal[last].t)};
    const double l = ends(length[i], 0.5 * (length[0] + before->length[kb]), length[0],
                          0.5 * (length[last] + after->length[ka]), length[last]);
    const double alpha = ends(angle[i], 0.5 * (angle[0] + before->angle[kb]), angle[0],
                              0.5 * (angle[last] + after->angle[ka]), angle[last]);
    const double phi = M_PI - alpha;
    patch.foot[wall].push_back({shift.m / place[i].speed, shift.t / place[i].radius});
    patch.reach[wall].push_back(l * std::sin(alpha) / place[i].height);
    patch.handle[wall].push_back(4.0 / 3 * std::tan(phi / 4) / std::tan(phi / 2));
  }
}

void check_room(const CwDesign *design, const CwMeridian *meridian, CwBladeShape *shape) {
  const double mm = 1e3 * design->unit;
  double taken = 0;
  for (const CwBladePatch *patch : shape->patches())
    for (size_t i = 0; i < patch->u.size(); i++)
      taken = std::max(taken, patch->reach[CW_HUB][i] + patch->reach[CW_SHROUD][i]);
  if (taken > CW_ROOT_FILLETS_MOST)
    cw_solid_refuse("root fillets of %.3g mm take %.0f %% of the %s's height, %.0f %% are allowed: lower "
                    "root_fillet_radius_mm to %.3g",
                    design->root_fillet_radius * mm, 100 * taken, shape->name, 100 * CW_ROOT_FILLETS_MOST,
                    design->root_fillet_radius * mm * CW_ROOT_FILLETS_MOST / taken * 0.98);
  for (int wall : {CW_HUB, CW_SHROUD}) {
    const CwBladeOnWall on = cw_blade_on_wall(meridian, wall);
    const int j = wall == CW_HUB ? 0 : CW_SPAN_POINTS - 1;
    for (size_t i = 0; i < shape->leading.u.size(); i++) {
      const double q = shape->leading.points[i * CW_SPAN_POINTS + j].q + shape->leading.foot[wall][i].q;
      if (on.begin + q * on.length > 0.02 * on.begin) continue;
      cw_solid_refuse("root fillets of %.3g mm have no room before the %s's leading edge on the %s: lower "
                      "root_fillet_radius_mm, or raise leading_edge_radius_%s_mm",
                      design->root_fillet_radius * mm, shape->name, wall == CW_HUB ? "hub" : "shroud",
                      wall == CW_HUB ? "hub" : "shroud");
    }
  }
}

} // namespace

void cw_root_fillets(const CwDesign *design, const CwMeridian *meridian, CwBladeShape *shape) {
  for (int wall : {CW_HUB, CW_SHROUD}) {
    Fillets pressure(design, meridian, shape, wall), suction = pressure, leading = pressure, bevel = pressure,
                                                     trailing = pressure;
    pressure.normals(shape->pressure, true, false);
    leading.normals(shape->leading, true, true);
    suction.normals(shape->suction, false, false);
    leading.rest_at_ends(shape->leading);
    pressure.rest_at_ends(shape->pressure);
    suction.rest_at_ends(shape->suction);
    if (shape->has_bevel) bevel.normals(shape->bevel, false, false);
    if (shape->has_trailing) trailing.normals(shape->trailing, false, design->trailing_edge == CW_EDGE_ROUNDED);
    const Fillets *behind_suction = shape->has_bevel ? &bevel : &trailing;
    const Fillets *behind_pressure = shape->has_trailing ? &trailing : &bevel;
    leading.feet(shape->leading, false, &suction, false, &pressure, false);
    pressure.feet(shape->pressure, false, &leading, true, behind_pressure, true);
    suction.feet(shape->suction, false, &leading, false, behind_suction, false);
    if (shape->has_bevel)
      bevel.feet(shape->bevel, true, &suction, true, shape->has_trailing ? &trailing : &pressure, !shape->has_trailing);
    if (shape->has_trailing)
      trailing.feet(shape->trailing, design->trailing_edge != CW_EDGE_ROUNDED, shape->has_bevel ? &bevel : &suction,
                    true, &pressure, true);
  }
  check_room(design, meridian, shape);
}
