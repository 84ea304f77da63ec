// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/cdt.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "mesher/common/model_unit.h"

namespace {

struct FaceInfo {
  int32_t parity = -1; // boundary edges between the face and the infinite one, modulo 2; -1: not reached yet
  int32_t number = -1; // in the result
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int32_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;
using Point = Kernel::Point_2;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;
using Pair = std::pair<int32_t, int32_t>;

template <typename T> void take_memory(T **pointer, size_t count) {
  *pointer = static_cast<T *>(calloc(count, sizeof(T)));
  if (!*pointer) throw std::bad_alloc();
}

Pair sorted_pair(int32_t a, int32_t b) {
  return a < b ? Pair(a, b) : Pair(b, a);
}

// The place of a point for messages: mm, and (u,v).
#define PLACE "(%.6g, %.6g, %.6g) mm, (u,v) = (%.9g, %.9g)"
#define PLACE_OF(p) CW_MM(input->x[p]), input->uv[p][0], input->uv[p][1]

CwStatus check_numbers(const CwPatchInput *input, const double scale[2]) {
  CwStatus status = CW_OK;
  CW_REQUIRE(scale[0] > 0 && scale[1] > 0 && std::isfinite(scale[0]) && std::isfinite(scale[1]), CW_ERR_MESH,
             "patch %s: scales %g, %g of the parameter plane are not above 0: the surface map is degenerate",
             input->name, scale[0], scale[1]);
  for (int32_t p = 0; p < input->point_count; p++)
    for (int k = 0; k < 3; k++)
      CW_REQUIRE(std::isfinite(input->x[p][k]) && std::isfinite(input->uv[p][k % 2]), CW_ERR_MESH,
                 "patch %s: point %d at " PLACE " is not finite", input->name, p, PLACE_OF(p));
  for (int32_t e = 0; e < input->edge_count; e++) {
    int32_t a = input->edge[e][0], b = input->edge[e][1];
    CW_REQUIRE(a >= 0 && b >= 0 && a < input->point_count && b < input->point_count && a != b, CW_ERR_MESH,
               "patch %s: edge %d joins points %d and %d: allowed are two different points of 0 to %d", input->name, e,
               a, b, input->point_count - 1);
  }
done:
  return status;
}

// Each point must have an even number of boundary edges: then parity does not depend on the way taken.
CwStatus check_closed(const CwPatchInput *input) {
  CwStatus status = CW_OK;
  std::vector<int32_t> edges(size_t(input->point_count), 0);
  for (int32_t e = 0; e < input->edge_count; e++)
    for (int k = 0; input->boundary[e] && k < 2; k++) edges[size_t(input->edge[e][k])]++;
  for (int32_t p = 0; p < input->point_count; p++)
    CW_REQUIRE(edges[size_t(p)] % 2 == 0, CW_ERR_MESH,
               "patch %s: the boundary is open at point %d, " PLACE " (%d boundary edges meet there; allowed: an even "
               "number)",
               input->name, p, PLACE_OF(p), edges[size_t(p)]);
done:
  return status;
}

// Names the given edge that crosses or touches edge e. Only called once something is wrong, so a plain search
// does.
void tell_crossing(const CwPatchInput *input, const std::vector<Vertex> &vertex, int32_t e, CwOutcome *outcome) {
  int32_t a = input->edge[e][0], b = input->edge[e][1];
  auto at = [&](int32_t p) { return vertex[size_t(p)]->point(); };
  for (int32_t p = 0; p < input->point_count; p++)
    if (p != a && p != b && CGAL::are_strictly_ordered_along_line(at(a), at(p), at(b)))
      return cw_outcome_set(outcome, CW_OUTCOME_FINER, input->x[p],
                            "patch %s: point %d at (u,v) = (%.9g, %.9g) lies on edge %d (points %d and %d)",
                            input->name, p, input->uv[p][0], input->uv[p][1], e, a, b);
  for (int32_t f = 0; f < input->edge_count; f++) {
    int32_t c = input->edge[f][0], d = input->edge[f][1];
    if (f == e || c == a || c == b || d == a || d == b) continue;
    double ca = CGAL::to_double(CGAL::area(at(c), at(d), at(a))), cb = CGAL::to_double(CGAL::area(at(c), at(d), at(b)));
    if (CGAL::orientation(at(c), at(d), at(a)) == CGAL::orientation(at(c), at(d), at(b)) ||
        CGAL::orientation(at(a), at(b), at(c)) == CGAL::orientation(at(a), at(b), at(d)))
      continue;
    double t = ca == cb ? 0.5 : ca / (ca - cb), x[3], uv[2];
    for (int k = 0; k < 3; k++) x[k] = (1 - t) * input->x[a][k] + t * input->x[b][k];
    for (int k = 0; k < 2; k++) uv[k] = (1 - t) * input->uv[a][k] + t * input->uv[b][k];
    return cw_outcome_set(outcome, CW_OUTCOME_FINER, x,
                          "patch %s: edges %d (points %d and %d) and %d (points %d and %d) cross at (u,v) = (%.9g, "
                          "%.9g)",
                          input->name, e, a, b, f, c, d, uv[0], uv[1]);
  }
  cw_outcome_set(outcome, CW_OUTCOME_FINER, input->x[a], "patch %s: edge %d (points %d and %d) crosses another",
                 input->name, e, a, b);
}

void insert_points(const CwPatchInput *input, const double scale[2], Triangulation &mesh, std::vector<Vertex> &vertex,
                   CwOutcome *outcome) {
  std::vector<std::pair<Point, int32_t>> points(size_t(input->point_count));
  for (int32_t p = 0; p < input->point_count; p++)
    points[size_t(p)] = {Point(scale[0] * input->uv[p][0], scale[1] * input->uv[p][1]), p};
  mesh.insert(points.begin(), points.end());
  vertex.assign(points.size(), Vertex());
  for (Vertex v : mesh.finite_vertex_handles()) vertex[size_t(v->info())] = v;
  for (int32_t p = 0; p < input->point_count; p++)
    if (vertex[size_t(p)] == Vertex())
      return cw_outcome_set(outcome, CW_OUTCOME_FINER, input->x[p],
                            "patch %s: point %d at (u,v) = (%.9g, %.9g) coincides with another", input->name, p,
                            input->uv[p][0], input->uv[p][1]);
}

void insert_edges(const CwPatchInput *input, Triangulation &mesh, const std::vector<Vertex> &vertex,
                  CwOutcome *outcome) {
  std::vector<std::pair<Pair, int32_t>> pairs(size_t(input->edge_count));
  for (int32_t e = 0; e < input->edge_count; e++)
    pairs[size_t(e)] = {sorted_pair(input->edge[e][0], input->edge[e][1]), e};
  std::sort(pairs.begin(), pairs.end());
  for (size_t k = 1; k < pairs.size(); k++)
    if (pairs[k].first == pairs[k - 1].first)
      return cw_outcome_set(outcome, CW_OUTCOME_FINER, input->x[pairs[k].first.first],
                            "patch %s: the edge of points %d and %d is given twice (%d and %d)", input->name,
                            pairs[k].first.first, pairs[k].first.second, pairs[k - 1].second, pairs[k].second);
  for (int32_t e = 0; e < input->edge_count; e++) {
    try {
      mesh.insert_constraint(vertex[size_t(input->edge[e][0])], vertex[size_t(input->edge[e][1])]);
    } catch (const Triangulation::Intersection_of_constraints_exception &) {
      return tell_crossing(input, vertex, e, outcome);
    }
  }
  for (int32_t e = 0; e < input->edge_count; e++) {
    Face face;
    int side = 0;
    // An edge through a point has been cut there and is not there as a whole.
    if (!mesh.is_edge(vertex[size_t(input->edge[e][0])], vertex[size_t(input->edge[e][1])], face, side))
      return tell_crossing(input, vertex, e, outcome);
  }
}

// Floods from the infinite face; each boundary edge on the way turns the parity.
void find_parity(const CwPatchInput *input, Triangulation &mesh) {
  std::vector<Pair> walls;
  for (int32_t e = 0; e < input->edge_count; e++)
    if (input->boundary[e]) walls.push_back(sorted_pair(input->edge[e][0], input->edge[e][1]));
  std::sort(walls.begin(), walls.end());
  std::vector<Face> queue{mesh.infinite_face()};
  queue[0]->info().parity = 0;
  for (size_t k = 0; k < queue.size(); k++) {
    Face face = queue[k];
    for (int i = 0; i < 3; i++) {
      Face next = face->neighbor(i);
      if (next->info().parity >= 0) continue;
      Vertex a = face->vertex(mesh.ccw(i)), b = face->vertex(mesh.cw(i));
      int wall = face->is_constrained(i) && !mesh.is_infinite(a) && !mesh.is_infinite(b) &&
                 std::binary_search(walls.begin(), walls.end(), sorted_pair(a->info(), b->info()));
      next->info().parity = face->info().parity ^ wall;
      queue.push_back(next);
    }
  }
}

CwStatus take_inside(const CwPatchInput *input, Triangulation &mesh, CwCdt *cdt) {
  CwStatus status = CW_OK;
  // Sorted by points, so that numbers follow from the input alone.
  std::vector<std::pair<std::array<int32_t, 3>, std::pair<Face, int>>> inside;
  for (Face face : mesh.finite_face_handles()) {
    if (face->info().parity != 1) continue;
    int first = 0;
    for (int i = 1; i < 3; i++)
      if (face->vertex(i)->info() < face->vertex(first)->info()) first = i;
    inside.push_back(
        {{face->vertex(first)->info(), face->vertex(mesh.ccw(first))->info(), face->vertex(mesh.cw(first))->info()},
         {face, first}});
  }
  std::sort(inside.begin(), inside.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  size_t count = inside.size();
  CW_REQUIRE(count > 0, CW_ERR_MESH, "patch %s: nothing lies inside its boundary (%d points, %d edges)", input->name,
             input->point_count, input->edge_count);
  take_memory(&cdt->triangle, count);
  take_memory(&cdt->neighbour, count);
  take_memory(&cdt->given, count);
  take_memory(&cdt->component, count);
  cdt->triangle_count = int32_t(count);
  for (size_t t = 0; t < count; t++) inside[t].second.first->info().number = int32_t(t);
  for (size_t t = 0; t < count; t++) {
    Face face = inside[t].second.first;
    for (int k = 0; k < 3; k++) {
      int i = (inside[t].second.second + k) % 3;
      cdt->triangle[t][k] = inside[t].first[size_t(k)];
      cdt->neighbour[t][k] = face->neighbor(i)->info().number;
      if (face->is_constrained(i)) cdt->given[t] = uint8_t(cdt->given[t] | 1 << k);
    }
    cdt->component[t] = -1;
  }
done:
  return status;
}

void find_components(CwCdt *cdt) {
  std::vector<int32_t> stack;
  for (int32_t t = 0; t < cdt->triangle_count; t++) {
    if (cdt->component[t] >= 0) continue;
    cdt->component[t] = cdt->component_count;
    stack.push_back(t);
    while (!stack.empty()) {
      int32_t s = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; i++) {
        int32_t n = cdt->neighbour[s][i];
        if (n < 0 || cdt->given[s] >> i & 1 || cdt->component[n] >= 0) continue;
        cdt->component[n] = cdt->component_count;
        stack.push_back(n);
      }
    }
    cdt->component_count++;
  }
}

} // namespace

CwStatus cw_cdt_make(const CwPatchInput *input, const double scale[2], CwCdt *cdt, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  *cdt = CwCdt();
  // No exception may pass into C.
  try {
    Triangulation mesh;
    std::vector<Vertex> vertex;
    CW_TRY(check_numbers(input, scale));
    CW_TRY(check_closed(input));
    insert_points(input, scale, mesh, vertex, outcome);
    if (outcome->kind == CW_OUTCOME_DONE) insert_edges(input, mesh, vertex, outcome);
    if (outcome->kind != CW_OUTCOME_DONE) goto done;
    find_parity(input, mesh);
    CW_TRY(take_inside(input, mesh, cdt));
    find_components(cdt);
  } catch (const std::bad_alloc &) {
    status = CW_FAIL(CW_ERR_MEMORY, "patch %s: out of memory in the Delaunay triangulation of %d points", input->name,
                     input->point_count);
  } catch (const std::exception &failure) {
    status = CW_FAIL(CW_ERR_LIBRARY, "patch %s: CGAL failed: %s", input->name, failure.what());
  }
done:
  if (status != CW_OK) cw_cdt_free(cdt);
  return status;
}

void cw_cdt_free(CwCdt *cdt) {
  free(cdt->triangle);
  free(cdt->neighbour);
  free(cdt->given);
  free(cdt->component);
  *cdt = CwCdt();
}
