// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/stage.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "export/folder.h"
#include "export/output.h"
#include "export/patch_role.h"
#include "export/region_check.h"
#include "pipeline/case_points.h"
#include "pipeline/log.h"
#include "pipeline/record.h"

// Of volume and area, between the cells and the solid and the two sides of an interface: more is worth a word.
static const double FAIR_DIFFERENCE = 0.02;

// A solver's case needs both ends.
static CwStatus check_ends(const CwMesh *mesh) {
  CwStatus status = CW_OK;
  for (CwPatchKind kind = CW_PATCH_INLET; kind <= CW_PATCH_OUTLET; ++kind)
    CW_REQUIRE(cw_patch_kind_count(mesh, kind) > 0, CW_ERR_EXPORT,
               "mesh/manifest.json: no patch is of kind %s; allowed: one at least", cw_patch_kind_name(kind));
done:
  return status;
}

// What rank 0 does alone before the regions are written.
static CwStatus begin_files(const CwAssembly *assembly, CwOutput *output) {
  CwStatus status = CW_OK;
  const int count = assembly->mesh->interface_count;
  CwInterface *interfaces = NULL;
  CW_NEW(interfaces, count);
  for (int i = 0; i < count; ++i) CW_TRY(cw_interface_make(assembly, i, &interfaces[i]));
  CW_TRY(cw_folder_remove(output->folder));
  CW_TRY(cw_output_begin(output, interfaces));
done:
  for (int i = 0; interfaces && i < count; ++i) cw_interface_free(&interfaces[i]);
  free(interfaces);
  return status;
}

// The second pass over the regions.
typedef struct {
  CwAssembly *assembly;
  const CwRanks *ranks;
  CwOutput *output;
  CwRegionFigures *figures; // by region
  CwRegionModel model;
  int written; // regions of this rank
} Writing;

enum { SYNCS = 16 }; // times that what is written is sent to the disk on the way

static CwStatus write_region(void *context, int region, CwRegionData *data) {
  CwStatus status = CW_OK;
  Writing *w = context;
  const int64_t regions = w->assembly->share.own_count, written = ++w->written;
  CW_TRY(cw_region_check(w->assembly, region, data, &w->model));
  w->figures[region] = w->model.figures;
  CW_TRY(cw_output_write_region(w->output, region, data, &w->model.faces));
  cw_region_model_keep(w->assembly, region, data, &w->model);
  if (w->ranks->rank == 0 && written * SYNCS / regions > (written - 1) * SYNCS / regions)
    cw_folder_sync_begin(w->output->folder);
done:
  return status;
}

// The bulk: every rank its regions. The failures of single ranks are told at the end, as closing is
// collective.
static CwStatus write_regions(CwAssembly *assembly, const CwRanks *ranks, CwOutput *output) {
  CwStatus status = CW_OK;
  const int regions = assembly->mesh->region_count;
  Writing writing = {.assembly = assembly,
                     .ranks = ranks,
                     .output = output,
                     .figures = calloc((size_t)regions, sizeof *writing.figures)};
  if (!writing.figures) status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %d regions", regions);
  CW_TRY(cw_ranks_agree(ranks, status));
  status = cw_output_open(output, ranks);
  if (status == CW_OK)
    status = cw_each_region(assembly, ranks, "check and write the mesh", CW_BACKWARDS, write_region, &writing);
done:;
  CwStatus closed = cw_output_close(output);
  status = cw_ranks_agree(ranks, status == CW_OK ? closed : status);
  if (status == CW_OK) cw_region_figures_sum(ranks, writing.figures, assembly);
  cw_region_model_free(&writing.model);
  free(writing.figures);
  return status;
}

static CwStatus record_patches(const CwAssembly *a, CwRecord *record) {
  json_t *patches = json_array();
  for (int p = 0; p < a->mesh->patch_count; ++p) {
    const CwPatchPart *sum = &a->patches[p];
    json_array_append_new(patches, json_pack("{s:s, s:s, s:I, s:I, s:f}", "name", a->mesh->patches[p].name, "domain",
                                             a->mesh->domains[a->mesh->patches[p].domain].name, "triangles",
                                             (json_int_t)sum->faces.triangles, "quads", (json_int_t)sum->faces.quads,
                                             "area_m2", sum->area));
  }
  return cw_record_json(record, "patches", patches);
}

// Meshes of one pump may differ in these, and their solved flows then in more than the size of the cells.
static CwStatus record_turbulence(const CwAssembly *a, CwRecord *record) {
  CwStatus status = CW_OK;
  json_t *resolved = json_array();
  for (int p = 0; p < a->mesh->patch_count; ++p)
    if (cw_patch_is_there(a, p) && cw_patch_resolved(&a->mesh->patches[p]))
      json_array_append_new(resolved, json_string(a->mesh->patches[p].name));
  CW_TRY(cw_record_json(record, "resolved_walls", resolved));
  CW_TRY(
      cw_record_json(record, "turbulence_model", json_string(cw_turbulence_model_name(cw_turbulence_model(a->mesh)))));
done:
  return status;
}

static CwStatus record_interfaces(const CwAssembly *a, CwRecord *record) {
  json_t *list = json_array();
  for (int i = 0; i < a->mesh->interface_count; ++i) {
    const int *patch = a->mesh->interfaces[i].patch;
    const CwPatchPart *one = &a->patches[patch[0]], *other = &a->patches[patch[1]];
    json_array_append_new(list, json_pack("{s:[s,s], s:[s,s], s:[f,f], s:[I,I]}", "domains",
                                          a->mesh->domains[a->mesh->patches[patch[0]].domain].name,
                                          a->mesh->domains[a->mesh->patches[patch[1]].domain].name, "patches",
                                          a->mesh->patches[patch[0]].name, a->mesh->patches[patch[1]].name, "areas_m2",
                                          one->area, other->area, "faces", (json_int_t)cw_face_count(one->faces),
                                          (json_int_t)cw_face_count(other->faces)));
  }
  return cw_record_json(record, "interfaces", list);
}

// The points of the characteristic curve, of which the solvers' cases have a set-up each, and what was measured.
static CwStatus record_points(const CwCase *table, CwRecord *record) {
  CwStatus status = CW_OK;
  json_t *list = json_array();
  CwCasePoint points[CW_LIST_MOST];
  const int count = cw_case_points(table, points);
  for (int k = 0; k < count; ++k)
    json_array_append_new(list, json_pack("{s:s, s:f, s:f}", "name", points[k].name, "flow_m3_per_h",
                                          3600 * points[k].flow, "flow_share", points[k].share));
  CW_TRY(cw_record_json(record, "operating_points", list));
  if (cw_case_given(table->operating_point.test_head))
    CW_TRY(cw_record_number(record, "test_head_m", table->operating_point.test_head));
done:
  return status;
}

// What checkMesh would tell of.
static void put_counts(const CwFaceQuality *faces, json_t *figures) {
  const struct {
    const char *name;
    int64_t count;
  } counts[] = {{"skew_faces_of_prisms", faces->skew[CW_FACE_OF_PRISM]},
                {"other_skew_faces", faces->skew[CW_FACE_OTHER]},
                {"small_weight_faces_of_prisms", faces->light[CW_FACE_OF_PRISM]},
                {"other_small_weight_faces", faces->light[CW_FACE_OTHER]},
                {"small_volume_ratio_faces_of_prisms", faces->uneven[CW_FACE_OF_PRISM]},
                {"other_small_volume_ratio_faces", faces->uneven[CW_FACE_OTHER]},
                {"twisted_faces", faces->twisted},
                {"high_aspect_ratio_prisms", faces->slender},
                {"small_determinant_prisms", faces->open[CW_FACE_OF_PRISM]},
                {"other_small_determinant_cells", faces->open[CW_FACE_OTHER]}};
  for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i)
    json_object_set_new(figures, counts[i].name, json_integer((json_int_t)counts[i].count));
}

static CwStatus record_results(const CwAssembly *a, CwRecord *record) {
  CwStatus status = CW_OK;
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    const CwDomainTotal *t = &a->totals[d];
    json_t *figures =
        json_pack("{s:I, s:I, s:I, s:I, s:f, s:f, s:f, s:f, s:f}", "points", (json_int_t)t->points, "tetrahedra",
                  (json_int_t)t->tetrahedra, "pyramids", (json_int_t)t->pyramids, "prisms", (json_int_t)t->prisms,
                  "volume_m3", t->volume, "solid_volume_m3", a->mesh->domains[d].solid_volume, "least_cell_volume_m3",
                  t->least_volume, "greatest_non_orthogonality_deg", cw_non_orthogonality_greatest(&t->faces),
                  "mean_non_orthogonality_deg", cw_non_orthogonality_mean(&t->faces));
    put_counts(&t->faces, figures);
    CW_TRY(cw_record_json(record, a->mesh->domains[d].name, figures));
  }
  CW_TRY(cw_record_integer(record, "cells", cw_assembly_cells(a)));
  CW_TRY(cw_record_integer(record, "faces_on_partition_planes", a->open_count / 2));
  CW_TRY(record_interfaces(a, record));
  CW_TRY(record_patches(a, record));
  CW_TRY(record_turbulence(a, record));
done:
  return status;
}

// Counts as checkMesh does what it calls a failed check.
static void warn_of_faces(CwLog *log, const char *domain, const CwFaceQuality *faces) {
  const struct {
    const int64_t *count; // by CwFaceKind
    const char *are;
    double limit;
    const char *why;
  } kinds[] = {{faces->skew, "have a skewness above", CW_SKEWNESS_MOST,
                ": layers are thin for the bend of their wall; less mesh.curvature_angle_deg, more mesh.cells or "
                "thicker layers lower it"},
               {faces->light, "have an interpolation weight under", CW_SMALL_WEIGHT,
                ": the last layer is thin for the tetrahedra on it; more walls.layer_count or mesh.cells raise it"},
               {faces->uneven, "lie between cells of which one has more than", 1 / CW_VOLUME_RATIO_LEAST,
                " times the volume of the other; walls.layer_count: auto brings layers to the size of the tetrahedra"}};
  const int64_t open = faces->open[CW_FACE_OF_PRISM], other_open = faces->open[CW_FACE_OTHER];
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i)
    if (kinds[i].count[CW_FACE_OF_PRISM] + kinds[i].count[CW_FACE_OTHER] > 0)
      cw_log_warn(log, "domain %s: %lld faces of prisms and %lld others %s %g%s", domain,
                  (long long)kinds[i].count[CW_FACE_OF_PRISM], (long long)kinds[i].count[CW_FACE_OTHER], kinds[i].are,
                  kinds[i].limit, kinds[i].why);
  if (faces->twisted > 0)
    cw_log_warn(log,
                "domain %s: %lld sides of prisms are so twisted that no diagonal divides them for both cells: columns "
                "lean apart; more mesh.cells or thinner layers make them fewer",
                domain, (long long)faces->twisted);
  if (faces->slender + open > 0)
    cw_log_warn(
        log,
        "domain %s: %lld prisms have an aspect ratio above %g and %lld a determinant under %g, as thin as the case "
        "asks or at edges of open patches; a greater walls.y_plus_* or more mesh.cells make them fewer",
        domain, (long long)faces->slender, CW_ASPECT_MOST, (long long)open, CW_SMALL_DETERMINANT);
  if (other_open > 0)
    cw_log_warn(log,
                "domain %s: %lld other cells have a determinant under %g: flat ones, or such with two faces on "
                "patches; with more mesh.cells there are fewer",
                domain, (long long)other_open, CW_SMALL_DETERMINANT);
}

// Worth a word, though the mesh can be used.
static void warn(CwLog *log, const CwAssembly *a) {
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    warn_of_faces(log, a->mesh->domains[d].name, &a->totals[d].faces);
    double solid = a->mesh->domains[d].solid_volume, off = a->totals[d].volume / solid - 1;
    if (fabs(off) > FAIR_DIFFERENCE)
      cw_log_warn(log,
                  "domain %s: the cells fill %.6g mm3, the solid %.6g mm3: %+.1f %%; wanted: within %.0f %%; more "
                  "mesh.cells follow its walls better",
                  a->mesh->domains[d].name, 1e9 * a->totals[d].volume, 1e9 * solid, 100 * off, 100 * FAIR_DIFFERENCE);
  }
  for (int i = 0; i < a->mesh->interface_count; ++i) {
    const int *patch = a->mesh->interfaces[i].patch;
    const double area = a->patches[patch[0]].area, other = a->patches[patch[1]].area;
    if (fabs(area / other - 1) > FAIR_DIFFERENCE)
      cw_log_warn(log,
                  "the interface has %.6g mm2 on patch '%s' and %.6g mm2 on '%s'; wanted: within %.0f %%; more "
                  "mesh.cells, or a lower mesh.size_interface, follow its surface better",
                  1e6 * area, a->mesh->patches[patch[0]].name, 1e6 * other, a->mesh->patches[patch[1]].name,
                  100 * FAIR_DIFFERENCE);
  }
  for (int p = 0; p < a->mesh->patch_count; ++p)
    if (!cw_patch_is_there(a, p)) cw_log_warn(log, "patch '%s' has no face and is left out", a->mesh->patches[p].name);
}

// Moves what was made to its place. What an earlier run left of other formats is not of this mesh.
static CwStatus finish_files(const char *folder, const char *part, int formats) {
  CwStatus status = CW_OK;
  char *from = NULL, *to = NULL;
  CW_TRY(cw_folder_sync(part));
  for (int f = 0; f < CW_FORMATS; ++f) {
    CW_TRY(cw_path_set(&from, "%s/%s", part, cw_output_names[f]));
    CW_TRY(cw_path_set(&to, "%s/%s", folder, cw_output_names[f]));
    CW_TRY(formats >> f & 1 ? cw_folder_replace(from, to) : cw_folder_remove(to));
  }
  CW_TRY(cw_folder_remove(part));
done:
  free(from);
  free(to);
  return status;
}

// The formats that were written, and why another one was not.
static CwStatus record_formats(CwLog *log, const CwOutput *output, CwRecord *record) {
  CwStatus status = CW_OK;
  json_t *written = json_array(), *headlines = json_array();
  for (int f = 0; f < CW_FORMATS; ++f) {
    if (cw_output_has(output, (CwFormat)f)) json_array_append_new(written, json_string(cw_output_names[f]));
    if (!output->left_out[f][0]) continue;
    cw_log_warn(log, "%s", output->left_out[f]);
    json_array_append_new(headlines, json_string(output->left_out[f]));
  }
  CW_TRY(cw_record_json(record, "formats", written));
  CW_TRY(cw_record_json(record, "headlines", headlines));
done:
  return status;
}

static CwStatus fill_record(const CwCase *table, const CwRanks *ranks, const CwAssembly *assembly,
                            const CwOutput *output, CwRecord *record) {
  CwStatus status = CW_OK;
  warn(ranks->log, assembly);
  CW_TRY(record_results(assembly, record));
  CW_TRY(record_points(table, record));
  CW_TRY(record_formats(ranks->log, output, record));
  CW_TRY(cw_record_case(record, table));
  CW_TRY(cw_record_integer(record, "ranks", ranks->size));
done:
  return status;
}

CwStatus cw_export_run(const CwCase *table, const char *run, const char *const *reads, const CwRanks *ranks) {
  CwStatus status = CW_OK;
  CwMesh mesh = {0};
  CwAssembly assembly = {0};
  CwOutput output = {0};
  CwRecord *record = NULL;
  char *folder = NULL, *part = NULL, *path = NULL, digest[CW_HASH_TEXT];
  double start = cw_seconds(), checked = 0, planned = 0, written = 0;
  status = cw_path_set(&folder, "%s/export", run);
  if (status == CW_OK) status = cw_path_set(&part, "%s/.part", folder);
  if (status == CW_OK) status = cw_path_set(&path, "%s/record.json", folder);
  if (status == CW_OK) status = cw_record_start("export", ranks->log, &record);
  if (status == CW_OK) status = cw_record_made_from(record, run, reads);
  if (status == CW_OK) status = cw_mesh_manifest_read(run, &mesh);
  if (status == CW_OK) status = check_ends(&mesh);
  CW_TRY(cw_ranks_agree(ranks, status));
  CW_TRY(cw_assembly_make(&mesh, ranks, &assembly));
  checked = cw_seconds();
  status = cw_output_plan(table, &assembly, part, &output);
  if (status == CW_OK && ranks->rank == 0) status = begin_files(&assembly, &output);
  CW_TRY(cw_ranks_agree(ranks, status));
  planned = cw_seconds();
  CW_TRY(write_regions(&assembly, ranks, &output));
  CW_TRY(cw_output_digest(&output, ranks, digest));
  written = cw_seconds();
  int64_t memory = cw_peak_memory_bytes(), faces = 0;
  const int64_t cells = cw_assembly_cells(&assembly);
  for (int i = 0; i < mesh.interface_count; ++i)
    for (int s = 0; s < 2; ++s) faces += cw_face_count(assembly.patches[mesh.interfaces[i].patch[s]].faces);
  MPI_Allreduce(MPI_IN_PLACE, &memory, 1, MPI_INT64_T, MPI_SUM, ranks->comm);
  if (ranks->rank == 0) {
    CW_TRY(cw_record_step(record, "number the mesh", checked - start, cells, "cells"));
    CW_TRY(cw_record_step(record, "interface and tree", planned - checked, faces, "faces"));
    CW_TRY(cw_record_step(record, "check and write the mesh", written - planned, cells, "cells"));
    CW_TRY(fill_record(table, ranks, &assembly, &output, record));
    CW_TRY(cw_record_file_digest(record, cw_output_known_by(&output), digest));
    cw_record_set_peak_memory(record, memory);
    CW_TRY(finish_files(folder, part, output.formats));
    CW_TRY(cw_record_write(record, path));
    cw_log(ranks->log, "%lld cells written to %s in %.1f s", (long long)cells, folder, cw_seconds() - start);
  }
done:
  if (status != CW_OK && ranks->rank == 0 && part) {
    const CwFailure failure = *cw_failure(); // that is what is told, not what becomes of the folder
    cw_folder_remove(part);
    *cw_failure() = failure;
    rmdir(folder); // only if nothing is in it
  }
  cw_output_free(&output);
  cw_assembly_free(&assembly);
  cw_mesh_free(&mesh);
  cw_record_free(record);
  free(folder);
  free(part);
  free(path);
  return cw_ranks_agree(ranks, status);
}
