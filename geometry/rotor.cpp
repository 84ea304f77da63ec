// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/rotor.h"

#include <algorithm>
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
#include "geometry/blade_patches.hpp"
#include "geometry/bspline_fit.hpp"
#include "geometry/meridian.h"
#include "geometry/model_unit.h"
#include "geometry/shell_builder.hpp"
#include "geometry/solid.hpp"

namespace {

// Parameter planes of the surfaces of revolution begin a margin before a blade's trailing edge, so that a whole passage
// has angles between 0 and 2 pi; half of it is left behind the leading edge. rad; bevels and leaning edges need the
// least.
const double usual_margin = 0.5, least_margin = 0.15;
enum { WALL_LEVELS = 4 }; // curves along the blade: hub, ends of both root fillets, shroud

// A blade in the shell. Levels run from the hub's (0) to the shroud's, one more than bands; inner levels are
// where root fillets end.
struct Blade {
  const CwBladeShape *shape;
  int turns; // multiples of the pitch
  // Vertices on the walls: upstream corner of the meridian line, tip of the nose, on the interface.
  int up[2], tip[2], out[2], disk, inlet, shaft;
  // Vertices of each level: nose/pressure, nose/suction, end of the pressure side, begin and end of the bevel.
  int nose_p[WALL_LEVELS], nose_s[WALL_LEVELS], corner[WALL_LEVELS], bevel0[WALL_LEVELS], bevel1[WALL_LEVELS];
  // Edges on the walls: meridian lines, their continuation on nut or pipe, along the shaft and the inlet, arcs
  // from this blade to the next.
  int e_up[2], e_down[2], e_end[2], e_shaft, e_inlet, x_out, a_out[2], a_up[2], a_end[2], a_shaft;
  // Edges of each level. On a wall the nose has two edges with the tip between, on an inner level one (nose_p).
  int e_nose_s[WALL_LEVELS], e_nose_p[WALL_LEVELS], e_p[WALL_LEVELS], e_s[WALL_LEVELS], e_bevel[WALL_LEVELS],
      e_te[WALL_LEVELS];
  // Edges across the span, of each band.
  int x_p[WALL_LEVELS], x_s[WALL_LEVELS], x_bevel0[WALL_LEVELS], x_bevel1[WALL_LEVELS], x_corner[WALL_LEVELS];
};

class Rotor {
public:
  Rotor(const CwDesign *from, double model_unit) : design(from), unit(model_unit), scale(1 / model_unit) {}
  CwStatus sections();
  CwSolid *build();

private:
  const CwDesign *design;
  const double unit, scale; // the model unit, m; model units in a metre
  CwMeridian meridian;
  const CwMeridianCurve *curve[2];  // hub and shroud
  std::vector<CwBladeShape> shapes; // the blade and, with splitters, the splitter behind its pressure side
  std::vector<Blade> blade;         // splitters among the blades
  double pitch, margin;
  int bands;
  bool has_nut, has_shaft;
  CwShellBuilder shell;

  gp_Pnt at(double r, double theta, double z) const {
    return gp_Pnt(scale * r * std::cos(theta), scale * r * std::sin(theta), scale * z);
  }
  gp_Ax3 frame(int k, double z = 0) const;
  Handle(Geom_Curve) meridian_curve(const CwMeridianCurve &curve, double theta) const;
  Handle(Geom_Curve) nut_curve(double theta) const;
  // An edge between places (r, theta, z), in which it is linear: straight where both angles are the same, else part of
  // a helix or spiral.
  int slanted_line(const double from[3], const double to[3], int begin, int end);
  void level_edges(Blade &b, int level);
  void band_edges(Blade &b, int band);
  void wall_edges(Blade &b);
  void arcs(int i);
  void wall_face(int i, int w);
  void pipe_faces(int i);
  void blade_faces(int i);
  void disk(double height, double r, int w, bool outward, const char *patch, const char *kind, const char *name);
  // Angle of the next blade's frame in that of blade i: 0, or the pitch where it is the first of its pitch.
  double far_of(int i) const {
    return (i + 1) % (int)shapes.size() == 0 ? pitch : 0;
  }
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
  double last = 0; // angle of the foremost leading edge
  pitch = 2 * M_PI / design->blade_count;
  CW_TRY(cw_meridian_make(design, &meridian));
  shapes.resize(design->splitter_start > 0 ? 2 : 1);
  for (int j = 0; j < CW_SPAN_POINTS; j++) {
    CwBladeSection section;
    CW_TRY(cw_blade_section(design, &meridian, (double)j / (CW_SPAN_POINTS - 1), &section));
    shapes[0].section.push_back(section);
    if (shapes.size() > 1) shapes[1].section.push_back(cw_blade_splitter(design, &section));
  }
  shapes[0].name = "blade";
  if (shapes.size() > 1) shapes[1].name = "splitter";
  for (const CwBladeShape &shape : shapes)
    for (const CwBladeSection &s : shape.section) {
      last = std::max(last, cw_blade_theta(&s, 0));
      CW_REQUIRE(s.nose < 0.5 * s.end && s.nose < 0.8 * s.thickest_at, CW_ERR_GEOMETRY,
                 "the leading edge's ellipse takes %.0f %% of the %s at span %.2f: lower "
                 "leading_edge_thickness_mm or leading_edge_ratio, or raise thickest_at",
                 100 * s.nose, shape.name, s.span);
    }
  margin = std::min(usual_margin, (2 * M_PI - last - pitch) / 1.5);
  CW_REQUIRE(margin >= least_margin, CW_ERR_GEOMETRY,
             "the wrap of %.1f deg plus the pitch of %.1f deg must stay under %.1f deg: lower wrap_angle_deg or "
             "raise blade_count",
             last * 180 / M_PI, pitch * 180 / M_PI, (2 * M_PI - 1.5 * least_margin) * 180 / M_PI);
done:
  return status;
}

// Axes whose x axis is the zero of the parameter plane of passage k.
gp_Ax3 Rotor::frame(int k, double z) const {
  const double angle = k * pitch - margin;
  return gp_Ax3(gp_Pnt(0, 0, scale * z), gp::DZ(), gp_Dir(std::cos(angle), std::sin(angle), 0));
}

Handle(Geom_Curve) Rotor::meridian_curve(const CwMeridianCurve &curve, double theta) const {
  TColgp_Array1OfPnt poles(1, 4);
  for (int i = 0; i < 4; i++) poles.SetValue(i + 1, at(curve.pole[i][0], theta, curve.pole[i][1]));
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

const int slanted_points = 33;

int Rotor::slanted_line(const double from[3], const double to[3], int begin, int end) {
  const gp_Pnt first = at(from[0], from[1], from[2]), last = at(to[0], to[1], to[2]);
  if (from[1] == to[1])
    return shell.edge(new Geom_Line(first, gp_Dir(gp_Vec(first, last))), 0, first.Distance(last), begin, end);
  std::vector<double> u;
  std::vector<gp_Pnt> x;
  for (int i = 0; i < slanted_points; i++) {
    const double f = (double)i / (slanted_points - 1);
    u.push_back(f);
    x.push_back(at(from[0] + f * (to[0] - from[0]), from[1] + f * (to[1] - from[1]), from[2] + f * (to[2] - from[2])));
  }
  return shell.edge(cw_bspline_curve_3d(u, x), 0, 1, begin, end);
}

// The same between (r, theta) in the plane's parameters.
Handle(Geom2d_Curve) slanted_line_in_plane(double scale, double r, double theta, double to_r, double to_theta) {
  const auto in_plane = [&](double f) {
    const double at_r = scale * (r + f * (to_r - r)), angle = theta + f * (to_theta - theta);
    return gp_Pnt2d(at_r * std::cos(angle), at_r * std::sin(angle));
  };
  if (theta == to_theta) return new Geom2d_Line(in_plane(0), gp_Dir2d(gp_Vec2d(in_plane(0), in_plane(1))));
  std::vector<double> u;
  std::vector<gp_Pnt2d> x;
  for (int i = 0; i < slanted_points; i++) {
    u.push_back((double)i / (slanted_points - 1));
    x.push_back(in_plane(u.back()));
  }
  return cw_bspline_curve_2d(u, x);
}

// The curve along a patch at a level, of blade 0.
Handle(Geom_Curve) along(const CwBladePatch &patch, int level) {
  const int bands = (int)patch.band.size();
  return level < bands ? patch.band[level]->VIso(0) : patch.band[bands - 1]->VIso(1);
}

// Vertices and edges along the blade at a level.
void Rotor::level_edges(Blade &b, int level) {
  const CwBladeShape &s = *b.shape;
  const double turn = b.turns * pitch;
  const Handle(Geom_Curve) nose = turned(along(s.leading, level), turn);
  const Handle(Geom_Curve) side_p = turned(along(s.pressure, level), turn);
  const Handle(Geom_Curve) side_s = turned(along(s.suction, level), turn);
  b.nose_p[level] = shell.vertex(nose->Value(1));
  b.nose_s[level] = shell.vertex(nose->Value(0));
  b.corner[level] = shell.vertex(side_p->Value(1));
  b.bevel0[level] = b.bevel1[level] = shell.vertex(side_s->Value(s.u_bevel));
  if (s.has_bevel)
    b.bevel1[level] = s.has_trailing ? shell.vertex(turned(along(s.trailing, level), turn)->Value(0)) : b.corner[level];
  b.e_nose_s[level] = -1;
  if (level > 0 && level < bands) {
    b.e_nose_p[level] = shell.edge(nose, 0, 1, b.nose_s[level], b.nose_p[level]);
  } else {
    const int w = level == 0 ? CW_HUB : CW_SHROUD;
    b.tip[w] = shell.vertex(nose->Value(0.5));
    b.e_nose_s[level] = shell.edge(nose, 0, 0.5, b.nose_s[level], b.tip[w]);
    b.e_nose_p[level] = shell.edge(nose, 0.5, 1, b.tip[w], b.nose_p[level]);
  }
  b.e_p[level] = shell.edge(side_p, 0, 1, b.nose_p[level], b.corner[level]);
  b.e_s[level] = shell.edge(side_s, 0, s.u_bevel, b.nose_s[level], b.bevel0[level]);
  if (s.has_bevel)
    b.e_bevel[level] = shell.edge(turned(along(s.bevel, level), turn), 0, 1, b.bevel0[level], b.bevel1[level]);
  if (s.has_trailing)
    b.e_te[level] = shell.edge(turned(along(s.trailing, level), turn), 0, 1, b.bevel1[level], b.corner[level]);
}

// Edges across the span, from a level to the next.
void Rotor::band_edges(Blade &b, int band) {
  const CwBladeShape &s = *b.shape;
  const auto across = [&](const CwBladePatch &patch, double u, const int *vertex) {
    return shell.edge(turned(patch.band[band]->UIso(u), b.turns * pitch), 0, 1, vertex[band], vertex[band + 1]);
  };
  b.x_p[band] = across(s.leading, 1, b.nose_p);
  b.x_s[band] = across(s.leading, 0, b.nose_s);
  b.x_bevel0[band] = across(s.has_bevel ? s.bevel : s.trailing, 0, b.bevel0);
  b.x_bevel1[band] = s.has_bevel && s.has_trailing ? across(s.trailing, 0, b.bevel1) : b.x_bevel0[band];
  b.x_corner[band] = across(s.has_trailing ? s.trailing : s.bevel, 1, b.corner);
}

// Vertices and edges on hub, shroud, nut, shaft and pipe, along the flow.
void Rotor::wall_edges(Blade &b) {
  const CwBladeShape &s = *b.shape;
  const double turn = b.turns * pitch, r_pipe = design->inlet_diameter / 2;
  for (int w : {CW_HUB, CW_SHROUD}) {
    const Handle(Geom_Curve) down = meridian_curve(*curve[w], turn + s.theta_corner[w]);
    b.up[w] = shell.vertex(at(curve[w]->pole[0][0], turn + s.theta_up[w], curve[w]->pole[0][1]));
    b.out[w] = shell.vertex(down->Value(1));
    if (s.guide[w].IsNull())
      b.e_up[w] = shell.edge(meridian_curve(*curve[w], turn + s.theta_up[w]), 0, s.t_tip[w], b.up[w], b.tip[w]);
    else
      b.e_up[w] = shell.edge(turned(s.guide[w], turn), 0, 1, b.up[w], b.tip[w]);
    b.e_down[w] = shell.edge(down, s.t_corner[w], 1, b.corner[w == CW_HUB ? 0 : bands], b.out[w]);
  }
  const double at_hub = turn + s.theta_up[CW_HUB], at_shroud = turn + s.theta_up[CW_SHROUD];
  b.inlet = shell.vertex(at(r_pipe, at_shroud, meridian.inlet_z));
  b.e_end[CW_SHROUD] = shell.edge(new Geom_Line(at(r_pipe, at_shroud, 0), gp::DZ()), scale * meridian.inlet_z,
                                  scale * curve[CW_SHROUD]->pole[0][1], b.inlet, b.up[CW_SHROUD]);
  b.disk = b.up[CW_HUB];
  if (has_nut) {
    b.disk = shell.vertex(at(meridian.nut_disk_radius, at_hub, meridian.nut_end_z));
    b.e_end[CW_HUB] = shell.edge(nut_curve(at_hub), 0, 1, b.disk, b.up[CW_HUB]);
  }
  if (has_shaft) {
    const double r = meridian.shaft_radius, from[3] = {r, at_hub, meridian.inlet_z},
                 to[3] = {r_pipe, at_shroud, meridian.inlet_z};
    b.shaft = shell.vertex(at(r, at_hub, meridian.inlet_z));
    b.e_shaft = shell.edge(new Geom_Line(at(r, at_hub, 0), gp::DZ()), scale * meridian.inlet_z,
                           scale * meridian.nut_end_z, b.shaft, b.disk);
    b.e_inlet = slanted_line(from, to, b.shaft, b.inlet);
  }
  const double ri = design->interface_radius, half = design->outlet_width / 2;
  const double low[3] = {ri, turn + s.theta_corner[CW_SHROUD], -half},
               high[3] = {ri, turn + s.theta_corner[CW_HUB], half};
  b.x_out = slanted_line(low, high, b.out[CW_SHROUD], b.out[CW_HUB]);
}

// Arcs to the next blade. They have the angle in the frame of their passage as parameter.
void Rotor::arcs(int i) {
  Blade &b = blade[i];
  const Blade &next = blade[(i + 1) % blade.size()];
  const CwBladeShape &s = *b.shape, &f = *next.shape;
  const auto arc = [&](double r, double height, double from, double to, int begin, int end) {
    return shell.edge(new Geom_Circle(frame(b.turns, height).Ax2(), scale * r), from + margin, to + margin + far_of(i),
                      begin, end);
  };
  for (int w : {CW_HUB, CW_SHROUD}) {
    b.a_out[w] = arc(design->interface_radius, curve[w]->pole[3][1], s.theta_corner[w], f.theta_corner[w], b.out[w],
                     next.out[w]);
    b.a_up[w] = arc(curve[w]->pole[0][0], curve[w]->pole[0][1], s.theta_up[w], f.theta_up[w], b.up[w], next.up[w]);
  }
  b.a_end[CW_SHROUD] = arc(design->inlet_diameter / 2, meridian.inlet_z, s.theta_up[CW_SHROUD], f.theta_up[CW_SHROUD],
                           b.inlet, next.inlet);
  b.a_end[CW_HUB] = has_nut ? arc(meridian.nut_disk_radius, meridian.nut_end_z, s.theta_up[CW_HUB], f.theta_up[CW_HUB],
                                  b.disk, next.disk)
                            : b.a_up[CW_HUB];
  if (has_shaft)
    b.a_shaft =
        arc(meridian.shaft_radius, meridian.inlet_z, s.theta_up[CW_HUB], f.theta_up[CW_HUB], b.shaft, next.shaft);
}

Handle(Geom_Surface) revolved(const Handle(Geom_Curve) & basis) {
  return new Geom_SurfaceOfRevolution(basis, gp::OZ());
}

// Hub or shroud between a blade and the next.
void Rotor::wall_face(int i, int w) {
  const Blade &b = blade[i], &next = blade[(i + 1) % blade.size()];
  const CwBladeShape &s = *b.shape, &f = *next.shape;
  const double near = margin, far = margin + far_of(i);
  const int level = w == CW_HUB ? 0 : bands;
  const char *patch = w == CW_HUB ? "hub" : "shroud";
  const auto up_on_wall = [&](const CwBladeShape &shape, double offset) -> Handle(Geom2d_Curve) {
    if (shape.guide[w].IsNull()) return along_v(shape.theta_up[w] + offset);
    return moved(shape.guide_on_wall[w], offset);
  };
  std::vector<CwEdgeUse> loop = {{b.e_up[w], true, up_on_wall(s, near)},
                                 {b.e_nose_p[level], true, moved(s.leading.on_wall[w], near)},
                                 {b.e_p[level], true, moved(s.pressure.on_wall[w], near)},
                                 {b.e_down[w], true, along_v(s.theta_corner[w] + near)},
                                 {b.a_out[w], true, along_u(1)},
                                 {next.e_down[w], false, along_v(f.theta_corner[w] + far)}};
  if (f.has_trailing) loop.push_back({next.e_te[level], false, moved(f.trailing.on_wall[w], far)});
  if (f.has_bevel) loop.push_back({next.e_bevel[level], false, moved(f.bevel.on_wall[w], far)});
  loop.push_back({next.e_s[level], false, moved(f.suction.on_wall[w], far)});
  loop.push_back({next.e_nose_s[level], true, moved(f.leading.on_wall[w], far)});
  loop.push_back({next.e_up[w], false, up_on_wall(f, far)});
  loop.push_back({b.a_up[w], false, along_u(0)});
  shell.face(revolved(meridian_curve(*curve[w], b.turns * pitch - margin)), loop, w == CW_SHROUD, patch, "wall",
             patch + ("_" + std::to_string(i + 1)));
}

// Nut, shaft, suction pipe, the inlet round a shaft, and interface, between a blade and the next.
void Rotor::pipe_faces(int i) {
  const Blade &b = blade[i], &next = blade[(i + 1) % blade.size()];
  const CwBladeShape &s = *b.shape, &f = *next.shape;
  const std::string number = "_" + std::to_string(i + 1);
  const double near = margin, far = margin + far_of(i), half = scale * design->outlet_width / 2;
  // A face of revolution between the lines of this blade and the next and the arcs below and above.
  const auto tube = [&](const Handle(Geom_Surface) & surface, int w, int line, int next_line, int low, double v_low,
                        int high, double v_high, bool outward, const char *patch) {
    shell.face(surface,
               {{line, true, along_v(s.theta_up[w] + near)},
                {high, true, along_u(v_high)},
                {next_line, false, along_v(f.theta_up[w] + far)},
                {low, false, along_u(v_low)}},
               outward, patch, "wall", patch + number);
  };
  const auto cylinder = [&](double r) -> Handle(Geom_Surface) {
    return new Geom_CylindricalSurface(frame(b.turns), scale * r);
  };
  const double z_inlet = scale * meridian.inlet_z;
  if (has_nut)
    tube(revolved(nut_curve(b.turns * pitch - margin)), CW_HUB, b.e_end[CW_HUB], next.e_end[CW_HUB], b.a_end[CW_HUB], 0,
         b.a_up[CW_HUB], 1, false, "hub_nut");
  tube(cylinder(design->inlet_diameter / 2), CW_SHROUD, b.e_end[CW_SHROUD], next.e_end[CW_SHROUD], b.a_end[CW_SHROUD],
       z_inlet, b.a_up[CW_SHROUD], scale * curve[CW_SHROUD]->pole[0][1], true, "suction_pipe");
  if (has_shaft) {
    tube(cylinder(meridian.shaft_radius), CW_HUB, b.e_shaft, next.e_shaft, b.a_shaft, z_inlet, b.a_end[CW_HUB],
         scale * meridian.nut_end_z, false, "hub_shaft");
    // In the plane of the inlet, whose axes are those of the passage.
    const auto spoke = [&](const CwBladeShape &shape, double offset) -> Handle(Geom2d_Curve) {
      return slanted_line_in_plane(scale, meridian.shaft_radius, shape.theta_up[CW_HUB] + offset,
                                   design->inlet_diameter / 2, shape.theta_up[CW_SHROUD] + offset);
    };
    const auto circle = [&](double r) -> Handle(Geom2d_Curve) {
      return new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(1, 0)), scale * r);
    };
    shell.face(new Geom_Plane(frame(b.turns, meridian.inlet_z)),
               {{b.e_inlet, true, spoke(s, near)},
                {b.a_end[CW_SHROUD], true, circle(design->inlet_diameter / 2)},
                {next.e_inlet, false, spoke(f, far)},
                {b.a_shaft, false, circle(meridian.shaft_radius)}},
               false, "inlet", "inlet", "inlet" + number);
  }
  // An axial line has its length as its parameter, a helix 0 to 1.
  const auto across_interface = [&](const CwBladeShape &shape, double offset) -> Handle(Geom2d_Curve) {
    if (shape.theta_corner[CW_HUB] == shape.theta_corner[CW_SHROUD])
      return line(shape.theta_corner[CW_HUB] + offset, -half, 0, 1);
    TColgp_Array1OfPnt2d poles(1, 2);
    poles.SetValue(1, gp_Pnt2d(shape.theta_corner[CW_SHROUD] + offset, -half));
    poles.SetValue(2, gp_Pnt2d(shape.theta_corner[CW_HUB] + offset, half));
    return new Geom2d_BezierCurve(poles);
  };
  shell.face(cylinder(design->interface_radius),
             {{b.x_out, true, across_interface(s, near)},
              {b.a_out[CW_HUB], true, along_u(half)},
              {next.x_out, false, across_interface(f, far)},
              {b.a_out[CW_SHROUD], false, along_u(-half)}},
             true, "rotor_interface", "interface", "rotor_interface" + number);
}

// All patches of a blade, band by band.
void Rotor::blade_faces(int i) {
  const Blade &b = blade[i];
  const CwBladeShape &s = *b.shape;
  const std::string number = "_" + std::to_string(b.turns + 1);
  for (int band = 0; band < bands; band++) {
    const bool fillet = bands > 1 && band != 1;
    const std::string root = band == 0 ? "_hub_root" : "_shroud_root";
    // A patch between its edges along both levels and across the span at its begin and end.
    const auto face = [&](const CwBladePatch &patch, const int *row, const int *row_before, const int *begin,
                          const int *end, bool outward, const std::string &part, const std::string &more,
                          const char *patch_name) {
      Handle(Geom_Surface) surface = Handle(Geom_Surface)::DownCast(patch.band[band]->Copy());
      surface->Rotate(gp::OZ(), b.turns * pitch);
      std::vector<CwEdgeUse> loop;
      if (row_before && row_before[band] >= 0) loop.push_back({row_before[band], true, along_u(0)});
      loop.push_back({row[band], true, along_u(0)});
      loop.push_back({end[band], true, along_v(patch.u.back())});
      loop.push_back({row[band + 1], false, along_u(1)});
      if (row_before && row_before[band + 1] >= 0) loop.push_back({row_before[band + 1], false, along_u(1)});
      loop.push_back({begin[band], false, along_v(patch.u.front())});
      shell.face(surface, loop, outward, patch_name, "wall", s.name + part + (fillet ? root : more) + number);
    };
    face(s.leading, b.e_nose_p, b.e_nose_s, b.x_s, b.x_p, false, "_leading", "_edge", "blade_leading_edge");
    face(s.pressure, b.e_p, nullptr, b.x_p, b.x_corner, false, "_pressure", "", "blade_pressure");
    face(s.suction, b.e_s, nullptr, b.x_s, b.x_bevel0, true, "_suction", "", "blade_suction");
    if (s.has_bevel)
      face(s.bevel, b.e_bevel, nullptr, b.x_bevel0, s.has_trailing ? b.x_bevel1 : b.x_corner, true,
           fillet ? "_bevel" : "_trailing", "_bevel", "blade_trailing_edge");
    if (s.has_trailing)
      face(s.trailing, b.e_te, nullptr, b.x_bevel1, b.x_corner, true, "_trailing", "_edge", "blade_trailing_edge");
  }
}

// A flat end: one disk, bounded by the arcs of the passages. The plane's axes are those of passage 0, the
// arcs' those of their own passage.
void Rotor::disk(double height, double r, int w, bool outward, const char *patch, const char *kind, const char *name) {
  std::vector<CwEdgeUse> loop;
  for (const Blade &b : blade) {
    const double angle = b.turns * pitch - margin;
    loop.push_back({b.a_end[w], true,
                    new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(std::cos(angle), std::sin(angle))), scale * r)});
  }
  shell.face(new Geom_Plane(gp_Ax3(gp_Pnt(0, 0, scale * height), gp::DZ(), gp::DX())), loop, outward, patch, kind,
             name);
}

CwSolid *Rotor::build() {
  for (CwBladeShape &shape : shapes) cw_blade_patches(design, &meridian, unit, &shape);
  const int kinds = (int)shapes.size(), n = design->blade_count * kinds;
  curve[CW_HUB] = &meridian.hub;
  curve[CW_SHROUD] = &meridian.shroud;
  bands = (int)shapes[0].pressure.band.size();
  has_shaft = meridian.shaft_radius > 0;
  has_nut = meridian.nut_end_z < meridian.hub.pole[0][1];
  blade.resize(n);
  for (int i = 0; i < n; i++) {
    Blade &b = blade[i];
    b.turns = i / kinds;
    b.shape = &shapes[i % kinds];
    for (int level = 0; level <= bands; level++) level_edges(b, level);
    for (int band = 0; band < bands; band++) band_edges(b, band);
    wall_edges(b);
  }
  for (int i = 0; i < n; i++) arcs(i);
  for (int i = 0; i < n; i++) {
    wall_face(i, CW_HUB);
    wall_face(i, CW_SHROUD);
    pipe_faces(i);
    blade_faces(i);
  }
  if (!has_shaft) {
    disk(meridian.nut_end_z, meridian.nut_disk_radius, CW_HUB, true, "hub_nut", "wall", "hub_nut_end");
    disk(meridian.inlet_z, design->inlet_diameter / 2, CW_SHROUD, false, "inlet", "inlet", "inlet");
  }
  return shell.finish("rotor", unit);
}

// Name of the first face that OpenCASCADE finds fault with; "" if all is well.
std::string faulty_face(const CwSolid *solid) {
  BRepCheck_Analyzer check(solid->solid);
  if (check.IsValid()) return "";
  for (const CwSolidFace &face : solid->faces)
    if (!check.IsValid(face.face)) return face.name;
  return solid->faces.front().name;
}

} // namespace

CwStatus cw_rotor_build(const CwDesign *design, CwSolid **rotor) {
  CwStatus status = CW_OK;
  *rotor = nullptr;
  try {
    Rotor builder(design, cw_model_unit(design->outlet_diameter));
    CW_TRY(builder.sections());
    *rotor = builder.build();
    const std::string faulty = faulty_face(*rotor);
    if (!faulty.empty()) {
      cw_solid_free(rotor);
      status =
          CW_FAIL(CW_ERR_GEOMETRY,
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
