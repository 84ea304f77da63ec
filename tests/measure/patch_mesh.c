// SPDX-License-Identifier: AGPL-3.0-or-later
// Meshes the unit square and prints: title, triangles, triangles per second, least, 1 % and mean least angle
// in degrees. Use: patch_mesh EDGE_LENGTH GRADED (0: uniform; 1: that length on a circle, growing by 0.2 to
// at most 0.05)
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesher/surface/patch_mesh.h"
#include "pipeline/log.h"
#include "pipeline/order.h"

typedef struct {
  double length;
  int graded;
} Field;

static void plane_at(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  x[0] = uv[0], x[1] = uv[1], x[2] = 0;
  if (xu) xu[0] = 1, xu[1] = xu[2] = 0;
  if (xv) xv[1] = 1, xv[0] = xv[2] = 0;
}

static double length_at(const void *context, const double x[3]) {
  const Field *field = context;
  if (!field->graded) return field->length;
  return fmin(0.05, field->length + 0.2 * fabs(hypot(x[0] - 0.5, x[1] - 0.5) - 0.3));
}

int main(int argc, char **argv) {
  if (argc != 3) return fprintf(stderr, "use: patch_mesh EDGE_LENGTH GRADED\n"), 2;
  Field field = {atof(argv[1]), atoi(argv[2])};
  int side = field.graded ? 20 : (int)round(1 / field.length), count = 4 * side;
  double(*uv)[2] = calloc((size_t)count, sizeof *uv), (*x)[3] = calloc((size_t)count, sizeof *x);
  int32_t(*edge)[2] = calloc((size_t)count, sizeof *edge);
  uint8_t *boundary = calloc((size_t)count, 1);
  if (!uv || !x || !edge || !boundary) return 5;
  for (int k = 0; k < count; k++) {
    double t = (double)(k % side) / side;
    const double at[4][2] = {{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}};
    x[k][0] = uv[k][0] = at[k / side][0];
    x[k][1] = uv[k][1] = at[k / side][1];
    edge[k][0] = k;
    edge[k][1] = (k + 1) % count;
    boundary[k] = 1;
  }
  CwPatchInput input = {.surface = plane_at,
                        .size = length_at,
                        .size_context = &field,
                        .point_count = count,
                        .uv = (const double(*)[2])uv,
                        .x = (const double(*)[3])x,
                        .edge_count = count,
                        .edge = (const int32_t(*)[2])edge,
                        .boundary = boundary,
                        .name = "square"};
  CwPatchMesh mesh;
  double start = cw_processor_seconds();
  CwStatus status = cw_patch_mesh(&input, &mesh, &(CwOutcome){0});
  double seconds = cw_processor_seconds() - start;
  if (status != CW_OK) return fprintf(stderr, "%s\n", cw_fail_message()), (int)status;
  double *angle = calloc((size_t)mesh.triangle_count, sizeof *angle), mean = 0;
  for (int32_t t = 0; angle && t < mesh.triangle_count; t++) {
    angle[t] = 180;
    for (int i = 0; i < 3; i++) {
      const double *a = mesh.x[mesh.triangle[t][i]], *b = mesh.x[mesh.triangle[t][(i + 1) % 3]],
                   *c = mesh.x[mesh.triangle[t][(i + 2) % 3]];
      double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - a[0], c[1] - a[1]};
      angle[t] = fmin(angle[t], atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]) * 180 / M_PI);
    }
    mean += angle[t] / mesh.triangle_count;
  }
  if (angle) {
    qsort(angle, (size_t)mesh.triangle_count, sizeof *angle, cw_order_doubles);
    printf("%-24s %9d %12.0f %6.1f %6.1f %6.1f\n", "cutwater", mesh.triangle_count, mesh.triangle_count / seconds,
           angle[0], angle[mesh.triangle_count / 100], mean);
  }
  free(angle);
  cw_patch_mesh_free(&mesh);
  free(uv);
  free(x);
  free(edge);
  free(boundary);
  return 0;
}
