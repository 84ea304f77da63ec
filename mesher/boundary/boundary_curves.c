// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/boundary_curves.h"

#include <math.h>
#include <stdlib.h>

enum { SIZE_STEPS = 400 };

CwStatus cw_divide_by_size(double (*size_at)(const void *context, double place), const void *context, double from,
                           double to, double length, int32_t least, int32_t *count, double **place) {
  CwStatus status = CW_OK;
  // Number of edges up to each of many small steps: integral of ds / h by the midpoint rule.
  double edges[SIZE_STEPS + 1] = {0};
  for (int i = 0; i < SIZE_STEPS; i++) {
    double at = from + (to - from) * (i + 0.5) / SIZE_STEPS;
    edges[i + 1] = edges[i] + length / SIZE_STEPS / size_at(context, at);
  }
  int32_t whole = (int32_t)floor(edges[SIZE_STEPS] + 0.5);
  if (whole < least) whole = least;
  *count = whole + 1;
  CW_NEW(*place, whole + 1);
  (*place)[0] = from;
  (*place)[whole] = to;
  int step = 0;
  for (int32_t k = 1; k < whole; k++) {
    double wanted = edges[SIZE_STEPS] * k / whole;
    while (step < SIZE_STEPS - 1 && edges[step + 1] < wanted) step++;
    double s = (wanted - edges[step]) / (edges[step + 1] - edges[step]);
    (*place)[k] = from + (to - from) * (step + s) / SIZE_STEPS;
  }
done:
  return status;
}

typedef struct {
  const CwBoundaryInput *in;
  const CwCurve *curve;
} Along;

static double size_along(const void *context, double length) {
  const Along *along = context;
  double x[3], parameter[2];
  cw_curve_point(along->in->network, along->curve, length, x, parameter);
  return along->in->size_at(along->in->size, x);
}

CwStatus cw_curve_divide(const CwBoundaryInput *in, const CwCurve *curve, double from, double to, int32_t least,
                         int32_t *count, double **place) {
  return cw_divide_by_size(size_along, &(Along){in, curve}, from, to, fabs(to - from), least, count, place);
}

CwStatus cw_image_link_curves(const CwPeriodicImages *images, int32_t first, const CwCurveNodes *curve,
                              CwNodeImages *nodes) {
  CwStatus status = CW_OK;
  int32_t copies = cw_image_copies(images, &images->curve, first), at = first;
  for (int32_t turns = 1; turns <= copies && copies > 1; turns++) {
    int32_t next = images->curve.next[at];
    for (int32_t k = 1; k + 1 < curve[at].count; k++) {
      CW_TRY(cw_image_link(nodes, curve[at].node[k], curve[next].node[k], turns % copies));
    }
    at = next;
  }
done:
  return status;
}
