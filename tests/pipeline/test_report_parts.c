// SPDX-License-Identifier: AGPL-3.0-or-later
// What the pictures of the report are chosen by: colours, directions, the side of the suction.
#include <stdlib.h>

#include "pipeline/report/drawing.h"
#include "pipeline/report/picture_list.h"
#include "pipeline/report/report_data.h"
#include "pipeline/report/survey.h"
#include "tests/unit_test.h"

// Red, green and blue, no more; neither pale nor dark; neighbours in number differ in one of them by a fifth at least.
static void regions_have_colours_of_their_own(void **state) {
  for (int index = 0; index < 200; index++) {
    uint32_t colour = cw_region_colour(index), next = cw_region_colour(index + 1);
    int most = 0;
    assert_true(colour <= 0xffffff);
    for (int c = 0; c < 24; c += 8) {
      int value = (int)(colour >> c & 255), other = (int)(next >> c & 255);
      assert_in_range(value, 128, 240);
      if (abs(value - other) > most) most = abs(value - other);
    }
    assert_true(most > 51);
  }
}

// Along the axis and obliquely all pictures look from the suction side, wherever that lies, with x up; across the axis
// and close by, that side is up.
static void pictures_are_turned_alike(void **state) {
  const CwMesh mesh = {0};
  CwSurvey *survey = malloc(sizeof *survey);
  for (int suction = -1; suction <= 1; suction += 2) {
    const CwPumpSizes sizes = {6, 0.05, 0.1, 0.101, 0.102, suction};
    cw_survey_start(survey, &sizes);
    for (int k = 0; k < cw_picture_list_count; k++) {
      const CwPictureSpec *spec = &cw_picture_list[k];
      const int close = spec->target == CW_TARGET_PLACE && spec->plane == CW_PLANE_NONE;
      CwDrawing *drawing = calloc(1, sizeof *drawing);
      cw_drawing_start(spec, &mesh, survey, drawing);
      const CwCamera *camera = &drawing->camera;
      if (close || spec->plane == CW_PLANE_MERIDIONAL) {
        assert_true(suction * camera->up[2] > 0.4);
      } else {
        assert_true(suction * camera->towards[2] > 0.4);
        assert_true(camera->up[0] > 0.4);
        assert_true(-suction * camera->right[1] > 0.9);
      }
      free(drawing);
    }
  }
  free(survey);
}

// The rotation tells it of a designed pump, the geometry's record of one from CAD files.
static void the_suction_side_is_known(void **state) {
  CwCase table = {.impeller.rotation = CW_ROTATION_COUNTER_CLOCKWISE};
  CwReportData data = {.table = &table};
  assert_int_equal(cw_report_suction(&data), -1);
  table.impeller.rotation = CW_ROTATION_CLOCKWISE;
  assert_int_equal(cw_report_suction(&data), 1);
  for (int side = -1; side <= 1; side += 2) {
    data.record[0] = json_pack("{s:{s:i}}", "results", "suction_side", side);
    assert_int_equal(cw_report_suction(&data), side);
    json_decref(data.record[0]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(regions_have_colours_of_their_own),
      cmocka_unit_test(pictures_are_turned_alike),
      cmocka_unit_test(the_suction_side_is_known),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
