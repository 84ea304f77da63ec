// SPDX-License-Identifier: AGPL-3.0-or-later
// Shapes for closed boundaries, appended to a surface (its orientation: 1 out, 0 in), and what bends or
// refines it. Lengths in m, angles in radians.
#pragma once

#include "closed_surfaces.h"
#include "tests/draw.h"

int32_t shape_point(Surface *s, double x, double y, double z);

// A box between two corners with n edges along each axis; a sphere, its triangles divided `level` times.
void shape_box(Surface *s, double lx, double ly, double lz, double hx, double hy, double hz, int nx, int ny, int nz,
               int outward);
void shape_ball(Surface *s, double x, double y, double z, double radius, int level, int outward);

// A point of a curve and the radius there, u from 0 to 1.
typedef void (*Curve)(const void *context, double u, double x[3], double *radius);

// A tube of `rows` points round a curve of `columns` points; closed on itself or with a fan over each end.
void shape_tube(Surface *s, Curve curve, const void *context, int rows, int columns, int closed, double shift,
                int outward);
void shape_torus(Surface *s, double x, double y, double z, double great, double small, double tilt, int rows,
                 int columns, int outward);

// Triangles of a simple polygon by its ears, the roundest first; counter-clockwise. Gives n - 2.
int shape_ears(int n, const double (*p)[2], int (*triangle)[3]);

// A counter-clockwise polygon, each edge cut into pieces of at most `edge`, extruded along z in `layers` and
// turned by `twist` from end to end; the same of a comb with `teeth` that take a share of it, and of a star.
void shape_extrude(Surface *s, int corners, const double (*corner)[2], double edge, double height, int layers,
                   double twist, int outward);
void shape_comb(Surface *s, int teeth, double share, double edge, double height, int layers, double twist);
void shape_star(Surface *s, int arms, double inner, double edge, double height, int layers, double twist);

// Turns the diagonals of two triangles where that makes none twice, one in `one_in`; gives how many.
int shape_turn_diagonals(Surface *s, uint64_t seed, int one_in);

// Cuts the longest edges of triangles that are longer than `least + growth * distance from the place`, and
// their neighbours', until none is or the surface has `limit` triangles.
void shape_refine(Surface *s, const double place[3], double least, double growth, int limit);

// Scales along the axes; turns about z by a, then about x by b.
void shape_scale(Surface *s, double x, double y, double z);
void shape_turn(Surface *s, double a, double b);
