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

// The greatest curvature of each bend, 1/m: of the principal ones.
typedef struct {
  double of[CW_BENDS];
} Curvature;

static Curvature curvature_at(const CwCad *cad, int face, const double uv[2]) {
  double lesser, greater = cw_cad_face_curvature(cad, face, uv, &lesser);
  return (Curvature){{fmax(0, fmax(greater, lesser)), fmax(0, -fmin(greater, lesser))}};
}

CwStatus cw_face_radii(const CwCad *cad, const CwBackground *background, double (*radius)[CW_BENDS]) {
  CwStatus status = CW_OK;
  Piece *piece[CW_BENDS] = {NULL};
  double *area = NULL, *sharper[CW_BENDS] = {NULL}, centre[3];
  Curvature *curvature = NULL;
  int32_t count = background->triangle_count;
  int faces = cw_cad_face_count(cad), *face_at = NULL; // the face of which a point's curvature is known, and 1
  CW_NEW(area, faces);
  CW_NEW(face_at, background->point_count);
  CW_NEW_UNSET(curvature, background->point_count);
  for (int bend = 0; bend < CW_BENDS; bend++) {
    CW_NEW_UNSET(piece[bend], count);
    CW_NEW(sharper[bend], faces);
    for (int f = 0; f < faces; f++) radius[f][bend] = INFINITY;
  }
  for (int32_t t = 0; t < count; t++) {
    int face = background->face[t];
    double most[CW_BENDS] = {0}, of = cw_background_area(background, t, centre);
    for (int k = 0; k < 3; k++) {
      int32_t p = background->triangle[t][k];
      if (face_at[p] != face + 1) curvature[p] = curvature_at(cad, face, background->uv[t][k]);
      face_at[p] = face + 1;
      for (int bend = 0; bend < CW_BENDS; bend++) most[bend] = fmax(most[bend], curvature[p].of[bend]);
    }
    for (int bend = 0; bend < CW_BENDS; bend++)
      piece[bend][t] = (Piece){face, most[bend] > 0 ? 1 / most[bend] : INFINITY, of};
    area[face] += of;
  }
  for (int bend = 0; bend < CW_BENDS; bend++) {
    qsort(piece[bend], (size_t)count, sizeof **piece, by_radius);
    for (int32_t t = 0; t < count; t++) {
      const Piece *of = &piece[bend][t];
      double *least = &radius[of->face][bend];
      sharper[bend][of->face] += of->area;
      if (isinf(*least) && sharper[bend][of->face] > cw_policy.missed_share * area[of->face]) *least = of->radius;
    }
  }
done:
  for (int bend = 0; bend < CW_BENDS; bend++) {
    free(piece[bend]);
    free(sharper[bend]);
  }
  free(area);
  free(face_at);
  free(curvature);
  return status;
}
