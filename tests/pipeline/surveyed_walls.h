// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <math.h>
#include <string.h>

#include "pipeline/report/survey.h"
#include "tests/unit_test.h"

// A hub at z = 0.01 and a shroud at z = -0.02, flat rings from a radius of 0.02 to 0.09, and a trailing edge
// at azimuth 90 degrees.
static inline void survey_walls(const CwPumpSizes *sizes, CwSurvey *survey) {
  enum { RINGS = 48, AROUND = 24, POINTS = (RINGS + 1) * AROUND, FACES = 2 * RINGS * AROUND };
  static double x[2 * POINTS + 3][3] = {[2 * POINTS] = {0, 0.1, -0.004}, {0.003, 0.1, 0.004}, {-0.003, 0.1, 0.004}};
  static int32_t triangle[2 * FACES + 1][3] = {[2 * FACES] = {2 * POINTS, 2 * POINTS + 1, 2 * POINTS + 2}},
                                      patch[2 * FACES + 1] = {[2 * FACES] = 2};
  static CwModelPatch names[] = {{.name = "hub", .kind = CW_PATCH_WALL},
                                 {.name = "shroud", .kind = CW_PATCH_WALL},
                                 {.name = "blade_trailing_edge", .kind = CW_PATCH_WALL}};
  const CwMesh known = {.patch_count = 3, .patches = names};
  const CwRegionData surface = {.point_count = 2 * POINTS + 3,
                                .triangle_count = 2 * FACES + 1,
                                .points = x,
                                .triangles = triangle,
                                .triangle_patch = patch};
  for (int wall = 0, t = 0; wall < 2; wall++)
    for (int r = 0; r <= RINGS; r++)
      for (int a = 0; a < AROUND; a++) {
        const double radius = 0.02 + 0.07 * r / RINGS, angle = 2 * M_PI * a / AROUND;
        const int32_t here = wall * POINTS + r * AROUND + a, next = wall * POINTS + r * AROUND + (a + 1) % AROUND;
        memcpy(x[here], (double[]){radius * cos(angle), radius * sin(angle), wall ? -0.02 : 0.01}, sizeof *x);
        if (r == RINGS) continue;
        memcpy(triangle[t], (int32_t[]){here, next, next + AROUND}, sizeof *triangle);
        memcpy(triangle[t + 1], (int32_t[]){here, next + AROUND, here + AROUND}, sizeof *triangle);
        patch[t] = patch[t + 1] = wall;
        t += 2;
      }
  cw_survey_start(survey, sizes);
  assert_int_equal(cw_survey_add(survey, &known, &surface), CW_OK);
}
