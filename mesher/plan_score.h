// SPDX-License-Identifier: AGPL-3.0-or-later
// How the planner weighs one dividing plane against another, and the clipped surface it weighs them on.
#ifndef CUTWATER_MESHER_PLAN_SCORE_H
#define CUTWATER_MESHER_PLAN_SCORE_H

#include "mesher/plan.h"

// Convex pieces of background triangles: corner[start[i] .. start[i+1]) of piece i, cut from triangle[i].
typedef struct {
  int32_t count;
  int32_t *start, *triangle;
  double (*corner)[3];
} CwPieces;

typedef struct {
  const CwCad *cad;
  const CwBackground *background;
  const CwInside *inside;
  const CwPlanOptions *options;
  int32_t sample_count;
  double (*sample_x)[3];
  double *sample_volume, *sample_work; // m3; predicted tetrahedra
  double spacing;                      // m, typical distance of samples
  double *density;                     // predicted prisms per m2 of each background triangle (0 on caps)
  double (*normal)[3], (*centre)[3];   // of each background triangle
  int32_t edge_point_count;            // points along CAD edges that bound a wall, with tangents
  double (*edge_x)[3], (*edge_t)[3];
  double *edge_room;                   // m: how near a plane may come to each of them
} CwPlanScorer;

CwStatus cw_pieces_from_background(const CwBackground *background, CwPieces *pieces);
CwStatus cw_pieces_clip(const CwPieces *pieces, const CwPlane *plane, CwPieces *kept);
void cw_pieces_free(CwPieces *pieces);

CwStatus cw_plan_scorer_make(const CwCad *cad, const CwBackground *background, const CwInside *inside,
                             const CwSize *size, const CwPlanOptions *options, CwPlanScorer *scorer);
void cw_plan_scorer_free(CwPlanScorer *scorer);

// Predicted cells (prisms and tetrahedra) of a part of the domain.
double cw_plan_work(const CwPlanScorer *scorer, const CwPieces *pieces, int32_t sample_count, const int32_t *sample);

// How many points of CAD edges in the cell of `node` the plane runs along or grazes.
int32_t cw_plan_grazed_edges(const CwPlanScorer *scorer, const CwPlan *plan, int32_t node, const CwPlane *plane);

// How the lines of a new plane for `node` with its ancestors fare, `reach` m about the points of the lines nearest to the
// origin: 0 fine, 1 cramped, 2 one coincides with another.
int cw_plan_judge_lines(const CwPlanScorer *scorer, const CwPlan *plan, int32_t node, const CwPlane *plane,
                        double reach);

// The best plane for `node` (its ancestors are in the plan) to divide a part that is to become `regions` regions;
// *first of them on its negative side. *worst_angle: least sqrt(1 - (n.m)^2) over the wall triangles it crosses. Fails
// with CW_ERR_MESH where no plane at all divides the part.
CwStatus cw_plan_best_plane(const CwPlanScorer *scorer, const CwPlan *plan, int32_t node, const CwPieces *pieces,
                            int32_t sample_count, const int32_t *sample, int32_t regions, CwPlane *plane,
                            int32_t *first, double *worst_angle);

#endif
