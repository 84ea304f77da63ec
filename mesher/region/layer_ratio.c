// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/layer_ratio.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/region/tets_on.h"
#include "pipeline/mesh/cell.h"

static const double BINS_AN_OCTAVE = 8;

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
  const CwRegionData *cells = &mesh->cells;
  const int32_t last = layers - 1 - cells->tetrahedron_count - cells->pyramid_count; // beside the first of a column
  int32_t(*end)[3] = NULL, *wall = NULL, *above = NULL, ends = 0;
  CW_NEW_UNSET(end, cells->triangle_count);
  CW_NEW_UNSET(wall, cells->triangle_count);
  CW_NEW_UNSET(above, cells->triangle_count);
  for (int32_t t = 0; t < cells->triangle_count; t++) {
    if (cells->triangle_cell[t] < cells->tetrahedron_count + cells->pyramid_count) continue; // open, or tapered
    memcpy(end[ends], cells->prisms[cells->triangle_cell[t] + last] + 3, sizeof *end);
    wall[ends++] = t;
  }
  CW_TRY(cw_tets_on(cells->point_count, ends, (const int32_t(*)[3])end, cells->tetrahedron_count,
                    (const int32_t(*)[4])cells->tetrahedra, above));
  for (int32_t e = 0; e < ends; e++) {
    const int32_t patch = cells->triangle_patch[wall[e]];
    const double *x = cells->points[end[e][0]];
    CW_REQUIRE(above[e] >= 0, CW_ERR_FAULT,
               "%s region %d: the column that ends at (%.6g, %.6g, %.6g) mm has no tetrahedron there", mesh->domain,
               mesh->region, CW_MM(x));
    Meeting meeting = meet(mesh, cells->triangle_cell[wall[e]] + last, cells->tetrahedra[above[e]]);
    if (patch < patches) count(&meeting, &ratio[patch]);
  }
done:
  free(end);
  free(wall);
  free(above);
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
