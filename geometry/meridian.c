// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/meridian.h"

#include <math.h>
#include <string.h>

#include "pipeline/order.h"

static const double gauss_x[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                  0.9061798459386640};
static const double gauss_w[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                  0.2369268850561891};

void cw_meridian_point(const CwMeridianCurve *curve, double t, double x[2], double dx[2]) {
  const double u = 1 - t;
  for (int i = 0; i < 2; i++) {
    const double p0 = curve->pole[0][i], p1 = curve->pole[1][i], p2 = curve->pole[2][i], p3 = curve->pole[3][i];
    x[i] = u * u * u * p0 + 3 * u * u * t * p1 + 3 * u * t * t * p2 + t * t * t * p3;
    if (dx) dx[i] = 3 * (u * u * (p1 - p0) + 2 * u * t * (p2 - p1) + t * t * (p3 - p2));
  }
}

static double curve_speed(const CwMeridianCurve *curve, double t) {
  double x[2], dx[2];
  cw_meridian_point(curve, t, x, dx);
  return hypot(dx[0], dx[1]);
}

static double curve_piece(const CwMeridianCurve *curve, double a, double b) {
  double sum = 0;
  for (int i = 0; i < 5; i++) sum += gauss_w[i] * curve_speed(curve, 0.5 * (a + b) + 0.5 * (b - a) * gauss_x[i]);
  return 0.5 * (b - a) * sum;
}

static void curve_measure(CwMeridianCurve *curve) {
  curve->length[0] = 0;
  for (int i = 0; i < CW_MERIDIAN_STEPS; i++)
    curve->length[i + 1] =
        curve->length[i] + curve_piece(curve, (double)i / CW_MERIDIAN_STEPS, (double)(i + 1) / CW_MERIDIAN_STEPS);
}

double cw_meridian_length(const CwMeridianCurve *curve, double t) {
  int i = (int)(t * CW_MERIDIAN_STEPS);
  i = i < 0 ? 0 : i > CW_MERIDIAN_STEPS ? CW_MERIDIAN_STEPS : i;
  return curve->length[i] + curve_piece(curve, (double)i / CW_MERIDIAN_STEPS, t);
}

double cw_meridian_parameter(const CwMeridianCurve *curve, double length) {
  const int low = cw_interval_of(CW_MERIDIAN_STEPS + 1, curve->length, length), high = low + 1;
  double t = (low + (length - curve->length[low]) / (curve->length[high] - curve->length[low])) / CW_MERIDIAN_STEPS;
  for (int i = 0; i < 4; i++)
    t -= (curve->length[low] + curve_piece(curve, (double)low / CW_MERIDIAN_STEPS, t) - length) / curve_speed(curve, t);
  return t;
}

// Arc length where the curve passes a radius, going downstream; the radius grows along the curve there. mm: millimetres
// in a unit.
static CwStatus curve_at_radius(const CwMeridianCurve *curve, double radius, double mm, const char *what,
                                double *length) {
  CwStatus status = CW_OK;
  double low = 0, high = 1, x[2];
  CW_REQUIRE(radius > curve->pole[0][0] && radius < curve->pole[3][0], CW_ERR_DESIGN,
             "the %s has the radius %.3f mm; allowed: between %.3f and %.3f mm", what, radius * mm,
             curve->pole[0][0] * mm, curve->pole[3][0] * mm);
  for (int i = 0; i < 60; i++) {
    const double middle = 0.5 * (low + high);
    cw_meridian_point(curve, middle, x, NULL);
    *(x[0] < radius ? &low : &high) = middle;
  }
  *length = cw_meridian_length(curve, 0.5 * (low + high));
done:
  return status;
}

void cw_meridian_walls(const CwDesign *design, double hub_radial, double shroud_axial, double shroud_radial,
                       CwMeridianCurve *hub, CwMeridianCurve *shroud) {
  const double r1 = design->inlet_diameter / 2, r2 = design->outlet_diameter / 2, ri = design->interface_radius;
  const double rn = design->hub_diameter / 2, half = design->outlet_width / 2, axial = design->axial_length;
  const double pole[2][4][2] = {
      {{rn, half - CW_MERIDIAN_HUB_START * axial}, {rn, half}, {rn + hub_radial * (r1 - rn), half}, {ri, half}},
      {{r1, -half - axial}, {r1, -half - shroud_axial * axial}, {r1 + shroud_radial * (r2 - r1), -half}, {ri, -half}}};
  memcpy(hub->pole, pole[0], sizeof hub->pole);
  memcpy(shroud->pole, pole[1], sizeof shroud->pole);
}

CwStatus cw_meridian_make(const CwDesign *design, CwMeridian *meridian) {
  CwStatus status = CW_OK;
  const double r1 = design->inlet_diameter / 2, r2 = design->outlet_diameter / 2, ri = design->interface_radius;
  const double rn = design->hub_diameter / 2, mm = 1e3 * design->unit;
  CW_REQUIRE(rn < r1 && r1 < r2 && r2 < ri, CW_ERR_DESIGN,
             "hub %.3f, inlet %.3f, outlet %.3f and interface %.3f mm (radii) must grow in this order: change "
             "hub_diameter_mm, inlet_diameter_mm, outlet_diameter_mm or base_diameter_mm",
             rn * mm, r1 * mm, r2 * mm, ri * mm);
  cw_meridian_walls(design, design->hub_pole_radial, design->shroud_pole_axial, design->shroud_pole_radial,
                    &meridian->hub, &meridian->shroud);
  curve_measure(&meridian->hub);
  curve_measure(&meridian->shroud);
  CW_TRY(curve_at_radius(&meridian->hub, design->leading_edge_radius_hub, mm,
                         "leading edge at the hub (leading_edge_radius_hub_mm)", &meridian->hub_leading));
  CW_TRY(curve_at_radius(&meridian->shroud, design->leading_edge_radius_shroud, mm,
                         "leading edge at the shroud (leading_edge_radius_shroud_mm)", &meridian->shroud_leading));
  CW_TRY(curve_at_radius(&meridian->hub, r2, mm, "trailing edge at the hub", &meridian->hub_trailing));
  CW_TRY(curve_at_radius(&meridian->shroud, r2, mm, "trailing edge at the shroud", &meridian->shroud_trailing));
  meridian->shaft_radius = design->through_shaft_diameter / 2;
  meridian->nut_disk_radius = design->nut_disk_radius;
  meridian->nut_end_z = meridian->hub.pole[0][1] - design->nut_length;
  meridian->inlet_z = meridian->shroud.pole[0][1] - design->suction_pipe_length;
  CW_REQUIRE(meridian->inlet_z < meridian->nut_end_z, CW_ERR_DESIGN,
             "the inlet at z = %.3f mm must lie before the nut's end at z = %.3f mm: raise "
             "suction_pipe_length_mm to more than %.3f",
             meridian->inlet_z * mm, meridian->nut_end_z * mm,
             mm * (design->suction_pipe_length + meridian->inlet_z - meridian->nut_end_z));
done:
  return status;
}

void cw_meridian_blade_point(const CwMeridian *meridian, double s, double q, double x[2], double dx[2]) {
  const double hub_length = meridian->hub_trailing - meridian->hub_leading;
  const double shroud_length = meridian->shroud_trailing - meridian->shroud_leading;
  double h[2], dh[2], c[2], dc[2];
  cw_meridian_point(&meridian->hub, cw_meridian_parameter(&meridian->hub, meridian->hub_leading + q * hub_length), h,
                    dh);
  cw_meridian_point(&meridian->shroud,
                    cw_meridian_parameter(&meridian->shroud, meridian->shroud_leading + q * shroud_length), c, dc);
  const double sh = hub_length / hypot(dh[0], dh[1]), ss = shroud_length / hypot(dc[0], dc[1]);
  for (int i = 0; i < 2; i++) {
    x[i] = (1 - s) * h[i] + s * c[i];
    if (dx) dx[i] = (1 - s) * dh[i] * sh + s * dc[i] * ss;
  }
}

double cw_meridian_area(const CwMeridian *meridian, double q) {
  double h[2], c[2], x[2], flow[2];
  cw_meridian_blade_point(meridian, 0, q, h, NULL);
  cw_meridian_blade_point(meridian, 1, q, c, NULL);
  cw_meridian_blade_point(meridian, 0.5, q, x, flow);
  // Of the line between hub and shroud the flow sees what lies square to it.
  return M_PI * (h[0] + c[0]) * fabs((h[0] - c[0]) * flow[1] - (h[1] - c[1]) * flow[0]) / hypot(flow[0], flow[1]);
}

double cw_meridian_curvature(const CwMeridianCurve *curve, double t) {
  double x[2], dx[2], ddx[2];
  cw_meridian_point(curve, t, x, dx);
  for (int k = 0; k < 2; k++)
    ddx[k] = 6 * ((1 - t) * (curve->pole[2][k] - 2 * curve->pole[1][k] + curve->pole[0][k]) +
                  t * (curve->pole[3][k] - 2 * curve->pole[2][k] + curve->pole[1][k]));
  const double speed = hypot(dx[0], dx[1]);
  return fabs(dx[0] * ddx[1] - dx[1] * ddx[0]) / (speed * speed * speed);
}

double cw_meridian_bend_radius(const CwMeridianCurve *curve) {
  double largest = 0;
  for (int i = 1; i < CW_MERIDIAN_STEPS; i++)
    largest = fmax(largest, cw_meridian_curvature(curve, (double)i / CW_MERIDIAN_STEPS));
  return 1 / largest;
}

// Integral of pi r^2 dz along a curve from t = 0 to t = 1 (exact: a polynomial of degree 8).
static double curve_swept_volume(const CwMeridianCurve *curve) {
  double sum = 0;
  for (int i = 0; i < 5; i++) {
    double x[2], dx[2];
    cw_meridian_point(curve, 0.5 + 0.5 * gauss_x[i], x, dx);
    sum += gauss_w[i] * x[0] * x[0] * dx[1];
  }
  return 0.5 * M_PI * sum;
}

double cw_meridian_volume(const CwMeridian *meridian) {
  const double ri = meridian->hub.pole[3][0], r1 = meridian->shroud.pole[0][0], rn = meridian->hub.pole[0][0];
  const double d = meridian->nut_disk_radius, a = rn - d, l = meridian->hub.pole[0][1] - meridian->nut_end_z;
  // Quarter ellipse r = d + a sin x, z = -l cos x: pi (d^2 l + 2 d a l pi/4 + a^2 l 2/3).
  const double nut = M_PI * l * (d * d + d * a * M_PI / 2 + a * a * 2 / 3);
  return M_PI * r1 * r1 * (meridian->shroud.pole[0][1] - meridian->inlet_z) + curve_swept_volume(&meridian->shroud) +
         M_PI * ri * ri * (meridian->hub.pole[3][1] - meridian->shroud.pole[3][1]) -
         curve_swept_volume(&meridian->hub) - nut -
         M_PI * meridian->shaft_radius * meridian->shaft_radius * (meridian->nut_end_z - meridian->inlet_z);
}
