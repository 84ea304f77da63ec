// SPDX-License-Identifier: AGPL-3.0-or-later
// Inner to the improvement of tetrahedra: its state, and the changes that it tries. Each change is made only
// where it raises the least quality of the tetrahedra that it touches.
#ifndef CUTWATER_MESHER_FILL_TET_WORK_H
#define CUTWATER_MESHER_FILL_TET_WORK_H

#include <math.h>
#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/common/four.h"
#include "mesher/common/number.h"
#include "mesher/fill/kernel_flips.h"
#include "mesher/fill/tet_improve.h"
#include "mesher/fill/tet_quality.h"

#ifdef __cplusplus
extern "C" {
#endif

// Quality below which tetrahedra are improved: the sine of 25 (or 155) degrees. More costs time and gives no
// better worst ones.
#define CW_TET_IMPROVE 0.4226
// Longest over shortest edge above which a tetrahedron is slender: its longest edge may go (cw_tet_shorten).
#define CW_TET_LONG 1.6
// The same, once points have been taken away, in regions where very many are.
#define CW_TET_LONG_CROWDED 1.5
// The ratio of a tetrahedron that neither helps nor hinders, so that the number of them does not count.
#define CW_TET_USUAL 1.4
// Least improvement, so that no two changes undo one another for ever.
#define CW_TET_GAIN 1e-6

enum { CW_TET_STAR = 96 };
enum { CW_TET_NO_PASS = (1 << 30) - 1 }; // of a tetrahedron that no pass has put into a list

typedef struct {
  int32_t *tet, count, space;
} CwTetList;

// The pass of a tetrahedron is the one that put it into the list for the next, its star the last one it was in, its
// weight what it counts when edges are made even; the pass in which something changed at a point stands in the point's
// mark.
typedef struct {
  CwFlips flips;
  CwDelaunay *mesh;
  int32_t fixed_count, source_count;
  const uint8_t *on_plane;     // of the fixed points: 1 on a dividing plane; or NULL
  int32_t tet_count;           // without free places, when all were judged first
  uint32_t stamp;              // of the last star
  double limit;                // quality below which tetrahedra are in the list
  double floor;                // and below which none becomes worse for the sake of the aspect
  double insert, insert_round; // and those for which a new point is tried, and at places round about
  uint32_t pass;
  int is_crowded;                     // very many tetrahedra are slender: more is done, and more of them are called so
  int32_t *bad, bad_count, bad_space; // to look at in this pass
  int32_t *next, next_count, next_space;
  CwTetList slender;  // when all were judged, and what has changed since, where relaxing is to follow
  uint8_t *irregular; // by point, where relaxing is to follow: 1 where one round it is not as in a lattice
  int32_t irregular_space;
  CwFour *place; // of each point when they were last judged or moved together, from `middle`
  int32_t place_space;
  double middle[3], blurred; // square of an edge that is too short for such places
  CwTetImproved count;
} CwTetWork;

// A hollow: faces seen from a point inside it, each making a positive tetrahedron (face, point).
typedef struct {
  int count;
  const double *face[CW_TET_STAR][3];
} CwHollow;

extern const int8_t cw_tet_face[4][3]; // opposite each corner, outward
extern const int8_t cw_tet_edge[6][2];
extern const double cw_tet_way[14][3]; // unit vectors to the faces and corners of a cube

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

// The shortest and the longest edge of a tetrahedron: squares and ends.
typedef struct {
  double shortest, longest;
  int32_t near[2], far[2];
} CwTetEnds;

static inline CwTetEnds cw_tet_ends(const CwTetWork *w, const int32_t corner[4]) {
  CwTetEnds ends;
  double square[6];
  int near = 0, far = 0;
  for (int e = 0; e < 6; e++) square[e] = cw_tet_square_of(w, corner[cw_tet_edge[e][0]], corner[cw_tet_edge[e][1]]);
  ends.shortest = ends.longest = square[0];
  for (int e = 1; e < 6; e++) { // which one is as good as random, and takes no branch
    int less = (int)cw_number(square[e] < ends.shortest), more = (int)cw_number(square[e] > ends.longest);
    near += less * (e - near);
    far += more * (e - far);
    ends.shortest = cw_tet_less(square[e], ends.shortest);
    ends.longest = cw_tet_more(square[e], ends.longest);
  }
  for (int i = 0; i < 2; i++) ends.near[i] = corner[cw_tet_edge[near][i]], ends.far[i] = corner[cw_tet_edge[far][i]];
  return ends;
}

// Of the longest over the shortest edge.
static inline double cw_tet_slender_square(const CwTetWork *w) {
  return w->is_crowded ? CW_TET_LONG_CROWDED * CW_TET_LONG_CROWDED : CW_TET_LONG * CW_TET_LONG;
}

static inline int cw_tet_is_slender(const CwTetWork *w, const CwTetEnds *ends) {
  return ends->longest > cw_tet_slender_square(w) * ends->shortest;
}

// Longest over shortest edge, less the usual.
static inline double cw_tet_excess(const CwTetWork *w, const int32_t corner[4]) {
  double shortest = INFINITY, longest = 0.0;
  for (int e = 0; e < 6; e++) {
    double square = cw_tet_square_of(w, corner[cw_tet_edge[e][0]], corner[cw_tet_edge[e][1]]);
    shortest = cw_tet_less(shortest, square);
    longest = cw_tet_more(longest, square);
  }
  return sqrt(longest / shortest) - CW_TET_USUAL;
}

// Asks the memory for the neighbours of one that comes a little later in the list, and for one that comes later still.
// Always inline, since compilers drop calls of what does nothing but ask.
static inline __attribute__((always_inline)) void cw_tet_ask_ahead(const CwTetWork *w, const int32_t *list,
                                                                   int32_t count, int32_t k) {
  const CwDelaunayTet *tet = w->mesh->tet;
  if (k + 16 < count) cw_delaunay_ask_links(&tet[list[k + 16]]);
  if (k + 8 < count) {
    for (int i = 0; i < 4; i++) {
      int32_t next = tet[list[k + 8]].neighbour[i];
      if (next >= 0) cw_delaunay_ask_links(&tet[next / 4]);
    }
  }
}

// Frees what belongs to the work, not its mesh.
void cw_tet_work_free(CwTetWork *w);

// Puts a place into the list for the next pass, once.
CwStatus cw_tet_push(CwTetWork *w, int32_t t);
// Keeps a new quality, and the tetrahedron in mind where it is below the limit.
CwStatus cw_tet_set_quality(CwTetWork *w, int32_t t, double quality);
CwStatus cw_tet_replace(CwTetWork *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                        const double *quality);

// The same where all that comes is positive and of this quality at least; then *replaced goes up by one.
CwStatus cw_tet_replace_sound(CwTetWork *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                              double least, int32_t *replaced);

// Removes the edge a-b of t.
CwStatus cw_tet_remove_edge(CwTetWork *w, int32_t t, int32_t a, int32_t b, int *done_it);
// Two tetrahedra at face i of t become three round a new edge.
CwStatus cw_tet_remove_face(CwTetWork *w, int32_t t, int i, int *done_it);
// Moves an inner point of t.
CwStatus cw_tet_smooth(CwTetWork *w, int32_t t, int32_t point, int *done_it);
// A new point in the place of t and of what stands in its way.
CwStatus cw_tet_insert(CwTetWork *w, int32_t t, int *done_it);

// A new point in the place of t and of all that would be below `aim` with it, from `place` to its best place there.
// Made whether it gains or not, where nothing is below `least` then.
CwStatus cw_tet_insert_at(CwTetWork *w, int32_t t, const double place[3], double aim, double least);
// Goes over the list, again and again while something changes. The first pass adds no points.
CwStatus cw_tet_improve_list(CwTetWork *w, int passes, int move);
// Where single changes have left dihedral angles below 13 degrees in the list, or below 18 and below 0.85 of what the
// boundary allows (cw_tet_bound): disturbs patches of a few hundred tetrahedra and improves them again, hundreds of
// times; what is better in all is kept. The same every time. A place below 12 degrees is begun with again while the
// boundary allows clearly more than is reached. There are no more than 600 disturbances in all, or one for 500
// tetrahedra, and 200 where nothing is below 13 degrees: a search takes about half as long as their fill. Then the
// same, 1200 at most, where checkMesh calls determinants small; no angle below 18 degrees becomes less for them.
CwStatus cw_tet_search(CwTetWork *w);

// Tetrahedra of an inner point of t; 0 where there are more than CW_TET_STAR.
int cw_tet_star(CwTetWork *w, int32_t t, int32_t point, int32_t star[CW_TET_STAR]);
// Least quality of the hollow's tetrahedra for the point at p; stops at `enough` and moves that face forward,
// so that the next trial finds it first.
double cw_hollow_quality(CwHollow *hollow, const double p[3], double enough);
// Pattern search for the point of best least quality from p, which it moves; returns that quality.
double cw_hollow_best(CwHollow *hollow, double p[3], double start);

// How all inner points move at once: towards even spacing first, where `centres` is set, then in `evenings` steps
// towards even edges, of which the first goes `pull` of an edge and each further one 0.7 of the one before, and those
// beside dividing planes in `beside` more.
typedef struct {
  int centres, evenings, beside;
  double pull;
} CwTetMoves;

// Moves all inner points but those that are as in a lattice, where nothing is left worse below the floor; then every
// tetrahedron below the limit is in the list.
CwStatus cw_tet_relax(CwTetWork *w, CwTetMoves moves);
// Goes once over the slender tetrahedra that are wide at their longest edge. Three or four round it are made anew
// without it where the ratio becomes less in the mean; the least quality of those may fall, to the floor.
CwStatus cw_tet_shorten(CwTetWork *w);
// Takes away inner points with edges that are the shortest ones of seven slender tetrahedra and more: a point goes into
// the other end of its shortest one where the ratios, less the usual one, become less in the sum, or by so little more
// that relaxing makes up for it. The least quality of its tetrahedra may fall, to the floor. All are to be judged anew
// then.
CwStatus cw_tet_collapse(CwTetWork *w);
// Sets all qualities and finds the tetrahedra below the limit.
CwStatus cw_tet_scan(CwTetWork *w);

#ifdef __cplusplus
}
#endif
#endif
