// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/blade_patches.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/bspline_fit.hpp"
#include "geometry/root_fillet.hpp"
#include "geometry/solid.hpp"

namespace {

const double level = 1e-12; // rad: two corners of an edge without lean
const int fillet_points = 7;

class Maker {
public:
  Maker(const CwDesign *from, const CwMeridian *section, CwBladeShape &of)
      : design(from), meridian(*section), shape(of) {}
  void make(double room);
  void make_seam(double room);

private:
  const CwDesign *design;
  const CwMeridian &meridian;
  CwBladeShape &shape;

  gp_Pnt at(double r, double theta, double z) const {
    return gp_Pnt(r * std::cos(theta), r * std::sin(theta), z);
  }

  void trailing_points(double p_bevel);
  void points();
  void fill(CwBladePatch &patch);
  Handle(Geom2d_BSplineCurve) curve_on_wall(const CwBladePatch &patch, int wall) const;
  gp_Pnt2d nearest_on_wall(const CwMeridianCurve &curve, const gp_Pnt &point, const gp_Pnt2d &guess) const;
  CwBladePoint between(const CwBladePatch &patch, size_t i, double s) const;
  Handle(Geom_BSplineSurface)
      surface(const CwBladePatch &patch, const std::vector<double> &v, const std::vector<std::vector<double>> &span,
              const std::vector<CwBladePoint> &points) const;
  Handle(Geom_BSplineSurface) fillet(const CwBladePatch &patch, int wall) const;
  void guide_line(int wall, double room);
};

// Point of the outline at u[i] and the span s, between those of the sections: by Lagrange's polynomial through
// the six nearest.
CwBladePoint Maker::between(const CwBladePatch &patch, size_t i, double s) const {
  const int near = 6, n = CW_SPAN_POINTS - 1;
  const int first = std::min(n + 1 - near, std::max(0, (int)std::floor(s * n) - near / 2 + 1));
  CwBladePoint sum = {0, 0};
  for (int j = first; j < first + near; j++) {
    double weight = 1;
    for (int k = first; k < first + near; k++)
      if (k != j) weight *= (s * n - k) / (j - k);
    sum.q += weight * patch.points[i * CW_SPAN_POINTS + j].q;
    sum.theta += weight * patch.points[i * CW_SPAN_POINTS + j].theta;
  }
  return sum;
}

// Surface through points at span[i][j] of (u[i], v[j]).
Handle(Geom_BSplineSurface) Maker::surface(const CwBladePatch &patch, const std::vector<double> &v,
                                           const std::vector<std::vector<double>> &span,
                                           const std::vector<CwBladePoint> &points) const {
  std::vector<gp_Pnt> in_space;
  for (size_t i = 0; i < patch.u.size(); i++)
    for (size_t j = 0; j < v.size(); j++) {
      const CwBladePoint &point = points[i * v.size() + j];
      double x[2];
      cw_meridian_blade_point(&meridian, span[i][j], point.q, x, nullptr);
      in_space.push_back(at(x[0], point.theta, x[1]));
    }
  return cw_bspline_surface(patch.u, v, in_space);
}

// The arc of the fillet is a cubic in v, with the foot's share out(v) along the wall and out(1 - v) of the
// reach up the blade; of the shroud v runs from the blade to the wall.
Handle(Geom_BSplineSurface) Maker::fillet(const CwBladePatch &patch, int wall) const {
  std::vector<double> v;
  std::vector<std::vector<double>> span;
  std::vector<CwBladePoint> points;
  for (int j = 0; j < fillet_points; j++) v.push_back((double)j / (fillet_points - 1));
  for (size_t i = 0; i < patch.u.size(); i++) {
    const double inner = 1 - patch.handle[wall][i];
    const auto out = [&](double t) { return (1 - t) * (1 - t) * (1 - t + 3 * t * inner); };
    span.push_back({});
    for (double at_v : v) {
      const double t = wall == CW_HUB ? at_v : 1 - at_v;
      const double s = patch.reach[wall][i] * out(1 - t);
      span.back().push_back(wall == CW_HUB ? s : 1 - s);
      CwBladePoint point = between(patch, i, span.back().back());
      point.q += out(t) * patch.foot[wall][i].q;
      point.theta += out(t) * patch.foot[wall][i].theta;
      points.push_back(point);
    }
  }
  return surface(patch, v, span, points);
}

// Surfaces, and curves on hub and shroud.
void Maker::fill(CwBladePatch &patch) {
  const size_t count = patch.u.size();
  const bool fillets = !patch.foot[CW_HUB].empty();
  std::vector<double> v;
  std::vector<std::vector<double>> span(count);
  std::vector<CwBladePoint> points;
  for (int j = 0; j < CW_SPAN_POINTS; j++) v.push_back((double)j / (CW_SPAN_POINTS - 1));
  for (size_t i = 0; i < count; i++)
    for (int j = 0; j < CW_SPAN_POINTS; j++) {
      const double low = fillets ? patch.reach[CW_HUB][i] : 0, high = fillets ? 1 - patch.reach[CW_SHROUD][i] : 1;
      span[i].push_back(low + v[j] * (high - low));
      points.push_back(fillets ? between(patch, i, span[i][j]) : patch.points[i * CW_SPAN_POINTS + j]);
    }
  if (fillets) patch.band.push_back(fillet(patch, CW_HUB));
  patch.band.push_back(surface(patch, v, span, points));
  if (fillets) patch.band.push_back(fillet(patch, CW_SHROUD));
  for (int wall : {CW_HUB, CW_SHROUD}) {
    for (size_t i = 0; i < count; i++) {
      CwBladePoint point = patch.points[i * CW_SPAN_POINTS + (wall == CW_HUB ? 0 : CW_SPAN_POINTS - 1)];
      if (fillets) {
        point.q += patch.foot[wall][i].q;
        point.theta += patch.foot[wall][i].theta;
      }
      patch.outline[wall].push_back(point);
    }
    patch.on_wall[wall] = curve_on_wall(patch, wall);
  }
}

// The outline in (theta, t), through its points and, half-way between them, through those of the wall nearest to the
// surface's edge: t may run very unevenly along a wall.
Handle(Geom2d_BSplineCurve) Maker::curve_on_wall(const CwBladePatch &patch, int wall) const {
  const CwBladeOnWall on = cw_blade_on_wall(&meridian, wall);
  const Handle(Geom_Curve) edge = wall == CW_HUB ? patch.band.front()->VIso(0) : patch.band.back()->VIso(1);
  std::vector<double> u;
  std::vector<gp_Pnt2d> points;
  for (size_t i = 0; i < patch.u.size(); i++) {
    const CwBladePoint &point = patch.outline[wall][i];
    const gp_Pnt2d here(point.theta, cw_meridian_parameter(on.curve, on.begin + point.q * on.length));
    if (i > 0) {
      u.push_back(0.5 * (patch.u[i - 1] + patch.u[i]));
      points.push_back(
          nearest_on_wall(*on.curve, edge->Value(u.back()), gp_Pnt2d(0.5 * (points.back().XY() + here.XY()))));
    }
    u.push_back(patch.u[i]);
    points.push_back(here);
  }
  return cw_bspline_curve_2d(u, points);
}

// (theta, t) of the point of a wall nearest to one beside it, from a guess.
gp_Pnt2d Maker::nearest_on_wall(const CwMeridianCurve &curve, const gp_Pnt &point, const gp_Pnt2d &guess) const {
  const double r = std::hypot(point.X(), point.Y()), z = point.Z();
  double theta = std::atan2(point.Y(), point.X()), t = guess.Y();
  theta += 2 * M_PI * std::round((guess.X() - theta) / (2 * M_PI));
  for (int i = 0; i < 8; i++) {
    double x[2], dx[2];
    cw_meridian_point(&curve, t, x, dx);
    t -= ((x[0] - r) * dx[0] + (x[1] - z) * dx[1]) / (dx[0] * dx[0] + dx[1] * dx[1]);
  }
  return gp_Pnt2d(theta, t);
}

// Bevel and cut, both from the suction to the pressure side.
void Maker::trailing_points(double p_bevel) {
  const bool round = design->trailing_edge == CW_EDGE_ROUNDED;
  const int points = round || design->trailing_edge == CW_EDGE_SHARP ? 33 : 9;
  const CwBladeSection &middle = shape.section[CW_SPAN_POINTS / 2];
  const double theta_bevel = cw_blade_bevel_theta(&middle, p_bevel);
  for (int i = 0; i < points; i++) {
    const double f = (double)i / (points - 1);
    shape.bevel.u.push_back(f);
    shape.trailing.u.push_back(f);
    for (int j = 0; j < CW_SPAN_POINTS; j++) {
      const CwBladeSection &s = shape.section[j];
      // The corner's angle is the same at every span but for lean, unless the angles differ.
      const bool alike = design->blade_form == CW_BLADE_TWISTED && !round;
      const double corner =
          cw_blade_side(alike ? &middle : &s, CW_BLADE_PRESSURE, s.end).theta + (alike ? s.shift - middle.shift : 0);
      const CwBladePoint begin = cw_blade_side(&s, CW_BLADE_SUCTION, p_bevel);
      const double to = shape.has_trailing ? theta_bevel - middle.shift + s.shift : corner;
      const double from = shape.has_bevel ? to : begin.theta;
      shape.bevel.points.push_back({begin.q + (1 - begin.q) * f, begin.theta + (to - begin.theta) * f});
      shape.trailing.points.push_back(round ? cw_blade_trailing_edge(&s, M_PI * (f - 0.5))
                                            : CwBladePoint{1, from + (corner - from) * f});
    }
  }
}

void Maker::points() {
  const bool fillets = design->root_fillet_radius > 0;
  const int side_points = 181, nose_points = fillets ? 97 : 49;
  const CwTrailingEdge edge = design->trailing_edge;
  const CwBladeSection &middle = shape.section[CW_SPAN_POINTS / 2];
  shape.has_bevel = edge == CW_EDGE_BEVELLED || edge == CW_EDGE_SHARP;
  shape.has_trailing = edge != CW_EDGE_SHARP;
  const double p_bevel =
      shape.has_bevel ? cw_blade_bevel_begin(&middle, edge, design->trailing_edge_bevel) : middle.end;
  const double theta_corner = cw_blade_side(&middle, CW_BLADE_PRESSURE, middle.end).theta;
  const double first = cw_blade_bevel_earliest(edge), mm = 1e3 * design->unit;
  if (!(p_bevel > first) && !shape.has_bevel)
    cw_solid_refuse("the rounding of the trailing edge begins at %.0f %% of the %s; allowed: from %.0f %% on: lower "
                    "trailing_edge_thickness_mm (%.3g mm)",
                    100 * p_bevel, shape.name, 100 * first, mm * design->trailing_edge_thickness);
  if (!(p_bevel > first) || (edge == CW_EDGE_BEVELLED && cw_blade_bevel_theta(&middle, p_bevel) >= theta_corner))
    cw_solid_refuse(
        "the bevel of %.3g mm is longer than the trailing edge of the %s, or begins at %.0f %% of it; allowed: "
        "from %.0f %% on: lower trailing_edge_bevel_mm to %.3g, or trailing_edge_thickness_mm (%.3g mm)",
        mm * design->trailing_edge_bevel, shape.name, 100 * p_bevel, 100 * first,
        mm * std::min(cw_blade_usual_bevel(edge, design->trailing_edge_thickness, design->outlet_blade_angle),
                      cw_blade_longest_bevel(&middle, edge)),
        mm * design->trailing_edge_thickness);
  // With fillets half-way between even steps on the ellipse and even turns of its normal, which their feet follow.
  for (int i = 0; i < nose_points; i++) {
    const double f = (double)i / (nose_points - 1), even = M_PI * (f - 0.5);
    const double turned = std::atan2(std::sin(even), design->leading_edge_ratio * std::cos(even));
    const double psi = fillets ? 0.5 * (even + turned) : even;
    shape.leading.u.push_back(f);
    for (int j = 0; j < CW_SPAN_POINTS; j++)
      shape.leading.points.push_back(cw_blade_leading_edge(&shape.section[j], psi));
  }
  // Parameters of the sides run from 0 at the leading to 1 at the trailing edge, closer together towards the
  // leading edge. The suction side ends where the bevel begins.
  for (int i = 0; i < side_points; i++) {
    const double g = (double)i / (side_points - 1);
    shape.pressure.u.push_back(0.4 * g + 0.6 * g * g);
  }
  const double nose = middle.nose;
  const double u_bevel = shape.u_bevel = shape.has_bevel ? (p_bevel - nose) / (1 - nose) : 1;
  for (double u : shape.pressure.u)
    if (!shape.has_bevel || u < u_bevel * 0.995) shape.suction.u.push_back(u);
  if (shape.has_bevel) shape.suction.u.push_back(u_bevel);
  for (CwBladePatch *side : {&shape.pressure, &shape.suction})
    for (double u : side->u)
      for (int j = 0; j < CW_SPAN_POINTS; j++) {
        const CwBladeSection &s = shape.section[j];
        const bool bevelled = shape.has_bevel && side == &shape.suction;
        const double p = bevelled ? s.nose + (p_bevel - s.nose) * u / u_bevel : s.nose + (s.end - s.nose) * u;
        side->points.push_back(cw_blade_side(&s, side == &shape.pressure ? CW_BLADE_PRESSURE : CW_BLADE_SUCTION, p));
      }
  trailing_points(p_bevel);
}

void Maker::make(double room) {
  points();
  if (design->root_fillet_radius > 0) cw_root_fillets(design, &meridian, &shape);
  for (CwBladePatch *patch : shape.patches()) fill(*patch);
  for (int w : {CW_HUB, CW_SHROUD}) {
    const CwBladeOnWall on = cw_blade_on_wall(&meridian, w);
    const CwBladePoint &corner = shape.pressure.outline[w].back();
    shape.theta_corner[w] = corner.theta;
    shape.t_corner[w] = cw_meridian_parameter(on.curve, on.begin + corner.q * on.length);
    guide_line(w, room);
  }
  for (double *theta : {shape.theta_corner, shape.theta_up})
    if (std::fabs(theta[CW_HUB] - theta[CW_SHROUD]) < level) theta[CW_HUB] = theta[CW_SHROUD];
}

void Maker::make_seam(double room) {
  shape.seam = true;
  shape.has_bevel = shape.has_trailing = false;
  for (int w : {CW_HUB, CW_SHROUD}) {
    guide_line(w, room);
    shape.theta_corner[w] = shape.guide_on_wall[w]->Value(1).X();
  }
}

// The mean line of the blades on a wall, which goes on smoothly into the meridian before their leading edge and, of a
// seam, at the trailing edge: theta by length along the wall.
class GuideLine {
public:
  GuideLine(const CwBladeSection &of, const CwBladeOnWall &on, double room)
      : s(of), begin(on.begin), length(on.length) {
    const double step = 1e-4;
    slope = (in_passage(0) - in_passage(step)) / (step * length);
    turning = std::min(0.7 * begin, 0.4 * room / slope);
    const double out = (in_passage(1 - step) - in_passage(1)) / (step * length);
    straightening = std::min(0.5 * length, 0.4 * room / out);
  }
  double in_passage(double q) const {
    return cw_blade_theta(&s, (q - s.start) / (1 - s.start));
  }
  // Upstream.
  double theta(double at) const {
    if (at >= begin) return in_passage((at - begin) / length);
    const double f = std::min(1.0, (begin - at) / turning), f4 = f * f * f * f;
    return in_passage(0) + slope * turning * (f - f4 * (2.5 - 3 * f + f * f));
  }
  // The same, but meridional from the trailing edge on.
  double theta_of_seam(double at) const {
    const double from = begin + length - straightening;
    if (at <= from) return theta(at);
    const double q = (from - begin) / length, step = 1e-4;
    const double out = (in_passage(q - step) - in_passage(q)) / (step * length);
    const double f = std::min(1.0, (at - from) / straightening), f4 = f * f * f * f;
    return in_passage(q) - out * straightening * (f - f4 * (2.5 - 3 * f + f * f));
  }

private:
  const CwBladeSection &s;
  const double begin, length;
  double slope, turning, straightening; // of theta by length upstream; lengths
};

// From the nose, or of a seam from the interface, upstream to the eye. The points are evenly spaced: with
// uneven ones the curve through them wriggles.
void Maker::guide_line(int wall, double room) {
  const int fine = 8000, points = shape.seam ? 960 : 480; // a seam is longer and turns at both ends
  const CwBladeOnWall on = cw_blade_on_wall(&meridian, wall);
  const CwMeridianCurve &curve = *on.curve;
  const GuideLine line(shape.section[wall == CW_HUB ? 0 : CW_SPAN_POINTS - 1], on, room);
  // The tip of a root fillet's foot lies a little off the mean line.
  const CwBladePoint tip = shape.seam ? CwBladePoint{0, 0} : shape.leading.outline[wall][shape.leading.u.size() / 2];
  const double end = shape.seam ? cw_meridian_length(&curve, 1) : on.begin + tip.q * on.length;
  const double off = shape.seam ? 0 : tip.theta - line.theta(end);
  const auto theta_at = [&](double at_length) {
    if (shape.seam) return line.theta_of_seam(at_length);
    return line.theta(at_length) + off * cw_smooth_step((at_length / end - 0.8) / 0.2);
  };
  const auto point_at = [&](double at_length, double theta, double *t) {
    double x[2];
    *t = cw_meridian_parameter(&curve, at_length);
    cw_meridian_point(&curve, *t, x, nullptr);
    return at(x[0], theta, x[1]);
  };
  std::vector<double> travelled(1, 0), u;
  std::vector<gp_Pnt> x;
  std::vector<gp_Pnt2d> on_wall;
  double t;
  gp_Pnt last = point_at(0, theta_at(0), &t);
  for (int i = 1; i <= fine; i++) {
    const double at_length = end * i / fine;
    const gp_Pnt next = point_at(at_length, theta_at(at_length), &t);
    travelled.push_back(travelled.back() + next.Distance(last));
    last = next;
  }
  for (int i = 0, j = 0; i < points; i++) {
    const double wanted = travelled.back() * i / (points - 1);
    while (j < fine - 1 && travelled[j + 1] < wanted) j++;
    const double share = (wanted - travelled[j]) / (travelled[j + 1] - travelled[j]);
    const double at_length = i == points - 1 ? end : end * (j + share) / fine;
    u.push_back((double)i / (points - 1));
    x.push_back(point_at(at_length, theta_at(at_length), &t));
    on_wall.push_back(gp_Pnt2d(theta_at(at_length), t));
  }
  shape.guide[wall] = cw_bspline_curve_3d(u, x);
  shape.guide_on_wall[wall] = cw_bspline_curve_2d(u, on_wall);
  shape.theta_up[wall] = on_wall.front().X();
}

} // namespace

void cw_blade_patches(const CwDesign *design, const CwMeridian *meridian, double room, CwBladeShape *shape) {
  Maker(design, meridian, *shape).make(room);
}

void cw_blade_seam(const CwDesign *design, const CwMeridian *meridian, double room, CwBladeShape *shape) {
  Maker(design, meridian, *shape).make_seam(room);
}
