// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_insert.h"

#include <math.h>
#include <string.h>

#include "mesher/fill/tet_cavity.h"
#include "mesher/policy.h"

enum { MOST_CLEARED = 64, SIDES = CW_CAVITY, AGAIN = 3, SHELLS = 5, AIMS = 3, PLACES = 4 * 3 + 1 + 6 + 14 * SHELLS };

// Tetrahedra to be taken away, and the faces of their hull, as 4 * tetrahedron + face.
typedef struct {
  int count, side_count;
  int32_t tet[MOST_CLEARED], side[SIDES];
} Cleared;

// Of the faces that a cavity was grown over the best quality, and of those that it was not the least: for all
// thresholds from the first up to below the second it grows alike.
typedef struct {
  double crossed, kept;
} Grown;

static double side_quality(const CwTetWork *w, int32_t side, const double p[3]) {
  int32_t c[3];
  cw_cavity_face(&w->mesh->tet[side / 4], side % 4, c);
  return cw_tet_quality(cw_tet_at(w, c[0]), cw_tet_at(w, c[1]), cw_tet_at(w, c[2]), p);
}

// Grows the cavity from t over every face that would make a tetrahedron with p no better than `enough`.
// 0 where it meets the boundary or becomes too large.
static int grow(CwTetWork *w, int32_t t, const double p[3], double enough, Cleared *cleared, Grown *grown) {
  CwTetMesh *mesh = w->mesh;
  int32_t open[4 * MOST_CLEARED];
  int opened = 0, kept = 0;
  mesh->stars++;
  mesh->tet[t].star = mesh->stars;
  cleared->tet[0] = t;
  cleared->count = 1;
  cleared->side_count = 0;
  *grown = (Grown){-INFINITY, INFINITY};
  for (int i = 0; i < 4; i++) open[opened++] = 4 * t + i;
  for (int head = 0; head < opened; head++) {
    int32_t side = open[head], other = mesh->tet[side / 4].neighbour[side % 4];
    if (other >= 0 && mesh->tet[other / 4].star == mesh->stars) continue;
    double quality = side_quality(w, side, p);
    if (quality > enough) {
      open[kept++] = side; // never ahead of head
      grown->kept = fmin(grown->kept, quality);
      continue;
    }
    grown->crossed = fmax(grown->crossed, quality);
    if (other < 0 || cleared->count == MOST_CLEARED) return 0;
    mesh->tet[other / 4].star = mesh->stars;
    cleared->tet[cleared->count++] = other / 4;
    for (int i = 0; i < 4; i++) {
      if (i != other % 4) open[opened++] = other / 4 * 4 + i;
    }
  }
  for (int k = 0; k < kept; k++) {
    int32_t other = mesh->tet[open[k] / 4].neighbour[open[k] % 4];
    if (other >= 0 && mesh->tet[other / 4].star == mesh->stars) continue; // what lies behind was taken later
    if (cleared->side_count == SIDES) return 0;
    cleared->side[cleared->side_count++] = open[k];
  }
  return 1;
}

// Whether the tetrahedra from p to the hull fill the cavity, once.
static int is_filled(const CwTetWork *w, const Cleared *cleared, const double p[3]) {
  double old = 0.0, made = 0.0;
  for (int k = 0; k < cleared->count; k++) {
    const int32_t *c = w->mesh->tet[cleared->tet[k]].corner;
    old += cw_tet_volume6(cw_tet_at(w, c[0]), cw_tet_at(w, c[1]), cw_tet_at(w, c[2]), cw_tet_at(w, c[3]));
  }
  for (int k = 0; k < cleared->side_count; k++) {
    int32_t c[3];
    cw_cavity_face(&w->mesh->tet[cleared->side[k] / 4], cleared->side[k] % 4, c);
    made += cw_tet_volume6(cw_tet_at(w, c[0]), cw_tet_at(w, c[1]), cw_tet_at(w, c[2]), p);
  }
  return fabs(made - old) <= 1e-9 * old;
}

// Places to try: over each boundary face, the middles of the tetrahedron, of its faces and of its edges. Round a bad
// one those in 14 directions too, on shells to the length of its mean edge.
static int candidates(const CwTetWork *w, int32_t t, double place[][3]) {
  const CwTet *tet = &w->mesh->tet[t];
  const double *x[4];
  int count = 0;
  for (int i = 0; i < 4; i++) x[i] = cw_tet_at(w, tet->corner[i]);
  for (int f = 0; f < 4; f++) {
    const double *a = x[cw_tet_face[f][0]], *b = x[cw_tet_face[f][1]], *c = x[cw_tet_face[f][2]];
    double normal[3];
    cw_normal(a, b, c, normal);
    double square = cw_dot(normal, normal);
    // The height of the regular tetrahedron on a face of the same area, sqrt(2/3) (4/sqrt(3) A)^(1/2).
    double height = tet->neighbour[f] < 0 ? -0.8774 * sqrt(sqrt(square)) / sqrt(square) : 0.0;
    for (int step = 1; step <= (height < 0.0 ? 3 : 1); step++, count++) {
      for (int i = 0; i < 3; i++) place[count][i] = (a[i] + b[i] + c[i]) / 3.0 + step / 3.0 * height * normal[i];
    }
  }
  for (int i = 0; i < 3; i++) place[count][i] = 0.25 * (x[0][i] + x[1][i] + x[2][i] + x[3][i]);
  count++;
  for (int e = 0; e < 6; e++, count++) {
    for (int i = 0; i < 3; i++) place[count][i] = 0.5 * (x[cw_tet_edge[e][0]][i] + x[cw_tet_edge[e][1]][i]);
  }
  if (tet->quality >= w->insert_round) return count;
  CwTetMeasures m = cw_tet_measures(x[0], x[1], x[2], x[3]);
  double edge = cw_tet_mean_edge(&m);
  for (int k = 0; k < 14 * SHELLS; k++, count++) {
    const double *direction = cw_tet_direction[k % 14];
    double radius = edge * (double)(k / 14 + 1) / SHELLS;
    for (int i = 0; i < 3; i++)
      place[count][i] = 0.25 * (x[0][i] + x[1][i] + x[2][i] + x[3][i]) + radius * direction[i];
  }
  return count;
}

// The star from p to the hull of a cavity.
static void make_cavity(const CwTetWork *w, const Cleared *cleared, CwCavity *cavity) {
  cavity->count = cleared->side_count;
  for (int s = 0; s < cleared->side_count; s++) {
    int32_t corner[3];
    cw_cavity_face(&w->mesh->tet[cleared->side[s] / 4], cleared->side[s] % 4, corner);
    for (int k = 0; k < 3; k++) cavity->face[s][k] = cw_tet_at(w, corner[k]);
  }
}

// Grows the cavity for a point at p and moves the point to its best place there, in turn, while this gains. Returns the
// best quality, of the cavity and place in *chosen and p; `best`, and leaves these alone, where there is no better one.
// *first tells of the cavity of the place itself.
static double best_from(CwTetWork *w, int32_t t, const double place[3], double aim, double best, Cleared *chosen,
                        double p[3], Grown *first) {
  Cleared cleared;
  Grown later;
  CwCavity cavity;
  double there[3];
  memcpy(there, place, sizeof there);
  for (int again = 0; again < AGAIN; again++) {
    if (!grow(w, t, there, fmax(aim, best), &cleared, again ? &later : first) || !is_filled(w, &cleared, there)) break;
    make_cavity(w, &cleared, &cavity);
    double got = cw_cavity_best(&cavity, there, cw_cavity_quality(&cavity, there, -2.0));
    if (got <= best) break;
    best = got;
    *chosen = cleared;
    memcpy(p, there, sizeof there);
  }
  return best;
}

// Puts the star from a new point at p into the cavity.
static CwStatus fill_cavity(CwTetWork *w, const Cleared *cleared, const double p[3]) {
  CwStatus status = CW_OK;
  double quality[SIDES];
  int32_t corner[SIDES][4], point;
  CW_TRY(cw_tet_mesh_add_point(w->mesh, p, w->source_count++, &point));
  for (int s = 0; s < cleared->side_count; s++) {
    cw_cavity_face(&w->mesh->tet[cleared->side[s] / 4], cleared->side[s] % 4, corner[s]);
    corner[s][3] = point;
    quality[s] = cw_tet_quality_of(w, corner[s][0], corner[s][1], corner[s][2], point);
  }
  CW_TRY(cw_tet_replace(w, cleared->count, cleared->tet, cleared->side_count, (const int32_t(*)[4])corner, quality));
done:
  return status;
}

CwStatus cw_tet_insert_at(CwTetWork *w, int32_t t, const double place[3], double aim, double least) {
  Cleared chosen = {0};
  Grown grown;
  double p[3];
  return best_from(w, t, place, aim, least, &chosen, p, &grown) > least ? fill_cavity(w, &chosen, p) : CW_OK;
}

CwStatus cw_tet_insert(CwTetWork *w, int32_t t, int *done_it) {
  CwStatus status = CW_OK;
  double place[PLACES][3], least = w->mesh->tet[t].quality + cw_policy.least_gain, best = least, p[3];
  int tries = candidates(w, t, place);
  Cleared chosen = {0};
  Grown grown[PLACES];
  *done_it = 0;
  for (int a = AIMS; a >= 0; a--) { // thresholds for the growth of a cavity, the highest first
    double aim = cw_policy.improve_below * a / AIMS;
    for (int k = 0; k < tries; k++) {
      double enough = fmax(aim, best);
      if (a == AIMS || enough < grown[k].crossed || enough >= grown[k].kept) // else it would end as before
        best = best_from(w, t, place[k], aim, best, &chosen, p, &grown[k]);
    }
  }
  if (best <= least) goto done;
  CW_TRY(fill_cavity(w, &chosen, p));
  w->count.points_added++;
  *done_it = 1;
done:
  return status;
}
