// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/clip.h"

#include <string.h>

double cw_plane_distance(const CwPlane *plane, const double x[3]) {
  return plane->normal[0] * x[0] + plane->normal[1] * x[1] + plane->normal[2] * x[2] - plane->offset;
}

CwPlane cw_plane_flipped(const CwPlane *plane) {
  return (CwPlane){{-plane->normal[0], -plane->normal[1], -plane->normal[2]}, -plane->offset};
}

// Crossing of the edge a-b. The ends are put in an order of their own, by their coordinates: the same two ends give
// the same bits from whichever side of the plane, and from whichever triangle, they are asked for.
static void crossing(const double *a, double da, const double *b, double db, double *x) {
  int swap = 0;
  for (int k = 0; k < 3; k++) {
    if (a[k] != b[k]) {
      swap = a[k] > b[k];
      break;
    }
  }
  const double *first = swap ? b : a, *second = swap ? a : b;
  double d1 = swap ? db : da, d2 = swap ? da : db;
  double s = d1 / (d1 - d2);
  for (int k = 0; k < 3; k++) x[k] = first[k] + s * (second[k] - first[k]);
}

int cw_clip_polygon(const CwPlane *plane, int count, const double (*corner)[3], double (*result)[3]) {
  int made = 0;
  if (count == 0) return 0;
  const double *previous = corner[count - 1];
  double d_previous = cw_plane_distance(plane, previous);
  for (int i = 0; i < count; i++) {
    const double *next = corner[i];
    double d_next = cw_plane_distance(plane, next);
    int in_previous = d_previous <= 0, in_next = d_next <= 0;
    // An end on the plane is the crossing itself: a crossing computed there would repeat it.
    int crosses = (d_previous < 0 && d_next > 0) || (d_previous > 0 && d_next < 0);
    if (crosses && in_previous != in_next) crossing(previous, d_previous, next, d_next, result[made++]);
    if (in_next) memcpy(result[made++], next, sizeof(double[3]));
    previous = next;
    d_previous = d_next;
  }
  return made < 3 ? 0 : made;
}
