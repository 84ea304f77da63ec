// SPDX-License-Identifier: AGPL-3.0-or-later
// What the mesher's record tells of the layers, and its warnings of them. These stand among the headlines of the record
// too, which the report and the summary of a run begin with: `headlines` is an array of texts to which each is added.
#pragma once

#include <jansson.h>

#include "mesher/region/layer_ratio.h"
#include "mesher/run/domain.h"
#include "pipeline/log.h"

// Adds what the first height over a patch follows from to its entry of layer_coverage.
void cw_put_first_height(const CwPatchTarget *target, json_t *patch);
// And the figures of the layer top over it.
void cw_put_layer_ratio(const CwLayerRatio *ratio, json_t *patch);

// Warns, before anything is meshed, of walls in laminar flow, and of those whose asked first height does not fit the
// passage.
void cw_warn_of_first_heights(CwLog *log, const CwDomain *domain, json_t *headlines);

// And of where layers taper to nothing, if anywhere, with what would mend the first place.
void cw_warn_of_pinched(CwLog *log, const CwDomain *domain, json_t *headlines);

// Tells, before anything is meshed too, of walls that meet in an edge so sharp that first heights beside it are missed;
// and adds the angle of the sharpest to the entry of the domain.
void cw_tell_of_sharp_edge(CwLog *log, const CwDomain *domain);
void cw_put_sharp_edge(const CwDomain *domain, json_t *result);

// And, where the number of layers is open, of a domain that has fewer than `needed`, for which about `cells` have room.
void cw_warn_of_few_layers(CwLog *log, const CwDomain *domain, int needed, double cells, json_t *headlines);

// And of too few cells, for the layers that the case may give, which leave edges of walls too long: of what
// cw_cells_crowded() finds. `made`: the layers that there are, where the case gives more.
void cw_warn_of_long_edges(CwLog *log, const CwCase *table, int made, double scale, double cells, json_t *headlines);

// And of faces of a domain that are left out of it: edges there are `edge` long, and about `cells` show them.
void cw_warn_of_left_out(CwLog *log, const CwDomain *domain, double edge, double cells, json_t *headlines);
// Adds how many these are, and the width of the widest, to the entry of the domain.
void cw_put_left_out(const CwDomain *domain, json_t *result);

// Warns, once for all patches of `coverage` (the domain's layer_coverage), of prisms of small determinant.
void cw_warn_of_thin(CwLog *log, const char *domain, const json_t *coverage);

// Warns where less than 90 % of the wall faces of `coverage` have their first height.
void cw_warn_of_missed(CwLog *log, const char *domain, const json_t *coverage, json_t *headlines);

// Warns of the patches of `coverage` over which more than 5 % of the faces of the layer top exceed CW_RATIO_FAIR, any
// exceeds CW_RATIO_MOST or any has a small weight, and names the key to change. `layers`: their number; automatic: the
// case leaves it open. A headline where more than 5 % of all its faces exceed CW_RATIO_FAIR.
void cw_warn_of_layers(CwLog *log, const char *domain, int layers, int automatic, const json_t *coverage,
                       json_t *headlines);
