// SPDX-License-Identifier: AGPL-3.0-or-later
// cad_solids CASE FILE FOLDER: writes FOLDER/1/geometry, FOLDER/2/geometry, ... as the geometry stage does, each with
// one solid of a STEP, IGES or B-rep file: healed, brought to 200 mm, closed faces divided, all faces walls. A line for
// each: its number, its faces, whether it is valid, its degenerate edges, its volume.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>

#include <sys/stat.h>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeFix_Shape.hxx>
#include <ShapeUpgrade_ShapeDivideAngle.hxx>
#include <ShapeUpgrade_ShapeDivideClosed.hxx>
#include <ShapeUpgrade_ShapeDivideClosedEdges.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Trsf.hxx>

extern "C" {
#include "pipeline/case_read.h"
#include "pipeline/log.h"
#include "pipeline/model.h"
#include "pipeline/record.h"
}

static const double EXTENT = 200; // mm

static bool read(const std::string &path, TopoDS_Shape &shape) {
  std::string ending = path.substr(path.rfind('.') + 1);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == "brep" || ending == "rle") {
    BRep_Builder builder;
    return BRepTools::Read(shape, path.c_str(), builder) && !shape.IsNull();
  }
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return false;
  reader.TransferRoots();
  shape = reader.OneShape();
  return !shape.IsNull();
}

// Throws Standard_Failure where OpenCASCADE does.
static TopoDS_Shape heal(const TopoDS_Shape &solid) {
  Handle(ShapeFix_Shape) fix = new ShapeFix_Shape(solid);
  fix->Perform();
  TopoDS_Shape shape = fix->Shape();
  ShapeUpgrade_ShapeDivideAngle angle(M_PI / 2, shape);
  if (angle.Perform()) shape = angle.Result();
  ShapeUpgrade_ShapeDivideClosed closed(shape);
  closed.SetNbSplitPoints(2);
  if (closed.Perform()) shape = closed.Result();
  ShapeUpgrade_ShapeDivideClosedEdges edges(shape);
  if (edges.Perform()) shape = edges.Result();
  TopExp_Explorer found(shape, TopAbs_SOLID);
  return found.More() ? found.Current() : TopoDS_Shape();
}

static TopoDS_Shape brought_to_size(const TopoDS_Shape &solid) {
  Bnd_Box box;
  double low[3], high[3];
  BRepBndLib::Add(solid, box);
  box.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
  double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
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
  CW_TRY(cw_record_start("geometry", &record));
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

static CwStatus write_solid(const CwCase *table, const TopoDS_Shape &found, const std::string &folder, int number) {
  TopoDS_Shape solid = heal(found);
  if (solid.IsNull()) return CW_OK;
  solid = brought_to_size(solid);
  TopTools_IndexedMapOfShape faces, edges;
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  TopExp::MapShapes(solid, TopAbs_EDGE, edges);
  int degenerate = 0;
  for (int e = 1; e <= edges.Extent(); e++) degenerate += BRep_Tool::Degenerated(TopoDS::Edge(edges(e)));
  bool valid = BRepCheck_Analyzer(solid).IsValid();
  std::string run = folder + "/" + std::to_string(number);
  mkdir(run.c_str(), 0777);
  mkdir((run + "/geometry").c_str(), 0777);
  CwStatus status = write_geometry(table, solid, run + "/geometry", faces.Extent());
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid, properties);
  std::printf("solid %d faces %d valid %d degenerate %d volume %.4g\n", number, faces.Extent(), valid, degenerate,
              std::abs(properties.Mass()));
  return status;
}

int main(int argc, char **argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: cad_solids CASE FILE FOLDER\n"), CW_ERR_USAGE;
  CwCase table;
  CwStatus status = cw_case_read(argv[1], &table);
  std::streambuf *said = std::cout.rdbuf(nullptr); // the readers have words of their own
  TopoDS_Shape shape;
  int number = 0;
  if (status == CW_OK && !read(argv[2], shape)) status = CW_FAIL(CW_ERR_INPUT, "%s: cannot be read", argv[2]);
  mkdir(argv[3], 0777);
  for (TopExp_Explorer it(shape, TopAbs_SOLID); status == CW_OK && it.More(); it.Next()) {
    try {
      status = write_solid(&table, it.Current(), argv[3], ++number);
    } catch (const Standard_Failure &) {
      std::printf("solid %d faces 0 valid 0 degenerate 0 volume 0\n", number);
    }
  }
  std::cout.rdbuf(said);
  return status == CW_OK ? 0 : cw_log_error(status);
}
