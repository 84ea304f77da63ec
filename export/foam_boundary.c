// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_boundary.h"

#include <stdio.h>
#include <stdlib.h>

#include "export/foam_zones.h"
#include "export/folder.h"
#include "export/patch_role.h"
#include "export/template.h"

static const char head[] = "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       %s;\n"
                           "    location    \"constant/polyMesh\";\n    object      %s;\n}\n\n%d\n(\n";

static void put_patch(FILE *out, const CwFoamMesh *mesh, int part, int p) {
  const CwMesh *input = mesh->assembly->mesh;
  const CwModelPatch *patch = &input->patches[p];
  int side = 0, between = cw_interface_of(input->interfaces, input->interface_count, p, &side);
  fprintf(out, "    %s\n    {\n", patch->name);
  if (patch->kind == CW_PATCH_INTERFACE)
    fprintf(out,
            "        type            cyclicAMI;\n        inGroups        1(cyclicAMI);\n"
            "        matchTolerance  0.0001;\n        transform       noOrdering;\n"
            "        neighbourPatch  %s;\n        lowWeightCorrection 0.2;\n%s",
            input->patches[input->interfaces[between].patch[1 - side]].name,
            mesh->release == CW_FOAM_V1912 ? "" : "        AMIMethod       faceAreaWeightAMI;\n");
  else if (patch->kind == CW_PATCH_WALL)
    fprintf(out, "        type            wall;\n        inGroups        1(wall);\n");
  else if (patch->kind == CW_PATCH_SYMMETRY)
    fprintf(out, "        type            symmetry;\n        inGroups        1(symmetry);\n");
  else
    fprintf(out, "        type            patch;\n");
  fprintf(out, "        nFaces          %lld;\n        startFace       %lld;\n    }\n",
          (long long)cw_face_count(mesh->division.parts[part].patch[p]),
          (long long)cw_face_count(mesh->parts[part].patch[p]));
}

// The patches to other parts, each of the links of all regions; gives their number, and writes nothing where `out` is
// NULL.
static int put_processors(FILE *out, const CwFoamMesh *mesh, int part) {
  const CwPart *of = &mesh->division.parts[part];
  const CwLink *links = of->link_count ? &mesh->division.links[of->first_link] : NULL;
  int patches = 0;
  for (int i = 0, end; i < of->link_count; i = end, ++patches) {
    int64_t faces = 0;
    for (end = i; end < of->link_count && links[end].other == links[i].other; ++end)
      faces += cw_face_count(links[end].count);
    if (!out) continue;
    fprintf(out,
            "    procBoundary%dto%d\n    {\n        type            processor;\n"
            "        inGroups        1(processor);\n        nFaces          %lld;\n        startFace       %lld;\n"
            "        matchTolerance  0.0001;\n        transform       unknown;\n        myProcNo        %d;\n"
            "        neighbProcNo    %d;\n    }\n",
            part, links[i].other, (long long)faces, (long long)cw_face_count(mesh->parts[part].link[i]), part,
            links[i].other);
  }
  return patches;
}

static void put_boundary(FILE *out, const CwFoamMesh *mesh, int part) {
  const CwAssembly *a = mesh->assembly;
  fprintf(out, head, "polyBoundaryMesh", "boundary", cw_patch_count(a, -1, NULL) + put_processors(NULL, mesh, part));
  for (int p = 0; p < a->mesh->patch_count; ++p)
    if (cw_patch_is_there(a, p)) put_patch(out, mesh, part, p);
  put_processors(out, mesh, part);
  fprintf(out, ")\n");
}

// The numbers that the patches have in the whole mesh; those to other parts have none.
static void put_boundary_numbers(FILE *out, const CwFoamMesh *mesh, int part) {
  const int present = cw_patch_count(mesh->assembly, -1, NULL), others = put_processors(NULL, mesh, part);
  fprintf(out, head, "labelList", "boundaryProcAddressing", present + others);
  for (int i = 0; i < present; ++i) fprintf(out, "%d\n", i);
  for (int i = 0; i < others; ++i) fprintf(out, "-1\n");
  fprintf(out, ")\n");
}

// Several inlets or outlets are a zone of faces too, over which solvers can report a mean.
static void put_end_zones(FILE *out, const CwFoamMesh *mesh, int part) {
  const CwMesh *input = mesh->assembly->mesh;
  const int zones =
      (cw_patch_kind_count(input, CW_PATCH_INLET) > 1) + (cw_patch_kind_count(input, CW_PATCH_OUTLET) > 1);
  const CwFaceCount *counts = mesh->division.parts[part].patch;
  fprintf(out, head, "regIOobject", "faceZones", zones);
  for (CwPatchKind kind = CW_PATCH_INLET; kind <= CW_PATCH_OUTLET; ++kind) {
    int64_t faces = 0;
    if (cw_patch_kind_count(input, kind) <= 1) continue;
    for (int p = 0; p < input->patch_count; ++p)
      if (input->patches[p].kind == kind) faces += cw_face_count(counts[p]);
    fprintf(out, "%s\n{\n    type            faceZone;\n    faceLabels      List<label>\n%lld\n(\n",
            cw_foam_end_zone(kind), (long long)faces);
    for (int p = 0; p < input->patch_count; ++p)
      for (int64_t f = 0; f < cw_face_count(counts[p]) && input->patches[p].kind == kind; ++f)
        fprintf(out, "%lld\n", (long long)(cw_face_count(mesh->parts[part].patch[p]) + f));
    fprintf(out, ")\n;\n    flipMap         List<bool> %lld{0};\n}\n", (long long)faces);
  }
  fprintf(out, ")\n");
}

// What `put` writes, as a file.
static CwStatus write_file(const CwFoamMesh *mesh, int part, const char *folder, const char *name,
                           void (*put)(FILE *out, const CwFoamMesh *mesh, int part)) {
  CwStatus status = CW_OK;
  char *path = NULL, *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  CW_REQUIRE(out, CW_ERR_MEMORY, "out of memory");
  put(out, mesh, part);
  int failed = fclose(out) != 0;
  CW_REQUIRE(!failed, CW_ERR_MEMORY, "out of memory");
  CW_TRY(cw_path_set(&path, "%s/%s", folder, name));
  CW_TRY(cw_text_write(path, text, 0));
done:
  free(path);
  free(text);
  return status;
}

CwStatus cw_foam_boundary_write(const CwFoamMesh *mesh, int part, const char *folder) {
  CwStatus status = CW_OK;
  const CwMesh *input = mesh->assembly->mesh;
  CW_TRY(write_file(mesh, part, folder, "boundary", put_boundary));
  if (cw_patch_kind_count(input, CW_PATCH_INLET) > 1 || cw_patch_kind_count(input, CW_PATCH_OUTLET) > 1)
    CW_TRY(write_file(mesh, part, folder, "faceZones", put_end_zones));
  if (mesh->division.part_count > 1)
    CW_TRY(write_file(mesh, part, folder, "boundaryProcAddressing", put_boundary_numbers));
done:
  return status;
}
