// SPDX-License-Identifier: AGPL-3.0-or-later
// The faces that wait for their other side, in a hash table that grows and shrinks with them.
#pragma once

#include <stdint.h>

// The three smallest node numbers of a face, ascending, and in the upper bits of the first two whether it is a
// quadrilateral and which side it is seen from. Exact up to 2^31 - 1 points; above, the numbers are mixed to as many
// bits, and two faces may be taken for one once in 2^60.
typedef struct {
  uint32_t word[3];
} FaceKey;

typedef struct {
  FaceKey *slot; // word[0] == 0: empty
  int64_t room, count, most;
} Faces;

typedef enum { FACE_MATCHED, FACE_WAITS, FACE_TWICE } FaceResult;

void faces_start(Faces *faces, int64_t points);
void faces_free(Faces *faces);

// The key of a face of an element with these nodes (from 1). `turned`: it is seen from outside, as by the cell that is
// not there; so a boundary element meets its cell.
FaceKey faces_key(const int64_t *node, const int face[4], int turned);
void faces_prefetch(const Faces *faces, const FaceKey *key);

// Takes the face out where its other side waits (FACE_MATCHED); else it waits itself.
FaceResult faces_meet(Faces *faces, const FaceKey *key);
