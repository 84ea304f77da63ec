// SPDX-License-Identifier: AGPL-3.0-or-later
// Feet and heights of the root fillets of the paper's blade, in mm, against those of a ball that rolls along the crease
// (root_fillet_size.h). Vectors on a wall are (downstream, in the sense of theta).
#include "geometry/root_fillet.hpp"

#include <cstdio>
#include <stdexcept>

#include "geometry/root_fillet_size.h"
#include "tests/geometry/paper_blade.hpp"
#include "tests/unit_test.h"

static const double radius = 1e-3;                                                        // m
static const CwTrailingEdge edges[] = {CW_EDGE_BEVELLED, CW_EDGE_BLUNT, CW_EDGE_ROUNDED}; // a sharp one has no fillets

struct Vector {
  double m, t;
};
static double dot(const Vector &a, const Vector &b) {
  return a.m * b.m + a.t * b.t;
}
static double size(const Vector &a) {
  return std::sqrt(dot(a, a));
}

// One patch on one wall.
struct Foot {
  const PaperBlade &blade;
  const CwBladePatch &patch;
  int wall;

  size_t last() const {
    return patch.u.size() - 1;
  }
  const CwBladePoint &point(size_t i) const {
    return patch.points[i * CW_SPAN_POINTS + (wall == CW_HUB ? 0 : CW_SPAN_POINTS - 1)];
  }
  CwFilletPlace place(size_t i) const {
    const std::vector<CwBladeSection> &section = blade.shapes[0].section;
    return cw_root_fillet_place(&blade.meridian, &section[wall == CW_HUB ? 0 : 12], &section[wall == CW_HUB ? 1 : 11],
                                point(i).q);
  }
  Vector foot(size_t i) const {
    const CwFilletPlace at = place(i);
    return {patch.foot[wall][i].q * at.speed, patch.foot[wall][i].theta * at.radius};
  }
  // Of the outline, out of the blade: to the left where the fluid lies there. From the point before to that behind; at
  // an end along the parabola through three points.
  Vector normal(size_t i, bool left) const {
    const CwFilletPlace at = place(i);
    const size_t k = std::min(std::max<size_t>(i, 1), last() - 1); // the middle one
    const double w[3] = {i < k ? -3. : i > k ? 1. : -1., i < k ? 4. : i > k ? -4. : 0., i < k ? -1. : i > k ? 3. : 1.};
    Vector along = {0, 0};
    for (int j = 0; j < 3; j++) {
      along.m += w[j] * point(k + j - 1).q * at.speed;
      along.t += w[j] * point(k + j - 1).theta * at.radius;
    }
    const double length = size(along) * (left ? 1 : -1);
    return {-along.t / length, along.m / length};
  }
  double ball(size_t i, const Vector &normal, double *angle) const {
    const CwFilletPlace at = place(i);
    *angle = cw_root_fillet_angle(&at, normal.m, normal.t);
    return cw_root_fillet_length(&blade.design, &blade.shapes[0].section[wall == CW_HUB ? 0 : 12], point(i).q, *angle);
  }
};

// Along a side, away from its ends: square to the outline, as long as the ball's tangents, on the wall and up the
// blade; the handles are those of a cubic that is nearest to an arc of pi - alpha.
static void sides_have_the_balls_feet(void **) {
  PaperBlade &blade = made_blade(CW_EDGE_BEVELLED, radius);
  for (const int wall : {CW_HUB, CW_SHROUD})
    for (const bool pressure : {true, false}) {
      const CwBladeShape &shape = blade.shapes[0];
      const Foot side = {blade, pressure ? shape.pressure : shape.suction, wall};
      int seen = 0;
      for (size_t i = 0; i <= side.last(); i++) {
        const double f = side.patch.u[i] / side.patch.u.back();
        if (f < 0.2 || f > 0.8) continue;
        const Vector normal = side.normal(i, pressure), foot = side.foot(i);
        double alpha;
        const double length = side.ball(i, normal, &alpha), arc = M_PI - alpha;
        assert_near(size(foot), length, 1e-3 * length);
        assert_near(dot(foot, normal) / length, 1, 1e-3);
        assert_true(pressure ? foot.t > 0 : foot.t < 0);
        assert_near(side.patch.reach[wall][i] * side.place(i).height, length * std::sin(alpha), 1e-3 * length);
        assert_near(side.patch.handle[wall][i], 4.0 / 3 * std::tan(arc / 4) / std::tan(arc / 2), 1e-3);
        seen++;
      }
      assert_true(seen > 50);
    }
}

// Round an edge the feet point out of the blade all the way. Sizes are those of a normal that turns from rest to rest,
// in the sense of the outline: clockwise as (m, t) is drawn where the fluid lies on its left.
static void check_round(const Foot &edge, bool left) {
  const Vector first = edge.normal(0, left), end = edge.normal(edge.last(), left);
  const double sense = left ? -1 : 1;
  const double least = std::atan2(first.m * end.t - first.t * end.m, dot(first, end));
  const double whole = least * sense > 0 ? least : least + sense * 2 * M_PI;
  double turn = 0, alpha;
  assert_near(whole, sense * M_PI, 0.35); // but for what the sides of the blade are not parallel
  for (size_t i = 0; i <= edge.last(); i++) {
    const Vector foot = edge.foot(i), normal = edge.normal(i, left);
    const double length = edge.ball(i, normal, &alpha), f = edge.patch.u[i], by = whole * cw_smooth_step(f);
    assert_true(dot(foot, normal) > 0.95 * size(foot));
    assert_true(size(foot) > 0.6 * length && size(foot) < 1.4 * length);
    if (f > 0.2 && f < 0.8) {
      const Vector turned = {first.m * cos(by) - first.t * sin(by), first.m * sin(by) + first.t * cos(by)};
      const double tangent = edge.ball(i, turned, &alpha), up = tangent * std::sin(alpha);
      assert_near(edge.patch.reach[edge.wall][i] * edge.place(i).height, up, 2e-3 * up);
    }
    if (i == 0) continue;
    const Vector before = edge.foot(i - 1);
    turn += std::atan2(before.m * foot.t - before.t * foot.m, dot(before, foot));
  }
  assert_near(turn, whole, 0.35);
  const Vector middle = edge.foot(edge.last() / 2);
  assert_true(left ? middle.m < 0 : middle.m > 0);
}

static void round_edges_have_feet_all_round(void **) {
  for (const int wall : {CW_HUB, CW_SHROUD}) {
    const PaperBlade &blade = made_blade(CW_EDGE_ROUNDED, radius);
    check_round({blade, blade.shapes[0].leading, wall}, true);
    check_round({blade, blade.shapes[0].trailing, wall}, false);
  }
}

static void same(const CwBladePatch &a, bool a_end, const CwBladePatch &b, bool b_end) {
  for (const int wall : {CW_HUB, CW_SHROUD}) {
    const size_t i = a_end ? a.u.size() - 1 : 0, k = b_end ? b.u.size() - 1 : 0;
    assert_near(a.foot[wall][i].q, b.foot[wall][k].q, 1e-12);
    assert_near(a.foot[wall][i].theta, b.foot[wall][k].theta, 1e-12);
    assert_near(a.reach[wall][i], b.reach[wall][k], 1e-12);
    assert_near(a.handle[wall][i], b.handle[wall][k], 1e-12);
  }
}

static void neighbours_have_one_foot(void **) {
  for (const CwTrailingEdge edge : edges) {
    PaperBlade &blade = made_blade(edge, radius);
    const CwBladeShape &s = blade.shapes[0];
    same(s.leading, false, s.suction, false);
    same(s.leading, true, s.pressure, false);
    same(s.suction, true, s.has_bevel ? s.bevel : s.trailing, false);
    if (s.has_bevel && s.has_trailing) same(s.bevel, true, s.trailing, false);
    same(s.pressure, true, s.has_trailing ? s.trailing : s.bevel, true);
  }
}

// Where a facet leaves the suction side, and the cut the facet, the foot lies as far off both lines: a mitre. Between
// them it runs straight.
static void corners_have_mitres(void **) {
  PaperBlade &blade = made_blade(CW_EDGE_BEVELLED, radius);
  const CwBladeShape &s = blade.shapes[0];
  for (const int wall : {CW_HUB, CW_SHROUD}) {
    const Foot suction = {blade, s.suction, wall}, bevel = {blade, s.bevel, wall}, cut = {blade, s.trailing, wall};
    const struct {
      Vector foot, normal[2];
    } corners[] = {{bevel.foot(0), {suction.normal(suction.last(), false), bevel.normal(0, false)}},
                   {cut.foot(0), {bevel.normal(bevel.last(), false), cut.normal(0, false)}}};
    for (const auto &corner : corners) {
      const double off[2] = {dot(corner.foot, corner.normal[0]), dot(corner.foot, corner.normal[1])};
      assert_true(off[0] > 0.1);
      assert_near(off[0], off[1], 0.02 * off[0]);
      assert_true(dot(corner.normal[0], corner.normal[1]) < 0.95); // a corner it is
    }
    for (const Foot *facet : {&bevel, &cut})
      for (size_t i = 0; i <= facet->last(); i++) {
        const double f = (double)i / facet->last();
        const Vector begin = facet->foot(0), end = facet->foot(facet->last()), foot = facet->foot(i);
        assert_near(foot.m, begin.m + f * (end.m - begin.m), 2e-3);
        assert_near(foot.t, begin.t + f * (end.t - begin.t), 2e-3);
      }
  }
}

// A mitre is no longer than 1.6 tangents: of a blunt edge the suction side and the cut meet at a wedge.
static void sharp_corners_have_short_mitres(void **) {
  PaperBlade &blade = made_blade(CW_EDGE_BLUNT, radius);
  const CwBladeShape &s = blade.shapes[0];
  for (const int wall : {CW_HUB, CW_SHROUD}) {
    const Foot suction = {blade, s.suction, wall}, cut = {blade, s.trailing, wall};
    const Vector one = suction.normal(suction.last(), false), other = cut.normal(0, false);
    double alpha, beta;
    const double length = (suction.ball(suction.last(), one, &alpha) + cut.ball(0, other, &beta)) / 2;
    assert_true(dot(one, other) < 2 / (1.6 * 1.6) - 1); // 1 / cos of half their angle is more than that
    assert_near(size(cut.foot(0)), 1.6 * length, 0.01 * length);
  }
}

// Sizes and angles begin and end at rest: the first and last steps change them by far less than those beyond.
static void sizes_rest_at_the_ends_of_sides(void **) {
  PaperBlade &blade = made_blade(CW_EDGE_ROUNDED, radius);
  const CwBladeShape &s = blade.shapes[0];
  for (const int wall : {CW_HUB, CW_SHROUD})
    for (const CwBladePatch *patch : {&s.pressure, &s.suction, &s.leading}) {
      const size_t n = patch->u.size() - 1;
      const std::vector<double> &handle = patch->handle[wall]; // by the angle alone
      const auto rate = [&](size_t i) {
        return std::fabs((handle[i + 1] - handle[i]) / (patch->u[i + 1] - patch->u[i]));
      };
      double most = 0;
      for (size_t i = 0; i < n; i++) most = std::max(most, rate(i));
      assert_true(most > 1e-3);
      assert_true(rate(0) < 0.05 * most && rate(n - 1) < 0.05 * most);
    }
}

// What is advised fits; a little more than what is refused does not either.
static void too_large_fillets_are_refused(void **) {
  double given, share, advised;
  PaperBlade large(paper_with(CW_EDGE_BEVELLED, radius));
  large.design.root_fillet_radius = 3.6;
  const std::string text = refusal_of(large);
  assert_int_equal(sscanf(text.c_str(),
                          "root fillets of %lf mm take %lf %% of the blade's height, 85 %% are allowed: lower "
                          "root_fillet_radius_mm to %lf",
                          &given, &share, &advised),
                   3);
  assert_near(given, 3.6, 1e-9);
  assert_true(share > 85 && advised < 3.6 && advised > 2.5);
  PaperBlade less(paper_with(CW_EDGE_BEVELLED, radius)), more(paper_with(CW_EDGE_BEVELLED, radius));
  less.design.root_fillet_radius = advised;
  assert_string_equal(refusal_of(less).c_str(), "");
  more.design.root_fillet_radius = advised / 0.98 * 1.01;
  assert_int_equal(refusal_of(more).find("root fillets of "), 0);
}

// A leading edge that lies nearer to the begin of a wall than the fillet's foot is long.
static void fillets_before_the_eye_are_refused(void **) {
  CwCase table = paper_with(CW_EDGE_BEVELLED, radius);
  table.impeller.leading_edge_radius_shroud = 37.01e-3;
  PaperBlade blade(table);
  blade.design.root_fillet_radius = 2;
  assert_true(blade.meridian.shroud_leading > 0.1 && blade.meridian.shroud_leading < 1.6);
  const std::string text = refusal_of(blade);
  if (text.find("have no room before the blade's leading edge on the shroud: lower root_fillet_radius_mm, or raise "
                "leading_edge_radius_shroud_mm") == std::string::npos)
    fail_msg("'%s', %g before the edge", text.c_str(), blade.meridian.shroud_leading);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sides_have_the_balls_feet),       cmocka_unit_test(round_edges_have_feet_all_round),
      cmocka_unit_test(neighbours_have_one_foot),        cmocka_unit_test(corners_have_mitres),
      cmocka_unit_test(sharp_corners_have_short_mitres), cmocka_unit_test(sizes_rest_at_the_ends_of_sides),
      cmocka_unit_test(too_large_fillets_are_refused),   cmocka_unit_test(fillets_before_the_eye_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
