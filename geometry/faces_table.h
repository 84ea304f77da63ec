// SPDX-License-Identifier: AGPL-3.0-or-later
// faces.csv, the patch, kind and name of every CAD face. The format is in docs/file-formats.md.
#ifndef CUTWATER_GEOMETRY_FACES_TABLE_H
#define CUTWATER_GEOMETRY_FACES_TABLE_H

#include "geometry/solid.h"
#include "pipeline/status.h"

// Writes the faces of `count` solids, whole or not at all.
CwStatus cw_faces_table_write(const CwSolid *const *solids, int count, const char *path);
#endif
