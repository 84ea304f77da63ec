// SPDX-License-Identifier: AGPL-3.0-or-later
// What a CGNS file holds, by HDF5 alone. Whatever is wrong ends the program with one line.
#pragma once

#include <hdf5.h>
#include <stdint.h>
#include <stdlib.h>

enum { AUDIT_ZONES_MOST = 16, AUDIT_LIST_MOST = 200, AUDIT_NAME_SIZE = 33 };

// A dataset of one or two dimensions, in the file's order.
typedef struct {
  hid_t set;
  int64_t size;
} AuditArray;

typedef struct {
  char name[AUDIT_NAME_SIZE];
  int type; // code of ElementType_t
  int64_t first, count;
  AuditArray nodes;
} AuditSection;

typedef struct {
  char name[AUDIT_NAME_SIZE], other[AUDIT_NAME_SIZE]; // other: the zone that a connection names
  int64_t first, last;
  AuditArray donor, place; // of a connection
} AuditRange;

typedef struct {
  char name[AUDIT_NAME_SIZE];
  int64_t points, cells;
  AuditArray x[3];
  AuditSection sections[AUDIT_LIST_MOST]; // by their first element
  AuditRange conditions[AUDIT_LIST_MOST]; // by their first element
  AuditRange connections[AUDIT_LIST_MOST];
  int section_count, condition_count, connection_count;
} AuditZone;

typedef struct {
  hid_t file;
  int zone_count;
  AuditZone *zones;
} AuditFile;

// Blocks of points that were asked for of late.
typedef struct {
  const AuditZone *zone;
  int64_t *block_of; // the slot of each block of points, -1: not held
  int64_t *held;     // the block in each slot, -1: none
  double (*x)[3];
  int slots, next;
} Points;

_Noreturn void audit_fail(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *audit_new(size_t bytes); // zeroed

int audit_file_zone_count(const char *path);
void audit_file_open(const char *path, AuditFile *file);
void audit_file_close(AuditFile *file);

void audit_read_integers(const AuditArray *array, int64_t first, int64_t count, int64_t *values);
void audit_read_reals(const AuditArray *array, int64_t first, int64_t count, double *values);

void points_start(Points *points, const AuditZone *zone);
void points_at(Points *points, int64_t point, double x[3]); // from 0
void points_free(Points *points);

// Looks whether the connections of a zone each have the range of a condition, name faces of the other zone that are in
// a condition, and lie where they say: returns the largest distance between a face's centre and its place in the face
// that it names, over the longest edge of the two; above 1 is a fault.
double audit_connections(const AuditFile *file, int zone, Points *points);
