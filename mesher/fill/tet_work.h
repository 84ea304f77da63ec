// SPDX-License-Identifier: AGPL-3.0-or-later
// The improvement of tetrahedra: its state and the list of what is to be improved. Operators (tet_reconnect, tet_move,
// tet_insert, tet_shorten, tet_relax) change the mesh through it, so that qualities and list stay true.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/fill.h"
#include "mesher/fill/tet_quality.h"
#include "mesher/fill/tet_topology.h"

enum { CW_STAR = 96 };                   // tetrahedra of a point that is moved or taken away, at most
enum { CW_TET_NO_PASS = (1 << 30) - 1 }; // of a tetrahedron that no pass has put into a list

typedef struct {
  int32_t *tet, count, capacity;
} CwTetList;

// In the mesh, the pass of a tetrahedron is the one that put it into the list for the next, the mark of a point the
// pass in which something changed at it.
typedef struct {
  CwTetMesh *mesh; // the caller's
  int32_t fixed_count,
      source_count;            // points with sources below the first stay; new points have those from the second on
  double limit;                // quality below which tetrahedra are in the list
  double insert, insert_round; // and those for which a new point is tried, and at places round about
  uint32_t pass;
  CwTetList bad, next; // to look at in this pass; in the next one
  CwTetList *changed;  // where not NULL, gets all that changes
  CwTetChanges count;
} CwTetWork;

static inline const double *cw_tet_at(const CwTetWork *w, int32_t p) {
  return w->mesh->point[p].x;
}

static inline double cw_tet_square_of(const CwTetWork *w, int32_t p, int32_t q) {
  const double *x = cw_tet_at(w, p), *y = cw_tet_at(w, q);
  double u = y[0] - x[0], v = y[1] - x[1], z = y[2] - x[2];
  return u * u + v * v + z * z;
}

static inline double cw_tet_quality_of(const CwTetWork *w, int32_t a, int32_t b, int32_t c, int32_t d) {
  return cw_tet_quality(cw_tet_at(w, a), cw_tet_at(w, b), cw_tet_at(w, c), cw_tet_at(w, d));
}

// Whether something changed at a point of a tetrahedron in this pass or the one before.
static inline int cw_tet_has_changed(const CwTetWork *w, int32_t t) {
  for (int i = 0; i < 4; i++) {
    if (w->mesh->point[w->mesh->tet[t].corner[i]].mark + 1 >= w->pass) return 1;
  }
  return 0;
}

// Prefetches the neighbours of one that comes a little later in the list, and one that comes later still. Always
// inline, since compilers drop calls of what only prefetches.
static inline __attribute__((always_inline)) void cw_tet_prefetch_list(const CwTetWork *w, const int32_t *list,
                                                                       int32_t count, int32_t k) {
  const CwTet *tet = w->mesh->tet;
  if (k + 16 < count) cw_tet_prefetch_links(&tet[list[k + 16]]);
  if (k + 8 < count) {
    for (int i = 0; i < 4; i++) {
      int32_t next = tet[list[k + 8]].neighbour[i];
      if (next >= 0) cw_tet_prefetch_links(&tet[next / 4]);
    }
  }
}

// Frees what belongs to the work, not its mesh.
void cw_tet_work_free(CwTetWork *w);

CwStatus cw_tet_list_push(CwTetList *list, int32_t t);
// Puts a tetrahedron into the list for the next pass, once.
CwStatus cw_tet_push(CwTetWork *w, int32_t t);
// Keeps a new quality, and the tetrahedron in mind where it is below the limit.
CwStatus cw_tet_set_quality(CwTetWork *w, int32_t t, double quality);
CwStatus cw_tet_replace(CwTetWork *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                        const double *quality);
// The same where all that comes is positive and of this quality at least; then *replaced goes up by one.
CwStatus cw_tet_replace_sound(CwTetWork *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                              double least, int32_t *replaced);
