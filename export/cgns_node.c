// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/cgns_node.h"

#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 33, TYPE_SIZE = 3 };

static CwStatus put_text_attribute(hid_t node, const char *name, const char *text, size_t size) {
  CwStatus status = CW_OK;
  char padded[NAME_SIZE] = {0};
  hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR), attribute = -1;
  memcpy(padded, text, strnlen(text, size - 1));
  H5Tset_size(type, size);
  attribute = H5Acreate2(node, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  CW_REQUIRE(attribute >= 0 && H5Awrite(attribute, type, padded) >= 0, CW_ERR_LIBRARY,
             "HDF5 cannot write the attribute '%s' = '%s'", name, text);
done:
  if (attribute >= 0) H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
  return status;
}

static CwStatus put_attributes(hid_t node, const char *name, const char *label, const char *type) {
  CwStatus status = CW_OK;
  CW_TRY(put_text_attribute(node, "name", name, NAME_SIZE));
  CW_TRY(put_text_attribute(node, "label", label, NAME_SIZE));
  CW_TRY(put_text_attribute(node, "type", type, TYPE_SIZE));
done:
  return status;
}

static CwStatus put_data(hid_t node, const char *name, hid_t type, int dimensions, const hsize_t *size,
                         const void *data) {
  CwStatus status = CW_OK;
  hid_t plan = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(dimensions, size, NULL), set = -1;
  H5Pset_obj_track_times(plan, 0);
  H5Pset_alloc_time(plan, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(plan, H5D_FILL_TIME_NEVER);
  set = H5Dcreate2(node, name, type, space, H5P_DEFAULT, plan, H5P_DEFAULT);
  CW_REQUIRE(set >= 0, CW_ERR_LIBRARY, "HDF5 cannot make the dataset '%s'", name);
  if (data)
    CW_REQUIRE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0, CW_ERR_IO,
               "HDF5 cannot write the dataset '%s'", name);
  herr_t closed = H5Dclose(set); // small ones are written only now
  set = -1;
  CW_REQUIRE(closed >= 0, CW_ERR_IO, "HDF5 cannot write the dataset '%s'", name);
done:
  if (set >= 0) H5Dclose(set);
  H5Sclose(space);
  H5Pclose(plan);
  return status;
}

CwStatus cw_cgns_create(const char *path, hid_t *file) {
  CwStatus status = CW_OK;
  static const char format[] = "IEEE_LITTLE_32";
  char version[NAME_SIZE] = "HDF5 Version 1.10.8";
  const float library = 3.4f;
  hid_t create = H5Pcreate(H5P_FILE_CREATE), access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_link_creation_order(create, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(create, 0);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  *file = H5Fcreate(path, H5F_ACC_TRUNC, create, access);
  CW_REQUIRE(*file >= 0, CW_ERR_IO, "HDF5 cannot make the file");
  CW_TRY(put_attributes(*file, "HDF5 MotherNode", "Root Node of HDF5 File", "MT"));
  CW_TRY(put_data(*file, " format", H5T_STD_I8LE, 1, (hsize_t[]){sizeof format}, format));
  CW_TRY(put_data(*file, " hdf5version", H5T_STD_I8LE, 1, (hsize_t[]){sizeof version}, version));
  CW_TRY(cw_cgns_list(*file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4", 1, &library, NULL));
done:
  H5Pclose(access);
  H5Pclose(create);
  return status;
}

CwStatus cw_cgns_node(hid_t parent, const char *name, const char *label, const char *type, int dimensions,
                      const hsize_t *size, const void *data, hid_t *node) {
  CwStatus status = CW_OK;
  const int one = 1;
  hid_t plan = H5Pcreate(H5P_GROUP_CREATE), group = -1, space = -1, attribute = -1;
  CW_REQUIRE(strlen(name) < NAME_SIZE, CW_ERR_EXPORT, "the CGNS name '%s' has %zu characters; allowed: %d", name,
             strlen(name), NAME_SIZE - 1);
  H5Pset_obj_track_times(plan, 0);
  H5Pset_link_creation_order(plan, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  group = H5Gcreate2(parent, name, H5P_DEFAULT, plan, H5P_DEFAULT);
  CW_REQUIRE(group >= 0, CW_ERR_LIBRARY, "HDF5 cannot make the node '%s'", name);
  CW_TRY(put_attributes(group, name, label, type));
  space = H5Screate_simple(1, (hsize_t[]){1}, NULL);
  attribute = H5Acreate2(group, "flags", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT);
  CW_REQUIRE(attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT, &one) >= 0, CW_ERR_LIBRARY,
             "HDF5 cannot write the attribute 'flags' of '%s'", name);
  if (strcmp(type, "MT") != 0) {
    hid_t of = strcmp(type, "C1") == 0   ? H5T_STD_I8LE
               : strcmp(type, "I4") == 0 ? H5T_STD_I32LE
               : strcmp(type, "I8") == 0 ? H5T_STD_I64LE
               : strcmp(type, "R4") == 0 ? H5T_IEEE_F32LE
                                         : H5T_IEEE_F64LE;
    CW_TRY(put_data(group, " data", of, dimensions, size, data));
  }
done:
  if (attribute >= 0) H5Aclose(attribute);
  if (space >= 0) H5Sclose(space);
  if (group >= 0 && (!node || status != CW_OK))
    H5Gclose(group);
  else if (node)
    *node = group;
  H5Pclose(plan);
  return status;
}

CwStatus cw_cgns_text(hid_t parent, const char *name, const char *label, const char *text, hid_t *node) {
  return cw_cgns_node(parent, name, label, "C1", 1, (hsize_t[]){strlen(text)}, text, node);
}

CwStatus cw_cgns_list(hid_t parent, const char *name, const char *label, const char *type, hsize_t count,
                      const void *data, hid_t *node) {
  return cw_cgns_node(parent, name, label, type, 1, &count, data, node);
}

CwStatus cw_cgns_integers(hid_t parent, const char *name, const char *label, int wide, hsize_t count, hsize_t columns,
                          const int64_t *data, hid_t *node) {
  CwStatus status = CW_OK;
  const hsize_t size[2] = {count, columns}, values = count * (columns ? columns : 1);
  int32_t *narrow = NULL;
  if (data && !wide) {
    CW_NEW_UNSET(narrow, values);
    for (hsize_t i = 0; i < values; ++i) narrow[i] = (int32_t)data[i];
  }
  CW_TRY(cw_cgns_node(parent, name, label, wide ? "I8" : "I4", columns ? 2 : 1, size,
                      wide ? (const void *)data : narrow, node));
done:
  free(narrow);
  return status;
}

CwStatus cw_cgns_quantity(hid_t parent, const char *name, const char *type, hsize_t count, const void *data,
                          const float exponents[5]) {
  CwStatus status = CW_OK;
  hid_t array = -1;
  CW_TRY(cw_cgns_list(parent, name, "DataArray_t", type, count, data, &array));
  CW_TRY(cw_cgns_list(array, "DimensionalExponents", "DimensionalExponents_t", "R4", 5, exponents, NULL));
done:
  if (array >= 0) H5Gclose(array);
  return status;
}
