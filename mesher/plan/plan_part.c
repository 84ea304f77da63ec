// SPDX-License-Identifier: AGPL-3.0-or-later
// Cells of the tree: what of the model lies in them.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/plan/plan_model.h"

static double polygon_area(int32_t corners, const double (*corner)[3]) {
  double sum[3] = {0, 0, 0};
  for (int32_t i = 2; i < corners; i++) {
    double n[3];
    cw_normal(corner[0], corner[i - 1], corner[i], n);
    for (int k = 0; k < 3; k++) sum[k] += n[k];
  }
  return cw_norm(sum) / 2;
}

static CwStatus pieces_new(CwPieces *pieces, int32_t count, size_t corners) {
  CwStatus status = CW_OK;
  CW_NEW_UNSET(pieces->start, (size_t)count + 1);
  CW_NEW_UNSET(pieces->triangle, count);
  CW_NEW_UNSET(pieces->work, count);
  CW_NEW_UNSET(pieces->corner, corners);
  pieces->start[0] = 0;
done:
  return status;
}

static void piece_add(const CwPlanModel *model, CwPieces *pieces, int32_t triangle, int corners,
                      const double (*corner)[3]) {
  int32_t used = pieces->start[pieces->count];
  pieces->triangle[pieces->count] = triangle;
  pieces->work[pieces->count] = model->triangle[triangle].density * polygon_area(corners, corner);
  memcpy(pieces->corner + used, corner, (size_t)corners * sizeof *corner);
  pieces->start[++pieces->count] = used + corners;
}

// Sutherland and Hodgman for all pieces: the part on the negative side of the plane.
static CwStatus pieces_clip(const CwPlanModel *model, const CwPieces *pieces, const CwPlane *plane, CwPieces *kept) {
  CwStatus status = CW_OK;
  // A plane adds at most one corner to a convex piece.
  CW_TRY(pieces_new(kept, pieces->count, (size_t)pieces->start[pieces->count] + (size_t)pieces->count));
  for (int32_t i = 0; i < pieces->count; i++) {
    int32_t first = pieces->start[i], corners = pieces->start[i + 1] - first;
    double clipped[CW_CLIP_MAX][3];
    CW_REQUIRE(corners < CW_CLIP_MAX, CW_ERR_MESH, "a surface triangle was cut into more than %d corners", CW_CLIP_MAX);
    int left = cw_clip_polygon(plane, corners, (const double(*)[3])(pieces->corner + first), clipped);
    if (left) piece_add(model, kept, pieces->triangle[i], left, (const double(*)[3])clipped);
  }
done:
  return status;
}

// Sums and box, once the lists are made.
static void part_measure(const CwPlanModel *model, CwPlanPart *part) {
  part->work = part->volume = 0;
  part->box = cw_box_empty();
  for (int32_t i = 0; i < part->sample_count; i++) {
    int32_t s = part->sample[i];
    part->work += model->sample[s].work;
    part->volume += model->sample[s].volume;
    cw_box_add_point(&part->box, model->sample[s].x);
  }
  for (int32_t i = 0; i < part->pieces.count; i++) part->work += part->pieces.work[i];
}

CwStatus cw_plan_part_whole(const CwPlanModel *model, CwPlanPart *part) {
  CwStatus status = CW_OK;
  const CwBackground *background = model->background;
  memset(part, 0, sizeof *part);
  CW_TRY(pieces_new(&part->pieces, background->triangle_count, 3 * (size_t)background->triangle_count));
  for (int32_t t = 0; t < background->triangle_count; t++) {
    double corner[3][3];
    if (!model->wall[t]) continue; // planes may meet open patches as they like
    for (int k = 0; k < 3; k++) cw_copy(background->x[background->triangle[t][k]], corner[k]);
    piece_add(model, &part->pieces, t, 3, (const double(*)[3])corner);
  }
  CW_NEW_UNSET(part->sample, model->sample_count);
  part->sample_count = model->sample_count;
  for (int32_t i = 0; i < model->sample_count; i++) part->sample[i] = i;
  CW_NEW_UNSET(part->edge, model->edge_count);
  part->edge_count = model->edge_count;
  for (int32_t i = 0; i < model->edge_count; i++) part->edge[i] = i;
  part_measure(model, part);
done:
  if (status != CW_OK) cw_plan_part_free(part);
  return status;
}

CwStatus cw_plan_part_clip(const CwPlanModel *model, const CwPlanPart *whole, const CwPlane *plane, int other,
                           CwPlanPart *part) {
  CwStatus status = CW_OK;
  CwPlane side = other ? cw_plane_flipped(plane) : *plane;
  memset(part, 0, sizeof *part);
  CW_TRY(pieces_clip(model, &whole->pieces, &side, &part->pieces));
  CW_NEW_UNSET(part->sample, whole->sample_count);
  for (int32_t i = 0; i < whole->sample_count; i++) {
    int positive = cw_plane_distance(plane, model->sample[whole->sample[i]].x) > 0;
    if (positive == other) part->sample[part->sample_count++] = whole->sample[i];
  }
  CW_NEW_UNSET(part->edge, whole->edge_count);
  for (int32_t i = 0; i < whole->edge_count; i++) {
    int32_t e = whole->edge[i];
    double room = fmax(fmax(model->edge[e].room, model->edge[e].touch), model->edge[e].half);
    if (cw_plane_distance(&side, model->edge[e].x) <= room) part->edge[part->edge_count++] = e;
  }
  part_measure(model, part);
done:
  if (status != CW_OK) cw_plan_part_free(part);
  return status;
}

void cw_plan_part_free(CwPlanPart *part) {
  free(part->pieces.start);
  free(part->pieces.triangle);
  free(part->pieces.corner);
  free(part->pieces.work);
  free(part->sample);
  free(part->edge);
  memset(part, 0, sizeof *part);
}
