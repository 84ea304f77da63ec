// SPDX-License-Identifier: AGPL-3.0-or-later
// The mesh divided into parts of equally many cells, for solvers that want one folder a rank. The cells are taken in
// their order, region by region; where a part ends within a region, the region is cut by planes across its longest
// extent (recursive coordinate bisection: M. J. Berger and S. H. Bokhari, IEEE Trans. Computers C-36, 1987). The parts
// follow from the mesh alone. Within a part cells, points and faces keep the order of the whole mesh.
#pragma once

#include "export/face_stretch.h"

// What a region gives to a part, and what the regions before have given.
typedef struct {
  int part;
  int64_t cells, first_cell;
  int64_t own_points, first_own_point; // points of the region alone; the number of the first in the part
  CwFaceCount inner, first_inner;      // between two cells of the part
  CwFaceCount *patch, *first_patch;    // by patch of the domain
} CwPiece;

// The faces that belong to a region between cells of two parts.
typedef struct {
  int part, other, region;
  CwFaceCount count, first; // first: of the regions before
} CwLink;

typedef struct {
  int64_t cells, points;
  int64_t domain_cells[CW_DOMAINS_MOST], first_point[CW_DOMAINS_MOST]; // first_point: shared points, then own ones
  CwFaceCount inner, *patch;                                           // patch: by patch of the mesh
  int first_link, link_count;                                          // into CwDivision.links
} CwPart;

typedef struct {
  const CwAssembly *assembly;
  int part_count;
  CwPart *parts;
  int *first_piece; // by region, and one more: into `pieces`
  CwPiece *pieces;
  CwLink *links; // by part, other, region
  int link_count;
  int64_t *first_shared; // by part and domain, and one more: into `shared`
  int64_t *shared;       // the shared points of a domain that cells of a part have, ascending; none for one part
  int64_t *open_cell;    // by open face: the number in its part of the cell that has it; none for one part
  int32_t *open_part;    // the same: its part
} CwDivision;

// Divides into `parts` parts. CW_ERR_EXPORT where there are fewer cells; alike on all ranks.
CwStatus cw_division_plan(const CwAssembly *assembly, int parts, CwDivision *division);

// Counts what each region gives to each part, for which every region is read again where there are several parts.
// Collective, though it may fail on a rank alone.
CwStatus cw_division_count(CwDivision *division, const CwRanks *ranks);
void cw_division_free(CwDivision *division);

// The piece of its region that each cell lies in, from 0, and its number in the part.
CwStatus cw_division_cells(const CwDivision *division, int region, const CwRegionData *data, int32_t *piece,
                           int64_t *number);

// The numbers in its part of the points of a region that cells of a piece have, else -1. `piece_of`: by cell.
void cw_division_points(const CwDivision *division, int region, int piece, const CwRegionData *data,
                        const int32_t *piece_of, int64_t *number);

// The number in a part of a shared point of a domain that its cells have.
int64_t cw_division_shared(const CwDivision *division, int part, int domain, int64_t shared_id);
