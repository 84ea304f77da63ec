// SPDX-License-Identifier: AGPL-3.0-or-later
// What the step of the regions does where a region does not come out: layers that leave no room are told in its
// summary, a fault of the program ends the run.
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <sys/stat.h>

extern "C" {
#include "mesher/common/vec.h"
#include "mesher/run/mesh_steps.h"
}

#include "divided_box.h"

// A run with one domain, the box in two regions.
struct BoxRun {
  Box box{1};
  std::unique_ptr<CwMeshRun> run = std::make_unique<CwMeshRun>();
  int32_t number[2] = {1, 2};
  TemporaryFolder folder;

  BoxRun() {
    make_surfaces(box);
    assert_int_equal(mkdir((folder.path + "/mesh").c_str(), 0777), 0);
    CwDomain &domain = run->domain[0];
    run->run_path = folder.path.c_str();
    run->model.domain_count = 1;
    domain.name = "box";
    domain.plan = box.plan;
    domain.number = number;
  }
  bool has(const char *file) const {
    struct stat found;
    return stat((folder.path + "/mesh/" + file).c_str(), &found) == 0;
  }
  // The first region.
  CwStatus make(const CwRegionContext &context, CwRegionSummary **summary) {
    int64_t size = 0;
    void *bytes = nullptr;
    run->domain[0].context = context;
    CwStatus status = cw_step_region(run.get(), {0, 0, 1}, &bytes, &size);
    *summary = static_cast<CwRegionSummary *>(bytes);
    assert_int_equal(size, bytes ? sizeof **summary : 0);
    return status;
  }
  // The wall vertex, off the partition plane, over which the layer top is nearest to a place.
  int vertex_at(const double place[3]) const {
    const DomainSurfaces &boundary = box.boundary;
    int best = -1;
    for (int v = 0; v < boundary.surface.vertex_count; v++) {
      if (boundary.interfaces.nodes.on_plane[v]) continue;
      if (best < 0 || cw_distance(boundary.layers.top[v], place) < cw_distance(boundary.layers.top[best], place))
        best = v;
    }
    return best;
  }
};

// A node on the plane that nobody else is told of: the faces round it are open, but on no plane and on no patch. No
// layers can be blamed for that.
static void a_region_that_fails_its_audit_ends_the_run(void **) {
  BoxRun made;
  Regions regions(made.box.boundary);
  CwRegionSummary *summary;
  const CwInterfaceTriangles &planned = made.box.boundary.interfaces.refined;
  int lone = -1;
  for (int t = 0; t < planned.count && lone < 0; t++) {
    for (int node : planned.triangle[t]) {
      if (node >= made.box.boundary.surface.vertex_count) lone = node; // no column stands there
    }
  }
  assert_true(lone >= 0);
  regions.shared.base[lone] = -1;
  assert_int_equal(made.make(regions.context, &summary), CW_ERR_FAULT);
  assert_null(summary);
  assert_non_null(strstr(cw_fail_message(), "box region 1"));
  assert_false(made.has("box-0001.h5"));
  assert_false(made.has("failed-box-0001.vtk"));
}

// A wall vertex moved through the layer top: the boundary of the tetrahedra is as it was, the prisms are turned over.
static void a_prism_turned_over_is_thinned_where_it_is(void **) {
  BoxRun made;
  DomainSurfaces &boundary = made.box.boundary;
  const double under[3] = {0.010, 0.015, 0.0185};
  const int v = made.vertex_at(under);
  boundary.surface.x[v][2] = boundary.layers.top[v][2] - 5e-3; // the columns beside it are 1.5 mm high
  const Regions regions(boundary);
  CwRegionSummary *summary;
  check(made.make(regions.context, &summary));
  assert_int_equal(summary->failure.failed, 1);
  assert_int_equal(summary->failure.everywhere, 0);
  assert_true(cw_distance(summary->failure.at, boundary.layers.top[v]) < 5e-3);
  assert_non_null(strstr(summary->failure.message, "prism of cell"));
  assert_string_equal(summary->failure.patch, "the layers");
  assert_false(made.has("box-0001.h5"));
  assert_true(made.has("failed-box-0001.vtk"));
  free(summary);
}

// A column through the partition plane: the boundary crosses itself and cannot be filled.
static void a_boundary_that_cannot_be_filled_is_thinned(void **) {
  BoxRun made;
  DomainSurfaces &boundary = made.box.boundary;
  const double before[3] = {0.0195, 0.015, 0.0185}, through[3] = {0.0235, 0.015, 0.010};
  const int v = made.vertex_at(before);
  cw_copy(through, boundary.layers.top[v]);
  cw_copy(through, boundary.interfaces.nodes.x[v]);
  const Regions regions(boundary);
  CwRegionSummary *summary;
  check(made.make(regions.context, &summary));
  assert_int_equal(summary->failure.failed, 1);
  assert_int_equal(summary->failure.everywhere, 0);
  assert_non_null(strstr(summary->failure.message, "crosses itself"));
  assert_true(made.has("failed-box-0001.vtk"));
  free(summary);
}

// A file that was written as it is, of a region with a tetrahedron turned over: it counts as damaged, which the summary
// tells, and is made again. The new one is taken up.
static void a_damaged_file_is_made_again(void **) {
  BoxRun made;
  DomainSurfaces &boundary = made.box.boundary;
  Regions regions(boundary);
  CwDomain &domain = made.run->domain[0];
  std::vector<double> target(boundary.surface.vertex_count, 1.5e-3);
  CwRegionMesh mesh;
  CwOutcome outcome = {};
  CwRegionSummary *summary;
  domain.cad = made.box.cad;
  domain.surface = boundary.surface;
  domain.layers = boundary.layers;
  domain.layers.first_height = regions.first.data();
  domain.layer_count = regions.context.layer_count;
  domain.targets.layer_count = regions.context.layer_count;
  domain.targets.first_height = regions.first.data();
  domain.targets.growth = regions.growth.data();
  domain.targets.target = target.data();
  check(cw_region_build(&regions.context, 0, 1, &mesh, &outcome));
  std::swap(mesh.cells.tetrahedra[5][0], mesh.cells.tetrahedra[5][1]);
  check(cw_region_write((made.folder.path + "/mesh/box-0001.h5").c_str(), &mesh));
  char digest[CW_HASH_TEXT] = "";
  for (int again = 0; again < 2; again++) {
    check(made.make(regions.context, &summary));
    assert_int_equal(summary->failure.failed, 0);
    assert_int_equal(summary->tetrahedra, mesh.cells.tetrahedron_count);
    if (again) {
      assert_string_equal(summary->damage, "");
      assert_string_equal(summary->digest, digest);
    } else {
      assert_non_null(strstr(summary->damage, "tetrahedron of cell 5"));
      assert_string_not_equal(summary->digest, mesh.digest);
      strcpy(digest, summary->digest);
    }
    free(summary);
  }
  assert_false(made.has("failed-box-0001.vtk"));
  cw_region_free(&mesh);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_region_that_fails_its_audit_ends_the_run),
      cmocka_unit_test(a_prism_turned_over_is_thinned_where_it_is),
      cmocka_unit_test(a_boundary_that_cannot_be_filled_is_thinned),
      cmocka_unit_test(a_damaged_file_is_made_again),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
