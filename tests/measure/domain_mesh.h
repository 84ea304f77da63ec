// SPDX-License-Identifier: AGPL-3.0-or-later
// All regions of one domain of a finished run.
#pragma once

#include "mesher/region/region_file.h"

typedef struct {
  int32_t region_count;
  CwRegionMesh *region;
} CwDomainMesh;

// Reads MESH_DIR/DOMAIN-0001.h5 and those after it.
CwStatus cw_domain_mesh_read(const char *mesh_dir, const char *domain, CwDomainMesh *mesh);
void cw_domain_mesh_free(CwDomainMesh *mesh);
