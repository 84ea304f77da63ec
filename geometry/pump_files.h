// SPDX-License-Identifier: AGPL-3.0-or-later
// RUN/geometry: the files that a pump has wherever its solids come from, and others beside them. Each appears whole;
// record.json, written last by the program, says that all are there.
#pragma once

#include "geometry/solid.h"
#include "pipeline/model.h"
#include "pipeline/record.h"
#include "pipeline/stage_args.h"

typedef struct {
  int count; // of solids
  CwSolid *const *solid;
  const CwModel *model;
  // Others: write(given, k, path) writes other[k].
  int other_count;
  const char *const *other;
  CwStatus (*write)(const void *given, int k, const char *path);
  const void *given;
} CwPumpFiles;

// "RUN/geometry/NAME" in a new string to be freed.
CwStatus cw_geometry_path(const CwStageArgs *args, const char *name, char **path);

// faces.csv, the patch, kind and name of every CAD face of `count` solids, whole or not at all. The format is in
// docs/file-formats.md.
CwStatus cw_faces_table_write(const CwSolid *const *solids, int count, const char *path);

// Writes DOMAIN.brep of each solid, faces.csv, model.json, pump.step, the others, and pump_faces.step, which is made
// beside them (beside.h). The record gets their digests and the step "files".
CwStatus cw_pump_files_write(const CwStageArgs *args, const CwPumpFiles *files, CwRecord *record);
