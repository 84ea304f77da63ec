// SPDX-License-Identifier: AGPL-3.0-or-later
#include "patch_plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/vec.h"
#include "tests/unit_test.h"

void surface_at(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  const Plan *plan = context;
  double u = uv[0], v = uv[1], su = plan->shape == STRETCHED ? 0.02 : 1;
  double at[3] = {su * u, v, 0}, du[3] = {su, 0, 0}, dv[3] = {0, 1, 0};
  if (plan->shape == CYLINDER) {
    memcpy(at, (double[3]){0.1 * cos(u), 0.1 * sin(u), v}, sizeof at);
    memcpy(du, (double[3]){-0.1 * sin(u), 0.1 * cos(u), 0}, sizeof du);
    memcpy(dv, (double[3]){0, 0, 1}, sizeof dv);
  } else if (plan->shape == SPHERE) {
    memcpy(at, (double[3]){cos(u) * cos(v), sin(u) * cos(v), sin(v)}, sizeof at);
    memcpy(du, (double[3]){-sin(u) * cos(v), cos(u) * cos(v), 0}, sizeof du);
    memcpy(dv, (double[3]){-cos(u) * sin(v), -sin(u) * sin(v), cos(v)}, sizeof dv);
  } else if (plan->shape == FUNNEL) { // a cone whose parameter v runs faster and faster, with shear
    double r = 0.2 + v * v, w = u + v;
    memcpy(at, (double[3]){r * cos(w), r * sin(w), v * v}, sizeof at);
    memcpy(du, (double[3]){-r * sin(w), r * cos(w), 0}, sizeof du);
    memcpy(dv, (double[3]){2 * v * cos(w) - r * sin(w), 2 * v * sin(w) + r * cos(w), 2 * v}, sizeof dv);
  }
  memcpy(x, at, sizeof at);
  if (xu) memcpy(xu, du, sizeof du);
  if (xv) memcpy(xv, dv, sizeof dv);
}

double size_at(const void *context, const double x[3]) {
  const Plan *plan = context;
  return plan->size + plan->slope * fabs(x[0]);
}

Plan *new_plan(int shape, double size) {
  Plan *plan = calloc(1, sizeof *plan);
  assert_non_null(plan);
  plan->shape = shape;
  plan->size = size;
  plan->input = (CwPatchInput){.surface = surface_at,
                               .surface_context = plan,
                               .size = size_at,
                               .size_context = plan,
                               .uv = (const double(*)[2])plan->uv,
                               .x = (const double(*)[3])plan->x,
                               .edge = (const int32_t(*)[2])plan->edge,
                               .boundary = plan->boundary,
                               .name = "lid"};
  return plan;
}

int32_t add_point(Plan *plan, double u, double v) {
  int32_t p = plan->input.point_count++;
  assert_true(p < MOST);
  plan->uv[p][0] = u;
  plan->uv[p][1] = v;
  surface_at(plan, plan->uv[p], plan->x[p], NULL, NULL);
  return p;
}

void add_edge(Plan *plan, int32_t a, int32_t b, int boundary) {
  int32_t e = plan->input.edge_count++;
  assert_true(e < MOST);
  plan->edge[e][0] = a;
  plan->edge[e][1] = b;
  plan->boundary[e] = (uint8_t)boundary;
}

void add_line(Plan *plan, int32_t a, int32_t b, int boundary) {
  enum { PIECES = 2000 };
  static double along[PIECES + 1]; // wanted edges up to there
  double last[3];
  memcpy(last, plan->x[a], sizeof last);
  along[0] = 0;
  for (int k = 1; k <= PIECES; k++) {
    double t = (double)k / PIECES, uv[2], x[3], d = 0;
    for (int c = 0; c < 2; c++) uv[c] = (1 - t) * plan->uv[a][c] + t * plan->uv[b][c];
    surface_at(plan, uv, x, NULL, NULL);
    for (int c = 0; c < 3; c++) d += (x[c] - last[c]) * (x[c] - last[c]);
    along[k] = along[k - 1] + sqrt(d) / size_at(plan, x);
    memcpy(last, x, sizeof last);
  }
  int count = (int)fmax(1, round(along[PIECES]));
  int32_t from = a;
  for (int i = 1, k = 1; i < count; i++) {
    while (along[k] < along[PIECES] * i / count) k++;
    double t = (k - 1 + (along[PIECES] * i / count - along[k - 1]) / (along[k] - along[k - 1])) / PIECES;
    int32_t p =
        add_point(plan, (1 - t) * plan->uv[a][0] + t * plan->uv[b][0], (1 - t) * plan->uv[a][1] + t * plan->uv[b][1]);
    add_edge(plan, from, p, boundary);
    from = p;
  }
  add_edge(plan, from, b, boundary);
}

void add_outline(Plan *plan) {
  const int32_t count = plan->input.point_count;
  for (int32_t k = 0; k < count; k++) add_edge(plan, k, (k + 1) % count, 1);
}

void add_loop(Plan *plan, int count, const double (*corner)[2]) {
  int32_t first = plan->input.point_count;
  for (int k = 0; k < count; k++) add_point(plan, corner[k][0], corner[k][1]);
  for (int k = 0; k < count; k++) add_line(plan, first + k, first + (k + 1) % count, 1);
}

void add_rectangle(Plan *plan, double u0, double v0, double u1, double v1) {
  const double corner[4][2] = {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
  add_loop(plan, 4, corner);
}

Plan *lattice_plan(int shape, int n, double h, double scale, double turned) {
  Plan *plan = new_plan(shape, h);
  const int32_t count = 4 * n;
  for (int32_t k = 0; k < count; k++) {
    const int side = k / n, at = k % n;
    const double a = side == 0 ? at : side == 1 ? n : side == 2 ? n - at : 0;
    const double b = side == 0 ? 0 : side == 1 ? at : side == 2 ? n : n - at;
    const double x = h * (a + 0.5 * b), y = h * sqrt(0.75) * b;
    add_point(plan, (x * cos(turned) - y * sin(turned)) / scale, x * sin(turned) + y * cos(turned));
  }
  add_outline(plan);
  return plan;
}

typedef struct {
  int32_t a, b, triangle;
} Side;

static int compare_sides(const void *left, const void *right) {
  const Side *l = left, *r = right;
  return l->a != r->a ? (l->a > r->a) - (l->a < r->a) : (l->b > r->b) - (l->b < r->b);
}

static double height_over(const CwPatchMesh *mesh, int32_t p, int32_t a, int32_t b) {
  double ab = cw_distance(mesh->x[a], mesh->x[b]), ap = cw_distance(mesh->x[a], mesh->x[p]),
         bp = cw_distance(mesh->x[b], mesh->x[p]);
  double along = (ab * ab + ap * ap - bp * bp) / (2 * ab);
  return sqrt(fmax(ap * ap - along * along, 0));
}

// Every triangle has three sides; a side belongs to one triangle exactly where it is a boundary edge, to two
// elsewhere; the given edges are among the sides; vertices - edges + triangles is as expected; components
// meet at given edges only. Returns the clearance of the free points over the given edges.
static double check_topology(const Plan *plan, const CwPatchMesh *mesh, int euler) {
  double clearance = 1;
  int32_t count = 3 * mesh->triangle_count, edges = 0, points = 0, given = plan->input.edge_count, found = 0;
  Side *side = calloc((size_t)(count + given), sizeof *side);
  uint8_t *used = calloc((size_t)mesh->point_count, 1);
  assert_non_null(side);
  assert_non_null(used);
  for (int32_t k = 0; k < count + given; k++) {
    int32_t a, b;
    if (k < count) {
      a = mesh->triangle[k / 3][k % 3];
      b = mesh->triangle[k / 3][(k + 1) % 3];
      used[a] = 1;
    } else {
      a = plan->edge[k - count][0];
      b = plan->edge[k - count][1];
    }
    side[k] = (Side){a < b ? a : b, a < b ? b : a, k < count ? k / 3 : -1 - plan->boundary[k - count]};
  }
  qsort(side, (size_t)(count + given), sizeof *side, compare_sides);
  for (int32_t k = 0, next; k < count + given; k = next) {
    int triangles = 0, wall = 0, is_given = 0;
    int32_t component[2] = {0, 0}, apex[2] = {-1, -1};
    for (next = k; next < count + given && !compare_sides(&side[k], &side[next]); next++)
      if (side[next].triangle >= 0) {
        assert_true(triangles < 2);
        const int32_t *c = mesh->triangle[side[next].triangle];
        apex[triangles] = c[0] + c[1] + c[2] - side[k].a - side[k].b;
        component[triangles++] = mesh->component[side[next].triangle];
      } else {
        is_given = 1;
        wall = side[next].triangle == -2;
      }
    assert_int_equal(triangles, wall ? 1 : 2);
    if (!is_given) assert_int_equal(component[0], component[1]);
    for (int i = 0; is_given && i < 2; i++)
      if (apex[i] >= plan->input.point_count)
        clearance = fmin(clearance, height_over(mesh, apex[i], side[k].a, side[k].b) / size_at(plan, mesh->x[apex[i]]));
    found += is_given;
    edges++;
  }
  for (int32_t p = 0; p < mesh->point_count; p++) points += used[p];
  assert_int_equal(points, mesh->point_count);
  assert_int_equal(found, given);
  assert_int_equal(points - edges + mesh->triangle_count, euler);
  free(side);
  free(used);
  return clearance;
}

static void check_places(const Plan *plan, const CwPatchMesh *mesh, double uv_area) {
  double sum = 0;
  assert_memory_equal(mesh->x, plan->x, sizeof plan->x[0] * (size_t)plan->input.point_count);
  assert_memory_equal(mesh->uv, plan->uv, sizeof plan->uv[0] * (size_t)plan->input.point_count);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    double x[3];
    surface_at(plan, mesh->uv[p], x, NULL, NULL);
    assert_true(cw_distance(x, mesh->x[p]) < 1e-12);
  }
  for (int32_t t = 0; t < mesh->triangle_count; t++) {
    const int32_t *c = mesh->triangle[t];
    const double *a = mesh->uv[c[0]], *b = mesh->uv[c[1]], *d = mesh->uv[c[2]];
    double cross = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]), normal[3], up[3] = {0};
    assert_true(cross > 0);
    for (int i = 0; i < 3; i++) {
      double x[3], xu[3], xv[3];
      surface_at(plan, mesh->uv[c[i]], x, xu, xv);
      cw_cross(xu, xv, normal);
      for (int k = 0; k < 3; k++) up[k] += normal[k];
    }
    cw_normal(mesh->x[c[0]], mesh->x[c[1]], mesh->x[c[2]], normal);
    assert_true(cw_dot(normal, up) > 0);
    assert_true(mesh->component[t] >= 0 && mesh->component[t] < mesh->component_count);
    sum += 0.5 * cross;
  }
  assert_near(sum / uv_area, 1, 1e-11);
}

static Figures measure(const Plan *plan, const CwPatchMesh *mesh) {
  Figures figures = {180, 0, 0, 0, 0};
  for (int32_t t = 0; t < mesh->triangle_count; t++) {
    double l[3], least = 180;
    for (int i = 0; i < 3; i++) {
      const double *a = mesh->x[mesh->triangle[t][(i + 1) % 3]], *b = mesh->x[mesh->triangle[t][(i + 2) % 3]];
      l[i] = cw_distance(a, b);
      double ratio = 2 * l[i] / (size_at(plan, a) + size_at(plan, b));
      figures.outside += (ratio < 0.5 || ratio > 1.6) / (3.0 * mesh->triangle_count);
    }
    for (int i = 0; i < 3; i++) {
      double b = l[(i + 1) % 3], c = l[(i + 2) % 3];
      least = fmin(least, acos(fmax(-1, fmin(1, (b * b + c * c - l[i] * l[i]) / (2 * b * c)))) * 180 / M_PI);
    }
    double s = 0.5 * (l[0] + l[1] + l[2]);
    figures.area += sqrt(fmax(0, s * (s - l[0]) * (s - l[1]) * (s - l[2])));
    figures.least_angle = fmin(figures.least_angle, least);
    figures.mean_angle += least / mesh->triangle_count;
  }
  return figures;
}

double mesh_plan(Plan *plan, const char *title, double uv_area, int euler, CwPatchMesh *mesh) {
  if (cw_patch_mesh(&plan->input, mesh, &(CwOutcome){0}) != CW_OK) fail_msg("%s: %s", title, cw_fail_message());
  const double clearance = check_topology(plan, mesh, euler);
  check_places(plan, mesh, uv_area);
  return clearance;
}

Figures mesh_and_check(Plan *plan, const char *title, double uv_area, int euler, int components,
                       int32_t *triangle_count) {
  CwPatchMesh mesh, again;
  double clearance = mesh_plan(plan, title, uv_area, euler, &mesh);
  assert_int_equal(mesh.component_count, components);
  assert_int_equal(cw_patch_mesh(&plan->input, &again, &(CwOutcome){0}), CW_OK);
  assert_int_equal(again.point_count, mesh.point_count);
  assert_int_equal(again.triangle_count, mesh.triangle_count);
  assert_memory_equal(again.x, mesh.x, sizeof mesh.x[0] * (size_t)mesh.point_count);
  assert_memory_equal(again.triangle, mesh.triangle, sizeof mesh.triangle[0] * (size_t)mesh.triangle_count);
  assert_memory_equal(again.component, mesh.component, sizeof mesh.component[0] * (size_t)mesh.triangle_count);
  Figures figures = measure(plan, &mesh);
  figures.clearance = clearance;
  printf("%-24s %7d triangles, least angle %5.1f, mean %5.2f, edges out of size %.2f %%, clearance %.2f\n", title,
         mesh.triangle_count, figures.least_angle, figures.mean_angle, 100 * figures.outside, clearance);
  if (triangle_count) *triangle_count = mesh.triangle_count;
  cw_patch_mesh_free(&again);
  cw_patch_mesh_free(&mesh);
  free(plan);
  return figures;
}

void check_good(Figures figures, double least, double mean) {
  assert_true(figures.least_angle >= least);
  assert_true(figures.mean_angle >= mean);
  assert_true(figures.outside <= 0.01);
  assert_true(figures.clearance >= 0.4);
}
