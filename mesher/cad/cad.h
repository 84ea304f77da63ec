// SPDX-License-Identifier: AGPL-3.0-or-later
// The exact geometry of one domain, read from the geometry stage. The one bridge of the mesher to OpenCASCADE. The
// B-rep has a unit of its own; lengths here are metres until cw_cad_rescale brings them to the unit of the model
// (common/model_unit). Indices are 0-based. One thread at a time asks a solid: OpenCASCADE keeps what it found last.
#pragma once

#include "mesher/common/box.h"
#include "pipeline/model.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwCad CwCad;

// Opens GEOMETRY_DIR/DOMAIN.brep and its rows of GEOMETRY_DIR/faces.csv. Fails with CW_ERR_IO, with CW_ERR_INPUT (other
// than one solid, a face with a seam or two degenerate edges, a face without a row), with CW_ERR_LIBRARY where
// OpenCASCADE does. [out] cad: cw_cad_close.
CwStatus cw_cad_open(const char *geometry_dir, const char *domain, CwCad **cad);
void cw_cad_close(CwCad **cad);

// Widens the box by the vertices of the solid and places along its edges.
void cw_cad_add_to_box(const CwCad *cad, CwBox *box);
// Lengths are in `unit`, m, from then on: the unit of the B-rep file times a power of two, so that no number loses a
// bit (of moved faces the place does), and solids with the same numbers, or powers of two of them, become one and the
// same. What was asked before, parameters included, holds no more.
CwStatus cw_cad_rescale(CwCad *cad, double unit);

// Within which places of the solid are one: the greatest tolerance of its vertices and edges, but no less than 1e-9 in
// the unit of the model.
double cw_cad_tolerance(const CwCad *cad);

int cw_cad_patch_count(const CwCad *cad);
const char *cw_cad_patch_name(const CwCad *cad, int patch);
CwPatchKind cw_cad_patch_kind(const CwCad *cad, int patch);

int cw_cad_face_count(const CwCad *cad);
int cw_cad_face_patch(const CwCad *cad, int face);
const char *cw_cad_face_name(const CwCad *cad, int face);
int cw_cad_face_is_wall(const CwCad *cad, int face); // whether layers grow on the face

// True where xu x xv points into the fluid, so that triangles that are counter-clockwise in (u,v) must be
// turned to have their normal out of the domain.
int cw_cad_face_reversed(const CwCad *cad, int face);

// Takes the file for one whose faces point into the solid: turns them all. Whether it is one only a volume tells, so
// that it is cw_background_join that finds it; before that the faces are as the file has them.
void cw_cad_turn(CwCad *cad);

// Faces and edges are evaluated without a status: where OpenCASCADE fails, as at a singular point of an offset surface,
// the one error line, with the face and its place, ends all ranks (CW_ERR_GEOMETRY).

// Point of a face at (u,v); with the first derivatives where xu and xv are not NULL.
void cw_cad_face_point(const CwCad *cad, int face, const double uv[2], double x[3], double xu[3], double xv[3]);

// Unit normal of a face at (u,v), out of the domain.
void cw_cad_face_normal(const CwCad *cad, int face, const double uv[2], double n[3]);

// What the exact face adds to the volume of the solid: the integral of x.n / 3 over it, n out of the domain, m3; 0
// where OpenCASCADE cannot have it.
double cw_cad_face_volume(const CwCad *cad, int face);

// The principal curvature of the greater amount, 1/m: above 0 where the face bends away from the fluid, as round a rod.
// *lesser: the other one, unless NULL.
double cw_cad_face_curvature(const CwCad *cad, int face, const double uv[2], double *lesser);

// Nearest point of the face's surface to x by Newton from the given (u,v), which it updates. Returns the
// distance, m.
double cw_cad_face_project(const CwCad *cad, int face, const double x[3], double uv[2]);

// Distance of x from the surface of a face, wherever on it; exact for planes, cylinders and spheres.
double cw_cad_face_distance(const CwCad *cad, int face, const double x[3]);

int cw_cad_edge_count(const CwCad *cad);
// Ends of the edge's parameter; vertices at those ends; its two faces (both differ: there are no seams).
void cw_cad_edge_range(const CwCad *cad, int edge, double t[2]);
void cw_cad_edge_vertices(const CwCad *cad, int edge, int vertex[2]);
void cw_cad_edge_faces(const CwCad *cad, int edge, int face[2]);
// Point and tangent dx/dt (NULL: not wanted) at t; (u,v) of that point on one of its faces.
void cw_cad_edge_point(const CwCad *cad, int edge, double t, double x[3], double xt[3]);
void cw_cad_edge_uv(const CwCad *cad, int edge, int face, double t, double uv[2]);

int cw_cad_vertex_count(const CwCad *cad);
void cw_cad_vertex_point(const CwCad *cad, int vertex, double x[3]);

#ifdef __cplusplus
}
#endif
