// SPDX-License-Identifier: AGPL-3.0-or-later
// The free curves of a domain divided into mesh edges between the ends of the layers, and the outlines that they and
// the layer top leave on the partition planes (paper, section 2.2): what open patches and interfaces are meshed inside
// of.
#pragma once

#include <stdint.h>

#include "mesher/network/network.h"
#include "mesher/network/periodic_images.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Nodes 0 .. vertices of the surface mesh - 1 stand on the layer top, one over each vertex; the others lie on free
// curves, open patches and interfaces.
typedef struct {
  int32_t count, x_capacity, plane_capacity;
  double (*x)[3];
  uint8_t *on_plane; // the node (and its column) is shared by regions
} CwNodeTable;

// One outline on a partition plane: an interface between two regions.
typedef struct {
  int32_t node;         // plan node of its plane
  int32_t corner_count; // of all loops
  int32_t loop_count;
  int32_t *loop_start; // loop_count + 1
  int32_t *corner;     // nodes
  // Set when the interfaces are merged:
  int32_t free_start, free_count;         // its inner nodes, as planned
  int32_t triangle_start, triangle_count; // its triangles as planned,
  int32_t refined_start, refined_count;   // and by the rule of region numbers
} CwInterfaceOutline;

typedef struct {
  CwNodeTable nodes;
  CwNodeImages images;  // of the nodes
  int32_t corner_count; // of the network
  int32_t *corner_node; // of each of them, or -1
  int32_t curve_count;
  CwCurveNodes *curve;                 // along each curve of the network; none along wall curves
  int32_t tight_count, tight_capacity; // places where layers leave no room for a free curve, or cross one
  double (*tight)[3];                  // m
  int32_t outline_count, outline_capacity;
  CwInterfaceOutline *outline; // of all planes, by node
  CwImages outline_images;     // where turns take each outline
  CwHostMemory *memory;        // where its arrays lie; NULL: they are this rank's
} CwFreeCurves;

// Checks what free curves hold that are not tight: each begins and ends at the nodes of its corners, with distinct
// nodes between, and outlines whose loops have three corners or more, all of them nodes on planes. CW_ERR_FAULT with
// the first that does not hold.
CwStatus cw_free_curves_audit(const CwFreeCurves *free_curves, const CwNetwork *network);

// Appends a node.
CwStatus cw_node_table_add(CwNodeTable *nodes, const double x[3], int on_plane, int32_t *node);

// Shows the arrays (CwArrays): of all; of a table of nodes; of outlines with their images.
void cw_free_curves_arrays(void *free_curves, CwArrayVisit visit, void *given);
void cw_node_table_arrays(CwNodeTable *nodes, CwArrayVisit visit, void *given);
void cw_outlines_arrays(int32_t count, CwInterfaceOutline **outline, CwImages *images, CwArrayVisit visit, void *given);
void cw_free_curves_free(CwFreeCurves *free_curves);

#ifdef __cplusplus
}
#endif
