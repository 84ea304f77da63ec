// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/audit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/quality.h"

// One side of one cell's face. Faces with the same points stand together after sorting by (bucket of least
// point, rest).
typedef struct {
  int32_t rest[3]; // the other points, ascending; the third of a triangle is -1
  int32_t cell;    // cell of the region, or -1 - listed face
  int8_t turn;     // direction of the face: which of the rest follows, and which precedes, the least point
} Side;

static const int tet_face[4][4] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
static const int pyramid_face[5][4] = {
    {0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
static const int prism_face[5][4] = {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};

static int64_t cell_count(const CwRegionMesh *r) {
  return (int64_t)r->tetrahedron_count + r->pyramid_count + r->prism_count;
}

// Corners of a cell (tetrahedra first, then pyramids, then prisms); returns their number: 4, 5 or 6.
static int cell_corners(const CwRegionMesh *r, int64_t cell, const int32_t **corner) {
  if (cell < r->tetrahedron_count) {
    *corner = r->tetrahedron[cell];
    return 4;
  }
  cell -= r->tetrahedron_count;
  if (cell < r->pyramid_count) {
    *corner = r->pyramid[cell];
    return 5;
  }
  *corner = r->prism[cell - r->pyramid_count];
  return 6;
}

static const char *cell_name(int corners) {
  return corners == 4 ? "tetrahedron" : corners == 5 ? "pyramid" : "prism";
}

static CwStatus fail_at_points(const CwRegionMesh *r, const char *what, int count, const int32_t *point,
                               int64_t cell, const char *fault) {
  double mean[3] = {0, 0, 0};
  for (int k = 0; k < count; k++) {
    for (int i = 0; i < 3; i++)
      mean[i] += 1e3 * r->x[point[k]][i] / count;
  }
  return CW_FAIL(CW_ERR_MESH, "%s region %d: %s of cell %lld at (%.6g, %.6g, %.6g) mm %s", r->domain,
                 r->region, what, (long long)cell, mean[0], mean[1], mean[2], fault);
}

// The face in the form that sorting compares; returns its least point.
static int32_t side_of(int count, const int32_t *point, int64_t cell, Side *side) {
  int least = 0;
  for (int k = 1; k < count; k++) {
    if (point[k] < point[least])
      least = k;
  }
  int32_t follow[3] = {-1, -1, -1};
  for (int k = 1; k < count; k++)
    follow[k - 1] = point[(least + k) % count];
  int place[3] = {0, 1, 2}; // place[k]: which of follow stands at rest[k]
  for (int i = 1; i < count - 1; i++) {
    for (int j = i; j > 0 && follow[place[j]] < follow[place[j - 1]]; j--) {
      int swap = place[j];
      place[j] = place[j - 1];
      place[j - 1] = swap;
    }
  }
  int first = 0, last = 0;
  for (int k = 0; k < count - 1; k++) {
    side->rest[k] = follow[place[k]];
    if (place[k] == 0)
      first = k;
    if (place[k] == count - 2)
      last = k;
  }
  if (count == 3)
    side->rest[2] = -1;
  side->cell = (int32_t)cell;
  side->turn = (int8_t)(4 * first + last);
  return point[least];
}

static int compare_rest(const Side *a, const Side *b) {
  for (int k = 0; k < 3; k++) {
    if (a->rest[k] != b->rest[k])
      return a->rest[k] < b->rest[k] ? -1 : 1;
  }
  return 0;
}

static int compare_sides(const void *left, const void *right) {
  const Side *a = left, *b = right;
  int order = compare_rest(a, b);
  if (order)
    return order;
  return a->cell < b->cell ? 1 : a->cell > b->cell ? -1 : 0; // cells before listed faces
}

static int opposite_turn(int turn) {
  return 4 * (turn % 4) + turn / 4;
}

static int all_below(int count, const int32_t *point, int32_t end) {
  int below = 1;
  for (int k = 0; k < count; k++)
    below &= point[k] < end;
  return below;
}

// Calls for every face with all its points below `end`: all sides of cells, then all listed faces. With `side`
// NULL only counts buckets.
static void visit_sides(const CwRegionMesh *r, int32_t end, int64_t *start, Side *side) {
  int64_t cells = cell_count(r);
  Side one;
  for (int64_t c = 0; c < cells; c++) {
    const int32_t *corner;
    int corners = cell_corners(r, c, &corner);
    const int(*face)[4] = corners == 4 ? tet_face : corners == 5 ? pyramid_face : prism_face;
    for (int f = 0; f < (corners == 4 ? 4 : 5); f++) {
      int32_t point[4];
      int count = face[f][3] < 0 ? 3 : 4;
      for (int k = 0; k < count; k++)
        point[k] = corner[face[f][k]];
      if (!all_below(count, point, end))
        continue;
      int64_t at = start[side_of(count, point, c, &one)]++;
      if (side)
        side[at] = one;
    }
  }
  for (int64_t k = 0; k < (int64_t)r->triangle_count + r->quad_count; k++) {
    int quad = k >= r->triangle_count;
    const int32_t *point = quad ? r->quad[k - r->triangle_count] : r->triangle[k];
    if (!all_below(quad ? 4 : 3, point, end))
      continue;
    int64_t at = start[side_of(quad ? 4 : 3, point, -1 - k, &one)]++;
    if (side)
      side[at] = one;
  }
}

static uint64_t mixed(uint64_t h, uint64_t v) { // finaliser of splitmix64
  h = (h ^ v) + 0x9e3779b97f4a7c15ull;
  h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ h >> 27) * 0x94d049bb133111ebull;
  return h ^ h >> 31;
}

// The hash of an open face on a dividing plane, negative where its cell sees it the other way round.
static uint64_t open_face_hash(const CwRegionMesh *r, int32_t least, const Side *side) {
  int corners = side->rest[2] < 0 ? 3 : 4, first = side->turn / 4, last = side->turn % 4, at = 0;
  int32_t cycle[4] = {least, side->rest[first], side->rest[last], side->rest[last]};
  if (corners == 4)
    cycle[2] = side->rest[3 - first - last];
  // From the least shared number on, towards the lesser of its two neighbours.
  for (int k = 1; k < corners; k++) {
    if (r->shared_id[cycle[k]] < r->shared_id[cycle[at]])
      at = k;
  }
  int back = r->shared_id[cycle[(at + corners - 1) % corners]] < r->shared_id[cycle[(at + 1) % corners]];
  uint64_t hash = (uint64_t)corners;
  for (int k = 0; k < corners; k++) {
    int32_t p = cycle[(at + (back ? corners - k : k)) % corners];
    uint64_t bits[3];
    memcpy(bits, r->x[p], sizeof bits);
    hash = mixed(hash, (uint64_t)r->shared_id[p]);
    for (int i = 0; i < 3; i++)
      hash = mixed(hash, bits[i]);
  }
  return back ? -hash : hash;
}

// One face: `count` sides with the same points.
static CwStatus check_face(const CwRegionMesh *r, int32_t least, int count, const Side *side,
                           CwQuality *quality) {
  CwStatus status = CW_OK;
  int32_t point[4] = {least, side->rest[0], side->rest[1], side->rest[2]};
  int corners = side->rest[2] < 0 ? 3 : 4, of_cells = 0;
  const char *what = corners == 3 ? "triangle" : "quadrilateral", *fault = NULL;
  while (of_cells < count && side[of_cells].cell >= 0)
    of_cells++;
  int listed = count - of_cells;
  if (of_cells == 0)
    fault = "is listed as boundary but is no face of a cell";
  else if (of_cells > 2)
    fault = "belongs to more than two cells";
  else if (of_cells == 2 && listed)
    fault = "is listed as boundary but lies between two cells";
  else if (of_cells == 2 && side[1].turn != opposite_turn(side[0].turn))
    fault = "has both of its cells on one side or is seen twisted by one of them";
  else if (listed > 1)
    fault = "is listed as boundary more than once";
  else if (listed == 1) {
    int32_t k = -1 - side[1].cell;
    int32_t cell = corners == 3 ? r->triangle_cell[k] : r->quad_cell[k - r->triangle_count];
    if (side[1].turn != side[0].turn)
      fault = "is listed as boundary with its normal into the domain";
    else if (cell != side[0].cell)
      fault = "is listed as boundary with the wrong cell";
  } else if (of_cells == 1) {
    for (int k = 0; k < corners; k++) {
      if (point[k] >= r->shared_count)
        fault = "is open: not listed as boundary and not on a dividing plane";
    }
    if (!fault)
      quality->open_faces += open_face_hash(r, least, side);
  }
  if (fault) {
    int64_t cell = side->cell;
    if (cell < 0)
      cell = corners == 3 ? r->triangle_cell[-1 - cell] : r->quad_cell[-1 - cell - r->triangle_count];
    status = fail_at_points(r, what, corners, point, cell, fault);
  }
  return status;
}

// All faces with all their points below `end`.
static CwStatus check_faces(const CwRegionMesh *r, int32_t end, CwQuality *quality) {
  CwStatus status = CW_OK;
  int64_t *start = NULL;
  Side *side = NULL;
  CW_NEW(start, (int64_t)end + 1);
  visit_sides(r, end, start, NULL);
  int64_t total = 0;
  for (int32_t p = 0; p <= end; p++) {
    int64_t here = start[p];
    start[p] = total;
    total += here;
  }
  CW_NEW(side, total);
  visit_sides(r, end, start, side);
  // Filling moved each start to the end of its bucket.
  int64_t from = 0;
  for (int32_t p = 0; p < end; p++) {
    int64_t to = start[p];
    if (to - from > 1)
      qsort(side + from, (size_t)(to - from), sizeof *side, compare_sides);
    while (from < to) {
      int64_t next = from + 1;
      while (next < to && compare_rest(&side[from], &side[next]) == 0)
        next++;
      CW_TRY(check_face(r, p, (int)(next - from), &side[from], quality));
      from = next;
    }
  }
done:
  free(side);
  free(start);
  return status;
}

static CwStatus check_indices(const CwRegionMesh *r) {
  CwStatus status = CW_OK;
  uint8_t *used = NULL;
  CW_NEW(used, r->point_count);
  int64_t cells = cell_count(r);
  for (int64_t c = 0; c < cells; c++) {
    const int32_t *corner;
    int corners = cell_corners(r, c, &corner);
    for (int k = 0; k < corners; k++) {
      CW_REQUIRE(corner[k] >= 0 && corner[k] < r->point_count, CW_ERR_MESH,
                 "%s region %d: cell %lld names point %d; 0 to %d are allowed", r->domain, r->region,
                 (long long)c, corner[k], r->point_count - 1);
      used[corner[k]] = 1;
    }
  }
  for (int64_t k = 0; k < (int64_t)r->triangle_count + r->quad_count; k++) {
    int quad = k >= r->triangle_count;
    const int32_t *corner = quad ? r->quad[k - r->triangle_count] : r->triangle[k];
    for (int i = 0; i < (quad ? 4 : 3); i++) {
      CW_REQUIRE(corner[i] >= 0 && corner[i] < r->point_count, CW_ERR_MESH,
                 "%s region %d: boundary face %lld names point %d; 0 to %d are allowed", r->domain, r->region,
                 (long long)k, corner[i], r->point_count - 1);
    }
  }
  for (int32_t p = 0; p < r->point_count; p++) {
    CW_REQUIRE(used[p], CW_ERR_MESH, "%s region %d: point %d at (%.6g, %.6g, %.6g) mm belongs to no cell",
               r->domain, r->region, p, 1e3 * r->x[p][0], 1e3 * r->x[p][1], 1e3 * r->x[p][2]);
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
  figures->aspect_max = fmax(figures->aspect_max, aspect);
  figures->mean_ratio_sum += shape->mean_ratio;
  figures->mean_ratio_least = fmin(figures->mean_ratio_least, shape->mean_ratio);
  figures->dihedral_least = fmin(figures->dihedral_least, shape->dihedral_least);
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
static CwStatus check_volume(const CwRegionMesh *r, int64_t cell, int *corners, const double *x[6],
                             double *volume) {
  CwStatus status = CW_OK;
  const int32_t *corner;
  *corners = cell_corners(r, cell, &corner);
  for (int k = 0; k < *corners; k++)
    x[k] = r->x[corner[k]];
  *volume = cw_cell_volume(*corners, x);
  double doubt = *corners == 4 ? cw_tet_volume6_error(x[0], x[1], x[2], x[3]) / 6.0 : 0.0;
  if (!(*volume > doubt)) {
    char fault[100];
    snprintf(fault, sizeof fault, "has no positive volume: %.3g mm3", 1e9 * *volume);
    status = fail_at_points(r, cell_name(*corners), *corners, corner, cell, fault);
  }
  return status;
}

static CwStatus check_cells(const CwRegionMesh *r, CwQuality *quality) {
  static const double limit[7] = {1.5, 2, 3, 4, 5, 7, 10};
  CwStatus status = CW_OK;
  double aspects = 0.0;
  quality->cells = cell_count(r);
  quality->prism_count = r->prism_count;
  for (int64_t c = 0; c < quality->cells; c++) {
    const double *x[6];
    double volume;
    int corners;
    CW_TRY(check_volume(r, c, &corners, x, &volume));
    quality->volume += volume;
    quality->least_volume = fmin(quality->least_volume, volume);
    if (corners == 4) {
      CwTetShape shape;
      cw_tet_shape(x, &shape);
      double aspect = shape.edge_longest / shape.edge_shortest;
      aspects += aspect;
      int beside = 0;
      for (int k = 0; k < 4; k++)
        beside |= r->tetrahedron[c][k] < r->shared_count;
      add_tet(beside ? &quality->beside : &quality->apart, &shape, aspect);
      quality->aspect_max = fmax(quality->aspect_max, aspect);
      int class = 0;
      while (class < 7 && aspect > limit[class])
        class ++;
      quality->aspect_class[class]++;
      quality->dihedral_least = fmin(quality->dihedral_least, shape.dihedral_least);
      quality->dihedral_greatest = fmax(quality->dihedral_greatest, shape.dihedral_greatest);
      quality->dihedral_bin[bin_of(shape.dihedral_least, 10.0, 18)]++;
    } else if (corners == 6) {
      double jacobian = cw_prism_scaled_jacobian(x);
      quality->prism_least_scaled_jacobian = fmin(quality->prism_least_scaled_jacobian, jacobian);
      quality->prism_jacobian_bin[bin_of(jacobian, 1.0 / CW_QUALITY_BINS, CW_QUALITY_BINS)]++;
    }
  }
  if (r->tetrahedron_count)
    quality->aspect_mean = aspects / r->tetrahedron_count;
done:
  return status;
}

CwStatus cw_audit_region(const CwRegionMesh *region, CwQuality *quality) {
  CwStatus status = CW_OK;
  cw_quality_start(quality);
  CW_TRY(check_indices(region));
  CW_TRY(check_cells(region, quality));
  CW_TRY(check_faces(region, region->point_count, quality));
done:
  return status;
}

CwStatus cw_audit_copy(const CwRegionMesh *copy, uint64_t *open_faces) {
  CwStatus status = CW_OK;
  CwQuality quality;
  const double *x[6];
  double volume;
  int corners;
  cw_quality_start(&quality);
  for (int64_t c = 0; c < cell_count(copy); c++)
    CW_TRY(check_volume(copy, c, &corners, x, &volume));
  CW_TRY(check_faces(copy, copy->shared_count, &quality));
  *open_faces = quality.open_faces;
done:
  return status;
}

void cw_quality_start(CwQuality *sum) {
  memset(sum, 0, sizeof *sum);
  sum->least_volume = INFINITY;
  sum->dihedral_least = 180.0;
  sum->beside.dihedral_least = sum->apart.dihedral_least = 180.0;
  sum->beside.mean_ratio_least = sum->apart.mean_ratio_least = 1.0;
  sum->prism_least_scaled_jacobian = 1.0;
}

void cw_quality_add(CwQuality *sum, const CwQuality *more, int64_t tetrahedra) {
  int64_t before = 0;
  for (int k = 0; k < 8; k++)
    before += sum->aspect_class[k];
  if (before + tetrahedra > 0) {
    sum->aspect_mean = (sum->aspect_mean * (double)before + more->aspect_mean * (double)tetrahedra) /
                       (double)(before + tetrahedra);
  }
  sum->volume += more->volume;
  sum->least_volume = fmin(sum->least_volume, more->least_volume);
  sum->cells += more->cells;
  sum->aspect_max = fmax(sum->aspect_max, more->aspect_max);
  for (int k = 0; k < 8; k++)
    sum->aspect_class[k] += more->aspect_class[k];
  sum->dihedral_least = fmin(sum->dihedral_least, more->dihedral_least);
  sum->dihedral_greatest = fmax(sum->dihedral_greatest, more->dihedral_greatest);
  for (int k = 0; k < 18; k++)
    sum->dihedral_bin[k] += more->dihedral_bin[k];
  add_figures(&sum->beside, &more->beside);
  add_figures(&sum->apart, &more->apart);
  sum->open_faces += more->open_faces;
  sum->prism_count += more->prism_count;
  sum->prism_least_scaled_jacobian =
      fmin(sum->prism_least_scaled_jacobian, more->prism_least_scaled_jacobian);
  for (int k = 0; k < CW_QUALITY_BINS; k++)
    sum->prism_jacobian_bin[k] += more->prism_jacobian_bin[k];
}
