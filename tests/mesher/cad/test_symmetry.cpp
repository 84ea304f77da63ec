// SPDX-License-Identifier: AGPL-3.0-or-later
// A tank with n equal sides and a hub in its middle: its symmetry, a fan over it, and its regions as turned copies.
#include <cmath>
#include <cstring>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Shell.hxx>
#include <gp_Ax1.hxx>
#include <gp_Ax3.hxx>
#include <gp_Pln.hxx>

extern "C" {
#include "mesher/cad/symmetry.h"
#include "mesher/plan/fan.h"
#include "mesher/region/audit.h"
#include "mesher/region/region_copy.h"
#include "mesher/region/region_number.h"
#include "mesher/skeleton/skeleton.h"
}

#include "shared_points.h"

static double even_size(const void *, const double *) {
  return 4e-3;
}

static void check(CwStatus status) {
  if (status != CW_OK) fail_msg("status %d: %s", status, cw_fail_message());
}

// Casing: a prism with n sides, 40 mm to its corners, z = 0 to 40 mm. Hub: a frustum on its floor, 20 mm to the corners
// below, 14 mm above, 15 mm high; on its top the flow meets the axis. The floor is cut into one face a side.
static TopoDS_Shape tank(int n) {
  const double outer = 40, low = 20, high = 14, top = 40, nose = 15, pitch = 2 * M_PI / n;
  struct Ring {
    double r, z;
    std::vector<TopoDS_Vertex> vertex;
    std::vector<TopoDS_Edge> edge;
  } ring[4] = {{outer, top, {}, {}}, {outer, 0, {}, {}}, {low, 0, {}, {}}, {high, nose, {}, {}}};
  const auto at = [](const Ring &of, double angle) {
    return gp_Pnt(of.r * std::cos(angle), of.r * std::sin(angle), of.z);
  };
  for (Ring &of : ring) {
    for (int k = 0; k < n; k++) of.vertex.push_back(BRepBuilderAPI_MakeVertex(at(of, k * pitch)));
    for (int k = 0; k < n; k++) of.edge.push_back(BRepBuilderAPI_MakeEdge(of.vertex[k], of.vertex[(k + 1) % n]));
  }
  BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (int r = 0; r < 3; r++) { // side of the casing, floor, side of the hub; normals out of the fluid
    std::vector<TopoDS_Edge> down;
    for (int k = 0; k < n; k++) down.push_back(BRepBuilderAPI_MakeEdge(ring[r].vertex[k], ring[r + 1].vertex[k]));
    const gp_Pnt a = at(ring[r], 0), b = at(ring[r], pitch), c = at(ring[r + 1], 0);
    const gp_Vec along(a, b), normal = gp_Vec(a, c).Crossed(along);
    for (int k = 0; k < n; k++) {
      gp_Ax3 axes(a, gp_Dir(normal), gp_Dir(along));
      axes.Rotate(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), k * pitch);
      BRepBuilderAPI_MakeWire wire(ring[r].edge[k], down[(k + 1) % n], ring[r + 1].edge[k], down[k]);
      builder.Add(shell, BRepBuilderAPI_MakeFace(gp_Pln(axes), wire.Wire(), true).Face());
    }
  }
  for (int end = 0; end < 2; end++) { // the water's face above, the hub's top below
    const Ring &of = ring[end ? 3 : 0];
    BRepBuilderAPI_MakeWire wire;
    for (int k = 0; k < n; k++) wire.Add(of.edge[k]);
    const gp_Ax3 axes(gp_Pnt(0, 0, of.z), gp_Dir(0, 0, end ? -1 : 1), gp_Dir(1, 0, 0));
    builder.Add(shell, BRepBuilderAPI_MakeFace(gp_Pln(axes), wire.Wire(), true).Face());
  }
  shell.Closed(true);
  return BRepBuilderAPI_MakeSolid(shell).Solid();
}

// `odd`: the patch of one side of the casing has another name.
static CwCad *open_tank(int n, bool odd = false) {
  return open_solid(tank(n), [=](const TopoDS_Face &face) -> std::string {
    const gp_Ax3 axes = BRepAdaptor_Surface(face).Plane().Position();
    if (axes.Direction().Z() > 0.99) return "water,inlet";
    const bool first_side = std::fabs(axes.Direction().Z()) < 0.01 && axes.Location().Y() == 0;
    return odd && first_side ? "odd,wall" : "side,wall";
  });
}

struct Tank {
  int n;
  CwCad *cad;
  CwBackground background;
  CwInside *inside = nullptr;
  CwSymmetry *symmetry = nullptr;
  std::vector<CwPlanNode> node;
  std::vector<double> none;
  CwPlan plan;
  CwSkeleton skeleton = {};

  // Plane 0 at z = 8 mm through the hub; `wedges` half-planes in each pitch; `divided`: a plane across each wedge, 24
  // mm from the axis, whose lines on the half-planes before and after differ.
  Tank(int turns, int wedges, bool divided = false) : n(turns), cad(open_tank(turns)) {
    check(cw_background_make(cad, 1e-4, 0.2, &background));
    check(
        cw_inside_make(background.point_count, background.x, background.triangle_count, background.triangle, &inside));
    check(cw_symmetry_find(cad, &background, &symmetry));
    const int count = n * wedges, first = 1 + count, each = divided ? 2 : 1;
    const auto wedge = [=](int j) { return divided ? first + j : -2 - j; };
    node.push_back({{{0, 0, -1}, -0.008}, -1, {-1, 1}});
    for (int j = 0; j < count; j++) {
      const double angle = 0.3 * 2 * M_PI / n + j * 2 * M_PI / count;
      node.push_back({{{-std::sin(angle), std::cos(angle), 0}, 0}, 0, {wedge((j + count - 1) % count), wedge(j)}});
    }
    for (int j = 0; divided && j < count; j++) {
      const double angle = 0.3 * 2 * M_PI / n + (j + 0.5) * 2 * M_PI / count + 0.05;
      node.push_back({{{std::cos(angle), std::sin(angle), 0}, 0.024}, 1 + j, {-2 - 2 * j, -3 - 2 * j}});
    }
    none.assign(node.size(), 0);
    plan = {(int)node.size(), 1 + each * count, node.data(), none.data(), none.data(), 1, count, 1, n};
    skeleton.cad = cad;
    skeleton.plan = &plan;
    skeleton.size_at = even_size;
    check(cw_network_make(cad, &background, inside, &plan, &skeleton.network));
    skeleton.orbits.symmetry = symmetry;
  }
  ~Tank() {
    cw_skeleton_free(&skeleton);
    cw_symmetry_free(&symmetry);
    cw_inside_free(&inside);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
};

static int turns_of(CwCad *cad) {
  CwBackground background;
  CwSymmetry *symmetry;
  check(cw_background_make(cad, 1e-4, 0.2, &background));
  check(cw_symmetry_find(cad, &background, &symmetry));
  const int count = symmetry ? symmetry->count : 1;
  cw_symmetry_free(&symmetry);
  cw_background_free(&background);
  cw_cad_close(&cad);
  return count;
}

static void turns_are_counted(void **) {
  assert_int_equal(turns_of(open_tank(5)), 5);
  assert_int_equal(turns_of(open_tank(6)), 6);
  assert_int_equal(turns_of(open_tank(6, true)), 1);
  const auto box = [](const TopoDS_Face &) -> std::string { return "side,wall"; };
  assert_int_equal(turns_of(open_solid(BRepPrimAPI_MakeBox(40, 30, 20).Shape(), box)), 1); // the axis at its edge
}

// Each turning face stands for n, the two across the axis for themselves; the first ones have edges in common.
static void faces_form_orbits(void **) {
  Tank tank(6, 1);
  const CwOrbits &face = tank.symmetry->face;
  int fixed = 0, firsts = 0;
  for (int f = 0; f < cw_cad_face_count(tank.cad); f++) {
    fixed += face.next[f] == f;
    firsts += face.first[f] == f;
    assert_int_equal(cw_orbits_turned(&face, face.first[f], face.turns[f]), f);
    assert_int_equal(cw_orbits_turned(&face, f, 6), f);
    assert_int_equal(cw_orbits_size(&face, 6, f), face.next[f] == f ? 1 : 6);
  }
  assert_int_equal(fixed, 2);
  assert_int_equal(firsts, 5);
  int joints = 0;
  for (int e = 0; e < cw_cad_edge_count(tank.cad); e++) {
    int sides[2];
    cw_cad_edge_faces(tank.cad, e, sides);
    joints += face.first[sides[0]] == sides[0] && face.first[sides[1]] == sides[1];
  }
  assert_int_equal(joints, 4); // water - casing - floor - hub - its top
}

static void orbits_of_odd_lengths_are_refused(void **) {
  CwOrbits orbits;
  const auto made = [&](std::vector<int32_t> next, int count, int allow_fixed) {
    int32_t *copy = (int32_t *)malloc(next.size() * sizeof *copy);
    memcpy(copy, next.data(), next.size() * sizeof *copy);
    CwStatus status = cw_orbits_make((int32_t)next.size(), copy, count, allow_fixed, &orbits);
    if (status == CW_OK) cw_orbits_free(&orbits);
    return status;
  };
  assert_int_equal(made({1, 2, 0}, 3, 0), CW_OK);
  assert_int_equal(made({1, 2, 0, 3}, 3, 1), CW_OK);
  assert_int_equal(made({1, 2, 0, 3}, 3, 0), CW_RETRY);
  assert_int_equal(made({1, 2, 0}, 6, 1), CW_RETRY);
  assert_int_equal(made({1, 0}, 3, 1), CW_RETRY);
  assert_int_equal(made({1, 2, 1}, 3, 1), CW_RETRY); // two items come to one
  assert_int_equal(made({1, -1, 0}, 3, 1), CW_RETRY);
}

// Points by angle and height, against the fan's own answer.
static void fan_divides_by_angle(void **) {
  for (int n : {3, 5, 6}) {
    Tank tank(n, 2), divided(n, 2, true);
    const double first = 0.3 * 2 * M_PI / n, width = M_PI / n;
    for (int i = 0; i < 1000; i++) {
      const double angle = first + 2 * M_PI * (i + 0.5) / 1000, r = 0.02 + 1e-5 * i, z = i % 2 ? 0.005 : 0.02;
      const double x[3] = {r * std::cos(angle), r * std::sin(angle), z};
      const int wedge = (int)((angle - first) / width), region = z > 0.008 ? 0 : 1 + wedge;
      assert_int_equal(cw_plan_locate(&tank.plan, x), region);
      for (int other = 0; other < tank.plan.region_count; other++) {
        assert_int_equal(cw_plan_in_region(&tank.plan, other, x, 0), other == region);
      }
      double turned[3];
      cw_symmetry_turn(n, 1, x, turned);
      assert_int_equal(cw_plan_locate(&tank.plan, turned), cw_fan_turned_region(&tank.plan, n, 1, region));
      assert_int_equal(cw_fan_first_region(&tank.plan, n, region), region == 0 ? 0 : 1 + wedge % 2);
      const int beyond = region > 0 && cw_plane_distance(&divided.node[1 + 2 * n + wedge].plane, x) > 0;
      const int half = region == 0 ? 0 : 1 + 2 * wedge + beyond;
      assert_int_equal(cw_plan_locate(&divided.plan, x), half);
      for (int other = 0; other < divided.plan.region_count; other++) {
        assert_int_equal(cw_plan_in_region(&divided.plan, other, x, 0), other == half);
      }
      assert_int_equal(cw_plan_locate(&divided.plan, turned), cw_fan_turned_region(&divided.plan, n, 1, half));
      assert_int_equal(cw_fan_first_region(&divided.plan, n, half), half == 0 ? 0 : 1 + (half - 1) % 4);
    }
  }
}

// Both half-planes beside a wedge bound what lies in it; no plane of another wedge does.
static void wedges_have_two_half_planes(void **) {
  Tank tank(5, 1, true);
  for (int j = 0; j < 5; j++) {
    int bounds = 0, node = 6 + j;
    for (CwPlanBound b = cw_plan_bound(&tank.plan, node); b.node >= 0; b = cw_plan_next_bound(&tank.plan, b)) bounds++;
    assert_int_equal(bounds, 3);
    for (int other = 0; other <= 10; other++) {
      const bool bounding = other == 0 || other == 1 + j || other == 1 + (j + 1) % 5;
      assert_int_equal(cw_plan_is_ancestor(&tank.plan, other, node), bounding);
    }
    assert_int_equal(cw_fan_turned_node(&tank.plan, 5, 1, node), 6 + (j + 1) % 5);
  }
}

static void network_is_its_own_copy(void **) {
  Tank tank(5, 2, true);
  CwSkeleton &skeleton = tank.skeleton;
  check(cw_orbit_network(&skeleton.network, &skeleton.orbits));
  const CwOrbits &orbits = skeleton.orbits.curve;
  for (int i = 0; i < skeleton.network.curve_count; i++) {
    const CwCurve &curve = skeleton.network.curve[i], &first = skeleton.network.curve[orbits.first[i]];
    assert_int_equal(curve.fine_count, first.fine_count);
    for (int k = 0; k < curve.fine_count; k++) {
      double turned[3];
      cw_symmetry_turn(5, orbits.turns[i], first.fine_x[k], turned);
      assert_memory_equal(turned, curve.fine_x[k], sizeof turned);
    }
    for (int s = 0; s <= 4; s++) { // still on its edges, faces and planes
      double x[3], parameter[2];
      cw_curve_point(&skeleton.network, &curve, curve.fine_length[curve.fine_count - 1] * s / 4, x, parameter);
      for (int p : curve.plane) {
        if (p >= 0) assert_near(cw_plane_distance(&tank.node[p].plane, x), 0, 1e-12);
      }
    }
  }
}

// A plan whose half-planes do not repeat with the solid.
static void uneven_plans_are_told(void **) {
  Tank tank(6, 1);
  cw_network_free(&tank.skeleton.network);
  const double angle = 0.33 * 2 * M_PI / 6;
  tank.node[1].plane = {{-std::sin(angle), std::cos(angle), 0}, 0};
  check(cw_network_make(tank.cad, &tank.background, tank.inside, &tank.plan, &tank.skeleton.network));
  assert_int_equal(cw_orbit_network(&tank.skeleton.network, &tank.skeleton.orbits), CW_RETRY);
}

// All regions, the copies too, are audited; together they are as large as the tank; shared points agree to the last
// bit.
static void fill_the_tank(bool divided) {
  Tank tank(5, 1, divided);
  CwSkeleton &skeleton = tank.skeleton;
  const CwSkeletonOrbits &orbits = skeleton.orbits;
  const int faces = cw_cad_face_count(tank.cad);
  std::vector<void *> walls(faces, nullptr), caps(faces, nullptr), interfaces;
  int64_t size;
  check(cw_orbit_network(&skeleton.network, &skeleton.orbits));
  check(cw_skeleton_wall_curves(&skeleton));
  for (int f = 0; f < faces; f++) {
    if (orbits.symmetry->face.first[f] != f) continue;
    if (cw_face_is_wall(tank.cad, f)) check(cw_skeleton_mesh_wall(&skeleton, f, &walls[f], &size));
  }
  check(cw_skeleton_merge_walls(&skeleton, walls.data()));
  std::vector<double> target(skeleton.wall_count, 1.5e-3), first(skeleton.wall_count, 2e-4),
      growth(skeleton.wall_count, 1.5);
  check(cw_skeleton_grow(&skeleton, &tank.background, target.data(), nullptr, nullptr));
  check(cw_skeleton_free_curves(&skeleton));
  for (int f = 0; f < faces; f++) {
    if (orbits.symmetry->face.first[f] != f) continue;
    if (!cw_face_is_wall(tank.cad, f)) check(cw_skeleton_mesh_cap(&skeleton, f, &caps[f], &size));
  }
  assert_int_equal(skeleton.outline_count, divided ? 30 : 10);
  interfaces.resize(skeleton.outline_count, nullptr);
  for (int i = 0; i < skeleton.outline_count; i++) {
    if (orbits.outline.first[i] == i) check(cw_skeleton_mesh_interface(&skeleton, i, &interfaces[i], &size));
  }
  check(cw_skeleton_merge_inner(&skeleton, caps.data(), interfaces.data()));
  for (int v = 0; v < skeleton.wall_count; v++) {
    const int next = cw_orbit_node(&orbits, v, 1);
    if (next < 0) continue;
    double turned[3];
    cw_symmetry_turn(5, 1, skeleton.front[v], turned);
    for (int k = 0; k < 3; k++) assert_near(turned[k], skeleton.front[next][k], 1e-15);
    assert_int_equal(cw_orbit_node(&orbits, v, 5), v);
  }

  const int regions = tank.plan.region_count;
  int pair_count, colours;
  std::vector<int> number(regions);
  int32_t(*pair)[2];
  check(cw_skeleton_adjacency(&skeleton, &pair_count, &pair));
  assert_int_equal(pair_count, divided ? 30 : 10);
  check(cw_region_numbers(regions, pair_count, pair, number.data(), nullptr, &colours));
  CwRegionContext context = {};
  context.skeleton = &skeleton;
  context.domain = "tank";
  context.layer_count = 4;
  context.growth = growth.data();
  context.first_height = first.data();
  check(cw_region_context_make(&context));
  double volume = 0;
  SharedPoints shared;
  CwRegionMesh first_mesh[2], mesh;
  const int each = (regions - 1) / 5; // regions of a wedge
  for (int r = 0; r < each; r++) check(cw_region_build(&context, 1 + r, number[1 + r], &first_mesh[r]));
  for (int r = 0; r < regions; r++) {
    CwQuality quality;
    if (r <= each) {
      check(cw_region_build(&context, r, number[r], &mesh));
    } else {
      char fingerprint[33];
      const CwRegionMesh &source = first_mesh[(r - 1) % each];
      cw_region_copy_fingerprint(&context, &source, (r - 1) / each, fingerprint);
      check(cw_region_copy(&context, &source, (r - 1) / each, number[r], fingerprint, &mesh));
      assert_string_equal(mesh.fingerprint, fingerprint);
      assert_string_not_equal(mesh.fingerprint, source.fingerprint);
    }
    assert_int_equal(mesh.region, r + 1);
    check(cw_audit_region(&mesh, &quality));
    volume += quality.volume;
    for (int i = 0; i < mesh.point_count; i++) { // every point lies in its own region
      assert_true(cw_plan_in_region(&tank.plan, r, mesh.x[i], 1e-9));
    }
    shared.add(mesh);
    cw_region_free(&mesh);
  }
  for (int r = 0; r < each; r++) cw_region_free(&first_mesh[r]);
  assert_near(volume / solid_volume(tank.cad), 1, 1e-12);
  shared.check(context.shared_count);

  cw_region_context_free(&context);
  free(pair);
  for (void *bytes : walls) free(bytes);
  for (void *bytes : caps) free(bytes);
  for (void *bytes : interfaces) free(bytes);
}

static void copies_fill_the_tank(void **) {
  fill_the_tank(false);
  fill_the_tank(true);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(turns_are_counted),
      cmocka_unit_test(faces_form_orbits),
      cmocka_unit_test(orbits_of_odd_lengths_are_refused),
      cmocka_unit_test(fan_divides_by_angle),
      cmocka_unit_test(wedges_have_two_half_planes),
      cmocka_unit_test(network_is_its_own_copy),
      cmocka_unit_test(uneven_plans_are_told),
      cmocka_unit_test(copies_fill_the_tank),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
