// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/rotor_edges.hpp"

#include <Geom_BezierCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <gp.hxx>
#include <gp_Vec.hxx>

#include "geometry/bspline_fit.hpp"

RotorEdges::RotorEdges(const CwDesign *from, const CwMeridian &section, const std::vector<CwBladeShape> &kinds,
                       double before)
    : design(from), meridian(section), shapes(kinds), curve{&section.hub, &section.shroud},
      pitch(2 * M_PI / from->blade_count), margin(before), bands((int)kinds[0].pressure.band.size()),
      has_nut(section.nut_end_z < section.hub.pole[0][1]), has_shaft(section.shaft_radius > 0),
      blade(from->blade_count * kinds.size()) {
  for (size_t i = 0; i < blade.size(); i++) {
    RotorBlade &b = blade[i];
    b.turns = (int)(i / shapes.size());
    b.shape = &shapes[i % shapes.size()];
    for (int level = 0; level <= bands && !b.shape->seam; level++) level_edges(b, level);
    for (int band = 0; band < bands && !b.shape->seam; band++) band_edges(b, band);
    wall_edges(b);
  }
  for (size_t i = 0; i < blade.size(); i++) arcs((int)i);
}

// Axes whose x axis is the zero of the parameter planes of the passage behind blade i.
gp_Ax3 RotorEdges::blade_axes(int i, double z) const {
  const double angle = zero_of(i);
  return gp_Ax3(gp_Pnt(0, 0, z), gp::DZ(), gp_Dir(std::cos(angle), std::sin(angle), 0));
}

Handle(Geom_Curve) RotorEdges::meridian_curve(const CwMeridianCurve &curve, double theta) const {
  TColgp_Array1OfPnt poles(1, 4);
  for (int i = 0; i < 4; i++) poles.SetValue(i + 1, at(curve.pole[i][0], theta, curve.pole[i][1]));
  return new Geom_BezierCurve(poles);
}

// Quarter ellipse from the flat disk to the hub, exact as a rational Bezier.
Handle(Geom_Curve) RotorEdges::nut_curve(double theta) const {
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

static Handle(Geom_Curve) turned(const Handle(Geom_Curve) & curve, double angle) {
  Handle(Geom_Curve) copy = Handle(Geom_Curve)::DownCast(curve->Copy());
  copy->Rotate(gp::OZ(), angle);
  return copy;
}

int RotorEdges::slanted_line(const double from[3], const double to[3], int begin, int end) {
  const gp_Pnt first = at(from[0], from[1], from[2]), last = at(to[0], to[1], to[2]);
  if (from[1] == to[1])
    return shell.edge(new Geom_Line(first, gp_Dir(gp_Vec(first, last))), 0, first.Distance(last), begin, end);
  std::vector<double> u;
  std::vector<gp_Pnt> x;
  for (int i = 0; i < SLANTED_POINTS; i++) {
    const double f = (double)i / (SLANTED_POINTS - 1);
    u.push_back(f);
    x.push_back(at(from[0] + f * (to[0] - from[0]), from[1] + f * (to[1] - from[1]), from[2] + f * (to[2] - from[2])));
  }
  return shell.edge(cw_bspline_curve_3d(u, x), 0, 1, begin, end);
}

// The curve along a patch at a level, of blade 0.
static Handle(Geom_Curve) along(const CwBladePatch &patch, int level) {
  const int bands = (int)patch.band.size();
  return level < bands ? patch.band[level]->VIso(0) : patch.band[bands - 1]->VIso(1);
}

// Vertices and edges along the blade at a level.
void RotorEdges::level_edges(RotorBlade &b, int level) {
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
void RotorEdges::band_edges(RotorBlade &b, int band) {
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
void RotorEdges::wall_edges(RotorBlade &b) {
  const CwBladeShape &s = *b.shape;
  const double turn = b.turns * pitch, r_pipe = design->inlet_diameter / 2;
  for (int w : {CW_HUB, CW_SHROUD}) {
    const Handle(Geom_Curve) down = meridian_curve(*curve[w], turn + s.theta_corner[w]);
    if (s.seam) {
      const Handle(Geom_Curve) whole = turned(s.guide[w], turn);
      b.up[w] = shell.vertex(whole->Value(0));
      b.out[w] = shell.vertex(whole->Value(1));
      b.e_up[w] = shell.edge(whole, 0, 1, b.up[w], b.out[w]);
      continue;
    }
    b.up[w] = shell.vertex(at(curve[w]->pole[0][0], turn + s.theta_up[w], curve[w]->pole[0][1]));
    b.out[w] = shell.vertex(down->Value(1));
    b.e_up[w] = shell.edge(turned(s.guide[w], turn), 0, 1, b.up[w], b.tip[w]);
    b.e_down[w] = shell.edge(down, s.t_corner[w], 1, b.corner[w == CW_HUB ? 0 : bands], b.out[w]);
  }
  const double at_hub = turn + s.theta_up[CW_HUB], at_shroud = turn + s.theta_up[CW_SHROUD];
  b.inlet = shell.vertex(at(r_pipe, at_shroud, meridian.inlet_z));
  b.e_end[CW_SHROUD] = shell.edge(new Geom_Line(at(r_pipe, at_shroud, 0), gp::DZ()), meridian.inlet_z,
                                  curve[CW_SHROUD]->pole[0][1], b.inlet, b.up[CW_SHROUD]);
  b.disk = b.up[CW_HUB];
  if (has_nut) {
    b.disk = shell.vertex(at(meridian.nut_disk_radius, at_hub, meridian.nut_end_z));
    b.e_end[CW_HUB] = shell.edge(nut_curve(at_hub), 0, 1, b.disk, b.up[CW_HUB]);
  }
  if (has_shaft) {
    const double r = meridian.shaft_radius, from[3] = {r, at_hub, meridian.inlet_z},
                 to[3] = {r_pipe, at_shroud, meridian.inlet_z};
    b.shaft = shell.vertex(at(r, at_hub, meridian.inlet_z));
    b.e_shaft =
        shell.edge(new Geom_Line(at(r, at_hub, 0), gp::DZ()), meridian.inlet_z, meridian.nut_end_z, b.shaft, b.disk);
    b.e_inlet = slanted_line(from, to, b.shaft, b.inlet);
  }
  const double ri = design->interface_radius, half = design->outlet_width / 2;
  const double low[3] = {ri, turn + s.theta_corner[CW_SHROUD], -half},
               high[3] = {ri, turn + s.theta_corner[CW_HUB], half};
  b.x_out = slanted_line(low, high, b.out[CW_SHROUD], b.out[CW_HUB]);
}

// Arcs to the next blade. They have the angle in the frame of their passage as parameter.
void RotorEdges::arcs(int i) {
  RotorBlade &b = blade[i];
  const RotorBlade &next = blade[(i + 1) % blade.size()];
  const CwBladeShape &s = *b.shape, &f = *next.shape;
  const auto arc_to_next = [&](double r, double height, double from, double to, int begin, int end) {
    return shell.edge(new Geom_Circle(blade_axes(i, height).Ax2(), r), from + near_of(i), to + far_of(i), begin, end);
  };
  for (int w : {CW_HUB, CW_SHROUD}) {
    b.a_out[w] = arc_to_next(design->interface_radius, curve[w]->pole[3][1], s.theta_corner[w], f.theta_corner[w],
                             b.out[w], next.out[w]);
    b.a_up[w] =
        arc_to_next(curve[w]->pole[0][0], curve[w]->pole[0][1], s.theta_up[w], f.theta_up[w], b.up[w], next.up[w]);
  }
  b.a_end[CW_SHROUD] = arc_to_next(design->inlet_diameter / 2, meridian.inlet_z, s.theta_up[CW_SHROUD],
                                   f.theta_up[CW_SHROUD], b.inlet, next.inlet);
  b.a_end[CW_HUB] = has_nut ? arc_to_next(meridian.nut_disk_radius, meridian.nut_end_z, s.theta_up[CW_HUB],
                                          f.theta_up[CW_HUB], b.disk, next.disk)
                            : b.a_up[CW_HUB];
  if (has_shaft)
    b.a_shaft = arc_to_next(meridian.shaft_radius, meridian.inlet_z, s.theta_up[CW_HUB], f.theta_up[CW_HUB], b.shaft,
                            next.shaft);
}
