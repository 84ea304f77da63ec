// SPDX-License-Identifier: AGPL-3.0-or-later
// cgns_audit FILE: reads a CGNS file of unstructured zones by HDF5 alone, as a stream, and looks whether its mesh is
// sound: sections without gaps, nodes in range, every point in use, every cell of positive volume, every face shared by
// two cells that see it from two sides or by one cell and one boundary element, every boundary element in one
// condition, and every face of a connection over the one that it names. Prints a line of JSON a zone; ends with 1 and
// one line at the first fault. Shares no code with the exporter. The zones are read side by side, one process each.
//
// Memory: of the faces only those are held that wait for their other side, of the points a few blocks.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/measure/cgns_audit_faces.h"
#include "tests/measure/cgns_audit_file.h"

enum { BATCH = 1 << 15, TRI = 5, QUAD = 7, TETRA = 10, PYRA = 12, PENTA = 14 };

// Of the CGNS standard: nodes of each face, outward, from 0; -1 at the end of a triangle.
static const int tetra_faces[4][4] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
static const int pyra_faces[5][4] = {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
static const int penta_faces[5][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}, {0, 2, 1, -1}, {3, 4, 5, -1}};
static const int tri_faces[1][4] = {{0, 1, 2, -1}};
static const int quad_faces[1][4] = {{0, 1, 2, 3}};

static const struct Shape {
  int code, nodes, faces, is_cell;
  const int (*face)[4];
} shapes[] = {{TRI, 3, 1, 0, tri_faces},
              {QUAD, 4, 1, 0, quad_faces},
              {TETRA, 4, 4, 1, tetra_faces},
              {PYRA, 5, 5, 1, pyra_faces},
              {PENTA, 6, 5, 1, penta_faces}};

typedef struct {
  const AuditZone *zone;
  Faces faces;
  Points points;
  unsigned char *used; // a bit a point
  double volume, least, enclosed;
} Audit;

static const struct Shape *shape_of(const AuditZone *zone, const AuditSection *section) {
  for (size_t i = 0; i < sizeof shapes / sizeof *shapes; ++i)
    if (shapes[i].code == section->type) return &shapes[i];
  audit_fail("zone %s: section %s has elements of type %d", zone->name, section->name, section->type);
}

// Volume between the origin of `x` and a face, a quadrilateral as four triangles about its mean.
static double volume_under(const double (*x)[3], const int face[4], const double origin[3]) {
  const int corners = face[3] < 0 ? 3 : 4;
  double middle[3] = {0}, sum = 0;
  for (int i = 0; i < corners; ++i)
    for (int k = 0; k < 3; ++k) middle[k] += (x[face[i]][k] - origin[k]) / corners;
  for (int i = 0; i < (corners == 3 ? 1 : 4); ++i) {
    double a[3], b[3], c[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = x[face[i]][k] - origin[k];
      b[k] = x[face[(i + 1) % corners]][k] - origin[k];
      c[k] = corners == 3 ? x[face[2]][k] - origin[k] : middle[k];
    }
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

static void measure(Audit *audit, const AuditSection *section, const struct Shape *shape, const double (*x)[3],
                    int64_t element) {
  static const double origin[3] = {0};
  double volume = 0;
  for (int f = 0; f < shape->faces; ++f)
    volume += volume_under(x, shape->face[f], shape->is_cell ? x[0] : origin);
  if (!shape->is_cell) {
    audit->enclosed += volume;
    return;
  }
  if (!(volume > 0))
    audit_fail("zone %s, %s: element %lld near (%.6g, %.6g, %.6g) has a volume of %.3g", audit->zone->name,
               section->name, (long long)element, x[0][0], x[0][1], x[0][2], volume);
  audit->volume += volume;
  audit->least = fmin(audit->least, volume);
}

// The elements of one batch: their nodes, places and volumes, and then their faces.
static void read_batch(Audit *audit, const AuditSection *section, const struct Shape *shape, const int64_t *node,
                       int64_t first, int count) {
  FaceKey keys[5 * 64];
  for (int from = 0; from < count; from += 64) {
    const int to = from + 64 < count ? from + 64 : count;
    int key_count = 0;
    for (int e = from; e < to; ++e) {
      const int64_t *n = node + (int64_t)e * shape->nodes;
      double x[6][3];
      for (int i = 0; i < shape->nodes; ++i) {
        if (n[i] < 1 || n[i] > audit->zone->points)
          audit_fail("zone %s, %s: element %lld has node %lld; allowed: 1 to %lld", audit->zone->name, section->name,
                     (long long)(first + e), (long long)n[i], (long long)audit->zone->points);
        audit->used[(n[i] - 1) >> 3] |= (unsigned char)(1 << ((n[i] - 1) & 7));
        points_at(&audit->points, n[i] - 1, x[i]);
      }
      measure(audit, section, shape, (const double(*)[3])x, first + e);
      for (int f = 0; f < shape->faces; ++f) keys[key_count++] = faces_key(n, shape->face[f], !shape->is_cell);
    }
    for (int i = 0; i < key_count; ++i) faces_prefetch(&audit->faces, &keys[i]);
    for (int i = 0; i < key_count; ++i) {
      const FaceResult result = faces_meet(&audit->faces, &keys[i]);
      const int64_t element = first + from + i / shape->faces;
      if (result == FACE_TWICE)
        audit_fail("zone %s, %s: a face of element %lld is seen twice from one side", audit->zone->name, section->name,
                   (long long)element);
      if (result == FACE_WAITS && !shape->is_cell)
        audit_fail("zone %s, %s: boundary element %lld is no open face of a cell", audit->zone->name, section->name,
                   (long long)element);
    }
  }
}

static void read_section(Audit *audit, const AuditSection *section) {
  const struct Shape *shape = shape_of(audit->zone, section);
  int64_t *node = audit_new(BATCH * 6 * sizeof *node);
  for (int64_t done = 0; done < section->count; done += BATCH) {
    const int64_t now = section->count - done < BATCH ? section->count - done : BATCH;
    audit_read_integers(&section->nodes, done * shape->nodes, now * shape->nodes, node);
    read_batch(audit, section, shape, node, section->first + done, (int)now);
  }
  free(node);
}

// Sections follow one another, cells before boundary elements.
static void check_sections(const AuditZone *zone) {
  int64_t next = 1, cells = 0;
  for (int s = 0; s < zone->section_count; ++s) {
    const AuditSection *section = &zone->sections[s];
    const struct Shape *shape = shape_of(zone, section);
    if (section->first != next || section->nodes.size != section->count * shape->nodes)
      audit_fail("zone %s: section %s begins at %lld with %lld nodes; expected: %lld and %lld", zone->name,
                 section->name, (long long)section->first, (long long)section->nodes.size, (long long)next,
                 (long long)(section->count * shape->nodes));
    next += section->count;
    if (shape->is_cell) cells = next - 1;
  }
  if (cells != zone->cells)
    audit_fail("zone %s: sections of %lld cells; its size says %lld", zone->name, (long long)cells,
               (long long)zone->cells);
  int64_t covered = cells + 1; // the ranges of the conditions come in their order
  for (int c = 0; c < zone->condition_count; ++c) {
    if (zone->conditions[c].first != covered)
      audit_fail("zone %s: condition %s begins at element %lld; expected: %lld", zone->name, zone->conditions[c].name,
                 (long long)zone->conditions[c].first, (long long)covered);
    covered = zone->conditions[c].last + 1;
  }
  if (covered != next)
    audit_fail("zone %s: boundary elements from %lld on are in no condition", zone->name, (long long)covered);
}

static void audit_zone(const AuditFile *file, int number) {
  const AuditZone *zone = &file->zones[number];
  Audit audit = {.zone = zone, .least = INFINITY};
  check_sections(zone);
  faces_start(&audit.faces, zone->points);
  points_start(&audit.points, zone);
  audit.used = audit_new((size_t)zone->points / 8 + 1);
  for (int s = 0; s < zone->section_count; ++s) read_section(&audit, &zone->sections[s]);
  if (audit.faces.count > 0)
    audit_fail("zone %s: %lld faces of cells have neither a second cell nor a boundary element", zone->name,
               (long long)audit.faces.count);
  for (int64_t p = 0; p < zone->points; ++p)
    if (!(audit.used[p >> 3] >> (p & 7) & 1))
      audit_fail("zone %s: point %lld is in no element", zone->name, (long long)p + 1);
  if (fabs(audit.enclosed - audit.volume) > 1e-6 * audit.volume)
    audit_fail("zone %s: the cells have a volume of %.9g, the boundary encloses %.9g", zone->name, audit.volume,
               audit.enclosed);
  const double gap = audit_connections(file, number, &audit.points);
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  printf("{\"zone\": \"%s\", \"points\": %lld, \"cells\": %lld, \"volume\": %.12g, \"least_volume\": %.6g, "
         "\"connection_gap\": %.3g, \"faces_waiting_most\": %lld, \"memory_bytes\": %lld}\n",
         zone->name, (long long)zone->points, (long long)zone->cells, audit.volume, audit.least, gap,
         (long long)audit.faces.most, 1024 * (long long)usage.ru_maxrss);
  faces_free(&audit.faces);
  points_free(&audit.points);
  free(audit.used);
}

int main(int argc, char **argv) {
  pid_t child[AUDIT_ZONES_MOST];
  if (argc != 2) audit_fail("usage: cgns_audit FILE");
  AuditFile file;
  const int zones = audit_file_zone_count(argv[1]);
  for (int z = 0; z < zones; ++z) {
    child[z] = fork();
    if (child[z] == 0) {
      audit_file_open(argv[1], &file);
      audit_zone(&file, z);
      audit_file_close(&file);
      return fflush(stdout) != 0;
    }
  }
  int failed = 0;
  for (int z = 0; z < zones; ++z) {
    int status = 1;
    failed |= child[z] < 0 || waitpid(child[z], &status, 0) < 0 || status != 0;
  }
  return failed;
}
