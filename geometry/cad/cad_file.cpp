// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_file.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <gp_Trsf.hxx>

#include "geometry/cad/cad_part.hpp"
#include "geometry/cad/sewing.hpp"
#include "geometry/step_document.hpp"

namespace {

const double millimetre = 1e-3; // m

struct Document : CwStepDocument {
  Handle(XCAFDoc_ColorTool) colours = XCAFDoc_DocumentTool::ColorTool(handle->Main());
  Handle(XCAFDoc_LayerTool) layers = XCAFDoc_DocumentTool::LayerTool(handle->Main());
};

std::string label_name(const TDF_Label &label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return "";
  const TCollection_AsciiString text(name->Get());
  return text.ToCString();
}

int label_colour(const Document &document, const TDF_Label &label) {
  Quantity_Color colour;
  const XCAFDoc_ColorType types[] = {XCAFDoc_ColorSurf, XCAFDoc_ColorGen};
  for (XCAFDoc_ColorType type : types) {
    if (!document.colours->GetColor(label, type, colour)) continue;
    Standard_Real red, green, blue;
    colour.Values(red, green, blue, Quantity_TOC_sRGB);
    const auto byte = [](double share) { return (int)std::lround(255 * share); };
    return byte(red) << 16 | byte(green) << 8 | byte(blue);
  }
  return -1;
}

std::vector<std::string> label_layers(const Document &document, const TDF_Label &label) {
  Handle(TColStd_HSequenceOfExtendedString) names;
  std::vector<std::string> layers;
  if (!document.layers->GetLayers(label, names)) return layers;
  for (int i = 1; i <= names->Length(); i++) layers.push_back(TCollection_AsciiString(names->Value(i)).ToCString());
  return layers;
}

CwCadFaceOrigin label_origin(const Document &document, const TDF_Label &label) {
  return {label_name(label), label_layers(document, label), label_colour(document, label)};
}

using Origins = std::vector<std::pair<TopoDS_Shape, CwCadFaceOrigin>>;

// What is said of a face goes before what the body has.
void take(const TopTools_IndexedMapOfShape &map, const Origins &of, CwCadBody &body) {
  for (const auto &[face, origin] : of) {
    const int index = map.FindIndex(face);
    if (!index) continue;
    CwCadFaceOrigin &its = body.origin[index - 1];
    if (!origin.name.empty()) its.name = origin.name;
    if (!origin.layers.empty()) its.layers = origin.layers;
    if (origin.colour >= 0) its.colour = origin.colour;
  }
}

// The solids of one product that is no assembly, at one of its places.
void add_product(const Document &document, const TDF_Label &label, const TopLoc_Location &place,
                 const std::string &instance, const std::string &file, CwCadBodies &bodies) {
  const CwCadFaceOrigin whole = label_origin(document, label);
  Origins faces, inherited;
  std::vector<std::pair<TopoDS_Shape, std::string>> solids;
  TDF_LabelSequence parts;
  document.shapes->GetSubShapes(label, parts);
  for (int i = 1; i <= parts.Length(); i++) {
    const TopoDS_Shape part = document.shapes->GetShape(parts(i));
    const CwCadFaceOrigin origin = label_origin(document, parts(i));
    if (part.ShapeType() == TopAbs_FACE) {
      faces.emplace_back(part, origin);
    } else {
      for (TopExp_Explorer at(part, TopAbs_FACE); at.More(); at.Next())
        inherited.emplace_back(at.Current(), CwCadFaceOrigin{"", origin.layers, origin.colour});
      if (part.ShapeType() == TopAbs_SOLID && !origin.name.empty()) solids.emplace_back(part, origin.name);
    }
  }
  for (TopExp_Explorer at(document.shapes->GetShape(label), TopAbs_SOLID); at.More(); at.Next()) {
    const TopTools_IndexedMapOfShape map = cw_cad_faces(at.Current());
    if (map.IsEmpty()) continue;
    CwCadBody body = {file, whole.name, instance, at.Current().Moved(place), {}};
    for (const auto &[solid, its_name] : solids)
      if (solid.IsSame(at.Current())) body.name = its_name;
    body.origin.resize(map.Extent(), {"", whole.layers, whole.colour});
    take(map, inherited, body);
    take(map, faces, body);
    bodies.body.push_back(body);
  }
}

void add_label(const Document &document, const TDF_Label &label, const TopLoc_Location &place,
               const std::string &instance, const std::string &file, CwCadBodies &bodies) {
  TDF_Label referred;
  TDF_LabelSequence components;
  if (XCAFDoc_ShapeTool::IsReference(label) && XCAFDoc_ShapeTool::GetReferredShape(label, referred)) {
    add_label(document, referred, place * XCAFDoc_ShapeTool::GetLocation(label), label_name(label), file, bodies);
  } else if (XCAFDoc_ShapeTool::GetComponents(label, components)) {
    for (int i = 1; i <= components.Length(); i++) add_label(document, components(i), place, instance, file, bodies);
  } else {
    add_product(document, label, place, instance, file, bodies);
  }
}

TopoDS_Shape scaled(const TopoDS_Shape &shape, double factor) {
  if (std::fabs(factor - 1) < 1e-12) return shape;
  gp_Trsf scale;
  scale.SetScale(gp_Pnt(0, 0, 0), factor);
  return BRepBuilderAPI_Transform(shape, scale, Standard_True).Shape();
}

// Length of one unit of a STEP file, mm; files name converted units as they like (INCH, inch).
CwStatus own_unit(const char *path, STEPControl_Reader &reader, double *unit) {
  TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  static const std::map<std::string, double> known = {{"millimetre", 1}, {"metre", 1000}, {"centimetre", 10},
                                                      {"inch", 25.4},    {"foot", 304.8}, {"micrometre", 1e-3}};
  *unit = 1;
  if (lengths.IsEmpty()) return CW_OK;
  TCollection_AsciiString name = lengths(1);
  name.LowerCase();
  const auto found = known.find(name.ToCString());
  if (found == known.end())
    return CW_FAIL(CW_ERR_INPUT,
                   "%s: its lengths are in '%s'; with cad.unit_mm allowed: millimetre, metre, centimetre, micrometre, "
                   "inch, foot; without the key its own unit is taken",
                   path, lengths(1).ToCString());
  *unit = found->second;
  return CW_OK;
}

// Gap that is sewn where no tolerance is given, mm: a share of the diagonal of the box about all faces.
double usual_gap(const std::vector<TopoDS_Shape> &shapes) {
  constexpr double share = 2e-5;
  Bnd_Box box;
  for (const TopoDS_Shape &shape : shapes) BRepBndLib::Add(shape, box);
  return share * std::sqrt(box.SquareExtent());
}

// All faces of the shapes, sewn, as solids.
CwStatus sew(const char *path, const std::vector<TopoDS_Shape> &shapes, double tolerance, CwCadBodies &bodies) {
  const double gap = tolerance > 0 ? tolerance / millimetre : usual_gap(shapes);
  const CwSewn sewn = cw_cad_sew(shapes, gap);
  if (!sewn.faces)
    return CW_FAIL(CW_ERR_INPUT, "%s: holds no solid and no face; allowed: the water as closed solids", path);
  if (!sewn.open.empty()) {
    const CwOpening opening = cw_cad_opening(sewn.open[0], sewn.open);
    char by[40] = "";
    if (opening.gap > gap) snprintf(by, sizeof by, ", by %.3g mm", opening.gap);
    return CW_FAIL(
        CW_ERR_INPUT,
        "%s: holds no solid, and its %d faces do not close within %.3g mm: %d edges stay open, one at (%.3f, "
        "%.3f, %.3f) mm%s; allowed: the water as closed solids, or a greater cad.tolerance_mm",
        path, sewn.faces, gap, (int)sewn.open.size(), opening.at.X(), opening.at.Y(), opening.at.Z(), by);
  }
  for (const TopoDS_Shape &solid : sewn.solids)
    bodies.body.push_back({path, "", "", solid, std::vector<CwCadFaceOrigin>(cw_cad_faces(solid).Extent())});
  return CW_OK;
}

CwStatus read_step(const char *path, double unit, double tolerance, CwCadBodies &bodies) {
  Document document;
  STEPCAFControl_Reader reader;
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  reader.SetNameMode(Standard_True);
  reader.SetColorMode(Standard_True);
  reader.SetLayerMode(Standard_True);
  if (reader.ReadFile(path) != IFSelect_RetDone) return CW_FAIL(CW_ERR_INPUT, "%s: is not a STEP file", path);
  double factor = 1;
  if (unit > 0) {
    double own;
    const CwStatus status = own_unit(path, reader.ChangeReader(), &own);
    if (status != CW_OK) return status;
    factor = unit / millimetre / own;
  }
  if (!reader.Transfer(document.handle)) return CW_FAIL(CW_ERR_INPUT, "%s: holds no shape; allowed: solids", path);
  TDF_LabelSequence labels;
  document.shapes->GetFreeShapes(labels);
  const size_t before = bodies.body.size();
  std::vector<TopoDS_Shape> all;
  for (int i = 1; i <= labels.Length(); i++) {
    add_label(document, labels(i), TopLoc_Location(), "", path, bodies);
    all.push_back(document.shapes->GetShape(labels(i)));
  }
  if (bodies.body.size() == before) {
    for (TopoDS_Shape &shape : all) shape = scaled(shape, factor);
    return sew(path, all, tolerance, bodies);
  }
  for (size_t i = before; i < bodies.body.size(); i++) bodies.body[i].solid = scaled(bodies.body[i].solid, factor);
  return CW_OK;
}

bool read_shape(const char *path, TopoDS_Shape &shape) {
  char head[64] = {0};
  std::ifstream(path, std::ios::binary).read(head, sizeof head - 1);
  const std::string start(head);
  std::streambuf *out = std::cout.rdbuf(nullptr); // the reader has words of its own for a damaged file
  bool read = false;
  try {
    BRep_Builder builder;
    if (start.find("Open CASCADE Topology") != std::string::npos)
      read = BinTools::Read(shape, path);
    else if (start.find("DBRep_DrawableShape") != std::string::npos || start.find("CASCADE") != std::string::npos)
      read = BRepTools::Read(shape, path, builder);
  } catch (const Standard_Failure &) {
  }
  std::cout.rdbuf(out);
  return read && !shape.IsNull();
}

CwStatus read_brep(const char *path, double unit, double tolerance, CwCadBodies &bodies) {
  TopoDS_Shape shape;
  if (!read_shape(path, shape))
    return CW_FAIL(CW_ERR_INPUT, "%s: is neither STEP nor a B-rep file of OpenCASCADE; allowed: .step, .stp, .brep",
                   path);
  if (unit > 0) shape = scaled(shape, unit / millimetre);
  const size_t before = bodies.body.size();
  for (TopExp_Explorer at(shape, TopAbs_SOLID); at.More(); at.Next()) {
    const int faces = cw_cad_faces(at.Current()).Extent();
    if (faces) bodies.body.push_back({path, "", "", at.Current(), std::vector<CwCadFaceOrigin>(faces)});
  }
  return bodies.body.size() > before ? CW_OK : sew(path, {shape}, tolerance, bodies);
}

bool is_step(const char *path) {
  char head[512] = {0};
  std::ifstream(path, std::ios::binary).read(head, sizeof head - 1);
  return std::string(head).find("ISO-10303-21") != std::string::npos;
}

} // namespace

CwStatus cw_cad_file_read(const char *path, double unit, double tolerance, CwCadBodies **bodies) {
  if (!std::ifstream(path).good())
    return CW_FAIL(CW_ERR_IO, "%s: cannot be read; cad.files names it, counted from the folder of the case file", path);
  if (!*bodies) *bodies = new CwCadBodies;
  return cw_cad_guard(path, [&] {
    return is_step(path) ? read_step(path, unit, tolerance, **bodies) : read_brep(path, unit, tolerance, **bodies);
  });
}

void cw_cad_bodies_free(CwCadBodies **bodies) {
  delete *bodies;
  *bodies = nullptr;
}

int cw_cad_body_count(const CwCadBodies *bodies) {
  return (int)bodies->body.size();
}

const char *cw_cad_body_name(const CwCadBodies *bodies, int body) {
  return bodies->body[body].name.c_str();
}

const char *cw_cad_body_instance(const CwCadBodies *bodies, int body) {
  return bodies->body[body].instance.c_str();
}

CwStatus cw_cad_body_holds(const CwCadBodies *bodies, int body, const double point[3], int *holds) {
  return cw_cad_guard(bodies->body[body].file, [&] {
    const gp_Pnt at(point[0] / millimetre, point[1] / millimetre, point[2] / millimetre);
    BRepClass3d_SolidClassifier classifier(bodies->body[body].solid, at, 1e-6);
    GProp_GProps properties;
    BRepGProp::VolumeProperties(bodies->body[body].solid, properties);
    *holds = classifier.State() == (properties.Mass() < 0 ? TopAbs_OUT : TopAbs_IN); // inside out: heal turns it
    return CW_OK;
  });
}
