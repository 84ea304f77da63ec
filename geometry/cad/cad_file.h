// SPDX-License-Identifier: AGPL-3.0-or-later
// The solids of CAD files: STEP (AP203, AP214, AP242) through XCAF, with the names of products, instances and faces,
// colours, layers, the unit of the file and the placement of assemblies; B-rep files of OpenCASCADE, which have none of
// these. A file with shells alone is sewn into solids, and a shell inside of another is a void of it.
#pragma once

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwCadBodies CwCadBodies;

// Adds the solids of a file to *bodies, which is made where it is NULL. `unit`: length of one unit of the file, m; of a
// STEP file 0 takes its own. `tolerance`: gaps up to it are sewn, m; 0: a share of what the faces reach over.
// CW_ERR_IO; CW_ERR_INPUT where the file is none of these, or holds no solid and its faces do not close.
CwStatus cw_cad_file_read(const char *path, double unit, double tolerance, CwCadBodies **bodies);
void cw_cad_bodies_free(CwCadBodies **bodies);

int cw_cad_body_count(const CwCadBodies *bodies);
// Of the product and of its place in an assembly; "" where the file has none.
const char *cw_cad_body_name(const CwCadBodies *bodies, int body);
const char *cw_cad_body_instance(const CwCadBodies *bodies, int body);
// Whether a point, m, lies inside, also of a solid whose faces point into it.
CwStatus cw_cad_body_holds(const CwCadBodies *bodies, int body, const double point[3], int *holds);

#ifdef __cplusplus
}
#endif
