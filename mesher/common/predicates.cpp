// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/predicates.h"

#include <tetgen.h>

namespace {

// Shewchuk's predicates as TetGen has them: adaptive, without its filter for a box of known size (1, 1, 1). TetGen
// prepares them anew, with that filter, wherever it makes a mesh; it does so in a process of its own (tetgen_fill).
struct Prepared {
  Prepared() {
    exactinit(0, 0, 1, 1, 1, 1);
  }
} prepared;

// They take points that are not const, and change none.
double *of(const double x[3]) {
  return const_cast<double *>(x);
}

// Theirs are positive where ours are negative.
int turned_sign(double value) {
  return (value < 0) - (value > 0);
}

} // namespace

int cw_orient3d_exact(const double a[3], const double b[3], const double c[3], const double d[3]) {
  return turned_sign(orient3d(of(a), of(b), of(c), of(d)));
}

int cw_insphere_exact(const double a[3], const double b[3], const double c[3], const double d[3], const double e[3]) {
  return turned_sign(insphere(of(a), of(b), of(c), of(d), of(e)));
}
