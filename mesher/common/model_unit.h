// SPDX-License-Identifier: AGPL-3.0-or-later
// The unit of all lengths in the mesher: that of the solids times a power of two, such that the greatest extent of the
// model lies between a quarter and a half of it. So a length in the code is a share of the model's size, tolerances of
// OpenCASCADE included, and solids with the same numbers give the same mesh, whatever their unit: cw_cad_rescale loses
// no bit, cw_in_model_unit brings lengths of the case and of the flow to the unit, and region files keep it. Manifest,
// record, VTK and messages have metres or millimetres, and so has what the case asks of a patch (CwPatchTarget);
// elsewhere in the mesher "m" stands for this unit.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

// Sets the unit of the run to that of the solids, m, times the power of two that suits their greatest extent, m, above
// 0.
void cw_model_unit_fit(double solid_unit, double extent);
// Sets it, m; 1 m until then.
void cw_model_unit_set(double unit);
// The unit, m.
double cw_model_unit(void);
// A length in m in the unit, to ten digits (pipeline/significant.h).
double cw_in_model_unit(double length);
// A length in millimetres and a volume in cubic ones, for messages.
double cw_mm(double length);
double cw_mm3(double volume);

#ifdef __cplusplus
}
#endif

// A place as three arguments of a message, mm.
#define CW_MM(x) cw_mm((x)[0]), cw_mm((x)[1]), cw_mm((x)[2])
