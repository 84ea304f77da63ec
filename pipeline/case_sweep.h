// SPDX-License-Identifier: AGPL-3.0-or-later
// How a case follows another number of cells than its own, for sweeps over the mesh size.
#pragma once

#include "pipeline/case.h"

// Asks for `cells` in place of the case's own number. Where mesh.sweep is similar the layers go with it: the same
// stretching T(i) of thickness over layers (P. J. Roache, 1998, systematic refinement) is sampled with n' = n (cells /
// own)^(1/3) of them, rounded, so that T'(i) = T(i n / n'): the growth becomes g^(n / n'), the first height T(n / n'),
// and the whole thickness stays. CW_ERR_INPUT, naming `path`, where the case leaves layers open or n' is not allowed.
CwStatus cw_case_sweep(const char *path, int64_t cells, CwCase *table);
