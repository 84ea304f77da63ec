// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/flow.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"
#include "pipeline/order.h"
#include "pipeline/vec.h"

enum { SAMPLES = 100000 }; // values at the most that a span is taken from

const char *const cw_flow_label[CW_FLOW_QUANTITIES] = {"pressure, kPa", "y<sup>+</sup>", "speed, m/s"};

// The greatest of the folders whose names are iterations; 0 where there is none.
static int latest_iteration(const char *folder) {
  int latest = 0;
  DIR *list = opendir(folder);
  for (struct dirent *entry = list ? readdir(list) : NULL; entry; entry = readdir(list)) {
    char *end;
    long number = strtol(entry->d_name, &end, 10);
    if (!*end && number > latest && number < 1000000000) latest = (int)number;
  }
  if (list) closedir(list);
  return latest;
}

// Adds magnitudes (of vectors) or values of every `step`th item.
static int sample(const CwFoamField *field, const CwFoamValues *values, int64_t step, double *list, int count) {
  for (int64_t k = 0; values->bytes && k < values->count && count < SAMPLES; k += step) {
    double v[CW_FOAM_COMPONENTS] = {0};
    cw_foam_field_value(field, values, k, v);
    double size = field->components == 1 ? v[0] : cw_norm(v);
    if (isfinite(size)) list[count++] = size;
  }
  return count;
}

// From the 1st to the 99th of a hundred values: single cells do not take the scale.
static void span_of(double *list, int count, double scale, CwColourSpan *span) {
  qsort(list, (size_t)count, sizeof *list, cw_order_doubles);
  span->least = count ? scale * list[count / 100] : 0;
  span->most = count ? scale * list[count - 1 - count / 100] : 1;
}

static CwStatus find_spans(CwFlow *flow) {
  CwStatus status = CW_OK;
  double *list = NULL;
  int count = 0;
  int64_t faces = 0, step = 1 + flow->pressure.cells.count / SAMPLES;
  CW_NEW(list, SAMPLES);
  span_of(list, sample(&flow->pressure, &flow->pressure.cells, step, list, 0), 1e-3 * flow->density,
          &flow->span[CW_FLOW_PRESSURE]);
  span_of(list, sample(&flow->velocity, &flow->velocity.cells, step, list, 0), 1, &flow->span[CW_FLOW_SPEED]);
  flow->span[CW_FLOW_SPEED].least = 0;
  for (int p = 0; p < flow->y_plus.patch_count; p++) faces += flow->y_plus.patch[p].count;
  for (int p = 0; p < flow->y_plus.patch_count; p++)
    count = sample(&flow->y_plus, &flow->y_plus.patch[p], 1 + faces / SAMPLES, list, count);
  span_of(list, count, 1, &flow->span[CW_FLOW_Y_PLUS]);
  CwColourSpan *y_plus = &flow->span[CW_FLOW_Y_PLUS];
  y_plus->logarithmic = y_plus->most > 0;
  y_plus->least = fmax(y_plus->least, 1e-3 * y_plus->most); // three powers of ten at the most
done:
  free(list);
  return status;
}

static CwStatus open_field(const char *folder, int iteration, const char *name, int components, int64_t cells,
                           CwFoamField *field) {
  CwStatus status = CW_OK;
  char path[4096];
  snprintf(path, sizeof path, "%s/%d/%s", folder, iteration, name);
  CW_TRY(cw_foam_field_open(path, field));
  CW_REQUIRE(field->components == components, CW_ERR_INPUT, "%s: has %d components; it must have %d", path,
             field->components, components);
  CW_REQUIRE(!field->cells.bytes || field->cells.count == cells, CW_ERR_INPUT,
             "%s: has values of %lld cells, the mesh has %lld; solve it again (make solve)", path,
             (long long)field->cells.count, (long long)cells);
done:
  return status;
}

CwStatus cw_flow_open(const char *run, const CwMesh *mesh, const CwCase *table, CwFlow *flow) {
  CwStatus status = CW_OK;
  char folder[4000];
  int64_t cells = 0;
  snprintf(folder, sizeof folder, "%s/solve/steady", run);
  const int iteration = latest_iteration(folder);
  if (iteration == 0) goto done;
  flow->density = table->fluid.density;
  flow->angular_speed = table->operating_point.speed;
  CW_NEW(flow->first_cell, mesh->region_count);
  CW_NEW(flow->next_face, mesh->patch_count);
  for (int r = 0; r < mesh->region_count; r++) {
    flow->first_cell[r] = cells;
    cells += cw_mesh_region_cells(&mesh->regions[r]);
  }
  CW_TRY(open_field(folder, iteration, "p", 1, cells, &flow->pressure));
  CW_TRY(open_field(folder, iteration, "U", 3, cells, &flow->velocity));
  CW_TRY(open_field(folder, iteration, "yPlus", 1, cells, &flow->y_plus));
  CW_TRY(find_spans(flow));
  flow->present = 1;
done:
  return status;
}

void cw_flow_close(CwFlow *flow) {
  cw_foam_field_close(&flow->pressure);
  cw_foam_field_close(&flow->velocity);
  cw_foam_field_close(&flow->y_plus);
  free(flow->first_cell);
  free(flow->next_face);
  *flow = (CwFlow){0};
}

// The pressure of the cell behind a wall is that of the wall: the solver takes no gradient across it.
static double pressure_at(const CwFlow *flow, int region, int32_t cell) {
  double value;
  cw_foam_field_value(&flow->pressure, &flow->pressure.cells, flow->first_cell[region] + cell, &value);
  return cw_colour_share(&flow->span[CW_FLOW_PRESSURE], 1e-3 * flow->density * value);
}

static double y_plus_at(CwFlow *flow, const CwMesh *mesh, int patch) {
  double value = NAN;
  const CwFoamValues *values = cw_foam_field_patch(&flow->y_plus, mesh->patches[patch].name);
  int64_t face = flow->next_face[patch]++;
  if (mesh->patches[patch].kind != CW_PATCH_WALL || !values || (values->bytes && face >= values->count)) return NAN;
  cw_foam_field_value(&flow->y_plus, values, face, &value);
  return cw_colour_share(&flow->span[CW_FLOW_Y_PLUS], value);
}

void cw_flow_skip(CwFlow *flow, const CwMesh *mesh, const int64_t *faces) {
  for (int p = 0; p < mesh->patch_count; p++) flow->next_face[p] += faces[p];
}

CwStatus cw_flow_faces(CwFlow *flow, const CwMesh *mesh, int region, const CwRegionData *cells, double *share[2]) {
  CwStatus status = CW_OK;
  int first = mesh->domains[cells->domain].first_patch;
  int32_t faces = cells->triangle_count + cells->quad_count;
  CW_NEW(share[0], faces);
  CW_NEW(share[1], faces);
  for (int32_t f = 0; f < faces; f++) {
    int32_t quad = f - cells->triangle_count;
    int patch = first + (quad < 0 ? cells->triangle_patch[f] : cells->quad_patch[quad]);
    share[0][f] = pressure_at(flow, region, quad < 0 ? cells->triangle_cell[f] : cells->quad_cell[quad]);
    share[1][f] = y_plus_at(flow, mesh, patch);
  }
done:
  return status;
}

// The mean of the corners of a cell.
static void middle_of(const CwRegionData *cells, int32_t cell, double middle[3]) {
  int count;
  const int32_t *corner = cw_cell_nodes(cells, cell, &count);
  memset(middle, 0, 3 * sizeof *middle);
  for (int k = 0; k < count; k++)
    for (int i = 0; i < 3; i++) middle[i] += cells->points[corner[k]][i] / count;
}

void cw_flow_cell_velocity(const CwFlow *flow, const CwMesh *mesh, int region, const CwRegionData *cells, int32_t cell,
                           double velocity[3]) {
  double x[3], turn = mesh->domains[cells->domain].rotating ? flow->angular_speed : 0;
  middle_of(cells, cell, x);
  cw_foam_field_value(&flow->velocity, &flow->velocity.cells, flow->first_cell[region] + cell, velocity);
  velocity[0] += turn * x[1];
  velocity[1] -= turn * x[0];
}

double cw_flow_speed_share(const CwFlow *flow, const double velocity[3]) {
  return cw_colour_share(&flow->span[CW_FLOW_SPEED], cw_norm(velocity));
}
