// SPDX-License-Identifier: AGPL-3.0-or-later
// The paper's rotor as a solid, in mm: areas and places by hand, and what must hold of any closed surface.
#include "geometry/rotor_faces.hpp"

#include <map>
#include <memory>
#include <set>

#include <BRep_Tool.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <TopExp_Explorer.hxx>

#include "tests/geometry/hand_solids.hpp"
#include "tests/geometry/paper_blade.hpp"
#include "tests/unit_test.h"

extern "C" {
#include "geometry/rotor_volume.h"
}

// Three blades: leaning and bevelled; sharp, round a shaft; with root fillets, round a shaft without a nut. Or two of
// them: rounded with splitters; blunt with a seam in each passage.
enum Kind { LEANING, SPLITTERS, SEAMS, SHAFT, FILLETS, KINDS };

static int blades_of(int kind) {
  return kind == SPLITTERS || kind == SEAMS ? 2 : 3;
}

struct Rotor {
  PaperBlade of;
  std::unique_ptr<CwSolid> solid;
  std::vector<gp_Pnt> middle; // of the corners of each face
  explicit Rotor(const CwCase &table, int parts = 1) : of(table) {
    of.make();
    of.add_seams(parts);
    solid.reset(RotorFaces(&of.design, of.meridian, of.shapes, of.margin).make());
    for (const CwSolidFace &face : solid->faces) {
      TopTools_IndexedMapOfShape corners;
      TopExp::MapShapes(face.face, TopAbs_VERTEX, corners);
      gp_XYZ sum;
      for (int i = 1; i <= corners.Extent(); i++) sum += BRep_Tool::Pnt(TopoDS::Vertex(corners(i))).XYZ();
      middle.push_back(gp_Pnt(sum / corners.Extent()));
    }
  }
};

// All kinds, made once.
static std::unique_ptr<Rotor> rotors[KINDS];

static int make_all(void **) {
  static const CwTrailingEdge edge[KINDS] = {CW_EDGE_BEVELLED, CW_EDGE_ROUNDED, CW_EDGE_BLUNT, CW_EDGE_SHARP,
                                             CW_EDGE_BEVELLED};
  for (int kind = 0; kind < KINDS; kind++) {
    CwCase table = paper_with(edge[kind], kind == FILLETS ? 1e-3 : 0, kind == SPLITTERS ? 0.4 : 0);
    table.impeller.blade_count = blades_of(kind);
    if (kind == SHAFT || kind == FILLETS) {
      table.impeller.hub_diameter = kind == SHAFT ? 0.03 : 0.024;
      table.impeller.through_shaft_diameter = 0.024;
    }
    if (kind == LEANING) table.impeller.lean_angle = 12 * M_PI / 180;
    rotors[kind].reset(new Rotor(table, kind == SEAMS ? 2 : 1));
  }
  return 0;
}

static int free_all(void **) {
  for (auto &rotor : rotors) rotor.reset();
  return 0;
}

static bool has_shaft(int kind) {
  return kind == SHAFT || kind == FILLETS;
}

static int sectors_of(int kind) {
  return kind == SPLITTERS || kind == SEAMS ? 4 : 3;
}

static int count_of(const CwSolid &solid, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape all;
  TopExp::MapShapes(solid.solid, kind, all);
  return all.Extent();
}

// Vertices less edges plus faces are 2 less twice the number of holes (Euler): each blade and splitter is one, and a
// shaft through the water. No face has a hole of its own. Surfaces and edges fit to a thousandth of a millimetre.
static void the_surface_has_its_holes(void **) {
  for (int kind = 0; kind < KINDS; kind++) {
    const CwSolid &solid = *rotors[kind]->solid;
    const int holes = (kind == SPLITTERS ? 4 : blades_of(kind)) + has_shaft(kind);
    assert_int_equal(count_of(solid, TopAbs_VERTEX) - count_of(solid, TopAbs_EDGE) + count_of(solid, TopAbs_FACE),
                     2 - 2 * holes);
    assert_string_equal(cw_solid_fault(solid).c_str(), "");
    assert_true(hand_edge_tolerance(solid) < 1e-3);
    assert_true(hand_faces_in_order(solid));
    assert_string_equal(solid.domain.c_str(), "rotor");
    assert_near(solid.unit, 1e-3, 1e-15);
  }
}

// Pappus knows nothing of the corners of fillets.
static void the_volume_is_that_of_the_sections(void **) {
  for (const int kind : {LEANING, FILLETS}) {
    double wanted;
    assert_int_equal(cw_rotor_volume(&rotors[kind]->of.design, &wanted), CW_OK);
    assert_near(hand_volume(rotors[kind]->solid->solid) / wanted, 1, kind == FILLETS ? 2e-4 : 2e-5);
  }
}

// One face a passage, of three or four; of blades one for each band of each patch.
static void faces_of_each_patch(void **) {
  static const char *const patch[] = {"inlet",
                                      "suction_pipe",
                                      "hub",
                                      "hub_nut",
                                      "hub_shaft",
                                      "shroud",
                                      "blade_pressure",
                                      "blade_suction",
                                      "blade_leading_edge",
                                      "blade_trailing_edge",
                                      "rotor_interface"};
  static const int wanted[KINDS][11] = {
      {1, 3, 3, 4, 0, 3, 3, 3, 3, 6, 3}, // the nut's disk is the fourth; a bevel and a cut
      {1, 4, 4, 5, 0, 4, 4, 4, 4, 4, 4},
      {1, 4, 4, 5, 0, 4, 2, 2, 2, 2, 4},
      {3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
      {3, 3, 3, 0, 3, 3, 9, 9, 9, 18, 3}};
  for (int kind = 0; kind < KINDS; kind++) {
    const CwSolid &solid = *rotors[kind]->solid;
    size_t all = 0;
    std::set<std::string> names;
    for (int k = 0; k < 11; k++) {
      if (hand_patch_count(solid, patch[k]) != wanted[kind][k])
        fail_msg("%d: %d faces of %s", kind, hand_patch_count(solid, patch[k]), patch[k]);
      all += wanted[kind][k];
    }
    assert_int_equal(solid.faces.size(), all);
    for (const CwSolidFace &face : solid.faces) {
      names.insert(face.name);
      assert_int_equal(face.kind, face.patch == "inlet"             ? CW_PATCH_INLET
                                  : face.patch == "rotor_interface" ? CW_PATCH_INTERFACE
                                                                    : CW_PATCH_WALL);
    }
    assert_int_equal(names.size(), all); // each has its own
  }
}

// D1 is 74, the interface 202 and 8 wide. The nut is a quarter of an ellipse about the axis, by Simpson's rule, and
// without a shaft its disk; the shaft's wall is straight.
static void areas_by_hand(void **) {
  for (int kind = 0; kind < KINDS; kind++) {
    const CwSolid &solid = *rotors[kind]->solid;
    const CwMeridian &m = rotors[kind]->of.meridian;
    const double shaft = has_shaft(kind) ? 12 : 0, d = m.nut_disk_radius, a = m.hub.pole[0][0] - d;
    const double l = m.hub.pole[0][1] - m.nut_end_z;
    double nut = has_shaft(kind) ? 0 : M_PI * d * d;
    for (int i = 0; i <= 2000; i++) {
      const double turn = M_PI / 2 * i / 2000, rate = std::hypot(a * cos(turn), l * sin(turn));
      nut += (i == 0 || i == 2000 ? 1 : i % 2 ? 4 : 2) / 3.0 * M_PI / 4000 * 2 * M_PI * (d + a * sin(turn)) * rate;
    }
    const double pipe = m.shroud.pole[0][1] - m.inlet_z;
    assert_near(hand_patch_area(solid, "inlet") / (M_PI * (37 * 37 - shaft * shaft)), 1, 1e-6);
    assert_near(hand_patch_area(solid, "suction_pipe") / (2 * M_PI * 37 * pipe), 1, 1e-6);
    assert_near(hand_patch_area(solid, "rotor_interface") / (2 * M_PI * 101 * 8), 1, 1e-6);
    assert_near(hand_patch_area(solid, "hub_nut"), nut, 1e-6 * nut + 1e-9);
    assert_near(hand_patch_area(solid, "hub_shaft"), 2 * M_PI * shaft * (m.nut_end_z - m.inlet_z), 1e-2);
  }
}

// At the interface the hub lies in z = 4, the shroud in z = -4 mm.
static void walls_are_told_apart(void **) {
  for (int kind = 0; kind < KINDS; kind++)
    for (const CwSolidFace &face : rotors[kind]->solid->faces) {
      int seen = 0;
      if (face.patch != "hub" && face.patch != "shroud") continue;
      for (TopExp_Explorer at(face.face, TopAbs_VERTEX); at.More(); at.Next()) {
        const gp_Pnt x = BRep_Tool::Pnt(TopoDS::Vertex(at.Current()));
        if (std::hypot(x.X(), x.Y()) < 101 - 1e-6) continue;
        assert_near(x.Z(), face.patch == "hub" ? 4 : -4, 1e-9);
        seen++;
      }
      assert_true(seen >= 2);
    }
}

// The corners of the next of a kind are those of the last turned by a pitch. Walls are numbered by passage, blades by
// pitch.
static void passages_are_alike(void **) {
  for (int kind = 0; kind < KINDS; kind++) {
    std::map<std::string, std::vector<gp_Pnt>> middle; // by the name without its number
    for (int number = 1; number <= 4; number++)
      for (size_t f = 0; f < rotors[kind]->middle.size(); f++) {
        const std::string &name = rotors[kind]->solid->faces[f].name;
        const size_t at = name.rfind('_');
        if (name.substr(at + 1) == std::to_string(number))
          middle[name.substr(0, at)].push_back(rotors[kind]->middle[f]);
      }
    for (const auto &[name, points] : middle) {
      const int count = (int)points.size(), blades = blades_of(kind), step = count / blades;
      assert_int_equal(count % blades, 0);
      for (int i = 0; i < count; i++) {
        const double off = points[i].Rotated(gp::OZ(), 2 * M_PI / blades).Distance(points[(i + step) % count]);
        if (off > 1e-4) fail_msg("%d: %s_%d is off by %g", kind, name.c_str(), i + 1, off);
      }
    }
    assert_true(middle.size() >= 9);
  }
}

// Face names tell which is which: the pressure side lies ahead of the suction side of the same blade, unless that ends
// well before it at a sharp edge; and the leading edge ahead of the trailing edge by the wrap of 71 degrees less a
// little at both ends.
static void blades_are_named_as_they_lie(void **) {
  for (int kind = 0; kind < KINDS; kind++) {
    std::map<std::string, double> angle;
    for (size_t f = 0; f < rotors[kind]->middle.size(); f++) {
      const gp_Pnt &at = rotors[kind]->middle[f];
      angle[rotors[kind]->solid->faces[f].name] = std::atan2(at.Y(), at.X());
    }
    const auto ahead = [&](const std::string &of, const std::string &than) {
      if (!angle.count(of) || !angle.count(than)) fail_msg("no %s or %s", of.c_str(), than.c_str());
      return std::remainder(angle[of] - angle[than], 2 * M_PI) * 180 / M_PI;
    };
    for (int b = 1; b <= blades_of(kind); b++) {
      const std::string n = "_" + std::to_string(b);
      if (kind != SHAFT) assert_true(ahead("blade_pressure" + n, "blade_suction" + n) > 0.5);
      assert_near(ahead("blade_leading_edge" + n, (kind == SHAFT ? "blade_trailing_bevel" : "blade_trailing_edge") + n),
                  71, 8);
      if (kind == FILLETS) assert_true(ahead("blade_pressure_hub_root" + n, "blade_suction_hub_root" + n) > 0.5);
      if (kind != SPLITTERS) continue;
      assert_near(ahead("splitter_trailing_edge" + n, "blade_trailing_edge" + n), 90, 8);
      assert_true(ahead("splitter_leading_edge" + n, "splitter_trailing_edge" + n) > 20);
    }
  }
}

// Rims: arcs of a circle about the axis, on the interface in z = -4 and 4 mm; between them straight lines along the
// axis; or parts of a helix with a leaning edge, and where seams or root fillets end at other angles on hub and shroud.
static void edges_of_the_interface(void **) {
  for (int kind = 0; kind < KINDS; kind++) {
    int arcs = 0, lines = 0, slanted = 0;
    double turned = 0;
    for (const CwSolidFace &face : rotors[kind]->solid->faces)
      for (TopExp_Explorer at(face.face, TopAbs_EDGE); at.More() && face.patch == "rotor_interface"; at.Next()) {
        double first, last;
        const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(at.Current()), first, last);
        const Handle(Geom_Circle) circle = Handle(Geom_Circle)::DownCast(curve);
        if (circle.IsNull()) {
          (Handle(Geom_Line)::DownCast(curve).IsNull() ? slanted : lines)++;
          for (int k = 0; k <= 10; k++) {
            const gp_Pnt x = curve->Value(first + (last - first) * k / 10);
            assert_near(std::hypot(x.X(), x.Y()), 101, 1e-5);
          }
          continue;
        }
        arcs++;
        turned += last - first;
        assert_near(circle->Radius(), 101, 1e-12);
        assert_near(std::fabs(circle->Location().Z()), 4, 1e-12);
      }
    assert_int_equal(arcs, 2 * sectors_of(kind));
    assert_near(turned, 4 * M_PI, 1e-9);
    assert_int_equal(lines + slanted, 2 * sectors_of(kind));
    if (kind != SPLITTERS) assert_int_equal(slanted, kind == SHAFT ? 0 : 2 * blades_of(kind));
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_surface_has_its_holes), cmocka_unit_test(the_volume_is_that_of_the_sections),
      cmocka_unit_test(faces_of_each_patch),       cmocka_unit_test(areas_by_hand),
      cmocka_unit_test(passages_are_alike),        cmocka_unit_test(blades_are_named_as_they_lie),
      cmocka_unit_test(edges_of_the_interface),    cmocka_unit_test(walls_are_told_apart),
  };
  return cmocka_run_group_tests(tests, make_all, free_all);
}
