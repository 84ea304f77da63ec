// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/vtk.h"

#include "mesher/common/model_unit.h"
#include "pipeline/atomic_file.h"

static void write_points(FILE *out, const char *title, int32_t count, const double (*x)[3]) {
  double unit = cw_model_unit();
  fprintf(out, "# vtk DataFile Version 3.0\n%s, m\nASCII\nDATASET POLYDATA\nPOINTS %d double\n", title, count);
  for (int32_t p = 0; p < count; p++)
    fprintf(out, "%.17g %.17g %.17g\n", unit * x[p][0], unit * x[p][1], unit * x[p][2]);
}

static void write_fields(FILE *out, int32_t count, int field_count, const CwVtkField *field) {
  fprintf(out, "CELL_DATA %d\n", count);
  for (int f = 0; f < field_count; f++) {
    fprintf(out, "SCALARS %s %s 1\nLOOKUP_TABLE default\n", field[f].name, field[f].real ? "double" : "int");
    for (int32_t i = 0; i < count; i++) {
      if (field[f].real) {
        fprintf(out, "%.17g\n", field[f].real[i]);
      } else {
        fprintf(out, "%d\n", field[f].value[i]);
      }
    }
  }
}

CwStatus cw_vtk_write(const char *path, const CwVtkTriangles *triangles) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  CW_TRY(cw_atomic_file_open(path, &file));
  write_points(file.stream, triangles->title, triangles->point_count, triangles->x);
  fprintf(file.stream, "POLYGONS %d %d\n", triangles->triangle_count, 4 * triangles->triangle_count);
  for (int32_t t = 0; t < triangles->triangle_count; t++) {
    const int32_t *corner = triangles->triangle[t];
    fprintf(file.stream, "3 %d %d %d\n", corner[0], corner[1], corner[2]);
  }
  write_fields(file.stream, triangles->triangle_count, triangles->field_count, triangles->field);
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}

CwStatus cw_vtk_write_lines(const char *path, const CwVtkLines *lines) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  int32_t count = lines->line_count, points = lines->start[count];
  CW_TRY(cw_atomic_file_open(path, &file));
  write_points(file.stream, lines->title, points, lines->x);
  fprintf(file.stream, "LINES %d %d\n", count, count + points);
  for (int32_t i = 0; i < count; i++) {
    fprintf(file.stream, "%d", lines->start[i + 1] - lines->start[i]);
    for (int32_t p = lines->start[i]; p < lines->start[i + 1]; p++) fprintf(file.stream, " %d", p);
    fputc('\n', file.stream);
  }
  write_fields(file.stream, count, lines->field_count, lines->field);
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}
