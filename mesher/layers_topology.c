// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>

#include "mesher/incident.h"
#include "mesher/layers_inner.h"

// Some ten numbers: by insertion.
static void sort_few(int32_t count, int32_t *number) {
  for (int32_t i = 1; i < count; i++) {
    int32_t moved = number[i], at = i;
    for (; at > 0 && number[at - 1] > moved; at--) number[at] = number[at - 1];
    number[at] = moved;
  }
}

static int find_near(const CwLayerWork *work, int32_t v, int32_t w) {
  int32_t low = work->near_start[v], high = work->near_start[v + 1];
  while (high - low > 1) {
    int32_t middle = (low + high) / 2;
    if (work->near[middle] <= w)
      low = middle;
    else
      high = middle;
  }
  return low;
}

static CwStatus check_input(const CwLayerInput *in) {
  CwStatus status = CW_OK;
  for (int32_t v = 0; v < in->point_count; v++) {
    const double *x = in->x[v];
    CW_REQUIRE(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]), CW_ERR_INPUT,
               "layers: wall vertex %d has a coordinate that is not a number", v);
    CW_REQUIRE(isfinite(in->target[v]) && in->target[v] > 0, CW_ERR_INPUT,
               "layers: height %g mm asked at (%.4f, %.4f, %.4f) mm; it must be above 0", in->target[v] * 1e3,
               x[0] * 1e3, x[1] * 1e3, x[2] * 1e3);
    int guides = in->guide_count ? in->guide_count[v] : 0;
    CW_REQUIRE(guides >= 0 && guides <= 2, CW_ERR_INPUT,
               "layers: %d guides at (%.4f, %.4f, %.4f) mm; allowed are 0 to 2", guides, x[0] * 1e3, x[1] * 1e3,
               x[2] * 1e3);
    for (int i = 0; i < guides; i++)
      CW_REQUIRE(fabs(length3(in->guide_normal[v][i]) - 1) < 1e-6, CW_ERR_INPUT,
                 "layers: guide normal at (%.4f, %.4f, %.4f) mm is not a unit vector", x[0] * 1e3, x[1] * 1e3,
                 x[2] * 1e3);
  }
  for (int32_t f = 0; f < in->triangle_count; f++)
    for (int i = 0; i < 3; i++)
      CW_REQUIRE(in->triangle[f][i] >= 0 && in->triangle[f][i] < in->point_count, CW_ERR_INPUT,
                 "layers: wall triangle %d names point %d of %d", f, in->triangle[f][i], in->point_count);
  for (int32_t f = 0; f < in->obstacle_triangle_count; f++)
    for (int i = 0; i < 3; i++)
      CW_REQUIRE(in->obstacle_triangle[f][i] >= 0 && in->obstacle_triangle[f][i] < in->obstacle_point_count,
                 CW_ERR_INPUT, "layers: obstacle triangle %d names point %d of %d", f, in->obstacle_triangle[f][i],
                 in->obstacle_point_count);
done:
  return status;
}

// The next and the last corner of triangle f, seen from its corner v.
static void beside(const CwLayerInput *in, int32_t f, int32_t v, int32_t *next, int32_t *last) {
  const int32_t *corner = in->triangle[f];
  int i = corner[0] == v ? 0 : corner[1] == v ? 1 : 2;
  *next = corner[(i + 1) % 3];
  *last = corner[(i + 2) % 3];
}

static int is_among(int32_t count, const int32_t *number, int32_t wanted) {
  int found = 0;
  for (int32_t i = 0; i < count; i++) found |= number[i] == wanted;
  return found;
}

static CwStatus lists(CwLayerWork *work) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = work->in;
  CwIncident around = {0};
  CW_TRY(cw_incident_make(work->n, in->triangle_count, in->triangle, &around));
  work->face_start = around.start;
  work->face = around.triangle;
  CW_NEW_UNSET(work->near_start, work->n + 1);
  CW_NEW_UNSET(work->near, 6 * (size_t)in->triangle_count);
  int32_t count = 0;
  for (int32_t v = 0; v < work->n; v++) {
    int32_t start = count, next, last;
    CW_REQUIRE(work->face_start[v + 1] > work->face_start[v], CW_ERR_INPUT,
               "layers: vertex %d at (%.4f, %.4f, %.4f) mm belongs to no wall triangle", v, in->x[v][0] * 1e3,
               in->x[v][1] * 1e3, in->x[v][2] * 1e3);
    work->near_start[v] = start;
    for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++) {
      beside(in, work->face[k], v, &next, &last);
      work->near[count++] = next;
    }
    int32_t nexts = count - start; // most of them, or all
    for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++) {
      beside(in, work->face[k], v, &next, &last);
      if (!is_among(nexts, work->near + start, last)) work->near[count++] = last;
    }
    sort_few(count - start, work->near + start);
    int32_t kept = start;
    for (int32_t k = start; k < count; k++)
      if (k == start || work->near[k] != work->near[kept - 1]) work->near[kept++] = work->near[k];
    count = kept;
  }
  work->near_start[work->n] = count;
done:
  return status;
}

// Two edges of a wall triangle and its area vector, of twice its area, into the domain: the input's points out of it.
static void area_vector(const CwLayerInput *in, int32_t f, double e1[3], double e2[3], double vector[3]) {
  const int32_t *corner = in->triangle[f];
  sub3(in->x[corner[1]], in->x[corner[0]], e1);
  sub3(in->x[corner[2]], in->x[corner[0]], e2);
  cross3(e2, e1, vector);
}

static CwStatus find_normal(void *context, int32_t f, void *out) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = ((const CwLayerWork *)context)->in;
  const int32_t *corner = in->triangle[f];
  double e1[3], e2[3], *normal = out;
  area_vector(in, f, e1, e2, normal);
  CW_REQUIRE(unit3(normal) > 1e-12 * (dot3(e1, e1) + dot3(e2, e2)), CW_ERR_INPUT,
             "layers: wall triangle without area at (%.4f, %.4f, %.4f) mm", in->x[corner[0]][0] * 1e3,
             in->x[corner[0]][1] * 1e3, in->x[corner[0]][2] * 1e3);
done:
  return status;
}

static double twice_area(const CwLayerInput *in, int32_t f) {
  double e1[3], e2[3], normal[3];
  area_vector(in, f, e1, e2, normal);
  return length3(normal);
}

// Half the cotangent of the angle at corner i of f, which belongs to the opposite edge; clamped so that obtuse corners
// keep the system monotone.
static double half_cotangent(const CwLayerInput *in, int32_t f, int i) {
  const int32_t *corner = in->triangle[f];
  double e1[3], e2[3];
  sub3(in->x[corner[(i + 1) % 3]], in->x[corner[i]], e1);
  sub3(in->x[corner[(i + 2) % 3]], in->x[corner[i]], e2);
  return 0.5 * fmin(fmax(dot3(e1, e2) / twice_area(in, f), 0.05), 5.0);
}

static CwStatus find_weights(void *context, int32_t v, void *out) {
  const CwLayerWork *work = context;
  double *weight = out;
  for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++) {
    int32_t f = work->face[k];
    const int32_t *corner = work->in->triangle[f];
    int i = corner[0] == v ? 0 : corner[1] == v ? 1 : 2, next = (i + 1) % 3, last = (i + 2) % 3;
    weight[find_near(work, v, corner[next]) - work->near_start[v]] += half_cotangent(work->in, f, last);
    weight[find_near(work, v, corner[last]) - work->near_start[v]] += half_cotangent(work->in, f, next);
  }
  return CW_OK;
}

// Of a vertex.
typedef struct {
  double area, edge_min;
} Measured;

static CwStatus measure(void *context, int32_t v, void *out) {
  const CwLayerWork *work = context;
  const CwLayerInput *in = work->in;
  Measured *made = out;
  made->edge_min = INFINITY;
  for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++)
    made->area += twice_area(in, work->face[k]) / 6;
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    made->edge_min = fmin(made->edge_min, distance3(in->x[work->near[k]], in->x[v]));
  }
  return CW_OK;
}

static CwStatus measures(CwLayerWork *work) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = work->in;
  Measured *measured = NULL;
  CW_NEW(measured, work->n);
  CW_NEW(work->face_normal, in->triangle_count);
  CW_NEW(work->weight, work->near_start[work->n]);
  CW_NEW(work->area, work->n);
  CW_NEW(work->edge_min, work->n);
  CW_TRY(cw_share("layers: normals", in->triangle_count, sizeof *work->face_normal, find_normal, work,
                  work->face_normal));
  CW_TRY(cw_share_lists("layers: weights", work->n, work->near_start, sizeof *work->weight, find_weights, work,
                        work->weight));
  CW_TRY(cw_share("layers: lengths", work->n, sizeof *measured, measure, work, measured));
  for (int32_t v = 0; v < work->n; v++) {
    work->area[v] = measured[v].area;
    work->edge_min[v] = measured[v].edge_min;
  }
done:
  free(measured);
  return status;
}

CwStatus cw_layers_topology(const CwLayerInput *input, CwLayerWork *work) {
  CwStatus status = CW_OK;
  work->in = input;
  work->n = input->point_count;
  CW_TRY(check_input(input));
  CW_TRY(lists(work));
  CW_TRY(measures(work));
  CW_NEW(work->normal, work->n);
  CW_NEW(work->normal_cos, work->n);
  CW_NEW(work->base, work->n);
  CW_NEW(work->base_cos, work->n);
  CW_NEW(work->crease, work->n);
  CW_NEW(work->along, work->n);
  CW_NEW(work->column, work->n);
  CW_NEW(work->t, work->n);
  CW_NEW(work->most, work->n);
  CW_NEW(work->reason, work->n);
done:
  return status;
}

void cw_layers_work_free(CwLayerWork *work) {
  free(work->face_normal);
  free(work->face_start);
  free(work->face);
  free(work->near_start);
  free(work->near);
  free(work->weight);
  free(work->area);
  free(work->edge_min);
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
  free(work->curve);
  cw_fans_free(&work->fans);
  memset(work, 0, sizeof *work);
}
