// SPDX-License-Identifier: AGPL-3.0-or-later
// Fluid, turbulence and the way to the steady flow.
#include "cs_defs.h"
#include "cs_domain.h"
#include "cs_field.h"
#include "cs_field_pointer.h"
#include "cs_mesh_quantities.h"
#include "cs_parameters.h"
#include "cs_physical_constants.h"
#include "cs_time_step.h"
#include "cs_turbulence_model.h"
#include "cs_wall_functions.h"
#include "cs_prototypes.h"

#include "pump.h"

void cs_user_model(void) {
  cs_get_glob_turb_model()->iturb = PUMP_TURBULENCE;
}

// Upwind, but for a share of second order with a slope test. On the way to a steady state no equation need be solved
// closely.
static void set_scheme(cs_field_t *field, double second_order_share) {
  const int key = cs_field_key_id("var_cal_opt");
  cs_var_cal_opt_t options;
  cs_field_get_key_struct(field, key, &options);
  options.ischcv = 0; // upwind with the upwind cell's gradient
  options.isstpc = 0;
  options.blencv = second_order_share;
  options.imligr = 1; // limited gradients: without them k runs away from skewed cells
  options.climgr = 1;
  options.epsilo = 1e-3;
  cs_field_set_key_struct(field, key, &options);
}

// The parts of joined faces lie askew between their cells: the correction for that is clipped, and each of its sweeps
// is relaxed by what it has left. The gradient is not limited: a limited one leaves a part of the force out of the
// momentum, and the wheel turns the flow too much.
static void set_pressure(void) {
  const int key = cs_field_key_id("var_cal_opt");
  cs_var_cal_opt_t options;
  cs_field_get_key_struct(CS_F_(p), key, &options);
  options.iswdyn = 1;
  options.nswrsm = 2;
  options.imligr = -1;
  options.epsilo = 1e-3;
  options.epsrsm = 1e-3;
  cs_field_set_key_struct(CS_F_(p), key, &options);
  cs_glob_mesh_quantities_flag |= CS_FACE_RECONSTRUCTION_CLIP | CS_FACE_DISTANCE_CLIP | CS_CELL_FACE_CENTER_CORRECTION;
}

// The steady algorithm, with relaxed equations: with steps in time that are local to the cells k runs away.
static void set_steps(cs_time_step_t *steps) {
  cs_get_glob_time_step_options()->idtvar = -1;
  steps->nt_max = PUMP_ITERATIONS;
}

void cs_user_parameters(cs_domain_t *domain) {
  cs_fluid_properties_t *fluid = cs_get_glob_fluid_properties();
  cs_turb_ref_values_t *turbulence = cs_get_glob_turb_ref_values();
  fluid->ro0 = PUMP_DENSITY;
  fluid->viscl0 = PUMP_DENSITY * PUMP_KINEMATIC_VISCOSITY;
  fluid->p0 = PUMP_PRESSURE;
  turbulence->uref = PUMP_PASSAGE_SPEED;
  turbulence->almax = PUMP_PASSAGE_WIDTH;
  if (PUMP_TURBULENCE == CS_TURB_K_EPSILON) cs_get_glob_wall_functions()->iwallf = CS_WALL_F_2SCALES_LOG;
  cs_get_glob_turb_rans_model()->iclkep = 1; // k and epsilon clipped together
  cs_get_glob_space_disc()->imrgra = 1; // gradients by least squares
  set_steps(domain->time_step);
  set_scheme(CS_F_(vel), PUMP_SECOND_ORDER);
  set_pressure();
  if (PUMP_TURBULENCE == CS_TURB_NONE) return;
  set_scheme(CS_F_(k), 0);
  set_scheme(PUMP_TURBULENCE == CS_TURB_K_EPSILON ? CS_F_(eps) : CS_F_(omg), 0);
}
