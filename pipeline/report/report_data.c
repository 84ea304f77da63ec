// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/report_data.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/case_origin.h"
#include "pipeline/json_read.h"
#include "pipeline/sealed_json.h"
#include "pipeline/stage_files.h"

const char *const cw_report_stage[CW_STAGES] = {"geometry", "mesh", "export"};

static CwStatus read_record(const char *run, const CwCase *table, int stage, json_t **record) {
  CwStatus status = CW_OK;
  char path[4096];
  const char *name;
  json_t *value;
  snprintf(path, sizeof path, "%s/%s/record.json", run, cw_report_stage[stage]);
  if (!strcmp(cw_report_stage[stage], "export")) {
    if (access(path, F_OK) != 0) goto done; // not exported yet
    CW_TRY(cw_case_origin_check(table, run, "export"));
  }
  CW_TRY(cw_sealed_json_read(path, record));
  CW_TRY(cw_json_text(*record, path, "stage", &name));
  CW_REQUIRE(!strcmp(name, cw_report_stage[stage]), CW_ERR_INPUT, "%s: 'stage' is %s; it must be %s", path, name,
             cw_report_stage[stage]);
  CW_REQUIRE(cw_json_real(*record, "seconds") >= 0, CW_ERR_INPUT, "%s: 'seconds' must be a number from 0", path);
  CW_REQUIRE(cw_json_real(*record, "peak_memory_bytes") >= 0, CW_ERR_INPUT,
             "%s: 'peak_memory_bytes' must be a number from 0", path);
  CW_TRY(cw_json_array(*record, path, "steps", &value));
  for (size_t k = 0; k < json_array_size(value); k++) {
    json_t *step = json_array_get(value, k);
    CW_TRY(cw_json_text(step, path, "name", &name));
    CW_REQUIRE(cw_json_real(step, "seconds") >= 0, CW_ERR_INPUT, "%s: 'seconds' of step '%s' must be a number from 0",
               path, name);
  }
  CW_TRY(cw_json_array(*record, path, "warnings", &value));
  CW_TRY(cw_json_object(*record, path, "results", &value));
done:
  return status;
}

// The solved flow, where there is one, and whether it is of the export that lies there.
static CwStatus read_solve(const char *run, CwReportData *data) {
  CwStatus status = CW_OK;
  char path[4096];
  json_t *value, *made_from = NULL;
  snprintf(path, sizeof path, "%s/solve/record.json", run);
  if (access(path, F_OK) != 0) goto done;
  CW_TRY(cw_sealed_json_read(path, &data->solve));
  CW_TRY(cw_json_object(data->solve, path, "results", &value));
  CW_TRY(cw_json_array(data->solve, path, "warnings", &value));
  if (!data->record[CW_STAGE_OF_EXPORT]) goto done;
  CW_TRY(cw_stage_files_read(run, (const char *const[]){"export", NULL}, &made_from));
  data->is_solved = json_equal(json_object_get(data->solve, "made_from"), made_from);
done:
  json_decref(made_from);
  return status;
}

CwStatus cw_report_data_read(const char *run, const CwCase *table, CwReportData *data) {
  CwStatus status = CW_OK;
  char path[4096];
  *data = (CwReportData){.table = table};
  data->run = strdup(run);
  CW_REQUIRE(data->run, CW_ERR_MEMORY, "out of memory: a path");
  snprintf(path, sizeof path, "%s/geometry/design.json", run);
  if (access(path, F_OK) == 0) CW_TRY(cw_json_read(path, &data->design)); // else no generator made the pump
  for (int s = 0; s < CW_STAGES; s++) CW_TRY(read_record(run, table, s, &data->record[s]));
  CW_TRY(read_solve(run, data));
  CW_TRY(cw_mesh_manifest_read(run, &data->mesh));
  if (data->is_solved) CW_TRY(cw_flow_open(run, &data->mesh, table, &data->flow));
done:
  return status;
}

void cw_report_data_free(CwReportData *data) {
  free(data->run);
  json_decref(data->design);
  for (int s = 0; s < CW_STAGES; s++) json_decref(data->record[s]);
  json_decref(data->solve);
  cw_mesh_free(&data->mesh);
  cw_report_pictures_free(&data->pictures);
  cw_view_free(&data->view);
  cw_flow_close(&data->flow);
  *data = (CwReportData){0};
}

int cw_report_suction(const CwReportData *data) {
  const double side = cw_json_real(json_object_get(data->record[0], "results"), "suction_side");
  return side > 0 ? 1 : side < 0 ? -1 : cw_suction_side(data->table->impeller.rotation);
}

// Of a pump that no generator made: what the model says of it.
static CwPumpSizes sizes_of_model(const CwMesh *mesh, int suction) {
  CwPumpSizes sizes = {.blade_count = mesh->flow.blade_count,
                       .leading_radius = INFINITY,
                       .outlet_radius = 0.5 * mesh->flow.reference_length,
                       .suction = suction};
  sizes.interface_radius = sizes.outlet_radius;
  for (int i = mesh->interface_count - 1; i >= 0; i--)
    if (mesh->interfaces[i].surface == CW_SURFACE_CYLINDER) sizes.interface_radius = mesh->interfaces[i].radius;
  sizes.base_radius = sizes.interface_radius;
  return sizes;
}

// From the design: the case may leave any of them open.
CwStatus cw_report_sizes(const CwReportData *data, CwPumpSizes *sizes) {
  CwStatus status = CW_OK;
  if (!data->design) {
    *sizes = sizes_of_model(&data->mesh, cw_report_suction(data));
    return CW_OK;
  }
  static const char *const keys[] = {"blade_count", "outlet_diameter_m", "interface_radius_m", "base_diameter_m"};
  char path[4096];
  double value[4], splitters = cw_json_real(data->design, "splitter_count");
  double leading = fmax(cw_json_real(data->design, "leading_edge_radius_hub_m"),
                        cw_json_real(data->design, "leading_edge_radius_shroud_m"));
  snprintf(path, sizeof path, "%s/geometry/design.json", data->run);
  for (int i = 0; i < 4; i++) CW_TRY(cw_json_positive(data->design, path, keys[i], &value[i]));
  *sizes = (CwPumpSizes){.blade_count = (int)value[0] + (splitters > 0 ? (int)splitters : 0),
                         .leading_radius = leading > 0 ? 1.1 * leading : INFINITY,
                         .outlet_radius = 0.5 * value[1],
                         .interface_radius = value[2],
                         .base_radius = 0.5 * value[3],
                         .suction = cw_report_suction(data)};
done:
  return status;
}

CwStatus cw_report_mesh_domains(const CwReportData *data, json_t *domain[CW_DOMAINS_MOST]) {
  CwStatus status = CW_OK;
  char where[4096];
  const char *name;
  json_t *domains;
  snprintf(where, sizeof where, "%s/mesh/record.json: results", data->run);
  CW_TRY(cw_json_array(json_object_get(data->record[1], "results"), where, "domains", &domains));
  for (int d = 0; d < data->mesh.domain_count; d++) {
    domain[d] = json_array_get(domains, (size_t)d);
    CW_TRY(cw_json_text(domain[d], where, "name", &name));
    CW_REQUIRE(!strcmp(name, data->mesh.domains[d].name), CW_ERR_INPUT, "%s: domain %d is '%s'; it must be '%s'", where,
               d + 1, name, data->mesh.domains[d].name);
  }
done:
  return status;
}
