// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_improve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fill/tet_mesh.h"
#include "mesher/fill/tet_work.h"

static const double insert_limit = 0.4226, round_limit = 0.38;
// Shares of slender tetrahedra above which their shapes are worth more time, and above which points stand too close.
static const double needy = 0.16, crowded = 0.235;
// Quality that may be left by what is done for the aspect: flips follow, and mend nearly all of it.
static const double loose = 0.05;
static const CwTetMoves spread = {.centres = 1}, first_moves = {.centres = 1, .evenings = 1, .pull = 0.5};
static const CwTetMoves only_moves = {.centres = 1, .evenings = 1, .pull = 0.14, .beside = 3},
                        last_moves = {.evenings = 5, .pull = 0.22, .beside = 2};
static const CwTetMoves first_crowded = {.centres = 1, .evenings = 3, .pull = 0.5},
                        last_crowded = {.evenings = 4, .pull = 0.22, .beside = 2};
// The sine of 21 degrees: what a crowded region's tetrahedra are improved to from then on. The last few degrees, which
// its boundary keeps many from, would be bought with aspects.
static const double crowded_limit = 0.3584;
enum { PASSES = 5 };

const int8_t cw_tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
const int8_t cw_tet_edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// What only relaxing needs; the search that comes after it asks for memory of its own.
static void free_shapes(CwTetWork *w) {
  free(w->slender.tet);
  free(w->place);
  free(w->irregular);
  w->slender = (CwTetList){0};
  w->place = NULL;
  w->place_space = 0;
  w->irregular = NULL;
}

void cw_tet_work_free(CwTetWork *w) {
  free(w->bad);
  free(w->next);
  free_shapes(w);
}

CwStatus cw_tet_push(CwTetWork *w, int32_t t) {
  CwStatus status = CW_OK;
  if (w->mesh->tet[t].pass == w->pass) goto done;
  w->mesh->tet[t].pass = w->pass & CW_TET_NO_PASS;
  CW_GROW(w->next, w->next_space, w->next_count + 1);
  w->next[w->next_count++] = t;
done:
  return status;
}

CwStatus cw_tet_set_quality(CwTetWork *w, int32_t t, double quality) {
  CwStatus status = CW_OK;
  CwDelaunayTet *tet = &w->mesh->tet[t];
  tet->quality = quality;
  for (int i = 0; i < 4; i++) w->mesh->point[tet->corner[i]].mark = w->pass;
  if (w->irregular) { // it may be slender now
    CW_GROW(w->slender.tet, w->slender.space, w->slender.count + 1);
    w->slender.tet[w->slender.count++] = t;
  }
  if (quality < w->limit) CW_TRY(cw_tet_push(w, t));
done:
  return status;
}

CwStatus cw_tet_replace(CwTetWork *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                        const double *quality) {
  CwStatus status = CW_OK;
  int32_t slot[CW_FLIP];
  CW_TRY(cw_flips_replace(&w->flips, old_count, old, count, corner, slot));
  for (int k = 0; k < count; k++) CW_TRY(cw_tet_set_quality(w, slot[k], quality[k]));
done:
  return status;
}

CwStatus cw_tet_replace_sound(CwTetWork *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                              double least, int32_t *replaced) {
  CwStatus status = CW_OK;
  double quality[CW_FLIP];
  for (int k = 0; k < count; k++) {
    quality[k] = cw_tet_quality_of(w, corner[k][0], corner[k][1], corner[k][2], corner[k][3]);
    if (!(quality[k] > 0.0 && quality[k] >= least)) goto done;
  }
  CW_TRY(cw_tet_replace(w, old_count, old, count, corner, quality));
  ++*replaced;
done:
  return status;
}

// One try at a tetrahedron: the first change that helps.
static CwStatus improve_one(CwTetWork *w, int32_t t, int move, int insert, int *done_it) {
  CwStatus status = CW_OK;
  int32_t c[4];
  int order[6];
  memcpy(c, w->mesh->tet[t].corner, sizeof c);
  *done_it = 0;
  CwTetMeasures m = cw_tet_measures(cw_tet_at(w, c[0]), cw_tet_at(w, c[1]), cw_tet_at(w, c[2]), cw_tet_at(w, c[3]));
  for (int e = 0; e < 6; e++) { // longest first: the diagonals of a flat one
    int k = e;
    for (; k > 0 && m.edge[order[k - 1]] < m.edge[e]; k--) order[k] = order[k - 1];
    order[k] = e;
  }
  for (int e = 0; e < 6 && !*done_it; e++)
    CW_TRY(cw_tet_remove_edge(w, t, c[cw_tet_edge[order[e]][0]], c[cw_tet_edge[order[e]][1]], done_it));
  for (int i = 0; i < 4 && !*done_it; i++) CW_TRY(cw_tet_remove_face(w, t, i, done_it));
  for (int i = 0; i < 4 && move && !*done_it; i++) CW_TRY(cw_tet_smooth(w, t, c[i], done_it));
  if (insert && !*done_it && w->mesh->tet[t].quality < w->insert) CW_TRY(cw_tet_insert(w, t, done_it));
done:
  return status;
}

static int has_changed(const CwTetWork *w, int32_t t) {
  for (int i = 0; i < 4; i++) {
    if (w->mesh->point[w->mesh->tet[t].corner[i]].mark + 1 >= w->pass) return 1;
  }
  return 0;
}

CwStatus cw_tet_improve_list(CwTetWork *w, int passes, int move) {
  CwStatus status = CW_OK;
  for (int pass = 0; pass < passes && w->next_count; pass++) {
    int32_t *swap = w->bad, space = w->bad_space, changes = 0;
    w->pass++;
    w->bad = w->next, w->bad_count = w->next_count, w->bad_space = w->next_space;
    w->next = swap, w->next_count = 0, w->next_space = space;
    for (int32_t k = 0; k < w->bad_count; k++) {
      int32_t t = w->bad[k];
      int done_it = 0;
      cw_tet_ask_ahead(w, w->bad, w->bad_count, k);
      if (w->mesh->tet[t].corner[0] < 0 || w->mesh->tet[t].quality >= w->limit) continue;
      if (pass <= 1 || has_changed(w, t)) CW_TRY(improve_one(w, t, move, pass >= 1, &done_it));
      changes += done_it;
      if (!done_it) CW_TRY(cw_tet_push(w, t));
    }
    if (changes == 0 && pass >= 1) break;
  }
done:
  return status;
}

// All below the limit are in the list.
static double least_quality(const CwTetWork *w) {
  double least = CW_TET_IMPROVE;
  for (int32_t k = 0; k < w->next_count; k++) {
    const CwDelaunayTet *tet = &w->mesh->tet[w->next[k]];
    if (tet->corner[0] >= 0) least = cw_tet_less(least, tet->quality);
  }
  return least;
}

// Moves points and takes away edges, and points where very many tetrahedra are slender, for the mean ratio of edges.
// *is_needy: whether more of this is worth its time. Further rounds are not: a second one has 8 % of the cost of
// the fill for 0.006 of the mean ratio.
static CwStatus even_out(CwTetWork *w, int *is_needy) {
  CwStatus status = CW_OK;
  w->floor = loose;
  CW_TRY(cw_tet_relax(w, spread));
  *is_needy = w->slender.count > needy * w->tet_count;
  int is_crowded = w->slender.count > crowded * w->tet_count;
  if (is_crowded) CW_TRY(cw_tet_collapse(w));
  w->is_crowded = is_crowded;
  if (is_crowded) w->limit = crowded_limit;
  CW_TRY(cw_tet_shorten(w));
  CW_TRY(cw_tet_relax(w, is_crowded ? first_crowded : *is_needy ? first_moves : only_moves));
done:
  return status;
}

// Flips and moves of single points for the angles make tetrahedra slender again; here nothing is left worse that would
// have to be improved again.
static CwStatus even_out_again(CwTetWork *w) {
  CwStatus status = CW_OK;
  w->floor = w->limit;
  CW_GROW(w->irregular, w->irregular_space, w->mesh->point_count);
  memset(w->irregular, 1, (size_t)w->mesh->point_count);
  CW_TRY(cw_tet_shorten(w));
  CW_TRY(cw_tet_relax(w, w->is_crowded ? last_crowded : last_moves));
done:
  return status;
}

CwStatus cw_tet_improve_mesh(CwDelaunay *mesh, int32_t fixed_count, const uint8_t *on_plane, int32_t *source_count,
                             CwTetImproved *improved) {
  CwStatus status = CW_OK;
  CwTetWork w = {.flips = {.mesh = mesh},
                 .mesh = mesh,
                 .fixed_count = fixed_count,
                 .on_plane = on_plane,
                 .source_count = *source_count,
                 .limit = CW_TET_IMPROVE,
                 .insert = insert_limit,
                 .insert_round = round_limit};
  int is_needy = 0;
  CW_NEW(w.irregular, mesh->point_count);
  w.irregular_space = mesh->point_count;
  CW_TRY(cw_tet_scan(&w));
  w.count.least_before = least_quality(&w);
  CW_TRY(cw_tet_improve_list(&w, 1, 0));
  CW_TRY(even_out(&w, &is_needy));
  CW_TRY(cw_tet_improve_list(&w, PASSES, 1));
  if (is_needy) CW_TRY(even_out_again(&w));
  free_shapes(&w);
  if (fixed_count < *source_count) CW_TRY(cw_tet_search(&w));
  w.count.least_after = least_quality(&w);
  *source_count = w.source_count;
  if (improved) *improved = w.count;
done:
  cw_tet_work_free(&w);
  return status;
}

CwStatus cw_tet_improve(int32_t fixed_count, const uint8_t *on_plane, CwFill *fill, CwTetImproved *improved) {
  CwStatus status = CW_OK;
  CwDelaunay mesh;
  int32_t count = fill->point_count;
  status = cw_tet_mesh_make(fill, &mesh);
  cw_fill_free(fill);
  CW_TRY(status);
  CW_TRY(cw_tet_improve_mesh(&mesh, fixed_count, on_plane, &count, improved));
  CW_TRY(cw_tet_mesh_take(&mesh, fixed_count, count, fill));
done:
  cw_delaunay_free(&mesh);
  if (status != CW_OK) cw_fill_free(fill);
  return status;
}
