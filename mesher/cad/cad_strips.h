// SPDX-License-Identifier: AGPL-3.0-or-later
// Chains of narrow faces: what cad_leave_out.h can leave out. In C++ for the bridge only.
#pragma once

#include <vector>

#include "mesher/cad/cad.h"
#include "mesher/cad/cad_shape.h"

enum { CW_CAD_STRIP_SAMPLES = 9 };

// An edge in the sense in which a loop of a face runs through it.
struct CwCadUse {
  int edge;
  bool reversed;
};

// Sides and ends in the order of the loop: side[0], end[0], side[1], end[1].
struct CwCadChainStrip {
  int face;
  std::vector<CwCadUse> side[2];
  CwCadUse end[2];
  int stays;                          // side of the row that stays
  bool broken;                        // what would follow in its chain cannot go
  double length;                      // of the longer side, m
  double width[CW_CAD_STRIP_SAMPLES]; // from side to side at even steps along it, m
  double x[CW_CAD_STRIP_SAMPLES][3];  // middles there
};

typedef std::vector<CwCadChainStrip> CwCadChain;

// The face across an edge of a face.
int cw_cad_beyond(const CwCad *cad, int edge, int face);
// Parameter of the edge at a share of its range, as it is used.
double cw_cad_use_at(const CwCad *cad, const CwCadUse &use, double share);
// The vertex at which the use of an edge begins (end: 0) or ends (1).
int cw_cad_use_vertex(const CwCad *cad, const CwCadUse &use, int end);
// Whether a side begins or ends at a vertex.
bool cw_cad_side_ends_at(const CwCad *cad, const std::vector<CwCadUse> &side, int vertex);

std::vector<CwCadChain> cw_cad_chains(const CwCad *cad);
