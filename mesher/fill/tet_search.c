// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/mix.h"
#include "mesher/common/quality.h"
#include "mesher/common/tet.h"
#include "mesher/fill/tet_bound.h"
#include "mesher/fill/tet_insert.h"
#include "mesher/fill/tet_loop.h"
#include "mesher/fill/tet_patch.h"
#include "mesher/policy.h"
#include "pipeline/mesh/cell.h"

static const CwPolicy *const policy = &cw_policy;
enum { PLACES = 6, BEGINNINGS = 8, CHANGES = 3 }; // places searched; of a place; of one disturbance
static const double SHAKEN = 0.3;                 // edges: farthest that points are moved by a disturbance

typedef struct {
  double least, sine, deficit; // least judged, and least sine; what all lack, the worst by far the most
} Rated;

// A patch, changed or not.
typedef struct {
  CwTetPatch patch;
  Rated rated;
  double gain; // in deficit
} Found;

typedef struct {
  CwTetWork *whole, work; // of the mesh; of a trial
  Found now, best;        // of this beginning; of all of a place
  CwTetMesh trial;
  uint64_t random;
  int32_t tries;    // left
  double begin;     // least sine below which a search begins
  double again;     // and begins again
  int determinants; // count too
} Search;

// In [0, 1).
static double next_random(Search *s) {
  s->random += CW_MIX_STEP;
  return (double)(cw_mix(s->random) >> 11) * 0x1p-53;
}

static int32_t choose(Search *s, int32_t count) {
  return (int32_t)(next_random(s) * count);
}

static CwTetMeasures measures_of(const CwTetMesh *mesh, int32_t t) {
  const int32_t *c = mesh->tet[t].corner;
  return cw_tet_measures(mesh->point[c[0]].x, mesh->point[c[1]].x, mesh->point[c[2]].x, mesh->point[c[3]].x);
}

static double flat_sine(void) {
  return sin(policy->flat_angle * CW_DEGREE);
}

static double wanted_sine(void) {
  return sin(policy->wanted_angle * CW_DEGREE);
}

static double least_sine(const CwTetMeasures *m) {
  static const int8_t beside[6][2] = {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}; // faces at each edge
  double least = INFINITY;
  for (int e = 0; e < 6; e++) least = fmin(least, m->edge[e] / (m->area[beside[e][0]] * m->area[beside[e][1]]));
  return m->six > 0.0 ? m->six * sqrt(least) : -1.0;
}

// The least sine or, where the search is for determinants, less where checkMesh calls that small: flat at its limit.
// Of flat tetrahedra it goes with the fourth power of their angles, and those of 12 to 17 degrees may be called so.
static double judge(const Search *s, const CwTetMesh *mesh, int32_t t, double *sine) {
  CwTetMeasures m = measures_of(mesh, t);
  int open = 0;
  *sine = least_sine(&m);
  if (!s->determinants || *sine < 0.0) return *sine;
  for (int i = 0; i < 4; i++) open |= (mesh->tet[t].neighbour[i] == CW_BESIDE_NOTHING) << i;
  double determinant = cw_tet_determinant(&m, open);
  return determinant > 0.0 ? fmin(*sine, flat_sine() * cw_tet_determinant_share(determinant)) : *sine;
}

static double mean_edge(const CwTetMesh *mesh, int32_t t) {
  CwTetMeasures m = measures_of(mesh, t);
  return cw_tet_mean_edge(&m);
}

static Rated rate(const Search *s, const CwTetMesh *mesh) {
  Rated rated = {INFINITY, INFINITY, 0.0};
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    if (mesh->tet[t].corner[0] < 0) continue;
    double sine, judged = judge(s, mesh, t, &sine), lack = fmax(0.0, 1.0 - judged / wanted_sine());
    rated.least = fmin(rated.least, judged);
    rated.sine = fmin(rated.sine, sine);
    rated.deficit += lack * lack * lack * lack * lack * lack;
  }
  return rated;
}

// One of the tetrahedra that count, or of what lies a face or two beside it; -1 where none counts any more.
static int32_t choose_tet(Search *s) {
  int32_t count = 0, chosen = -1;
  for (int32_t t = 0; t < s->trial.tet_count; t++) {
    double sine;
    if (s->trial.tet[t].corner[0] >= 0 && judge(s, &s->trial, t, &sine) < wanted_sine() && choose(s, ++count) == 0)
      chosen = t;
  }
  for (int steps = chosen < 0 ? 0 : choose(s, 3); steps > 0; steps--) {
    int32_t next = s->trial.tet[chosen].neighbour[choose(s, 4)];
    chosen = next < 0 ? chosen : next / 4;
  }
  return chosen;
}

// Takes a free point of t away, or of the first tetrahedron round t that has one: of the edges to its neighbours the
// one goes that leaves the best worst tetrahedron.
static CwStatus contract(Search *s, int32_t t) {
  CwStatus status = CW_OK;
  int32_t star[CW_STAR], made[CW_STAR][4], point = -1, to = -1;
  double quality[CW_STAR], best = policy->sound_quality;
  int count = 0, first = choose(s, 4);
  for (int k = 0; k < 20 && point < 0; k++) { // t, then its neighbours
    int32_t near = k < 4 ? 4 * t : s->trial.tet[t].neighbour[k / 4 - 1];
    if (near < 0) continue;
    int32_t p = s->trial.tet[near / 4].corner[(first + k) % 4];
    if (s->trial.source[p] > 0) point = p, t = near / 4;
  }
  if (point < 0) goto done;
  int n = cw_tet_star(&s->trial, t, point, CW_STAR, star);
  if (n > CW_CAVITY) goto done;
  for (int k = 0; k < 4 * n; k++) {
    int32_t other = s->trial.tet[star[k / 4]].corner[k % 4];
    double least = other == point ? -1.0 : INFINITY;
    for (int m = 0; m < n && least > best; m++) {
      const int32_t *c = s->trial.tet[star[m]].corner;
      int32_t one[4];
      int has = 0;
      for (int i = 0; i < 4; i++) has |= c[i] == other, one[i] = c[i] == point ? other : c[i];
      if (!has) least = fmin(least, cw_tet_quality_of(&s->work, one[0], one[1], one[2], one[3]));
    }
    if (least > best) best = least, to = other;
  }
  if (to < 0) goto done;
  for (int m = 0; m < n; m++) {
    const int32_t *c = s->trial.tet[star[m]].corner;
    int has = 0;
    for (int i = 0; i < 4; i++) has |= c[i] == to, made[count][i] = c[i] == point ? to : c[i];
    if (has) continue;
    quality[count] = cw_tet_quality_of(&s->work, made[count][0], made[count][1], made[count][2], made[count][3]);
    count++;
  }
  CW_TRY(cw_tet_replace(&s->work, n, star, count, (const int32_t(*)[4])made, quality));
done:
  return status;
}

static CwStatus insert(Search *s, int32_t t) {
  double place[3], edge = next_random(s) * mean_edge(&s->trial, t); // mostly near: room in a corner is small
  for (int i = 0; i < 3; i++) {
    place[i] = edge * (2.0 * next_random(s) - 1.0);
    for (int k = 0; k < 4; k++) place[i] += 0.25 * s->trial.point[s->trial.tet[t].corner[k]].x[i];
  }
  return cw_tet_insert_at(&s->work, t, place, policy->improve_below * next_random(s), policy->sound_quality);
}

// Moves about half of the free points, where no tetrahedron turns over.
static void shake(Search *s) {
  CwTetMesh *mesh = &s->trial;
  double reach = SHAKEN * next_random(s), old[3];
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    int32_t star[CW_STAR];
    if (mesh->tet[t].corner[0] < 0 || choose(s, 2)) continue;
    int32_t p = mesh->tet[t].corner[choose(s, 4)];
    int n = mesh->source[p] > 0 ? cw_tet_star(mesh, t, p, CW_STAR, star) : 0, good = 1;
    if (n == 0) continue;
    memcpy(old, mesh->point[p].x, sizeof old);
    double edge = mean_edge(mesh, t);
    for (int i = 0; i < 3; i++) mesh->point[p].x[i] += reach * edge * (2.0 * next_random(s) - 1.0);
    for (int k = 0; k < n && good; k++) {
      const int32_t *c = mesh->tet[star[k]].corner;
      good = cw_tet_quality_of(&s->work, c[0], c[1], c[2], c[3]) > policy->sound_quality;
    }
    if (good)
      mesh->point[p].mark = s->work.pass;
    else
      memcpy(mesh->point[p].x, old, sizeof old);
  }
}

// A trial begins as what has been found, nothing of it changed.
static CwStatus begin_trial(Search *s) {
  CwStatus status = CW_OK;
  CwTetMesh *mesh = &s->trial;
  CW_TRY(cw_tet_patch_copy_mesh(&s->now.patch.mesh, mesh));
  for (int32_t t = 0; t < mesh->tet_count; t++) mesh->tet[t].star = 0;
  for (int32_t p = 0; p < mesh->point_count; p++) mesh->point[p].mark = 0;
  s->work.pass += 2;
done:
  return status;
}

// Improves what touches a change, or all of it: the rest has been tried as it is.
static CwStatus improve_trial(Search *s, int all, Rated *result) {
  CwStatus status = CW_OK;
  s->work.next.count = 0;
  for (int32_t t = 0; t < s->trial.tet_count; t++) {
    CwTet *tet = &s->trial.tet[t];
    const int32_t *c = tet->corner;
    tet->pass = CW_TET_NO_PASS;
    if (c[0] < 0 || !(all || cw_tet_has_changed(&s->work, t))) continue;
    tet->quality = cw_tet_quality_of(&s->work, c[0], c[1], c[2], c[3]);
    if (tet->quality < s->work.limit) CW_TRY(cw_tet_push(&s->work, t));
  }
  CW_TRY(cw_tet_improve_list(&s->work, policy->improve_passes, 1));
  *result = rate(s, &s->trial);
done:
  return status;
}

static CwStatus disturb(Search *s) {
  CwStatus status = CW_OK;
  for (int changes = 1 + choose(s, CHANGES); changes > 0; changes--) {
    int32_t t = choose_tet(s), kind = choose(s, 3);
    if (t < 0) break;
    if (kind == 0)
      CW_TRY(insert(s, t));
    else if (kind == 1)
      CW_TRY(contract(s, t));
    else
      shake(s);
  }
done:
  return status;
}

// Puts the best patch back, and its tetrahedra below the limit into the list.
static CwStatus put_back(Search *s) {
  CwStatus status = CW_OK;
  int32_t *place = NULL;
  CwTetWork *w = s->whole;
  int32_t sources = w->source_count;
  CW_TRY(cw_tet_patch_put(&s->best.patch, w->mesh, &w->source_count, &place));
  for (int32_t k = 0; k < s->best.patch.mesh.tet_count; k++) {
    if (place[k] < 0) continue;
    const int32_t *c = w->mesh->tet[place[k]].corner;
    w->mesh->tet[place[k]].star = 0;
    w->mesh->tet[place[k]].pass = CW_TET_NO_PASS;
    CW_TRY(cw_tet_set_quality(w, place[k], cw_tet_quality_of(w, c[0], c[1], c[2], c[3])));
  }
  w->count.points_added += w->source_count - sources;
  w->count.patches_changed++;
done:
  free(place);
  return status;
}

// Goes on from the best that was found, until as many tries as the policy has in a row lead nowhere.
static CwStatus search_patch(Search *s, int32_t t) {
  CwStatus status = CW_OK;
  Rated trial, *best = &s->now.rated;
  CW_TRY(cw_tet_patch_take(s->whole->mesh, t, policy->search_patch, s->whole->fixed_count, &s->now.patch));
  *best = rate(s, &s->now.patch.mesh);
  s->now.gain = best->deficit;
  double allowed = fmin(best->sine, policy->search_wanted);
  int vain = 0;
  for (int k = 0; best->least < s->begin && vain < policy->search_vain && s->tries > 0; k++) {
    s->tries--;
    vain++;
    s->whole->count.search_tries++;
    CW_TRY(begin_trial(s));
    if (k > 0) CW_TRY(disturb(s));
    CW_TRY(improve_trial(s, k == 0, &trial));
    if (trial.least < best->least || trial.deficit > 0.999 * best->deficit) continue;
    if (trial.sine < allowed) continue;
    vain = 0;
    CwTetMesh swap = s->now.patch.mesh;
    s->now.patch.mesh = s->trial;
    s->trial = swap;
    *best = trial;
  }
  s->now.gain -= best->deficit;
done:
  return status;
}

// What leads nowhere from one beginning may do from another.
static CwStatus search_place(Search *s, int32_t t) {
  CwStatus status = CW_OK;
  for (int k = 0; k < BEGINNINGS && s->tries > 0 && (k == 0 || s->best.rated.least < s->again); k++) {
    CW_TRY(search_patch(s, t));
    double more = s->now.rated.least - s->best.rated.least;
    if (k == 0 || more > 0.0 || (more == 0.0 && s->now.gain > s->best.gain)) {
      Found swap = s->best;
      s->best = s->now;
      s->now = swap;
    }
    cw_tet_patch_free(&s->now.patch);
  }
  if (s->best.gain > 0.0) CW_TRY(put_back(s));
done:
  cw_tet_patch_free(&s->now.patch);
  cw_tet_patch_free(&s->best.patch);
  return status;
}

static int is_near(const CwTetWork *w, int32_t t, int count, const double (*place)[3], const double *reach) {
  const double *x = cw_tet_at(w, w->mesh->tet[t].corner[0]);
  for (int k = 0; k < count; k++) {
    double square = 0.0;
    for (int i = 0; i < 3; i++) square += (x[i] - place[k][i]) * (x[i] - place[k][i]);
    if (square < reach[k] * reach[k]) return 1;
  }
  return 0;
}

static int32_t count_bad(const CwTetWork *w) {
  int32_t count = 0;
  for (int32_t k = 0; k < w->next.count; k++) {
    int32_t t = w->next.tet[k];
    if (w->mesh->tet[t].corner[0] < 0 || w->mesh->tet[t].quality >= flat_sine()) continue;
    CwTetMeasures m = measures_of(w->mesh, t);
    count += least_sine(&m) < flat_sine();
  }
  return count;
}

// The sine of the least angle that the boundary of this mesh allows.
static CwStatus sine_allowed(const CwTetMesh *mesh, double *sine) {
  CwStatus status = CW_OK;
  double(*x)[3] = NULL, allowed;
  int32_t(*triangle)[3] = NULL, count = 0, worst;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const CwTet *tet = &mesh->tet[t];
    cw_tet_prefetch_ahead(tet);
    for (int i = 0; i < 4; i++) count += tet->corner[0] >= 0 && tet->neighbour[i] < 0;
  }
  CW_NEW(x, mesh->point_count);
  CW_NEW(triangle, count);
  for (int32_t p = 0; p < mesh->point_count; p++) memcpy(x[p], mesh->point[p].x, sizeof x[p]);
  count = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const CwTet *tet = &mesh->tet[t];
    cw_tet_prefetch_ahead(tet);
    for (int i = 0; i < 4 && tet->corner[0] >= 0; i++) {
      if (tet->neighbour[i] >= 0) continue;
      for (int k = 0; k < 3; k++) triangle[count][k] = tet->corner[cw_tet_face[i][k]];
      count++;
    }
  }
  CwFillInput boundary = {.point_count = mesh->point_count,
                          .x = (const double(*)[3])x,
                          .triangle_count = count,
                          .triangle = (const int32_t(*)[3])triangle};
  CW_TRY(cw_tet_bound(&boundary, &allowed, &worst));
  *sine = sin(allowed * CW_DEGREE);
done:
  free(triangle);
  free(x);
  return status;
}

// The worst below where a search begins, as it is judged, but near none of the places; -1 where there is none. In a
// search for determinants its angles are not what is bad: those have been searched for.
static int32_t find_worst(const Search *s, int count, const double (*place)[3], const double *reach, double *least) {
  const CwTetWork *w = s->whole;
  int32_t worst = -1;
  *least = s->begin;
  for (int32_t k = 0; k < w->next.count; k++) {
    int32_t t = w->next.tet[k];
    if (w->mesh->tet[t].corner[0] < 0 || w->mesh->tet[t].quality >= (s->determinants ? policy->search_wanted : *least))
      continue;
    double sine, judged = judge(s, w->mesh, t, &sine);
    if (s->determinants && sine < s->begin) continue;
    if (judged < *least && judged > policy->sound_quality && !is_near(w, t, count, place, reach))
      *least = judged, worst = t;
  }
  return worst;
}

static CwStatus search_places(Search *s) {
  CwStatus status = CW_OK;
  double place[PLACES][3], reach[PLACES], least;
  for (int n = 0; n < PLACES && s->tries > 0; n++) {
    int32_t worst = find_worst(s, n, (const double(*)[3])place, reach, &least);
    if (worst < 0) break;
    memcpy(place[n], cw_tet_at(s->whole, s->whole->mesh->tet[worst].corner[0]), sizeof place[n]);
    reach[n] = 2.0 * mean_edge(s->whole->mesh, worst); // what else is bad there was before the same search
    CW_TRY(search_place(s, worst));
  }
done:
  return status;
}

CwStatus cw_tet_search(CwTetWork *w) {
  CwStatus status = CW_OK;
  Search s = {.whole = w,
              .begin = policy->search_wanted,
              .work = {.limit = wanted_sine(), .insert = flat_sine(), .fixed_count = 1}};
  double least, allowed = 0.0;
  s.work.mesh = &s.trial;
  s.work.source_count = 1;
  s.tries = w->mesh->tet_count > policy->search_share * policy->search_fewest
                ? w->mesh->tet_count / policy->search_share
                : policy->search_fewest;
  int64_t most = w->mesh->tet_count / policy->search_share;
  if (count_bad(w) > (most > policy->search_any ? most : policy->search_any)) goto done;
  if (find_worst(&s, 0, NULL, NULL, &least) >= 0) {
    CW_TRY(sine_allowed(w->mesh, &allowed));
    s.again = fmin(flat_sine(), allowed);
    s.begin = fmin(policy->search_wanted, fmax(flat_sine(), allowed));
    CW_TRY(search_places(&s));
  }
  // After the angles, with tries of its own.
  s.determinants = 1;
  s.begin = s.again = flat_sine();
  s.tries = policy->search_fewest;
  CW_TRY(search_places(&s));
done:
  cw_tet_mesh_free(&s.trial);
  cw_tet_work_free(&s.work);
  return status;
}
