// SPDX-License-Identifier: AGPL-3.0-or-later
// Surfaces of the paper's blade, in mm, against its sections: where both are asked for at the same place.
#include "geometry/blade_patches.hpp"

#include <cstring>
#include <stdexcept>

#include "tests/geometry/paper_blade.hpp"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;
static const CwTrailingEdge edges[] = {CW_EDGE_BEVELLED, CW_EDGE_BLUNT, CW_EDGE_ROUNDED, CW_EDGE_SHARP};

// Where the suction side ends: at the bevel, which begins everywhere as on mid-span.
static double suction_end(const PaperBlade &of, const CwBladeShape &shape, const CwBladeSection &section) {
  const CwTrailingEdge edge = of.design.trailing_edge;
  if (edge != CW_EDGE_BEVELLED && edge != CW_EDGE_SHARP) return section.end;
  return cw_blade_bevel_begin(&shape.section[6], edge, of.design.trailing_edge_bevel);
}

// At the sections, and half-way between two of them; along the sides between the points that they are made through.
static void sides_are_those_of_the_sections(void **) {
  for (const CwTrailingEdge edge : edges) {
    PaperBlade &blade = made_blade(edge);
    const CwBladeShape &shape = blade.shapes[0];
    for (const double j : {0., 4., 6.5, 12.}) {
      const CwBladeSection section = blade.section_at(j / 12);
      const double end = suction_end(blade, shape, section), near = j == 6.5 ? 2e-3 : 2e-4;
      for (int i = 0; i <= 20; i++) {
        const double u = i / 20.0;
        const CwBladePoint pressure =
            cw_blade_side(&section, CW_BLADE_PRESSURE, section.nose + (section.end - section.nose) * u);
        const CwBladePoint suction = cw_blade_side(&section, CW_BLADE_SUCTION, section.nose + (end - section.nose) * u);
        const CwBladePoint nose = cw_blade_leading_edge(&section, M_PI * (u - 0.5));
        const auto off = [&](const CwBladePatch &patch, double at_u, const CwBladePoint &point) {
          return patch.band[0]->Value(at_u, j / 12).Distance(blade.at(j / 12, point));
        };
        assert_near(off(shape.pressure, u, pressure), 0, near);
        assert_near(off(shape.suction, u * shape.u_bevel, suction), 0, near);
        assert_near(off(shape.leading, u, nose), 0, near);
      }
    }
    assert_int_equal(shape.has_bevel, edge == CW_EDGE_BEVELLED || edge == CW_EDGE_SHARP);
    assert_int_equal(shape.has_trailing, edge != CW_EDGE_SHARP);
  }
}

// How far two patches lie apart along the edge at u of the one and at w of the other, over all bands.
static double apart(const CwBladePatch &a, double u, const CwBladePatch &b, double w) {
  double most = 0;
  assert_int_equal(a.band.size(), b.band.size());
  for (size_t band = 0; band < a.band.size(); band++)
    for (int k = 0; k <= 30; k++)
      most = std::max(most, a.band[band]->Value(u, k / 30.0).Distance(b.band[band]->Value(w, k / 30.0)));
  return most;
}

// The paper's blade whose trailing edge leans by 12 degrees.
static PaperBlade &leaning_blade() {
  static std::unique_ptr<PaperBlade> blade;
  if (!blade) {
    CwCase table = paper_with(CW_EDGE_BEVELLED);
    table.impeller.lean_angle = 12 * degree;
    std::unique_ptr<PaperBlade> made(new PaperBlade(table));
    made->make();
    blade = std::move(made);
  }
  return *blade;
}

static void neighbours_share_their_edges(void **) {
  enum { BARE, FILLETS, LEANING };
  for (const int kind : {BARE, FILLETS, LEANING})
    for (const CwTrailingEdge edge : edges) {
      if (kind == FILLETS && edge == CW_EDGE_SHARP) continue; // no design has both
      if (kind == LEANING && edge != CW_EDGE_BEVELLED) continue;
      PaperBlade &blade = kind == LEANING ? leaning_blade() : made_blade(edge, kind == FILLETS ? 1e-3 : 0);
      const CwBladeShape &s = blade.shapes[0];
      assert_near(apart(s.leading, 0, s.suction, 0), 0, 1e-9);
      assert_near(apart(s.leading, 1, s.pressure, 0), 0, 1e-9);
      if (s.has_bevel) assert_near(apart(s.suction, s.u_bevel, s.bevel, 0), 0, 1e-9);
      if (s.has_bevel && s.has_trailing) assert_near(apart(s.bevel, 1, s.trailing, 0), 0, 1e-9);
      if (!s.has_bevel) assert_near(apart(s.suction, 1, s.trailing, 0), 0, 1e-9);
      assert_near(apart(s.has_trailing ? s.trailing : s.bevel, 1, s.pressure, 1), 0, 1e-9);
      assert_int_equal(s.pressure.band.size(), kind == FILLETS ? 3 : 1);
    }
}

// A cut lies on D2, 200 mm; the foremost line of a rounding too. The facet of a bevel is as wide as it is asked for.
static void trailing_edges_end_on_the_outlet_diameter(void **) {
  for (const CwTrailingEdge edge : edges) {
    PaperBlade &blade = made_blade(edge);
    const CwBladeShape &s = blade.shapes[0];
    for (int k = 0; k <= 12; k++) {
      double most = 0, least = INFINITY;
      for (int i = 0; i <= 60 && s.has_trailing; i++) {
        const gp_Pnt x = s.trailing.band[0]->Value(i / 60.0, k / 12.0);
        most = std::max(most, std::hypot(x.X(), x.Y()));
        least = std::min(least, std::hypot(x.X(), x.Y()));
      }
      if (s.has_trailing) assert_near(most, 100, edge == CW_EDGE_ROUNDED ? 5e-3 : 1e-5);
      if (edge == CW_EDGE_BEVELLED || edge == CW_EDGE_BLUNT) assert_near(least, 100, 1e-5);
      const gp_Pnt corner = s.pressure.band[0]->Value(1, k / 12.0);
      if (edge != CW_EDGE_ROUNDED) assert_near(std::hypot(corner.X(), corner.Y()), 100, 1e-5);
    }
    if (!s.has_bevel) continue;
    const double wide = s.bevel.band[0]->Value(0, 0.5).Distance(s.bevel.band[0]->Value(1, 0.5));
    assert_near(wide, blade.design.trailing_edge_bevel, 0.03 * wide);
  }
}

// (r, z) of a wall at t and the normal of its surface of revolution at the angle theta, by the curve's tangent.
static gp_Pnt wall_point(const CwMeridianCurve &curve, double theta, double t, gp_Vec *normal = nullptr) {
  double x[2], dx[2];
  cw_meridian_point(&curve, t, x, dx);
  if (normal) *normal = gp_Vec(dx[1] * cos(theta), dx[1] * sin(theta), -dx[0]).Normalized();
  return gp_Pnt(x[0] * cos(theta), x[0] * sin(theta), x[1]);
}

// The lowest edge of each patch lies on hub and shroud, where its curve in (theta, t) says; that is the outline of the
// section, moved out by the foot of a fillet.
static void patches_end_on_both_walls(void **) {
  for (const double fillet : {0.0, 1e-3}) {
    PaperBlade &blade = made_blade(CW_EDGE_BEVELLED, fillet);
    for (CwBladePatch *patch : blade.shapes[0].patches())
      for (const int wall : {CW_HUB, CW_SHROUD}) {
        const CwMeridianCurve &curve = wall == CW_HUB ? blade.meridian.hub : blade.meridian.shroud;
        const double first = patch->u.front(), last = patch->u.back();
        for (int i = 0; i <= 200; i++) {
          const double u = first + (last - first) * i / 200;
          const gp_Pnt2d on = patch->on_wall[wall]->Value(u);
          const gp_Pnt edge = wall == CW_HUB ? patch->band.front()->Value(u, 0) : patch->band.back()->Value(u, 1);
          assert_near(edge.Distance(wall_point(curve, on.X(), on.Y())), 0, 1e-3);
        }
        for (size_t i = 0; i < patch->u.size(); i++) {
          const CwBladePoint &without = patch->points[i * CW_SPAN_POINTS + (wall == CW_HUB ? 0 : 12)];
          const CwBladePoint &with = patch->outline[wall][i];
          assert_near(with.q - without.q, fillet > 0 ? patch->foot[wall][i].q : 0, 1e-15);
          assert_near(with.theta - without.theta, fillet > 0 ? patch->foot[wall][i].theta : 0, 1e-15);
        }
      }
  }
}

static gp_Vec normal_of(const Handle(Geom_BSplineSurface) & surface, double u, double v) {
  gp_Pnt x;
  gp_Vec by_u, by_v;
  surface->D1(u, v, x, by_u, by_v);
  return by_u.Crossed(by_v).Normalized();
}

// A fillet leaves the wall along it and meets the blade smoothly; between lies the blade itself, from where the one
// fillet ends to where the other begins.
static void fillets_are_tangent_to_both(void **) {
  PaperBlade &blade = made_blade(CW_EDGE_BEVELLED, 1e-3), &plain = made_blade(CW_EDGE_BEVELLED);
  for (CwBladePatch *patch : {&blade.shapes[0].pressure, &blade.shapes[0].suction, &blade.shapes[0].leading}) {
    const CwBladePatch &bare = patch == &blade.shapes[0].pressure  ? plain.shapes[0].pressure
                               : patch == &blade.shapes[0].suction ? plain.shapes[0].suction
                                                                   : plain.shapes[0].leading;
    const double last = patch->u.back();
    for (int i = 1; i < 40; i++) {
      const double u = last * i / 40;
      for (const int wall : {CW_HUB, CW_SHROUD}) {
        const Handle(Geom_BSplineSurface) &fillet = patch->band[wall == CW_HUB ? 0 : 2];
        const gp_Pnt2d on = patch->on_wall[wall]->Value(u);
        const double foot = wall == CW_HUB ? 0 : 1;
        gp_Vec of_wall;
        wall_point(wall == CW_HUB ? blade.meridian.hub : blade.meridian.shroud, on.X(), on.Y(), &of_wall);
        const double at_foot = normal_of(fillet, u, foot).Angle(of_wall);
        assert_near(std::min(at_foot, M_PI - at_foot), 0, 1 * degree);
        assert_near(normal_of(fillet, u, 1 - foot).Angle(normal_of(patch->band[1], u, foot)), 0, 1.5 * degree);
        assert_near(fillet->Value(u, 1 - foot).Distance(patch->band[1]->Value(u, foot)), 0, 1e-9);
      }
      // Of the same surface as without fillets: not off it by more than the fit of the nose's points allows.
      if (patch == &blade.shapes[0].leading) continue;
      const gp_Pnt x = patch->band[1]->Value(u, 0.4);
      const auto off = [&](double v) { return x.Distance(bare.band[0]->Value(u, v)); };
      double low = 0, high = 1;
      for (int k = 0; k < 60; k++) { // where it is nearest: the distance has one least value
        const double a = (2 * low + high) / 3, b = (low + 2 * high) / 3;
        (off(a) < off(b) ? high : low) = off(a) < off(b) ? b : a;
      }
      assert_near(off(low), 0, 1e-4);
    }
  }
}

// A ball of 1 mm between blade and wall touches both at the length L from their crease; the middle of its arc lies
// sqrt(R^2 + L^2) - R from it.
static void fillets_are_arcs(void **) {
  PaperBlade &blade = made_blade(CW_EDGE_BEVELLED, 1e-3), &plain = made_blade(CW_EDGE_BEVELLED);
  for (const bool pressure : {true, false})
    for (const int wall : {CW_HUB, CW_SHROUD})
      for (double u = 0.25; u < 0.75; u += 0.05) {
        const CwBladeShape &with = blade.shapes[0], &without = plain.shapes[0];
        const double foot = wall == CW_HUB ? 0 : 1;
        const gp_Pnt crease = (pressure ? without.pressure : without.suction).band[0]->Value(u, foot);
        const Handle(Geom_BSplineSurface) &fillet =
            (pressure ? with.pressure : with.suction).band[wall == CW_HUB ? 0 : 2];
        const double length = crease.Distance(fillet->Value(u, foot)), up = crease.Distance(fillet->Value(u, 1 - foot));
        assert_near(up, length, 0.02 * length);
        assert_near(crease.Distance(fillet->Value(u, 0.5)), std::hypot(1, length) - 1, 0.02 * length);
      }
}

// The mean line's angle on a wall at its end, where tan(beta) = dm / (r dtheta).
static double angle_at(const Handle(Geom_BSplineCurve) & guide, double u) {
  gp_Pnt x;
  gp_Vec along;
  guide->D1(u, x, along);
  const double r = std::hypot(x.X(), x.Y());
  const double turn = (x.X() * along.Y() - x.Y() * along.X()) / r, out = (x.X() * along.X() + x.Y() * along.Y()) / r;
  return std::atan2(std::hypot(out, along.Z()), turn);
}

// From the eye, where they run along the meridian, to the tip of the nose, along the mean line: on their wall all the
// way, at even speed, and turned by no more than a fifth of the room between.
static void guide_lines_lead_from_the_eye_to_the_nose(void **) {
  for (const double splitter : {0.0, 0.4}) {
    PaperBlade &blade = made_blade(CW_EDGE_BEVELLED, 0, splitter);
    for (const CwBladeShape &s : blade.shapes)
      for (const int wall : {CW_HUB, CW_SHROUD}) {
        const CwMeridianCurve &curve = wall == CW_HUB ? blade.meridian.hub : blade.meridian.shroud;
        const CwBladeSection &section = s.section[wall == CW_HUB ? 0 : 12];
        const Handle(Geom_BSplineCurve) &guide = s.guide[wall];
        // A splitter's goes on as the blades' mean line to their leading edge, q = 0, before it turns.
        const double mean = cw_blade_theta(&section, 0), before = -section.start / (1 - section.start);
        const double turned = s.theta_up[wall] - cw_blade_theta(&section, before);
        assert_near(guide->Value(0).Distance(wall_point(curve, s.theta_up[wall], 0)), 0, 1e-9);
        assert_near(guide->Value(1).Distance(blade.at(section.span, {section.start, mean})), 0, 1e-6);
        assert_near(angle_at(guide, 0), 90 * degree, 0.02 * degree);
        assert_near(angle_at(guide, 1), M_PI - cw_blade_beta(&section, 0), 0.05 * degree);
        assert_true(turned > 0 && turned < 0.2 * blade.room_of(s) * 1.001);
        gp_Pnt x;
        gp_Vec along, first;
        guide->D1(0, x, first);
        for (int i = 0; i <= 300; i++) {
          const gp_Pnt2d on = s.guide_on_wall[wall]->Value(i / 300.0);
          guide->D1(i / 300.0, x, along);
          assert_near(x.Distance(wall_point(curve, on.X(), on.Y())), 0, 1e-4);
          assert_near(along.Magnitude() / first.Magnitude(), 1, 1e-3);
        }
      }
  }
}

// With fillets the line ends at the tip of the nose's foot.
static void guide_lines_end_at_the_foot(void **) {
  PaperBlade &blade = made_blade(CW_EDGE_BEVELLED, 1e-3);
  const CwBladeShape &s = blade.shapes[0];
  for (const int wall : {CW_HUB, CW_SHROUD}) {
    const gp_Pnt tip = wall == CW_HUB ? s.leading.band.front()->Value(0.5, 0) : s.leading.band.back()->Value(0.5, 1);
    assert_near(s.guide[wall]->Value(1).Distance(tip), 0, 1e-6);
    assert_near(angle_at(s.guide[wall], 0), 90 * degree, 0.02 * degree);
  }
}

// The end of the pressure side, by its angle and by where the wall passes D2.
static void corners_lie_where_they_say(void **) {
  for (int lean = 0; lean < 2; lean++) {
    const PaperBlade &blade = lean ? leaning_blade() : made_blade(CW_EDGE_BEVELLED);
    const CwBladeShape &s = blade.shapes[0];
    for (const int wall : {CW_HUB, CW_SHROUD}) {
      const CwMeridianCurve &curve = wall == CW_HUB ? blade.meridian.hub : blade.meridian.shroud;
      const gp_Pnt corner = s.pressure.band[0]->Value(1, wall == CW_HUB ? 0 : 1);
      assert_near(corner.Distance(wall_point(curve, s.theta_corner[wall], s.t_corner[wall])), 0, 1e-6);
    }
    const double apart = s.theta_corner[CW_SHROUD] - s.theta_corner[CW_HUB];
    if (lean)
      assert_near(apart, 8 * tan(12 * degree) / 100, 1e-6);
    else
      assert_true(apart == 0);
  }
}

// From the eye to the interface, along the meridian at both ends, and on the shifted mean line between.
static void seams_cross_the_whole_passage(void **) {
  PaperBlade blade(paper_with(CW_EDGE_BEVELLED));
  blade.add_seams(2);
  const CwBladeShape &seam = blade.shapes[1];
  assert_true(seam.seam);
  for (const int wall : {CW_HUB, CW_SHROUD}) {
    const CwMeridianCurve &curve = wall == CW_HUB ? blade.meridian.hub : blade.meridian.shroud;
    const CwBladeOnWall on = cw_blade_on_wall(&blade.meridian, wall);
    const Handle(Geom_BSplineCurve) &guide = seam.guide[wall];
    assert_near(guide->Value(0).Distance(wall_point(curve, seam.theta_up[wall], 0)), 0, 1e-9);
    assert_near(guide->Value(1).Distance(wall_point(curve, seam.theta_corner[wall], 1)), 0, 1e-9);
    assert_near(angle_at(guide, 0), 90 * degree, 0.05 * degree);
    assert_near(angle_at(guide, 1), 90 * degree, 0.05 * degree);
    // Where the wall is a third of the blade's length behind its leading edge.
    const double t = cw_meridian_parameter(&curve, on.begin + on.length / 3);
    const CwBladeSection &own = blade.shapes[0].section[wall == CW_HUB ? 0 : 12];
    double low = 0, high = 1;
    for (int i = 0; i < 60; i++) {
      const double u = (low + high) / 2;
      (seam.guide_on_wall[wall]->Value(u).Y() < t ? low : high) = u;
    }
    assert_near(seam.guide_on_wall[wall]->Value(low).X() - cw_blade_theta(&own, 1.0 / 3), 30 * degree, 1e-4);
  }
}

// Each names the value and what to lower.
static void trailing_edges_that_do_not_fit(void **) {
  CwCase table = paper_with(CW_EDGE_BEVELLED);
  table.impeller.trailing_edge_bevel = 5e-3;
  PaperBlade bevel(table);
  std::string text = refusal_of(bevel);
  assert_int_equal(text.find("the bevel of 5 mm is longer than the trailing edge of the blade"), 0);
  assert_true(text.find("lower trailing_edge_bevel_mm to ") != std::string::npos);
  PaperBlade round(paper_with(CW_EDGE_ROUNDED));
  round.design.trailing_edge_thickness = 30;
  round.shapes[0].section.clear();
  for (int j = 0; j < CW_SPAN_POINTS; j++) round.shapes[0].section.push_back(round.section_at(j / 12.0));
  text = refusal_of(round);
  assert_int_equal(text.find("the rounding of the trailing edge begins at "), 0);
  assert_true(text.find("allowed: from 80 % on: lower trailing_edge_thickness_mm (30 mm)") != std::string::npos);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sides_are_those_of_the_sections),
      cmocka_unit_test(neighbours_share_their_edges),
      cmocka_unit_test(trailing_edges_end_on_the_outlet_diameter),
      cmocka_unit_test(patches_end_on_both_walls),
      cmocka_unit_test(fillets_are_tangent_to_both),
      cmocka_unit_test(guide_lines_lead_from_the_eye_to_the_nose),
      cmocka_unit_test(fillets_are_arcs),
      cmocka_unit_test(guide_lines_end_at_the_foot),
      cmocka_unit_test(corners_lie_where_they_say),
      cmocka_unit_test(seams_cross_the_whole_passage),
      cmocka_unit_test(trailing_edges_that_do_not_fit),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
