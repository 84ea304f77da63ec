// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/step_file.h"

#include <fstream>

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDataStd_Name.hxx>
#include <TopoDS_Shell.hxx>
#include <XSControl_WorkSession.hxx>

#include "geometry/solid.hpp"
#include "geometry/solid_scale.hpp"
#include "geometry/step_document.hpp"
#include "pipeline/atomic_file.h"

namespace {

void set_name(const TDF_Label &label, const std::string &name) {
  TDataStd_Name::Set(label, TCollection_ExtendedString(name.c_str()));
}

const double millimetre = 1e-3; // m

// Each face once more, as a shell that is a product with the name of its patch.
void add_faces(const Handle(XCAFDoc_ShapeTool) & shapes, const CwSolid &solid) {
  for (const CwSolidFace &face : solid.faces) {
    TopoDS_Shell shell;
    BRep_Builder builder;
    builder.MakeShell(shell);
    builder.Add(shell, face.face);
    set_name(shapes->AddShape(shell, Standard_False), face.patch);
  }
}

// With all digits of each number: whoever reads the file has the very solids that were meshed. The library's own way
// leaves twelve decimals.
bool write_exactly(STEPControl_Writer &writer, const char *path) {
  StepData_StepWriter text(writer.Model());
  text.FloatWriter().SetFormat("%.16E");
  text.FloatWriter().SetFormatForRange("0.", 0, 1e-99); // the library has no room for an exponent of three digits
  text.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ofstream stream(path, std::ios::binary);
  return text.Print(stream) && stream.flush().good();
}

CwStatus write(const CwSolid *const *solids, int count, bool with_faces, const CwAtomicFile &file) {
  CwStepDocument document;
  const Handle(XCAFDoc_ShapeTool) &shapes = document.shapes;
  for (int i = 0; i < count; i++) {
    const CwSolid solid = cw_solid_scaled(*solids[i], solids[i]->unit / millimetre);
    const TDF_Label label = shapes->AddShape(solid.solid, Standard_False);
    set_name(label, solid.domain);
    for (const CwSolidFace &face : solid.faces) {
      const TDF_Label part = shapes->AddSubShape(label, face.face);
      if (part.IsNull()) throw Standard_Failure(("no label for face " + face.name).c_str());
      set_name(part, face.patch);
    }
    if (with_faces) add_faces(shapes, solid);
  }
  STEPCAFControl_Writer writer;
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  writer.SetNameMode(Standard_True);
  if (!writer.Transfer(document.handle, STEPControl_AsIs)) throw Standard_Failure("the shapes cannot be translated");
  APIHeaderSection_MakeHeader header(writer.ChangeWriter().Model());
  header.SetName(new TCollection_HAsciiString("pump"));
  header.SetTimeStamp(new TCollection_HAsciiString("2000-01-01T00:00:00"));
  header.SetOriginatingSystem(new TCollection_HAsciiString("Cutwater"));
  if (!write_exactly(writer.ChangeWriter(), file.temporary_path))
    return CW_FAIL(CW_ERR_IO, "%s: cannot be written (is the disk full?)", file.final_path);
  return CW_OK;
}

CwStatus write_whole(const CwSolid *const *solids, int count, bool with_faces, const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {};
  CW_TRY(cw_atomic_file_name(path, &file));
  CW_TRY(cw_solid_guard(CW_ERR_LIBRARY, path, "OpenCASCADE: ", [&] { return write(solids, count, with_faces, file); }));
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}

struct FileWithFaces {
  const CwSolid *const *solids;
  int count;
  const char *path;
};

CwStatus write_with_faces(const void *given) {
  const FileWithFaces *file = static_cast<const FileWithFaces *>(given);
  return write_whole(file->solids, file->count, true, file->path);
}

} // namespace

CwStatus cw_step_write(const CwSolid *const *solids, int count, const char *path) {
  return write_whole(solids, count, false, path);
}

CwStatus cw_step_write_with_faces(const CwSolid *const *solids, int count, const char *path, CwBeside **beside) {
  const FileWithFaces file = {solids, count, path};
  return cw_beside_start(write_with_faces, &file, beside);
}
