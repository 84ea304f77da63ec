// SPDX-License-Identifier: AGPL-3.0-or-later
// faces.csv, the patch, kind and name of every CAD face, and interfaces.csv, which patches of two domains are
// the two sides of one surface. The formats are in docs/file-formats.md.
#ifndef CUTWATER_GEOMETRY_FACES_TABLE_H
#define CUTWATER_GEOMETRY_FACES_TABLE_H

#include "geometry/pump.h"
#include "geometry/solid.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Writes the faces of `count` solids, whole or not at all.
CwStatus cw_faces_table_write(const CwSolid *const *solids, int count, const char *path);

// Writes the interfaces between the domains, whole or not at all.
CwStatus cw_interfaces_table_write(const CwPump *pump, const char *path);

#ifdef __cplusplus
}
#endif
#endif
