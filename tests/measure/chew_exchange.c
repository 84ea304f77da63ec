// SPDX-License-Identifier: AGPL-3.0-or-later
#include "chew_exchange.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
  double cost;
  int32_t region;
} Costly;

static int compare_costs(const void *p, const void *q) {
  const Costly *a = p, *b = q;
  if (a->cost != b->cost) return a->cost > b->cost ? -1 : 1;
  return a->region - b->region;
}

CwStatus cw_chew_owners_make(const CwInterfaces *interfaces, int32_t region_count, const double *cost,
                             CwChewOwners *owners) {
  CwStatus status = CW_OK;
  Costly *order = NULL;
  double *load = NULL;
  *owners = (CwChewOwners){.region_count = region_count};
  MPI_Comm_dup(MPI_COMM_WORLD, &owners->ranks);
  MPI_Comm_rank(owners->ranks, &owners->rank);
  MPI_Comm_size(owners->ranks, &owners->rank_count);
  CW_NEW(order, region_count);
  CW_NEW(load, owners->rank_count);
  CW_NEW(owners->owner, region_count);
  for (int32_t r = 0; r < region_count; r++) order[r] = (Costly){cost[r], r};
  qsort(order, (size_t)region_count, sizeof *order, compare_costs);
  for (int32_t k = 0; k < region_count; k++) {
    int least = 0;
    for (int p = 1; p < owners->rank_count; p++) least = load[p] < load[least] ? p : least;
    owners->owner[order[k].region] = least;
    load[least] += order[k].cost;
  }
  CW_TRY(cw_interfaces_adjacency(interfaces, region_count, &owners->pair_count, &owners->pair));
done:
  free(order);
  free(load);
  return status;
}

void cw_chew_owners_free(CwChewOwners *owners) {
  if (owners->owner) MPI_Comm_free(&owners->ranks);
  free(owners->owner);
  free(owners->pair);
  *owners = (CwChewOwners){0};
}

static int compare_asked(const void *p, const void *q) {
  const CwChewAsked *a = p, *b = q;
  if (a->interface != b->interface) return a->interface < b->interface ? -1 : 1;
  if (a->region != b->region) return a->region < b->region ? -1 : 1;
  for (int k = 0; k < 3; k++) {
    if (a->x[k] != b->x[k]) return a->x[k] < b->x[k] ? -1 : 1;
  }
  return 0;
}

typedef struct {
  CwChewAsked *item;
  int32_t count, space;
} List;

static CwStatus add(List *list, int32_t count, const CwChewAsked *item) {
  CwStatus status = CW_OK;
  CW_GROW(list->item, list->space, list->count + count);
  if (count) memcpy(list->item + list->count, item, (size_t)count * sizeof *item);
  list->count += count;
done:
  return status;
}

// What a region asks of its interfaces with another one.
static CwStatus gather(const CwChewInterface *interface, const CwChewRegion *from, int32_t to, List *list) {
  CwStatus status = CW_OK;
  list->count = 0;
  for (int32_t k = 0; k < from->asked_count; k++) {
    const int32_t *regions = interface[from->asked[k].interface].region;
    if (regions[0] == to || regions[1] == to) CW_TRY(add(list, 1, &from->asked[k]));
  }
done:
  return status;
}

// The message of the other region of a pair.
static CwStatus receive(const CwChewOwners *owners, int owner, int tag, List *heard) {
  CwStatus status = CW_OK;
  MPI_Message message;
  MPI_Status about;
  int size;
  MPI_Mprobe(owner, tag, owners->ranks, &message, &about);
  MPI_Get_count(&about, MPI_BYTE, &size);
  int32_t count = size / (int)sizeof(CwChewAsked);
  CW_GROW(heard->item, heard->space, heard->count + count);
  MPI_Mrecv(heard->item + heard->count, size, MPI_BYTE, &message, MPI_STATUS_IGNORE);
  heard->count += count;
done:
  return status;
}

CwStatus cw_chew_exchange(const CwChewOwners *owners, const CwChewInterface *interface, const CwChewRegion *region,
                          CwChewTraffic *traffic, int32_t *count, CwChewAsked **asked) {
  CwStatus status = CW_OK;
  List *message = NULL, heard = {0};
  MPI_Request *request = NULL;
  int requests = 0;
  CW_NEW(message, 2 * (size_t)owners->pair_count);
  CW_NEW(request, 2 * (size_t)owners->pair_count);
  for (int32_t k = 0; k < 2 * owners->pair_count; k++) {
    int32_t from = owners->pair[k / 2][k % 2], to = owners->pair[k / 2][1 - k % 2];
    if (owners->owner[from] != owners->rank) continue;
    CW_TRY(gather(interface, &region[from], to, &message[k]));
    int size = message[k].count * (int)sizeof(CwChewAsked);
    traffic->messages++;
    traffic->bytes += size;
    if (owners->owner[to] == owners->rank) continue;
    traffic->sent_messages++;
    traffic->sent_bytes += size;
    MPI_Isend(message[k].item, size, MPI_BYTE, owners->owner[to], k, owners->ranks, &request[requests++]);
  }
  for (int32_t k = 0; k < 2 * owners->pair_count; k++) {
    int32_t from = owners->pair[k / 2][k % 2], to = owners->pair[k / 2][1 - k % 2];
    if (owners->owner[to] == owners->rank && owners->owner[from] != owners->rank)
      CW_TRY(receive(owners, owners->owner[from], k, &heard));
  }
  for (int32_t r = 0; r < owners->region_count; r++) {
    if (owners->owner[r] == owners->rank) CW_TRY(add(&heard, region[r].asked_count, region[r].asked));
  }
  MPI_Waitall(requests, request, MPI_STATUSES_IGNORE);
  if (heard.count) qsort(heard.item, (size_t)heard.count, sizeof *heard.item, compare_asked);
  *count = heard.count;
  *asked = heard.item;
  heard.item = NULL;
done:
  for (int32_t k = 0; message && k < 2 * owners->pair_count; k++) free(message[k].item);
  free(message);
  free(request);
  free(heard.item);
  return status;
}
