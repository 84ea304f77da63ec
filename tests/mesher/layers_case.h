// SPDX-License-Identifier: AGPL-3.0-or-later
// A wall with its layers, and what must hold for every one: told apart from the module's own judgement by
// other formulas.
#pragma once

#include <stdio.h>

#include "mesher/common/intersect.h"
#include "mesher/layers/layers.h"
#include "surfaces.h"
#include "tests/unit_test.h"

// Unit normals of the open patches and planes that hold a column at x; returns their count.
typedef int (*CaseGuide)(const void *context, const double x[3], double normal[2][3]);

typedef struct {
  Surface wall, open_patch;
  double target, lowest; // lowest: the least thickness, 0 for none
  CaseGuide constraint;
  const void *constraint_context;
  void (*snap)(const void *context, int32_t v, double x[3]);
  CwLayerInput in;
  CwLayers out;
  CwOutcome outcome;
  double share; // of columns at the asked thickness
  double mean;  // of all thicknesses, over the asked one
} Case;

// Holds the columns at y = 0 and y = depth (the context, a double, m): the ends of what is extruded.
static inline int case_end_planes(const void *context, const double x[3], double normal[2][3]) {
  if (x[1] > 1e-9 && x[1] < *(const double *)context - 1e-9) return 0;
  normal[0][1] = 1;
  return 1;
}

static inline CwStatus case_make(Case *c) {
  surface_weld(&c->wall);
  surface_weld(&c->open_patch);
  int32_t n = c->wall.point_count, *constraint_count = calloc(n, sizeof *constraint_count);
  double *target = malloc(n * sizeof *target), *lowest = c->lowest > 0 ? malloc(n * sizeof *lowest) : NULL;
  double(*constraint_normal)[2][3] = calloc(n, sizeof *constraint_normal);
  for (int32_t v = 0; v < n; v++) {
    target[v] = c->target;
    if (lowest) lowest[v] = c->lowest;
    if (c->constraint) constraint_count[v] = c->constraint(c->constraint_context, c->wall.x[v], constraint_normal[v]);
  }
  c->in = (CwLayerInput){.point_count = n,
                         .x = (const double(*)[3])c->wall.x,
                         .triangle_count = c->wall.triangle_count,
                         .triangle = (const int32_t(*)[3])c->wall.triangle,
                         .target = target,
                         .least = lowest,
                         .constraint_count = constraint_count,
                         .constraint_normal = (const double(*)[2][3])constraint_normal,
                         .snap = c->snap,
                         .snap_context = c,
                         .obstacle_point_count = c->open_patch.point_count,
                         .obstacle_x = (const double(*)[3])c->open_patch.x,
                         .obstacle_triangle_count = c->open_patch.triangle_count,
                         .obstacle_triangle = (const int32_t(*)[3])c->open_patch.triangle};
  return cw_layers_make(&c->in, &c->out, &c->outcome);
}

static inline void case_free(Case *c) {
  free((void *)c->in.target);
  free((void *)c->in.least);
  free((void *)c->in.constraint_count);
  free((void *)c->in.constraint_normal);
  surface_free(&c->wall);
  surface_free(&c->open_patch);
  cw_layers_free(&c->out);
}

static inline double case_det(const double o[3], const double a[3], const double b[3], const double c[3]) {
  double m[3][3];
  for (int k = 0; k < 3; k++) m[0][k] = a[k] - o[k], m[1][k] = b[k] - o[k], m[2][k] = c[k] - o[k];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static inline void case_at(const Case *c, int32_t v, double fraction, double x[3]) {
  for (int k = 0; k < 3; k++) x[k] = c->wall.x[v][k] + fraction * (c->out.top[v][k] - c->wall.x[v][k]);
}

// Ten sub-layers: every corner tetrahedron of each sub-prism has a positive volume.
static inline void case_check_prisms(const Case *c) {
  for (int32_t f = 0; f < c->wall.triangle_count; f++) {
    const int32_t corner[3] = {c->wall.triangle[f][0], c->wall.triangle[f][2], c->wall.triangle[f][1]};
    for (int layer = 0; layer < 10; layer++) {
      double p[6][3];
      for (int i = 0; i < 3; i++) {
        case_at(c, corner[i], layer / 10.0, p[i]);
        case_at(c, corner[i], (layer + 1) / 10.0, p[3 + i]);
      }
      for (int i = 0; i < 3; i++) {
        assert_true(case_det(p[i], p[(i + 1) % 3], p[(i + 2) % 3], p[3 + i]) > 0);
        assert_true(case_det(p[3 + i], p[3 + (i + 2) % 3], p[3 + (i + 1) % 3], p[i]) > 0);
      }
    }
  }
}

// Wall and layer top together cross nowhere, nor does the layer top cross an open patch except with the columns that
// run inside one.
static inline void case_check_top(const Case *c) {
  int32_t n = c->wall.point_count, m = c->wall.triangle_count, open_patches = c->open_patch.triangle_count, count,
          (*pair)[2];
  int32_t points = 2 * n + c->open_patch.point_count;
  double(*x)[3] = malloc(points * sizeof *x);
  int32_t(*t)[3] = malloc((2 * (size_t)m + open_patches) * sizeof *t);
  memcpy(x, c->out.top, n * sizeof *x);
  memcpy(x + n, c->wall.x, n * sizeof *x);
  if (open_patches) memcpy(x + 2 * n, c->open_patch.x, c->open_patch.point_count * sizeof *x);
  for (int32_t f = 0; f < m; f++)
    for (int i = 0; i < 3; i++) t[f][i] = c->wall.triangle[f][i], t[m + f][i] = n + c->wall.triangle[f][i];
  for (int32_t f = 0; f < open_patches; f++)
    for (int i = 0; i < 3; i++) t[2 * m + f][i] = 2 * n + c->open_patch.triangle[f][i];
  assert_int_equal(
      cw_self_intersections(points, (const double(*)[3])x, 2 * m + open_patches, (const int32_t(*)[3])t, &count, &pair),
      CW_OK);
  for (int32_t i = 0; i < count; i++) {
    assert_true(pair[i][1] >= 2 * m);
    if (pair[i][0] >= m) continue;
    int held = 0;
    for (int k = 0; k < 3; k++) held += c->in.constraint_count[c->wall.triangle[pair[i][0]][k]];
    assert_true(held > 0);
  }
  free(pair);
  free(x);
  free(t);
}

// Makes the layers, checks what must always hold, prints the shares.
static inline void case_run(Case *c, const char *name) {
  CwStatus status = case_make(c);
  if (status != CW_OK) print_error("%s: %s\n", name, cw_fail_message());
  assert_int_equal(status, CW_OK);
  int32_t n = c->wall.point_count, full = 0, reason[CW_LAYER_REPAIR + 1] = {0};
  c->mean = 0;
  double least = INFINITY;
  for (int32_t v = 0; v < n; v++) {
    assert_true(c->out.thickness[v] > 0);
    if (c->out.thickness[v] >= 0.99 * c->target) full++;
    c->mean += c->out.thickness[v] / c->target / n;
    if (c->out.thickness[v] < least) least = c->out.thickness[v];
    reason[c->out.reason[v]]++;
  }
  assert_int_equal(n - full, c->out.thinned_count);
  c->share = (double)full / n;
  print_message(
      "  %-26s %7d triangles: %6.2f %% at %.2f mm, mean %.3f of it, least %.3f mm; sharpness %d, gap %d, gradation %d, "
      "repair %d; rounds %d\n",
      name, c->wall.triangle_count, 100 * c->share, c->target / MM, c->mean, least / MM, reason[CW_LAYER_SHARPNESS],
      reason[CW_LAYER_GAP], reason[CW_LAYER_GRADATION], reason[CW_LAYER_REPAIR], c->out.repair_rounds);
  case_check_prisms(c);
  case_check_top(c);
  // Constrained columns stay in the surfaces that hold them, to first order where those are curved and not put
  // back.
  for (int32_t v = 0; v < n && !c->snap; v++)
    for (int i = 0; i < c->in.constraint_count[v]; i++) {
      double away = 0;
      for (int k = 0; k < 3; k++) away += (c->out.top[v][k] - c->wall.x[v][k]) * c->in.constraint_normal[v][i][k];
      assert_true(fabs(away) < 1e-12);
    }
}
