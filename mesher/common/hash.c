// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/hash.h"

#include <inttypes.h>
#include <stdio.h>

CwHash cw_hash_start(void) {
  return (CwHash){{UINT64_C(14695981039346656037), UINT64_C(1469598103934665603)}};
}

void cw_hash_bytes(CwHash *hash, const void *data, size_t size) {
  const unsigned char *byte = data;
  for (size_t i = 0; i < size; i++) {
    hash->sum[0] = (hash->sum[0] ^ byte[i]) * UINT64_C(1099511628211);
    hash->sum[1] = (hash->sum[1] ^ byte[i]) * UINT64_C(1099511628211) + 1;
  }
}

void cw_hash_hex(const CwHash *hash, char text[33]) {
  snprintf(text, 33, "%016" PRIx64 "%016" PRIx64, hash->sum[0], hash->sum[1]);
}
