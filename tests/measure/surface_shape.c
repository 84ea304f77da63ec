// SPDX-License-Identifier: AGPL-3.0-or-later
// Measures the surface mesh of a finished run against the exact geometry. Prints for each patch: triangles, least,
// 1 % and mean of their least angles (degrees), triangles below 20 degrees, greatest distance of a node from the
// surfaces of the patch (m). Use: surface_shape GEOMETRY_DIR MESH_DIR
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesher/cad/background_make.h"
#include "mesher/common/vec.h"
#include "pipeline/order.h"
#include "tests/measure/domain_mesh.h"

static const double RAD = 180 / M_PI;
enum { NEAREST = 30 }; // places of the background from which a node's (u,v) is sought

static double least_angle(const double *const x[3]) {
  double least = M_PI;
  for (int k = 0; k < 3; k++) {
    double u[3], v[3], n[3];
    cw_sub(x[(k + 1) % 3], x[k], u);
    cw_sub(x[(k + 2) % 3], x[k], v);
    cw_cross(u, v, n);
    least = fmin(least, atan2(cw_norm(n), cw_dot(u, v)));
  }
  return least * RAD;
}

// Distance of x from the nearest surface of a patch: Newton's method from the nearest corners of its background.
static double distance_to_patch(CwCad *cad, const CwBackground *background, int patch, const double x[3]) {
  double near[NEAREST], best = INFINITY;
  int32_t corner[NEAREST];
  int count = 0;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    if (cw_cad_face_patch(cad, background->face[t]) != patch) continue;
    for (int k = 0; k < 3; k++) {
      double d = cw_distance(x, background->x[background->triangle[t][k]]);
      if (count == NEAREST && d >= near[count - 1]) continue;
      int at = count < NEAREST ? count++ : count - 1;
      for (; at > 0 && near[at - 1] > d; at--) {
        near[at] = near[at - 1];
        corner[at] = corner[at - 1];
      }
      near[at] = d;
      corner[at] = 3 * t + k;
    }
  }
  for (int i = 0; i < count; i++) {
    int32_t t = corner[i] / 3;
    double uv[2] = {background->uv[t][corner[i] % 3][0], background->uv[t][corner[i] % 3][1]};
    best = fmin(best, cw_cad_face_project(cad, background->face[t], x, uv));
  }
  return best;
}

static CwStatus measure(const char *geometry, const char *folder, const char *name) {
  CwStatus status = CW_OK;
  CwCad *cad = NULL;
  CwBackground background = {0};
  CwDomainMesh mesh = {0};
  double *angle = NULL;
  int64_t triangles = 0;
  CW_TRY(cw_cad_open(geometry, name, &cad));
  CW_TRY(cw_background_make(cad, 4e-5, 0.2, &background));
  CW_TRY(cw_domain_mesh_read(folder, name, &mesh));
  for (int32_t r = 0; r < mesh.region_count; r++) triangles += mesh.region[r].cells.triangle_count;
  CW_NEW(angle, triangles);
  for (int patch = 0; patch < cw_cad_patch_count(cad); patch++) {
    double sum = 0, off = 0;
    int64_t count = 0, poor = 0, node = 0;
    for (int32_t r = 0; r < mesh.region_count; r++) {
      const CwRegionMesh *region = &mesh.region[r];
      for (int32_t t = 0; t < region->cells.triangle_count; t++) {
        if (region->cells.triangle_patch[t] != patch) continue;
        const double *x[3];
        for (int k = 0; k < 3; k++) x[k] = region->cells.points[region->cells.triangles[t][k]];
        angle[count] = least_angle(x);
        sum += angle[count];
        poor += angle[count++] < 20;
        // A node in so many is as good as all of them.
        if (node++ % 16 == 0) off = fmax(off, distance_to_patch(cad, &background, patch, x[0]));
      }
    }
    if (!count) continue;
    qsort(angle, (size_t)count, sizeof *angle, cw_order_doubles);
    printf("%-7s %-22s %9lld %6.1f %6.1f %6.1f %7lld %10.2g\n", name, cw_cad_patch_name(cad, patch), (long long)count,
           angle[0], angle[count / 100], sum / (double)count, (long long)poor, off);
  }
done:
  free(angle);
  cw_domain_mesh_free(&mesh);
  cw_background_free(&background);
  cw_cad_close(&cad);
  return status;
}

int main(int argc, char **argv) {
  if (argc != 3) {
    fprintf(stderr, "use: surface_shape GEOMETRY_DIR MESH_DIR\n");
    return CW_ERR_USAGE;
  }
  printf("%-7s %-22s %9s %6s %6s %6s %7s %10s\n", "domain", "patch", "triangles", "least", "low_1%", "mean", "below20",
         "distance_m");
  CwStatus status = measure(argv[1], argv[2], "rotor");
  if (status == CW_OK) status = measure(argv[1], argv[2], "stator");
  if (status != CW_OK) fprintf(stderr, "%s\n", cw_fail_message());
  return (int)status;
}
