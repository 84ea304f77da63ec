// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/size/size_audit.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/model_unit.h"

CwStatus cw_size_audit(const CwSize *size, const CwBackground *background) {
  CwStatus status = CW_OK;
  for (int32_t p = 0; p < background->point_count; p++) {
    double h = cw_size_at(size, background->x[p]);
    CW_REQUIRE(h > 0 && isfinite(h), CW_ERR_FAULT, "size field: edges of %g mm are wanted at (%.3f, %.3f, %.3f) mm",
               cw_mm(h), CW_MM(background->x[p]));
  }
done:
  return status;
}

CwStatus cw_size_vtk(const CwSize *size, const CwBackground *background, const char *path) {
  CwStatus status = CW_OK;
  double *h = NULL;
  CW_NEW(h, background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    double centre[3];
    cw_background_area(background, t, centre);
    h[t] = cw_model_unit() * cw_size_at(size, centre);
  }
  CW_TRY(cw_background_vtk(background, "wanted edge lengths", &(CwVtkField){"size_m", NULL, h}, path));
done:
  free(h);
  return status;
}
