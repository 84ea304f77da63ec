// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/meridian_shape.h"

#include <math.h>
#include <string.h>

#include "geometry/meridian.h"
#include "geometry/meridian_passage.h"

enum { SHARES = 3, STATIONS = 49, ROUNDS = 120 };

static const double LEAST_BEND = 0.62; // 0.6 is wanted, of the curve and not of samples
static const double least_share[SHARES] = {0.2, 0.02, 0}, largest_share[SHARES] = {3, 0.95, 0.8};

// Radii of the hub's poles grow, or the hub would reach out beyond the interface and come back; its last piece keeps a
// tenth of the way, for the tangent at its end.
static double largest_of(const CwDesign *design, int share) {
  const double hub = design->hub_diameter / 2, way = design->interface_radius - hub;
  return share > 0 ? largest_share[share] : fmin(largest_share[0], 0.9 * way / (design->inlet_diameter / 2 - hub));
}

typedef struct {
  const CwDesign *design;
  const double *given; // of every share, NAN where it is free
} Problem;

// Integral of the squared curvature along a wall, 1/m; `sharpest`: raised to its largest curvature.
static double bending(const CwMeridianCurve *curve, double *sharpest) {
  enum { POINTS = 48 };
  double sum = 0;
  for (int i = 0; i < POINTS; i++) {
    const double t = (i + 0.5) / POINTS;
    double x[2], dx[2];
    cw_meridian_point(curve, t, x, dx);
    const double curvature = cw_meridian_curvature(curve, t);
    *sharpest = fmax(*sharpest, curvature);
    sum += curvature * curvature * hypot(dx[0], dx[1]) / POINTS;
  }
  return sum;
}

// The walls' bending, and penalties where the area steps back or grows (falls) by less than a tenth of its mean pace,
// and where a wall bends with a radius of less than LEAST_BEND of the passage's height at the leading edge. The latter
// is linear: it holds the bound where that can be met, and gives nothing else up for it where it cannot.
static double cost(const Problem *problem, const double at[SHARES]) {
  const CwDesign *design = problem->design;
  CwMeridianCurve hub, shroud;
  CwPassageStation station[STATIONS];
  double share[SHARES], outside = 0, back = 0, sharpest = 0;
  for (int i = 0; i < SHARES; i++) {
    share[i] =
        cw_case_given(problem->given[i]) ? problem->given[i] : fmin(largest_of(design, i), fmax(least_share[i], at[i]));
    outside += pow(at[i] - share[i], 2);
  }
  cw_meridian_walls(design, share[0], share[1], share[2], &hub, &shroud);
  cw_meridian_passage(&hub, &shroud, design->outlet_diameter / 2, STATIONS, station);
  const double first = station[0].area, change = station[STATIONS - 1].area - first, trend = change < 0 ? -1 : 1;
  for (int i = 1; i < STATIONS; i++) {
    const double step = trend * (station[i].area - station[i - 1].area);
    const double lacking = fmax(0, 0.1 * fabs(change) / (STATIONS - 1) - step) / first;
    back += (STATIONS - 1) * lacking * lacking;
  }
  const double bent = bending(&hub, &sharpest) + bending(&shroud, &sharpest);
  const CwPassageStation edge = cw_meridian_passage_at(&hub, &shroud, design->leading_edge_radius_shroud);
  const double tight = fmax(0, LEAST_BEND * edge.height * sharpest - 1);
  return 0.5 * (design->inlet_diameter - design->hub_diameter) * bent + 1e4 * back + 30 * tight + 100 * outside;
}

typedef struct {
  double at[SHARES], value;
} Corner;

// Nelder and Mead, A simplex method for function minimization, Computer Journal 7 (1965), from `best` on.
static double descend(const Problem *problem, double best[SHARES]) {
  static const double step[SHARES] = {0.3, 0.1, 0.1};
  Corner corner[SHARES + 1], *const worst = &corner[SHARES];
  for (int i = 0; i <= SHARES; i++) {
    memcpy(corner[i].at, best, sizeof corner[i].at);
    if (i > 0) corner[i].at[i - 1] += step[i - 1];
    corner[i].value = cost(problem, corner[i].at);
  }
  for (int round = 0; round < ROUNDS; round++) {
    for (int i = 1; i <= SHARES; i++) // sorted, the best first
      for (int j = i; j > 0 && corner[j].value < corner[j - 1].value; j--) {
        const Corner kept = corner[j];
        corner[j] = corner[j - 1];
        corner[j - 1] = kept;
      }
    double size = 0, centre[SHARES] = {0};
    for (int i = 0; i < SHARES; i++)
      for (int k = 0; k < SHARES; k++) {
        centre[k] += corner[i].at[k] / SHARES;
        size = fmax(size, fabs(corner[i + 1].at[k] - corner[0].at[k]));
      }
    if (size < 2e-4) break;
    Corner mirrored, further = {.value = HUGE_VAL};
    for (int k = 0; k < SHARES; k++) mirrored.at[k] = 2 * centre[k] - worst->at[k];
    mirrored.value = cost(problem, mirrored.at);
    // Further out where the mirrored corner is the best, else back towards the centre where it is no better than
    // others.
    const double reach = mirrored.value < corner[0].value ? 2 : mirrored.value < worst->value ? 0.5 : -0.5;
    if (mirrored.value < corner[0].value || mirrored.value >= corner[SHARES - 1].value) {
      for (int k = 0; k < SHARES; k++) further.at[k] = centre[k] + reach * (centre[k] - worst->at[k]);
      further.value = cost(problem, further.at);
    }
    if (further.value < fmin(mirrored.value, worst->value)) {
      *worst = further;
    } else if (mirrored.value < worst->value) {
      *worst = mirrored;
    } else {
      for (int i = 1; i <= SHARES; i++) {
        for (int k = 0; k < SHARES; k++) corner[i].at[k] = 0.5 * (corner[i].at[k] + corner[0].at[k]);
        corner[i].value = cost(problem, corner[i].at);
      }
    }
  }
  const Corner *least = corner;
  for (int i = 1; i <= SHARES; i++)
    if (corner[i].value < least->value) least = &corner[i];
  memcpy(best, least->at, sizeof least->at);
  return least->value;
}

void cw_meridian_shape(const CwImpellerTable *table, CwDesign *design) {
  // A shroud that begins to turn late, and one that turns early: between them the penalty may have a ridge.
  static const double start[3][SHARES] = {{1.8, 0.7, 0.05}, {1.8, 0.2, 0.5}, {2.2, 0.1, 0.7}};
  const double given[SHARES] = {table->hub_pole_radial, table->shroud_pole_axial, table->shroud_pole_radial};
  const Problem problem = {design, given};
  double best[SHARES] = {0}, least = HUGE_VAL;
  for (int i = 0; i < 3; i++) {
    double found[SHARES];
    for (int k = 0; k < SHARES; k++) found[k] = cw_case_given(given[k]) ? given[k] : start[i][k];
    descend(&problem, found);
    const double value = descend(&problem, found); // a simplex that has become flat begins anew
    if (value < least) memcpy(best, found, sizeof best);
    least = fmin(least, value);
  }
  static const int quantity[SHARES] = {CW_DESIGN_hub_pole_radial, CW_DESIGN_shroud_pole_axial,
                                       CW_DESIGN_shroud_pole_radial};
  double *share[SHARES] = {&design->hub_pole_radial, &design->shroud_pole_axial, &design->shroud_pole_radial};
  for (int i = 0; i < SHARES; i++) {
    const int open = !cw_case_given(given[i]);
    *share[i] = open ? round(1e3 * fmin(largest_of(design, i), fmax(least_share[i], best[i]))) / 1e3 : given[i];
    design->source[quantity[i]] = open ? "monotone passage area with the least bending" : "case";
    design->asked[quantity[i]] = NAN;
  }
}
