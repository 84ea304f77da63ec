// SPDX-License-Identifier: AGPL-3.0-or-later
// constant/polyMesh of OpenFOAM, binary, in upper-triangular order: cells region by region, inner faces by
// owner and then neighbour, then the faces of each patch. Labels have 32 bits, as Debian and most others
// build OpenFOAM.
#ifndef CUTWATER_EXPORT_FOAM_MESH_H
#define CUTWATER_EXPORT_FOAM_MESH_H

#include "export/assembly.h"

typedef enum {
  CW_FOAM_POINTS,
  CW_FOAM_FACES,
  CW_FOAM_OWNER,
  CW_FOAM_NEIGHBOUR,
  CW_FOAM_ZONES, // cellZones: the cells of each domain are one run of numbers
  CW_FOAM_FILES
} CwFoamFile;

// Numbers of faces and where things stand in the files; the same on all ranks.
typedef struct {
  const CwAssembly *assembly;
  char *folder;
  int file[CW_FOAM_FILES];                           // descriptors, 0 if not open
  int64_t points, cells, faces, inner_faces, labels; // labels: entries of all faces
  int64_t *first_face, *first_label;   // by region: its first inner face, and label in the list of all faces
  int64_t *patch_face, *patch_label;   // by patch
  int64_t start[CW_FOAM_FILES];        // byte at which the first value stands
  int64_t label_start;                 // that of the labels in `faces`, whose first values are offsets
  int64_t zone_start[CW_DOMAINS_MOST]; // that of the cells of each domain in `cellZones`
} CwFoamMesh;

// Computes the layout. CW_ERR_EXPORT where a number passes 2^31 - 1. Zeroed `mesh` on entry.
CwStatus cw_foam_mesh_plan(const CwAssembly *assembly, const char *folder, CwFoamMesh *mesh);

// Makes the files with everything but the values of the regions, and the whole of `boundary`. One rank calls it.
CwStatus cw_foam_mesh_create(CwFoamMesh *mesh);

// Opens the files for cw_foam_mesh_write_region(), on any rank.
CwStatus cw_foam_mesh_open(CwFoamMesh *mesh);

// Writes the own points, the faces and the zone of a region. A face between regions is written by that of the lower
// cell.
CwStatus cw_foam_mesh_write_region(const CwFoamMesh *mesh, int region, const CwRegionData *data,
                                   const CwRegionFaces *faces);

// Closes the files; CW_ERR_IO where the disk is full. Frees on failure too.
CwStatus cw_foam_mesh_close(CwFoamMesh *mesh);

#endif
