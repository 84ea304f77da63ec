// SPDX-License-Identifier: AGPL-3.0-or-later
// Which stage has which name, and which product it writes: of a box the size field and its plan, of the others as many
// triangles or lines as each alone has.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/run/stage_view.h"
}

#include "planned_solid.h"

static const char *const names[] = {"size", "decomposition", "curves", "surface", "layers", "interfaces"};
static const CwStage stages[] = {CW_STAGE_SIZE,    CW_STAGE_DECOMPOSITION, CW_STAGE_CURVES,
                                 CW_STAGE_SURFACE, CW_STAGE_LAYERS,        CW_STAGE_INTERFACES};

static void stages_have_their_names(void **) {
  CwStage stage;
  for (int i = 0; i < 6; i++) {
    check(cw_stage_of(names[i], &stage));
    assert_int_equal(stage, stages[i]);
  }
  for (const char *other : {"", "none", "sizes", "Layers", "regions", "size "}) {
    assert_int_equal(cw_stage_of(other, &stage), CW_ERR_USAGE);
    const std::string wanted = std::string("--stop-after: ") + other +
                               " is no stage; allowed: size, decomposition, curves, surface, layers, interfaces";
    assert_string_equal(cw_fail_message(), wanted.c_str());
    assert_int_equal(stage, CW_STAGE_NONE);
  }
}

// Two domains, the second of which has a box. Of its other products, that share their points, there are two curves,
// three wall triangles, one of the layer top, and an open one beside one on a plane.
struct Stopped {
  PlannedSolid box{BRepPrimAPI_MakeBox(10, 10, 10).Shape()};
  TemporaryFolder folder;
  std::unique_ptr<CwMeshRun> run = std::make_unique<CwMeshRun>();
  CwPlanNode node = {};
  double x[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 0}};
  int32_t triangle[3][3] = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}, none[3] = {0, 0, 0}, region[3] = {5, 6, 7};
  int32_t across[1][2] = {{3, 2}};
  uint8_t reason[5] = {};
  CwCurve curve[2] = {};

  Stopped() {
    assert_int_equal(mkdir((folder.path + "/mesh").c_str(), 0777), 0);
    node = {{{1, 0, 0}, 0.005}, -1, {-1, -2}, 1};
    for (CwCurve &one : curve) {
      one.kind = CW_CURVE_CUT;
      one.fine_count = 3;
      one.fine_x = x;
    }
    run->run_path = folder.path.c_str();
    run->vtk = 1;
    run->model.domain_count = 2;
    for (int d = 0; d < 2; d++) fill(run->domain[d]);
    run->domain[0].name = "rotor";
    run->domain[1].name = "stator";
  }
  void fill(CwDomain &domain) {
    domain.background = box.background;
    domain.size = box.size;
    domain.plan.node_count = 1;
    domain.plan.region_count = 2;
    domain.plan.node = &node;
    domain.network.curve_count = 2;
    domain.network.curve = curve;
    domain.surface.vertex_count = domain.layers.column_count = domain.interfaces.nodes.count = 5;
    domain.surface.x = domain.layers.top = domain.interfaces.nodes.x = x;
    domain.surface.triangle_count = 3;
    domain.surface.triangle = domain.layers.triangle = triangle;
    domain.surface.face = domain.interfaces.open_patch.face = none;
    domain.surface.region = region;
    domain.layers.triangle_count = 1;
    domain.layers.reason = reason;
    domain.interfaces.open_patch.count = domain.interfaces.refined.count = 1;
    domain.interfaces.open_patch.triangle = triangle;
    domain.interfaces.open_patch.region = region;
    domain.interfaces.refined.triangle = triangle + 1;
    domain.interfaces.refined.region = across;
  }
  std::string path(int domain, int stage) const {
    return folder.path + "/mesh/" + run->domain[domain].name + "-" + names[stage] + ".vtk";
  }
  // The text of a file, which goes; "" where there is none.
  std::string taken(int domain, int stage) const {
    std::ifstream file(path(domain, stage));
    std::stringstream text;
    text << file.rdbuf();
    std::remove(path(domain, stage).c_str());
    return text.str();
  }
  // Fails where anything else is left.
  void expect_no_more() const {
    assert_int_equal(rmdir((folder.path + "/mesh").c_str()), 0);
    assert_int_equal(mkdir((folder.path + "/mesh").c_str(), 0777), 0);
  }
};

// The numbers of a cell field.
static std::vector<double> field(const std::string &text, const std::string &name) {
  std::vector<double> values;
  const size_t at = text.find("SCALARS " + name + " ");
  assert_true(at != std::string::npos);
  std::istringstream rest(text.substr(text.find("LOOKUP_TABLE default\n", at) + 21));
  for (double value; rest >> value;) values.push_back(value);
  return values;
}

static void expect_cells(const std::string &text, const char *title, const std::string &name,
                         const std::vector<double> &wanted) {
  const std::string begin = std::string("# vtk DataFile Version 3.0\n") + title + ", m\n";
  assert_int_equal(text.find(begin), 0);
  const std::vector<double> found = field(text, name);
  assert_int_equal(found.size(), wanted.size());
  for (size_t i = 0; i < wanted.size(); i++) assert_near(found[i], wanted[i], 1e-12);
}

static void each_stage_writes_its_product(void **) {
  Stopped made;
  std::vector<double> lengths, regions;
  for (int32_t t = 0; t < made.box.background.triangle_count; t++) {
    double centre[3];
    cw_background_area(&made.box.background, t, centre);
    lengths.push_back(cw_size_at(made.box.size, centre));
    regions.push_back(centre[0] > 0.005);
  }
  const struct {
    const char *title, *field;
    std::vector<double> cells;
  } wanted[] = {{"wanted edge lengths", "size_m", lengths},
                {"regions", "region", regions},
                {"curves", "kind", {CW_CURVE_CUT, CW_CURVE_CUT}},
                {"surface mesh", "region", {5, 6, 7}},
                {"layer top", "region", {5}},
                {"open patches and interfaces", "region", {5, 2}}};
  for (int i = 0; i < 6; i++) {
    made.run->stop_after = stages[i];
    made.run->stopped = 0;
    check(cw_stage_view(made.run.get(), stages[i]));
    assert_int_equal(made.run->stopped, 1);
    for (int d = 0; d < 2; d++) expect_cells(made.taken(d, i), wanted[i].title, wanted[i].field, wanted[i].cells);
    made.expect_no_more();
  }
}

// Other stages than the one that is asked leave no trace; at that one a run without pictures stops too, and every rank,
// of which the first writes.
static void a_run_goes_on_up_to_its_stage(void **) {
  Stopped made;
  for (int asked = -1; asked < 6; asked++) {
    made.run->stop_after = asked < 0 ? CW_STAGE_NONE : stages[asked];
    for (int i = 0; i < 6; i++) {
      made.run->stopped = 0;
      made.run->vtk = 0;
      check(cw_stage_view(made.run.get(), stages[i]));
      assert_int_equal(made.run->stopped, i == asked);
      made.run->vtk = made.run->rank = 1;
      made.run->stopped = 0;
      check(cw_stage_view(made.run.get(), stages[i]));
      assert_int_equal(made.run->stopped, i == asked);
      made.run->rank = 0;
      made.expect_no_more();
    }
  }
}

static void a_folder_that_is_not_there_is_told(void **) {
  Stopped made;
  assert_int_equal(rmdir((made.folder.path + "/mesh").c_str()), 0);
  made.run->stop_after = CW_STAGE_SURFACE;
  assert_int_equal(cw_stage_view(made.run.get(), CW_STAGE_SURFACE), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "/mesh/rotor-surface.vtk"));
}

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(stages_have_their_names), cmocka_unit_test(each_stage_writes_its_product),
      cmocka_unit_test(a_run_goes_on_up_to_its_stage), cmocka_unit_test(a_folder_that_is_not_there_is_told)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
