// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan_score.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/vec.h"

enum {
  DIRECTIONS = 60,       // planes parallel to the axis, every 3 degrees
  SHARES = 13,           // positions tried for each direction, by share of the work
  STATIONS = 24,         // positions of planes across the axis, by place
  EDGE_POINTS = 40,      // samples along each CAD edge
  LINE_SAMPLES = 200,
  RUN_SAMPLES = 12,
  SAMPLES_WANTED = 40000
};
static const double FIRST_SHARE = 0.2, LAST_SHARE = 0.8;
static const double SMOOTH_COSINE = 0.98; // between the faces of an edge that is no feature
// Room that planes keep, in thicknesses of the layers there: beside an edge its columns and those of the plane's cut
// want a cell between them; beside a smooth edge only the surface triangles do. Lines of two planes start behind the layers.
static const double EDGE_ROOM = 2, SMOOTH_ROOM = 0.5, ROOM = 1.5;
static const double ALONG_EDGE = 0.35;     // sine of the least angle between a plane and a CAD edge that it crosses
static const double SHARP_PLANE = 0.7;     // least plane-to-wall measure of a plane that is not penalised

static void triangle_normal(const CwBackground *background, int32_t t, double normal[3], double *area) {
  const double *a = background->x[background->triangle[t][0]], *b = background->x[background->triangle[t][1]],
               *c = background->x[background->triangle[t][2]];
  double u[3], v[3];
  for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
  for (int k = 0; k < 3; k++) normal[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
  double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  for (int k = 0; k < 3; k++) normal[k] /= length > 0 ? length : 1;
  *area = length / 2;
}

void cw_pieces_free(CwPieces *pieces) {
  free(pieces->start);
  free(pieces->triangle);
  free(pieces->corner);
  memset(pieces, 0, sizeof *pieces);
}

CwStatus cw_pieces_from_background(const CwBackground *background, CwPieces *pieces) {
  CwStatus status = CW_OK;
  pieces->count = background->triangle_count;
  CW_NEW(pieces->start, pieces->count + 1);
  CW_NEW(pieces->triangle, pieces->count);
  CW_NEW(pieces->corner, 3 * (size_t)pieces->count);
  for (int32_t t = 0; t < pieces->count; t++) {
    pieces->start[t] = 3 * t;
    pieces->triangle[t] = t;
    for (int k = 0; k < 3; k++) {
      memcpy(pieces->corner[3 * t + k], background->x[background->triangle[t][k]], sizeof(double[3]));
    }
  }
  pieces->start[pieces->count] = 3 * pieces->count;
done:
  return status;
}

CwStatus cw_pieces_clip(const CwPieces *pieces, const CwPlane *plane, CwPieces *kept) {
  CwStatus status = CW_OK;
  CW_NEW(kept->start, pieces->count + 1);
  CW_NEW(kept->triangle, pieces->count);
  // A plane adds at most one corner to a convex piece.
  CW_NEW(kept->corner, (size_t)pieces->start[pieces->count] + (size_t)pieces->count);
  int32_t used = 0;
  for (int32_t i = 0; i < pieces->count; i++) {
    int32_t first = pieces->start[i], corners = pieces->start[i + 1] - first;
    double clipped[CW_CLIP_MAX][3];
    CW_REQUIRE(corners < CW_CLIP_MAX, CW_ERR_MESH, "a surface triangle was cut into more than %d corners",
               CW_CLIP_MAX);
    int left = cw_clip_polygon(plane, corners, (const double(*)[3])(pieces->corner + first), clipped);
    if (left == 0) continue;
    kept->start[kept->count] = used;
    kept->triangle[kept->count++] = pieces->triangle[i];
    memcpy(kept->corner + used, clipped, (size_t)left * sizeof clipped[0]);
    used += left;
  }
  kept->start[kept->count] = used;
done:
  return status;
}

static double polygon_area(int32_t corners, const double (*corner)[3]) {
  double sum[3] = {0, 0, 0};
  for (int32_t i = 2; i < corners; i++) {
    double u[3], v[3];
    for (int k = 0; k < 3; k++) u[k] = corner[i - 1][k] - corner[0][k], v[k] = corner[i][k] - corner[0][k];
    for (int k = 0; k < 3; k++) sum[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
  }
  return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / 2;
}

// True where the two faces of a CAD edge pass into one another: no feature, only a border of parameters.
static int is_smooth(const CwCad *cad, int edge) {
  int face[2];
  double range[2], normal[2][3];
  cw_cad_edge_range(cad, edge, range);
  cw_cad_edge_faces(cad, edge, face);
  for (int s = 0; s < 2; s++) {
    double uv[2], x[3], xu[3], xv[3];
    cw_cad_edge_uv(cad, edge, face[s], (range[0] + range[1]) / 2, uv);
    cw_cad_face_point(cad, face[s], uv, x, xu, xv);
    cw_cross(xu, xv, normal[s]);
    cw_unit(normal[s]);
    if (cw_cad_face_reversed(cad, face[s])) {
      for (int k = 0; k < 3; k++) normal[s][k] = -normal[s][k];
    }
  }
  return cw_dot(normal[0], normal[1]) > SMOOTH_COSINE;
}

// Keeps every n-th sample, which then stands for n times its volume: planes need no finer picture.
static void thin_samples(CwPlanScorer *scorer) {
  int32_t stride = scorer->sample_count / SAMPLES_WANTED + 1, kept = 0;
  for (int32_t i = 0; i < scorer->sample_count; i += stride) {
    cw_copy(scorer->sample_x[i], scorer->sample_x[kept]);
    scorer->sample_volume[kept++] = stride * scorer->sample_volume[i];
  }
  scorer->sample_count = kept;
}

CwStatus cw_plan_scorer_make(const CwCad *cad, const CwBackground *background, const CwInside *inside,
                             const CwSize *size, const CwPlanOptions *options, CwPlanScorer *scorer) {
  CwStatus status = CW_OK;
  memset(scorer, 0, sizeof *scorer);
  scorer->cad = cad;
  scorer->background = background;
  scorer->inside = inside;
  scorer->options = options;
  CW_TRY(cw_size_samples(size, &scorer->sample_count, &scorer->sample_x, &scorer->sample_volume));
  thin_samples(scorer);
  CW_NEW(scorer->sample_work, scorer->sample_count);
  for (int32_t i = 0; i < scorer->sample_count; i++) {
    double h = cw_size_at(size, scorer->sample_x[i]);
    scorer->sample_work[i] = options->tet_factor * scorer->sample_volume[i] / (h * h * h);
    scorer->spacing = fmax(scorer->spacing, cbrt(scorer->sample_volume[i]));
  }
  CW_NEW(scorer->density, background->triangle_count);
  CW_NEW(scorer->normal, background->triangle_count);
  CW_NEW(scorer->centre, background->triangle_count);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    double area, centre[3] = {0, 0, 0};
    triangle_normal(background, t, scorer->normal[t], &area);
    for (int k = 0; k < 9; k++) centre[k % 3] += background->x[background->triangle[t][k / 3]][k % 3] / 3;
    cw_copy(centre, scorer->centre[t]);
    int patch = cw_cad_face_patch(cad, background->face[t]);
    double h = cw_size_at(size, centre);
    if (cw_cad_patch_kind(cad, patch) == CW_PATCH_WALL) scorer->density[t] = options->prism_factor / (h * h);
  }
  CW_NEW(scorer->edge_x, (size_t)cw_cad_edge_count(cad) * EDGE_POINTS);
  CW_NEW(scorer->edge_t, (size_t)cw_cad_edge_count(cad) * EDGE_POINTS);
  CW_NEW(scorer->edge_room, (size_t)cw_cad_edge_count(cad) * EDGE_POINTS);
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    double range[2], room = 0;
    int faces[2];
    cw_cad_edge_range(cad, e, range);
    cw_cad_edge_faces(cad, e, faces);
    for (int side = 0; side < 2; side++) room = fmax(room, options->thickness[cw_cad_face_patch(cad, faces[side])]);
    room *= is_smooth(cad, e) ? SMOOTH_ROOM : EDGE_ROOM;
    for (int i = 0; i < EDGE_POINTS; i++) {
      double t = range[0] + (range[1] - range[0]) * i / (EDGE_POINTS - 1), *tangent = scorer->edge_t[scorer->edge_point_count];
      cw_cad_edge_point(cad, e, t, scorer->edge_x[scorer->edge_point_count], tangent);
      double length = sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1] + tangent[2] * tangent[2]);
      for (int k = 0; k < 3; k++) tangent[k] /= length > 0 ? length : 1;
      scorer->edge_room[scorer->edge_point_count++] = room;
    }
  }
done:
  if (status != CW_OK) cw_plan_scorer_free(scorer);
  return status;
}

void cw_plan_scorer_free(CwPlanScorer *scorer) {
  free(scorer->sample_x);
  free(scorer->sample_volume);
  free(scorer->sample_work);
  free(scorer->density);
  free(scorer->normal);
  free(scorer->centre);
  free(scorer->edge_x);
  free(scorer->edge_t);
  free(scorer->edge_room);
  memset(scorer, 0, sizeof *scorer);
}

double cw_plan_work(const CwPlanScorer *scorer, const CwPieces *pieces, int32_t sample_count, const int32_t *sample) {
  double work = 0;
  for (int32_t i = 0; i < sample_count; i++) work += scorer->sample_work[sample[i]];
  for (int32_t i = 0; i < pieces->count; i++) {
    int32_t first = pieces->start[i];
    work += scorer->density[pieces->triangle[i]] *
            polygon_area(pieces->start[i + 1] - first, (const double(*)[3])(pieces->corner + first));
  }
  return work;
}

// One weighted place along a direction.
typedef struct {
  double place, work;
} Mark;

static int compare_marks(const void *a, const void *b) {
  const Mark *p = a, *q = b;
  return (p->place > q->place) - (p->place < q->place);
}

// Marks of all work along `direction`, sorted by place; *total their sum.
static void mark_work(const CwPlanScorer *scorer, const CwPieces *pieces, int32_t sample_count, const int32_t *sample,
                      const double direction[3], Mark *mark, double *total) {
  int32_t count = 0;
  CwPlane plane = {{direction[0], direction[1], direction[2]}, 0};
  for (int32_t i = 0; i < sample_count; i++) {
    mark[count++] = (Mark){cw_plane_distance(&plane, scorer->sample_x[sample[i]]), scorer->sample_work[sample[i]]};
  }
  for (int32_t i = 0; i < pieces->count; i++) {
    int32_t first = pieces->start[i], corners = pieces->start[i + 1] - first;
    double work = scorer->density[pieces->triangle[i]] *
                  polygon_area(corners, (const double(*)[3])(pieces->corner + first));
    mark[count++] = (Mark){cw_plane_distance(&plane, pieces->corner[first]), work};
  }
  qsort(mark, (size_t)count, sizeof *mark, compare_marks);
  *total = 0;
  for (int32_t i = 0; i < count; i++) *total += mark[i].work;
}

// Share of the work below `place`.
static double share_below(const Mark *mark, int32_t count, double total, double place) {
  double work = 0;
  for (int32_t i = 0; i < count && mark[i].place <= place; i++) work += mark[i].work;
  return work / total;
}

static double place_of_share(const Mark *mark, int32_t count, double total, double share) {
  double work = 0;
  for (int32_t i = 0; i < count; i++) {
    work += mark[i].work;
    if (work >= share * total) return mark[i].place;
  }
  return mark[count - 1].place;
}

// Least sqrt(1 - (n.m)^2) over the wall pieces that the plane crosses: 1 where it stands normal to all of them.
static double plane_to_wall(const CwPlanScorer *scorer, const CwPieces *pieces, const CwPlane *plane) {
  double worst = 1;
  for (int32_t i = 0; i < pieces->count; i++) {
    int32_t t = pieces->triangle[i];
    if (scorer->density[t] == 0) continue;
    int below = 0, above = 0;
    for (int32_t c = pieces->start[i]; c < pieces->start[i + 1]; c++) {
      if (cw_plane_distance(plane, pieces->corner[c]) > 0) {
        above = 1;
      } else {
        below = 1;
      }
    }
    if (!below || !above) continue;
    const double *n = plane->normal, *m = scorer->normal[t];
    double dot = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
    worst = fmin(worst, sqrt(fmax(0, 1 - dot * dot)));
  }
  return worst;
}

// How many points of CAD edges in the cell the plane runs along or grazes.
static int32_t grazed_edges(const CwPlanScorer *scorer, const CwPlan *plan, int32_t node, const CwPlane *plane) {
  int32_t count = 0;
  for (int32_t i = 0; i < scorer->edge_point_count; i++) {
    double clearance = scorer->edge_room[i];
    double distance = fabs(cw_plane_distance(plane, scorer->edge_x[i]));
    if (distance > clearance) continue;
    const double *n = plane->normal, *t = scorer->edge_t[i];
    int along = fabs(n[0] * t[0] + n[1] * t[1] + n[2] * t[2]) < ALONG_EDGE;
    int at_vertex = i % EDGE_POINTS == 0 || i % EDGE_POINTS == EDGE_POINTS - 1;
    if (!along && !at_vertex) continue;
    if (cw_plan_in_cell(plan, node, scorer->edge_x[i], clearance, NULL, 0)) count++;
  }
  return count;
}

// Thickness of the layers on the surface nearest to x, m; 0 on a cap. *distance (may be NULL): to that surface.
static double thickness_near(const CwPlanScorer *scorer, const double x[3], double *distance_out) {
  double best = INFINITY;
  int32_t nearest = 0;
  for (int32_t t = 0; t < scorer->background->triangle_count; t++) {
    double distance = cw_distance(scorer->centre[t], x);
    if (distance < best) best = distance, nearest = t;
  }
  if (distance_out) *distance_out = best;
  return scorer->options->thickness[cw_cad_face_patch(scorer->cad, scorer->background->face[nearest])];
}

static int near_an_edge(const CwPlanScorer *scorer, const double x[3]) {
  for (int32_t e = 0; e < scorer->edge_point_count; e++) {
    if (cw_distance(scorer->edge_x[e], x) < scorer->edge_room[e]) return 1;
  }
  return 0;
}

// True where another plane (not `above`) comes within `room` of x inside its own cell.
static int near_a_plane(const CwPlan *plan, int32_t node, int32_t above, const double x[3], double room) {
  for (int32_t c = 0; c < node; c++) {
    if (c != above && fabs(cw_plane_distance(&plan->node[c].plane, x)) < room &&
        cw_plan_in_cell(plan, c, x, room, NULL, 0)) {
      return 1;
    }
  }
  return 0;
}

// True where the line runs inside or beside the layers of a wall between its ends, `taken` m of which are theirs.
static int runs_in_layers(const CwPlanScorer *scorer, const double start[3], const double direction[3], double run,
                          double taken) {
  for (int i = 0; i < RUN_SAMPLES; i++) {
    double s = run * (i + 0.5) / RUN_SAMPLES, x[3], distance;
    if (s < ROOM * taken || s > run - ROOM * taken) continue;
    for (int k = 0; k < 3; k++) x[k] = start[k] + s * direction[k];
    double thickness = thickness_near(scorer, x, &distance);
    if (distance < ROOM * thickness) return 1;
  }
  return 0;
}

// How the lines of the new plane with its ancestors fare: 0 fine; 1 cramped: a line leaves the domain too near to a CAD
// edge, is hardly longer than the layers at its ends, meets a third plane within them, or runs along a wall in its layers; 2: a line runs along a third
// plane, so that two lines coincide on one interface.
static int judge_lines(const CwPlanScorer *scorer, const CwPlan *plan, int32_t node, const CwPlane *plane,
                       double reach) {
  int verdict = 0;
  for (int32_t a = plan->node[node].parent; a >= 0; a = plan->node[a].parent) {
    double point[3], direction[3], step = 2 * reach / (LINE_SAMPLES - 1);
    if (!cw_plane_line(&plan->node[a].plane, plane, point, direction)) continue;
    double run = 0, along = 0, taken = 0; // lengths: inside so far, of that beside a third plane, of layers
    double start[3];
    for (int i = 0; i < LINE_SAMPLES; i++) {
      double x[3], s = step * i - reach;
      for (int k = 0; k < 3; k++) x[k] = point[k] + s * direction[k];
      int inside = cw_plan_in_cell(plan, node, x, 1e-9, NULL, 0) && cw_inside_test(scorer->inside, x);
      if (inside && run == 0) {
        taken = thickness_near(scorer, x, NULL);
        cw_copy(x, start);
        if (near_an_edge(scorer, x)) verdict = 1;
        if (near_a_plane(plan, node, a, x, ROOM * taken)) verdict = 1;
      }
      if (inside) {
        run += step;
        along += near_a_plane(plan, node, a, x, step) ? step : 0;
      } else if (run > 0) {
        double before[3];
        for (int k = 0; k < 3; k++) before[k] = x[k] - step * direction[k];
        double end = thickness_near(scorer, before, NULL);
        taken += end;
        if (near_an_edge(scorer, before) || near_a_plane(plan, node, a, before, ROOM * end)) verdict = 1;
        if (run < ROOM * taken || runs_in_layers(scorer, start, direction, run, fmax(taken - end, end))) verdict = 1;
        if (along > 0.3 * run && along > 4 * step) return 2;
        run = along = 0;
      }
    }
  }
  return verdict;
}

// Area of the interface, from the samples in a slab about the plane, m2.
static double interface_area(const CwPlanScorer *scorer, int32_t sample_count, const int32_t *sample,
                             const CwPlane *plane) {
  double volume = 0, half = 1.5 * scorer->spacing;
  for (int32_t i = 0; i < sample_count; i++) {
    if (fabs(cw_plane_distance(plane, scorer->sample_x[sample[i]])) < half) volume += scorer->sample_volume[sample[i]];
  }
  return volume / (2 * half);
}

// The planes to try along one direction: by shares of the work; through the axis; across the axis also by place.
static int32_t positions(const Mark *mark, int32_t marks, double total, int across, double *offset) {
  int32_t count = 0;
  for (int s = 0; s < SHARES; s++) {
    offset[count++] =
        place_of_share(mark, marks, total, FIRST_SHARE + (LAST_SHARE - FIRST_SHARE) * s / (SHARES - 1));
  }
  if (!across) offset[count++] = 0; // holds the axis: normal to hub and shroud
  for (int i = 1; across && i < STATIONS; i++) {
    offset[count++] = mark[0].place + (mark[marks - 1].place - mark[0].place) * i / STATIONS;
  }
  return count;
}

CwStatus cw_plan_best_plane(const CwPlanScorer *scorer, const CwPlan *plan, int32_t node, const CwPieces *pieces,
                            int32_t sample_count, const int32_t *sample, int32_t regions, CwPlane *best,
                            int32_t *first, double *worst_angle) {
  CwStatus status = CW_OK;
  Mark *mark = NULL;
  int32_t marks = sample_count + pieces->count;
  double least_score = INFINITY, volume = 0, reach = 0;
  CW_NEW(mark, marks);
  for (int32_t i = 0; i < sample_count; i++) {
    volume += scorer->sample_volume[sample[i]];
    reach = fmax(reach, cw_norm(scorer->sample_x[sample[i]]));
  }
  double area_scale = pow(volume, 2.0 / 3);
  for (int d = 0; d <= DIRECTIONS; d++) {
    // A small odd turn keeps the fan of planes off the symmetry planes of the CAD.
    double angle = M_PI * (d + 0.37) / DIRECTIONS, total, offset[SHARES + STATIONS];
    double direction[3] = {cos(angle), sin(angle), 0};
    if (d == DIRECTIONS) direction[0] = direction[1] = 0, direction[2] = 1;
    mark_work(scorer, pieces, sample_count, sample, direction, mark, &total);
    int32_t count = positions(mark, marks, total, d == DIRECTIONS, offset);
    for (int32_t i = 0; i < count; i++) {
      CwPlane plane = {{direction[0], direction[1], direction[2]}, offset[i]};
      double below = share_below(mark, marks, total, plane.offset);
      // Either side gets as many regions as its share of the work is worth.
      int32_t below_regions = (int32_t)floor(below * regions + 0.5);
      if (below_regions < 1 || below_regions >= regions) continue;
      double balance = fmax(below * regions / below_regions, (1 - below) * regions / (regions - below_regions)) - 1;
      double score = 2 * balance + 0.5 * fabs(2.0 * below_regions / regions - 1);
      if (score >= least_score) continue;
      double worst = plane_to_wall(scorer, pieces, &plane);
      score += 0.5 * interface_area(scorer, sample_count, sample, &plane) / area_scale + (1 - worst) +
               (worst < SHARP_PLANE ? 2 : 0);
      if (score >= least_score) continue;
      int32_t grazed = grazed_edges(scorer, plan, node, &plane);
      score += grazed ? 3 + 0.02 * grazed : 0;
      if (score >= least_score) continue;
      int lines = judge_lines(scorer, plan, node, &plane, reach);
      score += lines ? 4 : 0;
      if (score >= least_score || lines == 2) continue;
      least_score = score;
      *best = plane;
      *first = below_regions;
      *worst_angle = worst;
    }
  }
  CW_REQUIRE(least_score < INFINITY, CW_ERR_MESH,
             "no plane divides what is left of the domain at node %d of the plan; ask for fewer regions "
             "(mesh: cells_per_region)", node);
done:
  free(mark);
  return status;
}

int32_t cw_plan_grazed_edges(const CwPlanScorer *scorer, const CwPlan *plan, int32_t node, const CwPlane *plane) {
  return grazed_edges(scorer, plan, node, plane);
}

int cw_plan_judge_lines(const CwPlanScorer *scorer, const CwPlan *plan, int32_t node, const CwPlane *plane,
                        double reach) {
  return judge_lines(scorer, plan, node, plane, reach);
}
