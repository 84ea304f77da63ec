// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/cgns_sections.h"

#include <stdio.h>
#include <stdlib.h>

int64_t cw_cgns_patch_first(const CwAssembly *a, int patch) {
  int domain = a->mesh->patches[patch].domain;
  int64_t first = a->totals[domain].cells + 1;
  for (int p = a->mesh->domains[domain].first_patch; p < patch; ++p) first += cw_face_count(a->patches[p].faces);
  return first;
}

static void add(CwSection *sections, int *count, const char *prefix, const char *name, int type, int nodes, int patch,
                int64_t *next, int64_t elements) {
  if (elements == 0) return;
  CwSection *section = &sections[(*count)++];
  snprintf(section->name, sizeof section->name, "%.22s%.10s", prefix, name);
  section->type = type;
  section->nodes = nodes;
  section->patch = patch;
  section->first = *next;
  section->count = elements;
  *next += elements;
}

CwStatus cw_cgns_sections(const CwAssembly *a, int domain, CwSection **sections, int *count) {
  CwStatus status = CW_OK;
  const CwDomainTotal *total = &a->totals[domain];
  const CwMeshDomain *d = &a->mesh->domains[domain];
  int64_t next = 1;
  *count = 0;
  CW_NEW(*sections, 3 + 2 * d->patch_count);
  add(*sections, count, "", "tetrahedra", CW_CGNS_TETRA_4, 4, -1, &next, total->tetrahedra);
  add(*sections, count, "", "pyramids", CW_CGNS_PYRA_5, 5, -1, &next, total->pyramids);
  add(*sections, count, "", "prisms", CW_CGNS_PENTA_6, 6, -1, &next, total->prisms);
  for (int p = d->first_patch; p < d->first_patch + d->patch_count; ++p) {
    const char *name = a->mesh->patches[p].name;
    add(*sections, count, name, "_triangles", CW_CGNS_TRI_3, 3, p, &next, a->patches[p].faces.triangles);
    add(*sections, count, name, "_quads", CW_CGNS_QUAD_4, 4, p, &next, a->patches[p].faces.quads);
  }
done:
  return status;
}
