// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/cell_law.h"

#include <math.h>

// Of cells with the scale: what two counts tell may be noise. Where they tell that cells hardly fall any more, edges
// are as long as the model lets them, and a step that counted on so little would be too long.
static const double SLOPE_LEAST = 1, SLOPE_MOST = 6;
// Relative change of the scale from which on two counts tell a slope; and where the scale that is wanted lies between.
static const double APART = 0.01, APART_BETWEEN = 1e-4;

double cw_cell_law_at(const CwCellLaw *law, double scale) {
  return law->scale > 0 ? law->factor * pow(scale / law->scale, law->exponent) : law->factor;
}

void cw_cell_law_learn(CwCellLaw *law, double factor, double scale, int power, int between) {
  double step = law->scale > 0 ? log(scale / law->scale) : 0, least = between ? -INFINITY : power - SLOPE_MOST;
  if (fabs(step) >= (between ? APART_BETWEEN : APART))
    law->exponent = fmin(fmax(log(factor / law->factor) / step, least), power - SLOPE_LEAST);
  law->factor = factor;
  law->scale = scale;
}
