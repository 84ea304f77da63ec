// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_fluid.h"

#include "pipeline/case_schema.h"
#include "pipeline/water.h"

static const double DEFAULT_CELSIUS = 20;
// A given value that differs more from water's is another fluid's: water at 100 bar is denser by 0.5 %.
static const double SAME_DENSITY = 0.01, SAME_VISCOSITY = 0.05;

// Takes the value of water for a key that was left out, and compares a given one with it.
static CwStatus settle(const char *path, const CwCasePlace *places, const char *name, double celsius, double water,
                       double same, CwCase *table) {
  CwStatus status = CW_OK;
  const int index = cw_case_key_find("fluid", name);
  const CwCaseKey *key = &cw_case_keys[index];
  if (!places[index].given) {
    cw_case_key_set(key, water, table);
    goto done;
  }
  const double given = cw_case_key_value(key, table);
  CW_REQUIRE(
      fabs(given / water - 1) <= same, CW_ERR_INPUT,
      "%s:%d:%d: fluid.%s: %.6g contradicts fluid.temperature_c: water of %.6g degrees Celsius has %.6g; allowed: "
      "within %.0f %% of that, or one of the two keys",
      path, places[index].line, places[index].column, name, given, celsius, water, 100 * same);
done:
  return status;
}

CwStatus cw_case_fluid(const char *path, const CwCasePlace *places, CwCase *table) {
  CwStatus status = CW_OK;
  const double celsius = table->fluid.temperature;
  if (cw_case_given(celsius)) {
    CW_TRY(settle(path, places, "density_kg_per_m3", celsius, cw_water_density(celsius), SAME_DENSITY, table));
    CW_TRY(settle(path, places, "kinematic_viscosity_m2_per_s", celsius, cw_water_kinematic_viscosity(celsius),
                  SAME_VISCOSITY, table));
  }
  if (!cw_case_given(table->fluid.vapour_pressure))
    table->fluid.vapour_pressure = cw_water_vapour_pressure(cw_case_given(celsius) ? celsius : DEFAULT_CELSIUS);
done:
  return status;
}
