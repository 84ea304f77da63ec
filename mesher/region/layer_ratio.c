// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/layer_ratio.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/vec.h"
#include "pipeline/mesh/cell.h"

static const double BINS_AN_OCTAVE = 8;

// The end of a column.
typedef struct {
  int32_t corner[3]; // ascending
  int32_t triangle;  // of the wall
} End;

static End end_of(int32_t a, int32_t b, int32_t c, int32_t triangle) {
  End end = {{a, b, c}, triangle};
  for (int pass = 0; pass < 2; pass++) {
    for (int k = 0; k < 2 - pass; k++) {
      if (end.corner[k] <= end.corner[k + 1]) continue;
      int32_t swap = end.corner[k];
      end.corner[k] = end.corner[k + 1];
      end.corner[k + 1] = swap;
    }
  }
  return end;
}

static int compare_ends(const void *p, const void *q) {
  const End *a = p, *b = q;
  for (int k = 0; k < 3; k++) {
    if (a->corner[k] != b->corner[k]) return a->corner[k] < b->corner[k] ? -1 : 1;
  }
  return 0;
}

// The cells on both sides of a face of the layer top.
typedef struct {
  double prism, tetrahedron; // volumes, m3
  double weight;             // of the face
  double centre[3];          // of the face, m
} Meeting;

static Meeting meet(const CwRegionMesh *mesh, int32_t prism, const int32_t *tetrahedron) {
  Meeting meeting = {0};
  const double *x[6], *y[4];
  double normal[3], below[3], above[3];
  for (int k = 0; k < 6; k++) x[k] = mesh->cells.points[mesh->cells.prisms[prism][k]];
  for (int k = 0; k < 4; k++) y[k] = mesh->cells.points[tetrahedron[k]];
  for (int k = 0; k < 3; k++) meeting.centre[k] = (x[3][k] + x[4][k] + x[5][k]) / 3;
  cw_normal(x[3], x[4], x[5], normal);
  meeting.prism = cw_cell_volume(6, x);
  meeting.tetrahedron = cw_cell_volume(4, y);
  cw_cell_centroid(6, x, below);
  cw_cell_centroid(4, y, above);
  cw_sub(meeting.centre, below, below);
  cw_sub(above, meeting.centre, above);
  double to_prism = fabs(cw_dot(below, normal)), to_tetrahedron = fabs(cw_dot(above, normal));
  meeting.weight = fmin(to_prism, to_tetrahedron) / (to_prism + to_tetrahedron);
  return meeting;
}

static void count(const Meeting *meeting, CwLayerRatio *ratio) {
  double over = meeting->prism / meeting->tetrahedron, of = fmax(over, 1 / over);
  int bin = (int)fmin(fmax(ceil(BINS_AN_OCTAVE * log2(of)) - 1, 0), CW_RATIO_BINS - 1);
  ratio->faces++;
  ratio->bin[bin]++;
  ratio->thin_over_fair += of > CW_RATIO_FAIR && over < 1;
  ratio->thick_over_fair += of > CW_RATIO_FAIR && over > 1;
  ratio->over_most += of > CW_RATIO_MOST;
  ratio->small_weight += meeting->weight < CW_SMALL_WEIGHT;
  if (of <= ratio->greatest) return;
  ratio->greatest = of;
  cw_copy(meeting->centre, ratio->greatest_at);
}

CwStatus cw_layer_ratio(const CwRegionMesh *mesh, int layers, int patches, CwLayerRatio *ratio) {
  CwStatus status = CW_OK;
  End *end = NULL;
  uint8_t *on_end = NULL;
  int32_t ends = 0, met = 0,
          last = layers - 1 - mesh->cells.tetrahedron_count - mesh->cells.pyramid_count; // beside the first
  CW_NEW(end, mesh->cells.triangle_count);
  CW_NEW(on_end, mesh->cells.point_count);
  for (int32_t t = 0; t < mesh->cells.triangle_count; t++) {
    if (mesh->cells.triangle_cell[t] < mesh->cells.tetrahedron_count) continue;
    const int32_t *top = mesh->cells.prisms[mesh->cells.triangle_cell[t] + last] + 3;
    end[ends++] = end_of(top[0], top[1], top[2], t);
    for (int k = 0; k < 3; k++) on_end[top[k]] = 1;
  }
  qsort(end, (size_t)ends, sizeof *end, compare_ends);
  for (int32_t c = 0; c < mesh->cells.tetrahedron_count; c++) {
    const int32_t *corner = mesh->cells.tetrahedra[c];
    if (on_end[corner[0]] + on_end[corner[1]] + on_end[corner[2]] + on_end[corner[3]] < 3) continue;
    for (int k = 0; k < 4; k++) {
      End key = end_of(corner[(k + 1) % 4], corner[(k + 2) % 4], corner[(k + 3) % 4], 0);
      const End *found = bsearch(&key, end, (size_t)ends, sizeof *end, compare_ends);
      if (!found) continue;
      int32_t patch = mesh->cells.triangle_patch[found->triangle];
      Meeting meeting = meet(mesh, mesh->cells.triangle_cell[found->triangle] + last, corner);
      met++;
      if (patch < patches) count(&meeting, &ratio[patch]);
    }
  }
  CW_REQUIRE(met == ends, CW_ERR_MESH, "%s region %d: %d of %d columns have no tetrahedron on their ends", mesh->domain,
             mesh->region, ends - met, ends);
done:
  free(end);
  free(on_end);
  return status;
}

void cw_layer_ratio_add(CwLayerRatio *sum, const CwLayerRatio *of) {
  sum->faces += of->faces;
  for (int b = 0; b < CW_RATIO_BINS; b++) sum->bin[b] += of->bin[b];
  sum->thin_over_fair += of->thin_over_fair;
  sum->thick_over_fair += of->thick_over_fair;
  sum->over_most += of->over_most;
  sum->small_weight += of->small_weight;
  if (of->greatest <= sum->greatest) return;
  sum->greatest = of->greatest;
  cw_copy(of->greatest_at, sum->greatest_at);
}

double cw_layer_ratio_quantile(const CwLayerRatio *ratio, double share) {
  int64_t below = 0;
  for (int b = 0; b < CW_RATIO_BINS - 1; b++) {
    below += ratio->bin[b];
    if ((double)below >= share * (double)ratio->faces) return fmin(exp2((b + 1) / BINS_AN_OCTAVE), ratio->greatest);
  }
  return ratio->greatest;
}
