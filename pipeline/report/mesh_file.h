// SPDX-License-Identifier: AGPL-3.0-or-later
// The mesh of a run as the report reads it: the manifest, and one region at a time.
#ifndef CUTWATER_PIPELINE_REPORT_MESH_FILE_H
#define CUTWATER_PIPELINE_REPORT_MESH_FILE_H

#include <stdint.h>

#include "pipeline/status.h"

enum { CW_REPORT_DOMAINS_MOST = 8, CW_REPORT_ROTOR = 0, CW_REPORT_STATOR = 1, CW_REPORT_PATCHES = 64 };

typedef struct {
  char *file; // within RUN/mesh
  int region, number;
  int64_t points, own_points, tetrahedra, pyramids, prisms, triangles, quads;
} CwReportRegion;

typedef struct {
  char *name;
  char *patch[CW_REPORT_PATCHES];
  int patch_count;
  CwReportRegion *region;
  int region_count;
} CwReportDomain;

typedef struct {
  char *folder; // RUN/mesh
  char *case_name;
  int domain_count;
  CwReportDomain domain[CW_REPORT_DOMAINS_MOST]; // rotor, stator, then pipes that are zones of their own
} CwReportMesh;

// Reads RUN/mesh/manifest.json. CW_ERR_IO, CW_ERR_INPUT. Free with cw_report_mesh_free, also after a failure.
CwStatus cw_report_mesh_read(const char *run, CwReportMesh *mesh);
void cw_report_mesh_free(CwReportMesh *mesh);

// Index of a patch in its domain, or -1.
int cw_report_patch(const CwReportDomain *domain, const char *name);

// What pictures need of a region file; the names are those of docs/file-formats.md.
typedef struct {
  int32_t points, tetrahedra, pyramids, prisms, triangles, quads;
  double (*x)[3]; // m
  int32_t (*tetrahedron)[4], (*pyramid)[5], (*prism)[6];
  int32_t (*triangle)[3], *triangle_patch, (*quad)[4], *quad_patch;
} CwReportCells;

// Reads region `r` of domain `d`; without its cells where `with_cells` is 0. Checks sizes against the
// manifest and every index. CW_ERR_IO, CW_ERR_INPUT. Free with cw_report_cells_free, also after a failure.
CwStatus cw_report_cells_read(const CwReportMesh *mesh, int d, int r, int with_cells, CwReportCells *cells);
void cw_report_cells_free(CwReportCells *cells);

#endif
