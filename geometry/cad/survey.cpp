// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <gp_Vec.hxx>

#include "geometry/cad/cad_part.hpp"
#include "geometry/cad/face_distance.hpp"
#include "geometry/edge_angle.hpp"

struct CwSurveyData {
  double unit; // m
  std::deque<CwFaceDistance> part;
  std::vector<CwSurveyFace> face;
  std::vector<CwSurveyEdge> edge;
  std::vector<std::array<int, 3>> triangle;
  std::vector<std::array<double, 3>> point;
  std::vector<CwSurveySample> sample;
  std::vector<CwSurveySegment> segment;
  int bare = -1; // the first face without triangles
  std::vector<std::array<double, 6>> box;
};

namespace {

const double DEFLECTION = 1e-3;  // of the size, chord to surface
const double AREA = 1e-5;        // relative error of areas
const double ANGLE = 0.35;       // rad, between neighbouring chords
const double CORNER = 0.95;      // of the way from the middle of a triangle to its corners
const int TRIANGLES = 24;        // that are sampled on a face, about
const double SAME_NORMAL = 1e-5; // sine of the angle within which normals are alike

std::array<double, 3> metres(const gp_Pnt &p, double unit) {
  return {p.X() * unit, p.Y() * unit, p.Z() * unit};
}

void put(const gp_Pnt &p, double unit, double x[3]) {
  const std::array<double, 3> at = metres(p, unit);
  std::copy(at.begin(), at.end(), x);
}

// Unit normal out of the part; false where the face has none.
bool normal_at(const BRepAdaptor_Surface &surface, bool reversed, const gp_Pnt2d &uv, gp_Vec &normal) {
  gp_Pnt point;
  gp_Vec du, dv;
  surface.D1(uv.X(), uv.Y(), point, du, dv);
  normal = du.Crossed(dv);
  if (!(normal.Magnitude() > 1e-12 * du.Magnitude() * dv.Magnitude()) || normal.Magnitude() == 0) return false;
  normal.Normalize();
  if (reversed) normal.Reverse();
  return true;
}

struct Normals {
  gp_Vec first, sum;
  double most_off = 0;   // from the first
  double most_twist = 0; // |normal times direction of rotation|
  double twist = 0, area = 0;
  void add(const gp_Pnt &at, const gp_Vec &normal, double weight) {
    if (area == 0) first = normal;
    const gp_Vec around = gp_Vec(-at.Y(), at.X(), 0);
    const double along = around.Magnitude() > 0 ? normal.Dot(around) / around.Magnitude() : 0;
    most_off = std::max(most_off, normal.Crossed(first).Magnitude() + (normal.Dot(first) < 0 ? 2 : 0));
    most_twist = std::max(most_twist, std::fabs(along));
    twist += weight * along;
    sum += normal * weight;
    area += weight;
  }
};

// Of the points the nearest that lies on the face; of a ring narrower than its chords are deep another one.
template <class OnFace>
gp_Pnt point_of(const TopoDS_Face &face, const BRepAdaptor_Surface &surface, const gp_Pnt &centre,
                std::vector<std::pair<double, gp_XY>> &by_distance, const OnFace &on_face) {
  std::stable_sort(by_distance.begin(), by_distance.end(),
                   [](const auto &a, const auto &b) { return a.first < b.first; });
  for (const auto &[distance, uv] : by_distance)
    if (on_face(uv)) return surface.Value(uv.X(), uv.Y());
  gp_Pnt inside = centre;
  cw_cad_inner_point(face, inside);
  return inside;
}

void add_face(const TopoDS_Face &face, int part, int index, double unit, CwSurveyData &lists) {
  CwSurveyFace made = {};
  made.part = part;
  made.face = index;
  made.first_triangle = (int)lists.triangle.size();
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties, AREA);
  made.area = std::fabs(properties.Mass()) * unit * unit;
  made.mean_radius = unit * std::sqrt(properties.MomentOfInertia(gp::OZ()) / properties.Mass());
  put(properties.CentreOfMass(), unit, made.centre);
  made.radius[0] = made.height[0] = INFINITY;
  made.height[1] = -INFINITY;
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
  const BRepAdaptor_Surface surface(face, Standard_False);
  BRepTopAdaptor_FClass2d outline(face, Precision::PConfusion());
  // Chords of the triangles may leave the face.
  const auto on_face = [&](const gp_XY &uv) { return outline.Perform(gp_Pnt2d(uv)) != TopAbs_OUT; };
  const auto add_sample = [&](const gp_XY &uv) {
    if (!on_face(uv)) return;
    lists.sample.push_back({(int)lists.triangle.size() - 1, {}});
    put(surface.Value(uv.X(), uv.Y()), unit, lists.sample.back().at);
  };
  const bool reversed = face.Orientation() == TopAbs_REVERSED;
  const int first_point = (int)lists.point.size();
  for (int i = 1; i <= mesh->NbNodes(); i++) {
    const std::array<double, 3> x = metres(mesh->Node(i).Transformed(place.Transformation()), unit);
    const double r = std::hypot(x[0], x[1]);
    made.radius[0] = std::min(made.radius[0], r);
    made.radius[1] = std::max(made.radius[1], r);
    made.height[0] = std::min(made.height[0], x[2]);
    made.height[1] = std::max(made.height[1], x[2]);
    lists.point.push_back(x);
  }
  Normals normals;
  std::vector<std::pair<double, gp_XY>> middles; // and their distance from the centre
  const int step = std::max(1, mesh->NbTriangles() / TRIANGLES);
  made.first_sample = (int)lists.sample.size();
  for (int i = 1; i <= mesh->NbTriangles(); i++) {
    int n[3];
    mesh->Triangle(i).Get(n[0], n[1], n[2]);
    if (reversed) std::swap(n[1], n[2]);
    lists.triangle.push_back({first_point + n[0] - 1, first_point + n[1] - 1, first_point + n[2] - 1});
    gp_XY uv(0, 0);
    gp_Pnt p[3];
    for (int k = 0; k < 3; k++) uv += mesh->UVNode(n[k]).XY() / 3, p[k] = mesh->Node(n[k]);
    const gp_Pnt at = surface.Value(uv.X(), uv.Y());
    middles.emplace_back(at.Distance(properties.CentreOfMass()), uv);
    if ((i - 1) % step == 0) {
      add_sample(uv);
      for (int k = 0; k < 3; k++) add_sample(uv * (1 - CORNER) + mesh->UVNode(n[k]).XY() * CORNER);
    }
    gp_Vec normal;
    if (normal_at(surface, reversed, gp_Pnt2d(uv), normal))
      normals.add(at, normal, gp_Vec(p[0], p[1]).Crossed(gp_Vec(p[0], p[2])).Magnitude() / 2);
  }
  made.sample_count = (int)lists.sample.size() - made.first_sample;
  put(point_of(face, surface, properties.CentreOfMass(), middles, on_face), unit, made.at);
  made.triangle_count = mesh->NbTriangles();
  if (normals.area > 0)
    for (int i = 0; i < 3; i++) made.normal[i] = normals.sum.Coord(i + 1) / normals.area;
  if (normals.area > 0) made.twist = normals.twist / normals.area;
  made.turned = normals.most_twist < SAME_NORMAL;
  made.form = normals.most_off < SAME_NORMAL ? CW_FORM_PLANE : made.turned ? CW_FORM_REVOLVED : CW_FORM_OTHER;
  lists.face.push_back(made);
  lists.box.push_back(cw_cad_box(face));
  for (double &x : lists.box.back()) x *= unit;
}

// A face without triangles: a corner of it, and its edges.
void add_outline(const TopoDS_Face &face, int part, int index, double unit, CwSurveyData &lists) {
  constexpr int steps = 16;
  CwSurveyFace made = {};
  made.part = part;
  made.face = index;
  made.first_triangle = (int)lists.triangle.size();
  made.first_sample = (int)lists.sample.size();
  const TopExp_Explorer corner(face, TopAbs_VERTEX);
  if (corner.More()) put(BRep_Tool::Pnt(TopoDS::Vertex(corner.Current())), unit, made.at);
  const int number = (int)lists.face.size();
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next()) {
    if (BRep_Tool::Degenerated(TopoDS::Edge(at.Current()))) continue;
    const std::vector<gp_Pnt> points = cw_cad_edge_points(TopoDS::Edge(at.Current()), steps);
    for (int i = 0; i < steps; i++) {
      CwSurveySegment segment = {number, {}};
      for (int k = 0; k < 2; k++) put(points[i + k], unit, segment.at[k]);
      lists.segment.push_back(segment);
    }
  }
  if (lists.bare < 0) lists.bare = number;
  lists.face.push_back(made);
  lists.box.push_back(cw_cad_box(face));
  for (double &x : lists.box.back()) x *= unit;
}

bool has_triangles(const TopoDS_Face &face) {
  TopLoc_Location place;
  return !BRep_Tool::Triangulation(face, place).IsNull();
}

CwStatus fail_bare(const CwCadParts &parts, const CwCadFrame &frame, const CwSurveyData &lists) {
  const CwSurveyFace &face = lists.face[lists.bare];
  const CwCadPart &part = parts.part[face.part];
  const std::string &name = part.origin[face.face].name;
  return CW_FAIL(CW_ERR_GEOMETRY,
                 "cad.domains.%s: a face with a corner %s cannot be triangulated: face %d%s%s%s; allowed: outlines "
                 "that do not cross themselves; draw it anew",
                 part.domain.c_str(), cw_cad_place(gp_Pnt(face.at[0], face.at[1], face.at[2]), 1, frame).c_str(),
                 lists.bare + 1, name.empty() ? "" : " '", name.c_str(), name.empty() ? "" : "'");
}

void add_edges(const TopoDS_Shape &shape, int first_face, double unit, CwSurveyData &lists) {
  const TopTools_IndexedMapOfShape map = cw_cad_faces(shape);
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); i++) {
    const TopoDS_Edge &edge = TopoDS::Edge(faces.FindKey(i));
    if (BRep_Tool::Degenerated(edge) || faces(i).Extent() != 2) continue;
    const int a = map.FindIndex(faces(i).First()), b = map.FindIndex(faces(i).Last());
    if (a == b) continue;
    GProp_GProps properties;
    BRepGProp::LinearProperties(edge, properties);
    lists.edge.push_back({{first_face + a - 1, first_face + b - 1},
                          properties.Mass() * unit,
                          cw_edge_angle(edge, TopoDS::Face(map(a)), TopoDS::Face(map(b)))});
  }
}

double box_distance(const double box[2][3], const double x[3]) {
  double sum = 0;
  for (int i = 0; i < 3; i++) {
    const double off = std::max(std::max(box[0][i] - x[i], x[i] - box[1][i]), 0.0);
    sum += off * off;
  }
  return std::sqrt(sum);
}

double extent(const CwCadParts &parts) {
  Bnd_Box bounds;
  double x0, y0, z0, x1, y1, z1;
  for (const CwCadPart &part : parts.part) BRepBndLib::Add(part.solid, bounds, Standard_False);
  bounds.Get(x0, y0, z0, x1, y1, z1);
  return std::max(std::max(x1 - x0, y1 - y0), z1 - z0);
}

// Whether a point may be within `reach` of a face: its triangles stand within the deflection of it. Boxes of curved
// faces alone are of no use, for a volute's hold the whole wheel.
bool may_reach(const CwSurvey &survey, const CwSurveyFace &face, const double x[3], double reach) {
  const double far = reach + 2 * DEFLECTION * survey.size;
  for (int t = face.first_triangle; t < face.first_triangle + face.triangle_count; t++) {
    double box[2][3];
    for (int i = 0; i < 3; i++) {
      const double a = survey.point[survey.triangle[t][0]][i], b = survey.point[survey.triangle[t][1]][i],
                   c = survey.point[survey.triangle[t][2]][i];
      box[0][i] = std::min(a, std::min(b, c));
      box[1][i] = std::max(a, std::max(b, c));
    }
    if (box_distance(box, x) < far) return true;
  }
  return false;
}

template <class To, class From> void show(std::vector<From> &list, To *&array, int &count) {
  static_assert(sizeof(To) == sizeof(From), "the same numbers");
  array = reinterpret_cast<To *>(list.data());
  count = (int)list.size();
}

} // namespace

CwStatus cw_survey_make(const CwCadParts *parts, const CwCadFrame *frame, CwSurvey *survey) {
  return cw_cad_guard("cad", [&]() -> CwStatus {
    survey->data = new CwSurveyData;
    CwSurveyData &lists = *survey->data;
    const double size = extent(*parts);
    survey->size = size * parts->unit;
    for (size_t p = 0; p < parts->part.size(); p++) {
      const TopoDS_Shape &solid = parts->part[p].solid;
      const int first = (int)lists.face.size();
      BRepTools::Clean(solid);
      BRepMesh_IncrementalMesh mesh(solid, DEFLECTION * size, Standard_False, ANGLE);
      const TopTools_IndexedMapOfShape faces = cw_cad_faces(solid);
      for (int i = 1; i <= faces.Extent(); i++) {
        const TopoDS_Face &face = TopoDS::Face(faces(i));
        (has_triangles(face) ? add_face : add_outline)(face, (int)p, i - 1, parts->unit, lists);
      }
      BRepTools::Clean(solid); // a stored triangulation would go into the files
      if (lists.bare < 0) add_edges(solid, first, parts->unit, lists);
    }
    int boxes;
    show(lists.face, survey->face, survey->face_count);
    show(lists.edge, survey->edge, survey->edge_count);
    show(lists.triangle, survey->triangle, survey->triangle_count);
    show(lists.point, survey->point, survey->point_count);
    show(lists.sample, survey->sample, survey->sample_count);
    show(lists.segment, survey->segment, survey->segment_count);
    show(lists.box, survey->box, boxes);
    lists.unit = parts->unit;
    if (lists.bare >= 0) return fail_bare(*parts, *frame, lists);
    for (const CwCadPart &part : parts->part) lists.part.emplace_back(part.solid);
    return CW_OK;
  });
}

void cw_survey_free(CwSurvey *survey) {
  delete survey->data;
  *survey = CwSurvey();
}

CwStatus cw_survey_nearest(const CwSurvey *survey, int part, const double point[3], double reach, int *face,
                           double *distance, CwSurveyNext *next) {
  return cw_cad_guard("cad", [&] {
    const double unit = survey->data->unit;
    const gp_Pnt at(point[0] / unit, point[1] / unit, point[2] / unit);
    double best = reach / unit, second = best; // in model units, so that what is not nearer comes back as it is
    int other = -1;
    *face = -1;
    for (int i = 0; i < survey->face_count; i++) {
      const CwSurveyFace &of = survey->face[i];
      const double within = next ? second : best;
      if ((part >= 0 && of.part != part) || box_distance(survey->box[i], point) >= unit * within) continue;
      if (std::isfinite(within) && !may_reach(*survey, of, point, unit * within)) continue;
      const double d = survey->data->part[of.part].at(of.face, at, within);
      const bool same = next && *face >= 0 && next->number[i] == next->number[*face];
      if (d < best) {
        if (!same) second = best, other = *face;
        best = d;
        *face = i;
      } else if (d < second && !same) {
        second = d;
        other = i;
      }
    }
    *distance = unit * best;
    if (next) next->face = other, next->distance = unit * second;
    return CW_OK;
  });
}
