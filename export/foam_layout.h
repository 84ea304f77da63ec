// SPDX-License-Identifier: AGPL-3.0-or-later
// How the polyMesh of OpenFOAM is laid out, binary, in upper-triangular order: cells region by region, inner faces by
// owner and then neighbour, then the faces of each patch. Whole in constant/, or divided into processorN/constant/ as
// decomposePar would: each with its patches to other parts behind the others, and with the numbers that its points,
// faces and cells have in the whole mesh.
#pragma once

#include "export/division.h"
#include "pipeline/case.h"

typedef enum {
  CW_FOAM_POINTS,
  CW_FOAM_FACES,
  CW_FOAM_OWNER,
  CW_FOAM_NEIGHBOUR,
  CW_FOAM_ZONES, // cellZones: the cells of each domain are one run of numbers
  CW_FOAM_WHOLE_FILES,
  CW_FOAM_OF_POINTS = CW_FOAM_WHOLE_FILES, // pointProcAddressing and so on
  CW_FOAM_OF_FACES,
  CW_FOAM_OF_CELLS,
  CW_FOAM_FILES
} CwFoamFile;

enum { CW_FOAM_POINT_SIZE = 24 }; // bytes of a point in its file

// Numbers of faces of one polyMesh and where things stand in its files.
typedef struct {
  CwFaceCount all;              // with the patches to other parts
  CwFaceCount *patch;           // faces before those of each patch of the mesh, and one more: before the other parts'
  CwFaceCount *link;            // faces before those of each link of the part
  int64_t start[CW_FOAM_FILES]; // byte at which the first value stands
  int64_t label_start;          // that of the labels in `faces`, whose first values are offsets
} CwFoamPart;

typedef struct {
  const CwAssembly *assembly;
  char *folder;      // the case's
  CwIntegers labels; // as the case asks
  int label_size;    // 4 or 8 bytes, in the end by cw_foam_layout_parts()
  CwFoamRelease release;
  CwFaceLayout layout;
  CwDivision division;
  CwFoamPart *parts;
} CwFoamMesh;

// Divides the mesh for as many processors as the table says. CW_ERR_EXPORT where a number passes the labels' greatest.
// Zeroed `mesh` on entry. Alike on all ranks.
CwStatus cw_foam_layout_plan(const CwAssembly *assembly, const char *folder, const CwExportTable *table,
                             CwFoamMesh *mesh);

void cw_foam_layout_free(CwFoamMesh *mesh);

// Lays out each part once the division has been counted. CW_ERR_MEMORY; CW_ERR_EXPORT where a part has more face
// corners than the labels that the case asks can hold.
CwStatus cw_foam_layout_parts(CwFoamMesh *mesh);

// Whether the mesh has several parts; the files of a whole one are the first CW_FOAM_WHOLE_FILES.
int cw_foam_is_divided(const CwFoamMesh *mesh);

// The head of a binary file of a part, up to the bracket before the first value or zone; its length.
enum { CW_FOAM_HEADER_SIZE = 1000 };
int cw_foam_header(const CwFoamMesh *mesh, int part, CwFoamFile file, char text[CW_FOAM_HEADER_SIZE]);

// The values of a file of a part, without the labels behind the offsets of `faces`.
int64_t cw_foam_value_count(const CwFoamMesh *mesh, int part, CwFoamFile file);

extern const char *const cw_foam_file_names[CW_FOAM_FILES];
