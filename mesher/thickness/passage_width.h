// SPDX-License-Identifier: AGPL-3.0-or-later
// How far the opposite wall is from each patch, measured by rays through the exact solid: what the layers of both have
// room in.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"
#include "mesher/parallel/context.h"

// Of each wall patch, sets width[patch] (m or the unit of the model; on entry the greatest that is of interest) to the
// distance along the inward normal to a wall that faces it, which all but missed_share of the patch's area have at
// least; it stays where so much of the wall sees none within it. Other patches keep what they have. Collective; the
// same bits for any number of ranks.
CwStatus cw_passage_widths(const CwContext *context, const CwCad *cad, const CwBackground *background, double *width);
