// SPDX-License-Identifier: AGPL-3.0-or-later
// What regions tell one another in a round of Chew's algorithm: which points encroach upon the interfaces that they
// share. One message goes each way between two adjacent regions, an empty one too, since the other waits for it.
#pragma once

#include <mpi.h>

#include "chew_points.h"

// Messages and their bytes: between regions, as if each had a rank of its own; and really sent between ranks. Of this
// rank's regions, by the sender.
typedef struct {
  int64_t messages, bytes, sent_messages, sent_bytes;
} CwChewTraffic;

// Who has which region, and which are adjacent.
typedef struct {
  MPI_Comm ranks;
  int rank, rank_count;
  int32_t region_count, *owner; // of each region
  int32_t pair_count, (*pair)[2];
} CwChewOwners;

// The same on all ranks: regions by descending cost, each to the rank with the least so far. Collective.
CwStatus cw_chew_owners_make(const CwInterfaces *interfaces, int32_t region_count, const double *cost,
                             CwChewOwners *owners);
void cw_chew_owners_free(CwChewOwners *owners);

// The points asked for by this rank's regions and by those adjacent to them, by interface, region and place. Adds to
// the traffic. [out] asked: caller frees. Collective.
CwStatus cw_chew_exchange(const CwChewOwners *owners, const CwChewInterface *interface, const CwChewRegion *region,
                          CwChewTraffic *traffic, int32_t *count, CwChewAsked **asked);
