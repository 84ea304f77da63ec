// SPDX-License-Identifier: AGPL-3.0-or-later
// Frames, curves and numbers of the rotor's edges, as its faces see them.
#include "geometry/rotor_edges.hpp"

#include <memory>
#include <set>

#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include "geometry/rotor_faces.hpp"
#include "tests/geometry/paper_blade.hpp"
#include "tests/unit_test.h"

// What RotorFaces has of them.
class Edges : public RotorEdges {
public:
  using RotorEdges::bands;
  using RotorEdges::blade;
  using RotorEdges::blade_axes;
  using RotorEdges::far_of;
  using RotorEdges::has_nut;
  using RotorEdges::has_shaft;
  using RotorEdges::meridian_curve;
  using RotorEdges::near_of;
  using RotorEdges::nut_curve;
  using RotorEdges::shell;
  using RotorEdges::zero_of;
  explicit Edges(const PaperBlade &of) : RotorEdges(&of.design, of.meridian, of.shapes, of.margin) {}
};

enum Kind { PLAIN, SPLITTERS, SEAMS, SHAFT, BARE_SHAFT, FILLETS, SHARP, KINDS }; // bare: without a nut

static CwCase case_of_kind(int kind) {
  CwCase table = paper_with(kind == SHARP ? CW_EDGE_SHARP : CW_EDGE_BEVELLED, kind == FILLETS ? 1e-3 : 0,
                            kind == SPLITTERS ? 0.4 : 0);
  if (kind == SHAFT || kind == BARE_SHAFT) {
    table.impeller.hub_diameter = kind == SHAFT ? 0.03 : 0.024;
    table.impeller.through_shaft_diameter = 0.024;
  }
  if (kind == SHARP) table.impeller.lean_angle = 12 * M_PI / 180;
  return table;
}

// Made once.
static PaperBlade &of_kind(int kind) {
  static std::unique_ptr<PaperBlade> all[KINDS];
  if (!all[kind]) {
    all[kind].reset(new PaperBlade(case_of_kind(kind)));
    all[kind]->make();
    if (kind == SEAMS) all[kind]->add_seams(3);
  }
  return *all[kind];
}

// A passage's parameter planes begin `margin` before its blade: by what is added there to the angles of the blade and
// of the next one both stand where they do in space.
static void frames_of_passages(void **) {
  for (const int kind : {PLAIN, SPLITTERS, SEAMS}) {
    PaperBlade &of = of_kind(kind);
    const Edges edges(of);
    const int shapes = (int)of.shapes.size(), count = 6 * shapes;
    assert_int_equal(shapes, kind == PLAIN ? 1 : kind == SPLITTERS ? 2 : 3);
    assert_int_equal(edges.blade.size(), count);
    for (int i = 0; i < count; i++) {
      const RotorBlade &b = edges.blade[i], &next = edges.blade[(i + 1) % count];
      assert_int_equal(b.turns, i / shapes);
      assert_ptr_equal(b.shape, &of.shapes[i % shapes]);
      assert_near(edges.zero_of(i) + edges.near_of(i), b.turns * of.pitch, 1e-12);
      assert_near(std::remainder(edges.zero_of(i) + edges.far_of(i) - next.turns * of.pitch, 2 * M_PI), 0, 1e-12);
      assert_true(edges.far_of(i) >= edges.near_of(i));
      // The shape's own angle lies behind the plane's zero by the margin, where it begins.
      assert_near(edges.near_of(i) + b.shape->begin, of.margin, 1e-12);
      const gp_Ax3 axes = edges.blade_axes(i, 2.5);
      assert_near(axes.Location().Distance(gp_Pnt(0, 0, 2.5)), 0, 1e-12);
      assert_near(axes.Direction().Angle(gp::DZ()), 0, 1e-12);
      assert_near(std::remainder(std::atan2(axes.XDirection().Y(), axes.XDirection().X()) - edges.zero_of(i), 2 * M_PI),
                  0, 1e-12);
    }
  }
}

// The walls' cubics at any angle, and the quarter of an ellipse between the disk of the nut and the hub.
static void curves_of_the_meridian(void **) {
  PaperBlade &of = of_kind(PLAIN);
  const Edges edges(of);
  const CwMeridian &m = of.meridian;
  for (const CwMeridianCurve *wall : {&m.hub, &m.shroud}) {
    const Handle(Geom_Curve) curve = edges.meridian_curve(*wall, 1.1);
    for (int i = 0; i <= 10; i++) {
      double x[2];
      cw_meridian_point(wall, i / 10.0, x, nullptr);
      assert_near(curve->Value(i / 10.0).Distance(gp_Pnt(x[0] * cos(1.1), x[0] * sin(1.1), x[1])), 0, 1e-10);
    }
  }
  const Handle(Geom_Curve) nut = edges.nut_curve(-0.7);
  const double rn = m.hub.pole[0][0], z0 = m.hub.pole[0][1], a = rn - m.nut_disk_radius, l = z0 - m.nut_end_z;
  for (int i = 0; i <= 20; i++) {
    const gp_Pnt x = nut->Value(i / 20.0);
    const double r = std::hypot(x.X(), x.Y()), across = (r - m.nut_disk_radius) / a, along = (x.Z() - z0) / l;
    assert_near(across * across + along * along, 1, 1e-10);
    assert_near(std::atan2(x.Y(), x.X()), -0.7, 1e-12);
    assert_true(across > -1e-12 && along < 1e-12);
  }
  assert_near(nut->Value(0).Z(), m.nut_end_z, 1e-12);
  assert_near(nut->Value(1).Z(), z0, 1e-12);
}

// Every edge of every blade has a number of its own, from 0 on, and none is left over.
static void edges_are_numbered_without_gaps(void **) {
  for (int kind = 0; kind < KINDS; kind++) {
    PaperBlade &of = of_kind(kind);
    Edges edges(of);
    std::multiset<int> used;
    assert_int_equal(edges.has_shaft, kind == SHAFT || kind == BARE_SHAFT);
    assert_int_equal(edges.has_nut, kind != BARE_SHAFT);
    assert_int_equal(edges.bands, kind == FILLETS ? 3 : 1);
    for (const RotorBlade &b : edges.blade) {
      const CwBladeShape &s = *b.shape;
      std::vector<int> own = {b.e_up[0],  b.e_up[1], b.e_end[1], b.x_out,   b.a_out[0],
                              b.a_out[1], b.a_up[0], b.a_up[1],  b.a_end[1]};
      if (edges.has_nut) own.insert(own.end(), {b.e_end[0], b.a_end[0]});
      if (edges.has_shaft) own.insert(own.end(), {b.e_shaft, b.e_inlet, b.a_shaft});
      for (int level = 0; level <= edges.bands && !s.seam; level++) {
        own.insert(own.end(), {b.e_nose_p[level], b.e_p[level], b.e_s[level]});
        if (b.e_nose_s[level] >= 0) own.push_back(b.e_nose_s[level]);
        assert_int_equal(b.e_nose_s[level] >= 0, level == 0 || level == edges.bands);
        if (s.has_bevel) own.push_back(b.e_bevel[level]);
        if (s.has_trailing) own.push_back(b.e_te[level]);
      }
      for (int band = 0; band < edges.bands && !s.seam; band++) {
        own.insert(own.end(), {b.x_p[band], b.x_s[band], b.x_bevel0[band], b.x_corner[band]});
        if (s.has_bevel && s.has_trailing)
          own.push_back(b.x_bevel1[band]);
        else
          assert_int_equal(b.x_bevel1[band], b.x_bevel0[band]);
      }
      if (!s.seam) own.insert(own.end(), {b.e_down[0], b.e_down[1]});
      used.insert(own.begin(), own.end());
    }
    int next = 0;
    for (const int edge : used) assert_int_equal(edge, next++);
    assert_int_equal(edges.shell.pole(0, 1, 0), next); // the next to be made
  }
}

// Levels and bands of the same blade begin and end at its own vertices alone; without a nut or a shaft the hub's begin
// is the disk's.
static void vertices_are_numbered_without_gaps(void **) {
  for (int kind = 0; kind < KINDS; kind++) {
    PaperBlade &of = of_kind(kind);
    Edges edges(of);
    std::multiset<int> used;
    for (const RotorBlade &b : edges.blade) {
      const CwBladeShape &s = *b.shape;
      used.insert({b.up[0], b.up[1], b.out[0], b.out[1], b.inlet});
      if (edges.has_nut)
        used.insert(b.disk);
      else
        assert_int_equal(b.disk, b.up[0]);
      if (edges.has_shaft) used.insert(b.shaft);
      for (int level = 0; level <= edges.bands && !s.seam; level++) {
        used.insert({b.nose_p[level], b.nose_s[level], b.corner[level], b.bevel0[level]});
        if (s.has_bevel && s.has_trailing) used.insert(b.bevel1[level]);
        if (s.has_bevel && !s.has_trailing) assert_int_equal(b.bevel1[level], b.corner[level]);
      }
      if (!s.seam) used.insert({b.tip[0], b.tip[1]});
    }
    int next = 0;
    for (const int vertex : used) assert_int_equal(vertex, next++);
    assert_int_equal(edges.shell.vertex(gp::Origin()), next);
  }
}

// Circles, lines and helices lie on the surfaces of revolution to the least tolerance, splines to a thousandth of a
// millimetre; each ends at its vertices.
static void edges_lie_on_their_surfaces(void **) {
  for (const int kind : {BARE_SHAFT, SHARP}) {
    PaperBlade &of = of_kind(kind);
    std::unique_ptr<CwSolid> solid(RotorFaces(&of.design, of.meridian, of.shapes, of.margin).make());
    int exact = 0;
    for (const CwSolidFace &face : solid->faces)
      for (TopExp_Explorer at(face.face, TopAbs_EDGE); at.More(); at.Next()) {
        const double tolerance = BRep_Tool::Tolerance(TopoDS::Edge(at.Current()));
        assert_true(tolerance < 1e-3);
        if (face.patch != "inlet" && face.patch != "suction_pipe" && face.patch != "rotor_interface" &&
            face.patch != "hub_nut" && face.patch != "hub_shaft")
          continue;
        assert_near(tolerance, 1e-5, 0);
        exact++;
      }
    // Inlet, pipe, interface, nut and its disk; or inlet ring, pipe, interface and shaft.
    assert_int_equal(exact, 6 * (kind == SHARP ? 1 + 4 + 4 + 4 + 1 : 4 + 4 + 4 + 4));
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(frames_of_passages),
      cmocka_unit_test(curves_of_the_meridian),
      cmocka_unit_test(edges_are_numbered_without_gaps),
      cmocka_unit_test(vertices_are_numbered_without_gaps),
      cmocka_unit_test(edges_lie_on_their_surfaces),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
