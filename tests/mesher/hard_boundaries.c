// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hard_boundaries.h"

#include <stdio.h>

#include "mesher/fill_shape.h"
#include "mesher/predicates.h"
#include "mesher/quality.h"

static const double PI = 3.141592653589793;

double constant_size(const void *length, const double x[3]) {
  return *(const double *)length;
}

CwFillInput fill_input(const Surface *surface, const double *size) {
  return (CwFillInput){.point_count = surface->point_count,
                       .x = (const double(*)[3])surface->x,
                       .triangle_count = surface->triangle_count,
                       .triangle = (const int32_t(*)[3])surface->triangle,
                       .size = constant_size,
                       .size_context = size,
                       .name = "rotor region 3"};
}

static double draw(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

static int draw_below(uint64_t *state, int below) {
  return (int)(draw(state) * below);
}

static void box(Surface *s, double lx, double ly, double lz, double hx, double hy, double hz, int nx, int ny, int nz,
                int outward) {
  surface_add_box(s, (double[3]){lx, ly, lz}, (double[3]){hx, hy, hz}, (int[3]){nx, ny, nz}, outward);
}

static void ball(Surface *s, double x, double y, double z, double radius, int level, int outward) {
  surface_add_sphere(s, (double[3]){x, y, z}, radius, level, outward);
}

static int32_t new_point(Surface *s, double x, double y, double z) {
  return surface_point(s, (double[3]){x, y, z}, s->point_count);
}

// A tube of `rows` points round a curve of `columns` points; closed on itself or with a fan over each end.
typedef void (*Curve)(const void *context, double u, double x[3], double *radius);

static void curve_frame(Curve curve, const void *context, double u, double t[3]) {
  double a[3], b[3], radius, length = 0.0;
  curve(context, u - 1e-5, a, &radius);
  curve(context, u + 1e-5, b, &radius);
  for (int i = 0; i < 3; i++)
    length += (b[i] - a[i]) * (b[i] - a[i]);
  for (int i = 0; i < 3; i++)
    t[i] = (b[i] - a[i]) / sqrt(length);
}

static void add_tube(Surface *s, Curve curve, const void *context, int rows, int columns, int closed, double shift,
                     int outward) {
  int32_t base = s->point_count;
  int stations = closed ? columns : columns + 1;
  double v[3] = {0, 0, 0}, first[3], last_turn = 0.0;
  for (int pass = 0; pass < (closed ? 2 : 1); pass++) { // the first to see how far the frame turns in all
    for (int c = 0; c < stations + (pass == 0 && closed); c++) {
      double x[3], t[3], w[3], radius, dot = 0.0, length = 0.0;
      curve(context, (double)c / columns, x, &radius);
      curve_frame(curve, context, (double)c / columns, t);
      if (c == 0) {
        int least = fabs(t[0]) < fabs(t[1]) ? (fabs(t[0]) < fabs(t[2]) ? 0 : 2) : (fabs(t[1]) < fabs(t[2]) ? 1 : 2);
        memset(v, 0, sizeof v);
        v[least] = 1.0;
      }
      for (int i = 0; i < 3; i++)
        dot += v[i] * t[i];
      for (int i = 0; i < 3; i++) {
        v[i] -= dot * t[i];
        length += v[i] * v[i];
      }
      for (int i = 0; i < 3; i++)
        v[i] /= sqrt(length);
      for (int i = 0; i < 3; i++)
        w[i] = t[(i + 1) % 3] * v[(i + 2) % 3] - t[(i + 2) % 3] * v[(i + 1) % 3];
      if (c == 0)
        memcpy(first, v, sizeof first);
      if (c == stations && pass == 0) {
        double along = 0.0, across = 0.0;
        for (int i = 0; i < 3; i++) {
          along += v[i] * first[i];
          across += w[i] * first[i];
        }
        last_turn = atan2(across, along);
        continue;
      }
      if (closed && pass == 0)
        continue;
      for (int r = 0; r < rows; r++) {
        double a = 2.0 * PI * (r + shift * c) / rows + last_turn * c / columns;
        new_point(s, x[0] + radius * (cos(a) * v[0] + sin(a) * w[0]), x[1] + radius * (cos(a) * v[1] + sin(a) * w[1]),
                  x[2] + radius * (cos(a) * v[2] + sin(a) * w[2]));
      }
    }
  }
  for (int c = 0; c < columns; c++) {
    for (int r = 0; r < rows; r++) {
      int turn = 0; // rows by which a closed, shifted tube meets itself later
      if (closed && c + 1 == columns)
        turn = (int)floor(shift * columns + 0.5);
      int32_t a = base + c * rows + r, b = base + c * rows + (r + 1) % rows, next = base + (c + 1) % stations * rows;
      int32_t d = next + (r + turn) % rows, e = next + (r + 1 + turn) % rows;
      surface_triangle(s, a, b, e, outward);
      surface_triangle(s, a, e, d, outward);
    }
  }
  for (int end = 0; end < 2 && !closed; end++) {
    double x[3], radius;
    curve(context, end, x, &radius);
    int32_t middle = new_point(s, x[0], x[1], x[2]), ring = base + end * columns * rows;
    for (int r = 0; r < rows; r++)
      surface_triangle(s, ring + r, middle, ring + (r + 1) % rows, end ? !outward : outward);
  }
}

typedef struct {
  double centre[3], great, small, tilt;
} Ring;

static void ring_curve(const void *context, double u, double x[3], double *radius) {
  const Ring *r = context;
  double a = 2.0 * PI * u, y = r->great * sin(a);
  x[0] = r->centre[0] + r->great * cos(a);
  x[1] = r->centre[1] + cos(r->tilt) * y;
  x[2] = r->centre[2] + sin(r->tilt) * y;
  *radius = r->small;
}

static void torus(Surface *s, double x, double y, double z, double great, double small, double tilt, int rows,
                  int columns, int outward) {
  add_tube(s, ring_curve, &(Ring){{x, y, z}, great, small, tilt}, rows, columns, 1, 0.0, outward);
}

static void straight_curve(const void *context, double u, double x[3], double *radius) {
  const double *p = context; // length, radius at the ends and in the middle
  x[0] = x[1] = 0.0;
  x[2] = p[0] * u;
  *radius = p[2] + (p[1] - p[2]) * fabs(2.0 * u - 1.0);
}

static void helix_curve(const void *context, double u, double x[3], double *radius) {
  const double *p = context; // turns, great radius, pitch, small radius
  x[0] = p[1] * cos(2.0 * PI * p[0] * u);
  x[1] = p[1] * sin(2.0 * PI * p[0] * u);
  x[2] = p[2] * p[0] * u;
  *radius = p[3];
}

static void knot_curve(const void *context, double u, double x[3], double *radius) {
  double a = 2.0 * PI * u;
  x[0] = 0.01 * (sin(a) + 2.0 * sin(2.0 * a));
  x[1] = 0.01 * (cos(a) - 2.0 * cos(2.0 * a));
  x[2] = -0.01 * sin(3.0 * a);
  *radius = *(const double *)context;
}

static double area(const double *a, const double *b, const double *c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Triangles of a simple polygon by its ears, the roundest first; counter-clockwise. Gives n - 2.
static int cut_ears(int n, const double (*p)[2], int (*triangle)[3]) {
  int *left = malloc((size_t)n * sizeof *left), count = 0;
  for (int k = 0; k < n; k++)
    left[k] = k;
  for (; n >= 3; n--) {
    int best = -1;
    double most = 0.0;
    for (int k = 0; k < n; k++) {
      int at[3] = {left[(k + n - 1) % n], left[k], left[(k + 1) % n]};
      const double *a = p[at[0]], *b = p[at[1]], *c = p[at[2]];
      double twice = area(a, b, c), square = 0.0;
      for (int i = 0; i < 2; i++)
        square += (b[i] - a[i]) * (b[i] - a[i]) + (c[i] - b[i]) * (c[i] - b[i]) + (a[i] - c[i]) * (a[i] - c[i]);
      if (twice < 1e-9 * square || twice / square <= most)
        continue;
      int holds = 0;
      for (int m = 0; m < n && !holds; m++) {
        const double *q = p[left[m]];
        holds = left[m] != at[0] && left[m] != at[1] && left[m] != at[2] && area(a, b, q) >= -1e-9 * square &&
                area(b, c, q) >= -1e-9 * square && area(c, a, q) >= -1e-9 * square;
      }
      if (holds)
        continue;
      best = k;
      most = twice / square;
    }
    if (best < 0)
      break;
    int *t = triangle[count++];
    t[0] = left[(best + n - 1) % n], t[1] = left[best], t[2] = left[(best + 1) % n];
    memmove(left + best, left + best + 1, (size_t)(n - 1 - best) * sizeof *left);
  }
  free(left);
  return count;
}

// A counter-clockwise polygon, each edge cut into pieces of at most `edge`, extruded along z in `layers` and
// turned by `twist` from end to end.
static void extrude(Surface *s, int corners, const double (*corner)[2], double edge, double height, int layers,
                    double twist, int outward) {
  double(*p)[2] = malloc(4000 * sizeof *p);
  int(*triangle)[3] = malloc(4000 * sizeof *triangle), n = 0;
  for (int k = 0; k < corners; k++) {
    const double *a = corner[k], *b = corner[(k + 1) % corners];
    int pieces = (int)ceil(hypot(b[0] - a[0], b[1] - a[1]) / edge - 1e-9);
    if (pieces < 1)
      pieces = 1;
    for (int i = 0; i < pieces; i++, n++) {
      p[n][0] = a[0] + (b[0] - a[0]) * i / pieces;
      p[n][1] = a[1] + (b[1] - a[1]) * i / pieces;
    }
  }
  int32_t base = s->point_count;
  for (int l = 0; l <= layers; l++) {
    double c = cos(twist * l / layers), d = sin(twist * l / layers);
    for (int k = 0; k < n; k++)
      new_point(s, c * p[k][0] - d * p[k][1], d * p[k][0] + c * p[k][1], height * l / layers);
  }
  for (int l = 0; l < layers; l++) {
    for (int k = 0; k < n; k++) {
      int32_t a = base + l * n + k, b = base + l * n + (k + 1) % n;
      surface_triangle(s, a, b, b + n, outward);
      surface_triangle(s, a, b + n, a + n, outward);
    }
  }
  int count = cut_ears(n, (const double(*)[2])p, triangle);
  for (int t = 0; t < count; t++) {
    const int *q = triangle[t];
    surface_triangle(s, base + q[0], base + q[1], base + q[2], !outward);
    int32_t top = base + layers * n;
    surface_triangle(s, top + q[0], top + q[1], top + q[2], outward);
  }
  free(p);
  free(triangle);
}

static void wedge(Surface *s, double degrees, double edge) {
  double a = degrees * PI / 180.0, p[3][2] = {{0, 0}, {0.04, 0}, {0.04 * cos(a), 0.04 * sin(a)}};
  extrude(s, 3, (const double(*)[2])p, edge, 0.03, (int)ceil(0.03 / edge), 0.0, 1);
}

static int32_t triangle_with(const Surface *s, int32_t a, int32_t b, int *third) {
  for (int32_t t = 0; t < s->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      if (s->triangle[t][k] != a || s->triangle[t][(k + 1) % 3] != b)
        continue;
      *third = (k + 2) % 3;
      return t;
    }
  }
  return -1;
}

int turn_diagonals(Surface *s, uint64_t seed, int one_in) {
  uint8_t *done = calloc((size_t)s->triangle_count, 1);
  int turned = 0, at, unused;
  for (int32_t t = 0; t < s->triangle_count; t++) {
    if (draw_below(&seed, one_in) || done[t])
      continue;
    int32_t a = s->triangle[t][0], b = s->triangle[t][1], c = s->triangle[t][2], o = triangle_with(s, b, a, &at);
    if (o < 0 || done[o])
      continue;
    int32_t d = s->triangle[o][at];
    if (c == d || triangle_with(s, c, d, &unused) >= 0 || triangle_with(s, d, c, &unused) >= 0)
      continue;
    done[t] = done[o] = 1;
    const int32_t one[3] = {a, d, c}, two[3] = {d, b, c};
    memcpy(s->triangle[t], one, sizeof one);
    memcpy(s->triangle[o], two, sizeof two);
    turned++;
  }
  free(done);
  return turned;
}

// Cuts the longest edges of the triangles that are longer than `least + growth * distance from the place`, and their
// neighbours', until none is.
static void refine(Surface *s, const double place[3], double least, double growth, int limit) {
  const double p[3] = {place[0], place[1], place[2]}; // it may be a point of the surface, which moves in memory
  for (int again = 1; again && s->triangle_count < limit;) {
    again = 0;
    for (int32_t t = 0; t < s->triangle_count && s->triangle_count < limit; t++) {
      for (;;) { // to the neighbour with the longer edge, until one edge is the longest of both
        int at = 0, third;
        double most = 0.0, far = INFINITY;
        for (int k = 0; k < 3; k++) {
          const double *a = s->x[s->triangle[t][k]], *b = s->x[s->triangle[t][(k + 1) % 3]];
          double length = hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
          if (length > most) {
            most = length;
            at = k;
          }
          far = fmin(far, hypot(hypot(p[0] - a[0], p[1] - a[1]), p[2] - a[2]));
        }
        if (most <= least + growth * far)
          break;
        int32_t a = s->triangle[t][at], b = s->triangle[t][(at + 1) % 3], c = s->triangle[t][(at + 2) % 3];
        int32_t o = triangle_with(s, b, a, &third), d = s->triangle[o][third];
        double m[3];
        for (int i = 0; i < 3; i++)
          m[i] = 0.5 * (s->x[a][i] + s->x[b][i]);
        int32_t n = new_point(s, m[0], m[1], m[2]);
        const int32_t one[3] = {a, n, c}, two[3] = {b, n, d};
        memcpy(s->triangle[t], one, sizeof one);
        memcpy(s->triangle[o], two, sizeof two);
        surface_triangle(s, n, b, c, 1);
        surface_triangle(s, n, a, d, 1);
        again = 1;
      }
    }
  }
}

static void scale(Surface *s, double x, double y, double z) {
  for (int32_t p = 0; p < s->point_count; p++)
    s->x[p][0] *= x, s->x[p][1] *= y, s->x[p][2] *= z;
}

static void turn(Surface *s, double a, double b) {
  for (int32_t p = 0; p < s->point_count; p++) {
    double x = s->x[p][0], y = s->x[p][1], z = s->x[p][2];
    s->x[p][0] = cos(a) * x - sin(a) * y;
    y = sin(a) * x + cos(a) * y;
    s->x[p][1] = cos(b) * y - sin(b) * z;
    s->x[p][2] = sin(b) * y + cos(b) * z;
  }
}

static void cube(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 8, 8, 8, 1);
  *size = 0.005;
}

static void cube_of_twelve_triangles(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 1, 1, 1, 1);
  *size = 0.04;
}

static void turned_cube_with_turned_diagonals(Surface *s, double *size) {
  cube(s, size);
  turn_diagonals(s, 3, 3);
  turn(s, 0.7, 0.4);
}

static void fine_surface_coarse_inside(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 12, 12, 12, 1);
  *size = 0.02;
}

static void coarse_surface_fine_inside(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 2, 2, 2, 1);
  *size = 0.004;
}

static void cylinder(Surface *s, double *size) {
  add_tube(s, straight_curve, (double[3]){0.04, 0.01, 0.01}, 24, 16, 0, 0.0, 1);
  *size = 0.0026;
}

static void cylinder_of_long_quads(Surface *s, double *size) {
  add_tube(s, straight_curve, (double[3]){0.08, 0.01, 0.01}, 48, 3, 0, 0.0, 1);
  *size = 0.003;
}

static void cylinder_of_flat_quads(Surface *s, double *size) {
  add_tube(s, straight_curve, (double[3]){0.02, 0.01, 0.01}, 6, 60, 0, 0.0, 1);
  *size = 0.003;
}

static void twisted_cylinder(Surface *s, double *size) {
  add_tube(s, straight_curve, (double[3]){0.04, 0.01, 0.01}, 12, 16, 0, 0.9, 1);
  *size = 0.004;
}

static void hourglass(Surface *s, double *size) {
  add_tube(s, straight_curve, (double[3]){0.04, 0.01, 0.0002}, 16, 40, 0, 0.0, 1);
  *size = 0.002;
}

static void thin_gap(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 8, 8, 8, 1);
  box(s, 0.01, 0.01, 0.0001, 0.03, 0.03, 0.03, 4, 4, 4, 0);
  *size = 0.005;
}

static void thin_gap_all_round(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 6, 6, 6, 1);
  box(s, 0.0004, 0.0004, 0.0004, 0.0396, 0.0396, 0.0396, 7, 7, 7, 0);
  *size = 0.006;
}

static void nearly_touching_spheres(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.02, 3, 1);
  ball(s, 0.04001, 0, 0, 0.02, 2, 1);
  *size = 0.004;
}

static void nearly_touching_voids(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.05, 3, 1);
  ball(s, -0.0151, 0, 0, 0.015, 2, 0);
  ball(s, 0.0151, 0.0003, 0, 0.015, 2, 0);
  *size = 0.008;
}

static void void_near_the_wall(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.05, 3, 1);
  ball(s, 0, 0, 0.0095, 0.04, 3, 0);
  *size = 0.008;
}

static void wedge_30(Surface *s, double *size) {
  wedge(s, 30, *size = 0.004);
}

static void wedge_15(Surface *s, double *size) {
  wedge(s, 15, *size = 0.004);
}

static void wedge_10(Surface *s, double *size) {
  wedge(s, 10, *size = 0.004);
}

static void wedge_5(Surface *s, double *size) {
  wedge(s, 5, *size = 0.004);
}

static void wedge_1(Surface *s, double *size) {
  wedge(s, 1, *size = 0.004);
}

static void void_wedge_5(Surface *s, double *size) { // a cut as sharp into the body
  const double a = 5 * PI / 180.0;
  double q[7][2] = {{0, 0}, {0.04 * cos(a), 0.04 * sin(a)}, {0.04, 0.02}, {-0.02, 0.02}, {-0.02, -0.02}, {0.04, -0.02},
                    {0.04, 0}};
  extrude(s, 7, (const double(*)[2])q, *size = 0.005, 0.02, 4, 0.0, 1);
}

static void needle(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.001, 2, 1);
  scale(s, 1, 1, 50);
  *size = 0.001;
}

static void needle_of_a_cone(Surface *s, double *size) {
  int n = 20;
  int32_t tip = new_point(s, 0, 0, 0.1), foot = new_point(s, 0, 0, 0), first = s->point_count;
  for (int k = 0; k < n; k++)
    new_point(s, 0.002 * cos(2 * PI * k / n), 0.002 * sin(2 * PI * k / n), 0);
  for (int k = 0; k < n; k++) {
    surface_triangle(s, first + k, first + (k + 1) % n, tip, 1);
    surface_triangle(s, first + (k + 1) % n, first + k, foot, 1);
  }
  *size = 0.001;
}

static void spikes(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.01, 2, 1);
  for (int32_t p = 0; p < s->point_count; p += 5) {
    for (int i = 0; i < 3; i++)
      s->x[p][i] *= 5.0;
  }
  *size = 0.003;
}

static void dents(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.01, 2, 1);
  for (int32_t p = 0; p < s->point_count; p += 5) {
    for (int i = 0; i < 3; i++)
      s->x[p][i] *= 0.05;
  }
  *size = 0.003;
}

static void one_void(Surface *s, double *size) {
  box(s, -0.02, -0.02, -0.02, 0.02, 0.02, 0.02, 6, 6, 6, 1);
  ball(s, 0.001, 0, 0, 0.012, 2, 0);
  *size = 0.006;
}

static void many_voids(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 6, 6, 6, 1);
  for (int k = 0; k < 27; k++)
    ball(s, 0.01 + 0.01 * (k % 3), 0.01 + 0.01 * (k / 3 % 3), 0.01 + 0.01 * (k / 9), 0.0045, 1, 0);
  *size = 0.006;
}

static void five_shells(Surface *s, double *size) {
  for (int k = 0; k < 5; k++)
    ball(s, 0.0004 * k, 0, 0, 0.05 - 0.008 * k, k < 3 ? 3 : 2, k % 2 == 0);
  *size = 0.01;
}

static void one_torus(Surface *s, double *size) {
  torus(s, 0, 0, 0, 0.03, 0.008, 0.0, 12, 40, 1);
  *size = 0.004;
}

static void thin_torus(Surface *s, double *size) {
  torus(s, 0, 0, 0, 0.03, 0.001, 0.3, 5, 60, 1);
  *size = 0.002;
}

static void linked_torus_voids(Surface *s, double *size) {
  box(s, -0.05, -0.05, -0.05, 0.08, 0.05, 0.05, 10, 8, 8, 1);
  torus(s, 0, 0, 0, 0.03, 0.008, 0.0, 10, 30, 0);
  torus(s, 0.03, 0, 0, 0.03, 0.008, PI / 2, 10, 30, 0);
  *size = 0.012;
}

static void linked_tori(Surface *s, double *size) {
  torus(s, 0, 0, 0, 0.03, 0.008, 0.0, 10, 30, 1);
  torus(s, 0.03, 0, 0, 0.03, 0.008, PI / 2, 10, 30, 1);
  *size = 0.005;
}

static void torus_in_a_torus(Surface *s, double *size) {
  torus(s, 0, 0, 0, 0.03, 0.008, 0.0, 12, 36, 1);
  torus(s, 0, 0, 0, 0.03, 0.006, 0.0, 10, 30, 0);
  *size = 0.004;
}

static void slab(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.0001, 16, 16, 1, 1);
  *size = 0.0025;
}

static void slab_of_turned_diagonals(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.0005, 16, 16, 1, 1);
  turn_diagonals(s, 9, 2);
  *size = 0.0025;
}

static void foil(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04e-4, 12, 12, 1, 1);
  *size = 0.003;
}

static void bent_slab(Surface *s, double *size) {
  box(s, 0, 0, 0, 1, 1, 1, 40, 8, 1, 1);
  for (int32_t p = 0; p < s->point_count; p++) {
    double a = 5.0 * s->x[p][0], r = 0.03 + 0.0002 * s->x[p][2], y = s->x[p][1];
    s->x[p][0] = r * sin(a), s->x[p][1] = 0.02 * y, s->x[p][2] = r * cos(a); // (along, y, out) stays right-handed
  }
  *size = 0.003;
}

static void sizes_varying_by_50(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 4, 4, 4, 1);
  refine(s, (double[3]){0.04, 0.017, 0.04}, 0.0002, 0.35, 6000);
  *size = 0.01;
}

static void sphere_with_a_fine_spot(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.04, 1, 1);
  refine(s, s->x[7], 0.0003, 0.5, 6000);
  *size = 0.01;
}

static void thin_box_with_a_fine_spot(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.04, 0.04, 0.002, 2, 2, 1, 1);
  refine(s, (double[3]){0.013, 0.017, 0.002}, 0.0001, 0.5, 6000);
  *size = 0.01;
}

// A prism of n sides of which the upper polygon is turned, so that the sides bend inwards.
static void twisted_prism(Surface *s, int n, double degrees, double height) {
  for (int k = 0; k < 2 * n; k++) {
    double a = 2.0 * PI * (k % n) / n + (k < n ? 0.0 : degrees * PI / 180.0);
    new_point(s, 0.01 * cos(a), 0.01 * sin(a), k < n ? 0.0 : height);
  }
  for (int k = 0; k < n; k++) {
    int32_t a = k, b = (k + 1) % n;
    surface_triangle(s, a, b, a + n, 1);
    surface_triangle(s, b, b + n, a + n, 1);
    if (k > 0 && k < n - 1) {
      surface_triangle(s, 0, b, a, 1);
      surface_triangle(s, n, n + a, n + b, 1);
    }
  }
}

static void schoenhardt(Surface *s, double *size) {
  twisted_prism(s, 3, 30, *size = 0.01);
}

static void schoenhardt_nearly_closed(Surface *s, double *size) {
  twisted_prism(s, 3, 55, *size = 0.01);
}

static void schoenhardt_flat(Surface *s, double *size) {
  twisted_prism(s, 3, 40, 0.0005);
  *size = 0.01;
}

static void twisted_prism_of_8_sides(Surface *s, double *size) {
  twisted_prism(s, 8, 40, 0.02);
  *size = 0.01;
}

static void twisted_prism_of_30_sides(Surface *s, double *size) {
  twisted_prism(s, 30, 100, 0.02);
  *size = 0.01;
}

static void column_of_schoenhardts(Surface *s, double *size) {
  const double p[3][2] = {{0.01, 0}, {-0.005, 0.00866}, {-0.005, -0.00866}};
  extrude(s, 3, p, 1.0, 0.08, 8, -8 * 35 * PI / 180.0, 1); // against the diagonals: every side bends inwards
  *size = 0.01;
}

static void schoenhardt_void(Surface *s, double *size) {
  twisted_prism(s, 3, 30, *size = 0.01);
  for (int32_t t = 0; t < s->triangle_count; t++) {
    int32_t swap = s->triangle[t][0];
    s->triangle[t][0] = s->triangle[t][1];
    s->triangle[t][1] = swap;
  }
  box(s, -0.011, -0.011, -0.001, 0.011, 0.011, 0.011, 1, 1, 1, 1);
}

// Notches from below along y and from above along x, whose ridges nearly meet on the saddle z = x y
// (B. Chazelle, SIAM J. Comput. 13, 1984).
static void chazelle(Surface *s, double *size) {
  enum { N = 4 };
  const double width = 0.1, near = 0.02, m = N + 1, deep = -6.0, high = m * m + 6.0;
  int32_t low[2][3 * N + 2], top[2][3 * N + 2];
  for (int end = 0; end < 2; end++) {
    for (int k = 0; k < 3 * N + 2; k++) {
      int i = (k + 2) / 3, ridge = k > 0 && k < 3 * N + 1 && k % 3 == 2;
      double across = k == 0 ? 0 : k == 3 * N + 1 ? m : i + (k % 3 == 1 ? -width : k % 3 == 0 ? width : 0);
      if (k > 0 && k < 3 * N + 1 && k % 3 == 0)
        across = k / 3 + width;
      if (ridge)
        across = (k + 1) / 3;
      double along = end ? m : 0, z = across * along;
      low[end][k] = new_point(s, across, along, ridge ? z - near : deep);
      top[end][k] = new_point(s, along, across, ridge ? z + near : high);
    }
  }
  for (int k = 0; k < 3 * N + 1; k++) {
    surface_triangle(s, low[0][k], low[1][k], low[1][k + 1], 1);
    surface_triangle(s, low[0][k], low[1][k + 1], low[0][k + 1], 1);
    surface_triangle(s, top[0][k], top[1][k], top[1][k + 1], 1);
    surface_triangle(s, top[0][k], top[1][k + 1], top[0][k + 1], 1);
  }
  // Walls: two with the zigzag below and a straight edge above, two the other way.
  for (int end = 0; end < 2; end++) {
    double p[3 * N + 4][2];
    int triangle[3 * N + 4][3];
    int32_t at[2][3 * N + 4];
    int n = 3 * N + 2;
    for (int k = 0; k < n; k++) {
      p[k][0] = s->x[low[end][k]][0];
      p[k][1] = s->x[low[end][k]][2];
      at[0][k] = low[end][k];
    }
    at[0][n] = top[1][end ? n - 1 : 0];
    at[0][n + 1] = top[0][end ? n - 1 : 0];
    for (int k = n; k < n + 2; k++) {
      p[k][0] = s->x[at[0][k]][0];
      p[k][1] = s->x[at[0][k]][2];
    }
    int count = cut_ears(n + 2, (const double(*)[2])p, triangle);
    for (int t = 0; t < count; t++)
      surface_triangle(s, at[0][triangle[t][0]], at[0][triangle[t][1]], at[0][triangle[t][2]], end == 0);
    for (int k = 0; k < n; k++) { // turned over, to be counter-clockwise too
      at[1][k] = top[end][n - 1 - k];
      p[k][0] = s->x[at[1][k]][1];
      p[k][1] = s->x[at[1][k]][2];
    }
    at[1][n] = low[0][end ? n - 1 : 0];
    at[1][n + 1] = low[1][end ? n - 1 : 0];
    for (int k = n; k < n + 2; k++) {
      p[k][0] = s->x[at[1][k]][1];
      p[k][1] = s->x[at[1][k]][2];
    }
    count = cut_ears(n + 2, (const double(*)[2])p, triangle);
    for (int t = 0; t < count; t++)
      surface_triangle(s, at[1][triangle[t][0]], at[1][triangle[t][1]], at[1][triangle[t][2]], end == 1);
  }
  scale(s, 0.01, 0.01, 0.002);
  *size = 0.01;
}

static void spiral(Surface *s, double *size) {
  double p[122][2];
  for (int k = 0; k < 122; k++) {
    int i = k < 61 ? k : 121 - k;
    double a = 6.0 * PI * i / 60.0, r = 0.005 + 0.0015 * a + (k < 61 ? 0.004 : 0.0);
    p[k][0] = r * cos(a), p[k][1] = r * sin(a);
  }
  extrude(s, 122, (const double(*)[2])p, 0.006, 0.02, 4, 0.0, 1);
  *size = 0.005;
}

static void re_entrant(Surface *s, double *size) {
  const double p[6][2] = {{0, 0}, {0.04, 0}, {0.04, 0.01}, {0.01, 0.01}, {0.01, 0.04}, {0, 0.04}};
  extrude(s, 6, p, *size = 0.005, 0.02, 4, 0.0, 1);
}

static void coarse_re_entrant(Surface *s, double *size) {
  const double p[6][2] = {{0, 0}, {0.04, 0}, {0.04, 0.001}, {0.001, 0.001}, {0.001, 0.04}, {0, 0.04}};
  extrude(s, 6, p, 0.04, 0.04, 1, 0.0, 1);
  *size = 0.02;
}

static void comb_of(Surface *s, int teeth, double share, double edge, double height, int layers, double twist) {
  double p[200][2];
  int n = 0;
  const double pitch = 0.004, deep = 0.02;
  p[n][0] = 0, p[n++][1] = -0.004;
  p[n][0] = teeth * pitch, p[n++][1] = -0.004;
  for (int k = teeth - 1; k >= 0; k--) {
    double low = (k + 0.5 - 0.5 * share) * pitch, high = (k + 0.5 + 0.5 * share) * pitch;
    const double q[4][2] = {{high, 0}, {high, deep}, {low, deep}, {low, 0}};
    memcpy(p + n, q, sizeof q);
    n += 4;
  }
  p[n][0] = 0, p[n++][1] = 0;
  double q[201][2];
  memcpy(q, p, 2 * sizeof *p);
  q[2][0] = teeth * pitch, q[2][1] = 0;
  memcpy(q + 3, p + 2, (size_t)(n - 2) * sizeof *p);
  extrude(s, n + 1, (const double(*)[2])q, edge, height, layers, twist, 1);
}

static void comb(Surface *s, double *size) {
  comb_of(s, 8, 0.5, *size = 0.004, 0.012, 3, 0.0);
}

static void comb_of_thin_teeth(Surface *s, double *size) {
  comb_of(s, 8, 0.05, *size = 0.004, 0.012, 3, 0.0);
}

static void comb_of_thin_slots(Surface *s, double *size) {
  comb_of(s, 8, 0.97, *size = 0.004, 0.012, 3, 0.0);
}

static void comb_without_points(Surface *s, double *size) {
  comb_of(s, 8, 0.9, 1.0, 0.03, 1, 0.0);
  *size = 0.01;
}

static void star_of(Surface *s, int arms, double inner, double edge, double height, int layers, double twist) {
  double p[200][2];
  for (int k = 0; k < 2 * arms; k++) {
    double a = PI * k / arms, r = k % 2 ? inner : 0.02;
    p[k][0] = r * cos(a), p[k][1] = r * sin(a);
  }
  extrude(s, 2 * arms, (const double(*)[2])p, edge, height, layers, twist, 1);
}

static void star(Surface *s, double *size) {
  star_of(s, 5, 0.008, *size = 0.004, 0.01, 3, 0.0);
}

static void twisted_star(Surface *s, double *size) {
  star_of(s, 7, 0.004, *size = 0.004, 0.04, 10, 2.0);
}

static void star_twisted_without_points(Surface *s, double *size) {
  star_of(s, 6, 0.006, 1.0, 0.03, 3, -1.2);
  *size = 0.01;
}

static void sharp_star(Surface *s, double *size) {
  star_of(s, 24, 0.004, 1.0, 0.02, 2, 0.0);
  *size = 0.004;
}

static void helix(Surface *s, double *size) {
  add_tube(s, helix_curve, (double[4]){3, 0.01, 0.006, 0.0025}, 10, 120, 0, 0.0, 1);
  *size = 0.0016;
}

static void tight_helix(Surface *s, double *size) { // turns nearly touch
  add_tube(s, helix_curve, (double[4]){4, 0.01, 0.0052, 0.0025}, 8, 120, 0, 0.0, 1);
  *size = 0.002;
}

static void knot_void(Surface *s, double *size) {
  box(s, -0.035, -0.035, -0.02, 0.035, 0.035, 0.02, 8, 8, 5, 1);
  add_tube(s, knot_curve, (double[1]){0.003}, 8, 90, 1, 0.0, 0);
  *size = 0.008;
}

static void sphere_of_poles(Surface *s, double *size) {
  const int rows = 24, columns = 12;
  int32_t south = new_point(s, 0, 0, -0.02), north = new_point(s, 0, 0, 0.02), base = s->point_count;
  for (int c = 1; c < columns; c++) {
    for (int r = 0; r < rows; r++) {
      double a = 2.0 * PI * r / rows, b = PI * c / columns;
      new_point(s, 0.02 * sin(b) * cos(a), 0.02 * sin(b) * sin(a), -0.02 * cos(b));
    }
  }
  for (int r = 0; r < rows; r++) {
    int q = (r + 1) % rows;
    for (int c = 0; c + 2 < columns; c++) {
      int32_t a = base + c * rows;
      surface_triangle(s, a + r, a + q, a + rows + q, 1);
      surface_triangle(s, a + r, a + rows + q, a + rows + r, 1);
    }
    surface_triangle(s, south, base + q, base + r, 1);
    surface_triangle(s, north, base + (columns - 2) * rows + r, base + (columns - 2) * rows + q, 1);
  }
  *size = 0.004;
}

static void sphere_of_turned_diagonals(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.05, 3, 1);
  turn_diagonals(s, 5, 4);
  *size = 0.007;
}

static void lens(Surface *s, double *size) {
  ball(s, 0, 0, 0, 0.02, 3, 1);
  for (int32_t p = 0; p < s->point_count; p++)
    s->x[p][2] *= 0.05;
  *size = 0.003;
}

static void long_triangles(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.09, 0.01, 0.01, 1, 12, 12, 1);
  *size = 0.004;
}

static void long_triangles_both_ways(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.03, 0.03, 0.002, 1, 20, 1, 1);
  turn_diagonals(s, 4, 2);
  *size = 0.01;
}

// Two cubes with an edge in common, and two with a corner.
static void add_touching_box(Surface *s, double x, double y, double z) {
  Surface other = {0};
  box(&other, x, y, z, x + 0.01, y + 0.01, z + 0.01, 2, 2, 2, 1);
  int32_t *number = malloc((size_t)other.point_count * sizeof *number);
  int32_t before = s->point_count;
  for (int32_t p = 0; p < other.point_count; p++) {
    number[p] = -1;
    for (int32_t q = 0; q < before && number[p] < 0; q++) {
      double d = 0.0;
      for (int i = 0; i < 3; i++)
        d += fabs(s->x[q][i] - other.x[p][i]);
      if (d < 1e-9)
        number[p] = q;
    }
    if (number[p] < 0)
      number[p] = new_point(s, other.x[p][0], other.x[p][1], other.x[p][2]);
  }
  for (int32_t t = 0; t < other.triangle_count; t++)
    surface_triangle(s, number[other.triangle[t][0]], number[other.triangle[t][1]], number[other.triangle[t][2]], 1);
  free(number);
  surface_free(&other);
}

static void boxes_with_a_common_edge(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.01, 0.01, 0.01, 2, 2, 2, 1);
  add_touching_box(s, 0.01, 0.01, 0);
  *size = 0.005;
}

static void boxes_with_a_common_corner(Surface *s, double *size) {
  box(s, 0, 0, 0, 0.01, 0.01, 0.01, 2, 2, 2, 1);
  add_touching_box(s, 0.01, 0.01, 0.01);
  *size = 0.005;
}

static void box_far_from_the_origin(Surface *s, double *size) {
  cube(s, size);
  for (int32_t p = 0; p < s->point_count; p++) {
    for (int i = 0; i < 3; i++)
      s->x[p][i] += 1000.0 * (i + 1);
  }
}

static void warped_box(Surface *s, double *size) {
  uint64_t seed = 12;
  box(s, 0, 0, 0, 0.04, 0.04, 0.04, 8, 8, 8, 1);
  for (int32_t p = 0; p < 3 * s->point_count; p++)
    s->x[p / 3][p % 3] += 0.0022 * (draw(&seed) - 0.5);
  *size = 0.005;
}

static const struct {
  const char *name;
  void (*make)(Surface *, double *);
} hard[] = {
#define HARD(name) {#name, name}
    HARD(cube), HARD(cube_of_twelve_triangles), HARD(turned_cube_with_turned_diagonals),
    HARD(fine_surface_coarse_inside), HARD(coarse_surface_fine_inside), HARD(cylinder), HARD(cylinder_of_long_quads),
    HARD(cylinder_of_flat_quads), HARD(twisted_cylinder), HARD(hourglass), HARD(thin_gap), HARD(thin_gap_all_round),
    HARD(nearly_touching_spheres), HARD(nearly_touching_voids), HARD(void_near_the_wall), HARD(wedge_30),
    HARD(wedge_15), HARD(wedge_10), HARD(wedge_5), HARD(wedge_1), HARD(void_wedge_5), HARD(needle),
    HARD(needle_of_a_cone), HARD(spikes), HARD(dents), HARD(one_void), HARD(many_voids), HARD(five_shells),
    HARD(one_torus), HARD(thin_torus), HARD(linked_torus_voids), HARD(linked_tori), HARD(torus_in_a_torus), HARD(slab),
    HARD(slab_of_turned_diagonals), HARD(foil), HARD(bent_slab), HARD(sizes_varying_by_50),
    HARD(sphere_with_a_fine_spot), HARD(thin_box_with_a_fine_spot), HARD(schoenhardt), HARD(schoenhardt_nearly_closed),
    HARD(schoenhardt_flat), HARD(twisted_prism_of_8_sides), HARD(twisted_prism_of_30_sides),
    HARD(column_of_schoenhardts), HARD(schoenhardt_void), HARD(chazelle), HARD(spiral), HARD(re_entrant),
    HARD(coarse_re_entrant), HARD(comb), HARD(comb_of_thin_teeth), HARD(comb_of_thin_slots), HARD(comb_without_points),
    HARD(star), HARD(twisted_star), HARD(star_twisted_without_points), HARD(sharp_star), HARD(helix), HARD(tight_helix),
    HARD(knot_void), HARD(sphere_of_poles), HARD(sphere_of_turned_diagonals), HARD(lens), HARD(long_triangles),
    HARD(long_triangles_both_ways), HARD(boxes_with_a_common_edge), HARD(boxes_with_a_common_corner),
    HARD(box_far_from_the_origin), HARD(warped_box),
#undef HARD
};

int hard_boundary_count(void) {
  return (int)(sizeof hard / sizeof *hard);
}

const char *hard_boundary(int number, Surface *surface, double *size) {
  memset(surface, 0, sizeof *surface);
  hard[number].make(surface, size);
  return hard[number].name;
}

typedef struct {
  double at[4][3], phase[4][3], radius, wave;
} Wavy;

static void wavy_curve(const void *context, double u, double x[3], double *radius) {
  const Wavy *w = context;
  for (int i = 0; i < 3; i++) {
    x[i] = 0.0;
    for (int k = 0; k < 4; k++)
      x[i] += w->at[k][i] * cos(2.0 * PI * (k + 1) * u + w->phase[k][i]);
  }
  *radius = w->radius * (1.0 + w->wave * sin(14.0 * u));
}

static void waves(Surface *s, uint64_t *state, double share) {
  double way[4][3], phase[4], length = 0.0;
  for (int32_t p = 0; p < s->point_count; p++)
    length = fmax(length, hypot(hypot(s->x[p][0], s->x[p][1]), s->x[p][2]));
  for (int k = 0; k < 12; k++)
    way[k / 3][k % 3] = (6.0 * draw(state) - 3.0) / length;
  for (int k = 0; k < 4; k++)
    phase[k] = 6.28 * draw(state);
  for (int32_t p = 0; p < s->point_count; p++) {
    double x[3];
    memcpy(x, s->x[p], sizeof x);
    for (int k = 0; k < 4; k++)
      s->x[p][k % 3] += share * length * sin(way[k][0] * x[0] + way[k][1] * x[1] + way[k][2] * x[2] + phase[k]);
  }
}

void random_boundary(uint64_t seed, Surface *s, double *size) {
  uint64_t state = seed * 0x9e3779b97f4a7c15u + 1;
  memset(s, 0, sizeof *s);
  for (int k = 0; k < 8; k++)
    draw(&state);
  int kind = (int)(seed % 5);
  *size = 0.002 + 0.006 * draw(&state);
  if (kind == 0) { // star-shaped, from smooth to spiky
    double rough = draw(&state) * draw(&state) * 0.8;
    ball(s, 0, 0, 0, 0.02, 1 + draw_below(&state, 3), 1);
    for (int32_t p = 0; p < s->point_count; p++) {
      double factor = exp(rough * (4.0 * draw(&state) - 2.0));
      for (int i = 0; i < 3; i++)
        s->x[p][i] *= factor;
    }
  } else if (kind == 1) {
    Wavy w = {.radius = 0.001 + 0.002 * draw(&state), .wave = 0.9 * draw(&state)};
    for (int k = 0; k < 12; k++) {
      w.at[k / 3][k % 3] = 0.03 * (draw(&state) - 0.5) / (1 + k / 3);
      w.phase[k / 3][k % 3] = 6.28 * draw(&state);
    }
    add_tube(s, wavy_curve, &w, 3 + draw_below(&state, 9), 60 + draw_below(&state, 90), draw(&state) < 0.5, 0.0, 1);
  } else if (kind == 2) { // voids that do not touch: in cells of a lattice
    box(s, 0, 0, 0, 0.04, 0.04, 0.04, 2 + draw_below(&state, 6), 2 + draw_below(&state, 6), 2 + draw_below(&state, 6),
        1);
    for (int k = 0; k < 27; k++) {
      double r = 0.0063 * (0.2 + 0.79 * draw(&state)), free = 0.0065 - r, c[3];
      int place[3] = {k % 3, k / 3 % 3, k / 9};
      for (int i = 0; i < 3; i++)
        c[i] = 0.007 + 0.013 * place[i] + free * (2.0 * draw(&state) - 1.0);
      if (draw(&state) < 0.4)
        continue;
      if (draw(&state) < 0.5)
        ball(s, c[0], c[1], c[2], r, draw_below(&state, 3), 0);
      else
        torus(s, c[0], c[1], c[2], 0.65 * r, 0.3 * r, 3.0 * draw(&state), 4 + draw_below(&state, 4),
              8 + draw_below(&state, 12), 0);
    }
  } else if (kind == 3) {
    double height = 0.005 + 0.03 * draw(&state), edge = 0.003 + 0.02 * draw(&state) * draw(&state);
    double twist = (draw(&state) - 0.5) * 2.0, p[100][2];
    int layers = 1 + draw_below(&state, 8), corners = 3 + draw_below(&state, 20), which = draw_below(&state, 3);
    if (which == 0)
      comb_of(s, 2 + draw_below(&state, 8), 0.03 + 0.94 * draw(&state), edge, height, layers, twist);
    else if (which == 1)
      star_of(s, 3 + draw_below(&state, 20), 0.002 + 0.016 * draw(&state), edge, height, layers, twist);
    for (int k = 0; k < corners && which == 2; k++) {
      double a = 2.0 * PI * (k + 0.8 * draw(&state)) / corners, r = 0.003 + 0.02 * draw(&state);
      p[k][0] = r * cos(a), p[k][1] = r * sin(a);
    }
    if (which == 2)
      extrude(s, corners, (const double(*)[2])p, edge, height, layers, twist, 1);
  } else { // boxes, thin ones too, within each other
    double thin = pow(10.0, -2.0 * draw(&state));
    int n[3];
    for (int i = 0; i < 3; i++)
      n[i] = 1 + draw_below(&state, 9);
    box(s, -0.02, -0.02, -0.02 * thin, 0.02, 0.02, 0.02 * thin, n[0], n[1], n[2], 1);
    if (draw(&state) < 0.6) {
      double gap = pow(10.0, -2.0 * draw(&state)) * 0.9, l = 0.02 * (1.0 - gap);
      box(s, -l, -l, -l * thin, l, l, l * thin, 1 + draw_below(&state, 8), 1 + draw_below(&state, 8),
          1 + draw_below(&state, 8), 0);
    }
    turn(s, 6.0 * draw(&state), 6.0 * draw(&state));
  }
  if (draw(&state) < 0.5)
    waves(s, &state, 0.08 * draw(&state) * draw(&state));
  if (draw(&state) < 0.3)
    turn_diagonals(s, seed, 2 + draw_below(&state, 20));
  if (draw(&state) < 0.3)
    refine(s, s->x[draw_below(&state, s->point_count)], 0.0002 + 0.001 * draw(&state), 0.3 + 0.5 * draw(&state),
           s->triangle_count + 2500);
}

static int compare_triples(const void *a, const void *b) {
  return memcmp(a, b, 3 * sizeof(int32_t));
}

static void least_first(const int32_t p[3], int32_t out[3]) {
  int least = p[0] < p[1] ? (p[0] < p[2] ? 0 : 2) : (p[1] < p[2] ? 1 : 2);
  for (int k = 0; k < 3; k++)
    out[k] = p[(least + k) % 3];
}

const char *fill_fault(const Surface *s, const CwFill *fill) {
  static const int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const char *fault = NULL;
  int32_t(*neighbour)[4] = malloc((size_t)fill->tetrahedron_count * sizeof *neighbour);
  int32_t(*open)[3] = malloc((size_t)s->triangle_count * sizeof *open), opened = 0;
  int32_t(*given)[3] = malloc((size_t)s->triangle_count * sizeof *given);
  uint8_t *used = calloc((size_t)fill->point_count, 1);
  long double six = 0.0, size = 0.0;
  if (fill->point_count < s->point_count || memcmp(fill->x, s->x, (size_t)s->point_count * sizeof *s->x))
    fault = "points of the boundary were changed";
  else if (cw_tet_neighbours(fill->point_count, fill->tetrahedron_count, (const int32_t(*)[4])fill->tetrahedron,
                             neighbour) != CW_OK)
    fault = "a face has more than two cells";
  for (int32_t t = 0; t < fill->tetrahedron_count && !fault; t++) {
    const int32_t *p = fill->tetrahedron[t];
    const double *x[4];
    for (int i = 0; i < 4; i++) {
      x[i] = fill->x[p[i]];
      used[p[i]] = 1;
      size = fmaxl(size, fabs(x[i][0]) + fabs(x[i][1]) + fabs(x[i][2]));
    }
    if (cw_orient3d(x[0], x[1], x[2], x[3]) != 1)
      fault = "a cell is not positive";
    six += cw_tet_volume6(x[0], x[1], x[2], x[3]);
    for (int i = 0; i < 4 && !fault; i++) {
      if (neighbour[t][i] >= 0)
        continue;
      if (opened == s->triangle_count) {
        fault = "more faces are open than given";
        break;
      }
      const int32_t q[3] = {p[face[i][0]], p[face[i][1]], p[face[i][2]]};
      least_first(q, open[opened++]);
    }
  }
  if (!fault && opened != s->triangle_count)
    fault = "fewer faces are open than given";
  for (int32_t t = 0; t < s->triangle_count && !fault; t++)
    least_first(s->triangle[t], given[t]);
  if (!fault) {
    qsort(open, (size_t)opened, sizeof *open, compare_triples);
    qsort(given, (size_t)opened, sizeof *given, compare_triples);
    if (memcmp(open, given, (size_t)opened * sizeof *open))
      fault = "an open face is not the given triangle";
  }
  for (int32_t p = 0; p < fill->point_count && !fault; p++) {
    if (!used[p])
      fault = "a point is in no cell";
  }
  // surface_volume() goes from the origin: its rounding is that of the cube of the distance to it.
  double volume = surface_volume(s);
  if (!fault && fabsl(six / 6.0L - volume) > 1e-12 * volume + 1e-16 * size * size * size * s->triangle_count)
    fault = "the volume is not the enclosed one";
  free(neighbour);
  free(open);
  free(given);
  free(used);
  return fault;
}
