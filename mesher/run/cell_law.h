// SPDX-License-Identifier: AGPL-3.0-or-later
// How cells follow the scale of the size fields: an integral of the field, s^-2 over walls or s^-3 over the volume,
// times a factor that follows a power of s. The factor is constant in fine meshes. In coarse ones the curves of the
// model, each with a whole number of edges, hold up the count, and the exponent is what two counts tell (secants in
// the logarithms).
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double factor;   // cells per unit of the integral; 0: not known yet
  double scale;    // at which they were counted; 0: predicted, for any scale
  double exponent; // of the factor, as a function of the scale
  int64_t layers;  // of all domains together, with which they were counted; 0: predicted, for any number
} CwCellLaw;

double cw_cell_law_at(const CwCellLaw *law, double scale);

// Takes in what was counted at a scale: cells = factor * integral / scale^power. between: the scale that is wanted lies
// between this one and the last; however steep they are, it is had from both. Elsewhere cells fall with the sixth power
// at most. [in,out] law.
void cw_cell_law_learn(CwCellLaw *law, double factor, double scale, int power, int between);

#ifdef __cplusplus
}
#endif
