// SPDX-License-Identifier: AGPL-3.0-or-later
// Which triangles and vertices stand about each vertex of a wall.
#pragma once

#include "mesher/layers/layer_columns.h"
#include "pipeline/status.h"

// Neighbourhoods and face normals; room for all else. `work` is zeroed before. Collective.
CwStatus cw_layers_topology(const CwLayerInput *input, CwLayerWork *work);
void cw_layers_work_free(CwLayerWork *work);

// Cotangent weights of v's entries of `near`, clamped; *area: a third of the triangles around, m2.
void cw_layers_weights(const CwLayerWork *work, int32_t v, double *weight, double *area);
double cw_layers_shortest_edge(const CwLayerWork *work, int32_t v); // m
