// SPDX-License-Identifier: AGPL-3.0-or-later
// A box on its way from curve network to audited regions, with dividing planes placed by hand.
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>
#include <gp_Pnt.hxx>

extern "C" {
#include "mesher/audit.h"
#include "mesher/region_build.h"
#include "mesher/region_number.h"
#include "mesher/skeleton.h"
}

#include "solids.h"

static double even_size(const void *, const double *) {
  return 2.5e-3;
}

// A box of 40 x 30 x 20 mm with inlet at x = 0 and outlet at x = 40. Plane 0: x = 21. Plane 1, behind it: y = 14, a
// little askew. Plane 2, before it: z = 9.
struct Box {
  CwCad *cad;
  CwBackground background;
  CwInside *inside = nullptr;
  CwPlanNode node[3];
  double none[4] = {0, 0, 0, 0};
  CwPlan plan;
  CwSkeleton skeleton;

  explicit Box(int nodes)
      : cad(open_solid(BRepPrimAPI_MakeBox(40, 30, 20).Shape(), [](const TopoDS_Face &face) -> std::string {
          BRepAdaptor_Surface surface(face);
          double x = surface.Value(0.5, 0.5).X(), y = surface.Value(0.6, 0.7).X();
          if (std::fabs(x - y) > 1e-9) return "side,wall";
          if (std::fabs(x) < 1e-9) return "in,inlet";
          return "out,outlet";
        })) {
    double tilt = 0.1, c = std::cos(tilt), s = std::sin(tilt);
    node[0] = {{{1, 0, 0}, 0.021}, -1, {-1, -2}};
    node[1] = {{{s, c, 0}, 0.014 * c + 0.030 * s}, 0, {-2, -3}};
    node[2] = {{{0, 0, 1}, 0.009}, 0, {-1, -4}};
    if (nodes >= 2) node[0].child[1] = 1;
    if (nodes >= 3) node[0].child[0] = 2;
    plan = {nodes, nodes + 1, node, none, none, 0, 0, 0};
    assert_int_equal(cw_background_make(cad, 1e-4, 0.2, &background), CW_OK);
    assert_int_equal(cw_inside_make(background.point_count, background.x, background.triangle_count,
                                    background.triangle, &inside),
                     CW_OK);
    skeleton = {};
    skeleton.cad = cad;
    skeleton.plan = &plan;
    skeleton.size_at = even_size;
    check(cw_network_make(cad, &background, inside, &plan, &skeleton.network));
  }
  ~Box() {
    cw_skeleton_free(&skeleton);
    cw_inside_free(&inside);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
  static void check(CwStatus status) {
    if (status != CW_OK) fail_msg("%s", cw_fail_message());
  }
  int count(CwCurveKind kind) const {
    int found = 0;
    for (int i = 0; i < skeleton.network.curve_count; i++) found += skeleton.network.curve[i].kind == kind;
    return found;
  }
};

// One plane: four edges of the box are cut in two; four cuts. A second plane on one side: two more edges, three cuts of
// its own, two cuts of the first divided, one line. A third on the other side likewise, and where both lines cross on the
// first plane each is divided: two pieces of each.
static void network_of_a_box(void **) {
  {
    Box box(1);
    assert_int_equal(box.count(CW_CURVE_EDGE), 16);
    assert_int_equal(box.count(CW_CURVE_CUT), 4);
    assert_int_equal(box.count(CW_CURVE_LINE), 0);
    assert_int_equal(box.skeleton.network.corner_count, 12);
  }
  {
    Box box(2);
    assert_int_equal(box.count(CW_CURVE_EDGE), 18);
    assert_int_equal(box.count(CW_CURVE_CUT), 9);
    assert_int_equal(box.count(CW_CURVE_LINE), 1);
    assert_int_equal(box.skeleton.network.corner_count, 16);
  }
  {
    Box box(3);
    assert_int_equal(box.count(CW_CURVE_EDGE), 20);
    assert_int_equal(box.count(CW_CURVE_CUT), 14);
    assert_int_equal(box.count(CW_CURVE_LINE), 4);
    assert_int_equal(box.skeleton.network.corner_count, 21);
  }
}

static void curves_lie_on_their_planes(void **) {
  Box box(3);
  for (int i = 0; i < box.skeleton.network.curve_count; i++) {
    const CwCurve &curve = box.skeleton.network.curve[i];
    for (int s = 0; s <= 10; s++) {
      double x[3], parameter[2];
      cw_curve_point(&box.skeleton.network, &curve, curve.fine_length[curve.fine_count - 1] * s / 10, x, parameter);
      for (int p : curve.plane) {
        if (p >= 0) assert_near(cw_plane_distance(&box.node[p].plane, x), 0, 1e-12);
      }
    }
  }
}

// Regions of the whole box: audited, together as large as the box, with shared points that agree to the last bit.
static void regions_fill_the_box(void **) {
  Box box(3);
  CwSkeleton &skeleton = box.skeleton;
  int faces = cw_cad_face_count(box.cad);
  std::vector<void *> walls(faces, nullptr), caps(faces, nullptr), interfaces;
  int64_t size;
  Box::check(cw_skeleton_wall_curves(&skeleton));
  for (int f = 0; f < faces; f++) {
    if (cw_face_is_wall(box.cad, f)) Box::check(cw_skeleton_mesh_wall(&skeleton, f, &walls[f], &size));
  }
  Box::check(cw_skeleton_merge_walls(&skeleton, walls.data()));
  std::vector<double> target(skeleton.wall_count, 1.5e-3), first(skeleton.wall_count, 2e-4);
  Box::check(cw_skeleton_grow(&skeleton, &box.background, target.data()));
  for (int v = 0; v < skeleton.wall_count; v++) { // corners and edges of a box keep the asked height to the walls
    for (int k = 1; k < 3; k++) {
      double side = k == 1 ? 0.030 : 0.020, x = skeleton.front[v][k];
      assert_true(x > 1.5e-3 - 1e-9 && x < side - 1.5e-3 + 1e-9);
    }
  }
  Box::check(cw_skeleton_free_curves(&skeleton));
  for (int f = 0; f < faces; f++) {
    if (!cw_face_is_wall(box.cad, f)) Box::check(cw_skeleton_mesh_cap(&skeleton, f, &caps[f], &size));
  }
  assert_int_equal(skeleton.outline_count, 6); // four pieces of plane 0, one of each other
  interfaces.resize(skeleton.outline_count);
  for (int i = 0; i < skeleton.outline_count; i++) {
    Box::check(cw_skeleton_mesh_interface(&skeleton, i, &interfaces[i], &size));
  }
  Box::check(cw_skeleton_merge_inner(&skeleton, caps.data(), interfaces.data()));

  int pair_count, colours, number[4];
  int32_t(*pair)[2];
  Box::check(cw_skeleton_adjacency(&skeleton, &pair_count, &pair));
  assert_int_equal(pair_count, 6); // all four regions touch one another on plane 0
  Box::check(cw_region_numbers(4, pair_count, pair, number, nullptr, &colours));
  CwRegionContext context = {};
  context.skeleton = &skeleton;
  context.domain = "box";
  context.layer_count = 4;
  std::vector<double> growth(skeleton.wall_count, 1.5);
  context.growth = growth.data();
  context.first_height = first.data();
  Box::check(cw_region_context_make(&context));
  double volume = 0;
  std::map<int64_t, std::vector<double>> shared;
  std::map<int64_t, int> held;
  for (int r = 0; r < 4; r++) {
    CwRegionMesh mesh;
    CwQuality quality;
    Box::check(cw_region_build(&context, r, number[r], &mesh));
    Box::check(cw_audit_region(&mesh, &quality));
    assert_int_equal(mesh.prism_count % 4, 0);
    volume += quality.volume;
    for (int i = 0; i < mesh.shared_count; i++) {
      std::vector<double> x(mesh.x[i], mesh.x[i] + 3);
      auto found = shared.emplace(mesh.shared_id[i], x);
      assert_memory_equal(found.first->second.data(), x.data(), sizeof(double[3]));
      held[mesh.shared_id[i]]++;
    }
    cw_region_free(&mesh);
  }
  assert_near(volume / (0.04 * 0.03 * 0.02), 1, 1e-12);
  assert_int_equal(shared.size(), context.shared_count);
  assert_int_equal(shared.rbegin()->first, context.shared_count - 1);
  for (const auto &point : held) assert_true(point.second >= 2);

  cw_region_context_free(&context);
  free(pair);
  for (void *bytes : walls) free(bytes);
  for (void *bytes : caps) free(bytes);
  for (void *bytes : interfaces) free(bytes);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(network_of_a_box),
      cmocka_unit_test(curves_lie_on_their_planes),
      cmocka_unit_test(regions_fill_the_box),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
