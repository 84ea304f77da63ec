// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/symmetry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/vec.h"

enum { TURNS_MOST = 64, FACE_SAMPLES = 5, EDGE_SAMPLES = 5 };

void cw_symmetry_turn(int32_t count, int32_t turns, const double x[3], double turned[3]) {
  if (turns == 0) {
    memmove(turned, x, sizeof(double[3]));
    return;
  }
  double angle = 2 * M_PI * turns / count, c = cos(angle), s = sin(angle);
  double at[3] = {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
  memcpy(turned, at, sizeof at);
}

void cw_images_free(CwImages *images) {
  free(images->next);
  free(images->first);
  free(images->turns);
  memset(images, 0, sizeof *images);
}

CwStatus cw_images_make(int32_t item_count, int32_t **next, int32_t count, int allow_fixed, CwImages *images,
                        int *whole) {
  CwStatus status = CW_OK;
  *whole = 0;
  *images = (CwImages){.next = *next};
  *next = NULL;
  CW_NEW(images->first, item_count);
  CW_NEW(images->turns, item_count);
  for (int32_t i = 0; i < item_count; i++) images->first[i] = -1;
  *whole = 1;
  for (int32_t i = 0; i < item_count && *whole; i++) {
    if (images->first[i] >= 0) continue;
    int32_t size = 0, at = i;
    do {
      if (at < 0 || images->first[at] >= 0 || size == count) {
        *whole = 0;
        break;
      }
      images->first[at] = i;
      images->turns[at] = size++;
      at = images->next[at];
    } while (at != i);
    if (size != count && !(size == 1 && allow_fixed)) *whole = 0;
  }
done:
  if (!*whole) cw_images_free(images);
  return status;
}

int32_t cw_images_turned(const CwImages *images, int32_t item, int32_t turns) {
  for (int32_t k = 0; k < turns; k++) item = images->next[item];
  return item;
}

int32_t cw_images_size(const CwImages *images, int32_t count, int32_t item) {
  return images->next[item] == item ? 1 : count;
}

// Some places of each face, inside of it: middles of background triangles.
typedef struct {
  int32_t count;
  double uv[FACE_SAMPLES][2], x[FACE_SAMPLES][3];
} FaceSamples;

static CwStatus sample_faces(const CwCad *cad, const CwBackground *background, FaceSamples **samples) {
  CwStatus status = CW_OK;
  int32_t *triangles = NULL, *seen = NULL;
  CW_NEW(*samples, cw_cad_face_count(cad));
  CW_NEW(triangles, cw_cad_face_count(cad));
  CW_NEW(seen, cw_cad_face_count(cad));
  for (int32_t t = 0; t < background->triangle_count; t++) triangles[background->face[t]]++;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    int32_t face = background->face[t];
    FaceSamples *of = &(*samples)[face];
    int32_t every = triangles[face] / FACE_SAMPLES + 1;
    if (seen[face]++ % every != every / 2 || of->count == FACE_SAMPLES) continue;
    double *uv = of->uv[of->count];
    for (int k = 0; k < 2; k++) {
      uv[k] = (background->uv[t][0][k] + background->uv[t][1][k] + background->uv[t][2][k]) / 3;
    }
    cw_cad_face_point(cad, face, uv, of->x[of->count++], NULL, NULL);
  }
done:
  free(triangles);
  free(seen);
  return status;
}

static void edge_middle(const CwCad *cad, int32_t edge, double x[3]) {
  double range[2];
  cw_cad_edge_range(cad, edge, range);
  cw_cad_edge_point(cad, edge, (range[0] + range[1]) / 2, x, NULL);
}

static int bounds(const CwCad *cad, int32_t edge, int32_t face) {
  int faces[2];
  cw_cad_edge_faces(cad, edge, faces);
  return faces[0] == face || faces[1] == face;
}

// True where one turn takes the edges of face `f` to edges of face `g`: faces may be pieces of one surface.
static int edges_agree(const CwCad *cad, double near, int32_t count, int32_t f, int32_t g) {
  for (int32_t e = 0; e < cw_cad_edge_count(cad); e++) {
    if (!bounds(cad, e, f)) continue;
    double x[3], turned[3];
    int found = 0;
    edge_middle(cad, e, x);
    cw_symmetry_turn(count, 1, x, turned);
    for (int32_t other = 0; other < cw_cad_edge_count(cad) && !found; other++) {
      if (!bounds(cad, other, g)) continue;
      edge_middle(cad, other, x);
      found = cw_distance(x, turned) < near;
    }
    if (!found) return 0;
  }
  return 1;
}

// Where one turn takes `face`, -1: nowhere.
static int32_t face_image(const CwCad *cad, double near, const FaceSamples *samples, int32_t count, int32_t face) {
  const FaceSamples *of = &samples[face];
  for (int32_t g = 0; g < cw_cad_face_count(cad); g++) {
    if (g == face || cw_cad_face_patch(cad, g) != cw_cad_face_patch(cad, face)) continue;
    if (cw_cad_face_is_wall(cad, g) != cw_cad_face_is_wall(cad, face)) continue;
    if (cw_cad_face_reversed(cad, g) != cw_cad_face_reversed(cad, face)) continue;
    if (cw_cad_face_is_left_out(cad, g) != cw_cad_face_is_left_out(cad, face)) continue; // it has no edges to tell by
    int same = of->count > 0;
    for (int32_t s = 0; same && s < of->count; s++) {
      double turned[3], x[3];
      cw_symmetry_turn(count, 1, of->x[s], turned);
      cw_cad_face_point(cad, g, of->uv[s], x, NULL, NULL);
      same = cw_distance(turned, x) < near;
    }
    if (same && edges_agree(cad, near, count, face, g)) return g;
  }
  for (int32_t s = 0; s < of->count; s++) {
    double turned[3], uv[2] = {of->uv[s][0], of->uv[s][1]};
    cw_symmetry_turn(count, 1, of->x[s], turned);
    if (cw_cad_face_project(cad, face, turned, uv) >= near) return -1;
  }
  return of->count > 0 && edges_agree(cad, near, count, face, face) ? face : -1;
}

static int32_t edge_image(const CwCad *cad, double near, const CwImages *face, int32_t count, int32_t edge) {
  double range[2];
  int faces[2];
  cw_cad_edge_range(cad, edge, range);
  cw_cad_edge_faces(cad, edge, faces);
  for (int32_t e = 0; e < cw_cad_edge_count(cad); e++) {
    double other[2];
    int found[2];
    cw_cad_edge_range(cad, e, other);
    cw_cad_edge_faces(cad, e, found);
    int a = face->next[faces[0]], b = face->next[faces[1]];
    if (!(a == found[0] && b == found[1]) && !(a == found[1] && b == found[0])) continue;
    double room = 1e-9 * fabs(range[1] - range[0]);
    int same = fabs(other[0] - range[0]) <= room && fabs(other[1] - range[1]) <= room;
    for (int s = 0; same && s < EDGE_SAMPLES; s++) {
      double t = range[0] + (range[1] - range[0]) * s / (EDGE_SAMPLES - 1), x[3], turned[3];
      cw_cad_edge_point(cad, edge, t, x, NULL);
      cw_symmetry_turn(count, 1, x, turned);
      cw_cad_edge_point(cad, e, t, x, NULL);
      same = cw_distance(turned, x) < near;
    }
    if (same) return e;
  }
  return -1;
}

static int32_t vertex_image(const CwCad *cad, double near, int32_t count, int32_t vertex) {
  double x[3], turned[3];
  cw_cad_vertex_point(cad, vertex, x);
  cw_symmetry_turn(count, 1, x, turned);
  for (int32_t v = 0; v < cw_cad_vertex_count(cad); v++) {
    cw_cad_vertex_point(cad, v, x);
    if (cw_distance(x, turned) < near) return v;
  }
  return -1;
}

// *whole: whether `count` turns bring the solid to itself.
static CwStatus try_count(const CwCad *cad, double near, const FaceSamples *samples, int32_t count,
                          CwSymmetry *symmetry, int *whole) {
  CwStatus status = CW_OK;
  int32_t *next = NULL, faces = cw_cad_face_count(cad), edges = cw_cad_edge_count(cad), turning = 0;
  symmetry->count = count;
  *whole = 0;
  CW_NEW(next, faces);
  for (int32_t f = 0; f < faces; f++) {
    next[f] = face_image(cad, near, samples, count, f);
    if (next[f] < 0) goto done;
    turning += next[f] != f;
  }
  if (turning == 0) goto done;
  CW_TRY(cw_images_make(faces, &next, count, 1, &symmetry->face, whole));
  if (!*whole) goto done;
  CW_NEW(next, edges);
  for (int32_t e = 0; e < edges; e++) next[e] = edge_image(cad, near, &symmetry->face, count, e);
  CW_TRY(cw_images_make(edges, &next, count, 0, &symmetry->edge, whole));
  if (!*whole) goto done;
  CW_NEW(next, cw_cad_vertex_count(cad));
  for (int32_t v = 0; v < cw_cad_vertex_count(cad); v++) next[v] = vertex_image(cad, near, count, v);
  CW_TRY(cw_images_make(cw_cad_vertex_count(cad), &next, count, 1, &symmetry->vertex, whole)); // one on the axis
done:
  free(next);
  return status;
}

// Makes the first faces of all image sets one connected passage, as far as may be: what is done for them needs least
// beside them then.
static CwStatus gather_firsts(const CwCad *cad, CwSymmetry *symmetry) {
  CwStatus status = CW_OK;
  CwImages *face = &symmetry->face;
  int32_t faces = cw_cad_face_count(cad), taken = 0, done_with = 0, *queue = NULL;
  uint8_t *settled = NULL; // of each image set, by its first as it was
  CW_NEW(queue, faces);
  CW_NEW(settled, faces);
  for (int32_t f = 0; f < faces; f++) {
    if (face->next[f] == f) settled[f] = 1;
  }
  for (int32_t seed = 0; seed < faces; seed++) {
    if (settled[face->first[seed]]) continue;
    settled[face->first[seed]] = 1;
    queue[taken++] = seed;
    for (; done_with < taken; done_with++) {
      for (int e = 0; e < cw_cad_edge_count(cad); e++) {
        int sides[2];
        cw_cad_edge_faces(cad, e, sides);
        for (int k = 0; k < 2; k++) {
          if (sides[k] != queue[done_with] || settled[face->first[sides[1 - k]]]) continue;
          settled[face->first[sides[1 - k]]] = 1;
          queue[taken++] = sides[1 - k];
        }
      }
    }
  }
  for (int32_t i = 0; i < taken; i++) {
    int32_t at = queue[i], turns = 0;
    do {
      face->first[at] = queue[i];
      face->turns[at] = turns++;
      at = face->next[at];
    } while (at != queue[i]);
  }
done:
  free(queue);
  free(settled);
  return status;
}

static void clear(CwSymmetry *symmetry) {
  cw_images_free(&symmetry->face);
  cw_images_free(&symmetry->edge);
  cw_images_free(&symmetry->vertex);
}

CwStatus cw_symmetry_find(const CwCad *cad, const CwBackground *background, CwSymmetry **symmetry) {
  CwStatus status = CW_OK;
  FaceSamples *samples = NULL;
  const double near = cw_cad_tolerance(cad);
  *symmetry = NULL;
  CW_TRY(sample_faces(cad, background, &samples));
  CW_NEW(*symmetry, 1);
  int found = 0;
  for (int32_t count = TURNS_MOST; count >= 2 && !found; count--) {
    CW_TRY(try_count(cad, near, samples, count, *symmetry, &found));
    if (!found) clear(*symmetry);
  }
  if (found) {
    CW_TRY(gather_firsts(cad, *symmetry));
  } else {
    cw_symmetry_free(symmetry);
  }
done:
  if (status != CW_OK) cw_symmetry_free(symmetry);
  free(samples);
  return status;
}

void cw_symmetry_free(CwSymmetry **symmetry) {
  if (!*symmetry) return;
  clear(*symmetry);
  free(*symmetry);
  *symmetry = NULL;
}
