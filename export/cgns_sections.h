// SPDX-License-Identifier: AGPL-3.0-or-later
// The element numbering of a zone of pump.cgns.
#pragma once

#include "export/assembly.h"

// Codes of ElementType_t of the CGNS standard.
enum { CW_CGNS_TRI_3 = 5, CW_CGNS_QUAD_4 = 7, CW_CGNS_TETRA_4 = 10, CW_CGNS_PYRA_5 = 12, CW_CGNS_PENTA_6 = 14 };

typedef struct {
  char name[CW_MESH_NAME_SIZE];
  int type, nodes;      // ElementType_t, nodes of an element
  int patch;            // -1 for cells
  int64_t first, count; // 1-based number of the first element
} CwSection;

// The sections of a zone that have elements, in order, as a new array.
CwStatus cw_cgns_sections(const CwAssembly *assembly, int domain, CwSection **sections, int *count);

// 1-based number of the first boundary element of a patch in its zone.
int64_t cw_cgns_patch_first(const CwAssembly *assembly, int patch);
