// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/quantity.h"

#include <ctype.h>
#include <string.h>

#include "pipeline/report/html.h"

// Longer ends first. One that does not begin with _ belongs to the name but for what follows its last _.
static const CwQuantityUnit units[] = {
    {"_m3_per_s", "m&sup3;/h", 3600},
    {"_m3_per_h", "m&sup3;/h", 1},
    {"_m2_per_s", "m&sup2;/s", 1},
    {"_rad_per_s", "rad/s", 1},
    {"_m_per_s", "m/s", 1},
    {"head_m", "m", 1},
    {"head_residual_m", "m", 1},
    {"head_wiesner_m", "m", 1},
    {"head_pfleiderer_m", "m", 1},
    {"npsh_required_m", "m", 1},
    {"npsh_available_m", "m", 1},
    {"_deg", "&deg;", 1},
    {"_m2", "mm&sup2;", 1e6},
    {"cell_volume_m3", "mm&sup3;", 1e9},
    {"_m3", "cm&sup3;", 1e6},
    {"_m", "mm", 1e3},
    {"_w", "W", 1},
    {"_pa", "Pa", 1},
};

static const struct {
  const char *key, *symbol;
} symbols[] = {
    {"flow_rate", "Q"},
    {"head", "H"},
    {"angular_speed", "&omega;"},
    {"specific_speed_nq", "n<sub>q</sub>"},
    {"specific_speed_ns", "n<sub>s</sub>"},
    {"head_coefficient", "&psi;"},
    {"inlet_diameter", "D<sub>1</sub>"},
    {"outlet_diameter", "D<sub>2</sub>"},
    {"outlet_width", "b<sub>2</sub>"},
    {"inlet_blade_angle", "&beta;<sub>1</sub>"},
    {"outlet_blade_angle", "&beta;<sub>2</sub>"},
    {"wrap_angle", "&phi;"},
    {"impeller_tip_speed", "u<sub>2</sub>"},
    {"inlet_blade_speed", "u<sub>1</sub>"},
    {"inlet_meridional_speed", "c<sub>m1</sub>"},
    {"inlet_blockage", "&tau;<sub>1</sub>"},
    {"inlet_relative_speed", "w<sub>1</sub>"},
    {"outlet_meridional_speed", "c<sub>m2</sub>"},
    {"outlet_blockage", "&tau;<sub>2</sub>"},
    {"slip_factor", "&gamma;"},
    {"outlet_swirl_speed", "c<sub>u2</sub>"},
    {"outlet_absolute_speed", "c<sub>2</sub>"},
    {"outlet_relative_speed", "w<sub>2</sub>"},
    {"outlet_absolute_angle", "&alpha;<sub>2</sub>"},
    {"diffusion_ratio", "w<sub>2</sub>/w<sub>1</sub>"},
    {"hydraulic_efficiency", "&eta;<sub>h</sub>"},
    {"theoretical_head", "H<sub>th</sub>"},
    {"base_diameter", "D<sub>3</sub>"},
    {"inlet_width", "b<sub>3</sub>"},
    {"swirl_constant", "K"},
    {"discharge_diameter", "DN"},
    {"blade_count", "z"},
};

const CwQuantityUnit *cw_quantity_unit(const char *key) {
  static const CwQuantityUnit none = {"", "", 1};
  for (size_t k = 0; k < sizeof units / sizeof *units; k++) {
    size_t size = strlen(units[k].end), length = strlen(key);
    if (length >= size && !strcmp(key + length - size, units[k].end)) return &units[k];
  }
  return &none;
}

void cw_quantity_stem(const char *key, char stem[CW_STEM_SIZE]) {
  const CwQuantityUnit *unit = cw_quantity_unit(key);
  size_t cut = strlen(*unit->end && *unit->end != '_' ? strrchr(unit->end, '_') : unit->end);
  snprintf(stem, CW_STEM_SIZE, "%.*s", (int)(strlen(key) - cut), key);
}

static void symbol_cell(FILE *page, const char *stem) {
  fputs("<td class=\"q\">", page);
  for (size_t k = 0; k < sizeof symbols / sizeof *symbols; k++) {
    if (!strcmp(stem, symbols[k].key)) fputs(symbols[k].symbol, page);
  }
  fputs("</td>", page);
}

void cw_quantity_start(FILE *page, const char *stem, const char *name) {
  fputs("<tr><td>", page);
  if (name && islower((unsigned char)name[0]) && isalpha((unsigned char)name[1])) // a word; not u2 or c_m
    fputc(toupper((unsigned char)*name++), page);
  if (name)
    cw_html_text(page, "", name, "");
  else
    cw_html_label(page, "", stem, "");
  fputs("</td>", page);
  symbol_cell(page, stem);
}
