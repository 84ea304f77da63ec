// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tetgen_fill.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <tetgen.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "mesher/common/model_unit.h"
#include "mesher/common/quality.h"
#include "mesher/fill/boundary_check.h"
#include "mesher/fill/fill_points.h"
#include "mesher/fill/fill_shape.h"
#include "mesher/fill/tet_improve.h"
#include "pipeline/log.h"

namespace {

void give_points(const CwFillInput *input, int32_t inner_count, const double (*inner)[3], tetgenio &io) {
  io.numberofpoints = input->point_count + inner_count;
  io.pointlist = new REAL[3 * (size_t)io.numberofpoints];
  memcpy(io.pointlist, input->x, (size_t)input->point_count * sizeof *input->x);
  if (inner_count) memcpy(io.pointlist + 3 * (size_t)input->point_count, inner, (size_t)inner_count * sizeof *inner);
}

void give_triangles(const CwFillInput *input, tetgenio &io) {
  io.facetlist = new tetgenio::facet[input->triangle_count];
  io.numberoffacets = input->triangle_count;
  for (int32_t t = 0; t < input->triangle_count; t++) tetgenio::init(&io.facetlist[t]);
  for (int32_t t = 0; t < input->triangle_count; t++) {
    tetgenio::facet *facet = &io.facetlist[t];
    facet->polygonlist = new tetgenio::polygon[1];
    facet->numberofpolygons = 1;
    tetgenio::init(facet->polygonlist);
    facet->polygonlist->vertexlist = new int[3];
    facet->polygonlist->numberofvertices = 3;
    for (int k = 0; k < 3; k++) facet->polygonlist->vertexlist[k] = input->triangle[t][k];
  }
}

// Writes or reads all of it; false where the other end is gone.
bool pass(int file, void *data, size_t size, bool out) {
  char *at = static_cast<char *>(data);
  while (size > 0) {
    ssize_t done = out ? write(file, at, size) : read(file, at, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    at += done;
    size -= (size_t)done;
  }
  return true;
}

// The child's work: TetGen, and what it makes into the pipe: points, tetrahedra, then both arrays. Gives TetGen's
// number for a failure (1 memory, 3 self-intersection, 4 and 5 very close features, others inner).
int run_and_send(tetgenio &in, int file) {
  tetgenio out;
  char switches[] = "pYQO0"; // p: keep the boundary; Y: without points on it; O0: the optimisation is ours
  int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) { // it prints even when told to be quiet, and before it aborts
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  try {
    tetrahedralize(switches, &in, &out);
  } catch (int code) {
    return code ? code : 2;
  } catch (const std::bad_alloc &) {
    return 1;
  }
  int32_t count[2] = {out.numberofpoints, out.numberoftetrahedra};
  bool sent = pass(file, count, sizeof count, true) &&
              pass(file, out.pointlist, 3 * sizeof(double) * (size_t)count[0], true) &&
              pass(file, out.tetrahedronlist, 4 * sizeof(int) * (size_t)count[1], true);
  return sent ? 0 : 2;
}

// What the child made; *whole is false where it did not come to that.
CwStatus receive(const CwFillInput *input, int file, CwFill *fill, bool *whole) {
  int32_t count[2] = {0, 0};
  *whole = false;
  if (!pass(file, count, sizeof count, false) || count[0] < input->point_count || count[1] <= 0) return CW_OK;
  fill->x = static_cast<double(*)[3]>(malloc((size_t)count[0] * sizeof *fill->x));
  fill->tetrahedron = static_cast<int32_t(*)[4]>(malloc((size_t)count[1] * sizeof *fill->tetrahedron));
  if (!fill->x || !fill->tetrahedron)
    return CW_FAIL(CW_ERR_MEMORY, "%s: out of memory: %d tetrahedra", input->name, count[1]);
  if (!pass(file, fill->x, (size_t)count[0] * sizeof *fill->x, false) ||
      !pass(file, fill->tetrahedron, (size_t)count[1] * sizeof *fill->tetrahedron, false))
    return CW_OK;
  fill->point_count = count[0];
  fill->tetrahedron_count = count[1];
  memcpy(fill->x, input->x, (size_t)input->point_count * sizeof *fill->x);
  *whole = true;
  return CW_OK;
}

// One Delaunay tetrahedralisation of all points, in which TetGen then recovers the few triangles that are
// missing. In a process of its own: on some boundaries TetGen frees memory twice, or aborts.
CwStatus tetrahedralise(const CwFillInput *input, int32_t inner_count, const double (*inner)[3], CwFill *fill) {
  CwStatus status = CW_OK;
  int ends[2] = {-1, -1}, how = 0;
  bool whole = false;
  pid_t child = -1, parent;
  CW_REQUIRE(pipe(ends) == 0, CW_ERR_LIBRARY, "%s: no pipe for TetGen: %s", input->name, strerror(errno));
  fflush(NULL); // or the child might print it again
  parent = getpid();
  child = fork();
  CW_REQUIRE(child >= 0, CW_ERR_LIBRARY, "%s: no process for TetGen: %s", input->name, strerror(errno));
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL); // or it would hold the memory of a rank that was killed
    if (getppid() != parent) _exit(1);
    signal(SIGABRT, SIG_DFL);
    signal(SIGSEGV, SIG_DFL);
    signal(SIGPIPE, SIG_IGN);
    tetgenio in;
    give_points(input, inner_count, inner, in);
    give_triangles(input, in);
    _exit(run_and_send(in, ends[1]));
  }
  close(ends[1]);
  ends[1] = -1;
  status = receive(input, ends[0], fill, &whole);
  close(ends[0]); // a child that still writes ends then
  ends[0] = -1;
  while (waitpid(child, &how, 0) < 0 && errno == EINTR) continue;
  if (status != CW_OK) goto done;
  CW_REQUIRE(!WIFEXITED(how) || WEXITSTATUS(how) != 1, CW_ERR_MEMORY, "%s: out of memory in TetGen", input->name);
  CW_REQUIRE(WIFEXITED(how), CW_ERR_MESH, "%s: TetGen cannot fill the boundary (signal %d)", input->name,
             WTERMSIG(how));
  CW_REQUIRE(WEXITSTATUS(how) == 0 && whole, CW_ERR_MESH, "%s: TetGen cannot fill the boundary (its code %d)",
             input->name, WEXITSTATUS(how));
done:
  for (int end : ends) {
    if (end >= 0) close(end);
  }
  if (status != CW_OK) cw_fill_free(fill);
  return status;
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
             input->name, cw_mm3(enclosed), cw_mm3(filled));
done:
  return status;
}

// Fills with the given inner points, or, where there are none, with points that keep `clearance` times their usual
// distance from the boundary.
CwStatus try_fill(const CwFillInput *input, double clearance, CwFill *fill) {
  CwStatus status = CW_OK;
  double(*made)[3] = nullptr;
  const double(*inner)[3] = input->inner;
  int32_t inner_count = input->inner_count;
  if (!inner) {
    CW_TRY(cw_fill_points(input, clearance, &inner_count, &made, nullptr));
    inner = made;
  }
  try {
    CW_TRY(tetrahedralise(input, inner_count, inner, fill));
  } catch (const std::bad_alloc &) {
    status = CW_FAIL(CW_ERR_MEMORY, "%s: out of memory", input->name);
    goto done;
  }
  CW_TRY(cw_fill_keep_inside(input, fill));
  CW_TRY(check_volume(input, fill));
done:
  free(made);
  if (status != CW_OK) cw_fill_free(fill);
  return status;
}

} // namespace

CwStatus cw_tetgen_fill(const CwFillInput *input, CwFill *fill) {
  CwStatus status = CW_OK;
  CwTetChanges changes;
  CwFillInput away = *input;
  away.inner = nullptr;
  away.open_count = away.offset_count = 0;
  memset(fill, 0, sizeof *fill);
  CW_TRY(cw_boundary_check(input));
  CW_TRY(cw_boundary_check_crossing(input)); // TetGen loses memory over such boundaries, or aborts
  status = try_fill(input, 1.0, fill);
  if (status == CW_ERR_MESH) {
    char first[600];
    snprintf(first, sizeof first, "%s", cw_fail_message());
    // Points further away leave recovery more room.
    status = try_fill(&away, 2.0, fill);
    if (status == CW_ERR_MESH) status = CW_FAIL(CW_ERR_MESH, "%s", first);
  }
  if (status != CW_OK) goto done;
  CW_TRY(cw_tet_improve(input->point_count, fill, &changes));
  fill->recovery.tetgen = 1;
  cw_log_debug(input->log,
               "%s: %d tetrahedra, %d edges and %d faces removed, %d points moved, %d added, least sine "
               "%.3g to %.3g",
               input->name, fill->tetrahedron_count, changes.edges_removed, changes.faces_removed, changes.points_moved,
               changes.points_added, changes.least_before, changes.least_after);
done:
  if (status != CW_OK) cw_fill_free(fill);
  return status;
}
