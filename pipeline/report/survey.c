// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/survey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/exact_sum.h"
#include "pipeline/vec.h"

static const char *const place_patch[CW_PLACE_COUNT] = {"blade_leading_edge", "blade_trailing_edge", "tongue"};
static const char *const wall_patch[CW_WALL_COUNT] = {"hub", "shroud"};

void cw_survey_start(CwSurvey *survey, const CwPumpSizes *sizes) {
  memset(survey, 0, sizeof *survey);
  survey->sizes = *sizes;
  survey->area_unit = cw_exact_unit(pow(sizes->outlet_radius, 2));
  survey->moment_unit = cw_exact_unit(pow(sizes->outlet_radius, 3));
  for (int k = 0; k < CW_SURVEY_BINS; k++) {
    survey->radius_most[k] = -INFINITY;
    survey->z_least[k] = INFINITY;
    survey->z_most[k] = -INFINITY;
  }
}

static int bin_of(double azimuth) {
  double turns = azimuth / (2 * M_PI);
  int bin = (int)floor((turns - floor(turns)) * CW_SURVEY_BINS);
  return bin >= CW_SURVEY_BINS ? 0 : bin;
}

// Returns the bin that the point falls into.
static int add_point(CwSurvey *survey, const double x[3]) {
  int bin = bin_of(atan2(x[1], x[0]));
  survey->radius_most[bin] = fmax(survey->radius_most[bin], hypot(x[0], x[1]));
  survey->z_least[bin] = fmin(survey->z_least[bin], x[2]);
  survey->z_most[bin] = fmax(survey->z_most[bin], x[2]);
  return bin;
}

static double face_area(const double a[3], const double b[3], const double c[3]) {
  double n[3];
  cw_normal(a, b, c, n);
  return 0.5 * cw_norm(n);
}

CwStatus cw_survey_add(CwSurvey *survey, const CwMesh *mesh, const CwRegionData *surface) {
  CwStatus status = CW_OK;
  // Patches of a region are counted from the first one of its domain; those of another domain get a number no face has.
  int first = mesh->domains[surface->domain].first_patch, wall[CW_WALL_COUNT];
  int patch[CW_PLACE_COUNT], *bins = NULL;
  for (int k = 0; k < CW_PLACE_COUNT; k++) patch[k] = cw_mesh_patch_find(mesh, place_patch[k]) - first;
  for (int k = 0; k < CW_WALL_COUNT; k++) wall[k] = cw_mesh_patch_find(mesh, wall_patch[k]) - first;
  CW_NEW_UNSET(bins, surface->point_count);
  for (int32_t p = 0; p < surface->point_count; p++) bins[p] = add_point(survey, surface->points[p]);
  for (int32_t t = 0; t < surface->triangle_count; t++) {
    const int32_t *corner = surface->triangles[t];
    const double *a = surface->points[corner[0]], *b = surface->points[corner[1]], *c = surface->points[corner[2]];
    double middle[3], area = face_area(a, b, c);
    for (int i = 0; i < 3; i++) middle[i] = (a[i] + b[i] + c[i]) / 3;
    // Within a bin it lies between the corners.
    if (bins[corner[0]] != bins[corner[1]] || bins[corner[0]] != bins[corner[2]]) add_point(survey, middle);
    for (int k = 0; k < CW_PLACE_COUNT; k++) {
      if (patch[k] != surface->triangle_patch[t]) continue;
      if (k == CW_PLACE_LEADING_EDGE && hypot(middle[0], middle[1]) > survey->sizes.leading_radius) continue;
      double *sum = survey->place_sum[k][bin_of(atan2(middle[1], middle[0]))];
      sum[0] += cw_exact_term(area, survey->area_unit);
      for (int i = 0; i < 3; i++) sum[1 + i] += cw_exact_term(area * middle[i], survey->moment_unit);
    }
    for (int k = 0; k < CW_WALL_COUNT; k++) {
      if (wall[k] != surface->triangle_patch[t]) continue;
      int bin = (int)(hypot(middle[0], middle[1]) / survey->sizes.outlet_radius * CW_SURVEY_RADII);
      if (bin >= CW_SURVEY_RADII) continue;
      survey->wall_sum[k][bin][0] += cw_exact_term(area, survey->area_unit);
      survey->wall_sum[k][bin][1] += cw_exact_term(area * middle[2], survey->moment_unit);
    }
  }
done:
  free(bins);
  return status;
}

void cw_survey_join(CwSurvey *survey, const CwRanks *ranks) {
  cw_ranks_reduce(ranks, survey->place_sum, sizeof survey->place_sum / sizeof(double), MPI_DOUBLE, MPI_SUM);
  cw_ranks_reduce(ranks, survey->wall_sum, sizeof survey->wall_sum / sizeof(double), MPI_DOUBLE, MPI_SUM);
  cw_ranks_reduce(ranks, survey->radius_most, CW_SURVEY_BINS, MPI_DOUBLE, MPI_MAX);
  cw_ranks_reduce(ranks, survey->z_least, CW_SURVEY_BINS, MPI_DOUBLE, MPI_MIN);
  cw_ranks_reduce(ranks, survey->z_most, CW_SURVEY_BINS, MPI_DOUBLE, MPI_MAX);
}

int cw_survey_place(const CwSurvey *survey, CwPlace place, double middle[3]) {
  const double(*sum)[4] = survey->place_sum[place];
  int most = 0;
  for (int k = 1; k < CW_SURVEY_BINS; k++) {
    if (sum[k][0] > sum[most][0]) most = k;
  }
  if (!(sum[most][0] > 0)) return 0;
  // What lies within half a pitch belongs to the same blade.
  int reach = place == CW_PLACE_TONGUE ? CW_SURVEY_BINS / 6 : CW_SURVEY_BINS / (2 * survey->sizes.blade_count);
  double total[4] = {0};
  for (int k = most - reach; k <= most + reach; k++) {
    for (int i = 0; i < 4; i++) total[i] += sum[(k + CW_SURVEY_BINS) % CW_SURVEY_BINS][i];
  }
  for (int i = 0; i < 3; i++) middle[i] = total[1 + i] / total[0];
  return 1;
}

static double reach_at(const CwSurvey *survey, double azimuth) {
  double reach = 0;
  int bin = bin_of(azimuth);
  for (int k = bin - 3; k <= bin + 3; k++)
    reach = fmax(reach, survey->radius_most[(k + CW_SURVEY_BINS) % CW_SURVEY_BINS]);
  return reach;
}

double cw_survey_meridional_azimuth(const CwSurvey *survey) {
  double edge[3], best = 0, best_reach = INFINITY;
  int blades = survey->sizes.blade_count;
  if (!cw_survey_place(survey, CW_PLACE_TRAILING_EDGE, edge)) return 0;
  for (int k = 0; k < blades; k++) {
    double azimuth = atan2(edge[1], edge[0]) + (2 * k + 1) * M_PI / blades;
    double reach = fmax(reach_at(survey, azimuth), reach_at(survey, azimuth + M_PI));
    if (reach < best_reach * (1 - 1e-6)) {
      best_reach = reach;
      best = azimuth;
    }
  }
  return best;
}

int cw_survey_meridional_reach(const CwSurvey *survey, double azimuth, double *radius, double *z_least,
                               double *z_most) {
  *radius = fmax(reach_at(survey, azimuth), reach_at(survey, azimuth + M_PI));
  *z_least = INFINITY;
  *z_most = -INFINITY;
  for (int side = 0; side < 2; side++) {
    int bin = bin_of(azimuth + side * M_PI);
    for (int k = bin - 3; k <= bin + 3; k++) {
      int at = (k + CW_SURVEY_BINS) % CW_SURVEY_BINS;
      *z_least = fmin(*z_least, survey->z_least[at]);
      *z_most = fmax(*z_most, survey->z_most[at]);
    }
  }
  return *radius > 0 && *z_most > *z_least;
}

int cw_survey_wall(const CwSurvey *survey, CwSurveyWall wall, double radius, double *z) {
  int bin = (int)(radius / survey->sizes.outlet_radius * CW_SURVEY_RADII);
  double area = 0, sum = 0;
  for (int k = bin - 2; k <= bin + 2; k++) {
    if (k < 0 || k >= CW_SURVEY_RADII) continue;
    area += survey->wall_sum[wall][k][0];
    sum += survey->wall_sum[wall][k][1];
  }
  if (area > 0) *z = sum / area;
  return area > 0;
}

double cw_survey_span(const CwSurvey *survey, double share, const double x[3]) {
  double radius = hypot(x[0], x[1]), z[CW_WALL_COUNT][2], surface[2];
  // Linear between the middles of two bins.
  double width = survey->sizes.outlet_radius / CW_SURVEY_RADII, at = radius / width - 0.5, below = floor(at);
  for (int end = 0; end < 2; end++) {
    for (int k = 0; k < CW_WALL_COUNT; k++)
      if (!cw_survey_wall(survey, (CwSurveyWall)k, fmax(below + end + 0.5, 0) * width, &z[k][end])) return NAN;
    surface[end] = (1 - share) * z[CW_WALL_HUB][end] + share * z[CW_WALL_SHROUD][end];
  }
  return x[2] - surface[0] - (at - below) * (surface[1] - surface[0]);
}

int cw_survey_has_span(const CwSurvey *survey) {
  for (int k = 0; k < CW_SURVEY_RADII; k++)
    if (survey->wall_sum[CW_WALL_HUB][k][0] > 0 && survey->wall_sum[CW_WALL_SHROUD][k][0] > 0) return 1;
  return 0;
}
