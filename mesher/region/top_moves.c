// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/top_moves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/incident.h"
#include "mesher/common/vec.h"
#include "mesher/fill/tet_cavity.h"
#include "mesher/fill/tet_quality.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"

// Pattern search: steps of this share of the shortest way to another corner, then half and a quarter.
enum { STEPS = 3, ROUNDS = 8, MEASURES = 3 };
static const double FIRST_STEP = 0.2;

typedef enum { STAYS, INSIDE, ON_TOP } Kind;

// Points that may move, by row, with their tetrahedra and, on the layer top, the last prisms of their columns.
typedef struct {
  CwRegionData *cells;
  int layers;
  int32_t fill_count; // of tetrahedra; the others are of tapered columns
  double flat_sine;
  uint8_t *kind;         // of each point
  int32_t *row;          // of each point, -1: none
  int32_t count, *point; // of each row
  int32_t flat_count, *flat;
  CwIncident tet, column;      // tetrahedra and columns by row
  double (*measure)[MEASURES]; // of each column, as it was at first
  double *height;              // of the last layer at first, by row
} Moves;

// The last prism of column t, whose corners 3 to 5 are on the layer top.
static int32_t last_prism(const Moves *m, int32_t t) {
  return (t + 1) * m->layers - 1;
}

static void find_kinds(Moves *m, int32_t shared_count) {
  const CwRegionData *c = m->cells;
  memset(m->kind, INSIDE, (size_t)c->point_count);
  for (int32_t p = 0; p < c->prism_count; p++)
    for (int k = 0; k < 6; k++) m->kind[c->prisms[p][k]] = STAYS;
  for (int32_t t = 0; t < c->prism_count / m->layers; t++)
    for (int k = 3; k < 6; k++) m->kind[c->prisms[last_prism(m, t)][k]] = ON_TOP;
  for (int32_t p = 0; p < c->pyramid_count; p++)
    for (int k = 0; k < 5; k++) m->kind[c->pyramids[p][k]] = STAYS;
  for (int32_t t = m->fill_count; t < c->tetrahedron_count; t++)
    for (int k = 0; k < 4; k++) m->kind[c->tetrahedra[t][k]] = STAYS;
  for (int32_t t = 0; t < c->triangle_count; t++)
    for (int k = 0; k < 3; k++) m->kind[c->triangles[t][k]] = STAYS;
  for (int32_t q = 0; q < c->quad_count; q++)
    for (int k = 0; k < 4; k++) m->kind[c->quads[q][k]] = STAYS;
  memset(m->kind, STAYS, (size_t)shared_count);
}

// The quality or, where checkMesh calls the determinant small, less (judge in fill/tet_search.c). Most have inner faces
// alone; those of faces on patches are less.
static double quality_of(const Moves *m, int32_t t) {
  const int32_t *p = m->cells->tetrahedra[t];
  double(*x)[3] = m->cells->points;
  CwTetMeasures s = cw_tet_measures(x[p[0]], x[p[1]], x[p[2]], x[p[3]]);
  double quality = cw_tet_quality_by(&s), determinant = cw_tet_determinant(&s, 0);
  return quality > 0 ? fmin(quality, m->flat_sine * cw_tet_determinant_share(determinant)) : quality;
}

// The flat tetrahedra on the layer top, and rows for their points.
static CwStatus find_flat(Moves *m) {
  CwStatus status = CW_OK;
  const CwRegionData *c = m->cells;
  int32_t flat_capacity = 0, capacity = 0;
  for (int32_t t = 0; t < m->fill_count; t++) {
    const int32_t *p = c->tetrahedra[t];
    int on_top = 0;
    for (int k = 0; k < 4; k++) on_top |= m->kind[p[k]] == ON_TOP;
    if (!on_top || quality_of(m, t) >= cw_policy.search_wanted) continue;
    CW_GROW(m->flat, flat_capacity, m->flat_count + 1);
    m->flat[m->flat_count++] = t;
    CW_GROW(m->point, capacity, m->count + 4);
    for (int k = 0; k < 4; k++) {
      if (m->kind[p[k]] == STAYS || m->row[p[k]] >= 0) continue;
      m->row[p[k]] = m->count;
      m->point[m->count++] = p[k];
    }
  }
done:
  return status;
}

// Lists cells by the rows of their points: `corners` of each, `stride` from one to the next.
static CwStatus list_cells(const Moves *m, int32_t count, const int32_t *corner, int corners, int stride,
                           CwIncident *made) {
  CwStatus status = CW_OK;
  int32_t *cell = NULL, *group = NULL, number = 0, capacity = 0, group_capacity = 0;
  for (int32_t i = 0; i < count; i++)
    for (int k = 0; k < corners; k++) {
      int32_t row = m->row[corner[(size_t)i * (size_t)stride + (size_t)k]];
      if (row < 0) continue;
      CW_GROW(cell, capacity, number + 1);
      CW_GROW(group, group_capacity, number + 1);
      cell[number] = i;
      group[number++] = row;
    }
  CW_NEW(made->start, (size_t)m->count + 1);
  CW_NEW(made->triangle, number);
  if (number) cw_list_by_group(number, group, m->count, made->start, made->triangle);
  for (int32_t i = 0; i < number; i++) made->triangle[i] = cell[made->triangle[i]];
done:
  free(cell);
  free(group);
  return status;
}

// How sound the last prism of a column is: its corners, its top, its sides.
static void measure_prism(const Moves *m, int32_t column, double measure[MEASURES]) {
  const int32_t *p = m->cells->prisms[last_prism(m, column)];
  const double *base[3], *top[3];
  for (int k = 0; k < 3; k++) { // with the base's normal out of the domain
    base[k] = m->cells->points[p[(3 - k) % 3]];
    top[k] = m->cells->points[p[3 + (3 - k) % 3]];
  }
  measure[0] = cw_prism_quality(base, top);
  measure[1] = cw_prism_top_quality(base, top);
  measure[2] = cw_prism_shear_quality(base, top, 1, (const double[3]){1, 1, 1});
}

// The height of the last layer under a point of the layer top.
static double height_of(const Moves *m, int32_t row) {
  const int32_t *prism = m->cells->prisms[last_prism(m, m->column.triangle[m->column.start[row]])];
  int k = 3;
  while (prism[k] != m->point[row]) k++;
  return cw_distance(m->cells->points[prism[k]], m->cells->points[prism[k - 3]]);
}

// The prisms and the heights of the last layers, before any point moves.
static void measure_all(Moves *m) {
  for (int32_t row = 0; row < m->count; row++) {
    if (m->kind[m->point[row]] != ON_TOP) continue;
    m->height[row] = height_of(m, row);
    for (int32_t i = m->column.start[row]; i < m->column.start[row + 1]; i++)
      measure_prism(m, m->column.triangle[i], m->measure[m->column.triangle[i]]);
  }
}

// Whether the prisms under a point of the layer top are as they may be.
static int are_sound(const Moves *m, int32_t row) {
  const double good[MEASURES] = {cw_policy.prism_good, cw_policy.prism_good, 1};
  if (m->kind[m->point[row]] != ON_TOP) return 1;
  double change = height_of(m, row) / m->height[row], most = 1 + cw_policy.slope;
  if (change < 1 / most || change > most) return 0;
  for (int32_t i = m->column.start[row]; i < m->column.start[row + 1]; i++) {
    const int32_t column = m->column.triangle[i];
    double now[MEASURES];
    measure_prism(m, column, now);
    for (int k = 0; k < MEASURES; k++)
      if (!(now[k] >= fmin(m->measure[column][k], good[k]))) return 0;
  }
  return 1;
}

// The least quality of the tetrahedra at a point.
static double least_around(const Moves *m, int32_t row) {
  double least = INFINITY;
  for (int32_t i = m->tet.start[row]; i < m->tet.start[row + 1]; i++)
    least = fmin(least, quality_of(m, m->tet.triangle[i]));
  return least;
}

static double shortest_edge(const Moves *m, int32_t row) {
  const double *x = m->cells->points[m->point[row]];
  double shortest = INFINITY;
  for (int32_t i = m->tet.start[row]; i < m->tet.start[row + 1]; i++) {
    const int32_t *corner = m->cells->tetrahedra[m->tet.triangle[i]];
    for (int k = 0; k < 4; k++)
      if (corner[k] != m->point[row]) shortest = fmin(shortest, cw_distance(m->cells->points[corner[k]], x));
  }
  return shortest;
}

// Moves a point to where the least quality round it is greatest. Whether it did.
static int move_point(Moves *m, int32_t row) {
  double *x = m->cells->points[m->point[row]], best = least_around(m, row), step = FIRST_STEP * shortest_edge(m, row);
  int moved = 0;
  for (int halvings = 0; halvings < STEPS; halvings++, step *= 0.5)
    for (int k = 0; k < 14; k++) {
      double before[3], quality;
      cw_copy(x, before);
      for (int i = 0; i < 3; i++) x[i] += step * cw_tet_direction[k][i];
      quality = least_around(m, row);
      if (quality > best + cw_policy.least_gain && are_sound(m, row)) {
        best = quality;
        moved = 1;
        k--; // on in the same direction
      } else {
        cw_copy(before, x);
      }
    }
  return moved;
}

static void move_all(Moves *m, uint8_t *moved) {
  for (int round = 0, changes = 1; round < ROUNDS && changes; round++) {
    changes = 0;
    for (int32_t f = 0; f < m->flat_count; f++)
      for (int k = 0; k < 4 && quality_of(m, m->flat[f]) < cw_policy.search_wanted; k++) {
        int32_t row = m->row[m->cells->tetrahedra[m->flat[f]][k]];
        if (row < 0 || !move_point(m, row)) continue;
        moved[row] = 1;
        changes = 1;
      }
  }
}

CwStatus cw_top_moves(int layers, CwRegionMesh *mesh, int32_t *moved) {
  CwStatus status = CW_OK;
  CwRegionData *cells = &mesh->cells;
  Moves m = {.cells = cells, .layers = layers, .flat_sine = sin(cw_policy.flat_angle * CW_DEGREE)};
  uint8_t *has_moved = NULL;
  *moved = 0;
  m.fill_count = cells->tetrahedron_count - mesh->layer_tetrahedra;
  if (layers < 2) goto done;
  CW_NEW_UNSET(m.kind, cells->point_count);
  CW_NEW_UNSET(m.row, cells->point_count);
  memset(m.row, -1, (size_t)cells->point_count * sizeof *m.row);
  find_kinds(&m, cells->shared_count);
  CW_TRY(find_flat(&m));
  if (!m.flat_count) goto done;
  const int32_t columns = cells->prism_count / layers;
  CW_TRY(list_cells(&m, m.fill_count, *cells->tetrahedra, 4, 4, &m.tet));
  CW_TRY(list_cells(&m, columns, cells->prisms[layers - 1] + 3, 3, 6 * layers, &m.column));
  CW_NEW_UNSET(m.measure, columns);
  CW_NEW_UNSET(m.height, m.count);
  CW_NEW(has_moved, m.count);
  measure_all(&m);
  move_all(&m, has_moved);
  for (int32_t row = 0; row < m.count; row++) *moved += has_moved[row];
done:
  free(m.kind);
  free(m.row);
  free(m.point);
  free(m.flat);
  cw_incident_free(&m.tet);
  cw_incident_free(&m.column);
  free(m.measure);
  free(m.height);
  free(has_moved);
  return status;
}
