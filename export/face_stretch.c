// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/face_stretch.h"

#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"

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
    layout->region[r] = layout->inner;
    cw_face_count_add(&layout->inner, a->places[r].inner);
    cw_face_count_add(&layout->inner, a->places[r].outer);
  }
  layout->all = layout->inner;
  for (int p = 0; p < a->mesh->patch_count; ++p) {
    layout->patch[p] = layout->all;
    cw_face_count_add(&layout->all, a->patches[p].faces);
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
  CwFaceCount before = layout->patch[patch];
  cw_face_count_add(&before, cw_patch_part(a, region, patch)->before);
  return before;
}

CwStatus cw_face_stretch_new(int64_t most, CwFaceStretch *s) {
  CwStatus status = CW_OK;
  *s = (CwFaceStretch){.most = most};
  CW_NEW_UNSET(s->cell, most);
  CW_NEW_UNSET(s->across, most);
  CW_NEW_UNSET(s->open, most);
  CW_NEW_UNSET(s->sides, most);
  CW_NEW_UNSET(s->corner, 4 * most);
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
  int count;
  const int32_t *nodes = cw_cell_nodes(data, cell, &count);
  const signed char *corner = cw_cell_face_table(count)[face];
  const int64_t at = s->faces++;
  const int is_quad = corner[3] >= 0;
  int32_t *place = s->corner + s->corners;
  for (int i = 0; i < 3; ++i) place[i] = nodes[corner[i]];
  place[3] = nodes[is_quad ? corner[3] : 0];
  s->corners += 3 + is_quad;
  s->sides[at] = (int8_t)(3 + is_quad);
  s->cell[at] = cell;
  s->across[at] = across;
  s->open[at] = open;
}

static inline void order(int64_t *a, int64_t *b) {
  const int64_t low = *a < *b ? *a : *b, high = *a < *b ? *b : *a;
  *a = low;
  *b = high;
}

// The faces of a cell to cells of larger numbers, in the order of those: the other cell and, in the lowest three bits,
// the face; returns how many. Five numbers are put in order by nine exchanges without branches, as which faces those
// are no processor can foresee.
static inline int faces_onward(int64_t cell, const int64_t across[CW_CELL_FACES], int64_t key[CW_CELL_FACES]) {
  int count = 0;
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    key[f] = across[f] > cell ? across[f] << 3 | f : INT64_MAX;
    count += across[f] > cell;
  }
  order(&key[0], &key[1]);
  order(&key[3], &key[4]);
  order(&key[2], &key[4]);
  order(&key[2], &key[3]);
  order(&key[1], &key[4]);
  order(&key[0], &key[3]);
  order(&key[0], &key[2]);
  order(&key[1], &key[3]);
  order(&key[1], &key[2]);
  return count;
}

int cw_face_stretch_inner(const CwAssembly *a, int region, const CwRegionData *data, const CwRegionFaces *faces,
                          CwFaceStretch *s) {
  const CwRegionPlace *place = &a->places[region];
  const int32_t cells = cw_region_cell_count(data);
  s->faces = s->corners = 0;
  for (; s->next < cells && s->faces + CW_CELL_FACES <= s->most; ++s->next) {
    const int32_t cell = (int32_t)s->next;
    int64_t across[CW_CELL_FACES], open[CW_CELL_FACES], key[CW_CELL_FACES];
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      const int32_t local = faces->across[CW_CELL_FACES * cell + f];
      open[f] = local == CW_ACROSS_OPEN ? place->first_open + s->next_open++ : -1;
      across[f] = open[f] >= 0 ? a->across[open[f]] : local >= 0 ? place->cell + local : -1;
    }
    const int count = faces_onward(place->cell + cell, across, key);
    for (int i = 0; i < count; ++i) stretch_add(s, data, cell, key[i] & 7, key[i] >> 3, open[key[i] & 7]);
  }
  return s->faces > 0;
}

int cw_face_stretch_patch(const CwAssembly *a, int patch, const CwRegionData *data, const CwRegionFaces *faces,
                          CwFaceStretch *s) {
  const int local = patch - a->mesh->domains[data->domain].first_patch;
  const int64_t triangles = data->triangle_count, count = triangles + data->quad_count;
  s->faces = s->corners = 0;
  for (; s->next < count && s->faces < s->most; ++s->next) {
    const int64_t quad = s->next - triangles;
    if ((quad < 0 ? data->triangle_patch[s->next] : data->quad_patch[quad]) != local) continue;
    const int32_t face = quad < 0 ? faces->triangle_face[s->next] : faces->quad_face[quad];
    stretch_add(s, data, face / CW_CELL_FACES, face % CW_CELL_FACES, -1, -1);
  }
  return s->faces > 0;
}
