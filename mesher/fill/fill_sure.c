// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_sure.h"

#include <math.h>
#include <string.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/fill/kernel.h"
#include "pipeline/log.h"

static const double FLAT_CELL = 1e-7; // of cw_fill_flatness: as flat as rounding

double cw_fill_flatness(const CwFill *fill) {
  double least = INFINITY;
  for (int32_t t = 0; t < fill->tetrahedron_count; t++) {
    const double *x[4];
    double square = 0.0, d[3];
    for (int k = 0; k < 4; k++) x[k] = fill->x[fill->tetrahedron[t][k]];
    for (int k = 0; k < 6; k++) {
      cw_sub(x[k < 3 ? 0 : k < 5 ? 1 : 2], x[k < 3 ? k + 1 : k < 5 ? k - 1 : 3], d);
      square = fmax(square, cw_dot(d, d));
    }
    least = fmin(least, cw_tet_volume6(x[0], x[1], x[2], x[3]) / (square * sqrt(square)));
  }
  return least;
}

CwStatus cw_fill_sure(const CwFillInput *input, CwFillMethod method, CwFill *fill) {
  CwStatus status;
  CwFill own = {0};
  double flatness = 0.0;
  memset(fill, 0, sizeof *fill);
  if (method == CW_FILL_KERNEL) {
    status = cw_kernel_fill(input, &own);
    if (status != CW_OK && status != CW_RETRY) goto done;
    flatness = status == CW_OK ? cw_fill_flatness(&own) : 0.0;
    if (flatness > FLAT_CELL) {
      *fill = own;
      return CW_OK;
    }
    cw_log_debug("%s: left to TetGen, flatness %.3g", input->name, flatness);
  }
  status = cw_fill(input, fill);
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
