// SPDX-License-Identifier: AGPL-3.0-or-later
// A domain's regions filled by Chew's algorithm and by the rule of region numbers, from the same surfaces, by the same
// ranks: what each takes and sends. Regions are owned as chew_exchange.h says; seconds are of the processor, so that
// waits and what else runs on the machine do not count, and of the clock.
#pragma once

#include "chew_exchange.h"

// Over all ranks, once cw_chew_sum has added them up.
typedef struct {
  double interface_seconds; // splits, or the rule
  double refine_seconds;    // inner points
  double fill_seconds;      // the kernel's fill of them
  double wall_seconds;      // from the first to the last of these, without files and audit
  CwChewTraffic traffic;
  int64_t rounds, inserted, refused, tetrahedra; // inserted: interface points; refused: triangles left encroached
} CwChewFigures;

// Fills the regions from the interfaces as planned; writes PATH/DOMAIN-0001.h5 ... and audits them, and that the faces
// on partition planes have their two sides. Collective.
CwStatus cw_chew_domain(const CwRegionInput *from, const CwChewOwners *owners, const CwChewBounds *bounds,
                        const char *domain, const char *path, CwChewFigures *figures);

// The same regions by the rule of region numbers, as the mesher makes them; nothing is written. A message goes from the
// owner of interfaces to the region that takes them. Collective.
CwStatus cw_rule_domain(const CwRegionInput *from, const CwChewOwners *owners, const int32_t *number,
                        CwChewFigures *figures);

// Adds up the figures of all ranks; wall_seconds, rounds and splits are the greatest. Collective.
void cw_chew_sum(const CwChewOwners *owners, CwChewFigures *figures);
