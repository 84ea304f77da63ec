// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/network/periodic_images.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/plan/plan.h"

static const double SAME_CORNER = 1e-7; // of the model's unit
static const double SAME_CURVE = 0.1;   // of its length: how far the middle of a turned curve may be off its image

void cw_periodic_images_free(CwPeriodicImages *images) {
  cw_images_free(&images->corner);
  cw_images_free(&images->curve);
  memset(images, 0, sizeof *images);
}

CwStatus cw_image_link(CwNodeImages *images, int32_t node, int32_t next, int32_t turns) {
  CwStatus status = CW_OK;
  int32_t most = node > next ? node : next;
  if (most >= images->capacity) {
    int32_t capacity = most + most / 2 + 4096;
    void *nexts = realloc(images->next, (size_t)capacity * sizeof *images->next);
    if (nexts) images->next = nexts;
    void *turned = realloc(images->turns, (size_t)capacity * sizeof *images->turns);
    if (turned) images->turns = turned;
    CW_REQUIRE(nexts && turned, CW_ERR_MEMORY, "out of memory: %d nodes", capacity);
    for (int32_t i = images->capacity; i < capacity; i++) images->next[i] = -1, images->turns[i] = 0;
    images->capacity = capacity;
  }
  images->next[node] = next;
  images->turns[next] = turns;
done:
  return status;
}

CwStatus cw_image_link_copy(CwNodeImages *images, int32_t node, int32_t count, int32_t turns, int32_t copies) {
  CwStatus status = CW_OK;
  if (turns > 0) CW_TRY(cw_image_link(images, node - count, node, turns));
  if (turns > 0 && turns == copies - 1) CW_TRY(cw_image_link(images, node, node - turns * count, 0));
done:
  return status;
}

int32_t cw_image_node(const CwNodeImages *images, int32_t node, int32_t turns) {
  for (int32_t k = 0; k < turns && node >= 0; k++) node = node < images->capacity ? images->next[node] : -1;
  return node;
}

int32_t cw_image_node_turns(const CwNodeImages *images, int32_t node) {
  return node < images->capacity ? images->turns[node] : 0;
}

CwStatus cw_node_images_copy(const CwNodeImages *images, CwNodeImages *copy) {
  CwStatus status = CW_OK;
  size_t size = (size_t)images->capacity * sizeof *copy->next;
  *copy = (CwNodeImages){0};
  if (!images->capacity) goto done;
  CW_NEW_UNSET(copy->next, images->capacity);
  CW_NEW_UNSET(copy->turns, images->capacity);
  memcpy(copy->next, images->next, size);
  memcpy(copy->turns, images->turns, size);
  copy->capacity = images->capacity;
done:
  return status;
}

void cw_node_images_arrays(CwNodeImages *images, CwArrayVisit visit, void *given) {
  CW_SHOW(visit, given, images->next, images->capacity);
  CW_SHOW(visit, given, images->turns, images->capacity);
}

void cw_node_images_free(CwNodeImages *images) {
  free(images->next);
  free(images->turns);
  *images = (CwNodeImages){0};
}

int32_t cw_image_face_copies(const CwPeriodicImages *images, int32_t face) {
  return images->symmetry ? cw_image_copies(images, &images->symmetry->face, face) : 1;
}

int32_t cw_image_face(const CwPeriodicImages *images, int32_t face, int32_t turns) {
  return images->symmetry ? cw_images_turned(&images->symmetry->face, face, turns) : face;
}

void cw_image_point(const CwPeriodicImages *images, int32_t turns, const double x[3], double turned[3]) {
  cw_symmetry_turn(images->symmetry ? images->symmetry->count : 1, turns, x, turned);
}

int32_t cw_image_region(const CwPeriodicImages *images, const CwPlan *plan, int32_t region, int32_t turns) {
  return images->symmetry ? cw_sector_turned_region(plan, images->symmetry->count, turns, region) : region;
}

int32_t cw_image_region_first(const CwPeriodicImages *images, const CwPlan *plan, int32_t region) {
  return images->symmetry ? cw_sector_first_region(plan, images->symmetry->count, region) : region;
}

static int32_t turned_plane(const CwNetwork *network, int32_t count, int32_t node) {
  return node < 0 ? node : cw_sector_turned_node(network->plan, count, 1, node);
}

// The corner as one turn takes it.
static CwCorner turned_corner(const CwNetwork *network, const CwSymmetry *symmetry, const CwCorner *corner) {
  CwCorner turned = *corner;
  cw_symmetry_turn(symmetry->count, 1, corner->x, turned.x);
  if (corner->face >= 0) turned.face = symmetry->face.next[corner->face];
  if (corner->edge >= 0) turned.edge = symmetry->edge.next[corner->edge];
  if (corner->vertex >= 0) turned.vertex = symmetry->vertex.next[corner->vertex];
  for (int k = 0; k < 3; k++) turned.plane[k] = turned_plane(network, symmetry->count, corner->plane[k]);
  for (int pass = 0; pass < 2; pass++) { // ascending, none last
    for (int k = 0; k < 2; k++) {
      int32_t a = turned.plane[k], b = turned.plane[k + 1];
      if (b < 0 || (a >= 0 && a <= b)) continue;
      turned.plane[k] = b;
      turned.plane[k + 1] = a;
    }
  }
  return turned;
}

static int32_t find_corner(const CwNetwork *network, const CwCorner *like) {
  for (int32_t i = 0; i < network->corner_count; i++) {
    const CwCorner *corner = &network->corner[i];
    if (corner->face == like->face && corner->edge == like->edge && corner->vertex == like->vertex &&
        !memcmp(corner->plane, like->plane, sizeof corner->plane) && corner->on_wall == like->on_wall &&
        cw_distance(corner->x, like->x) < SAME_CORNER) {
      return i;
    }
  }
  return -1;
}

static int same_faces(const CwCurve *curve, const int32_t face[2]) {
  return (curve->face[0] == face[0] && curve->face[1] == face[1]) ||
         (curve->face[0] == face[1] && curve->face[1] == face[0]);
}

// Point half-way along the fine polyline.
static void middle(const CwCurve *curve, double x[3]) {
  double half = curve->fine_length[curve->fine_count - 1] / 2;
  int32_t i = 0;
  while (i < curve->fine_count - 2 && curve->fine_length[i + 1] < half) i++;
  double span = curve->fine_length[i + 1] - curve->fine_length[i];
  cw_lerp(curve->fine_x[i], curve->fine_x[i + 1], span > 0 ? (half - curve->fine_length[i]) / span : 0, x);
}

static int32_t find_curve(const CwNetwork *network, const CwSymmetry *symmetry, const CwImages *corner,
                          const CwCurve *curve) {
  int32_t face[2], plane[2], end[2], found = -1;
  double x[3], turned[3], best = SAME_CURVE * curve->fine_length[curve->fine_count - 1];
  for (int k = 0; k < 2; k++) {
    face[k] = curve->face[k] < 0 ? -1 : symmetry->face.next[curve->face[k]];
    plane[k] = turned_plane(network, symmetry->count, curve->plane[k]);
    end[k] = corner->next[curve->corner[k]];
  }
  middle(curve, x);
  cw_symmetry_turn(symmetry->count, 1, x, turned);
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *other = &network->curve[i];
    if (!(other->corner[0] == end[0] && other->corner[1] == end[1]) &&
        !(other->corner[0] == end[1] && other->corner[1] == end[0]))
      continue;
    if (other->kind != curve->kind || other->wall != curve->wall || !same_faces(other, face)) continue;
    if (other->plane[0] != plane[0] || other->plane[1] != plane[1]) continue;
    if (curve->edge >= 0 && other->edge != symmetry->edge.next[curve->edge]) continue;
    middle(other, x);
    double distance = cw_distance(x, turned);
    if (distance < best) best = distance, found = i;
  }
  return found;
}

// Makes the curve the copy of `first` turned, in the same direction.
static CwStatus copy_curve(const CwPeriodicImages *images, const CwCurve *first, int32_t turns, CwCurve *curve) {
  CwStatus status = CW_OK;
  size_t n = (size_t)first->fine_count;
  CwCurve made = *curve;
  CW_TRY(cw_curve_fine_make(first->fine_count, &made));
  cw_curve_fine_free(curve);
  *curve = made;
  for (size_t i = 0; i < n; i++) cw_image_point(images, turns, first->fine_x[i], curve->fine_x[i]);
  memcpy(curve->fine_parameter, first->fine_parameter, n * sizeof *first->fine_parameter);
  memcpy(curve->fine_length, first->fine_length, n * sizeof *first->fine_length);
  for (int k = 0; k < 2; k++) curve->corner[k] = cw_images_turned(&images->corner, first->corner[k], turns);
done:
  return status;
}

static const char UNCLOSED[] = "turns do not bring corners and curves of the planes to themselves";

CwStatus cw_periodic_images_make(CwNetwork *network, CwPeriodicImages *images, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwSymmetry *symmetry = images->symmetry;
  int32_t *next = NULL;
  int whole;
  CW_NEW(next, network->corner_count);
  for (int32_t i = 0; i < network->corner_count; i++) {
    CwCorner turned = turned_corner(network, symmetry, &network->corner[i]);
    next[i] = find_corner(network, &turned);
    CW_END_UNLESS(next[i] >= 0, outcome, CW_OUTCOME_ASYMMETRIC, network->corner[i].x,
                  "a corner of planes and edges has no periodic image");
  }
  CW_TRY(cw_images_make(network->corner_count, &next, symmetry->count, 1, &images->corner, &whole));
  CW_END_UNLESS(whole, outcome, CW_OUTCOME_ASYMMETRIC, NULL, UNCLOSED);
  CW_NEW(next, network->curve_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    const double *x = network->corner[network->curve[i].corner[0]].x;
    next[i] = find_curve(network, symmetry, &images->corner, &network->curve[i]);
    CW_END_UNLESS(next[i] >= 0, outcome, CW_OUTCOME_ASYMMETRIC, x, "a curve has no periodic image, from its end");
  }
  CW_TRY(cw_images_make(network->curve_count, &next, symmetry->count, 0, &images->curve, &whole));
  CW_END_UNLESS(whole, outcome, CW_OUTCOME_ASYMMETRIC, NULL, UNCLOSED);
  for (int32_t i = 0; i < network->corner_count; i++) {
    const CwCorner *first = &network->corner[images->corner.first[i]];
    cw_image_point(images, images->corner.turns[i], first->x, network->corner[i].x);
  }
  for (int32_t i = 0; i < network->curve_count; i++) {
    if (images->curve.turns[i] == 0) continue;
    CW_TRY(copy_curve(images, &network->curve[images->curve.first[i]], images->curve.turns[i], &network->curve[i]));
  }
done:
  free(next);
  if (status != CW_OK || outcome->kind != CW_OUTCOME_DONE) {
    cw_images_free(&images->corner);
    cw_images_free(&images->curve);
  }
  return status;
}
