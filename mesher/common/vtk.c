// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/vtk.h"

#include "mesher/common/model_unit.h"
#include "pipeline/atomic_file.h"

CwStatus cw_vtk_write(const char *path, const CwVtkTriangles *triangles) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  double unit = cw_model_unit();
  CW_TRY(cw_atomic_file_open(path, &file));
  fprintf(file.stream, "# vtk DataFile Version 3.0\n%s, m\nASCII\nDATASET POLYDATA\nPOINTS %d double\n",
          triangles->title, triangles->point_count);
  for (int32_t p = 0; p < triangles->point_count; p++) {
    const double *x = triangles->x[p];
    fprintf(file.stream, "%.17g %.17g %.17g\n", unit * x[0], unit * x[1], unit * x[2]);
  }
  fprintf(file.stream, "POLYGONS %d %d\n", triangles->triangle_count, 4 * triangles->triangle_count);
  for (int32_t t = 0; t < triangles->triangle_count; t++) {
    const int32_t *corner = triangles->triangle[t];
    fprintf(file.stream, "3 %d %d %d\n", corner[0], corner[1], corner[2]);
  }
  fprintf(file.stream, "CELL_DATA %d\n", triangles->triangle_count);
  for (int f = 0; f < triangles->field_count; f++) {
    fprintf(file.stream, "SCALARS %s int 1\nLOOKUP_TABLE default\n", triangles->field[f].name);
    for (int32_t t = 0; t < triangles->triangle_count; t++) fprintf(file.stream, "%d\n", triangles->field[f].value[t]);
  }
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}
