// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/geometry/paper_rotor.h"

#include <math.h>
#include <stdio.h>

#include "geometry/hydraulic_design.h"
#include "geometry/rotor.h"
#include "geometry/rotor_volume.h"
#include "pipeline/case_read.h"
#include "pipeline/case_schema.h"
#include "tests/unit_test.h"

CwCase case_of(const char *name) {
  CwCase table;
  char path[512];
  snprintf(path, sizeof path, CUTWATER_SOURCE_DIR "/cases/%s/case.yaml", name);
  assert_int_equal(cw_case_read(path, &table), CW_OK);
  return table;
}

CwCase paper(void) {
  return case_of("paper");
}

CwCase duty_point(double cubic_metres_per_hour, double head, double rpm) {
  CwCase table;
  cw_case_defaults(&table);
  table.operating_point.flow_rate = cubic_metres_per_hour / 3600;
  table.operating_point.head = head;
  table.operating_point.speed = rpm * M_PI / 30;
  return table;
}

CwDesign design_of(const CwCase *table) {
  CwDesign design;
  if (cw_hydraulic_design(table, &design) != CW_OK) fail_msg("%s", cw_fail_message());
  return design;
}

CwPump pump_of(const CwCase *table, CwDesign *design) {
  CwPipeStubs stubs;
  CwPump pump = {0};
  *design = design_of(table);
  if (cw_pump_pipe_stubs(table, design, &stubs) != CW_OK || cw_pump_build(table, design, &stubs, &pump) != CW_OK)
    fail_msg("%s", cw_fail_message());
  return pump;
}

void measure(const CwDesign *design, CwMeasuredSolid *solid, CwMeasuredRotor *measured) {
  CwSolid *rotor = NULL;
  if (cw_rotor_build(design, &rotor) != CW_OK ||
      (design->rotation == CW_ROTATION_CLOCKWISE && cw_solid_mirror(rotor) != CW_OK) ||
      cw_measure_solid(rotor, solid) != CW_OK || cw_measure_rotor(rotor, measured) != CW_OK)
    fail_msg("%s", cw_fail_message());
  cw_solid_free(&rotor);
  assert_true(solid->valid && solid->closed && solid->largest_tolerance < 1e-6);
}

void volumes_agree(const CwDesign *design, const CwMeasuredSolid *solid, double tolerance) {
  double expected;
  assert_int_equal(cw_rotor_volume(design, &expected), CW_OK);
  assert_near(solid->volume / expected, 1, tolerance);
}
