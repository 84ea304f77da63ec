// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/standard_bore.h"

#include <math.h>
#include <stddef.h>

// Nominal sizes of ISO 6708, mm.
static const int nominal[] = {15,   20,   25,   32,   40,   50,   65,   80,   100,  125,  150,  200,  250,
                              300,  350,  400,  450,  500,  600,  700,  800,  900,  1000, 1200, 1400, 1600,
                              1800, 2000, 2200, 2400, 2600, 2800, 3000, 3200, 3400, 3600, 3800, 4000};
enum { NOMINAL_COUNT = sizeof nominal / sizeof *nominal };

// ISO 3, R10, times ten.
static const double preferred[] = {10, 12.5, 16, 20, 25, 31.5, 40, 50, 63, 80, 100};

// A bore that went through millimetres may be off by a rounding.
static const double SAME = 1 - 1e-12;

double cw_standard_bore(double least) {
  const double wanted = 1e3 * least * SAME;
  if (wanted > 12.5 && wanted <= nominal[NOMINAL_COUNT - 1]) {
    size_t i = 0;
    while (nominal[i] < wanted) i++;
    return nominal[i] / 1e3;
  }
  const double decade = pow(10, floor(log10(wanted)) - 1);
  size_t i = 0;
  while (preferred[i] * decade < wanted) i++;
  return preferred[i] * decade / 1e3;
}
