// SPDX-License-Identifier: AGPL-3.0-or-later
// pump.cgns: the whole mesh with families, boundary conditions and the GGI connections of the domains.
#ifndef CUTWATER_EXPORT_CGNS_FILE_H
#define CUTWATER_EXPORT_CGNS_FILE_H

#include <hdf5.h>

#include "export/assembly.h"
#include "export/interface.h"
#include "pipeline/case.h"

// Whether the integers have 64 bits. CW_ERR_EXPORT where a zone has more than 2^31 - 1 points or elements and the case
// asks for 32.
CwStatus cw_cgns_plan(const CwAssembly *assembly, CwIntegers integers, int *wide);

// Lays down every node, with space for the coordinates and the connectivities. One rank calls it.
// `interfaces`: those of the mesh. CW_ERR_IO, CW_ERR_LIBRARY.
CwStatus cw_cgns_tree_write(const char *path, const CwAssembly *assembly, const CwInterface *interfaces,
                            const CwCase *table, int wide);

// Opens a laid down file on all ranks (collective), for regions to be written from any rank in any order.
CwStatus cw_cgns_open(const char *path, const CwRanks *ranks, hid_t *file);

// Writes the coordinates of the shared points of all domains. One rank calls it.
CwStatus cw_cgns_write_shared(hid_t file, const CwAssembly *assembly);

// Writes the own points, cells and boundary faces of a region. `data` is that region.
CwStatus cw_cgns_write_region(hid_t file, const CwAssembly *assembly, int region, const CwRegionData *data, int wide);

// Closes it; collective for an opened one. CW_ERR_IO.
CwStatus cw_cgns_close(hid_t file);

// Whether a file could not be closed on this rank. HDF5 then ends in a segmentation fault within MPI_Finalize: the
// process has to end without it. Kept once a process, as the state of HDF5 that it tells of.
int cw_cgns_stuck(void);

#endif
