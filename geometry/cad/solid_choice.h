// SPDX-License-Identifier: AGPL-3.0-or-later
// Which solids of the files each domain of the case is made of.
#pragma once

#include "geometry/cad/cad_file.h"
#include "pipeline/case_cad.h"

#ifdef __cplusplus
extern "C" {
#endif

// domain[i]: that of body i, or -1; cw_cad_body_count of them. CW_ERR_INPUT, naming the key, where a word or a point
// chooses no solid, a name without a pattern chooses several, or two domains choose the same solid.
CwStatus cw_cad_solid_choice(const CwCaseCad *cad, const CwCadBodies *bodies, int *domain);

#ifdef __cplusplus
}
#endif
