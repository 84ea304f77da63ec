// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/audit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/mix.h"
#include "mesher/quality.h"

// One side of one face, seen from a cell or listed as boundary. Sides lie in buckets by their least point.
typedef struct {
  int32_t rest[3]; // the other points, ascending; the third of a triangle is -1
  int32_t cell;    // cell of the region, or -1 - listed face
  int8_t turn;     // direction of the face: which of the rest follows, and which precedes, the least point
} Side;

// What is known of a face within its bucket, kept at the first of its sides.
enum { FACE_SINGLE, FACE_INNER, FACE_OTHER };

// The sides of a bucket find each other in a small hash table, which the next bucket uses again.
typedef struct {
  int32_t *slot;  // place in the bucket of a face's first side, or -1
  int32_t *first; // by place in the bucket: the first side of the same face
  uint8_t *face;  // by place in the bucket, of first sides
} Match;

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

static inline void order_two(uint64_t *a, uint64_t *b) {
  uint64_t low = *a < *b ? *a : *b, high = *a < *b ? *b : *a;
  *a = low;
  *b = high;
}

// Fills *side. Without branches, which no processor could foresee: points are ordered with their places in the lowest
// bits.
static inline void side_of(int count, const int32_t *point, int64_t cell, Side *side) {
  uint64_t p[4];
  for (int k = 0; k < count; k++)
    p[k] = (uint64_t)(uint32_t)point[k] << 2 | (uint64_t)k;
  order_two(&p[0], &p[1]);
  if (count == 4) {
    order_two(&p[2], &p[3]);
    order_two(&p[0], &p[2]);
    order_two(&p[1], &p[3]);
  } else {
    order_two(&p[0], &p[2]);
  }
  order_two(&p[1], &p[2]);
  int least = (int)(p[0] & 3), follow = (least + 1) % count, precede = (least + count - 1) % count;
  int first = 0, last = 0;
  for (int k = 1; k < count; k++) {
    int place = (int)(p[k] & 3);
    side->rest[k - 1] = (int32_t)(p[k] >> 2);
    first += (k - 1) * (place == follow);
    last += (k - 1) * (place == precede);
  }
  if (count == 3)
    side->rest[2] = -1;
  side->cell = (int32_t)cell;
  side->turn = (int8_t)(4 * first + last);
}

// Both of one bucket.
static inline int same_face(const Side *a, const Side *b) {
  return a->rest[0] == b->rest[0] && a->rest[1] == b->rest[1] && a->rest[2] == b->rest[2];
}

static int compare_sides(const void *left, const void *right) {
  const Side *a = left, *b = right;
  for (int k = 0; k < 3; k++) {
    if (a->rest[k] != b->rest[k])
      return a->rest[k] < b->rest[k] ? -1 : 1;
  }
  return a->cell < b->cell ? 1 : a->cell > b->cell ? -1 : 0; // cells before listed faces
}

static int opposite_turn(int turn) {
  return 4 * (turn % 4) + turn / 4;
}

// Counts a side into its bucket (`side` NULL) or puts it there, if all its points are below `end`.
static inline void add_side(int count, const int32_t *point, int64_t cell, int32_t end, int64_t *start, Side *side) {
  int32_t least = point[0], greatest = point[0];
  for (int k = 1; k < count; k++) {
    least = point[k] < least ? point[k] : least;
    greatest = point[k] > greatest ? point[k] : greatest;
  }
  if (greatest >= end)
    return;
  int64_t at = start[least]++;
  if (side)
    side_of(count, point, cell, &side[at]);
}

static inline void add_cell_sides(const int32_t *corner, const int (*face)[4], int faces, int64_t cell, int32_t end,
                                  int64_t *start, Side *side) {
  for (int f = 0; f < faces; f++) {
    const int *at = face[f];
    if (at[3] < 0)
      add_side(3, (int32_t[3]){corner[at[0]], corner[at[1]], corner[at[2]]}, cell, end, start, side);
    else
      add_side(4, (int32_t[4]){corner[at[0]], corner[at[1]], corner[at[2]], corner[at[3]]}, cell, end, start, side);
  }
}

// Every face with all its points below `end`: all sides of cells, then all listed faces. With `side` NULL only counts
// buckets.
static void add_sides(const CwRegionMesh *r, int32_t end, int64_t *start, Side *side) {
  int64_t cell = 0;
  for (int32_t k = 0; k < r->tetrahedron_count; k++)
    add_cell_sides(r->tetrahedron[k], tet_face, 4, cell++, end, start, side);
  for (int32_t k = 0; k < r->pyramid_count; k++)
    add_cell_sides(r->pyramid[k], pyramid_face, 5, cell++, end, start, side);
  for (int32_t k = 0; k < r->prism_count; k++)
    add_cell_sides(r->prism[k], prism_face, 5, cell++, end, start, side);
  for (int32_t k = 0; k < r->triangle_count; k++)
    add_side(3, r->triangle[k], -1 - k, end, start, side);
  for (int32_t k = 0; k < r->quad_count; k++)
    add_side(4, r->quad[k], -1 - ((int64_t)r->triangle_count + k), end, start, side);
}

static uint64_t mixed(uint64_t h, uint64_t v) {
  return cw_mix((h ^ v) + CW_MIX_STEP);
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

// Bits of the table for so many sides: at least two places for each.
static int table_bits(int64_t count) {
  int bits = 1;
  while (count > (int64_t)1 << (bits - 1))
    bits++;
  return bits;
}

// Drops from a bucket the faces with one cell on each side and no more: most of all, and nothing is wrong with them.
// The sides of the others move to its front; returns their number.
static int32_t drop_inner_faces(const Match *m, int32_t count, Side *side) {
  int bits = table_bits(count);
  uint32_t mask = ((uint32_t)1 << bits) - 1;
  memset(m->slot, -1, ((size_t)mask + 1) * sizeof *m->slot);
  for (int32_t i = 0; i < count; i++) {
    uint64_t key = (uint64_t)(uint32_t)side[i].rest[0] << 32 | (uint32_t)side[i].rest[1];
    key = (key ^ (uint64_t)(uint32_t)side[i].rest[2] << 16) * 0x9e3779b97f4a7c15ull;
    uint32_t at = (uint32_t)(key >> (64 - bits));
    while (m->slot[at] >= 0 && !same_face(&side[m->slot[at]], &side[i]))
      at = (at + 1) & mask;
    if (m->slot[at] < 0) {
      m->slot[at] = m->first[i] = i;
      m->face[i] = FACE_SINGLE;
      continue;
    }
    int32_t first = m->first[i] = m->slot[at];
    int inner = side[first].cell >= 0 && side[i].cell >= 0 && side[i].turn == opposite_turn(side[first].turn);
    m->face[first] = m->face[first] == FACE_SINGLE && inner ? FACE_INNER : FACE_OTHER;
  }
  int32_t left = 0;
  for (int32_t i = 0; i < count; i++) {
    if (m->face[m->first[i]] != FACE_INNER)
      side[left++] = side[i];
  }
  return left;
}

// All faces with all their points below `end`: a counting sort of their sides by least point, then each bucket by
// itself.
static CwStatus check_faces(const CwRegionMesh *r, int32_t end, CwQuality *quality) {
  CwStatus status = CW_OK;
  int64_t *start = NULL;
  Side *sides = NULL;
  Match m = {0};
  CW_NEW(start, (int64_t)end + 1);
  add_sides(r, end, start, NULL);
  int64_t total = 0, most = 0;
  for (int32_t p = 0; p <= end; p++) {
    int64_t here = start[p];
    most = here > most ? here : most;
    start[p] = total;
    total += here;
  }
  CW_NEW_UNSET(sides, total);
  CW_NEW_UNSET(m.slot, (int64_t)1 << table_bits(most));
  CW_NEW_UNSET(m.first, most);
  CW_NEW_UNSET(m.face, most);
  add_sides(r, end, start, sides);
  // Filling moved each start to the end of its bucket.
  int64_t from = 0;
  for (int32_t p = 0; p < end; from = start[p++]) {
    Side *side = sides + from;
    int32_t left = drop_inner_faces(&m, (int32_t)(start[p] - from), side);
    if (left > 1)
      qsort(side, (size_t)left, sizeof *side, compare_sides);
    for (int32_t at = 0, next; at < left; at = next) {
      next = at + 1;
      while (next < left && same_face(&side[at], &side[next]))
        next++;
      CW_TRY(check_face(r, p, next - at, &side[at], quality));
    }
  }
done:
  free(m.slot);
  free(m.first);
  free(m.face);
  free(sides);
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
