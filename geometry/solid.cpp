// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/solid.h"

#include <cerrno>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepTools.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>

#include "geometry/solid.hpp"
#include "pipeline/atomic_file.h"

std::string cw_solid_failure_text(const Standard_Failure &failure) {
  const char *text = failure.GetMessageString();
  return text && *text ? text : "failed without a word";
}

CwStatus cw_solid_guard(CwStatus code, const std::string &what, const char *library,
                        const std::function<CwStatus()> &run) {
  try {
    return run();
  } catch (const Standard_Failure &failure) {
    return CW_FAIL(code, "%s: %s%s", what.c_str(), library, cw_solid_failure_text(failure).c_str());
  } catch (const std::exception &failure) {
    return CW_FAIL(code, "%s: %s", what.c_str(), failure.what());
  }
}

void cw_solid_refuse(const char *format, ...) {
  char text[400];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  throw std::runtime_error(text);
}

std::string cw_solid_fault(const CwSolid &solid) {
  BRepCheck_Analyzer check(solid.solid);
  if (check.IsValid()) return "";
  for (const CwSolidFace &face : solid.faces)
    if (!check.IsValid(face.face)) return "the edges of face " + face.name + " cross or do not fit";
  return "its faces do not bound a volume";
}

double cw_solid_unit_of_pump(double outlet_diameter) {
  return outlet_diameter / 200;
}

double cw_solid_unit_of_drawing(double outlet_diameter) {
  const double millimetre = 1e-3; // m
  const int size_exponent = 8;    // D2 is less than 2^8 units
  int exponent;
  std::frexp(outlet_diameter / millimetre, &exponent);
  return std::ldexp(millimetre, exponent - size_exponent);
}

void cw_solid_free(CwSolid **solid) {
  delete *solid;
  *solid = nullptr;
}

const char *cw_solid_domain(const CwSolid *solid) {
  return solid->domain.c_str();
}

double cw_solid_unit(const CwSolid *solid) {
  return solid->unit;
}

int cw_solid_face_count(const CwSolid *solid) {
  return (int)solid->faces.size();
}

const char *cw_solid_face_patch(const CwSolid *solid, int face) {
  return solid->faces[face].patch.c_str();
}

CwPatchKind cw_solid_face_kind(const CwSolid *solid, int face) {
  return solid->faces[face].kind;
}

const char *cw_solid_face_name(const CwSolid *solid, int face) {
  return solid->faces[face].name.c_str();
}

CwStatus cw_solid_mirror(CwSolid *solid) {
  return cw_solid_guard(CW_ERR_GEOMETRY, solid->domain + " cannot be mirrored", "", [&]() -> CwStatus {
    gp_Trsf mirror;
    mirror.SetMirror(gp_Ax2(gp::Origin(), gp::DZ()));
    BRepBuilderAPI_Transform transform(solid->solid, mirror, Standard_True);
    std::vector<CwSolidFace> faces = solid->faces;
    for (CwSolidFace &face : faces) face.face = TopoDS::Face(transform.ModifiedShape(face.face));
    const TopoDS_Solid mirrored = TopoDS::Solid(transform.Shape());
    TopTools_IndexedMapOfShape map;
    TopExp::MapShapes(mirrored, TopAbs_FACE, map);
    if (map.Extent() != (int)faces.size())
      return CW_FAIL(CW_ERR_LIBRARY, "%s: the mirror image has other faces", solid->domain.c_str());
    for (size_t i = 0; i < faces.size(); i++) {
      if (!map((int)i + 1).IsSame(faces[i].face))
        return CW_FAIL(CW_ERR_LIBRARY, "%s: the mirror image has faces in another order", solid->domain.c_str());
      faces[i].face = TopoDS::Face(map((int)i + 1));
    }
    solid->solid = mirrored;
    solid->faces = faces;
    return CW_OK;
  });
}

CwStatus cw_solid_write_brep(const CwSolid *solid, const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {};
  std::ofstream stream;
  try {
    CW_TRY(cw_atomic_file_name(path, &file));
    stream.open(file.temporary_path, std::ios::binary);
    BRepTools::Write(solid->solid, stream);
    stream.close();
    CW_REQUIRE(stream, CW_ERR_IO, "%s: cannot be written: %s", path, std::strerror(errno));
    CW_TRY(cw_atomic_file_commit(&file));
  } catch (const Standard_Failure &failure) {
    status = CW_FAIL(CW_ERR_LIBRARY, "%s: OpenCASCADE: %s", path, failure.GetMessageString());
  } catch (const std::exception &failure) {
    // OpenCASCADE may throw what it likes where a stream has failed.
    status = stream ? CW_FAIL(CW_ERR_LIBRARY, "%s: %s", path, failure.what())
                    : CW_FAIL(CW_ERR_IO, "%s: cannot be written (is the disk full?)", path);
  }
done:
  cw_atomic_file_abandon(&file);
  return status;
}
