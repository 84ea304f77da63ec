// SPDX-License-Identifier: AGPL-3.0-or-later
// pump.msh of ANSYS Fluent: sections of text, the numbers in hexadecimal. Cells, points and faces are numbered from 1
// in the order of the OpenFOAM mesh. All numbers have a fixed width, so that each rank writes its regions at their
// places.
#pragma once

#include "export/face_stretch.h"
#include "export/place_file.h"

typedef struct {
  const CwAssembly *assembly;
  CwFaceLayout layout;
  CwPlaceFile file;
  int64_t point_start;                 // byte of the first point
  int64_t cell_start[CW_DOMAINS_MOST]; // of the types of each domain's cells
  int64_t face_start[CW_DOMAINS_MOST]; // of each domain's inner faces
  int64_t *patch_start;                // of each patch's faces
  int64_t end;                         // of the sections
} CwFluentMesh;

// Computes the layout. CW_ERR_EXPORT where a number passes 2^31 - 1. Zeroed `mesh` on entry.
CwStatus cw_fluent_mesh_plan(const CwAssembly *assembly, CwFluentMesh *mesh);

// Makes `folder`/pump.msh with everything but the values of the regions; opens it. One rank calls it.
CwStatus cw_fluent_mesh_create(const char *folder, CwFluentMesh *mesh);

// Opens it on the other ranks; fine where it is open.
CwStatus cw_fluent_mesh_open(const char *folder, CwFluentMesh *mesh);

// Writes the own points, the cells and the faces of a region.
CwStatus cw_fluent_mesh_write_region(const CwFluentMesh *mesh, int region, const CwRegionData *data,
                                     const CwRegionFaces *faces);

// Closes the file and frees, on failure too. CW_ERR_IO where the disk is full.
CwStatus cw_fluent_mesh_close(CwFluentMesh *mesh);
