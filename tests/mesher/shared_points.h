// SPDX-License-Identifier: AGPL-3.0-or-later
// Points that regions of a domain share, gathered from one mesh after another.
#pragma once

#include <map>
#include <vector>

extern "C" {
#include "mesher/region/region_file.h"
}

#include "solids.h"

class SharedPoints {
public:
  // All regions that hold a point have the same bits for it.
  void add(const CwRegionMesh &mesh) {
    for (int i = 0; i < mesh.cells.shared_count; i++) {
      std::vector<double> x(mesh.cells.points[i], mesh.cells.points[i] + 3);
      auto found = point.emplace(mesh.cells.shared_id[i], x);
      assert_memory_equal(found.first->second.data(), x.data(), sizeof(double[3]));
      held[mesh.cells.shared_id[i]]++;
    }
  }

  // There are `count`, numbered from 0 without a gap, and two regions or more hold each.
  void check(int64_t count) const {
    assert_int_equal(point.size(), count);
    assert_int_equal(point.rbegin()->first, count - 1);
    for (const auto &one : held) assert_true(one.second >= 2);
  }

private:
  std::map<int64_t, std::vector<double>> point;
  std::map<int64_t, int> held;
};
