// SPDX-License-Identifier: AGPL-3.0-or-later
// The steps of the layer envelope, in their order, each in a file of its own.
#ifndef CUTWATER_MESHER_LAYERS_LAYERS_INNER_H
#define CUTWATER_MESHER_LAYERS_LAYERS_INNER_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layer_columns.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/parallel/parallel_for.h"

typedef enum { CW_CREASE_NONE, CW_CREASE_CONVEX, CW_CREASE_CONCAVE } CwCrease;

// layers_topology.c
// Cotangent weights of v's entries of `near`, clamped; *area: a third of the triangles around, m2.
void cw_layers_weights(const CwLayerWork *work, int32_t v, double *weight, double *area);
double cw_layers_shortest_edge(const CwLayerWork *work, int32_t v); // m

// layers_normal.c
// Most normal direction: the unit g that maximises the least n.g over `count` unit normals, exactly: the best of the
// single normals, the bisectors of pairs and the circumcentres of triples. With one constraint g is held in the plane
// normal to it, with two on the line of both. Returns the least cosine; negative where no direction sees all faces.
double cw_layers_most_normal(int count, const double (*normal)[3], int constraint_count, const double (*constraint)[3],
                             double g[3]);
// Directions and creases of all vertices. Collective. CW_ERR_MESH where the faces around a vertex see no
// common direction or a constraint that stays holds none; outcome CW_OUTCOME_REPLAN where other constraints hold none.
CwStatus cw_layers_normals(CwLayerWork *work, CwOutcome *outcome);
// Distinct normals around vertex v, at most CW_LAYER_NORMALS; returns the count.
enum { CW_LAYER_NORMALS = 48 };
int cw_layers_distinct_normals(const CwLayerWork *work, int32_t v, double (*normal)[3]);
// Least cosine that a column over thickness t[v] is lengthened for: it is the offset g / max(n.g, floor).
double cw_layers_floor(const CwLayerWork *work, int32_t v);
// The column of v without any smoothing.
void cw_layers_upright(const CwLayerWork *work, int32_t v, double column[3]);

// direction_smoothing.c: tilts the columns beside concave creases and tilted constraints for the thicknesses t. The
// first time it sets every column, later those that the change of thicknesses concerns. Collective.
CwStatus cw_smooth_directions(CwLayerWork *work);
void cw_smoothing_free(struct CwSmoothing **smoothing);

// layers_gap.c: a tree of all triangles, those of the walls first, and the free way along a ray. Sets `curve`.
// Collective.
CwStatus cw_gap_tree_make(CwLayerWork *work, CwBoxTree *tree);
// How thick the column of v may be where another wall stands `way` before it, m: gap_share of the way, and no more
// than leaves `core` (m) to the tetrahedra between both layer tops; but as much as makes its last prism no smaller than
// 1 / core_ratio of a tetrahedron across what is left, and as much as keeps the first layer.
double cw_layers_room(const CwLayerWork *work, int32_t v, double way, double core);
// t = min(most, room before walls, 0.6 of the gap to obstacles) for the columns as they stand. Collective.
CwStatus cw_layers_limit_by_gap(CwLayerWork *work, CwBoxTree *tree);
// Sets `most`: the target, but in a concave place, where columns side by side lean to one another, 0.6 of the thickness
// at which they would meet. Beside a concave crease the smoothing keeps them apart, and nothing is limited. Collective.
CwStatus cw_layers_limit_by_concavity(CwLayerWork *work);
// Lowers thicknesses until |dt| <= 0.3 length along every edge, the lesser of its lengths on the wall and at the lower
// thickness. lowered: vertices lowered since that last held; NULL: any. Collective.
CwStatus cw_layers_grade(CwLayerWork *work, const uint8_t *lowered);

// layers_turn.c: what the layer top over triangle f counts beside its prism; and its shear, where its quality is
// `prism`: prism_good where no determinant is small.
double cw_layers_top_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]);
double cw_layers_shear_quality(const CwLayerWork *work, int32_t f, const double (*top)[3], double prism);

// layers_repair.c: makes prisms and layer top valid; fills `top`. *rounds: how many that took. Takes the tree of walls
// and obstacles over. CW_ERR_MESH with the place where 40 rounds do not do.
CwStatus cw_layers_repair(CwLayerWork *work, CwBoxTree *tree, double (*top)[3], int32_t *rounds);

#endif
