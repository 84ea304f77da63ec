// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/background.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/background_tessellate.h"

typedef struct {
  int32_t low, high; // points of the edge
  int32_t triangle;
  int32_t forward;   // the triangle runs from low to high
} HalfEdge;

static int by_points(const void *a, const void *b) {
  const HalfEdge *p = a, *q = b;
  if (p->low != q->low) return p->low < q->low ? -1 : 1;
  if (p->high != q->high) return p->high < q->high ? -1 : 1;
  if (p->forward != q->forward) return p->forward < q->forward ? -1 : 1;
  return p->triangle < q->triangle ? -1 : p->triangle > q->triangle;
}

// Each edge twice, in opposite directions: that is closed and consistently oriented.
static CwStatus check_closed(const CwCad *cad, const CwBackground *background) {
  CwStatus status = CW_OK;
  HalfEdge *half = NULL;
  size_t count = 0;
  CW_NEW(half, 3 * (size_t)background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t a = background->triangle[t][k], b = background->triangle[t][(k + 1) % 3];
      half[count++] = (HalfEdge){a < b ? a : b, a < b ? b : a, t, a < b};
    }
  }
  qsort(half, count, sizeof *half, by_points);
  for (size_t i = 0; i < count; i += 2) {
    const double *x = background->x[half[i].low];
    const char *name = cw_cad_face_name(cad, background->face[half[i].triangle]);
    int pair = i + 1 < count && half[i + 1].low == half[i].low && half[i + 1].high == half[i].high;
    int opposite = pair && half[i].forward != half[i + 1].forward;
    int more = pair && i + 2 < count && half[i + 2].low == half[i].low && half[i + 2].high == half[i].high;
    CW_REQUIRE(opposite && !more, CW_ERR_GEOMETRY,
               "face '%s': the tessellation %s at (%.3f, %.3f, %.3f) mm", name,
               !pair ? "is open" : "folds or turns over", x[0] * 1e3, x[1] * 1e3, x[2] * 1e3);
  }
done:
  free(half);
  return status;
}

CwStatus cw_background_make(CwCad *cad, double deflection, double angle, CwBackground *background) {
  CwStatus status = CW_OK;
  memset(background, 0, sizeof *background);
  CW_REQUIRE(deflection > 0 && angle > 0, CW_ERR_USAGE, "deflection %g m and angle %g rad must be greater than zero",
             deflection, angle);
  CW_TRY(cw_background_tessellate(cad, deflection, angle, background));
  CW_TRY(check_closed(cad, background));
  CW_REQUIRE(cw_background_volume(background) > 0, CW_ERR_GEOMETRY,
             "the tessellation encloses %g m3; it must be positive", cw_background_volume(background));
done:
  if (status != CW_OK) cw_background_free(background);
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
