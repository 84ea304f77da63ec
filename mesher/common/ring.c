// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/ring.h"

#include <string.h>

int cw_ring_tets(const int8_t *cut, int stride, const int32_t *ring, int32_t a, int32_t b, int i, int j,
                 int32_t (*tet)[4], int count) {
  if (j - i < 2) return count;
  int k = cut[i * stride + j];
  count = cw_ring_tets(cut, stride, ring, a, b, i, k, tet, count);
  count = cw_ring_tets(cut, stride, ring, a, b, k, j, tet, count);
  const int32_t up[4] = {ring[i], ring[k], ring[j], b}, down[4] = {ring[i], ring[j], ring[k], a};
  memcpy(tet[count++], up, sizeof up);
  memcpy(tet[count++], down, sizeof down);
  return count;
}
