// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/tets_on.h"

#include <stdlib.h>

// A triangle by its corners, ascending.
typedef struct {
  int32_t corner[3], triangle;
} Key;

static void order(int32_t *a, int32_t *b) {
  if (*a <= *b) return;
  const int32_t swap = *a;
  *a = *b;
  *b = swap;
}

static Key key_of(int32_t a, int32_t b, int32_t c, int32_t triangle) {
  order(&a, &b);
  order(&b, &c);
  order(&a, &b);
  return (Key){{a, b, c}, triangle};
}

static int compare(const void *p, const void *q) {
  const Key *a = p, *b = q;
  for (int k = 0; k < 3; k++) {
    if (a->corner[k] != b->corner[k]) return a->corner[k] < b->corner[k] ? -1 : 1;
  }
  return 0;
}

CwStatus cw_tets_on(int32_t point_count, int32_t triangle_count, const int32_t (*triangle)[3], int32_t tet_count,
                    const int32_t (*tet)[4], int32_t *on) {
  CwStatus status = CW_OK;
  Key *key = NULL;
  uint8_t *is_corner = NULL; // of a triangle
  CW_NEW_UNSET(key, triangle_count);
  CW_NEW(is_corner, point_count);
  for (int32_t t = 0; t < triangle_count; t++) {
    key[t] = key_of(triangle[t][0], triangle[t][1], triangle[t][2], t);
    on[t] = -1;
    for (int k = 0; k < 3; k++) is_corner[triangle[t][k]] = 1;
  }
  qsort(key, (size_t)triangle_count, sizeof *key, compare);
  for (int32_t t = 0; t < tet_count; t++) {
    const int32_t *corner = tet[t];
    if (is_corner[corner[0]] + is_corner[corner[1]] + is_corner[corner[2]] + is_corner[corner[3]] < 3) continue;
    for (int k = 0; k < 4; k++) {
      const Key face = key_of(corner[(k + 1) % 4], corner[(k + 2) % 4], corner[(k + 3) % 4], 0);
      const Key *found = bsearch(&face, key, (size_t)triangle_count, sizeof *key, compare);
      if (found) on[found->triangle] = t;
    }
  }
done:
  free(key);
  free(is_corner);
  return status;
}
