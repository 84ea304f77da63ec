// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_lines.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/cad/rays.h"
#include "mesher/cad/symmetry.h"
#include "mesher/common/vec.h"
#include "mesher/plan/plan_cost.h"
#include "mesher/policy.h"

enum { LINE_SAMPLES_LEAST = 8, LINE_SAMPLES_MOST = 400, HITS_MOST = 64 };
static const double LINE_STEP = 0.5; // base sizes between samples of a line
static const double SAME_LINE = 1;   // edge length between two lines on one interface: nearer than that they are one
static const double NEIGHBOUR_REACH = 5; // base sizes: planes farther from a line do not matter to it
static const double SAME_POINT = 1e-9;   // of the model's unit

typedef struct {
  int impossible;
  double cramped; // sum over the lines of the squares of their shortage of room
  double sharp;   // least sine of the angle between the planes along a line in the domain; 1 without lines
  double cosine;  // least of a line to a wall's normal; 1 without lines
} Lines;

// A plane that comes near a line, as so many turns make it: within the wedges of a sector decomposition planes have
// periodic images.
typedef struct {
  CwPlane plane;
  int32_t node, turns;
} Neighbour;

// A line of the new plane and one that bounds its cell, as far as it lies in the cell.
typedef struct {
  const CwPlanModel *model;
  const CwPlan *plan;
  const CwPlane *plane;
  int32_t node, above;
  double point[3], direction[3], from, to, most; // most: cost at which no more is asked
  int32_t neighbour_count, neighbour_capacity;
  Neighbour *neighbour;
} Line;

static void at(const Line *line, double s, double x[3]) {
  for (int k = 0; k < 3; k++) x[k] = line->point[k] + s * line->direction[k];
}

// Cuts the line to where plane . x <= 0 on the given side.
static void cut(Line *line, const CwPlane *plane, int positive) {
  double distance = cw_plane_distance(plane, line->point), slope = cw_dot(plane->normal, line->direction);
  if (positive) distance = -distance, slope = -slope;
  if (fabs(slope) < 1e-12) {
    if (distance > 0) line->to = line->from;
  } else if (slope > 0) {
    line->to = fmin(line->to, -distance / slope);
  } else {
    line->from = fmax(line->from, -distance / slope);
  }
}

// Cuts the line to the box of the part and to the cell of the node.
static void cut_to_cell(Line *line, const CwPlanPart *part) {
  line->from = -INFINITY;
  line->to = INFINITY;
  for (int k = 0; k < 3; k++) {
    CwPlane side = {{k == 0, k == 1, k == 2}, part->box.high[k] + 2 * line->model->sample_spacing};
    cut(line, &side, 0);
    side.offset = part->box.low[k] - 2 * line->model->sample_spacing;
    cut(line, &side, 1);
  }
  const CwPlan *plan = line->plan;
  if (cw_sector_holds(plan, line->node)) {
    CwPlane end = cw_sector_end(plan, line->node);
    cut(line, &end, 1);
  }
  for (CwPlanBound b = cw_plan_bound(plan, line->node); b.node >= 0; b = cw_plan_next_bound(plan, b)) {
    if (b.node != line->above) cut(line, &plan->node[b.node].plane, b.positive);
  }
}

// Collects the planes, not those of the line nor those below, that come within `room` of it; of the new plane its
// periodic images.
static CwStatus find_neighbours(Line *line, double room) {
  CwStatus status = CW_OK;
  const CwPlan *plan = line->plan;
  const int32_t node = line->node;
  double ends[2][3];
  at(line, line->from, ends[0]);
  at(line, line->to, ends[1]);
  line->neighbour_count = 0;
  for (int32_t c = 0; c < plan->node_count || c <= node; c++) {
    int in_wedge = plan->sector_turns && c >= plan->sector_first + plan->sector_count;
    for (int32_t turns = c == node; turns < (in_wedge ? plan->sector_turns : 1); turns++) {
      Neighbour made = {c == node ? *line->plane : plan->node[c].plane, c, turns};
      if (c == line->above) continue;
      if (turns) cw_symmetry_turn(plan->sector_turns, turns, made.plane.normal, made.plane.normal);
      double a = cw_plane_distance(&made.plane, ends[0]), b = cw_plane_distance(&made.plane, ends[1]);
      if ((a > room && b > room) || (a < -room && b < -room)) continue;
      if (c > node && cw_plan_is_ancestor(plan, node, c)) continue; // its own lines are judged from there
      CW_GROW(line->neighbour, line->neighbour_capacity, line->neighbour_count + 1);
      line->neighbour[line->neighbour_count++] = made;
    }
  }
done:
  return status;
}

// Whether x lies in the cell of a neighbour, or as near to it as `off`, where turns have not moved it.
static int in_its_cell(const Line *line, const Neighbour *near, const double x[3], double off) {
  double back[3];
  cw_copy(x, back);
  if (near->turns) cw_symmetry_turn(line->plan->sector_turns, line->plan->sector_turns - near->turns, x, back);
  return cw_plan_in_cell(line->plan, near->node, back, off, NULL, 0);
}

// Distance from x to the nearest other plane inside its own cell; `room` where none is nearer.
static double plane_near(const Line *line, const double x[3], double room) {
  double best = room;
  for (int32_t i = 0; i < line->neighbour_count; i++) {
    const Neighbour *near = &line->neighbour[i];
    double distance = fabs(cw_plane_distance(&near->plane, x));
    if (distance < best && in_its_cell(line, near, x, room)) best = distance;
  }
  return best;
}

// 0 where there is all the room that is wanted, 1 where there is no more than the least.
static double shortage(double room, double least, double wanted) {
  return fmin(fmax((wanted - room) / (wanted - least), 0), 1);
}

// Points at which a run of the line is looked at.
static int samples_along(const Line *line, double run) {
  return (int)fmin(fmax(ceil(run / (LINE_STEP * line->model->base_size)), LINE_SAMPLES_LEAST), LINE_SAMPLES_MOST);
}

static double cost_of(const Lines *lines) {
  return lines->impossible ? INFINITY : lines->cramped + cw_plan_sharpness(lines->sharp);
}

// Whether so much more shortage makes the lines cost as much as is asked.
static int is_enough(const Line *line, const Lines *lines, double cramped) {
  return cost_of(lines) + cramped * cramped >= line->most;
}

static void add_cramped(double cramped, Lines *lines) {
  lines->cramped += cramped * cramped;
}

static double near_an_edge(const Line *line, const CwPlanPart *part, const double x[3]) {
  const CwPlanModel *model = line->model;
  double worst = 0;
  for (int32_t i = 0; i < part->edge_count; i++) {
    int32_t e = part->edge[i];
    double room = model->edge[e].room, distance = cw_distance(model->edge[e].x, x);
    if (distance < room) worst = fmax(worst, shortage(distance, room / 2, room));
  }
  return worst;
}

// Where other planes cross the line, in their own cells, a piece of a line ends: not within the layers.
static double judge_crossings(const Line *line, double from, double to, Lines *lines) {
  double a[3], b[3], x[3], worst = 0;
  at(line, from - SAME_POINT, a);
  at(line, to + SAME_POINT, b);
  for (int32_t i = 0; i < line->neighbour_count && !lines->impossible; i++) {
    const Neighbour *near = &line->neighbour[i];
    double before = cw_plane_distance(&near->plane, a), after = cw_plane_distance(&near->plane, b);
    if ((before > 0) == (after > 0)) continue;
    cw_lerp(a, b, before / (before - after), x);
    if (!in_its_cell(line, near, x, 2 * SAME_POINT)) continue;
    CwPlanWall wall = cw_plan_wall_near(line->model, x, cw_policy.plan_room * line->model->thickest, -1);
    if (wall.thickness > 0)
      worst = fmax(worst, shortage(wall.distance, wall.thickness, cw_policy.plan_room * wall.thickness));
    if (wall.distance < wall.thickness) lines->impossible = 1;
  }
  return worst;
}

// An end of a run of the line through the domain.
typedef struct {
  double place;     // along the line, m
  int32_t triangle; // of the background through which it leaves; -1: at a plane that bounds the cell
  double layers;    // what they take of the run, m
  double cosine;    // between the line and the wall's normal
} End;

static double judge_end(const Line *line, const CwPlanPart *part, End *end, Lines *lines) {
  const CwPlanModel *model = line->model;
  double x[3];
  if (end->triangle < 0) return 0; // left to the crossings
  at(line, end->place, x);
  double thickness = model->triangle[end->triangle].thickness, cramped = near_an_edge(line, part, x);
  // Columns keep the height normal to the wall, but for those that lean too much.
  end->cosine = fabs(cw_dot(line->direction, model->triangle[end->triangle].normal));
  end->layers = thickness / fmax(end->cosine, cw_policy.upright_cosine);
  if (thickness == 0) return cramped;
  lines->cosine = fmin(lines->cosine, end->cosine);
  if (end->cosine < cw_policy.column_least_cosine) lines->impossible = 1;
  cramped = fmax(cramped, shortage(end->cosine, cw_policy.column_least_cosine, cw_policy.upright_cosine));
  return fmax(cramped, shortage(plane_near(line, x, cw_policy.plan_room * thickness), thickness / 2,
                                cw_policy.plan_room * thickness));
}

// Whether the line comes to the wall of this triangle at the end, and the place is beside that.
static int is_at_end(const Line *line, const End *end, double place, int32_t triangle) {
  const CwPlanModel *model = line->model;
  if (end->triangle < 0 || fabs(place - end->place) > 2 * cw_policy.plan_room * end->layers) return 0;
  return cw_dot(model->triangle[end->triangle].normal, model->triangle[triangle].normal) >= cw_policy.crease_cosine;
}

// A run of the line through the domain.
static void judge_run(const Line *line, const CwPlanPart *part, End *from, End *to, Lines *lines) {
  const CwPlanModel *model = line->model;
  double run = to->place - from->place;
  double cramped = judge_end(line, part, from, lines);
  cramped = fmax(cramped, judge_end(line, part, to, lines));
  double taken = from->layers + to->layers;
  if (run < taken) lines->impossible = 1;
  if (lines->impossible) return;
  cramped = fmax(cramped, judge_crossings(line, from->place, to->place, lines));
  if (taken > 0) cramped = fmax(cramped, shortage(run, taken, cw_policy.plan_room * taken));
  int samples = samples_along(line, run), beside = 0;
  double step = run / samples;
  CwPlanWall wall = {.point = -1};
  for (int i = 0; i < samples && !is_enough(line, lines, cramped); i++) {
    double x[3], s = from->place + step * (i + 0.5);
    at(line, s, x);
    double h = cw_size_at(model->size, x), near = plane_near(line, x, cw_policy.plan_room * h);
    beside += near < SAME_LINE * h;
    cramped = fmax(cramped, shortage(near, SAME_LINE * h, cw_policy.plan_room * h));
    if (s - from->place < from->layers || to->place - s < to->layers) continue;
    wall = cw_plan_wall_near(model, x, cw_policy.plan_room * model->thickest, wall.point);
    if (wall.thickness == 0) continue;
    if (is_at_end(line, from, s, wall.triangle) || is_at_end(line, to, s, wall.triangle)) continue;
    cramped = fmax(cramped, shortage(wall.distance, wall.thickness, cw_policy.plan_room * wall.thickness));
    if (wall.distance < wall.thickness) lines->impossible = 1;
  }
  if (beside == samples) lines->impossible = 1;
  add_cramped(cramped, lines);
}

// Whether both planes of the line cross the edge at one of its points, and do not run along it.
static int both_cross(const Line *line, int32_t e) {
  return cw_plan_along_edge(line->model, e, line->plane->normal) == 0 &&
         cw_plan_along_edge(line->model, e, line->plan->node[line->above].plane.normal) == 0;
}

// A stretch of the line outside the domain. Where it passes close by, the planes cut the boundary side by side, and
// between their cuts there is less room the nearer it is: to edges that both cross, and to walls that it runs along.
static double judge_outside(const Line *line, const CwPlanPart *part, double from, double to) {
  const CwPlanModel *model = line->model;
  double run = to - from, cramped = 0;
  for (int32_t i = 0; i < part->edge_count; i++) {
    int32_t e = part->edge[i];
    double x[3], d[3], h = model->edge[e].touch / cw_policy.boundary_distance;
    if (model->edge[e].room == 0 || !both_cross(line, e)) continue;
    cw_sub(model->edge[e].x, line->point, d);
    at(line, fmin(fmax(cw_dot(d, line->direction), from), to), x);
    double least = fmax(model->edge[e].room / cw_policy.plan_room, SAME_LINE * h);
    cramped = fmax(cramped, shortage(cw_distance(model->edge[e].x, x), least, cw_policy.plan_room * least));
  }
  int samples = samples_along(line, run);
  CwPlanWall wall = {.point = -1};
  for (int i = 0; i < samples && cramped < 1; i++) {
    double x[3];
    at(line, from + run * (i + 0.5) / samples, x);
    double h = cw_size_at(model->size, x);
    wall = cw_plan_wall_near(model, x, cw_policy.plan_room * h, wall.point);
    if (wall.triangle < 0) continue;
    if (fabs(cw_dot(line->direction, model->triangle[wall.triangle].normal)) > cw_policy.column_least_cosine) continue;
    cramped = fmax(cramped, shortage(wall.distance, SAME_LINE * h, cw_policy.plan_room * h));
  }
  return cramped;
}

static CwStatus judge_line(Line *line, const CwPlanPart *part, double sine, Lines *lines) {
  CwStatus status = CW_OK;
  cut_to_cell(line, part);
  if (!(line->to > line->from)) return CW_OK;
  CwRayHit hit[HITS_MOST];
  int32_t hits =
      cw_rays_hits(line->model->background->rays, line->point, line->direction, line->from, line->to, HITS_MOST, hit);
  if (hits == HITS_MOST) lines->impossible = 1; // there may be more of them
  int found = 0;
  double outside = 0;
  End from = {line->from, -1, 0, 0};
  for (int32_t i = 0; i <= hits && !is_enough(line, lines, outside); i++) {
    End to = {line->to, -1, 0, 0};
    double x[3];
    if (i < hits) to.place = hit[i].place, to.triangle = hit[i].triangle;
    at(line, (from.place + to.place) / 2, x);
    int is_stretch = to.place - from.place > SAME_POINT;
    int inside = is_stretch && cw_verticals_inside(line->model->inside, x);
    if (is_stretch && !inside) outside = fmax(outside, judge_outside(line, part, from.place, to.place));
    if (inside) {
      if (!found) CW_TRY(find_neighbours(line, NEIGHBOUR_REACH * line->model->base_size));
      found = 1;
      lines->sharp = fmin(lines->sharp, sine);
      judge_run(line, part, &from, &to, lines);
    }
    from = to;
  }
  add_cramped(outside, lines);
done:
  free(line->neighbour);
  return status;
}

// Whether parallel planes, one of them perhaps turned round, leave a region between them.
static int room_between(const CwPlanModel *model, const CwPlane *a, const CwPlane *b) {
  double apart = cw_dot(a->normal, b->normal) > 0 ? b->offset - a->offset : b->offset + a->offset;
  return fabs(apart) > 2 * model->sample_spacing;
}

CwStatus cw_plan_lines(const CwPlanModel *model, const CwPlan *plan, int32_t node, const CwPlanPart *part,
                       const CwPlane *plane, double most, CwPlanLines *found) {
  CwStatus status = CW_OK;
  Lines lines = {.sharp = 1, .cosine = 1};
  CwPlanBound bound = cw_plan_bound(plan, node);
  for (; bound.node >= 0 && cost_of(&lines) < most; bound = cw_plan_next_bound(plan, bound)) {
    const CwPlane *other = &plan->node[bound.node].plane;
    Line line = {.model = model, .plan = plan, .plane = plane, .node = node, .above = bound.node, .most = most};
    double across[3];
    if (!cw_plane_line(other, plane, line.point, line.direction)) {
      lines.impossible = !room_between(model, other, plane);
      continue;
    }
    cw_cross(other->normal, plane->normal, across);
    CW_TRY(judge_line(&line, part, cw_norm(across), &lines));
  }
  *found = (CwPlanLines){cost_of(&lines), lines.cosine};
done:
  return status;
}
