// SPDX-License-Identifier: AGPL-3.0-or-later
// pump.cgns: the whole mesh with families, boundary conditions and the GGI connections of the domains.
#pragma once

#include "export/cgns_sections.h"
#include "export/interface.h"
#include "export/place_file.h"
#include "pipeline/case.h"

// The file as the ranks fill it: HDF5 lays its arrays down, each in one piece, and tells where. Zeroed: not open.
typedef struct {
  int wide; // 64-bit integers
  CwCgnsProfile profile;
  const CwAssembly *assembly;
  CwPlaceFile file;
  CwFileSum sum;   // of what this rank has written; on rank 0 also of the nodes
  int64_t size;    // of the file, bytes
  int64_t *starts; // bytes of the arrays, domain by domain: three of coordinates, then those of its sections
  CwSection *sections[CW_DOMAINS_MOST]; // of each domain, as they lie in the file; freed by cw_cgns_close()
  int section_count[CW_DOMAINS_MOST];
  int first_array[CW_DOMAINS_MOST + 1]; // of each domain
} CwCgnsFile;

// Whether the integers have 64 bits. CW_ERR_EXPORT where a zone has more than 2^31 - 1 points or elements and the case
// asks for 32.
CwStatus cw_cgns_plan(const CwAssembly *assembly, CwIntegers integers, int *wide);

// Lays down every node, with space for the coordinates and the connectivities. One rank calls it.
// `interfaces`: those of the mesh. CW_ERR_IO, CW_ERR_LIBRARY.
CwStatus cw_cgns_tree_write(const char *path, const CwAssembly *assembly, const CwInterface *interfaces,
                            const CwCase *table, int wide);

// Opens FOLDER/pump.cgns, laid down, on all ranks, for regions to be written from any rank in any order. Fails on all
// ranks alike. Zeroed `file` on entry but for `wide` and `profile`. Collective.
CwStatus cw_cgns_open(const char *folder, const CwAssembly *assembly, const CwRanks *ranks, CwCgnsFile *file);

// Writes the coordinates of the shared points of all domains. One rank calls it. CW_ERR_IO.
CwStatus cw_cgns_write_shared(CwCgnsFile *file);

// Writes the own points, cells and boundary faces of a region. `data` is that region. CW_ERR_IO.
CwStatus cw_cgns_write_region(CwCgnsFile *file, int region, const CwRegionData *data);

// Closes it; fine where it is not open. CW_ERR_IO.
CwStatus cw_cgns_close(CwCgnsFile *file);

// Whether HDF5 could not close a file. It then ends in a segmentation fault within MPI_Finalize: the process has to end
// without it. Kept once a process, as the state of HDF5 that it tells of.
int cw_cgns_stuck(void);
