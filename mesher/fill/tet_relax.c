// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box.h"
#include "mesher/common/four.h"
#include "mesher/common/number.h"

static const float regular = 0.8f;      // a point stays where all round it are above; 0.866 in a lattice
static const double unsure = 1e-3;      // of a quality in single precision, by far
static const double blurred = 1e-4;     // of the extent of all: edges for which single precision will not do
static const float decay = 0.7f;        // of each step towards even edges over the one before
static const uint32_t beside_plane = 2; // weight of tetrahedra beside dividing planes, when edges are made even
enum { MOVED = 1, RETURNED = 2 };       // a point that is free to move
enum { ON_PLANE = 4, BESIDE = 8 };      // a fixed point on a dividing plane; a free one of its tetrahedra
enum { BLOCK = 128, PAD = 3 };          // tetrahedra that are looked for together; room behind a list

// Four tetrahedra side by side in single precision, which is enough for where points should go and for what is well
// shaped: the ways from their first corners to the others, by corner and coordinate, and their weights.
typedef struct {
  CwFour arm[3][4], weight;
} Group;

static inline CwFour place_of(const CwTetWork *w, const double x[3]) {
  return cw_four_way(w->middle, x);
}

static CwStatus set_places(CwTetWork *w) {
  CwStatus status = CW_OK;
  const CwDelaunay *mesh = w->mesh;
  CwBox box = cw_box_empty();
  CW_GROW(w->place, w->place_space, mesh->point_count);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    if (mesh->source[p] >= 0) cw_box_add_point(&box, mesh->point[p].x);
  }
  for (int i = 0; i < 3; i++) w->middle[i] = 0.5 * (box.low[i] + box.high[i]);
  double extent = cw_box_longest(&box);
  w->blurred = blurred * blurred * extent * extent;
  for (int32_t p = 0; p < mesh->point_count; p++) w->place[p] = place_of(w, mesh->point[p].x);
done:
  return status;
}

static inline void take_group(const CwTetWork *w, const int32_t list[4], Group *g) {
  CwFour weight = {0};
  for (int k = 0; k < 4; k++) {
    const CwDelaunayTet *tet = &w->mesh->tet[list[k]];
    const int32_t *corner = tet->corner;
    cw_delaunay_ask(tet, BLOCK); // of the next block, while this one is reckoned with
    CwFour from = w->place[corner[0]];
    weight[k] = (float)tet->weight;
    for (int c = 0; c < 3; c++) g->arm[c][k] = w->place[corner[c + 1]] - from;
  }
  g->weight = weight;
  for (int c = 0; c < 3; c++) cw_four_turn(g->arm[c]);
}

// A list of tetrahedra is taken by fours: the last one stands for those that lack.
static inline void pad_list(int32_t *list, int count) {
  for (int k = 0; k < PAD && count; k++) list[count + k] = list[count - 1];
}

// The tetrahedra from one on that are listed together end here.
static inline int32_t block_end(const CwDelaunay *mesh, int32_t from) {
  return mesh->tet_count - from < BLOCK ? mesh->tet_count : from + BLOCK;
}

// Marks those of the next BLOCK tetrahedra that have such a point with their weight.
static inline void mark_moving(CwDelaunay *mesh, int32_t from, const uint8_t *moved, uint8_t which) {
  const uint32_t weight[2] = {1, beside_plane};
  for (int32_t t = from, end = block_end(mesh, from); t < end; t++) {
    const int32_t *c = mesh->tet[t].corner, used = ~(c[0] >> 31);
    uint8_t any = moved[c[0] & used] | moved[c[1] & used] | moved[c[2] & used] | moved[c[3] & used];
    mesh->tet[t].weight = (uint32_t)(used & ((any & which) != 0)) * weight[(any & ON_PLANE) != 0];
  }
}

// Those of the next BLOCK tetrahedra that are marked. Returns their number. Without branches, which would be taken at
// random.
static inline int list_moving(const CwDelaunay *mesh, int32_t from, int32_t list[BLOCK + PAD]) {
  int count = 0;
  for (int32_t t = from, end = block_end(mesh, from); t < end; t++) {
    list[count] = t;
    count += (int)cw_number(mesh->tet[t].weight != 0);
  }
  pad_list(list, count);
  return count;
}

// The edges and their squares in the order of cw_tet_edge.
static inline void find_edges(const Group *g, CwFour edge[6][3], CwFour square[6]) {
  const CwFour *a = g->arm[0], *b = g->arm[1], *c = g->arm[2];
  for (int i = 0; i < 3; i++) {
    edge[0][i] = a[i], edge[1][i] = b[i], edge[2][i] = c[i];
    edge[3][i] = b[i] - a[i], edge[4][i] = c[i] - a[i], edge[5][i] = c[i] - b[i];
  }
  for (int e = 0; e < 6; e++) square[e] = cw_four_dot(edge[e], edge[e]);
}

static inline void find_extremes(const CwFour square[6], CwFour *least, CwFour *most) {
  *least = *most = square[0];
  for (int e = 1; e < 6; e++) {
    *least = cw_four_less(*least, square[e]);
    *most = cw_four_more(*most, square[e]);
  }
}

// As cw_tet_quality, but for rounding where that is above 0.1 or so, and what is less, or not a number, elsewhere; 0
// where edges are too short to tell.
static inline CwFour qualities_of(const Group *g, double too_short, float slender_square, CwFourMask *slender) {
  CwFour edge[6][3], l[6], face[4][3], n[4], shortest, longest;
  find_edges(g, edge, l);
  find_extremes(l, &shortest, &longest);
  cw_four_cross(g->arm[1], g->arm[2], face[1]);
  cw_four_cross(g->arm[2], g->arm[0], face[2]);
  cw_four_cross(g->arm[0], g->arm[1], face[3]);
  for (int i = 0; i < 3; i++) face[0][i] = face[1][i] + face[2][i] + face[3][i];
  CwFour scale = 1.0f / longest, six = scale * cw_four_dot(g->arm[2], face[3]);
  for (int f = 0; f < 4; f++) n[f] = scale * scale * cw_four_dot(face[f], face[f]);
  CwFour least = cw_four_less(cw_four_less(l[0] * (n[0] * n[1]), l[1] * (n[0] * n[2])),
                              cw_four_less(l[2] * (n[0] * n[3]), l[3] * (n[1] * n[2])));
  least = cw_four_less(least, cw_four_less(l[4] * (n[1] * n[3]), l[5] * (n[2] * n[3])));
  least = six * six * scale * (scale * least) / (n[0] * n[1] * n[2] * n[3]);
  CwFour aspect = (float)CW_TET_ASPECT * shortest * scale;
  CwFour counted = cw_four_more(aspect, cw_four_sqrt((float)CW_TET_SLENDER * aspect)); // the root, below that
  *slender = longest > slender_square * shortest;
  return cw_four_if((six > 0.0f) & (shortest > (float)too_short), cw_four_sqrt(cw_four_less(least, counted)));
}

// Where a point is to go: from its place by what it has moved in single precision.
static inline void find_goal(const CwTetWork *w, int32_t p, double goal[3]) {
  const double *x = cw_tet_at(w, p);
  CwFour way = w->place[p] - place_of(w, x);
  for (int i = 0; i < 3; i++) goal[i] = x[i] + (double)way[i];
}

static double quality_at_goals(const CwTetWork *w, const int32_t corner[4]) {
  double x[4][3];
  for (int k = 0; k < 4; k++) find_goal(w, corner[k], x[k]);
  return cw_tet_quality(x[0], x[1], x[2], x[3]);
}

// Whether moves make a tetrahedron worse than it may be.
static int is_spoilt(const CwTetWork *w, int32_t t) {
  const CwDelaunayTet *tet = &w->mesh->tet[t];
  const int32_t *c = tet->corner;
  return tet->quality < w->floor && tet->quality < cw_tet_quality_of(w, c[0], c[1], c[2], c[3]);
}

// Marks the points of a group where it is irregular, and adds the slender ones to their list, without branches.
static inline void note_shapes(CwTetWork *w, const int32_t *list, int count, CwFourMask irregular, CwFourMask slender) {
  for (int k = 0; k < 4 && w->irregular; k++) {
    const int32_t *c = w->mesh->tet[list[k]].corner;
    for (int i = 0; i < 4; i++) w->irregular[c[i]] |= (uint8_t)(irregular[k] & 1);
  }
  for (int k = 0; k < count; k++) {
    w->slender.tet[w->slender.count] = list[k];
    w->slender.count -= slender[k];
  }
}

// Sets the quality of some tetrahedra as it is to be, in a list with PAD more, and puts them into the list where they
// are below the limit, into that of the slender ones and, where given, into that of the spoilt ones.
static CwStatus judge(CwTetWork *w, const int32_t *list, int count, CwTetList *spoilt) {
  CwStatus status = CW_OK;
  const float slender_square = (float)cw_tet_slender_square(w);
  CW_GROW(w->slender.tet, w->slender.space, w->slender.count + count + 1);
  for (int from = 0; from < count; from += 4) {
    Group g;
    CwFourMask slender;
    int some = count - from < 4 ? count - from : 4;
    take_group(w, list + from, &g);
    CwFour quality = qualities_of(&g, w->blurred, slender_square, &slender);
    CwFourMask sure = quality > (float)(w->limit + unsure);
    note_shapes(w, list + from, some, quality < regular, slender);
    for (int k = 0; k < some; k++) {
      int32_t t = list[from + k];
      CwDelaunayTet *tet = &w->mesh->tet[t];
      tet->quality = (double)quality[k];
      if (sure[k]) continue;
      tet->quality = quality_at_goals(w, tet->corner);
      if (tet->quality < w->limit) CW_TRY(cw_tet_push(w, t));
      if (!spoilt || !is_spoilt(w, t)) continue;
      CW_GROW(spoilt->tet, spoilt->space, spoilt->count + 1);
      spoilt->tet[spoilt->count++] = t;
    }
  }
done:
  return status;
}

CwStatus cw_tet_scan(CwTetWork *w) {
  CwStatus status = CW_OK;
  int32_t list[BLOCK + PAD];
  CW_TRY(set_places(w));
  w->slender.count = w->tet_count = 0;
  for (int32_t p = 0; p < w->mesh->point_count; p++) w->mesh->point[p].mark = 0;
  for (int32_t t = 0; t < w->mesh->tet_count; t += BLOCK) {
    for (int32_t k = t, end = block_end(w->mesh, t); k < end; k++) {
      CwDelaunayTet *tet = &w->mesh->tet[k];
      tet->star = 0;
      tet->pass = CW_TET_NO_PASS;
      tet->weight = tet->corner[0] >= 0;
    }
    int count = list_moving(w->mesh, t, list);
    CW_TRY(judge(w, list, count, NULL));
    w->tet_count += count;
  }
done:
  return status;
}

// Adds what each corner of a group is to have, by coordinates: the weighted way to where it is wanted, and the weight.
static inline void add_sums(const CwTetWork *w, const int32_t *list, int count, CwFour part[4][4], CwFour *sum) {
  for (int c = 0; c < 4; c++) cw_four_turn(part[c]);
  for (int k = 0; k < count; k++) {
    const int32_t *corner = w->mesh->tet[list[k]].corner;
    for (int c = 0; c < 4; c++) sum[corner[c]] += part[c][k];
  }
}

// A tetrahedron wants its points at the centre of its circumscribed sphere. Its weight is its volume over the cube of
// its mean edge: equal for all that are well shaped, large or small, so that the spacing keeps its gradient; nothing
// for flat ones, whose spheres are anywhere.
static inline void find_centres(const Group *g, CwFour part[4][4]) {
  CwFour edge[6][3], l[6], bc[3], ca[3], ab[3];
  find_edges(g, edge, l);
  cw_four_cross(g->arm[1], g->arm[2], bc);
  cw_four_cross(g->arm[2], g->arm[0], ca);
  cw_four_cross(g->arm[0], g->arm[1], ab);
  CwFour squares = l[0] + l[1] + l[2] + l[3] + l[4] + l[5];
  CwFour scale = 1.0f / (squares * cw_four_sqrt(squares)), weight = scale * cw_four_dot(g->arm[0], bc);
  for (int i = 0; i < 3; i++) {
    CwFour way = 0.5f * scale * (l[0] * bc[i] + l[1] * ca[i] + l[2] * ab[i]);
    part[0][i] = way;
    for (int m = 0; m < 3; m++) part[m + 1][i] = way - weight * g->arm[m][i];
  }
  for (int m = 0; m < 4; m++) part[m][3] = weight;
}

// A tetrahedron wants the ends of its longest edge nearer to one another, and those of its shortest edge farther apart:
// down the gradient of their ratio, so that slender ones count for more.
static inline void find_pulls(const Group *g, CwFour part[4][4]) {
  CwFour edge[6][3], square[6], step[6], way[6], least, most;
  find_edges(g, edge, square);
  find_extremes(square, &least, &most);
  CwFourMask sound = least > (float)CW_TET_FLAT * most;
  CwFour in = cw_four_if(sound, g->weight / cw_four_sqrt(least * most));
  CwFour out = cw_four_if(sound, in * most / least);
  for (int e = 0; e < 6; e++) step[e] = cw_four_if(square[e] == most, in) - cw_four_if(square[e] == least, out);
  for (int i = 0; i < 3; i++) {
    for (int e = 0; e < 6; e++) way[e] = step[e] * edge[e][i];
    part[0][i] = way[0] + way[1] + way[2];
    part[1][i] = way[3] + way[4] - way[0];
    part[2][i] = way[5] - way[1] - way[3];
    part[3][i] = -way[2] - way[4] - way[5];
  }
  part[0][3] = part[1][3] = part[2][3] = part[3][3] = 0.5f * (in + out);
}

// Moves such points at once towards the weighted mean of the places that their tetrahedra want them at, by `share` of
// the way; these are to be marked here, or were before.
static inline void move_all(CwTetWork *w, int mark, void (*find)(const Group *, CwFour[4][4]), float share,
                            const uint8_t *moved, uint8_t which, CwFour *sum) {
  CwDelaunay *mesh = w->mesh;
  int32_t list[BLOCK + PAD];
  memset(sum, 0, (size_t)mesh->point_count * sizeof *sum);
  for (int32_t t = 0; t < mesh->tet_count; t += BLOCK) {
    if (mark) mark_moving(mesh, t, moved, which);
    int count = list_moving(mesh, t, list);
    for (int from = 0; from < count; from += 4) {
      Group group;
      CwFour part[4][4];
      take_group(w, list + from, &group);
      find(&group, part);
      add_sums(w, list + from, count - from < 4 ? count - from : 4, part, sum);
    }
  }
  for (int32_t p = 0; p < mesh->point_count; p++) {
    if (!(moved[p] & which) || !(sum[p][3] > 0.0f)) continue;
    w->place[p] += cw_four_if((CwFourMask){-1, -1, -1, 0}, share / sum[p][3] * sum[p]);
  }
}

// A point of t is to stay where it is. *whole: its tetrahedra are too many to be judged here.
static CwStatus put_back(CwTetWork *w, int32_t t, int32_t point, CwTetList *spoilt, int *whole) {
  CwStatus status = CW_OK;
  int32_t star[CW_TET_STAR + PAD];
  w->place[point] = place_of(w, cw_tet_at(w, point));
  int count = cw_tet_star(w, t, point, star);
  *whole |= count == 0;
  pad_list(star, count);
  CW_TRY(judge(w, star, count, spoilt));
done:
  return status;
}

// Judges all tetrahedra of the moved points. Where one is spoilt its points go back, and those of others that are
// spoilt by this.
static CwStatus take_back(CwTetWork *w, uint8_t *moved) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = w->mesh;
  CwTetList spoilt = {0};
  int32_t list[BLOCK + PAD];
  int whole;
  do {
    whole = 0;
    w->slender.count = 0;
    for (int32_t t = 0; t < mesh->tet_count; t += BLOCK) {
      int count = list_moving(mesh, t, list);
      CW_TRY(judge(w, list, count, &spoilt));
    }
    while (spoilt.count) {
      int32_t t = spoilt.tet[--spoilt.count];
      for (int i = 0; i < 4 && is_spoilt(w, t); i++) {
        int32_t point = mesh->tet[t].corner[i];
        if (!(moved[point] & MOVED)) continue;
        moved[point] = RETURNED;
        w->count.points_moved--;
        CW_TRY(put_back(w, t, point, &spoilt, &whole));
      }
    }
  } while (whole);
done:
  free(spoilt.tet);
  return status;
}

// Moves such points down the gradient of their aspects by ever shorter steps, of which the first goes `share` of the
// way; returns the share that comes next.
static float even_edges(CwTetWork *w, int steps, int mark, float share, const uint8_t *moved, uint8_t which,
                        CwFour *sum) {
  for (int k = 0; k < steps; k++, share *= decay) move_all(w, mark && k == 0, find_pulls, share, moved, which, sum);
  return share;
}

// Further steps of the points beside dividing planes alone: there triangles that both sides share hold tetrahedra more
// than elsewhere.
static void even_beside_planes(CwTetWork *w, int steps, float share, uint8_t *moved, CwFour *sum) {
  CwDelaunay *mesh = w->mesh;
  int32_t count = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    if (c[0] < 0 || !((moved[c[0]] | moved[c[1]] | moved[c[2]] | moved[c[3]]) & ON_PLANE)) continue;
    for (int i = 0; i < 4; i++) {
      if (!(moved[c[i]] & MOVED)) continue;
      moved[c[i]] |= BESIDE;
      count++;
    }
  }
  if (count == 0) return;
  even_edges(w, steps, 1, share, moved, BESIDE, sum);
  for (int32_t t = 0; t < mesh->tet_count; t += BLOCK) mark_moving(mesh, t, moved, MOVED);
}

// Every inner point that is not in a lattice goes to the weighted mean of the centres round it (L. Chen and J. Xu,
// Optimal Delaunay triangulations, J. Comp. Math. 22, 2004), and from there by ever shorter steps to where its
// tetrahedra's edges are more even.
CwStatus cw_tet_relax(CwTetWork *w, CwTetMoves moves) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = w->mesh;
  CwFour *sum = NULL;
  uint8_t *moved = NULL;
  CW_NEW(sum, mesh->point_count);
  CW_NEW(moved, mesh->point_count);
  CW_TRY(set_places(w));
  for (int32_t p = 0; p < mesh->point_count; p++) {
    int32_t source = mesh->source[p], is_free = source >= w->fixed_count;
    moved[p] = is_free && w->irregular[p] ? MOVED : 0;
    if (!is_free && source >= 0 && w->on_plane && w->on_plane[source]) moved[p] = ON_PLANE;
    w->irregular[p] = 0;
    w->count.points_moved += moved[p] == MOVED;
  }
  if (moves.centres) move_all(w, 1, find_centres, 1.0f, moved, MOVED, sum);
  float share = even_edges(w, moves.evenings, !moves.centres, (float)moves.pull, moved, MOVED, sum);
  if (moves.beside && w->on_plane) even_beside_planes(w, moves.beside, share, moved, sum);
  CW_TRY(take_back(w, moved));
  for (int32_t p = 0; p < mesh->point_count; p++) {
    double goal[3];
    if (!(moved[p] & MOVED)) continue;
    find_goal(w, p, goal);
    memcpy(mesh->point[p].x, goal, sizeof goal);
  }
done:
  free(sum);
  free(moved);
  return status;
}
