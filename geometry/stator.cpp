// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/stator.h"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <GeomAPI.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <gp_Ax2.hxx>
#include <gp_Ax3.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>

#include "geometry/bspline_fit.hpp"
#include "geometry/design_unit.h"
#include "geometry/stator_builder.hpp"
#include "geometry/stator_check.hpp"
#include "geometry/volute_diffuser.h"
#include "geometry/volute_section.h"
#include "geometry/volute_tongue.h"

namespace {

const int SECTORS = 5;                      // round the axis; the last one holds the tongue and opens into the throat
const double SECTOR = CW_VOLUTE_SECTOR;     // angle of all but the last
const int ALONG = 33, SIDE = 25;            // points of interpolation: along the flow, other
const int ACROSS = 49, ACROSS_CORNERS = 97; // over the outer wall, whose curvature jumps where it has corners
// Of curves in the parameter plane where the kink line bends more: each of its points is one of theirs.
const int PLANE_CURVE_BENT = 97;
const double TONGUE_SIDE = 1.01;  // least radius of the tongue's end at the side wall, in D3/2
const double LEAST_WALL = 0.0025; // between diffuser and spiral, of D3
enum { BOTTOM, TOP };

using PointOfOne = std::function<gp_Pnt(double)>;

// The stator in the making. In the arrays, the last index says below or above z = 0; sectors count from the
// start of the kink line at the tongue. Names of the points as in volute.h. The fields are vertices and edges that
// faces made in different steps have in common.
class StatorMaker {
public:
  StatorMaker(const CwVolute &volute, double unit)
      : v_(volute), unit_(unit), across_(std::isnan(volute.input.corner_radius) ? ACROSS : ACROSS_CORNERS),
        b_(volute.end_half_angle > volute.arc_half_angle ? PLANE_CURVE_BENT : PLANE_CURVE, unit) {}

  CwSolid *make() {
    for (int j = 0; j <= SECTORS; j++) angle_[j] = v_.start_angle + SECTOR * j;
    angle_[SECTORS] = v_.start_angle + 2 * M_PI;
    make_inner_rings();
    make_outer_wall();
    make_nose();
    make_flank();
    make_side_walls();
    make_diffuser();
    make_pipe();
    gp_Trsf turn; // the discharge pipe into +y
    turn.SetRotation(gp::OZ(), -v_.discharge_lean);
    return b_.build("stator", turn, false); // the interface's cylinders have their axis outside the fluid
  }

private:
  static double sign(int side) {
    return side == TOP ? 1 : -1;
  }
  double r3() const {
    return 0.5 * v_.input.base_diameter;
  }
  double half_width(double r) const {
    return cw_volute_half_width(&v_, r);
  }
  double psi(double t) const {
    return v_.arc_half_angle * (2 * t - 1);
  }

  gp_Pnt wall(double phi, double psi) const {
    double x[3];
    cw_volute_wall_point(&v_, phi, psi, x, nullptr, nullptr);
    return gp_Pnt(x[0], x[1], x[2]);
  }

  static gp_Pnt polar(double r, double angle, double z) {
    return gp_Pnt(r * std::cos(angle), r * std::sin(angle), z);
  }

  // Frame about the axis in which the angles from `from` to `to` (rad) have positive u; z counts outward from
  // `height`.
  static gp_Ax3 frame(double from, double to, double height, int side) {
    double x = side == TOP ? from - U_MARGIN : to + U_MARGIN;
    return gp_Ax3(gp_Pnt(0, 0, sign(side) * height), gp_Dir(0, 0, sign(side)), gp_Dir(std::cos(x), std::sin(x), 0));
  }

  // Ring of vertices and arcs at one radius and level, one arc a sector.
  struct Ring {
    std::array<int, SECTORS> vertex, arc;
  };
  Ring ring(double r, double z) {
    Ring ring;
    for (int j = 0; j < SECTORS; j++) ring.vertex[j] = b_.vertex(polar(r, angle_[j], z));
    for (int j = 0; j < SECTORS; j++)
      ring.arc[j] = b_.arc(ring.vertex[j], ring.vertex[(j + 1) % SECTORS], angle_[j + 1] - angle_[j]);
    return ring;
  }
  std::array<int, SECTORS> joints(const Ring &a, const Ring &b) {
    std::array<int, SECTORS> lines;
    for (int j = 0; j < SECTORS; j++) lines[j] = b_.line(a.vertex[j], b.vertex[j]);
    return lines;
  }
  static std::vector<LoopEdge> between(const Ring &a, const Ring &b, const std::array<int, SECTORS> &joint, int j) {
    return {a.arc[j], joint[(j + 1) % SECTORS], b.arc[j], joint[j]};
  }

  // Interface cylinder, neck, and the step from b2 to b3 at D3/2.
  void make_inner_rings() {
    double r = v_.input.interface_radius, b2 = 0.5 * v_.input.neck_width, b3 = 0.5 * v_.input.inlet_width;
    Ring interface[2], neck[2];
    std::array<int, SECTORS> neck_joint[2], step_joint[2];
    for (int side : {BOTTOM, TOP}) {
      interface[side] = ring(r, sign(side) * b2);
      neck[side] = ring(r3(), sign(side) * b2);
      step_[side] = ring(r3(), sign(side) * b3);
      neck_joint[side] = joints(interface[side], neck[side]);
      step_joint[side] = joints(neck[side], step_[side]);
    }
    std::array<int, SECTORS> interface_joint = joints(interface[BOTTOM], interface[TOP]);
    for (int j = 0; j < SECTORS; j++) {
      gp_Ax3 upright = frame(angle_[j], angle_[j + 1], 0, TOP);
      b_.face(new Geom_CylindricalSurface(upright, r), between(interface[BOTTOM], interface[TOP], interface_joint, j),
              "stator_interface", CW_PATCH_INTERFACE);
      for (int side : {BOTTOM, TOP}) {
        b_.face(new Geom_Plane(frame(angle_[j], angle_[j + 1], b2, side)),
                between(interface[side], neck[side], neck_joint[side], j), "neck");
        b_.face(new Geom_CylindricalSurface(upright, r3()), between(neck[side], step_[side], step_joint[side], j),
                "step");
      }
    }
  }

  // u along the flow, v over the arc from below upward. The first sector begins where the nose touches the
  // wall, the last one ends at the throat.
  void make_outer_wall() {
    std::array<Handle(Geom_BSplineSurface), SECTORS> surface;
    for (int j = 0; j < SECTORS; j++)
      surface[j] = cw_bspline_surface(ALONG, across_, [&](double u, double v) {
        double from = j == 0 ? cw_volute_contact_angle(&v_, psi(v)) : angle_[j];
        double to = j == SECTORS - 1 ? cw_volute_throat_angle(&v_, psi(v)) : angle_[j + 1];
        return wall(from + u * (to - from), psi(v));
      });
    for (int j = 0; j <= SECTORS; j++) {
      Handle(Geom_BSplineSurface) at = surface[j < SECTORS ? j : SECTORS - 1];
      double u = j < SECTORS ? 0 : 1;
      for (int side : {BOTTOM, TOP}) kink_vertex_[j][side] = b_.vertex(at->Value(u, side));
      section_[j] = b_.edge(at->UIso(u), 0, 1, kink_vertex_[j][BOTTOM], kink_vertex_[j][TOP]);
    }
    for (int j = 0; j < SECTORS; j++) {
      for (int side : {BOTTOM, TOP})
        kink_[j][side] = b_.edge(surface[j]->VIso(side), 0, 1, kink_vertex_[j][side], kink_vertex_[j + 1][side]);
      b_.face(surface[j],
              {LoopEdge(section_[j], 0, 0, 0, 1), LoopEdge(kink_[j][TOP], 0, 1, 1, 1),
               LoopEdge(section_[j + 1], 1, 0, 1, 1), LoopEdge(kink_[j][BOTTOM], 0, 0, 1, 0)},
              "volute");
    }
  }

  // u round the nose from the outer wall to the flank, v from below upward; v = 0 and 1 lie on the side
  // walls.
  void make_nose() {
    double radius = v_.input.tongue_radius, k = v_.arc_half_angle, centre[2], normal[2];
    auto direction = [&](double psi) { // of the contact with the outer wall, from the nose's centre
      cw_volute_contact_circle(&v_, cw_volute_contact_angle(&v_, psi), psi, centre, normal);
      return std::atan2(-normal[1], -normal[0]);
    };
    double side_direction = direction(k);
    Handle(Geom_BSplineSurface) surface = cw_bspline_surface(SIDE, across_, [&](double u, double v) {
      double height = cw_volute_nose_height(&v_, side_direction * (1 - u));
      if (std::isnan(height))
        cw_solid_refuse(
            "the nose of the tongue, of radius %.3g mm, does not reach the side walls, which open by %.1f deg: "
            "lower tongue_radius_mm or side_wall_angle_deg",
            1e3 * radius, 180 / M_PI * v_.input.side_wall_angle);
      double contact[3];
      cw_volute_wall_point(&v_, cw_volute_contact_angle(&v_, psi(v)), psi(v), contact, nullptr, nullptr);
      // u = 0 lies on the outer wall's border exactly.
      double z = contact[2] * (1 + (u > 0 ? height / v_.side_level - 1 : 0));
      double beta = direction(psi(v)) * (1 - u);
      return gp_Pnt(v_.inner_wall_x - radius + radius * std::cos(beta),
                    cw_volute_nose_y(&v_, z) + radius * std::sin(beta), z);
    });
    for (int side : {BOTTOM, TOP}) {
      flank_vertex_[side] = b_.vertex(surface->Value(1, side));
      gp_Pnt p = b_.point(flank_vertex_[side]);
      const double at = std::hypot(p.X(), p.Y()), least = TONGUE_SIDE * r3(), mm = 1e3 * unit_;
      if (at < least)
        cw_solid_refuse("the tongue's side comes to %.2f mm from the axis; allowed: at least %.2f mm, 1.01 D3/2: raise "
                        "tongue_gap_mm by %.2f or more",
                        mm * at, mm * least, mm * (least - at));
      nose_side_[side] = b_.edge(surface->VIso(side), 0, 1, kink_vertex_[0][side], flank_vertex_[side]);
    }
    nose_flank_ = b_.edge(surface->UIso(1), 0, 1, flank_vertex_[BOTTOM], flank_vertex_[TOP]);
    b_.face(surface,
            {LoopEdge(section_[0], 0, 0, 0, 1), LoopEdge(nose_side_[TOP], 0, 1, 1, 1),
             LoopEdge(nose_flank_, 1, 0, 1, 1), LoopEdge(nose_side_[BOTTOM], 0, 0, 1, 0)},
            "tongue");
  }

  // The plane x = x_i from the nose to the throat.
  void make_flank() {
    double x = v_.inner_wall_x, y = v_.throat_y;
    gp_Pln plane(gp_Ax3(gp_Pnt(x, 0, 0), gp::DX(), gp::DY())); // its parameters are y and z
    for (int side : {BOTTOM, TOP}) {
      double from = b_.point(flank_vertex_[side]).Y();
      throat_vertex_[side] = b_.vertex(gp_Pnt(x, y, sign(side) * half_width(std::hypot(x, y))));
      Handle(Geom2d_BSplineCurve) curve = cw_bspline_curve_2d(SIDE, 0, 1, [&](double t) {
        double at = from + t * (y - from);
        return gp_Pnt2d(at, sign(side) * half_width(std::hypot(x, at)));
      });
      flank_side_[side] = b_.edge(GeomAPI::To3d(curve, plane), 0, 1, flank_vertex_[side], throat_vertex_[side]);
    }
    throat_inner_ = b_.line(throat_vertex_[BOTTOM], throat_vertex_[TOP]);
    b_.face(new Geom_Plane(plane), {nose_flank_, flank_side_[TOP], throat_inner_, flank_side_[BOTTOM]}, "tongue");
  }

  gp_Pnt throat_side(double t, int side) const {
    double a = b_.point(throat_vertex_[side]).X(), b = b_.point(kink_vertex_[SECTORS][side]).X();
    double x = a + t * (b - a), y = v_.throat_y;
    return gp_Pnt(x, y, sign(side) * half_width(std::hypot(x, y)));
  }

  void make_side_walls() {
    double cone_angle = 0.5 * M_PI - v_.input.side_wall_angle, b3 = 0.5 * v_.input.inlet_width;
    for (int side : {BOTTOM, TOP}) {
      std::array<int, SECTORS> ray;
      for (int j = 0; j < SECTORS; j++) ray[j] = b_.line(step_[side].vertex[j], kink_vertex_[j][side]);
      gp_Pln throat(gp_Ax3(gp_Pnt(0, v_.throat_y, 0), -gp::DY(), gp::DX())); // its parameters are x and z
      Handle(Geom2d_BSplineCurve) curve = cw_bspline_curve_2d(
          SIDE, 0, 1, [&](double t) { return gp_Pnt2d(throat_side(t, side).X(), throat_side(t, side).Z()); });
      throat_side_[side] =
          b_.edge(GeomAPI::To3d(curve, throat), 0, 1, throat_vertex_[side], kink_vertex_[SECTORS][side]);
      for (int j = 0; j < SECTORS; j++) {
        std::vector<LoopEdge> loop = {step_[side].arc[j], ray[j], kink_[j][side]};
        if (j < SECTORS - 1)
          loop.push_back(ray[j + 1]);
        else
          for (int edge : {throat_side_[side], flank_side_[side], nose_side_[side], ray[0]}) loop.push_back(edge);
        double to = angle_[j + 1];
        if (j == SECTORS - 1) to = std::max(to, 2 * M_PI + std::atan2(v_.throat_y, v_.inner_wall_x));
        gp_Ax3 at = frame(angle_[j], to, b3, side);
        Handle(Geom_Surface) wall = v_.input.side_wall_angle > 0
                                        ? Handle(Geom_Surface)(new Geom_ConicalSurface(at, cone_angle, r3()))
                                        : Handle(Geom_Surface)(new Geom_Plane(at));
        b_.face(wall, loop, "volute");
      }
    }
  }

  static void coordinates(const gp_Pnt &p, double x[3]) {
    for (int i = 0; i < 3; i++) x[i] = p.Coord(i + 1);
  }

  // Places along the diffuser at which its surfaces are interpolated: four points of a cubic give the cubic back.
  static std::vector<double> along_diffuser(double turning) {
    const int turned = 12, rest = 12;
    if (turning == 1) return {0, 1.0 / 3, 2.0 / 3, 1};
    turning = std::min(turning, 0.5);
    std::vector<double> v;
    for (int i = 0; i < turned; i++) v.push_back(turning * i / turned);
    for (int i = 0; i <= rest; i++) v.push_back(turning + (1 - turning) * i / rest);
    return v;
  }

  // Four patches, inner, top, outer and bottom, from the throat's contour to the outlet's circle. They leave
  // in the tangent planes of the walls before the throat and arrive along the pipe.
  void make_diffuser() {
    double length = CW_DIFFUSER_TANGENT * v_.diffuser_length, slope = std::tan(v_.input.side_wall_angle);
    std::array<gp_Pnt, 2> inner = {b_.point(throat_vertex_[BOTTOM]), b_.point(throat_vertex_[TOP])};
    auto outer_start = [&](double t) { return wall(cw_volute_throat_angle(&v_, psi(t)), psi(t)); };
    auto outer_direction = [&](double t) {
      double x[3], along[3];
      cw_volute_wall_point(&v_, cw_volute_throat_angle(&v_, psi(t)), psi(t), x, along, nullptr);
      return gp_Pnt(length * along[0] / along[1], length, length * along[2] / along[1]);
    };
    double lean = outer_direction(1).X() / length; // dx/dy of the wall at the kink
    auto side_direction = [&](double t, int side) {
      gp_Pnt p = throat_side(t, side);
      double dz = slope * (p.X() * lean * t + p.Y()) / std::hypot(p.X(), p.Y());
      return gp_Pnt(length * lean * t, length, sign(side) * length * dz);
    };
    auto inner_start = [&](double t) { return gp_Pnt(inner[0].XYZ() * (1 - t) + inner[1].XYZ() * t); };
    auto inner_direction = [&](double t) { return gp_Pnt(0, length, (2 * t - 1) * side_direction(0, TOP).Z()); };

    // The contour's corners go to the circle by their share of its length.
    auto contour_length = [](const PointOfOne &f) {
      double sum = 0;
      for (int i = 0; i < 64; i++) sum += f(i / 64.0).Distance(f((i + 1) / 64.0));
      return sum;
    };
    double inner_length = contour_length(inner_start), outer_length = contour_length(outer_start);
    double side_length = contour_length([&](double t) { return throat_side(t, TOP); });
    double whole = inner_length + outer_length + 2 * side_length;
    double a = M_PI * outer_length / whole, b = M_PI * (1 - inner_length / whole);
    // Corners counter-clockwise about minus the flow from the outer wall's lower one; the fourth arc ends
    // where the first begins.
    corner_ = {-a, a, b, 2 * M_PI - b, 2 * M_PI - a};

    double radius = 0.5 * v_.input.outlet_diameter;
    circle_end_ = make_circle(outlet_centre(0));
    auto on_circle = [&](double angle) {
      return gp_Pnt(outlet_centre(0).XYZ() + radius * in_outlet_plane(angle).XYZ());
    };
    const CwDiffuserLines lines = cw_diffuser_lines(&v_);
    const std::vector<double> along = along_diffuser(lines.turning);
    auto leaf = [&](int count, const PointOfOne &start, const PointOfOne &direction, const PointOfOne &finish) {
      return cw_bspline_surface(count, along, [&](double u, double v) {
        double from[3], leaving[3], to[3], x[3];
        coordinates(start(u), from);
        coordinates(direction(u), leaving);
        coordinates(finish(u), to);
        cw_diffuser_line(&lines, from, leaving, to, v, x);
        return gp_Pnt(x[0], x[1], x[2]);
      });
    };
    auto turn = [&](double from, double to) { return [=](double t) { return on_circle(from + t * (to - from)); }; };
    Handle(Geom_BSplineSurface) outer = leaf(across_, outer_start, outer_direction, turn(corner_[0], corner_[1]));
    Handle(Geom_BSplineSurface) inner_surface = leaf(SIDE, inner_start, inner_direction, turn(corner_[3], corner_[2]));
    std::array<Handle(Geom_BSplineSurface), 2> sides;
    for (int side : {BOTTOM, TOP})
      sides[side] = leaf(
          SIDE, [&](double t) { return throat_side(t, side); }, [&](double t) { return side_direction(t, side); },
          side == TOP ? turn(corner_[2], corner_[1]) : turn(corner_[3], corner_[4]));

    for (const Handle(Geom_BSplineSurface) & surface : {inner_surface, sides[BOTTOM], sides[TOP]})
      keep_off_spiral(surface);
    add_diffuser_faces(outer, inner_surface, sides);
  }

  void add_diffuser_faces(const Handle(Geom_BSplineSurface) & outer, const Handle(Geom_BSplineSurface) & inner_surface,
                          const std::array<Handle(Geom_BSplineSurface), 2> &sides) {
    const std::array<int, 4> &end = circle_end_.vertex, &arc = circle_end_.arc;
    int outer_edge[2], inner_edge[2];
    for (int side : {BOTTOM, TOP}) {
      outer_edge[side] = b_.edge(outer->UIso(side), 0, 1, kink_vertex_[SECTORS][side], end[side == TOP ? 1 : 0]);
      inner_edge[side] = b_.edge(inner_surface->UIso(side), 0, 1, throat_vertex_[side], end[side == TOP ? 2 : 3]);
    }
    b_.face(outer,
            {LoopEdge(section_[SECTORS], 0, 0, 1, 0), LoopEdge(outer_edge[TOP], 1, 0, 1, 1),
             LoopEdge(arc[0], 0, 1, 1, 1), LoopEdge(outer_edge[BOTTOM], 0, 0, 0, 1)},
            "diffuser");
    b_.face(inner_surface,
            {LoopEdge(throat_inner_, 0, 0, 1, 0), LoopEdge(inner_edge[TOP], 1, 0, 1, 1), LoopEdge(arc[2], 1, 1, 0, 1),
             LoopEdge(inner_edge[BOTTOM], 0, 0, 0, 1)},
            "diffuser");
    for (int side : {BOTTOM, TOP}) {
      LoopEdge circle = side == TOP ? LoopEdge(arc[1], 1, 1, 0, 1) : LoopEdge(arc[3], 0, 1, 1, 1);
      b_.face(sides[side],
              {LoopEdge(throat_side_[side], 0, 0, 1, 0), LoopEdge(outer_edge[side], 1, 0, 1, 1), circle,
               LoopEdge(inner_edge[side], 0, 0, 0, 1)},
              "diffuser");
    }
  }

  void keep_off_spiral(const Handle(Geom_BSplineSurface) & surface) const {
    const int samples = 24;
    const double least = LEAST_WALL * 2 * r3();
    for (int i = 0; i <= samples; i++)
      for (int j = 1; j <= samples; j++) {
        gp_Pnt p = surface->Value(double(i) / samples, double(j) / samples);
        CwVoluteSection s = cw_volute_section(&v_, std::atan2(p.Y(), p.X()));
        double z = std::min(std::fabs(p.Z()), s.kink_height);
        double wall = cw_volute_wall_radius(&s, z);
        if (std::fabs(p.Z()) > s.kink_height + least || std::hypot(p.X(), p.Y()) > wall + least) continue;
        const double mm = 1e3 * unit_;
        cw_solid_refuse("the diffuser meets the spiral near (%.1f, %.1f, %.1f) mm; allowed: a wall of %.2f mm between "
                        "them: raise diffuser_length_mm or tongue_gap_mm, or lower outlet_diameter_mm (%.1f mm)",
                        mm * p.X(), mm * p.Y(), mm * p.Z(), mm * least, 1e3 * v_.input.outlet_diameter);
      }
  }

  gp_Dir downstream() const {
    return gp_Dir(-std::sin(v_.discharge_lean), std::cos(v_.discharge_lean), 0);
  }
  // Direction from the pipe's axis, by its angle about minus the flow.
  gp_Dir in_outlet_plane(double angle) const {
    double c = std::cos(angle);
    return gp_Dir(c * std::cos(v_.discharge_lean), c * std::sin(v_.discharge_lean), std::sin(angle));
  }
  gp_Pnt outlet_centre(double behind) const {
    return gp_Pnt(v_.outlet_x, v_.outlet_y, 0).Translated(gp_Vec(downstream()) * behind);
  }

  struct Circle {
    std::array<int, 4> vertex, arc;
  };
  Circle make_circle(const gp_Pnt &centre) {
    Circle circle;
    double radius = 0.5 * v_.input.outlet_diameter;
    for (int i = 0; i < 4; i++) circle.vertex[i] = b_.vertex(centre.XYZ() + radius * in_outlet_plane(corner_[i]).XYZ());
    for (int i = 0; i < 4; i++)
      circle.arc[i] = b_.edge(new Geom_Circle(gp_Ax2(centre, -downstream(), in_outlet_plane(corner_[i])), radius), 0,
                              corner_[i + 1] - corner_[i], circle.vertex[i], circle.vertex[(i + 1) % 4]);
    return circle;
  }

  void make_pipe() {
    gp_Pnt centre = outlet_centre(v_.input.discharge_pipe_length);
    Circle outlet = make_circle(centre);
    int line[4];
    for (int i = 0; i < 4; i++) line[i] = b_.line(circle_end_.vertex[i], outlet.vertex[i]);
    for (int i = 0; i < 4; i++) {
      gp_Ax3 at(outlet_centre(0), -downstream(), in_outlet_plane(corner_[i] - U_MARGIN));
      b_.face(new Geom_CylindricalSurface(at, 0.5 * v_.input.outlet_diameter),
              {circle_end_.arc[i], line[(i + 1) % 4], outlet.arc[i], line[i]}, "discharge");
    }
    b_.face(new Geom_Plane(gp_Ax3(centre, downstream())), {outlet.arc[0], outlet.arc[1], outlet.arc[2], outlet.arc[3]},
            "outlet", CW_PATCH_OUTLET);
  }

  const CwVolute &v_; // in the model unit
  const double unit_; // the model unit, m
  const int across_;
  LoopBuilder b_;
  double angle_[SECTORS + 1];
  Ring step_[2];
  int kink_vertex_[SECTORS + 1][2], kink_[SECTORS][2], section_[SECTORS + 1];
  int flank_vertex_[2], nose_side_[2], nose_flank_, throat_vertex_[2], flank_side_[2], throat_inner_, throat_side_[2];
  std::array<double, 5> corner_;
  Circle circle_end_;
};

} // namespace

CwStatus cw_stator_build(const CwVolute *volute, double unit, CwSolid **stator) {
  *stator = nullptr;
  return cw_solid_guard(CW_ERR_GEOMETRY, "stator", "", [&] {
    const CwVolute in_unit = cw_volute_in_unit(volute, unit);
    std::unique_ptr<CwSolid> fresh(StatorMaker(in_unit, unit).make());
    cw_stator_check(*fresh);
    *stator = fresh.release();
    return CW_OK;
  });
}
