// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/geometry/paper_rotor.h"

#include <math.h>

#include "geometry/hydraulic_design.h"
#include "geometry/rotor.h"
#include "pipeline/case_read.h"
#include "pipeline/case_schema.h"
#include "tests/unit_test.h"

CwCase paper(void) {
  CwCase table;
  assert_int_equal(cw_case_read(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", &table), CW_OK);
  return table;
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

void measure(const CwDesign *design, CwMeasuredSolid *solid, CwMeasuredRotor *measured) {
  CwSolid *rotor = NULL;
  if (cw_rotor_build(design, &rotor) != CW_OK ||
      (design->rotation == CW_ROTATION_CLOCKWISE && cw_solid_mirror(rotor) != CW_OK) ||
      cw_measure_solid(rotor, solid) != CW_OK || cw_measure_rotor(rotor, measured) != CW_OK)
    fail_msg("%s", cw_fail_message());
  cw_solid_free(&rotor);
  assert_true(solid->valid && solid->closed && solid->largest_tolerance < 1e-6);
}
