// SPDX-License-Identifier: AGPL-3.0-or-later
// A tank with n equal sides and a hub in its middle, divided into sectors, up to its network of curves.
#pragma once

#include <cmath>
#include <cstring>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Shell.hxx>
#include <gp_Ax1.hxx>
#include <gp_Ax3.hxx>
#include <gp_Pln.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/cad/symmetry.h"
#include "mesher/plan/sector_plan.h"
}

#include "domain_surfaces.h"
#include "solids.h"

inline double tank_size(const void *, const double *) {
  return 4e-3;
}

// Casing: a prism with n sides, 40 mm to its corners, z = 0 to 40 mm. Hub: a frustum on its floor, 20 mm to the corners
// below, 14 mm above, 15 mm high; on its top the flow meets the axis, or on its tip 6 mm above that. The floor is cut
// into one face a side.
inline TopoDS_Shape tank_solid(int n, bool tip = false) {
  const double outer = 40, low = 20, high = 14, top = 40, nose = 15, pitch = 2 * M_PI / n;
  struct Ring {
    double r, z;
    std::vector<TopoDS_Vertex> vertex;
    std::vector<TopoDS_Edge> edge;
  } ring[4] = {{outer, top, {}, {}}, {outer, 0, {}, {}}, {low, 0, {}, {}}, {high, nose, {}, {}}};
  const auto at = [](const Ring &of, double angle) {
    return gp_Pnt(of.r * std::cos(angle), of.r * std::sin(angle), of.z);
  };
  for (Ring &of : ring) {
    for (int k = 0; k < n; k++) of.vertex.push_back(BRepBuilderAPI_MakeVertex(at(of, k * pitch)));
    for (int k = 0; k < n; k++) of.edge.push_back(BRepBuilderAPI_MakeEdge(of.vertex[k], of.vertex[(k + 1) % n]));
  }
  BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (int r = 0; r < 3; r++) { // side of the casing, floor, side of the hub; normals out of the fluid
    std::vector<TopoDS_Edge> down;
    for (int k = 0; k < n; k++) down.push_back(BRepBuilderAPI_MakeEdge(ring[r].vertex[k], ring[r + 1].vertex[k]));
    const gp_Pnt a = at(ring[r], 0), b = at(ring[r], pitch), c = at(ring[r + 1], 0);
    const gp_Vec along(a, b), normal = gp_Vec(a, c).Crossed(along);
    for (int k = 0; k < n; k++) {
      gp_Ax3 axes(a, gp_Dir(normal), gp_Dir(along));
      axes.Rotate(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), k * pitch);
      BRepBuilderAPI_MakeWire wire(ring[r].edge[k], down[(k + 1) % n], ring[r + 1].edge[k], down[k]);
      builder.Add(shell, BRepBuilderAPI_MakeFace(gp_Pln(axes), wire.Wire(), true).Face());
    }
  }
  if (tip) {
    const gp_Pnt end(0, 0, nose + 6);
    const TopoDS_Vertex apex = BRepBuilderAPI_MakeVertex(end);
    std::vector<TopoDS_Edge> up;
    for (int k = 0; k < n; k++) up.push_back(BRepBuilderAPI_MakeEdge(ring[3].vertex[k], apex));
    for (int k = 0; k < n; k++) {
      const gp_Pnt a = at(ring[3], k * pitch), b = at(ring[3], (k + 1) * pitch);
      const gp_Ax3 axes(a, gp_Dir(gp_Vec(a, end).Crossed(gp_Vec(a, b))), gp_Dir(gp_Vec(a, b)));
      BRepBuilderAPI_MakeWire wire(ring[3].edge[k], up[(k + 1) % n], up[k]);
      builder.Add(shell, BRepBuilderAPI_MakeFace(gp_Pln(axes), wire.Wire(), true).Face());
    }
  }
  for (int end = 0; end < (tip ? 1 : 2); end++) { // the water's face above, the hub's top below
    const Ring &of = ring[end ? 3 : 0];
    BRepBuilderAPI_MakeWire wire;
    for (int k = 0; k < n; k++) wire.Add(of.edge[k]);
    const gp_Ax3 axes(gp_Pnt(0, 0, of.z), gp_Dir(0, 0, end ? -1 : 1), gp_Dir(1, 0, 0));
    builder.Add(shell, BRepBuilderAPI_MakeFace(gp_Pln(axes), wire.Wire(), true).Face());
  }
  shell.Closed(true);
  return BRepBuilderAPI_MakeSolid(shell).Solid();
}

// `odd`: the patch of one side of the casing has another name. `tip`: the hub ends in one.
inline CwCad *open_tank(int n, bool odd = false, bool tip = false) {
  return open_solid(tank_solid(n, tip), [=](const TopoDS_Face &face) -> std::string {
    const gp_Ax3 axes = BRepAdaptor_Surface(face).Plane().Position();
    if (axes.Direction().Z() > 0.99) return "water,inlet";
    const bool first_side = std::fabs(axes.Direction().Z()) < 0.01 && axes.Location().Y() == 0;
    return odd && first_side ? "odd,wall" : "side,wall";
  });
}

struct Tank {
  int n;
  CwCad *cad;
  CwBackground background;
  CwVerticals *inside = nullptr;
  CwSymmetry *symmetry = nullptr;
  std::vector<CwPlanNode> node;
  std::vector<double> none;
  CwPlan plan;
  DomainSurfaces boundary;
  CwOutcome outcome = {};

  // Plane 0 at z = 8 mm through the hub; `wedges` half-planes in each pitch; `divided`: a plane across each wedge, 24
  // mm from the axis, whose lines on the half-planes before and after differ.
  Tank(int turns, int wedges, bool divided = false, bool tip = false) : n(turns), cad(open_tank(turns, false, tip)) {
    check(cw_background_make(cad, 1e-4, 0.2, &background));
    check(cw_verticals_make(background.x, background.triangle_count, background.triangle, &inside));
    check(cw_symmetry_find(cad, &background, &symmetry));
    const int count = n * wedges, first = 1 + count, each = divided ? 2 : 1;
    const auto wedge = [=](int j) { return divided ? first + j : -2 - j; };
    node.push_back({{{0, 0, -1}, -0.008}, -1, {-1, 1}, 0});
    for (int j = 0; j < count; j++) {
      const double angle = 0.3 * 2 * M_PI / n + j * 2 * M_PI / count;
      node.push_back({{{-std::sin(angle), std::cos(angle), 0}, 0}, 0, {wedge((j + count - 1) % count), wedge(j)}, 0});
    }
    for (int j = 0; divided && j < count; j++) {
      const double angle = 0.3 * 2 * M_PI / n + (j + 0.5) * 2 * M_PI / count + 0.05;
      node.push_back({{{std::cos(angle), std::sin(angle), 0}, 0.024}, 1 + j, {-2 - 2 * j, -3 - 2 * j}, 0});
    }
    none.assign(node.size(), 0);
    plan = {(int)node.size(), 1 + each * count, node.data(), none.data(), 1, count, 1, n};
    boundary.input.cad = cad;
    boundary.input.plan = &plan;
    boundary.input.size_at = tank_size;
    check(cw_network_make(NULL, cad, &background, inside, &plan, &boundary.network, &outcome));
    assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
    boundary.images.symmetry = symmetry;
  }
  ~Tank() {
    boundary.free();
    cw_symmetry_free(&symmetry);
    cw_verticals_free(&inside);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
};
