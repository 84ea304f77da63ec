// SPDX-License-Identifier: AGPL-3.0-or-later
// The unit in which the solids are built: 2^k mm, with the k for which D2 is 128 to 256 of them. OpenCASCADE's absolute
// tolerances (1e-7) then mean the same share of every pump, and similar pumps whose sizes are powers of two apart have
// the same solids, bit by bit: a product with a power of two is exact.
#ifndef CUTWATER_GEOMETRY_MODEL_UNIT_H
#define CUTWATER_GEOMETRY_MODEL_UNIT_H

#ifdef __cplusplus
extern "C" {
#endif

// The unit of a pump with the impeller outlet D2 > 0, m: its length in m.
double cw_model_unit(double outlet_diameter);

#ifdef __cplusplus
}
#endif
#endif
