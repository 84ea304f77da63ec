// SPDX-License-Identifier: AGPL-3.0-or-later
// The unit of all lengths in the mesher: metres times a power of two, such that the greatest extent of the model lies
// between a quarter and a half of it. So a length in the code is a share of the model's size, tolerances of
// OpenCASCADE included, and models that are 2^k times one another have the same bits. What is read is brought to the
// unit (the solids by cw_cad_rescale, the case's heights by cw_domain_set_layers), what is written goes back to metres:
// both lose no bit. Region files, manifest, record, VTK and messages have metres or millimetres, and so has what the
// case asks of a patch (CwPatchTarget); elsewhere in the mesher "m" stands for this unit.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

// The power of two of a metre that is the unit of a model of greatest extent `extent`, m; above 0.
int cw_model_unit_power(double extent);

// Sets the unit of the run to 2^power m; 1 m until then.
void cw_model_unit_set(int power);
// The unit, m.
double cw_model_unit(void);
// A length in millimetres and a volume in cubic ones, for messages.
double cw_mm(double length);
double cw_mm3(double volume);

#ifdef __cplusplus
}
#endif

// A place as three arguments of a message, mm.
#define CW_MM(x) cw_mm((x)[0]), cw_mm((x)[1]), cw_mm((x)[2])
