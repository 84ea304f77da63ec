// SPDX-License-Identifier: AGPL-3.0-or-later
// Columns beside a straight crease or a tilted constraint lean as one screened Poisson equation along the wall says:
// u - L(s)^2 u'' = 0 from what the source leans by to nothing at the end of its reach.
#include "layers_case.h"
#include "mesher/common/vec.h"
#include "mesher/layers/direction_smoothing.h"
#include "mesher/layers/layers_gap.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/policy.h"
#include "tests/draw.h"

enum { PARTS = 3000, ROWS = 40, REACH = 6 };
static const double H = 0.25 * MM, T = 1 * MM, DEPTH = 2 * MM;

// The lean at PARTS + 1 places from s = 0 to `last` of a source that leans by `first`; opening: the tangent of the lean
// of its column, or cot(alpha / 2). L is 1.5 thicknesses times the opening, which fades over the reach, at least 0.7.
static void solve_line(double t, double opening, double first, double last, double *u) {
  double ratio[PARTS + 1], step = last / PARTS; // u[i] = ratio[i] u[i + 1] + u[i] of the elimination
  ratio[0] = 0, u[0] = first;
  for (int i = 1; i < PARTS; i++) {
    double fade = fmax(0, 1 - i * step / (REACH * t)), reach = 1.5 * t * fmax(0.7, opening * fade);
    double link = reach * reach / (step * step), pivot = 1 + link * (2 - ratio[i - 1]);
    ratio[i] = link / pivot;
    u[i] = link * u[i - 1] / pivot;
  }
  u[PARTS] = 0;
  for (int i = PARTS - 1; i > 0; i--) u[i] += ratio[i] * u[i + 1];
}

typedef struct {
  Case c;
  CwLayerWork work;
  double opening, lean; // of the source; at thickness 1, along the wall away from it
} Line;

static void begin(Line *line) {
  CwBoxTree tree = {0};
  CwOutcome outcome = {0};
  Case *c = &line->c;
  assert_int_equal(case_make(c), CW_OK);
  assert_int_equal(cw_layers_topology(&c->in, &line->work), CW_OK);
  assert_int_equal(cw_layers_normals(&line->work, &outcome), CW_OK);
  assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
  assert_int_equal(cw_gap_tree_make(&line->work, &tree), CW_OK);
  cw_box_tree_free(&tree);
}

static void end(Line *line) {
  cw_smoothing_free(&line->work.smoothing);
  cw_layers_work_free(&line->work);
  case_free(&line->c);
}

static void smooth(Line *line, double t) {
  for (int32_t v = 0; v < line->work.n; v++) line->work.t[v] = t;
  assert_int_equal(cw_smooth_directions(&line->work), CW_OK);
}

// Every column has its normal thickness and leans along the wall, away from the source, by what the equation says; past
// the reach it stands upright. Returns how far the worst one is off, of the source's lean.
static double check_line(const Line *line, double t) {
  const CwLayerWork *work = &line->work;
  const double last = (floor(REACH * T / H + 1e-9) + 1) * H;
  double *u = malloc((PARTS + 1) * sizeof *u), worst = 0;
  solve_line(t, line->opening, line->lean * t, last, u);
  for (int32_t v = 0; v < work->n; v++) {
    const double *x = work->in->x[v], *column = work->column[v], s = hypot(x[0], x[2]);
    if (s < 1e-9) continue;
    const double away[3] = {x[0] / s, 0, x[2] / s};
    assert_near(cw_layers_least_cosine(work, v, column), 1, 1e-12);
    assert_near(column[1], 0, 1e-9);
    double leans = cw_dot(column, away), wanted = s < last ? u[(int)lround(s / last * PARTS)] / t : 0;
    if (s > last - 1e-9) assert_near(leans, 0, 1e-12);
    worst = fmax(worst, fabs(leans - wanted) / fabs(line->lean));
  }
  free(u);
  return worst;
}

// Two walls of 10 mm at an angle alpha, the fluid between them.
static void crease(Line *line, double alpha) {
  const double c = ROWS * H * cos(alpha / 2), s = ROWS * H * sin(alpha / 2), p[3][2] = {{c, s}, {0, 0}, {c, -s}};
  line->c = (Case){.target = T, .constraint = case_end_planes, .constraint_context = &DEPTH};
  line->opening = line->lean = 1 / tan(alpha / 2);
  surface_extrude(&line->c.wall, 3, p, 0, DEPTH, H, 1);
  begin(line);
}

static void beside_a_crease(void **state) {
  uint64_t seed = 3;
  for (int i = 0; i < 8; i++) {
    const double alpha = (60 + 90 * draw(&seed)) * M_PI / 180;
    Line line = {0};
    crease(&line, alpha);
    for (int32_t v = 0; v < line.work.n; v++) { // all in reach are set
      const double s = hypot(line.work.in->x[v][0], line.work.in->x[v][2]);
      if (s > 1e-9 && s < REACH * T) line.work.column[v][0] = NAN;
    }
    smooth(&line, T);
    double worst = check_line(&line, T);
    print_message("  %5.1f degrees: %.4f off\n", alpha * 180 / M_PI, worst);
    assert_true(worst < 0.02);
    for (int32_t v = 0; v < line.work.n; v++) { // the crease's own columns halve the angle
      if (hypot(line.work.in->x[v][0], line.work.in->x[v][2]) > 1e-9) continue;
      const double wanted[3] = {1 / sin(alpha / 2), 0, 0};
      for (int k = 0; k < 3; k++) assert_near(line.work.column[v][k], wanted[k], 1e-9);
    }
    end(&line);
  }
}

// Walls that bend away from one another by 10 degrees, here and there: columns that lean keep their thickness over both
// faces of a bend.
static void beside_a_crease_of_bent_walls(void **state) {
  for (int side = -1; side <= 1; side += 2) {
    double p[9][2] = {{0}};
    int32_t leaning = 0;
    Line line = {.c = {.target = T, .constraint = case_end_planes, .constraint_context = &DEPTH}};
    for (int i = 1; i <= 4; i++) {
      double angle = (40 + side * 10 * (i - 1)) * M_PI / 180;
      for (int end = -1; end <= 1; end += 2) {
        p[4 - end * i][0] = p[4 - end * (i - 1)][0] + 4 * H * cos(angle);
        p[4 - end * i][1] = p[4 - end * (i - 1)][1] + end * 4 * H * sin(angle);
      }
    }
    surface_extrude(&line.c.wall, 9, (const double(*)[2])p, 0, DEPTH, H, 1);
    begin(&line);
    smooth(&line, T);
    for (int32_t v = 0; v < line.work.n; v++) {
      double upright[3];
      cw_layers_upright(&line.work, v, upright);
      assert_near(cw_layers_least_cosine(&line.work, v, line.work.column[v]), 1, 1e-9);
      leaning += cw_distance(upright, line.work.column[v]) > 0.02;
    }
    assert_true(leaning > line.work.n / 2);
    end(&line);
  }
}

// The same wall smoothed again as it is stays bit for bit; of thinner columns the solution is that of their thickness,
// within what was reached at first; a column alone that gets thinner changes nothing out of its reach.
static void smoothed_again(void **state) {
  Line line = {0};
  crease(&line, 80 * M_PI / 180);
  smooth(&line, T);
  size_t size = (size_t)line.work.n * sizeof *line.work.column;
  double(*before)[3] = malloc(size);
  memcpy(before, line.work.column, size);
  smooth(&line, T);
  assert_memory_equal(before, line.work.column, size);
  smooth(&line, 0.6 * T);
  assert_true(check_line(&line, 0.6 * T) < 0.02);
  smooth(&line, T);
  assert_true(check_line(&line, T) < 0.02);
  memcpy(before, line.work.column, size);
  int32_t thin = -1, far = 0, moved = 0;
  for (int32_t v = 0; v < line.work.n; v++) {
    if (line.work.in->x[v][2] > 0 && fabs(hypot(line.work.in->x[v][0], line.work.in->x[v][2]) - 2 * H) < 1e-9) thin = v;
  }
  line.work.t[thin] = 0.5 * T;
  assert_int_equal(cw_smooth_directions(&line.work), CW_OK);
  for (int32_t v = 0; v < line.work.n; v++) {
    int same = !memcmp(before[v], line.work.column[v], sizeof *before);
    moved += !same;
    if (line.work.in->x[v][2] > -3 * T) continue; // over on the other wall
    far++;
    assert_true(same);
  }
  assert_true(far > 0 && moved > 0);
  free(before);
  end(&line);
}

static int end_and_tilted_plane(const void *context, const double x[3], double normal[2][3]) {
  double tilt = *(const double *)context;
  int count = 0;
  if (x[0] < 1e-9) normal[count][0] = cos(tilt), normal[count][1] = 0, normal[count++][2] = -sin(tilt);
  if (x[1] < 1e-9 || x[1] > DEPTH - 1e-9) normal[count][0] = 0, normal[count][1] = 1, normal[count++][2] = 0;
  return count;
}

// A plate that ends at x = 0 on a plane which leans over it, or away from it, by `tilt`.
static void plate(Line *line, const double *tilt) {
  const double p[2][2] = {{0, 0}, {ROWS * H, 0}};
  line->c = (Case){.target = T, .constraint = end_and_tilted_plane, .constraint_context = tilt};
  line->lean = tan(*tilt);
  line->opening = fabs(line->lean);
  surface_extrude(&line->c.wall, 2, p, 0, DEPTH, H, 1);
  begin(line);
}

static void beside_a_tilted_plane(void **state) {
  uint64_t seed = 5;
  for (int i = 0; i < 8; i++) {
    const double tilt = (i % 2 ? 1 : -1) * (11 + 40 * draw(&seed)) * M_PI / 180;
    Line line = {0};
    plate(&line, &tilt);
    smooth(&line, T);
    double worst = check_line(&line, T);
    print_message("  %5.1f degrees: %.4f off\n", tilt * 180 / M_PI, worst);
    assert_true(worst < 0.02);
    for (int32_t v = 0; v < line.work.n; v++) {
      if (line.work.in->x[v][0] > 1e-9) continue;
      assert_near(line.work.column[v][0], tan(tilt), 1e-9);
      assert_near(line.work.column[v][2], 1, 1e-9);
    }
    end(&line);
  }
}

// A plane that leans by less than the cosine of 0.985 tilts no other column.
static void a_plane_that_hardly_leans(void **state) {
  for (int i = 0; i < 2; i++) {
    const double tilt = acos(i ? 0.984 : 0.986);
    int32_t tilted = 0;
    Line line = {0};
    plate(&line, &tilt);
    smooth(&line, T);
    for (int32_t v = 0; v < line.work.n; v++) tilted += line.work.in->x[v][0] > 1e-9 && line.work.column[v][0] != 0;
    assert_true(i ? tilted > 0 : tilted == 0);
    end(&line);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(beside_a_crease),
      cmocka_unit_test(beside_a_crease_of_bent_walls),
      cmocka_unit_test(smoothed_again),
      cmocka_unit_test(beside_a_tilted_plane),
      cmocka_unit_test(a_plane_that_hardly_leans),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
