// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/face_radius.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/policy.h"

typedef struct {
  int face;
  double radius, area;
} Piece;

static int by_radius(const void *a, const void *b) {
  const Piece *p = a, *q = b;
  if (p->radius != q->radius) return p->radius < q->radius ? -1 : 1;
  return (p->area > q->area) - (p->area < q->area);
}

CwStatus cw_face_radii(const CwCad *cad, const CwBackground *background, double *radius) {
  CwStatus status = CW_OK;
  Piece *piece = NULL;
  double *area = NULL, *sharper = NULL, *curvature = NULL, centre[3];
  int faces = cw_cad_face_count(cad), *face_at = NULL; // the face of which a point's curvature is known, and 1
  CW_NEW_UNSET(piece, background->triangle_count);
  CW_NEW(area, faces);
  CW_NEW(sharper, faces);
  CW_NEW(face_at, background->point_count);
  CW_NEW_UNSET(curvature, background->point_count);
  for (int f = 0; f < faces; f++) radius[f] = INFINITY;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    int face = background->face[t];
    double most = 0;
    for (int k = 0; k < 3; k++) {
      int32_t p = background->triangle[t][k];
      if (face_at[p] != face + 1) curvature[p] = cw_cad_face_curvature(cad, face, background->uv[t][k]);
      face_at[p] = face + 1;
      most = fmax(most, curvature[p]);
    }
    piece[t] = (Piece){face, most > 0 ? 1 / most : INFINITY, cw_background_area(background, t, centre)};
    area[face] += piece[t].area;
  }
  qsort(piece, (size_t)background->triangle_count, sizeof *piece, by_radius);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    int face = piece[t].face;
    sharper[face] += piece[t].area;
    if (isinf(radius[face]) && sharper[face] > cw_policy.missed_share * area[face]) radius[face] = piece[t].radius;
  }
done:
  free(piece);
  free(area);
  free(sharper);
  free(face_at);
  free(curvature);
  return status;
}
