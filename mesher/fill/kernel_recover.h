// SPDX-License-Identifier: AGPL-3.0-or-later
// Brings boundary triangles that the Delaunay mesh does not have into it, by flips and a few new points.
#pragma once

#include "mesher/fill/kernel_facets.h"
#include "pipeline/log.h"

// Of an edge or facet from its ends in turn, each two of a depth, and rounds over all: what one facet could not have
// may be free after others have theirs. Half of the flips that only prepare others.
enum { CW_RECOVER_TRIES = 8 };

// Takes the missing ones of *facets, edges first; facets that are there stay. Those that cannot be recovered
// stay missing. `inner` and missing_count of *facets, which cw_facets_locate has found, are kept true. A later `round`
// than the first tries other flips, and puts new points inside where these are stuck, with the sources *source_count
// and on. Adds what was flipped to *flips. Deterministic.
CwStatus cw_kernel_recover(CwTetMesh *mesh, CwFacets *facets, int round, CwLog *log, int32_t *source_count,
                           int64_t *flips);
