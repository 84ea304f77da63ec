// SPDX-License-Identifier: AGPL-3.0-or-later
// How many cells a scale of the size fields gives, as integrals of the fields and factors learned predict it.
#pragma once

#include "mesher/run/pass_state.h"
#include "mesher/run/run_state.h"

// Sets the factors with which the first pass starts.
void cw_start_factors(CwMeshRun *run);

// Cells of one domain as its integrals and the factors predict them at the present scale.
double cw_predicted_cells(const CwMeshRun *run, int domain);

// Sets the scale of the size fields of all domains; or that with which the predicted count is the asked one.
void cw_mesh_set_scale(CwMeshRun *run, double scale);
void cw_mesh_solve_scale(CwMeshRun *run);
// Once the walls are meshed: the scale with which the tetrahedra make up for what their triangles are off.
void cw_mesh_fit_volume(CwMeshRun *run);
// Sets the layers with which that starts: as many as the case gives, or the fewest. A y+ that it leaves open is the
// least that it gives anywhere, so that walls are resolved, or not, together; where it gives none, of the log layer.
void cw_start_layers(CwMeshRun *run);
// The scale, and where the case leaves it open the number of layers of each domain, the least that leads to the size of
// its tetrahedra, or what the cells have room for.
void cw_mesh_solve_layers(CwMeshRun *run);
// Where triangles on narrow faces would have less than wanted_angle at the present scale, layers beyond the fewest go,
// one of each domain at a time, and the scale is solved anew; first those beyond `most` of each domain (0, or NULL:
// any).
void cw_mesh_leave_room(CwMeshRun *run, const int32_t *most);
// The number of layers of each domain that leads to the size of its tetrahedra, where the case leaves it open and the
// cells have no room for it. Returns about how many cells have room for all, or 0 where these have.
double cw_layers_short(CwMeshRun *run, int needed[CW_DOMAINS_MOST]);
// Where the scale is beyond cw_size_scale_fine(), as with few cells or more layers given than these have room for:
// about how many cells have room, or more where walls are limited; else returns 0.
double cw_cells_crowded(CwMeshRun *run);

// Tells of where layers taper to nothing and the numbers of layers, anew where they have changed: the old headlines of
// them go.
void cw_tell_layers(CwMeshRun *run);
// What a pass begins with: the cells as those before have counted them, if there were any, the scale that follows, and
// no more layers than leave room then; told of where that changes their numbers.
void cw_mesh_take_start(CwMeshRun *run, const CwPassStart *start);

// Cells of all domains at the present scale, over the asked number, less one.
double cw_predicted_off(const CwMeshRun *run);

// Set a factor to what was made: the triangles on the walls, or the tetrahedra of the last pass.
void cw_learn_prisms(CwMeshRun *run);
void cw_learn_tets(CwMeshRun *run);
