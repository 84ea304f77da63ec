// SPDX-License-Identifier: AGPL-3.0-or-later
// Directions most normal to the faces about a vertex, and the columns that follow.
#pragma once

#include "mesher/layers/layer_columns.h"
#include "mesher/parallel/outcome.h"
#include "pipeline/status.h"

#define CW_LAYERS_LEAST_COSINE 0.05 // of a column to the normals of the faces around

// Most normal direction: the unit g that maximises the least n.g over `count` unit normals, exactly: the best of the
// single normals, the bisectors of pairs and the circumcentres of triples. With one constraint g is held in the plane
// normal to it, with two on the line of both. Returns the least cosine; negative where no direction sees all faces.
double cw_layers_most_normal(int count, const double (*normal)[3], int constraint_count, const double (*constraint)[3],
                             double g[3]);
// The direction with the greatest least share: n.g over the cosine of half the greatest angle between n and another
// normal, which is the most that any g can have of both. The most normal one where all normals are alike; where a knife
// edge ends, that would lie in the face it ends on. Returns the least cosine.
double cw_layers_fair_normal(int count, const double (*normal)[3], int constraint_count, const double (*constraint)[3],
                             double g[3]);
// What may help where no column can stand at vertex v: another plan where a partition plane holds it, else shorter
// edges, or none there.
CwOutcomeKind cw_layers_kind_at(const CwLayerWork *work, int32_t v);
// Adds the corner of wall triangle f to the places of an outcome of that kind, whose reason the first one gives.
void cw_layers_add_place(const CwLayerWork *work, int32_t f, int corner, CwOutcome *outcome, const char *why);
// Directions and creases of all vertices. Collective. Outcome: that of cw_layers_kind_at where the faces around a
// vertex see no common one, or none inside what holds the column.
CwStatus cw_layers_normals(CwLayerWork *work, CwOutcome *outcome);
enum { CW_LAYER_NORMALS = 48 }; // distinct ones around a vertex, at most
// Least cosine that a column over thickness t[v] is lengthened for: it is the offset g / max(n.g, floor), of concave
// edges column_least_cosine, of all others upright_cosine: sharper convex ones leave thinner layers.
double cw_layers_floor(const CwLayerWork *work, int32_t v);
// The column of v without any smoothing.
void cw_layers_upright(const CwLayerWork *work, int32_t v, double column[3]);

// Least product of a vector with the unit normals of the faces around v: of a direction its least
// cosine, of a column its normal thickness.
double cw_layers_least_cosine(const CwLayerWork *work, int32_t v, const double direction[3]);
// Outer end of the column of v at thickness t[v], put back on its constraints.
void cw_layers_place(const CwLayerWork *work, int32_t v, double end[3]);
