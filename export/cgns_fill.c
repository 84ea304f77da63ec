// SPDX-License-Identifier: AGPL-3.0-or-later
// The bulk arrays of pump.cgns, region by region. Every region has its own stretch of every array, so ranks need not
// wait for each other, and the order of writing leaves no trace.
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>

#include "export/cgns_file.h"

enum { COORDINATES = 3, NODE_SIZE = 100, PATH_SIZE = 2 * NODE_SIZE };

// Where an array begins in the file.
static CwStatus find_start(const CwCgnsFile *f, hid_t file, const char *zone, const char *node, int64_t *start) {
  CwStatus status = CW_OK;
  char path[PATH_SIZE];
  snprintf(path, sizeof path, "/pump/%s/%s/ data", zone, node);
  hid_t set = H5Dopen2(file, path, H5P_DEFAULT);
  CW_REQUIRE(set >= 0, CW_ERR_LIBRARY, "%s: has no '%s'", f->file.path, path);
  const haddr_t place = H5Dget_offset(set);
  H5Dclose(set);
  CW_REQUIRE(place != HADDR_UNDEF, CW_ERR_LIBRARY, "%s: HDF5 has no place for '%s'", f->file.path, path);
  *start = (int64_t)place;
done:
  return status;
}

static CwStatus find_starts(const CwCgnsFile *f) {
  CwStatus status = CW_OK;
  char node[NODE_SIZE];
  int64_t *starts = f->starts;
  hid_t file = H5Fopen(f->file.path, H5F_ACC_RDONLY, H5P_DEFAULT);
  CW_REQUIRE(file >= 0, CW_ERR_IO, "%s: cannot be read by HDF5", f->file.path);
  for (int d = 0; d < f->assembly->mesh->domain_count; ++d) {
    const char *zone = f->assembly->mesh->domains[d].zone;
    for (int k = 0; k < COORDINATES; ++k) {
      snprintf(node, sizeof node, "GridCoordinates/Coordinate%c", "XYZ"[k]);
      CW_TRY(find_start(f, file, zone, node, starts++));
    }
    for (int s = 0; s < f->section_count[d]; ++s) {
      snprintf(node, sizeof node, "%s/ElementConnectivity", f->sections[d][s].name);
      CW_TRY(find_start(f, file, zone, node, starts++));
    }
  }
done:
  if (file >= 0) H5Fclose(file);
  return status;
}

CwStatus cw_cgns_open(const char *folder, const CwAssembly *a, const CwRanks *ranks, CwCgnsFile *file) {
  CwStatus status = CW_OK;
  const int *count = &file->first_array[a->mesh->domain_count];
  file->assembly = a;
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    CW_TRY(cw_cgns_sections(a, d, &file->sections[d], &file->section_count[d]));
    file->first_array[d + 1] = file->first_array[d] + COORDINATES + file->section_count[d];
  }
  CW_NEW(file->starts, *count);
  CW_TRY(cw_place_file_open(folder, "pump.cgns", 0, &file->file));
  CW_TRY(cw_file_size(file->file.path, &file->size));
  if (ranks->rank == 0) {
    CW_TRY(find_starts(file));
    CW_TRY(cw_file_sum_blocks(file->file.path, file->size, 0, 1, &file->sum)); // all that is there yet
  }
done:
  status = cw_ranks_agree(ranks, status);
  if (status == CW_OK) cw_ranks_broadcast(ranks, file->starts, *count, sizeof *file->starts);
  return status;
}

CwStatus cw_cgns_close(CwCgnsFile *file) {
  free(file->starts);
  file->starts = NULL;
  for (int d = 0; d < CW_DOMAINS_MOST; ++d) {
    free(file->sections[d]);
    file->sections[d] = NULL;
  }
  return cw_place_file_close(&file->file);
}

// Values on their way to the file, which are summed and written while they are in the cache.
typedef struct {
  CwCgnsFile *file;
  int64_t at; // byte of the file of the first one
  int size;   // bytes of a value
  int count;
  union {
    double coordinates[1 << 15];
    int64_t wide[1 << 15];
    int32_t narrow[1 << 16];
  } values;
} Stretch;

static int has_space(const Stretch *s, int count) {
  return (size_t)(s->count + count) * (size_t)s->size <= sizeof s->values;
}

static CwStatus flush(Stretch *s) {
  CwStatus status = CW_OK;
  const int64_t bytes = (int64_t)s->count * s->size;
  cw_file_sum_add(&s->file->sum, s->at, &s->values, bytes);
  CW_TRY(cw_place_file_put(&s->file->file, &s->values, bytes, s->at));
  s->at += bytes;
  s->count = 0;
done:
  return status;
}

static CwStatus write_points(CwCgnsFile *f, int array, int64_t first, int64_t count, const double (*points)[3]) {
  CwStatus status = CW_OK;
  for (int k = 0; k < COORDINATES; ++k) {
    Stretch s = {.file = f, .at = f->starts[array + k] + first * (int64_t)sizeof(double), .size = sizeof(double)};
    for (int64_t i = 0; i < count; ++i) {
      if (!has_space(&s, 1)) CW_TRY(flush(&s));
      s.values.coordinates[s.count++] = points[i][k];
    }
    CW_TRY(flush(&s));
  }
done:
  return status;
}

CwStatus cw_cgns_write_shared(CwCgnsFile *f) {
  CwStatus status = CW_OK;
  const CwAssembly *a = f->assembly;
  for (int d = 0; d < a->mesh->domain_count; ++d)
    CW_TRY(write_points(f, f->first_array[d], 0, a->mesh->domains[d].shared_points, (const double(*)[3])a->shared[d]));
done:
  return status;
}

// The corner that an element's list begins with; the others follow in turn. The first triangle of VTK's wedge has its
// normal outwards (vtkWedge), that of CGNS's PENTA_6 inwards: the two triangles change places.
static int first_corner(const CwCgnsFile *f, const CwSection *section) {
  return f->profile == CW_CGNS_VENDOR && section->type == CW_CGNS_PENTA_6 ? 3 : 0;
}

// Writes the elements of a section whose patch is its (patch_of NULL: all), `first` elements into it.
static CwStatus write_elements(CwCgnsFile *f, int array, int region, const CwRegionData *data, const CwSection *section,
                               int64_t first, const int32_t *elements, int64_t count, const int32_t *patch_of) {
  CwStatus status = CW_OK;
  const CwAssembly *a = f->assembly;
  const int local_patch = section->patch - a->mesh->domains[data->domain].first_patch, nodes = section->nodes;
  const int corner = first_corner(f, section);
  Stretch s = {.file = f, .size = f->wide ? sizeof *s.values.wide : sizeof *s.values.narrow};
  s.at = f->starts[array] + first * nodes * s.size;
  for (int64_t i = 0; i < count; ++i) {
    if (patch_of && patch_of[i] != local_patch) continue;
    if (!has_space(&s, nodes)) CW_TRY(flush(&s));
    for (int n = 0; n < nodes; ++n) {
      const int at = corner + n < nodes ? corner + n : corner + n - nodes;
      const int64_t number = cw_point_number(a, region, data, elements[i * nodes + at]) + 1;
      if (f->wide)
        s.values.wide[s.count++] = number;
      else
        s.values.narrow[s.count++] = (int32_t)number;
    }
  }
  CW_TRY(flush(&s));
done:
  return status;
}

CwStatus cw_cgns_write_region(CwCgnsFile *f, int region, const CwRegionData *data) {
  CwStatus status = CW_OK;
  const CwAssembly *a = f->assembly;
  const CwSection *sections = f->sections[data->domain];
  const int array = f->first_array[data->domain];
  const CwRegionPlace *place = &a->places[region];
  CW_TRY(write_points(f, array, place->own_point, data->point_count - data->shared_count,
                      (const double(*)[3])data->points + data->shared_count));
  for (int s = 0; s < f->section_count[data->domain]; ++s) {
    const CwPatchPart *part = sections[s].patch < 0 ? NULL : cw_patch_part(a, region, sections[s].patch);
    const int32_t *elements = NULL, *patch_of = NULL;
    int64_t first = 0, elements_count = 0;
    switch (sections[s].type) {
    case CW_CGNS_TETRA_4:
      elements = *data->tetrahedra, elements_count = data->tetrahedron_count, first = place->tetrahedron;
      break;
    case CW_CGNS_PYRA_5:
      elements = *data->pyramids, elements_count = data->pyramid_count, first = place->pyramid;
      break;
    case CW_CGNS_PENTA_6:
      elements = *data->prisms, elements_count = data->prism_count, first = place->prism;
      break;
    case CW_CGNS_TRI_3:
      elements = *data->triangles, elements_count = part->faces.triangles ? data->triangle_count : 0;
      patch_of = data->triangle_patch, first = part->before.triangles;
      break;
    default:
      elements = *data->quads, elements_count = part->faces.quads ? data->quad_count : 0;
      patch_of = data->quad_patch, first = part->before.quads;
    }
    CW_TRY(write_elements(f, array + COORDINATES + s, region, data, &sections[s], first, elements, elements_count,
                          patch_of));
  }
done:
  return status;
}
