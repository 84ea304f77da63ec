// SPDX-License-Identifier: AGPL-3.0-or-later
// Narrow faces left out of the topology (virtual topology: A. Sheffer, T. Blacker, J. Clements, M. Bercovier, 1997).
// A strip is a wall face with two long sides and two short ends. Strips that share an end form a chain, such as the
// root fillet round a blade; the two rows of sides of a chain border other walls:
//
//      Q   |   Q     |          Q   |   Q     |
//     -----+---------+- B           |         |        B and the ends vanish,
//       F  |    F'   |        ------+---------+- A     A is the edge of P and Q
//     -----+---------+- A
//      P       P     |              P     P   |
//
// The row that stays is the longer one. On Q, the edge A has the (u,v) of B; edges that ended at B end at A. A face
// whose edges are all ends of strips that go, a corner in which three fillets meet, goes with them to one of its
// vertices.
#pragma once

#include "mesher/cad/cad.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_STRIP_SAMPLES = 9 };

typedef struct {
  int face, chain;
  double length;                  // of the longer side, m
  double width[CW_STRIP_SAMPLES]; // from side to side at even steps along it, m
  double x[CW_STRIP_SAMPLES][3];  // middles there
} CwCadStrip;

// Lists the strips of all chains that can be left out: walls with walls beyond both sides that go on in one surface, or
// meet in a concave edge of 30 degrees or more (so that no nose of a blade and no step is one). Chains are numbered
// from 0 on without gaps. *strips [out]: malloc'd, by chain. CW_ERR_MEMORY.
CwStatus cw_cad_strips_find(const CwCad *cad, int *count, CwCadStrip **strips);

// Leaves out chains, numbered as cw_cad_strips_find does, and the corners between them, in this order; one that touches
// an earlier one elsewhere, or takes the last face of a patch, stays. Edges and vertices are numbered anew, faces are
// not: one that is left out keeps its number, but bounds no edge. Returns the number of faces left out in *faces. Once
// for a solid, after cw_cad_rescale.
CwStatus cw_cad_leave_out(CwCad *cad, int chain_count, const int *chain, int *faces);

// Whether a face was left out: it is a wall still, but is not meshed.
int cw_cad_face_is_left_out(const CwCad *cad, int face);
// Whether layers grow on the face (cw_cad_face_is_wall) and it is meshed.
int cw_cad_face_is_meshed_wall(const CwCad *cad, int face);
// Greatest width of a face that was left out, m; 0 for others.
double cw_cad_face_left_out_width(const CwCad *cad, int face);
// The left-out face that the edge borders in place of the face behind it, or -1; *gap (NULL: not wanted): how far the
// edge lies off that one, m.
int cw_cad_edge_stands_for(const CwCad *cad, int edge, double *gap);
// Whether the edge borders both faces, one of them perhaps in place of a left-out one.
int cw_cad_edge_borders(const CwCad *cad, int edge, int face, int other);
// How far the edge lies beside one of its faces, m: 0, but for edges that stay beside left-out faces.
double cw_cad_edge_gap(const CwCad *cad, int edge, int face);
// How far an end (0 or 1) of the edge was moved, m.
double cw_cad_edge_end_gap(const CwCad *cad, int edge, int end);

#ifdef __cplusplus
}
#endif
