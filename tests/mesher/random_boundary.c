// SPDX-License-Identifier: AGPL-3.0-or-later
#include "random_boundary.h"

#include "surface_shapes.h"

static const double PI = 3.141592653589793;

typedef struct {
  double at[4][3], phase[4][3], radius, wave;
} Wavy;

static void wavy_curve(const void *context, double u, double x[3], double *radius) {
  const Wavy *w = context;
  for (int i = 0; i < 3; i++) {
    x[i] = 0.0;
    for (int k = 0; k < 4; k++) x[i] += w->at[k][i] * cos(2.0 * PI * (k + 1) * u + w->phase[k][i]);
  }
  *radius = w->radius * (1.0 + w->wave * sin(14.0 * u));
}

static void waves(Surface *s, uint64_t *state, double share) {
  double way[4][3], phase[4], length = 0.0;
  for (int32_t p = 0; p < s->point_count; p++) length = fmax(length, hypot(hypot(s->x[p][0], s->x[p][1]), s->x[p][2]));
  for (int k = 0; k < 12; k++) way[k / 3][k % 3] = (6.0 * draw(state) - 3.0) / length;
  for (int k = 0; k < 4; k++) phase[k] = 6.28 * draw(state);
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
  for (int k = 0; k < 8; k++) draw(&state);
  int kind = (int)(seed % 5);
  *size = 0.002 + 0.006 * draw(&state);
  if (kind == 0) { // star-shaped, from smooth to spiky
    double rough = draw(&state) * draw(&state) * 0.8;
    shape_ball(s, 0, 0, 0, 0.02, 1 + draw_below(&state, 3), 1);
    for (int32_t p = 0; p < s->point_count; p++) {
      double factor = exp(rough * (4.0 * draw(&state) - 2.0));
      for (int i = 0; i < 3; i++) s->x[p][i] *= factor;
    }
  } else if (kind == 1) {
    Wavy w = {.radius = 0.001 + 0.002 * draw(&state), .wave = 0.9 * draw(&state)};
    for (int k = 0; k < 12; k++) {
      w.at[k / 3][k % 3] = 0.03 * (draw(&state) - 0.5) / (1 + k / 3);
      w.phase[k / 3][k % 3] = 6.28 * draw(&state);
    }
    shape_tube(s, wavy_curve, &w, 3 + draw_below(&state, 9), 60 + draw_below(&state, 90), draw(&state) < 0.5, 0.0, 1);
  } else if (kind == 2) { // voids that do not touch: in cells of a lattice
    shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 2 + draw_below(&state, 6), 2 + draw_below(&state, 6),
              2 + draw_below(&state, 6), 1);
    for (int k = 0; k < 27; k++) {
      double r = 0.0063 * (0.2 + 0.79 * draw(&state)), free = 0.0065 - r, c[3];
      int place[3] = {k % 3, k / 3 % 3, k / 9};
      for (int i = 0; i < 3; i++) c[i] = 0.007 + 0.013 * place[i] + free * (2.0 * draw(&state) - 1.0);
      if (draw(&state) < 0.4) continue;
      if (draw(&state) < 0.5)
        shape_ball(s, c[0], c[1], c[2], r, draw_below(&state, 3), 0);
      else
        shape_torus(s, c[0], c[1], c[2], 0.65 * r, 0.3 * r, 3.0 * draw(&state), 4 + draw_below(&state, 4),
                    8 + draw_below(&state, 12), 0);
    }
  } else if (kind == 3) {
    double height = 0.005 + 0.03 * draw(&state), edge = 0.003 + 0.02 * draw(&state) * draw(&state);
    double twist = (draw(&state) - 0.5) * 2.0, p[100][2];
    int layers = 1 + draw_below(&state, 8), corners = 3 + draw_below(&state, 20), which = draw_below(&state, 3);
    if (which == 0)
      shape_comb(s, 2 + draw_below(&state, 8), 0.03 + 0.94 * draw(&state), edge, height, layers, twist);
    else if (which == 1)
      shape_star(s, 3 + draw_below(&state, 20), 0.002 + 0.016 * draw(&state), edge, height, layers, twist);
    for (int k = 0; k < corners && which == 2; k++) {
      double a = 2.0 * PI * (k + 0.8 * draw(&state)) / corners, r = 0.003 + 0.02 * draw(&state);
      p[k][0] = r * cos(a), p[k][1] = r * sin(a);
    }
    if (which == 2) shape_extrude(s, corners, (const double(*)[2])p, edge, height, layers, twist, 1);
  } else { // boxes, thin ones too, within each other
    double thin = pow(10.0, -2.0 * draw(&state));
    int n[3];
    for (int i = 0; i < 3; i++) n[i] = 1 + draw_below(&state, 9);
    shape_box(s, -0.02, -0.02, -0.02 * thin, 0.02, 0.02, 0.02 * thin, n[0], n[1], n[2], 1);
    if (draw(&state) < 0.6) {
      double gap = pow(10.0, -2.0 * draw(&state)) * 0.9, l = 0.02 * (1.0 - gap);
      shape_box(s, -l, -l, -l * thin, l, l, l * thin, 1 + draw_below(&state, 8), 1 + draw_below(&state, 8),
                1 + draw_below(&state, 8), 0);
    }
    shape_turn(s, 6.0 * draw(&state), 6.0 * draw(&state));
  }
  if (draw(&state) < 0.5) waves(s, &state, 0.08 * draw(&state) * draw(&state));
  if (draw(&state) < 0.3) shape_turn_diagonals(s, seed, 2 + draw_below(&state, 20));
  if (draw(&state) < 0.3)
    shape_refine(s, s->x[draw_below(&state, s->point_count)], 0.0002 + 0.001 * draw(&state), 0.3 + 0.5 * draw(&state),
                 s->triangle_count + 2500);
}
