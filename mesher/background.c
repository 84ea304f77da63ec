// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/background.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/background_tessellate.h"

typedef struct {
  int32_t low, high; // points of the edge
  int32_t forward;   // its triangle runs from low to high
  int32_t triangle, side;
} HalfEdge;

static int by_points(const void *a, const void *b) {
  const HalfEdge *p = a, *q = b;
  if (p->low != q->low)
    return p->low < q->low ? -1 : 1;
  if (p->high != q->high)
    return p->high < q->high ? -1 : 1;
  if (p->forward != q->forward)
    return p->forward < q->forward ? -1 : 1;
  return p->triangle < q->triangle ? -1 : p->triangle > q->triangle;
}

static int same_edge(const HalfEdge *a, const HalfEdge *b) {
  return a->low == b->low && a->high == b->high;
}

CwStatus cw_background_neighbours(const CwCad *cad, const CwBackground *background,
                                  int32_t (**neighbour)[3]) {
  CwStatus status = CW_OK;
  HalfEdge *half = NULL;
  int32_t(*across)[3] = NULL;
  size_t count = 0;
  CW_NEW(half, 3 * (size_t)background->triangle_count);
  CW_NEW(across, background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t a = background->triangle[t][k], b = background->triangle[t][(k + 1) % 3];
      half[count++] = (HalfEdge){a < b ? a : b, a < b ? b : a, a < b, t, k};
    }
  }
  qsort(half, count, sizeof *half, by_points);
  for (size_t i = 0; i < count; i += 2) {
    const HalfEdge *h = &half[i];
    const double *x = background->x[h->low];
    int pair = i + 1 < count && same_edge(h, h + 1);
    int whole = pair && h[0].forward != h[1].forward && !(i + 2 < count && same_edge(h, h + 2));
    CW_REQUIRE(whole, CW_ERR_GEOMETRY, "face '%s': the tessellation %s at (%.3f, %.3f, %.3f) mm",
               cw_cad_face_name(cad, background->face[h->triangle]), pair ? "folds or turns over" : "is open",
               x[0] * 1e3, x[1] * 1e3, x[2] * 1e3);
    across[h[0].triangle][h[0].side] = h[1].triangle;
    across[h[1].triangle][h[1].side] = h[0].triangle;
  }
  *neighbour = across;
  across = NULL;
done:
  free(half);
  free(across);
  return status;
}

CwStatus cw_background_make(CwCad *cad, double deflection, double angle, CwBackground *background) {
  CwStatus status = CW_OK;
  int32_t(*neighbour)[3] = NULL;
  memset(background, 0, sizeof *background);
  CW_REQUIRE(deflection > 0 && angle > 0, CW_ERR_USAGE,
             "deflection %g m and angle %g rad must be greater than zero", deflection, angle);
  CW_TRY(cw_background_tessellate(cad, deflection, angle, background));
  CW_TRY(cw_background_neighbours(cad, background, &neighbour)); // closed, or it fails
  CW_REQUIRE(cw_background_volume(background) > 0, CW_ERR_GEOMETRY,
             "the tessellation encloses %g m3; it must be positive", cw_background_volume(background));
done:
  free(neighbour);
  if (status != CW_OK)
    cw_background_free(background);
  return status;
}

void cw_background_free(CwBackground *background) {
  free(background->x);
  free(background->triangle);
  free(background->face);
  free(background->uv);
  memset(background, 0, sizeof *background);
}

double cw_background_volume(const CwBackground *background) {
  double six_volumes = 0;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    const double *a = background->x[background->triangle[t][0]];
    const double *b = background->x[background->triangle[t][1]];
    const double *c = background->x[background->triangle[t][2]];
    six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six_volumes / 6;
}
