// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/passage_width.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/cad/rays.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"

// Rays start on the centres of equal parts of a triangle, edges of which are no longer than this share of the width,
// and so short that a patch has some hundred rays; at most so many along an edge. Small triangles share one.
static const double SPACING = 1, LEAST_RAYS = 200;
enum { PARTS_MOST = 24 };

enum { BINS = 200 }; // of a patch's distances, over its width

// What a ray sees, and the area that it stands for.
typedef struct {
  int32_t patch, bin; // of the distance; BINS: no wall within the width
  double area;
} Seen;

typedef struct {
  const CwCad *cad;
  const CwBackground *background;
  const double *width;
  const int32_t *first;    // ray of each triangle; last: of all
  const double *area;      // that the rays of each triangle stand for
  const int32_t *triangle; // of each ray
} Look;

// 0: no rays.
static int32_t parts_along(const Look *look, int32_t t, double step) {
  const CwBackground *b = look->background;
  double longest = 0;
  if (!cw_cad_face_is_wall(look->cad, b->face[t]) || !(step > 0) || isinf(step)) return 0;
  for (int k = 0; k < 3; k++)
    longest = fmax(longest, cw_distance(b->x[b->triangle[t][k]], b->x[b->triangle[t][(k + 1) % 3]]));
  return (int32_t)fmin(fmax(ceil(longest / step), 1), PARTS_MOST);
}

// Centre of part i of the n * n equal ones: row r has 2 r + 1, upright and inverted in turn.
static void centre_of_part(const Look *look, int32_t t, int32_t n, int32_t i, double x[3]) {
  const CwBackground *b = look->background;
  int32_t row = (int32_t)sqrt((double)i), at = i - row * row;
  double v = (at / 2 + (at % 2 ? 2.0 : 1.0) / 3) / n, u = (row + (at % 2 ? 1.0 : 2.0) / 3) / n;
  const double *p = b->x[b->triangle[t][0]], *q = b->x[b->triangle[t][1]], *r = b->x[b->triangle[t][2]];
  for (int k = 0; k < 3; k++) x[k] = (1 - u) * p[k] + (u - v) * q[k] + v * r[k];
}

static CwStatus look_across(void *context, int32_t ray, void *out) {
  const Look *look = context;
  const CwBackground *b = look->background;
  int32_t t = look->triangle[ray], rays = look->first[t + 1] - look->first[t], n = (int32_t)lround(sqrt(rays));
  int patch = cw_cad_face_patch(look->cad, b->face[t]);
  double x[3], normal[3], met[3], distance, width = look->width[patch];
  Seen *seen = out;
  *seen = (Seen){.patch = patch, .bin = BINS, .area = look->area[t] / rays};
  centre_of_part(look, t, n, ray - look->first[t], x);
  cw_background_normal(b, t, normal);
  const double inward[3] = {-normal[0], -normal[1], -normal[2]};
  int32_t hit = cw_rays_exit(b->rays, x, inward, 1e-3 * width, (1 - 1.0 / BINS) * width, &distance);
  if (hit < 0 || !cw_cad_face_is_wall(look->cad, b->face[hit])) return CW_OK;
  cw_background_normal(b, hit, met);
  if (cw_dot(inward, met) >= cw_policy.size_facing) seen->bin = (int32_t)fmin(BINS * distance / width, BINS - 1);
  return CW_OK;
}

// The distance that all but missed_share of the area have, of the patch's areas by bin.
static double width_of(const double area[BINS + 1], double width) {
  double all = 0, less = 0;
  for (int i = 0; i <= BINS; i++) all += area[i];
  for (int i = 0; i < BINS; i++) {
    less += area[i];
    if (less > cw_policy.missed_share * all) return width * (i + 0.5) / BINS;
  }
  return width;
}

CwStatus cw_passage_widths(const CwContext *context, const CwCad *cad, const CwBackground *background, double *width) {
  CwStatus status = CW_OK;
  Seen *seen = NULL;
  int32_t *first = NULL, *triangle = NULL, triangles = background->triangle_count;
  double(*area)[BINS + 1] = NULL, *stands_for = NULL, *waiting = NULL, *step = NULL, centre[3];
  Look look = {cad, background, width, NULL, NULL, NULL};
  int patches = cw_cad_patch_count(cad);
  CW_NEW(first, (size_t)triangles + 1);
  CW_NEW(area, patches);
  CW_NEW(waiting, patches);
  CW_NEW(step, patches);
  CW_NEW(stands_for, triangles);
  for (int32_t t = 0; t < triangles; t++)
    step[cw_cad_face_patch(cad, background->face[t])] += cw_background_area(background, t, centre);
  for (int p = 0; p < patches; p++)
    step[p] = isinf(width[p]) ? INFINITY : fmin(SPACING * width[p], sqrt(2 * step[p] / LEAST_RAYS));
  for (int32_t t = 0; t < triangles; t++) {
    int patch = cw_cad_face_patch(cad, background->face[t]);
    int32_t n = parts_along(&look, t, step[patch]);
    waiting[patch] += n > 0 ? cw_background_area(background, t, centre) : 0;
    if (n == 1 && waiting[patch] < step[patch] * step[patch] / 2) n = 0; // of the next one
    first[t + 1] = first[t] + n * n;
    if (n == 0) continue;
    stands_for[t] = waiting[patch];
    waiting[patch] = 0;
  }
  CW_NEW_UNSET(triangle, first[triangles]);
  CW_NEW_UNSET(seen, first[triangles]);
  for (int32_t t = 0; t < triangles; t++) {
    for (int32_t i = first[t]; i < first[t + 1]; i++) triangle[i] = t;
  }
  look = (Look){cad, background, width, first, stands_for, triangle};
  CW_TRY(cw_parallel_for(context, "passage widths", first[triangles], sizeof *seen, look_across, &look, seen));
  for (int32_t i = 0; i < first[triangles]; i++) area[seen[i].patch][seen[i].bin] += seen[i].area;
  for (int p = 0; p < patches; p++) {
    if (cw_cad_patch_kind(cad, p) == CW_PATCH_WALL) width[p] = width_of(area[p], width[p]);
  }
done:
  free(first);
  free(stands_for);
  free(waiting);
  free(step);
  free(triangle);
  free(seen);
  free(area);
  return status;
}
