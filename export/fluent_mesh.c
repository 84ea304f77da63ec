// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/fluent_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export/patch_role.h"

// Bytes of a point, of the type of a cell, and of a face: "3 node node node cell cell", eight digits each.
enum { POINT_SIZE = 72, TYPE_SIZE = 2, TRIANGLE_SIZE = 47, QUAD_SIZE = 56, TEXT_SIZE = 200 };
enum { POINTS_AT_ONCE = 1 << 16 };

// Codes of the format: types of cells, and of zones of faces.
enum { TETRAHEDRON = 2, PYRAMID = 5, WEDGE = 6, INTERIOR = 2, FACES_MIXED = 0, CELLS_FLUID = 1, CELLS_MIXED = 0 };
static const struct {
  int code;
  const char *name;
} zone_types[CW_PATCH_KINDS] = {[CW_PATCH_WALL] = {3, "wall"},
                                [CW_PATCH_INLET] = {4, "pressure-inlet"},
                                [CW_PATCH_OUTLET] = {5, "pressure-outlet"},
                                [CW_PATCH_SYMMETRY] = {7, "symmetry"},
                                [CW_PATCH_INTERFACE] = {24, "interface"}};

// Numbers of the zones: points 1, then the cells and the inner faces of the domains, then the patches.
static int zone_of_cells(int domain) {
  return 2 + domain;
}
static int zone_of_faces(const CwMesh *mesh, int domain) {
  return 2 + mesh->domain_count + domain;
}
static int zone_of_patch(const CwMesh *mesh, int patch) {
  return 2 + 2 * mesh->domain_count + patch;
}

static int64_t face_bytes(CwFaceCount count) {
  return TRIANGLE_SIZE * count.triangles + QUAD_SIZE * count.quads;
}

static CwFaceCount less(CwFaceCount a, CwFaceCount b) {
  return (CwFaceCount){a.triangles - b.triangles, a.quads - b.quads};
}

// The faces before the inner ones of a domain; before those of the patches for the one behind the last.
static CwFaceCount before_domain(const CwFluentMesh *mesh, int domain) {
  const CwMesh *input = mesh->assembly->mesh;
  return domain < input->domain_count ? mesh->layout.region[input->domains[domain].first_region] : mesh->layout.inner;
}

static CwFaceCount inner_faces(const CwFluentMesh *mesh, int domain) {
  return less(before_domain(mesh, domain + 1), before_domain(mesh, domain));
}

static int head_text(const CwFluentMesh *mesh, char text[TEXT_SIZE]) {
  return snprintf(text, TEXT_SIZE,
                  "(0 \"pump: metres, rotation about +z\")\n(2 3)\n(10 (0 1 %llx 0 3))\n(12 (0 1 %llx 0 0))\n"
                  "(13 (0 1 %llx 0 0))\n(10 (1 1 %llx 1 3)(\n",
                  (unsigned long long)mesh->layout.points, (unsigned long long)mesh->layout.cells,
                  (unsigned long long)cw_face_count(mesh->layout.all), (unsigned long long)mesh->layout.points);
}

// The line before the values of a section: its kind (12 cells, 13 faces), zone, numbers from and to, and two codes.
static int section_text(int kind, int zone, int64_t before, int64_t count, int code, int shape, char text[TEXT_SIZE]) {
  return snprintf(text, TEXT_SIZE, "(%d (%x %llx %llx %x %x)(\n", kind, (unsigned)zone,
                  (unsigned long long)(before + 1), (unsigned long long)(before + count), (unsigned)code,
                  (unsigned)shape);
}

static const char section_end[] = "))\n";
enum { END_SIZE = sizeof section_end - 1 };

// Cells of the domains before.
static int64_t cells_before(const CwAssembly *a, int domain) {
  return a->places[a->mesh->domains[domain].first_region].cell;
}

static int cells_text(const CwFluentMesh *mesh, int domain, char text[TEXT_SIZE]) {
  return section_text(12, zone_of_cells(domain), cells_before(mesh->assembly, domain),
                      mesh->assembly->totals[domain].cells, CELLS_FLUID, CELLS_MIXED, text);
}

static int faces_text(const CwFluentMesh *mesh, int domain, char text[TEXT_SIZE]) {
  return section_text(13, zone_of_faces(mesh->assembly->mesh, domain), cw_face_count(before_domain(mesh, domain)),
                      cw_face_count(inner_faces(mesh, domain)), INTERIOR, FACES_MIXED, text);
}

static int patch_text(const CwFluentMesh *mesh, int patch, char text[TEXT_SIZE]) {
  return section_text(13, zone_of_patch(mesh->assembly->mesh, patch), cw_face_count(mesh->layout.patch[patch]),
                      cw_face_count(mesh->assembly->patches[patch].faces),
                      zone_types[mesh->assembly->mesh->patches[patch].kind].code, FACES_MIXED, text);
}

CwStatus cw_fluent_mesh_plan(const CwAssembly *a, CwFluentMesh *mesh) {
  CwStatus status = CW_OK;
  char text[TEXT_SIZE];
  mesh->assembly = a;
  CW_TRY(cw_face_layout_make(a, &mesh->layout));
  CW_NEW(mesh->patch_start, a->mesh->patch_count);
  CW_REQUIRE(cw_face_count(mesh->layout.all) <= INT32_MAX && mesh->layout.points <= INT32_MAX, CW_ERR_EXPORT,
             "%lld faces and %lld points; Fluent's mesh file allows %d of each, which fewer mesh.cells keep to",
             (long long)cw_face_count(mesh->layout.all), (long long)mesh->layout.points, INT32_MAX);
  int64_t at = mesh->point_start = head_text(mesh, text);
  at += POINT_SIZE * mesh->layout.points + END_SIZE;
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    mesh->cell_start[d] = at + cells_text(mesh, d, text);
    at = mesh->cell_start[d] + TYPE_SIZE * a->totals[d].cells + END_SIZE;
  }
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    mesh->face_start[d] = at + faces_text(mesh, d, text);
    at = mesh->face_start[d] + face_bytes(inner_faces(mesh, d)) + END_SIZE;
  }
  for (int p = 0; p < a->mesh->patch_count; ++p) {
    mesh->patch_start[p] = at;
    if (!cw_patch_is_there(a, p)) continue;
    mesh->patch_start[p] = at + patch_text(mesh, p, text);
    at = mesh->patch_start[p] + face_bytes(a->patches[p].faces) + END_SIZE;
  }
  mesh->end = at;
done:
  return status;
}

static CwStatus put_points(const CwFluentMesh *mesh, const double (*points)[3], int64_t count, int64_t first) {
  CwStatus status = CW_OK;
  char *text = NULL;
  CW_NEW_UNSET(text, POINT_SIZE * POINTS_AT_ONCE + 1);
  for (int64_t put = 0, now; put < count; put += now) {
    now = count - put < POINTS_AT_ONCE ? count - put : POINTS_AT_ONCE;
    for (int64_t i = 0; i < now; ++i) {
      const double *x = points[put + i];
      snprintf(text + POINT_SIZE * i, POINT_SIZE + 1, "%23.16e %23.16e %23.16e\n", x[0], x[1], x[2]);
    }
    CW_TRY(cw_place_file_put(&mesh->file, text, POINT_SIZE * now, mesh->point_start + POINT_SIZE * (first + put)));
  }
done:
  free(text);
  return status;
}

// The line before the values of a section and what ends them.
static CwStatus put_section(const CwFluentMesh *mesh, const char *text, int length, int64_t start, int64_t bytes) {
  CwStatus status = CW_OK;
  CW_TRY(cw_place_file_put(&mesh->file, text, length, start - length));
  CW_TRY(cw_place_file_put(&mesh->file, section_end, END_SIZE, start + bytes));
done:
  return status;
}

// What stands around the values of each section, and at the end the names of the zones.
static CwStatus put_frame(const CwFluentMesh *mesh) {
  CwStatus status = CW_OK;
  const CwAssembly *a = mesh->assembly;
  char text[TEXT_SIZE];
  int64_t end = mesh->end;
  int length;
  CW_TRY(put_section(mesh, text, head_text(mesh, text), mesh->point_start, POINT_SIZE * mesh->layout.points));
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    CW_TRY(put_section(mesh, text, cells_text(mesh, d, text), mesh->cell_start[d], TYPE_SIZE * a->totals[d].cells));
    CW_TRY(put_section(mesh, text, faces_text(mesh, d, text), mesh->face_start[d], face_bytes(inner_faces(mesh, d))));
  }
  for (int p = 0; p < a->mesh->patch_count; ++p)
    if (cw_patch_is_there(a, p))
      CW_TRY(put_section(mesh, text, patch_text(mesh, p, text), mesh->patch_start[p], face_bytes(a->patches[p].faces)));
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    length = snprintf(text, sizeof text, "(45 (%d fluid %s)())\n(45 (%d interior %s_inside)())\n", zone_of_cells(d),
                      a->mesh->domains[d].name, zone_of_faces(a->mesh, d), a->mesh->domains[d].name);
    CW_TRY(cw_place_file_put(&mesh->file, text, length, end));
    end += length;
  }
  for (int p = 0; p < a->mesh->patch_count; ++p) {
    if (!cw_patch_is_there(a, p)) continue;
    length = snprintf(text, sizeof text, "(45 (%d %s %s)())\n", zone_of_patch(a->mesh, p),
                      zone_types[a->mesh->patches[p].kind].name, a->mesh->patches[p].name);
    CW_TRY(cw_place_file_put(&mesh->file, text, length, end));
    end += length;
  }
done:
  return status;
}

CwStatus cw_fluent_mesh_create(const char *folder, CwFluentMesh *mesh) {
  CwStatus status = CW_OK;
  const CwAssembly *a = mesh->assembly;
  CW_TRY(cw_place_file_open(folder, "pump.msh", 1, &mesh->file));
  CW_TRY(put_frame(mesh));
  for (int d = 0; d < a->mesh->domain_count; ++d)
    CW_TRY(put_points(mesh, (const double(*)[3])a->shared[d], a->mesh->domains[d].shared_points,
                      a->totals[d].first_point));
done:
  return status;
}

CwStatus cw_fluent_mesh_open(const char *folder, CwFluentMesh *mesh) {
  return mesh->file.descriptor ? CW_OK : cw_place_file_open(folder, "pump.msh", 0, &mesh->file);
}

CwStatus cw_fluent_mesh_close(CwFluentMesh *mesh) {
  CwStatus status = cw_place_file_close(&mesh->file);
  cw_face_layout_free(&mesh->layout);
  free(mesh->patch_start);
  memset(mesh, 0, sizeof *mesh);
  return status;
}

static CwStatus put_cells(const CwFluentMesh *mesh, int region, const CwRegionData *data) {
  CwStatus status = CW_OK;
  const int32_t count = cw_region_cell_count(data);
  const int64_t before = mesh->assembly->places[region].cell - cells_before(mesh->assembly, data->domain); // in it
  char *text = NULL;
  CW_NEW_UNSET(text, TYPE_SIZE * (int64_t)count);
  for (int32_t i = 0; i < count; ++i) {
    const int type = i < data->tetrahedron_count                         ? TETRAHEDRON
                     : i < data->tetrahedron_count + data->pyramid_count ? PYRAMID
                                                                         : WEDGE;
    text[TYPE_SIZE * i] = (char)('0' + type);
    text[TYPE_SIZE * i + 1] = '\n';
  }
  CW_TRY(cw_place_file_put(&mesh->file, text, TYPE_SIZE * (int64_t)count,
                           mesh->cell_start[data->domain] + TYPE_SIZE * before));
done:
  free(text);
  return status;
}

static char *put_hex(char *at, int64_t number) {
  static const char digits[] = "0123456789abcdef";
  *at++ = ' ';
  for (int shift = 28; shift >= 0; shift -= 4) *at++ = digits[number >> shift & 15];
  return at;
}

// The right-hand rule over the nodes points to the first cell. Of an inner face that is the one of the larger number,
// as the nodes are those of the other; the nodes of a face on a patch are turned over.
static CwStatus put_faces(const CwFluentMesh *mesh, int region, const CwRegionData *data, const CwFaceStretch *s,
                          int64_t *at) {
  CwStatus status = CW_OK;
  const CwAssembly *a = mesh->assembly;
  const int64_t points_before = a->totals[data->domain].first_point;
  const int32_t *corner = s->corner;
  char *text = NULL, *to;
  CW_NEW_UNSET(text, s->faces * face_bytes((CwFaceCount){.quads = 1}));
  to = text;
  for (int64_t f = 0; f < s->faces; ++f) {
    const int sides = s->sides[f], inner = s->across[f] >= 0;
    const int64_t own = a->places[region].cell + s->cell[f] + 1;
    *to++ = (char)('0' + sides);
    for (int i = 0; i < sides; ++i)
      to = put_hex(to, points_before + cw_point_number(a, region, data, corner[inner ? i : sides - 1 - i]) + 1);
    to = put_hex(to, inner ? s->across[f] + 1 : own);
    to = put_hex(to, inner ? own : 0);
    *to++ = '\n';
    corner += sides;
  }
  CW_TRY(cw_place_file_put(&mesh->file, text, to - text, *at));
  *at += to - text;
done:
  free(text);
  return status;
}

CwStatus cw_fluent_mesh_write_region(const CwFluentMesh *mesh, int region, const CwRegionData *data,
                                     const CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  const CwAssembly *a = mesh->assembly;
  const CwMeshDomain *domain = &a->mesh->domains[data->domain];
  CwFaceStretch s = {0};
  CW_TRY(put_points(mesh, (const double(*)[3])data->points + data->shared_count, data->point_count - data->shared_count,
                    a->totals[data->domain].first_point + a->places[region].own_point));
  CW_TRY(put_cells(mesh, region, data));
  CW_TRY(cw_face_stretch_new(CW_FACES_AT_ONCE, &s));
  int64_t at =
      mesh->face_start[data->domain] + face_bytes(less(mesh->layout.region[region], before_domain(mesh, data->domain)));
  while (cw_face_stretch_inner(a, region, data, faces, &s)) CW_TRY(put_faces(mesh, region, data, &s, &at));
  for (int p = domain->first_patch; p < domain->first_patch + domain->patch_count; ++p) {
    at = mesh->patch_start[p] +
         face_bytes(less(cw_face_layout_patch(&mesh->layout, a, region, p), mesh->layout.patch[p]));
    cw_face_stretch_start(&s);
    while (cw_face_stretch_patch(a, p, data, faces, &s)) CW_TRY(put_faces(mesh, region, data, &s, &at));
  }
done:
  cw_face_stretch_free(&s);
  return status;
}
