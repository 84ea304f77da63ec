// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/tet_improve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/kernel_flips.h"
#include "mesher/ring.h"
#include "mesher/tet_mesh.h"
#include "mesher/tet_quality.h"

// Sines: tetrahedra with an angle below 25 (or above 155) degrees are improved, below 18 also with new
// points. More than 25 costs time and gives no better worst ones.
static const double limit_improve = 0.4226, limit_insert = 0.31;
static const double gain = 1e-6;      // least improvement, so that no two changes undo one another for ever
static const double step_gain = 2e-3; // least gain of a move: smaller ones cost much and give little
enum { PASSES = 5, RING = 8, STAR = 96, SPLIT = 16 };

static const int8_t tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
static const int8_t tet_edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// The quality of a tetrahedron stands in its square (1 where it is only known not to be below the limit), a
// mark of the last star in its centre[0], the pass that put it into the list for the next in centre[1], and
// the pass in which something changed at a point in the point's mark.
typedef struct {
  CwFlips flips;
  CwDelaunay *mesh;
  int32_t fixed_count, source_count;
  double stamp;
  uint64_t pass;
  int32_t *bad, bad_count, bad_space; // to look at in this pass
  int32_t *next, next_count, next_space;
  CwTetImproved count;
} Improver;

static const double *at(const Improver *w, int32_t p) {
  return w->mesh->point[p].x;
}

static double quality_of(const Improver *w, int32_t a, int32_t b, int32_t c, int32_t d) {
  return cw_tet_quality(at(w, a), at(w, b), at(w, c), at(w, d));
}

// Puts a place into the list for the next pass, once.
static CwStatus push(Improver *w, int32_t t) {
  CwStatus status = CW_OK;
  if (w->mesh->tet[t].centre[1] == (double)w->pass)
    goto done;
  w->mesh->tet[t].centre[1] = (double)w->pass;
  if (w->next_count == w->next_space) {
    int32_t more = 2 * w->next_space + 1024;
    int32_t *grown = realloc(w->next, (size_t)more * sizeof *grown);
    CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: list of %d tetrahedra", more);
    w->next = grown;
    w->next_space = more;
  }
  w->next[w->next_count++] = t;
done:
  return status;
}

static CwStatus set_quality(Improver *w, int32_t t, double quality) {
  CwDelaunayTet *tet = &w->mesh->tet[t];
  tet->square = quality;
  for (int i = 0; i < 4; i++)
    w->mesh->point[tet->corner[i]].mark = w->pass;
  return quality < limit_improve ? push(w, t) : CW_OK;
}

static CwStatus replace(Improver *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                        const double *quality) {
  CwStatus status = CW_OK;
  int32_t slot[CW_FLIP];
  CW_TRY(cw_flips_replace(&w->flips, old_count, old, count, corner, slot));
  for (int k = 0; k < count; k++)
    CW_TRY(set_quality(w, slot[k], quality[k]));
done:
  return status;
}

// Triangulations of the ring by dynamic programming (Klincsek): best[i][j] is the best least quality over the
// part i..j.
typedef struct {
  double best[RING][RING];
  int8_t cut[RING][RING];
} RingTable;

// Removes the edge a-b of t where that raises the least quality round it.
static CwStatus remove_edge(Improver *w, int32_t t, int32_t a, int32_t b, int *done_it) {
  CwStatus status = CW_OK;
  int32_t old[CW_RING], ring[CW_RING], tet[2 * RING][4];
  double quality[2 * RING], least = INFINITY;
  RingTable table;
  *done_it = 0;
  int n = cw_flips_ring(&w->flips, t, a, b, old, ring);
  if (n < 3 || n > RING)
    goto done;
  for (int k = 0; k < n; k++) {
    double q = w->mesh->tet[old[k]].square;
    if (q < least)
      least = q;
    if (k + 1 < n)
      table.best[k][k + 1] = INFINITY;
  }
  least += gain;
  for (int span = 2; span < n; span++) {
    for (int from = 0; from + span < n; from++) {
      int to = from + span;
      double best = -INFINITY;
      table.cut[from][to] = (int8_t)(from + 1);
      for (int k = from + 1; k < to; k++) {
        double worst = table.best[from][k] < table.best[k][to] ? table.best[from][k] : table.best[k][to];
        if (worst <= least || worst <= best)
          continue;
        double q = quality_of(w, ring[from], ring[k], ring[to], b);
        if (q < worst)
          worst = q;
        if (worst <= least || worst <= best)
          continue;
        q = quality_of(w, ring[from], ring[to], ring[k], a);
        if (q < worst)
          worst = q;
        if (worst <= best)
          continue;
        best = worst;
        table.cut[from][to] = (int8_t)k;
      }
      table.best[from][to] = best;
    }
  }
  if (!(table.best[0][n - 1] > least))
    goto done;
  int count = cw_ring_tets(&table.cut[0][0], RING, ring, a, b, 0, n - 1, tet, 0);
  for (int k = 0; k < count; k++)
    quality[k] = quality_of(w, tet[k][0], tet[k][1], tet[k][2], tet[k][3]);
  CW_TRY(replace(w, n, old, count, (const int32_t(*)[4])tet, quality));
  w->count.edges_removed++;
  *done_it = 1;
done:
  return status;
}

// Two tetrahedra at a face become three round a new edge, where that is better.
static CwStatus remove_face(Improver *w, int32_t t, int i, int *done_it) {
  CwStatus status = CW_OK;
  const CwDelaunayTet *tet = &w->mesh->tet[t];
  int32_t made[3][4], other = tet->neighbour[i];
  double quality[3];
  *done_it = 0;
  if (other < 0)
    goto done;
  const int32_t old[2] = {t, other / 4};
  int32_t below = tet->corner[i], above = w->mesh->tet[old[1]].corner[other % 4];
  double least = w->mesh->tet[old[1]].square < tet->square ? w->mesh->tet[old[1]].square : tet->square;
  for (int k = 0; k < 3; k++) {
    const int32_t one[4] = {tet->corner[tet_face[i][k]], tet->corner[tet_face[i][(k + 1) % 3]], below, above};
    quality[k] = quality_of(w, one[0], one[1], one[2], one[3]);
    if (quality[k] <= least + gain)
      goto done;
    memcpy(made[k], one, sizeof one);
  }
  CW_TRY(replace(w, 2, old, 3, (const int32_t(*)[4])made, quality));
  w->count.faces_removed++;
  *done_it = 1;
done:
  return status;
}

// A hollow: faces seen from a point inside it, each making a positive tetrahedron (face, point).
typedef struct {
  int count;
  const double *face[2 * STAR][3];
} Hollow;

// Least quality of the hollow's tetrahedra for the point at p; stops at `enough` and moves that face forward,
// so that the next trial finds it first.
static double hollow_quality(Hollow *hollow, const double p[3], double enough) {
  double least = INFINITY;
  for (int k = 0; k < hollow->count; k++) {
    const double **f = hollow->face[k];
    double q = cw_tet_quality(f[0], f[1], f[2], p);
    if (q >= least)
      continue;
    least = q;
    if (least > enough)
      continue;
    if (k > 0) {
      const double *kept[3];
      int to = k / 2;
      memcpy(kept, f, sizeof kept);
      memcpy(f, hollow->face[to], sizeof kept);
      memcpy(hollow->face[to], kept, sizeof kept);
    }
    break;
  }
  return least;
}

// Pattern search for the point of best least quality from p, which it moves; returns that quality.
static double best_place(Hollow *hollow, double p[3], double start) {
  static const double way[14][3] = {{1, 0, 0},  {-1, 0, 0},  {0, 1, 0},   {0, -1, 0},  {0, 0, 1},
                                    {0, 0, -1}, {1, 1, 1},   {-1, 1, 1},  {1, -1, 1},  {-1, -1, 1},
                                    {1, 1, -1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, -1}};
  double best = start, mean[3] = {0, 0, 0}, square = 0.0;
  for (int k = 0; k < hollow->count; k++) {
    for (int c = 0; c < 3; c++) {
      for (int i = 0; i < 3; i++)
        mean[i] += hollow->face[k][c][i] / (3.0 * hollow->count);
    }
  }
  for (int i = 0; i < 3; i++)
    square += (hollow->face[0][0][i] - p[i]) * (hollow->face[0][0][i] - p[i]);
  double q = hollow_quality(hollow, mean, best);
  if (q > best) {
    best = q;
    memcpy(p, mean, sizeof mean);
  }
  int last = 0;
  for (double step = 0.2 * sqrt(square), end = 0.2 * step; step > end; step *= 0.5) {
    for (int tries = 0, k = last; tries < 14; tries++, k = (k + 1) % 14) {
      double scale = k < 6 ? step : step * 0.57735026918962573, there[3];
      for (int i = 0; i < 3; i++)
        there[i] = p[i] + scale * way[k][i];
      q = hollow_quality(hollow, there, best + step_gain);
      if (q <= best + step_gain)
        continue;
      best = q;
      memcpy(p, there, sizeof there);
      last = k;
      tries = -1; // on in the same direction
      k = (k + 13) % 14;
    }
  }
  return best;
}

// Tetrahedra of an inner point of t; 0 where there are more than STAR.
static int star_of(Improver *w, int32_t t, int32_t point, int32_t *star) {
  CwDelaunay *mesh = w->mesh;
  int count = 1;
  w->stamp += 1.0;
  star[0] = t;
  mesh->tet[t].centre[0] = w->stamp;
  for (int head = 0; head < count; head++) {
    const CwDelaunayTet *tet = &mesh->tet[star[head]];
    for (int i = 0; i < 4; i++) {
      if (tet->corner[i] == point || tet->neighbour[i] < 0)
        continue;
      CwDelaunayTet *next = &mesh->tet[tet->neighbour[i] / 4];
      if (next->centre[0] == w->stamp)
        continue;
      if (count == STAR)
        return 0;
      next->centre[0] = w->stamp;
      star[count++] = tet->neighbour[i] / 4;
    }
  }
  return count;
}

static CwStatus smooth(Improver *w, int32_t t, int32_t point, int *done_it) {
  CwStatus status = CW_OK;
  int32_t star[STAR];
  Hollow hollow;
  double p[3], least = INFINITY;
  *done_it = 0;
  if (w->mesh->source[point] < w->fixed_count)
    goto done;
  int n = star_of(w, t, point, star);
  hollow.count = n;
  for (int k = 0; k < n; k++) {
    const CwDelaunayTet *tet = &w->mesh->tet[star[k]];
    int corner = 0;
    while (tet->corner[corner] != point)
      corner++;
    // Inward: (face, point) positive.
    for (int i = 0; i < 3; i++)
      hollow.face[k][i] = at(w, tet->corner[tet_face[corner][2 - i]]);
    if (tet->square < least)
      least = tet->square;
  }
  if (n == 0)
    goto done;
  memcpy(p, at(w, point), sizeof p);
  if (!(best_place(&hollow, p, least) > least + step_gain))
    goto done;
  memcpy(w->mesh->point[point].x, p, sizeof p);
  for (int k = 0; k < n; k++) {
    const int32_t *c = w->mesh->tet[star[k]].corner;
    CW_TRY(set_quality(w, star[k], quality_of(w, c[0], c[1], c[2], c[3])));
  }
  w->count.points_moved++;
  *done_it = 1;
done:
  return status;
}

// A new point on an inner edge of t, moved to its best place. Flat tetrahedra with all corners on the
// boundary, which no flip and no smoothing can raise, are cut from below this way.
static CwStatus split_edge(Improver *w, int32_t t, int32_t a, int32_t b, int *done_it) {
  CwStatus status = CW_OK;
  int32_t old[CW_RING], ring[CW_RING], tet[2 * SPLIT][4], point = -1;
  double quality[2 * SPLIT], p[3], least = INFINITY;
  Hollow hollow;
  *done_it = 0;
  int n = cw_flips_ring(&w->flips, t, a, b, old, ring);
  if (n < 3 || n > SPLIT)
    goto done;
  hollow.count = 2 * n;
  for (int k = 0; k < n; k++) {
    double q = w->mesh->tet[old[k]].square;
    if (q < least)
      least = q;
    // (a, b, r, s) is positive; so are (a, p, r, s) and (p, b, r, s) for p between a and b.
    const int32_t r = ring[k], s = ring[(k + 1) % n], one[3] = {a, r, s}, two[3] = {b, s, r};
    memcpy(tet[2 * k], one, sizeof one);
    memcpy(tet[2 * k + 1], two, sizeof two);
    for (int i = 0; i < 3; i++) {
      hollow.face[2 * k][i] = at(w, one[i]);
      hollow.face[2 * k + 1][i] = at(w, two[i]);
    }
  }
  for (int i = 0; i < 3; i++)
    p[i] = 0.5 * (at(w, a)[i] + at(w, b)[i]);
  if (!(best_place(&hollow, p, hollow_quality(&hollow, p, -2.0)) > least + 0.02))
    goto done;
  CW_TRY(cw_delaunay_add_point(w->mesh, p, w->source_count++, &point));
  for (int k = 0; k < 2 * n; k++) {
    tet[k][3] = point;
    quality[k] = quality_of(w, tet[k][0], tet[k][1], tet[k][2], point);
  }
  CW_TRY(replace(w, n, old, 2 * n, (const int32_t(*)[4])tet, quality));
  w->count.points_added++;
  *done_it = 1;
done:
  return status;
}

// One try at a tetrahedron: the first change that helps.
static CwStatus improve_one(Improver *w, int32_t t, int insert, int *done_it) {
  CwStatus status = CW_OK;
  int32_t c[4];
  memcpy(c, w->mesh->tet[t].corner, sizeof c);
  *done_it = 0;
  for (int e = 0; e < 6 && !*done_it; e++)
    CW_TRY(remove_edge(w, t, c[tet_edge[e][0]], c[tet_edge[e][1]], done_it));
  for (int i = 0; i < 4 && !*done_it; i++)
    CW_TRY(remove_face(w, t, i, done_it));
  if (*done_it)
    goto done;
  for (int i = 0; i < 4; i++) {
    int moved;
    CW_TRY(smooth(w, t, c[i], &moved));
    *done_it |= moved;
    if (moved)
      break;
  }
  if (!insert || w->mesh->tet[t].square >= limit_insert)
    goto done;
  for (int e = 0; e < 6 && !*done_it; e++)
    CW_TRY(split_edge(w, t, c[tet_edge[e][0]], c[tet_edge[e][1]], done_it));
done:
  return status;
}

static int has_changed(const Improver *w, int32_t t) {
  for (int i = 0; i < 4; i++) {
    if (w->mesh->point[w->mesh->tet[t].corner[i]].mark + 1 >= w->pass)
      return 1;
  }
  return 0;
}

static double least_quality(const Improver *w) {
  double least = 1.0;
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    const CwDelaunayTet *tet = &w->mesh->tet[t];
    if (tet->corner[0] >= 0 && tet->square < least)
      least = tet->square;
  }
  return least;
}

CwStatus cw_tet_improve_mesh(CwDelaunay *mesh, int32_t fixed_count, int32_t *source_count,
                           CwTetImproved *improved) {
  CwStatus status = CW_OK;
  Improver w = {
      .flips = {.mesh = mesh}, .mesh = mesh, .fixed_count = fixed_count, .source_count = *source_count};
  for (int32_t p = 0; p < mesh->point_count; p++)
    mesh->point[p].mark = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    CwDelaunayTet *tet = &mesh->tet[t];
    const int32_t *c = tet->corner;
    tet->centre[0] = 0.0;
    tet->centre[1] = -1.0;
    if (c[0] < 0)
      continue;
    tet->square = 1.0;
    if (!cw_tet_is_below(at(&w, c[0]), at(&w, c[1]), at(&w, c[2]), at(&w, c[3]), limit_improve))
      continue;
    tet->square = quality_of(&w, c[0], c[1], c[2], c[3]);
    CW_TRY(push(&w, t));
  }
  w.count.least_before = least_quality(&w);
  for (w.pass = 1; w.pass <= PASSES && w.next_count; w.pass++) {
    int32_t *swap = w.bad, space = w.bad_space, changes = 0;
    w.bad = w.next, w.bad_count = w.next_count, w.bad_space = w.next_space;
    w.next = swap, w.next_count = 0, w.next_space = space;
    for (int32_t k = 0; k < w.bad_count; k++) {
      int32_t t = w.bad[k];
      int done_it = 0;
      if (mesh->tet[t].corner[0] < 0 || mesh->tet[t].square >= limit_improve)
        continue;
      if (w.pass <= 2 || has_changed(&w, t))
        CW_TRY(improve_one(&w, t, w.pass >= 2, &done_it));
      changes += done_it;
      if (!done_it)
        CW_TRY(push(&w, t));
    }
    if (changes == 0 && w.pass >= 2)
      break;
  }
  w.count.least_after = least_quality(&w);
  *source_count = w.source_count;
  if (improved)
    *improved = w.count;
done:
  free(w.bad);
  free(w.next);
  return status;
}

CwStatus cw_tet_improve(int32_t fixed_count, CwFill *fill, CwTetImproved *improved) {
  CwStatus status = CW_OK;
  CwDelaunay mesh;
  int32_t count = fill->point_count;
  status = cw_tet_mesh_make(fill, &mesh);
  cw_fill_free(fill);
  CW_TRY(status);
  CW_TRY(cw_tet_improve_mesh(&mesh, fixed_count, &count, improved));
  CW_TRY(cw_tet_mesh_take(&mesh, fixed_count, count, fill));
done:
  cw_delaunay_free(&mesh);
  if (status != CW_OK)
    cw_fill_free(fill);
  return status;
}
