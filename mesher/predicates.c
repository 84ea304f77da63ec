// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/predicates.h"

// An expansion is a sum of doubles that do not overlap, in ascending order of size, without zeros (but a single zero for
// nothing): the last one has the sign of the sum.

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
    if (j == n || (i < m && fabs(e[i]) < fabs(f[j]))) next = e[i++];
    else next = f[j++];
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

// Longest expansions: differences 2, minors of two rows 16, of three rows 192, squares of distances 24, terms of the
// fourth order 9216.
enum { TWO = 16, THREE = 192, SQUARE = 24, TERM = 2 * THREE * SQUARE };

// h = e f; room for 2 m n, in `spare` too.
static int multiply(int m, const double *e, int n, const double *f, double *h, double *spare) {
  double part[2 * THREE], *from = spare, *to = h;
  int count = 1;
  if (n % 2 == 0) from = h, to = spare; // so that the last sum goes to h
  from[0] = 0.0;
  for (int j = 0; j < n; j++) {
    int length = scale(m, e, f[j], part);
    count = add(count, from, length, part, to);
    double *swap = from;
    from = to;
    to = swap;
  }
  return count;
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

static int square_of(const Short v[3], double h[SQUARE]) {
  double s[3][8], pair[16], spare[8];
  int n[3];
  for (int i = 0; i < 3; i++) n[i] = multiply(v[i].n, v[i].c, v[i].n, v[i].c, s[i], spare);
  int count = add(n[0], s[0], n[1], s[1], pair);
  return add(count, pair, n[2], s[2], h);
}

int cw_insphere_exact(const double a[3], const double b[3], const double c[3], const double d[3], const double e[3]) {
  const double *corner[4] = {a, b, c, d};
  Short row[4][3];
  double term[TERM], spare[TERM], sum[2][4 * TERM];
  for (int k = 0; k < 4; k++) from_to(e, corner[k], row[k]);
  int count = 1;
  sum[0][0] = 0.0;
  for (int k = 0; k < 4; k++) {
    Minor3 minor;
    double square[SQUARE];
    minor3(row[(k + 1) % 4], row[(k + 2) % 4], row[(k + 3) % 4], &minor);
    int n = square_of(row[k], square);
    n = multiply(minor.n, minor.c, n, square, term, spare);
    if (k % 2) turn(n, term);
    count = add(count, sum[k % 2], n, term, sum[(k + 1) % 2]);
  }
  return sign_of(count, sum[0]);
}
