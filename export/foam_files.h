// SPDX-License-Identifier: AGPL-3.0-or-later
// The binary files of one polyMesh while they are written.
#pragma once

#include "export/foam_layout.h"
#include "export/place_file.h"

typedef struct {
  const CwFoamMesh *mesh;
  int part;
  CwPlaceFile file[CW_FOAM_FILES];
} CwFoamFiles;

// The folder of the polyMesh of a part, as a new string.
CwStatus cw_foam_part_folder(const CwFoamMesh *mesh, int part, char **path);

// Opens the files of a part, new ones in a new folder or those that are there. CW_ERR_IO.
CwStatus cw_foam_files_open(const CwFoamMesh *mesh, int part, int is_new, CwFoamFiles *files);

// Closes them; gives `status` or, where that is CW_OK, what the closing gives.
CwStatus cw_foam_files_close(CwFoamFiles *files, CwStatus status);

// Writes values of a file behind `before` others; the numbers that things of a part have in the whole mesh
// (pointProcAddressing and so on) only where there are several. CW_ERR_IO.
CwStatus cw_foam_put_labels(const CwFoamFiles *files, CwFoamFile f, const int64_t *values, int64_t count,
                            int64_t before);
CwStatus cw_foam_put_points(const CwFoamFiles *files, const double (*points)[3], const int64_t *numbers, int64_t count,
                            int64_t before);
