// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/output.h"

#include <stdio.h>
#include <stdlib.h>

#include "export/cfx_case.h"
#include "export/fluent_case.h"
#include "export/folder.h"
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
enum { ON_CGNS = 1 << CW_FORMAT_CFX | 1 << CW_FORMAT_SATURNE };

// What writes the files beside a mesh into a folder, which it makes.
typedef CwStatus (*CaseWriter)(const char *folder, const CwCase *table, const CwAssembly *assembly);
static const CaseWriter case_writers[CW_FORMATS] = {[CW_FORMAT_OPENFOAM] = cw_foam_case_write,
                                                    [CW_FORMAT_CFX] = cw_cfx_case_write,
                                                    [CW_FORMAT_FLUENT] = cw_fluent_case_write,
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

static CwStatus plan_one(CwOutput *o, CwFormat format) {
  switch (format) {
  case CW_FORMAT_CGNS:
    o->cgns.profile = o->table->output.cgns_profile;
    return cw_cgns_plan(o->assembly, o->table->output.cgns_integers, &o->cgns.wide);
  case CW_FORMAT_OPENFOAM:
    return cw_foam_layout_plan(o->assembly, o->paths[format], &o->table->output, &o->foam);
  case CW_FORMAT_FLUENT:
    return cw_fluent_mesh_plan(o->assembly, &o->fluent);
  default:
    return CW_OK;
  }
}

// What cannot hold the mesh, as the last failure tells; that failure where no format is left.
static CwStatus leave_out(CwOutput *o, CwFormat format) {
  const int is_read = format == CW_FORMAT_CGNS && (o->formats & ON_CGNS);
  snprintf(o->left_out[format], sizeof o->left_out[format], "%s is left out%s: %s", cw_output_names[format],
           is_read ? ", and what reads it" : "", cw_fail_message());
  o->formats &= ~(1 << format | (format == CW_FORMAT_CGNS ? ON_CGNS : 0));
  return o->formats ? CW_OK : CW_ERR_EXPORT;
}

CwStatus cw_output_plan(const CwCase *table, const CwAssembly *assembly, const char *folder, CwOutput *o) {
  CwStatus status = CW_OK;
  o->table = table;
  o->assembly = assembly;
  CW_TRY(cw_path_set(&o->folder, "%s", folder));
  for (int f = 0; f < CW_FORMATS; ++f) CW_TRY(cw_path_set(&o->paths[f], "%s/%s", folder, cw_output_names[f]));
  o->formats = table->output.formats;
  if (o->formats & ON_CGNS) o->formats |= 1 << CW_FORMAT_CGNS;
  for (int f = 0; f < CW_FORMATS; ++f) {
    if (!cw_output_has(o, (CwFormat)f)) continue;
    status = plan_one(o, (CwFormat)f);
    if (status == CW_ERR_EXPORT) status = leave_out(o, (CwFormat)f);
    CW_TRY(status);
  }
done:
  return status;
}

CwStatus cw_output_begin(CwOutput *o, const CwInterface *interfaces) {
  CwStatus status = CW_OK;
  CW_TRY(cw_make_directory(o->folder));
  if (cw_output_has(o, CW_FORMAT_CGNS))
    CW_TRY(cw_cgns_tree_write(o->paths[CW_FORMAT_CGNS], o->assembly, interfaces, o->table, o->cgns.wide));
  for (int f = 0; f < CW_FORMATS; ++f)
    if (case_writers[f] && cw_output_has(o, (CwFormat)f)) CW_TRY(case_writers[f](o->paths[f], o->table, o->assembly));
  if (cw_output_has(o, CW_FORMAT_FLUENT)) CW_TRY(cw_fluent_mesh_create(o->paths[CW_FORMAT_FLUENT], &o->fluent));
done:
  return status;
}

CwStatus cw_output_open(CwOutput *o, const CwRanks *ranks) {
  CwStatus status = CW_OK;
  if (cw_output_has(o, CW_FORMAT_CGNS)) CW_TRY(cw_cgns_open(o->folder, o->assembly, ranks, &o->cgns));
  if (cw_output_has(o, CW_FORMAT_FLUENT)) status = cw_fluent_mesh_open(o->paths[CW_FORMAT_FLUENT], &o->fluent);
  CW_TRY(cw_ranks_agree(ranks, status));
  if (cw_output_has(o, CW_FORMAT_OPENFOAM)) {
    status = cw_foam_mesh_create(&o->foam, ranks);
    if (status == CW_ERR_EXPORT) status = leave_out(o, CW_FORMAT_OPENFOAM); // on all ranks: parts are counted alike
    CW_TRY(status);
  }
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

CwStatus cw_output_close(CwOutput *o) {
  const CwStatus cgns = cw_cgns_close(&o->cgns), fluent = cw_fluent_mesh_close(&o->fluent);
  return cgns != CW_OK ? cgns : fluent;
}

CwStatus cw_output_digest(const CwOutput *o, const CwRanks *ranks, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  char *path = NULL;
  if (cw_output_has(o, CW_FORMAT_CGNS)) {
    cw_ranks_sum_digest(ranks, o->cgns.sum, o->cgns.size, digest);
  } else {
    CW_TRY(cw_ranks_agree(ranks, cw_path_set(&path, "%s/%s", o->folder, cw_output_known_by(o))));
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
  for (int f = 0; f < CW_FORMATS; ++f) free(o->paths[f]);
  *o = (CwOutput){0};
}
