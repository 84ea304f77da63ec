// SPDX-License-Identifier: AGPL-3.0-or-later
// The solved flow on the mesh of a run: fields of the OpenFOAM case in RUN/solve/steady by region, cell and face, for
// pictures. Cells and faces of a patch stand there region by region, in the order of the region files.
#pragma once

#include "pipeline/case.h"
#include "pipeline/mesh/region_read.h"
#include "pipeline/report/colour_scale.h"
#include "pipeline/report/foam_field.h"

// Pressure over that of the reference, kPa; y+; speed, relative to the frame of the zone, m/s.
typedef enum { CW_FLOW_PRESSURE, CW_FLOW_Y_PLUS, CW_FLOW_SPEED, CW_FLOW_QUANTITIES } CwFlowQuantity;

typedef struct {
  int present;                   // 0: the run has no solved fields; the rest is empty
  double density, angular_speed; // kg/m3; rad/s about z, of turning zones
  CwFoamField pressure, velocity, y_plus;
  int64_t *first_cell; // of each region
  int64_t *next_face;  // of each patch: the first that no region has had
  CwColourSpan span[CW_FLOW_QUANTITIES];
} CwFlow;

extern const char *const cw_flow_label[CW_FLOW_QUANTITIES]; // with unit, HTML

// Finds the latest fields of RUN/solve/steady. CW_ERR_IO, CW_ERR_INPUT where one is unreadable or not of this mesh.
// Zeroed `flow` on entry; free it with cw_flow_close, also after a failure.
CwStatus cw_flow_open(const char *run, const CwMesh *mesh, const CwCase *table, CwFlow *flow);
void cw_flow_close(CwFlow *flow);

// Leaves out so many faces of each patch: those of regions that another process takes.
void cw_flow_skip(CwFlow *flow, const CwMesh *mesh, const int64_t *faces);

// The shares of the colour scale of each boundary face of a region, triangles before quadrilaterals, in new arrays of
// quantities PRESSURE and Y_PLUS; NAN: the face has no such value. Once for each region that is not left out, in the
// order of the manifest.
CwStatus cw_flow_faces(CwFlow *flow, const CwMesh *mesh, int region, const CwRegionData *cells, double *share[2]);

// The velocity of a cell, its number in its region, relative to the frame of its zone, m/s.
void cw_flow_cell_velocity(const CwFlow *flow, const CwMesh *mesh, int region, const CwRegionData *cells, int32_t cell,
                           double velocity[3]);
// The share of the colour scale of a velocity.
double cw_flow_speed_share(const CwFlow *flow, const double velocity[3]);
