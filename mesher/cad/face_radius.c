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

// The greatest of the principal curvatures of each bend, 1/m.
static void curvatures_at(const CwCad *cad, int face, const double uv[2], double curvature[CW_BENDS]) {
  double lesser, greater = cw_cad_face_curvature(cad, face, uv, &lesser);
  curvature[CW_CONVEX] = fmax(0, fmax(greater, lesser));
  curvature[CW_CONCAVE] = fmax(0, -fmin(greater, lesser));
}

// Sets the radii of one bend from the pieces of all faces, which it sorts; area: of each face.
static CwStatus find_radii(Piece *piece, int32_t count, const double *area, int faces, int bend,
                           double (*radius)[CW_BENDS]) {
  CwStatus status = CW_OK;
  double *sharper = NULL;
  CW_NEW(sharper, faces);
  for (int f = 0; f < faces; f++) radius[f][bend] = INFINITY;
  qsort(piece, (size_t)count, sizeof *piece, by_radius);
  for (int32_t t = 0; t < count; t++) {
    int face = piece[t].face;
    double *least = &radius[face][bend];
    sharper[face] += piece[t].area;
    if (isinf(*least) && sharper[face] > cw_policy.missed_share * area[face]) *least = piece[t].radius;
  }
done:
  free(sharper);
  return status;
}

CwStatus cw_face_radii(const CwCad *cad, const CwBackground *background, double (*radius)[CW_BENDS]) {
  CwStatus status = CW_OK;
  Piece *piece[CW_BENDS] = {NULL};
  double *area = NULL, (*curvature)[CW_BENDS] = NULL, centre[3];
  int32_t count = background->triangle_count;
  int faces = cw_cad_face_count(cad), *face_at = NULL; // the face of which a point's curvature is known, and 1
  CW_NEW(area, faces);
  CW_NEW(face_at, background->point_count);
  CW_NEW_UNSET(curvature, background->point_count);
  for (int bend = 0; bend < CW_BENDS; bend++) CW_NEW_UNSET(piece[bend], count);
  for (int32_t t = 0; t < count; t++) {
    int face = background->face[t];
    double most[CW_BENDS] = {0}, of = cw_background_area(background, t, centre);
    for (int k = 0; k < 3; k++) {
      int32_t p = background->triangle[t][k];
      if (face_at[p] != face + 1) curvatures_at(cad, face, background->uv[t][k], curvature[p]);
      face_at[p] = face + 1;
      for (int bend = 0; bend < CW_BENDS; bend++) most[bend] = fmax(most[bend], curvature[p][bend]);
    }
    for (int bend = 0; bend < CW_BENDS; bend++)
      piece[bend][t] = (Piece){face, most[bend] > 0 ? 1 / most[bend] : INFINITY, of};
    area[face] += of;
  }
  for (int bend = 0; bend < CW_BENDS; bend++) CW_TRY(find_radii(piece[bend], count, area, faces, bend, radius));
done:
  for (int bend = 0; bend < CW_BENDS; bend++) free(piece[bend]);
  free(area);
  free(face_at);
  free(curvature);
  return status;
}
