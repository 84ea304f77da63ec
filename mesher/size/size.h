// SPDX-License-Identifier: AGPL-3.0-or-later
// The size field: edge length of the mesh as a function of place, h(x) = scale * min over the surface of
// (h_p + gradation * |x - p|), with h_p from patch sizes, curvature and narrow gaps; near open edges of walls no
// more than these allow. Kept on a Cartesian grid that also knows which of its nodes lie inside the domain, so that
// cell counts can be predicted by integration.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"
#include "pipeline/case.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwSize CwSize;

// The field begins with seeds on the surface: part 0 .. faces - 1 are those of a face, what patch sizes, curvature and
// gaps ask for there; then those of the edges, and last the lines that tell which part of space lies in the domain.
// `patch_size` gives the relative size of each patch of the CAD (from the mesh table of the case). Sizes are
// relative to `base_size` (m), the edge length at relative size 1 before scaling. Different parts may be made on
// different ranks; they come packed (malloc'd). CW_ERR_USAGE where a size, a gradation or an angle is not above 0.
typedef struct CwSizeSeeds CwSizeSeeds;
CwStatus cw_size_seeds_start(const CwCad *cad, const CwBackground *background, const CwMeshTable *table,
                             const double *patch_size, double base_size, CwSizeSeeds **seeds);
int cw_size_seed_parts(const CwCad *cad);
CwStatus cw_size_seeds_part(CwSizeSeeds *seeds, int part, void **bytes, int64_t *byte_count);
void cw_size_seeds_free(CwSizeSeeds **seeds);

// What one point asks for, at scale 1.
typedef struct {
  double x[3], size; // m
} CwSizePoint;

// Longest edges (m, by patch; only those of walls count): what is left to hold a flat prism falls with the fourth power
// of height over length.
typedef struct {
  const double *open_edge; // where a wall meets an open face, and prisms have a side on the boundary; at any scale
  const double *wall;      // all over the walls, at scale 1; NULL: any
  double scale;            // that the field is made for: narrow faces get no edges above twice their width; 0: any
  int32_t point_count;     // edges about these are no longer than they ask, whatever the limits of other sizes
  const CwSizePoint *point;
} CwSizeLimits;

// The field that spreads from all parts of the seeds (seeds[part]) through the domain, within the limits, if given.
// Open edges are granted no less than 0.4 of what is wanted there without them, and nothing where they ask for less
// than 0.28 of it in the mean. Different ranks may make its two parts: the field of the seeds, and that of the open
// edges, which joins it. They come in one block of bytes (malloc'd), to travel between ranks.
typedef enum { CW_SIZE_SEEDS, CW_SIZE_OPEN_EDGES } CwSizePart;
CwStatus cw_size_make(const CwCad *cad, const CwBackground *background, const CwMeshTable *table,
                      const double *patch_size, double base_size, const CwSizeLimits *limits, void *const *seeds,
                      CwSizePart part, void **bytes, int64_t *byte_count);
// The field in its block, which it takes over (*bytes is NULL after).
CwStatus cw_size_unpack(void **bytes, CwSize **size);
// The field in a block that stays the caller's, unchanged for as long as there is the field, or one that it has joined.
CwStatus cw_size_read(void *bytes, CwSize **size);
// Gives a field that has none the open edges of another one, of the open edges alone or of both; frees what is left of
// that.
void cw_size_join(CwSize *size, CwSize **open_edges);
void cw_size_free(CwSize **size);

// The greatest scale at which narrow faces still have edges no longer than twice their width.
double cw_size_scale_fine(void);
// The greatest scale at which triangles over narrow faces have angles of wanted_angle at least.
double cw_size_scale_flat(void);

// The factor in front of the whole field; 1 at first.
void cw_size_set_scale(CwSize *size, double scale);
double cw_size_scale(const CwSize *size);

// Edge length at x, m. Fast (trilinear); any x. A CwSizeAt, with the field as context.
double cw_size_at(const void *size, const double x[3]);

// The integral of h^-3 over the domain is that over the neighbourhoods of so many lines.
int32_t cw_size_line_count(const CwSize *size);
double cw_size_line_integral(const CwSize *size, int32_t line);

// Sample points inside the domain: *count points with the volume each stands for (m3); sum of volumes =
// volume of the domain to about 1 %. For predicting cells per region: cells = c * sum(volume / h^3). Caller
// frees both.
CwStatus cw_size_samples(const CwSize *size, int32_t *count, double (**x)[3], double **volume);

#ifdef __cplusplus
}
#endif
