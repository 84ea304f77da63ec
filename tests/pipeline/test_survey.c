// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/survey.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/picture_list.h"
#include "tests/draw.h"
#include "tests/pipeline/surveyed_walls.h"
#include "tests/unit_test.h"

// Two blades' trailing edges as one triangle each, on opposite sides; the far corner of a discharge at
// azimuth 90 deg.
static void survey_finds_places(void **state) {
  double x[][3] = {{0.1, 0, -0.004},      {0.1, 0.003, 0.004},  {0.1, -0.003, 0.004}, {-0.1, 0, -0.004},
                   {-0.1, -0.003, 0.004}, {-0.1, 0.003, 0.004}, {0, 0.3, 0.02},       {0.001, 0.3, -0.02},
                   {-0.001, 0.29, 0},     {0.05, 0, -0.01},     {0, 0.05, -0.01},     {0.0, -0.05, -0.01}};
  int32_t triangle[][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}, patch[] = {0, 0, 1, 2};
  CwModelPatch names[] = {{.name = "blade_trailing_edge", .kind = CW_PATCH_WALL},
                          {.name = "outlet", .kind = CW_PATCH_OUTLET},
                          {.name = "shroud", .kind = CW_PATCH_WALL}};
  CwMesh mesh = {.patch_count = 3, .patches = names};
  CwRegionData cells = {
      .point_count = 12, .triangle_count = 4, .points = x, .triangles = triangle, .triangle_patch = patch};
  CwPumpSizes sizes = {2, 0.05, 0.1, 0.101, 0.102, -1};
  CwSurvey *survey = malloc(sizeof *survey);
  double middle[3], radius, z_least, z_most, z;
  cw_survey_start(survey, &sizes);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_TRAILING_EDGE, middle), 0);
  assert_int_equal(cw_survey_wall(survey, CW_WALL_SHROUD, 0.02, &z), 0);
  assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_TRAILING_EDGE, middle),
                   1); // one blade, not the mean of both
  assert_near(fabs(middle[0]), 0.1, 1e-9);
  assert_near(middle[1], 0, 1e-9);
  assert_near(middle[2], 0.004 / 3, 1e-9);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_TONGUE, middle), 0);
  // Midway between two blades is at 90 deg from both.
  assert_near(fabs(sin(cw_survey_meridional_azimuth(survey))), 1, 1e-9);
  assert_int_equal(cw_survey_meridional_reach(survey, M_PI / 2, &radius, &z_least, &z_most), 1);
  assert_near(radius, hypot(0.001, 0.3), 1e-9);
  assert_near(z_least, -0.02, 1e-12);
  assert_near(z_most, 0.02, 1e-12);
  assert_int_equal(cw_survey_wall(survey, CW_WALL_SHROUD, 0.05 / 3, &z), 1);
  assert_near(z, -0.01, 1e-12);
  assert_false(cw_survey_has_span(survey));
  // Midway between walls: a hub at z = 0.02 of the same radius, over a shroud at -0.01.
  assert_true(isnan(cw_survey_span(survey, 0.5, (double[]){0.01, 0.01, 0}))); // no hub yet
  for (int k = 9; k < 12; k++) x[k][2] = 0.02;
  snprintf(names[2].name, sizeof names[2].name, "hub");
  assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
  assert_true(cw_survey_has_span(survey));
  assert_near(cw_survey_span(survey, 0.5, (double[]){0, 0.05 / 3, 0.03}), 0.025, 1e-12);
  // Hub at 0.02, shroud at -0.01: the surfaces near them, where the list of pictures has them.
  assert_near(cw_survey_span(survey, cw_plane_span(CW_PLANE_NEAR_HUB), (double[]){0, 0.05 / 3, 0.03}), 0.013, 1e-12);
  assert_near(cw_survey_span(survey, cw_plane_span(CW_PLANE_NEAR_SHROUD), (double[]){0, 0.05 / 3, 0.03}), 0.037, 1e-12);
  assert_true(isnan(cw_plane_span(CW_PLANE_Z0)));
  assert_true(isnan(cw_survey_span(survey, 0.5, (double[]){0.09, 0, 0})));
  // Of leading edges those of whole blades count: the larger face, further out, is a splitter's.
  names[0] = (CwModelPatch){.name = "blade_leading_edge", .kind = CW_PATCH_WALL};
  x[0][0] = 0.04;
  x[1][0] = x[2][0] = 0.041;
  cw_survey_start(survey, &sizes);
  assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_LEADING_EDGE, middle), 1);
  assert_near(middle[0], 0.122 / 3, 1e-9);
  free(survey);
}

// Faces of trailing edges on both sides of azimuth 0, with the same area, and of one of the other three blades.
static void a_blade_at_azimuth_zero_is_whole(void **state) {
  double x[9][3];
  int32_t triangle[][3] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}, patch[] = {0, 0, 0};
  CwModelPatch name = {.name = "blade_trailing_edge", .kind = CW_PATCH_WALL};
  CwMesh mesh = {.patch_count = 1, .patches = &name};
  CwRegionData cells = {
      .point_count = 9, .triangle_count = 3, .points = x, .triangles = triangle, .triangle_patch = patch};
  const CwPumpSizes sizes = {4, 0.05, 0.1, 0.101, 0.102, -1};
  const double azimuth[3] = {-0.04, 0.04, M_PI / 2};
  for (int t = 0; t < 3; t++)
    for (int k = 0; k < 3; k++) {
      const double turned = azimuth[t] + 1e-3 * (k - 1);
      memcpy(x[3 * t + k], (double[]){0.1 * cos(turned), 0.1 * sin(turned), k == 1 ? 4e-3 : -2e-3}, sizeof *x);
    }
  CwSurvey *survey = malloc(sizeof *survey);
  double middle[3];
  cw_survey_start(survey, &sizes);
  assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
  assert_int_equal(cw_survey_place(survey, CW_PLACE_TRAILING_EDGE, middle), 1);
  assert_near(middle[0], 0.1 * cos(0.04), 1e-6);
  assert_near(middle[1], 0, 1e-9);
  assert_near(middle[2], 0, 1e-9);
  free(survey);
}

// Of four blades, one at azimuth 0, the planes midway lie at 45 and 135 degrees; one of them has a discharge in it.
static void the_meridional_plane_leaves_the_discharge(void **state) {
  double x[6][3] = {{0.1, 0, -0.004}, {0.1, 0.001, 0.004}, {0.1, -0.001, 0.004}};
  int32_t triangle[][3] = {{0, 1, 2}, {3, 4, 5}}, patch[] = {0, 1};
  CwModelPatch names[] = {{.name = "blade_trailing_edge", .kind = CW_PATCH_WALL},
                          {.name = "outlet", .kind = CW_PATCH_OUTLET}};
  CwMesh mesh = {.patch_count = 2, .patches = names};
  CwRegionData cells = {
      .point_count = 6, .triangle_count = 2, .points = x, .triangles = triangle, .triangle_patch = patch};
  const CwPumpSizes sizes = {4, 0.05, 0.1, 0.101, 0.102, -1};
  CwSurvey *survey = malloc(sizeof *survey);
  for (int quarter = 0; quarter < 4; quarter++) {
    const double discharge = M_PI / 4 + quarter * M_PI / 2;
    for (int k = 0; k < 3; k++)
      memcpy(x[3 + k], (double[]){0.3 * cos(discharge), 0.3 * sin(discharge), 0.02 * (k - 1)}, sizeof *x);
    cw_survey_start(survey, &sizes);
    assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
    const double azimuth = cw_survey_meridional_azimuth(survey);
    assert_near(fabs(cos(azimuth)), M_SQRT1_2, 1e-3);
    assert_near(cos(azimuth - discharge), 0, 1e-3);
    double radius, least, most;
    assert_int_equal(cw_survey_meridional_reach(survey, discharge + M_PI, &radius, &least, &most), 1); // both sides
    assert_near(radius, 0.3, 1e-12);
    assert_near(most - least, 0.04, 1e-12);
  }
  free(survey);
}

// A plane hub and a conical shroud, as strips all round: between the middles of bins and between both walls the surface
// of a share is linear.
static void shares_of_the_span_are_cones(void **state) {
  enum { RINGS = 320, POINTS = (RINGS + 1) * WALLS_AROUND, FACES = 2 * RINGS * WALLS_AROUND };
  static double x[2 * POINTS][3];
  static int32_t triangle[2 * FACES][3], patch[2 * FACES];
  CwModelPatch names[] = {{.name = "hub", .kind = CW_PATCH_WALL}, {.name = "shroud", .kind = CW_PATCH_WALL}};
  CwMesh mesh = {.patch_count = 2, .patches = names};
  CwRegionData cells = {.point_count = 2 * POINTS,
                        .triangle_count = 2 * FACES,
                        .points = x,
                        .triangles = triangle,
                        .triangle_patch = patch};
  const CwPumpSizes sizes = {4, 0.05, 0.1, 0.101, 0.102, -1};
  wall_strips(RINGS, 0.08, (const double[2]){-0.03, 0.2}, x, triangle, patch);
  CwSurvey *survey = malloc(sizeof *survey);
  cw_survey_start(survey, &sizes);
  assert_int_equal(cw_survey_add(survey, &mesh, &cells), CW_OK);
  uint64_t seed = 1;
  for (int i = 0; i < 500; i++) {
    const double radius = 0.03 + 0.06 * draw(&seed), share = draw(&seed), angle = 7 * draw(&seed),
                 z = draw(&seed) - 0.5;
    const double surface = (1 - share) * 0.01 + share * (-0.03 + 0.2 * radius);
    const double at[3] = {radius * cos(angle), radius * sin(angle), z};
    assert_near(cw_survey_span(survey, share, at), z - surface, 2e-4); // a tenth of a bin's width is 1.6e-4
  }
  free(survey);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(survey_finds_places),
      cmocka_unit_test(a_blade_at_azimuth_zero_is_whole),
      cmocka_unit_test(the_meridional_plane_leaves_the_discharge),
      cmocka_unit_test(shares_of_the_span_are_cones),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
