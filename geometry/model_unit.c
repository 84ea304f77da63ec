// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/model_unit.h"

#include <math.h>

#include "pipeline/record.h"

static const double millimetre = 1e-3; // m
enum { SIZE_EXPONENT = 8 };            // D2 is less than 2^8 units

double cw_model_unit(double outlet_diameter) {
  int exponent;
  frexp(outlet_diameter / millimetre, &exponent);
  return ldexp(millimetre, exponent - SIZE_EXPONENT);
}

CwStatus cw_model_unit_write(double unit, const char *path) {
  CwStatus status = CW_OK;
  json_t *root = json_pack("{s:i, s:f}", "format", 1, "unit_m", unit);
  CW_REQUIRE(root, CW_ERR_MEMORY, "%s: out of memory", path);
  CW_TRY(cw_json_write(root, path));
done:
  json_decref(root);
  return status;
}
