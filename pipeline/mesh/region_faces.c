// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/region_faces.h"

#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"
#include "pipeline/order.h"

// One side of a face: seen from a cell (ref = CW_CELL_FACES * cell + face) or from a boundary face (ref below
// zero: -1 - place, triangles first, then quadrilaterals). The smallest node is known from the bucket; `key`
// holds its two neighbours, the smaller one first, and in the lowest bit whether the side runs to the larger
// one first; `opposite` is the fourth node, -1 in a triangle.
typedef struct {
  uint64_t key;
  int32_t opposite, ref;
} Side;

// Faces in the making. Sides lie in buckets by their smallest node; those of a bucket find each other in a small
// hash table, which the next bucket uses again.
typedef struct {
  const char *name;
  CwStatus fault;
  const CwRegionData *data;
  int32_t end;          // faces with all their nodes below it are matched
  int64_t *start;       // of the buckets by node
  Side *sides;          // NULL while they are counted
  int32_t *slot;        // the table: place in the bucket, or -1
  unsigned char *met;   // by place in the bucket: whether the side has found the other
  CwRegionFaces *faces; // NULL where only open faces are asked for
  int32_t *open;        // these, as refs
  int32_t open_count;
} Match;

int cw_face_loop(const int64_t *nodes, int count, int order[4]) {
  int first = 0;
  for (int i = 1; i < count; ++i)
    if (nodes[i] < nodes[first]) first = i;
  int64_t next = nodes[(first + 1) % count], last = nodes[(first + count - 1) % count];
  int reversed = last < next;
  for (int i = 0; i < count; ++i) order[i] = (first + (reversed ? count - i : i)) % count;
  return reversed;
}

void cw_region_faces_free(CwRegionFaces *faces) {
  free(faces->across);
  free(faces->triangle_face);
  free(faces->quad_face);
  memset(faces, 0, sizeof *faces);
}

// The nodes of a side; returns 3 or 4.
static int side_nodes(const CwRegionData *data, int32_t ref, int32_t nodes[4]) {
  if (ref >= 0) return cw_cell_face(data, ref / CW_CELL_FACES, ref % CW_CELL_FACES, nodes);
  int32_t place = -1 - ref;
  int count = place < data->triangle_count ? 3 : 4;
  memcpy(nodes, count == 3 ? data->triangles[place] : data->quads[place - data->triangle_count],
         (size_t)count * sizeof *nodes);
  return count;
}

static inline int32_t lesser(int32_t a, int32_t b) {
  return a < b ? a : b;
}

static inline int32_t greater(int32_t a, int32_t b) {
  return a < b ? b : a;
}

// The smallest node of a side; what else is to be known of it in `side`. Without branches, which no processor could
// foresee.
static inline int32_t side_make(const int32_t *n, int count, int32_t ref, Side *side) {
  int32_t low = lesser(n[0], n[2]), high = greater(n[0], n[2]); // of one diagonal of a quadrilateral
  int32_t least, next, last;
  unsigned reversed;
  if (count == 3) {
    least = lesser(low, n[1]);
    last = greater(high, n[1]);
    next = n[0] ^ n[1] ^ n[2] ^ least ^ last;
    reversed = (unsigned)(n[0] > n[1]) ^ (n[0] > n[2]) ^ (n[1] > n[2]);
    side->opposite = -1;
  } else {
    int32_t low2 = lesser(n[1], n[3]), high2 = greater(n[1], n[3]); // of the other
    int first = low < low2;
    least = first ? low : low2;
    next = first ? low2 : low;
    last = first ? high2 : high;
    side->opposite = first ? high : high2;
    reversed = (unsigned)(first ? (n[3] < n[1]) ^ (n[2] < n[0]) : (n[0] < n[2]) ^ (n[3] < n[1]));
  }
  side->key = (uint64_t)(uint32_t)next << 32 | (uint64_t)(uint32_t)last << 1 | reversed;
  side->ref = ref;
  return least;
}

static inline int same_face(const Side *a, const Side *b) {
  return a->key >> 1 == b->key >> 1 && a->opposite == b->opposite;
}

static CwStatus fail_at_face(const Match *m, int32_t ref, const char *what) {
  const CwRegionData *data = m->data;
  int32_t nodes[4], place = -1 - ref;
  int count = side_nodes(data, ref, nodes);
  double centre[3] = {0};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < count; ++i) centre[k] += 1e3 * data->points[nodes[i]][k] / count;
  int32_t cell = ref >= 0     ? ref / CW_CELL_FACES
                 : count == 3 ? data->triangle_cell[place]
                              : data->quad_cell[place - data->triangle_count];
  return CW_FAIL(m->fault, "%s: %s of cell %d at (%.6g, %.6g, %.6g) mm %s", m->name,
                 count == 3 ? "triangle" : "quadrilateral", cell, centre[0], centre[1], centre[2], what);
}

// Counts a side (`sides` NULL) or puts it into its bucket, if all its nodes lie below `end`.
static inline void add_side(const int32_t *nodes, int count, int32_t ref, int32_t end, int64_t *start, Side *sides) {
  Side side;
  for (int i = 0; i < count; ++i)
    if (nodes[i] >= end) return;
  int32_t least = side_make(nodes, count, ref, &side);
  if (sides)
    sides[start[least]++] = side;
  else
    ++start[least + 1];
}

// The four sides of a tetrahedron at once, as add_side() would do them one by one: with its nodes in order (a < b < c
// < d, the corner of each in the lowest bits) three sides have a as their smallest node, the fourth b.
static inline void add_tetrahedron(const int32_t *n, int32_t ref, int32_t end, int64_t *start, Side *sides) {
  static const signed char face_opposite[4] = {2, 3, 1, 0};
  if ((n[0] < end) + (n[1] < end) + (n[2] < end) + (n[3] < end) < 3) return;
  uint64_t p = (uint64_t)n[0] << 2, q = (uint64_t)n[1] << 2 | 1, r = (uint64_t)n[2] << 2 | 2;
  uint64_t s = (uint64_t)n[3] << 2 | 3;
  unsigned odd = (p > q) ^ (p > r) ^ (p > s) ^ (q > r) ^ (q > s) ^ (r > s); // of the permutation that orders them
  uint64_t low = p < q ? p : q, high = p < q ? q : p, low2 = r < s ? r : s, high2 = r < s ? s : r;
  uint64_t a = low < low2 ? low : low2, u = low < low2 ? low2 : low;
  uint64_t d = high < high2 ? high2 : high, v = high < high2 ? high : high2;
  uint64_t b = u < v ? u : v, c = u < v ? v : u;
  int32_t least = (int32_t)(a >> 2), second = (int32_t)(b >> 2);
  int whole = (int32_t)(d >> 2) < end;
  if (!sides) {
    start[least + 1] += whole ? 3 : 1;
    start[second + 1] += whole;
    return;
  }
  // Seen from outside a tetrahedron in order has its sides a c b, a b d, a d c and b c d.
  uint64_t b31 = (b >> 2) << 32, c31 = (c >> 2) << 32, c1 = (c >> 2) << 1, d1 = (d >> 2) << 1;
  Side *side = &sides[start[least]];
  side[0] = (Side){b31 | c1 | (odd ^ 1), -1, ref + face_opposite[d & 3]};
  if (!whole) {
    start[least] += 1;
    return;
  }
  side[1] = (Side){b31 | d1 | odd, -1, ref + face_opposite[c & 3]};
  side[2] = (Side){c31 | d1 | (odd ^ 1), -1, ref + face_opposite[b & 3]};
  start[least] += 3;
  sides[start[second]++] = (Side){c31 | d1 | odd, -1, ref + face_opposite[a & 3]};
}

// Every side with all its nodes below `end`, in the order of the cells but for the boundary faces, which stand before.
static void add_sides(const CwRegionData *data, int32_t end, int64_t *start, Side *sides) {
  for (int32_t i = 0; i < data->triangle_count; ++i) add_side(data->triangles[i], 3, -1 - i, end, start, sides);
  for (int32_t i = 0; i < data->quad_count; ++i)
    add_side(data->quads[i], 4, -1 - data->triangle_count - i, end, start, sides);
  for (int32_t cell = 0; cell < data->tetrahedron_count; ++cell)
    add_tetrahedron(data->tetrahedra[cell], CW_CELL_FACES * cell, end, start, sides);
  for (int32_t cell = data->tetrahedron_count, cells = cw_region_cell_count(data); cell < cells; ++cell) {
    int corners, below = 0;
    const int32_t *of_cell = cw_cell_nodes(data, cell, &corners);
    for (int i = 0; i < corners; ++i) below += of_cell[i] < end;
    if (below < 3) continue;
    const signed char(*face)[4] = cw_cell_face_table(corners);
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      int count = face[f][3] < 0 ? 3 : 4;
      const int32_t nodes[4] = {of_cell[face[f][0]], of_cell[face[f][1]], of_cell[face[f][2]],
                                of_cell[face[f][count - 1]]};
      if (count == 3)
        add_side(nodes, 3, CW_CELL_FACES * cell + f, end, start, sides);
      else
        add_side(nodes, 4, CW_CELL_FACES * cell + f, end, start, sides);
    }
  }
}

static CwStatus take_boundary_face(const Match *m, const Side *bound, const Side *of_cell) {
  CwStatus status = CW_OK;
  const CwRegionData *data = m->data;
  int32_t place = -1 - bound->ref;
  int is_quad = place >= data->triangle_count;
  if (is_quad) place -= data->triangle_count;
  int32_t said = is_quad ? data->quad_cell[place] : data->triangle_cell[place];
  if (bound->key != of_cell->key)
    CW_TRY(fail_at_face(m, of_cell->ref, "is listed as boundary with its normal into the domain"));
  if (said != of_cell->ref / CW_CELL_FACES)
    CW_TRY(fail_at_face(m, of_cell->ref, "is listed as boundary with the wrong cell"));
  if (m->faces) {
    m->faces->across[of_cell->ref] = CW_ACROSS_PATCH;
    (is_quad ? m->faces->quad_face : m->faces->triangle_face)[place] = of_cell->ref;
  }
done:
  return status;
}

// Two sides of one face; boundary faces come first.
static inline CwStatus take_pair(const Match *m, const Side *first, const Side *second) {
  CwRegionFaces *faces = m->faces;
  if (second->ref < 0) return fail_at_face(m, first->ref, "is listed as boundary more than once");
  if (first->ref < 0) return take_boundary_face(m, first, second);
  if (first->key == second->key) return fail_at_face(m, first->ref, "has both of its cells on one side");
  if (faces) {
    faces->across[first->ref] = second->ref / CW_CELL_FACES;
    faces->across[second->ref] = first->ref / CW_CELL_FACES;
    ++*(first->opposite < 0 ? &faces->inner_triangles : &faces->inner_quads);
  }
  return CW_OK;
}

// A side that has not met another.
static CwStatus take_single(Match *m, const Side *side) {
  CwStatus status = CW_OK;
  int32_t nodes[4];
  if (side->ref < 0) CW_TRY(fail_at_face(m, side->ref, "is listed as boundary but is no face of a cell"));
  for (int i = 0, count = side_nodes(m->data, side->ref, nodes); i < count; ++i)
    if (nodes[i] >= m->data->shared_count)
      CW_TRY(fail_at_face(m, side->ref, "is open: not listed as boundary and not on a partition plane"));
  if (m->faces)
    m->faces->across[side->ref] = CW_ACROSS_OPEN;
  else
    m->open[m->open_count] = side->ref;
  ++m->open_count;
done:
  return status;
}

// Bits of the table for so many sides: at least two places for each.
static int table_bits(int64_t count) {
  int bits = 1;
  while (count > (int64_t)1 << (bits - 1)) ++bits;
  return bits;
}

static CwStatus match_bucket(Match *m, const Side *side, int32_t count) {
  CwStatus status = CW_OK;
  int bits = table_bits(count);
  uint32_t mask = ((uint32_t)1 << bits) - 1;
  int32_t alone = count;
  memset(m->slot, -1, ((size_t)mask + 1) * sizeof *m->slot);
  for (int32_t i = 0; i < count; ++i) {
    uint64_t hash = ((side[i].key >> 1) ^ (uint64_t)(uint32_t)side[i].opposite << 16) * 0x9e3779b97f4a7c15u;
    uint32_t at = (uint32_t)(hash >> (64 - bits));
    while (m->slot[at] >= 0 && !same_face(&side[m->slot[at]], &side[i])) at = (at + 1) & mask;
    int32_t first = m->slot[at];
    m->met[i] = first >= 0;
    if (first < 0) {
      m->slot[at] = i;
      continue;
    }
    if (m->met[first]) CW_TRY(fail_at_face(m, side[i].ref, "belongs to more than two cells or boundary faces"));
    m->met[first] = 1;
    alone -= 2;
    CW_TRY(take_pair(m, &side[first], &side[i]));
  }
  for (int32_t i = 0; alone > 0; ++i)
    if (!m->met[i]) {
      --alone;
      CW_TRY(take_single(m, &side[i]));
    }
done:
  return status;
}

// A counting sort of the sides by smallest node, then each bucket by itself.
static CwStatus match_all(Match *m) {
  CwStatus status = CW_OK;
  const CwRegionData *data = m->data;
  int64_t most = 0;
  CW_REQUIRE((int64_t)CW_CELL_FACES * cw_region_cell_count(data) + data->triangle_count + data->quad_count <= INT32_MAX,
             m->fault, "%s: %d cells; a region may have %d", m->name, cw_region_cell_count(data),
             INT32_MAX / CW_CELL_FACES);
  CW_NEW(m->start, (size_t)m->end + 2);
  add_sides(data, m->end, m->start, NULL);
  for (int32_t p = 0; p < m->end; ++p) {
    most = m->start[p + 1] > most ? m->start[p + 1] : most;
    m->start[p + 1] += m->start[p];
  }
  CW_NEW_UNSET(m->sides, m->start[m->end]);
  CW_NEW_UNSET(m->slot, (size_t)1 << table_bits(most));
  CW_NEW_UNSET(m->met, most);
  if (!m->faces) CW_NEW_UNSET(m->open, m->start[m->end]);
  add_sides(data, m->end, m->start, m->sides); // leaves start[p] at the end of bucket p
  for (int64_t first = 0, p = 0; p < m->end; first = m->start[p++])
    CW_TRY(match_bucket(m, m->sides + first, (int32_t)(m->start[p] - first)));
done:
  free(m->start);
  free(m->sides);
  free(m->slot);
  free(m->met);
  return status;
}

CwStatus cw_region_faces(const char *name, CwStatus fault, const CwRegionData *data, CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  Match m = {.name = name, .fault = fault, .data = data, .end = data->point_count, .faces = faces};
  size_t cell_faces = (size_t)CW_CELL_FACES * (size_t)cw_region_cell_count(data);
  CW_NEW_UNSET(faces->across, cell_faces);
  CW_NEW_UNSET(faces->triangle_face, data->triangle_count);
  CW_NEW_UNSET(faces->quad_face, data->quad_count);
  memset(faces->across, CW_ACROSS_NO_FACE, cell_faces * sizeof *faces->across);
  CW_TRY(match_all(&m));
  faces->open_count = m.open_count;
done:
  return status;
}

CwStatus cw_region_open_faces(const char *name, CwStatus fault, const CwRegionData *data, int only_shared,
                              int32_t **open, int32_t *count) {
  Match m = {.name = name, .fault = fault, .data = data, .end = only_shared ? data->shared_count : data->point_count};
  CwStatus status = match_all(&m);
  if (status == CW_OK) qsort(m.open, (size_t)m.open_count, sizeof *m.open, cw_order_int32s);
  *open = m.open;
  *count = m.open_count;
  return status;
}
