// SPDX-License-Identifier: AGPL-3.0-or-later
// The bulk arrays of pump.cgns, region by region through parallel HDF5. Every region has its own stretch of
// every array, so ranks need not wait for each other, and the order of writing leaves no trace.
#include <stdio.h>
#include <stdlib.h>

#include "export/cgns_file.h"
#include "export/cgns_sections.h"

CwStatus cw_cgns_open(const char *path, const CwRanks *ranks, hid_t *file) {
  CwStatus status = CW_OK;
  hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  if (ranks->size > 1) H5Pset_fapl_mpio(access, ranks->comm, MPI_INFO_NULL);
  *file = H5Fopen(path, H5F_ACC_RDWR, access);
  CW_REQUIRE(*file >= 0, CW_ERR_IO, "%s: cannot be opened for parallel writing", path);
done:
  H5Pclose(access);
  return status;
}

static int stuck; // a file could not be closed

CwStatus cw_cgns_close(hid_t file) {
  CwStatus status = CW_OK;
  stuck |= H5Fclose(file) < 0;
  CW_REQUIRE(!stuck, CW_ERR_IO, "the CGNS file cannot be written to its end (is the disk full?)");
done:
  return status;
}

int cw_cgns_stuck(void) {
  return stuck;
}

static CwStatus write_stretch(hid_t file, const char *path, hid_t type, int64_t first, int64_t count,
                              const void *values) {
  CwStatus status = CW_OK;
  hid_t set = -1, there = -1, here = -1;
  if (count == 0) goto done;
  set = H5Dopen2(file, path, H5P_DEFAULT);
  CW_REQUIRE(set >= 0, CW_ERR_LIBRARY, "the CGNS file has no '%s'", path);
  there = H5Dget_space(set);
  here = H5Screate_simple(1, (hsize_t[]){(hsize_t)count}, NULL);
  H5Sselect_hyperslab(there, H5S_SELECT_SET, (hsize_t[]){(hsize_t)first}, NULL, (hsize_t[]){(hsize_t)count}, NULL);
  int written = H5Dwrite(set, type, here, there, H5P_DEFAULT, values) >= 0;
  if (H5Dclose(set) < 0) written = 0; // small stretches are written only now
  set = -1;
  CW_REQUIRE(written, CW_ERR_IO, "%lld values cannot be written to '%s' of the CGNS file (is the disk full?)",
             (long long)count, path);
done:
  if (here >= 0) H5Sclose(here);
  if (there >= 0) H5Sclose(there);
  if (set >= 0) H5Dclose(set);
  return status;
}

static CwStatus write_points(hid_t file, const CwMesh *mesh, int domain, int64_t first, int64_t count,
                             const double (*points)[3]) {
  CwStatus status = CW_OK;
  double *one = NULL;
  CW_NEW_UNSET(one, count);
  for (int k = 0; k < 3; ++k) {
    char path[100];
    snprintf(path, sizeof path, "/pump/%s/GridCoordinates/Coordinate%c/ data", mesh->domains[domain].zone, "XYZ"[k]);
    for (int64_t i = 0; i < count; ++i) one[i] = points[i][k];
    CW_TRY(write_stretch(file, path, H5T_NATIVE_DOUBLE, first, count, one));
  }
done:
  free(one);
  return status;
}

CwStatus cw_cgns_write_shared(hid_t file, const CwAssembly *a) {
  CwStatus status = CW_OK;
  for (int d = 0; d < a->mesh->domain_count; ++d)
    CW_TRY(write_points(file, a->mesh, d, 0, a->mesh->domains[d].shared_points, (const double(*)[3])a->shared[d]));
done:
  return status;
}

// Writes the elements of `nodes` nodes whose patch is `patch` (patch_of NULL: all), `first` elements into a
// section.
static CwStatus write_elements(hid_t file, const CwAssembly *a, int region, const CwRegionData *data,
                               const CwSection *section, int64_t first, const int32_t *elements, int64_t count,
                               const int32_t *patch_of, int wide) {
  CwStatus status = CW_OK;
  int32_t *out = NULL;
  int64_t *wide_out = NULL;
  int64_t used = 0;
  char path[100];
  int local_patch = section->patch - a->mesh->domains[data->domain].first_patch;
  if (wide)
    CW_NEW_UNSET(wide_out, count * section->nodes);
  else
    CW_NEW_UNSET(out, count * section->nodes);
  for (int64_t i = 0; i < count; ++i)
    for (int n = 0; n < section->nodes && (!patch_of || patch_of[i] == local_patch); ++n) {
      const int64_t number = cw_point_number(a, region, data, elements[i * section->nodes + n]) + 1;
      if (wide)
        wide_out[used++] = number;
      else
        out[used++] = (int32_t)number;
    }
  snprintf(path, sizeof path, "/pump/%s/%s/ElementConnectivity/ data", a->mesh->domains[data->domain].zone,
           section->name);
  CW_TRY(write_stretch(file, path, wide ? H5T_NATIVE_INT64 : H5T_NATIVE_INT32, first * section->nodes, used,
                       wide ? (const void *)wide_out : out));
done:
  free(out);
  free(wide_out);
  return status;
}

CwStatus cw_cgns_write_region(hid_t file, const CwAssembly *a, int region, const CwRegionData *data, int wide) {
  CwStatus status = CW_OK;
  CwSection *sections = NULL;
  int count = 0;
  const CwRegionPlace *place = &a->places[region];
  CW_TRY(write_points(file, a->mesh, data->domain, place->own_point, data->point_count - data->shared_count,
                      (const double(*)[3])data->points + data->shared_count));
  CW_TRY(cw_cgns_sections(a, data->domain, &sections, &count));
  for (int s = 0; s < count; ++s) {
    const CwPatchPart *part =
        sections[s].patch < 0 ? NULL
                              : &a->parts[(size_t)region * (size_t)a->mesh->patch_count + (size_t)sections[s].patch];
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
      elements = *data->triangles, elements_count = part->triangles ? data->triangle_count : 0;
      patch_of = data->triangle_patch, first = part->triangle;
      break;
    default:
      elements = *data->quads, elements_count = part->quads ? data->quad_count : 0;
      patch_of = data->quad_patch, first = part->quad;
    }
    CW_TRY(write_elements(file, a, region, data, &sections[s], first, elements, elements_count, patch_of,
                          wide));
  }
done:
  free(sections);
  return status;
}
