// SPDX-License-Identifier: AGPL-3.0-or-later
// A solid with what its curve network is made from, and planes that divide it.
#pragma once

#include <initializer_list>
#include <vector>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/common/vec.h"
#include "mesher/network/network.h"
}

#include "solids.h"
#include "tests/draw.h"

// A plane below another one, on that one's negative (0) or positive side; the first has none.
struct DividingPlane {
  CwPlane plane;
  int32_t above;
  int side;
};

struct DividedSolid {
  CwCad *cad;
  CwBackground background;
  CwVerticals *inside = nullptr;
  std::vector<CwPlanNode> node;
  CwPlan plan = {};
  CwNetwork network = {};
  CwOutcome outcome = {};

  explicit DividedSolid(const TopoDS_Shape &shape, const PatchOfFace &patch_of = all_wall)
      : cad(open_solid(shape, patch_of)) {
    check(cw_background_make(cad, 1e-4, 0.2, &background));
    check(cw_verticals_make(background.x, background.triangle_count, background.triangle, &inside));
  }
  ~DividedSolid() {
    cw_network_free(&network);
    cw_verticals_free(&inside);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
  // Sets the plan, and an empty network of it.
  void divide(const std::vector<DividingPlane> &planes) {
    int32_t regions = 0;
    node.clear();
    for (const DividingPlane &one : planes) node.push_back({one.plane, one.above, {-1, -1}, 1});
    for (int32_t i = 1; i < (int32_t)planes.size(); i++) node[planes[i].above].child[planes[i].side] = i;
    for (CwPlanNode &one : node)
      for (int32_t &child : one.child)
        if (child < 0) child = -1 - regions++;
    plan = {};
    plan.node_count = (int32_t)node.size();
    plan.region_count = regions;
    plan.node = node.data();
    cw_network_free(&network);
    network = {};
    network.cad = cad;
    network.plan = &plan;
    outcome = {};
  }
  // The network of the plan, all of it.
  void make_network() {
    check(cw_network_make(NULL, cad, &background, inside, &plan, &network, &outcome));
    assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
  }
};

inline CwPlane random_plane(const double through[3], uint64_t *seed) {
  CwPlane plane;
  do
    for (double &n : plane.normal) n = 2 * draw(seed) - 1;
  while (cw_norm(plane.normal) < 0.1 || cw_norm(plane.normal) > 1);
  cw_unit(plane.normal);
  plane.offset = cw_dot(plane.normal, through);
  return plane;
}
