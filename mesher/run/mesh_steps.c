// SPDX-License-Identifier: AGPL-3.0-or-later
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/background_tessellate.h"
#include "mesher/common/vec.h"
#include "mesher/fill/tet_bound.h"
#include "mesher/region/region_boundary.h"
#include "mesher/region/region_copy.h"
#include "mesher/run/domain_size.h"
#include "mesher/run/mesh_steps.h"
#include "pipeline/mesh/cell.h"

CwStatus cw_step_background(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size) {
  return cw_tessellation_face(run->domain[task.domain].tessellation, task.index, bytes, size);
}

CwStatus cw_step_seed(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size) {
  return cw_domain_seed(&run->domain[task.domain], run->table, task.index, bytes, size);
}

CwStatus cw_step_size(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CwSizePoint *point = NULL;
  int32_t points;
  CW_TRY(cw_finer_places_of(&run->finer, task.domain, &points, &point));
  CW_TRY(cw_domain_make_size(&run->domain[task.domain], run->table, run->gradation, run->wall_scale, points, point,
                             run->seeds[task.domain], task.index, bytes, size));
done:
  free(point);
  return status;
}

CwStatus cw_step_wall(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size) {
  const CwDomain *domain = &run->domain[task.domain];
  int patch = cw_cad_face_patch(domain->cad, task.index);
  double largest = cw_domain_longest_edge(domain, patch);
  return cw_surface_mesh_face(&domain->input, &domain->wall_curves, task.index, largest, bytes, size);
}

CwStatus cw_step_interface(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size) {
  const CwDomain *domain = &run->domain[task.domain];
  int32_t faces = cw_cad_face_count(domain->cad);
  if (task.index >= faces)
    return cw_interfaces_polygon(&domain->input, &domain->free_curves, task.index - faces, bytes, size);
  return cw_interfaces_open_patch(&domain->input, &domain->wall_curves, &domain->free_curves, task.index, bytes, size);
}

CwStatus cw_step_rule(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size) {
  const CwDomain *domain = &run->domain[task.domain];
  char name[64];
  const CwRegionInput from = cw_domain_region_input(domain, run->context.log);
  snprintf(name, sizeof name, "%s region %d", domain->name, task.index + 1);
  return cw_interface_rule(&from, domain->number, task.index, name, bytes, size);
}

static double face_area(const CwRegionMesh *mesh, const int32_t *corner, int corners) {
  double area[3];
  cw_face_area((const double(*)[3])mesh->cells.points, corner, corners, area);
  return cw_norm(area);
}

static void summarise(const CwRegionMesh *mesh, CwRegionSummary *summary) {
  summary->points = mesh->cells.point_count;
  summary->own_points = mesh->cells.point_count - mesh->cells.shared_count;
  summary->tetrahedra = mesh->cells.tetrahedron_count;
  summary->pyramids = mesh->cells.pyramid_count;
  summary->prisms = mesh->cells.prism_count;
  summary->triangles = mesh->cells.triangle_count;
  summary->quads = mesh->cells.quad_count;
  summary->recovery = mesh->recovery;
  strcpy(summary->digest, mesh->digest);
  for (int32_t i = 0; i < mesh->cells.triangle_count; i++) {
    summary->patch_area[mesh->cells.triangle_patch[i]] += face_area(mesh, mesh->cells.triangles[i], 3);
  }
  for (int32_t i = 0; i < mesh->cells.quad_count; i++) {
    summary->patch_area[mesh->cells.quad_patch[i]] += face_area(mesh, mesh->cells.quads[i], 4);
  }
}

int32_t cw_region_copies(const CwDomain *domain, int32_t region) {
  const CwPeriodicImages *images = &domain->images;
  return cw_image_region(images, &domain->plan, region, 1) == region ? 1 : images->symmetry->count;
}

enum { PATH_SIZE = 4096 };

// Of a region its file and, NULL: not asked for, that of its boundary where it has failed.
static CwStatus region_paths(const CwMeshRun *run, int d, int32_t region, char path[PATH_SIZE],
                             char failure_path[PATH_SIZE]) {
  CwStatus status = CW_OK;
  const char *name = run->domain[d].name;
  int length = snprintf(path, PATH_SIZE, "%s/mesh/%s-%04d.h5", run->run_path, name, region + 1);
  if (failure_path)
    length = snprintf(failure_path, PATH_SIZE, "%s/mesh/failed-%s-%04d.vtk", run->run_path, name, region + 1);
  CW_REQUIRE(length < PATH_SIZE, CW_ERR_USAGE, "%s: the path is too long; allowed: about %d characters", run->run_path,
             PATH_SIZE - 2 * CW_NAME_SIZE);
done:
  return status;
}

// Takes up a region that an earlier run has left whole. A file that is damaged, or that fails the audit though it was
// written as it is, counts as none, and the summary says so.
static CwStatus take_up(const char *path, const char *fingerprint, CwRegionMesh *mesh, CwRegionSummary *summary,
                        int *taken) {
  CwStatus status = CW_OK;
  CwRegionFound found;
  CwOutcome outcome = {0};
  CW_TRY(cw_region_take_up(path, fingerprint, mesh, &found));
  if (found == CW_REGION_TAKEN) {
    status = cw_audit_region(mesh, &summary->quality, &outcome);
    if (status == CW_ERR_FAULT || outcome.kind != CW_OUTCOME_DONE) found = CW_REGION_DAMAGED;
    if (status != CW_ERR_FAULT) CW_TRY(status);
  }
  status = CW_OK;
  *taken = found == CW_REGION_TAKEN;
  if (found == CW_REGION_DAMAGED)
    snprintf(summary->damage, sizeof summary->damage, "%.*s", (int)sizeof summary->damage - 1,
             outcome.kind ? outcome.reason : cw_fail_message());
  if (!*taken) cw_region_free(mesh);
done:
  return status;
}

// Makes a periodic image of the region `source`, whose file at `source_path` is whole, or takes it up where an earlier
// run left it so.
static CwStatus make_copy(const CwMeshRun *run, CwMeshTask task, int32_t source, const char *source_path,
                          CwRegionSummary *summary) {
  CwStatus status = CW_OK;
  const CwDomain *domain = &run->domain[task.domain];
  const CwPeriodicImages *images = &domain->images;
  CwRegionMesh first = {0}, mesh = {0};
  CwOutcome outcome = {0};
  char path[PATH_SIZE], fingerprint[CW_HASH_TEXT];
  int32_t turns = 1;
  int taken;
  while (cw_image_region(images, &domain->plan, source, turns) != task.index) turns++;
  CW_TRY(cw_region_read(source_path, &first));
  CW_TRY(region_paths(run, task.domain, task.index, path, NULL));
  cw_region_copy_fingerprint(&domain->context, &first, turns, fingerprint);
  CW_TRY(take_up(path, fingerprint, &mesh, summary, &taken));
  if (!taken) {
    CW_TRY(cw_region_turn(&domain->context, turns, domain->number[task.index], fingerprint, &first));
    CW_TRY(cw_audit_copy(&first, &summary->quality.open_faces, &outcome));
    CW_REQUIRE(outcome.kind == CW_OUTCOME_DONE, CW_ERR_FAULT, "%s", outcome.reason); // the first has passed
    CW_TRY(cw_region_write(path, &first));
  }
  strcpy(summary->digest, taken ? mesh.digest : first.digest);
done:
  cw_region_free(&first);
  cw_region_free(&mesh);
  return status;
}

// Of its summary the digest and the open faces alone. NFS keeps what another host has made out of sight of one that has
// looked for it in vain, until that one opens the folder again.
static CwStatus step_copy(const CwMeshRun *run, CwMeshTask task, int32_t first, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CwRegionSummary *summary = NULL;
  char path[PATH_SIZE];
  snprintf(path, PATH_SIZE, "%s/mesh", run->run_path);
  DIR *folder = opendir(path);
  if (folder) closedir(folder);
  CW_NEW(summary, 1);
  CW_TRY(region_paths(run, task.domain, first, path, NULL));
  CW_TRY(make_copy(run, task, first, path, summary));
  *bytes = summary;
  *size = sizeof *summary;
  summary = NULL;
done:
  free(summary);
  return status;
}

// What the region's boundary allows the tetrahedra.
static CwStatus bound_angles(const CwDomain *domain, int32_t region, double *allowed) {
  CwStatus status = CW_OK;
  CwRegionBoundary inner = {0};
  int32_t worst;
  CW_TRY(cw_region_boundary_make(&domain->context.from, region, 0, &inner));
  CwFillInput input = cw_region_fill_input(&domain->context.from, &inner, domain->name);
  CW_TRY(cw_tet_bound(&input, allowed, &worst));
done:
  cw_region_boundary_free(&inner);
  return status;
}

CwStatus cw_step_region(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const CwDomain *domain = &run->domain[task.domain];
  CwRegionMesh mesh = {0};
  CwRegionSummary *summary = NULL;
  CwAtomicFile file = {0};
  CwOutcome outcome = {0};
  char path[PATH_SIZE], boundary_path[PATH_SIZE], fingerprint[CW_HASH_TEXT];
  int taken;
  int32_t first = cw_image_region_first(&domain->images, &domain->plan, task.index);
  if (first != task.index) return step_copy(run, task, first, bytes, size);
  CW_TRY(region_paths(run, task.domain, task.index, path, boundary_path));
  CW_NEW(summary, 1);
  cw_region_fingerprint(&domain->context, task.index, fingerprint);
  CW_TRY(take_up(path, fingerprint, &mesh, summary, &taken));
  if (!taken) CW_TRY(cw_region_build(&domain->context, task.index, domain->number[task.index], &mesh, &outcome));
  if (!taken && outcome.kind == CW_OUTCOME_DONE) { // on its way to the disk while it is looked at
    CW_TRY(cw_region_write_begin(path, &mesh, &file));
    CW_TRY(cw_audit_region(&mesh, &summary->quality, &outcome));
  }
  if (outcome.kind != CW_OUTCOME_DONE) {
    CW_TRY(cw_region_failure_examine(&domain->context.from, task.index, &outcome, boundary_path, &summary->failure));
    remove(path); // of an earlier attempt: it must not be copied
  } else {
    remove(boundary_path); // of an earlier attempt
    summarise(&mesh, summary);
    CW_TRY(bound_angles(domain, task.index, &summary->dihedral_allowed));
    cw_domain_coverage(domain, task.index, summary->coverage);
    CW_TRY(cw_layer_ratio(&mesh, domain->layer_count, CW_PATCHES_MOST, summary->ratio));
    if (!taken) CW_TRY(cw_atomic_file_commit(&file));
  }
  *bytes = summary;
  *size = sizeof *summary;
  summary = NULL;
done:
  cw_atomic_file_abandon(&file);
  cw_region_free(&mesh);
  free(summary);
  return status;
}
