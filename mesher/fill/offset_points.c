// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/offset_points.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/radix.h"
#include "mesher/common/vec.h"

static const double CLOSE_PACKING = 0.81649658092772603273; // of its layers, over the spacing: sqrt(2/3)

static const double line[3] = {1.0, 0.37, 0.61}; // along no axis, so that few places of regular triangles are level

CwOffsetPoint cw_offset_point(const CwFillInput *input, int32_t t) {
  const double *a = input->x[input->triangle[t][0]], *b = input->x[input->triangle[t][1]];
  const double *c = input->x[input->triangle[t][2]];
  double u[3], v[3], normal[3];
  int on_interface = t >= input->triangle_count - input->interface_count;
  CwOffsetPoint place = {.triangle = t, .on_interface = on_interface};
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  cw_cross(u, v, normal);
  cw_unit(normal);
  for (int i = 0; i < 3; i++) place.x[i] = (a[i] + b[i] + c[i]) / 3.0;
  double edge = sqrt(2.0 * (cw_dot(u, u) + cw_dot(v, v) - cw_dot(u, v)) / 3.0);
  double wanted = input->size(input->size_context, place.x);
  place.spacing = fmin(sqrt(edge * wanted), cbrt(edge * wanted * wanted));
  for (int i = 0; i < 3; i++) place.x[i] -= CLOSE_PACKING * place.spacing * normal[i];
  place.along = cw_dot(line, place.x);
  return place;
}

static uint64_t key_of(const CwOffsetPoint *place) {
  return cw_radix_key(place->along) >> 1 | (place->on_interface ? 0 : (uint64_t)1 << 63);
}

CwStatus cw_offset_points(const CwFillInput *input, CwOffsetPoint **places) {
  CwStatus status = CW_OK;
  CwOffsetPoint *made = NULL, *place = NULL;
  CwRadix *order = NULL;
  CW_NEW_UNSET(made, input->offset_count);
  CW_NEW_UNSET(order, input->offset_count);
  for (int32_t p = 0; p < input->offset_count; p++) {
    made[p] = cw_offset_point(input, input->triangle_count - input->offset_count + p);
    order[p] = (CwRadix){key_of(&made[p]), p, 0};
  }
  CW_TRY(cw_radix_sort(input->offset_count, order));
  CW_NEW_UNSET(place, input->offset_count);
  for (int32_t p = 0; p < input->offset_count; p++) place[p] = made[order[p].item];
  *places = place;
done:
  free(made);
  free(order);
  return status;
}
