// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/parallel/message.h"

#include <stdlib.h>

static const int64_t MOST_BYTES = 1 << 26;

int cw_message_items(int64_t left, size_t size) {
  const char *asked = getenv("CUTWATER_MESSAGE_BYTES");
  int64_t most = asked ? atoll(asked) : MOST_BYTES;
  if (most < 1 || most > MOST_BYTES) most = MOST_BYTES;
  most = most > (int64_t)size ? most / (int64_t)size : 1;
  return (int)(left < most ? left : most);
}
