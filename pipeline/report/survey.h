// SPDX-License-Identifier: AGPL-3.0-or-later
// A first look at the boundary of the mesh, region by region: where the places are that the pictures show,
// and how far each view reaches.
#pragma once

#include "pipeline/mesh/region_read.h"
#include "pipeline/parallel/ranks.h"

enum { CW_SURVEY_BINS = 360, CW_SURVEY_RADII = 64 };

// Places with a patch of their own.
typedef enum { CW_PLACE_LEADING_EDGE, CW_PLACE_TRAILING_EDGE, CW_PLACE_TONGUE, CW_PLACE_COUNT } CwPlace;

// Walls that a passage of the impeller lies between.
typedef enum { CW_WALL_HUB, CW_WALL_SHROUD, CW_WALL_COUNT } CwSurveyWall;

// What the pictures take from case and design, m.
typedef struct {
  int blade_count;       // at the outlet: blades and splitters
  double leading_radius; // no leading edge of a whole blade lies outside it; those of splitters do
  double outlet_radius, interface_radius, base_radius;
  int suction; // -1 or 1: the sign of z on the suction side
} CwPumpSizes;

typedef struct {
  CwPumpSizes sizes;
  double area_unit, moment_unit; // of the sums below, which are exact (exact_sum.h)
  // Faces of each place by their azimuth: sums of area and of area times centroid.
  double place_sum[CW_PLACE_COUNT][CW_SURVEY_BINS][4];
  // Extent of the boundary by azimuth.
  double radius_most[CW_SURVEY_BINS], z_least[CW_SURVEY_BINS], z_most[CW_SURVEY_BINS];
  // Sums of area and of area times z of hub and shroud, by radius up to the outlet.
  double wall_sum[CW_WALL_COUNT][CW_SURVEY_RADII][2];
} CwSurvey;

void cw_survey_start(CwSurvey *survey, const CwPumpSizes *sizes);
// Adds the boundary of a region (surface.h). CW_ERR_MEMORY.
CwStatus cw_survey_add(CwSurvey *survey, const CwMesh *mesh, const CwRegionData *surface);
// All ranks get the survey of the regions of all. Collective.
void cw_survey_join(CwSurvey *survey, const CwRanks *ranks);

// The middle of a place: of the tongue, or of one blade's edge. Returns 0 where the mesh has no such patch.
int cw_survey_place(const CwSurvey *survey, CwPlace place, double middle[3]);

// Azimuth of a plane through the axis that lies midway between two blades at the outlet and cuts the least of
// the discharge. 0 where no trailing edge was found.
double cw_survey_meridional_azimuth(const CwSurvey *survey);

// Reach of the boundary in that plane on both sides of the axis: largest radius, least and greatest z.
// Returns 0 where there is none.
int cw_survey_meridional_reach(const CwSurvey *survey, double azimuth, double *radius, double *z_least, double *z_most);

// z of a wall at `radius`. Returns 0 where there is none.
int cw_survey_wall(const CwSurvey *survey, CwSurveyWall wall, double radius, double *z);

// How far x lies above the surface of revolution that has this share of the way along the axis from hub (0) to shroud
// (1) behind it, m; NAN where one of them is missing at its radius.
double cw_survey_span(const CwSurvey *survey, double share, const double x[3]);
int cw_survey_has_span(const CwSurvey *survey); // whether both walls are there somewhere
