// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/measure/cgns_audit_faces.h"

#include <stdlib.h>

#include "tests/measure/cgns_audit_file.h"

static const uint32_t UPPER = UINT32_C(1) << 31;
static int is_mixed; // node numbers pass 31 bits

void faces_start(Faces *faces, int64_t points) {
  is_mixed = points >= (int64_t)UPPER;
  *faces = (Faces){.room = 1 << 16};
  faces->slot = audit_new((size_t)faces->room * sizeof *faces->slot);
}

void faces_free(Faces *faces) {
  free(faces->slot);
  *faces = (Faces){0};
}

static uint64_t mixed(uint64_t value) { // splitmix64 (Steele, Lea, Flood 2014)
  value = (value ^ value >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  value = (value ^ value >> 27) * UINT64_C(0x94d049bb133111eb);
  return value ^ value >> 31;
}

FaceKey faces_key(const int64_t *node, const int face[4], int turned) {
  FaceKey key;
  int64_t n[4], m[4];
  const int count = face[3] < 0 ? 3 : 4;
  int least = 0;
  for (int i = 0; i < count; ++i) {
    n[i] = node[face[i]];
    if (n[i] < n[least]) least = i;
  }
  // From the smallest on towards the smaller neighbour; the side is the sense of that.
  const int64_t next = n[(least + 1) % count], before = n[(least + count - 1) % count];
  const int side = (next < before) ^ turned;
  for (int i = 0; i < count; ++i) m[i] = n[i];
  for (int i = 1; i < count; ++i) { // ascending
    const int64_t value = m[i];
    int at = i;
    for (; at > 0 && m[at - 1] > value; --at) m[at] = m[at - 1];
    m[at] = value;
  }
  for (int i = 0; i < 3; ++i)
    key.word[i] = is_mixed ? (uint32_t)(mixed((uint64_t)m[i] + ((uint64_t)i << 62)) % (UPPER - 1) + 1) : (uint32_t)m[i];
  if (count == 4) key.word[0] |= UPPER;
  if (side) key.word[1] |= UPPER;
  return key;
}

static int64_t place_of(const Faces *faces, const FaceKey *key) {
  const uint64_t a = (uint64_t)key->word[0] << 32 | (key->word[1] & ~UPPER);
  return (int64_t)(mixed(a * UINT64_C(0x9e3779b97f4a7c15) + key->word[2]) & (uint64_t)(faces->room - 1));
}

void faces_prefetch(const Faces *faces, const FaceKey *key) {
  __builtin_prefetch(&faces->slot[place_of(faces, key)], 1);
}

static void grow(Faces *faces) {
  Faces old = *faces;
  faces->room *= 2;
  faces->slot = audit_new((size_t)faces->room * sizeof *faces->slot);
  for (int64_t i = 0; i < old.room; ++i) {
    if (!old.slot[i].word[0]) continue;
    int64_t at = place_of(faces, &old.slot[i]);
    while (faces->slot[at].word[0]) at = (at + 1) & (faces->room - 1);
    faces->slot[at] = old.slot[i];
  }
  free(old.slot);
}

// Closes the gap at `hole`: what comes behind it without a gap moves up as far as its place allows (Knuth, The Art of
// Computer Programming 3, 6.4, algorithm R).
static void take_out(Faces *faces, int64_t hole) {
  const int64_t mask = faces->room - 1;
  for (int64_t at = (hole + 1) & mask; faces->slot[at].word[0]; at = (at + 1) & mask) {
    const int64_t home = place_of(faces, &faces->slot[at]);
    if (((at - home) & mask) < ((at - hole) & mask)) continue;
    faces->slot[hole] = faces->slot[at];
    hole = at;
  }
  faces->slot[hole].word[0] = 0;
  --faces->count;
}

FaceResult faces_meet(Faces *faces, const FaceKey *key) {
  int64_t at = place_of(faces, key);
  for (; faces->slot[at].word[0]; at = (at + 1) & (faces->room - 1)) {
    const FaceKey *there = &faces->slot[at];
    if (there->word[0] != key->word[0] || there->word[2] != key->word[2]) continue;
    if (there->word[1] == key->word[1]) return FACE_TWICE;
    if ((there->word[1] ^ key->word[1]) != UPPER) continue;
    take_out(faces, at);
    return FACE_MATCHED;
  }
  faces->slot[at] = *key;
  if (++faces->count > faces->most) faces->most = faces->count;
  if (faces->count > faces->room / 5 * 4) grow(faces);
  return FACE_WAITS;
}
