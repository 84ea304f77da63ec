// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <math.h>
#include <string.h>

#include "pipeline/report/survey.h"
#include "tests/unit_test.h"

enum { WALLS_AROUND = 24 };

// Hub and shroud as strips all round, of so many rings from a radius of 0.02 over `width`: a flat hub at z = 0.01 and a
// shroud at z = shroud[0] + shroud[1] radius. Patches: 0 and 1. For each wall (rings + 1) WALLS_AROUND points.
static inline void wall_strips(int rings, double width, const double shroud[2], double (*x)[3], int32_t (*triangle)[3],
                               int32_t *patch) {
  const int around = WALLS_AROUND, points = (rings + 1) * around;
  for (int wall = 0, t = 0; wall < 2; wall++)
    for (int r = 0; r <= rings; r++)
      for (int a = 0; a < around; a++) {
        const double radius = 0.02 + width * r / rings, angle = 2 * M_PI * a / around;
        const int32_t here = wall * points + r * around + a, next = wall * points + r * around + (a + 1) % around;
        memcpy(x[here],
               (double[]){radius * cos(angle), radius * sin(angle), wall ? shroud[0] + shroud[1] * radius : 0.01},
               sizeof *x);
        if (r == rings) continue;
        memcpy(triangle[t], (int32_t[]){here, next, next + around}, sizeof *triangle);
        memcpy(triangle[t + 1], (int32_t[]){here, next + around, here + around}, sizeof *triangle);
        patch[t] = patch[t + 1] = wall;
        t += 2;
      }
}

// A hub at z = 0.01 and a shroud at z = -0.02, flat rings from a radius of 0.02 to 0.09, and a trailing edge
// at azimuth 90 degrees.
static inline void survey_walls(const CwPumpSizes *sizes, CwSurvey *survey) {
  enum { RINGS = 48, POINTS = (RINGS + 1) * WALLS_AROUND, FACES = 2 * RINGS * WALLS_AROUND };
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
  wall_strips(RINGS, 0.07, (const double[2]){-0.02, 0}, x, triangle, patch);
  cw_survey_start(survey, sizes);
  assert_int_equal(cw_survey_add(survey, &known, &surface), CW_OK);
}
