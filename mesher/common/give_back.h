// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <stdlib.h> // says whether this is glibc

#ifdef __GLIBC__
#include <malloc.h>
#endif

// What has been freed, to the system: what comes next is of other sizes, and would stand beside it at the peak.
static inline void cw_give_back(void) {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}
