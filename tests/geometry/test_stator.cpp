// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Plane.hxx>
#include <Geom_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <gp_Vec.hxx>

#include "geometry/measure.h"
#include "geometry/solid.hpp"
#include "geometry/stator.h"
#include "geometry/volute_design.h"
#include "geometry/volute_section.h"
#include "tests/geometry/paper_volute.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180, mm = 1e-3;

static CwVolute volute;
static CwSolid *stator;

static int setup(void **) {
  CwVoluteInput input = volute_of_paper();
  return cw_volute_design(&input, &volute) || cw_stator_build(&volute, mm, &stator);
}

static int teardown(void **) {
  cw_solid_free(&stator);
  return 0;
}

static void valid_and_closed(void **) {
  CwMeasuredSolid measured;
  assert_int_equal(cw_measure_solid(stator, &measured), CW_OK);
  assert_true(measured.valid);
  assert_true(measured.closed);
  assert_int_equal(measured.face_count, 51);
  assert_true(measured.largest_tolerance < 1e-7); // 1e-4 mm, far below the 1e-3 mm allowed
}

// Lines and circles in planes are that in the parameters too, so that a STEP file, which has no such curves of planes,
// loses nothing.
static void curves_in_planes(void **) {
  int count = 0;
  for (const CwSolidFace &face : stator->faces) {
    if (BRep_Tool::Surface(face.face)->DynamicType() != STANDARD_TYPE(Geom_Plane)) continue;
    for (TopExp_Explorer at(face.face, TopAbs_EDGE); at.More(); at.Next(), count++) {
      double first, last;
      const TopoDS_Edge edge = TopoDS::Edge(at.Current());
      const std::string in_space = BRep_Tool::Curve(edge, first, last)->DynamicType()->Name();
      const Handle(Geom2d_Curve) flat = BRep_Tool::CurveOnSurface(edge, face.face, first, last);
      assert_string_equal(flat->DynamicType()->Name() + strlen("Geom2d_"), in_space.c_str() + strlen("Geom_"));
    }
  }
  assert_true(count > 0);
}

static void dimensions(void **) {
  CwMeasuredStator measured;
  assert_int_equal(cw_measure_stator(stator, &measured), CW_OK);
  assert_near(measured.base_diameter, 0.204, 1e-9);
  assert_near(measured.inlet_width, 0.012, 1e-9);
  assert_near(measured.interface_radius, 0.101, 1e-9);
  assert_near(measured.interface_area, 2 * M_PI * 0.101 * 0.008, 1e-12); // so its width is b2
}

static void patches(void **) {
  const std::map<std::string, std::pair<int, std::string>> expected = {{"stator_interface", {5, "interface"}},
                                                                       {"neck", {10, "wall"}},
                                                                       {"step", {10, "wall"}},
                                                                       {"volute", {15, "wall"}},
                                                                       {"tongue", {2, "wall"}},
                                                                       {"diffuser", {4, "wall"}},
                                                                       {"discharge", {4, "wall"}},
                                                                       {"outlet", {1, "outlet"}}};
  std::map<std::string, int> count;
  std::set<std::string> names;
  for (int i = 0; i < cw_solid_face_count(stator); i++) {
    count[cw_solid_face_patch(stator, i)]++;
    names.insert(cw_solid_face_name(stator, i));
    assert_string_equal(cw_patch_kind_name(cw_solid_face_kind(stator, i)),
                        expected.at(cw_solid_face_patch(stator, i)).second.c_str());
  }
  for (const auto &patch : expected) assert_int_equal(count[patch.first], patch.second.first);
  assert_int_equal(names.size(), 51);
  assert_string_equal(cw_solid_domain(stator), "stator");
}

// The outlet is a disk across +y at the end of the pipe.
static void outlet(void **) {
  for (const CwSolidFace &face : stator->faces) {
    if (face.patch != "outlet") continue;
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face.face, properties);
    assert_near(properties.Mass(), M_PI * 625, 1e-3);
    double reach = std::hypot(volute.outlet_x, volute.outlet_y) * 1e3;
    double angle = std::atan2(volute.outlet_y, volute.outlet_x) - volute.discharge_lean;
    gp_Pnt centre = properties.CentreOfMass();
    assert_near(centre.X(), reach * std::cos(angle), 1e-5);
    assert_near(centre.Y(), reach * std::sin(angle) + 100, 1e-5);
    assert_near(centre.Z(), 0, 1e-5);
  }
}

// Fluid between r = D3/2 and the throat by columns over a grid in plan: the height of a column follows from
// the sections; the tongue is left sharp, which is worth some 10 mm3.
static double spiral_volume(const CwVolute &volute) {
  double r3 = volute.input.base_diameter / 2, step = 0.4 * mm, sum = 0;
  auto height = [&](double r, double phi) {
    CwVoluteSection s = cw_volute_section(&volute, phi);
    if (r < s.kink_radius) return cw_volute_half_width(&volute, r);
    double inside = s.arc_radius * s.arc_radius - std::pow(r - s.arc_centre, 2);
    return inside > 0 ? s.flat + std::sqrt(inside) : 0;
  };
  for (double x = -0.2 + step / 2; x < 0.2; x += step)
    for (double y = -0.2 + step / 2; y < 0.2; y += step) {
      double r = std::hypot(x, y), phi = std::atan2(y, x);
      if (r < r3 || r > 0.19) continue;
      if (phi < 0) phi += 2 * M_PI;
      double first = height(r, phi);
      if (x > 0 && y > 0 && y < volute.throat_y && x > volute.inner_wall_x) first = height(r, phi + 2 * M_PI);
      sum += 2 * first * step * step;
    }
  return sum;
}

// Volume of the diffuser, closed by the planes of throat and outlet: a third of the flux of x through small
// triangles.
static double diffuser_volume(const CwVolute &volute, const CwSolid *stator) {
  enum { STEPS = 100 };
  double sum = 0;
  for (const CwSolidFace &face : stator->faces) {
    if (face.patch != "diffuser") continue;
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face.face);
    auto at = [&](int i, int j) { return gp_Vec(surface->Value(double(i) / STEPS, double(j) / STEPS).XYZ()); };
    double sign = face.face.Orientation() == TopAbs_REVERSED ? -1 : 1;
    for (int i = 0; i < STEPS; i++)
      for (int j = 0; j < STEPS; j++) {
        gp_Vec a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        sum += sign * (a.Dot(b.Crossed(c)) + a.Dot(c.Crossed(d))) / 6;
      }
  }
  // The whole solid is turned by minus the lean of the discharge: so is the throat's plane.
  double lean = volute.discharge_lean, radius = volute.input.outlet_diameter / 2,
         outlet = volute.outlet_y * std::cos(lean) - volute.outlet_x * std::sin(lean);
  return sum * 1e-9 + (outlet * M_PI * radius * radius - volute.throat_y * volute.throat_area) / 3;
}

static void check_volume(const CwVolute &volute, const CwSolid *stator) {
  CwMeasuredSolid measured;
  assert_int_equal(cw_measure_solid(stator, &measured), CW_OK);
  const CwVoluteInput &in = volute.input;
  double neck = M_PI * (std::pow(in.base_diameter / 2, 2) - std::pow(in.interface_radius, 2)) * in.neck_width;
  double pipe = M_PI / 4 * in.outlet_diameter * in.outlet_diameter * in.discharge_pipe_length;
  double expected = neck + spiral_volume(volute) + diffuser_volume(volute, stator) + pipe;
  assert_near(measured.volume, expected, 1e-3 * expected);
}

static void volume(void **) {
  check_volume(volute, stator);
}

struct Side {
  gp_Vec normal, into; // out of the fluid; along the face away from the edge
};

static Side side_of(const TopoDS_Edge &edge, const TopoDS_Face &face, double t) {
  double first, last;
  gp_Pnt2d uv;
  gp_Vec2d duv;
  gp_Pnt x;
  gp_Vec xu, xv;
  BRep_Tool::CurveOnSurface(edge, face, first, last)->D1(t, uv, duv);
  BRep_Tool::Surface(face)->D1(uv.X(), uv.Y(), x, xu, xv);
  gp_Vec normal = xu.Crossed(xv).Normalized(), tangent = (xu * duv.X() + xv * duv.Y()).Normalized();
  if (face.Orientation() == TopAbs_REVERSED) normal.Reverse();
  if (edge.Orientation() == TopAbs_REVERSED) tangent.Reverse();
  return {normal, normal.Crossed(tangent)};
}

// Angles through the fluid along all edges: nothing concave under 89 degrees, no solid wedge under 89 degrees
// (the step), and no kink at all where the construction is smooth.
static void creases(void **) {
  TopTools_IndexedDataMapOfShapeListOfShape faces_of;
  TopExp::MapShapesAndAncestors(stator->solid, TopAbs_EDGE, TopAbs_FACE, faces_of);
  std::map<const TopoDS_TShape *, const CwSolidFace *> by_shape;
  for (const CwSolidFace &face : stator->faces) by_shape[face.face.TShape().get()] = &face;
  int smooth_edges = 0;
  for (int i = 1; i <= faces_of.Extent(); i++) {
    TopoDS_Edge uses[2];
    const CwSolidFace *faces[2] = {by_shape.at(faces_of(i).First().TShape().get()),
                                   by_shape.at(faces_of(i).Last().TShape().get())};
    for (int k = 0; k < 2; k++)
      for (TopExp_Explorer explorer(faces[k]->face, TopAbs_EDGE); explorer.More(); explorer.Next())
        if (explorer.Current().IsSame(faces_of.FindKey(i))) uses[k] = TopoDS::Edge(explorer.Current());
    double first, last, least = 360, largest = 0;
    Handle(Geom_Curve) curve = BRep_Tool::Curve(uses[0], first, last);
    for (int k = 0; k <= 60; k++) {
      double t = first + (last - first) * k / 60;
      Side a = side_of(uses[0], faces[0]->face, t), b = side_of(uses[1], faces[1]->face, t);
      double angle = a.into.Angle(b.into) / degree;
      if (b.into.Dot(a.normal) >= 0) angle = 360 - angle;
      least = std::min(least, angle);
      largest = std::max(largest, angle);
    }
    if (least < 89.9 || largest > 270.1)
      fail_msg("%s and %s meet at %.2f to %.2f deg", faces[0]->name.c_str(), faces[1]->name.c_str(), least, largest);
    bool smooth = least > 179.5 && largest < 180.5;
    smooth_edges += smooth;
    std::set<std::string> pair = {faces[0]->patch, faces[1]->patch};
    // Nose to outer wall and to its own flank, throat to diffuser, diffuser to pipe.
    if (pair == std::set<std::string>{"diffuser", "volute"} || pair == std::set<std::string>{"diffuser", "tongue"} ||
        pair == std::set<std::string>{"diffuser", "discharge"} || pair == std::set<std::string>{"tongue"})
      if (!smooth)
        fail_msg("%s and %s meet at %.3f to %.3f deg", faces[0]->name.c_str(), faces[1]->name.c_str(), least, largest);
  }
  // Rings: interface 5, neck 10, step 10; side walls 10; outer wall 4, nose 2, throat 4, diffuser to pipe 4,
  // pipe 4.
  assert_int_equal(smooth_edges, 53);
}

// Angle through the fluid, in degrees, in the middle of the edge that two faces share; -1: they share none.
static double angle_between(const CwSolidFace &a, const CwSolidFace &b) {
  for (TopExp_Explorer i(a.face, TopAbs_EDGE); i.More(); i.Next())
    for (TopExp_Explorer j(b.face, TopAbs_EDGE); j.More(); j.Next())
      if (i.Current().IsSame(j.Current())) {
        TopoDS_Edge edge = TopoDS::Edge(i.Current());
        double first, last;
        BRep_Tool::Range(edge, first, last);
        Side one = side_of(edge, a.face, (first + last) / 2),
             other = side_of(TopoDS::Edge(j.Current()), b.face, (first + last) / 2);
        double angle = one.into.Angle(other.into) / degree;
        return other.into.Dot(one.normal) >= 0 ? 360 - angle : angle;
      }
  return -1;
}

// Each family, by either law and discharge, has the paper's faces; its outer wall touches the side walls all
// along the last three sectors; its volume is that of its sections.
static void families(void **) {
  for (int kind = 0; kind < 4; kind++) {
    CwVoluteInput input = volute_of_paper();
    input.section = kind == 2 ? CW_SECTION_CIRCLE : kind == 1 ? CW_SECTION_RECTANGLE : CW_SECTION_TRAPEZOID;
    input.corner_radius = kind < 2 ? 4 * mm : NAN;
    input.inlet_width = (kind == 1 ? 28 : 14) * mm;
    input.area_law = kind % 2 ? CW_AREA_LAW_VELOCITY : CW_AREA_LAW_ANGULAR_MOMENTUM;
    input.discharge = kind == 0 ? CW_DISCHARGE_TANGENTIAL : CW_DISCHARGE_RADIAL;
    input.throat_area = input.outlet_diameter = NAN;
    input.diffuser_area_ratio = 1.7;
    CwVolute trial;
    CwSolid *solid = NULL;
    if (cw_volute_design(&input, &trial) != CW_OK || cw_stator_build(&trial, mm, &solid) != CW_OK)
      fail_msg("%d: %s", kind, cw_fail_message());
    CwMeasuredSolid measured;
    assert_int_equal(cw_measure_solid(solid, &measured), CW_OK);
    assert_true(measured.valid && measured.closed && measured.largest_tolerance < 1e-6);
    assert_int_equal(cw_solid_face_count(solid), cw_solid_face_count(stator));
    std::map<std::string, const CwSolidFace *> wall;
    for (int i = 0; i < cw_solid_face_count(solid); i++) {
      assert_string_equal(cw_solid_face_name(solid, i), cw_solid_face_name(stator, i));
      wall[solid->faces[i].name] = &solid->faces[i];
    }
    // volute_1 to 5: outer wall; 6 to 10 and 11 to 15: side walls below and above.
    for (int sector = 3; sector <= 5; sector++)
      for (int side : {5, 10}) {
        double angle = angle_between(*wall.at("volute_" + std::to_string(sector)),
                                     *wall.at("volute_" + std::to_string(sector + side)));
        assert_near(angle, kind == 3 ? 105 : 180, 0.3);
      }
    check_volume(trial, solid);
    cw_solid_free(&solid);
  }
}

// Every set is built whole, or refused in one line.
static void parameter_sets(void **) {
  int built = 0, sets = 0;
  for (double b2 : {5.0, 8.0, 12.0, 16.0})
    for (double ratio : {1.02, 1.05, 1.08})
      for (double k : {0.76, 0.95}) {
        double wider = k < 0.8 ? 2 : 4;
        CwVoluteInput input = volute_of_paper();
        input.neck_width = b2 * mm;
        input.inlet_width = (b2 + wider) * mm;
        input.base_diameter = ratio * 0.2;
        input.interface_radius = (0.2 + input.base_diameter) / 4;
        input.angular_momentum = k;
        input.throat_area = NAN;
        CwVolute trial;
        CwSolid *solid = NULL;
        CwStatus status = cw_volute_design(&input, &trial);
        if (status == CW_OK) status = cw_stator_build(&trial, mm, &solid);
        sets++;
        if (status == CW_OK) {
          CwMeasuredSolid measured;
          assert_int_equal(cw_measure_solid(solid, &measured), CW_OK);
          assert_true(measured.valid && measured.closed && measured.largest_tolerance < 1e-6 && measured.volume > 0);
          built++;
        } else {
          print_message("b2 %g b3 %g D3 %g K %g: %s\n", b2, b2 + wider, 200 * ratio, k, cw_fail_message());
          assert_true(std::strlen(cw_fail_message()) > 20 && !std::strchr(cw_fail_message(), '\n'));
          assert_true(status == CW_ERR_DESIGN || status == CW_ERR_GEOMETRY);
        }
        cw_solid_free(&solid);
      }
  print_message("%d of %d sets built\n", built, sets);
  assert_true(built >= 0.9 * sets);
}

// No free surface bends more sharply than a quarter of the nose's radius: the mesh sizes follow the
// curvature.
static void curvature(void **) {
  for (const CwSolidFace &face : stator->faces) {
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face.face);
    if (!surface->IsKind(STANDARD_TYPE(Geom_BSplineSurface))) continue;
    for (int i = 0; i <= 40; i++)
      for (int j = 0; j <= 80; j++) {
        GeomLProp_SLProps at(surface, i / 40.0, j / 80.0, 2, 1e-9);
        double largest = std::max(std::fabs(at.MaxCurvature()), std::fabs(at.MinCurvature()));
        if (largest > 4 / 1.5) fail_msg("%s bends with a radius of %.3f mm", face.name.c_str(), 1 / largest);
      }
  }
}

static std::string text_of(const CwSolid *solid) {
  std::ostringstream stream;
  BRepTools::Write(solid->solid, stream);
  return stream.str();
}

static void same_bits(void **) {
  CwSolid *again = NULL;
  assert_int_equal(cw_stator_build(&volute, mm, &again), CW_OK);
  assert_true(text_of(stator) == text_of(again));
  cw_solid_free(&again);
}

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(valid_and_closed), cmocka_unit_test(curves_in_planes), cmocka_unit_test(dimensions),
      cmocka_unit_test(patches),          cmocka_unit_test(outlet),           cmocka_unit_test(volume),
      cmocka_unit_test(creases),          cmocka_unit_test(parameter_sets),   cmocka_unit_test(same_bits),
      cmocka_unit_test(curvature),        cmocka_unit_test(families),
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
