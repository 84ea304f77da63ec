// SPDX-License-Identifier: AGPL-3.0-or-later
#include "fill_fault.h"

#include "mesher/common/predicates.h"
#include "mesher/common/quality.h"
#include "mesher/fill/fill_shape.h"
#include "tests/unit_test.h"

static double constant_size(const void *length, const double x[3]) {
  return *(const double *)length;
}

CwFillInput fill_input(const Surface *surface, const double *size) {
  return surface_fill_input(surface, constant_size, size);
}

static int compare_triples(const void *a, const void *b) {
  return memcmp(a, b, 3 * sizeof(int32_t));
}

static void least_first(const int32_t p[3], int32_t out[3]) {
  int least = p[0] < p[1] ? (p[0] < p[2] ? 0 : 2) : (p[1] < p[2] ? 1 : 2);
  for (int k = 0; k < 3; k++) out[k] = p[(least + k) % 3];
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
  else if (cw_tet_neighbours(fill->tetrahedron_count, (const int32_t(*)[4])fill->tetrahedron, neighbour) != CW_OK)
    fault = "a face has more than two cells";
  for (int32_t t = 0; t < fill->tetrahedron_count && !fault; t++) {
    const int32_t *p = fill->tetrahedron[t];
    const double *x[4];
    for (int i = 0; i < 4; i++) {
      x[i] = fill->x[p[i]];
      used[p[i]] = 1;
      size = fmaxl(size, fabs(x[i][0]) + fabs(x[i][1]) + fabs(x[i][2]));
    }
    if (cw_orient3d(x[0], x[1], x[2], x[3]) != 1) fault = "a cell is not positive";
    six += cw_tet_volume6(x[0], x[1], x[2], x[3]);
    for (int i = 0; i < 4 && !fault; i++) {
      if (neighbour[t][i] >= 0) continue;
      if (opened == s->triangle_count) {
        fault = "more faces are open than given";
        break;
      }
      const int32_t q[3] = {p[face[i][0]], p[face[i][1]], p[face[i][2]]};
      least_first(q, open[opened++]);
    }
  }
  if (!fault && opened != s->triangle_count) fault = "fewer faces are open than given";
  for (int32_t t = 0; t < s->triangle_count && !fault; t++) least_first(s->triangle[t], given[t]);
  if (!fault) {
    qsort(open, (size_t)opened, sizeof *open, compare_triples);
    qsort(given, (size_t)opened, sizeof *given, compare_triples);
    if (memcmp(open, given, (size_t)opened * sizeof *open)) fault = "an open face is not the given triangle";
  }
  for (int32_t p = 0; p < fill->point_count && !fault; p++) {
    if (!used[p]) fault = "a point is in no cell";
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

FillShape check_fill(const Surface *s, const CwFill *fill) {
  FillShape found = {180.0, 0.0, 0.0};
  const char *fault = fill_fault(s, fill);
  if (fault) fail_msg("%s", fault);
  for (int32_t t = 0; t < fill->tetrahedron_count; t++) {
    const double *x[4];
    CwTetShape shape;
    for (int i = 0; i < 4; i++) x[i] = fill->x[fill->tetrahedron[t][i]];
    cw_tet_shape(x, &shape);
    const double aspect = shape.edge_longest / shape.edge_shortest;
    found.dihedral_least = fmin(found.dihedral_least, shape.dihedral_least);
    found.aspect_mean += aspect / fill->tetrahedron_count;
    found.aspect_most = fmax(found.aspect_most, aspect);
  }
  return found;
}
