// SPDX-License-Identifier: AGPL-3.0-or-later
// The walls of a box and of a tank of equal passages, and the open patches of the box, against their exact shapes.
extern "C" {
#include "mesher/boundary/boundary_curves.h"
}

#include "bow_tie.h"
#include "divided_box.h"
#include "tank_surfaces.h"

static const double SIDE[3] = {0.040, 0.030, 0.020}; // of the box, m

// The axis that a face of the box stands across; *far: whether it is the one away from the origin.
static int axis_of(const CwCad *cad, int face, bool *far) {
  const double uv[2] = {1e-3, 2e-3};
  double n[3];
  cw_cad_face_normal(cad, face, uv, n);
  for (int k = 0; k < 3; k++) {
    if (std::fabs(n[k]) < 0.5) continue;
    *far = n[k] > 0;
    return k;
  }
  fail_msg("face %d has no axis", face);
  return -1;
}

// Twice the area of a triangle that lies on a face of the box, with its normal outwards.
static double area_on_face(const CwCad *cad, int face, const double (*x)[3], const int32_t *corner) {
  bool far = false;
  double n[3];
  const int axis = axis_of(cad, face, &far);
  for (int k = 0; k < 3; k++) assert_near(x[corner[k]][axis], far ? SIDE[axis] : 0, 1e-12);
  cw_normal(x[corner[0]], x[corner[1]], x[corner[2]], n);
  assert_true((n[axis] > 0) == far);
  return std::fabs(n[axis]);
}

static void middle_of(const double (*x)[3], const int32_t *corner, double middle[3]) {
  for (int k = 0; k < 3; k++) middle[k] = (x[corner[0]][k] + x[corner[1]][k] + x[corner[2]][k]) / 3;
}

// The triangles of each wall cover it once, the right way round, and are divided among the regions at the planes. The
// vertices of the wall curves come first, as they are; nothing holds the others.
static void walls_are_covered(void **) {
  Box box(3);
  make_walls(box);
  const CwSurfaceMesh &surface = box.boundary.surface;
  const CwWallCurves &curves = box.boundary.wall_curves;
  std::vector<double> area(cw_cad_face_count(box.cad), 0);
  for (int t = 0; t < surface.triangle_count; t++) {
    double middle[3];
    area[surface.face[t]] += area_on_face(box.cad, surface.face[t], surface.x, surface.triangle[t]) / 2;
    middle_of(surface.x, surface.triangle[t], middle);
    assert_int_equal(surface.region[t], cw_plan_locate(&box.plan, middle));
    assert_int_equal(surface.source[t], t);
  }
  for (size_t f = 0; f < area.size(); f++) {
    bool far = false;
    const int axis = axis_of(box.cad, (int)f, &far);
    assert_near(area[f], axis == 0 ? 0 : SIDE[0] * SIDE[3 - axis], 1e-15); // no wall across x
  }
  assert_memory_equal(surface.x, curves.x, curves.vertex_count * sizeof *curves.x);
  for (int v = 0; v < surface.vertex_count; v++) {
    const CwConstraint none = {CW_CONSTRAINT_NONE, -1};
    const CwConstraint wanted = v < curves.vertex_count ? curves.constraint[v] : none;
    assert_int_equal(surface.constraint[v].kind, wanted.kind);
    assert_int_equal(surface.constraint[v].index, wanted.index);
  }
}

// Meshes the walls of a box without planes, and joins them by a plan with one plane across x.
static void join_with_plane(Box &box, double offset) {
  DomainSurfaces &boundary = box.boundary;
  std::vector<void *> bytes(cw_cad_face_count(box.cad), nullptr);
  int64_t size;
  check(cw_wall_curves_make(NULL, &boundary.input, &boundary.open_edges, &boundary.wall_curves));
  for (size_t f = 0; f < bytes.size(); f++)
    if (cw_cad_face_is_wall(box.cad, (int)f))
      check(cw_surface_mesh_face(&boundary.input, &boundary.wall_curves, (int)f, 0, &bytes[f], &size));
  box.node[0].plane.offset = offset;
  box.plan.node_count = 1;
  box.plan.region_count = 2;
  check(cw_surface_mesh_make(NULL, &boundary.input, &boundary.wall_curves, bytes.data(), &boundary.surface,
                             &box.outcome));
  for (void *one : bytes) free(one);
}

// Where the curves of a plane lack, the first triangle that reaches over it is told, and the plan has to be another
// one.
static void triangles_over_a_plane_are_told(void **) {
  Box box(0);
  join_with_plane(box, 0.021);
  const CwSurfaceMesh &surface = box.boundary.surface;
  int first = 0;
  const auto reaches = [&](int t) {
    double most = 0;
    for (int v : surface.triangle[t]) most = std::fmax(most, surface.x[v][0]);
    return most > 0.021 + 1e-8;
  };
  while (!reaches(first)) first++;
  const std::string wanted = std::string("a triangle of face ") + cw_cad_face_name(box.cad, surface.face[first]) +
                             " reaches out of region 1: a cut curve is missing";
  assert_int_equal(box.outcome.kind, CW_OUTCOME_REPLAN);
  assert_string_equal(box.outcome.reason, wanted.c_str());
  assert_near(cw_distance(box.outcome.place[0], surface.x[surface.triangle[first][0]]), 0, 0);
}

// Within 1e-8 of the plane a vertex lies on it.
static void vertices_may_be_off_by_rounding(void **) {
  for (int over = 0; over < 2; over++) {
    Box box(0);
    join_with_plane(box, SIDE[0] - (over ? 1.1e-8 : 0.9e-8));
    assert_int_equal(box.outcome.kind, over ? CW_OUTCOME_REPLAN : CW_OUTCOME_DONE);
  }
}

// Whatever the faces before and after it have.
static void a_face_without_a_mesh_ends_it(void **) {
  Box box(0);
  DomainSurfaces &boundary = box.boundary;
  std::vector<void *> bytes(cw_cad_face_count(box.cad), nullptr);
  int64_t size;
  check(cw_wall_curves_make(NULL, &boundary.input, &boundary.open_edges, &boundary.wall_curves));
  for (int f = 2; f < 6; f += 2)
    check(cw_surface_mesh_face(&boundary.input, &boundary.wall_curves, f, 0, &bytes[f], &size));
  bytes[3] = bow_tie_bytes();
  check(cw_surface_mesh_make(NULL, &boundary.input, &boundary.wall_curves, bytes.data(), &boundary.surface,
                             &box.outcome));
  assert_int_equal(box.outcome.kind, CW_OUTCOME_FINER);
  assert_int_equal(boundary.surface.triangle_count, 0);
  for (void *one : bytes) free(one);
}

// Of a tank of five passages each triangle is the one that it is a copy of, turned by as many turns as its face is from
// that of the other; and lies on its face in its region.
static void copies_are_turned(void **) {
  Tank tank(5, 2, true);
  make_walls(tank);
  const CwSurfaceMesh &surface = tank.boundary.surface;
  const CwImages &face = tank.symmetry->face;
  std::vector<int> of_turns(5, 0);
  for (int t = 0; t < surface.triangle_count; t++) {
    const int source = surface.source[t], turns = face.turns[surface.face[t]];
    double middle[3], uv[2] = {1e-3, 1e-3}, turned[3];
    assert_int_equal(surface.face[source], face.first[surface.face[t]]);
    for (int k = 0; k < 3; k++) {
      cw_symmetry_turn(5, turns, surface.x[surface.triangle[source][k]], turned);
      assert_near(cw_distance(turned, surface.x[surface.triangle[t][k]]), 0, 1e-12);
      assert_int_equal(cw_image_node(&surface.images, surface.triangle[source][k], turns), surface.triangle[t][k]);
    }
    middle_of(surface.x, surface.triangle[t], middle);
    assert_near(cw_cad_face_project(tank.cad, surface.face[t], middle, uv), 0, 1e-12);
    assert_int_equal(surface.region[t], cw_plan_locate(&tank.plan, middle));
    of_turns[turns] += source != t || face.next[surface.face[t]] != surface.face[t];
    assert_int_equal(source == t, turns == 0);
  }
  for (int k = 1; k < 5; k++) assert_int_equal(of_turns[k], of_turns[0]);
  assert_true(of_turns[0] > 100);
}

// The outline of an open patch of the box lies where the layers end, 1.5 mm from the walls around: its (u,v) are those
// of the points; what divides it is no boundary of it. Its triangles cover the rest, by region.
static void open_patches_lie_within_the_layers(void **) {
  Box box(3);
  DomainSurfaces &boundary = box.boundary;
  const double layer = 1.5e-3, wanted = (SIDE[1] - 2 * layer) * (SIDE[2] - 2 * layer);
  int patches = 0;
  make_surfaces(box);
  // The free curves were taken over by the interfaces; what outlines are made from is made once more.
  check(cw_free_curves_make(&boundary.input, &boundary.wall_curves, &boundary.surface, &boundary.layers,
                            &boundary.free_curves, &box.outcome));
  for (int f = 0; f < cw_cad_face_count(box.cad); f++) {
    if (cw_cad_face_is_wall(box.cad, f)) continue;
    CwPatchOutline outline = {};
    int inner = 0;
    check(cw_boundary_open_patch_outline(&boundary.input, &boundary.wall_curves, &boundary.free_curves, f, &outline));
    for (int p = 0; p < outline.point_count; p++) {
      double x[3];
      cw_cad_face_point(box.cad, f, outline.uv[p], x, NULL, NULL);
      assert_near(cw_distance(x, outline.x[p]), 0, 1e-12);
      assert_near(cw_distance(outline.x[p], boundary.free_curves.nodes.x[outline.node[p]]), 0, 0);
    }
    for (int e = 0; e < outline.edge_count; e++) {
      const double *a = outline.x[outline.edge[e][0]], *b = outline.x[outline.edge[e][1]];
      bool at_end = false;
      for (int k = 1; k < 3; k++)
        for (double end : {layer, SIDE[k] - layer})
          at_end |= std::fabs(a[k] - end) < 1e-9 && std::fabs(b[k] - end) < 1e-9;
      assert_int_equal(outline.boundary[e], at_end);
      inner += !at_end;
    }
    assert_true(inner >= 6); // each patch is divided by one plane
    cw_outline_free(&outline);
    double area = 0;
    for (int t = 0; t < boundary.interfaces.open_patch.count; t++) {
      double middle[3];
      if (boundary.interfaces.open_patch.face[t] != f) continue;
      const int32_t *corner = boundary.interfaces.open_patch.triangle[t];
      area += area_on_face(box.cad, f, boundary.interfaces.nodes.x, corner) / 2;
      middle_of(boundary.interfaces.nodes.x, corner, middle);
      assert_int_equal(boundary.interfaces.open_patch.region[t], cw_plan_locate(&box.plan, middle));
    }
    assert_near(area / wanted, 1, 1e-9);
    patches++;
  }
  assert_int_equal(patches, 2);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walls_are_covered),
      cmocka_unit_test(triangles_over_a_plane_are_told),
      cmocka_unit_test(vertices_may_be_off_by_rounding),
      cmocka_unit_test(a_face_without_a_mesh_ends_it),
      cmocka_unit_test(copies_are_turned),
      cmocka_unit_test(open_patches_lie_within_the_layers),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
