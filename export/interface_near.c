// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/interface_near.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/vec.h"

// Faces by the cubes of a grid that their boxes reach into.
typedef struct {
  int number[3];
  double first[3], step;
  int64_t *start; // number[0] * number[1] * number[2] + 1
  int64_t *faces;
} Cubes;

static void centre_of(const CwInterfaceFace *face, double x[3]) {
  memset(x, 0, sizeof(double[3]));
  for (int n = 0; n < face->count; ++n)
    for (int k = 0; k < 3; ++k) x[k] += face->nodes[n][k] / face->count;
}

static double longest_edge(const CwInterfaceFace *face) {
  double longest = 0, u[3];
  for (int n = 0; n < face->count; ++n) {
    cw_sub(face->nodes[(n + 1) % face->count], face->nodes[n], u);
    longest = fmax(longest, cw_dot(u, u));
  }
  return sqrt(longest);
}

static double clamp(double value, double most) {
  return fmin(fmax(value, 0), most);
}

// Where (r, s) lies in a face.
static void point_at(const CwInterfaceFace *face, const double rs[2], double x[3]) {
  const double(*v)[3] = face->nodes, r = rs[0], s = rs[1];
  for (int k = 0; k < 3; ++k)
    x[k] = face->count == 3 ? v[0][k] + r * (v[1][k] - v[0][k]) + s * (v[2][k] - v[0][k])
                            : (1 - r) * (1 - s) * v[0][k] + r * (1 - s) * v[1][k] + r * s * v[2][k] +
                                  (1 - r) * s * v[3][k];
}

// The place of a face nearest to a point, and its distance. Gauss-Newton on the distance, which is one step for a
// triangle; then, where that lies outside, along each edge.
static double nearest_in(const CwInterfaceFace *face, const double point[3], double rs[2]) {
  double at[3], off[3], best = INFINITY, try[2] = {1.0 / face->count, 1.0 / face->count};
  for (int step = 0; step < (face->count == 3 ? 1 : 8); ++step) {
    double u[3], w[3];
    for (int k = 0; k < 3; ++k) {
      const double(*v)[3] = face->nodes;
      double bend = face->count == 3 ? 0 : v[0][k] - v[1][k] + v[2][k] - v[3][k];
      u[k] = v[1][k] - v[0][k] + try[1] * bend;
      w[k] = v[face->count - 1][k] - v[0][k] + try[0] * bend;
    }
    point_at(face, try, at);
    cw_sub(point, at, off);
    double uu = cw_dot(u, u), uw = cw_dot(u, w), ww = cw_dot(w, w), determinant = uu * ww - uw * uw;
    if (!(determinant > 0)) break;
    try[0] += (cw_dot(u, off) * ww - cw_dot(w, off) * uw) / determinant;
    try[1] += (cw_dot(w, off) * uu - cw_dot(u, off) * uw) / determinant;
  }
  if (try[0] >= 0 && try[1] >= 0 && (face->count == 3 ? try[0] + try[1] <= 1 : try[0] <= 1 && try[1] <= 1)) {
    point_at(face, try, at);
    cw_sub(point, at, off);
    memcpy(rs, try, sizeof try);
    best = cw_dot(off, off);
  }
  static const double corner[2][4][2] = {{{0, 0}, {1, 0}, {0, 1}, {0, 0}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (int n = 0; n < face->count; ++n) {
    const double *a = corner[face->count - 3][n], *b = corner[face->count - 3][(n + 1) % face->count];
    double along[3], here[2];
    cw_sub(face->nodes[(n + 1) % face->count], face->nodes[n], along);
    cw_sub(point, face->nodes[n], off);
    double t = clamp(cw_dot(off, along) / cw_dot(along, along), 1);
    for (int k = 0; k < 2; ++k) here[k] = a[k] + t * (b[k] - a[k]);
    point_at(face, here, at);
    cw_sub(point, at, off);
    if (cw_dot(off, off) >= best) continue;
    best = cw_dot(off, off);
    memcpy(rs, here, sizeof here);
  }
  return sqrt(best);
}

static int cube_at(const Cubes *cubes, int k, double x) {
  int at = (int)floor((x - cubes->first[k]) / cubes->step);
  return at < 0 ? 0 : at >= cubes->number[k] ? cubes->number[k] - 1 : at;
}

// Counts the cubes of a face (faces NULL) or fills them.
static void sort_face(const Cubes *cubes, const CwInterfaceFace *face, int64_t number, int64_t *start, int64_t *faces) {
  int low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    double least = INFINITY, most = -INFINITY;
    for (int n = 0; n < face->count; ++n) {
      least = fmin(least, face->nodes[n][k]);
      most = fmax(most, face->nodes[n][k]);
    }
    low[k] = cube_at(cubes, k, least);
    high[k] = cube_at(cubes, k, most);
  }
  for (int x = low[0]; x <= high[0]; ++x)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int z = low[2]; z <= high[2]; ++z) {
        int64_t cube = ((int64_t)x * cubes->number[1] + y) * cubes->number[2] + z;
        if (faces)
          faces[start[cube]++] = number;
        else
          ++start[cube + 1];
      }
}

// About as many cubes as faces.
static CwStatus make_cubes(const CwInterfaceFace *faces, int64_t count, Cubes *cubes) {
  CwStatus status = CW_OK;
  double most[3] = {-INFINITY, -INFINITY, -INFINITY}, extent = 0;
  for (int k = 0; k < 3; ++k) cubes->first[k] = INFINITY;
  for (int64_t i = 0; i < count; ++i)
    for (int n = 0; n < faces[i].count; ++n)
      for (int k = 0; k < 3; ++k) {
        cubes->first[k] = fmin(cubes->first[k], faces[i].nodes[n][k]);
        most[k] = fmax(most[k], faces[i].nodes[n][k]);
      }
  for (int k = 0; k < 3; ++k) extent = fmax(extent, most[k] - cubes->first[k]);
  cubes->step = extent / cbrt((double)count + 1);
  for (int k = 0; k < 3; ++k) cubes->number[k] = 1 + (int)((most[k] - cubes->first[k]) / cubes->step);
  int64_t all = (int64_t)cubes->number[0] * cubes->number[1] * cubes->number[2];
  CW_NEW(cubes->start, all + 1);
  for (int64_t i = 0; i < count; ++i) sort_face(cubes, &faces[i], i, cubes->start, NULL);
  for (int64_t c = 0; c < all; ++c) cubes->start[c + 1] += cubes->start[c];
  CW_NEW(cubes->faces, cubes->start[all]);
  for (int64_t i = 0; i < count; ++i) sort_face(cubes, &faces[i], i, cubes->start, cubes->faces);
  memmove(cubes->start + 1, cubes->start, (size_t)all * sizeof *cubes->start);
  cubes->start[0] = 0;
done:
  return status;
}

static void search_cube(const Cubes *cubes, const int at[3], const CwInterfaceFace *faces, const double point[3],
                        int64_t *donor, double rs[2], double *best) {
  int64_t cube = ((int64_t)at[0] * cubes->number[1] + at[1]) * cubes->number[2] + at[2];
  for (int64_t i = cubes->start[cube]; i < cubes->start[cube + 1]; ++i) {
    double here[2] = {0};
    double distance = nearest_in(&faces[cubes->faces[i]], point, here);
    if (distance > *best || (distance == *best && cubes->faces[i] >= *donor)) continue;
    *best = distance;
    *donor = cubes->faces[i];
    memcpy(rs, here, sizeof here);
  }
}

// Looks into wider shells of cubes until no farther one can hold a nearer face.
static double find_nearest(const Cubes *cubes, const CwInterfaceFace *faces, const double point[3], int64_t *donor,
                           double rs[2]) {
  int middle[3], widest = 0;
  double best = INFINITY;
  *donor = -1;
  for (int k = 0; k < 3; ++k) {
    middle[k] = cube_at(cubes, k, point[k]);
    widest = cubes->number[k] > widest ? cubes->number[k] : widest;
  }
  for (int shell = 0; shell <= widest && best > (shell - 1) * cubes->step; ++shell)
    for (int x = middle[0] - shell; x <= middle[0] + shell; ++x)
      for (int y = middle[1] - shell; y <= middle[1] + shell; ++y)
        for (int z = middle[2] - shell; z <= middle[2] + shell; ++z) {
          const int at[3] = {x, y, z};
          int on = 0, inside = 1;
          for (int k = 0; k < 3; ++k) {
            on |= abs(at[k] - middle[k]) == shell;
            inside &= at[k] >= 0 && at[k] < cubes->number[k];
          }
          if (on && inside) search_cube(cubes, at, faces, point, donor, rs, &best);
        }
  return best;
}

CwStatus cw_interface_near(const CwInterfaceFace *faces, int64_t count, const CwInterfaceFace *others,
                           int64_t other_count, int64_t *donor, double (*place)[2], double *gap, int64_t *worst) {
  CwStatus status = CW_OK;
  Cubes cubes = {0};
  CW_TRY(make_cubes(others, other_count, &cubes));
  *gap = 0;
  *worst = 0;
  for (int64_t i = 0; i < count; ++i) {
    double centre[3];
    centre_of(&faces[i], centre);
    double off = find_nearest(&cubes, others, centre, &donor[i], place[i]);
    off /= fmax(longest_edge(&faces[i]), longest_edge(&others[donor[i]]));
    if (off <= *gap) continue;
    *gap = off;
    *worst = i;
  }
done:
  free(cubes.start);
  free(cubes.faces);
  return status;
}
