// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/number.h"

static const double floor_quality = 0.25; // below it no tetrahedron may become worse by relaxing
static const double regular = 0.8;        // a point stays where all round it are above; 0.866 in a lattice
static const double pull = 0.1;           // of an edge
enum { MOVED = 1, RETURNED = 2 };         // a point that is free to move
enum { LANES = 8 };

// Tetrahedra side by side, so that a processor's instructions for two or four numbers have as many of them at once.
// Those behind `count` are of no meaning.
typedef struct {
  int count;
  int32_t tet[LANES];
  double x[4][3][LANES], quality[LANES], slender[LANES];
} Lanes;

static inline void add_lane(const CwTetWork *w, int32_t t, Lanes *s) {
  for (int c = 0; c < 4; c++) {
    const double *x = cw_tet_at(w, w->mesh->tet[t].corner[c]);
    for (int i = 0; i < 3; i++) s->x[c][i][s->count] = x[i];
  }
  s->tet[s->count++] = t;
}

static void judge_lanes(Lanes *s) {
  for (int k = 0; k < LANES; k++) {
    double a[3], b[3], c[3], d[3], shortest, longest;
    for (int i = 0; i < 3; i++) a[i] = s->x[0][i][k], b[i] = s->x[1][i][k], c[i] = s->x[2][i][k], d[i] = s->x[3][i][k];
    CwTetMeasures measures = cw_tet_measures(a, b, c, d);
    cw_tet_edges(&measures, &shortest, &longest);
    s->slender[k] = longest > CW_TET_LONG * CW_TET_LONG * shortest ? 1.0 : 0.0;
    s->quality[k] = cw_tet_quality_by(&measures);
  }
}

typedef struct {
  int32_t *tet, count, space;
} List;

// Whether moves made a tetrahedron worse than it may be.
static int is_spoilt(const CwTetWork *w, int32_t t, const double (*old)[3]) {
  const CwDelaunayTet *tet = &w->mesh->tet[t];
  return tet->square < floor_quality && tet->square < cw_tet_quality(old[tet->corner[0]], old[tet->corner[1]],
                                                                     old[tet->corner[2]], old[tet->corner[3]]);
}

// Sets the quality of those in the lanes and whether they are slender, and puts them into the list where they are below
// the limit, and into that of the spoilt ones where that is so and `old` places are given. Empties the lanes.
static CwStatus judge(CwTetWork *w, Lanes *s, const double (*old)[3], List *spoilt) {
  CwStatus status = CW_OK;
  int count = s->count;
  s->count = 0;
  if (count) judge_lanes(s);
  for (int k = 0; k < count; k++) {
    CwDelaunayTet *tet = &w->mesh->tet[s->tet[k]];
    tet->centre[2] = s->slender[k];
    tet->square = s->quality[k];
    if (tet->square < w->limit) CW_TRY(cw_tet_push(w, s->tet[k]));
    if (!old || !is_spoilt(w, s->tet[k], old)) continue;
    CW_GROW(spoilt->tet, spoilt->space, spoilt->count + 1);
    spoilt->tet[spoilt->count++] = s->tet[k];
  }
done:
  return status;
}

CwStatus cw_tet_scan(CwTetWork *w) {
  CwStatus status = CW_OK;
  Lanes lanes = {0};
  for (int32_t p = 0; p < w->mesh->point_count; p++) w->mesh->point[p].mark = 0;
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    CwDelaunayTet *tet = &w->mesh->tet[t];
    cw_delaunay_ask_ahead(tet);
    tet->centre[0] = 0.0;
    tet->centre[1] = -1.0;
    if (tet->corner[0] >= 0) add_lane(w, t, &lanes);
    if (lanes.count == LANES) CW_TRY(judge(w, &lanes, NULL, NULL));
  }
  CW_TRY(judge(w, &lanes, NULL, NULL));
done:
  return status;
}

// Of a point's tetrahedra: sum of weights times the ways to the places they want it at, and of the weights.
typedef struct {
  float way[3], weight;
} Sum;

// A tetrahedron wants its points at the centre of its circumscribed sphere. Its weight is its volume over the cube of
// its mean edge: equal for all that are well shaped, large or small, so that the spacing keeps its gradient; nothing
// for flat ones, whose spheres are anywhere.
static inline void add_centre(const CwTetWork *w, const int32_t corner[4], Sum *sum) {
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
  double products =
      a[0] * (b[0] + c[0]) + a[1] * (b[1] + c[1]) + a[2] * (b[2] + c[2]) + b[0] * c[0] + b[1] * c[1] + b[2] * c[2];
  double squares = 3.0 * (aa + bb + cc) - 2.0 * products; // of all six edges
  double scale = 1.0 / (squares * sqrt(squares)), way[3];
  double weight = scale * (a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2]);
  for (int i = 0; i < 3; i++) way[i] = 0.5 * scale * (aa * bc[i] + bb * ca[i] + cc * ab[i]);
  for (int k = 0; k < 4; k++) {
    Sum *s = &sum[corner[k]];
    const double *from = k == 0 ? NULL : k == 1 ? a : k == 2 ? b : c;
    for (int i = 0; i < 3; i++) s->way[i] += (float)(from ? way[i] - weight * from[i] : way[i]);
    s->weight += (float)weight;
  }
}

// A tetrahedron wants the ends of its longest edge nearer to one another, and those of its shortest edge farther apart.
static inline void add_pull(const CwTetWork *w, const int32_t c[4], Sum *sum) {
  const double *x[4];
  double least = INFINITY, most = 0.0;
  unsigned shortest = 0, longest = 0;
  for (int k = 0; k < 4; k++) x[k] = cw_tet_at(w, c[k]);
  for (unsigned e = 0; e < 6; e++) { // without branches: they would be taken at random
    const double *p = x[cw_tet_edge[e][0]], *q = x[cw_tet_edge[e][1]];
    double u = q[0] - p[0], v = q[1] - p[1], z = q[2] - p[2], square = u * u + v * v + z * z;
    shortest ^= (shortest ^ e) & -cw_number(square < least);
    longest ^= (longest ^ e) & -cw_number(square > most);
    least = cw_tet_less(square, least);
    most = cw_tet_more(square, most);
  }
  if (!(least > CW_TET_FLAT * most)) return;
  for (int k = 0; k < 2; k++) {
    unsigned e = k ? longest : shortest;
    int a = cw_tet_edge[e][0], b = cw_tet_edge[e][1];
    double weight = 1.0 / (k ? most : least), step = k ? weight * pull : -weight * pull;
    Sum *p = &sum[c[a]], *q = &sum[c[b]];
    for (int i = 0; i < 3; i++) {
      float way = (float)(step * (x[b][i] - x[a][i]));
      p->way[i] += way;
      q->way[i] -= way;
    }
    p->weight += (float)weight;
    q->weight += (float)weight;
  }
}

// Marks the inner points that are not in a lattice.
static void find_irregular(const CwTetWork *w, uint8_t *moved) {
  CwDelaunay *mesh = w->mesh;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    cw_delaunay_ask_ahead(&mesh->tet[t]);
    if (c[0] < 0) continue;
    uint8_t irregular = MOVED * (uint8_t)cw_number(mesh->tet[t].square < regular);
    for (int i = 0; i < 4; i++) moved[c[i]] |= irregular;
  }
  for (int32_t p = 0; p < mesh->point_count; p++) moved[p] = moved[p] && mesh->source[p] >= w->fixed_count ? MOVED : 0;
}

// Moves the marked points at once to the weighted mean of the places that their tetrahedra want them at.
static inline void move_all(CwTetWork *w, void (*add)(const CwTetWork *, const int32_t[4], Sum *), const uint8_t *moved,
                            Sum *sum) {
  CwDelaunay *mesh = w->mesh;
  memset(sum, 0, (size_t)mesh->point_count * sizeof *sum);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    cw_delaunay_ask_ahead(&mesh->tet[t]);
    if (c[0] >= 0 && (moved[c[0]] | moved[c[1]] | moved[c[2]] | moved[c[3]])) add(w, c, sum);
  }
  for (int32_t p = 0; p < mesh->point_count; p++) {
    for (int i = 0; i < 3 && moved[p] && sum[p].weight > 0.0f; i++)
      mesh->point[p].x[i] += (double)(sum[p].way[i] / sum[p].weight);
  }
}

// A point of t goes back to where it stood. *whole: its tetrahedra are too many to be judged here.
static CwStatus put_back(CwTetWork *w, int32_t t, int32_t point, const double (*old)[3], List *spoilt, int *whole) {
  CwStatus status = CW_OK;
  int32_t star[CW_TET_STAR];
  Lanes lanes = {0};
  memcpy(w->mesh->point[point].x, old[point], sizeof *old);
  int count = cw_tet_star(w, t, point, star);
  *whole |= count == 0;
  for (int k = 0; k < count; k++) {
    add_lane(w, star[k], &lanes);
    if (lanes.count == LANES || k + 1 == count) CW_TRY(judge(w, &lanes, old, spoilt));
  }
done:
  return status;
}

// Judges all tetrahedra of the moved points. Where one is spoilt its points go back, and those of others that are
// spoilt by this.
static CwStatus take_back(CwTetWork *w, const double (*old)[3], uint8_t *moved) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = w->mesh;
  List spoilt = {0};
  Lanes lanes = {0};
  int whole;
  do {
    whole = 0;
    for (int32_t t = 0; t < mesh->tet_count; t++) {
      const int32_t *c = mesh->tet[t].corner;
      cw_delaunay_ask_ahead(&mesh->tet[t]);
      if (c[0] < 0 || !(moved[c[0]] | moved[c[1]] | moved[c[2]] | moved[c[3]])) continue;
      add_lane(w, t, &lanes);
      if (lanes.count == LANES) CW_TRY(judge(w, &lanes, old, &spoilt));
    }
    CW_TRY(judge(w, &lanes, old, &spoilt));
    while (spoilt.count) {
      int32_t t = spoilt.tet[--spoilt.count];
      for (int i = 0; i < 4 && is_spoilt(w, t, old); i++) {
        int32_t point = mesh->tet[t].corner[i];
        if (moved[point] != MOVED) continue;
        moved[point] = RETURNED;
        w->count.points_moved--;
        CW_TRY(put_back(w, t, point, old, &spoilt, &whole));
      }
    }
  } while (whole);
done:
  free(spoilt.tet);
  return status;
}

// Every inner point that is not in a lattice goes to the weighted mean of the centres round it (L. Chen and J. Xu,
// Optimal Delaunay triangulations, J. Comp. Math. 22, 2004), and from there by short steps to where its tetrahedra's
// edges are more even.
CwStatus cw_tet_relax(CwTetWork *w, int evenings) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = w->mesh;
  Sum *sum = NULL;
  double(*old)[3] = NULL;
  uint8_t *moved = NULL;
  CW_NEW(sum, mesh->point_count);
  CW_NEW(old, mesh->point_count);
  CW_NEW(moved, mesh->point_count);
  find_irregular(w, moved);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    memcpy(old[p], mesh->point[p].x, sizeof *old);
    w->count.points_moved += moved[p];
  }
  move_all(w, add_centre, moved, sum);
  for (int k = 0; k < evenings; k++) move_all(w, add_pull, moved, sum);
  CW_TRY(take_back(w, (const double(*)[3])old, moved));
done:
  free(sum);
  free(old);
  free(moved);
  return status;
}
