// SPDX-License-Identifier: AGPL-3.0-or-later
// The first height of the layers on a patch: what the case asks, where the passage has room for it and the flow is
// turbulent.
#pragma once

#include "pipeline/case.h"
#include "pipeline/model.h"

#ifdef __cplusplus
extern "C" {
#endif

// Reynolds number of the hydraulic diameter below which the flow in a passage is laminar: that of pipe flow
// (O. Reynolds 1883; H. Schlichting and K. Gersten, Boundary-Layer Theory).
#define CW_LAMINAR_REYNOLDS 2300.0
// Where the log layer begins, and wall functions hold (S. B. Pope, Turbulent Flows, 2000, section 7.1).
#define CW_LOG_LAYER_Y_PLUS 30.0
// And where it ends at the least Reynolds numbers of pumps (the same, figure 7.7).
#define CW_LOG_LAYER_END 300.0
// Of the width of a passage, in laminar flow. The wall shear that a cell of the height s W finds at its centre differs
// by s / 2 from that of a parabola over the width W: 1 %.
#define CW_LAMINAR_SHARE 0.02
// Fewer layers are no boundary layer mesh; policy.
enum { CW_LAYERS_LEAST = 3 };

typedef enum {
  CW_FIRST_ASKED,  // as the case gives it, or its y+
  CW_FIRST_AUTO,   // of a y+ in the log layer, or less where the passage is narrow
  CW_FIRST_FITTED, // what fits the passage, or all layers together as the case gives them, less than that
  CW_FIRST_LAMINAR // a share of the passage: the flow is laminar
} CwFirstSource;

typedef struct {
  double height;   // m
  double asked;    // of the case, or of a y+ in the log layer, m
  double y_plus;   // of `height` where the case counts it; NAN in laminar flow
  double reynolds; // of the passage
  double total;    // all layers together, as the case gives them, where that is what it fits, m; else 0
  CwFirstSource source;
} CwFirstHeight;

// All layers together on walls of a group, m: NAN, as all that is not given, where the case leaves that open.
double cw_thickness_given(const CwWalls *walls, const CwWallGroup *group);

// How tall columns may become, m: their share of the passage, or of the way to an open patch.
double cw_column_room(const CwWallFlow *flow);

// y_plus_auto: where the case leaves it open, from CW_LOG_LAYER_Y_PLUS to CW_LOG_LAYER_END, as far as
// CW_LAYER_COUNT_USUAL layers that grow by 1 + slope fit the passage, and `layer_count` even
// ones before an open patch, in laminar flow too.
CwFirstHeight cw_first_height_choose(const CwCase *table, const CwWallGroup *group, const CwWallFlow *flow,
                                     double y_plus_auto, int layer_count);

#ifdef __cplusplus
}
#endif
