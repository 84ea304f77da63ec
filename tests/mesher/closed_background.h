// SPDX-License-Identifier: AGPL-3.0-or-later
// What must hold of every background triangulation.
#pragma once

#include <cmath>
#include <map>
#include <utility>

#include "mesher/cad/background.h"

#include "solids.h"

// Independent of the check inside: each directed edge once, its opposite once; Euler's number of a ball's
// surface.
static inline void check_closed(const CwBackground *b) {
  std::map<std::pair<int32_t, int32_t>, int> directed;
  for (int32_t t = 0; t < b->triangle_count; t++) {
    for (int k = 0; k < 3; k++) directed[{b->triangle[t][k], b->triangle[t][(k + 1) % 3]}]++;
  }
  for (const auto &item : directed) {
    assert_int_equal(item.second, 1);
    assert_int_equal(directed.count({item.first.second, item.first.first}), 1);
  }
  assert_int_equal(b->point_count - (int)directed.size() / 2 + b->triangle_count, 2);
}

// Corners lie where their (u,v) on the face are.
static inline void check_corners(const CwCad *cad, const CwBackground *b) {
  for (int32_t t = 0; t < b->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      double x[3];
      cw_cad_face_point(cad, b->face[t], b->uv[t][k], x, nullptr, nullptr);
      const double *p = b->x[b->triangle[t][k]];
      assert_true(std::hypot(x[0] - p[0], x[1] - p[1], x[2] - p[2]) < 1e-9);
    }
  }
}

// Across edge (k, k + 1) of each triangle lies the one that has it the other way round.
static inline void check_neighbours(const CwBackground *b) {
  std::map<std::pair<int32_t, int32_t>, int32_t> owner;
  for (int32_t t = 0; t < b->triangle_count; t++) {
    for (int k = 0; k < 3; k++) owner[{b->triangle[t][k], b->triangle[t][(k + 1) % 3]}] = t;
  }
  for (int32_t t = 0; t < b->triangle_count; t++) {
    for (int k = 0; k < 3; k++)
      assert_int_equal(b->neighbour[t][k], owner.at({b->triangle[t][(k + 1) % 3], b->triangle[t][k]}));
  }
}
