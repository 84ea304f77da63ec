// SPDX-License-Identifier: AGPL-3.0-or-later
// A box on its way from curve network to audited regions, with partition planes placed by hand.
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <gp_Ax2.hxx>
#include <gp_Pnt.hxx>

extern "C" {
#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "mesher/region/audit.h"
#include "mesher/region/interface_rule.h"
#include "mesher/region/region_build.h"
#include "mesher/region/region_failure.h"
#include "mesher/region/region_number.h"
#include "pipeline/mesh/cell.h"
}

#include "divided_box.h"
#include "point_order.h"
#include "shared_points.h"

static double finer_size(const void *, const double *) {
  return 1.7e-3;
}

// One plane: four edges of the box are cut in two; four cuts. A second plane on one side: two more edges, three cuts of
// its own, two cuts of the first divided, one line. A third on the other side likewise, and where both lines cross on
// the first plane each is divided: two pieces of each.
static void network_of_a_box(void **) {
  const int wanted[3][4] = {{16, 4, 0, 12}, {18, 9, 1, 16}, {20, 14, 4, 21}};
  for (int planes = 1; planes <= 3; planes++) {
    Box box(planes);
    const int found[4] = {box.count(CW_CURVE_EDGE), box.count(CW_CURVE_CUT), box.count(CW_CURVE_LINE),
                          box.boundary.network.corner_count};
    for (int k = 0; k < 4; k++) assert_int_equal(found[k], wanted[planes - 1][k]);
  }
}

static void curves_lie_on_their_planes(void **) {
  Box box(3);
  for (int i = 0; i < box.boundary.network.curve_count; i++) {
    const CwCurve &curve = box.boundary.network.curve[i];
    for (int s = 0; s <= 10; s++) {
      double x[3], parameter[2];
      cw_curve_point(&box.boundary.network, &curve, curve.fine_length[curve.fine_count - 1] * s / 10, x, parameter);
      for (int p : curve.plane) {
        if (p >= 0) assert_near(cw_plane_distance(&box.node[p].plane, x), 0, 1e-12);
      }
    }
  }
}

// The rule of region numbers on interfaces that were meshed for a coarser size field than that of the fill.
static void refine_interfaces(DomainSurfaces &boundary, const int32_t *number) {
  const CwRegionInput from = boundary.regions();
  std::vector<void *> refined(4, nullptr);
  std::vector<int> inserted(4, 0);
  int64_t size;
  CwInterfaceRuleCounts counts;
  int nodes = boundary.interfaces.nodes.count;
  boundary.input.size_at = finer_size;
  for (int i = 0; i < boundary.interfaces.outline_count; i++) {
    const int32_t *region = boundary.interfaces.refined.region[boundary.interfaces.outline[i].triangle_start];
    int owner = cw_interface_owner(&from, number, i), other = owner == region[0] ? region[1] : region[0];
    assert_true(owner == region[0] || owner == region[1]);
    assert_true(number[owner] < number[other]);
  }
  for (int r = 0; r < 4; r++) check(cw_interface_rule(&from, number, r, "box", &refined[r], &size));
  check(cw_interface_rule_merge(boundary.input.images, &boundary.interfaces, 4, refined.data(), &counts));
  assert_true(counts.encroached > 20);
  assert_true(counts.inserted > 20);
  assert_int_equal(boundary.interfaces.nodes.count, nodes + counts.inserted);
  assert_int_equal(boundary.interfaces.planned.count, counts.planned);
  assert_int_equal(boundary.interfaces.refined.count, counts.refined);
  assert_int_equal(counts.refined, counts.planned + 2 * counts.inserted); // Euler: outlines stay as they are
  // New nodes lie on the plane of their interface.
  for (int i = 0; i < boundary.interfaces.outline_count; i++) {
    const CwInterfaceOutline &interface = boundary.interfaces.outline[i];
    for (int t = 0; t < interface.refined_count; t++) {
      for (int node : boundary.interfaces.refined.triangle[interface.refined_start + t]) {
        assert_near(
            cw_plane_distance(&boundary.input.plan->node[interface.node].plane, boundary.interfaces.nodes.x[node]), 0,
            1e-12);
      }
    }
  }
  // No region keeps a candidate in the sphere of an interface triangle.
  for (int r = 0; r < 4; r++) {
    int32_t count;
    double(*x)[3];
    CwLatticeSite *site;
    check(cw_interface_rule_points(&from, r, "box", &count, &x, &site));
    assert_true(count > 100);
    for (int t = 0; t < boundary.interfaces.refined.count; t++) {
      if (boundary.interfaces.refined.region[t][0] != r && boundary.interfaces.refined.region[t][1] != r) continue;
      const int32_t *node = boundary.interfaces.refined.triangle[t];
      double u[3], v[3], uu = 0, vv = 0, uv = 0, square = 0, centre[3];
      for (int k = 0; k < 3; k++) {
        u[k] = boundary.interfaces.nodes.x[node[1]][k] - boundary.interfaces.nodes.x[node[0]][k];
        v[k] = boundary.interfaces.nodes.x[node[2]][k] - boundary.interfaces.nodes.x[node[0]][k];
        uu += u[k] * u[k], vv += v[k] * v[k], uv += u[k] * v[k];
      }
      double det = 2 * (uu * vv - uv * uv), p = vv * (uu - uv) / det, q = uu * (vv - uv) / det;
      for (int k = 0; k < 3; k++) {
        double d = p * u[k] + q * v[k];
        centre[k] = boundary.interfaces.nodes.x[node[0]][k] + d;
        square += d * d;
      }
      square = std::fmin(square, std::fmax(std::fmax(uu, vv), uu + vv - 2 * uv)); // a needle's sphere ends
      for (int i = 0; i < count; i++) {
        double distance = 0;
        for (int k = 0; k < 3; k++) distance += (x[i][k] - centre[k]) * (x[i][k] - centre[k]);
        assert_true(distance > square);
      }
    }
    free(x);
    free(site);
  }
  for (void *bytes : refined) free(bytes);
}

// The line of planes 0 and 2 runs a millimetre above a wall, and the layer top there above the line.
static void layers_that_cross_a_line_are_found(void **) {
  Box box(3, 0.001);
  DomainSurfaces &boundary = box.boundary;
  make_layers(box);
  check(cw_free_curves_make(&boundary.input, &boundary.wall_curves, &boundary.surface, &boundary.layers,
                            &boundary.free_curves, &box.outcome));
  assert_int_equal(box.outcome.kind, CW_OUTCOME_THIN);
  assert_near(box.outcome.place[0][0], 0.021, 1e-9);
  assert_true(boundary.free_curves.tight_count > 0);
  for (int i = 0; i < boundary.free_curves.tight_count; i++) {
    assert_near(boundary.free_curves.tight[i][0], 0.021, 1e-9);
    assert_true(boundary.free_curves.tight[i][2] < 1.6e-3);
  }
}

// A post 2 mm wide, whose round nose is narrower than the edges wanted on it: along its foot and its head the nose gets
// three edges all the same, and the layers grow around it.
static void edges_follow_a_narrow_nose(void **) {
  TopoDS_Shape solid = BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(40, 30, 20).Shape(),
                                       BRepPrimAPI_MakeBox(gp_Pnt(12, 14, 0), 5, 2, 20).Shape());
  Box box(1, 0.009,
          BRepAlgoAPI_Cut(solid, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(12, 15, 0), gp_Dir(0, 0, 1)), 1, 20).Shape()));
  make_layers(box);
  int noses = 0;
  for (int i = 0; i < box.boundary.network.curve_count; i++) {
    const CwCurve &curve = box.boundary.network.curve[i];
    if (std::fabs(curve.fine_length[curve.fine_count - 1] - 1e-3 * M_PI) > 1e-5) continue;
    noses++;
    assert_int_equal(box.boundary.wall_curves.curve[i].count, 4);
  }
  assert_int_equal(noses, 2);
}

// A half-round bay of radius 8 mm at the box and a post in it that leaves 0.24 mm to the wall of the bay. Three edges
// are wanted along the half circle, whose chords run 1.07 mm inside of it, through the post: they get as many as they
// need to run outside of it.
static void edges_keep_apart_in_a_narrow_gap(void **) {
  TopoDS_Shape bay =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(10, 30, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)), 8, 20, M_PI).Shape();
  TopoDS_Shape post = BRepPrimAPI_MakeBox(gp_Pnt(9, 32, 0), 2, 5.7, 20).Shape();
  Box box(1, 0.009, BRepAlgoAPI_Cut(BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(40, 30, 20).Shape(), bay).Shape(), post));
  DomainSurfaces &boundary = box.boundary;
  boundary.input.size_at = [](const void *, const double *) { return 9e-3; };
  make_walls(box);
  int arcs = 0;
  for (int i = 0; i < boundary.network.curve_count; i++) {
    const CwCurve &curve = boundary.network.curve[i];
    if (std::fabs(curve.fine_length[curve.fine_count - 1] - 8e-3 * M_PI) > 1e-5) continue;
    arcs++;
    const CwCurveNodes &nodes = boundary.wall_curves.curve[i];
    for (int k = 0; k + 1 < nodes.count; k++) {
      const double *a = boundary.surface.x[nodes.node[k]], *b = boundary.surface.x[nodes.node[k + 1]];
      if ((a[0] < 0.010) == (b[0] < 0.010) && a[0] != 0.010) continue;
      double s = (0.010 - a[0]) / (b[0] - a[0]); // above the post's middle
      assert_true(a[1] + s * (b[1] - a[1]) > 0.0377);
    }
  }
  assert_int_equal(arcs, 2);
}

// Area of the faces that a region lists on patches.
static double listed_area(const CwRegionData &cells) {
  double sum = 0, area[3];
  for (int t = 0; t < cells.triangle_count + cells.quad_count; t++) {
    const bool quad = t >= cells.triangle_count;
    cw_face_area(cells.points, quad ? cells.quads[t - cells.triangle_count] : cells.triangles[t], quad ? 4 : 3, area);
    sum += cw_norm(area);
  }
  return sum;
}

// Regions of the whole box: audited, together as large as the box, with all of its surface, and with shared points and
// faces that agree to the last bit.
static void fill_the_box(int rule, const CwPinched *pinched) {
  Box box(3);
  DomainSurfaces &boundary = box.boundary;
  boundary.input.pinched = pinched;
  make_surfaces(box);
  assert_int_equal(boundary.interfaces.outline_count, 6); // four pieces of plane 0, one of each other
  int pair_count, colours, number[4];
  int32_t(*pair)[2];
  check(cw_interfaces_adjacency(&boundary.interfaces, 4, &pair_count, &pair));
  assert_int_equal(pair_count, 6); // all four regions touch one another on plane 0
  check(cw_region_numbers(4, pair_count, pair, number, nullptr, &colours));
  if (rule) refine_interfaces(boundary, number);
  check(cw_interfaces_audit(&boundary.interfaces, 4));
  const Regions regions(boundary);
  double volume = 0, area = 0;
  uint64_t open_faces = 0;
  SharedPoints shared;
  int pyramids = 0, layer_tetrahedra = 0, walls = 0;
  for (int r = 0; r < 4; r++) {
    CwRegionMesh mesh;
    CwQuality quality;
    CwOutcome outcome = {};
    check(cw_region_build(&regions.context, r, number[r], &mesh, &outcome));
    assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
    check(cw_audit_region(&mesh, &quality, &outcome));
    assert_int_equal(mesh.cells.prism_count % 4, 0);
    volume += quality.volume;
    assert_true(quality.open_faces != 0);
    assert_true(quality.beside.count > 0 && quality.apart.count > 0);
    assert_int_equal(quality.beside.count + quality.apart.count, mesh.cells.tetrahedron_count - mesh.layer_tetrahedra);
    pyramids += mesh.cells.pyramid_count;
    layer_tetrahedra += mesh.layer_tetrahedra;
    walls += mesh.cells.prism_count + mesh.cells.pyramid_count + mesh.layer_tetrahedra;
    area += listed_area(mesh.cells);
    open_faces += quality.open_faces;
    shared.add(mesh);
    check_point_order(mesh, even_size(nullptr, nullptr));
    cw_region_free(&mesh);
  }
  assert_near(volume / (0.04 * 0.03 * 0.02), 1, 1e-12);
  assert_near(area / (2 * (0.04 * 0.03 + 0.04 * 0.02 + 0.03 * 0.02)), 1, 1e-12);
  assert_int_equal(open_faces, 0);
  if (pinched)
    assert_true(pyramids > 0 && layer_tetrahedra > 0 && walls < 4 * boundary.surface.triangle_count);
  else
    assert_true(pyramids + layer_tetrahedra == 0 && walls == 4 * boundary.surface.triangle_count);
  shared.check(regions.shared.count);
  free(pair);
}

static void regions_fill_the_box(void **) {
  fill_the_box(0, nullptr);
}

static void regions_fill_the_box_by_the_rule(void **) {
  fill_the_box(1, nullptr);
}

// Layers taper about an edge at the inlet and where plane 0 cuts a wall: there pyramids stand at pinched columns,
// tetrahedra between two, and nothing between three.
static void regions_fill_the_box_where_layers_taper(void **) {
  CwPinched pinched = {};
  check(cw_pinched_add((const CwPinchedPlace[]){{{0, 0, 0.008}, 0.004}}, &pinched));
  check(cw_pinched_add((const CwPinchedPlace[]){{{0.021, 0.015, 0.020}, 0.004}}, &pinched));
  for (int rule = 0; rule < 2; rule++) fill_the_box(rule, &pinched);
  cw_pinched_free(&pinched);
}

// The file of a failed region: as many points and triangles as the boundary of region 0 has, all kinds of surface, some
// crossing.
static void check_failure_file(const DomainSurfaces &boundary, const std::string &path) {
  const CwRegionInput from = boundary.regions();
  std::ifstream file(path);
  std::string word;
  int points = 0, triangles = 0, of_surface[3] = {0, 0, 0}, crossing = 0;
  while (file >> word && word != "POINTS") {
  }
  file >> points;
  while (file >> word && word != "POLYGONS") {
  }
  file >> triangles;
  while (file >> word && word != "default") {
  }
  for (int t = 0, kind; t < triangles; t++) {
    file >> kind;
    assert_true(kind >= 0 && kind < 3);
    of_surface[kind]++;
  }
  while (file >> word && word != "default") {
  }
  for (int t = 0, one; t < triangles; t++) {
    assert_true(bool(file >> one));
    crossing += one;
  }
  CwRegionBoundary inner;
  check(cw_region_boundary_make(&from, 0, 0, &inner));
  assert_int_equal(points, inner.node_count);
  assert_int_equal(of_surface[0], inner.wall_count);
  assert_int_equal(of_surface[1], inner.open_patch_count);
  assert_int_equal(of_surface[2], inner.interface_count);
  assert_true(crossing >= 2 && crossing < triangles / 4);
  cw_region_boundary_free(&inner);
}

// Columns of `boundary` near the failed place are thinned, and no others; or all of region 0.
static void check_thinning(const DomainSurfaces &boundary, CwRegionFailure failure) {
  const CwRegionInput from = boundary.regions();
  std::vector<double> most(boundary.surface.vertex_count, INFINITY);
  cw_region_failure_thin(&from, 0, &failure, 4, most.data());
  int thinned = 0;
  for (int v = 0; v < boundary.surface.vertex_count; v++) {
    if (cw_distance(boundary.layers.top[v], failure.at) < 4 * 2.5e-3) {
      assert_near(most[v], cw_policy.column_kept * boundary.layers.thickness[v], 1e-15);
      thinned++;
    } else {
      assert_true(std::isinf(most[v]));
    }
  }
  assert_true(thinned > 3 && thinned < boundary.surface.vertex_count / 2);
  failure.everywhere = 1;
  cw_region_failure_thin(&from, 0, &failure, 4, most.data());
  for (int t = 0; t < boundary.surface.triangle_count; t++) {
    for (int v : boundary.layers.triangle[t]) {
      if (boundary.surface.region[t] == 0)
        assert_near(most[v], cw_policy.column_kept * boundary.layers.thickness[v], 1e-15);
    }
  }
}

// A column that stands through the plane x = 21 mm: both regions beside it fail, the place and the patch are told, the
// boundary is kept, and columns there are thinned and no others.
static void a_crossing_boundary_is_examined(void **) {
  Box box(1);
  DomainSurfaces &boundary = box.boundary;
  make_surfaces(box);
  int best = -1;
  const double from[3] = {0.0195, 0.015, 0.0185}; // on the layer top under the upper side, before the plane
  for (int v = 0; v < boundary.surface.vertex_count; v++) {
    if (boundary.interfaces.nodes.on_plane[v]) continue;
    if (best < 0 || cw_distance(boundary.layers.top[v], from) < cw_distance(boundary.layers.top[best], from)) best = v;
  }
  assert_true(cw_distance(boundary.layers.top[best], from) < 2e-3);
  const double through[3] = {0.0235, 0.015, 0.010};
  cw_copy(through, boundary.layers.top[best]);
  cw_copy(through, boundary.interfaces.nodes.x[best]);
  const Regions regions(boundary);
  CwRegionMesh mesh;
  CwOutcome why = {};
  check(cw_region_build(&regions.context, 0, 1, &mesh, &why));
  assert_int_equal(why.kind, CW_OUTCOME_THIN);
  assert_null(mesh.cells.points);
  const TemporaryFolder folder;
  const std::string path = folder.path + "/failed-box-0001.vtk";
  CwRegionFailure failure;
  check(cw_region_failure_examine(&regions.context.from, 0, &why, path.c_str(), &failure));
  assert_int_equal(failure.failed, 1);
  assert_int_equal(failure.everywhere, 0);
  assert_true(strlen(why.reason) > 20);
  assert_string_equal(failure.message, why.reason);
  assert_true(!strcmp(failure.patch, "side") || !strcmp(failure.patch, "partition plane"));
  assert_true(cw_distance(failure.at, through) < 0.012);

  check_failure_file(boundary, path);
  check_thinning(boundary, failure);
  // A sound boundary: no place is known.
  cw_copy(boundary.surface.x[best], boundary.layers.top[best]);
  boundary.layers.top[best][2] -= 1.5e-3;
  cw_copy(boundary.layers.top[best], boundary.interfaces.nodes.x[best]);
  check(cw_region_failure_examine(&regions.context.from, 0, &why, path.c_str(), &failure));
  assert_int_equal(failure.everywhere, 1);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(layers_that_cross_a_line_are_found), cmocka_unit_test(network_of_a_box),
      cmocka_unit_test(curves_lie_on_their_planes),         cmocka_unit_test(edges_follow_a_narrow_nose),
      cmocka_unit_test(edges_keep_apart_in_a_narrow_gap),   cmocka_unit_test(regions_fill_the_box),
      cmocka_unit_test(regions_fill_the_box_by_the_rule),   cmocka_unit_test(regions_fill_the_box_where_layers_taper),
      cmocka_unit_test(a_crossing_boundary_is_examined),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
