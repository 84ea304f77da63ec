// SPDX-License-Identifier: AGPL-3.0-or-later
// The surfaces of a domain that bear no layers: interfaces on the partition planes (paper, section 2.2), with the rule
// of region numbers (2.3), and open patches: inlet, outlet and rotor/stator interface, inside the marched open edges.
// Of it a rank needs what bounds its regions.
#pragma once

#include <stdint.h>

#include "mesher/boundary/free_curves.h"
#include "mesher/network/periodic_images.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int32_t count;
  int32_t (*triangle)[3], *face, *region; // normal out of the domain; CAD face; region inside
} CwOpenPatches;

typedef struct {
  int32_t count;
  int32_t (*triangle)[3], (*region)[2]; // normal from region [0] to region [1]
} CwInterfaceTriangles;

typedef struct {
  CwNodeTable nodes;   // those of the free curves, then the others
  CwNodeImages images; // of the nodes
  int32_t outline_count;
  CwInterfaceOutline *outline; // of all planes, by node
  CwImages outline_images;     // where turns take each outline
  CwOpenPatches open_patch;
  CwInterfaceTriangles refined; // that the regions have
  CwInterfaceTriangles planned; // before the rule of region numbers (interface_rule.h); NULL without it
  CwHostMemory *memory;         // where its arrays lie; NULL: they are this rank's
} CwInterfaces;

// The triangles on the planes, or those `planned` where there are such.
static inline const CwInterfaceTriangles *cw_interfaces_of(const CwInterfaces *interfaces, int planned) {
  return planned && interfaces->planned.triangle ? &interfaces->planned : &interfaces->refined;
}

// Checks what finished interfaces hold: corners within the nodes and distinct, the two regions of a triangle distinct,
// outlines whose triangles follow one another, and each edge of one outline in two of its triangles, but for those of
// its loops, which are in one. CW_ERR_FAULT with the first that does not hold. regions: their number.
CwStatus cw_interfaces_audit(const CwInterfaces *interfaces, int32_t regions);

// Writes open patches and interfaces as VTK PolyData (cell data face, -1 on interfaces; region, the lower of two), for
// a look.
CwStatus cw_interfaces_vtk(const CwInterfaces *interfaces, const char *path);

// Shows its arrays (CwArrays).
void cw_interfaces_arrays(void *interfaces, CwArrayVisit visit, void *given);
void cw_interfaces_free(CwInterfaces *interfaces);

#ifdef __cplusplus
}
#endif
