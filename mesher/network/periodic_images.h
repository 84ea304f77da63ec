// SPDX-License-Identifier: AGPL-3.0-or-later
// The image sets of a domain whose solid and plan have a symmetry: of the corners and curves of its network, and of
// mesh nodes. Items that turns take to one another form an image set: its first is made, the others are copies of it,
// turned, with the same numbers on both sides of every seam.
#pragma once

#include "mesher/cad/symmetry.h"
#include "mesher/network/network.h"
#include "mesher/parallel/host_memory.h"

typedef struct {
  const CwSymmetry *symmetry; // NULL: none, every item stands for itself
  CwImages corner, curve;
} CwPeriodicImages;

// Of mesh nodes: where one turn takes each, -1: nowhere (it lies inside of a fixed face, or there is no symmetry);
// turns from the first.
typedef struct {
  int32_t capacity, *next, *turns;
} CwNodeImages;

// Finds the image sets of corners and curves and makes each the periodic image of its first. Outcome:
// CW_OUTCOME_ASYMMETRIC where the network is not symmetric: where a plane grazes something, the passages may have been
// traced differently.
CwStatus cw_periodic_images_make(CwNetwork *network, CwPeriodicImages *images, CwOutcome *outcome);
void cw_periodic_images_free(CwPeriodicImages *images);

// Notes that one turn takes `node` to `next`, which is `turns` turns from the first of its image set.
CwStatus cw_image_link(CwNodeImages *images, int32_t node, int32_t next, int32_t turns);
// Links `node` of the copy `turns` of a block of `count` nodes, of which `copies` are numbered one behind the other: to
// the copy before, and the last copy to the first.
CwStatus cw_image_link_copy(CwNodeImages *images, int32_t node, int32_t count, int32_t turns, int32_t copies);
int32_t cw_image_node(const CwNodeImages *images, int32_t node, int32_t turns);
int32_t cw_image_node_turns(const CwNodeImages *images, int32_t node);

// The member of the image set of v that comes after `at`, which is v or another; -1 after the last. Over all of them:
//
//   for (int32_t at = v, turns = 0; at >= 0; at = cw_image_after(images, at, v), turns++)
static inline int32_t cw_image_after(const CwNodeImages *images, int32_t at, int32_t v) {
  int32_t next = cw_image_node(images, at, 1);
  return next == v ? -1 : next;
}

CwStatus cw_node_images_copy(const CwNodeImages *images, CwNodeImages *copy);
void cw_node_images_arrays(CwNodeImages *images, CwArrayVisit visit, void *given);
void cw_node_images_free(CwNodeImages *images);

// Copies to be made of an item, itself included, and the `turns`-th of them; without symmetry 1 and itself. A copy that
// is not the first has turns.
static inline int32_t cw_image_copies(const CwPeriodicImages *images, const CwImages *of, int32_t item) {
  return images->symmetry ? cw_images_size(of, images->symmetry->count, item) : 1;
}
static inline int32_t cw_image_turns(const CwPeriodicImages *images, const CwImages *of, int32_t item) {
  return images->symmetry ? of->turns[item] : 0;
}
int32_t cw_image_face_copies(const CwPeriodicImages *images, int32_t face);
int32_t cw_image_face(const CwPeriodicImages *images, int32_t face, int32_t turns);
void cw_image_point(const CwPeriodicImages *images, int32_t turns, const double x[3], double turned[3]);
int32_t cw_image_region(const CwPeriodicImages *images, const CwPlan *plan, int32_t region, int32_t turns);
int32_t cw_image_region_first(const CwPeriodicImages *images, const CwPlan *plan, int32_t region);
