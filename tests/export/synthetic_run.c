// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/export/synthetic_run.h"

#include <jansson.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "pipeline/case_origin.h"
#include "pipeline/case_read.h"
#include "pipeline/mesh/manifest.h"
#include "pipeline/mesh/region_items.h"
#include "tests/seal_run.h"

#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))

typedef struct {
  const char *name, *kind;
} Patch;

static const Patch rotor_patches[] = {{"inlet", "inlet"},
                                      {"suction_pipe", "wall"},
                                      {"hub", "wall"},
                                      {"hub_nut", "wall"},
                                      {"shroud", "wall"},
                                      {"blade_pressure", "wall"},
                                      {"blade_suction", "wall"},
                                      {"blade_leading_edge", "wall"},
                                      {"blade_trailing_edge", "wall"},
                                      {"rotor_interface", "interface"}};
static const Patch stator_patches[] = {{"stator_interface", "interface"},
                                       {"neck", "wall"},
                                       {"step", "wall"},
                                       {"volute", "wall"},
                                       {"tongue", "wall"},
                                       {"diffuser", "wall"},
                                       {"discharge", "wall"},
                                       {"outlet", "outlet"}};

// A domain while it is written.
typedef struct {
  const SyntheticPump *pump;
  const SyntheticAnnulus *annulus;
  const char *name;
  const Patch *patches;
  int patch_count, is_rotor;
  int node_count;
  int *shared; // by node: shared number or -1
  int shared_count;
  double volume;
} Domain;

typedef struct {
  CwRegionData data;
  int *local; // by node: place in the region or -1
} Region;

SyntheticPump synthetic_pump(void) {
  return (SyntheticPump){.bottom = -4e-3,
                         .top = 4e-3,
                         .rotor = {.inner = 0.05, .outer = 0.101, .radial = 8, .around = 72, .axial = 4, .regions = 3},
                         .stator = {.inner = 0.101, .outer = 0.13, .radial = 6, .around = 90, .axial = 5, .regions = 2},
                         .blades = 6};
}

SyntheticPump synthetic_pump_of_all_cells(void) {
  SyntheticPump pump = synthetic_pump();
  pump.rotor.around = 36;
  pump.stator.around = 45;
  pump.pyramids = 1;
  return pump;
}

static int node_at(const Domain *d, int i, int j, int k) {
  const SyntheticAnnulus *a = d->annulus;
  int around = (j % a->around + a->around) % a->around;
  return (k * a->around + around) * (a->radial + 1) + i;
}

static void place(const Domain *d, int node, double x[3]) {
  const SyntheticAnnulus *a = d->annulus;
  int i = node % (a->radial + 1), j = node / (a->radial + 1) % a->around, k = node / (a->radial + 1) / a->around;
  double r = a->inner + (a->outer - a->inner) * i / a->radial;
  double angle = 2 * M_PI * j / a->around + (d->is_rotor ? 0 : 0.013);
  double height = d->pump->top - d->pump->bottom, skin = 0.1 * height;
  double z = k == 0 ? 0 : k == a->axial ? height : skin + (height - 2 * skin) * (k - 1) / (a->axial - 2);
  x[0] = r * cos(angle);
  x[1] = r * sin(angle);
  x[2] = d->pump->bottom + z;
  // The ends are met exactly.
  if (k == a->axial) x[2] = d->pump->top;
}

static int blade_begin(const Domain *d) {
  return d->annulus->radial / 4;
}

static int blade_end(const Domain *d) {
  return d->annulus->radial - 1;
}

static int is_cell(const Domain *d, int i, int j, int k) {
  const SyntheticAnnulus *a = d->annulus;
  if (i < 0 || i >= a->radial || k < 0 || k >= a->axial) return 0;
  j = (j % a->around + a->around) % a->around;
  return !(d->is_rotor && i >= blade_begin(d) && i < blade_end(d) && j % (a->around / d->pump->blades) == 2);
}

static int region_of(const Domain *d, int j) {
  return (int)((int64_t)j * d->annulus->regions / d->annulus->around);
}

static int find_patch(const Domain *d, const char *name) {
  for (int p = 0; p < d->patch_count; ++p)
    if (strcmp(d->patches[p].name, name) == 0) return p;
  abort();
}

// The patch of the side `axis` (0 radius, 1 around, 2 axis), `up` or down, of a cell.
static int patch_of(const Domain *d, int i, int j, int axis, int up) {
  const SyntheticAnnulus *a = d->annulus;
  if (!d->is_rotor) {
    static const char *const flat[] = {"neck", "step", "volute", "tongue", "diffuser", "discharge"};
    if (axis == 0) return find_patch(d, up ? "outlet" : "stator_interface");
    return find_patch(d, flat[i * COUNT(flat) / a->radial]);
  }
  if (axis == 0 && i == (up ? a->radial - 1 : 0)) return find_patch(d, up ? "rotor_interface" : "inlet");
  if (axis == 0) return find_patch(d, up ? "blade_leading_edge" : "blade_trailing_edge");
  if (axis == 1) return find_patch(d, up ? "blade_suction" : "blade_pressure");
  if (i == 0) return find_patch(d, up ? "suction_pipe" : "hub_nut");
  return find_patch(d, up ? "shroud" : "hub");
}

static int local_node(const Domain *d, Region *r, int node) {
  if (r->local[node] < 0) {
    r->local[node] = r->data.point_count;
    place(d, node, r->data.points[r->data.point_count++]);
  }
  return r->local[node];
}

static double dot_cross(const double *a, const double *b, const double *c, const double *to) {
  double u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    w[k] = to[k] - a[k];
  }
  return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
}

static double tetrahedron_volume(const Region *r, int a, int b, int c, int e) {
  return dot_cross(r->data.points[a], r->data.points[b], r->data.points[c], r->data.points[e]) / 6;
}

// Cells of a type by their place, before it is known how many of the earlier types there are.
static int32_t cell_code(int nodes, int place_of_type) {
  return (nodes - 4) << 28 | place_of_type;
}

static int32_t cell_number(const Region *r, int32_t code) {
  const int before[] = {0, r->data.tetrahedron_count, r->data.tetrahedron_count + r->data.pyramid_count};
  return before[code >> 28] + (code & 0xfffffff);
}

// Adds a boundary face of one of the cells first, ..., first + count - 1 with `nodes` nodes each: finds the
// cell that has all its corners and turns the normal outward.
static void add_boundary(Region *r, const int32_t *cells, int first, int count, int nodes, const int *corners,
                         int corner_count, int patch) {
  for (int c = first; c < first + count; ++c) {
    const int32_t *cell = cells + c * nodes;
    int found = 0;
    double centre[3] = {0};
    for (int n = 0; n < nodes; ++n)
      for (int k = 0; k < 3; ++k) centre[k] += r->data.points[cell[n]][k] / nodes;
    for (int m = 0; m < corner_count; ++m)
      for (int n = 0; n < nodes; ++n) found += cell[n] == corners[m];
    if (found < corner_count) continue;
    int inward =
        dot_cross(r->data.points[corners[0]], r->data.points[corners[1]], r->data.points[corners[2]], centre) > 0;
    int32_t *out = corner_count == 3 ? r->data.triangles[r->data.triangle_count] : r->data.quads[r->data.quad_count];
    for (int m = 0; m < corner_count; ++m) out[m] = corners[inward ? corner_count - 1 - m : m];
    int32_t number = cell_code(nodes, c);
    if (corner_count == 3) {
      r->data.triangle_patch[r->data.triangle_count] = patch;
      r->data.triangle_cell[r->data.triangle_count++] = number;
    } else {
      r->data.quad_patch[r->data.quad_count] = patch;
      r->data.quad_cell[r->data.quad_count++] = number;
    }
    return;
  }
  abort();
}

// A few cells on the lower wall of the stator have a point in their middle: pyramids on four sides and on the
// wall, two tetrahedra under the tetrahedra above.
static int has_middle(const Domain *d, int i, int j, int k) {
  return d->pump->pyramids && !d->is_rotor && k == 0 && i == d->annulus->radial / 2 && j % 9 == 4;
}

static void add_cell_with_middle(Domain *d, Region *r, int i, int j, int k) {
  int v[8], middle = r->data.point_count++;
  memset(r->data.points[middle], 0, sizeof *r->data.points);
  for (int b = 0; b < 8; ++b) {
    v[b] = local_node(d, r, node_at(d, i + (b & 1), j + (b >> 1 & 1), k + (b >> 2 & 1)));
    for (int x = 0; x < 3; ++x) r->data.points[middle][x] += r->data.points[v[b]][x] / 8;
  }
  for (int side = 0; side < 6; ++side) {
    int axis = side / 2, up = side % 2;
    int s = axis == 0 ? 2 : 1, t = axis == 2 ? 2 : 4, o = up ? 1 << axis : 0;
    int c[4] = {v[o], v[o + s], v[o + s + t], v[o + t]};
    if (tetrahedron_volume(r, c[0], c[1], c[2], middle) < 0) {
      int swap = c[1];
      c[1] = c[3];
      c[3] = swap;
    }
    d->volume += tetrahedron_volume(r, c[0], c[1], c[2], middle) + tetrahedron_volume(r, c[0], c[2], c[3], middle);
    if (axis == 2 && up) {
      memcpy(r->data.tetrahedra[r->data.tetrahedron_count++], (int32_t[]){c[0], c[1], c[2], middle},
             4 * sizeof(int32_t));
      memcpy(r->data.tetrahedra[r->data.tetrahedron_count++], (int32_t[]){c[0], c[2], c[3], middle},
             4 * sizeof(int32_t));
      continue;
    }
    int place_of_type = r->data.pyramid_count++;
    memcpy(r->data.pyramids[place_of_type], (int32_t[]){c[0], c[1], c[2], c[3], middle}, 5 * sizeof(int32_t));
    if (axis == 2) add_boundary(r, *r->data.pyramids, place_of_type, 1, 5, c, 4, patch_of(d, i, j, axis, up));
  }
}

static void add_cell(Domain *d, Region *r, int i, int j, int k) {
  int is_prism = k == 0 || k == d->annulus->axial - 1;
  int v[8], first;
  for (int b = 0; b < 8; ++b) v[b] = local_node(d, r, node_at(d, i + (b & 1), j + (b >> 1 & 1), k + (b >> 2 & 1)));
  if (is_prism) {
    const int base[2][3] = {{0, 1, 3}, {0, 3, 2}};
    first = r->data.prism_count;
    for (int p = 0; p < 2; ++p) {
      int32_t *prism = r->data.prisms[r->data.prism_count++];
      for (int n = 0; n < 3; ++n) {
        prism[n] = v[base[p][n]];
        prism[n + 3] = v[base[p][n] + 4];
      }
    }
  } else {
    const int order[6][3] = {{1, 2, 4}, {2, 4, 1}, {4, 1, 2}, {1, 4, 2}, {4, 2, 1}, {2, 1, 4}};
    first = r->data.tetrahedron_count;
    for (int p = 0; p < 6; ++p) {
      int32_t *t = r->data.tetrahedra[r->data.tetrahedron_count++];
      int a = order[p][0], b = order[p][0] + order[p][1];
      t[0] = v[0];
      t[1] = v[p < 3 ? a : b]; // the last three permutations are odd
      t[2] = v[p < 3 ? b : a];
      t[3] = v[7];
      d->volume += tetrahedron_volume(r, t[0], t[1], t[2], t[3]);
    }
  }
  if (is_prism) {
    // The sides of the prisms are flat or ruled along the axis: the volume is that of the base times the
    // height.
    double z = r->data.points[v[4]][2] - r->data.points[v[0]][2];
    for (int p = 0; p < 2; ++p) {
      const int32_t *n = r->data.prisms[first + p];
      const double *a = r->data.points[n[0]], *b = r->data.points[n[1]], *c = r->data.points[n[2]];
      d->volume += 0.5 * z * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
  }
  for (int axis = 0; axis < 3; ++axis)
    for (int up = 0; up < 2; ++up) {
      int step = up ? 1 : -1;
      if (is_cell(d, i + (axis == 0) * step, j + (axis == 1) * step, k + (axis == 2) * step)) continue;
      int patch = patch_of(d, i, j, axis, up);
      int s = axis == 0 ? 2 : 1, t = axis == 2 ? 2 : 4, o = up ? 1 << axis : 0;
      int corners[4] = {v[o], v[o + s], v[o + s + t], v[o + t]};
      const int32_t *cells = is_prism ? *r->data.prisms : *r->data.tetrahedra;
      int nodes = is_prism ? 6 : 4, count = is_prism ? 2 : 6;
      if (is_prism && axis != 2) {
        add_boundary(r, cells, first, count, nodes, corners, 4, patch);
      } else {
        int second[3] = {corners[0], corners[2], corners[3]};
        add_boundary(r, cells, first, count, nodes, corners, 3, patch);
        add_boundary(r, cells, first, count, nodes, second, 3, patch);
      }
    }
}

static void region_name(const char *domain, int number, char name[40]) {
  snprintf(name, 40, "%s-%04d.h5", domain, number);
}

int synthetic_region_write(const char *run, const char *domain, int number, CwRegionData *data) {
  char path[4000], name[40], digest[CW_HASH_TEXT];
  region_name(domain, number, name);
  snprintf(path, sizeof path, "%s/mesh/%s", run, name);
  hid_t file = cw_region_items_create(path);
  if (file < 0) return -1;
  int failed = cw_region_items_put_integer(file, "format", CW_REGION_FORMAT) != CW_OK;
  failed |= cw_region_items_put_integer(file, "region", number) != CW_OK;
  failed |= cw_region_items_put_integer(file, "number", number) != CW_OK;
  failed |= cw_region_items_put_text(file, "domain", domain) != CW_OK;
  failed |= cw_region_items_put_number(file, "unit_m", 2) != CW_OK;
  cw_region_items_scale(data, 0.5);
  failed |= cw_region_items_write(file, data, digest) != CW_OK;
  cw_region_items_scale(data, 2);
  failed |= H5Fclose(file) < 0;
  return failed ? -1 : 0;
}

// Numbers the points that lie on a partition plane and belong to a cell.
static void number_shared(Domain *d) {
  const SyntheticAnnulus *a = d->annulus;
  d->shared = malloc((size_t)d->node_count * sizeof *d->shared);
  for (int n = 0; n < d->node_count; ++n) d->shared[n] = -1;
  for (int j = 0; j < a->around; ++j) {
    if (a->regions == 1 || region_of(d, j) == region_of(d, (j + a->around - 1) % a->around)) continue;
    for (int k = 0; k <= a->axial; ++k)
      for (int i = 0; i <= a->radial; ++i)
        for (int side = -1; side < 1 && d->shared[node_at(d, i, j, k)] < 0; ++side)
          for (int up = -1; up < 1; ++up)
            for (int out = -1; out < 1; ++out)
              if (d->shared[node_at(d, i, j, k)] < 0 && is_cell(d, i + out, j + side, k + up))
                d->shared[node_at(d, i, j, k)] = d->shared_count++;
  }
}

static json_t *write_region(const char *run, Domain *d, int region) {
  const SyntheticAnnulus *a = d->annulus;
  size_t cells = (size_t)a->radial * (size_t)(a->around / a->regions + 1) * (size_t)a->axial;
  Region r = {0};
  r.data.points = malloc(2 * (size_t)d->node_count * sizeof *r.data.points);
  r.data.shared_id = malloc((size_t)(d->shared_count + 1) * sizeof *r.data.shared_id);
  r.data.tetrahedra = malloc(6 * cells * sizeof *r.data.tetrahedra);
  r.data.pyramids = malloc(5 * cells * sizeof *r.data.pyramids);
  r.data.prisms = malloc(2 * cells * sizeof *r.data.prisms);
  r.data.triangles = malloc(12 * cells * sizeof *r.data.triangles);
  r.data.quads = malloc(6 * cells * sizeof *r.data.quads);
  r.data.triangle_patch = malloc(12 * cells * sizeof *r.data.triangle_patch);
  r.data.triangle_cell = malloc(12 * cells * sizeof *r.data.triangle_cell);
  r.data.quad_patch = malloc(6 * cells * sizeof *r.data.quad_patch);
  r.data.quad_cell = malloc(6 * cells * sizeof *r.data.quad_cell);
  r.local = malloc((size_t)d->node_count * sizeof *r.local);
  for (int n = 0; n < d->node_count; ++n) r.local[n] = -1;
  // Shared points first: those of the planes that bound this region and are used by its cells.
  for (int pass = 0; pass < 2; ++pass) {
    for (int j = 0; j < a->around; ++j)
      for (int k = 0; k < a->axial && region_of(d, j) == region; ++k)
        for (int i = 0; i < a->radial; ++i) {
          if (!is_cell(d, i, j, k)) continue;
          if (pass && has_middle(d, i, j, k)) {
            add_cell_with_middle(d, &r, i, j, k);
            continue;
          }
          if (pass) {
            add_cell(d, &r, i, j, k);
            continue;
          }
          for (int b = 0; b < 8; ++b) {
            int node = node_at(d, i + (b & 1), j + (b >> 1 & 1), k + (b >> 2 & 1));
            if (d->shared[node] >= 0 && r.local[node] < 0) {
              r.data.shared_id[r.data.shared_count++] = d->shared[node];
              local_node(d, &r, node);
            }
          }
        }
  }
  for (int t = 0; t < r.data.triangle_count; ++t) r.data.triangle_cell[t] = cell_number(&r, r.data.triangle_cell[t]);
  for (int q = 0; q < r.data.quad_count; ++q) r.data.quad_cell[q] = cell_number(&r, r.data.quad_cell[q]);
  char name[40];
  region_name(d->name, region + 1, name);
  json_t *line = NULL;
  if (synthetic_region_write(run, d->name, region + 1, &r.data) == 0)
    line = json_pack("{s:s, s:i, s:i, s:i, s:i, s:i, s:i, s:i, s:i, s:i}", "file", name, "region", region + 1, "number",
                     region + 1, "points", r.data.point_count, "own_points", r.data.point_count - r.data.shared_count,
                     "tetrahedra", r.data.tetrahedron_count, "pyramids", r.data.pyramid_count, "prisms",
                     r.data.prism_count, "triangles", r.data.triangle_count, "quads", r.data.quad_count);
  else
    fprintf(stderr, "%s: %s cannot be written\n", run, name);
  cw_mesh_region_free(&r.data);
  free(r.local);
  return line;
}

static json_t *patch_json(const Patch *of, int is_rotor) {
  const int is_blade = strncmp(of->name, "blade", 5) == 0;
  json_t *patch = json_pack("{s:s, s:s, s:s}", "name", of->name, "kind", of->kind, "size", "volute");
  if (!strcmp(of->kind, "outlet")) json_object_set_new(patch, "flow_share", json_real(1));
  if (strcmp(of->kind, "wall") != 0) return patch;
  json_object_set_new(patch, "group", json_string(is_blade ? "blade" : "volute"));
  json_object_set_new(patch, "turns", json_boolean(is_rotor && strcmp(of->name, "suction_pipe") != 0));
  json_object_set_new(patch, "monitored", json_boolean(!strcmp(of->name, "tongue")));
  json_object_set_new(patch, "y_plus", json_real(30));
  json_object_set_new(
      patch, "flow",
      json_pack("{s:f, s:f, s:f, s:f}", "speed_m_per_s", 7.8, "length_m", 0.1, "diameter_m", 0.01, "width_m", 0.008));
  return patch;
}

static json_t *write_domain(const char *run, const SyntheticPump *pump, int is_rotor) {
  Domain d = {.pump = pump,
              .annulus = is_rotor ? &pump->rotor : &pump->stator,
              .name = is_rotor ? "rotor" : "stator",
              .patches = is_rotor ? rotor_patches : stator_patches,
              .patch_count = is_rotor ? COUNT(rotor_patches) : COUNT(stator_patches),
              .is_rotor = is_rotor};
  d.node_count = (d.annulus->radial + 1) * d.annulus->around * (d.annulus->axial + 1);
  number_shared(&d);
  json_t *patches = json_array(), *regions = json_array();
  for (int p = 0; p < d.patch_count; ++p) json_array_append_new(patches, patch_json(&d.patches[p], is_rotor));
  int failed = 0;
  for (int r = 0; r < d.annulus->regions && !failed; ++r)
    failed = json_array_append_new(regions, write_region(run, &d, r));
  free(d.shared);
  json_t *domain = json_pack("{s:s, s:b, s:i, s:f, s:o, s:o}", "name", d.name, "rotating", is_rotor, "shared_points",
                             d.shared_count, "solid_volume_m3", d.volume, "patches", patches, "regions", regions);
  if (failed) {
    json_decref(domain);
    return NULL;
  }
  return domain;
}

// What later stages ask of a stage's record: the case that it ran for.
static int write_record(const char *run, const char *stage) {
  char path[4000];
  CwCase table;
  if (cw_case_read(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", &table) != CW_OK) return -1;
  json_t *root = json_pack("{s:o}", "case", cw_case_origin(&table));
  snprintf(path, sizeof path, "%s/%s/record.json", run, stage);
  const int failed = json_dump_file(root, path, JSON_INDENT(1));
  json_decref(root);
  return failed;
}

int synthetic_run_write(const char *run, const SyntheticPump *pump) {
  char path[4000];
  mkdir(run, 0777);
  snprintf(path, sizeof path, "%s/mesh", run);
  mkdir(path, 0777);
  snprintf(path, sizeof path, "%s/geometry", run);
  mkdir(path, 0777);
  json_t *rotor = write_domain(run, pump, 1), *stator = write_domain(run, pump, 0);
  if (!rotor || !stator) {
    json_decref(rotor);
    json_decref(stator);
    return -1;
  }
  json_t *flow =
      json_pack("{s:f, s:f, s:f, s:f, s:f, s:i}", "inlet_speed_m_per_s", 1.6, "inlet_diameter_m", 0.074,
                "passage_speed_m_per_s", 7.8, "passage_width_m", 0.008, "reference_length_m", 0.2, "blade_count", 6);
  json_t *root = json_pack("{s:i, s:[o, o], s:[{s:[s, s], s:s, s:f}], s:o}", "format", CW_MANIFEST_FORMAT, "domains",
                           rotor, stator, "interfaces", "patches", "rotor_interface", "stator_interface", "surface",
                           "cylinder", "radius_m", pump->rotor.outer, "flow", flow);
  snprintf(path, sizeof path, "%s/mesh/manifest.json", run);
  int failed = json_dump_file(root, path, JSON_INDENT(1));
  json_decref(root);
  return failed || write_record(run, "geometry") || write_record(run, "mesh") || seal_run(run) ? -1 : 0;
}
