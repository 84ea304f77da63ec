// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/delaunay.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box.h"
#include "mesher/common/hilbert.h"
#include "mesher/common/predicates.h"
#include "mesher/common/radix.h"
#include "mesher/common/simd_8f.h"
#include "mesher/common/tet.h"
#include "mesher/fill/sphere.h"

enum { LOCAL = 64 }; // points round a cavity that the edge table holds

typedef struct {
  int32_t corner[3]; // seen counter-clockwise from outside of the cavity
  int32_t outer;     // 4 * tetrahedron + face beyond it
  int32_t tet;       // the new one on it
  int32_t local[3];
} Side;

typedef struct {
  CwSphereFrame frame;
  int32_t *cavity, cavity_count, cavity_capacity;
  Side *side;
  int32_t side_count, side_capacity;
  CwRadix *edge;
  int32_t edge_capacity;
  double (*arm)[4]; // from the new point to each point round the cavity, and its square
  int32_t *round;   // these points
  int32_t arm_capacity, round_capacity;
  CwTet none; // a sphere without radius far from all points: in place of a neighbour where there is none
  int32_t table[LOCAL * LOCAL]; // 4 * tetrahedron + face at a directed edge of the cavity's boundary
} Work;

static inline const double *at(const CwTetMesh *mesh, int32_t p) {
  return mesh->point[p].x;
}

static int in_sphere_exactly(const CwTetMesh *mesh, const CwTet *t, const double p[3]) {
  const int32_t *c = t->corner;
  return cw_insphere(at(mesh, c[0]), at(mesh, c[1]), at(mesh, c[2]), at(mesh, c[3]), p) > 0;
}

static inline int in_sphere(const CwTetMesh *mesh, const CwTet *t, const double p[3], const float place[3]) {
  unsigned known = cw_sphere_compare(t, place);
  return known ? known == CW_WITHIN : in_sphere_exactly(mesh, t, p);
}

// A tetrahedron whose sphere holds p, from `start`: towards p through any face that has p beyond it. -1: p is
// a corner of *last.
static int32_t walk(const CwTetMesh *mesh, int32_t start, const double p[3], const float place[3], int32_t *last) {
  int32_t t = start, from = -1;
  uint32_t turn = 0;
  int exact = 0;
  for (int64_t step = 0;; step++) {
    const CwTet *tet = &mesh->tet[t];
    if (in_sphere(mesh, tet, p, place)) return t;
    int32_t next = -1;
    exact |= step > 4 * (int64_t)mesh->tet_count; // rounding might lead in circles
    for (int again = exact; again < 2 && next < 0; again++) {
      exact = again;
      for (int k = 0; k < 4 && next < 0; k++) {
        int i = (int)((turn + (uint32_t)k) & 3);
        if (tet->neighbour[i] < 0 || (!again && tet->neighbour[i] >> 2 == from)) continue;
        const double *a = at(mesh, tet->corner[cw_tet_face[i][0]]), *b = at(mesh, tet->corner[cw_tet_face[i][1]]);
        const double *c = at(mesh, tet->corner[cw_tet_face[i][2]]);
        int beyond;
        if (again) {
          beyond = cw_orient3d(a, b, c, p) > 0;
        } else {
          double ax = a[0] - p[0], ay = a[1] - p[1], az = a[2] - p[2];
          double bx = b[0] - p[0], by = b[1] - p[1], bz = b[2] - p[2];
          double cx = c[0] - p[0], cy = c[1] - p[1], cz = c[2] - p[2];
          beyond = (ay * bz - az * by) * cx + (az * bx - ax * bz) * cy + (ax * by - ay * bx) * cz < 0.0;
        }
        if (beyond) next = tet->neighbour[i] >> 2;
      }
    }
    if (next < 0) {
      *last = t;
      return -1;
    }
    from = t;
    t = next;
    turn = turn * 1664525u + 1013904223u;
    turn ^= turn >> 16;
  }
}

// Looks beyond the faces of a tetrahedron of the cavity. Whether a face leads to one more, to one outside or to one
// that was met before is as good as random, and as branches half of them were foretold wrongly, which took a third of
// the time: instead both lists are written to, and one of them, or none, keeps it. There is room for all.
CW_INLINE void look_beyond(CwTetMesh *mesh, Work *work, int32_t t, const double p[3], const float place[3]) {
  const CwTet *tet = &mesh->tet[t];
  int32_t *cavity = work->cavity + work->cavity_count, known[4];
  Side *side = work->side + work->side_count;
  CwTet *next[4];
  for (int i = 0; i < 4; i++) next[i] = tet->neighbour[i] < 0 ? &work->none : &mesh->tet[tet->neighbour[i] >> 2];
  cw_sphere_compare_4((const CwTet *const *)next, place, known);
  for (int i = 0; i < 4; i++) {
    if (known[i] == 0) known[i] = in_sphere_exactly(mesh, next[i], p) ? CW_WITHIN : CW_BEYOND;
    __builtin_prefetch(&next[i]->neighbour[3], 1); // used soon, and perhaps not in the line of the sphere
    cw_sphere_take(next[i], (uint32_t)known[i] & CW_WITHIN);
    *cavity = tet->neighbour[i] >> 2;
    cavity += known[i] & CW_WITHIN;
    for (int m = 0; m < 3; m++) side->corner[m] = tet->corner[cw_tet_face[i][m]];
    side->outer = tet->neighbour[i];
    side += known[i] == CW_BEYOND;
  }
  work->cavity_count = (int32_t)(cavity - work->cavity);
  work->side_count = (int32_t)(side - work->side);
}

// All tetrahedra whose spheres hold p, from one of them, which are taken then.
CW_INLINE CwStatus find_cavity(CwTetMesh *mesh, Work *work, int32_t start, const double p[3], const float place[3]) {
  CwStatus status = CW_OK;
  work->cavity_count = work->side_count = 0;
  CW_GROW(work->cavity, work->cavity_capacity, 1);
  work->cavity[work->cavity_count++] = start;
  cw_sphere_take(&mesh->tet[start], 1);
  for (int32_t head = 0; head < work->cavity_count; head++) {
    CW_GROW(work->cavity, work->cavity_capacity, work->cavity_count + 4);
    CW_GROW(work->side, work->side_capacity, work->side_count + 4);
    look_beyond(mesh, work, work->cavity[head], p, place);
  }
done:
  return status;
}

static inline void join(CwTetMesh *mesh, int32_t one, int32_t other) {
  mesh->tet[one >> 2].neighbour[one & 3] = other;
  mesh->tet[other >> 2].neighbour[other & 3] = one;
}

// Joins the new tetrahedra at the edges of a cavity with more points than the table holds.
static CwStatus join_by_sorting(CwTetMesh *mesh, Work *work) {
  CwStatus status = CW_OK;
  int32_t count = 0;
  CW_GROW(work->edge, work->edge_capacity, 3 * (int64_t)work->side_count);
  for (int32_t k = 0; k < work->side_count; k++) {
    const Side *side = &work->side[k];
    for (int i = 0; i < 3; i++) {
      int32_t a = side->corner[(i + 1) % 3], b = side->corner[(i + 2) % 3];
      uint64_t low = (uint64_t)(a < b ? a : b), high = (uint64_t)(a < b ? b : a);
      work->edge[count++] = (CwRadix){low << 32 | high, 4 * side->tet + (i == 0 ? 0 : 3 - i), 0};
    }
  }
  CW_TRY(cw_radix_sort(count, work->edge));
  for (int32_t k = 0; k + 1 < count; k += 2) join(mesh, work->edge[k].item, work->edge[k + 1].item);
done:
  return status;
}

// Numbers the points round the cavity, and gives each side a place for its tetrahedron: those of the cavity first, of
// which what is left over is freed.
CW_INLINE CwStatus prepare_sides(CwTetMesh *mesh, Work *work, int32_t point, int32_t *round_count) {
  CwStatus status = CW_OK;
  int32_t locals = 0;
  CW_GROW(work->arm, work->arm_capacity, 3 * (int64_t)work->side_count + 1);
  CW_GROW(work->round, work->round_capacity, 3 * (int64_t)work->side_count + 1);
  for (int32_t k = 0; k < work->side_count; k++) {
    Side *side = &work->side[k];
    for (int i = 0; i < 3; i++) { // without branches, as above
      uint64_t *mark = &mesh->point[side->corner[i]].mark;
      uint64_t last = *mark, fresh = ((last >> 32 ^ (uint64_t)point) + UINT32_MAX) >> 32; // does not wait for `locals`
      uint64_t now = last ^ ((last ^ ((uint64_t)point << 32 | (uint64_t)locals)) & -fresh);
      work->round[locals] = side->corner[i];
      *mark = now;
      side->local[i] = (int32_t)(uint32_t)now;
      locals += (int32_t)fresh;
    }
    if (k < work->cavity_count)
      side->tet = work->cavity[k];
    else
      CW_TRY(cw_tet_mesh_new_tet(mesh, &side->tet));
  }
  for (int32_t k = work->side_count; k < work->cavity_count; k++) {
    mesh->tet[work->cavity[k]].radius_square = 0.0f; // without its sign
    cw_tet_mesh_free_tet(mesh, work->cavity[k]);
  }
  *round_count = locals;
done:
  return status;
}

CW_INLINE void set_spheres(CwTetMesh *mesh, const Work *work, const double place[3]) {
  for (int32_t k = 0; k < work->side_count; k += 2) {
    const Side *side[2] = {&work->side[k], &work->side[k + 1 < work->side_count ? k + 1 : k]};
    CwTet *const tet[2] = {&mesh->tet[side[0]->tet], &mesh->tet[side[1]->tet]};
    const double *arm[3][2];
    for (int i = 0; i < 6; i++) arm[i / 2][i % 2] = work->arm[side[i % 2]->local[i / 2]];
    cw_sphere_set(tet, place, arm[0], arm[1], arm[2]);
  }
}

// Tetrahedra from the new point to all sides of the cavity, which it sees.
CW_INLINE CwStatus fill_cavity(CwTetMesh *mesh, Work *work, int32_t point, const double place[3]) {
  CwStatus status = CW_OK;
  const double *p = mesh->point[point].x;
  int32_t locals = 0, *table = work->table;
  CW_TRY(prepare_sides(mesh, work, point, &locals));
  for (int32_t l = 0; l < locals; l++) {
    const double *x = mesh->point[work->round[l]].x;
    double *arm = work->arm[l];
    for (int i = 0; i < 3; i++) arm[i] = (x[i] - p[i]) * work->frame.scale;
    arm[3] = arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2];
  }
  set_spheres(mesh, work, place);
  int tabled = locals <= LOCAL;
  for (int32_t k = 0; k < work->side_count; k++) {
    const Side *side = &work->side[k];
    CwTet *tet = &mesh->tet[side->tet];
    const int32_t *l = side->local;
    tet->corner[0] = side->corner[0];
    tet->corner[1] = side->corner[2];
    tet->corner[2] = side->corner[1];
    tet->corner[3] = point;
    tet->neighbour[3] = side->outer;
    if (side->outer >= 0) mesh->tet[side->outer >> 2].neighbour[side->outer & 3] = 4 * side->tet + 3;
    if (!tabled) continue;
    table[l[1] * LOCAL + l[2]] = 4 * side->tet;
    table[l[2] * LOCAL + l[0]] = 4 * side->tet + 2;
    table[l[0] * LOCAL + l[1]] = 4 * side->tet + 1;
  }
  if (!tabled) {
    CW_TRY(join_by_sorting(mesh, work));
    goto done;
  }
  for (int32_t k = 0; k < work->side_count; k++) {
    const Side *side = &work->side[k];
    const int32_t *l = side->local;
    int32_t *neighbour = mesh->tet[side->tet].neighbour;
    neighbour[0] = table[l[2] * LOCAL + l[1]];
    neighbour[2] = table[l[0] * LOCAL + l[2]];
    neighbour[1] = table[l[1] * LOCAL + l[0]];
  }
done:
  return status;
}

static CwStatus note_duplicate(CwTetMesh *mesh, int32_t given, int32_t point, const CwTet *tet, int32_t *capacity) {
  CwStatus status = CW_OK;
  CW_GROW(mesh->duplicate, *capacity, mesh->duplicate_count + 1);
  int32_t *pair = mesh->duplicate[mesh->duplicate_count++];
  pair[0] = given;
  pair[1] = -1;
  for (int i = 0; i < 4; i++) {
    const double *a = at(mesh, tet->corner[i]), *b = at(mesh, point);
    if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2]) pair[1] = mesh->source[tet->corner[i]];
  }
done:
  return status;
}

// Points of a tetrahedron with corners at (1, 1, 1), (1, -1, -1), ... times `reach` round the others; its
// inscribed sphere has the radius reach / sqrt(3).
static CwStatus enclose(CwTetMesh *mesh, int32_t count, const double (*x)[3]) {
  CwStatus status = CW_OK;
  static const int sign[4][3] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  double middle[3], reach = 0.0, size = 0.0;
  for (int32_t p = 0; p < count; p++)
    CW_REQUIRE(isfinite(x[p][0] + x[p][1] + x[p][2]), CW_ERR_MESH, "point %d is not finite", p);
  CwBox box = cw_box_of_points(count, x);
  for (int i = 0; i < 3; i++) {
    double side = box.high[i] - box.low[i];
    middle[i] = 0.5 * (box.low[i] + box.high[i]);
    reach += 0.25 * side * side;
    size = fmax(size, fabs(middle[i]));
  }
  reach = 4.0 * sqrt(reach) + 1e-3 * size;
  if (!(reach > 0.0)) reach = 1.0;
  for (int k = 0; k < CW_ENCLOSING_POINTS; k++) {
    for (int i = 0; i < 3; i++) mesh->point[k].x[i] = middle[i] + reach * sign[k][i];
    mesh->point[k].mark = 0;
    mesh->source[k] = -1;
  }
done:
  return status;
}

static void first_tet(CwTetMesh *mesh) {
  CwTet *tet = &mesh->tet[0];
  *tet = (CwTet){.radius_square = NAN};
  for (int k = 0; k < CW_ENCLOSING_POINTS; k++) {
    tet->neighbour[k] = -1;
    tet->corner[k] = k;
  }
  if (cw_orient3d(at(mesh, 0), at(mesh, 1), at(mesh, 2), at(mesh, 3)) < 0) {
    tet->corner[0] = 1;
    tet->corner[1] = 0;
  }
  mesh->tet_count = 1;
}

CwStatus cw_delaunay_order(int32_t count, const double (*x)[3], CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t *order = NULL;
  memset(mesh, 0, sizeof *mesh);
  CW_REQUIRE(count > 0 && count < INT32_MAX / 32, CW_ERR_MESH, "%d points to connect; 1 to %d are allowed", count,
             INT32_MAX / 32 - 1);
  CW_NEW_UNSET(order, count);
  CW_TRY(cw_hilbert_rounds(count, x, order));
  CW_NEW_UNSET(mesh->point, count + CW_ENCLOSING_POINTS);
  CW_NEW_UNSET(mesh->source, count + CW_ENCLOSING_POINTS);
  mesh->point_count = mesh->point_capacity = count + CW_ENCLOSING_POINTS;
  CW_TRY(enclose(mesh, count, x));
  for (int32_t k = 0; k < count; k++) {
    memcpy(mesh->point[CW_ENCLOSING_POINTS + k].x, x[order[k]], sizeof *x);
    mesh->point[CW_ENCLOSING_POINTS + k].mark = 0;
    mesh->source[CW_ENCLOSING_POINTS + k] = order[k];
  }
done:
  free(order);
  if (status != CW_OK) cw_tet_mesh_free(mesh);
  return status;
}

CW_INLINE CwStatus add_points(CwTetMesh *mesh, Work *work, int32_t end) {
  CwStatus status = CW_OK;
  int32_t last = 0, duplicate_capacity = 0;
  for (int32_t k = CW_ENCLOSING_POINTS; k < end; k++) {
    int32_t point = mesh->point_count, found = 0;
    mesh->point[point] = mesh->point[k]; // another place once a duplicate was left out
    mesh->source[point] = mesh->source[k];
    double place[3];
    cw_sphere_place(&work->frame, mesh->point[point].x, place);
    const float seen[3] = {(float)place[0], (float)place[1], (float)place[2]};
    int32_t start = walk(mesh, last, mesh->point[point].x, seen, &found);
    if (start < 0) {
      CW_TRY(note_duplicate(mesh, mesh->source[k], point, &mesh->tet[found], &duplicate_capacity));
      continue;
    }
    mesh->point_count++;
    CW_TRY(find_cavity(mesh, work, start, mesh->point[point].x, seen));
    CW_TRY(fill_cavity(mesh, work, point, place));
    last = work->side[0].tet;
  }
done:
  return status;
}

CW_AVX2 static CwStatus add_points_avx2(CwTetMesh *mesh, Work *work, int32_t end) {
  return add_points(mesh, work, end);
}

static CwStatus work_make(const CwTetMesh *mesh, Work **work) {
  CwStatus status = CW_OK;
  CW_NEW(*work, 1);
  (*work)->frame = cw_sphere_frame(at(mesh, 0), at(mesh, 1), at(mesh, 2), at(mesh, 3));
  (*work)->none = (CwTet){.centre = {8.0f}};
done:
  return status;
}

static void work_free(Work *work) {
  if (work) {
    free(work->cavity);
    free(work->side);
    free(work->edge);
    free(work->arm);
    free(work->round);
  }
  free(work);
}

CwStatus cw_delaunay_connect(CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  Work *work = NULL;
  int32_t end = mesh->point_count;
  // 6.8 as a rule, and 6 where most points are of the boundary; pages that are not used cost nothing.
  CW_TRY(cw_tet_mesh_make_room(mesh, 9 * (int64_t)end + 256, 6 * (int64_t)end));
  CW_TRY(work_make(mesh, &work));
  first_tet(mesh);
  mesh->point_count = CW_ENCLOSING_POINTS;
  CW_TRY(CW_HAS_AVX2 ? add_points_avx2(mesh, work, end) : add_points(mesh, work, end));
done:
  work_free(work);
  if (status != CW_OK) cw_tet_mesh_free(mesh);
  return status;
}

CwStatus cw_delaunay_make(int32_t count, const double (*x)[3], CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  CW_TRY(cw_delaunay_order(count, x, mesh));
  CW_TRY(cw_delaunay_connect(mesh));
done:
  return status;
}

struct CwDelaunayInsertion {
  CwTetMesh *mesh;
  Work *work;
  int32_t last; // a tetrahedron of the last point
};

CwStatus cw_delaunay_open(CwTetMesh *mesh, CwDelaunayInsertion **insertion) {
  CwStatus status = CW_OK;
  CW_NEW(*insertion, 1);
  (*insertion)->mesh = mesh;
  while (mesh->tet[(*insertion)->last].corner[0] < 0) (*insertion)->last++;
  CW_TRY(work_make(mesh, &(*insertion)->work));
done:
  if (status != CW_OK) cw_delaunay_close(insertion);
  return status;
}

CwStatus cw_delaunay_insert(CwDelaunayInsertion *insertion, const double x[3], int32_t source, int32_t near,
                            int32_t *point) {
  CwStatus status = CW_OK;
  CwTetMesh *mesh = insertion->mesh;
  Work *work = insertion->work;
  double place[3];
  int32_t found = 0;
  *point = -1;
  cw_sphere_place(&work->frame, x, place);
  const float seen[3] = {(float)place[0], (float)place[1], (float)place[2]};
  int32_t start = walk(mesh, near < 0 ? insertion->last : near, x, seen, &found);
  if (start < 0) goto done;
  CW_TRY(cw_tet_mesh_add_point(mesh, x, source, point));
  CW_TRY(find_cavity(mesh, work, start, x, seen));
  CW_TRY(fill_cavity(mesh, work, *point, place));
  insertion->last = work->side[0].tet;
done:
  return status;
}

void cw_delaunay_close(CwDelaunayInsertion **insertion) {
  if (*insertion) work_free((*insertion)->work);
  free(*insertion);
  *insertion = NULL;
}
