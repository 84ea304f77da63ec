// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/region_faces.h"

#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"
#include "pipeline/order.h"

// One side of a face: seen from a cell (ref = CW_CELL_FACES * cell + face) or from a boundary face (ref below
// zero: -1 - place, triangles first, then quadrilaterals). The smallest node is known from the list it stands in; `key`
// holds its two neighbours, the smaller one first, and in the lowest bit whether the side runs to the larger
// one first; `opposite` is the fourth node, -1 in a triangle.
typedef struct {
  uint64_t key;
  int32_t opposite, ref;
  int32_t next; // place of the next one in the list, or of the next free one; NONE at the end
} Side;

enum { NONE = -1, MET = INT32_MIN };            // no place; the ref of a side that has met the other one
enum { AHEAD = 6 };                             // cells
enum { LIST_BITS = 3, LISTS = 1 << LIST_BITS }; // of a node: then a list has about one side

// Faces in the making. A side waits in one of the lists of its smallest node until the other one comes. Cells near in
// number are near in space: few sides wait at a time, and they are at hand.
typedef struct {
  const char *name;
  CwStatus fault;
  const CwRegionData *data;
  int32_t end;    // faces with all their nodes below it are matched
  int32_t *first; // place of the first side of each list, LISTS a node
  Side *sides;
  int32_t capacity, used, free; // of `sides`: places, those taken so far, the first that is free again
  CwRegionFaces *faces;         // NULL where only open faces are asked for
  void (*pair)(void *given, int32_t cell, int32_t other); // is shown the two cells of each face; may be NULL
  void *given;
  int32_t *open; // open faces, as refs
  int32_t open_count, open_capacity;
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

static inline int is_shared(const CwRegionData *data, const Side *side) {
  const int32_t next = (int32_t)(side->key >> 32), last = (int32_t)((uint32_t)side->key >> 1);
  return (next < data->shared_count) & (last < data->shared_count) & (side->opposite < data->shared_count);
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
  if (m->pair) m->pair(m->given, first->ref / CW_CELL_FACES, second->ref / CW_CELL_FACES);
  return CW_OK;
}

// How often the face of a side is named by cells and boundary faces, all of which it looks through: for a message.
static int times_named(const CwRegionData *data, int32_t ref) {
  int times = 0;
  int32_t nodes[4], last = CW_CELL_FACES * cw_region_cell_count(data);
  Side side, other;
  const int32_t least = side_make(nodes, side_nodes(data, ref, nodes), ref, &side);
  for (int32_t r = -data->triangle_count - data->quad_count; r < last; ++r) {
    int corners = 4;
    if (r >= 0) cw_cell_nodes(data, r / CW_CELL_FACES, &corners);
    if (r >= 0 && corners == 4 && r % CW_CELL_FACES == 4) continue; // a tetrahedron has four faces
    times += side_make(nodes, side_nodes(data, r, nodes), r, &other) == least && same_face(&side, &other);
  }
  return times;
}

// A side that has not met another.
static CwStatus take_single(Match *m, const Side *side) {
  CwStatus status = CW_OK;
  if (side->ref < 0) CW_TRY(fail_at_face(m, side->ref, "is listed as boundary but is no face of a cell"));
  if (!is_shared(m->data, side))
    CW_TRY(fail_at_face(m, side->ref,
                        times_named(m->data, side->ref) > 2
                            ? "belongs to more than two cells or boundary faces"
                            : "is open: not listed as boundary and not on a partition plane"));
  if (m->faces) {
    m->faces->across[side->ref] = CW_ACROSS_OPEN;
  } else {
    CW_GROW(m->open, m->open_capacity, m->open_count + 1);
    m->open[m->open_count] = side->ref;
  }
  ++m->open_count;
done:
  return status;
}

// Puts a side to those that wait, or takes it with the one that it meets. Where all nodes are shared a face may stay
// open, so that of three sides the last would not be found: the one that was met stays, too.
static inline CwStatus meet(Match *m, int32_t least, const Side *side) {
  CwStatus status = CW_OK;
  const uint64_t hash = ((side->key >> 1) ^ (uint64_t)(uint32_t)side->opposite << 16) * 0x9e3779b97f4a7c15u;
  int32_t *const first = m->first + (size_t)LISTS * (size_t)least + (size_t)(hash >> (64 - LIST_BITS)), *link = first;
  while (*link != NONE && !same_face(&m->sides[*link], side)) link = &m->sides[*link].next;
  const int32_t at = *link;
  if (at != NONE) {
    Side *other = &m->sides[at];
    if (other->ref == MET) CW_TRY(fail_at_face(m, side->ref, "belongs to more than two cells or boundary faces"));
    CW_TRY(take_pair(m, other, side));
    other->ref = MET;
    if (!is_shared(m->data, side)) {
      *link = other->next;
      other->next = m->free;
      m->free = at;
    }
  } else {
    int32_t place = m->free;
    if (place == NONE) {
      CW_GROW(m->sides, m->capacity, m->used + 1);
      place = m->used++;
    } else {
      m->free = m->sides[place].next;
    }
    m->sides[place] = *side;
    m->sides[place].next = *first;
    *first = place;
  }
done:
  return status;
}

static inline CwStatus add_side(Match *m, const int32_t *nodes, int count, int32_t ref) {
  Side side;
  for (int i = 0; i < count; ++i)
    if (nodes[i] >= m->end) return CW_OK;
  const int32_t least = side_make(nodes, count, ref, &side);
  return meet(m, least, &side);
}

// The four sides of a tetrahedron at once, as add_side() would do them one by one: with its nodes in order (a < b < c
// < d, the corner of each in the lowest bits) three sides have a as their smallest node, the fourth b.
static inline CwStatus add_tetrahedron(Match *m, const int32_t *n, int32_t ref) {
  static const signed char face_opposite[4] = {2, 3, 1, 0};
  CwStatus status = CW_OK;
  const int32_t end = m->end;
  if ((n[0] < end) + (n[1] < end) + (n[2] < end) + (n[3] < end) < 3) return CW_OK;
  uint64_t p = (uint64_t)n[0] << 2, q = (uint64_t)n[1] << 2 | 1, r = (uint64_t)n[2] << 2 | 2;
  uint64_t s = (uint64_t)n[3] << 2 | 3;
  unsigned odd = (p > q) ^ (p > r) ^ (p > s) ^ (q > r) ^ (q > s) ^ (r > s); // of the permutation that orders them
  uint64_t low = p < q ? p : q, high = p < q ? q : p, low2 = r < s ? r : s, high2 = r < s ? s : r;
  uint64_t a = low < low2 ? low : low2, u = low < low2 ? low2 : low;
  uint64_t d = high < high2 ? high2 : high, v = high < high2 ? high : high2;
  uint64_t b = u < v ? u : v, c = u < v ? v : u;
  const int32_t least = (int32_t)(a >> 2);
  // Seen from outside a tetrahedron in order has its sides a c b, a b d, a d c and b c d.
  uint64_t b31 = (b >> 2) << 32, c31 = (c >> 2) << 32, c1 = (c >> 2) << 1, d1 = (d >> 2) << 1;
  CW_TRY(meet(m, least, &(Side){b31 | c1 | (odd ^ 1), -1, ref + face_opposite[d & 3], NONE}));
  if ((int32_t)(d >> 2) >= end) goto done;
  CW_TRY(meet(m, least, &(Side){b31 | d1 | odd, -1, ref + face_opposite[c & 3], NONE}));
  CW_TRY(meet(m, least, &(Side){c31 | d1 | (odd ^ 1), -1, ref + face_opposite[b & 3], NONE}));
  CW_TRY(meet(m, (int32_t)(b >> 2), &(Side){c31 | d1 | odd, -1, ref + face_opposite[a & 3], NONE}));
done:
  return status;
}

// The sides of a pyramid or a prism.
static CwStatus add_cell(Match *m, int32_t cell) {
  CwStatus status = CW_OK;
  int corners, below = 0;
  const int32_t *of_cell = cw_cell_nodes(m->data, cell, &corners);
  for (int i = 0; i < corners; ++i) below += of_cell[i] < m->end;
  if (below < 3) goto done;
  const signed char(*face)[4] = cw_cell_face_table(corners);
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    const int count = face[f][3] < 0 ? 3 : 4;
    const int32_t nodes[4] = {of_cell[face[f][0]], of_cell[face[f][1]], of_cell[face[f][2]],
                              of_cell[face[f][count - 1]]};
    CW_TRY(add_side(m, nodes, count, CW_CELL_FACES * cell + f));
  }
done:
  return status;
}

// Boundary faces first, so that each meets its cell; then what is left over.
static CwStatus match_all(Match *m) {
  CwStatus status = CW_OK;
  const CwRegionData *data = m->data;
  const int32_t cells = cw_region_cell_count(data);
  CW_REQUIRE((int64_t)CW_CELL_FACES * cells + data->triangle_count + data->quad_count <= INT32_MAX, m->fault,
             "%s: %d cells; a region may have %d", m->name, cells, INT32_MAX / CW_CELL_FACES);
  m->free = NONE;
  const size_t lists = (size_t)LISTS * (size_t)m->end;
  CW_NEW_UNSET(m->first, lists);
  memset(m->first, NONE, lists * sizeof *m->first);
  for (int32_t i = 0; i < data->triangle_count; ++i) CW_TRY(add_side(m, data->triangles[i], 3, -1 - i));
  for (int32_t i = 0; i < data->quad_count; ++i) CW_TRY(add_side(m, data->quads[i], 4, -1 - data->triangle_count - i));
  for (int32_t cell = 0; cell < data->tetrahedron_count; ++cell) {
    // The lists of a tetrahedron are asked for before its turn.
    const int32_t *n = data->tetrahedra[cell + AHEAD < data->tetrahedron_count ? cell + AHEAD : cell];
    const int32_t least = lesser(lesser(n[0], n[1]), lesser(n[2], n[3]));
    if (least < m->end) __builtin_prefetch(m->first + (size_t)LISTS * (size_t)least);
    CW_TRY(add_tetrahedron(m, data->tetrahedra[cell], CW_CELL_FACES * cell));
  }
  for (int32_t cell = data->tetrahedron_count; cell < cells; ++cell) CW_TRY(add_cell(m, cell));
  for (int of_cells = 0; of_cells < 2; ++of_cells) // a boundary face that is no cell's tells more than a face left open
    for (int32_t at = 0; at < m->used; ++at)
      if (m->sides[at].ref != MET && (m->sides[at].ref >= 0) == of_cells) CW_TRY(take_single(m, &m->sides[at]));
done:
  free(m->first);
  free(m->sides);
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
                              void (*pair)(void *given, int32_t cell, int32_t other), void *given, int32_t **open,
                              int32_t *count) {
  Match m = {.name = name,
             .fault = fault,
             .data = data,
             .end = only_shared ? data->shared_count : data->point_count,
             .pair = pair,
             .given = given};
  CwStatus status = match_all(&m);
  if (status == CW_OK) qsort(m.open, (size_t)m.open_count, sizeof *m.open, cw_order_int32s);
  *open = m.open;
  *count = m.open_count;
  return status;
}
