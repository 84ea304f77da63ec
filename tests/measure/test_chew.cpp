// SPDX-License-Identifier: AGPL-3.0-or-later
// Chew's algorithm on a box of four regions whose interfaces are coarser than the size field: on 1, 2 and 3 ranks the
// same regions, and each face on a partition plane has its two sides. Runs chew_interfaces, chew_points, chew_exchange,
// chew_fill and chew_domain.
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

extern "C" {
#include "chew_domain.h"
#include "mesher/common/vec.h"
#include "mesher/region/region_file.h"
}

#include "divided_box.h"
#include "launch.h"

static const int REGIONS = 4;

static double finer_size(const void *, const double *) {
  return 1.7e-3;
}

// The surfaces of the box, with its interfaces as planned and refined alike.
struct Surfaces {
  Box box{3};
  DomainSurfaces &boundary = box.boundary;

  Surfaces() {
    make_surfaces(box);
    CwInterfaceTriangles &refined = boundary.interfaces.refined, &planned = boundary.interfaces.planned;
    planned.count = refined.count;
    planned.triangle = static_cast<int32_t(*)[3]>(malloc(size_t(refined.count) * sizeof *planned.triangle));
    planned.region = static_cast<int32_t(*)[2]>(malloc(size_t(refined.count) * sizeof *planned.region));
    memcpy(planned.triangle, refined.triangle, size_t(refined.count) * sizeof *planned.triangle);
    memcpy(planned.region, refined.region, size_t(refined.count) * sizeof *planned.region);
    boundary.input.size_at = finer_size;
  }
};

// A point over the middle of a triangle splits it: the new points lie on the plane, and the sphere that still holds the
// point is final. Asked again nothing changes.
static void a_split_is_as_good_as_can_be_had(void **) {
  Surfaces surfaces;
  const CwRegionInput from = surfaces.boundary.regions();
  CwChewInterface interface;
  CwChewSphere *sphere = nullptr;
  int32_t count = 0, space = 0, added;
  check(cw_chew_interface_make(&from, 0, &interface));
  check(cw_chew_interface_spheres(&interface, 0, &sphere, &count, &space));
  int planned = interface.point_count, triangles = interface.triangle_count, widest = 0;
  assert_int_equal(count, triangles);
  for (int k = 0; k < count; k++) widest = sphere[k].radius > sphere[widest].radius ? k : widest;
  CwChewAsked asked = {};
  for (int k = 0; k < 3; k++)
    asked.x[k] = sphere[widest].centre[k] + 0.5 * sphere[widest].radius * interface.map.axis[2][k];
  for (int again = 0; again < 2; again++) {
    check(cw_chew_interface_split(&from, 1, &asked, &interface, &added));
    if (again) assert_int_equal(added, 0);
    if (!again) assert_true(added > 0);
    assert_int_equal(interface.triangle_count, triangles + 2 * (interface.point_count - planned));
  }
  for (int p = planned; p < interface.point_count; p++) {
    double d[3];
    cw_sub(interface.x[p], interface.map.origin, d);
    assert_near(cw_dot(d, interface.map.axis[2]), 0, 1e-15);
  }
  count = 0;
  check(cw_chew_interface_spheres(&interface, 0, &sphere, &count, &space));
  for (int k = 0; k < count; k++) {
    double d[3];
    cw_sub(asked.x, sphere[k].centre, d);
    assert_int_equal(cw_dot(d, d) < sphere[k].radius * sphere[k].radius, interface.final[sphere[k].triangle]);
  }
  free(sphere);
  cw_chew_interface_free(&interface);
}

static int be_a_rank(int argc, char **argv) {
  CwTeam *all = nullptr;
  std::string folder = argv[1];
  if (begin_as_rank(&argc, &argv, &all) != CW_OK) return 1;
  Surfaces surfaces;
  const CwRegionInput from = surfaces.boundary.regions();
  const double cost[REGIONS] = {4, 3, 2, 1};
  const CwChewBounds bounds = {0.71, 1.4};
  CwChewOwners owners;
  CwChewFigures figures;
  check(cw_chew_owners_make(&surfaces.boundary.interfaces, REGIONS, cost, &owners));
  check(cw_chew_domain(&from, &owners, &bounds, "box", folder.c_str(), &figures));
  cw_chew_sum(&owners, &figures);
  if (owners.rank == 0) {
    printf(" ROUNDS %lld INSERTED %lld MESSAGES %lld SENT %lld BYTES %lld\n", (long long)figures.rounds,
           (long long)figures.inserted, (long long)figures.traffic.messages, (long long)figures.traffic.sent_messages,
           (long long)figures.traffic.bytes);
  }
  cw_chew_owners_free(&owners);
  return end_as_rank(all, 0);
}

// A face of shared points: how often it is seen from each side.
struct Side {
  std::array<std::array<double, 3>, 3> x;
  int seen[2] = {0, 0};
};
using Faces = std::map<std::array<int64_t, 3>, Side>;

// Faces of the region with one tetrahedron whose points are all shared.
static void add_open_faces(const CwRegionMesh &mesh, Faces &faces) {
  static const int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const CwRegionData &data = mesh.cells;
  Faces own;
  for (int t = 0; t < data.tetrahedron_count; t++) {
    for (auto &corners : face) {
      std::array<int, 3> p;
      for (int k = 0; k < 3; k++) p[size_t(k)] = data.tetrahedra[t][corners[k]];
      if (p[0] >= data.shared_count || p[1] >= data.shared_count || p[2] >= data.shared_count) continue;
      while (data.shared_id[p[0]] > data.shared_id[p[1]] || data.shared_id[p[0]] > data.shared_id[p[2]])
        p = {p[1], p[2], p[0]};
      int back = data.shared_id[p[1]] > data.shared_id[p[2]];
      if (back) std::swap(p[1], p[2]);
      Side &side = own[{data.shared_id[p[0]], data.shared_id[p[1]], data.shared_id[p[2]]}];
      side.seen[back]++;
      for (size_t k = 0; k < 3; k++) memcpy(side.x[k].data(), data.points[p[k]], sizeof side.x[k]);
    }
  }
  for (auto &[key, side] : own) {
    if (side.seen[0] + side.seen[1] == 2) continue; // inside
    Side &all = faces.emplace(key, Side{side.x, {0, 0}}).first->second;
    assert_true(all.x == side.x);
    for (int k = 0; k < 2; k++) all.seen[k] += side.seen[k];
  }
}

static std::vector<char> bytes_of(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

static void any_number_of_ranks_makes_the_same(void **) {
  std::vector<std::vector<char>> first;
  int lines, messages[4] = {}, rounds[4] = {}, inserted[4] = {}, bytes[4] = {};
  for (int ranks = 1; ranks <= 3; ranks++) {
    TemporaryFolder folder;
    launch_well(ranks, folder.path.c_str());
    rounds[ranks] = sum_of(" ROUNDS ", &lines);
    inserted[ranks] = sum_of(" INSERTED ", &lines);
    messages[ranks] = sum_of(" MESSAGES ", &lines);
    bytes[ranks] = sum_of(" BYTES ", &lines);
    assert_int_equal(sum_of(" SENT ", &lines) > 0, ranks > 1);
    assert_true(rounds[ranks] > 1 && inserted[ranks] > 20 && bytes[ranks] > 0);
    assert_int_equal(messages[ranks], 12 * rounds[ranks]); // six pairs of regions
    for (int *of : {rounds, inserted, messages, bytes}) assert_int_equal(of[ranks], of[1]);
    Faces faces;
    for (int r = 1; r <= REGIONS; r++) {
      std::string path = folder.path + "/box-000" + std::to_string(r) + ".h5";
      CwRegionMesh mesh;
      check(cw_region_read(path.c_str(), &mesh));
      add_open_faces(mesh, faces);
      cw_region_free(&mesh);
      std::vector<char> made = bytes_of(path);
      assert_true(made.size() > 1000);
      if (ranks == 1) first.push_back(made);
      assert_true(made == first[size_t(r - 1)]);
      remove(path.c_str());
    }
    int interfaces = 0;
    for (auto &[key, side] : faces) { // others are of the layer top or of open patches, along the planes
      interfaces += side.seen[0] && side.seen[1];
      assert_true(side.seen[0] < 2 && side.seen[1] < 2);
    }
    assert_true(interfaces > 100);
  }
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_split_is_as_good_as_can_be_had),
      cmocka_unit_test(any_number_of_ranks_makes_the_same),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
