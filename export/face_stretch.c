// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/face_stretch.h"

#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"

static void add_count(CwFaceCount *sum, int64_t triangles, int64_t quads) {
  sum->triangles += triangles;
  sum->quads += quads;
}

CwStatus cw_face_layout_make(const CwAssembly *a, CwFaceLayout *layout) {
  CwStatus status = CW_OK;
  *layout = (CwFaceLayout){0};
  CW_NEW(layout->region, a->mesh->region_count);
  CW_NEW(layout->patch, a->mesh->patch_count);
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    layout->points += a->totals[d].points;
    layout->cells += a->totals[d].cells;
  }
  for (int r = 0; r < a->mesh->region_count; ++r) {
    const CwRegionPlace *place = &a->places[r];
    layout->region[r] = layout->inner;
    add_count(&layout->inner, place->inner_triangles + place->outer_triangles, place->inner_quads + place->outer_quads);
  }
  layout->all = layout->inner;
  for (int p = 0; p < a->mesh->patch_count; ++p) {
    layout->patch[p] = layout->all;
    add_count(&layout->all, a->patches[p].triangles, a->patches[p].quads);
  }
done:
  return status;
}

void cw_face_layout_free(CwFaceLayout *layout) {
  free(layout->region);
  free(layout->patch);
  memset(layout, 0, sizeof *layout);
}

CwFaceCount cw_face_layout_patch(const CwFaceLayout *layout, const CwAssembly *a, int region, int patch) {
  const CwPatchPart *part = &a->parts[(size_t)region * (size_t)a->mesh->patch_count + (size_t)patch];
  CwFaceCount before = layout->patch[patch];
  add_count(&before, part->triangle, part->quad);
  return before;
}

static CwStatus stretch_new(int64_t triangles, int64_t quads, CwFaceStretch *s) {
  CwStatus status = CW_OK;
  *s = (CwFaceStretch){.count = {triangles, quads}};
  CW_NEW_UNSET(s->cell, triangles + quads);
  CW_NEW_UNSET(s->across, triangles + quads);
  CW_NEW_UNSET(s->open, triangles + quads);
  CW_NEW_UNSET(s->sides, triangles + quads);
  CW_NEW_UNSET(s->corner, 3 * triangles + 4 * quads);
done:
  return status;
}

void cw_face_stretch_free(CwFaceStretch *s) {
  free(s->cell);
  free(s->across);
  free(s->open);
  free(s->sides);
  free(s->corner);
  memset(s, 0, sizeof *s);
}

static inline void stretch_add(CwFaceStretch *s, const CwRegionData *data, int32_t cell, int face, int64_t across,
                               int64_t open) {
  int count, sides = 0;
  const int32_t *nodes = cw_cell_nodes(data, cell, &count);
  const signed char *corner = cw_cell_face_table(count)[face];
  while (sides < 4 && corner[sides] >= 0) s->corner[s->corners++] = nodes[corner[sides++]];
  s->sides[s->faces] = (int8_t)sides;
  s->cell[s->faces] = cell;
  s->across[s->faces] = across;
  s->open[s->faces++] = open;
}

CwStatus cw_face_stretch_inner(const CwAssembly *a, int region, const CwRegionData *data, const CwRegionFaces *faces,
                               CwFaceStretch *s) {
  CwStatus status = CW_OK;
  const CwRegionPlace *place = &a->places[region];
  int64_t next_open = place->open;
  CW_TRY(stretch_new(place->inner_triangles + place->outer_triangles, place->inner_quads + place->outer_quads, s));
  for (int32_t cell = 0, cells = cw_region_cell_count(data); cell < cells; ++cell) {
    // The faces to cells of larger numbers, in the order of those numbers.
    int64_t other[CW_CELL_FACES], open[CW_CELL_FACES];
    int face[CW_CELL_FACES], count = 0;
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      const int32_t across = faces->across[CW_CELL_FACES * cell + f];
      const int64_t slot = across == CW_ACROSS_OPEN ? next_open++ : -1;
      const int64_t number = slot >= 0 ? a->across[slot] : across >= 0 ? place->cell + across : -1;
      if (number <= place->cell + cell) continue;
      int at = count++;
      for (; at > 0 && other[at - 1] > number; --at) {
        other[at] = other[at - 1];
        open[at] = open[at - 1];
        face[at] = face[at - 1];
      }
      other[at] = number;
      open[at] = slot;
      face[at] = f;
    }
    for (int i = 0; i < count; ++i) stretch_add(s, data, cell, face[i], other[i], open[i]);
  }
done:
  return status;
}

CwStatus cw_face_stretch_patch(const CwAssembly *a, int region, int patch, const CwRegionData *data,
                               const CwRegionFaces *faces, CwFaceStretch *s) {
  CwStatus status = CW_OK;
  const CwPatchPart *part = &a->parts[(size_t)region * (size_t)a->mesh->patch_count + (size_t)patch];
  const int local = patch - a->mesh->domains[data->domain].first_patch;
  CW_TRY(stretch_new(part->triangles, part->quads, s));
  for (int32_t i = 0; i < data->triangle_count && part->triangles; ++i)
    if (data->triangle_patch[i] == local)
      stretch_add(s, data, faces->triangle_face[i] / CW_CELL_FACES, faces->triangle_face[i] % CW_CELL_FACES, -1, -1);
  for (int32_t i = 0; i < data->quad_count && part->quads; ++i)
    if (data->quad_patch[i] == local)
      stretch_add(s, data, faces->quad_face[i] / CW_CELL_FACES, faces->quad_face[i] % CW_CELL_FACES, -1, -1);
done:
  return status;
}
