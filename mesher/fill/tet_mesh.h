// SPDX-License-Identifier: AGPL-3.0-or-later
// A mesh of tetrahedra that can be changed in place: who has which corners and neighbours. What changes one tetrahedron
// or a cavity of them goes through tet_topology.h; the mesh owns its arrays.
//
//   corner[i] is opposite face i; face i has the corners cw_tet_face[i], counter-clockwise from outside;
//   neighbour[i] = 4 * other + its face, so that mesh->tet[other].neighbour[face] = 4 * tet + i.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_ENCLOSING_POINTS = 4 }; // the first points of a Delaunay mesh, of a tetrahedron that encloses all others
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
      double quality; // while tetrahedra are improved
      uint32_t star;  // the last star or cavity that it was in, by the mesh's count of these
      unsigned pass;  // the list that it was put into last
    };
  };
  int32_t corner[4];    // positive: (x1 - x0) x (x2 - x0) . (x3 - x0) > 0; corner[0] = -1: a free place
  int32_t neighbour[4]; // 4 * tetrahedron + its face, at the face opposite each corner; else CW_BESIDE_...
} CwTet;

typedef struct {
  double x[3];
  uint64_t mark; // while points are connected: insertion number and local number of the last cavity that it bounded;
                 // while tetrahedra are improved: the pass in which something changed at it
} CwTetPoint;

typedef struct {
  int32_t point_count, point_capacity; // with the enclosing ones, where there are such
  CwTetPoint *point;                   // in the order of insertion
  int32_t *source;                     // the given point that each is; -1 for the enclosing ones
  int32_t tet_count, tet_capacity;     // with free places
  CwTet *tet;
  int32_t spare;  // 1 + the free place to use next, 0: none; corner[1] of each leads on likewise
  uint32_t stars; // so many stars and cavities were marked
  int32_t duplicate_count;
  int32_t (*duplicate)[2]; // given points that were left out, and the one at the same place
} CwTetMesh;

void cw_tet_mesh_free(CwTetMesh *mesh);

// Which corner the point is, or -1.
static inline int cw_tet_corner_of(const CwTet *tet, int32_t point) {
  int i = 3;
  while (i >= 0 && tet->corner[i] != point) i--;
  return i;
}

// Prefetches the tetrahedron so many places behind. Nothing is read, so that there need be none.
static inline void cw_tet_prefetch(const CwTet *tet, int64_t ahead) {
  __builtin_prefetch((const void *)((uintptr_t)tet + (uintptr_t)(ahead * (int64_t)sizeof *tet)), 1);
}

// Prefetches its corners and neighbours, which may lie in two lines of the cache.
static inline void cw_tet_prefetch_links(const CwTet *tet) {
  __builtin_prefetch(tet->corner, 1);
  __builtin_prefetch(&tet->neighbour[3], 1);
}

// For passes over all tetrahedra, in their order: prefetches one that comes a little later. Processors do so by
// themselves within a page only, which is 64 of them.
static inline void cw_tet_prefetch_ahead(const CwTet *tet) {
  cw_tet_prefetch(tet, 32);
}

// A free place for a tetrahedron; the caller fills it.
CwStatus cw_tet_mesh_new_tet(CwTetMesh *mesh, int32_t *tet);
void cw_tet_mesh_free_tet(CwTetMesh *mesh, int32_t tet);
// Room for tetrahedra, in which those there are stay. The first `sure` ones, which are certain to come, are asked for
// in large pages: thousands of small ones would take a tenth of the time to connect points.
CwStatus cw_tet_mesh_make_room(CwTetMesh *mesh, int64_t capacity, int64_t sure);
// Moves all tetrahedra to the front, in their order, without what they note, and gives the memory behind them back.
void cw_tet_mesh_pack(CwTetMesh *mesh);
// A point that no tetrahedron has yet.
CwStatus cw_tet_mesh_add_point(CwTetMesh *mesh, const double x[3], int32_t source, int32_t *point);

#ifdef __cplusplus
}
#endif
