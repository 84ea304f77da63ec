// SPDX-License-Identifier: AGPL-3.0-or-later
// Delaunay tetrahedra of points: incremental insertion (Bowyer, Watson) in a biased randomised order along
// Hilbert's curve, with exact signs. The points lie inside one large tetrahedron, whose corners are points 0
// to 3 here.
#ifndef CUTWATER_MESHER_FILL_DELAUNAY_H
#define CUTWATER_MESHER_FILL_DELAUNAY_H

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_DELAUNAY_CORNERS = 4 }; // of the enclosing tetrahedron
// In place of a neighbour: there is none in this mesh, but there are cells of the whole one; there are none at all.
enum { CW_BESIDE_OTHERS = -1, CW_BESIDE_NOTHING = -2 };

// While points are connected a tetrahedron has its circumscribed sphere (sphere.h); afterwards the place of that is
// used for what the boundary's recovery, the flood from outside and the improvement note. 48 bytes, a quarter less than
// with spheres in double precision.
typedef struct {
  union {
    struct {
      float centre[3];
      union {
        float radius_square; // not a number where the sphere is not known well enough
        uint32_t mark;       // the flood's, see kernel.c; the highest bit is the sign, which no square has
      };
    };
    struct {
      union {
        uint64_t stamp; // of the last star, while the boundary is recovered
        double quality; // while tetrahedra are improved
      };
      uint32_t star; // a stamp beside a quality
      unsigned pass : 30, weight : 2;
    };
  };
  int32_t corner[4];    // positive: (x1 - x0) x (x2 - x0) . (x3 - x0) > 0; corner[0] = -1: a free place
  int32_t neighbour[4]; // 4 * tetrahedron + its face, at the face opposite each corner; else CW_BESIDE_...
} CwDelaunayTet;

typedef struct {
  double x[3];
  uint64_t mark; // inner use: insertion number and local number of the last cavity that it bounded
} CwDelaunayPoint;

typedef struct {
  int32_t point_count, point_space; // given ones and the four corners
  CwDelaunayPoint *point;           // in the order of insertion
  int32_t *source;                  // the given point that each is; -1 for the corners
  int32_t tet_count, tet_space;     // with free places
  CwDelaunayTet *tet;
  int32_t spare; // 1 + the free place to use next, 0: none; corner[1] of each leads on likewise
  int32_t duplicate_count;
  int32_t (*duplicate)[2]; // given points that were left out, and the one at the same place
} CwDelaunay;

// Empty sphere of every tetrahedron, exactly; ties are broken by the order of insertion. Deterministic.
// Memory: 48 bytes a tetrahedron and 36 a point.
CwStatus cw_delaunay_make(int32_t count, const double (*x)[3], CwDelaunay *mesh);
// The same in two steps: after the first the mesh has its own copy of the points, and x may be freed before
// the tetrahedra take their memory. Each leaves the mesh empty where it fails.
CwStatus cw_delaunay_order(int32_t count, const double (*x)[3], CwDelaunay *mesh);
CwStatus cw_delaunay_connect(CwDelaunay *mesh);
void cw_delaunay_free(CwDelaunay *mesh);

// Which corner the point is, or -1.
static inline int cw_delaunay_corner_of(const CwDelaunayTet *tet, int32_t point) {
  int i = 3;
  while (i >= 0 && tet->corner[i] != point) i--;
  return i;
}

// Asks the memory for the tetrahedron so many places behind. Nothing is read, so that there need be none.
static inline void cw_delaunay_ask(const CwDelaunayTet *tet, int64_t ahead) {
  __builtin_prefetch((const void *)((uintptr_t)tet + (uintptr_t)(ahead * (int64_t)sizeof *tet)), 1);
}

// For its corners and neighbours, which may lie in two lines of the cache.
static inline void cw_delaunay_ask_links(const CwDelaunayTet *tet) {
  __builtin_prefetch(tet->corner, 1);
  __builtin_prefetch(&tet->neighbour[3], 1);
}

// For passes over all tetrahedra, in their order: asks for one that comes a little later. Processors do so by
// themselves within a page only, which is 64 of them.
static inline void cw_delaunay_ask_ahead(const CwDelaunayTet *tet) {
  cw_delaunay_ask(tet, 32);
}

// A free place for a tetrahedron; the caller fills it.
CwStatus cw_delaunay_new_tet(CwDelaunay *mesh, int32_t *tet);
void cw_delaunay_free_tet(CwDelaunay *mesh, int32_t tet);
// Moves all tetrahedra to the front, in their order, without their spheres, and gives the memory behind them back.
void cw_delaunay_pack(CwDelaunay *mesh);
// A point that no tetrahedron has yet.
CwStatus cw_delaunay_add_point(CwDelaunay *mesh, const double x[3], int32_t source, int32_t *point);

#ifdef __cplusplus
}
#endif
#endif
