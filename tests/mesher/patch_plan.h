// SPDX-License-Identifier: AGPL-3.0-or-later
// Plans of patches for the patch mesher, and what must hold of every mesh of one.
#pragma once

#include <stdint.h>

#include "mesher/surface/patch_mesh.h"

enum { MOST = 20000 };

// The map is chosen by `shape`, the field by `size` and `slope`.
typedef struct {
  enum { PLANE, STRETCHED, CYLINDER, SPHERE, FUNNEL } shape;
  double size, slope;
  double uv[MOST][2], x[MOST][3];
  int32_t edge[MOST][2];
  uint8_t boundary[MOST];
  CwPatchInput input;
} Plan;

typedef struct {
  double least_angle, mean_angle; // degrees; the mean is of the least angle of each triangle
  double outside;                 // share of edges not within 0.5 to 1.6 of the wanted length
  double clearance;               // least height of a free point over a given edge, in wanted lengths
  double area;                    // in space
} Figures;

void surface_at(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]);

// Least at x = 0, growing with |x|.
double size_at(const void *context, const double x[3]);

Plan *new_plan(int shape, double size);

int32_t add_point(Plan *plan, double u, double v);

void add_edge(Plan *plan, int32_t a, int32_t b, int boundary);

// Joins all points so far, in their order, by undivided edges round the patch.
void add_outline(Plan *plan);

// Joins points a and b by a straight line in (u,v), cut to the size field.
void add_line(Plan *plan, int32_t a, int32_t b, int boundary);

void add_loop(Plan *plan, int count, const double (*corner)[2]);

void add_rectangle(Plan *plan, double u0, double v0, double u1, double v1);

// A rhombus of equilateral triangles, n edges a side, on a surface that stretches u by 1 /
// scale; `turned` by an angle.
Plan *lattice_plan(int shape, int n, double h, double scale, double turned);

// Meshes the plan and checks its topology and places. Returns the clearance of the free points over the given edges.
double mesh_plan(Plan *plan, const char *title, double uv_area, int euler, CwPatchMesh *mesh);

// Meshes the plan twice, checks all that must hold of any mesh, prints its figures, and frees the plan.
Figures mesh_and_check(Plan *plan, const char *title, double uv_area, int euler, int components,
                       int32_t *triangle_count);

void check_good(Figures figures, double least, double mean);
