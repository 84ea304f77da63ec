// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/tet_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double floor_quality = 0.25; // below it no tetrahedron may become worse by relaxing
static const double regular = 0.8;        // a point stays where all round it are above; 0.866 in a lattice

// Sets the quality (1 for all that are regular enough), and puts the tetrahedron into the list where it is
// below the limit.
static CwStatus judge(CwTetWork *w, int32_t t) {
  CwDelaunayTet *tet = &w->mesh->tet[t];
  const int32_t *c = tet->corner;
  tet->square = cw_tet_quality_to(cw_tet_at(w, c[0]), cw_tet_at(w, c[1]), cw_tet_at(w, c[2]),
                                  cw_tet_at(w, c[3]), regular);
  return tet->square < w->limit ? cw_tet_push(w, t) : CW_OK;
}

CwStatus cw_tet_scan(CwTetWork *w) {
  CwStatus status = CW_OK;
  for (int32_t p = 0; p < w->mesh->point_count; p++)
    w->mesh->point[p].mark = 0;
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    CwDelaunayTet *tet = &w->mesh->tet[t];
    tet->centre[0] = 0.0;
    tet->centre[1] = -1.0;
    if (tet->corner[0] >= 0)
      CW_TRY(judge(w, t));
  }
done:
  return status;
}

// A point's tetrahedra: sum of weights times centres of the circumscribed spheres, and of the weights; then
// where the point stood.
typedef struct {
  double x[3], weight;
} Sum;

// The weight of a tetrahedron is its volume over the cube of its mean edge: equal for all that are well
// shaped, large or small, so that the spacing keeps its gradient; nothing for flat ones, whose spheres are
// anywhere.
static void add_centre(const CwTetWork *w, int32_t t, Sum *sum) {
  const int32_t *corner = w->mesh->tet[t].corner;
  const double *o = cw_tet_at(w, corner[0]);
  double a[3], b[3], c[3], bc[3], ca[3], ab[3];
  for (int i = 0; i < 3; i++) {
    a[i] = cw_tet_at(w, corner[1])[i] - o[i];
    b[i] = cw_tet_at(w, corner[2])[i] - o[i];
    c[i] = cw_tet_at(w, corner[3])[i] - o[i];
  }
  bc[0] = b[1] * c[2] - b[2] * c[1], bc[1] = b[2] * c[0] - b[0] * c[2], bc[2] = b[0] * c[1] - b[1] * c[0];
  ca[0] = c[1] * a[2] - c[2] * a[1], ca[1] = c[2] * a[0] - c[0] * a[2], ca[2] = c[0] * a[1] - c[1] * a[0];
  ab[0] = a[1] * b[2] - a[2] * b[1], ab[1] = a[2] * b[0] - a[0] * b[2], ab[2] = a[0] * b[1] - a[1] * b[0];
  double aa = a[0] * a[0] + a[1] * a[1] + a[2] * a[2], bb = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
  double cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  double products = a[0] * (b[0] + c[0]) + a[1] * (b[1] + c[1]) + a[2] * (b[2] + c[2]) + b[0] * c[0] +
                    b[1] * c[1] + b[2] * c[2];
  double squares = 3.0 * (aa + bb + cc) - 2.0 * products; // of all six edges
  double scale = 1.0 / (squares * sqrt(squares)), x[3];
  double weight = scale * (a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2]);
  for (int i = 0; i < 3; i++)
    x[i] = weight * o[i] + 0.5 * scale * (aa * bc[i] + bb * ca[i] + cc * ab[i]);
  for (int k = 0; k < 4; k++) {
    Sum *s = &sum[corner[k]];
    for (int i = 0; i < 3; i++)
      s->x[i] += x[i];
    s->weight += weight;
  }
}

// Whether the move made a tetrahedron worse than it may be.
static int is_spoilt(const CwTetWork *w, int32_t t, const Sum *old) {
  const CwDelaunayTet *tet = &w->mesh->tet[t];
  return tet->square < floor_quality &&
         tet->square < cw_tet_quality(old[tet->corner[0]].x, old[tet->corner[1]].x, old[tet->corner[2]].x,
                                      old[tet->corner[3]].x);
}

// Every inner point that is not in a lattice goes to the weighted mean of the centres round it (L. Chen and
// J. Xu, Optimal Delaunay triangulations, J. Comp. Math. 22, 2004). Where that spoils a tetrahedron its
// points go back, and those of others that are spoilt by this.
CwStatus cw_tet_relax(CwTetWork *w) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = w->mesh;
  Sum *sum = NULL;
  uint8_t *moved = NULL, *checked = NULL; // moved: 2 where it goes back in this round
  int32_t returned;
  CW_NEW(sum, mesh->point_count);
  CW_NEW(moved, mesh->point_count);
  CW_NEW(checked, mesh->point_count);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    if (c[0] >= 0 && mesh->tet[t].square < regular)
      moved[c[0]] = moved[c[1]] = moved[c[2]] = moved[c[3]] = 1;
  }
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    if (c[0] >= 0 && (moved[c[0]] | moved[c[1]] | moved[c[2]] | moved[c[3]]))
      add_centre(w, t, sum);
  }
  for (int32_t p = 0; p < mesh->point_count; p++) {
    double old[3];
    memcpy(old, mesh->point[p].x, sizeof old);
    moved[p] = checked[p] = moved[p] && mesh->source[p] >= w->fixed_count && sum[p].weight > 0.0;
    if (moved[p]) {
      for (int i = 0; i < 3; i++)
        mesh->point[p].x[i] = sum[p].x[i] / sum[p].weight;
      w->count.points_moved++;
    }
    memcpy(sum[p].x, old, sizeof old);
  }
  do {
    returned = 0;
    for (int32_t t = 0; t < mesh->tet_count; t++) {
      const int32_t *c = mesh->tet[t].corner;
      if (c[0] < 0 || !(checked[c[0]] | checked[c[1]] | checked[c[2]] | checked[c[3]]))
        continue;
      CW_TRY(judge(w, t));
      if (!is_spoilt(w, t, sum))
        continue;
      for (int i = 0; i < 4; i++)
        moved[c[i]] = moved[c[i]] ? 2 : 0;
    }
    for (int32_t p = 0; p < mesh->point_count; p++) {
      checked[p] = moved[p] > 1;
      if (!checked[p])
        continue;
      memcpy(mesh->point[p].x, sum[p].x, sizeof sum[p].x);
      moved[p] = 0;
      returned++;
      w->count.points_moved--;
    }
  } while (returned);
done:
  free(sum);
  free(moved);
  free(checked);
  return status;
}
