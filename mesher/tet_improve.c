// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/tet_improve.h"

#include <math.h>
#include <string.h>

#include "mesher/tet_improve_mesh.h"
#include "mesher/ring.h"

// Sines: tetrahedra with an angle below 27 (or above 153) degrees are improved, below 18 also with new
// points.
static const double limit_improve = 0.454, limit_insert = 0.31;
static const double gain = 1e-6; // least improvement, so that no two changes undo one another for ever
enum { PASSES = 6, RING = 8 };

static const int tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
static const int tet_edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

static double quality_of(const CwTetMesh *mesh, int32_t a, int32_t b, int32_t c, int32_t d) {
  return cw_tet_quality(mesh->x[a], mesh->x[b], mesh->x[c], mesh->x[d]);
}

// Triangulations of the ring by dynamic programming (Klincsek): best[i][j] is the best least quality over the
// part i..j.
typedef struct {
  double best[RING][RING];
  int8_t cut[RING][RING];
} RingTable;

// Removes the edge of corners i and j of t where that raises the least quality round it.
static CwStatus remove_edge(CwTetMesh *mesh, int32_t t, int i, int j, int *done_it) {
  CwStatus status = CW_OK;
  int32_t old[RING], ring[RING], tet[2 * RING][4], a = mesh->corner[t][i], b = mesh->corner[t][j];
  double quality[2 * RING], least = INFINITY;
  RingTable table;
  *done_it = 0;
  int n = cw_tet_mesh_ring(mesh, t, i, j, RING, old, ring);
  if (n < 3)
    goto done;
  for (int k = 0; k < n; k++)
    least = fmin(least, mesh->quality[old[k]]);
  for (int k = 0; k + 1 < n; k++)
    table.best[k][k + 1] = INFINITY;
  for (int span = 2; span < n; span++) {
    for (int from = 0; from + span < n; from++) {
      int to = from + span;
      table.best[from][to] = -INFINITY;
      table.cut[from][to] = (int8_t)(from + 1);
      for (int k = from + 1; k < to; k++) {
        double worst = fmin(table.best[from][k], table.best[k][to]);
        if (worst <= least + gain || worst <= table.best[from][to])
          continue;
        worst = fmin(worst, quality_of(mesh, ring[from], ring[k], ring[to], b));
        if (worst <= least + gain || worst <= table.best[from][to])
          continue;
        worst = fmin(worst, quality_of(mesh, ring[from], ring[to], ring[k], a));
        if (worst <= table.best[from][to])
          continue;
        table.best[from][to] = worst;
        table.cut[from][to] = (int8_t)k;
      }
    }
  }
  if (!(table.best[0][n - 1] > least + gain))
    goto done;
  int count = cw_ring_tets(&table.cut[0][0], RING, ring, a, b, 0, n - 1, tet, 0);
  for (int k = 0; k < count; k++)
    quality[k] = quality_of(mesh, tet[k][0], tet[k][1], tet[k][2], tet[k][3]);
  CW_TRY(cw_tet_mesh_replace(mesh, n, old, count, (const int32_t(*)[4])tet, quality));
  *done_it = 1;
done:
  return status;
}

// Two tetrahedra at a face become three round a new edge, where that is better.
static CwStatus remove_face(CwTetMesh *mesh, int32_t t, int i, int *done_it) {
  CwStatus status = CW_OK;
  int32_t tet[3][4], other = mesh->neighbour[t][i];
  double quality[3];
  *done_it = 0;
  if (other < 0)
    goto done;
  const int32_t old[2] = {t, other / 4};
  int32_t below = mesh->corner[t][i], above = mesh->corner[old[1]][other % 4];
  double least = fmin(mesh->quality[old[0]], mesh->quality[old[1]]);
  for (int k = 0; k < 3; k++) {
    // The face turns counter-clockwise seen from `above`.
    const int32_t one[4] = {mesh->corner[t][tet_face[i][k]], mesh->corner[t][tet_face[i][(k + 1) % 3]], below,
                            above};
    quality[k] = quality_of(mesh, one[0], one[1], one[2], one[3]);
    if (quality[k] <= least + gain)
      goto done;
    memcpy(tet[k], one, sizeof one);
  }
  CW_TRY(cw_tet_mesh_replace(mesh, 2, old, 3, (const int32_t(*)[4])tet, quality));
  *done_it = 1;
done:
  return status;
}

// A hollow: faces seen from a point inside it, each making a positive tetrahedron (face, point).
typedef struct {
  int count;
  int32_t face[2 * CW_CAVITY][3];
} Hollow;

// Least quality of the hollow's tetrahedra for the point at p; stops below `enough` and moves the worst face
// forward, so that the next trial finds it first.
static double hollow_quality(const CwTetMesh *mesh, Hollow *hollow, const double p[3], double enough) {
  double least = INFINITY;
  int worst = 0;
  for (int k = 0; k < hollow->count; k++) {
    const int32_t *f = hollow->face[k];
    double q = cw_tet_quality(mesh->x[f[0]], mesh->x[f[1]], mesh->x[f[2]], p);
    if (q < least) {
      least = q;
      worst = k;
      if (least <= enough)
        break;
    }
  }
  if (worst > 0) {
    int32_t kept[3];
    memcpy(kept, hollow->face[worst], sizeof kept);
    memmove(hollow->face[1], hollow->face[0], (size_t)worst * sizeof *hollow->face);
    memcpy(hollow->face[0], kept, sizeof kept);
  }
  return least;
}

// Pattern search for the point of best least quality from p, which it moves; returns that quality.
static double best_place(const CwTetMesh *mesh, Hollow *hollow, double p[3], double start) {
  static const double way[14][3] = {{1, 0, 0},  {-1, 0, 0},  {0, 1, 0},   {0, -1, 0},  {0, 0, 1},
                                    {0, 0, -1}, {1, 1, 1},   {-1, 1, 1},  {1, -1, 1},  {-1, -1, 1},
                                    {1, 1, -1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, -1}};
  double best = start, mean[3] = {0, 0, 0}, square = 0.0;
  for (int k = 0; k < hollow->count; k++) {
    for (int c = 0; c < 3; c++) {
      for (int i = 0; i < 3; i++)
        mean[i] += mesh->x[hollow->face[k][c]][i] / (3.0 * hollow->count);
    }
  }
  const double *corner = mesh->x[hollow->face[0][0]];
  for (int i = 0; i < 3; i++)
    square += (corner[i] - p[i]) * (corner[i] - p[i]);
  double q = hollow_quality(mesh, hollow, mean, best);
  if (q > best) {
    best = q;
    memcpy(p, mean, sizeof mean);
  }
  int last = -1;
  for (double step = 0.2 * sqrt(square), end = 0.05 * step; step > end; step *= 0.5) {
    for (int tries = 0, w = last < 0 ? 0 : last; tries < 14; tries++, w = (w + 1) % 14) {
      double scale = w < 6 ? step : step * 0.57735026918962573, there[3];
      for (int i = 0; i < 3; i++)
        there[i] = p[i] + scale * way[w][i];
      q = hollow_quality(mesh, hollow, there, best + gain);
      if (q <= best + gain)
        continue;
      best = q;
      memcpy(p, there, sizeof there);
      last = w;
      tries = -1; // on in the same direction
      w = (w + 13) % 14;
    }
  }
  return best;
}

static CwStatus smooth(CwTetMesh *mesh, int32_t point, int *done_it) {
  CwStatus status = CW_OK;
  int32_t star[CW_CAVITY];
  Hollow hollow;
  double p[3], least = INFINITY;
  *done_it = 0;
  int n = cw_tet_mesh_star(mesh, point, star);
  if (n == 0)
    goto done;
  hollow.count = n;
  for (int k = 0; k < n; k++) {
    const int32_t *c = mesh->corner[star[k]];
    int at = c[0] == point ? 0 : c[1] == point ? 1 : c[2] == point ? 2 : 3;
    // Inward: (face, point) positive.
    for (int i = 0; i < 3; i++)
      hollow.face[k][i] = c[tet_face[at][2 - i]];
    least = fmin(least, mesh->quality[star[k]]);
  }
  memcpy(p, mesh->x[point], sizeof p);
  if (!(best_place(mesh, &hollow, p, least) > least + gain))
    goto done;
  memcpy(mesh->x[point], p, sizeof p);
  for (int k = 0; k < n; k++) {
    const int32_t *c = mesh->corner[star[k]];
    mesh->quality[star[k]] = quality_of(mesh, c[0], c[1], c[2], c[3]);
  }
  *done_it = 1;
done:
  return status;
}

// A new point on an inner edge of t, moved to its best place. Flat tetrahedra with all corners on the
// boundary, which no flip and no smoothing can raise, are cut from below this way.
static CwStatus split_edge(CwTetMesh *mesh, int32_t t, int i, int j, int *done_it) {
  CwStatus status = CW_OK;
  enum { MOST = 16 };
  int32_t old[MOST], ring[MOST], tet[2 * MOST][4], point, a = mesh->corner[t][i], b = mesh->corner[t][j];
  double quality[2 * MOST], p[3], least = INFINITY;
  Hollow hollow;
  *done_it = 0;
  int n = cw_tet_mesh_ring(mesh, t, i, j, MOST, old, ring);
  if (n < 3)
    goto done;
  hollow.count = 2 * n;
  for (int k = 0; k < n; k++) {
    least = fmin(least, mesh->quality[old[k]]);
    // (a, b, r, s) is positive; so are (a, p, r, s) and (p, b, r, s) for p between a and b.
    const int32_t r = ring[k], s = ring[(k + 1) % n], one[3] = {a, r, s}, two[3] = {b, s, r};
    memcpy(hollow.face[2 * k], one, sizeof one);
    memcpy(hollow.face[2 * k + 1], two, sizeof two);
  }
  for (int k = 0; k < 3; k++)
    p[k] = 0.5 * (mesh->x[a][k] + mesh->x[b][k]);
  double best = best_place(mesh, &hollow, p, hollow_quality(mesh, &hollow, p, -2.0));
  if (!(best > least + 0.02))
    goto done;
  CW_TRY(cw_tet_mesh_add_point(mesh, p, &point));
  for (int k = 0; k < hollow.count; k++) {
    memcpy(tet[k], hollow.face[k], sizeof hollow.face[k]);
    tet[k][3] = point;
    quality[k] = quality_of(mesh, tet[k][0], tet[k][1], tet[k][2], point);
  }
  CW_TRY(cw_tet_mesh_replace(mesh, n, old, hollow.count, (const int32_t(*)[4])tet, quality));
  *done_it = 1;
done:
  return status;
}

// One try at a tetrahedron: the first change that helps.
static CwStatus improve_one(CwTetMesh *mesh, int32_t t, int insert, CwTetImproved *count, int *done_it) {
  CwStatus status = CW_OK;
  for (int e = 0; e < 6; e++) {
    CW_TRY(remove_edge(mesh, t, tet_edge[e][0], tet_edge[e][1], done_it));
    if (*done_it) {
      count->edges_removed++;
      goto done;
    }
  }
  for (int i = 0; i < 4; i++) {
    CW_TRY(remove_face(mesh, t, i, done_it));
    if (*done_it) {
      count->faces_removed++;
      goto done;
    }
  }
  for (int i = 0; i < 4; i++) {
    int moved;
    CW_TRY(smooth(mesh, mesh->corner[t][i], &moved));
    count->points_moved += moved;
    *done_it |= moved;
  }
  if (*done_it || !insert || mesh->quality[t] >= limit_insert)
    goto done;
  for (int e = 0; e < 6; e++) {
    CW_TRY(split_edge(mesh, t, tet_edge[e][0], tet_edge[e][1], done_it));
    if (*done_it) {
      count->points_added++;
      goto done;
    }
  }
done:
  return status;
}

static double least_quality(const CwTetMesh *mesh) {
  double least = INFINITY;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    if (mesh->corner[t][0] >= 0)
      least = fmin(least, mesh->quality[t]);
  }
  return least;
}

CwStatus cw_tet_improve(int32_t fixed_count, CwFill *fill, CwTetImproved *improved) {
  CwStatus status = CW_OK;
  CwTetMesh mesh;
  CwTetImproved count = {0};
  CW_TRY(cw_tet_mesh_make(fixed_count, fill->point_count, fill->x, fill->tetrahedron_count, fill->tetrahedron,
                          &mesh));
  count.least_before = least_quality(&mesh);
  for (int pass = 0; pass < PASSES; pass++) {
    int changes = 0;
    for (int32_t t = 0; t < mesh.tet_count; t++) {
      // A change leaves other tetrahedra in this place: go on with them a few times.
      for (int again = 0; again < 4; again++) {
        int done_it = 0;
        if (mesh.corner[t][0] < 0 || mesh.quality[t] >= limit_improve)
          break;
        CW_TRY(improve_one(&mesh, t, pass >= 1, &count, &done_it));
        if (!done_it)
          break;
        changes++;
      }
    }
    if (changes == 0)
      break;
  }
  count.least_after = least_quality(&mesh);
  CW_TRY(cw_tet_mesh_squeeze(&mesh));
  if (improved)
    *improved = count;
done:
  // Arrays may have moved, and counts changed, also on failure.
  fill->x = mesh.x;
  fill->point_count = mesh.point_count;
  fill->tetrahedron = mesh.corner;
  fill->tetrahedron_count = mesh.tet_count;
  cw_tet_mesh_free(&mesh);
  return status;
}
