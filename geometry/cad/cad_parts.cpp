// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_parts.h"

#include <cmath>
#include <memory>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <Bnd_Box.hxx>
#include <gp_Ax3.hxx>
#include <gp_Trsf.hxx>

#include "geometry/cad/cad_part.hpp"
#include "geometry/solid.hpp"

namespace {

const double millimetre = 1e-3; // m

gp_Trsf to_pump(const CwCadFrame &frame) {
  const auto point = [](const double *x, double by) { return gp_Pnt(by * x[0], by * x[1], by * x[2]); };
  const auto along = [](const double *x) { return gp_Dir(x[0], x[1], x[2]); };
  gp_Trsf motion;
  motion.SetTransformation(gp_Ax3(point(frame.origin, 1 / millimetre), along(frame.axis[2]), along(frame.axis[0])));
  return motion;
}

TopoDS_Shape moved(const TopoDS_Shape &shape, const gp_Trsf &motion) {
  return BRepBuilderAPI_Transform(shape, motion, Standard_True).Shape();
}

// Half the extent across the axis, mm.
double radius_of(const TopoDS_Shape &shape) {
  Bnd_Box bounds;
  double x0, y0, z0, x1, y1, z1;
  BRepBndLib::AddOptimal(shape, bounds, Standard_False, Standard_False);
  bounds.Get(x0, y0, z0, x1, y1, z1);
  return std::max(std::max(std::fabs(x0), std::fabs(x1)), std::max(std::fabs(y0), std::fabs(y1)));
}

// A body in the pump's coordinates, mm, as a part of its own. `number`: of the body, from 1.
CwCadPart placed(const CwCadBody &body, size_t number, const CwCadFrame &frame, const std::string &domain, int &faces) {
  const std::string name = body.name.empty() ? "" : " '" + body.name + "'";
  CwCadPart part = {domain, body.solid, body.origin, "solid " + std::to_string(number) + name + " of " + body.file};
  for (CwCadFaceOrigin &origin : part.origin) origin.number = faces++;
  if (!frame.same || !body.solid.Location().IsIdentity()) {
    part.solid = moved(body.solid, frame.same ? gp_Trsf() : to_pump(frame));
  }
  return part;
}

CwStatus fuse(CwCadPart &part, const CwCadPart &other) {
  BRepAlgoAPI_Fuse fusion(part.solid, other.solid);
  int solids = 0;
  TopoDS_Shape whole;
  for (TopExp_Explorer at(fusion.Shape(), TopAbs_SOLID); at.More(); at.Next(), solids++) whole = at.Current();
  if (fusion.HasErrors() || solids != 1)
    return CW_FAIL(
        CW_ERR_GEOMETRY,
        "cad.domains.%s: its solids do not make one when they are fused, but %d; allowed: solids that touch, "
        "or a domain for each",
        part.domain.c_str(), solids);
  CwCadPart fused = {part.domain, whole, {}, part.from + " and " + other.from};
  cw_cad_carry({part, other}, fused);
  part = fused;
  return CW_OK;
}

// `file`: of the part that reaches farthest.
CwStatus check_size(const std::string &file, double radius) {
  if (!(radius > 0)) return CW_FAIL(CW_ERR_INPUT, "cad.domains: none rotates; allowed: rotating: true in the wheel's");
  if (radius * millimetre > 5 || radius * millimetre < 2.5e-3)
    return CW_FAIL(
        CW_ERR_INPUT,
        "cad.files: the rotating domain reaches %.6g mm from the axis, so that the wheel would have a diameter "
        "of %.4g m; allowed: 5 mm to 10 m; where %s has another unit give cad.unit_mm, such as %s",
        radius, 2 * radius * millimetre, file.c_str(), radius > 5e3 ? "1 for millimetres" : "1000 for metres");
  return CW_OK;
}

} // namespace

CwStatus cw_cad_parts_make(const CwCaseCad *cad, const CwCadFrame *frame, const CwCadBodies *bodies, const int *domain,
                           CwCadParts **parts) {
  *parts = new CwCadParts{millimetre, {}};
  return cw_cad_guard("cad.domains", [&]() -> CwStatus {
    CwStatus status = CW_OK;
    double radius = 0;
    std::string file;
    int faces = 0;
    for (int d = 0; d < cad->domain_count; d++) {
      bool begun = false;
      std::string its_file;
      for (size_t i = 0; i < bodies->body.size(); i++) {
        if (domain[i] != d) continue;
        const CwCadPart part = placed(bodies->body[i], i + 1, *frame, cad->domain[d].name, faces);
        if (begun) {
          status = fuse((*parts)->part.back(), part);
          if (status != CW_OK) return status;
        } else {
          (*parts)->part.push_back(part);
        }
        begun = true;
        its_file = bodies->body[i].file;
      }
      if (!cad->domain[d].rotating) continue;
      const double reach = radius_of((*parts)->part.back().solid);
      if (reach > radius) radius = reach, file = its_file;
    }
    status = check_size(file, radius);
    if (status != CW_OK) return status;
    (*parts)->unit = cw_solid_unit_of_drawing(2 * radius * millimetre);
    const double factor = millimetre / (*parts)->unit;
    gp_Trsf scale;
    scale.SetScale(gp_Pnt(0, 0, 0), factor);
    for (CwCadPart &part : (*parts)->part)
      if (factor != 1) part.solid = moved(part.solid, scale);
    return CW_OK;
  });
}

void cw_cad_parts_free(CwCadParts **parts) {
  delete *parts;
  *parts = nullptr;
}

int cw_cad_part_count(const CwCadParts *parts) {
  return (int)parts->part.size();
}

double cw_cad_parts_unit(const CwCadParts *parts) {
  return parts->unit;
}

int cw_cad_part_face_count(const CwCadParts *parts, int part) {
  return (int)parts->part[part].origin.size();
}

CwCadFaceInfo cw_cad_part_face(const CwCadParts *parts, int part, int face) {
  const CwCadFaceOrigin &of = parts->part[part].origin[face];
  return {of.name.c_str(), of.colour, of.number};
}

const char *cw_cad_part_face_layer(const CwCadParts *parts, int part, int face, int i) {
  const std::vector<std::string> &layers = parts->part[part].origin[face].layers;
  return i < (int)layers.size() ? layers[i].c_str() : nullptr;
}

CwStatus cw_cad_part_solid(const CwCadParts *parts, int part, const char *const *patch, const CwPatchKind *kind,
                           CwSolid **solid) {
  const CwCadPart &of = parts->part[part];
  return cw_cad_guard("cad.domains." + of.domain, [&] {
    std::unique_ptr<CwSolid> made(new CwSolid);
    made->domain = of.domain;
    made->unit = parts->unit;
    made->solid = TopoDS::Solid(of.solid);
    const TopTools_IndexedMapOfShape map = cw_cad_faces(of.solid);
    for (int i = 0; i < map.Extent(); i++)
      made->faces.push_back({TopoDS::Face(map(i + 1)), patch[i], kind[i], of.domain + "_" + std::to_string(i + 1)});
    *solid = made.release();
    return CW_OK;
  });
}
