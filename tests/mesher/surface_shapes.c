// SPDX-License-Identifier: AGPL-3.0-or-later
#include "surface_shapes.h"

static const double PI = 3.141592653589793;

void shape_box(Surface *s, double lx, double ly, double lz, double hx, double hy, double hz, int nx, int ny, int nz,
               int outward) {
  surface_add_box(s, (double[3]){lx, ly, lz}, (double[3]){hx, hy, hz}, (int[3]){nx, ny, nz}, outward);
}

void shape_ball(Surface *s, double x, double y, double z, double radius, int level, int outward) {
  surface_add_sphere(s, (double[3]){x, y, z}, radius, level, outward);
}

int32_t shape_point(Surface *s, double x, double y, double z) {
  return surface_point(s, (double[3]){x, y, z});
}

static void curve_frame(Curve curve, const void *context, double u, double t[3]) {
  double a[3], b[3], radius, length = 0.0;
  curve(context, u - 1e-5, a, &radius);
  curve(context, u + 1e-5, b, &radius);
  for (int i = 0; i < 3; i++) length += (b[i] - a[i]) * (b[i] - a[i]);
  for (int i = 0; i < 3; i++) t[i] = (b[i] - a[i]) / sqrt(length);
}

void shape_tube(Surface *s, Curve curve, const void *context, int rows, int columns, int closed, double shift,
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
      for (int i = 0; i < 3; i++) dot += v[i] * t[i];
      for (int i = 0; i < 3; i++) {
        v[i] -= dot * t[i];
        length += v[i] * v[i];
      }
      for (int i = 0; i < 3; i++) v[i] /= sqrt(length);
      for (int i = 0; i < 3; i++) w[i] = t[(i + 1) % 3] * v[(i + 2) % 3] - t[(i + 2) % 3] * v[(i + 1) % 3];
      if (c == 0) memcpy(first, v, sizeof first);
      if (c == stations && pass == 0) {
        double along = 0.0, across = 0.0;
        for (int i = 0; i < 3; i++) {
          along += v[i] * first[i];
          across += w[i] * first[i];
        }
        last_turn = atan2(across, along);
        continue;
      }
      if (closed && pass == 0) continue;
      for (int r = 0; r < rows; r++) {
        double a = 2.0 * PI * (r + shift * c) / rows + last_turn * c / columns;
        shape_point(s, x[0] + radius * (cos(a) * v[0] + sin(a) * w[0]), x[1] + radius * (cos(a) * v[1] + sin(a) * w[1]),
                    x[2] + radius * (cos(a) * v[2] + sin(a) * w[2]));
      }
    }
  }
  for (int c = 0; c < columns; c++) {
    for (int r = 0; r < rows; r++) {
      int turn = 0; // rows by which a closed, shifted tube meets itself later
      if (closed && c + 1 == columns) turn = (int)floor(shift * columns + 0.5);
      int32_t a = base + c * rows + r, b = base + c * rows + (r + 1) % rows, next = base + (c + 1) % stations * rows;
      int32_t d = next + (r + turn) % rows, e = next + (r + 1 + turn) % rows;
      surface_facing(s, a, b, e, outward);
      surface_facing(s, a, e, d, outward);
    }
  }
  for (int end = 0; end < 2 && !closed; end++) {
    double x[3], radius;
    curve(context, end, x, &radius);
    int32_t middle = shape_point(s, x[0], x[1], x[2]), ring = base + end * columns * rows;
    for (int r = 0; r < rows; r++) surface_facing(s, ring + r, middle, ring + (r + 1) % rows, end ? !outward : outward);
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

void shape_torus(Surface *s, double x, double y, double z, double great, double small, double tilt, int rows,
                 int columns, int outward) {
  shape_tube(s, ring_curve, &(Ring){{x, y, z}, great, small, tilt}, rows, columns, 1, 0.0, outward);
}

static double area(const double *a, const double *b, const double *c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

int shape_ears(int n, const double (*p)[2], int (*triangle)[3]) {
  int *left = malloc((size_t)n * sizeof *left), count = 0;
  for (int k = 0; k < n; k++) left[k] = k;
  for (; n >= 3; n--) {
    int best = -1;
    double most = 0.0;
    for (int k = 0; k < n; k++) {
      int at[3] = {left[(k + n - 1) % n], left[k], left[(k + 1) % n]};
      const double *a = p[at[0]], *b = p[at[1]], *c = p[at[2]];
      double twice = area(a, b, c), square = 0.0;
      for (int i = 0; i < 2; i++)
        square += (b[i] - a[i]) * (b[i] - a[i]) + (c[i] - b[i]) * (c[i] - b[i]) + (a[i] - c[i]) * (a[i] - c[i]);
      if (twice < 1e-9 * square || twice / square <= most) continue;
      int holds = 0;
      for (int m = 0; m < n && !holds; m++) {
        const double *q = p[left[m]];
        holds = left[m] != at[0] && left[m] != at[1] && left[m] != at[2] && area(a, b, q) >= -1e-9 * square &&
                area(b, c, q) >= -1e-9 * square && area(c, a, q) >= -1e-9 * square;
      }
      if (holds) continue;
      best = k;
      most = twice / square;
    }
    if (best < 0) break;
    int *t = triangle[count++];
    t[0] = left[(best + n - 1) % n], t[1] = left[best], t[2] = left[(best + 1) % n];
    memmove(left + best, left + best + 1, (size_t)(n - 1 - best) * sizeof *left);
  }
  free(left);
  return count;
}

void shape_extrude(Surface *s, int corners, const double (*corner)[2], double edge, double height, int layers,
                   double twist, int outward) {
  double(*p)[2] = malloc(4000 * sizeof *p);
  int(*triangle)[3] = malloc(4000 * sizeof *triangle), n = 0;
  for (int k = 0; k < corners; k++) {
    const double *a = corner[k], *b = corner[(k + 1) % corners];
    int pieces = (int)ceil(hypot(b[0] - a[0], b[1] - a[1]) / edge - 1e-9);
    if (pieces < 1) pieces = 1;
    for (int i = 0; i < pieces; i++, n++) {
      p[n][0] = a[0] + (b[0] - a[0]) * i / pieces;
      p[n][1] = a[1] + (b[1] - a[1]) * i / pieces;
    }
  }
  int32_t base = s->point_count;
  for (int l = 0; l <= layers; l++) {
    double c = cos(twist * l / layers), d = sin(twist * l / layers);
    for (int k = 0; k < n; k++)
      shape_point(s, c * p[k][0] - d * p[k][1], d * p[k][0] + c * p[k][1], height * l / layers);
  }
  for (int l = 0; l < layers; l++) {
    for (int k = 0; k < n; k++) {
      int32_t a = base + l * n + k, b = base + l * n + (k + 1) % n;
      surface_facing(s, a, b, b + n, outward);
      surface_facing(s, a, b + n, a + n, outward);
    }
  }
  int count = shape_ears(n, (const double(*)[2])p, triangle);
  for (int t = 0; t < count; t++) {
    const int *q = triangle[t];
    surface_facing(s, base + q[0], base + q[1], base + q[2], !outward);
    int32_t top = base + layers * n;
    surface_facing(s, top + q[0], top + q[1], top + q[2], outward);
  }
  free(p);
  free(triangle);
}

static int32_t triangle_with(const Surface *s, int32_t a, int32_t b, int *third) {
  for (int32_t t = 0; t < s->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      if (s->triangle[t][k] != a || s->triangle[t][(k + 1) % 3] != b) continue;
      *third = (k + 2) % 3;
      return t;
    }
  }
  return -1;
}

int shape_turn_diagonals(Surface *s, uint64_t seed, int one_in) {
  uint8_t *done = calloc((size_t)s->triangle_count, 1);
  int turned = 0, at, unused;
  for (int32_t t = 0; t < s->triangle_count; t++) {
    if (draw_below(&seed, one_in) || done[t]) continue;
    int32_t a = s->triangle[t][0], b = s->triangle[t][1], c = s->triangle[t][2], o = triangle_with(s, b, a, &at);
    if (o < 0 || done[o]) continue;
    int32_t d = s->triangle[o][at];
    if (c == d || triangle_with(s, c, d, &unused) >= 0 || triangle_with(s, d, c, &unused) >= 0) continue;
    done[t] = done[o] = 1;
    const int32_t one[3] = {a, d, c}, two[3] = {d, b, c};
    memcpy(s->triangle[t], one, sizeof one);
    memcpy(s->triangle[o], two, sizeof two);
    turned++;
  }
  free(done);
  return turned;
}

void shape_refine(Surface *s, const double place[3], double least, double growth, int limit) {
  const double p[3] = {place[0], place[1], place[2]}; // it may be a point of the surface, which moves in memory
  for (int again = 1; again && s->triangle_count < limit;) {
    again = 0;
    for (int32_t t = 0; t < s->triangle_count && s->triangle_count < limit; t++) {
      for (;;) { // to the neighbour with the longer edge, until one edge is the longest of both
        int at = 0, third = 0;
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
        if (most <= least + growth * far) break;
        int32_t a = s->triangle[t][at], b = s->triangle[t][(at + 1) % 3], c = s->triangle[t][(at + 2) % 3];
        int32_t o = triangle_with(s, b, a, &third), d = s->triangle[o][third];
        double m[3];
        for (int i = 0; i < 3; i++) m[i] = 0.5 * (s->x[a][i] + s->x[b][i]);
        int32_t n = shape_point(s, m[0], m[1], m[2]);
        const int32_t one[3] = {a, n, c}, two[3] = {b, n, d};
        memcpy(s->triangle[t], one, sizeof one);
        memcpy(s->triangle[o], two, sizeof two);
        surface_facing(s, n, b, c, 1);
        surface_facing(s, n, a, d, 1);
        again = 1;
      }
    }
  }
}

void shape_scale(Surface *s, double x, double y, double z) {
  for (int32_t p = 0; p < s->point_count; p++) s->x[p][0] *= x, s->x[p][1] *= y, s->x[p][2] *= z;
}

void shape_turn(Surface *s, double a, double b) {
  for (int32_t p = 0; p < s->point_count; p++) {
    double x = s->x[p][0], y = s->x[p][1], z = s->x[p][2];
    s->x[p][0] = cos(a) * x - sin(a) * y;
    y = sin(a) * x + cos(a) * y;
    s->x[p][1] = cos(b) * y - sin(b) * z;
    s->x[p][2] = sin(b) * y + cos(b) * z;
  }
}

void shape_comb(Surface *s, int teeth, double share, double edge, double height, int layers, double twist) {
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
  shape_extrude(s, n + 1, (const double(*)[2])q, edge, height, layers, twist, 1);
}

void shape_star(Surface *s, int arms, double inner, double edge, double height, int layers, double twist) {
  double p[200][2];
  for (int k = 0; k < 2 * arms; k++) {
    double a = PI * k / arms, r = k % 2 ? inner : 0.02;
    p[k][0] = r * cos(a), p[k][1] = r * sin(a);
  }
  shape_extrude(s, 2 * arms, (const double(*)[2])p, edge, height, layers, twist, 1);
}
