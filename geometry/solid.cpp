// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/solid.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <BRepTools.hxx>
#include <Standard_Failure.hxx>

#include "geometry/solid.hpp"
#include "pipeline/atomic_file.h"

void cw_solid_free(CwSolid **solid) {
  delete *solid;
  *solid = nullptr;
}

const char *cw_solid_domain(const CwSolid *solid) {
  return solid->domain.c_str();
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

CwStatus cw_solid_write_brep(const CwSolid *solid, const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {};
  try {
    CW_TRY(cw_atomic_file_name(path, &file));
    std::ofstream stream(file.temporary_path, std::ios::binary);
    BRepTools::Write(solid->solid, stream);
    stream.close();
    CW_REQUIRE(stream, CW_ERR_IO, "%s: cannot be written: %s", path, std::strerror(errno));
    CW_TRY(cw_atomic_file_commit(&file));
  } catch (const Standard_Failure &failure) {
    status = CW_FAIL(CW_ERR_LIBRARY, "%s: OpenCASCADE: %s", path, failure.GetMessageString());
  } catch (const std::exception &failure) {
    status = CW_FAIL(CW_ERR_LIBRARY, "%s: %s", path, failure.what());
  }
done:
  cw_atomic_file_abandon(&file);
  return status;
}
