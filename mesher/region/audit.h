// SPDX-License-Identifier: AGPL-3.0-or-later
// Audit of a region mesh and its quality figures: what no later tool would tell. See also tests/judges.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/parallel/outcome.h"
#include "mesher/region/region_file.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_QUALITY_BINS = 20 };

// Sums and extremes over some of the tetrahedra.
typedef struct {
  int64_t count;
  double aspect_sum, aspect_max;
  double mean_ratio_sum, mean_ratio_least;
  double dihedral_least; // degrees
} CwTetFigures;

// The centre of a flat tetrahedron, or of one far larger than the next: the flattest within two of its edges.
typedef struct {
  double x[3], flatness; // m; degrees
} CwFlatPlace;
enum { CW_FLAT_PLACES = 12 };

// Below which tetrahedra count as nearly flat, degrees: halfway from flat_angle to wanted_angle.
double cw_nearly_flat_angle(void);

// The fields are figures of their own: of all cells, of tetrahedra, of open faces and of prisms.
typedef struct {
  double volume;       // m3, all cells
  double least_volume; // m3
  int64_t cells;
  // tetrahedra
  double aspect_mean, aspect_max;           // longest / shortest edge; 0 without tetrahedra
  int64_t aspect_class[8];                  // paper, Table 1: 1-1.5, 1.5-2, 2-3, 3-4, 4-5, 5-7, 7-10, above
  double dihedral_least, dihedral_greatest; // degrees
  double flattest;                          // of all angles, determinants and weights of faces, degrees
  CwFlatPlace flat[CW_FLAT_PLACES];         // of flat and nearly flat tetrahedra, the flattest first
  int32_t flat_count;
  int64_t dihedral_bin[18];   // of the least angle of each tetrahedron, 10 degrees wide up to 180
  CwTetFigures beside, apart; // those with a corner on a partition plane, and the others
  // Sum of hashes of all open faces on partition planes (shared numbers and coordinates to the last bit), negative
  // where the face is seen from its other side: 0 over all regions of a domain where each face has its two cells.
  uint64_t open_faces;
  // prisms
  int64_t prism_count;
  double prism_least_scaled_jacobian;
  int64_t prism_jacobian_bin[CW_QUALITY_BINS]; // scaled Jacobian from 0 to 1; negative ones in the first
} CwQuality;

// Outcome: CW_OUTCOME_THIN with its centre where a cell has no positive volume: tetrahedra may be as flat as rounding
// where nothing better fits the boundary, prisms be turned over between layers whose nodes were brought onto a curved
// patch. Fails with CW_ERR_FAULT, naming region, cell and place (mm), where a face belongs to more than two cells (or
// has both of its two on one side), a point belongs to no cell, a listed face has the wrong cell or its normal into
// the domain, or an open face is neither listed as boundary exactly once nor has all its points shared (on a
// partition plane). Where it passes fills *quality.
CwStatus cw_audit_region(const CwRegionMesh *region, CwQuality *quality, CwOutcome *outcome);
// What is left to audit in a periodic image of a region that passed: its points are its own, but its cells and faces
// are those of the first. Its outcome and *open_faces are as there.
CwStatus cw_audit_copy(const CwRegionMesh *copy, uint64_t *open_faces, CwOutcome *outcome);
// Adds figures of one region to those of others. Starts by cw_quality_start: no
// cells, volume 0, least volume infinite, dihedral angles 180 and 0 degrees, scaled Jacobian 1.
void cw_quality_start(CwQuality *sum);
void cw_quality_add(CwQuality *sum, const CwQuality *more);

#ifdef __cplusplus
}
#endif
