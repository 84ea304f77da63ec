// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/cad_shape.h"

#include <algorithm>

#include <gp_Vec.hxx>

double CwCadKnots::snap(double parameter) const {
  if (knot.empty()) return parameter;
  double tolerance = 1e-12 * (knot.back() - knot.front());
  auto next = std::lower_bound(knot.begin(), knot.end(), parameter);
  if (next != knot.end() && *next - parameter < tolerance) return *next;
  if (next != knot.begin() && parameter - *(next - 1) < tolerance) return *(next - 1);
  return parameter;
}

double CwCadReplaced::parameter(double share) const {
  size_t steps = t.size() - 1;
  double at = std::clamp(share, 0.0, 1.0) * (double)steps;
  size_t i = std::min((size_t)at, steps - 1);
  double s = at - (double)i;
  return s == 1 ? t[i + 1] : t[i] + s * (t[i + 1] - t[i]);
}

gp_Pnt CwCadFace::point(const double uv[2]) const {
  double at[2] = {uv[0], uv[1]};
  gp_Pnt p;
  if (pole.is) pole.to_surface(at);
  surface.D0(u_knots.snap(at[0]), v_knots.snap(at[1]), p);
  return p;
}

void CwCadFace::derive(const double uv[2], gp_Pnt &p, gp_Vec first[2], CwCadSecond *second) const {
  double off[2] = {uv[0], uv[1]};
  if (pole.is) pole.keep_off(off);
  double at[2] = {off[0], off[1]};
  if (pole.is) pole.to_surface(at);
  const double u = u_knots.snap(at[0]), v = v_knots.snap(at[1]);
  if (second)
    surface.D2(u, v, p, first[0], first[1], second->uu, second->vv, second->uv);
  else
    surface.D1(u, v, p, first[0], first[1]);
  if (!pole.is) return;
  pole.derive(off, first, second);
  p = point(uv);
}

void CwCadFace::keep_in_ranges(double uv[2]) const {
  if (pole.is) pole.to_surface(uv);
  uv[0] = std::clamp(uv[0], u_range[0], u_range[1]);
  uv[1] = std::clamp(uv[1], v_range[0], v_range[1]);
  if (pole.is) pole.to_plane(uv);
}
