// SPDX-License-Identifier: AGPL-3.0-or-later
// The frozen rotor: its cells are solved with absolute velocities in the frame that turns.
#include "cs_defs.h"
#include "cs_turbomachinery.h"
#include "cs_prototypes.h"

#include "pump.h"

void cs_user_turbomachinery(void) {
  cs_turbomachinery_set_model(CS_TURBOMACHINERY_FROZEN);
}

void cs_user_turbomachinery_rotor(void) {
  const double axis[3] = {0, 0, 1}, centre[3] = {0, 0, 0};
  cs_turbomachinery_add_rotor(PUMP_ROTOR, PUMP_SPEED, axis, centre);
}
