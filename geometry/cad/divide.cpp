// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/divide.h"

#include <cmath>

#include <BRep_Tool.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeExtend.hxx>
#include <ShapeUpgrade_FaceDivide.hxx>
#include <ShapeUpgrade_ShapeDivideAngle.hxx>
#include <ShapeUpgrade_ShapeDivideClosed.hxx>
#include <ShapeUpgrade_SplitSurface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <gp.hxx>
#include <gp_Vec.hxx>
#include <gp_Vec2d.hxx>

#include "geometry/cad/cad_part.hpp"
#include "pipeline/log.h"

namespace {

const double SAME = 1e-7;       // of the face's extent in a parameter
const double STEP = 1e-6;       // of the range of a parameter, to both sides of a knot
const double KINK = M_PI / 180; // rad
enum { SAMPLES = 8 };

int seams(const TopoDS_Shape &shape, TopoDS_Edge *first, int *face) {
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(shape);
  int count = 0;
  for (int i = 1; i <= faces.Extent(); i++)
    for (TopExp_Explorer at(faces(i), TopAbs_EDGE); at.More(); at.Next()) {
      const TopoDS_Edge &edge = TopoDS::Edge(at.Current());
      if (BRep_Tool::Degenerated(edge) || !BRep_Tool::IsClosed(edge, TopoDS::Face(faces(i)))) continue;
      if (!count++) *first = edge, *face = i;
    }
  return count;
}

// Gives a periodic spline the parameters from `first` on: where they are others now, one period further or less.
void begin_at(Geom_BSplineSurface &surface, int along, double first) {
  double range[4];
  surface.Bounds(range[0], range[1], range[2], range[3]);
  const double low = range[2 * along], period = range[2 * along + 1] - low,
               shift = std::floor((first - low) / period) * period, at = first - shift;
  int knot, next;
  if (along) {
    surface.InsertVKnot(at, 1, SAME * period, Standard_False);
    surface.LocateV(at, 2 * SAME * period, knot, next);
    surface.SetVOrigin(knot);
  } else {
    surface.InsertUKnot(at, 1, SAME * period, Standard_False);
    surface.LocateU(at, 2 * SAME * period, knot, next);
    surface.SetUOrigin(knot);
  }
  TColStd_Array1OfReal knots(1, along ? surface.NbVKnots() : surface.NbUKnots());
  along ? surface.VKnots(knots) : surface.UKnots(knots);
  for (double &value : knots) value += shift;
  along ? surface.SetVKnots(knots) : surface.SetUKnots(knots);
}

// Brings the ends of periodic splines to those of the faces on them: ShapeUpgrade makes a piece of a face that goes
// over the end of its surface end there. In place; what lies on the surfaces stays where it is.
void begin_with_faces(const TopoDS_Shape &shape) {
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
    TopLoc_Location location;
    const auto surface =
        Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(at.Current()), location));
    if (surface.IsNull()) continue;
    double range[4], end[4];
    BRepTools::UVBounds(TopoDS::Face(at.Current()), range[0], range[1], range[2], range[3]);
    surface->Bounds(end[0], end[1], end[2], end[3]);
    for (int along = 0; along < 2; along++) {
      const double *of = range + 2 * along, *has = end + 2 * along, least = SAME * (has[1] - has[0]);
      if (!(along ? surface->IsVPeriodic() : surface->IsUPeriodic())) continue;
      if (of[0] < has[0] - least || of[1] > has[1] + least) begin_at(*surface, along, of[0]);
    }
  }
}

// Whether a side of a surface is one point: u (0) or v (1) at `value`, the other from `first` to `last`.
bool is_point(const Geom_Surface &surface, int constant, double value, double first, double last) {
  const auto at = [&](double other) { return constant ? surface.Value(other, value) : surface.Value(value, other); };
  const gp_Pnt begin = at(first);
  for (int i = 1; i <= SAMPLES; i++)
    if (at(first + (last - first) * i / SAMPLES).Distance(begin) > Precision::Confusion()) return false;
  return true;
}

// Parameters u (0) or v (1) inside of a range at which the tangent plane turns by an angle: knots of splines alone can
// have that, and not all that formally might do.
std::vector<double> kinks(const Handle(Geom_Surface) & surface, int along, const double u[2], const double v[2]) {
  std::vector<double> found;
  const GeomAdaptor_Surface adaptor(surface, u[0], u[1], v[0], v[1]);
  const int count = along ? adaptor.NbVIntervals(GeomAbs_C1) : adaptor.NbUIntervals(GeomAbs_C1);
  TColStd_Array1OfReal knots(1, count + 1);
  along ? adaptor.VIntervals(knots, GeomAbs_C1) : adaptor.UIntervals(knots, GeomAbs_C1);
  const double *range = along ? v : u, *across = along ? u : v, step = STEP * (range[1] - range[0]);
  for (int i = 2; i <= count; i++) {
    double most = 0;
    for (int k = 0; k <= SAMPLES; k++) {
      gp_Vec tangent[2], other;
      gp_Pnt at;
      const double w = across[0] + (across[1] - across[0]) * k / SAMPLES;
      for (int side = 0; side < 2; side++) {
        const double t = knots(i) + (side ? step : -step);
        along ? surface->D1(w, t, at, other, tangent[side]) : surface->D1(t, w, at, tangent[side], other);
      }
      if (std::min(tangent[0].Magnitude(), tangent[1].Magnitude()) > gp::Resolution())
        most = std::max(most, tangent[0].Angle(tangent[1]));
    }
    if (most > KINK) found.push_back(knots(i));
  }
  return found;
}

// Cuts a surface at its kinks, and midway between its poles: sides of it that are points lie opposite or side by side.
class SimplePieces : public ShapeUpgrade_SplitSurface {
public:
  void Compute(const Standard_Boolean) override {
    const double u[] = {myUSplitValues->First(), myUSplitValues->Last()},
                 v[] = {myVSplitValues->First(), myVSplitValues->Last()};
    for (const double at : kinks(mySurface, 0, u, v)) add(myUSplitValues, at);
    for (const double at : kinks(mySurface, 1, u, v)) add(myVSplitValues, at);
    const int at_u = is_point(*mySurface, 0, u[0], v[0], v[1]) + is_point(*mySurface, 0, u[1], v[0], v[1]);
    const int at_v = is_point(*mySurface, 1, v[0], u[0], u[1]) + is_point(*mySurface, 1, v[1], u[0], u[1]);
    if (at_u + at_v >= 2 && at_v >= 1 && myVSplitValues->Length() == 2) add(myVSplitValues, (v[0] + v[1]) / 2);
    if (at_u == 2 && myUSplitValues->Length() == 2) add(myUSplitValues, (u[0] + u[1]) / 2);
  }

private:
  void add(const Handle(TColStd_HSequenceOfReal) & values, double at) {
    values->InsertBefore(values->Length(), at);
    myStatus = ShapeExtend::EncodeStatus(ShapeExtend_DONE1);
  }
};

class PiecesTool : public ShapeUpgrade_ShapeDivide {
public:
  explicit PiecesTool(const TopoDS_Shape &shape) : ShapeUpgrade_ShapeDivide(shape) {}

protected:
  Handle(ShapeUpgrade_FaceDivide) GetSplitFaceTool() const override {
    const Handle(ShapeUpgrade_FaceDivide) tool = new ShapeUpgrade_FaceDivide;
    tool->SetSplitSurfaceTool(new SimplePieces);
    return tool;
  }
};

// Whether a face has more poles than one: degenerate edges that are lines in its parameters.
bool has_several_poles(const TopoDS_Face &face, TopoDS_Edge *first) {
  double range[4];
  int count = 0;
  BRepTools::UVBounds(face, range[0], range[1], range[2], range[3]);
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
    double begin, end;
    const TopoDS_Edge &edge = TopoDS::Edge(at.Current());
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, begin, end);
    if (!BRep_Tool::Degenerated(edge) || curve.IsNull()) continue;
    const gp_Vec2d run(curve->Value(begin), curve->Value(end));
    const double share[] = {std::fabs(run.X()) / (range[1] - range[0]), std::fabs(run.Y()) / (range[3] - range[2])};
    if (std::max(share[0], share[1]) <= SAME) continue;
    *first = edge;
    count++;
  }
  return count > 1;
}

int several_poles(const TopoDS_Shape &shape, TopoDS_Edge *first, int *face) {
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(shape);
  int count = 0;
  for (int i = faces.Extent(); i >= 1; i--)
    if (has_several_poles(TopoDS::Face(faces(i)), first)) count++, *face = i;
  return count;
}

bool has_kinks(const TopoDS_Shape &shape) {
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
    double u[2], v[2];
    BRepTools::UVBounds(TopoDS::Face(at.Current()), u[0], u[1], v[0], v[1]);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(at.Current()));
    for (int along = 0; along < 2; along++)
      if (!kinks(surface, along, u, v).empty()) return true;
  }
  return false;
}

CwStatus fail_at(const CwCadPart &part, const CwCadFrame &frame, double unit, const TopoDS_Edge &edge, int face,
                 const char *what) {
  const TopoDS_Vertex vertex = TopExp::FirstVertex(edge);
  const gp_Pnt at = vertex.IsNull() ? gp_Pnt() : BRep_Tool::Pnt(vertex);
  const std::string &name = part.origin[face - 1].name;
  return CW_FAIL(CW_ERR_GEOMETRY,
                 "cad.domains.%s: a face%s %s %s; allowed: faces with edges all around; split it in CAD",
                 part.domain.c_str(), name.empty() ? "" : (", '" + name + "',").c_str(), what,
                 cw_cad_place(at, unit, frame).c_str());
}

void replace(CwCadPart &part, const TopoDS_Shape &shape) {
  TopExp_Explorer solid(shape, TopAbs_SOLID);
  if (!solid.More())
    throw Standard_Failure("no solid is left when its closed or kinked faces are divided; split them in CAD");
  const TopoDS_Shape made = solid.Current();
  if (!BRepCheck_Analyzer(made).IsValid()) { // ends of lunes: their edges' parameters do not fit
    BRepLib::SameParameter(made, Precision::Confusion(), Standard_True);
  }
  cw_cad_replace(made, part);
}

CwStatus divide_part(int pieces, const CwCadFrame &frame, CwLog *log, double unit, CwCadPart &part) {
  TopoDS_Edge edge;
  int face = 0;
  const int before = cw_cad_faces(part.solid).Extent();
  begin_with_faces(part.solid);
  if (several_poles(part.solid, &edge, &face) || has_kinks(part.solid)) {
    PiecesTool divide(part.solid);
    divide.Perform();
    replace(part, divide.Result());
  }
  if (seams(part.solid, &edge, &face)) {
    ShapeUpgrade_ShapeDivideClosed divide(part.solid);
    divide.SetNbSplitPoints(std::max(pieces, 2) - 1);
    divide.Perform();
    replace(part, divide.Result());
  }
  if (seams(part.solid, &edge, &face)) { // a sphere of Ball.brep in occt-misc keeps one
    ShapeUpgrade_ShapeDivideAngle divide(2 * M_PI / std::max(pieces, 2), part.solid);
    divide.Perform();
    replace(part, divide.Result());
  }
  const int after = cw_cad_faces(part.solid).Extent();
  if (after != before)
    cw_log(log, "%s: closed and kinked faces divided, %d faces where the file has %d", part.domain.c_str(), after,
           before);
  if (seams(part.solid, &edge, &face)) return fail_at(part, frame, unit, edge, face, "stays closed upon itself");
  if (several_poles(part.solid, &edge, &face)) return fail_at(part, frame, unit, edge, face, "has several poles, one");
  return CW_OK;
}

} // namespace

CwStatus cw_cad_divide(const int *pieces, const CwCadFrame *frame, CwLog *log, CwCadParts *parts) {
  for (size_t i = 0; i < parts->part.size(); i++) {
    CwCadPart &part = parts->part[i];
    const CwStatus status = cw_cad_guard("cad.domains." + part.domain,
                                         [&] { return divide_part(pieces[i], *frame, log, parts->unit, part); });
    if (status != CW_OK) return status;
  }
  return CW_OK;
}
