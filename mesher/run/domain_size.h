// SPDX-License-Identifier: AGPL-3.0-or-later
// The size field of a domain, made by many ranks, and the integrals over it that predict cells.
#pragma once

#include "mesher/parallel/context.h"
#include "mesher/run/domain.h"

// What one rank makes for all, packed, and how all take it up: a part of the seeds of the size field; then the field
// from all of them, a part for each CwSizePart, and beside these few, for idle ranks, what each face adds to the exact
// volume.
void cw_domain_seed_costs(const CwDomain *domain, double *cost); // of each part, zeroed
CwStatus cw_domain_seed(CwDomain *domain, const CwCase *table, int part, void **bytes, int64_t *byte_count);
int cw_domain_size_parts(const CwDomain *domain);
void cw_domain_size_costs(const CwDomain *domain, double *cost); // of each part, zeroed
// Its growth at scale 1 is `gradation`; edges on walls are no longer at the scale `wall_scale`, if that is not 0, than
// their layers allow, and about the points than these ask.
CwStatus cw_domain_make_size(const CwDomain *domain, const CwCase *table, double gradation, double wall_scale,
                             int32_t point_count, const CwSizePoint *point, void *const *seeds, int part, void **bytes,
                             int64_t *byte_count);
// [in,out] bytes: taken over (cw_size_unpack); kept: they stay the caller's, for as long as the domain has its size
// field (cw_size_read). Collective.
CwStatus cw_domain_take_size(const CwContext *context, CwDomain *domain, int kept, void **bytes);
// The same for part CW_SIZE_SEEDS made once more, for about this scale.
CwStatus cw_domain_take_field(const CwContext *context, CwDomain *domain, double scale, int kept, void **bytes);
// Adds up area / h^2 of the walls at a scale of the field, and what it would be with no edge longer than they allow.
void cw_domain_walls_ask(const CwDomain *domain, double scale, double *wanted, double *asked);
// Integral of h^-3 over the domain less its layers at a scale of the size field, for h at scale 1: what the number of
// tetrahedra follows from.
double cw_domain_tet_integral(const CwDomain *domain, double scale);

// Adds the wall faces at a scale of the size field to needing[n] by the number of layers that they need, from 1 to
// CW_LAYERS_MOST, to lead to the tetrahedra, but no more than fit the passage.
void cw_domain_layers_needed(const CwDomain *domain, double scale, double *needing);
