// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/radix.h"

#include <stdlib.h>

enum { DIGIT = 11 };

CwStatus cw_radix_sort(int64_t count, CwRadix *record) {
  CwStatus status = CW_OK;
  CwRadix *other = NULL, *from = record, *to;
  uint64_t any = 0, all = ~0ull, mask = (1 << DIGIT) - 1;
  for (int64_t k = 0; k < count; k++) {
    any |= record[k].key;
    all &= record[k].key;
  }
  CW_NEW_UNSET(other, count);
  to = other;
  for (int shift = 0; shift < 64;) {
    if (!((any ^ all) >> shift & 1)) { // a bit that all have in common
      shift++;
      continue;
    }
    int64_t start[(1 << DIGIT) + 1] = {0};
    for (int64_t k = 0; k < count; k++) start[(from[k].key >> shift & mask) + 1]++;
    for (int d = 0; d < 1 << DIGIT; d++) start[d + 1] += start[d];
    for (int64_t k = 0; k < count; k++) to[start[from[k].key >> shift & mask]++] = from[k];
    CwRadix *swap = from;
    from = to;
    to = swap;
    shift += DIGIT;
  }
  if (from != record && count) memcpy(record, from, (size_t)count * sizeof *record);
done:
  free(other);
  return status;
}
