// SPDX-License-Identifier: AGPL-3.0-or-later
// The frozen rotor: its cells are solved with absolute velocities in the frame that turns, and joined to the others
// over the common surface of the faces of both sides.
#include "cs_defs.h"
#include "cs_join.h"
#include "cs_turbomachinery.h"
#include "cs_prototypes.h"

#include "pump.h"

void cs_user_turbomachinery(void) {
  cs_turbomachinery_set_model(CS_TURBOMACHINERY_FROZEN);
}

void cs_user_turbomachinery_rotor(void) {
  const double axis[3] = {0, 0, 1}, centre[3] = {0, 0, 0};
  cs_turbomachinery_add_rotor(PUMP_ROTOR, PUMP_SPEED, axis, centre);
  // The two sides of an interface are polygons of one circle, which do not lie on one another: points are merged within
  // PUMP_JOINING of their shortest edge, those of one side before within a twentieth of that, and edges are cut where
  // they meet (intersection mode 2). All else is default.
  for (int i = 0; i < PUMP_INTERFACES; ++i) {
    const int joining = cs_turbomachinery_join_add(pump_interfaces[i], PUMP_JOINING, 25.f, 1, 0);
    cs_join_set_advanced_param(joining, 1.0, 0.05, 1, 2, 500, 200, 30, 25, 5.0, 2.0);
  }
}
