// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/encroach.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "mesher/surface/cdt.h"

enum { ROUNDS = 40 };

typedef struct {
  double at[3];
  int32_t candidate;
} Near;

static int compare_near(const void *p, const void *q) {
  const Near *a = p, *b = q;
  if (a->at[0] != b->at[0]) return a->at[0] < b->at[0] ? -1 : 1;
  return a->candidate < b->candidate ? -1 : a->candidate > b->candidate;
}

CwStatus cw_beside_make(const double origin[3], const double axis[3][3], double reach, int32_t count,
                        const double (*x)[3], CwBeside *beside) {
  CwStatus status = CW_OK;
  Near *near = NULL;
  int32_t kept = 0, capacity = 0;
  *beside = (CwBeside){0};
  CW_GROW(near, capacity, 1); // qsort() wants an array even of none
  for (int32_t i = 0; i < count; i++) {
    double d[3];
    cw_sub(x[i], origin, d);
    double height = cw_dot(d, axis[2]);
    if (fabs(height) > reach) continue;
    CW_GROW(near, capacity, kept + 1);
    near[kept++] = (Near){{cw_dot(d, axis[0]), cw_dot(d, axis[1]), height}, i};
  }
  qsort(near, (size_t)kept, sizeof *near, compare_near);
  CW_NEW(beside->at, kept);
  CW_NEW(beside->candidate, kept);
  beside->count = kept;
  for (int32_t i = 0; i < kept; i++) {
    cw_copy(near[i].at, beside->at[i]);
    beside->candidate[i] = near[i].candidate;
  }
done:
  free(near);
  if (status != CW_OK) cw_beside_free(beside);
  return status;
}

void cw_beside_free(CwBeside *beside) {
  free(beside->at);
  free(beside->candidate);
  *beside = (CwBeside){0};
}

static double square(double x, double y) {
  return x * x + y * y;
}

int cw_encroach_circle(const double a[2], const double b[2], const double c[2], double centre[2], double *radius) {
  double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - a[0], c[1] - a[1]};
  double det = 2 * (u[0] * v[1] - u[1] * v[0]), uu = square(u[0], u[1]), vv = square(v[0], v[1]);
  if (!(fabs(det) > 1e-9 * (uu + vv))) return 0;
  double x = (v[1] * uu - u[1] * vv) / det, y = (u[0] * vv - v[0] * uu) / det;
  centre[0] = a[0] + x;
  centre[1] = a[1] + y;
  double longest = fmax(fmax(uu, vv), square(c[0] - b[0], c[1] - b[1]));
  *radius = cw_policy.interface_sphere * sqrt(fmin(square(x, y), longest));
  return 1;
}

int32_t cw_beside_in_sphere(const CwBeside *beside, const double centre[2], double radius, uint8_t *mark) {
  int32_t low = 0, high = beside->count, found = 0;
  while (low < high) {
    int32_t middle = low + (high - low) / 2;
    if (beside->at[middle][0] < centre[0] - radius)
      low = middle + 1;
    else
      high = middle;
  }
  for (int32_t i = low; i < beside->count && beside->at[i][0] <= centre[0] + radius; i++) {
    const double *p = beside->at[i];
    if (square(p[0] - centre[0], p[1] - centre[1]) + p[2] * p[2] >= radius * radius) continue;
    found++;
    if (mark) mark[beside->candidate[i]] = 1;
  }
  return found;
}

// A centre that is asked for.
typedef struct {
  double uv[2], need; // radius over the wanted length
  int32_t triangle;
} Centre;

static int compare_centres(const void *p, const void *q) {
  const Centre *a = p, *b = q;
  if (a->need != b->need) return a->need > b->need ? -1 : 1;
  return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

// The patch as it grows: its input with room for more points.
typedef struct {
  CwPatchInput input;
  double (*uv)[2], (*x)[3];
  int32_t uv_capacity, x_capacity;
} Growing;

static CwStatus add_point(Growing *growing, const double uv[2]) {
  CwStatus status = CW_OK;
  CW_GROW(growing->uv, growing->uv_capacity, growing->input.point_count + 1);
  CW_GROW(growing->x, growing->x_capacity, growing->input.point_count + 1);
  growing->input.uv = (const double(*)[2])growing->uv;
  growing->input.x = (const double(*)[3])growing->x;
  int32_t p = growing->input.point_count++;
  memcpy(growing->uv[p], uv, sizeof growing->uv[p]);
  growing->input.surface(growing->input.surface_context, uv, growing->x[p], NULL, NULL);
done:
  return status;
}

// Inside of the outline, and not too near to its edges.
static int has_room(const CwPatchInput *input, const double uv[2], double height) {
  int inside = 0;
  for (int32_t e = 0; e < input->edge_count; e++) {
    const double *a = input->uv[input->edge[e][0]], *b = input->uv[input->edge[e][1]];
    double d[2] = {b[0] - a[0], b[1] - a[1]}, p[2] = {uv[0] - a[0], uv[1] - a[1]};
    double along = fmin(fmax((p[0] * d[0] + p[1] * d[1]) / square(d[0], d[1]), 0), 1);
    if (square(p[0] - along * d[0], p[1] - along * d[1]) < height * height) return 0;
    if ((a[1] > uv[1]) != (b[1] > uv[1]) && uv[0] < a[0] + (uv[1] - a[1]) / d[1] * d[0]) inside = !inside;
  }
  return inside;
}

static int keeps_distance(const CwPatchInput *input, const double uv[2], double distance) {
  for (int32_t p = 0; p < input->point_count; p++) {
    if (square(input->uv[p][0] - uv[0], input->uv[p][1] - uv[1]) < distance * distance) return 0;
  }
  return 1;
}

// Adds the centres that encroached triangles ask for, most wanted first; *added: how many.
static CwStatus add_centres(Growing *growing, const CwCdt *cdt, const CwBeside *beside, int32_t *encroached,
                            int32_t *added) {
  CwStatus status = CW_OK;
  Centre *centre = NULL;
  int32_t count = 0;
  *encroached = *added = 0;
  CW_NEW(centre, cdt->triangle_count);
  for (int32_t t = 0; t < cdt->triangle_count; t++) {
    const int32_t *p = cdt->triangle[t];
    double middle[2], radius, x[3];
    if (!cw_encroach_circle(growing->uv[p[0]], growing->uv[p[1]], growing->uv[p[2]], middle, &radius) ||
        cw_beside_in_sphere(beside, middle, radius, NULL) == 0)
      continue;
    ++*encroached;
    growing->input.surface(growing->input.surface_context, middle, x, NULL, NULL);
    double wanted = growing->input.size(growing->input.size_context, x);
    if (sqrt(square(middle[0] - growing->uv[p[0]][0], middle[1] - growing->uv[p[0]][1])) <
            cw_policy.surface_least_distance * wanted ||
        !has_room(&growing->input, middle, cw_policy.boundary_distance * wanted))
      continue;
    centre[count++] = (Centre){{middle[0], middle[1]}, radius / wanted, t};
  }
  qsort(centre, (size_t)count, sizeof *centre, compare_centres);
  for (int32_t k = 0; k < count; k++) {
    double x[3];
    growing->input.surface(growing->input.surface_context, centre[k].uv, x, NULL, NULL);
    double wanted = growing->input.size(growing->input.size_context, x);
    if (!keeps_distance(&growing->input, centre[k].uv, cw_policy.surface_least_distance * wanted)) continue;
    CW_TRY(add_point(growing, centre[k].uv));
    ++*added;
  }
done:
  free(centre);
  return status;
}

CwStatus cw_encroach_refine(const CwPatchInput *patch, const CwBeside *beside, CwEncroachRefined *refined) {
  CwStatus status = CW_OK;
  CwCdt cdt = {0};
  Growing growing = {.input = *patch, .uv_capacity = patch->point_count, .x_capacity = patch->point_count};
  const double scale[2] = {1, 1};
  int32_t encroached = 0, added = 0;
  CwOutcome outcome = {0};
  *refined = (CwEncroachRefined){0};
  CW_NEW(growing.uv, patch->point_count);
  CW_NEW(growing.x, patch->point_count);
  memcpy(growing.uv, patch->uv, (size_t)patch->point_count * sizeof *growing.uv);
  memcpy(growing.x, patch->x, (size_t)patch->point_count * sizeof *growing.x);
  growing.input.uv = (const double(*)[2])growing.uv;
  growing.input.x = (const double(*)[3])growing.x;
  for (;; refined->rounds++) {
    cw_cdt_free(&cdt);
    CW_TRY(cw_cdt_make(&growing.input, scale, &cdt, &outcome));
    CW_REQUIRE(outcome.kind == CW_OUTCOME_DONE, CW_ERR_MESH, "%s", outcome.reason);
    if (refined->rounds == ROUNDS) break;
    CW_TRY(add_centres(&growing, &cdt, beside, &encroached, &added));
    if (refined->rounds == 0) refined->encroached = encroached;
    refined->left = encroached;
    if (added == 0) break;
  }
  refined->point_count = growing.input.point_count - patch->point_count;
  CW_NEW(refined->uv, refined->point_count);
  memcpy(refined->uv, growing.uv + patch->point_count, (size_t)refined->point_count * sizeof *refined->uv);
  refined->triangle_count = cdt.triangle_count;
  refined->triangle = cdt.triangle;
  cdt.triangle = NULL;
done:
  cw_cdt_free(&cdt);
  free(growing.uv);
  free(growing.x);
  if (status != CW_OK) cw_encroach_refined_free(refined);
  return status;
}

void cw_encroach_refined_free(CwEncroachRefined *refined) {
  free(refined->uv);
  free(refined->triangle);
  *refined = (CwEncroachRefined){0};
}
