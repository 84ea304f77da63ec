// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/design_input.h"

#include <errno.h>
#include <jansson.h>
#include <string.h>

CwStatus cw_design_read(const char *path, CwDesign *design) {
  CwStatus status = CW_OK;
  json_error_t error;
  json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
  const struct {
    const char *key;
    double *value;
  } keys[] = {
      {"interface_radius_m", &design->interface_radius},
      {"impeller_tip_speed_m_per_s", &design->tip_speed},
      {"relative_speed_m_per_s", &design->relative_speed},
      {"volute_speed_m_per_s", &design->volute_speed},
      {"suction_speed_m_per_s", &design->suction_speed},
      {"discharge_speed_m_per_s", &design->discharge_speed},
      {"predicted_head_m", &design->predicted_head},
  };
  CW_REQUIRE(root || error.line > 0, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  CW_REQUIRE(root, CW_ERR_INPUT, "%s:%d:%d: %s", path, error.line, error.column, error.text);
  for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
    const json_t *item = json_object_get(root, keys[i].key);
    CW_REQUIRE(json_is_number(item) && json_number_value(item) > 0, CW_ERR_INPUT,
               "%s: '%s' must be a number above 0", path, keys[i].key);
    *keys[i].value = json_number_value(item);
  }
done:
  json_decref(root);
  return status;
}

CwStatus cw_design_complete_case(const char *path, CwCase *table) {
  CwStatus status = CW_OK;
  json_error_t error;
  json_t *root = NULL;
  const struct {
    const char *key;
    double *value;
  } keys[] = {
      {"inlet_diameter_m", &table->impeller.inlet_diameter},
      {"outlet_diameter_m", &table->impeller.outlet_diameter},
      {"outlet_width_m", &table->impeller.outlet_width},
  };
  for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
    if (cw_case_given(*keys[i].value)) continue;
    if (!root) root = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    CW_REQUIRE(root, CW_ERR_INPUT, "%s: cannot be read: %s", path, error.text);
    const double value = json_number_value(json_object_get(root, keys[i].key));
    CW_REQUIRE(value > 0, CW_ERR_INPUT, "%s: '%s' must be a number above 0", path, keys[i].key);
    *keys[i].value = value;
  }
done:
  json_decref(root);
  return status;
}
