// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/rotor.h"

#include <array>
#include <cmath>
#include <memory>

#include <BRepCheck_Analyzer.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <gp_Ax3.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>

#include "geometry/blade.h"
#include "geometry/bspline_fit.hpp"
#include "geometry/meridian.h"
#include "geometry/shell_builder.hpp"
#include "geometry/solid.hpp"

namespace {

const double mm = 1e3;
// Parameter planes of the surfaces of revolution begin this far before a blade's trailing edge, so that a
// whole passage has angles between 0 and 2 pi.
const double margin = 0.5;
const int span_points = 13;
const double level = 1e-12; // rad: two corners of a trailing edge without lean

// Angles are of blade 0; the suffix says the curve of revolution on which they lie.
enum { HUB, SHROUD };

// One blade patch: grid of (q, theta) points, interpolated. The pressure and suction sides run from the
// leading to the trailing edge, the leading edge from suction to pressure, bevel and trailing edge towards
// greater theta.
struct Patch {
  std::vector<double> u;
  std::vector<CwBladePoint> points;       // points[i * span_points + j]
  Handle(Geom_BSplineSurface) surface;    // of blade 0
  Handle(Geom2d_BSplineCurve) on_wall[2]; // (theta, t) on hub and shroud
};

// A blade or a splitter. A bevelled trailing edge has a bevel and a cut, a blunt or rounded one no bevel, a
// sharp one no cut.
struct Shape {
  const char *name;
  std::vector<CwBladeSection> section;
  bool has_bevel, has_trailing;
  Patch pressure, suction, leading, bevel, trailing;
  double u_bevel;                       // parameter of the suction side where bevel or cut begins
  double theta_tip[2], theta_corner[2]; // of the nose and of the pressure side's end
  double t_tip[2], t_corner[2];         // the same along hub and shroud
  // The line on the wall from the eye to the nose: of a blade the meridian, of a splitter along the passage
  // between the blades, which a meridian would cross. theta_up is where it begins.
  double theta_up[2];
  Handle(Geom2d_BSplineCurve) guide_on_wall[2];
  Handle(Geom_BSplineCurve) guide[2];
};

class Rotor {
public:
  explicit Rotor(const CwDesign *from) : design(from) {}
  CwStatus sections();
  CwSolid *build();

private:
  const CwDesign *design;
  CwMeridian meridian;
  std::vector<double> span;
  std::vector<Shape> shapes; // the blade and, with splitters, the splitter behind its pressure side
  double pitch;
  CwShellBuilder shell;

  void fill(Patch &patch);
  void trailing_patches(Shape &shape, double p_bevel);
  void blade_patches(Shape &shape);
  void guide_line(Shape &shape, int wall);
  gp_Pnt at(double r, double theta, double z) const {
    return gp_Pnt(mm * r * std::cos(theta), mm * r * std::sin(theta), mm * z);
  }
  gp_Ax3 frame(int k, double z = 0) const;
  Handle(Geom_Curve) meridian_curve(const CwMeridianCurve &curve, double theta) const;
  Handle(Geom_Curve) nut_curve(double theta) const;
  // The blade's boundary on hub or shroud, turned to blade k.
  Handle(Geom_Curve) wall_curve(const Patch &patch, int wall, int k) const;
  // The line on the interface from the shroud's to the hub's angle: axial, or with lean part of a helix.
  int interface_line(const double theta[2], double turn, int begin, int end);
};

Handle(Geom2d_Curve) line(double u, double v, double du, double dv) {
  return new Geom2d_Line(gp_Pnt2d(u, v), gp_Dir2d(du, dv));
}

// Line u = t or v = t of a B-spline surface whose edge has the same parameter.
Handle(Geom2d_Curve) along_u(double v) {
  return line(0, v, 1, 0);
}
Handle(Geom2d_Curve) along_v(double u) {
  return line(u, 0, 0, 1);
}

Handle(Geom2d_Curve) moved(const Handle(Geom2d_BSplineCurve) & curve, double du) {
  Handle(Geom2d_Curve) copy = Handle(Geom2d_Curve)::DownCast(curve->Copy());
  copy->Translate(gp_Vec2d(du, 0));
  return copy;
}

CwStatus Rotor::sections() {
  CwStatus status = CW_OK;
  pitch = 2 * M_PI / design->blade_count;
  CW_TRY(cw_meridian_make(design, &meridian));
  span.resize(span_points);
  shapes.resize(design->splitter_start > 0 ? 2 : 1);
  for (int j = 0; j < span_points; j++) {
    CwBladeSection section;
    span[j] = (double)j / (span_points - 1);
    CW_TRY(cw_blade_section(design, &meridian, span[j], &section));
    shapes[0].section.push_back(section);
    if (shapes.size() > 1)
      shapes[1].section.push_back(cw_blade_splitter(design, &section));
  }
  shapes[0].name = "blade";
  if (shapes.size() > 1)
    shapes[1].name = "splitter";
  for (const Shape &shape : shapes)
    for (const CwBladeSection &s : shape.section) {
      const double last = cw_blade_theta(&s, 0);
      CW_REQUIRE(
          last + pitch < 2 * M_PI - 1.5 * margin, CW_ERR_GEOMETRY,
          "the wrap of %.1f deg plus the pitch of %.1f deg must stay under %.1f deg: lower wrap_angle_deg or "
          "raise blade_count",
          last * 180 / M_PI, pitch * 180 / M_PI, (2 * M_PI - 1.5 * margin) * 180 / M_PI);
      CW_REQUIRE(s.nose < 0.5 * s.end && s.nose < 0.8 * s.thickest_at, CW_ERR_GEOMETRY,
                 "the leading edge's ellipse takes %.0f %% of the %s at span %.2f: lower "
                 "leading_edge_thickness_mm or "
                 "leading_edge_ratio, or raise thickest_at",
                 100 * s.nose, shape.name, s.span);
    }
done:
  return status;
}

// Points, surface and curves on hub and shroud from (q, theta).
void Rotor::fill(Patch &patch) {
  std::vector<gp_Pnt> points;
  for (size_t i = 0; i < patch.u.size(); i++)
    for (int j = 0; j < span_points; j++) {
      const CwBladePoint &point = patch.points[i * span_points + j];
      double x[2];
      cw_meridian_blade_point(&meridian, span[j], point.q, x, nullptr);
      points.push_back(at(x[0], point.theta, x[1]));
    }
  patch.surface = cw_bspline_surface(patch.u, span, points);
  for (int wall : {HUB, SHROUD}) {
    const CwMeridianCurve &curve = wall == HUB ? meridian.hub : meridian.shroud;
    const double begin = wall == HUB ? meridian.hub_leading : meridian.shroud_leading;
    const double end = wall == HUB ? meridian.hub_trailing : meridian.shroud_trailing;
    std::vector<gp_Pnt2d> on_wall;
    for (size_t i = 0; i < patch.u.size(); i++) {
      const CwBladePoint &point = patch.points[i * span_points + (wall == HUB ? 0 : span_points - 1)];
      on_wall.push_back(
          gp_Pnt2d(point.theta, cw_meridian_parameter(&curve, begin + point.q * (end - begin))));
    }
    patch.on_wall[wall] = cw_bspline_curve_2d(patch.u, on_wall);
  }
}

// Bevel and cut, both from the suction to the pressure side.
void Rotor::trailing_patches(Shape &shape, double p_bevel) {
  const bool round = design->trailing_edge == CW_EDGE_ROUNDED;
  const int points = round || design->trailing_edge == CW_EDGE_SHARP ? 33 : 5;
  const CwBladeSection &middle = shape.section[span_points / 2];
  const double theta_bevel = cw_blade_bevel_theta(&middle, p_bevel);
  for (int i = 0; i < points; i++) {
    const double f = (double)i / (points - 1);
    shape.bevel.u.push_back(f);
    shape.trailing.u.push_back(f);
    for (int j = 0; j < span_points; j++) {
      const CwBladeSection &s = shape.section[j];
      // The corner's angle is the same at every span but for lean, unless the angles differ.
      const bool alike = design->blade_form == CW_BLADE_TWISTED && !round;
      const double corner = cw_blade_side(alike ? &middle : &s, CW_BLADE_PRESSURE, s.end).theta +
                            (alike ? s.shift - middle.shift : 0);
      const CwBladePoint begin = cw_blade_side(&s, CW_BLADE_SUCTION, p_bevel);
      const double to = shape.has_trailing ? theta_bevel - middle.shift + s.shift : corner;
      const double from = shape.has_bevel ? to : begin.theta;
      shape.bevel.points.push_back({begin.q + (1 - begin.q) * f, begin.theta + (to - begin.theta) * f});
      shape.trailing.points.push_back(round ? cw_blade_trailing_edge(&s, M_PI * (f - 0.5))
                                            : CwBladePoint{1, from + (corner - from) * f});
    }
  }
}

void Rotor::blade_patches(Shape &shape) {
  const int side_points = 81, nose_points = 33, bevel_points = 8;
  const CwTrailingEdge edge = design->trailing_edge;
  const CwBladeSection &middle = shape.section[span_points / 2];
  shape.has_bevel = edge == CW_EDGE_BEVELLED || edge == CW_EDGE_SHARP;
  shape.has_trailing = edge != CW_EDGE_SHARP;
  const double p_bevel =
      shape.has_bevel ? cw_blade_bevel_begin(&middle, edge, design->trailing_edge_bevel) : middle.end;
  const double theta_corner = cw_blade_side(&middle, CW_BLADE_PRESSURE, middle.end).theta;
  if (!(p_bevel > (edge == CW_EDGE_SHARP ? 0.7 : 0.8)) ||
      (edge == CW_EDGE_BEVELLED && cw_blade_bevel_theta(&middle, p_bevel) >= theta_corner))
    throw Standard_Failure("the bevel is longer than the trailing edge: lower trailing_edge_bevel_mm or "
                           "trailing_edge_thickness_mm");
  for (int i = 0; i < nose_points; i++) {
    shape.leading.u.push_back((double)i / (nose_points - 1));
    for (int j = 0; j < span_points; j++)
      shape.leading.points.push_back(
          cw_blade_leading_edge(&shape.section[j], M_PI * (shape.leading.u.back() - 0.5)));
  }
  // Parameters of the sides run from 0 at the leading to 1 at the trailing edge, closer together towards the
  // leading edge. The suction side has a row where the bevel begins, so that the bevel's row of points is one
  // of its own.
  for (int i = 0; i < side_points; i++) {
    const double g = (double)i / (side_points - 1);
    shape.pressure.u.push_back(0.4 * g + 0.6 * g * g);
  }
  const double nose = middle.nose;
  const double u_bevel = shape.u_bevel = shape.has_bevel ? (p_bevel - nose) / (1 - nose) : 1;
  for (double u : shape.pressure.u)
    if (!shape.has_bevel || u < u_bevel * 0.995)
      shape.suction.u.push_back(u);
  for (int i = 0; shape.has_bevel && i < bevel_points; i++)
    shape.suction.u.push_back(u_bevel + (1 - u_bevel) * i / (bevel_points - 1));
  for (Patch *side : {&shape.pressure, &shape.suction})
    for (double u : side->u)
      for (int j = 0; j < span_points; j++) {
        const CwBladeSection &s = shape.section[j];
        // Near the end p depends on u in the same way for all sections, so that the bevel begins at one p.
        const double p = !shape.has_bevel ? s.nose + (s.end - s.nose) * u
                         : u >= u_bevel   ? nose + (1 - nose) * u
                                          : s.nose + (p_bevel - s.nose) * u / u_bevel;
        side->points.push_back(
            cw_blade_side(&s, side == &shape.pressure ? CW_BLADE_PRESSURE : CW_BLADE_SUCTION, p));
      }
  trailing_patches(shape, p_bevel);
  for (Patch *patch : {&shape.pressure, &shape.suction, &shape.leading, &shape.bevel, &shape.trailing})
    fill(*patch);
  for (int w : {HUB, SHROUD}) {
    const CwMeridianCurve &curve = w == HUB ? meridian.hub : meridian.shroud;
    const double begin = w == HUB ? meridian.hub_leading : meridian.shroud_leading;
    const double length = (w == HUB ? meridian.hub_trailing : meridian.shroud_trailing) - begin;
    const int j = w == HUB ? 0 : span_points - 1;
    const CwBladePoint &tip = shape.leading.points[(nose_points / 2) * span_points + j];
    const CwBladePoint &corner = shape.pressure.points[(side_points - 1) * span_points + j];
    shape.theta_tip[w] = tip.theta;
    shape.theta_corner[w] = corner.theta;
    shape.t_tip[w] = cw_meridian_parameter(&curve, begin + tip.q * length);
    shape.t_corner[w] = cw_meridian_parameter(&curve, begin + corner.q * length);
    shape.theta_up[w] = tip.theta;
    if (shape.section[j].start > 0)
      guide_line(shape, w);
  }
  if (std::fabs(shape.theta_corner[HUB] - shape.theta_corner[SHROUD]) < level)
    shape.theta_corner[HUB] = shape.theta_corner[SHROUD];
}

// From the nose upstream along the mean line of the blades to their leading edge, then turning smoothly into
// the meridian within a fifth of a pitch. The points are evenly spaced: with uneven ones the curve through
// them wriggles.
void Rotor::guide_line(Shape &shape, int wall) {
  const int fine = 4000, points = 160;
  const CwMeridianCurve &curve = wall == HUB ? meridian.hub : meridian.shroud;
  const double begin = wall == HUB ? meridian.hub_leading : meridian.shroud_leading;
  const double length = (wall == HUB ? meridian.hub_trailing : meridian.shroud_trailing) - begin;
  const CwBladeSection &s = shape.section[wall == HUB ? 0 : span_points - 1];
  const double end = begin + s.start * length, step = 1e-4;
  const auto in_passage = [&](double q) { return cw_blade_theta(&s, (q - s.start) / (1 - s.start)); };
  const double slope = (in_passage(0) - in_passage(step)) / (step * length); // of theta by length upstream
  const double turning = std::min(0.7 * begin, 0.4 * pitch / slope);
  const auto theta_at = [&](double at_length) {
    if (at_length >= begin)
      return in_passage((at_length - begin) / length);
    const double f = std::min(1.0, (begin - at_length) / turning), f4 = f * f * f * f;
    return in_passage(0) + slope * turning * (f - f4 * (2.5 - 3 * f + f * f));
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
    while (j < fine - 1 && travelled[j + 1] < wanted)
      j++;
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

// Axes whose x axis is the zero of the parameter plane of passage k.
gp_Ax3 Rotor::frame(int k, double z) const {
  const double angle = k * pitch - margin;
  return gp_Ax3(gp_Pnt(0, 0, mm * z), gp::DZ(), gp_Dir(std::cos(angle), std::sin(angle), 0));
}

Handle(Geom_Curve) Rotor::meridian_curve(const CwMeridianCurve &curve, double theta) const {
  TColgp_Array1OfPnt poles(1, 4);
  for (int i = 0; i < 4; i++)
    poles.SetValue(i + 1, at(curve.pole[i][0], theta, curve.pole[i][1]));
  return new Geom_BezierCurve(poles);
}

// Quarter ellipse from the flat disk to the hub, exact as a rational Bezier.
Handle(Geom_Curve) Rotor::nut_curve(double theta) const {
  const double rn = meridian.hub.pole[0][0], z0 = meridian.hub.pole[0][1];
  TColgp_Array1OfPnt poles(1, 3);
  TColStd_Array1OfReal weights(1, 3);
  poles.SetValue(1, at(meridian.nut_disk_radius, theta, meridian.nut_end_z));
  poles.SetValue(2, at(rn, theta, meridian.nut_end_z));
  poles.SetValue(3, at(rn, theta, z0));
  weights.SetValue(1, 1);
  weights.SetValue(2, std::sqrt(0.5));
  weights.SetValue(3, 1);
  return new Geom_BezierCurve(poles, weights);
}

Handle(Geom_Curve) turned(const Handle(Geom_Curve) & curve, double angle) {
  Handle(Geom_Curve) copy = Handle(Geom_Curve)::DownCast(curve->Copy());
  copy->Rotate(gp::OZ(), angle);
  return copy;
}

Handle(Geom_Curve) Rotor::wall_curve(const Patch &patch, int wall, int k) const {
  return turned(patch.surface->VIso(wall == HUB ? 0 : 1), k * pitch);
}

int Rotor::interface_line(const double theta[2], double turn, int begin, int end) {
  const double half = design->outlet_width / 2, ri = design->interface_radius;
  if (theta[HUB] == theta[SHROUD])
    return shell.edge(new Geom_Line(at(ri, turn + theta[HUB], 0), gp::DZ()), -mm * half, mm * half, begin,
                      end);
  const int points = 33;
  std::vector<double> u;
  std::vector<gp_Pnt> x;
  for (int i = 0; i < points; i++) {
    u.push_back((double)i / (points - 1));
    x.push_back(
        at(ri, turn + theta[SHROUD] + u.back() * (theta[HUB] - theta[SHROUD]), half * (2 * u.back() - 1)));
  }
  return shell.edge(cw_bspline_curve_3d(u, x), 0, 1, begin, end);
}

CwSolid *Rotor::build() {
  for (Shape &shape : shapes)
    blade_patches(shape);
  const int kinds = (int)shapes.size(), n = design->blade_count * kinds;
  const CwMeridianCurve *curve[2] = {&meridian.hub, &meridian.shroud};
  const double r_disk = meridian.nut_disk_radius, r_pipe = design->inlet_diameter / 2;
  const double ri = design->interface_radius;

  // Vertices and edges, blade by blade, splitters among them. [wall] is HUB or SHROUD.
  struct Blade {
    const Shape *shape;
    int turns; // multiples of the pitch
    // Upstream corner of the meridian line on the wall, tip of the nose, nose/pressure, nose/suction,
    // end of the pressure side, begin and end of the bevel, on the interface.
    int up[2], tip[2], nose_p[2], nose_s[2], corner[2], bevel0[2], bevel1[2], out[2], disk, inlet;
    // Edges: meridian lines, their continuation on nut or pipe, the blade's foot, and across the span.
    int e_up[2], e_down[2], e_end[2], e_nose_s[2], e_nose_p[2], e_p[2], e_s[2], e_bevel[2], e_te[2];
    int x_p, x_s, x_bevel0, x_bevel1, x_corner, x_out;
    // Arcs from this blade to the next.
    int a_out[2], a_up[2], a_end[2];
  };
  std::vector<Blade> blade(n);
  for (int i = 0; i < n; i++) {
    Blade &b = blade[i];
    const int k = b.turns = i / kinds;
    const Shape &s = *(b.shape = &shapes[i % kinds]);
    const double turn = k * pitch;
    for (int w : {HUB, SHROUD}) {
      const double r0 = curve[w]->pole[0][0], z0 = curve[w]->pole[0][1];
      const Handle(Geom_Curve) down = meridian_curve(*curve[w], turn + s.theta_corner[w]);
      const Handle(Geom_Curve) nose = wall_curve(s.leading, w, k), side_p = wall_curve(s.pressure, w, k);
      const Handle(Geom_Curve) side_s = wall_curve(s.suction, w, k);
      b.up[w] = shell.vertex(at(r0, turn + s.theta_up[w], z0));
      b.tip[w] = shell.vertex(nose->Value(0.5));
      b.nose_p[w] = shell.vertex(nose->Value(1));
      b.nose_s[w] = shell.vertex(nose->Value(0));
      b.corner[w] = shell.vertex(side_p->Value(1));
      b.bevel0[w] = b.bevel1[w] = shell.vertex(side_s->Value(s.u_bevel));
      if (s.has_bevel)
        b.bevel1[w] = s.has_trailing ? shell.vertex(wall_curve(s.trailing, w, k)->Value(0)) : b.corner[w];
      b.out[w] = shell.vertex(down->Value(1));
      if (s.guide[w].IsNull())
        b.e_up[w] =
            shell.edge(meridian_curve(*curve[w], turn + s.theta_up[w]), 0, s.t_tip[w], b.up[w], b.tip[w]);
      else
        b.e_up[w] = shell.edge(turned(s.guide[w], turn), 0, 1, b.up[w], b.tip[w]);
      b.e_down[w] = shell.edge(down, s.t_corner[w], 1, b.corner[w], b.out[w]);
      b.e_nose_s[w] = shell.edge(nose, 0, 0.5, b.nose_s[w], b.tip[w]);
      b.e_nose_p[w] = shell.edge(nose, 0.5, 1, b.tip[w], b.nose_p[w]);
      b.e_p[w] = shell.edge(side_p, 0, 1, b.nose_p[w], b.corner[w]);
      b.e_s[w] = shell.edge(side_s, 0, s.u_bevel, b.nose_s[w], b.bevel0[w]);
      if (s.has_bevel)
        b.e_bevel[w] = shell.edge(wall_curve(s.bevel, w, k), 0, 1, b.bevel0[w], b.bevel1[w]);
      if (s.has_trailing)
        b.e_te[w] = shell.edge(wall_curve(s.trailing, w, k), 0, 1, b.bevel1[w], b.corner[w]);
    }
    b.disk = shell.vertex(at(r_disk, turn + s.theta_up[HUB], meridian.nut_end_z));
    b.inlet = shell.vertex(at(r_pipe, turn + s.theta_up[SHROUD], meridian.inlet_z));
    b.e_end[HUB] = shell.edge(nut_curve(turn + s.theta_up[HUB]), 0, 1, b.disk, b.up[HUB]);
    b.e_end[SHROUD] =
        shell.edge(new Geom_Line(at(r_pipe, turn + s.theta_up[SHROUD], 0), gp::DZ()), mm * meridian.inlet_z,
                   mm * curve[SHROUD]->pole[0][1], b.inlet, b.up[SHROUD]);
    const auto across = [&](const Patch &patch, double u, int begin, int end) {
      return shell.edge(turned(patch.surface->UIso(u), turn), 0, 1, begin, end);
    };
    b.x_p = across(s.leading, 1, b.nose_p[HUB], b.nose_p[SHROUD]);
    b.x_s = across(s.leading, 0, b.nose_s[HUB], b.nose_s[SHROUD]);
    b.x_bevel0 = across(s.has_bevel ? s.bevel : s.trailing, 0, b.bevel0[HUB], b.bevel0[SHROUD]);
    if (s.has_bevel && s.has_trailing)
      b.x_bevel1 = across(s.trailing, 0, b.bevel1[HUB], b.bevel1[SHROUD]);
    else
      b.x_bevel1 = b.x_bevel0;
    b.x_corner = across(s.has_trailing ? s.trailing : s.bevel, 1, b.corner[HUB], b.corner[SHROUD]);
    b.x_out = interface_line(s.theta_corner, turn, b.out[SHROUD], b.out[HUB]);
  }
  // Arcs have the angle in the frame of their passage as parameter. The angles of the next blade are those of
  // its shape, and the pitch besides where it is the first of its pitch.
  const auto far_of = [&](int i) { return (i + 1) % kinds == 0 ? pitch : 0; };
  for (int i = 0; i < n; i++) {
    Blade &b = blade[i], &next = blade[(i + 1) % n];
    const Shape &s = *b.shape, &f = *next.shape;
    const auto arc = [&](double r, double height, double from, double to, int begin, int end) {
      const gp_Ax3 axes = frame(b.turns, height);
      return shell.edge(new Geom_Circle(axes.Ax2(), mm * r), from + margin, to + margin + far_of(i), begin,
                        end);
    };
    for (int w : {HUB, SHROUD}) {
      b.a_out[w] = arc(ri, curve[w]->pole[3][1], s.theta_corner[w], f.theta_corner[w], b.out[w], next.out[w]);
      b.a_up[w] =
          arc(curve[w]->pole[0][0], curve[w]->pole[0][1], s.theta_up[w], f.theta_up[w], b.up[w], next.up[w]);
    }
    b.a_end[HUB] = arc(r_disk, meridian.nut_end_z, s.theta_up[HUB], f.theta_up[HUB], b.disk, next.disk);
    b.a_end[SHROUD] =
        arc(r_pipe, meridian.inlet_z, s.theta_up[SHROUD], f.theta_up[SHROUD], b.inlet, next.inlet);
  }

  const auto revolved = [&](const Handle(Geom_Curve) & basis) -> Handle(Geom_Surface) {
    return new Geom_SurfaceOfRevolution(basis, gp::OZ());
  };
  for (int i = 0; i < n; i++) {
    Blade &b = blade[i], &next = blade[(i + 1) % n];
    const Shape &s = *b.shape, &f = *next.shape;
    const std::string number = "_" + std::to_string(i + 1), blade_number = "_" + std::to_string(b.turns + 1);
    const double base = b.turns * pitch - margin, turn = b.turns * pitch, near = margin,
                 far = margin + far_of(i);
    for (int w : {HUB, SHROUD}) {
      const auto up_on_wall = [&](const Shape &shape, double offset) -> Handle(Geom2d_Curve) {
        if (shape.guide[w].IsNull())
          return along_v(shape.theta_up[w] + offset);
        return moved(shape.guide_on_wall[w], offset);
      };
      std::vector<CwEdgeUse> loop = {{b.e_up[w], true, up_on_wall(s, near)},
                                     {b.e_nose_p[w], true, moved(s.leading.on_wall[w], near)},
                                     {b.e_p[w], true, moved(s.pressure.on_wall[w], near)},
                                     {b.e_down[w], true, along_v(s.theta_corner[w] + near)},
                                     {b.a_out[w], true, along_u(1)},
                                     {next.e_down[w], false, along_v(f.theta_corner[w] + far)}};
      if (f.has_trailing)
        loop.push_back({next.e_te[w], false, moved(f.trailing.on_wall[w], far)});
      if (f.has_bevel)
        loop.push_back({next.e_bevel[w], false, moved(f.bevel.on_wall[w], far)});
      loop.push_back({next.e_s[w], false, moved(f.suction.on_wall[w], far)});
      loop.push_back({next.e_nose_s[w], true, moved(f.leading.on_wall[w], far)});
      loop.push_back({next.e_up[w], false, up_on_wall(f, far)});
      loop.push_back({b.a_up[w], false, along_u(0)});
      shell.face(revolved(meridian_curve(*curve[w], base)), loop, w == SHROUD, w == HUB ? "hub" : "shroud",
                 "wall", (w == HUB ? "hub" : "shroud") + number);
    }
    shell.face(revolved(nut_curve(base)),
               {{b.e_end[HUB], true, along_v(s.theta_up[HUB] + near)},
                {b.a_up[HUB], true, along_u(1)},
                {next.e_end[HUB], false, along_v(f.theta_up[HUB] + far)},
                {b.a_end[HUB], false, along_u(0)}},
               false, "hub_nut", "wall", "hub_nut" + number);
    const double z_inlet = mm * meridian.inlet_z, z_eye = mm * curve[SHROUD]->pole[0][1],
                 half = mm * design->outlet_width / 2;
    shell.face(new Geom_CylindricalSurface(frame(b.turns), mm * r_pipe),
               {{b.e_end[SHROUD], true, along_v(s.theta_up[SHROUD] + near)},
                {b.a_up[SHROUD], true, along_u(z_eye)},
                {next.e_end[SHROUD], false, along_v(f.theta_up[SHROUD] + far)},
                {b.a_end[SHROUD], false, along_u(z_inlet)}},
               true, "suction_pipe", "wall", "suction_pipe" + number);
    // An axial line has z as its parameter, a helix 0 to 1.
    const auto across_interface = [&](const Shape &shape, double offset) -> Handle(Geom2d_Curve) {
      if (shape.theta_corner[HUB] == shape.theta_corner[SHROUD])
        return along_v(shape.theta_corner[HUB] + offset);
      TColgp_Array1OfPnt2d poles(1, 2);
      poles.SetValue(1, gp_Pnt2d(shape.theta_corner[SHROUD] + offset, -half));
      poles.SetValue(2, gp_Pnt2d(shape.theta_corner[HUB] + offset, half));
      return new Geom2d_BezierCurve(poles);
    };
    shell.face(new Geom_CylindricalSurface(frame(b.turns), mm * ri),
               {{b.x_out, true, across_interface(s, near)},
                {b.a_out[HUB], true, along_u(half)},
                {next.x_out, false, across_interface(f, far)},
                {b.a_out[SHROUD], false, along_u(-half)}},
               true, "rotor_interface", "interface", "rotor_interface" + number);
    const auto blade_face = [&](const Patch &patch, std::vector<CwEdgeUse> loop, bool outward,
                                const char *part, const char *patch_name) {
      Handle(Geom_Surface) surface = Handle(Geom_Surface)::DownCast(patch.surface->Copy());
      surface->Rotate(gp::OZ(), turn);
      shell.face(surface, loop, outward, patch_name, "wall", std::string(s.name) + part + blade_number);
    };
    blade_face(s.leading,
               {{b.e_nose_s[HUB], true, along_u(0)},
                {b.e_nose_p[HUB], true, along_u(0)},
                {b.x_p, true, along_v(1)},
                {b.e_nose_p[SHROUD], false, along_u(1)},
                {b.e_nose_s[SHROUD], false, along_u(1)},
                {b.x_s, false, along_v(0)}},
               false, "_leading_edge", "blade_leading_edge");
    blade_face(s.pressure,
               {{b.e_p[HUB], true, along_u(0)},
                {b.x_corner, true, along_v(1)},
                {b.e_p[SHROUD], false, along_u(1)},
                {b.x_p, false, along_v(0)}},
               false, "_pressure", "blade_pressure");
    blade_face(s.suction,
               {{b.e_s[HUB], true, along_u(0)},
                {b.x_bevel0, true, along_v(s.u_bevel)},
                {b.e_s[SHROUD], false, along_u(1)},
                {b.x_s, false, along_v(0)}},
               true, "_suction", "blade_suction");
    if (s.has_bevel)
      blade_face(s.bevel,
                 {{b.e_bevel[HUB], true, along_u(0)},
                  {s.has_trailing ? b.x_bevel1 : b.x_corner, true, along_v(1)},
                  {b.e_bevel[SHROUD], false, along_u(1)},
                  {b.x_bevel0, false, along_v(0)}},
                 true, "_trailing_bevel", "blade_trailing_edge");
    if (s.has_trailing)
      blade_face(s.trailing,
                 {{b.e_te[HUB], true, along_u(0)},
                  {b.x_corner, true, along_v(1)},
                  {b.e_te[SHROUD], false, along_u(1)},
                  {b.x_bevel1, false, along_v(0)}},
                 true, "_trailing_edge", "blade_trailing_edge");
  }
  // The flat ends: one disk each, bounded by the arcs of the passages. The plane's axes are those of passage
  // 0, the arcs' those of their own passage.
  const auto disk = [&](double height, double r, int w, bool outward, const char *patch, const char *kind,
                        const char *name) {
    std::vector<CwEdgeUse> loop;
    for (int i = 0; i < n; i++) {
      const double angle = blade[i].turns * pitch - margin;
      loop.push_back(
          {blade[i].a_end[w], true,
           new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(std::cos(angle), std::sin(angle))), mm * r)});
    }
    shell.face(new Geom_Plane(gp_Ax3(gp_Pnt(0, 0, mm * height), gp::DZ(), gp::DX())), loop, outward, patch,
               kind, name);
  };
  disk(meridian.nut_end_z, r_disk, HUB, true, "hub_nut", "wall", "hub_nut_end");
  disk(meridian.inlet_z, r_pipe, SHROUD, false, "inlet", "inlet", "inlet");
  return shell.finish("rotor");
}

// Name of the first face that OpenCASCADE finds fault with; "" if all is well.
std::string faulty_face(const CwSolid *solid) {
  BRepCheck_Analyzer check(solid->solid);
  if (check.IsValid())
    return "";
  for (const CwSolidFace &face : solid->faces)
    if (!check.IsValid(face.face))
      return face.name;
  return solid->faces.front().name;
}

} // namespace

CwStatus cw_rotor_build(const CwDesign *design, CwSolid **rotor) {
  CwStatus status = CW_OK;
  *rotor = nullptr;
  try {
    Rotor builder(design);
    CW_TRY(builder.sections());
    *rotor = builder.build();
    const std::string faulty = faulty_face(*rotor);
    if (!faulty.empty()) {
      cw_solid_free(rotor);
      status = CW_FAIL(
          CW_ERR_GEOMETRY,
          "rotor: the edges of face %s cross with %d blades%s and a wrap of %.1f deg: lower blade_count or "
          "blade_thickness_mm, leave splitter_start out, or take blade_form twisted",
          faulty.c_str(), design->blade_count, design->splitter_start > 0 ? " and as many splitters" : "",
          design->wrap_angle * 180 / M_PI);
    }
  } catch (const Standard_Failure &failure) {
    status = CW_FAIL(CW_ERR_GEOMETRY, "rotor: %s", failure.GetMessageString());
  } catch (const std::exception &failure) {
    status = CW_FAIL(CW_ERR_GEOMETRY, "rotor: %s", failure.what());
  }
done:
  return status;
}
