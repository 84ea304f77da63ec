// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/solid.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepTools.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>

#include "geometry/solid.hpp"
#include "pipeline/atomic_file.h"

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

const char *cw_solid_face_kind(const CwSolid *solid, int face) {
  return solid->faces[face].kind.c_str();
}

const char *cw_solid_face_name(const CwSolid *solid, int face) {
  return solid->faces[face].name.c_str();
}

CwStatus cw_solid_mirror(CwSolid *solid) {
  CwStatus status = CW_OK;
  try {
    gp_Trsf mirror;
    mirror.SetMirror(gp_Ax2(gp::Origin(), gp::DZ()));
    BRepBuilderAPI_Transform transform(solid->solid, mirror, Standard_True);
    std::vector<CwSolidFace> faces = solid->faces;
    for (CwSolidFace &face : faces) face.face = TopoDS::Face(transform.ModifiedShape(face.face));
    const TopoDS_Solid mirrored = TopoDS::Solid(transform.Shape());
    TopTools_IndexedMapOfShape map;
    TopExp::MapShapes(mirrored, TopAbs_FACE, map);
    CW_REQUIRE(map.Extent() == (int)faces.size(), CW_ERR_LIBRARY, "%s: the mirror image has other faces",
               solid->domain.c_str());
    for (size_t i = 0; i < faces.size(); i++) {
      CW_REQUIRE(map((int)i + 1).IsSame(faces[i].face), CW_ERR_LIBRARY,
                 "%s: the mirror image has faces in another order", solid->domain.c_str());
      faces[i].face = TopoDS::Face(map((int)i + 1));
    }
    solid->solid = mirrored;
    solid->faces = faces;
  } catch (const Standard_Failure &failure) {
    status = CW_FAIL(CW_ERR_GEOMETRY, "%s cannot be mirrored: %s", solid->domain.c_str(), failure.GetMessageString());
  }
done:
  return status;
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
