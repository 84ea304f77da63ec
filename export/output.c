// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/output.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export/cfx_case.h"
#include "export/fluent_case.h"
#include "export/foam_case.h"
#include "export/foam_mesh.h"
#include "export/foam_region.h"
#include "export/saturne_case.h"
#include "pipeline/atomic_file.h"

const char *const cw_output_names[CW_FORMATS] = {[CW_FORMAT_CGNS] = "pump.cgns",
                                                 [CW_FORMAT_OPENFOAM] = "openfoam",
                                                 [CW_FORMAT_CFX] = "cfx",
                                                 [CW_FORMAT_FLUENT] = "fluent",
                                                 [CW_FORMAT_SATURNE] = "code_saturne"};

// Those that are a few files beside pump.cgns.
typedef CwStatus (*CaseWriter)(const char *folder, const CwCase *table, const CwAssembly *assembly);
static const CaseWriter beside_cgns[CW_FORMATS] = {[CW_FORMAT_CFX] = cw_cfx_case_write,
                                                   [CW_FORMAT_SATURNE] = cw_saturne_case_write};

int cw_output_has(const CwOutput *output, CwFormat format) {
  return output->formats >> format & 1;
}

const char *cw_output_known_by(const CwOutput *o) {
  if (cw_output_has(o, CW_FORMAT_CGNS)) return "pump.cgns";
  if (cw_output_has(o, CW_FORMAT_FLUENT)) return "fluent/pump.msh";
  return cw_foam_is_divided(&o->foam) ? "openfoam/processor0/constant/polyMesh/points"
                                      : "openfoam/constant/polyMesh/points";
}

static CwStatus join(const char *folder, const char *name, char **path) {
  CwStatus status = CW_OK;
  CW_REQUIRE(asprintf(path, "%s/%s", folder, name) >= 0, CW_ERR_MEMORY, "out of memory");
done:
  return status;
}

static CwStatus plan_one(CwOutput *o, CwFormat format) {
  switch (format) {
  case CW_FORMAT_CGNS:
    return cw_cgns_plan(o->assembly, o->table->output.cgns_integers, &o->cgns.wide);
  case CW_FORMAT_OPENFOAM:
    return cw_foam_layout_plan(o->assembly, o->foam_folder, &o->table->output, &o->foam);
  case CW_FORMAT_FLUENT:
    return cw_fluent_mesh_plan(o->assembly, &o->fluent);
  default:
    return CW_OK;
  }
}

CwStatus cw_output_plan(const CwCase *table, const CwAssembly *assembly, const char *folder, CwOutput *o) {
  CwStatus status = CW_OK;
  int on_cgns = 0;
  for (int f = 0; f < CW_FORMATS; ++f)
    if (beside_cgns[f]) on_cgns |= 1 << f;
  o->table = table;
  o->assembly = assembly;
  CW_REQUIRE((o->folder = strdup(folder)), CW_ERR_MEMORY, "out of memory");
  CW_TRY(join(folder, cw_output_names[CW_FORMAT_CGNS], &o->cgns_path));
  CW_TRY(join(folder, cw_output_names[CW_FORMAT_OPENFOAM], &o->foam_folder));
  CW_TRY(join(folder, cw_output_names[CW_FORMAT_FLUENT], &o->fluent_folder));
  o->formats = table->output.formats;
  if (o->formats & on_cgns) o->formats |= 1 << CW_FORMAT_CGNS;
  for (int f = 0; f < CW_FORMATS; ++f) {
    if (!cw_output_has(o, (CwFormat)f)) continue;
    status = plan_one(o, (CwFormat)f);
    if (status != CW_ERR_EXPORT) CW_TRY(status);
    if (status == CW_OK) continue;
    snprintf(o->left_out[f], sizeof o->left_out[f], "%s is left out: %s", cw_output_names[f], cw_fail_message());
    o->formats &= ~(1 << f | (f == CW_FORMAT_CGNS ? on_cgns : 0));
  }
  CW_REQUIRE(o->formats, CW_ERR_EXPORT, "%s", cw_fail_message());
  status = CW_OK;
done:
  return status;
}

CwStatus cw_output_begin(CwOutput *o, const CwInterface *interfaces) {
  CwStatus status = CW_OK;
  char *path = NULL;
  CW_TRY(cw_make_directory(o->folder));
  if (cw_output_has(o, CW_FORMAT_CGNS))
    CW_TRY(cw_cgns_tree_write(o->cgns_path, o->assembly, interfaces, o->table, o->cgns.wide));
  if (cw_output_has(o, CW_FORMAT_OPENFOAM)) {
    CW_TRY(cw_make_directory(o->foam_folder));
    CW_TRY(cw_foam_case_write(o->foam_folder, o->table, o->assembly));
  }
  for (int f = 0; f < CW_FORMATS; ++f) {
    if (!beside_cgns[f] || !cw_output_has(o, (CwFormat)f)) continue;
    free(path);
    path = NULL;
    CW_TRY(join(o->folder, cw_output_names[f], &path));
    CW_TRY(cw_make_directory(path));
    CW_TRY(beside_cgns[f](path, o->table, o->assembly));
  }
  if (cw_output_has(o, CW_FORMAT_FLUENT)) {
    CW_TRY(cw_make_directory(o->fluent_folder));
    CW_TRY(cw_fluent_mesh_create(o->fluent_folder, &o->fluent));
    CW_TRY(cw_fluent_case_write(o->fluent_folder, o->table, o->assembly));
  }
done:
  free(path);
  return status;
}

CwStatus cw_output_open(CwOutput *o, const CwRanks *ranks) {
  CwStatus status = CW_OK;
  if (cw_output_has(o, CW_FORMAT_CGNS)) CW_TRY(cw_cgns_open(o->folder, o->assembly, ranks, &o->cgns));
  if (cw_output_has(o, CW_FORMAT_FLUENT)) status = cw_fluent_mesh_open(o->fluent_folder, &o->fluent);
  CW_TRY(cw_ranks_agree(ranks, status));
  if (cw_output_has(o, CW_FORMAT_OPENFOAM)) CW_TRY(cw_foam_mesh_create(&o->foam, ranks));
  if (ranks->rank == 0 && cw_output_has(o, CW_FORMAT_CGNS)) CW_TRY(cw_cgns_write_shared(&o->cgns));
done:
  return status;
}

CwStatus cw_output_write_region(CwOutput *o, int region, const CwRegionData *data, const CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  if (cw_output_has(o, CW_FORMAT_CGNS)) CW_TRY(cw_cgns_write_region(&o->cgns, region, data));
  if (cw_output_has(o, CW_FORMAT_OPENFOAM)) CW_TRY(cw_foam_region_write(&o->foam, region, data, faces));
  if (cw_output_has(o, CW_FORMAT_FLUENT)) CW_TRY(cw_fluent_mesh_write_region(&o->fluent, region, data, faces));
done:
  return status;
}

static void keep_first(CwStatus *status, CwStatus next) {
  if (*status == CW_OK) *status = next;
}

CwStatus cw_output_close(CwOutput *o) {
  CwStatus status = CW_OK;
  keep_first(&status, cw_cgns_close(&o->cgns));
  keep_first(&status, cw_fluent_mesh_close(&o->fluent));
  return status;
}

CwStatus cw_output_digest(const CwOutput *o, const CwRanks *ranks, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  char *path = NULL;
  if (cw_output_has(o, CW_FORMAT_CGNS)) {
    cw_ranks_sum_digest(ranks, o->cgns.sum, o->cgns.size, digest);
  } else {
    CW_TRY(cw_ranks_agree(ranks, join(o->folder, cw_output_known_by(o), &path)));
    CW_TRY(cw_ranks_file_digest(ranks, path, digest));
  }
done:
  free(path);
  return status;
}

void cw_output_free(CwOutput *o) {
  cw_foam_layout_free(&o->foam);
  cw_cgns_close(&o->cgns);
  cw_fluent_mesh_close(&o->fluent);
  free(o->folder);
  free(o->cgns_path);
  free(o->foam_folder);
  free(o->fluent_folder);
  *o = (CwOutput){0};
}
