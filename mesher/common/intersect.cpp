// SPDX-License-Identifier: AGPL-3.0-or-later
// Bridge to CGAL: candidate pairs by box intersection, each judged with exact predicates.
#include "mesher/common/intersect.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int32_t>;
using Pair = std::array<int32_t, 2>;

struct Soup {
  const double (*x)[3];

  Point point(int32_t v) const {
    return Point(x[v][0], x[v][1], x[v][2]);
  }

  Triangle shape(const int32_t *t) const {
    return Triangle(point(t[0]), point(t[1]), point(t[2]));
  }

  // Crossing beyond the vertices that both triangles share.
  bool cross(const int32_t *a, const int32_t *b) const {
    int shared = 0, in_a[3] = {0, 0, 0}, in_b[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        if (a[i] == b[j]) shared++, in_a[i] = 1, in_b[j] = 1;
    if (shared == 0) return CGAL::do_intersect(shape(a), shape(b));
    if (shared == 3) return true;
    int i = 0, j = 0;
    if (shared == 2) { // overlap only when folded flat onto each other
      while (in_a[i]) i++;
      while (in_b[j]) j++;
      const Point p = point(a[(i + 1) % 3]), q = point(a[(i + 2) % 3]), r = point(a[i]), s = point(b[j]);
      return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
    }
    while (!in_a[i]) i++;
    while (!in_b[j]) j++;
    const Segment s(point(a[(i + 1) % 3]), point(a[(i + 2) % 3]));
    const Segment t(point(b[(j + 1) % 3]), point(b[(j + 2) % 3]));
    return CGAL::do_intersect(shape(a), t) || CGAL::do_intersect(shape(b), s);
  }
};

} // namespace

extern "C" CwStatus cw_self_intersections(int32_t point_count, const double (*x)[3], int32_t triangle_count,
                                          const int32_t (*triangle)[3], int32_t *pair_count, int32_t (**pair)[2]) {
  CwStatus status = CW_OK;
  *pair_count = 0;
  *pair = nullptr;
  try {
    const Soup soup{x};
    std::vector<Pair> found;
    std::vector<Box> boxes;
    boxes.reserve(triangle_count);
    for (int32_t f = 0; f < triangle_count; f++) {
      for (int i = 0; i < 3; i++) {
        const int32_t v = triangle[f][i];
        CW_REQUIRE(v >= 0 && v < point_count, CW_ERR_INPUT, "triangle %d names point %d of %d", f, v, point_count);
        for (int k = 0; k < 3; k++)
          CW_REQUIRE(std::isfinite(x[v][k]), CW_ERR_INPUT, "point %d has a coordinate that is not a number", v);
      }
      const Triangle shape = soup.shape(triangle[f]);
      if (shape.is_degenerate())
        found.push_back({f, f});
      else
        boxes.emplace_back(shape.bbox(), f);
    }
    std::vector<const Box *> order;
    order.reserve(boxes.size());
    for (const Box &box : boxes) order.push_back(&box);
    CGAL::box_self_intersection_d(
        order.begin(), order.end(),
        [&](const Box *a, const Box *b) {
          if (soup.cross(triangle[a->info()], triangle[b->info()]))
            found.push_back({std::min(a->info(), b->info()), std::max(a->info(), b->info())});
        },
        std::ptrdiff_t(2000));
    // The order of discovery depends on addresses; the sorted list does not.
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    *pair = static_cast<int32_t(*)[2]>(std::malloc((found.size() + 1) * sizeof **pair));
    CW_REQUIRE(*pair, CW_ERR_MEMORY, "out of memory: %zu crossing pairs", found.size());
    for (size_t i = 0; i < found.size(); i++) (*pair)[i][0] = found[i][0], (*pair)[i][1] = found[i][1];
    *pair_count = static_cast<int32_t>(found.size());
  } catch (const std::bad_alloc &) {
    status = CW_FAIL(CW_ERR_MEMORY, "out of memory in the self-intersection test of %d triangles", triangle_count);
  } catch (const std::exception &e) {
    status = CW_FAIL(CW_ERR_LIBRARY, "CGAL failed in the self-intersection test: %s", e.what());
  }
done:
  return status;
}

extern "C" int cw_triangles_cross(const double (*x)[3], const int32_t a[3], const int32_t b[3]) {
  return Soup{x}.cross(a, b);
}
