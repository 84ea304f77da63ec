// SPDX-License-Identifier: AGPL-3.0-or-later
// Rotational symmetry of a domain about the z axis: an impeller of z equal passages comes to itself when it is turned
// by a z-th of a revolution. Items (faces, curves, nodes, regions) then form image sets: the first of each is made, the
// others are its copies, turned.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"

#ifdef __cplusplus
extern "C" {
#endif

// Of each item. A fixed item, which comes to itself, is its own next and first.
typedef struct {
  int32_t *next;  // where one turn takes it
  int32_t *first; // the one of its image set that is made
  int32_t *turns; // turns from the first to it
} CwImages;

typedef struct {
  int32_t count;               // z: turns in a revolution
  CwImages face, edge, vertex; // of the CAD
} CwSymmetry;

// Finds the greatest number of turns, at most 64, that brings the solid to itself: its patches, its faces with their
// parameters (u,v), its edges with theirs, its vertices, all within the tolerance of the solid. A face may be fixed (a
// disk about the axis), an edge or vertex not. The first faces of all image sets are chosen so that
// they hang together. *symmetry is NULL where there is none.
CwStatus cw_symmetry_find(const CwCad *cad, const CwBackground *background, CwSymmetry **symmetry);
void cw_symmetry_free(CwSymmetry **symmetry);

// x turned by `turns` z-ths of a revolution; `turned` may be x.
void cw_symmetry_turn(int32_t count, int32_t turns, const double x[3], double turned[3]);

// Image sets from (*next)[0..item_count), which they take over (*next is NULL after); the first of each is the one with
// the least number. *whole: 0, and no image sets, unless every item comes back to itself after exactly `count` turns,
// or, with `allow_fixed`, one.
CwStatus cw_images_make(int32_t item_count, int32_t **next, int32_t count, int allow_fixed, CwImages *images,
                        int *whole);
void cw_images_free(CwImages *images);
int32_t cw_images_turned(const CwImages *images, int32_t item, int32_t turns);
// Members of the image set: 1 for a fixed item.
int32_t cw_images_size(const CwImages *images, int32_t count, int32_t item);

#ifdef __cplusplus
}
#endif
