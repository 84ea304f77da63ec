// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/number.h"
#include "mesher/common/vec.h"
#include "mesher/fill/fill_columns.h"
#include "mesher/fill/fill_reach.h"
#include "mesher/fill/fill_row.h"
#include "mesher/fill/lattice_places.h"

static const double coarse = 2.2; // cells of lists, over wanted cells
enum { DEPTH = 19 };

// What reaches a cell of the octree that is not cut for the sake of the boundary any more.
typedef struct {
  int32_t count; // items, from list
  int64_t list;
  int whole; // none reaches it: all of it is inside
  int clear; // none is in it
} Reached;

// Of the row, where it is chosen.
typedef struct {
  CwRowPlace place;
  int32_t at[3]; // finest cell that it lies in
  int32_t cell;  // that it lies in, or -1
  int chosen;
} RowPoint;

// Items: the triangles of the boundary, then the places of the row.
typedef struct {
  const CwFillInput *input;
  CwColumns *columns;
  CwReachBox *box;   // of each item
  CwReachBall *ball; // of each triangle
  RowPoint *row;
  CwLatticeFrame frame;
  double clearance; // factor on the distances to the boundary
  CwLatticeCell *cell;
  Reached *reached; // of each cell
  int32_t cell_count, cell_space, reached_space;
  int32_t *list;
  int64_t list_count, list_space;
  int32_t *near;     // items whose boxes hold a point
  uint8_t *children; // of the cell that is divided, which each item of its list reaches into
} Tree;

static double size_at(const CwFillInput *input, const double x[3]) {
  return input->size(input->size_context, x);
}

static CwStatus reach_of(Tree *tree, int32_t t, double *area, double *weight) {
  CwStatus status = CW_OK;
  const CwFillInput *input = tree->input;
  const double *a = input->x[input->triangle[t][0]], *b = input->x[input->triangle[t][1]];
  const double *c = input->x[input->triangle[t][2]];
  double u[3], v[3], normal[3], mean[3], h;
  for (int i = 0; i < 3; i++) mean[i] = (a[i] + b[i] + c[i]) / 3.0;
  CW_TRY(cw_lattice_size(input, mean, &h));
  cw_reach_of_triangle(a, b, c, 1.3 * fmax(h, size_at(input, a)), tree->clearance, &tree->box[t], &tree->ball[t]);
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  cw_cross(u, v, normal);
  double here = cw_norm(normal);
  *area += here;
  *weight += here * log(h);
done:
  return status;
}

static double distance_square(const double a[3], const double b[3]) {
  double d[3];
  cw_sub(a, b, d);
  return cw_dot(d, d);
}

// Whether an item of the cell keeps a point of the lattice, or of the row, away from x.
static int is_forbidden(const Tree *tree, const Reached *reached, const double x[3], int of_row) {
  const CwFillInput *input = tree->input;
  double h = 0.0, apart = of_row ? CW_ROW_APART : CW_ROW_CLEAR;
  float p[3] = {(float)x[0], (float)x[1], (float)x[2]};
  int32_t near = 0;
  for (int32_t k = reached->count - 1; k >= 0; k--) { // the row first: it is soon asked
    int32_t t = tree->near[near] = tree->list[reached->list + k];
    near += (int32_t)cw_number(cw_reach_holds(&tree->box[t], p));
  }
  for (int32_t k = 0; k < near; k++) {
    int32_t t = tree->near[k], place = t - input->triangle_count;
    if (place >= 0 && !tree->row[place].chosen) continue;
    if (place >= 0) {
      const CwRowPlace *point = &tree->row[place].place;
      double nearest = apart * point->spacing;
      if (distance_square(x, point->x) < nearest * nearest) return 1;
      continue;
    }
    if (h == 0.0) h = tree->clearance * size_at(input, x);
    int open = !of_row && t >= input->triangle_count - input->open_count;
    const int32_t *q = input->triangle[t];
    if ((!open && cw_reach_in_ball(&tree->ball[t], x)) ||
        cw_reach_is_near(input->x[q[0]], input->x[q[1]], input->x[q[2]], &tree->ball[t], h, tree->clearance, x))
      return 1;
  }
  return 0;
}

// 1 where x lies inside.
static CwStatus test_inside(Tree *tree, const double x[3], int *inside) {
  CwStatus status = CW_OK;
  int32_t count;
  const double *z;
  *inside = 0;
  CW_TRY(cw_columns_cut(tree->columns, x[0], x[1], &count, &z));
  for (int32_t k = 0; k < count; k++) *inside ^= z[k] > x[2];
done:
  return status;
}

static void centre_of(const Tree *tree, const int32_t at[3], int level, double x[3]) {
  for (int i = 0; i < 3; i++) x[i] = tree->frame.origin[i] + tree->frame.unit * (at[i] + 0.5 * (double)(1 << level));
}

static void child_of(const int32_t at[3], int level, int child, int32_t corner[3]) {
  for (int i = 0; i < 3; i++) corner[i] = at[i] + ((child >> i & 1) << (level - 1));
}

// Whether no item reaches into the box of a cell, as far as their own boxes tell. They keep no distance here, as
// those in the tree do.
static int is_clear(const Tree *tree, const int32_t at[3], int level, int64_t list, int32_t list_count) {
  const CwFillInput *input = tree->input;
  double low[3], high[3];
  for (int i = 0; i < 3; i++) {
    low[i] = tree->frame.origin[i] + tree->frame.unit * at[i];
    high[i] = tree->frame.origin[i] + tree->frame.unit * (at[i] + (1 << level));
  }
  for (int32_t k = 0; k < list_count; k++) {
    int32_t t = tree->list[list + k], of_row = t - input->triangle_count;
    const int32_t *q = of_row < 0 ? input->triangle[t] : NULL;
    const double *a = q ? input->x[q[0]] : tree->row[of_row].place.x, *b = q ? input->x[q[1]] : a;
    const double *c = q ? input->x[q[2]] : a;
    int apart = 0;
    for (int i = 0; i < 3; i++)
      apart |= ((a[i] < low[i]) & (b[i] < low[i]) & (c[i] < low[i])) |
               ((a[i] > high[i]) & (b[i] > high[i]) & (c[i] > high[i]));
    if (!apart) return 0;
  }
  return 1;
}

// The halves of a cell, by axis, that the box of an item reaches into: bits of its children 0 to 7. The item reaches
// into the cell; `low` and `high` are its middle, rounded down and up.
static uint8_t children_of(const CwReachBox *box, const float low[3], const float high[3]) {
  static const uint8_t lower[3] = {0x55, 0x33, 0x0f};
  unsigned children = 0xff;
  for (int i = 0; i < 3; i++)
    children &= (box->low[i] <= high[i] ? lower[i] : 0u) | (box->high[i] >= low[i] ? 0xffu & ~lower[i] : 0u);
  return (uint8_t)children;
}

// Hands the items of a cell down to its children, of which child c gets child_count[c] from list[child_list[c]] on.
static CwStatus divide_list(Tree *tree, const int32_t at[3], int level, int64_t list, int32_t list_count,
                            int64_t child_list[8], int32_t child_count[8]) {
  CwStatus status = CW_OK;
  float low[3], high[3];
  for (int i = 0; i < 3; i++) {
    double middle = tree->frame.origin[i] + tree->frame.unit * (at[i] + (1 << (level - 1)));
    low[i] = nextafterf((float)middle, -INFINITY);
    high[i] = nextafterf((float)middle, INFINITY);
  }
  memset(child_count, 0, 8 * sizeof *child_count);
  for (int32_t k = 0; k < list_count; k++) {
    uint8_t children = tree->children[k] = children_of(&tree->box[tree->list[list + k]], low, high);
    for (; children; children &= (uint8_t)(children - 1)) child_count[__builtin_ctz(children)]++;
  }
  for (int c = 0; c < 8; c++) {
    child_list[c] = tree->list_count;
    tree->list_count += child_count[c];
  }
  CW_GROW(tree->list, tree->list_space, tree->list_count);
  int64_t to[8];
  memcpy(to, child_list, sizeof to);
  for (int32_t k = 0; k < list_count; k++) {
    for (uint8_t children = tree->children[k]; children; children &= (uint8_t)(children - 1))
      tree->list[to[__builtin_ctz(children)]++] = tree->list[list + k];
  }
done:
  return status;
}

// Cuts down to coarse cells.
static CwStatus cut_coarse(Tree *tree, const int32_t at[3], int level, int64_t list, int32_t list_count) {
  CwStatus status = CW_OK;
  double centre[3], size, edge = tree->frame.unit * (double)(1 << level);
  int64_t child_list[8];
  int32_t child_count[8];
  int inside;
  centre_of(tree, at, level, centre);
  CW_TRY(cw_lattice_size(tree->input, centre, &size));
  if (list_count == 0 || level == 0 || edge <= coarse * CW_LATTICE_CONSTANT * size) {
    int clear = is_clear(tree, at, level, list, list_count);
    CW_TRY(test_inside(tree, centre, &inside));
    if (list_count == 0 && !inside) goto done;
    CW_GROW(tree->cell, tree->cell_space, tree->cell_count + 1);
    CW_GROW(tree->reached, tree->reached_space, tree->cell_count + 1);
    tree->reached[tree->cell_count] = (Reached){list_count, list, list_count == 0, clear};
    tree->cell[tree->cell_count++] = (CwLatticeCell){{at[0], at[1], at[2]}, level, inside};
    goto done;
  }
  CW_TRY(divide_list(tree, at, level, list, list_count, child_list, child_count));
  for (int child = 0; child < 8; child++) {
    int32_t corner[3];
    child_of(at, level, child, corner);
    CW_TRY(cut_coarse(tree, corner, level - 1, child_list[child], child_count[child]));
  }
done:
  return status;
}

// Which cell each place of the row lies in.
static void find_cells(Tree *tree) {
  for (int32_t p = 0; p < tree->input->row_count; p++) {
    for (int i = 0; i < 3; i++)
      tree->row[p].at[i] = (int32_t)floor((tree->row[p].place.x[i] - tree->frame.origin[i]) / tree->frame.unit);
  }
  for (int32_t c = 0; c < tree->cell_count; c++) {
    const CwLatticeCell *cell = &tree->cell[c];
    const Reached *reached = &tree->reached[c];
    for (int32_t k = reached->count - 1; k >= 0; k--) { // the row comes last
      int32_t p = tree->list[reached->list + k] - tree->input->triangle_count;
      if (p < 0) break;
      const int32_t *at = tree->row[p].at;
      int32_t over = (at[0] - cell->at[0]) | (at[1] - cell->at[1]) | (at[2] - cell->at[2]);
      if (over >> cell->level == 0) // neither below its corner nor beyond its edge
        tree->row[p].cell = c;
    }
  }
}

// Takes the places that were not chosen out of the lists.
static void shorten_lists(Tree *tree) {
  int32_t first = tree->input->triangle_count;
  for (int32_t c = 0; c < tree->cell_count; c++) {
    Reached *reached = &tree->reached[c];
    int32_t *list = tree->list + reached->list, count = 0;
    for (int32_t k = 0; k < reached->count; k++) {
      if (list[k] < first || tree->row[list[k] - first].chosen) list[count++] = list[k];
    }
    reached->count = count;
  }
}

// Of the places of the row, one after the other, those that are inside and that neither the boundary nor those chosen
// before forbid.
static CwStatus choose_row(Tree *tree, int32_t *chosen) {
  CwStatus status = CW_OK;
  *chosen = 0;
  find_cells(tree);
  for (int32_t p = 0; p < tree->input->row_count; p++) {
    RowPoint *point = &tree->row[p];
    if (point->cell < 0 || is_forbidden(tree, &tree->reached[point->cell], point->place.x, 1)) continue;
    CW_TRY(test_inside(tree, point->place.x, &point->chosen));
    *chosen += point->chosen;
  }
  shorten_lists(tree);
done:
  return status;
}

// Of the places of the lattice those that are inside and not forbidden. A line along z is cut once for all its
// places: near the boundary, where the jitter would make a difference, they are forbidden. The row comes last.
static CwStatus collect(Tree *tree, int64_t place_count, const CwLatticePlace *places, int32_t *count, double (**x)[3],
                        CwLatticeSite **site) {
  CwStatus status = CW_OK;
  double(*points)[3] = NULL;
  CwLatticeSite *sites = NULL;
  const double *z = NULL;
  int32_t kept = 0, crossings = 0, chosen;
  uint64_t cut = ~0ull;
  CW_TRY(choose_row(tree, &chosen));
  CW_REQUIRE(place_count < INT32_MAX / 16, CW_ERR_MESH,
             "%s: the size field asks for more than 100 million points in one region", tree->input->name);
  CW_NEW(points, place_count + chosen);
  if (site) CW_NEW(sites, place_count + chosen);
  for (int64_t k = 0; k < place_count; k++) {
    const CwLatticePlace *place = &places[k];
    const Reached *reached = &tree->reached[place->cell];
    double p[3], fixed[3];
    cw_lattice_point(&tree->frame, place, fixed, p);
    if (!reached->whole) {
      if (place->key >> 21 != cut) {
        cut = place->key >> 21;
        CW_TRY(cw_columns_cut(tree->columns, fixed[0], fixed[1], &crossings, &z));
      }
      int inside = 0;
      for (int32_t c = 0; c < crossings; c++) inside ^= z[c] > fixed[2];
      if (!inside || is_forbidden(tree, reached, p, 0)) continue;
    }
    if (site) sites[kept] = (CwLatticeSite){place->key, place->level, reached->clear};
    memcpy(points[kept++], p, sizeof p);
  }
  for (int32_t p = 0; p < tree->input->row_count; p++) {
    if (!tree->row[p].chosen) continue;
    if (site) sites[kept] = (CwLatticeSite){CW_LATTICE_NO_PLACE + (uint64_t)p, 0, 0};
    memcpy(points[kept++], tree->row[p].place.x, sizeof *points);
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

static int compare_row(const void *p, const void *q) {
  return cw_row_compare(&((const RowPoint *)p)->place, &((const RowPoint *)q)->place);
}

CwStatus cw_fill_points(const CwFillInput *input, double clearance, int32_t *count, double (**x)[3],
                        CwLatticeSite **site) {
  CwStatus status = CW_OK;
  Tree whole = {.input = input, .clearance = clearance}, *tree = &whole;
  CwLatticePlace *place = NULL;
  int64_t places;
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  double area = 0.0, weight = 0.0, extent = 0.0;
  int above = 0;
  *count = 0;
  *x = NULL;
  if (site) *site = NULL;
  CW_TRY(cw_columns_make(input, &tree->columns));
  int32_t items = input->triangle_count + input->row_count;
  CW_NEW(tree->box, items);
  CW_NEW(tree->ball, input->triangle_count);
  CW_NEW(tree->row, input->row_count);
  CW_NEW(tree->near, items);
  CW_NEW(tree->children, items);
  CW_GROW(tree->list, tree->list_space, items);
  for (int32_t t = 0; t < input->triangle_count; t++) {
    tree->list[tree->list_count++] = t;
    CW_TRY(reach_of(tree, t, &area, &weight));
    for (int k = 0; k < 9; k++) {
      double value = input->x[input->triangle[t][k / 3]][k % 3];
      low[k % 3] = value < low[k % 3] ? value : low[k % 3];
      high[k % 3] = value > high[k % 3] ? value : high[k % 3];
    }
  }
  for (int32_t p = 0; p < input->row_count; p++)
    tree->row[p] = (RowPoint){.place = cw_row_place(input, input->triangle_count - input->row_count + p), .cell = -1};
  qsort(tree->row, (size_t)input->row_count, sizeof *tree->row, compare_row);
  for (int32_t p = 0; p < input->row_count; p++) {
    tree->box[input->triangle_count + p] =
        cw_reach_box(tree->row[p].place.x, fmax(CW_ROW_APART, CW_ROW_CLEAR) * tree->row[p].place.spacing);
    tree->list[tree->list_count++] = input->triangle_count + p;
  }
  for (int i = 0; i < 3; i++) extent = fmax(extent, high[i] - low[i]);
  // The mean size of the boundary is a cell size exactly, so that a uniform field is met exactly.
  double edge = CW_LATTICE_CONSTANT * exp(weight / area);
  while (edge * (double)(1 << above) < 1.001 * extent) {
    above++;
    CW_REQUIRE(above <= DEPTH, CW_ERR_MESH, "%s: the size field is below 1e-5 of the region", input->name);
  }
  int below = DEPTH - above < 8 ? DEPTH - above : 8;
  tree->frame.unit = edge / (double)(1 << below);
  for (int i = 0; i < 3; i++) {
    tree->frame.origin[i] = 0.5 * (low[i] + high[i]) - 0.5 * tree->frame.unit * (double)(1 << (above + below));
  }
  CW_TRY(cut_coarse(tree, (int32_t[3]){0, 0, 0}, above + below, 0, items));
  CW_TRY(cw_lattice_places(input, &tree->frame, tree->cell_count, tree->cell, &places, &place));
  CW_TRY(collect(tree, places, place, count, x, site));
done:
  free(tree->box);
  free(tree->ball);
  free(tree->row);
  free(tree->cell);
  free(tree->reached);
  free(tree->list);
  free(tree->near);
  free(tree->children);
  free(place);
  cw_columns_free(&tree->columns);
  return status;
}
