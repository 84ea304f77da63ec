// SPDX-License-Identifier: AGPL-3.0-or-later
// The folders processorN of a case whose mesh is divided (foam_mesh.h).
#ifndef CUTWATER_EXPORT_FOAM_PROCESSORS_H
#define CUTWATER_EXPORT_FOAM_PROCESSORS_H

#include "pipeline/status.h"

// Gives `folder` so many folders processorN, each with a link to the start fields of the case, which are uniform and
// so those of every part. `above`: the way from there to the case that has the mesh, for a link to its constant; NULL:
// this is that case. CW_ERR_IO.
CwStatus cw_foam_processors_link(const char *folder, int count, const char *above);

#endif
