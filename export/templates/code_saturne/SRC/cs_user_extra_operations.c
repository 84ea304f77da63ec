// SPDX-License-Identifier: AGPL-3.0-or-later
// head.csv: head and torque by iteration, by the definitions of the OpenFOAM case.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bft_mem.h"
#include "cs_defs.h"
#include "cs_base.h"
#include "cs_domain.h"
#include "cs_field.h"
#include "cs_field_pointer.h"
#include "cs_mesh.h"
#include "cs_mesh_quantities.h"
#include "cs_parall.h"
#include "cs_post_util.h"
#include "cs_selector.h"
#include "cs_time_step.h"
#include "cs_prototypes.h"

#include "pump.h"

static const double gravity = 9.80665; // m/s2, standard

// The total pressure (Pa) at the faces of a group, weighted with the flow through them.
static double total_pressure(const char *group) {
  const cs_mesh_t *mesh = cs_glob_mesh;
  const cs_field_t *velocity = CS_F_(vel);
  const cs_real_3_t *inside = (const cs_real_3_t *)velocity->val;
  const cs_real_3_t *a = (const cs_real_3_t *)velocity->bc_coeffs->a;
  const cs_real_33_t *b = (const cs_real_33_t *)velocity->bc_coeffs->b;
  const int flux_id = cs_field_get_key_int(velocity, cs_field_key_id("boundary_mass_flux_id"));
  const cs_real_t *flux = cs_field_by_id(flux_id)->val;
  double sums[2] = {0, 0};
  cs_lnum_t count, *faces;
  cs_real_t *pressure;
  BFT_MALLOC(faces, mesh->n_b_faces, cs_lnum_t);
  cs_selector_get_b_face_list(group, &count, faces);
  BFT_MALLOC(pressure, count, cs_real_t);
  cs_post_b_pressure(count, faces, pressure);
  for (cs_lnum_t i = 0; i < count; ++i) {
    const cs_lnum_t face = faces[i], cell = mesh->b_face_cells[face];
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double at_face = a[face][axis];
      for (int other = 0; other < 3; ++other) at_face += b[face][axis][other] * inside[cell][other];
      square += at_face * at_face;
    }
    sums[0] += flux[face] * (pressure[i] + 0.5 * PUMP_DENSITY * square);
    sums[1] += flux[face];
  }
  BFT_FREE(pressure);
  BFT_FREE(faces);
  cs_parall_sum(2, CS_DOUBLE, sums);
  return sums[0] / sums[1];
}

// The shaft's torque on the walls that turn (N m), positive in a pump: pressure, and the stress by the coefficients of
// the wall's diffusive flux.
static double torque(void) {
  const cs_mesh_quantities_t *at = cs_glob_mesh_quantities;
  const cs_field_t *velocity = CS_F_(vel);
  const cs_real_3_t *inside = (const cs_real_3_t *)velocity->val;
  const cs_real_3_t *a = (const cs_real_3_t *)velocity->bc_coeffs->af;
  const cs_real_33_t *b = (const cs_real_33_t *)velocity->bc_coeffs->bf;
  double moment = 0;
  cs_lnum_t count, *faces;
  cs_real_t *pressure;
  BFT_MALLOC(faces, cs_glob_mesh->n_b_faces, cs_lnum_t);
  cs_selector_get_b_face_list(PUMP_TURNING_WALLS, &count, faces);
  BFT_MALLOC(pressure, count, cs_real_t);
  cs_post_b_pressure(count, faces, pressure);
  for (cs_lnum_t i = 0; i < count; ++i) {
    const cs_lnum_t face = faces[i], cell = cs_glob_mesh->b_face_cells[face];
    const cs_real_t *centre = at->b_face_cog + 3 * face;
    double force[2]; // of the water on the wall
    for (int axis = 0; axis < 2; ++axis) {
      double stress = a[face][axis];
      for (int other = 0; other < 3; ++other) stress += b[face][axis][other] * inside[cell][other];
      force[axis] = at->b_face_surf[face] * stress + pressure[i] * at->b_face_normal[3 * face + axis];
    }
    moment -= centre[0] * force[1] - centre[1] * force[0];
  }
  BFT_FREE(pressure);
  BFT_FREE(faces);
  cs_parall_sum(1, CS_DOUBLE, &moment);
  return moment;
}

// head.csv behind the rows of the iterations that are done. What a run that was killed wrote after the checkpoint from
// which this one goes on is cut off.
static FILE *open_history(int done) {
  char line[200];
  long end = 0;
  FILE *out = done > 0 ? fopen("head.csv", "r+") : NULL;
  if (!out) out = fopen("head.csv", "w+");
  if (!out) return NULL;
  while (fgets(line, sizeof line, out) && strchr(line, '\n') && (end == 0 || atoi(line) <= done)) end = ftell(out);
  if (fseek(out, end, SEEK_SET) != 0 || ftruncate(fileno(out), end) != 0) {
    fclose(out);
    return NULL;
  }
  if (end == 0) fprintf(out, "iteration,head_m,torque_n_m\n");
  return out;
}

void cs_user_extra_operations(cs_domain_t *domain) {
  static FILE *out;
  const double head = (total_pressure(PUMP_OUTLET_GROUPS) - total_pressure(PUMP_INLETS)) / (PUMP_DENSITY * gravity);
  const double moment = torque();
  if (cs_glob_rank_id > 0) return;
  if (!out) out = open_history(domain->time_step->nt_prev);
  if (!out) return;
  fprintf(out, "%d,%.9g,%.9g\n", domain->time_step->nt_cur, head, moment);
  fflush(out);
}
