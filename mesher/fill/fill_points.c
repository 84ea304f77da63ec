// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box.h"
#include "mesher/common/branchless.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/common/verticals.h"
#include "mesher/fill/fill_reach.h"
#include "mesher/fill/lattice_places.h"
#include "mesher/fill/offset_points.h"
#include "mesher/policy.h"

enum { DEPTH = 19, COARSE = 2 }; // levels of the octree; lattice cells along one with a list of its own

// A box in finest cells of the octree, both ends in it: 20 bits an axis, and a guard over each, so that one subtraction
// compares all three.
typedef struct {
  uint64_t low, high;
} Box;

enum { AXIS = 21 }; // bits
#define UNITS (1ull | 1ull << 21 | 1ull << 42)
#define GUARDS (UNITS << 20)
static const Box nowhere = {GUARDS - UNITS, 0};

// What reaches a cell of the octree that is not cut for the sake of the boundary any more.
typedef struct {
  int32_t triangles, count; // items, from list: so many triangles, and with offset points
  int64_t list;
  int whole; // none reaches it: all of it is inside
  int clear; // none is in it
} Reached;

// The triangles of the boundary, then the candidates of offset points.
typedef struct {
  Box *reach;        // of each; of offset points, once the octree is cut, of those that are chosen
  Box *own;          // of each, without the distance that it keeps
  CwReachBall *ball; // of each triangle
  CwOffsetPoint *offset;
  int32_t *offset_cell; // that each candidate lies in, or -1
  uint8_t *chosen;      // of each candidate
  int32_t *near;        // items whose boxes hold a point
} Items;

typedef struct {
  int32_t *item;
  int64_t count, capacity;
} List;

typedef struct {
  const CwFillInput *input;
  CwVerticals *verticals;
  Items items;
  CwLatticeFrame frame;
  double per_unit;  // 1 / frame.unit
  double clearance; // factor on the distances to the boundary
  CwLatticeCell *cell;
  Reached *reached; // of each cell
  int32_t cell_count, cell_capacity, reached_capacity;
  List list; // of cells
  List open; // of cells that are still being cut, each after that of the cell that it came from
  uint8_t children[64];
} Tree;

static uint64_t pack(const Tree *tree, double x, double y, double z) {
  const double most = (double)((1 << (AXIS - 1)) - 1), place[3] = {x, y, z};
  uint64_t packed = 0;
  for (int i = 0; i < 3; i++) {
    double cells = (place[i] - tree->frame.origin[i]) * tree->per_unit;
    cells = cells > 0.0 ? cells : 0.0;
    packed |= (uint64_t)(int64_t)(cells < most ? cells : most) << (AXIS * i);
  }
  return packed;
}

static uint64_t pack_cell(const int32_t at[3], int32_t further) { // along all axes
  return (uint64_t)(at[0] + further) | (uint64_t)(at[1] + further) << AXIS | (uint64_t)(at[2] + further) << (2 * AXIS);
}

static Box pack_box(const Tree *tree, const CwReachBox *box) {
  return (Box){pack(tree, box->low[0], box->low[1], box->low[2]), pack(tree, box->high[0], box->high[1], box->high[2])};
}

static Box reach_of_offset(const Tree *tree, int32_t p) {
  const CwOffsetPoint *place = &tree->items.offset[p];
  CwReachBox box = cw_reach_box(place->x, cw_policy.least_distance * place->spacing);
  return pack_box(tree, &box);
}

// The guards of the axes along which a <= b.
static inline uint64_t at_most(uint64_t a, uint64_t b) {
  return ((b | GUARDS) - a) & GUARDS;
}

static inline int holds(const Box *box, uint64_t place) {
  return (at_most(box->low, place) & at_most(place, box->high)) == GUARDS;
}

static CwStatus reach_of(Tree *tree, int32_t t, CwReachBox *box, double *area, double *weight) {
  CwStatus status = CW_OK;
  const CwFillInput *input = tree->input;
  const double *a = input->x[input->triangle[t][0]], *b = input->x[input->triangle[t][1]];
  const double *c = input->x[input->triangle[t][2]];
  double normal[3], mean[3], h;
  for (int i = 0; i < 3; i++) mean[i] = (a[i] + b[i] + c[i]) / 3.0;
  CW_TRY(cw_lattice_size(input, mean, &h));
  cw_reach_of_triangle(a, b, c, 1.5 * h, tree->clearance, box, &tree->items.ball[t]);
  cw_normal(a, b, c, normal);
  double here = cw_norm(normal);
  *area += here;
  *weight += here * log(h);
done:
  return status;
}

// Of these items those whose boxes hold a place, into tree->items.near.
static int32_t find_near(const Tree *tree, const int32_t *list, int32_t count, uint64_t place) {
  int32_t near = 0;
  for (int32_t k = 0; k < count; k++) {
    tree->items.near[near] = list[k];
    near += (int32_t)cw_branchless(holds(&tree->items.reach[list[k]], place));
  }
  return near;
}

// Whether an item of the cell keeps a lattice point, or an offset point, away from x: offset points first, which take
// little time, then spheres, and at last distances.
static int is_forbidden(const Tree *tree, const Reached *reached, const double x[3], int is_offset) {
  const CwFillInput *input = tree->input;
  const int32_t *list = tree->list.item + reached->list;
  uint64_t place = pack(tree, x[0], x[1], x[2]);
  int32_t near = find_near(tree, list + reached->triangles, reached->count - reached->triangles, place);
  for (int32_t k = 0; k < near; k++) {
    const CwOffsetPoint *point = &tree->items.offset[tree->items.near[k] - input->triangle_count];
    double nearest = cw_policy.least_distance * point->spacing, d[3];
    cw_sub(x, point->x, d);
    if (cw_dot(d, d) < nearest * nearest) return 1;
  }
  near = find_near(tree, list, reached->triangles, place);
  int32_t first_open = input->triangle_count - input->open_count;
  for (int32_t k = 0; k < near && !is_offset && tree->items.near[k] < first_open; k++) {
    if (cw_reach_in_ball(&tree->items.ball[tree->items.near[k]], x)) return 1;
  }
  double h = near ? input->size(input->size_context, x) : 0.0;
  for (int32_t k = 0; k < near; k++) {
    const int32_t *q = input->triangle[tree->items.near[k]];
    const CwReachBall *ball = &tree->items.ball[tree->items.near[k]];
    if (cw_reach_is_near(input->x[q[0]], input->x[q[1]], input->x[q[2]], ball, h, tree->clearance, x)) return 1;
  }
  return 0;
}

static void centre_of(const Tree *tree, const int32_t at[3], int level, double x[3]) {
  for (int i = 0; i < 3; i++) x[i] = tree->frame.origin[i] + tree->frame.unit * (at[i] + 0.5 * (double)(1 << level));
}

static void child_of(const int32_t at[3], int level, int child, int32_t corner[3]) {
  for (int i = 0; i < 3; i++) corner[i] = at[i] + ((child >> i & 1) << (level - 1));
}

// Whether no item lies in the cell, as far as their own boxes tell, without the distances that they keep.
static int is_clear(const Tree *tree, const int32_t at[3], int level, const int32_t *list, int32_t list_count) {
  uint64_t low = pack_cell(at, 0), high = pack_cell(at, 1 << level);
  for (int32_t k = 0; k < list_count; k++) {
    const Box *own = &tree->items.own[list[k]];
    if ((at_most(own->low, high) & at_most(low, own->high)) == GUARDS) return 0;
  }
  return 1;
}

// The children of a cell that a box reaches into, as bits, by the axes along which it reaches below the middle (three
// bits) and beyond it (three more).
static void name_children(uint8_t children[64]) {
  static const uint8_t lower[3] = {0x55, 0x33, 0x0f};
  for (int k = 0; k < 64; k++) {
    unsigned bits = 0xff;
    for (int i = 0; i < 3; i++) bits &= (k >> i & 1 ? lower[i] : 0u) | (k >> (i + 3) & 1 ? 0xffu & ~lower[i] : 0u);
    children[k] = (uint8_t)bits;
  }
}

// Hands the items of a cell, at `list` of the open ones, down to its children, of which child c gets child_count[c]
// from first + c * list_count on: each item is written to all of them, and stays where the child keeps it, without a
// branch. What only touches the middle goes to both sides, since points are shaken a little.
static CwStatus divide_list(Tree *tree, const int32_t at[3], int level, int64_t list, int32_t list_count,
                            int64_t *first, int32_t child_count[8]) {
  CwStatus status = CW_OK;
  uint64_t middle = pack_cell(at, 1 << (level - 1)), before = middle - UNITS;
  int32_t *to[8];
  *first = tree->open.count;
  CW_GROW(tree->open.item, tree->open.capacity, tree->open.count + 8 * (int64_t)list_count + 1);
  tree->open.count += 8 * (int64_t)list_count;
  for (int c = 0; c < 8; c++) to[c] = tree->open.item + *first + (int64_t)c * list_count;
  for (int32_t k = 0; k < list_count; k++) {
    int32_t item = tree->open.item[list + k];
    const Box *reach = &tree->items.reach[item];
    uint64_t sides = at_most(reach->low, middle) >> 20 | at_most(before, reach->high) >> 17;
    unsigned children = tree->children[(sides | sides >> 20 | sides >> 40) & 63];
    for (int c = 0; c < 8; c++) {
      *to[c] = item;
      to[c] += children >> c & 1;
    }
  }
  for (int c = 0; c < 8; c++) child_count[c] = (int32_t)(to[c] - (tree->open.item + *first + (int64_t)c * list_count));
done:
  return status;
}

// A cell that is not cut by the boundary any more.
static CwStatus add_cell(Tree *tree, const int32_t at[3], int level, int64_t list, int32_t list_count, int inside) {
  CwStatus status = CW_OK;
  int clear = is_clear(tree, at, level, tree->open.item + list, list_count);
  CW_GROW(tree->cell, tree->cell_capacity, tree->cell_count + 1);
  CW_GROW(tree->reached, tree->reached_capacity, tree->cell_count + 1);
  CW_GROW(tree->list.item, tree->list.capacity, tree->list.count + list_count);
  int32_t *its = tree->list.item + tree->list.count, triangles = list_count, first = tree->input->triangle_count;
  if (list_count) memcpy(its, tree->open.item + list, (size_t)list_count * sizeof *its);
  const Box box = {pack_cell(at, 0), pack_cell(at, (1 << level) - 1)};
  for (; triangles > 0 && its[triangles - 1] >= first; triangles--) { // offset points come last
    int32_t item = its[triangles - 1];
    if (holds(&box, tree->items.own[item].low)) tree->items.offset_cell[item - first] = tree->cell_count;
  }
  tree->reached[tree->cell_count] = (Reached){triangles, list_count, tree->list.count, list_count == 0, clear};
  tree->cell[tree->cell_count++] = (CwLatticeCell){{at[0], at[1], at[2]}, level, inside};
  tree->list.count += list_count;
done:
  return status;
}

// Cuts down to coarse cells.
static CwStatus cut_coarse(Tree *tree, const int32_t at[3], int level, int64_t list, int32_t list_count) {
  CwStatus status = CW_OK;
  double centre[3], size, edge = tree->frame.unit * (double)(1 << level);
  int64_t first;
  int32_t child_count[8];
  centre_of(tree, at, level, centre);
  CW_TRY(cw_lattice_size(tree->input, centre, &size));
  if (list_count == 0 || level == 0 || edge <= COARSE * CW_LATTICE_CONSTANT * size) {
    int inside = cw_verticals_inside(tree->verticals, centre);
    if (list_count || inside) CW_TRY(add_cell(tree, at, level, list, list_count, inside));
    goto done;
  }
  CW_TRY(divide_list(tree, at, level, list, list_count, &first, child_count));
  for (int child = 0; child < 8; child++) {
    int32_t corner[3];
    child_of(at, level, child, corner);
    CW_TRY(cut_coarse(tree, corner, level - 1, first + (int64_t)child * list_count, child_count[child]));
  }
  tree->open.count = first;
done:
  return status;
}

// Takes the places that were not chosen out of the lists.
static void shorten_lists(Tree *tree) {
  for (int32_t c = 0; c < tree->cell_count; c++) {
    Reached *reached = &tree->reached[c];
    int32_t *list = tree->list.item + reached->list, count = reached->triangles;
    for (int32_t k = count; k < reached->count; k++) {
      list[count] = list[k];
      count += tree->items.chosen[list[k] - tree->input->triangle_count];
    }
    reached->count = count;
  }
}

// Of the candidates of offset points, one after the other, those that are inside and that neither the boundary nor
// those chosen before forbid. Returns how many.
static int32_t choose_offsets(Tree *tree) {
  int32_t chosen = 0;
  Box *reach = tree->items.reach + tree->input->triangle_count;
  for (int32_t p = 0; p < tree->input->offset_count; p++) reach[p] = nowhere;
  for (int32_t p = 0; p < tree->input->offset_count; p++) {
    const double *x = tree->items.offset[p].x;
    int32_t cell = tree->items.offset_cell[p];
    if (cell < 0 || is_forbidden(tree, &tree->reached[cell], x, 1) || !cw_verticals_inside(tree->verticals, x))
      continue;
    reach[p] = reach_of_offset(tree, p);
    tree->items.chosen[p] = 1;
    chosen++;
  }
  shorten_lists(tree);
  return chosen;
}

static int is_asked(const CwFillInput *input, const double x[3]) {
  for (int32_t s = 0; s < input->slab_count; s++) {
    if (fabs(cw_plane_distance(&input->slab[s].plane, x)) <= input->slab[s].reach) return 1;
  }
  return input->slab_count == 0;
}

// Of the places of the lattice those that are asked for, inside and not forbidden. A line along z is cut once for all
// its places: near the boundary, where the jitter would make a difference, they are forbidden. Offset points come last.
static CwStatus collect(Tree *tree, int64_t place_count, const CwRadix *places, int32_t *count, double (**x)[3],
                        CwLatticeSite **site) {
  CwStatus status = CW_OK;
  double(*points)[3] = NULL;
  CwLatticeSite *sites = NULL;
  const double *z = NULL;
  int32_t kept = 0, crossings = 0, chosen = choose_offsets(tree);
  uint64_t cut = ~0ull;
  CW_REQUIRE(place_count < INT32_MAX / 16, CW_ERR_MESH,
             "%s: the size field asks for %lld points in one region; allowed: below %d; lower mesh.cells_per_region",
             tree->input->name, (long long)place_count, INT32_MAX / 16);
  CW_NEW_UNSET(points, place_count + chosen);
  if (site) CW_NEW_UNSET(sites, place_count + chosen);
  for (int64_t k = 0; k < place_count; k++) {
    const CwRadix *place = &places[k];
    const Reached *reached = &tree->reached[place->item];
    double p[3], fixed[3];
    if (!reached->whole) {
      cw_lattice_fixed(&tree->frame, place->key, fixed);
      if (place->key >> 21 != cut) {
        cut = place->key >> 21;
        CW_TRY(cw_verticals_cut(tree->verticals, fixed[0], fixed[1], &crossings, &z));
      }
      int inside = 0;
      for (int32_t c = 0; c < crossings; c++) inside ^= z[c] > fixed[2];
      if (!inside) continue;
    }
    cw_lattice_point(&tree->frame, place, p);
    if (!is_asked(tree->input, p) || (!reached->whole && is_forbidden(tree, reached, p, 0))) continue;
    if (site) sites[kept] = (CwLatticeSite){place->key, place->tag, reached->clear};
    memcpy(points[kept++], p, sizeof p);
  }
  for (int32_t p = 0; p < tree->input->offset_count; p++) {
    if (!tree->items.chosen[p] || !is_asked(tree->input, tree->items.offset[p].x)) continue;
    if (site) sites[kept] = (CwLatticeSite){CW_LATTICE_NO_PLACE + (uint64_t)p, 0, 0};
    memcpy(points[kept++], tree->items.offset[p].x, sizeof *points);
  }
  *count = kept;
  *x = points;
  points = NULL;
  if (site) *site = sites;
  sites = NULL;
done:
  free(points);
  free(sites);
  return status;
}

// Of all items, now that the octree is known.
static void name_boxes(Tree *tree, const CwReachBox *reach) {
  const CwFillInput *input = tree->input;
  for (int32_t t = 0; t < input->triangle_count; t++) {
    const int32_t *q = input->triangle[t];
    CwBox own = cw_box_of_triangle(input->x[q[0]], input->x[q[1]], input->x[q[2]]);
    const double *low = own.low, *high = own.high;
    tree->items.reach[t] = pack_box(tree, &reach[t]);
    tree->items.own[t] = (Box){pack(tree, low[0], low[1], low[2]), pack(tree, high[0], high[1], high[2])};
  }
  for (int32_t p = 0; p < input->offset_count; p++) {
    const double *x = tree->items.offset[p].x;
    uint64_t own = pack(tree, x[0], x[1], x[2]);
    tree->items.reach[input->triangle_count + p] = reach_of_offset(tree, p);
    tree->items.own[input->triangle_count + p] = (Box){own, own};
  }
  name_children(tree->children);
}

CwStatus cw_fill_points(const CwFillInput *input, double clearance, int32_t *count, double (**x)[3],
                        CwLatticeSite **site) {
  CwStatus status = CW_OK;
  Tree whole = {.input = input, .clearance = clearance}, *tree = &whole;
  CwReachBox *box = NULL;
  CwRadix *place = NULL;
  int64_t places;
  CwBox within = cw_box_empty();
  double area = 0.0, weight = 0.0;
  int above = 0;
  *count = 0;
  *x = NULL;
  if (site) *site = NULL;
  CW_TRY(cw_verticals_make(input->x, input->triangle_count, input->triangle, &tree->verticals));
  int32_t items = input->triangle_count + input->offset_count;
  CW_NEW_UNSET(box, input->triangle_count);
  CW_NEW_UNSET(tree->items.reach, items);
  CW_NEW_UNSET(tree->items.own, items);
  CW_NEW_UNSET(tree->items.ball, input->triangle_count);
  CW_NEW_UNSET(tree->items.offset_cell, input->offset_count);
  memset(tree->items.offset_cell, -1, (size_t)input->offset_count * sizeof *tree->items.offset_cell);
  CW_NEW(tree->items.chosen, input->offset_count);
  CW_NEW_UNSET(tree->items.near, items);
  for (int32_t t = 0; t < input->triangle_count; t++) {
    CW_TRY(reach_of(tree, t, &box[t], &area, &weight));
    for (int k = 0; k < 3; k++) cw_box_add_point(&within, input->x[input->triangle[t][k]]);
  }
  CW_TRY(cw_offset_points(input, &tree->items.offset));
  double extent = cw_box_longest(&within);
  // The mean size of the boundary is a cell size exactly, so that a uniform field is met exactly.
  double edge = CW_LATTICE_CONSTANT * exp(weight / area);
  while (edge * (double)(1 << above) < 1.001 * extent) {
    above++;
    CW_REQUIRE(above <= DEPTH, CW_ERR_MESH,
               "%s: the size field asks for edges of %.3g mm in a region of %.6g mm; allowed: above %.3g mm there, by "
               "fewer mesh.cells or greater mesh.size_... of its walls",
               input->name, cw_mm(edge / CW_LATTICE_CONSTANT), cw_mm(extent),
               cw_mm(1.001 * extent / (CW_LATTICE_CONSTANT * (double)(1 << DEPTH))));
  }
  int below = DEPTH - above < 8 ? DEPTH - above : 8;
  tree->frame.unit = edge / (double)(1 << below);
  for (int i = 0; i < 3; i++) {
    tree->frame.origin[i] =
        0.5 * (within.low[i] + within.high[i]) - 0.5 * tree->frame.unit * (double)(1 << (above + below));
  }
  tree->per_unit = 1.0 / tree->frame.unit;
  name_boxes(tree, box);
  CW_GROW(tree->open.item, tree->open.capacity, items);
  for (; tree->open.count < items; tree->open.count++) tree->open.item[tree->open.count] = (int32_t)tree->open.count;
  CW_TRY(cut_coarse(tree, (int32_t[3]){0, 0, 0}, above + below, 0, items));
  CW_TRY(cw_lattice_places(input, &tree->frame, tree->cell_count, tree->cell, &places, &place));
  CW_TRY(collect(tree, places, place, count, x, site));
done:
  free(box);
  free(tree->items.reach);
  free(tree->items.own);
  free(tree->items.ball);
  free(tree->items.offset);
  free(tree->items.offset_cell);
  free(tree->items.chosen);
  free(tree->cell);
  free(tree->reached);
  free(tree->list.item);
  free(tree->items.near);
  free(tree->open.item);
  free(place);
  cw_verticals_free(&tree->verticals);
  return status;
}
