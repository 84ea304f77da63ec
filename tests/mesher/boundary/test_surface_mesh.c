// SPDX-License-Identifier: AGPL-3.0-or-later
// A tetrahedron's surface is a sound surface mesh, whole or open; each way of spoiling it is told.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "mesher/boundary/surface_mesh.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

enum { VERTICES = 4, TRIANGLES = 4, REGIONS = 2 };

// Triangles 0 and 2 in region 0, 1 and 3 in region 1.
typedef struct {
  CwSurfaceMesh surface;
  double x[VERTICES][3];
  int32_t triangle[TRIANGLES][3], face[TRIANGLES], region[TRIANGLES], start[REGIONS + 1], listed[TRIANGLES],
      source[TRIANGLES];
} Tetrahedron;

static void make(Tetrahedron *made) {
  static const Tetrahedron plain = {.x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                    .triangle = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
                                    .face = {0, 1, 2, 3},
                                    .region = {0, 1, 0, 1},
                                    .start = {0, 2, 4},
                                    .listed = {0, 2, 1, 3},
                                    .source = {0, 1, 2, 3}};
  *made = plain;
  made->surface = (CwSurfaceMesh){.vertex_count = VERTICES,
                                  .x = made->x,
                                  .triangle_count = TRIANGLES,
                                  .triangle = made->triangle,
                                  .face = made->face,
                                  .region = made->region,
                                  .region_start = made->start,
                                  .region_triangle = made->listed,
                                  .source = made->source};
}

static void sound_ones_pass(void **state) {
  Tetrahedron of;
  make(&of);
  assert_int_equal(cw_surface_mesh_audit(&of.surface, REGIONS), CW_OK);
  of.surface.triangle_count = of.start[2] = 3; // without the last triangle it is open, and as sound
  assert_int_equal(cw_surface_mesh_audit(&of.surface, REGIONS), CW_OK);
  of.surface.triangle_count = of.start[2] = 4;
  of.source[3] = 1; // a periodic image of triangle 1
  assert_int_equal(cw_surface_mesh_audit(&of.surface, REGIONS), CW_OK);
}

static void told(Tetrahedron *of, const char *message) {
  assert_int_equal(cw_surface_mesh_audit(&of->surface, REGIONS), CW_ERR_FAULT);
  if (!strstr(cw_fail_message(), message)) fail_msg("%s", cw_fail_message());
  make(of);
}

static void spoiled_ones_are_told(void **state) {
  Tetrahedron of;
  make(&of);
  of.triangle[2][1] = VERTICES;
  told(&of, "triangle 2 has the corners 1, 4, 3 of 4 vertices");
  of.triangle[1][2] = of.triangle[1][1];
  told(&of, "triangle 1 has the corners 0, 1, 1");
  of.surface.triangle_count = of.start[2] = 2; // triangles 0 and 1
  of.triangle[1][2] = 2;
  told(&of, "vertex 3 at (0.000, 0.000, 1000.000) mm has no triangle");
  of.triangle[3][1] = 2, of.triangle[3][2] = 3; // turned over
  told(&of, "run the same way along the edge");
  // The edge of the first triangle that ends at its first corner counts as the others do.
  of.triangle[3][0] = 1, of.triangle[3][1] = 0, of.triangle[3][2] = 3; // as triangle 0 has its edge from 1 to 0
  told(&of, "triangles 0 and 3 run the same way along the edge from (0.000, 0.000, 0.000) to (1000.000, 0.000, 0.000)");
  of.start[2] = 3;
  told(&of, "regions list 3 of 4 triangles");
  of.listed[1] = 0;
  told(&of, "region 0 lists triangle 0 after 0");
  of.region[3] = 0;
  told(&of, "region 1 lists triangle 3 after 1");
  of.source[3] = 1, of.source[1] = 0;
  told(&of, "triangle 3 is a copy of 1");
}

// What is free has nothing, and may be freed again.
static void freed_ones_are_empty(void **state) {
  CwSurfaceMesh surface = {.vertex_count = 1, .triangle_count = 1}, none = {0};
  surface.x = malloc(sizeof *surface.x);
  surface.triangle = malloc(sizeof *surface.triangle);
  cw_surface_mesh_free(&surface);
  assert_memory_equal(&surface, &none, sizeof none);
  cw_surface_mesh_free(&surface);
}

static void vtk_has_all_triangles(void **state) {
  Tetrahedron of;
  make(&of);
  const char *path = in_test_folder("it.vtk");
  assert_int_equal(cw_surface_mesh_vtk(&of.surface, path), CW_OK);
  char *text = read_whole(path, NULL);
  remove(path);
  assert_non_null(strstr(text, "DATASET POLYDATA\nPOINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"));
  assert_non_null(strstr(text, "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"));
  assert_non_null(strstr(text, "CELL_DATA 4\nSCALARS face int 1\nLOOKUP_TABLE default\n0\n1\n2\n3\n"));
  assert_non_null(strstr(text, "SCALARS region int 1\nLOOKUP_TABLE default\n0\n1\n0\n1\n"));
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sound_ones_pass),
      cmocka_unit_test(spoiled_ones_are_told),
      cmocka_unit_test(freed_ones_are_empty),
      cmocka_unit_test(vtk_has_all_triangles),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
