// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill.h"

#include <fcntl.h>
#include <unistd.h>

// TetGen's own terminatetetgen frees its mesh and then throws, and the mesh frees itself again on the way up:
// any failure ends in a crash. It is an exported function of the library, so the one below takes its place
// there; the header's is put out of the way.
#define terminatetetgen tetgen_terminate_that_frees_twice
#include <tetgen.h>
#undef terminatetetgen

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include "mesher/boundary_check.h"
#include "mesher/fill_points.h"
#include "mesher/fill_shape.h"
#include "mesher/quality.h"
#include "mesher/tet_improve.h"
#include "pipeline/log.h"

void terminatetetgen(tetgenmesh *mesh, int code);

void terminatetetgen(tetgenmesh *, int code) {
  throw code;
}

namespace {

// TetGen prints to standard output even when told to be quiet.
class Silence {
public:
  Silence() {
    fflush(stdout);
    kept = dup(STDOUT_FILENO);
    int nowhere = open("/dev/null", O_WRONLY);
    if (kept >= 0 && nowhere >= 0)
      dup2(nowhere, STDOUT_FILENO);
    if (nowhere >= 0)
      close(nowhere);
  }
  ~Silence() {
    fflush(stdout);
    if (kept >= 0) {
      dup2(kept, STDOUT_FILENO);
      close(kept);
    }
  }

private:
  int kept;
};

void give_points(const CwFillInput *input, int32_t inner_count, const double (*inner)[3], tetgenio &io) {
  io.numberofpoints = input->point_count + inner_count;
  io.pointlist = new REAL[3 * (size_t)io.numberofpoints];
  memcpy(io.pointlist, input->x, (size_t)input->point_count * sizeof *input->x);
  if (inner_count)
    memcpy(io.pointlist + 3 * (size_t)input->point_count, inner, (size_t)inner_count * sizeof *inner);
}

void give_triangles(const CwFillInput *input, tetgenio &io) {
  io.facetlist = new tetgenio::facet[input->triangle_count];
  io.numberoffacets = input->triangle_count;
  for (int32_t t = 0; t < input->triangle_count; t++)
    tetgenio::init(&io.facetlist[t]);
  for (int32_t t = 0; t < input->triangle_count; t++) {
    tetgenio::facet *facet = &io.facetlist[t];
    facet->polygonlist = new tetgenio::polygon[1];
    facet->numberofpolygons = 1;
    tetgenio::init(facet->polygonlist);
    facet->polygonlist->vertexlist = new int[3];
    facet->polygonlist->numberofvertices = 3;
    for (int k = 0; k < 3; k++)
      facet->polygonlist->vertexlist[k] = input->triangle[t][k];
  }
}

// Runs TetGen; 0, or the number it throws (1 memory, 3 self-intersection, 4 and 5 very close features, others
// inner).
int run(const char *switches, tetgenio &in, tetgenio &out) {
  char text[64];
  snprintf(text, sizeof text, "%s", switches);
  Silence silence;
  try {
    tetrahedralize(text, &in, &out);
  } catch (int code) {
    return code ? code : 2;
  } catch (const std::bad_alloc &) {
    return 1;
  }
  return 0;
}

// One Delaunay tetrahedralisation of all points, in which TetGen then recovers the few triangles that are
// missing.
CwStatus tetrahedralise(const CwFillInput *input, int32_t inner_count, const double (*inner)[3],
                        CwFill *fill) {
  tetgenio in, out;
  give_points(input, inner_count, inner, in);
  give_triangles(input, in);
  // p: keep the boundary; Y: without points on it; O0: the optimisation is ours.
  int code = run("pYQO0", in, out);
  if (code == 1)
    return CW_FAIL(CW_ERR_MEMORY, "%s: out of memory in TetGen", input->name);
  if (code)
    return CW_FAIL(CW_ERR_MESH, "%s: TetGen cannot fill the boundary (its code %d)", input->name, code);
  if (out.numberofpoints < in.numberofpoints)
    return CW_FAIL(CW_ERR_MESH, "%s: TetGen takes points of the boundary for one", input->name);
  fill->x = static_cast<double(*)[3]>(malloc((size_t)out.numberofpoints * sizeof *fill->x));
  fill->tetrahedron =
      static_cast<int32_t(*)[4]>(malloc((size_t)out.numberoftetrahedra * sizeof *fill->tetrahedron));
  if (!fill->x || !fill->tetrahedron)
    return CW_FAIL(CW_ERR_MEMORY, "%s: out of memory", input->name);
  fill->point_count = out.numberofpoints;
  fill->tetrahedron_count = out.numberoftetrahedra;
  memcpy(fill->x, out.pointlist, (size_t)out.numberofpoints * sizeof *fill->x);
  memcpy(fill->x, input->x, (size_t)input->point_count * sizeof *fill->x);
  memcpy(fill->tetrahedron, out.tetrahedronlist, (size_t)out.numberoftetrahedra * sizeof *fill->tetrahedron);
  return CW_OK;
}

// Fails where the tetrahedra do not fill what the boundary encloses: a body of several is turned inside out.
CwStatus check_volume(const CwFillInput *input, const CwFill *fill) {
  CwStatus status = CW_OK;
  const double *origin = input->x[0];
  double enclosed = 0.0, filled = 0.0;
  for (int32_t t = 0; t < input->triangle_count; t++) {
    const int32_t *p = input->triangle[t];
    enclosed += cw_tet_volume6(origin, input->x[p[0]], input->x[p[1]], input->x[p[2]]) / 6.0;
  }
  for (int32_t t = 0; t < fill->tetrahedron_count; t++) {
    const int32_t *p = fill->tetrahedron[t];
    filled += cw_tet_volume6(fill->x[p[0]], fill->x[p[1]], fill->x[p[2]], fill->x[p[3]]) / 6.0;
  }
  CW_REQUIRE(std::fabs(enclosed - filled) <= 1e-6 * filled, CW_ERR_MESH,
             "%s: the boundary encloses %.6g mm3, of which %.6g mm3 can be filled: some of its normals point inward",
             input->name, 1e9 * enclosed, 1e9 * filled);
done:
  return status;
}

// Fills with inner points that keep `clearance` times their usual distance from the boundary.
CwStatus try_fill(const CwFillInput *input, double clearance, CwFill *fill) {
  CwStatus status = CW_OK;
  double(*inner)[3] = nullptr;
  int32_t inner_count = 0;
  CW_TRY(cw_fill_points(input, clearance, &inner_count, &inner));
  try {
    CW_TRY(tetrahedralise(input, inner_count, inner, fill));
  } catch (const std::bad_alloc &) {
    status = CW_FAIL(CW_ERR_MEMORY, "%s: out of memory", input->name);
    goto done;
  }
  CW_TRY(cw_fill_keep_inside(input, fill));
  CW_TRY(check_volume(input, fill));
done:
  free(inner);
  if (status != CW_OK)
    cw_fill_free(fill);
  return status;
}

} // namespace

CwStatus cw_fill(const CwFillInput *input, CwFill *fill) {
  CwStatus status = CW_OK;
  CwTetImproved improved;
  memset(fill, 0, sizeof *fill);
  CW_TRY(cw_boundary_check(input));
  CW_TRY(cw_boundary_check_crossing(input)); // TetGen loses memory over such boundaries, or aborts
  status = try_fill(input, 1.0, fill);
  if (status == CW_ERR_MESH) {
    char first[600];
    snprintf(first, sizeof first, "%s", cw_fail_message());
    // Points further away are less in the way of recovery.
    status = try_fill(input, 2.0, fill);
    if (status == CW_ERR_MESH)
      status = CW_FAIL(CW_ERR_MESH, "%s", first);
  }
  if (status != CW_OK)
    goto done;
  CW_TRY(cw_tet_improve(input->point_count, fill, &improved));
  fill->way.tetgen = 1;
  cw_log_debug(
      "%s: %d tetrahedra, %d edges and %d faces removed, %d points moved, %d added, least sine %.3g to %.3g",
      input->name, fill->tetrahedron_count, improved.edges_removed, improved.faces_removed,
      improved.points_moved, improved.points_added, improved.least_before, improved.least_after);
done:
  if (status != CW_OK)
    cw_fill_free(fill);
  return status;
}

void cw_fill_free(CwFill *fill) {
  free(fill->x);
  free(fill->tetrahedron);
  memset(fill, 0, sizeof *fill);
}
