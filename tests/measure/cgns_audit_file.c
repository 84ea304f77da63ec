// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/measure/cgns_audit_file.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { BLOCK = 1 << 14, SLOTS = 1 << 9 }; // 16384 points each, 200 MB in all

void audit_fail(const char *format, ...) {
  va_list arguments;
  char text[1000];
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  fprintf(stderr, "cgns_audit: %s\n", text);
  _exit(1);
}

void *audit_new(size_t bytes) {
  void *memory = calloc(1, bytes + 1);
  if (!memory) audit_fail("out of memory: %zu bytes", bytes);
  return memory;
}

static void text_of(hid_t node, const char *attribute, char text[AUDIT_NAME_SIZE]) {
  memset(text, 0, AUDIT_NAME_SIZE);
  hid_t at = H5Aopen(node, attribute, H5P_DEFAULT), type = at < 0 ? -1 : H5Aget_type(at);
  char *bytes = audit_new(at < 0 ? 1 : H5Tget_size(type));
  if (at < 0 || H5Aread(at, type, bytes) < 0) audit_fail("a node has no attribute %s", attribute);
  snprintf(text, AUDIT_NAME_SIZE, "%s", bytes);
  free(bytes);
  H5Tclose(type);
  H5Aclose(at);
}

static int is_labelled(hid_t node, const char *label) {
  char text[AUDIT_NAME_SIZE];
  text_of(node, "label", text);
  return strcmp(text, label) == 0;
}

static hid_t open_array(hid_t node, const char *path, int is_needed, AuditArray *array) {
  hid_t set = !is_needed && H5Lexists(node, path, H5P_DEFAULT) <= 0 ? -1 : H5Dopen2(node, path, H5P_DEFAULT);
  if (set < 0 && is_needed) audit_fail("a node has no '%s'", path);
  *array = (AuditArray){.set = set};
  if (set < 0) return set;
  hid_t space = H5Dget_space(set);
  array->size = H5Sget_simple_extent_npoints(space);
  H5Sclose(space);
  return set;
}

// A stretch of an array of one dimension, or the whole of any.
static void read_values(const AuditArray *array, int64_t first, int64_t count, hid_t type, void *values) {
  hid_t there = H5Dget_space(array->set);
  hsize_t from = (hsize_t)first, length = (hsize_t)count;
  hid_t here = H5Screate_simple(1, &length, NULL);
  if (count < array->size) H5Sselect_hyperslab(there, H5S_SELECT_SET, &from, NULL, &length, NULL);
  if (H5Dread(array->set, type, here, there, H5P_DEFAULT, values) < 0)
    audit_fail("%lld values cannot be read", (long long)count);
  H5Sclose(here);
  H5Sclose(there);
}

void audit_read_integers(const AuditArray *array, int64_t first, int64_t count, int64_t *values) {
  if (count > 0) read_values(array, first, count, H5T_NATIVE_INT64, values);
}

void audit_read_reals(const AuditArray *array, int64_t first, int64_t count, double *values) {
  if (count > 0) read_values(array, first, count, H5T_NATIVE_DOUBLE, values);
}

static void small_integers(hid_t node, const char *path, int count, int64_t *values) {
  AuditArray array;
  open_array(node, path, 1, &array);
  if (array.size < count) audit_fail("'%s' has %lld values; expected: %d", path, (long long)array.size, count);
  int64_t all[16];
  if (array.size > 16) audit_fail("'%s' has %lld values", path, (long long)array.size);
  audit_read_integers(&array, 0, array.size, all);
  memcpy(values, all, (size_t)count * sizeof *values);
  H5Dclose(array.set);
}

// Calls `take` for each node below one, with its name.
typedef void (*Take)(hid_t node, const char *name, void *context);
static void for_nodes(hid_t parent, Take take, void *context) {
  H5G_info_t info;
  H5Gget_info(parent, &info);
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char name[100];
    H5Lget_name_by_idx(parent, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT);
    if (name[0] == ' ') continue; // data
    hid_t node = H5Gopen2(parent, name, H5P_DEFAULT);
    if (node < 0) continue;
    take(node, name, context);
    H5Gclose(node);
  }
}

static void take_section(hid_t node, const char *name, void *context) {
  AuditZone *zone = context;
  int64_t range[2], code[2];
  if (!is_labelled(node, "Elements_t")) return;
  if (zone->section_count == AUDIT_LIST_MOST) audit_fail("more than %d sections", AUDIT_LIST_MOST);
  AuditSection *section = &zone->sections[zone->section_count++];
  snprintf(section->name, sizeof section->name, "%.32s", name);
  small_integers(node, " data", 2, code);
  small_integers(node, "ElementRange/ data", 2, range);
  section->type = (int)code[0];
  section->first = range[0];
  section->count = range[1] - range[0] + 1;
  open_array(node, "ElementConnectivity/ data", 1, &section->nodes);
}

static void take_range(hid_t node, const char *name, AuditRange *list, int *count) {
  int64_t range[2];
  if (*count == AUDIT_LIST_MOST) audit_fail("more than %d conditions", AUDIT_LIST_MOST);
  AuditRange *one = &list[(*count)++];
  snprintf(one->name, sizeof one->name, "%.32s", name);
  small_integers(node, "PointRange/ data", 2, range);
  one->first = range[0];
  one->last = range[1];
}

static void take_condition(hid_t node, const char *name, void *context) {
  AuditZone *zone = context;
  if (is_labelled(node, "BC_t")) take_range(node, name, zone->conditions, &zone->condition_count);
}

static void take_connection(hid_t node, const char *name, void *context) {
  AuditZone *zone = context;
  AuditArray text;
  if (!is_labelled(node, "GridConnectivity_t")) return;
  take_range(node, name, zone->connections, &zone->connection_count);
  AuditRange *one = &zone->connections[zone->connection_count - 1];
  open_array(node, " data", 1, &text);
  if (text.size >= AUDIT_NAME_SIZE) audit_fail("connection %s: a zone's name of %lld letters", name,
                                               (long long)text.size);
  read_values(&text, 0, text.size, H5T_NATIVE_INT8, one->other);
  H5Dclose(text.set);
  open_array(node, "CellListDonor/ data", 1, &one->donor);
  open_array(node, "InterpolantsDonor/ data", 1, &one->place);
}

static int by_first(const void *left, const void *right) {
  const AuditSection *a = left, *b = right;
  return (a->first > b->first) - (a->first < b->first);
}

static int by_range(const void *left, const void *right) {
  const AuditRange *a = left, *b = right;
  return (a->first > b->first) - (a->first < b->first);
}

static void take_zone(hid_t node, const char *name, void *context) {
  AuditFile *file = context;
  int64_t size[3];
  if (!is_labelled(node, "Zone_t")) return;
  if (file->zone_count == AUDIT_ZONES_MOST) audit_fail("more than %d zones", AUDIT_ZONES_MOST);
  AuditZone *zone = &file->zones[file->zone_count++];
  snprintf(zone->name, sizeof zone->name, "%.32s", name);
  small_integers(node, " data", 3, size);
  zone->points = size[0];
  zone->cells = size[1];
  for (int k = 0; k < 3; ++k) {
    char path[60];
    snprintf(path, sizeof path, "GridCoordinates/Coordinate%c/ data", "XYZ"[k]);
    open_array(node, path, 1, &zone->x[k]);
    if (zone->x[k].size != zone->points)
      audit_fail("zone %s: %lld values of a coordinate; its size says %lld", name, (long long)zone->x[k].size,
                 (long long)zone->points);
  }
  for_nodes(node, take_section, zone);
  qsort(zone->sections, (size_t)zone->section_count, sizeof *zone->sections, by_first);
  hid_t all = H5Gopen2(node, "ZoneBC", H5P_DEFAULT);
  if (all < 0) audit_fail("zone %s has no conditions", name);
  for_nodes(all, take_condition, zone);
  H5Gclose(all);
  qsort(zone->conditions, (size_t)zone->condition_count, sizeof *zone->conditions, by_range);
  all = H5Gopen2(node, "ZoneGridConnectivity", H5P_DEFAULT);
  if (all < 0) return;
  for_nodes(all, take_connection, zone);
  H5Gclose(all);
}

static void take_base(hid_t node, const char *name, void *context) {
  if (is_labelled(node, "CGNSBase_t")) for_nodes(node, take_zone, context);
}

void audit_file_open(const char *path, AuditFile *file) {
  *file = (AuditFile){.zones = audit_new(AUDIT_ZONES_MOST * sizeof *file->zones)};
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  file->file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file->file < 0) audit_fail("%s cannot be opened", path);
  for_nodes(file->file, take_base, file);
  if (file->zone_count == 0) audit_fail("%s has no zone", path);
}

void audit_file_close(AuditFile *file) {
  free(file->zones);
  H5Fclose(file->file);
}

int audit_file_zone_count(const char *path) {
  AuditFile file;
  audit_file_open(path, &file);
  const int count = file.zone_count;
  audit_file_close(&file);
  H5close(); // each process opens it for itself
  return count;
}

void points_start(Points *points, const AuditZone *zone) {
  const int64_t blocks = zone->points / BLOCK + 1;
  *points = (Points){.zone = zone, .slots = blocks < SLOTS ? (int)blocks : SLOTS};
  points->block_of = audit_new((size_t)blocks * sizeof *points->block_of);
  points->held = audit_new((size_t)points->slots * sizeof *points->held);
  points->x = audit_new((size_t)points->slots * BLOCK * sizeof *points->x);
  for (int64_t b = 0; b < blocks; ++b) points->block_of[b] = -1;
  for (int s = 0; s < points->slots; ++s) points->held[s] = -1;
}

void points_free(Points *points) {
  free(points->block_of);
  free(points->held);
  free(points->x);
}

// Into the slot whose turn it is.
static int64_t hold(Points *points, int64_t block) {
  static double one[BLOCK];
  const int64_t first = block * BLOCK, left = points->zone->points - first, count = left < BLOCK ? left : BLOCK;
  const int slot = points->next;
  points->next = (slot + 1) % points->slots;
  if (points->held[slot] >= 0) points->block_of[points->held[slot]] = -1;
  points->held[slot] = block;
  points->block_of[block] = slot;
  for (int k = 0; k < 3; ++k) {
    audit_read_reals(&points->zone->x[k], first, count, one);
    for (int64_t i = 0; i < count; ++i) {
      if (!isfinite(one[i]))
        audit_fail("zone %s: point %lld is no place", points->zone->name, (long long)(first + i) + 1);
      points->x[(int64_t)slot * BLOCK + i][k] = one[i];
    }
  }
  return slot;
}

void points_at(Points *points, int64_t point, double x[3]) {
  int64_t slot = points->block_of[point / BLOCK];
  if (slot < 0) slot = hold(points, point / BLOCK);
  memcpy(x, points->x[slot * BLOCK + point % BLOCK], 3 * sizeof *x);
}

// The corners of a boundary element, from 0 on; their number.
static int element_at(const AuditZone *zone, int64_t element, Points *points, double x[4][3]) {
  for (int s = 0; s < zone->section_count; ++s) {
    const AuditSection *section = &zone->sections[s];
    const int count = section->type == 5 ? 3 : 4;
    int64_t node[4];
    if (element < section->first || element >= section->first + section->count) continue;
    if (section->type != 5 && section->type != 7) break;
    audit_read_integers(&section->nodes, (element - section->first) * count, count, node);
    for (int i = 0; i < count; ++i) points_at(points, node[i] - 1, x[i]);
    return count;
  }
  audit_fail("zone %s: element %lld is no boundary element", zone->name, (long long)element);
}

static int is_condition(const AuditZone *zone, int64_t first, int64_t last) {
  for (int c = 0; c < zone->condition_count; ++c)
    if (zone->conditions[c].first <= first && last <= zone->conditions[c].last) return 1;
  return 0;
}

static double longest_edge(const double (*x)[3], int count) {
  double longest = 0;
  for (int i = 0; i < count; ++i) {
    const double *a = x[i], *b = x[(i + 1) % count];
    longest = fmax(longest, sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2)));
  }
  return longest;
}

// How far the centre of a face lies from the place (r, s) of another, over the longest edge of both.
static double gap_between(const double (*x)[3], int count, const double (*y)[3], int others, double r, double s) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    double centre = 0;
    for (int i = 0; i < count; ++i) centre += x[i][k] / count;
    const double place = others == 3 ? (1 - r - s) * y[0][k] + r * y[1][k] + s * y[2][k]
                                     : (1 - r) * (1 - s) * y[0][k] + r * (1 - s) * y[1][k] + r * s * y[2][k] +
                                           (1 - r) * s * y[3][k];
    sum += (centre - place) * (centre - place);
  }
  return sqrt(sum) / fmax(longest_edge(x, count), longest_edge(y, others));
}

static double audit_connection(const AuditZone *here, const AuditRange *one, const AuditZone *there, Points *points,
                               Points *others) {
  const int64_t count = one->last - one->first + 1;
  double worst = 0;
  if (!is_condition(here, one->first, one->last))
    audit_fail("zone %s: connection %s is no part of a condition", here->name, one->name);
  if (one->donor.size != count || one->place.size != 2 * count)
    audit_fail("zone %s: connection %s has %lld donors and %lld values of places for %lld faces", here->name, one->name,
               (long long)one->donor.size, (long long)one->place.size, (long long)count);
  int64_t *donor = audit_new((size_t)count * sizeof *donor);
  double *place = audit_new((size_t)(2 * count) * sizeof *place), x[4][3], y[4][3];
  audit_read_integers(&one->donor, 0, count, donor);
  audit_read_reals(&one->place, 0, 2 * count, place);
  const int64_t step = count / 20000 + 1; // a sample: each face is two reads
  for (int64_t i = 0; i < count; ++i) {
    const double r = place[2 * i], s = place[2 * i + 1];
    if (!is_condition(there, donor[i], donor[i]) || !(r >= 0 && r <= 1 && s >= 0 && s <= 1))
      audit_fail("zone %s: connection %s: face %lld names face %lld at (%g, %g)", here->name, one->name,
                 (long long)(one->first + i), (long long)donor[i], r, s);
    if (i % step) continue;
    const int corners = element_at(here, one->first + i, points, x), its = element_at(there, donor[i], others, y);
    const double by_rows = gap_between((const double(*)[3])x, corners, (const double(*)[3])y, its, r, s);
    if (by_rows > 1)
      audit_fail("zone %s: connection %s: face %lld lies %.3g edges from face %lld", here->name, one->name,
                 (long long)(one->first + i), by_rows, (long long)donor[i]);
    worst = fmax(worst, by_rows);
  }
  free(donor);
  free(place);
  return worst;
}

double audit_connections(const AuditFile *file, int zone, Points *points) {
  const AuditZone *here = &file->zones[zone];
  double worst = 0;
  for (int c = 0; c < here->connection_count; ++c) {
    int other = -1;
    for (int z = 0; z < file->zone_count; ++z)
      if (strcmp(file->zones[z].name, here->connections[c].other) == 0) other = z;
    if (other < 0 || other == zone)
      audit_fail("zone %s: connection %s leads to '%s'", here->name, here->connections[c].name,
                 here->connections[c].other);
    Points others;
    points_start(&others, &file->zones[other]);
    worst = fmax(worst, audit_connection(here, &here->connections[c], &file->zones[other], points, &others));
    points_free(&others);
  }
  return worst;
}
