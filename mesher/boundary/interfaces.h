// SPDX-License-Identifier: AGPL-3.0-or-later
// The surfaces of a domain that bear no layers: interfaces on the partition planes (paper, section 2.2), with the rule
// of region numbers (2.3), and open patches: inlet, outlet and rotor/stator interface, inside the marched open edges.
// Of it a rank needs what bounds its regions.
#ifndef CUTWATER_MESHER_BOUNDARY_INTERFACES_H
#define CUTWATER_MESHER_BOUNDARY_INTERFACES_H

#include <stdint.h>

#include "mesher/network/periodic_images.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Nodes 0 .. vertices of the surface mesh - 1 stand on the layer top, one over each vertex; the others lie on free
// curves, open patches and interfaces.
typedef struct {
  int32_t count, capacity;
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
  // Set when the inner surfaces are merged:
  int32_t free_start, free_count;         // its inner nodes, as planned
  int32_t triangle_start, triangle_count; // its triangles as planned,
  int32_t refined_start, refined_count;   // and by the rule of region numbers
} CwInterfaceOutline;

typedef struct {
  int32_t count;
  int32_t (*triangle)[3], *face, *region; // normal out of the domain; CAD face; region inside
} CwOpenPatches;

typedef struct {
  int32_t count;
  int32_t (*triangle)[3], (*region)[2]; // normal from region [0] to region [1]
} CwInterfaceTriangles;

typedef struct {
  CwNodeTable nodes;
  CwNodeImages images;  // of the nodes
  int32_t *corner_node; // of each corner of the network, or -1
  int32_t curve_count;
  CwCurveNodes *curve; // along each curve of the network; none along wall curves
  int32_t tight_count; // places where layers leave no room for a free curve, or layer top and free curves cross
  double (*tight)[3];
  CwOpenPatches open_patch;
  int32_t outline_count;
  CwInterfaceOutline *outline;
  CwImages outline_images;      // without symmetry none
  CwInterfaceTriangles refined; // that the regions have
  CwInterfaceTriangles planned; // before the rule of region numbers (interface_rule.h); NULL without it
} CwInterfaces;

// Checks what finished interfaces hold: corners within the nodes and distinct, the two regions of a triangle distinct,
// outlines whose triangles follow one another, and each edge of one outline in two of its triangles, but for those of
// its loops, which are in one. CW_ERR_MESH with the first that does not hold. regions: their number.
CwStatus cw_interfaces_audit(const CwInterfaces *interfaces, int32_t regions);

// Writes open patches and interfaces as VTK PolyData (cell data face, -1 on interfaces; region, the lower of two), for
// a look.
CwStatus cw_interfaces_vtk(const CwInterfaces *interfaces, const char *path);

// Appends a node while interfaces are made.
CwStatus cw_interfaces_add_node(CwInterfaces *interfaces, const double x[3], int on_plane, int32_t *node);

void cw_interfaces_free(CwInterfaces *interfaces);

#ifdef __cplusplus
}
#endif
#endif
