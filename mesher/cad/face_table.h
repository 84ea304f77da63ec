// SPDX-License-Identifier: AGPL-3.0-or-later
// The rows of faces.csv that belong to one domain: patch, kind and name of each CAD face.
#pragma once

#include "pipeline/case.h"
#include "pipeline/model.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  char name[CW_NAME_SIZE];
  CwPatchKind kind;
} CwFacePatch;

typedef struct {
  int patch; // index into CwFaceTable.patch; -1: the file has no row for this face
  char name[CW_NAME_SIZE];
} CwFaceRow;

typedef struct {
  int face_count, patch_count;
  CwFaceRow *face;    // by 0-based face
  CwFacePatch *patch; // in the order of their first row
} CwFaceTable;

// Reads the rows of `domain` from `path` (columns domain,face,patch,kind,name). Fails with CW_ERR_INPUT and
// FILE:LINE on a wrong row, a face outside 1..face_count, a face that is named twice or not at all, a patch
// with two kinds.
CwStatus cw_face_table_read(const char *path, const char *domain, int face_count, CwFaceTable *table);
void cw_face_table_free(CwFaceTable *table);

#ifdef __cplusplus
}
#endif
