// SPDX-License-Identifier: AGPL-3.0-or-later
// The envelope of the boundary layers: for every wall vertex a direction and a height, so that the one thick prism over each wall
// triangle is valid and the front (the wall moved to its outer ends) does not cross itself. Rules and their reasons:
// most normal direction, fan beside concave creases, height by target, gap and gradation, repair.
#ifndef CUTWATER_MESHER_LAYERS_H
#define CUTWATER_MESHER_LAYERS_H

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  CW_LAYER_FULL,       // height as asked
  CW_LAYER_GAP,        // limited by a narrow gap
  CW_LAYER_GRADATION,  // limited by neighbours
  CW_LAYER_REPAIR      // limited by validity of the prisms or of the front
} CwLayerReason;

typedef struct {
  int32_t point_count;
  const double (*x)[3];               // wall vertices, m
  int32_t triangle_count;
  const int32_t (*triangle)[3];       // wall triangles, normal out of the domain
  const double *target;               // asked height of each vertex, normal to the wall, m
  // Guides: a vertex on a rim with a cap, or on a dividing plane, marches inside that surface. Up to two per vertex:
  // none: free; one: stays in the tangent plane; two: stays on the line of both.
  const int32_t *guide_count;         // 0, 1, 2 for each vertex
  const double (*guide_normal)[2][3]; // unit normals of the surfaces that hold the column
  // Puts a moved vertex back onto its guides (a cylinder, say); may be NULL.
  void (*snap)(const void *context, int32_t vertex, double x[3]);
  const void *snap_context;
  // Surfaces without layers that columns must not reach (caps: inlet, outlet, rotor/stator interface).
  int32_t obstacle_point_count;
  const double (*obstacle_x)[3];
  int32_t obstacle_triangle_count;
  const int32_t (*obstacle_triangle)[3];
} CwLayerInput;

typedef struct {
  double (*front)[3];   // outer end of each column
  double *height;       // normal height of each column, m
  uint8_t *reason;      // CwLayerReason
  int32_t repair_rounds;
  int32_t thinned_count; // columns below 0.99 of the target
} CwLayers;

// Fails with CW_ERR_MESH (place in mm) where no valid envelope is found. Every column has a height > 0.
CwStatus cw_layers_make(const CwLayerInput *input, CwLayers *layers);
void cw_layers_free(CwLayers *layers);

#ifdef __cplusplus
}
#endif
#endif
