// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/audit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/mix.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/fill/tet_quality.h"
#include "mesher/policy.h"
#include "pipeline/mesh/cell.h"
#include "pipeline/mesh/region_faces.h"

static const char *cell_name(int corners) {
  return corners == 4 ? "tetrahedron" : corners == 5 ? "pyramid" : "prism";
}

static uint64_t mixed(uint64_t h, uint64_t v) {
  return cw_mix((h ^ v) + CW_MIX_STEP);
}

// The hash of an open face on a partition plane, negative where its cell sees it the other way round.
static uint64_t open_face_hash(const CwRegionData *data, int32_t open) {
  int32_t point[4];
  int64_t shared[4];
  int order[4], corners = cw_cell_face(data, open / CW_CELL_FACES, open % CW_CELL_FACES, point);
  for (int k = 0; k < corners; k++) shared[k] = data->shared_id[point[k]];
  int back = cw_face_loop(shared, corners, order);
  uint64_t hash = (uint64_t)corners;
  for (int k = 0; k < corners; k++) {
    uint64_t bits[3];
    memcpy(bits, data->points[point[order[k]]], sizeof bits);
    hash = mixed(hash, (uint64_t)shared[order[k]]);
    for (int i = 0; i < 3; i++) hash = mixed(hash, bits[i]);
  }
  return back ? -hash : hash;
}

// Of places within `apart` of one another only the flattest stays, and of all the flattest.
static void add_flat(const CwFlatPlace *place, double apart, CwQuality *quality) {
  CwFlatPlace *flat = quality->flat;
  int32_t kept = 0;
  for (int32_t i = 0; i < quality->flat_count; i++) {
    int near = cw_distance(flat[i].x, place->x) < apart;
    if (near && flat[i].flatness <= place->flatness) return;
    if (!near) flat[kept++] = flat[i];
  }
  if (kept == CW_FLAT_PLACES && flat[kept - 1].flatness <= place->flatness) return;
  int32_t at = kept < CW_FLAT_PLACES ? kept : kept - 1;
  quality->flat_count = at + 1;
  for (; at > 0 && flat[at - 1].flatness > place->flatness; at--) flat[at] = flat[at - 1];
  flat[at] = *place;
}

double cw_nearly_flat_angle(void) {
  return 0.5 * (cw_policy.flat_angle + cw_policy.wanted_angle);
}

// Counts a tetrahedron of that flatness, its longest edge or about so `length`.
static void count_flat(const CwRegionData *data, int32_t cell, double flatness, double length, CwQuality *quality) {
  CwFlatPlace place = {.flatness = flatness};
  quality->flattest = cw_lesser(quality->flattest, flatness);
  if (flatness >= cw_nearly_flat_angle()) return;
  cw_cell_centre(data, cell, place.x);
  add_flat(&place, 2 * length, quality);
}

// The tetrahedra of a region but those of tapered columns, whose pairs are judged.
typedef struct {
  const CwRegionData *data;
  int32_t count;
  float *volume; // of each
  CwQuality *quality;
} Tetrahedra;

// Two tetrahedra on a face are as high over it as they have volume: where checkMesh calls the weight of the face small
// they count as flat, the larger as the place.
static void judge_pair(void *given, int32_t cell, int32_t other) {
  const Tetrahedra *of = given;
  if (cell >= of->count || other >= of->count) return;
  double a = of->volume[cell], b = of->volume[other], weight = cw_lesser(a, b) / (a + b), length = 0;
  if (weight >= CW_SMALL_WEIGHT) return;
  const int32_t larger = a > b ? cell : other, *corner = of->data->tetrahedra[larger];
  for (int k = 0; k < 3; k++)
    length = cw_greater(length, cw_distance(of->data->points[corner[k]], of->data->points[corner[k + 1]]));
  count_flat(of->data, larger, cw_policy.flat_angle * weight / CW_SMALL_WEIGHT, length, of->quality);
}

// All faces, with the pairs of tetrahedra, or where these are NULL those of shared points alone; adds up the open ones.
static CwStatus check_faces(const CwRegionMesh *r, Tetrahedra *pairs, uint64_t *sum) {
  CwStatus status = CW_OK;
  const CwRegionData *data = &r->cells;
  int32_t *open = NULL, count = 0;
  char name[40];
  snprintf(name, sizeof name, "%s region %d", r->domain, r->region);
  CW_TRY(cw_region_open_faces(name, CW_ERR_FAULT, data, !pairs, pairs ? judge_pair : NULL, pairs, &open, &count));
  for (int32_t k = 0; k < count; k++) *sum += open_face_hash(data, open[k]);
done:
  free(open);
  return status;
}

static CwStatus check_indices(const CwRegionMesh *r) {
  CwStatus status = CW_OK;
  uint8_t *used = NULL;
  CW_NEW(used, r->cells.point_count);
  const CwRegionData *data = &r->cells;
  for (int32_t c = 0, cells = cw_region_cell_count(data); c < cells; c++) {
    int corners;
    const int32_t *corner = cw_cell_nodes(data, c, &corners);
    for (int k = 0; k < corners; k++) {
      CW_REQUIRE(corner[k] >= 0 && corner[k] < r->cells.point_count, CW_ERR_FAULT,
                 "%s region %d: cell %d names point %d; 0 to %d are allowed", r->domain, r->region, c, corner[k],
                 r->cells.point_count - 1);
      used[corner[k]] = 1;
    }
  }
  for (int64_t k = 0; k < (int64_t)r->cells.triangle_count + r->cells.quad_count; k++) {
    int quad = k >= r->cells.triangle_count;
    const int32_t *corner = quad ? r->cells.quads[k - r->cells.triangle_count] : r->cells.triangles[k];
    for (int i = 0; i < (quad ? 4 : 3); i++) {
      CW_REQUIRE(corner[i] >= 0 && corner[i] < r->cells.point_count, CW_ERR_FAULT,
                 "%s region %d: boundary face %lld names point %d; 0 to %d are allowed", r->domain, r->region,
                 (long long)k, corner[i], r->cells.point_count - 1);
    }
  }
  for (int32_t p = 0; p < r->cells.point_count; p++) {
    CW_REQUIRE(used[p], CW_ERR_FAULT, "%s region %d: point %d at (%.6g, %.6g, %.6g) mm belongs to no cell", r->domain,
               r->region, p, CW_MM(r->cells.points[p]));
  }
done:
  free(used);
  return status;
}

static int bin_of(double value, double width, int bins) {
  int bin = (int)(value / width);
  return bin < 0 ? 0 : bin >= bins ? bins - 1 : bin;
}

static void add_tet(CwTetFigures *figures, const CwTetShape *shape, double aspect) {
  figures->count++;
  figures->aspect_sum += aspect;
  figures->aspect_max = cw_greater(figures->aspect_max, aspect);
  figures->mean_ratio_sum += shape->mean_ratio;
  figures->mean_ratio_least = cw_lesser(figures->mean_ratio_least, shape->mean_ratio);
  figures->dihedral_least = cw_lesser(figures->dihedral_least, shape->dihedral_least);
}

static void add_figures(CwTetFigures *sum, const CwTetFigures *more) {
  sum->count += more->count;
  sum->aspect_sum += more->aspect_sum;
  sum->aspect_max = fmax(sum->aspect_max, more->aspect_max);
  sum->mean_ratio_sum += more->mean_ratio_sum;
  sum->mean_ratio_least = fmin(sum->mean_ratio_least, more->mean_ratio_least);
  sum->dihedral_least = fmin(sum->dihedral_least, more->dihedral_least);
}

// Corners and volume of a cell, which must be positive beyond rounding.
static void check_volume(const CwRegionMesh *r, int32_t cell, int *corners, const double *x[6], double *volume,
                         CwOutcome *outcome) {
  const int32_t *corner = cw_cell_nodes(&r->cells, cell, corners);
  for (int k = 0; k < *corners; k++) x[k] = r->cells.points[corner[k]];
  int is_tet = *corners == 4;
  *volume = is_tet ? cw_tet_volume6(x[0], x[1], x[2], x[3]) / 6.0 : cw_cell_volume(*corners, x);
  double doubt = is_tet ? cw_tet_volume6_error(x[0], x[1], x[2], x[3]) / 6.0 : 0.0;
  if (*volume > doubt) return;
  double centre[3];
  cw_cell_centre(&r->cells, cell, centre);
  cw_outcome_set(outcome, CW_OUTCOME_THIN, centre, "%s region %d: %s of cell %d has no positive volume: %.3g mm3",
                 r->domain, r->region, cell_name(*corners), cell, cw_mm3(*volume));
}

// The faces of each tetrahedron that lie on patches, as bits. *on_patches [out]: malloc'd.
static CwStatus find_on_patches(const CwRegionData *data, uint8_t **on_patches) {
  CwStatus status = CW_OK;
  CW_NEW(*on_patches, data->tetrahedron_count);
  for (int32_t t = 0; t < data->triangle_count; t++) {
    int32_t cell = data->triangle_cell[t], node[4];
    const int32_t *on = data->triangles[t];
    for (int f = 0; f < 4 && cell < data->tetrahedron_count; f++) {
      int alike = 0;
      cw_cell_face(data, cell, f, node);
      for (int k = 0; k < 9; k++) alike += node[k / 3] == on[k % 3];
      if (alike == 3) (*on_patches)[cell] |= (uint8_t)(1 << f);
    }
  }
done:
  return status;
}

// The least dihedral angle of a tetrahedron or, where checkMesh may call its determinant small, what it is worth by
// that (see judge in fill/tet_search.c).
static double flatness_of(const double *const *x, double dihedral, double aspect, unsigned on_patches) {
  // Degrees, and longest over shortest edge: what is steeper and stouter has a greater determinant, but with two faces
  // on patches. Four points along a line are as steep as can be.
  static const double DOUBT = 20, SLENDER = 3;
  if (dihedral > DOUBT && aspect < SLENDER && (on_patches & (on_patches - 1)) == 0) return dihedral;
  double determinant = cw_cell_determinant(4, x, 0xf & ~on_patches);
  return cw_lesser(dihedral, cw_policy.flat_angle * cw_tet_determinant_share(determinant));
}

static CwStatus check_cells(const CwRegionMesh *r, float *tet_volume, CwQuality *quality, CwOutcome *outcome) {
  static const double limit[7] = {1.5, 2, 3, 4, 5, 7, 10};
  CwStatus status = CW_OK;
  double aspects = 0.0;
  const CwRegionData *data = &r->cells;
  const int32_t tetrahedra = data->tetrahedron_count - r->layer_tetrahedra;
  uint8_t *on_patches = NULL;
  CW_TRY(find_on_patches(data, &on_patches));
  quality->cells = cw_region_cell_count(data);
  quality->prism_count = r->cells.prism_count;
  for (int32_t c = 0; c < quality->cells; c++) {
    const double *x[6];
    double volume;
    int corners;
    check_volume(r, c, &corners, x, &volume, outcome);
    if (outcome->kind != CW_OUTCOME_DONE) goto done;
    quality->volume += volume;
    quality->least_volume = cw_lesser(quality->least_volume, volume);
    if (c < tetrahedra) {
      CwTetShape shape;
      tet_volume[c] = (float)volume;
      cw_tet_shape(x, &shape);
      double aspect = shape.edge_longest / shape.edge_shortest;
      aspects += aspect;
      int beside = 0;
      for (int k = 0; k < 4; k++) beside |= r->cells.tetrahedra[c][k] < r->cells.shared_count;
      add_tet(beside ? &quality->beside : &quality->apart, &shape, aspect);
      quality->aspect_max = cw_greater(quality->aspect_max, aspect);
      int class = 0;
      while (class < 7 && aspect > limit[class]) class ++;
      quality->aspect_class[class]++;
      count_flat(data, c, flatness_of(x, shape.dihedral_least, aspect, on_patches[c]), shape.edge_longest, quality);
      quality->dihedral_least = cw_lesser(quality->dihedral_least, shape.dihedral_least);
      quality->dihedral_greatest = cw_greater(quality->dihedral_greatest, shape.dihedral_greatest);
      quality->dihedral_bin[bin_of(shape.dihedral_least, 10.0, 18)]++;
    } else if (corners == 6) {
      double jacobian = cw_prism_scaled_jacobian(x);
      quality->prism_least_scaled_jacobian = cw_lesser(quality->prism_least_scaled_jacobian, jacobian);
      quality->prism_jacobian_bin[bin_of(jacobian, 1.0 / CW_QUALITY_BINS, CW_QUALITY_BINS)]++;
    }
  }
  if (tetrahedra) quality->aspect_mean = aspects / tetrahedra;
done:
  free(on_patches);
  return status;
}

CwStatus cw_audit_region(const CwRegionMesh *region, CwQuality *quality, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Tetrahedra tetrahedra = {
      .data = &region->cells, .count = region->cells.tetrahedron_count - region->layer_tetrahedra, .quality = quality};
  cw_quality_start(quality);
  CW_NEW_UNSET(tetrahedra.volume, region->cells.tetrahedron_count);
  CW_TRY(check_indices(region));
  CW_TRY_STAGE(check_cells(region, tetrahedra.volume, quality, outcome), outcome);
  CW_TRY(check_faces(region, &tetrahedra, &quality->open_faces));
done:
  free(tetrahedra.volume);
  return status;
}

CwStatus cw_audit_copy(const CwRegionMesh *copy, uint64_t *open_faces, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const double *x[6];
  double volume;
  int corners;
  *open_faces = 0;
  for (int32_t c = 0, cells = cw_region_cell_count(&copy->cells); c < cells; c++) {
    check_volume(copy, c, &corners, x, &volume, outcome);
    if (outcome->kind != CW_OUTCOME_DONE) goto done;
  }
  CW_TRY(check_faces(copy, NULL, open_faces));
done:
  return status;
}

void cw_quality_start(CwQuality *sum) {
  memset(sum, 0, sizeof *sum);
  sum->least_volume = INFINITY;
  sum->dihedral_least = sum->flattest = 180.0;
  sum->beside.dihedral_least = sum->apart.dihedral_least = 180.0;
  sum->beside.mean_ratio_least = sum->apart.mean_ratio_least = 1.0;
  sum->prism_least_scaled_jacobian = 1.0;
}

void cw_quality_add(CwQuality *sum, const CwQuality *more) {
  int64_t before = 0, tetrahedra = 0;
  for (int k = 0; k < 8; k++) before += sum->aspect_class[k], tetrahedra += more->aspect_class[k];
  if (before + tetrahedra > 0) {
    sum->aspect_mean =
        (sum->aspect_mean * (double)before + more->aspect_mean * (double)tetrahedra) / (double)(before + tetrahedra);
  }
  sum->volume += more->volume;
  sum->least_volume = fmin(sum->least_volume, more->least_volume);
  sum->cells += more->cells;
  sum->aspect_max = fmax(sum->aspect_max, more->aspect_max);
  for (int k = 0; k < 8; k++) sum->aspect_class[k] += more->aspect_class[k];
  for (int32_t i = 0; i < more->flat_count; i++) add_flat(&more->flat[i], 0, sum);
  sum->flattest = fmin(sum->flattest, more->flattest);
  sum->dihedral_least = fmin(sum->dihedral_least, more->dihedral_least);
  sum->dihedral_greatest = fmax(sum->dihedral_greatest, more->dihedral_greatest);
  for (int k = 0; k < 18; k++) sum->dihedral_bin[k] += more->dihedral_bin[k];
  add_figures(&sum->beside, &more->beside);
  add_figures(&sum->apart, &more->apart);
  sum->open_faces += more->open_faces;
  sum->prism_count += more->prism_count;
  sum->prism_least_scaled_jacobian = fmin(sum->prism_least_scaled_jacobian, more->prism_least_scaled_jacobian);
  for (int k = 0; k < CW_QUALITY_BINS; k++) sum->prism_jacobian_bin[k] += more->prism_jacobian_bin[k];
}
