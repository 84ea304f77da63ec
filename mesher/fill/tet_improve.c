// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_improve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/fill/fill_mesh.h"
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

// Moves points and takes away edges for the mean ratio of edges.
static CwStatus even_out(CwTetWork *w, CwTetShapes *shapes) {
  CwStatus status = CW_OK;
  shapes->floor = cw_policy.sound_quality;
  CW_TRY(cw_tet_relax(w, shapes, CW_TET_CENTRES));
  CW_TRY(cw_tet_shorten(w, shapes));
  CW_TRY(cw_tet_relax(w, shapes, CW_TET_CENTRES | CW_TET_EDGES));
done:
  return status;
}

// Flips and moves of single points for the angles make tetrahedra slender again; here nothing is left worse that would
// have to be improved again.
static CwStatus even_out_again(CwTetWork *w, CwTetShapes *shapes) {
  CwStatus status = CW_OK;
  shapes->floor = w->limit;
  CW_GROW(shapes->irregular, shapes->irregular_capacity, w->mesh->point_count);
  memset(shapes->irregular, 1, (size_t)w->mesh->point_count);
  CW_TRY(cw_tet_shorten(w, shapes));
  CW_TRY(cw_tet_relax(w, shapes, CW_TET_EDGES));
done:
  return status;
}

CwStatus cw_tet_improve_mesh(CwTetMesh *mesh, int32_t fixed_count, int32_t *source_count, CwTetChanges *changes) {
  CwStatus status = CW_OK;
  CwTetShapes shapes = {0};
  CwTetWork w = {.mesh = mesh,
                 .fixed_count = fixed_count,
                 .source_count = *source_count,
                 .limit = cw_policy.improve_below,
                 .insert = cw_policy.improve_below,
                 .insert_round = sin(cw_policy.wanted_angle * CW_DEGREE),
                 .changed = &shapes.slender};
  CW_NEW(shapes.irregular, mesh->point_count);
  shapes.irregular_capacity = mesh->point_count;
  CW_TRY(cw_tet_judge_all(&w, &shapes));
  w.count.least_before = least_quality(&w);
  CW_TRY(cw_tet_improve_list(&w, 1, 0));
  CW_TRY(even_out(&w, &shapes));
  CW_TRY(cw_tet_improve_list(&w, cw_policy.improve_passes, 1));
  CW_TRY(even_out_again(&w, &shapes));
  w.changed = NULL;
  cw_tet_shapes_free(&shapes); // the search asks for memory of its own
  if (fixed_count < *source_count) CW_TRY(cw_tet_search(&w));
  w.count.least_after = least_quality(&w);
  *source_count = w.source_count;
  *changes = w.count;
done:
  cw_tet_shapes_free(&shapes);
  cw_tet_work_free(&w);
  return status;
}

CwStatus cw_tet_improve(int32_t fixed_count, CwFill *fill, CwTetChanges *changes) {
  CwStatus status = CW_OK;
  CwTetMesh mesh;
  int32_t count = fill->point_count;
  status = cw_fill_to_mesh(fill, &mesh);
  cw_fill_free(fill);
  CW_TRY(status);
  CW_TRY(cw_tet_improve_mesh(&mesh, fixed_count, &count, changes));
  CW_TRY(cw_fill_from_mesh(&mesh, fixed_count, count, fill));
done:
  cw_tet_mesh_free(&mesh);
  if (status != CW_OK) cw_fill_free(fill);
  return status;
}
