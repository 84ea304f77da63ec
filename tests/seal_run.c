// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/seal_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/file_digest.h"
#include "pipeline/json_read.h"
#include "pipeline/mesh/region_items.h"
#include "pipeline/record.h"
#include "pipeline/sealed_json.h"
#include "pipeline/stage_files.h"

enum { PATH_SIZE = 4096 };
static const char *const array_names[CW_REGION_ARRAYS] = {"points", "shared_id",  "tetrahedra",     "pyramids",
                                                          "prisms", "triangles",  "triangle_patch", "triangle_cell",
                                                          "quads",  "quad_patch", "quad_cell"};

static CwHash digest_array(hid_t file, const char *name) {
  CwHash hash = cw_hash_start();
  hid_t set = H5Lexists(file, name, H5P_DEFAULT) > 0 ? H5Dopen2(file, name, H5P_DEFAULT) : -1;
  if (set >= 0) {
    hid_t type = H5Dget_type(set), space = H5Dget_space(set);
    size_t size = (size_t)H5Sget_simple_extent_npoints(space) * H5Tget_size(type);
    void *data = malloc(size + 1);
    if (size > 0) H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    cw_hash_bytes(&hash, data, size);
    free(data);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
  } else {
    cw_hash_bytes(&hash, "", 0);
  }
  return hash;
}

static void set_attribute(hid_t file, const char *name, hid_t type, const void *value) {
  hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  H5Awrite(attribute, type, value);
  H5Aclose(attribute);
}

static void seal_region(const char *path, char digest[CW_HASH_TEXT]) {
  CwHash digests[CW_REGION_ARRAYS];
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT), text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, CW_HASH_TEXT);
  if (file >= 0) {
    for (int k = 0; k < CW_REGION_ARRAYS; k++) digests[k] = digest_array(file, array_names[k]);
    set_attribute(file, "digests", H5T_NATIVE_UINT64, digests);
    if (cw_region_items_digest(file, path, digest) == CW_OK) set_attribute(file, "digest", text, digest);
    H5Fclose(file);
  }
  H5Tclose(text);
}

static int seal_mesh(const char *run) {
  char path[PATH_SIZE], digest[CW_HASH_TEXT];
  json_t *manifest = NULL, *domain, *region;
  size_t d, r;
  snprintf(path, sizeof path, "%s/mesh/manifest.json", run);
  if (cw_json_read(path, &manifest) != CW_OK) return 0;
  json_array_foreach(json_object_get(manifest, "domains"), d, domain) {
    json_array_foreach(json_object_get(domain, "regions"), r, region) {
      char file[PATH_SIZE];
      const char *name = json_string_value(json_object_get(region, "file"));
      snprintf(file, sizeof file, "%s/mesh/%s", run, name ? name : "");
      strcpy(digest, "none");
      seal_region(file, digest);
      json_object_set_new(region, "digest", json_string(digest));
    }
  }
  int failed = cw_json_write(manifest, path) != CW_OK;
  json_decref(manifest);
  return failed ? -1 : 0;
}

// The files of a stage for the others.
static const char *const stage_names[] = {"geometry", "mesh", "export", NULL};
static const char *const file_names[][8] = {
    {"design.json", "faces.csv", "model.json", "rotor.brep", "stator.brep", "velocity_triangles.svg"},
    {"manifest.json"},
    {"pump.cgns"}};

static int seal_record(const char *run, int stage) {
  char path[PATH_SIZE], digest[CW_HASH_TEXT];
  const char *reads[4] = {NULL};
  json_t *record = NULL, *made_from = NULL, *files = json_object();
  snprintf(path, sizeof path, "%s/%s/record.json", run, stage_names[stage]);
  if (cw_json_read(path, &record) != CW_OK) {
    json_decref(files);
    return 0;
  }
  for (const char *const *name = file_names[stage]; *name; name++) {
    char file[PATH_SIZE];
    snprintf(file, sizeof file, "%s/%s/%s", run, stage_names[stage], *name);
    if (access(file, F_OK) == 0 && cw_file_digest(file, digest) == CW_OK)
      json_object_set_new(files, *name, json_string(digest));
  }
  json_object_set_new(record, "files", files);
  memcpy(reads, stage_names, (size_t)stage * sizeof *reads);
  if (cw_stage_files_read(run, reads, &made_from) == CW_OK) json_object_set_new(record, "made_from", made_from);
  json_object_del(record, "digest");
  int failed = cw_sealed_json_write(record, path) != CW_OK;
  json_decref(record);
  return failed ? -1 : 0;
}

int seal_run(const char *run) {
  int failed = seal_mesh(run);
  for (int stage = 0; stage_names[stage]; stage++) failed |= seal_record(run, stage);
  return failed;
}
