// SPDX-License-Identifier: AGPL-3.0-or-later
// The sides of an interface have the points of one surface of revolution and chords of their own between them, which
// lie apart by more than a thin layer is high, and what lies apart is not joined. So they are joined in a plane, where
// the chords lie in one surface: `./cs_solver --preprocess` maps the points of the interfaces to it and writes
// mesh_output, which `run` calls mesh_flat. Where that is there, it is read and joined, and the points are mapped back.
// The map is conformal, so that triangles keep their shapes: a meridian of slope (c, s) through (r, z) goes to the
// radius r (1 + c t / r)^(1 / c), or r exp(t / r) on a cylinder, at the length t along it.
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "bft_error.h"
#include "bft_mem.h"
#include "cs_defs.h"
#include "cs_join.h"
#include "cs_mesh.h"
#include "cs_preprocessor_data.h"
#include "cs_prototypes.h"
#include "cs_selector.h"

#include "pump.h"

// Of the mesh's size: the height of the first flat interface.
#define FAR 10

static const char flat_mesh[] = "mesh_flat", places[] = "mesh_flat.txt";

// Of an interface: the middle of its meridian, its slope (c >= 0), and the height at which it lies flat (m).
typedef struct {
  double r, z, c, s, height;
} Place;

static int is_flat(void) {
  return access(flat_mesh, R_OK) == 0;
}

void cs_user_mesh_input(void) {
  cs_preprocessor_data_add_file(is_flat() ? flat_mesh : "mesh_input", 0, NULL, NULL);
}

void cs_user_join(void) {
  // Points meet within a tenth of their shortest edge, those of one side before within a twentieth of that, and edges
  // are cut where they meet (intersection mode 2). All else is default.
  for (int i = 0; is_flat() && i < PUMP_INTERFACES; ++i) {
    const int joining = cs_join_add(pump_interfaces[i], 0.1f, 25.f, 1, 0);
    cs_join_set_advanced_param(joining, 1.0, 0.05, 1, 2, 500, 200, 30, 25, 5.0, 2.0);
  }
}

// The radius at a length along a meridian, and back.
static double flat_radius(const Place *at, double along) {
  return at->r * exp(log1p(at->c * along / at->r) / at->c);
}

static double length_along(const Place *at, double radius) {
  return at->r * expm1(at->c * log(radius / at->r)) / at->c;
}

static double radius_of(const double x[3]) {
  return hypot(x[0], x[1]);
}

static void flatten(const Place *at, double x[3]) {
  const double angle = atan2(x[1], x[0]), r = radius_of(x) - at->r, z = x[2] - at->z;
  const double radius = flat_radius(at, r * at->c + z * at->s);
  x[0] = radius * cos(angle), x[1] = radius * sin(angle), x[2] = at->height + z * at->c - r * at->s;
}

static void bend_back(const Place *at, double x[3]) {
  const double angle = atan2(x[1], x[0]), along = length_along(at, radius_of(x)), across = x[2] - at->height;
  const double r = at->r + along * at->c - across * at->s;
  x[0] = r * cos(angle), x[1] = r * sin(angle), x[2] = at->z + along * at->s + across * at->c;
}

// Marks the points of an interface.
static void mark_points(const cs_mesh_t *mesh, const char *group, char marked[]) {
  cs_lnum_t count, *faces;
  memset(marked, 0, (size_t)mesh->n_vertices);
  BFT_MALLOC(faces, mesh->n_b_faces, cs_lnum_t);
  cs_selector_get_b_face_list(group, &count, faces);
  for (cs_lnum_t i = 0; i < count; ++i)
    for (cs_lnum_t j = mesh->b_face_vtx_idx[faces[i]]; j < mesh->b_face_vtx_idx[faces[i] + 1]; ++j)
      marked[mesh->b_face_vtx_lst[j]] = 1;
  BFT_FREE(faces);
}

// The line of least squares through the marked points, in the plane of radius and z.
static Place meridian_of(const cs_mesh_t *mesh, const char marked[]) {
  Place at = {0};
  double points = 0, rr = 0, rz = 0, zz = 0;
  for (cs_lnum_t i = 0; i < mesh->n_vertices; ++i) {
    const double *x = mesh->vtx_coord + 3 * i;
    if (marked[i]) ++points, at.r += radius_of(x), at.z += x[2];
  }
  at.r /= points, at.z /= points;
  for (cs_lnum_t i = 0; i < mesh->n_vertices; ++i) {
    const double *x = mesh->vtx_coord + 3 * i, r = radius_of(x) - at.r, z = x[2] - at.z;
    if (marked[i]) rr += r * r, rz += r * z, zz += z * z;
  }
  // Nowhere is the cosine 0 in floating point, not of a cylinder either.
  const double slope = atan2(2 * rz, rr - zz) / 2;
  at.c = cos(slope), at.s = sin(slope);
  return at;
}

// Maps the interfaces to planes far above the mesh, which tell them apart.
static void flatten_all(cs_mesh_t *mesh) {
  char *marked;
  double size = 0;
  FILE *file = fopen(places, "w");
  BFT_MALLOC(marked, mesh->n_vertices, char);
  for (cs_lnum_t i = 0; i < 3 * mesh->n_vertices; ++i) size = fmax(size, fabs(mesh->vtx_coord[i]));
  for (int i = 0; file && i < PUMP_INTERFACES; ++i) {
    mark_points(mesh, pump_interfaces[i], marked);
    Place at = meridian_of(mesh, marked);
    at.height = (i + 1) * FAR * size;
    for (cs_lnum_t j = 0; j < mesh->n_vertices; ++j)
      if (marked[j]) flatten(&at, mesh->vtx_coord + 3 * j);
    fprintf(file, "%.17g %.17g %.17g %.17g %.17g\n", at.r, at.z, at.c, at.s, at.height);
  }
  BFT_FREE(marked);
  if (!file || fclose(file)) bft_error(__FILE__, __LINE__, errno, "cannot write %s", places);
}

static void bend_all_back(cs_mesh_t *mesh) {
  Place at[PUMP_INTERFACES + 1];
  FILE *file = fopen(places, "r");
  for (int i = 0; i < PUMP_INTERFACES; ++i)
    if (!file || fscanf(file, "%lg %lg %lg %lg %lg", &at[i].r, &at[i].z, &at[i].c, &at[i].s, &at[i].height) != 5)
      bft_error(__FILE__, __LINE__, errno, "cannot read %s: remove %s", places, flat_mesh);
  if (file) fclose(file);
  for (cs_lnum_t j = 0; j < mesh->n_vertices; ++j)
    for (int i = 0; i < PUMP_INTERFACES; ++i)
      if (fabs(mesh->vtx_coord[3 * j + 2] - at[i].height) < at[0].height / 2) {
        bend_back(at + i, mesh->vtx_coord + 3 * j);
        break;
      }
}

void cs_user_mesh_modify(cs_mesh_t *mesh) {
  if (is_flat())
    bend_all_back(mesh);
  else
    flatten_all(mesh);
  mesh->modified = 1;
}
