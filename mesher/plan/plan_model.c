// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/cad/rays.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"

enum { STAND_CHORDS = 16, EDGE_POINTS_LEAST = 17, EDGE_POINTS_MOST = 3000, EDGE_ROUGH = 16, PIECE_STACK = 64 };
enum {
  SAMPLES_OF_REGION = 1000, // of the volume
  TOGETHER = 8,             // places of the size field in one sample, at most
  PARTS_ALONG = 4           // parts of a place along each side, at most
};
static const double HAIR = 1e-6;      // of the reach of a ray: the triangle that it starts from is nearer
static const double EDGE_STEP = 0.25; // base sizes between points along CAD edges
// Predicted tetrahedra: those of the lattice, and a shell of them that fits it to the layer top (the paper's pump from
// 1 to 20 million cells, by region).
static const double LATTICE = 8.4; // per volume / h^3
static const double SHELL = 4.2;   // per area of the walls / h^2
static const double WALL_STEP = 1; // base sizes between points on walls, at most

int cw_plan_edge_is_smooth(const CwCad *cad, int edge) {
  int face[2];
  double range[2], normal[2][3];
  cw_cad_edge_range(cad, edge, range);
  cw_cad_edge_faces(cad, edge, face);
  for (int s = 0; s < 2; s++) {
    double uv[2];
    cw_cad_edge_uv(cad, edge, face[s], (range[0] + range[1]) / 2, uv);
    cw_cad_face_normal(cad, face[s], uv, normal[s]);
  }
  return cw_dot(normal[0], normal[1]) > cw_policy.crease_cosine;
}

static int32_t points_of_edge(const CwCad *cad, int edge, const double range[2], double step) {
  double before[3], x[3], length = 0;
  for (int i = 0; i <= EDGE_ROUGH; i++) {
    cw_cad_edge_point(cad, edge, range[0] + (range[1] - range[0]) * i / EDGE_ROUGH, x, NULL);
    if (i > 0) length += cw_distance(before, x);
    cw_copy(x, before);
  }
  return (int32_t)fmin(fmax(ceil(length / step) + 1, EDGE_POINTS_LEAST), EDGE_POINTS_MOST);
}

// Adds the chords of the CAD edges that stand for the border of two faces, one of them left out.
static CwStatus add_stands(const CwCad *cad, int face, int other, CwPlanModel *model, int32_t *capacity) {
  CwStatus status = CW_OK;
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    if (!cw_cad_edge_borders(cad, e, face, other)) continue;
    double range[2];
    cw_cad_edge_range(cad, e, range);
    CW_GROW(model->stand, *capacity, model->stand_count + STAND_CHORDS);
    for (int i = 0; i < STAND_CHORDS; i++) {
      CwPlanStand *made = &model->stand[model->stand_count++];
      for (int end = 0; end < 2; end++)
        cw_cad_edge_point(cad, e, range[0] + (range[1] - range[0]) * (i + end) / STAND_CHORDS, made->x[end], NULL);
      cw_cad_edge_stands_for(cad, e, &made->gap);
    }
  }
done:
  return status;
}

// The borders of left-out faces, where cuts end that have to go on beyond.
static CwStatus sample_left_out(const CwCad *cad, CwPlanModel *model, int32_t capacity) {
  CwStatus status = CW_OK;
  int32_t stands = 0, start = 0;
  int beside = -1, border = -1; // faces of the border that the chords from `start` on are of
  const CwBackground *background = model->background;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    if (!cw_cad_face_is_left_out(cad, background->face[t])) continue;
    for (int k = 0; k < 3; k++) {
      int face = background->face[t], other = background->face[background->neighbour[t][k]];
      if (cw_cad_face_is_left_out(cad, other)) continue;
      const double *a = background->x[background->triangle[t][k]];
      const double *b = background->x[background->triangle[t][(k + 1) % 3]];
      CW_GROW(model->edge, capacity, model->edge_count + 1);
      CwPlanEdgePoint *made = &model->edge[model->edge_count++];
      if (face != beside || other != border) {
        start = model->stand_count;
        CW_TRY(add_stands(cad, face, other, model, &stands));
        beside = face;
        border = other;
      }
      *made = (CwPlanEdgePoint){
          .half = cw_distance(a, b) / 2, .stand_start = start, .stand_count = model->stand_count - start};
      cw_lerp(a, b, 0.5, made->x);
      cw_sub(b, a, made->tangent);
      cw_unit(made->tangent);
    }
  }
done:
  return status;
}

static CwStatus sample_edges(const CwCad *cad, const CwPlanOptions *options, CwPlanModel *model) {
  CwStatus status = CW_OK;
  int32_t most = 0;
  double range[2], step = EDGE_STEP * options->base_size;
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    cw_cad_edge_range(cad, e, range);
    most += points_of_edge(cad, e, range, step);
  }
  CW_NEW(model->edge, most);
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    int faces[2];
    cw_cad_edge_faces(cad, e, faces);
    cw_cad_edge_range(cad, e, range);
    if (!cw_cad_face_is_wall(cad, faces[0]) && !cw_cad_face_is_wall(cad, faces[1])) continue;
    int smooth = cw_plan_edge_is_smooth(cad, e);
    double layers = smooth ? 0 : cw_policy.plan_room;
    int32_t points = points_of_edge(cad, e, range, step);
    for (int32_t i = 0; i < points; i++) {
      CwPlanEdgePoint *made = &model->edge[model->edge_count++];
      *made = (CwPlanEdgePoint){0};
      cw_cad_edge_point(cad, e, range[0] + (range[1] - range[0]) * i / (points - 1), made->x, made->tangent);
      cw_unit(made->tangent);
      made->touch = cw_policy.boundary_distance * cw_size_at(model->size, made->x);
      made->room = layers * cw_plan_wall_near(model, made->x, model->thickest, -1).thickness;
      made->end = i == 0 || i == points - 1;
    }
  }
  CW_TRY(sample_left_out(cad, model, most));
done:
  return status;
}

typedef struct {
  double x[3][3];
} Facet;

// Halves the longest edge where it is longer than `limit`; the second half goes to *other. Returns whether it did.
static int halve(Facet *facet, double limit, Facet *other) {
  int longest = 0;
  double most = -1;
  for (int k = 0; k < 3; k++) {
    double length = cw_distance(facet->x[k], facet->x[(k + 1) % 3]);
    if (length > most) most = length, longest = k;
  }
  if (most <= limit) return 0;
  int next = (longest + 1) % 3;
  double middle[3];
  *other = *facet;
  cw_lerp(facet->x[longest], facet->x[next], 0.5, middle);
  cw_copy(middle, facet->x[next]);
  cw_copy(middle, other->x[longest]);
  return 1;
}

// Points all over a triangle of a wall, in order; stores them where there is room for them. Returns their number.
static int32_t divide_triangle(const CwPlanModel *model, int32_t t, double (*point)[3]) {
  const CwBackground *background = model->background;
  Facet stack[PIECE_STACK];
  int32_t count = 0;
  int top = 1;
  for (int k = 0; k < 3; k++) cw_copy(background->x[background->triangle[t][k]], stack[0].x[k]);
  while (top > 0) {
    Facet facet = stack[--top], other;
    if (top + 2 <= PIECE_STACK && halve(&facet, WALL_STEP * model->base_size, &other)) {
      stack[top++] = other;
      stack[top++] = facet;
      continue;
    }
    if (point) {
      for (int k = 0; k < 3; k++) point[count][k] = (facet.x[0][k] + facet.x[1][k] + facet.x[2][k]) / 3;
    }
    count++;
  }
  return count;
}

static CwStatus count_points(void *context, int32_t t, void *out) {
  const CwPlanModel *model = context;
  if (model->wall[t]) *(int32_t *)out = divide_triangle(model, t, NULL);
  return CW_OK;
}

static CwStatus find_points(void *context, int32_t t, void *out) {
  const CwPlanModel *model = context;
  if (model->wall[t]) divide_triangle(model, t, out);
  return CW_OK;
}

static CwBox box_of_point(const void *x, int32_t item) {
  return cw_box_of_point(((const double(*)[3])x)[item]);
}

static CwStatus sample_walls(CwPlanModel *model) {
  CwStatus status = CW_OK;
  int32_t triangles = model->background->triangle_count, *count = NULL, *start = NULL;
  CW_NEW_UNSET(count, triangles);
  CW_NEW_UNSET(start, triangles + 1);
  CW_TRY(cw_parallel_for(model->context, "decomposition", triangles, sizeof *count, count_points, model, count));
  start[0] = 0;
  for (int32_t t = 0; t < triangles; t++) {
    start[t + 1] = start[t] + count[t];
    model->thickest = fmax(model->thickest, model->triangle[t].thickness);
  }
  model->wall_count = start[triangles];
  CW_NEW_UNSET(model->wall_triangle, model->wall_count);
  CW_NEW_UNSET(model->wall_x, model->wall_count);
  for (int32_t t = 0; t < triangles; t++) {
    for (int32_t i = start[t]; i < start[t + 1]; i++) model->wall_triangle[i] = t;
  }
  CW_TRY(cw_parallel_for_lists(model->context, "decomposition", triangles, start, sizeof *model->wall_x, find_points,
                               model, model->wall_x));
  CwBox within = cw_box_of_points(model->wall_count, (const double(*)[3])model->wall_x);
  CW_TRY(cw_box_tree_make(model->context, model->wall_count, &within, box_of_point, model->wall_x, &model->walls));
done:
  free(count);
  free(start);
  return status;
}

// The nearest point on a wall so far.
typedef struct {
  const CwPlanModel *model;
  const double *x;
  double reach, square; // its distance, and the square of it
  int32_t point;        // -1: none yet
} Nearest;

static int take_nearer(void *context, int32_t point) {
  Nearest *nearest = context;
  double d[3];
  cw_sub(nearest->model->wall_x[point], nearest->x, d);
  double square = cw_dot(d, d);
  if (square < nearest->square) *nearest = (Nearest){nearest->model, nearest->x, sqrt(square), square, point};
  return 0;
}

CwPlanWall cw_plan_wall_near(const CwPlanModel *model, const double x[3], double reach, int32_t beside) {
  double step = WALL_STEP * model->base_size, d[3];
  Nearest nearest = {model, x, hypot(reach, 0.5 * step), INFINITY, -1};
  if (beside >= 0 && cw_distance(model->wall_x[beside], x) < nearest.reach) take_nearer(&nearest, beside);
  cw_box_tree_near(&model->walls, x, &nearest.reach, take_nearer, &nearest);
  if (nearest.point < 0) return (CwPlanWall){-1, -1, INFINITY, 0};
  CwPlanWall wall = {model->wall_triangle[nearest.point], nearest.point, nearest.reach, 0};
  wall.thickness = model->triangle[wall.triangle].thickness;
  // Beside a point the wall goes on: then its plane is what counts.
  cw_sub(x, model->wall_x[nearest.point], d);
  double off = fabs(cw_dot(d, model->triangle[wall.triangle].normal));
  if (nearest.square - off * off < step * step) wall.distance = off;
  return wall;
}

typedef struct {
  const CwCad *cad;
  const CwPlanOptions *options;
  const CwPlanModel *model;
} Walls;

// A column takes no more than its share of the way to a wall that faces it, as layers/ has it.
static double limited_by_gap(const CwPlanModel *model, int32_t t, const double normal[3], double thickness) {
  const CwBackground *background = model->background;
  const double inward[3] = {-normal[0], -normal[1], -normal[2]}, far = thickness / cw_policy.gap_share;
  double centre[3], opposite[3], distance;
  cw_background_area(background, t, centre);
  int32_t met = cw_rays_exit(background->rays, centre, inward, HAIR * far, far, &distance);
  if (met < 0 || !model->wall[met]) return thickness;
  cw_background_normal(background, met, opposite);
  return cw_dot(inward, opposite) >= cw_policy.size_facing ? cw_policy.gap_share * distance : thickness;
}

static CwStatus measure(void *context, int32_t t, void *out) {
  const Walls *walls = context;
  const CwPlanOptions *options = walls->options;
  const CwBackground *background = walls->model->background;
  CwPlanTriangle *made = out;
  double centre[3] = {0, 0, 0};
  cw_background_normal(background, t, made->normal);
  if (!walls->model->wall[t]) return CW_OK;
  for (int k = 0; k < 9; k++) centre[k % 3] += background->x[background->triangle[t][k / 3]][k % 3] / 3;
  double h = cw_size_at(walls->model->size, centre);
  made->density = (options->prism_factor + SHELL) / (h * h);
  double thickness = options->thickness(options->given, background->face[t], centre, made->normal);
  made->thickness = limited_by_gap(walls->model, t, made->normal, thickness);
  return CW_OK;
}

static CwStatus measure_walls(const CwCad *cad, const CwPlanOptions *options, CwPlanModel *model) {
  CwStatus status = CW_OK;
  const CwBackground *background = model->background;
  CW_NEW_UNSET(model->wall, background->triangle_count);
  CW_NEW_UNSET(model->triangle, background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    model->wall[t] = cw_cad_face_is_meshed_wall(cad, background->face[t]);
  }
  CW_TRY(cw_parallel_for(model->context, "decomposition", background->triangle_count, sizeof *model->triangle, measure,
                         &(Walls){cad, options, model}, model->triangle));
done:
  return status;
}

// The places where the size field is sampled.
typedef struct {
  const CwSize *size;
  int32_t count;
  double (*x)[3], *volume, *work; // m3; predicted tetrahedra, layers or not
} Places;

static CwStatus find_work(void *context, int32_t i, void *out) {
  const Places *places = context;
  double h = cw_size_at(places->size, places->x[i]);
  *(double *)out = LATTICE * places->volume[i] / (h * h * h);
  return CW_OK;
}

// Of the cube that a sample stands for, at any side of which layers may lie: all or nothing would miss by a tenth where
// samples are coarser than layers.
static CwStatus find_work_outside_layers(void *context, int32_t i, void *out) {
  const CwPlanModel *model = context;
  double side = cbrt(model->sample[i].volume);
  CwPlanWall wall = cw_plan_wall_near(model, model->sample[i].x, model->thickest + side / 2, -1);
  double outside = fmin(fmax((wall.distance - wall.thickness) / side + 0.5, 0), 1);
  *(double *)out = outside * model->sample[i].work;
  return CW_OK;
}

static void add_sample(CwPlanModel *model, const double x[3], double volume, double work) {
  if (model->sample) model->sample[model->sample_count] = (CwPlanSample){{x[0], x[1], x[2]}, volume, work};
  model->sample_count++;
}

// The parts of a place, so many along each side of the cube that it stands for.
static void add_parts(CwPlanModel *model, const double x[3], double volume, double work, int32_t along) {
  int32_t count = along * along * along;
  double step = cbrt(volume) / along, first = -step * (along - 1) / 2;
  for (int32_t i = 0; i < count; i++) {
    double part[3] = {x[0] + first + step * (i % along), x[1] + first + step * (i / along % along),
                      x[2] + first + step * (i / along / along)};
    add_sample(model, part, volume / count, work / count);
  }
}

// Visits samples of about `even` work each: a place, some together, or parts of one; stores them where there is room.
static void visit_samples(const Places *places, double even, CwPlanModel *model) {
  double work = 0, volume = 0;
  int32_t together = 0;
  model->sample_count = 0;
  for (int32_t i = 0; i < places->count; i++) {
    int32_t along = 1; // where less than 1.5^3 is in it: no root needed
    if (places->work[i] > 3 * even) along = (int32_t)fmin(round(cbrt(places->work[i] / even)), PARTS_ALONG);
    if (along > 1) add_parts(model, places->x[i], places->volume[i], places->work[i], along);
    if (along <= 1) work += places->work[i], volume += places->volume[i], together++;
    if (together == 0 || (together < TOGETHER && work < even && i + 1 < places->count)) continue;
    add_sample(model, places->x[i - together / 2], volume, work);
    work = volume = together = 0;
  }
}

// Samples of the volume, about as many in every region to be, wherever it will lie. Collective.
static CwStatus sample_volume(const CwPlanOptions *options, CwPlanModel *model) {
  CwStatus status = CW_OK;
  Places places = {.size = model->size};
  double even = 0;
  CW_TRY(cw_size_samples(model->size, &places.count, &places.x, &places.volume));
  CW_NEW(places.work, places.count);
  CW_TRY(cw_parallel_for(model->context, "decomposition", places.count, sizeof *places.work, find_work, &places,
                         places.work));
  for (int32_t i = 0; i < places.count; i++) even += places.work[i] / SAMPLES_OF_REGION / options->region_count;
  visit_samples(&places, even, model);
  CW_NEW(model->sample, model->sample_count);
  visit_samples(&places, even, model);
  for (int32_t i = 0; i < model->sample_count; i++) {
    model->sample_spacing = fmax(model->sample_spacing, model->sample[i].volume);
  }
  model->sample_spacing = cbrt(model->sample_spacing);
done:
  free(places.x);
  free(places.volume);
  free(places.work);
  return status;
}

// Takes the layers out of the work of the samples. Collective.
static CwStatus leave_layers_out(CwPlanModel *model) {
  CwStatus status = CW_OK;
  double *outside = NULL;
  CW_NEW(outside, model->sample_count);
  CW_TRY(cw_parallel_for(model->context, "decomposition", model->sample_count, sizeof *outside,
                         find_work_outside_layers, model, outside));
  for (int32_t i = 0; i < model->sample_count; i++) model->sample[i].work = outside[i];
done:
  free(outside);
  return status;
}

CwStatus cw_plan_model_make(const CwContext *context, const CwCad *cad, const CwBackground *background,
                            const CwVerticals *inside, const CwSize *size, const CwPlanOptions *options,
                            CwPlanModel *model) {
  CwStatus status = CW_OK;
  memset(model, 0, sizeof *model);
  model->context = context;
  model->background = background;
  model->inside = inside;
  model->size = size;
  model->region_count = options->region_count;
  model->base_size = options->base_size;
  CW_TRY(measure_walls(cad, options, model));
  CW_TRY(sample_volume(options, model)); // first: the places of the size field need room for a while
  CW_TRY(sample_walls(model));
  CW_TRY(leave_layers_out(model));
  CW_TRY(sample_edges(cad, options, model));
done:
  if (status != CW_OK) cw_plan_model_free(model);
  return status;
}

void cw_plan_model_free(CwPlanModel *model) {
  free(model->sample);
  free(model->wall);
  free(model->triangle);
  free(model->edge);
  free(model->stand);
  free(model->wall_x);
  free(model->wall_triangle);
  cw_box_tree_free(&model->walls);
  memset(model, 0, sizeof *model);
}
