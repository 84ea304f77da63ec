// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/cut.h"

#include <math.h>
#include <stdlib.h>

#include "pipeline/mesh/cell.h"
#include "pipeline/vec.h"

double cw_cut_distance(const CwCutPlane *plane, const double x[3]) {
  return cw_dot(plane->normal, x) - cw_dot(plane->normal, plane->origin);
}

static const int tetrahedron_edge[][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
static const int pyramid_edge[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
static const int prism_edge[][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};

// Where the plane goes through a corner of the cell, several edges give the same point: it is kept once.
static int without_doubles(int corners, double polygon[CW_CUT_CORNERS][2]) {
  double size = 0;
  int kept = 0;
  for (int k = 1; k < corners; k++)
    size = fmax(size, hypot(polygon[k][0] - polygon[0][0], polygon[k][1] - polygon[0][1]));
  for (int k = 0; k < corners; k++) {
    const double *before = polygon[kept ? kept - 1 : 0], *first = polygon[0], *here = polygon[k];
    if (kept && hypot(here[0] - before[0], here[1] - before[1]) <= 1e-9 * size) continue;
    if (kept && hypot(here[0] - first[0], here[1] - first[1]) <= 1e-9 * size) continue;
    polygon[kept][0] = here[0];
    polygon[kept++][1] = here[1];
  }
  return kept < 3 ? 0 : kept;
}

int cw_cut_cell(const CwCutPlane *plane, int count, const double *const *x, const double *s,
                double polygon[CW_CUT_CORNERS][2]) {
  const int(*edge)[2] = count == 4 ? tetrahedron_edge : count == 5 ? pyramid_edge : prism_edge;
  int edges = count == 4 ? 6 : count == 5 ? 8 : 9, corners = 0;
  double middle[2] = {0, 0}, angle[CW_CUT_CORNERS];
  for (int e = 0; e < edges; e++) {
    int a = edge[e][0], b = edge[e][1];
    if ((s[a] >= 0) == (s[b] >= 0)) continue;
    double t = s[a] / (s[a] - s[b]), point[3];
    for (int i = 0; i < 3; i++) point[i] = x[a][i] + t * (x[b][i] - x[a][i]) - plane->origin[i];
    polygon[corners][0] = cw_dot(point, plane->u);
    polygon[corners][1] = cw_dot(point, plane->v);
    middle[0] += polygon[corners][0];
    middle[1] += polygon[corners][1];
    corners++;
  }
  // The cut is convex (nearly, where a quadrilateral is warped): the corners stand in order about their mean.
  for (int k = 0; k < corners; k++)
    angle[k] = atan2(polygon[k][1] - middle[1] / corners, polygon[k][0] - middle[0] / corners);
  for (int k = 1; k < corners; k++) {
    for (int m = k; m > 0 && angle[m] < angle[m - 1]; m--) {
      for (int i = 0; i < 2; i++) {
        double swap = polygon[m][i];
        polygon[m][i] = polygon[m - 1][i];
        polygon[m - 1][i] = swap;
      }
      double swap = angle[m];
      angle[m] = angle[m - 1];
      angle[m - 1] = swap;
    }
  }
  return without_doubles(corners, polygon);
}

static CwStatus add_cell(const CwCutPlane *plane, const CwRegionData *cells, const double *distance, int32_t cell,
                         CwRegionCut *cut) {
  CwStatus status = CW_OK;
  int count;
  const int32_t *node = cw_cell_nodes(cells, cell, &count);
  const double *x[6];
  double s[6];
  for (int k = 0; k < count; k++) {
    x[k] = cells->points[node[k]];
    s[k] = distance[node[k]];
  }
  CW_GROW(cut->cells, cut->capacity, cut->count + 1);
  CwCutCell *made = &cut->cells[cut->count++];
  made->cell = cell;
  made->corners = cw_cut_cell(plane, count, x, s, made->polygon);
done:
  return status;
}

CwStatus cw_cut_region(const CwCutPlane *plane, const CwRegionData *cells, const double *distance, CwRegionCut *cut) {
  CwStatus status = CW_OK;
  enum { NONE = 16 }; // more than a cell has corners
  unsigned char *above = NULL;
  const struct {
    int32_t count;
    int corners;
    const int32_t *corner;
  } kind[] = {{cells->tetrahedron_count, 4, (const int32_t *)cells->tetrahedra},
              {cells->pyramid_count, 5, (const int32_t *)cells->pyramids},
              {cells->prism_count, 6, (const int32_t *)cells->prisms}};
  int any_above = 0, any_below = 0;
  CW_NEW_UNSET(above, cells->point_count);
  for (int32_t i = 0; i < cells->point_count; i++) {
    above[i] = isnan(distance[i]) ? NONE : distance[i] >= 0;
    any_above |= above[i] == 1;
    any_below |= above[i] == 0;
  }
  if (!any_above || !any_below) goto done;
  for (int32_t k = 0, before = 0; k < 3; before += kind[k++].count) {
    const int32_t *corner = kind[k].corner;
    for (int32_t c = 0; c < kind[k].count; c++, corner += kind[k].corners) {
      int sum = 0;
      for (int i = 0; i < kind[k].corners; i++) sum += above[corner[i]];
      if (sum > 0 && sum < kind[k].corners) CW_TRY(add_cell(plane, cells, distance, before + c, cut));
    }
  }
done:
  free(above);
  return status;
}

void cw_region_cut_free(CwRegionCut *cut) {
  free(cut->cells);
  *cut = (CwRegionCut){0};
}
