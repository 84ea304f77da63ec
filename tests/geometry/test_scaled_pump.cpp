// SPDX-License-Identifier: AGPL-3.0-or-later
// The solids of a pump in another unit (cw_solid_scaled).
#include <sstream>

#include <BRepTools.hxx>

#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "geometry/pump.h"
#include "geometry/solid.hpp"
#include "pipeline/case_read.h"
#include "tests/unit_test.h"

static std::string text_of(const CwSolid &solid) {
  std::ostringstream text;
  BRepTools::Write(solid.solid, text);
  return text.str();
}

// All kinds of faces and curves: cones, tori's neighbours, zones, a shaft and a mirror image. What is scaled is sound,
// has exactly the scaled volume, and comes back to the last bit.
static void there_and_back(void **) {
  CwCase table;
  CwDesign design;
  CwPipeStubs stubs;
  CwPump pump = {};
  assert_int_equal(cw_case_read(CUTWATER_SOURCE_DIR "/cases/zones/case.yaml", &table), CW_OK);
  table.impeller.rotation = CW_ROTATION_CLOCKWISE;
  if (cw_hydraulic_design(&table, &design) != CW_OK || cw_pump_pipe_stubs(&table, &design, &stubs) != CW_OK ||
      cw_pump_build(&table, &design, &stubs, &pump) != CW_OK)
    fail_msg("%s", cw_fail_message());
  for (int i = 0; i < pump.count; i++) {
    CwMeasuredSolid before, after;
    const CwSolid &solid = *pump.solid[i];
    const CwSolid large = cw_solid_scaled(solid, 8), odd = cw_solid_scaled(solid, 3);
    assert_true(large.unit == solid.unit / 8);
    assert_true(text_of(large) != text_of(solid));
    assert_true(text_of(cw_solid_scaled(large, 0.125)) == text_of(cw_solid_scaled(solid, 1)));
    assert_int_equal(cw_measure_solid(&solid, &before), CW_OK);
    for (const CwSolid *scaled : {&large, &odd}) {
      assert_int_equal(cw_measure_solid(scaled, &after), CW_OK);
      assert_true(after.valid && after.closed);
      assert_int_equal(after.face_count, before.face_count);
      assert_true(std::abs(after.volume / before.volume - 1) < 1e-9); // in m3: the unit is that much smaller
    }
  }
  cw_pump_free(&pump);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(there_and_back)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
