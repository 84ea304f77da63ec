// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_improve.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/fill/fill_mesh.h"
#include "mesher/fill/tet_collapse.h"
#include "mesher/fill/tet_loop.h"
#include "mesher/fill/tet_relax.h"
#include "mesher/fill/tet_search.h"
#include "mesher/fill/tet_shorten.h"
#include "mesher/policy.h"

// All below the limit are in the list.
static double least_quality(const CwTetWork *w) {
  double least = cw_policy.improve_below;
  for (int32_t k = 0; k < w->next.count; k++) {
    const CwTet *tet = &w->mesh->tet[w->next.tet[k]];
    if (tet->corner[0] >= 0) least = cw_lesser(least, tet->quality);
  }
  return least;
}

// Moves points and takes away edges, and points where very many tetrahedra are slender, for the mean ratio of edges.
// *again: whether more of this is worth its time. Further rounds are not: a second one has 8 % of the cost of the fill
// for 0.006 of the mean ratio.
static CwStatus even_out(CwTetWork *w, CwTetShapes *shapes, int *again) {
  CwStatus status = CW_OK;
  const CwPolicy *p = &cw_policy;
  shapes->floor = p->aspect_floor;
  CW_TRY(cw_tet_relax(w, shapes, (CwTetMoves){.centres = 1}));
  *again = shapes->slender.count > p->even_share * shapes->tet_count;
  if (shapes->slender.count > p->many_slender_share * shapes->tet_count) {
    CW_TRY(cw_tet_collapse(w, shapes));
    shapes->many_slender = 1;
    w->limit = p->improve_below_many_slender;
  }
  CW_TRY(cw_tet_shorten(w, shapes));
  CwTetMoves moves = {.centres = 1, .evenings = 1, .pull = p->pull_only, .beside = p->steps_beside};
  if (*again)
    moves = (CwTetMoves){.centres = 1,
                         .evenings = shapes->many_slender ? p->steps_many_slender : p->steps_needed,
                         .pull = p->pull_needed};
  CW_TRY(cw_tet_relax(w, shapes, moves));
done:
  return status;
}

// Flips and moves of single points for the angles make tetrahedra slender again; here nothing is left worse that would
// have to be improved again.
static CwStatus even_out_again(CwTetWork *w, CwTetShapes *shapes) {
  CwStatus status = CW_OK;
  const CwPolicy *p = &cw_policy;
  const CwTetMoves moves = {.evenings = shapes->many_slender ? p->steps_last_many_slender : p->steps_last,
                            .pull = p->pull_last,
                            .beside = p->steps_last_beside};
  shapes->floor = w->limit;
  CW_GROW(shapes->irregular, shapes->irregular_space, w->mesh->point_count);
  memset(shapes->irregular, 1, (size_t)w->mesh->point_count);
  CW_TRY(cw_tet_shorten(w, shapes));
  CW_TRY(cw_tet_relax(w, shapes, moves));
done:
  return status;
}

CwStatus cw_tet_improve_mesh(CwTetMesh *mesh, int32_t fixed_count, const uint8_t *on_plane, int32_t *source_count,
                             CwTetChanges *changes) {
  CwStatus status = CW_OK;
  CwTetShapes shapes = {.on_plane = on_plane};
  CwTetWork w = {.mesh = mesh,
                 .fixed_count = fixed_count,
                 .source_count = *source_count,
                 .limit = cw_policy.improve_below,
                 .insert = cw_policy.insert_below,
                 .insert_round = cw_policy.insert_round_below,
                 .changed = &shapes.slender};
  int again = 0;
  CW_NEW(shapes.irregular, mesh->point_count);
  shapes.irregular_space = mesh->point_count;
  CW_TRY(cw_tet_judge_all(&w, &shapes));
  w.count.least_before = least_quality(&w);
  CW_TRY(cw_tet_improve_list(&w, 1, 0));
  CW_TRY(even_out(&w, &shapes, &again));
  CW_TRY(cw_tet_improve_list(&w, cw_policy.improve_passes, 1));
  if (again) CW_TRY(even_out_again(&w, &shapes));
  w.changed = NULL;
  cw_tet_shapes_free(&shapes); // the search asks for memory of its own
  if (fixed_count < *source_count) CW_TRY(cw_tet_search(&w));
  w.count.least_after = least_quality(&w);
  *source_count = w.source_count;
  if (changes) *changes = w.count;
done:
  cw_tet_shapes_free(&shapes);
  cw_tet_work_free(&w);
  return status;
}

CwStatus cw_tet_improve(int32_t fixed_count, const uint8_t *on_plane, CwFill *fill, CwTetChanges *changes) {
  CwStatus status = CW_OK;
  CwTetMesh mesh;
  int32_t count = fill->point_count;
  status = cw_fill_to_mesh(fill, &mesh);
  cw_fill_free(fill);
  CW_TRY(status);
  CW_TRY(cw_tet_improve_mesh(&mesh, fixed_count, on_plane, &count, changes));
  CW_TRY(cw_fill_from_mesh(&mesh, fixed_count, count, fill));
done:
  cw_tet_mesh_free(&mesh);
  if (status != CW_OK) cw_fill_free(fill);
  return status;
}
