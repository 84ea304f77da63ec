// SPDX-License-Identifier: AGPL-3.0-or-later
// Whether two meshes are one but for their size.
//
//   similar_meshes RUN OTHER_RUN FACTOR DOMAIN...
//
// All cells, boundary faces and shared numbers are to be the same, and every coordinate of OTHER_RUN FACTOR times that
// of RUN: to the last bit where the factor is a power of two, else but for the rounding of both units and products.
// Prints what differs first and returns 1 where something does.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/measure/domain_mesh.h"

static CwStatus same_items(const char *what, const CwRegionMesh *a, int64_t count, int64_t other_count, size_t size,
                           const void *items, const void *other) {
  CwStatus status = CW_OK;
  CW_REQUIRE(count == other_count && !memcmp(items, other, (size_t)count * size), CW_ERR_INPUT,
             "%s region %d: the %s differ", a->domain, a->region, what);
done:
  return status;
}

static CwStatus compare(const CwRegionMesh *a, const CwRegionMesh *b, double factor) {
  CwStatus status = CW_OK;
  int exponent;
  const double rounding = frexp(factor, &exponent) == 0.5 ? 0 : 4 * DBL_EPSILON;
#define SAME(items, count)                                                                                             \
  CW_TRY(same_items(#items, a, a->cells.count, b->cells.count, sizeof *a->cells.items, a->cells.items, b->cells.items))
  SAME(shared_id, shared_count);
  SAME(tetrahedra, tetrahedron_count);
  SAME(pyramids, pyramid_count);
  SAME(prisms, prism_count);
  SAME(triangles, triangle_count);
  SAME(triangle_patch, triangle_count);
  SAME(triangle_cell, triangle_count);
  SAME(quads, quad_count);
  SAME(quad_patch, quad_count);
  SAME(quad_cell, quad_count);
#undef SAME
  CW_REQUIRE(a->cells.point_count == b->cells.point_count, CW_ERR_INPUT, "%s region %d: %d and %d points", a->domain,
             a->region, a->cells.point_count, b->cells.point_count);
  for (int32_t p = 0; p < a->cells.point_count; p++) {
    for (int k = 0; k < 3; k++)
      CW_REQUIRE(fabs(factor * a->cells.points[p][k] - b->cells.points[p][k]) <= rounding * fabs(b->cells.points[p][k]),
                 CW_ERR_INPUT, "%s region %d: point %d: %.17g and %.17g m", a->domain, a->region, p,
                 a->cells.points[p][k], b->cells.points[p][k]);
  }
done:
  return status;
}

static CwStatus compare_domain(const char *run, const char *other, double factor, const char *domain) {
  CwStatus status = CW_OK;
  CwDomainMesh a = {0}, b = {0};
  char path[4096];
  snprintf(path, sizeof path, "%s/mesh", run);
  CW_TRY(cw_domain_mesh_read(path, domain, &a));
  snprintf(path, sizeof path, "%s/mesh", other);
  CW_TRY(cw_domain_mesh_read(path, domain, &b));
  CW_REQUIRE(a.region_count == b.region_count, CW_ERR_INPUT, "%s: %d and %d regions", domain, a.region_count,
             b.region_count);
  for (int32_t r = 0; r < a.region_count; r++) CW_TRY(compare(&a.region[r], &b.region[r], factor));
done:
  cw_domain_mesh_free(&a);
  cw_domain_mesh_free(&b);
  return status;
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CW_REQUIRE(argc >= 5, CW_ERR_USAGE, "similar_meshes RUN OTHER_RUN FACTOR DOMAIN...");
  for (int i = 4; i < argc; i++) CW_TRY(compare_domain(argv[1], argv[2], atof(argv[3]), argv[i]));
done:
  if (status != CW_OK) printf("%s\n", cw_fail_message());
  return status == CW_OK ? 0 : 1;
}
