// SPDX-License-Identifier: AGPL-3.0-or-later
// turned_zones CASE RUN: writes RUN/geometry as the geometry stage does, of a machine that no generator made: four
// zones of revolution in an order of their own, of which the third turns; a cone, a plane and a cylinder between them,
// two inlets, two outlets and a plane of symmetry. mm:
//
//   z 60  +---inlets---+
//         |    pipe    |
//   z 20  +---plane----+-------------+--------+
//         |   wheel    \ cone casing |  ring  | outlets and wall
//   z  0  +---back-------+-symmetry--+--floor-+
//       r 0           40  50         90      110
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Ax1.hxx>
#include <gp_Pnt.hxx>

extern "C" {
#include "pipeline/case_read.h"
#include "pipeline/log.h"
#include "pipeline/model.h"
#include "pipeline/record.h"
}

typedef std::vector<std::pair<double, double>> Profile; // r, z

// The ring of a profile, with four faces where a surface goes all the way round.
static TopoDS_Shape turn(const Profile &profile) {
  TopoDS_Shape whole;
  for (int quarter = 0; quarter < 4; quarter++) {
    double angle = quarter * M_PI / 2;
    BRepBuilderAPI_MakePolygon polygon;
    for (const auto &p : profile) polygon.Add(gp_Pnt(p.first * std::cos(angle), p.first * std::sin(angle), p.second));
    polygon.Close();
    TopoDS_Shape part = BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(),
                                              gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), M_PI / 2)
                            .Shape();
    whole = quarter ? BRepAlgoAPI_Fuse(whole, part).Shape() : part;
  }
  TopExp_Explorer solid(whole, TopAbs_SOLID);
  return solid.Current();
}

struct Zone {
  const char *name;
  int rotating;
  Profile profile;
  std::function<std::pair<const char *, CwPatchKind>(const gp_Pnt &)> patch_at; // by the middle of a face
};

static gp_Pnt middle_of(const TopoDS_Face &face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return properties.CentreOfMass();
}

static bool at(double value, double wanted) {
  return std::fabs(value - wanted) < 0.1;
}

static CwStatus write_zone(const Zone &zone, const std::string &folder, FILE *faces, CwRecord *record, CwModel *model) {
  CwStatus status = CW_OK;
  TopoDS_Shape solid = turn(zone.profile);
  TopTools_IndexedMapOfShape map;
  std::string file = std::string(zone.name) + ".brep";
  TopExp::MapShapes(solid, TopAbs_FACE, map);
  BRepTools::Write(solid, (folder + "/" + file).c_str());
  CW_TRY(cw_record_file(record, folder.c_str(), file.c_str()));
  CW_TRY(cw_model_add_domain(model, zone.name, zone.rotating));
  for (int f = 1; f <= map.Extent(); f++) {
    auto patch = zone.patch_at(middle_of(TopoDS::Face(map(f))));
    std::fprintf(faces, "%s,%d,%s,%s,%s_%d\n", zone.name, f, patch.first, cw_patch_kind_name(patch.second), zone.name,
                 f);
    if (cw_model_patch_find(model, patch.first) >= 0) continue;
    CwModelPatch *made;
    CW_TRY(cw_model_add_patch(model, patch.first, patch.second, &made));
    made->flow = CwWallFlow{3, 0.1, 0.04, 0.02, 0};
    made->flow_share = patch.first == std::string("out_left") ? 0.25 : 0.75;
  }
done:
  return status;
}

static std::vector<Zone> make_zones() {
  auto casing = [](const gp_Pnt &p) -> std::pair<const char *, CwPatchKind> {
    double r = std::hypot(p.X(), p.Y());
    if (at(p.Z(), 0)) return {"middle", CW_PATCH_SYMMETRY};
    if (at(p.Z(), 20)) return {"cover", CW_PATCH_WALL};
    return r > 60 ? std::make_pair("casing_out", CW_PATCH_INTERFACE) : std::make_pair("casing_in", CW_PATCH_INTERFACE);
  };
  auto pipe = [](const gp_Pnt &p) -> std::pair<const char *, CwPatchKind> {
    if (at(p.Z(), 60))
      return p.X() > 0 ? std::make_pair("in_a", CW_PATCH_INLET) : std::make_pair("in_b", CW_PATCH_INLET);
    if (at(p.Z(), 20)) return {"pipe_end", CW_PATCH_INTERFACE};
    return {"tube", CW_PATCH_WALL};
  };
  auto wheel = [](const gp_Pnt &p) -> std::pair<const char *, CwPatchKind> {
    if (at(p.Z(), 0)) return {"back", CW_PATCH_WALL};
    if (at(p.Z(), 20)) return {"eye", CW_PATCH_INTERFACE};
    return {"cone", CW_PATCH_INTERFACE};
  };
  auto ring = [](const gp_Pnt &p) -> std::pair<const char *, CwPatchKind> {
    double r = std::hypot(p.X(), p.Y());
    if (at(p.Z(), 0) || at(p.Z(), 20)) return {"floor_and_roof", CW_PATCH_WALL};
    if (r < 90) return {"ring_in", CW_PATCH_INTERFACE};
    if (p.X() < 0 && p.Y() > 0) return {"out_left", CW_PATCH_OUTLET};
    if (p.X() > 0 && p.Y() < 0) return {"out_right", CW_PATCH_OUTLET};
    return {"rim", CW_PATCH_WALL};
  };
  return {{"casing", 0, {{50, 0}, {90, 0}, {90, 20}, {40, 20}}, casing},
          {"pipe", 0, {{0, 20}, {40, 20}, {40, 60}, {0, 60}}, pipe},
          {"wheel", 1, {{0, 0}, {50, 0}, {40, 20}, {0, 20}}, wheel},
          {"ring", 0, {{90, 0}, {110, 0}, {110, 20}, {90, 20}}, ring}};
}

static CwStatus write_geometry(const CwCase *table, const std::string &folder) {
  CwStatus status = CW_OK;
  CwModel model = {};
  CwRecord *record = nullptr;
  FILE *faces = std::fopen((folder + "/faces.csv").c_str(), "w");
  const char *cone[] = {"casing_in", "cone"}, *plane[] = {"eye", "pipe_end"}, *cylinder[] = {"ring_in", "casing_out"};
  CW_REQUIRE(faces, CW_ERR_IO, "%s: cannot be written", folder.c_str());
  model.unit = 1e-3;
  model.flow = CwModelFlow{2, 0.08, 5, 0.02, 0.1, 1};
  std::fputs("domain,face,patch,kind,name\n", faces);
  CW_TRY(cw_record_start("geometry", NULL, &record));
  for (const Zone &zone : make_zones()) CW_TRY(write_zone(zone, folder, faces, record, &model));
  CW_TRY(cw_model_add_interface(&model, cone, CW_SURFACE_OTHER, 0));
  CW_TRY(cw_model_add_interface(&model, plane, CW_SURFACE_PLANE, 0));
  CW_TRY(cw_model_add_interface(&model, cylinder, CW_SURFACE_CYLINDER, 0.09));
  CW_TRY(cw_model_write(&model, (folder + "/model.json").c_str()));
  std::fclose(faces);
  faces = nullptr;
  CW_TRY(cw_record_file(record, folder.c_str(), "faces.csv"));
  CW_TRY(cw_record_file(record, folder.c_str(), "model.json"));
  CW_TRY(cw_record_case(record, table));
  CW_TRY(cw_record_write(record, (folder + "/record.json").c_str()));
done:
  if (faces) std::fclose(faces);
  cw_record_free(record);
  cw_model_free(&model);
  return status;
}

int main(int argc, char **argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: turned_zones CASE RUN\n"), CW_ERR_USAGE;
  CwCase table;
  std::string folder = std::string(argv[2]) + "/geometry";
  mkdir(argv[2], 0777);
  mkdir(folder.c_str(), 0777);
  CwStatus status = cw_case_read(argv[1], &table);
  if (status == CW_OK) status = write_geometry(&table, folder);
  return status == CW_OK ? 0 : cw_log_error(NULL, status);
}
