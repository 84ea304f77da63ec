// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/rotor.h"

#include <array>
#include <cmath>
#include <memory>

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
#include <gp_Ax3.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>

#include "geometry/blade.h"
#include "geometry/bspline_fit.hpp"
#include "geometry/meridian.h"
#include "geometry/shell_builder.hpp"

namespace {

const double mm = 1e3;
// Parameter planes of the surfaces of revolution begin this far before a blade's trailing edge, so that a
// whole passage has angles between 0 and 2 pi.
const double margin = 0.5;
const int span_points = 13;

// Angles are of blade 0; the suffix says the curve of revolution on which they lie.
enum { HUB, SHROUD };

// One blade patch: grid of (q, theta) points, interpolated. The pressure and suction sides run from the
// leading edge to D2, the leading edge from suction to pressure, bevel and trailing edge towards greater
// theta.
struct Patch {
  std::vector<double> u;
  std::vector<CwBladePoint> points;       // points[i * span_points + j]
  Handle(Geom_BSplineSurface) surface;    // of blade 0
  Handle(Geom2d_BSplineCurve) on_wall[2]; // (theta, t) on hub and shroud
};

class Rotor {
public:
  explicit Rotor(const CwDesign *from) : design(from) {}
  CwStatus sections();
  CwSolid *build();

private:
  const CwDesign *design;
  CwMeridian meridian;
  std::vector<CwBladeSection> section;
  std::vector<double> span;
  Patch pressure, suction, leading, bevel, trailing;
  double u_bevel; // parameter of the suction side where the bevel begins
  double pitch;
  CwShellBuilder shell;

  void fill(Patch &patch);
  void blade_patches();
  gp_Pnt at(double r, double theta, double z) const {
    return gp_Pnt(mm * r * std::cos(theta), mm * r * std::sin(theta), mm * z);
  }
  gp_Ax3 frame(int k, double z = 0) const;
  Handle(Geom_Curve) meridian_curve(const CwMeridianCurve &curve, double theta) const;
  Handle(Geom_Curve) nut_curve(double theta) const;
  // The blade's boundary on hub or shroud, turned to blade k.
  Handle(Geom_Curve) wall_curve(const Patch &patch, int wall, int k) const;
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
  section.resize(span_points);
  for (int j = 0; j < span_points; j++) {
    span[j] = (double)j / (span_points - 1);
    CW_TRY(cw_blade_section(design, &meridian, span[j], &section[j]));
  }
  for (const CwBladeSection &s : section)
    CW_REQUIRE(s.theta[0] + pitch < 2 * M_PI - 1.5 * margin, CW_ERR_GEOMETRY,
               "the wrap of %.1f deg plus the pitch of %.1f deg must stay under %.1f deg",
               s.theta[0] * 180 / M_PI, pitch * 180 / M_PI, (2 * M_PI - 1.5 * margin) * 180 / M_PI);
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

void Rotor::blade_patches() {
  const int side_points = 81, nose_points = 33, short_points = 5, bevel_points = 8;
  const CwBladeSection &middle = section[span_points / 2];
  const double q_bevel = cw_blade_bevel_begin(&middle, design->trailing_edge_bevel);
  const double theta_bevel = cw_blade_bevel_theta(&middle, q_bevel);
  const double theta_corner = cw_blade_side(&middle, CW_BLADE_PRESSURE, 1).theta;
  if (!(q_bevel > 0.9 && theta_bevel < theta_corner))
    throw Standard_Failure("the bevel is longer than the trailing edge");
  for (int i = 0; i < nose_points; i++) {
    leading.u.push_back((double)i / (nose_points - 1));
    for (int j = 0; j < span_points; j++)
      leading.points.push_back(cw_blade_leading_edge(&section[j], M_PI * (leading.u.back() - 0.5)));
  }
  // Parameters of the sides run from 0 at the leading edge to 1 on D2, closer together towards the leading
  // edge. The suction side has a row where the bevel begins, so that the bevel's row of points is one of its
  // own.
  for (int i = 0; i < side_points; i++) {
    const double g = (double)i / (side_points - 1);
    pressure.u.push_back(0.4 * g + 0.6 * g * g);
  }
  const double nose = middle.nose;
  u_bevel = (q_bevel - nose) / (1 - nose);
  for (double u : pressure.u)
    if (u < u_bevel * 0.995)
      suction.u.push_back(u);
  for (int i = 0; i < bevel_points; i++)
    suction.u.push_back(u_bevel + (1 - u_bevel) * i / (bevel_points - 1));
  for (Patch *side : {&pressure, &suction})
    for (double u : side->u)
      for (int j = 0; j < span_points; j++) {
        // Near the end q depends on u in the same way for all sections, so that the bevel begins at one q.
        const double q = u >= u_bevel ? nose + (1 - nose) * u
                                      : section[j].nose + (q_bevel - section[j].nose) * u / u_bevel;
        side->points.push_back(
            cw_blade_side(&section[j], side == &pressure ? CW_BLADE_PRESSURE : CW_BLADE_SUCTION, q));
      }
  for (int i = 0; i < short_points; i++) {
    const double f = (double)i / (short_points - 1);
    bevel.u.push_back(f);
    trailing.u.push_back(f);
    for (int j = 0; j < span_points; j++) {
      const CwBladePoint begin = cw_blade_side(&section[j], CW_BLADE_SUCTION, q_bevel);
      bevel.points.push_back({q_bevel + (1 - q_bevel) * f, begin.theta + (theta_bevel - begin.theta) * f});
      trailing.points.push_back({1, theta_bevel + (theta_corner - theta_bevel) * f});
    }
  }
  for (Patch *patch : {&pressure, &suction, &leading, &bevel, &trailing})
    fill(*patch);
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

CwSolid *Rotor::build() {
  blade_patches();
  const int z = design->blade_count;
  const double theta_corner = pressure.points.back().theta;
  const double theta_tip[2] = {leading.points[(leading.u.size() / 2) * span_points].theta,
                               leading.points[(leading.u.size() / 2) * span_points + span_points - 1].theta};
  const CwMeridianCurve *curve[2] = {&meridian.hub, &meridian.shroud};
  const double r_disk = meridian.nut_disk_radius, r_pipe = design->inlet_diameter / 2;
  const double ri = design->interface_radius;
  const double t_tip[2] = {cw_meridian_parameter(curve[HUB], meridian.hub_leading),
                           cw_meridian_parameter(curve[SHROUD], meridian.shroud_leading)};
  const double t_corner[2] = {cw_meridian_parameter(curve[HUB], meridian.hub_trailing),
                              cw_meridian_parameter(curve[SHROUD], meridian.shroud_trailing)};

  // Vertices and edges, blade by blade. [wall] is HUB or SHROUD.
  struct Blade {
    // Upstream corner of the meridian line on the wall, tip of the nose, nose/pressure, nose/suction,
    // pressure corner on D2, begin and end of the bevel, on the interface.
    int up[2], tip[2], nose_p[2], nose_s[2], corner[2], bevel0[2], bevel1[2], out[2], disk, inlet;
    // Edges: meridian lines, their continuation on nut or pipe, the blade's foot, and across the span.
    int e_up[2], e_down[2], e_end[2], e_nose_s[2], e_nose_p[2], e_p[2], e_s[2], e_bevel[2], e_te[2];
    int x_p, x_s, x_bevel0, x_bevel1, x_corner, x_out;
    // Arcs from this blade to the next.
    int a_out[2], a_up[2], a_end[2];
  };
  std::vector<Blade> blade(z);
  for (int k = 0; k < z; k++) {
    Blade &b = blade[k];
    const double turn = k * pitch;
    for (int w : {HUB, SHROUD}) {
      const double r0 = curve[w]->pole[0][0], z0 = curve[w]->pole[0][1];
      const Handle(Geom_Curve) up = meridian_curve(*curve[w], turn + theta_tip[w]);
      const Handle(Geom_Curve) down = meridian_curve(*curve[w], turn + theta_corner);
      const Handle(Geom_Curve) nose = wall_curve(leading, w, k), side_p = wall_curve(pressure, w, k);
      const Handle(Geom_Curve) side_s = wall_curve(suction, w, k), cut = wall_curve(trailing, w, k);
      b.up[w] = shell.vertex(at(r0, turn + theta_tip[w], z0));
      b.tip[w] = shell.vertex(nose->Value(0.5));
      b.nose_p[w] = shell.vertex(nose->Value(1));
      b.nose_s[w] = shell.vertex(nose->Value(0));
      b.corner[w] = shell.vertex(cut->Value(1));
      b.bevel0[w] = shell.vertex(side_s->Value(u_bevel));
      b.bevel1[w] = shell.vertex(cut->Value(0));
      b.out[w] = shell.vertex(down->Value(1));
      b.e_up[w] = shell.edge(up, 0, t_tip[w], b.up[w], b.tip[w]);
      b.e_down[w] = shell.edge(down, t_corner[w], 1, b.corner[w], b.out[w]);
      b.e_nose_s[w] = shell.edge(nose, 0, 0.5, b.nose_s[w], b.tip[w]);
      b.e_nose_p[w] = shell.edge(nose, 0.5, 1, b.tip[w], b.nose_p[w]);
      b.e_p[w] = shell.edge(side_p, 0, 1, b.nose_p[w], b.corner[w]);
      b.e_s[w] = shell.edge(side_s, 0, u_bevel, b.nose_s[w], b.bevel0[w]);
      b.e_bevel[w] = shell.edge(wall_curve(bevel, w, k), 0, 1, b.bevel0[w], b.bevel1[w]);
      b.e_te[w] = shell.edge(cut, 0, 1, b.bevel1[w], b.corner[w]);
    }
    b.disk = shell.vertex(at(r_disk, turn + theta_tip[HUB], meridian.nut_end_z));
    b.inlet = shell.vertex(at(r_pipe, turn + theta_tip[SHROUD], meridian.inlet_z));
    b.e_end[HUB] = shell.edge(nut_curve(turn + theta_tip[HUB]), 0, 1, b.disk, b.up[HUB]);
    b.e_end[SHROUD] =
        shell.edge(new Geom_Line(at(r_pipe, turn + theta_tip[SHROUD], 0), gp::DZ()), mm * meridian.inlet_z,
                   mm * curve[SHROUD]->pole[0][1], b.inlet, b.up[SHROUD]);
    const auto across = [&](const Patch &patch, double u, int begin, int end) {
      return shell.edge(turned(patch.surface->UIso(u), turn), 0, 1, begin, end);
    };
    b.x_p = across(leading, 1, b.nose_p[HUB], b.nose_p[SHROUD]);
    b.x_s = across(leading, 0, b.nose_s[HUB], b.nose_s[SHROUD]);
    b.x_bevel0 = across(bevel, 0, b.bevel0[HUB], b.bevel0[SHROUD]);
    b.x_bevel1 = across(trailing, 0, b.bevel1[HUB], b.bevel1[SHROUD]);
    b.x_corner = across(trailing, 1, b.corner[HUB], b.corner[SHROUD]);
    b.x_out =
        shell.edge(new Geom_Line(at(ri, turn + theta_corner, 0), gp::DZ()), -mm * design->outlet_width / 2,
                   mm * design->outlet_width / 2, b.out[SHROUD], b.out[HUB]);
  }
  // Arcs have the angle in the frame of their passage as parameter.
  const auto arc = [&](int k, double r, double height, double theta, int begin, int end) {
    const gp_Ax3 axes = frame(k, height);
    return shell.edge(new Geom_Circle(axes.Ax2(), mm * r), theta + margin, theta + margin + pitch, begin,
                      end);
  };
  for (int k = 0; k < z; k++) {
    Blade &b = blade[k], &next = blade[(k + 1) % z];
    for (int w : {HUB, SHROUD}) {
      b.a_out[w] = arc(k, ri, curve[w]->pole[3][1], theta_corner, b.out[w], next.out[w]);
      b.a_up[w] = arc(k, curve[w]->pole[0][0], curve[w]->pole[0][1], theta_tip[w], b.up[w], next.up[w]);
    }
    b.a_end[HUB] = arc(k, r_disk, meridian.nut_end_z, theta_tip[HUB], b.disk, next.disk);
    b.a_end[SHROUD] = arc(k, r_pipe, meridian.inlet_z, theta_tip[SHROUD], b.inlet, next.inlet);
  }

  const auto revolved = [&](const Handle(Geom_Curve) & basis) -> Handle(Geom_Surface) {
    return new Geom_SurfaceOfRevolution(basis, gp::OZ());
  };
  for (int k = 0; k < z; k++) {
    Blade &b = blade[k], &next = blade[(k + 1) % z];
    const std::string number = "_" + std::to_string(k + 1);
    const double base = k * pitch - margin, turn = k * pitch;
    for (int w : {HUB, SHROUD}) {
      const double u_tip = theta_tip[w] + margin, u_out = theta_corner + margin, near = margin,
                   far = margin + pitch;
      shell.face(revolved(meridian_curve(*curve[w], base)),
                 {{b.e_up[w], true, along_v(u_tip)},
                  {b.e_nose_p[w], true, moved(leading.on_wall[w], near)},
                  {b.e_p[w], true, moved(pressure.on_wall[w], near)},
                  {b.e_down[w], true, along_v(u_out)},
                  {b.a_out[w], true, along_u(1)},
                  {next.e_down[w], false, along_v(u_out + pitch)},
                  {next.e_te[w], false, moved(trailing.on_wall[w], far)},
                  {next.e_bevel[w], false, moved(bevel.on_wall[w], far)},
                  {next.e_s[w], false, moved(suction.on_wall[w], far)},
                  {next.e_nose_s[w], true, moved(leading.on_wall[w], far)},
                  {next.e_up[w], false, along_v(u_tip + pitch)},
                  {b.a_up[w], false, along_u(0)}},
                 w == SHROUD, w == HUB ? "hub" : "shroud", "wall", (w == HUB ? "hub" : "shroud") + number);
    }
    const double u_hub = theta_tip[HUB] + margin, u_shroud = theta_tip[SHROUD] + margin;
    shell.face(revolved(nut_curve(base)),
               {{b.e_end[HUB], true, along_v(u_hub)},
                {b.a_up[HUB], true, along_u(1)},
                {next.e_end[HUB], false, along_v(u_hub + pitch)},
                {b.a_end[HUB], false, along_u(0)}},
               false, "hub_nut", "wall", "hub_nut" + number);
    const double z_inlet = mm * meridian.inlet_z, z_eye = mm * curve[SHROUD]->pole[0][1],
                 half = mm * design->outlet_width / 2;
    shell.face(new Geom_CylindricalSurface(frame(k), mm * r_pipe),
               {{b.e_end[SHROUD], true, along_v(u_shroud)},
                {b.a_up[SHROUD], true, along_u(z_eye)},
                {next.e_end[SHROUD], false, along_v(u_shroud + pitch)},
                {b.a_end[SHROUD], false, along_u(z_inlet)}},
               true, "suction_pipe", "wall", "suction_pipe" + number);
    shell.face(new Geom_CylindricalSurface(frame(k), mm * ri),
               {{b.x_out, true, along_v(theta_corner + margin)},
                {b.a_out[HUB], true, along_u(half)},
                {next.x_out, false, along_v(theta_corner + margin + pitch)},
                {b.a_out[SHROUD], false, along_u(-half)}},
               true, "rotor_interface", "interface", "rotor_interface" + number);
    const auto blade_face = [&](const Patch &patch, std::vector<CwEdgeUse> loop, bool outward,
                                const char *name) {
      Handle(Geom_Surface) surface = Handle(Geom_Surface)::DownCast(patch.surface->Copy());
      surface->Rotate(gp::OZ(), turn);
      const bool tail = &patch == &bevel || &patch == &trailing;
      shell.face(surface, loop, outward, tail ? "blade_trailing_edge" : name, "wall", name + number);
    };
    blade_face(leading,
               {{b.e_nose_s[HUB], true, along_u(0)},
                {b.e_nose_p[HUB], true, along_u(0)},
                {b.x_p, true, along_v(1)},
                {b.e_nose_p[SHROUD], false, along_u(1)},
                {b.e_nose_s[SHROUD], false, along_u(1)},
                {b.x_s, false, along_v(0)}},
               false, "blade_leading_edge");
    blade_face(pressure,
               {{b.e_p[HUB], true, along_u(0)},
                {b.x_corner, true, along_v(1)},
                {b.e_p[SHROUD], false, along_u(1)},
                {b.x_p, false, along_v(0)}},
               false, "blade_pressure");
    blade_face(suction,
               {{b.e_s[HUB], true, along_u(0)},
                {b.x_bevel0, true, along_v(u_bevel)},
                {b.e_s[SHROUD], false, along_u(1)},
                {b.x_s, false, along_v(0)}},
               true, "blade_suction");
    blade_face(bevel,
               {{b.e_bevel[HUB], true, along_u(0)},
                {b.x_bevel1, true, along_v(1)},
                {b.e_bevel[SHROUD], false, along_u(1)},
                {b.x_bevel0, false, along_v(0)}},
               true, "blade_trailing_bevel");
    blade_face(trailing,
               {{b.e_te[HUB], true, along_u(0)},
                {b.x_corner, true, along_v(1)},
                {b.e_te[SHROUD], false, along_u(1)},
                {b.x_bevel1, false, along_v(0)}},
               true, "blade_trailing_edge");
  }
  // The flat ends: one disk each, bounded by the arcs of the passages. The plane's axes are those of passage
  // 0, the arcs' those of their own passage.
  const auto disk = [&](double height, double r, int w, bool outward, const char *patch, const char *kind,
                        const char *name) {
    std::vector<CwEdgeUse> loop;
    for (int k = 0; k < z; k++) {
      const double angle = k * pitch - margin;
      loop.push_back(
          {blade[k].a_end[w], true,
           new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(std::cos(angle), std::sin(angle))), mm * r)});
    }
    shell.face(new Geom_Plane(gp_Ax3(gp_Pnt(0, 0, mm * height), gp::DZ(), gp::DX())), loop, outward, patch,
               kind, name);
  };
  disk(meridian.nut_end_z, r_disk, HUB, true, "hub_nut", "wall", "hub_nut_end");
  disk(meridian.inlet_z, r_pipe, SHROUD, false, "inlet", "inlet", "inlet");
  return shell.finish("rotor");
}

} // namespace

CwStatus cw_rotor_build(const CwDesign *design, CwSolid **rotor) {
  CwStatus status = CW_OK;
  *rotor = nullptr;
  try {
    Rotor builder(design);
    CW_TRY(builder.sections());
    *rotor = builder.build();
  } catch (const Standard_Failure &failure) {
    status = CW_FAIL(CW_ERR_GEOMETRY, "rotor: %s", failure.GetMessageString());
  } catch (const std::exception &failure) {
    status = CW_FAIL(CW_ERR_GEOMETRY, "rotor: %s", failure.what());
  }
done:
  return status;
}
