// SPDX-License-Identifier: AGPL-3.0-or-later
// A straight tube or rod about the z axis, made by LoopBuilder, whose ends are one disc or the sectors of a ring.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <gp_Ax3.hxx>
#include <gp_Trsf.hxx>

#include "geometry/stator_builder.hpp"

struct HandTube {
  double inner, outer, length; // 0: no hole
  int sectors;
  bool into = false; // the first face, an end in z = 0, has a natural normal out of the solid; else into it
  int turned = 0;    // begins each loop as many edges later, and runs round each second one the other way
};

// As it is given to the builder: ends "inlet" in z = 0 and "outlet", and walls "wall" outside and "core" inside.
inline void hand_tube_faces(LoopBuilder &builder, const HandTube &tube) {
  const int n = tube.sectors, rims = tube.inner > 0 ? 2 : 1;
  const double radius[2] = {tube.outer, tube.inner}, sweep = 2 * M_PI / n;
  std::vector<int> vertex[2][2], arc[2][2], along[2], across[2]; // by rim and end
  int faces = 0;
  for (int rim = 0; rim < rims; rim++) {
    for (int end = 0; end < 2; end++)
      for (int i = 0; i < n; i++)
        vertex[rim][end].push_back(
            builder.vertex(gp_Pnt(radius[rim] * cos(i * sweep), radius[rim] * sin(i * sweep), end ? tube.length : 0)));
    for (int end = 0; end < 2; end++)
      for (int i = 0; i < n; i++)
        arc[rim][end].push_back(builder.arc(vertex[rim][end][i], vertex[rim][end][(i + 1) % n], sweep));
    for (int i = 0; i < n; i++) along[rim].push_back(builder.line(vertex[rim][0][i], vertex[rim][1][i]));
  }
  for (int end = 0; end < 2 && rims == 2; end++)
    for (int i = 0; i < n; i++) across[end].push_back(builder.line(vertex[0][end][i], vertex[1][end][i]));
  const auto face = [&](const Handle(Geom_Surface) & surface, std::vector<LoopEdge> loop, const char *patch,
                        CwPatchKind kind) {
    std::rotate(loop.begin(), loop.begin() + tube.turned % loop.size(), loop.end());
    if (tube.turned && faces++ % 2) std::reverse(loop.begin(), loop.end());
    builder.face(surface, loop, patch, kind);
  };
  for (int end = 0; end < 2; end++) {
    const gp_Dir normal = end == 0 && tube.into ? -gp::DZ() : gp::DZ();
    const auto plane = [&]() { return new Geom_Plane(gp_Ax3(gp_Pnt(0, 0, end ? tube.length : 0), normal, gp::DX())); };
    const char *patch = end ? "outlet" : "inlet";
    const CwPatchKind kind = end ? CW_PATCH_OUTLET : CW_PATCH_INLET;
    if (rims == 1) face(plane(), {arc[0][end].begin(), arc[0][end].end()}, patch, kind);
    for (int i = 0; i < n && rims == 2; i++)
      face(plane(), {arc[0][end][i], across[end][(i + 1) % n], arc[1][end][i], across[end][i]}, patch, kind);
  }
  for (int rim = 0; rim < rims; rim++)
    for (int i = 0; i < n; i++) {
      const double from = i * sweep - U_MARGIN;
      face(new Geom_CylindricalSurface(gp_Ax3(gp::Origin(), gp::DZ(), gp_Dir(cos(from), sin(from), 0)), radius[rim]),
           {arc[rim][0][i], along[rim][(i + 1) % n], arc[rim][1][i], along[rim][i]}, rim ? "core" : "wall",
           CW_PATCH_WALL);
    }
}

inline CwSolid *hand_tube(const HandTube &tube, double unit, const gp_Trsf &motion = gp_Trsf()) {
  LoopBuilder builder(PLANE_CURVE, unit);
  hand_tube_faces(builder, tube);
  return builder.build("tube", motion, tube.into);
}
