// SPDX-License-Identifier: AGPL-3.0-or-later
#include "chew_domain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chew_fill.h"
#include "mesher/fill/fill_with_fallback.h"
#include "mesher/region/audit.h"
#include "mesher/region/interface_rule.h"
#include "pipeline/log.h"

static int owned(const CwChewOwners *owners, int32_t region) {
  return owners->owner[region] == owners->rank;
}

// This rank's regions and their interfaces.
typedef struct {
  const CwRegionInput *from;
  const CwChewOwners *owners;
  int32_t interface_count;
  CwChewInterface *interface; // region[] -1: of other ranks
  CwChewRegion *region;
} Domain;

static CwStatus open_domain(Domain *domain) {
  CwStatus status = CW_OK;
  const CwInterfaces *interfaces = domain->from->interfaces;
  CW_NEW(domain->interface, interfaces->outline_count);
  CW_NEW(domain->region, domain->owners->region_count);
  domain->interface_count = interfaces->outline_count;
  for (int32_t i = 0; i < domain->interface_count; i++) {
    const int32_t *regions = interfaces->planned.region[interfaces->outline[i].triangle_start];
    domain->interface[i].region[0] = domain->interface[i].region[1] = -1;
    if (owned(domain->owners, regions[0]) || owned(domain->owners, regions[1]))
      CW_TRY(cw_chew_interface_make(domain->from, i, &domain->interface[i]));
  }
done:
  return status;
}

static void close_domain(Domain *domain) {
  for (int32_t i = 0; i < domain->interface_count; i++) cw_chew_interface_free(&domain->interface[i]);
  for (int32_t r = 0; domain->region && r < domain->owners->region_count; r++) cw_chew_region_close(&domain->region[r]);
  free(domain->interface);
  free(domain->region);
}

// Splits the interfaces that are asked for, and brings the new points into this rank's regions.
static CwStatus split_interfaces(Domain *domain, int32_t count, const CwChewAsked *asked, int64_t *inserted) {
  CwStatus status = CW_OK;
  for (int32_t k = 0, end; k < count; k = end) {
    CwChewInterface *interface = &domain->interface[asked[k].interface];
    int32_t first = interface->point_count, added;
    for (end = k + 1; end < count && asked[end].interface == asked[k].interface;) end++;
    CW_TRY(cw_chew_interface_split(domain->from, end - k, asked + k, interface, &added));
    if (owned(domain->owners, interface->region[0])) *inserted += added; // once over all ranks
    for (int side = 0; side < 2; side++) {
      int32_t r = interface->region[side];
      if (owned(domain->owners, r))
        CW_TRY(cw_chew_region_add(&domain->region[r], interface, asked[k].interface, first));
    }
  }
done:
  return status;
}

// Rounds: all regions refine, tell what encroaches, and split, until nothing does.
static CwStatus refine(Domain *domain, const CwChewBounds *bounds, CwChewFigures *figures) {
  CwStatus status = CW_OK;
  CwChewAsked *asked = NULL;
  for (long long any = 1; any;) {
    int32_t count;
    double start = cw_processor_seconds();
    for (int32_t r = 0; r < domain->owners->region_count; r++) {
      if (!owned(domain->owners, r)) continue;
      if (figures->rounds == 0) CW_TRY(cw_chew_region_open(domain->from, r, &domain->region[r]));
      CW_TRY(
          cw_chew_region_refine(domain->from, bounds, domain->interface_count, domain->interface, &domain->region[r]));
    }
    figures->refine_seconds += cw_processor_seconds() - start;
    free(asked);
    asked = NULL;
    CW_TRY(cw_chew_exchange(domain->owners, domain->interface, domain->region, &figures->traffic, &count, &asked));
    start = cw_processor_seconds();
    CW_TRY(split_interfaces(domain, count, asked, &figures->inserted));
    figures->interface_seconds += cw_processor_seconds() - start;
    figures->rounds++;
    any = count;
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_LONG_LONG, MPI_MAX, domain->owners->ranks);
  }
  for (int32_t i = 0; i < domain->interface_count; i++) {
    for (int32_t t = 0;
         owned(domain->owners, domain->interface[i].region[0]) && t < domain->interface[i].triangle_count; t++)
      figures->refused += domain->interface[i].final[t];
  }
done:
  free(asked);
  return status;
}

// Fills a region, audits it and writes its file. Of these only the fill counts.
static CwStatus finish(Domain *domain, int32_t r, const char *name, const char *path, CwChewFigures *figures,
                       uint64_t *open_faces) {
  CwStatus status = CW_OK;
  CwChewSurface surface = {0};
  CwFill fill = {0};
  CwRegionMesh mesh = {0};
  CwQuality quality;
  CwOutcome outcome = {0};
  char text[4200];
  double start = cw_processor_seconds();
  snprintf(text, sizeof text, "%s region %d", name, r + 1);
  CW_TRY(cw_chew_surface_make(domain->from, domain->interface_count, domain->interface, &domain->region[r], &surface));
  CW_TRY(cw_chew_fill(domain->from, &surface, text, &domain->region[r].mesh, &fill));
  figures->fill_seconds += cw_processor_seconds() - start;
  figures->tetrahedra += fill.tetrahedron_count;
  cw_chew_region_close(&domain->region[r]);
  double wall = MPI_Wtime();
  CW_TRY(cw_chew_region_mesh(name, r, &surface, &fill, &mesh));
  CW_TRY(cw_audit_region(&mesh, &quality, &outcome));
  CW_REQUIRE(outcome.kind == CW_OUTCOME_DONE, CW_ERR_FAULT, "%s", outcome.reason);
  *open_faces += quality.open_faces;
  snprintf(text, sizeof text, "%s/%s-%04d.h5", path, name, r + 1);
  CW_TRY(cw_region_write(text, &mesh));
  figures->wall_seconds -= MPI_Wtime() - wall;
done:
  cw_chew_surface_free(&surface);
  cw_fill_free(&fill);
  cw_region_free(&mesh);
  return status;
}

CwStatus cw_chew_domain(const CwRegionInput *from, const CwChewOwners *owners, const CwChewBounds *bounds,
                        const char *name, const char *path, CwChewFigures *figures) {
  CwStatus status = CW_OK;
  Domain domain = {.from = from, .owners = owners};
  uint64_t open_faces = 0;
  *figures = (CwChewFigures){0};
  MPI_Barrier(owners->ranks);
  double start = MPI_Wtime(), before = cw_processor_seconds();
  CW_TRY(open_domain(&domain));
  figures->interface_seconds += cw_processor_seconds() - before;
  CW_TRY(refine(&domain, bounds, figures));
  for (int32_t r = 0; r < owners->region_count; r++) {
    if (owned(owners, r)) CW_TRY(finish(&domain, r, name, path, figures, &open_faces));
  }
  figures->wall_seconds += MPI_Wtime() - start;
  MPI_Allreduce(MPI_IN_PLACE, &open_faces, 1, MPI_UINT64_T, MPI_SUM, owners->ranks);
  CW_REQUIRE(open_faces == 0, CW_ERR_MESH, "%s: the regions do not fit together on the partition planes", name);
done:
  close_domain(&domain);
  return status;
}

// The interfaces that a region's rule gives, to each of the regions beside it.
static CwStatus count_rule(const CwRegionInput *from, const CwChewOwners *owners, int32_t r, const char *bytes,
                           CwChewFigures *figures) {
  CwStatus status = CW_OK;
  enum { OUTLINE, INSERTED, TRIANGLES, ENCROACHED, LEFT, HEADER }; // as interface_rule.c packs them
  int64_t *size = NULL;
  int32_t count, header[HEADER];
  CW_NEW(size, owners->region_count);
  memcpy(&count, bytes, sizeof count);
  bytes += sizeof count;
  for (int32_t k = 0; k < count; k++) {
    memcpy(header, bytes, sizeof header);
    int64_t length = (int64_t)sizeof header + header[INSERTED] * (int64_t)sizeof(double[3]) +
                     header[TRIANGLES] * (int64_t)sizeof(int32_t[3]);
    const int32_t *regions =
        from->interfaces->refined.region[from->interfaces->outline[header[OUTLINE]].triangle_start];
    size[regions[0] == r ? regions[1] : regions[0]] += length;
    figures->inserted += header[INSERTED];
    figures->refused += header[LEFT];
    bytes += length;
  }
  for (int32_t to = 0; to < owners->region_count; to++) {
    if (size[to] == 0) continue;
    figures->traffic.messages++;
    figures->traffic.bytes += size[to];
    if (owned(owners, to)) continue;
    figures->traffic.sent_messages++;
    figures->traffic.sent_bytes += size[to];
  }
done:
  free(size);
  return status;
}

static CwStatus fill_by_rule(const CwRegionInput *from, int32_t r, CwChewFigures *figures) {
  CwStatus status = CW_OK;
  CwRegionBoundary inner = {0};
  CwFill fill = {0};
  double(*x)[3] = NULL;
  CwLatticeSite *site = NULL;
  char name[64];
  snprintf(name, sizeof name, "region %d", r + 1);
  double start = cw_processor_seconds();
  CW_TRY(cw_region_boundary_make(from, r, 0, &inner));
  CwFillInput input = cw_region_fill_input(from, &inner, name);
  CW_TRY(cw_interface_rule_points(from, r, name, &input.inner_count, &x, &site));
  figures->refine_seconds += cw_processor_seconds() - start;
  input.inner = (const double(*)[3])x;
  input.inner_site = site;
  start = cw_processor_seconds();
  CW_TRY(cw_fill_with_fallback(&input, CW_FILL_KERNEL, &fill));
  figures->fill_seconds += cw_processor_seconds() - start;
  figures->tetrahedra += fill.tetrahedron_count;
done:
  cw_region_boundary_free(&inner);
  cw_fill_free(&fill);
  free(x);
  free(site);
  return status;
}

CwStatus cw_rule_domain(const CwRegionInput *from, const CwChewOwners *owners, const int32_t *number,
                        CwChewFigures *figures) {
  CwStatus status = CW_OK;
  CwInterfaces planned = *from->interfaces; // as the rule finds them
  CwRegionInput before = *from;
  void *bytes = NULL;
  planned.refined = planned.planned;
  planned.planned = (CwInterfaceTriangles){0};
  before.interfaces = &planned;
  *figures = (CwChewFigures){.rounds = 1};
  MPI_Barrier(owners->ranks);
  double start = MPI_Wtime();
  for (int32_t r = 0; r < owners->region_count; r++) {
    int64_t size;
    int refines = 0;
    for (int32_t i = 0; i < planned.outline_count; i++) refines |= cw_interface_refiner(&before, number, i) == r;
    if (!refines || !owned(owners, r)) continue;
    double began = cw_processor_seconds();
    CW_TRY(cw_interface_rule(&before, number, r, "region", &bytes, &size));
    figures->interface_seconds += cw_processor_seconds() - began;
    CW_TRY(count_rule(&before, owners, r, bytes, figures));
    free(bytes);
    bytes = NULL;
  }
  MPI_Barrier(owners->ranks); // each takes what the others have split
  for (int32_t r = 0; r < owners->region_count; r++) {
    if (owned(owners, r)) CW_TRY(fill_by_rule(from, r, figures));
  }
  figures->wall_seconds = MPI_Wtime() - start;
done:
  free(bytes);
  return status;
}

void cw_chew_sum(const CwChewOwners *owners, CwChewFigures *figures) {
  double seconds[3] = {figures->interface_seconds, figures->refine_seconds, figures->fill_seconds};
  int64_t count[7] = {figures->traffic.messages,   figures->traffic.bytes, figures->traffic.sent_messages,
                      figures->traffic.sent_bytes, figures->inserted,      figures->refused,
                      figures->tetrahedra};
  MPI_Allreduce(MPI_IN_PLACE, seconds, 3, MPI_DOUBLE, MPI_SUM, owners->ranks);
  MPI_Allreduce(MPI_IN_PLACE, count, 7, MPI_INT64_T, MPI_SUM, owners->ranks);
  MPI_Allreduce(MPI_IN_PLACE, &figures->wall_seconds, 1, MPI_DOUBLE, MPI_MAX, owners->ranks);
  *figures = (CwChewFigures){.interface_seconds = seconds[0],
                             .refine_seconds = seconds[1],
                             .fill_seconds = seconds[2],
                             .wall_seconds = figures->wall_seconds,
                             .traffic = {count[0], count[1], count[2], count[3]},
                             .rounds = figures->rounds,
                             .inserted = count[4],
                             .refused = count[5],
                             .tetrahedra = count[6]};
}
