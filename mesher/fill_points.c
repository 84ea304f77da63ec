// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill_points.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/inside.h"

// Lattice constant over edge length: 12 tetrahedra a cube, each of the volume of a regular one with edge 1.
static const double lattice_constant = 1.122462048309373; // (12 / (6 sqrt 2))^(1/3) = 2^(1/6)
static const double distance_factor = 0.62;               // of h, least distance to the boundary
static const double sphere_factor = 1.05; // of the radius of a triangle's smallest circumscribed sphere
static const double jitter = 1e-3;        // of the cell: breaks the lattice's cospherical points
enum { DEPTH = 19, LEAVES = 40000000 };   // LEAVES: as many tetrahedra as 32-bit face numbers hold

typedef struct {
  double centre[3], radius; // equatorial sphere
  double low[3], high[3];   // box of all places that the triangle can forbid
} Reach;

typedef struct {
  int32_t at[3]; // corner, in units of the finest cell
  int32_t level; // edge: 1 << level units
  int64_t list;  // its triangles: list[0 .. list_count)
  int32_t list_count;
  int8_t inside; // where it has no triangles: all of it is inside, or outside
} Leaf;

typedef struct {
  uint64_t key;
  int32_t leaf;
} Place;

typedef struct {
  const CwFillInput *input;
  const CwInside *inside;
  Reach *reach;
  double origin[3], unit; // finest cell, m
  double fit;             // factor on the wanted spacing
  double clearance;       // factor on the distances to the boundary
  Leaf *leaf;
  int64_t leaf_count, leaf_space;
  int32_t *list;
  int64_t list_count, list_space;
  double wanted, found; // cells that the size field asks for, and cells found, inside
} Tree;

static double size_at(const CwFillInput *input, const double x[3]) {
  return input->size(input->size_context, x);
}

static void subtract(const double a[3], const double b[3], double d[3]) {
  for (int i = 0; i < 3; i++)
    d[i] = a[i] - b[i];
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void reach_of(const CwFillInput *input, double clearance, int32_t t, Reach *reach) {
  const double *a = input->x[input->triangle[t][0]], *b = input->x[input->triangle[t][1]];
  const double *c = input->x[input->triangle[t][2]];
  double u[3], v[3], mean[3];
  subtract(b, a, u);
  subtract(c, a, v);
  double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), det = 2.0 * (uu * vv - uv * uv);
  double p = 1.0 / 3.0, q = 1.0 / 3.0;
  if (det > 1e-12 * uu * vv) {
    p = vv * (uu - uv) / det;
    q = uu * (vv - uv) / det;
  }
  double square = 0.0;
  for (int i = 0; i < 3; i++) {
    double d = p * u[i] + q * v[i];
    reach->centre[i] = a[i] + d;
    square += d * d;
    mean[i] = (a[i] + b[i] + c[i]) / 3.0;
  }
  // The sphere of a needle would reach far: it is no use to keep points out of all of it.
  double longest = sqrt(fmax(fmax(uu, vv), uu + vv - 2.0 * uv));
  reach->radius = clearance * sphere_factor * fmin(sqrt(square), longest);
  double margin = 1.3 * clearance * distance_factor * fmax(size_at(input, mean), size_at(input, a));
  for (int i = 0; i < 3; i++) {
    reach->low[i] = fmin(reach->centre[i] - reach->radius, fmin(fmin(a[i], b[i]), c[i]) - margin);
    reach->high[i] = fmax(reach->centre[i] + reach->radius, fmax(fmax(a[i], b[i]), c[i]) + margin);
  }
}

// Square of the distance of x to a triangle: over its inside by the normal, else by its three edges.
static double distance_square(const double x[3], const double a[3], const double b[3], const double c[3]) {
  double u[3], v[3], w[3];
  subtract(b, a, u);
  subtract(c, a, v);
  subtract(x, a, w);
  double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  double det = uu * vv - uv * uv, s = vv * wu - uv * wv, t = uu * wv - uv * wu;
  if (s >= 0.0 && t >= 0.0 && s + t <= det && det > 0.0) {
    double d[3];
    for (int i = 0; i < 3; i++)
      d[i] = w[i] - (s * u[i] + t * v[i]) / det;
    return dot(d, d);
  }
  const double *corner[3] = {a, b, c};
  double least = INFINITY;
  for (int k = 0; k < 3; k++) {
    double e[3], f[3];
    subtract(corner[(k + 1) % 3], corner[k], e);
    subtract(x, corner[k], f);
    double ee = dot(e, e), along = ee > 0.0 ? fmin(fmax(dot(e, f) / ee, 0.0), 1.0) : 0.0;
    for (int i = 0; i < 3; i++)
      f[i] -= along * e[i];
    least = fmin(least, dot(f, f));
  }
  return least;
}

static int is_forbidden(const Tree *tree, const Leaf *leaf, const double x[3]) {
  const CwFillInput *input = tree->input;
  double nearest = tree->clearance * distance_factor * size_at(input, x);
  for (int32_t k = 0; k < leaf->list_count; k++) {
    int32_t t = tree->list[leaf->list + k];
    const Reach *reach = &tree->reach[t];
    if (x[0] < reach->low[0] || x[0] > reach->high[0] || x[1] < reach->low[1] || x[1] > reach->high[1] ||
        x[2] < reach->low[2] || x[2] > reach->high[2])
      continue;
    double d[3];
    subtract(x, reach->centre, d);
    if (dot(d, d) < reach->radius * reach->radius)
      return 1;
    const int32_t *p = input->triangle[t];
    if (distance_square(x, input->x[p[0]], input->x[p[1]], input->x[p[2]]) < nearest * nearest)
      return 1;
  }
  return 0;
}

static CwStatus add_leaf(Tree *tree, const int32_t at[3], int level, int inside, int32_t count,
                         const int32_t *list) {
  CwStatus status = CW_OK;
  if (tree->leaf_count == tree->leaf_space) {
    tree->leaf_space = 2 * tree->leaf_space + 1024;
    Leaf *grown = realloc(tree->leaf, (size_t)tree->leaf_space * sizeof *grown);
    CW_REQUIRE(grown, CW_ERR_MEMORY, "%s: out of memory: octree", tree->input->name);
    tree->leaf = grown;
  }
  if (tree->list_count + count > tree->list_space) {
    tree->list_space = 2 * tree->list_space + count + 4096;
    int32_t *grown = realloc(tree->list, (size_t)tree->list_space * sizeof *grown);
    CW_REQUIRE(grown, CW_ERR_MEMORY, "%s: out of memory: octree", tree->input->name);
    tree->list = grown;
  }
  CW_REQUIRE(tree->leaf_count < LEAVES, CW_ERR_MESH,
             "%s: the size field asks for more than %d million points in one region", tree->input->name,
             2 * LEAVES / 1000000);
  Leaf *leaf = &tree->leaf[tree->leaf_count++];
  *leaf = (Leaf){.at = {at[0], at[1], at[2]},
                 .level = level,
                 .list = tree->list_count,
                 .list_count = count,
                 .inside = (int8_t)inside};
  if (count)
    memcpy(tree->list + tree->list_count, list, (size_t)count * sizeof *list);
  tree->list_count += count;
done:
  return status;
}

// Splits down to the wanted spacing. `known` is 1 or 0 where a cell without triangles is known to be inside
// or outside, -1 where it is not known.
static CwStatus split(Tree *tree, const int32_t at[3], int level, int known, int32_t count,
                      const int32_t *list) {
  CwStatus status = CW_OK;
  int32_t *part = NULL;
  double edge = tree->unit * (double)(1 << level), centre[3];
  for (int i = 0; i < 3; i++)
    centre[i] = tree->origin[i] + tree->unit * at[i] + 0.5 * edge;
  if (count == 0 && known < 0)
    known = cw_inside_test(tree->inside, centre);
  if (count == 0 && known == 0)
    goto done;
  double size = size_at(tree->input, centre);
  CW_REQUIRE(size > 0.0, CW_ERR_MESH, "%s: the size field gives %g m at (%.6g, %.6g, %.6g) mm",
             tree->input->name, size, 1e3 * centre[0], 1e3 * centre[1], 1e3 * centre[2]);
  double wanted = tree->fit * lattice_constant * size;
  if (level == 0 || edge <= 1.4142135623730951 * wanted) {
    // Near the boundary half the cells are inside: count by the centre.
    if (known < 0 ? cw_inside_test(tree->inside, centre) : known) {
      tree->found += 1.0;
      tree->wanted += pow(tree->fit * edge / wanted, 3.0);
    }
    CW_TRY(add_leaf(tree, at, level, known, count, list));
    goto done;
  }
  if (count)
    CW_NEW(part, count);
  for (int child = 0; child < 8; child++) {
    int32_t corner[3], kept = 0;
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
      corner[i] = at[i] + ((child >> i & 1) << (level - 1));
      low[i] = tree->origin[i] + tree->unit * corner[i];
      high[i] = low[i] + 0.5 * edge;
    }
    for (int32_t k = 0; k < count; k++) {
      const Reach *r = &tree->reach[list[k]];
      if (r->low[0] <= high[0] && r->high[0] >= low[0] && r->low[1] <= high[1] && r->high[1] >= low[1] &&
          r->low[2] <= high[2] && r->high[2] >= low[2])
        part[kept++] = list[k];
    }
    CW_TRY(split(tree, corner, level - 1, known, kept, part));
  }
done:
  free(part);
  return status;
}

static uint64_t spread(uint64_t v) { // 21 bits to every third
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  return (v | v << 2) & 0x1249249249249249ull;
}

static int compare_places(const void *left, const void *right) {
  const Place *a = left, *b = right;
  if (a->key != b->key)
    return a->key < b->key ? -1 : 1;
  return a->leaf < b->leaf ? -1 : a->leaf > b->leaf;
}

static double shake(uint64_t key, int axis) { // in [-1, 1), from the place alone
  uint64_t z = key + 0x9e3779b97f4a7c15ull * (uint64_t)(axis + 1);
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ z >> 27) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  return (double)(z >> 11) * 0x1p-52 - 1.0;
}

// Corners and centres of all leaves, each once, in Morton order; half units.
static CwStatus collect(const Tree *tree, int32_t *count, double (**x)[3]) {
  CwStatus status = CW_OK;
  Place *place = NULL;
  double(*points)[3] = NULL;
  int64_t places = 0;
  int32_t kept = 0;
  CW_NEW(place, 9 * tree->leaf_count);
  for (int64_t l = 0; l < tree->leaf_count; l++) {
    const Leaf *leaf = &tree->leaf[l];
    for (int k = 0; k < 9; k++) {
      uint64_t key = 0;
      for (int i = 0; i < 3; i++) {
        int32_t step = k == 8 ? 1 << leaf->level : (k >> i & 1) << (leaf->level + 1);
        key |= spread((uint64_t)(2 * leaf->at[i] + step)) << i;
      }
      place[places++] = (Place){key, (int32_t)l};
    }
  }
  qsort(place, (size_t)places, sizeof *place, compare_places);
  int64_t unique = 0;
  for (int64_t k = 0; k < places; k++) {
    if (k == 0 || place[k].key != place[k - 1].key)
      unique++;
  }
  CW_NEW(points, unique);
  for (int64_t k = 0; k < places; k++) {
    if (k && place[k].key == place[k - 1].key)
      continue;
    const Leaf *leaf = &tree->leaf[place[k].leaf];
    double p[3];
    for (int i = 0; i < 3; i++) {
      int32_t half = 0;
      for (int bit = 0; bit < 21; bit++)
        half |= (int32_t)(place[k].key >> (3 * bit + i) & 1) << bit;
      p[i] = tree->origin[i] +
             tree->unit * (0.5 * half + jitter * (double)(1 << leaf->level) * shake(place[k].key, i));
    }
    if (leaf->list_count) {
      if (is_forbidden(tree, leaf, p) || !cw_inside_test(tree->inside, p))
        continue;
    } else if (!leaf->inside)
      continue;
    memcpy(points[kept++], p, sizeof p);
  }
  *count = kept;
  *x = points;
  points = NULL;
done:
  free(points);
  free(place);
  return status;
}

CwStatus cw_fill_points(const CwFillInput *input, double clearance, int32_t *count, double (**x)[3]) {
  CwStatus status = CW_OK;
  Tree tree = {.input = input, .fit = 1.0, .clearance = clearance};
  CwInside *inside = NULL;
  int32_t *all = NULL;
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  *count = 0;
  *x = NULL;
  CW_TRY(cw_inside_make(input->point_count, input->x, input->triangle_count, input->triangle, &inside));
  tree.inside = inside;
  CW_NEW(tree.reach, input->triangle_count);
  CW_NEW(all, input->triangle_count);
  double area = 0.0, weight = 0.0;
  for (int32_t t = 0; t < input->triangle_count; t++) {
    all[t] = t;
    reach_of(input, clearance, t, &tree.reach[t]);
    const double *corner[3];
    double mean[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
      corner[k] = input->x[input->triangle[t][k]];
      for (int i = 0; i < 3; i++) {
        mean[i] += corner[k][i] / 3.0;
        low[i] = fmin(low[i], corner[k][i]);
        high[i] = fmax(high[i], corner[k][i]);
      }
    }
    double u[3], v[3], h = size_at(input, mean);
    CW_REQUIRE(h > 0.0 && isfinite(h), CW_ERR_MESH, "%s: the size field gives %g m at (%.6g, %.6g, %.6g) mm",
               input->name, h, 1e3 * mean[0], 1e3 * mean[1], 1e3 * mean[2]);
    subtract(corner[1], corner[0], u);
    subtract(corner[2], corner[0], v);
    double here = sqrt(fmax(dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v), 0.0));
    area += here;
    weight += here * log(h);
  }
  // The mean size of the boundary is a cell size exactly, so that a uniform field is met exactly.
  double extent = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
  double edge = lattice_constant * exp(weight / area);
  int above = 0;
  while (edge * (double)(1 << above) < 1.001 * extent) {
    above++;
    CW_REQUIRE(above <= DEPTH, CW_ERR_MESH, "%s: the size field is below 1e-5 of the region", input->name);
  }
  int below = DEPTH - above < 8 ? DEPTH - above : 8;
  tree.unit = edge / (double)(1 << below);
  for (int i = 0; i < 3; i++) {
    tree.origin[i] = 0.5 * (low[i] + high[i]) - 0.5 * tree.unit * (double)(1 << (above + below));
  }
  for (int round = 0; round < 4; round++) {
    tree.leaf_count = tree.list_count = 0;
    tree.wanted = tree.found = 0.0;
    CW_TRY(split(&tree, (int32_t[3]){0, 0, 0}, above + below, -1, input->triangle_count, all));
    if (!(tree.wanted > 0.0) || fabs(tree.found / tree.wanted - 1.0) < 0.01)
      break;
    if (round < 3)
      tree.fit *= cbrt(tree.found / tree.wanted);
  }
  CW_TRY(collect(&tree, count, x));
done:
  free(all);
  free(tree.reach);
  free(tree.leaf);
  free(tree.list);
  cw_inside_free(&inside);
  return status;
}
