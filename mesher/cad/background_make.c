// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/background_make.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/cad/background_tessellate.h"
#include "mesher/cad/rays.h"
#include "mesher/common/model_unit.h"

typedef struct {
  int32_t other;          // point at the far end of the edge
  int32_t triangle, side; // its triangle runs from the near end to the far one where `forward`
  int forward;
} HalfEdge;

// Pairs the half edges of one point, whose other ends have greater numbers.
static CwStatus pair_up(const CwCad *cad, CwBackground *background, int32_t point, const HalfEdge *half,
                        int32_t count) {
  for (int32_t i = 0; i < count; i++) {
    int32_t mate = -1, met = 0;
    for (int32_t j = 0; j < count; j++) {
      if (j == i || half[j].other != half[i].other) continue;
      mate = j;
      met++;
    }
    if (met != 1 || half[mate].forward == half[i].forward) {
      return CW_FAIL(CW_ERR_GEOMETRY, "face '%s': the tessellation %s at (%.3f, %.3f, %.3f) mm",
                     cw_cad_face_name(cad, background->face[half[i].triangle]),
                     met > 0 ? "folds or turns over" : "is open", CW_MM(background->x[point]));
    }
    background->neighbour[half[i].triangle][half[i].side] = half[mate].triangle;
  }
  return CW_OK;
}

// Finds the triangle across each edge. Fails where an edge is not shared by exactly two triangles that run opposite
// ways.
static CwStatus find_neighbours(const CwCad *cad, CwBackground *background) {
  CwStatus status = CW_OK;
  HalfEdge *half = NULL;
  int32_t *start = NULL;
  CW_NEW(half, 3 * (size_t)background->triangle_count);
  CW_NEW(start, background->point_count + 2);
  CW_NEW(background->neighbour, background->triangle_count);
  // Half edges by the lesser of their two points.
  for (int store = 0; store < 2; store++) {
    for (int32_t t = 0; t < background->triangle_count; t++) {
      for (int k = 0; k < 3; k++) {
        int32_t a = background->triangle[t][k], b = background->triangle[t][(k + 1) % 3];
        int32_t low = a < b ? a : b;
        if (store) {
          half[start[low + 1]++] = (HalfEdge){a < b ? b : a, t, k, a < b};
        } else {
          start[low + 2]++;
        }
      }
    }
    for (int32_t p = 2; !store && p < background->point_count + 2; p++) start[p] += start[p - 1];
  }
  for (int32_t p = 0; p < background->point_count; p++) {
    CW_TRY(pair_up(cad, background, p, half + start[p], start[p + 1] - start[p]));
  }
done:
  free(half);
  free(start);
  return status;
}

// The triangles of an inside-out solid, and the solid with them.
static void turn(CwCad *cad, CwBackground *background) {
  cw_cad_turn(cad);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    int32_t *corner = background->triangle[t], point = corner[1];
    double(*uv)[2] = background->uv[t], place[2];
    corner[1] = corner[2];
    corner[2] = point;
    memcpy(place, uv[1], sizeof place);
    memcpy(uv[1], uv[2], sizeof place);
    memcpy(uv[2], place, sizeof place);
  }
}

CwStatus cw_background_join(const CwContext *context, CwCad *cad, void *const *face_bytes, CwBackground *background) {
  CwStatus status = CW_OK;
  memset(background, 0, sizeof *background);
  CW_TRY(cw_tessellation_weld(cad, face_bytes, background));
  double volume = cw_background_volume(background);
  if (volume < 0) {
    turn(cad, background);
    volume = -volume;
  }
  CW_TRY(find_neighbours(cad, background)); // closed, or it fails
  CW_REQUIRE(volume > 0, CW_ERR_GEOMETRY, "solid of face '%s': the tessellation encloses %g mm3; allowed: above 0",
             cw_cad_face_name(cad, 0), cw_mm3(volume));
  CW_TRY(cw_rays_make(context, background->point_count, (const double(*)[3])background->x, background->triangle_count,
                      (const int32_t(*)[3])background->triangle, &background->rays));
done:
  if (status != CW_OK) cw_background_free(background);
  return status;
}

CwStatus cw_background_make(CwCad *cad, double deflection, double angle, CwBackground *background) {
  CwStatus status = CW_OK;
  CwTessellation *tessellation = NULL;
  void **bytes = NULL;
  int64_t size;
  int faces = cw_cad_face_count(cad);
  memset(background, 0, sizeof *background);
  CW_REQUIRE(deflection > 0 && angle > 0, CW_ERR_USAGE, "deflection %g m and angle %g rad must be greater than zero",
             deflection, angle);
  CW_NEW(bytes, faces);
  CW_TRY(cw_tessellation_start(cad, deflection, angle, &tessellation));
  for (int f = 0; f < faces; f++) CW_TRY(cw_tessellation_face(tessellation, f, &bytes[f], &size));
  CW_TRY(cw_background_join(NULL, cad, bytes, background));
done:
  for (int f = 0; bytes && f < faces; f++) free(bytes[f]);
  free(bytes);
  cw_tessellation_free(&tessellation);
  return status;
}
