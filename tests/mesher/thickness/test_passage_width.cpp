// SPDX-License-Identifier: AGPL-3.0-or-later
// Widths of a channel, beside an open face, and of a channel with a step.
#include <cmath>
#include <vector>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <Bnd_Box.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/policy.h"
#include "mesher/thickness/passage_width.h"
}

#include "solids.h"

static const double BIN = 0.005; // of the greatest width of interest: how finely distances are told apart

// Faces by the place of their middle along the axis, in mm.
static double middle(const TopoDS_Face &face, int axis) {
  Bnd_Box box;
  BRepBndLib::Add(face, box);
  return 0.5 * (box.CornerMin().Coord(axis + 1) + box.CornerMax().Coord(axis + 1));
}

// Of the first patch, the wall "seen", mm, of which no more than `most` (mm) is of interest.
static double width_seen(const TopoDS_Shape &solid, double most, const PatchOfFace &patch_of) {
  CwBackground background;
  CwCad *cad = open_solid(solid, patch_of);
  if (cw_background_make(cad, 1e-4, 0.2, &background) != CW_OK) fail_msg("%s", cw_fail_message());
  std::vector<double> width(cw_cad_patch_count(cad), most * 1e-3);
  if (cw_passage_widths(nullptr, cad, &background, width.data()) != CW_OK) fail_msg("%s", cw_fail_message());
  double seen = NAN;
  for (int p = 0; p < cw_cad_patch_count(cad); p++) {
    if (std::string(cw_cad_patch_name(cad, p)) == "seen") seen = 1e3 * width[p];
    if (cw_cad_patch_kind(cad, p) != CW_PATCH_WALL) assert_near(width[p], most * 1e-3, 0);
  }
  cw_background_free(&background);
  cw_cad_close(&cad);
  return seen;
}

static std::string floor_is_seen(const TopoDS_Face &face) {
  return std::fabs(middle(face, 2)) < 1e-3 ? "seen,wall" : "rest,wall";
}

static void a_channel_is_as_wide_as_it_is(void **) {
  TopoDS_Shape box = BRepPrimAPI_MakeBox(40, 30, 7).Shape();
  assert_near(width_seen(box, 10, floor_is_seen), 7, 10 * BIN);
  assert_near(width_seen(box, 7, floor_is_seen), 7, 0);
  assert_near(width_seen(box, 5, floor_is_seen), 5, 0);
}

static void open_faces_bound_no_layers(void **) {
  auto below_an_inlet = [](const TopoDS_Face &face) -> std::string {
    return std::fabs(middle(face, 2) - 7) < 1e-3 ? "in,inlet" : floor_is_seen(face);
  };
  assert_near(width_seen(BRepPrimAPI_MakeBox(40, 30, 7).Shape(), 10, below_an_inlet), 10, 0);
}

// A channel 7 wide beside one 3 wide, of a share of the floor.
static void a_small_share_may_be_nearer(void **) {
  for (double share : {0.5, 2.0}) { // of what may be
    double length = 40 * share * cw_policy.missed_share;
    TopoDS_Shape wide = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 40 - length, 30, 7).Shape();
    TopoDS_Shape low = BRepPrimAPI_MakeBox(gp_Pnt(40 - length, 0, 0), length, 30, 3).Shape();
    double width = width_seen(BRepAlgoAPI_Fuse(wide, low).Shape(), 10, floor_is_seen);
    assert_near(width, share > 1 ? 3 : 7, 10 * BIN);
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_channel_is_as_wide_as_it_is),
      cmocka_unit_test(open_faces_bound_no_layers),
      cmocka_unit_test(a_small_share_may_be_nearer),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
