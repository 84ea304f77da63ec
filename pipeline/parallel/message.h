// SPDX-License-Identifier: AGPL-3.0-or-later
// How much goes in one message of MPI. Its counts are int, and some ways of sending fail from two gigabytes on: what is
// longer goes in several.
#pragma once

#include <stddef.h>
#include <stdint.h>

// Of `left` items of `size` bytes each as many as the next message takes: one at least, and no more than fill 64 MiB.
// Tests set CUTWATER_MESSAGE_BYTES in the environment of all ranks to less.
//
//   for (int64_t at = 0; at < count; at += part) {
//     part = cw_message_items(count - at, sizeof *items);
//     MPI_Bcast(items + at, part * (int)sizeof *items, MPI_BYTE, 0, comm);
//   }
int cw_message_items(int64_t left, size_t size);
