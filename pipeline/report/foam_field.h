// SPDX-License-Identifier: AGPL-3.0-or-later
// A field of a solved OpenFOAM case: its values by cell and by boundary face, as the solver wrote them (binary).
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "pipeline/status.h"

enum { CW_FOAM_NAME_SIZE = 64, CW_FOAM_COMPONENTS = 3 };

// Values in the file, or one for all.
typedef struct {
  char patch[CW_FOAM_NAME_SIZE]; // "" of the cells
  const char *bytes;             // NULL: uniform
  int64_t count;                 // of a list
  double uniform[CW_FOAM_COMPONENTS];
} CwFoamValues;

typedef struct {
  char *map; // the file
  size_t size;
  int components, scalar_size; // 1 or 3; 4 or 8 bytes
  CwFoamValues cells;
  CwFoamValues *patch; // those patches that have values in the file
  int patch_count, patch_capacity;
} CwFoamField;

// Maps a volScalarField or volVectorField. Zeroed `field` on entry; free it with cw_foam_field_close, also after a
// failure. CW_ERR_IO; CW_ERR_INPUT where it is no such field, is not binary, of another machine, or cut short.
CwStatus cw_foam_field_open(const char *path, CwFoamField *field);
void cw_foam_field_close(CwFoamField *field);

// The values of a patch; NULL where the file has none.
const CwFoamValues *cw_foam_field_patch(const CwFoamField *field, const char *patch);

// Value `index`, below the count unless uniform, with as many components as the field has.
void cw_foam_field_value(const CwFoamField *field, const CwFoamValues *values, int64_t index, double *value);
