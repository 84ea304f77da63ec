// SPDX-License-Identifier: AGPL-3.0-or-later
// What the layers of a box of 40 x 30 x 20 mm, 1.5 mm thick, leave of its partition planes and of the curves between
// them: lengths and areas are known. (Open patches: test_boundary_walls.)
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <gp_Pnt.hxx>

extern "C" {
#include "mesher/boundary/boundary_curves.h"
#include "mesher/common/vec.h"
}

#include "bow_tie.h"
#include "divided_box.h"
#include "tank_surfaces.h"

static const double LAYER = 1.5e-3, SIDE[3] = {0.040, 0.030, 0.020}, EDGE = 2.5e-3;

static void make_free_curves(Box &box) {
  DomainSurfaces &boundary = box.boundary;
  check(cw_free_curves_make(&boundary.input, &boundary.wall_curves, &boundary.surface, &boundary.layers,
                            &boundary.free_curves, &box.outcome));
}

// Where the layers let a free curve along axis 2 or 1 begin or end.
static double within_layers(double x, int axis) {
  return std::fmin(std::fmax(x, LAYER), SIDE[axis] - LAYER);
}

// The nodes of a free curve run evenly from where the layers end to where they begin, or to a corner inside, by edges
// of 2.5 mm as nearly as whole numbers allow; on a plane unless it is an edge of the solid.
static void check_free_curve(const Box &box, int i) {
  const DomainSurfaces &boundary = box.boundary;
  const CwCurve &curve = boundary.network.curve[i];
  const CwCurveNodes &nodes = boundary.free_curves.curve[i];
  const CwNodeTable &table = boundary.free_curves.nodes;
  double end[2][3];
  for (int k = 0; k < 2; k++) {
    const int32_t node = boundary.free_curves.corner_node[curve.corner[k]];
    const CwCorner &corner = boundary.network.corner[curve.corner[k]];
    assert_int_equal(nodes.node[k ? nodes.count - 1 : 0], node);
    if (corner.on_wall) assert_int_equal(node, boundary.wall_curves.corner_vertex[curve.corner[k]]);
    if (!corner.on_wall) assert_true(node >= boundary.surface.vertex_count);
    cw_copy(table.x[node], end[k]);
    for (int axis = 1; axis < 3; axis++) assert_near(end[k][axis], within_layers(corner.x[axis], axis), 1e-9);
  }
  const double length = cw_distance(end[0], end[1]);
  assert_int_equal(nodes.count, 1 + std::fmax(1, std::floor(length / EDGE + 0.5)));
  for (int k = 0; k < nodes.count; k++) {
    double wanted[3];
    cw_lerp(end[0], end[1], (double)k / (nodes.count - 1), wanted);
    assert_near(cw_distance(table.x[nodes.node[k]], wanted), 0, 1e-9);
    const bool inner = k > 0 && k < nodes.count - 1;
    if (inner || curve.kind != CW_CURVE_EDGE)
      assert_int_equal(table.on_plane[nodes.node[k]], curve.kind != CW_CURVE_EDGE);
    if (inner) assert_true(nodes.node[k] >= boundary.surface.vertex_count);
  }
}

// The first nodes are those of the layer top; of these the ones over cuts lie on planes.
static void check_first_nodes(const Box &box) {
  const DomainSurfaces &boundary = box.boundary;
  const CwNodeTable &table = boundary.free_curves.nodes;
  assert_memory_equal(table.x, boundary.layers.top, boundary.surface.vertex_count * sizeof *table.x);
  for (int v = 0; v < boundary.surface.vertex_count; v++) {
    const double *x = boundary.surface.x[v];
    bool on_plane = false;
    for (int p = 0; p < box.plan.node_count; p++) {
      const bool beyond = p == 0 || (x[0] > 0.021 - 1e-9) == (p == 1) || std::fabs(x[0] - 0.021) < 1e-9;
      on_plane |= beyond && std::fabs(cw_plane_distance(&box.node[p].plane, x)) < 1e-9;
    }
    assert_int_equal(table.on_plane[v], on_plane);
  }
}

// Three planes: lines that meet inside. Two halves side by side: edges between their open faces are free curves too.
static void free_curves_run_between_the_layers(void **) {
  const TopoDS_Shape halves = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(40, 12, 20).Shape(),
                                               BRepPrimAPI_MakeBox(gp_Pnt(0, 12, 0), 40, 18, 20).Shape())
                                  .Shape();
  for (int split = 0; split < 2; split++) {
    Box box(3, 0.009, split ? halves : BRepPrimAPI_MakeBox(40, 30, 20).Shape());
    const CwNetwork &network = box.boundary.network;
    int of_kind[3] = {}, nodes = 0, off_wall = 0;
    make_layers(box);
    make_free_curves(box);
    assert_int_equal(box.outcome.kind, CW_OUTCOME_DONE);
    assert_int_equal(box.boundary.free_curves.tight_count, 0);
    check_first_nodes(box);
    for (int i = 0; i < network.curve_count; i++) {
      const int count = box.boundary.free_curves.curve[i].count;
      if (network.curve[i].wall) {
        assert_int_equal(count, 0);
        continue;
      }
      check_free_curve(box, i);
      of_kind[network.curve[i].kind]++;
      nodes += count - 2;
    }
    for (int i = 0; i < network.corner_count; i++) off_wall += !network.corner[i].on_wall;
    assert_int_equal(box.boundary.free_curves.nodes.count, box.boundary.surface.vertex_count + nodes + off_wall);
    assert_int_equal(of_kind[CW_CURVE_LINE], 4);
    assert_int_equal(of_kind[CW_CURVE_EDGE], split ? 3 : 0); // that at the inlet is cut in two
    assert_true(off_wall > 0);
  }
}

// Twice the area of a polygon across x, about the axis x.
static double twice_area_across_x(const double (*x)[3], const int32_t *corner, int count) {
  double sum = 0;
  for (int k = 0; k < count; k++) {
    const double *a = x[corner[k]], *b = x[corner[(k + 1) % count]];
    sum += a[1] * b[2] - a[2] * b[1];
  }
  return sum;
}

// The outline on a plane x = 21 mm is what the layers leave of the section: of 30 x 20 mm 27 x 17, and round a bar of
// 4 x 4 mm a hole of 7 x 7, which runs the other way round.
static void outlines_leave_the_layers_out(void **) {
  for (int bar = 0; bar < 2; bar++) {
    const TopoDS_Shape solid = BRepPrimAPI_MakeBox(40, 30, 20).Shape();
    const TopoDS_Shape barred = BRepAlgoAPI_Cut(solid, BRepPrimAPI_MakeBox(gp_Pnt(8, 12, 8), 26, 4, 4).Shape()).Shape();
    Box box(1, 0.009, bar ? barred : solid);
    make_layers(box);
    make_free_curves(box);
    assert_int_equal(box.outcome.kind, CW_OUTCOME_DONE);
    const CwFreeCurves &made = box.boundary.free_curves;
    assert_int_equal(made.outline_count, 1);
    const CwInterfaceOutline &outline = made.outline[0];
    assert_int_equal(outline.node, 0);
    assert_int_equal(outline.loop_count, bar ? 2 : 1);
    assert_int_equal(outline.loop_start[outline.loop_count], outline.corner_count);
    for (int l = 0; l < outline.loop_count; l++) {
      const int first = outline.loop_start[l], count = outline.loop_start[l + 1] - first;
      const double area = twice_area_across_x(made.nodes.x, outline.corner + first, count) / 2;
      assert_near(area / (l == 0 ? 27e-3 * 17e-3 : -7e-3 * 7e-3), 1, 1e-9);
      for (int k = 0; k < count; k++) {
        assert_true(made.nodes.on_plane[outline.corner[first + k]]);
        assert_near(made.nodes.x[outline.corner[first + k]][0], 0.021, 1e-12);
      }
    }
  }
}

// Interfaces of three planes cover what the layers leave of these, with their normals from the one region beside them
// to the other.
static void interfaces_cover_the_planes(void **) {
  Box box(3);
  make_surfaces(box);
  const CwInterfaces &made = box.boundary.interfaces;
  double area[3] = {};
  assert_int_equal(made.outline_count, 6);
  int next = 0;
  for (int i = 0; i < made.outline_count; i++) {
    const CwInterfaceOutline &outline = made.outline[i];
    const CwPlane &plane = box.node[outline.node].plane;
    assert_int_equal(outline.triangle_start, next);
    next += outline.triangle_count;
    for (int t = outline.triangle_start; t < next; t++) {
      const int32_t *corner = made.refined.triangle[t];
      double n[3], below[3], above[3];
      cw_normal(made.nodes.x[corner[0]], made.nodes.x[corner[1]], made.nodes.x[corner[2]], n);
      assert_near(cw_dot(n, plane.normal), cw_norm(n), 1e-15);
      area[outline.node] += cw_norm(n) / 2;
      for (int k = 0; k < 3; k++) {
        const double middle =
            (made.nodes.x[corner[0]][k] + made.nodes.x[corner[1]][k] + made.nodes.x[corner[2]][k]) / 3;
        below[k] = middle - 1e-6 * plane.normal[k];
        above[k] = middle + 1e-6 * plane.normal[k];
        assert_true(made.nodes.on_plane[corner[k]]);
      }
      assert_int_equal(made.refined.region[t][0], cw_plan_locate(&box.plan, below));
      assert_int_equal(made.refined.region[t][1], cw_plan_locate(&box.plan, above));
    }
    for (int v = outline.free_start; v < outline.free_start + outline.free_count; v++)
      assert_near(cw_plane_distance(&plane, made.nodes.x[v]), 0, 1e-12);
  }
  assert_int_equal(made.refined.count, next);
  assert_near(area[0] / (27e-3 * 17e-3), 1, 1e-9);
  assert_near(area[1] / (19e-3 / std::cos(0.1) * 17e-3), 1, 1e-9); // askew, from x = 21 to the outlet
  assert_near(area[2] / (21e-3 * 27e-3), 1, 1e-9);
}

// The loops of an outline are closed, each for itself, with the places of the nodes in the plane.
static void loops_become_outlines(void **) {
  double x[9][3];
  int32_t loop_start[3] = {0, 4, 7}, corner[7] = {8, 2, 3, 1, 5, 7, 6};
  const CwPlane plane = {{0.6, 0, 0.8}, 0.3};
  const CwPlaneMap map = cw_plane_map_of(&plane);
  for (int v = 0; v < 9; v++) {
    const double uv[2] = {0.1 * v, 0.01 * v * v};
    cw_plane_map(&map, uv, x[v], NULL, NULL);
  }
  CwNodeTable nodes = {};
  nodes.count = 9;
  nodes.x = x;
  CwInterfaceOutline interface = {};
  interface.corner_count = 7;
  interface.loop_count = 2;
  interface.loop_start = loop_start;
  interface.corner = corner;
  CwPatchOutline outline = {};
  check(cw_boundary_interface_outline(&nodes, &interface, &map, &outline));
  assert_int_equal(outline.point_count, 7);
  assert_int_equal(outline.edge_count, 7);
  for (int k = 0; k < 7; k++) {
    const int to = k == 3 ? 0 : k == 6 ? 4 : k + 1;
    const int *edge = outline.edge[k];
    assert_int_equal(outline.node[edge[0]], corner[k]);
    assert_int_equal(outline.node[edge[1]], corner[to]);
    assert_true(outline.boundary[k]);
    const int32_t v = outline.node[k];
    assert_near(outline.uv[k][0], 0.1 * v, 1e-15);
    assert_near(outline.uv[k][1], 0.01 * v * v, 1e-15);
    assert_near(cw_distance(outline.x[k], x[v]), 0, 0);
  }
  cw_outline_free(&outline);
}

// The line of two planes whose columns at both ends reach past one another, or just meet: both ends are told.
static void layers_that_fill_a_line_are_told(void **) {
  for (int meet = 0; meet < 2; meet++) {
    Box box(2);
    make_layers(box);
    DomainSurfaces &boundary = box.boundary;
    int line = 0;
    while (boundary.network.curve[line].kind != CW_CURVE_LINE) line++;
    const double low = boundary.network.corner[boundary.network.curve[line].corner[0]].x[2];
    int32_t end[2];
    for (int k = 0; k < 2; k++) {
      end[k] = boundary.wall_curves.corner_vertex[boundary.network.curve[line].corner[k]];
      boundary.layers.top[end[k]][2] = meet ? 0.010 : (k == 0) == (low < 0.01) ? 0.011 : 0.009;
    }
    make_free_curves(box);
    assert_int_equal(box.outcome.kind, CW_OUTCOME_THIN);
    assert_int_equal(boundary.free_curves.tight_count, 2);
    assert_int_equal(boundary.free_curves.outline_count, 0);
    for (int k = 0; k < 2; k++)
      assert_near(cw_distance(boundary.free_curves.tight[k], boundary.layers.top[end[k]]), 0, 0);
    assert_near(cw_distance(box.outcome.place[0], boundary.layers.top[end[0]]), 0, 0);
  }
}

// A column at the outlet that stands through the cut of plane 1 there, or one of plane 0 that stands through the line
// of both, twice across it: the ends of each two edges that cross are told.
static void layers_that_cross_a_curve_are_told(void **) {
  for (const double at : {SIDE[0], 0.021}) {
    Box box(2);
    make_layers(box);
    DomainSurfaces &boundary = box.boundary;
    const double from[3] = {at, 0, 0.010};
    int best = 0, moved = 0;
    for (int v = 0; v < boundary.surface.vertex_count; v++)
      if (cw_distance(boundary.surface.x[v], from) < cw_distance(boundary.surface.x[best], from)) best = v;
    assert_near(boundary.layers.top[best][0], at, 1e-12);
    boundary.layers.top[best][1] = 0.025; // cut and line are at y = 13 and 15
    make_free_curves(box);
    assert_int_equal(box.outcome.kind, CW_OUTCOME_THIN);
    assert_int_equal(boundary.free_curves.tight_count, 8);
    for (int i = 0; i < 8; i++) {
      assert_near(boundary.free_curves.tight[i][0], at, 1e-12);
      moved += cw_distance(boundary.free_curves.tight[i], boundary.layers.top[best]) == 0;
    }
    assert_int_equal(moved, 2);
  }
}

// An open patch without a mesh asks for what it asks for; an interface for other planes. Nodes and outlines go over.
static void patches_without_a_mesh_end_it(void **) {
  for (int kind = 0; kind < 2; kind++) {
    Box box(1);
    make_layers(box);
    make_free_curves(box);
    DomainSurfaces &boundary = box.boundary;
    const int nodes = boundary.free_curves.nodes.count, faces = cw_cad_face_count(box.cad);
    std::vector<void *> open_patches(faces, nullptr), interfaces(boundary.free_curves.outline_count, nullptr);
    int64_t size;
    for (int f = 0, made = 0; f < faces; f++) {
      if (cw_cad_face_is_wall(box.cad, f)) continue;
      if (kind == 0 && made++ == 0)
        open_patches[f] = bow_tie_bytes();
      else
        check(cw_interfaces_open_patch(&boundary.input, &boundary.wall_curves, &boundary.free_curves, f,
                                       &open_patches[f], &size));
    }
    interfaces[0] = bow_tie_bytes();
    check(cw_interfaces_make(&boundary.input, &boundary.free_curves, open_patches.data(), interfaces.data(),
                             &boundary.interfaces, &box.outcome));
    assert_int_equal(box.outcome.kind, kind == 0 ? CW_OUTCOME_FINER : CW_OUTCOME_REPLAN);
    assert_int_equal(boundary.interfaces.nodes.count, nodes);
    assert_int_equal(boundary.interfaces.outline_count, 1);
    assert_null(boundary.free_curves.nodes.x);
    assert_null(boundary.free_curves.outline);
    assert_null(boundary.free_curves.curve);
    for (void *bytes : open_patches) free(bytes);
    for (void *bytes : interfaces) free(bytes);
  }
}

// Of a tank of five passages each outline has the nodes and triangles of the one that a turn takes to it, turned.
static void images_are_turned(void **) {
  Tank tank(5, 1, true);
  make_surfaces(tank, true);
  const CwInterfaces &made = tank.boundary.interfaces;
  for (int i = 0; i < made.outline_count; i++) {
    const CwInterfaceOutline &one = made.outline[i], &next = made.outline[made.outline_images.next[i]];
    assert_int_equal(one.triangle_count, next.triangle_count);
    assert_int_equal(one.free_count, next.free_count);
    for (int t = 0; t < one.triangle_count; t++) {
      const int a = one.triangle_start + t, b = next.triangle_start + t;
      for (int k = 0; k < 3; k++)
        assert_int_equal(cw_image_node(&made.images, made.refined.triangle[a][k], 1), made.refined.triangle[b][k]);
      for (int k = 0; k < 2; k++)
        assert_int_equal(cw_sector_turned_region(&tank.plan, 5, 1, made.refined.region[a][k]),
                         made.refined.region[b][k]);
    }
  }
  for (int v = 0; v < made.nodes.count; v++) {
    const int next = cw_image_node(&made.images, v, 1);
    double turned[3];
    if (next < 0) continue; // inside of the water's face
    cw_symmetry_turn(5, 1, made.nodes.x[v], turned);
    assert_near(cw_distance(turned, made.nodes.x[next]), 0, 1e-12);
    assert_int_equal(made.nodes.on_plane[v], made.nodes.on_plane[next]);
    assert_int_equal(cw_image_node(&made.images, v, 5), v);
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(free_curves_run_between_the_layers), cmocka_unit_test(outlines_leave_the_layers_out),
      cmocka_unit_test(interfaces_cover_the_planes),        cmocka_unit_test(loops_become_outlines),
      cmocka_unit_test(layers_that_fill_a_line_are_told),   cmocka_unit_test(layers_that_cross_a_curve_are_told),
      cmocka_unit_test(patches_without_a_mesh_end_it),      cmocka_unit_test(images_are_turned),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
