// SPDX-License-Identifier: AGPL-3.0-or-later
// What the surfaces of one blade or splitter are made of, and the surfaces: see blade_patches.hpp.
#pragma once

#include <vector>

#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>

#include "geometry/blade.h"
#include "geometry/meridian.h"

enum { CW_HUB, CW_SHROUD }; // the two walls

// A grid of points. Angles are of blade 0. The sides run from the leading to the trailing edge, the leading
// edge from suction to pressure, bevel and trailing edge towards greater theta.
struct CwBladePatch {
  std::vector<double> u;
  std::vector<CwBladePoint> points; // points[i * CW_SPAN_POINTS + j], without fillets
  // Root fillets (empty: none): along the wall the outline moves out by `foot` (q, theta), and along the blade
  // the fillet ends at the share `reach` of the span; `handle` is the share of both at which the inner poles
  // of the arc between lie.
  std::vector<CwBladePoint> foot[2];
  std::vector<double> reach[2], handle[2];
  // Made of the above: surfaces from hub to shroud (v = 0 to 1 each), and the outline on both walls as points
  // and as a curve of (theta, t).
  std::vector<Handle(Geom_BSplineSurface)> band;
  std::vector<CwBladePoint> outline[2];
  Handle(Geom2d_BSplineCurve) on_wall[2];
};

// A blade, a splitter or a seam. A bevelled trailing edge has a bevel and a cut, a blunt or rounded one no bevel, a
// sharp one no cut. The fields are its sections and what its patches and the lines on both walls are made of.
struct CwBladeShape {
  const char *name;
  std::vector<CwBladeSection> section;
  bool has_bevel, has_trailing;
  CwBladePatch pressure, suction, leading, bevel, trailing;
  double u_bevel;                      // last parameter of the suction side: where bevel or cut begins
  double theta_corner[2], t_corner[2]; // of the pressure side's end: angle, and place along hub and shroud
  // The line on the wall from the eye to the nose. It arrives along the mean line, square to the nose: a meridian would
  // meet it at the blade angle, and would cross the blades before a splitter. theta_up is where it begins.
  double theta_up[2];
  Handle(Geom2d_BSplineCurve) guide_on_wall[2];
  Handle(Geom_BSplineCurve) guide[2];
  // A seam is no blade: only its guide lines from the eye to the interface, where a passage is cut in two because its
  // walls would wind round the axis by more than a revolution.
  bool seam = false;
  double begin = 0; // angle at which the parameter planes of the passage behind it begin, less the margin

  // The patches that this shape has.
  std::vector<CwBladePatch *> patches() {
    std::vector<CwBladePatch *> all = {&pressure, &suction, &leading};
    if (has_bevel) all.push_back(&bevel);
    if (has_trailing) all.push_back(&trailing);
    return all;
  }
};

// Arc lengths of the blade's ends on a wall, m, and the wall's curve.
struct CwBladeOnWall {
  const CwMeridianCurve *curve;
  double begin, length;
};
inline CwBladeOnWall cw_blade_on_wall(const CwMeridian *meridian, int wall) {
  if (wall == CW_HUB) return {&meridian->hub, meridian->hub_leading, meridian->hub_trailing - meridian->hub_leading};
  return {&meridian->shroud, meridian->shroud_leading, meridian->shroud_trailing - meridian->shroud_leading};
}
