// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/surface/cdt.h"
#include "mesher/surface/patch_delaunay.h"
#include "mesher/surface/patch_front.h"
#include "mesher/surface/patch_improve.h"
#include "mesher/surface/patch_work.h"

// Scales that make the parameter plane roughly isometric: mean |xu| and |xv| over the given points.
static void find_scale(const CwPatchInput *input, double scale[2]) {
  scale[0] = scale[1] = 0;
  for (int32_t p = 0; p < input->point_count; p++) {
    double x[3], d[2][3];
    input->surface(input->surface_context, input->uv[p], x, d[0], d[1]);
    for (int k = 0; k < 2; k++) scale[k] += cw_norm(d[k]) / input->point_count;
  }
}

// Copies what is alive; the given points keep their numbers, the others follow in the order they were made.
static CwStatus take_result(const CwPatchWork *work, int32_t component_count, CwPatchMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t *number = NULL;
  CW_NEW(number, work->point_count);
  for (int32_t p = 0; p < work->point_count; p++)
    number[p] = p < work->given_count || work->point_triangle[p] >= 0 ? mesh->point_count++ : -1;
  for (int32_t t = 0; t < work->triangle_count; t++) mesh->triangle_count += work->corner[t][0] >= 0;
  CW_NEW(mesh->uv, mesh->point_count);
  CW_NEW(mesh->x, mesh->point_count);
  CW_NEW(mesh->triangle, mesh->triangle_count);
  CW_NEW(mesh->component, mesh->triangle_count);
  mesh->component_count = component_count;
  for (int32_t p = 0; p < work->point_count; p++)
    if (number[p] >= 0) {
      memcpy(mesh->uv[number[p]], work->uv[p], sizeof work->uv[p]);
      memcpy(mesh->x[number[p]], work->x[p], sizeof work->x[p]);
    }
  for (int32_t t = 0, n = 0; t < work->triangle_count; t++) {
    const int32_t *c = work->corner[t];
    if (c[0] < 0) continue;
    for (int i = 0; i < 3; i++) mesh->triangle[n][i] = number[c[i]];
    mesh->component[n] = work->component[t];
    n++;
  }
done:
  free(number);
  return status;
}

CwStatus cw_patch_mesh(const CwPatchInput *input, CwPatchMesh *mesh, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwCdt cdt = {0};
  CwPatchWork work = {0};
  double scale[2];
  *mesh = (CwPatchMesh){0};
  CW_REQUIRE(input->point_count >= 3 && input->edge_count >= 3, CW_ERR_MESH,
             "patch %s: %d points and %d edges bound nothing: at least 3 of each are needed", input->name,
             input->point_count, input->edge_count);
  find_scale(input, scale);
  CW_TRY_STAGE(cw_cdt_make(input, scale, &cdt, outcome), outcome);
  CW_TRY(cw_patch_work_open(input, &cdt, &work));
  cw_patch_delaunay(&work, 0);
  CW_TRY(cw_patch_divide_noses(&work));
  CW_TRY(cw_patch_front(&work));
  CW_TRY(cw_patch_improve(&work));
  CW_TRY(take_result(&work, cdt.component_count, mesh));
done:
  cw_patch_work_close(&work);
  cw_cdt_free(&cdt);
  if (status != CW_OK) cw_patch_mesh_free(mesh);
  return status;
}

void cw_patch_mesh_free(CwPatchMesh *mesh) {
  free(mesh->uv);
  free(mesh->x);
  free(mesh->triangle);
  free(mesh->component);
  *mesh = (CwPatchMesh){0};
}
