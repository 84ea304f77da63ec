// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/root.h"

#include <math.h>

double cw_root_find(CwRootFunction f, const void *context, double a, double b) {
  double fa = f(a, context), fb = f(b, context);
  if (fa == 0) return a;
  if (fb == 0) return b;
  if (!(fa * fb < 0)) return NAN;
  double x = a;
  for (int i = 0; i < 200; i++) {
    double next = b - fb * (b - a) / (fb - fa);
    if (i % 8 == 7) next = 0.5 * (a + b);
    double moved = fabs(next - x);
    x = next;
    double fx = f(x, context);
    if (fx == 0 || fabs(b - a) <= 4e-16 * (fabs(a) + fabs(b)) || (moved <= 1e-16 * fabs(x) && i % 8 != 7)) break;
    if (fx * fb < 0) {
      a = b;
      fa = fb;
    } else {
      fa *= 0.5;
    }
    b = x;
    fb = fx;
  }
  return x;
}
