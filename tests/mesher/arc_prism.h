// SPDX-License-Identifier: AGPL-3.0-or-later
// Prisms over plane figures with arcs, for tests of the curves that bound them. Lengths in mm, z from 0 to the height.
#pragma once

#include <cmath>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <gp_Ax2.hxx>
#include <gp_Elips.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

inline TopoDS_Edge arc_edge(double radius, double from, double to) {
  const auto at = [=](double angle) { return gp_Pnt(radius * std::cos(angle), radius * std::sin(angle), 0); };
  return BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(at(from), at((from + to) / 2), at(to)).Value());
}

inline TopoDS_Shape prism_over(const TopoDS_Wire &wire, double height) {
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire), gp_Vec(0, 0, height)).Shape();
}

// An arc about the origin from the angle 0 on, and the straight line between its ends.
inline TopoDS_Shape segment_prism(double radius, double angle, double height) {
  const gp_Pnt from(radius * std::cos(angle), radius * std::sin(angle), 0), to(radius, 0, 0);
  return prism_over(BRepBuilderAPI_MakeWire(arc_edge(radius, 0, angle), BRepBuilderAPI_MakeEdge(from, to)), height);
}

// An arc and two lines to the origin.
inline TopoDS_Shape sector_prism(double radius, double angle, double height) {
  const gp_Pnt from(radius * std::cos(angle), radius * std::sin(angle), 0), to(radius, 0, 0), centre(0, 0, 0);
  return prism_over(BRepBuilderAPI_MakeWire(arc_edge(radius, 0, angle), BRepBuilderAPI_MakeEdge(from, centre),
                                            BRepBuilderAPI_MakeEdge(centre, to)),
                    height);
}

// Two arcs between (-1, 0) and (1, 0), as high over the line between them, or under it where that is below 0.
inline TopoDS_Shape lens_prism(double first, double second, double height) {
  const gp_Pnt from(-1, 0, 0), to(1, 0, 0);
  const TopoDS_Edge a = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(from, gp_Pnt(0, first, 0), to).Value());
  const TopoDS_Edge b = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(to, gp_Pnt(0, second, 0), from).Value());
  return prism_over(BRepBuilderAPI_MakeWire(a, b), height);
}

// A quarter of an ellipse with its axes; the arc is followed from the first axis to the second, or back.
inline TopoDS_Shape quarter_prism(double major, double minor, bool back, double height) {
  const gp_Pnt a(back ? -major : major, 0, 0), b(0, minor, 0), centre(0, 0, 0);
  const gp_Elips ellipse(gp_Ax2(centre, gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)), major, minor);
  const double from = back ? M_PI / 2 : 0;
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(ellipse, from, from + M_PI / 2));
  wire.Add(BRepBuilderAPI_MakeEdge(back ? a : b, centre));
  wire.Add(BRepBuilderAPI_MakeEdge(centre, back ? b : a));
  return prism_over(wire.Wire(), height);
}

// A circle of as many equal arcs.
inline TopoDS_Shape circle_prism(double radius, int arcs, double height) {
  BRepBuilderAPI_MakeWire wire;
  for (int k = 0; k < arcs; k++) wire.Add(arc_edge(radius, 2 * M_PI * k / arcs, 2 * M_PI * (k + 1) / arcs));
  return prism_over(wire.Wire(), height);
}
