// SPDX-License-Identifier: AGPL-3.0-or-later
// For inner loops over conditions that are as good as random: as branches they would be foretold wrongly.
#pragma once

// 1 where the condition holds, else 0: a number of which the compiler makes no branch.
static inline unsigned cw_branchless(int condition) {
  unsigned n = (unsigned)condition;
  __asm__("" : "+r"(n));
  return n;
}
