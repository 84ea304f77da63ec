// SPDX-License-Identifier: AGPL-3.0-or-later
// Measures the layers of a finished run at places that are hard for them. Prints for each: wall triangles with their
// centre near it, share of them with all layers (%), share with their first height within 10 % (%), least scaled
// Jacobian of their prisms, least thickness (mm). Use: layer_places GEOMETRY_DIR MESH_DIR
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad.h"
#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "tests/measure/domain_mesh.h"

// The points that two patches have in common; all of one patch where both are the same; its bends where the second is
// "".
typedef struct {
  const char *name, *domain, *patch, *other;
  double reach; // m: of the columns from the points
} Place;

static const Place PLACES[] = {
    {"trailing_edge_hub", "rotor", "blade_trailing_edge", "hub", 1.5e-3},
    {"trailing_edge_shroud", "rotor", "blade_trailing_edge", "shroud", 1.5e-3},
    {"trailing_edge", "rotor", "blade_trailing_edge", "blade_trailing_edge", 1e-4},
    {"neck", "stator", "neck", "neck", 1e-4},
    {"step", "stator", "neck", "step", 2e-3},
    {"tongue", "stator", "tongue", "tongue", 1e-4},
    {"volute_corner", "stator", "volute", "", 2e-3},
};
enum { PLACE_COUNT = sizeof PLACES / sizeof *PLACES };

typedef struct {
  int32_t count, capacity;
  double (*x)[3];
} Points;

static CwStatus add_point(Points *points, const double x[3]) {
  CwStatus status = CW_OK;
  if (points->count == points->capacity) {
    points->capacity = points->capacity ? 2 * points->capacity : 256;
    double(*more)[3] = realloc(points->x, (size_t)points->capacity * sizeof *more);
    CW_REQUIRE(more, CW_ERR_MEMORY, "out of memory: %d points", points->capacity);
    points->x = more;
  }
  cw_copy(x, points->x[points->count++]);
done:
  return status;
}

static void triangle_normal(const CwRegionMesh *mesh, const int32_t *corner, double normal[3]) {
  cw_normal(mesh->cells.points[corner[0]], mesh->cells.points[corner[1]], mesh->cells.points[corner[2]], normal);
  cw_unit(normal);
}

static int is_wall(const CwRegionMesh *mesh, int32_t triangle) {
  return mesh->cells.triangle_cell[triangle] >= mesh->cells.tetrahedron_count + mesh->cells.pyramid_count;
}

// Points of one region that make up a place.
static CwStatus find_points(const CwRegionMesh *mesh, int patch, int other, Points *points) {
  CwStatus status = CW_OK;
  uint8_t *on = NULL;
  double(*normal)[3] = NULL;
  CW_NEW(on, mesh->cells.point_count);
  CW_NEW(normal, mesh->cells.point_count);
  for (int32_t t = 0; t < mesh->cells.triangle_count; t++) {
    double n[3];
    triangle_normal(mesh, mesh->cells.triangles[t], n);
    for (int k = 0; k < 3; k++) {
      int32_t v = mesh->cells.triangles[t][k];
      if (mesh->cells.triangle_patch[t] == other) on[v] |= 2;
      if (mesh->cells.triangle_patch[t] != patch) continue;
      if (other < 0 && (on[v] & 1) && cw_dot(n, normal[v]) < 0.7) on[v] |= 2; // more than 45 degrees
      on[v] |= 1;
      cw_copy(n, normal[v]);
    }
  }
  for (int32_t v = 0; v < mesh->cells.point_count; v++) {
    if (on[v] == 3) CW_TRY(add_point(points, mesh->cells.points[v]));
  }
done:
  free(on);
  free(normal);
  return status;
}

static double distance_to(const Points *points, const double x[3]) {
  double least = INFINITY;
  for (int32_t i = 0; i < points->count && least > 0; i++) least = fmin(least, cw_distance(points->x[i], x));
  return least;
}

typedef struct {
  int64_t columns, covered, met;
  double jacobian, thickness;
} Figures;

// The column over a wall triangle: how many prisms stand on one another.
static int column_height(const CwRegionMesh *mesh, int32_t prism) {
  int count = 1;
  for (; prism + 1 < mesh->cells.prism_count; prism++, count++) {
    if (memcmp(mesh->cells.prisms[prism] + 3, mesh->cells.prisms[prism + 1], sizeof(int32_t[3])) != 0) break;
  }
  return count;
}

// Least normal distance of the prism's top from the plane of the wall triangle.
static double height_over(const CwRegionMesh *mesh, int32_t triangle, int32_t prism) {
  double normal[3], least = INFINITY;
  triangle_normal(mesh, mesh->cells.triangles[triangle], normal);
  for (int k = 0; k < 3; k++) {
    double away[3];
    cw_sub(mesh->cells.points[mesh->cells.triangles[triangle][0]], mesh->cells.points[mesh->cells.prisms[prism][3 + k]],
           away);
    least = fmin(least, cw_dot(normal, away));
  }
  return least;
}

static void measure_region(const CwRegionMesh *mesh, const Points *points, double reach, int layers,
                           const double *first, Figures *figures) {
  for (int32_t t = 0; t < mesh->cells.triangle_count; t++) {
    if (!(first[mesh->cells.triangle_patch[t]] > 0)) continue; // no wall
    double centre[3] = {0};
    for (int k = 0; k < 9; k++) centre[k % 3] += mesh->cells.points[mesh->cells.triangles[t][k / 3]][k % 3] / 3;
    const double *corner = mesh->cells.points[mesh->cells.triangles[t][0]];
    if (distance_to(points, centre) > fmax(reach, cw_distance(corner, centre))) continue;
    figures->columns++;
    if (!is_wall(mesh, t)) continue;
    int32_t prism = mesh->cells.triangle_cell[t] - mesh->cells.tetrahedron_count - mesh->cells.pyramid_count;
    int made = column_height(mesh, prism);
    figures->covered += made == layers;
    figures->met += fabs(height_over(mesh, t, prism) / first[mesh->cells.triangle_patch[t]] - 1) <= 0.1;
    figures->thickness = fmin(figures->thickness, height_over(mesh, t, prism + made - 1));
    for (int k = 0; k < made; k++) {
      const double *x[6];
      for (int c = 0; c < 6; c++) x[c] = mesh->cells.points[mesh->cells.prisms[prism + k][c]];
      figures->jacobian = fmin(figures->jacobian, cw_prism_scaled_jacobian(x));
    }
  }
}

// First heights asked, by patch (0 where the patch is no wall), and the number of layers, from the record of the run.
static CwStatus read_targets(const char *mesh_dir, const char *domain, const CwCad *cad, double *first, int *layers) {
  CwStatus status = CW_OK;
  char path[4096];
  json_error_t error;
  size_t i, k;
  json_t *one, *patch;
  snprintf(path, sizeof path, "%s/record.json", mesh_dir);
  json_t *file = json_load_file(path, 0, &error), *record = json_object_get(file, "results");
  CW_REQUIRE(file, CW_ERR_IO, "%s: %s", path, error.text);
  json_array_foreach(json_object_get(record, "domains"), i, one) {
    if (strcmp(json_string_value(json_object_get(one, "name")), domain) != 0) continue;
    *layers = (int)json_integer_value(json_object_get(one, "layers"));
    json_array_foreach(json_object_get(one, "layer_coverage"), k, patch) {
      for (int p = 0; p < cw_cad_patch_count(cad); p++) {
        if (strcmp(cw_cad_patch_name(cad, p), json_string_value(json_object_get(patch, "patch"))) != 0) continue;
        first[p] = json_number_value(json_object_get(patch, "first_height_target_m"));
      }
    }
  }
  CW_REQUIRE(*layers > 0, CW_ERR_INPUT, "%s: no layers", path);
done:
  json_decref(file);
  return status;
}

static int patch_of(const CwCad *cad, const char *name) {
  for (int p = 0; p < cw_cad_patch_count(cad); p++) {
    if (strcmp(cw_cad_patch_name(cad, p), name) == 0) return p;
  }
  return -1;
}

static CwStatus measure(const char *geometry, const char *mesh_dir, const char *domain) {
  CwStatus status = CW_OK;
  CwCad *cad = NULL;
  CwDomainMesh mesh = {0};
  Points points = {0};
  double *first = NULL;
  int layers = 0;
  CW_TRY(cw_cad_open(geometry, domain, &cad));
  CW_TRY(cw_domain_mesh_read(mesh_dir, domain, &mesh));
  CW_NEW(first, cw_cad_patch_count(cad));
  CW_TRY(read_targets(mesh_dir, domain, cad, first, &layers));
  for (int i = 0; i < PLACE_COUNT; i++) {
    const Place *place = &PLACES[i];
    Figures figures = {.jacobian = INFINITY, .thickness = INFINITY};
    if (strcmp(place->domain, domain) != 0) continue;
    points.count = 0;
    for (int32_t r = 0; r < mesh.region_count; r++) {
      CW_TRY(find_points(&mesh.region[r], patch_of(cad, place->patch), patch_of(cad, place->other), &points));
    }
    CW_REQUIRE(points.count > 1, CW_ERR_INPUT, "%s: no points of %s", place->name, domain);
    for (int32_t r = 0; r < mesh.region_count; r++) {
      measure_region(&mesh.region[r], &points, place->reach, layers, first, &figures);
    }
    double columns = (double)figures.columns;
    printf("%-21s %8lld %9.2f %9.2f %9.3f %12.3f\n", place->name, (long long)figures.columns,
           100 * (double)figures.covered / columns, 100 * (double)figures.met / columns, figures.jacobian,
           1e3 * figures.thickness);
  }
done:
  free(points.x);
  free(first);
  cw_domain_mesh_free(&mesh);
  cw_cad_close(&cad);
  return status;
}

int main(int argc, char **argv) {
  if (argc != 3) {
    fprintf(stderr, "use: layer_places GEOMETRY_DIR MESH_DIR\n");
    return CW_ERR_USAGE;
  }
  printf("%-21s %8s %9s %9s %9s %12s\n", "place", "columns", "covered_%", "first_%", "jacobian", "thickness_mm");
  CwStatus status = measure(argv[1], argv[2], "rotor");
  if (status == CW_OK) status = measure(argv[1], argv[2], "stator");
  if (status != CW_OK) fprintf(stderr, "%s\n", cw_fail_message());
  return (int)status;
}
