// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/design_input.h"

#include "pipeline/json_read.h"

CwStatus cw_design_read(const char *path, CwDesign *design, CwCase *table) {
  CwStatus status = CW_OK;
  json_t *root = NULL;
  const struct {
    const char *key;
    double *value;
  } always[] =
      {
          {"interface_radius_m", &design->interface_radius},   {"impeller_tip_speed_m_per_s", &design->tip_speed},
          {"relative_speed_m_per_s", &design->relative_speed}, {"volute_speed_m_per_s", &design->volute_speed},
          {"suction_speed_m_per_s", &design->suction_speed},   {"discharge_speed_m_per_s", &design->discharge_speed},
          {"predicted_head_m", &design->predicted_head},       {"blade_count", &design->blade_count},
      },
    where_open[] = {
        {"inlet_diameter_m", &table->impeller.inlet_diameter},
        {"outlet_diameter_m", &table->impeller.outlet_diameter},
        {"outlet_width_m", &table->impeller.outlet_width},
    };
  CW_TRY(cw_json_read(path, &root));
  for (size_t i = 0; i < sizeof always / sizeof *always; ++i)
    CW_TRY(cw_json_positive(root, path, always[i].key, always[i].value));
  for (size_t i = 0; i < sizeof where_open / sizeof *where_open; ++i)
    if (!cw_case_given(*where_open[i].value))
      CW_TRY(cw_json_positive(root, path, where_open[i].key, where_open[i].value));
done:
  json_decref(root);
  return status;
}
