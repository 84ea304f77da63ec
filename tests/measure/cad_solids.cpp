// SPDX-License-Identifier: AGPL-3.0-or-later
// cad_solids CASE FILE FOLDER: writes FOLDER/1/geometry, FOLDER/2/geometry, ... as the geometry stage does, each with
// one solid of a STEP, IGES or B-rep file: read, healed and divided as the solids of a case, brought to 200 mm, all
// faces walls. A line for each: its number, its faces, its volume; or its number and why it is refused.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>

#include <sys/stat.h>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <IGESControl_Reader.hxx>
#include <gp_Trsf.hxx>

#include "geometry/cad/cad_part.hpp"

extern "C" {
#include "geometry/cad/divide.h"
#include "geometry/cad/heal.h"
#include "pipeline/case_read.h"
#include "pipeline/log.h"
#include "pipeline/model.h"
#include "pipeline/record.h"
}

static const double EXTENT = 200, UNIT = 1e-3; // of the solids, units; m
static const double TOLERANCE = 0.01;          // units, as the stage has it
enum { PIECES = 3 };
static const CwCadFrame FRAME = {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1};

// IGES files go through a B-rep file: the stage reads none.
static CwStatus read(const std::string &path, const std::string &folder, CwCadBodies **bodies) {
  const std::string ending = path.substr(path.rfind('.') + 1), brep = folder + "/iges.brep";
  if (ending != "iges" && ending != "igs") return cw_cad_file_read(path.c_str(), 0, 0, bodies);
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return CW_FAIL(CW_ERR_INPUT, "%s: no IGES", path.c_str());
  reader.TransferRoots();
  BRepTools::Write(reader.OneShape(), brep.c_str());
  return cw_cad_file_read(brep.c_str(), 0, 0, bodies);
}

static TopoDS_Shape brought_to_size(const TopoDS_Shape &solid) {
  Bnd_Box box;
  double low[3], high[3];
  BRepBndLib::AddOptimal(solid, box, Standard_False, Standard_False);
  box.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  gp_Trsf move, scale;
  move.SetTranslation(gp_Vec(-(low[0] + high[0]) / 2, -(low[1] + high[1]) / 2, -(low[2] + high[2]) / 2));
  scale.SetScale(gp_Pnt(0, 0, 0), EXTENT / extent);
  return BRepBuilderAPI_Transform(solid, scale * move, true).Shape();
}

static CwStatus write_geometry(const CwCase *table, const TopoDS_Shape &solid, const std::string &folder, int faces) {
  CwStatus status = CW_OK;
  CwModel model = {};
  CwModelPatch *patch;
  CwRecord *record = nullptr;
  FILE *out = nullptr;
  model.unit = 1e-3;
  model.flow = CwModelFlow{1, 0.1, 1, 0.1, 0.2, 1};
  CW_TRY(cw_record_start("geometry", NULL, &record));
  CW_TRY(cw_model_add_domain(&model, "part", 0));
  CW_TRY(cw_model_add_patch(&model, "walls", CW_PATCH_WALL, &patch));
  patch->flow = CwWallFlow{5, 0.2, 0.1, 0.1, 0}; // as far apart as the case's first height asks
  BRepTools::Write(solid, (folder + "/part.brep").c_str());
  out = std::fopen((folder + "/faces.csv").c_str(), "w");
  CW_REQUIRE(out, CW_ERR_IO, "%s: cannot be written", folder.c_str());
  std::fputs("domain,face,patch,kind,name\n", out);
  for (int f = 1; f <= faces; f++) std::fprintf(out, "part,%d,walls,wall,face_%d\n", f, f);
  std::fclose(out);
  CW_TRY(cw_model_write(&model, (folder + "/model.json").c_str()));
  for (const char *name : {"part.brep", "faces.csv", "model.json"})
    CW_TRY(cw_record_file(record, folder.c_str(), name));
  CW_TRY(cw_record_case(record, table));
  CW_TRY(cw_record_write(record, (folder + "/record.json").c_str()));
done:
  cw_record_free(record);
  cw_model_free(&model);
  return status;
}

static CwStatus write_solid(const CwCase *table, const CwCadBody &body, const std::string &folder, int number) {
  CwStatus status = CW_OK;
  CwCadParts parts = {UNIT, {{"part", brought_to_size(body.solid), body.origin}}};
  CwCadFault fault;
  GProp_GProps properties;
  const std::string run = folder + "/" + std::to_string(number);
  const int pieces = PIECES;
  CW_TRY(cw_cad_heal(TOLERANCE, &FRAME, nullptr, &parts, &fault));
  CW_TRY(cw_cad_divide(&pieces, &FRAME, nullptr, &parts));
  mkdir(run.c_str(), 0777);
  mkdir((run + "/geometry").c_str(), 0777);
  CW_TRY(write_geometry(table, parts.part[0].solid, run + "/geometry", cw_cad_faces(parts.part[0].solid).Extent()));
  BRepGProp::VolumeProperties(parts.part[0].solid, properties);
  std::printf("solid %d faces %d volume %.4g\n", number, cw_cad_faces(parts.part[0].solid).Extent(),
              std::abs(properties.Mass()));
done:
  return status;
}

int main(int argc, char **argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: cad_solids CASE FILE FOLDER\n"), CW_ERR_USAGE;
  CwCase table;
  CwCadBodies *bodies = nullptr;
  std::streambuf *said = std::cout.rdbuf(nullptr); // the readers have words of their own
  mkdir(argv[3], 0777);
  CwStatus status = cw_case_read(argv[1], &table);
  if (status == CW_OK) status = cw_cad_guard(argv[2], [&] { return read(argv[2], argv[3], &bodies); });
  for (size_t i = 0; status == CW_OK && i < bodies->body.size(); i++) {
    const CwStatus one = cw_cad_guard("cad", [&] { return write_solid(&table, bodies->body[i], argv[3], (int)i + 1); });
    if (one != CW_OK) std::printf("solid %d refused: %s\n", (int)i + 1, cw_fail_message());
    std::fflush(stdout); // a crash in a later solid keeps those before
  }
  std::cout.rdbuf(said);
  cw_cad_bodies_free(&bodies);
  return status == CW_OK ? 0 : cw_log_error(NULL, status);
}
