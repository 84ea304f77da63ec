// SPDX-License-Identifier: AGPL-3.0-or-later
// What the planner weighs planes on: the work in the volume as samples, the work on the walls as pieces of background
// triangles, and points along the CAD edges; of the whole domain, and of the part in one cell of the tree.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"
#include "mesher/common/verticals.h"
#include "mesher/common/box_tree.h"
#include "mesher/parallel/context.h"
#include "mesher/plan/plan.h"
#include "mesher/size/size.h"

// What a plan is asked to be.
typedef struct {
  int32_t region_count; // at least 1; the plan has fewer where no plane divides a part of the domain any more
  // Of the layers over the point x of a CAD face that is a wall, m: planes and lines keep room for them; normal: of the
  // wall, out of the domain. Several threads call it at a time.
  double (*thickness)(const void *given, int32_t face, const double x[3], const double normal[3]);
  const void *given;
  double base_size;    // at which the model is looked at: a wanted edge length of a mesh of about a million cells
  double prism_factor; // predicted prisms = prism_factor * sum over wall triangles(area / h^2)
} CwPlanOptions;

// A place in the domain that stands for some of its volume.
typedef struct {
  double x[3], volume, work; // m3; predicted tetrahedra, none within the layers
} CwPlanSample;

// Of a background triangle; but for the normal zero off the walls.
typedef struct {
  double normal[3], density, thickness; // predicted prisms per m2; of the layers, m
} CwPlanTriangle;

// A point of a CAD edge, or the middle of a background edge that bounds a left-out face.
typedef struct {
  double x[3], tangent[3];
  double room;                      // m: how near a plane may come to it; 0 of an edge that is no feature
  double touch;                     // m: nearer than that a cut and the edge leave room for flat triangles alone
  int end;                          // at a CAD vertex
  double half;                      // m: half the length of the background edge; 0 of CAD edges
  int32_t stand_start, stand_count; // of the CAD edges that stand for it: a cut through it has a corner there
} CwPlanEdgePoint;

// A chord of a CAD edge that stands for another, and how far the edge lies off that one, m.
typedef struct {
  double x[2][3], gap;
} CwPlanStand;

// What cuts are judged by. The fields are points with their attributes: samples of the volume, background triangles,
// CAD edges and walls.
typedef struct {
  const CwContext *context; // the ranks that plan
  const CwVerticals *inside;
  const CwBackground *background;
  const CwSize *size;
  int32_t sample_count;
  CwPlanSample *sample;
  double sample_spacing;    // m
  double base_size;         // see CwPlanOptions
  uint8_t *wall;            // of each background triangle: on a wall
  CwPlanTriangle *triangle; // of each background triangle
  int32_t edge_count;       // points along CAD edges and borders of left-out faces
  CwPlanEdgePoint *edge;
  int32_t stand_count;
  CwPlanStand *stand;
  int32_t wall_count; // points all over the walls
  double (*wall_x)[3];
  int32_t *wall_triangle; // of each, the background triangle
  double thickest;        // m, of the layers anywhere
  CwBoxTree walls;        // of these points
  int32_t region_count;   // asked
  double mean_work;       // of the regions to be
} CwPlanModel;

// Convex pieces of background triangles: corner[start[i] .. start[i+1]) of piece i, cut from triangle[i].
typedef struct {
  int32_t count;
  int32_t *start, *triangle;
  double (*corner)[3];
  double *work; // predicted prisms
} CwPieces;

// What lies in one cell of the tree.
typedef struct {
  CwPieces pieces;
  int32_t sample_count, *sample;
  int32_t edge_count, *edge; // points of CAD edges in the cell or so near that they count
  double work, volume;       // cells; m3
  CwBox box;                 // of the samples
} CwPlanPart;

// True where the two faces of a CAD edge pass into one another: no feature, only a border of parameters.
int cw_plan_edge_is_smooth(const CwCad *cad, int edge);

// Collective: what takes long is shared among the ranks.
CwStatus cw_plan_model_make(const CwContext *context, const CwCad *cad, const CwBackground *background,
                            const CwVerticals *inside, const CwSize *size, const CwPlanOptions *options,
                            CwPlanModel *model);
void cw_plan_model_free(CwPlanModel *model);

// The whole domain, and the part of `whole` on the negative side of a plane (other: the positive one).
CwStatus cw_plan_part_whole(const CwPlanModel *model, CwPlanPart *part);
CwStatus cw_plan_part_clip(const CwPlanModel *model, const CwPlanPart *whole, const CwPlane *plane, int other,
                           CwPlanPart *part);
void cw_plan_part_free(CwPlanPart *part);

typedef struct {
  int32_t triangle, point;    // of the background, of the points all over the walls; -1: none
  double distance, thickness; // m; of its layers
} CwPlanWall;

// The wall nearest to x; none, infinitely far and with no layers, where none is within `reach` m or a little more.
// beside: the point found at a place beside it, from which the search goes the shorter way; -1: none.
CwPlanWall cw_plan_wall_near(const CwPlanModel *model, const double x[3], double reach, int32_t beside);
