// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/rotor_faces.hpp"

#include <string>

#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <gp.hxx>

#include "geometry/bspline_fit.hpp"

namespace {

Handle(Geom2d_Curve) line_in_plane(double u, double v, double du, double dv) {
  return new Geom2d_Line(gp_Pnt2d(u, v), gp_Dir2d(du, dv));
}

// Line u = t or v = t of a B-spline surface whose edge has the same parameter.
Handle(Geom2d_Curve) along_u(double v) {
  return line_in_plane(0, v, 1, 0);
}
Handle(Geom2d_Curve) along_v(double u) {
  return line_in_plane(u, 0, 0, 1);
}

Handle(Geom2d_Curve) moved(const Handle(Geom2d_BSplineCurve) & curve, double du) {
  Handle(Geom2d_Curve) copy = Handle(Geom2d_Curve)::DownCast(curve->Copy());
  copy->Translate(gp_Vec2d(du, 0));
  return copy;
}

// A line between (r, theta) in the parameters of a plane, in which both are linear.
Handle(Geom2d_Curve) slanted_line_in_plane(double r, double theta, double to_r, double to_theta) {
  const auto in_plane = [&](double f) {
    const double at_r = r + f * (to_r - r), angle = theta + f * (to_theta - theta);
    return gp_Pnt2d(at_r * std::cos(angle), at_r * std::sin(angle));
  };
  if (theta == to_theta) return new Geom2d_Line(in_plane(0), gp_Dir2d(gp_Vec2d(in_plane(0), in_plane(1))));
  return cw_bspline_curve_2d(SLANTED_POINTS, 0, 1, in_plane);
}

Handle(Geom_Surface) revolved(const Handle(Geom_Curve) & basis) {
  return new Geom_SurfaceOfRevolution(basis, gp::OZ());
}

} // namespace

// Axes and parameter plane are those of the passage behind blade i.
Handle(Geom_Surface) RotorFaces::cylinder(int i, double r) const {
  return new Geom_CylindricalSurface(blade_axes(i), r);
}

// Hub or shroud between a blade and the next.
void RotorFaces::wall_face(int i, int w) {
  const RotorBlade &b = blade[i], &next = blade[(i + 1) % blade.size()];
  const CwBladeShape &s = *b.shape, &f = *next.shape;
  const double near = near_of(i), far = far_of(i);
  const int level = w == CW_HUB ? 0 : bands;
  const char *patch = w == CW_HUB ? "hub" : "shroud";
  std::vector<CwEdgeUse> loop = {{b.e_up[w], true, moved(s.guide_on_wall[w], near)}};
  if (!s.seam) {
    loop.push_back({b.e_nose_p[level], true, moved(s.leading.on_wall[w], near)});
    loop.push_back({b.e_p[level], true, moved(s.pressure.on_wall[w], near)});
    loop.push_back({b.e_down[w], true, along_v(s.theta_corner[w] + near)});
  }
  loop.push_back({b.a_out[w], true, along_u(1)});
  if (!f.seam) {
    loop.push_back({next.e_down[w], false, along_v(f.theta_corner[w] + far)});
    if (f.has_trailing) loop.push_back({next.e_te[level], false, moved(f.trailing.on_wall[w], far)});
    if (f.has_bevel) loop.push_back({next.e_bevel[level], false, moved(f.bevel.on_wall[w], far)});
    loop.push_back({next.e_s[level], false, moved(f.suction.on_wall[w], far)});
    loop.push_back({next.e_nose_s[level], true, moved(f.leading.on_wall[w], far)});
  }
  loop.push_back({next.e_up[w], false, moved(f.guide_on_wall[w], far)});
  loop.push_back({b.a_up[w], false, along_u(0)});
  shell.face(revolved(meridian_curve(*curve[w], zero_of(i))), loop, w == CW_SHROUD, patch, CW_PATCH_WALL,
             patch + ("_" + std::to_string(i + 1)));
}

// Nut, shaft and suction pipe between a blade and the next: faces of revolution between the lines of both and the arcs
// below and above.
void RotorFaces::tube_faces(int i) {
  const RotorBlade &b = blade[i], &next = blade[(i + 1) % blade.size()];
  const CwBladeShape &s = *b.shape, &f = *next.shape;
  const double near = near_of(i), far = far_of(i), z_inlet = meridian.inlet_z;
  const auto tube = [&](const Handle(Geom_Surface) & surface, int w, int line, int next_line, int low, double v_low,
                        int high, double v_high, bool outward, const char *patch) {
    shell.face(surface,
               {{line, true, along_v(s.theta_up[w] + near)},
                {high, true, along_u(v_high)},
                {next_line, false, along_v(f.theta_up[w] + far)},
                {low, false, along_u(v_low)}},
               outward, patch, CW_PATCH_WALL, patch + ("_" + std::to_string(i + 1)));
  };
  if (has_nut)
    tube(revolved(nut_curve(zero_of(i))), CW_HUB, b.e_end[CW_HUB], next.e_end[CW_HUB], b.a_end[CW_HUB], 0,
         b.a_up[CW_HUB], 1, false, "hub_nut");
  tube(cylinder(i, design->inlet_diameter / 2), CW_SHROUD, b.e_end[CW_SHROUD], next.e_end[CW_SHROUD],
       b.a_end[CW_SHROUD], z_inlet, b.a_up[CW_SHROUD], curve[CW_SHROUD]->pole[0][1], true, "suction_pipe");
  if (has_shaft)
    tube(cylinder(i, meridian.shaft_radius), CW_HUB, b.e_shaft, next.e_shaft, b.a_shaft, z_inlet, b.a_end[CW_HUB],
         meridian.nut_end_z, false, "hub_shaft");
}

// The inlet round a shaft between a blade and the next. The plane's axes are those of the passage.
void RotorFaces::inlet_ring_face(int i) {
  const RotorBlade &b = blade[i], &next = blade[(i + 1) % blade.size()];
  const auto spoke = [&](const CwBladeShape &shape, double offset) -> Handle(Geom2d_Curve) {
    return slanted_line_in_plane(meridian.shaft_radius, shape.theta_up[CW_HUB] + offset, design->inlet_diameter / 2,
                                 shape.theta_up[CW_SHROUD] + offset);
  };
  const auto circle = [&](double r) -> Handle(Geom2d_Curve) {
    return new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(1, 0)), r);
  };
  shell.face(new Geom_Plane(blade_axes(i, meridian.inlet_z)),
             {{b.e_inlet, true, spoke(*b.shape, near_of(i))},
              {b.a_end[CW_SHROUD], true, circle(design->inlet_diameter / 2)},
              {next.e_inlet, false, spoke(*next.shape, far_of(i))},
              {b.a_shaft, false, circle(meridian.shaft_radius)}},
             false, "inlet", CW_PATCH_INLET, "inlet_" + std::to_string(i + 1));
}

void RotorFaces::interface_face(int i) {
  const RotorBlade &b = blade[i], &next = blade[(i + 1) % blade.size()];
  const double half = design->outlet_width / 2;
  // An axial line has its length as its parameter, a helix 0 to 1.
  const auto across = [&](const CwBladeShape &shape, double offset) -> Handle(Geom2d_Curve) {
    if (shape.theta_corner[CW_HUB] == shape.theta_corner[CW_SHROUD])
      return line_in_plane(shape.theta_corner[CW_HUB] + offset, -half, 0, 1);
    TColgp_Array1OfPnt2d poles(1, 2);
    poles.SetValue(1, gp_Pnt2d(shape.theta_corner[CW_SHROUD] + offset, -half));
    poles.SetValue(2, gp_Pnt2d(shape.theta_corner[CW_HUB] + offset, half));
    return new Geom2d_BezierCurve(poles);
  };
  shell.face(cylinder(i, design->interface_radius),
             {{b.x_out, true, across(*b.shape, near_of(i))},
              {b.a_out[CW_HUB], true, along_u(half)},
              {next.x_out, false, across(*next.shape, far_of(i))},
              {b.a_out[CW_SHROUD], false, along_u(-half)}},
             true, "rotor_interface", CW_PATCH_INTERFACE, "rotor_interface_" + std::to_string(i + 1));
}

// All patches of a blade, band by band.
void RotorFaces::blade_faces(int i) {
  const RotorBlade &b = blade[i];
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
      shell.face(surface, loop, outward, patch_name, CW_PATCH_WALL, s.name + part + (fillet ? root : more) + number);
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
void RotorFaces::disk_face(double height, double r, int w, bool outward, const char *patch, CwPatchKind kind,
                           const char *name) {
  std::vector<CwEdgeUse> loop;
  for (size_t i = 0; i < blade.size(); i++) {
    const double angle = zero_of((int)i);
    loop.push_back({blade[i].a_end[w], true,
                    new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(std::cos(angle), std::sin(angle))), r)});
  }
  shell.face(new Geom_Plane(gp_Ax3(gp_Pnt(0, 0, height), gp::DZ(), gp::DX())), loop, outward, patch, kind, name);
}

CwSolid *RotorFaces::make() {
  for (int i = 0; i < (int)blade.size(); i++) {
    wall_face(i, CW_HUB);
    wall_face(i, CW_SHROUD);
    tube_faces(i);
    if (has_shaft) inlet_ring_face(i);
    interface_face(i);
    if (!blade[i].shape->seam) blade_faces(i);
  }
  if (!has_shaft) {
    disk_face(meridian.nut_end_z, meridian.nut_disk_radius, CW_HUB, true, "hub_nut", CW_PATCH_WALL, "hub_nut_end");
    disk_face(meridian.inlet_z, design->inlet_diameter / 2, CW_SHROUD, false, "inlet", CW_PATCH_INLET, "inlet");
  }
  return shell.finish("rotor", design->unit);
}
