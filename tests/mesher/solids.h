// SPDX-License-Identifier: AGPL-3.0-or-later
// Small exact solids for the tests of the mesher, written as the geometry stage writes its own: a B-rep in mm
// and faces.csv, in a temporary folder.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include <BRepAdaptor_Surface.hxx>
#include <BRepTools.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include "mesher/cad/cad.h"

// Last: its macro named fail breaks the C++ headers. So this header comes last in a test as well.
#include "tests/unit_test.h"

#include "tests/folders.h"

inline void check(CwStatus status) {
  if (status != CW_OK) fail_msg("status %d: %s", status, cw_fail_message());
}

// Volume of the solid, m3, from all its faces.
static inline double solid_volume(const CwCad *cad) {
  double volume = 0;
  for (int f = 0; f < cw_cad_face_count(cad); f++) volume += cw_cad_face_volume(cad, f);
  return volume;
}

struct TemporaryFolder {
  std::string path;
  TemporaryFolder() {
    char made[100];
    assert_int_equal(make_temporary_folder(made, sizeof made), 0);
    path = made;
  }
  ~TemporaryFolder() {
    remove_folder(path.c_str());
  }
};

// Columns "patch,kind" of a face.
using PatchOfFace = std::function<std::string(const TopoDS_Face &)>;

inline std::string all_wall(const TopoDS_Face &) {
  return "wall,wall";
}

inline std::string by_shape(const TopoDS_Face &face) {
  return BRepAdaptor_Surface(face).GetType() == GeomAbs_Plane ? "flat,wall" : "curved,wall";
}

// Of a solid with its patches by shape.
inline int curved_face(const CwCad *cad) {
  for (int f = 0; f < cw_cad_face_count(cad); f++) {
    if (std::string(cw_cad_patch_name(cad, cw_cad_face_patch(cad, f))) == "curved") return f;
  }
  fail_msg("no face is curved");
  return -1;
}

inline void write_text(const TemporaryFolder &folder, const char *text) {
  FILE *file = std::fopen((folder.path + "/faces.csv").c_str(), "w");
  assert_non_null(file);
  std::fputs(text, file);
  std::fclose(file);
}

inline void write_solid(const TemporaryFolder &folder, const TopoDS_Shape &solid, const PatchOfFace &patch_of) {
  assert_true(BRepTools::Write(solid, (folder.path + "/part.brep").c_str()));
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  std::string text = "domain,face,patch,kind,name\nother,1,elsewhere,inlet,elsewhere\n";
  for (int f = 1; f <= faces.Extent(); f++) {
    std::string number = std::to_string(f);
    text += "part," + number + "," + patch_of(TopoDS::Face(faces(f))) + ",face_" + number + "\n";
  }
  write_text(folder, text.c_str());
}

inline CwCad *open_solid(const TopoDS_Shape &solid, const PatchOfFace &patch_of = all_wall) {
  TemporaryFolder folder;
  CwCad *cad = nullptr;
  write_solid(folder, solid, patch_of);
  check(cw_cad_open(folder.path.c_str(), "part", &cad));
  return cad;
}
