// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/predicates.h"

// An expansion is a sum of doubles that do not overlap, in ascending order of size, without zeros (but a
// single zero for nothing): the last one has the sign of the sum.

// sum + *error = a + b exactly.
static inline double two_sum(double a, double b, double *error) {
  double sum = a + b, part = sum - a;
  *error = (a - (sum - part)) + (b - part);
  return sum;
}

static inline void halves(double a, double *high, double *low) {
  double c = 134217729.0 * a; // 2^27 + 1
  *high = c - (c - a);
  *low = a - *high;
}

// product + *error = a b exactly.
static inline double two_product(double a, double b, double *error) {
  double product = a * b, ah, al, bh, bl;
  halves(a, &ah, &al);
  halves(b, &bh, &bl);
  *error = al * bl - (((product - ah * bh) - al * bh) - ah * bl);
  return product;
}

static int difference(double a, double b, double h[2]) {
  double low, high = two_sum(a, -b, &low);
  int n = 0;
  if (low != 0.0) h[n++] = low;
  if (high != 0.0 || n == 0) h[n++] = high;
  return n;
}

// h = e + f; room for m + n.
static int add(int m, const double *e, int n, const double *f, double *h) {
  int i = 0, j = 0, count = 0;
  double sum = 0.0;
  while (i < m || j < n) {
    double next, error;
    if (j == n || (i < m && fabs(e[i]) < fabs(f[j])))
      next = e[i++];
    else
      next = f[j++];
    sum = two_sum(sum, next, &error);
    if (error != 0.0) h[count++] = error;
  }
  if (sum != 0.0 || count == 0) h[count++] = sum;
  return count;
}

// h = b e; room for 2 m.
static int scale(int m, const double *e, double b, double *h) {
  int count = 0;
  double error, sum = two_product(e[0], b, &error);
  if (error != 0.0) h[count++] = error;
  for (int i = 1; i < m; i++) {
    double low, high = two_product(e[i], b, &low);
    double middle = two_sum(sum, low, &error);
    if (error != 0.0) h[count++] = error;
    sum = two_sum(high, middle, &error);
    if (error != 0.0) h[count++] = error;
  }
  if (sum != 0.0 || count == 0) h[count++] = sum;
  return count;
}

static void turn(int m, double *e) {
  for (int i = 0; i < m; i++) e[i] = -e[i];
}

static int sign_of(int m, const double *e) {
  return (e[m - 1] > 0.0) - (e[m - 1] < 0.0);
}

// Longest expansions: differences 2, minors of two rows 16, of three rows 192; that times a difference 768,
// twice 3072.
enum { TWO = 16, THREE = 192, FOUR = 4 * THREE, FIVE = 4 * FOUR };

// h = e f for f of one or two parts; room for 2 m n, in `spare` too.
static int multiply(int m, const double *e, int n, const double *f, double *h, double *spare) {
  if (n == 1) return scale(m, e, f[0], h);
  int low = scale(m, e, f[0], spare), high = scale(m, e, f[1], spare + low);
  return add(low, spare, high, spare + low, h);
}

typedef struct {
  int n;
  double c[2];
} Short;

typedef struct {
  int n;
  double c[TWO];
} Minor2;

typedef struct {
  int n;
  double c[THREE];
} Minor3;

// ax by - bx ay
static void minor2(const Short a[3], const Short b[3], int i, int j, Minor2 *m) {
  double p[8], q[8], spare[8];
  int np = multiply(a[i].n, a[i].c, b[j].n, b[j].c, p, spare);
  int nq = multiply(b[i].n, b[i].c, a[j].n, a[j].c, q, spare);
  turn(nq, q);
  m->n = add(np, p, nq, q, m->c);
}

// Determinant of rows a, b, c.
static void minor3(const Short a[3], const Short b[3], const Short c[3], Minor3 *m) {
  Minor2 bc, ca, ab;
  double p[64], q[64], r[64], pq[128], spare[64];
  minor2(b, c, 0, 1, &bc);
  minor2(c, a, 0, 1, &ca);
  minor2(a, b, 0, 1, &ab);
  int np = multiply(bc.n, bc.c, a[2].n, a[2].c, p, spare);
  int nq = multiply(ca.n, ca.c, b[2].n, b[2].c, q, spare);
  int nr = multiply(ab.n, ab.c, c[2].n, c[2].c, r, spare);
  int npq = add(np, p, nq, q, pq);
  m->n = add(npq, pq, nr, r, m->c);
}

static void from_to(const double a[3], const double b[3], Short d[3]) {
  for (int i = 0; i < 3; i++) d[i].n = difference(b[i], a[i], d[i].c);
}

int cw_orient3d_exact(const double a[3], const double b[3], const double c[3], const double d[3]) {
  Short row[3][3];
  Minor3 det;
  from_to(a, b, row[0]);
  from_to(a, c, row[1]);
  from_to(a, d, row[2]);
  minor3(row[0], row[1], row[2], &det);
  return sign_of(det.n, det.c);
}

int cw_insphere_exact(const double a[3], const double b[3], const double c[3], const double d[3], const double e[3]) {
  const double *corner[4] = {a, b, c, d};
  Short row[4][3];
  double once[FOUR], twice[FIVE], spare[FIVE], sum[2][12 * FIVE];
  int count = 1, now = 0;
  sum[0][0] = 0.0;
  for (int k = 0; k < 4; k++) from_to(e, corner[k], row[k]);
  for (int k = 0; k < 4; k++) {
    Minor3 minor;
    minor3(row[(k + 1) % 4], row[(k + 2) % 4], row[(k + 3) % 4], &minor);
    if (k % 2) turn(minor.n, minor.c);
    for (int i = 0; i < 3; i++) {
      int n = multiply(minor.n, minor.c, row[k][i].n, row[k][i].c, once, spare);
      n = multiply(n, once, row[k][i].n, row[k][i].c, twice, spare);
      count = add(count, sum[now], n, twice, sum[1 - now]);
      now = 1 - now;
    }
  }
  return sign_of(count, sum[now]);
}

// A number as the sum of two doubles, right to about 2^-102 of the numbers that made it.
typedef struct {
  double high, low;
} Pair;

static inline Pair pair_of(double a, double b) {
  Pair r;
  r.high = a + b;
  r.low = b - (r.high - a);
  return r;
}

static inline Pair pair_minus(Pair a, Pair b) {
  double error, sum = two_sum(a.high, -b.high, &error);
  return pair_of(sum, error + (a.low - b.low));
}

static inline Pair pair_plus(Pair a, Pair b) {
  double error, sum = two_sum(a.high, b.high, &error);
  return pair_of(sum, error + (a.low + b.low));
}

static inline Pair pair_times(Pair a, Pair b) {
  double error, product = two_product(a.high, b.high, &error);
  return pair_of(product, error + (a.high * b.low + a.low * b.high));
}

int cw_insphere_close(const double a[3], const double b[3], const double c[3], const double d[3], const double e[3]) {
  const double *corner[4] = {a, b, c, d};
  Pair v[4][3], square[4], det = {0.0, 0.0};
  double size = 0.0;
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < 3; i++) v[k][i].high = two_sum(corner[k][i], -e[i], &v[k][i].low);
    square[k] =
        pair_plus(pair_plus(pair_times(v[k][0], v[k][0]), pair_times(v[k][1], v[k][1])), pair_times(v[k][2], v[k][2]));
  }
  for (int k = 0; k < 4; k++) {
    const Pair *p = v[(k + 1) % 4], *q = v[(k + 2) % 4], *r = v[(k + 3) % 4];
    Pair minor = {0.0, 0.0};
    double minor_size = 0.0;
    for (int i = 0; i < 3; i++) {
      int x = (i + 1) % 3, y = (i + 2) % 3;
      Pair s = pair_times(q[x], r[y]), t = pair_times(q[y], r[x]);
      minor = pair_plus(minor, pair_times(p[i], pair_minus(s, t)));
      minor_size += fabs(p[i].high) * (fabs(s.high) + fabs(t.high));
    }
    Pair term = pair_times(minor, square[k]);
    det = k % 2 ? pair_minus(det, term) : pair_plus(det, term);
    size += minor_size * square[k].high;
  }
  // Some twenty operations deep, each within 2^-101.
  if (fabs(det.high) > 0x1p-94 * size) return det.high > 0.0 ? 1 : -1;
  return cw_insphere_exact(a, b, c, d, e);
}
