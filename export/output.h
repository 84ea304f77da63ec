// SPDX-License-Identifier: AGPL-3.0-or-later
// What an export writes, by the formats of the case. A format whose numbers cannot hold the mesh is left out, and the
// others are written.
#pragma once

#include "export/cgns_file.h"
#include "export/fluent_mesh.h"
#include "export/foam_layout.h"
#include "export/interface.h"
#include "pipeline/case.h"

typedef struct {
  const CwCase *table;
  const CwAssembly *assembly;
  int formats;                    // 1 << CwFormat of those that are written
  char left_out[CW_FORMATS][200]; // why a format that the case asks is not; "" for the others
  char *folder;                   // where all is written
  char *paths[CW_FORMATS];        // in it: the file or folder of each format
  CwCgnsFile cgns;
  CwFoamMesh foam;
  CwFluentMesh fluent;
} CwOutput;

// The files and folders of each format below the folder of the stage, by CwFormat.
extern const char *const cw_output_names[CW_FORMATS];

int cw_output_has(const CwOutput *output, CwFormat format);

// The file by whose digest the stages after it know the mesh, below the folder: pump.cgns, else another that has all
// points (of a divided mesh those of a part).
const char *cw_output_known_by(const CwOutput *output);

// Lays out the files; alike on all ranks. CW_ERR_EXPORT where no format is left. Zeroed `output` on entry.
CwStatus cw_output_plan(const CwCase *table, const CwAssembly *assembly, const char *folder, CwOutput *output);

// Makes what one rank alone makes of the files. One rank calls it.
CwStatus cw_output_begin(CwOutput *output, const CwInterface *interfaces);

// Opens them on all ranks, with space for the values of the regions. CW_ERR_EXPORT where no format is left. Collective.
CwStatus cw_output_open(CwOutput *output, const CwRanks *ranks);

// Writes a region of this rank. Collective are opening and closing alone.
CwStatus cw_output_write_region(CwOutput *output, int region, const CwRegionData *data, const CwRegionFaces *faces);

// Closes the files. Collective. CW_ERR_IO where the disk is full.
CwStatus cw_output_close(CwOutput *output);

// The digest of the file by which the mesh is known, closed. Collective. CW_ERR_IO.
CwStatus cw_output_digest(const CwOutput *output, const CwRanks *ranks, char digest[CW_HASH_TEXT]);

// Frees, also what cw_output_plan() left behind as it failed.
void cw_output_free(CwOutput *output);
