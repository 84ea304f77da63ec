// SPDX-License-Identifier: AGPL-3.0-or-later
// Thicknesses worked by hand on walls of a few triangles; lengths in any unit.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/policy.h"
#include "mesher/thickness/column_targets.h"
#include "mesher/thickness/layer_thickness.h"
#include "tests/unit_test.h"

enum { MOST = 16 };

typedef struct {
  CwPeriodicImages images;
  CwBoundaryInput in;
  CwSurfaceMesh surface;
  int32_t source[MOST], region_start[2], region_wall[MOST];
  double size;
  CwIncident around;
} Wall;

static double constant(const void *size, const double x[3]) {
  return *(const double *)size;
}

// All in one region, where edges are `size` long.
static void make_wall(Wall *wall, double size, int points, double (*x)[3], int triangles, int32_t (*triangle)[3],
                      int32_t *face) {
  memset(wall, 0, sizeof *wall);
  wall->size = size;
  wall->region_start[1] = triangles;
  for (int t = 0; t < triangles; t++) wall->source[t] = wall->region_wall[t] = t;
  wall->in = (CwBoundaryInput){.images = &wall->images, .size_at = constant, .size = &wall->size};
  wall->surface = (CwSurfaceMesh){.vertex_count = points,
                                  .x = x,
                                  .triangle_count = triangles,
                                  .triangle = triangle,
                                  .face = face,
                                  .region_start = wall->region_start,
                                  .region_triangle = wall->region_wall,
                                  .source = wall->source};
  assert_int_equal(cw_incident_make(points, triangles, (const int32_t(*)[3])triangle, &wall->around), CW_OK);
}

static void free_wall(Wall *wall, CwColumnTargets *targets) {
  cw_incident_free(&wall->around);
  cw_column_targets_free(targets);
}

// The unit square, its diagonal from corner 0 to corner 2.
static double square_x[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static int32_t square[2][3] = {{0, 1, 2}, {0, 2, 3}}, square_face[2] = {0, 0};

// Layers of 1, 2 and 4.
static const CwLayerTarget DOUBLING = {.first_height = 1, .growth = 2, .thickness = 7, .last = 1};

// A regular tetrahedron on edges of sqrt(3/2) h is h high.
static double edge_below(double last) {
  return sqrt(1.5) * last;
}

static void a_flat_wall(void **state) {
  assert_near(cw_column_thickness_flat(&DOUBLING, 3, edge_below(5)), 7, 1e-9);
  assert_near(cw_column_thickness_flat(&DOUBLING, 3, edge_below(2.25)), 4.75, 1e-9); // layers of 1, 1.5 and 2.25
  assert_near(cw_column_thickness_flat(&DOUBLING, 3, edge_below(0.5)), 3, 1e-9);     // three even layers
  CwLayerTarget thin = DOUBLING;
  thin.thickness = 4;
  assert_near(cw_column_thickness_flat(&thin, 3, edge_below(5)), 4, 1e-9);
  assert_near(cw_column_thickness_flat(
                  &(CwLayerTarget){.first_height = 1, .growth = 2, .thickness = INFINITY, .last = 1}, 1, 1),
              1, 1e-9);
  // A last layer of at most a sixth of it.
  CwLayerTarget open = DOUBLING;
  open.last = 1.0 / 6;
  assert_near(cw_column_thickness_flat(&open, 3, edge_below(6 * 2.25)), 4.75, 1e-9);
}

// Layers of 1, 1.5 and 2.25 over the wall z = 0, below which the fluid lies and edges grow by `rise` a length.
static double falling(const void *rise, const double x[3]) {
  return edge_below(2.25) - *(const double *)rise * x[2];
}

static void a_column_ends_where_sizes_are_others(void **state) {
  const double x[3] = {3, 4, 0}, normal[3] = {0, 0, 1}, at_wall = 4.75;
  const double none = 0, finer = -0.1, little = 0.1, much = 2;
  assert_near(cw_column_thickness_at(&DOUBLING, 3, falling, &none, x, normal), at_wall, 1e-9);
  assert_near(cw_column_thickness_at(&DOUBLING, 3, falling, &finer, x, normal), at_wall, 1e-9);
  // As over a wall with the edges that stand at the end of that column; they rise by no more than columns may.
  double end = cw_column_thickness_flat(&DOUBLING, 3, edge_below(2.25) + little * at_wall);
  assert_true(end > at_wall);
  assert_near(cw_column_thickness_at(&DOUBLING, 3, falling, &little, x, normal), end, 1e-9);
  double most = cw_column_thickness_flat(&DOUBLING, 3, edge_below(2.25) + cw_policy.slope * at_wall);
  assert_true(most > end && most < 7);
  assert_near(cw_column_thickness_at(&DOUBLING, 3, falling, &much, x, normal), most, 1e-9);
}

static void the_finer_patch_holds_where_two_meet(void **state) {
  // A strip of two triangles a step; the first step belongs to face 0.
  double x[8][3];
  int32_t triangle[6][3], face[6];
  for (int i = 0; i < 8; i++) memcpy(x[i], (double[3]){i / 2, i % 2, 0}, sizeof x[i]);
  for (int i = 0; i < 3; i++) {
    memcpy(triangle[2 * i], (int32_t[3]){2 * i, 2 * i + 2, 2 * i + 1}, sizeof *triangle);
    memcpy(triangle[2 * i + 1], (int32_t[3]){2 * i + 1, 2 * i + 2, 2 * i + 3}, sizeof *triangle);
    face[2 * i] = face[2 * i + 1] = i > 0;
  }
  const CwLayerTarget layers[2] = {{.first_height = 0.1, .growth = 2, .thickness = 0.7, .last = 1},
                                   {.first_height = 0.5, .growth = 1.5, .thickness = 2, .last = 1}};
  Wall wall;
  CwColumnTargets targets = {0};
  make_wall(&wall, 100, 8, x, 6, triangle, face);
  assert_int_equal(cw_column_targets_make(NULL, &wall.in, &wall.surface, &wall.around, layers, 3, &targets), CW_OK);
  // Three layers are three times the first where they do not grow, and thicknesses rise by 0.3.
  for (int v = 0; v < 4; v++) assert_near(targets.first_height[v], 0.1, 1e-9);
  for (int v = 4; v < 8; v++) assert_near(targets.first_height[v], 0.1 + 0.3 / 3 * (x[v][0] - 1), 1e-9);
  for (int v = 0; v < 8; v++) assert_near(targets.growth[v], v < 4 ? 2 : 1.5, 1e-9);
  // Growth of the face that has most, thickness of the one that has least.
  for (int v = 0; v < 4; v++) assert_near(targets.target[v], 0.7, 1e-9);
  assert_near(targets.target[4], targets.first_height[4] * 4.75, 1e-9);
  cw_column_targets_free(&targets);
  // A single layer rises as the first of two, which are twice as thick.
  assert_int_equal(cw_column_targets_make(NULL, &wall.in, &wall.surface, &wall.around, layers, 1, &targets), CW_OK);
  for (int v = 4; v < 8; v++) assert_near(targets.first_height[v], 0.1 + 0.3 / 2 * (x[v][0] - 1), 1e-9);
  free_wall(&wall, &targets);
}

// A periodic image has what its first has, whatever the layers where it lies ask for.
static void images_have_those_of_their_first(void **state) {
  double x[8][3];
  int32_t triangle[4][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}, face[4] = {0, 0, 1, 1};
  int32_t next[8] = {4, 5, 6, 7, 0, 1, 2, 3}, turns[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  for (int v = 0; v < 8; v++) memcpy(x[v], (double[3]){square_x[v % 4][0] + 50 * (v / 4), square_x[v % 4][1], 0}, 24);
  const CwLayerTarget layers[2] = {DOUBLING, {.first_height = 3, .growth = 1.5, .thickness = 20, .last = 1}};
  Wall wall;
  CwColumnTargets targets = {0};
  make_wall(&wall, 100, 8, x, 4, triangle, face);
  wall.surface.images = (CwNodeImages){.capacity = 8, .next = next, .turns = turns};
  assert_int_equal(cw_column_targets_make(NULL, &wall.in, &wall.surface, &wall.around, layers, 3, &targets), CW_OK);
  for (int v = 0; v < 8; v++) {
    assert_near(targets.first_height[v], 1, 1e-9);
    assert_near(targets.growth[v], 2, 1e-9);
    assert_near(targets.target[v], 7, 1e-9);
  }
  free_wall(&wall, &targets);
}

// A roof whose two planes fall by 45 degrees, seen at the middle of its ridge: with fluid below it is concave. One end
// of the ridge lies higher by `lift`.
static double roof_height(double size, int fluid_above, double lift) {
  double x[5][3] = {{0, 0, 0}, {0, -1, lift}, {0, 1, 0}, {-1, 0, -1}, {1, 0, -1}};
  int32_t triangle[4][3] = {{1, 4, 0}, {0, 4, 2}, {2, 3, 0}, {0, 3, 1}}, face[4] = {0};
  Wall wall;
  CwColumnTargets targets = {0};
  for (int t = 0; t < 4 && fluid_above; t++) {
    int32_t swap = triangle[t][1];
    triangle[t][1] = triangle[t][2], triangle[t][2] = swap;
  }
  make_wall(&wall, size, 5, x, 4, triangle, face);
  assert_int_equal(cw_column_targets_make(NULL, &wall.in, &wall.surface, &wall.around, &DOUBLING, 3, &targets), CW_OK);
  double thickness = targets.target[0];
  free_wall(&wall, &targets);
  return thickness;
}

static void bends_of_the_wall(void **state) {
  // Where it is concave tetrahedra are lower by cos 45: with a last layer of 2.25, after 1 and 1.5.
  assert_near(roof_height(edge_below(2.25) / sqrt(0.5), 0, 0), 4.75, 1e-9);
  // Over the ridge they are not, be it level or rising to one side.
  assert_near(roof_height(edge_below(2.25), 1, 0), 4.75, 1e-9);
  assert_near(roof_height(edge_below(2.25), 1, 0.1), 4.75, 1e-9);
  assert_near(roof_height(edge_below(5), 1, 0), 7, 1e-9);
}

static void a_vertex_without_triangle_is_an_error(void **state) {
  double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Wall wall;
  CwColumnTargets targets = {0};
  make_wall(&wall, 100, 4, x, 1, square, square_face);
  assert_int_equal(cw_column_targets_make(NULL, &wall.in, &wall.surface, &wall.around, &DOUBLING, 3, &targets),
                   CW_ERR_MESH);
  free_wall(&wall, &targets);
}

static void the_share_of_graded_columns(void **state) {
  const CwLayerTarget layers = {.first_height = 1, .growth = 2, .thickness = 2, .last = 1};
  Wall wall;
  CwColumnTargets targets = {0};
  double share = 0;
  make_wall(&wall, 100, 4, square_x, 2, square, square_face);
  assert_int_equal(cw_column_targets_make(NULL, &wall.in, &wall.surface, &wall.around, &layers, 2, &targets), CW_OK);
  assert_int_equal(cw_column_targets_share(NULL, &targets, &wall.in, &wall.surface, &wall.around, &layers, &share),
                   CW_OK);
  assert_near(share, 1, 1e-9);
  targets.target[0] = 1; // its neighbours come down to 1.3, the corner over the diagonal to 1 + 0.3 sqrt(2)
  assert_int_equal(cw_column_targets_share(NULL, &targets, &wall.in, &wall.surface, &wall.around, &layers, &share),
                   CW_OK);
  assert_near(share, (1 + 1.3 + 1 + 0.3 * sqrt(2)) / 3 / 2, 1e-9);
  free_wall(&wall, &targets);
}

// A column thinned to its least keeps its first height; one a little thinner does not.
static void the_least_columns_have_their_first_height(void **state) {
  for (int count = 2; count <= 18; count += 4) {
    const CwLayerTarget layers = {.first_height = 0.5, .growth = 1.2, .thickness = 100, .last = 1};
    Wall wall;
    CwColumnTargets targets = {0};
    double fraction[CW_LAYERS_MOST + 1];
    make_wall(&wall, 100, 4, square_x, 2, square, square_face);
    assert_int_equal(cw_column_targets_make(NULL, &wall.in, &wall.surface, &wall.around, &layers, count, &targets),
                     CW_OK);
    assert_near(cw_layer_fractions(targets.least[0], 0.5, count, 1.2, fraction), 0.5, 1e-9);
    assert_near(cw_layer_fractions(0.9 * targets.least[0], 0.5, count, 1.2, fraction), 0.45, 1e-9);
    free_wall(&wall, &targets);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(images_have_those_of_their_first),
                                     cmocka_unit_test(a_flat_wall),
                                     cmocka_unit_test(a_column_ends_where_sizes_are_others),
                                     cmocka_unit_test(the_finer_patch_holds_where_two_meet),
                                     cmocka_unit_test(bends_of_the_wall),
                                     cmocka_unit_test(a_vertex_without_triangle_is_an_error),
                                     cmocka_unit_test(the_share_of_graded_columns),
                                     cmocka_unit_test(the_least_columns_have_their_first_height)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
