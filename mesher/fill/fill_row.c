// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_row.h"

#include <math.h>

#include "mesher/common/vec.h"

static const double height = 0.75; // of the spacing; sqrt(2/3) in a close packing, which is denser than asked for
static const double most = 1.3;    // spacing over the edges of the triangle
static const double line[3] = {1.0, 0.37, 0.61}; // along no axis, so that few places of regular triangles are level

CwRowPlace cw_row_place(const CwFillInput *input, int32_t t) {
  const double *a = input->x[input->triangle[t][0]], *b = input->x[input->triangle[t][1]];
  const double *c = input->x[input->triangle[t][2]];
  double u[3], v[3], normal[3];
  int on_interface = t >= input->triangle_count - input->interface_count;
  CwRowPlace place = {.triangle = t, .on_interface = on_interface};
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  cw_cross(u, v, normal);
  cw_unit(normal);
  for (int i = 0; i < 3; i++) place.x[i] = (a[i] + b[i] + c[i]) / 3.0;
  double edge = sqrt(2.0 * (cw_dot(u, u) + cw_dot(v, v) - cw_dot(u, v)) / 3.0);
  place.spacing = fmin(sqrt(edge * input->size(input->size_context, place.x)), most * edge);
  for (int i = 0; i < 3; i++) place.x[i] -= height * place.spacing * normal[i];
  place.along = cw_dot(line, place.x);
  return place;
}

int cw_row_compare(const CwRowPlace *a, const CwRowPlace *b) {
  if (a->on_interface != b->on_interface) return b->on_interface - a->on_interface;
  if (a->along != b->along) return a->along < b->along ? -1 : 1;
  return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}
