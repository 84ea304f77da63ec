// SPDX-License-Identifier: AGPL-3.0-or-later
// What the parts of the layer module share. Of others only those that change columns once they stand include it:
// layers_orbit.c and front_open.c of the skeleton.
#ifndef CUTWATER_MESHER_LAYERS_LAYERS_INNER_H
#define CUTWATER_MESHER_LAYERS_LAYERS_INNER_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/vertex_heap.h"
#include "mesher/layers/layers.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/parallel/share.h"

typedef enum { CW_CREASE_NONE, CW_CREASE_CONVEX, CW_CREASE_CONCAVE } CwCrease;

// All normals point into the fluid. A column is t[v] * column[v]: `column` is the displacement for a unit
// normal height.
typedef struct {
  const CwLayerInput *in;
  int32_t n;                        // vertices
  double (*face_normal)[3];         // unit
  int32_t *face_start, *face;       // triangles around each vertex, ascending
  int32_t *near_start, *near;       // neighbours of each vertex, ascending
  double (*normal)[3], *normal_cos; // most normal direction without guides; its least cosine to the normals
  double (*base)[3], *base_cos;     // the same inside the guides
  uint8_t *crease;                  // CwCrease
  double (*along)[3];               // crease: direction of the edge, or zero at a corner
  double (*column)[3];              // unit-height displacement
  double *t;                        // height, m
  double *most;                     // the target, or less in a hollow: no height is greater, m
  int32_t *curve;                   // all vertices along a curve through space: near in the list, near in space
  double *gap, (*gap_column)[3];    // height that the gap along a column allows, m, and that column; NULL at first
  struct CwFans *fans;              // layers_fan.h; NULL before the first fan
  uint8_t *reason;                  // CwLayerReason
} CwLayerWork;

static inline double dot3(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static inline void cross3(const double a[3], const double b[3], double c[3]) {
  double r[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  memcpy(c, r, sizeof r);
}
static inline void sub3(const double a[3], const double b[3], double c[3]) {
  for (int k = 0; k < 3; k++) c[k] = a[k] - b[k];
}
static inline double length3(const double a[3]) {
  return sqrt(dot3(a, a));
}
static inline double distance3(const double a[3], const double b[3]) {
  double d[3];
  sub3(a, b, d);
  return length3(d);
}
// Makes `a` a unit vector; returns its length, and leaves it alone where that is zero.
static inline double unit3(double a[3]) {
  double length = length3(a);
  if (length > 0)
    for (int k = 0; k < 3; k++) a[k] /= length;
  return length;
}
// Takes out of `a` its part along the unit vector `n`.
static inline void flatten3(double a[3], const double n[3]) {
  double h = dot3(a, n);
  for (int k = 0; k < 3; k++) a[k] -= h * n[k];
}

// layers_topology.c: neighbourhoods, weights, face normals. `work` is zeroed before; freed with the other. Collective.
CwStatus cw_layers_topology(const CwLayerInput *input, CwLayerWork *work);
void cw_layers_work_free(CwLayerWork *work);
// Cotangent weights of v's entries of `near`, clamped; *area: a third of the triangles around, m2.
void cw_layers_weights(const CwLayerWork *work, int32_t v, double *weight, double *area);
double cw_layers_shortest_edge(const CwLayerWork *work, int32_t v); // m

// layers_normal.c
// Most normal direction: the unit g that maximises the least n.g over `count` unit normals, exactly: the
// best of the single
// normals, the bisectors of pairs and the circumcentres of triples. With one guide g is held in the plane
// normal to it, with
// two on the line of both. Returns the least cosine; negative where no direction sees all faces.
double cw_layers_most_normal(int count, const double (*normal)[3], int guide_count, const double (*guide)[3],
                             double g[3]);
// Directions and creases of all vertices. Collective. CW_ERR_MESH where the faces around a vertex see no
// common direction or a guide that stays holds none, CW_RETRY on all ranks where other guides hold none.
CwStatus cw_layers_normals(CwLayerWork *work);
// Distinct normals around vertex v, at most CW_LAYER_NORMALS; returns the count.
enum { CW_LAYER_NORMALS = 48 };
int cw_layers_distinct_normals(const CwLayerWork *work, int32_t v, double (*normal)[3]);
double cw_layers_least_cosine(const CwLayerWork *work, int32_t v, const double direction[3]);
// Least cosine that a column over height t[v] is lengthened for: it is the offset g / max(n.g, floor).
double cw_layers_floor(const CwLayerWork *work, int32_t v);
// The column of v without any fan.
void cw_layers_upright(const CwLayerWork *work, int32_t v, double column[3]);
// Outer end of the column of v at height t[v], put back on its guides.
void cw_layers_place(const CwLayerWork *work, int32_t v, double end[3]);

// layers_fan.c: tilts the columns beside concave creases and tilted guides for the heights t. The first time it sets
// every column, later those that the change of heights concerns. Collective.
CwStatus cw_layers_fan(CwLayerWork *work);
void cw_fans_free(struct CwFans **fans);

// layers_gap.c: a tree of all triangles, those of the walls first, and the free way along a ray. Sets `curve`.
// Collective.
CwStatus cw_gap_tree_make(CwLayerWork *work, CwBoxTree *tree);
// t = min(most, 0.35 of the gap to walls, 0.6 of the gap to obstacles) for the columns as they stand. Collective.
CwStatus cw_layers_limit_by_gap(CwLayerWork *work, CwBoxTree *tree);
// Sets `most`: the target, but in a hollow, where columns side by side lean to one another, 0.6 of the height at which
// they would meet. Beside a concave crease the fan keeps them apart, and nothing is limited. Collective.
CwStatus cw_layers_limit_by_hollow(CwLayerWork *work);
// Lowers heights until |dt| <= 0.3 length along every edge, the lesser of its lengths on the wall and at the lower
// height. lowered: vertices lowered since that last held; NULL: any. Collective.
CwStatus cw_layers_grade(CwLayerWork *work, const uint8_t *lowered);

// layers_crossing.c: pairs of triangles that cross; kinds are 0 front, 1 wall, 2 caps.
typedef struct {
  int32_t f, g, kind_f, kind_g;
} CwLayerPair;
typedef struct {
  const CwLayerWork *work;
  int32_t item_count;
  double (*x)[3];  // front, wall, caps
  CwBoxTree tree;  // of the prisms and the caps; may be given in any order
  uint8_t *active; // triangles that moved
  int32_t *list, list_count;
  int searched; // a first time
  int32_t pair_count;
  CwLayerPair *pair; // front with front, wall or cap; wall with wall, looked for once
} CwLayerCrossing;
CwStatus cw_layers_crossing_make(const CwLayerWork *work, CwLayerCrossing *crossing); // zeroed before
void cw_layers_crossing_free(CwLayerCrossing *crossing);
// Brings the pairs up to date with the front; moved: vertices that moved since the last time; the first time all those
// not known to be clear of one another. Collective.
CwStatus cw_layers_crossing_find(CwLayerCrossing *crossing, const double (*front)[3], const uint8_t *moved);

// layers_turn.c
#define CW_LAYER_GOOD 0.12 // quality of prisms and their fronts that is asked for
// Quality (prism_quality.h) of the prism over triangle f with column ends `front`; what its front counts beside it; and
// its shear, where it is `prism` itself: CW_LAYER_GOOD where no determinant is small.
double cw_layers_prism_quality(const CwLayerWork *work, int32_t f, const double (*front)[3]);
double cw_layers_front_quality(const CwLayerWork *work, int32_t f, const double (*front)[3]);
double cw_layers_shear_quality(const CwLayerWork *work, int32_t f, const double (*front)[3], double prism);
// How good the column of v is: by the worst prism around it, and where all are good by their front and shear too; no
// more than `floor` where one is no better, not looking at the others. *first: which of them is looked at first, and
// then the one that was the worst: most other directions fail there too.
double cw_layers_around(const CwLayerWork *work, int32_t v, const double (*front)[3], double floor, int32_t *first);
// How good the column of v is, as cw_layers_around.
typedef double (*CwLayerJudge)(const CwLayerWork *work, int32_t v, const double (*front)[3], double floor,
                               int32_t *first);
// Tries directions of the column of v near the present one; keeps the best.
void cw_layers_turn(CwLayerWork *work, int32_t v, double (*front)[3], CwLayerJudge judge);

// layers_repair.c: makes prisms and front valid; fills `front`.
// Takes the tree of walls and obstacles over.
CwStatus cw_layers_repair(CwLayerWork *work, CwBoxTree *tree, double (*front)[3], int32_t *rounds);

#endif
