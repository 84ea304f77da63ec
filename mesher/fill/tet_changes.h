// SPDX-License-Identifier: AGPL-3.0-or-later
// What the improvement of tetrahedra has changed.
#ifndef CUTWATER_MESHER_FILL_TET_CHANGES_H
#define CUTWATER_MESHER_FILL_TET_CHANGES_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int32_t edges_removed, faces_removed, points_moved, points_added, search_tries, patches_changed;
  double least_before, least_after; // least quality, as cw_tet_quality; the limit where none is below
} CwTetChanges;

#ifdef __cplusplus
}
#endif
#endif
