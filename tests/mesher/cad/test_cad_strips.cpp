// SPDX-License-Identifier: AGPL-3.0-or-later
// Prisms with a narrow wall: which of them are strips, how these hang together, and which row of a chain stays. Floor
// and lid are open, but for what a test asks of other faces.
#include <algorithm>
#include <cmath>
#include <vector>

#include <BRepPrimAPI_MakeRevol.hxx>
#include <GC_MakeArcOfCircle.hxx>

#include "mesher/cad/cad_strips.h"
#include "mesher/common/vec.h"
#include "polyhedron.h"
#include "solids.h"

static const double height = 30; // mm

// A prism over corners that run anticlockwise, or a frustum with the corners `top` above. Walls are numbered by their
// first corner; those of `split` are two, below and above `middle`; all upper ones are listed behind the others.
struct Profile {
  std::vector<gp_XY> corner, top;
  std::vector<int> split;
  double middle = height / 2;

  TopoDS_Shape solid() const {
    const int n = (int)corner.size();
    std::vector<gp_Pnt> point;
    std::vector<std::vector<int>> loops, upper;
    std::vector<int> floor, lid;
    const auto is_split = [&](int wall) { return std::count(split.begin(), split.end(), (wall + n) % n) > 0; };
    for (int level = 0; level < 3; level++) {
      const double z = level == 0 ? 0 : level == 1 ? middle : height, s = z / height;
      for (int i = 0; i < n; i++) {
        const gp_XY xy = top.empty() ? corner[i] : corner[i] * (1 - s) + top[i] * s;
        point.push_back(gp_Pnt(xy.X(), xy.Y(), z));
      }
    }
    for (int i = 0; i < n; i++) {
      const int next = (i + 1) % n;
      floor.insert(floor.begin(), i);
      lid.push_back(2 * n + i);
      if (is_split(i)) {
        loops.push_back({i, next, n + next, n + i});
        upper.push_back({n + i, n + next, 2 * n + next, 2 * n + i});
        continue;
      }
      loops.push_back({i, next});
      if (is_split(i + 1)) loops.back().push_back(n + next);
      loops.back().insert(loops.back().end(), {2 * n + next, 2 * n + i});
      if (is_split(i - 1)) loops.back().push_back(n + i);
    }
    loops.insert(loops.end(), upper.begin(), upper.end());
    loops.push_back(floor);
    loops.push_back(lid);
    return polyhedron(point, loops);
  }
};

static gp_Dir normal_of(const TopoDS_Face &face) {
  return BRepAdaptor_Surface(face).Plane().Axis().Direction();
}

static std::string open_ends(const TopoDS_Face &face) {
  return std::fabs(normal_of(face).Z()) > 0.99 ? "ends,inlet" : "wall,wall";
}

// A solid with its chains.
struct Chains {
  CwCad *cad;
  std::vector<CwCadChain> chain;

  explicit Chains(const TopoDS_Shape &solid, const PatchOfFace &patch_of = open_ends)
      : cad(open_solid(solid, patch_of)), chain(cw_cad_chains(cad)) {}
  ~Chains() {
    cw_cad_close(&cad);
  }
  // The strips of the one chain; of none 0.
  size_t strips() const {
    assert_true(chain.size() <= 1);
    return chain.empty() ? 0 : chain[0].size();
  }
  // Whether a row of a strip borders a wall that looks along an axis.
  bool borders(const CwCadChainStrip &strip, int row, int axis) const {
    for (const CwCadUse &use : strip.side[row]) {
      double n[3];
      const double uv[2] = {0, 0};
      cw_cad_face_normal(cad, cw_cad_beyond(cad, use.edge, strip.face), uv, n);
      if (std::fabs(n[axis]) < 0.999) return false;
    }
    return true;
  }
  // Whether it is the row at the wall y = 0 that stays, along all the chain.
  bool stays_at_y() const {
    assert_int_equal(chain.size(), 1);
    const CwCadChainStrip &first = chain[0][0];
    const bool at_y = borders(first, first.stays, 1);
    for (const CwCadChainStrip &strip : chain[0]) {
      assert_true(borders(strip, strip.stays, at_y ? 1 : 0));
      assert_true(borders(strip, 1 - strip.stays, at_y ? 0 : 1));
    }
    return at_y;
  }
};

// A square of 20 mm whose corner at the origin is cut off from (a, 0) to (0, b): wall 4. Its corners begin at the one
// given.
static Profile chamfered(double a, double b, int first = 0) {
  Profile made;
  made.corner = {gp_XY(a, 0), gp_XY(20, 0), gp_XY(20, 20), gp_XY(0, 20), gp_XY(0, b)};
  std::rotate(made.corner.begin(), made.corner.begin() + first, made.corner.end());
  return made;
}

// The same, cut from (c, 0) to (0, d) above.
static Profile tapered(double a, double b, double c, double d, int first = 0) {
  Profile made = chamfered(a, b, first);
  made.top = chamfered(c, d, first).corner;
  return made;
}

// Sides and ends follow one another round the loop; between the sides are the widths, in between the middles.
static void a_strip_is_measured(void **) {
  const Chains found(tapered(0.5, 0.5, 1.5, 1.5).solid());
  assert_int_equal(found.strips(), 1);
  const CwCad *cad = found.cad;
  const CwCadChainStrip &strip = found.chain[0][0];
  const CwCadUse round[4] = {strip.side[0][0], strip.end[0], strip.side[1][0], strip.end[1]};
  for (int k = 0; k < 4; k++) {
    assert_int_equal(cw_cad_use_vertex(cad, round[k], 1), cw_cad_use_vertex(cad, round[(k + 1) % 4], 0));
    int face[2];
    cw_cad_edge_faces(cad, round[k].edge, face);
    assert_true(face[0] == strip.face || face[1] == strip.face);
    assert_int_equal(cw_cad_beyond(cad, round[k].edge, strip.face), face[0] + face[1] - strip.face);
    for (int end = 0; end < 2; end++) {
      double x[3], v[3];
      cw_cad_edge_point(cad, round[k].edge, cw_cad_use_at(cad, round[k], end), x, nullptr);
      cw_cad_vertex_point(cad, cw_cad_use_vertex(cad, round[k], end), v);
      assert_near(cw_distance(x, v), 0, 1e-12);
      assert_int_equal(cw_cad_side_ends_at(cad, strip.side[0], cw_cad_use_vertex(cad, round[k], end)),
                       k == 0 || (k == 1 && end == 0) || (k == 3 && end == 1));
    }
  }
  const double along = std::hypot(1, height); // of either side
  assert_near(strip.length, 1e-3 * along, 1e-12);
  const bool down = strip.width[0] > strip.width[8];
  for (int i = 0; i < CW_CAD_STRIP_SAMPLES; i++) {
    const double s = (down ? 8 - i : i) / 8.0, cut = 0.5 + s;
    assert_near(strip.width[i], 1e-3 * std::sqrt(2) * cut, 1e-12);
    const double middle[3] = {1e-3 * cut / 2, 1e-3 * cut / 2, 1e-3 * height * s};
    assert_near(cw_distance(strip.x[i], middle), 0, 1e-12);
  }
}

// The flow between walls that meet at 30 degrees or more. A blunt tip of 0.5 mm, whose walls end 20 mm apart.
static void walls_may_meet_at_thirty_degrees(void **) {
  for (double angle : {29.0, 31.0, 90.0, 150.0}) {
    const double c = std::cos(angle / 2 * M_PI / 180), s = std::sin(angle / 2 * M_PI / 180), tip = 0.25 / s,
                 far = 20 / s;
    Profile wedge;
    wedge.corner = {gp_XY(tip * c, -tip * s), gp_XY(far * c, -far * s), gp_XY(far * c, far * s),
                    gp_XY(tip * c, tip * s)};
    assert_int_equal(Chains(wedge.solid()).strips(), angle > 30 ? 1 : 0);
  }
}

// Over a plane wall of 40 mm the strip rises or falls between two parallel walls: at more than 10 degrees it is a step.
// No slope: all is one plane.
static void a_step_is_no_strip(void **) {
  for (double angle : {0.0, 9.0, -9.0, 11.0, -11.0, 45.0, -80.0}) {
    const double rise = 0.5 * std::sin(angle * M_PI / 180), run = 0.5 * std::cos(angle * M_PI / 180);
    Profile wall;
    wall.corner = {gp_XY(0, 0), gp_XY(20, 0), gp_XY(20 + run, rise), gp_XY(40, rise), gp_XY(40, 40), gp_XY(0, 40)};
    assert_int_equal(Chains(wall.solid()).strips(), std::fabs(angle) < 10 ? 1 : 0);
  }
}

// Where the flow bends round the narrow wall, as round the nose of a blade. A corner of 270 degrees, cut off.
static void a_crest_is_no_strip(void **) {
  Profile crest;
  crest.corner = {gp_XY(0, 0),     gp_XY(40, 0),    gp_XY(40, 40), gp_XY(20, 40),
                  gp_XY(20, 20.3), gp_XY(19.7, 20), gp_XY(0, 20)};
  assert_int_equal(Chains(crest.solid()).strips(), 0);
}

// A cut at 15 degrees to one wall, 75 to the other, has sines 0.71 apart; at 30 degrees 0.37. 0.5 is the limit.
static void an_uneven_cut_is_part_of_its_wall(void **) {
  for (double angle : {15.0, 24.0, 25.0, 30.0, 60.0, 65.0, 66.0, 75.0}) {
    const double c = std::cos(angle * M_PI / 180), s = std::sin(angle * M_PI / 180);
    assert_int_equal(Chains(chamfered(0.7 * c, 0.7 * s).solid()).strips(), std::fabs(c - s) < 0.5 ? 1 : 0);
  }
}

// A strip from the floor to half of the height, in one wall that goes on round it; where it goes up to the lid it
// divides the wall.
static void a_strip_lies_between_two_walls(void **) {
  const double x[2] = {19.75, 20.25};
  for (bool up : {false, true}) {
    const double end = up ? height : height / 2;
    const std::vector<gp_Pnt> point = {gp_Pnt(0, 0, 0),        gp_Pnt(40, 0, 0),      gp_Pnt(40, 40, 0),
                                       gp_Pnt(0, 40, 0),       gp_Pnt(0, 0, height),  gp_Pnt(40, 0, height),
                                       gp_Pnt(40, 40, height), gp_Pnt(0, 40, height), gp_Pnt(x[0], 0, 0),
                                       gp_Pnt(x[1], 0, 0),     gp_Pnt(x[1], 0, end),  gp_Pnt(x[0], 0, end)};
    std::vector<std::vector<int>> loops = {
        {8, 9, 10, 11}, {3, 2, 1, 9, 8, 0}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    if (up)
      loops.insert(loops.end(), {{0, 8, 11, 4}, {9, 1, 5, 10}, {4, 11, 10, 5, 6, 7}});
    else
      loops.insert(loops.end(), {{0, 8, 11, 10, 9, 1, 5, 4}, {4, 5, 6, 7}});
    assert_int_equal(Chains(polyhedron(point, loops)).strips(), up ? 1 : 0);
  }
}

// The longer row stays, whatever patches lie beyond: cut lines that lean by 1 and by 0.5 mm over the height.
static void the_longer_row_stays(void **) {
  for (int first = 0; first < 5; first += 2) {
    for (bool patches : {false, true}) {
      const PatchOfFace by_axis = [=](const TopoDS_Face &face) -> std::string {
        return patches && std::fabs(normal_of(face).X()) > 0.999 ? "across,wall" : open_ends(face);
      };
      const Chains at_y(tapered(0.5, 0.25, 1.5, 0.75, first).solid(), by_axis);
      assert_true(at_y.stays_at_y());
      assert_near(at_y.chain[0][0].length, 1e-3 * std::hypot(1, height), 1e-12);
      assert_false(Chains(tapered(0.25, 0.5, 0.75, 1.5, first).solid(), by_axis).stays_at_y());
    }
  }
}

// Of rows of one length that stays beyond which is the patch that is listed first: that of the walls across y, or x.
static void the_first_patch_keeps_its_row(void **) {
  for (int first = 0; first < 2; first++) {
    const Chains found(chamfered(0.5, 0.5, first).solid(), [](const TopoDS_Face &face) -> std::string {
      return std::fabs(normal_of(face).X()) > 0.999 ? "across,wall" : open_ends(face);
    });
    const CwCadChainStrip &strip = found.chain[0][0];
    int patch[2];
    for (int row = 0; row < 2; row++)
      patch[row] = cw_cad_face_patch(found.cad, cw_cad_beyond(found.cad, strip.side[row][0].edge, strip.face));
    assert_int_equal(strip.stays, patch[1] < patch[0]);
    assert_int_equal(found.stays_at_y(), first == 0);
  }
}

// Else the one on the right of the way from the shorter end to the longer, seen from out of the fluid: that is d x n
// for a way d and the normal n out. Going up the cut off corner it lies at y = 0.
static void rows_alike_are_told_by_hand(void **) {
  for (int first = 0; first < 5; first += 2) {
    assert_true(Chains(tapered(0.5, 0.5, 1, 1, first).solid()).stays_at_y());
    assert_false(Chains(tapered(1, 1, 0.5, 0.5, first).solid()).stays_at_y());
  }
}

// A side of two edges can stay, but cannot go.
static void rows_of_two_edges_stay(void **) {
  const int at_y = 0, at_x = 3, cut = 4;
  Profile profile = chamfered(0.5, 0.5);
  for (int wall : {at_y, at_x}) {
    profile.split = {wall};
    const Chains found(profile.solid());
    assert_int_equal(found.strips(), 1);
    assert_int_equal(found.stays_at_y(), wall == at_y);
    const CwCadChainStrip &strip = found.chain[0][0];
    assert_int_equal(strip.side[strip.stays].size(), 2);
    assert_int_equal(strip.side[1 - strip.stays].size(), 1);
    assert_near(strip.length, 1e-3 * height, 1e-12);
    for (double width : strip.width) assert_near(width, 0.5e-3 * std::sqrt(2), 1e-12);
  }
  profile.split = {at_y, at_x};
  assert_int_equal(Chains(profile.solid()).strips(), 0);
  profile.split = {at_y, at_x, cut};
  const Chains both(profile.solid());
  assert_int_equal(both.strips(), 2);
  both.stays_at_y();
}

// The one over the other: the same row stays on both. What is shorter than twice its width has its sides where its
// neighbour has them, unless it is so short that it would be a strip across.
static void strips_that_share_an_end_are_a_chain(void **) {
  Profile profile = chamfered(0.5, 0.5);
  profile.split = {4};
  for (double middle : {15.0, 5.0, 29.5, 0.5}) {
    profile.middle = middle;
    const Chains found(profile.solid());
    assert_int_equal(found.strips(), 2);
    found.stays_at_y();
    const CwCadChain &chain = found.chain[0];
    int shared = 0;
    for (const CwCadUse &a : chain[0].end)
      for (const CwCadUse &b : chain[1].end) shared += a.edge == b.edge;
    assert_int_equal(shared, 1);
    assert_int_equal(found.borders(chain[0], 0, 1), found.borders(chain[1], 0, 1));
    assert_near(chain[0].length + chain[1].length, 1e-3 * height, 1e-12);
  }
  profile.middle = height - 0.2;
  const Chains found(profile.solid());
  assert_int_equal(found.strips(), 1);
  assert_near(found.chain[0][0].length, 1e-3 * (height - 0.2), 1e-12);
}

// Where the wall beside its upper half is open the cut cannot go there, nor below; where the upper half is open itself
// the lower one can.
static void a_chain_goes_whole_or_not_at_all(void **) {
  Profile profile = chamfered(0.5, 0.5);
  for (int axis = 0; axis < 2; axis++) {
    profile.split = {4, axis == 0 ? 3 : 0};
    const Chains broken(profile.solid(), [=](const TopoDS_Face &face) -> std::string {
      const gp_Pnt inside = BRepAdaptor_Surface(face).Plane().Location();
      const bool beside = std::fabs(normal_of(face).Coord(axis + 1)) > 0.999 && inside.Coord(axis + 1) < 1;
      return beside && inside.Z() > 14 ? "beside,outlet" : open_ends(face);
    });
    assert_int_equal(cw_cad_patch_count(broken.cad), 3);
    assert_int_equal(broken.strips(), 0);
  }
  profile.split = {4};
  const Chains below(profile.solid(), [](const TopoDS_Face &face) -> std::string {
    const bool cut =
        std::fabs(normal_of(face).X() - normal_of(face).Y()) < 1e-6 && std::fabs(normal_of(face).Z()) < 0.5;
    return cut && BRepAdaptor_Surface(face).Plane().Location().Z() > 14 ? "cut,outlet" : open_ends(face);
  });
  assert_int_equal(cw_cad_patch_count(below.cad), 3);
  assert_int_equal(below.strips(), 1);
  for (const auto &x : below.chain[0][0].x) assert_true(x[2] < 15.001e-3);
}

// A fillet of 0.5 mm round the foot of a post of 5 mm, over a quarter of a turn. The row on the floor is the longer
// one.
static void a_strip_may_be_bent(void **) {
  const double r = 0.5, s = r * (1 - std::sqrt(0.5));
  const gp_Pnt low(5 + r, 0, 0), middle(5 + s, 0, s), high(5, 0, r);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(low, middle, high).Value()));
  const gp_Pnt line[] = {high, gp_Pnt(5, 0, 20), gp_Pnt(20, 0, 20), gp_Pnt(20, 0, 0), low};
  for (int i = 0; i < 4; i++) wire.Add(BRepBuilderAPI_MakeEdge(line[i], line[i + 1]));
  const gp_Ax1 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  const TopoDS_Face profile = BRepBuilderAPI_MakeFace(wire.Wire());
  const Chains found(BRepPrimAPI_MakeRevol(profile, axis, M_PI / 2).Shape(),
                     [](const TopoDS_Face &face) -> std::string {
                       const bool plane = BRepAdaptor_Surface(face).GetType() == GeomAbs_Plane;
                       return plane && std::fabs(normal_of(face).Z()) < 0.1 ? "ends,inlet" : "wall,wall";
                     });
  assert_int_equal(found.strips(), 1);
  const CwCadChainStrip &strip = found.chain[0][0];
  assert_near(strip.length / (1e-3 * (5 + r) * M_PI / 2), 1, 1e-3); // by chords
  for (double width : strip.width) assert_near(width / (1e-3 * std::sqrt(2) * r), 1, 1e-3);
  assert_true(found.borders(strip, strip.stays, 2));
  assert_false(found.borders(strip, 1 - strip.stays, 2));
}

// Two narrow walls side by side, which turn by 30 degrees each: the narrower is the strip.
static void of_two_beside_one_another_the_narrower_goes(void **) {
  for (bool first : {false, true}) {
    const double a = first ? 0.4 : 0.7, b = first ? 0.7 : 0.4, c = std::sqrt(0.75), s = 0.5;
    Profile profile;
    profile.corner = {gp_XY(a * c + b * s, 0), gp_XY(20, 0),       gp_XY(20, 20), gp_XY(0, 20),
                      gp_XY(0, a * s + b * c), gp_XY(b * s, a * s)};
    const Chains found(profile.solid());
    assert_int_equal(found.strips(), 1);
    const CwCadChainStrip &strip = found.chain[0][0];
    for (double width : strip.width) assert_near(width, 0.4e-3, 1e-12);
    assert_int_equal(found.borders(strip, 0, 1) || found.borders(strip, 1, 1), first);
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_strip_is_measured),
      cmocka_unit_test(walls_may_meet_at_thirty_degrees),
      cmocka_unit_test(a_step_is_no_strip),
      cmocka_unit_test(a_crest_is_no_strip),
      cmocka_unit_test(an_uneven_cut_is_part_of_its_wall),
      cmocka_unit_test(a_strip_lies_between_two_walls),
      cmocka_unit_test(a_strip_may_be_bent),
      cmocka_unit_test(the_longer_row_stays),
      cmocka_unit_test(the_first_patch_keeps_its_row),
      cmocka_unit_test(rows_alike_are_told_by_hand),
      cmocka_unit_test(rows_of_two_edges_stay),
      cmocka_unit_test(strips_that_share_an_end_are_a_chain),
      cmocka_unit_test(a_chain_goes_whole_or_not_at_all),
      cmocka_unit_test(of_two_beside_one_another_the_narrower_goes),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
