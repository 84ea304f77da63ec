// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers_topology.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/incident.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/parallel_for.h"

static CwStatus check_triangles(const char *of, int32_t count, const int32_t (*triangle)[3], int32_t points) {
  CwStatus status = CW_OK;
  for (int32_t f = 0; f < count; f++)
    for (int k = 0; k < 3; k++)
      CW_REQUIRE(triangle[f][k] >= 0 && triangle[f][k] < points, CW_ERR_INPUT,
                 "layers: %s triangle %d names point %d of %d", of, f, triangle[f][k], points);
done:
  return status;
}

static CwStatus check_vertex(const CwLayerInput *in, int32_t v) {
  CwStatus status = CW_OK;
  const double *x = in->x[v];
  CW_REQUIRE(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]), CW_ERR_INPUT,
             "layers: wall vertex %d has a coordinate that is not a number", v);
  CW_REQUIRE(isfinite(in->target[v]) && in->target[v] > 0, CW_ERR_INPUT,
             "layers: thickness %g mm asked at (%.4f, %.4f, %.4f) mm; it must be above 0", cw_mm(in->target[v]),
             CW_MM(x));
  int constraints = cw_layer_constraints(in, v);
  CW_REQUIRE(constraints >= 0 && constraints <= 2, CW_ERR_INPUT,
             "layers: %d constraints at (%.4f, %.4f, %.4f) mm; allowed are 0 to 2", constraints, CW_MM(x));
  for (int i = 0; i < constraints; i++)
    CW_REQUIRE(fabs(cw_norm(in->constraint_normal[v][i]) - 1) < 1e-6, CW_ERR_INPUT,
               "layers: constraint normal at (%.4f, %.4f, %.4f) mm is not a unit vector", CW_MM(x));
done:
  return status;
}

// Inserts w into an ascending list unless it is there.
static int32_t insert(int32_t *list, int32_t count, int32_t w) {
  int32_t at = count;
  while (at > 0 && list[at - 1] > w) at--;
  if (at > 0 && list[at - 1] == w) return count;
  memmove(list + at + 1, list + at, (size_t)(count - at) * sizeof *list);
  list[at] = w;
  return count + 1;
}

// The neighbours of v, ascending; -1 in the places left over of two for each triangle around it.
static CwStatus list_near(void *context, int32_t v, void *out) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = context;
  const CwLayerInput *in = work->in;
  int32_t *list = out, count = 0, capacity = 2 * (work->face_start[v + 1] - work->face_start[v]);
  CW_TRY(check_vertex(in, v));
  CW_REQUIRE(capacity > 0, CW_ERR_INPUT, "layers: vertex %d at (%.4f, %.4f, %.4f) mm belongs to no wall triangle", v,
             CW_MM(in->x[v]));
  for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++) {
    const int32_t *corner = in->triangle[work->face[k]];
    for (int i = 0; i < 3; i++) {
      if (corner[i] != v) count = insert(list, count, corner[i]);
    }
  }
  while (count < capacity) list[count++] = -1;
done:
  return status;
}

static CwStatus lists(CwLayerWork *work) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = work->in;
  CwIncident around = {0};
  int32_t *start = NULL, count = 0; // of the lists as they come
  CW_TRY(cw_incident_make(work->n, in->triangle_count, in->triangle, &around));
  work->face_start = around.start;
  work->face = around.triangle;
  CW_NEW_UNSET(work->near_start, work->n + 1);
  CW_NEW_UNSET(work->near, 6 * (size_t)in->triangle_count);
  CW_NEW_UNSET(start, work->n + 1);
  for (int32_t v = 0; v <= work->n; v++) start[v] = 2 * work->face_start[v];
  CW_TRY(cw_parallel_for_lists(work->in->context, "layers: neighbours", work->n, start, sizeof *work->near, list_near,
                               work, work->near));
  for (int32_t v = 0; v < work->n; v++) {
    work->near_start[v] = count;
    for (int32_t k = start[v]; k < start[v + 1] && work->near[k] >= 0; k++) work->near[count++] = work->near[k];
  }
  work->near_start[work->n] = count;
  int32_t *fitted = realloc(work->near, (size_t)(count ? count : 1) * sizeof *fitted); // half is left; of 0 it frees
  if (fitted) work->near = fitted;
done:
  free(start);
  return status;
}

// Two edges of a wall triangle and its area vector, of twice its area, into the domain: the input's points out of it.
static void area_vector(const CwLayerInput *in, int32_t f, double e1[3], double e2[3], double vector[3]) {
  const int32_t *corner = in->triangle[f];
  cw_sub(in->x[corner[1]], in->x[corner[0]], e1);
  cw_sub(in->x[corner[2]], in->x[corner[0]], e2);
  cw_cross(e2, e1, vector);
}

static CwStatus find_normal(void *context, int32_t f, void *out) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = ((const CwLayerWork *)context)->in;
  const int32_t *corner = in->triangle[f];
  double e1[3], e2[3], *normal = out;
  area_vector(in, f, e1, e2, normal);
  CW_REQUIRE(cw_unit(normal) > 1e-12 * (cw_dot(e1, e1) + cw_dot(e2, e2)), CW_ERR_INPUT,
             "layers: wall triangle without area at (%.4f, %.4f, %.4f) mm", CW_MM(in->x[corner[0]]));
done:
  return status;
}

static double twice_area(const CwLayerInput *in, int32_t f) {
  double e1[3], e2[3], normal[3];
  area_vector(in, f, e1, e2, normal);
  return cw_norm(normal);
}

// Half the cotangent of the angle at corner i of f, which belongs to the opposite edge; clamped so that obtuse corners
// keep the system monotone.
static double half_cotangent(const CwLayerInput *in, int32_t f, int i, double twice_area) {
  const int32_t *corner = in->triangle[f];
  double e1[3], e2[3];
  cw_sub(in->x[corner[(i + 1) % 3]], in->x[corner[i]], e1);
  cw_sub(in->x[corner[(i + 2) % 3]], in->x[corner[i]], e2);
  return 0.5 * fmin(fmax(cw_dot(e1, e2) / twice_area, 0.05), 5.0);
}

// The place of w in a list that holds it.
static int32_t place_in(const int32_t *list, int32_t w) {
  int32_t at = 0;
  while (list[at] != w) at++;
  return at;
}

void cw_layers_weights(const CwLayerWork *work, int32_t v, double *weight, double *area) {
  const int32_t start = work->near_start[v], *near = work->near + start;
  memset(weight, 0, (size_t)(work->near_start[v + 1] - start) * sizeof *weight);
  *area = 0;
  for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++) {
    int32_t f = work->face[k];
    const int32_t *corner = work->in->triangle[f];
    int i = corner[0] == v ? 0 : corner[1] == v ? 1 : 2, next = (i + 1) % 3, last = (i + 2) % 3;
    double twice = twice_area(work->in, f);
    weight[place_in(near, corner[next])] += half_cotangent(work->in, f, last, twice);
    weight[place_in(near, corner[last])] += half_cotangent(work->in, f, next, twice);
    *area += twice / 6;
  }
}

double cw_layers_shortest_edge(const CwLayerWork *work, int32_t v) {
  double least = INFINITY;
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    least = fmin(least, cw_distance(work->in->x[work->near[k]], work->in->x[v]));
  }
  return least;
}

CwStatus cw_layers_topology(const CwLayerInput *input, CwLayerWork *work) {
  CwStatus status = CW_OK;
  work->in = input;
  work->n = input->point_count;
  CW_TRY(check_triangles("wall", input->triangle_count, input->triangle, input->point_count));
  CW_TRY(check_triangles("obstacle", input->obstacle_triangle_count, input->obstacle_triangle,
                         input->obstacle_point_count));
  CW_TRY(lists(work));
  CW_NEW_UNSET(work->face_normal, input->triangle_count);
  CW_TRY(cw_parallel_for(work->in->context, "layers: normals", input->triangle_count, sizeof *work->face_normal,
                         find_normal, work, work->face_normal));
  CW_NEW_UNSET(work->normal, work->n);
  CW_NEW_UNSET(work->normal_cos, work->n);
  CW_NEW_UNSET(work->base, work->n);
  CW_NEW_UNSET(work->base_cos, work->n);
  CW_NEW_UNSET(work->crease, work->n);
  CW_NEW(work->along, work->n);
  CW_NEW_UNSET(work->column, work->n);
  CW_NEW_UNSET(work->t, work->n);
  CW_NEW_UNSET(work->most, work->n);
  CW_NEW_UNSET(work->reason, work->n);
done:
  return status;
}

void cw_layers_work_free(CwLayerWork *work) {
  free(work->face_normal);
  free(work->face_start);
  free(work->face);
  free(work->near_start);
  free(work->near);
  free(work->normal);
  free(work->normal_cos);
  free(work->base);
  free(work->base_cos);
  free(work->crease);
  free(work->along);
  free(work->column);
  free(work->t);
  free(work->most);
  free(work->reason);
  free(work->gap);
  free(work->stale);
  free(work->curve);
  memset(work, 0, sizeof *work);
}
