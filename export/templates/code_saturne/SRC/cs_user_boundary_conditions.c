// SPDX-License-Identifier: AGPL-3.0-or-later
// Inlets with the flow rate, an outlet with a pressure (further ones with their shares of the flow), walls. A wall of
// the rotor's cells turns with them unless it is given a velocity.
#include "bft_error.h"
#include "bft_mem.h"
#include "cs_defs.h"
#include "cs_field.h"
#include "cs_field_pointer.h"
#include "cs_mesh.h"
#include "cs_mesh_quantities.h"
#include "cs_parall.h"
#include "cs_parameters.h"
#include "cs_selector.h"
#include "cs_turbulence_bc.h"
#include "cs_turbulence_model.h"
#include "cs_prototypes.h"

#include "pump.h"

// The arrays of code_saturne: a type a face, and three values of each variable at each face.
typedef struct {
  int variables;
  int *type;
  cs_real_t *value;
  cs_lnum_t faces;
} Conditions;

static void set_velocity(const Conditions *at, cs_lnum_t face, const double velocity[3]) {
  const int first = cs_field_get_key_int(CS_F_(vel), cs_field_key_id("variable_id")) - 1;
  for (int axis = 0; axis < 3; ++axis) at->value[(first + axis) * at->faces + face] = velocity[axis];
}

static void set_roughness(const Conditions *at, cs_lnum_t face) {
  const int first = cs_field_get_key_int(CS_F_(vel), cs_field_key_id("variable_id")) - 1;
  for (int axis = 0; axis < 3; ++axis)
    at->value[((cs_lnum_t)2 * at->variables + first + axis) * at->faces + face] = PUMP_ROUGHNESS;
}

static double area_of(cs_lnum_t count, const cs_lnum_t faces[]) {
  double area = 0;
  for (cs_lnum_t i = 0; i < count; ++i) area += cs_glob_mesh_quantities->b_face_surf[faces[i]];
  cs_parall_sum(1, CS_DOUBLE, &area);
  return area;
}

// A uniform velocity along the normal; `flow` (m3/s) out of the domain counts as positive.
static void set_flow(const Conditions *at, const char *group, double flow) {
  cs_lnum_t count, *faces;
  BFT_MALLOC(faces, at->faces, cs_lnum_t);
  cs_selector_get_b_face_list(group, &count, faces);
  const double speed = flow / area_of(count, faces);
  for (cs_lnum_t i = 0; i < count; ++i) {
    const cs_lnum_t face = faces[i];
    const double scale = speed / cs_glob_mesh_quantities->b_face_surf[face];
    const cs_real_t *normal = cs_glob_mesh_quantities->b_face_normal + 3 * face;
    at->type[face] = CS_INLET;
    set_velocity(at, face, (double[3]){scale * normal[0], scale * normal[1], scale * normal[2]});
    if (PUMP_TURBULENCE != CS_TURB_NONE)
      cs_turbulence_bc_inlet_k_eps(face, PUMP_INLET_K, PUMP_INLET_EPSILON, at->value);
  }
  BFT_FREE(faces);
}

static void set_type(const Conditions *at, const char *group, int type) {
  cs_lnum_t count, *faces;
  BFT_MALLOC(faces, at->faces, cs_lnum_t);
  cs_selector_get_b_face_list(group, &count, faces);
  for (cs_lnum_t i = 0; i < count; ++i) at->type[faces[i]] = type;
  BFT_FREE(faces);
}

// Walls that turn with `speed` (rad/s) about the axis.
static void set_turning(const Conditions *at, const char *group, double speed) {
  cs_lnum_t count, *faces;
  BFT_MALLOC(faces, at->faces, cs_lnum_t);
  cs_selector_get_b_face_list(group, &count, faces);
  for (cs_lnum_t i = 0; i < count; ++i) {
    const cs_real_t *centre = cs_glob_mesh_quantities->b_face_cog + 3 * faces[i];
    set_velocity(at, faces[i], (double[3]){-speed * centre[1], speed * centre[0], 0});
  }
  BFT_FREE(faces);
}

// What the joining has left of the interfaces: slips. More than a hundredth of them is told.
static void set_left_over(const Conditions *at) {
  static int told = 0;
  cs_lnum_t count, *faces;
  double area = 0;
  BFT_MALLOC(faces, at->faces, cs_lnum_t);
  for (int i = 0; i < PUMP_INTERFACES; ++i) {
    set_type(at, pump_interfaces[i], CS_SYMMETRY);
    cs_selector_get_b_face_list(pump_interfaces[i], &count, faces);
    area += area_of(count, faces);
  }
  BFT_FREE(faces);
  if (!told++ && area > 0.01 * PUMP_INTERFACE_AREA)
    bft_error(__FILE__, __LINE__, 0, "%.3g %% of the interfaces were not joined; allowed: 1 %%: take more cells",
              100 * area / PUMP_INTERFACE_AREA);
}

void cs_user_boundary_conditions(int nvar, int bc_type[], int icodcl[], cs_real_t rcodcl[]) {
  const Conditions at = {nvar, bc_type, rcodcl, cs_glob_mesh->n_b_faces};
  (void)icodcl;
  set_type(&at, "all[]", PUMP_ROUGHNESS > 0 ? CS_ROUGHWALL : CS_SMOOTHWALL);
  for (cs_lnum_t face = 0; face < at.faces && PUMP_ROUGHNESS > 0; ++face) set_roughness(&at, face);
  set_turning(&at, PUMP_STANDING_WALLS, 0);
  set_turning(&at, PUMP_SHAFTS, PUMP_SPEED);
  set_type(&at, PUMP_SYMMETRIES, CS_SYMMETRY);
  set_left_over(&at);
  set_flow(&at, PUMP_INLETS, -PUMP_FLOW);
  set_type(&at, pump_outlets[0].group, CS_OUTLET);
  for (int i = 1; i < PUMP_OUTLETS; ++i) set_flow(&at, pump_outlets[i].group, pump_outlets[i].share * PUMP_FLOW);
}

// The place of conditions in Fortran, of which there are none: code_saturne stops without it.
void cs_f_user_boundary_conditions_(void);
void cs_f_user_boundary_conditions_(void) {
}
