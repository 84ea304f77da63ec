// SPDX-License-Identifier: AGPL-3.0-or-later
// What the exporter reads of RUN/geometry/design.json.
#ifndef CUTWATER_EXPORT_DESIGN_INPUT_H
#define CUTWATER_EXPORT_DESIGN_INPUT_H

#include "pipeline/case.h"
#include "pipeline/status.h"

typedef struct {
  double interface_radius;                                                        // m
  double tip_speed, relative_speed, volute_speed, suction_speed, discharge_speed; // m/s
  double predicted_head;                                                          // m
  double blade_count;                                                             // without splitters
} CwDesign;

// Reads the design, and fills the impeller's D1, D2 and b2 of the case from it where the case leaves them open. Fails
// with CW_ERR_IO or CW_ERR_INPUT, naming the key.
CwStatus cw_design_read(const char *path, CwDesign *design, CwCase *table);

#endif
