// SPDX-License-Identifier: AGPL-3.0-or-later
// The triangulation of a patch while it is worked on, opened from a plan, and what must hold of it after every change.
#pragma once

#include "mesher/surface/cdt.h"
#include "mesher/surface/patch_work.h"
#include "patch_plan.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// Area of the regular hexagon of radius 1.
static const double HEXAGON = 2.598076211353316;

static inline void open_patch(const Plan *plan, CwPatchWork *work) {
  CwCdt cdt;
  assert_int_equal(cw_cdt_make(&plan->input, (const double[2]){1, 1}, &cdt, &(CwOutcome){0}), CW_OK);
  assert_int_equal(cw_patch_work_open(&plan->input, &cdt, work), CW_OK);
  cw_cdt_free(&cdt);
}

// A regular polygon about the origin of the plane, its first corner on the axis of u, with the size field `size`.
static inline Plan *polygon_plan(int corners, double radius, double size) {
  Plan *plan = new_plan(PLANE, size);
  for (int k = 0; k < corners; k++)
    add_point(plan, radius * cos(2 * M_PI * k / corners), radius * sin(2 * M_PI * k / corners));
  add_outline(plan);
  return plan;
}

// The given edge between a and b, -1: none.
static inline int32_t given_edge(const Plan *plan, int32_t a, int32_t b) {
  for (int32_t e = 0; e < plan->input.edge_count; e++)
    if ((plan->edge[e][0] == a && plan->edge[e][1] == b) || (plan->edge[e][0] == b && plan->edge[e][1] == a)) return e;
  return -1;
}

// Edge i of triangle t: the triangle across has it the other way round and says the same of it. Given edges are those
// of the plan; outside there is nothing across. Returns whether it is given.
static inline int check_edge(const Plan *plan, const CwPatchWork *work, int32_t t, int i) {
  const int32_t a = work->corner[t][(i + 1) % 3], b = work->corner[t][(i + 2) % 3], n = work->neighbour[t][i];
  const int is_given = work->given[t] >> i & 1;
  const int32_t e = given_edge(plan, a, b);
  assert_int_equal(is_given, e >= 0);
  assert_int_equal(n < 0, e >= 0 && plan->boundary[e]);
  if (n >= 0) {
    const int j = cw_patch_edge_from(work, n, b, a);
    assert_in_range(j, 0, 2);
    assert_true(work->corner[n][0] >= 0);
    assert_int_equal(work->neighbour[n][j], t);
    assert_int_equal(work->given[n] >> j & 1, is_given);
    if (!is_given) assert_int_equal(work->component[n], work->component[t]);
  }
  return is_given;
}

// All triangles are counter-clockwise and cover the patch once: by their area, and by Euler's formula for a patch
// without holes. Each given edge is there, each point knows one of its triangles, each slot that is not used is on the
// list of free ones. Returns the number of triangles.
static inline int32_t check_patch(const Plan *plan, const CwPatchWork *work, double uv_area) {
  int32_t triangles = 0, given = 0, outer = 0, points = 0, wanted = 0, unused = 0;
  double area = 0;
  for (int32_t t = 0; t < work->triangle_count; t++) {
    const int32_t *c = work->corner[t];
    if (c[0] < 0) continue;
    const double twice = cw_twice_area(work->uv[c[0]], work->uv[c[1]], work->uv[c[2]]);
    assert_true(twice > 0);
    area += 0.5 * twice;
    triangles++;
    for (int i = 0; i < 3; i++) {
      assert_in_range(c[i], 0, work->point_count - 1);
      assert_true(work->point_triangle[c[i]] >= 0);
      given += check_edge(plan, work, t, i);
      outer += work->neighbour[t][i] < 0;
    }
  }
  assert_near(area / uv_area, 1, 1e-12);
  for (int32_t p = 0; p < work->point_count; p++) {
    const int32_t t = work->point_triangle[p];
    if (t < 0) continue;
    assert_true(work->corner[t][0] == p || work->corner[t][1] == p || work->corner[t][2] == p);
    points++;
  }
  for (int32_t e = 0; e < plan->input.edge_count; e++) wanted += plan->boundary[e] ? 1 : 2;
  assert_int_equal(given, wanted);
  assert_int_equal(2 * points - (3 * triangles + outer) + 2 * triangles, 2);
  for (int32_t t = work->free_slot; t >= 0; t = work->neighbour[t][0], unused++) assert_true(work->corner[t][0] < 0);
  assert_int_equal(triangles + unused, work->triangle_count);
  return triangles;
}

// Whether the triangle lies right of the line u = 1.
static inline int is_right(const CwPatchWork *work, int32_t t) {
  const int32_t *c = work->corner[t];
  return work->uv[c[0]][0] + work->uv[c[1]][0] + work->uv[c[2]][0] > 3;
}

// A rectangle that the line u = 1 divides into two components, with random points; each is looked for from both sides,
// and goes in from its own.
static inline Plan *divided_rectangle(uint64_t *seed, CwPatchWork *work) {
  Plan *plan = new_plan(PLANE, 0.05);
  const double corner[6][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
  int inserted;
  for (int p = 0; p < 6; p++) add_point(plan, corner[p][0], corner[p][1]);
  add_outline(plan);
  add_edge(plan, 1, 4, 0);
  open_patch(plan, work);
  for (int i = 0; i < 40; i++) {
    const double uv[2] = {2 * draw(seed), draw(seed)};
    for (int side = 0; side < 2; side++) {
      const int32_t before = work->point_count;
      int32_t from = 0;
      while (is_right(work, from) != side) from++;
      assert_int_equal(cw_patch_insert(work, uv, from, 0.5, INFINITY, &inserted), CW_OK);
      assert_int_equal(work->point_count, before + inserted);
      if (side != (uv[0] > 1)) assert_int_equal(inserted, 0);
    }
  }
  assert_true(work->point_count > 30);
  check_patch(plan, work, 2);
  return plan;
}

// A plane that leans and shears: (u,v) of a place given by two coordinates in it, of unit length and square to one
// another, and back.
static const double XU[3] = {2, 0.3, 0.5}, XV[3] = {1.5, 1, -0.2};

static inline void sheared(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  for (int k = 0; k < 3; k++) x[k] = uv[0] * XU[k] + uv[1] * XV[k];
  if (xu) cw_copy(XU, xu);
  if (xv) cw_copy(XV, xv);
}

static inline void axes_of_sheared(double first[3], double second[3]) {
  cw_copy(XU, first);
  cw_unit(first);
  cw_copy(XV, second);
  cw_flatten(second, first);
  cw_unit(second);
}

static inline void uv_of_sheared(double p, double q, double uv[2]) {
  double first[3], second[3];
  axes_of_sheared(first, second);
  uv[1] = q / cw_dot(XV, second);
  uv[0] = (p - uv[1] * cw_dot(XV, first)) / cw_norm(XU);
}

// Lays the plan of a plane on the sheared one, with the same lengths and angles.
static inline Plan *sheared_plan(Plan *plan) {
  plan->input.surface = sheared;
  for (int32_t p = 0; p < plan->input.point_count; p++) {
    uv_of_sheared(plan->uv[p][0], plan->uv[p][1], plan->uv[p]);
    sheared(NULL, plan->uv[p], plan->x[p], NULL, NULL);
  }
  return plan;
}

// In (u,v), of a patch with this area in the plane.
static inline double uv_area_of_sheared(double area) {
  double cross[3];
  cw_cross(XU, XV, cross);
  return area / cw_norm(cross);
}

// The least cosine between a triangle on the cylinder and the normals at its corners.
static inline double cosine_on_cylinder(const CwPatchWork *work, const int32_t c[3]) {
  double n[3], least = 1;
  cw_normal(work->x[c[0]], work->x[c[1]], work->x[c[2]], n);
  cw_unit(n);
  for (int i = 0; i < 3; i++) {
    const double u = work->uv[c[i]][0], outward[3] = {cos(u), sin(u), 0};
    least = fmin(least, cw_dot(n, outward));
  }
  return least;
}

static inline int32_t count_free_points(const CwPatchWork *work) {
  int32_t count = 0;
  for (int32_t p = work->given_count; p < work->point_count; p++) count += work->point_triangle[p] >= 0;
  return count;
}
