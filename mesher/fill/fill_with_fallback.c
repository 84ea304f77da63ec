// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_with_fallback.h"

#include <math.h>
#include <string.h>

#include "mesher/fill/kernel.h"
#include "mesher/fill/tet_quality.h"
#include "mesher/fill/tetgen_fill.h"
#include "pipeline/log.h"

static const double FLAT_CELL = 1e-7; // of cw_fill_flatness: as flat as rounding

double cw_fill_flatness(const CwFill *fill) {
  double least = INFINITY;
  for (int32_t t = 0; t < fill->tetrahedron_count; t++) {
    const int32_t *p = fill->tetrahedron[t];
    CwTetMeasures m = cw_tet_measures(fill->x[p[0]], fill->x[p[1]], fill->x[p[2]], fill->x[p[3]]);
    double shortest, longest;
    cw_tet_edges(&m, &shortest, &longest);
    least = fmin(least, m.six / (longest * sqrt(longest)));
  }
  return least;
}

CwStatus cw_fill_with_fallback(const CwFillInput *input, CwFillMethod method, CwFill *fill) {
  CwStatus status = CW_OK;
  CwFill own = {0};
  double flatness = 0.0;
  memset(fill, 0, sizeof *fill);
  if (method == CW_FILL_KERNEL) {
    CwKernelOutcome outcome;
    CW_TRY(cw_kernel_fill(input, &own, &outcome));
    flatness = outcome == CW_KERNEL_FILLED ? cw_fill_flatness(&own) : 0.0;
    if (flatness > FLAT_CELL) {
      *fill = own;
      return CW_OK;
    }
    cw_log_debug(input->log, "%s: left to TetGen, flatness %.3g", input->name, flatness);
  }
  status = cw_tetgen_fill(input, fill);
  // A valid fill with a flat cell is better than none, and than a flatter one.
  if (flatness > 0.0 && (status != CW_OK || cw_fill_flatness(fill) < flatness)) {
    cw_fill_free(fill);
    *fill = own;
    return CW_OK;
  }
  own.recovery.tetgen = 1;
  fill->recovery = own.recovery;
done:
  cw_fill_free(&own);
  return status;
}
