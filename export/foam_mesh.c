// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export/foam_boundary.h"
#include "export/foam_files.h"

static CwStatus put_text(const CwFoamFiles *files, CwFoamFile f, const char *text, int64_t at) {
  return cw_place_file_put(&files->file[f], text, (int64_t)strlen(text), at);
}

// `cellZones`: the cells of each domain are one run of numbers.
static CwStatus put_zones(const CwFoamFiles *files) {
  CwStatus status = CW_OK;
  const CwFoamMesh *mesh = files->mesh;
  const CwPart *of = &mesh->division.parts[files->part];
  int64_t run[4096], at = mesh->parts[files->part].start[CW_FOAM_ZONES], cell = 0;
  char text[CW_FOAM_HEADER_SIZE];
  for (int d = 0; d < mesh->assembly->mesh->domain_count; ++d) {
    at += snprintf(text, sizeof text, "%s\n{\n    type            cellZone;\n    cellLabels      List<label>\n%lld\n(",
                   mesh->assembly->mesh->domains[d].name, (long long)of->domain_cells[d]);
    CW_TRY(put_text(files, CW_FOAM_ZONES, text, at - (int64_t)strlen(text)));
    for (int64_t left = of->domain_cells[d], now; left > 0; left -= now) {
      now = left < 4096 ? left : 4096;
      for (int64_t i = 0; i < now; ++i) run[i] = cell++;
      CW_TRY(cw_place_file_put_labels(&files->file[CW_FOAM_ZONES], run, now, mesh->label_size, at));
      at += mesh->label_size * now;
    }
    CW_TRY(put_text(files, CW_FOAM_ZONES, ");\n}\n", at));
    at += 5;
  }
  CW_TRY(put_text(files, CW_FOAM_ZONES, ")\n", at));
done:
  return status;
}

// The shared points of a part, with their numbers in the whole mesh.
static CwStatus put_shared(const CwFoamFiles *files) {
  CwStatus status = CW_OK;
  const CwFoamMesh *mesh = files->mesh;
  const CwAssembly *a = mesh->assembly;
  const CwDivision *v = &mesh->division;
  double(*points)[3] = NULL;
  int64_t *numbers = NULL;
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    const int64_t *first = v->shared ? &v->first_shared[(int64_t)files->part * a->mesh->domain_count + d] : NULL;
    const int64_t count = first ? first[1] - first[0] : a->mesh->domains[d].shared_points;
    CW_NEW(points, count);
    CW_NEW(numbers, count);
    for (int64_t i = 0; i < count; ++i) {
      const int64_t id = first ? v->shared[first[0] + i] : i;
      memcpy(points[i], a->shared[d][id], sizeof *points);
      numbers[i] = a->totals[d].first_point + id;
    }
    CW_TRY(cw_foam_put_points(files, (const double(*)[3])points, numbers, count, v->parts[files->part].first_point[d]));
    free(points);
    free(numbers);
    points = NULL;
    numbers = NULL;
  }
done:
  free(points);
  free(numbers);
  return status;
}

static CwStatus create_part(const CwFoamMesh *mesh, int part) {
  CwStatus status = CW_OK;
  const CwFoamPart *of = &mesh->parts[part];
  CwFoamFiles files = {0};
  char text[CW_FOAM_HEADER_SIZE], *folder = NULL;
  const int64_t corners = cw_corner_count(of->all), faces = cw_face_count(of->all);
  CW_TRY(cw_foam_files_open(mesh, part, 1, &files));
  for (int f = 0; f < (cw_foam_is_divided(mesh) ? CW_FOAM_FILES : CW_FOAM_WHOLE_FILES); ++f) {
    cw_foam_header(mesh, part, (CwFoamFile)f, text);
    CW_TRY(put_text(&files, (CwFoamFile)f, text, 0));
    const int64_t size = f == CW_FOAM_POINTS ? CW_FOAM_POINT_SIZE : mesh->label_size;
    if (f != CW_FOAM_ZONES && f != CW_FOAM_FACES)
      CW_TRY(
          put_text(&files, (CwFoamFile)f, ")\n", of->start[f] + size * cw_foam_value_count(mesh, part, (CwFoamFile)f)));
  }
  CW_TRY(cw_foam_put_labels(&files, CW_FOAM_FACES, &corners, 1, faces));
  snprintf(text, sizeof text, ")\n\n%lld\n(", (long long)corners);
  CW_TRY(put_text(&files, CW_FOAM_FACES, text, of->label_start - (int64_t)strlen(text)));
  CW_TRY(put_text(&files, CW_FOAM_FACES, ")\n", of->label_start + mesh->label_size * corners));
  CW_TRY(put_zones(&files));
  CW_TRY(put_shared(&files));
  CW_TRY(cw_foam_part_folder(mesh, part, &folder));
  CW_TRY(cw_foam_boundary_write(mesh, part, folder));
done:
  free(folder);
  return cw_foam_files_close(&files, status);
}

CwStatus cw_foam_mesh_create(CwFoamMesh *mesh, const CwRanks *ranks) {
  CwStatus status = cw_division_count(&mesh->division, ranks);
  if (status == CW_OK) status = cw_foam_layout_parts(mesh);
  for (int p = ranks->rank; p < mesh->division.part_count && status == CW_OK; p += ranks->size)
    status = create_part(mesh, p);
  return cw_ranks_agree(ranks, status);
}
