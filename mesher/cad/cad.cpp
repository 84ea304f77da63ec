// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/cad.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <unistd.h>

#include <BRepGProp_Domain.hxx>
#include <BRepGProp_Face.hxx>
#include <BRepGProp_Vinert.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Lin.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>

#include "mesher/cad/cad_shape.h"
#include "mesher/cad/cad_unit.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/ranks.h"

static const double least_tolerance = 1e-9; // of the model's unit
static const double same_parameter = 1e-9;  // of the range of an edge
enum { BOX_PARTS = 8, SEARCH_PARTS = 12 };  // of an edge; of a face along u and v
static const double pcurve_tolerance =
    1e-4; // in units of the B-rep: past it the point of an edge is projected onto its face

static CwStatus open_cad(const std::string &folder, const char *domain, CwCad *cad) {
  std::string path = folder + "/" + domain + ".brep";
  CwStatus status = cw_cad_unit_read(folder.c_str(), &cad->metres);
  if (status != CW_OK) return status;
  cad->unit = cad->metres;
  status = cw_cad_read_shape(path.c_str(), cad);
  if (status != CW_OK) return status;
  status = cw_face_table_read((folder + "/faces.csv").c_str(), domain, cad->face_map.Extent(), &cad->table);
  if (status != CW_OK) return status;
  return cw_cad_read_parts(cad);
}

CwStatus cw_cad_open(const char *geometry_dir, const char *domain, CwCad **cad) {
  CwStatus status = CW_OK;
  *cad = nullptr;
  try {
    *cad = new CwCad();
    status = open_cad(geometry_dir, domain, *cad);
  } catch (const Standard_Failure &failure) {
    const char *text = failure.GetMessageString();
    status = CW_FAIL(CW_ERR_LIBRARY, "%s/%s.brep: OpenCASCADE failed: %s", geometry_dir, domain, text ? text : "?");
  } catch (const std::exception &failure) {
    status = CW_FAIL(CW_ERR_LIBRARY, "%s/%s.brep: %s", geometry_dir, domain, failure.what());
  }
  if (status != CW_OK) cw_cad_close(cad);
  return status;
}

void cw_cad_close(CwCad **cad) {
  if (!*cad) return;
  cw_face_table_free(&(*cad)->table);
  delete *cad;
  *cad = nullptr;
}

void cw_cad_add_to_box(const CwCad *cad, CwBox *box) {
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    const double *range = cad->edge[e].range;
    for (int i = 0; i <= BOX_PARTS; i++) {
      double x[3];
      cw_cad_edge_point(cad, e, range[0] + (range[1] - range[0]) * i / BOX_PARTS, x, nullptr);
      cw_box_add_point(box, x);
    }
  }
}

double cw_cad_tolerance(const CwCad *cad) {
  double most = 0;
  for (int i = 1; i <= cad->vertex_map.Extent(); i++)
    most = std::max(most, BRep_Tool::Tolerance(TopoDS::Vertex(cad->vertex_map(i))));
  for (int i = 1; i <= cad->edge_map.Extent(); i++)
    most = std::max(most, BRep_Tool::Tolerance(TopoDS::Edge(cad->edge_map(i))));
  return std::max(least_tolerance, most * cad->unit);
}

int cw_cad_patch_count(const CwCad *cad) {
  return cad->table.patch_count;
}

const char *cw_cad_patch_name(const CwCad *cad, int patch) {
  return cad->table.patch[patch].name;
}

CwPatchKind cw_cad_patch_kind(const CwCad *cad, int patch) {
  return cad->table.patch[patch].kind;
}

int cw_cad_face_count(const CwCad *cad) {
  return cad->table.face_count;
}

int cw_cad_face_patch(const CwCad *cad, int face) {
  return cad->table.face[face].patch;
}

const char *cw_cad_face_name(const CwCad *cad, int face) {
  return cad->table.face[face].name;
}

int cw_cad_face_is_wall(const CwCad *cad, int face) {
  return cad->table.patch[cad->table.face[face].patch].kind == CW_PATCH_WALL;
}

int cw_cad_face_reversed(const CwCad *cad, int face) {
  return cad->face[face].reversed;
}

void cw_cad_turn(CwCad *cad) {
  cad->inside_out = !cad->inside_out;
  for (CwCadFace &face : cad->face) face.reversed = !face.reversed;
}

static void to_metres(const CwCad *cad, const gp_XYZ &p, double x[3]) {
  x[0] = p.X() * cad->unit;
  x[1] = p.Y() * cad->unit;
  x[2] = p.Z() * cad->unit;
}

// Evaluates a face or an edge of it. OpenCASCADE fails at singular points, as of an offset surface whose base has no
// normal; then there is nothing to go on with, and the one error line, with the face's place, ends all ranks.
template <class Work> static void evaluate(const CwCad *cad, int face, const Work &work) {
  try {
    work();
  } catch (const Standard_Failure &failure) {
    _exit(cw_mpi_fail(nullptr, cw_cad_face_failure(cad, face, failure)));
  }
}

void cw_cad_face_point(const CwCad *cad, int face, const double uv[2], double x[3], double xu[3], double xv[3]) {
  const CwCadFace &f = cad->face[face];
  gp_Pnt p;
  gp_Vec first[2];
  evaluate(cad, face, [&] {
    if (!xu && !xv)
      p = f.point(uv);
    else
      f.derive(uv, p, first, nullptr);
  });
  if (xu) to_metres(cad, first[0].XYZ(), xu);
  if (xv) to_metres(cad, first[1].XYZ(), xv);
  to_metres(cad, p.XYZ(), x);
}

void cw_cad_face_normal(const CwCad *cad, int face, const double uv[2], double n[3]) {
  double x[3], xu[3], xv[3];
  cw_cad_face_point(cad, face, uv, x, xu, xv);
  cw_cross(xu, xv, n);
  cw_unit(n);
  for (int k = 0; k < 3 && cw_cad_face_reversed(cad, face); k++) n[k] = -n[k];
}

double cw_cad_face_volume(const CwCad *cad, int face) {
  try {
    const TopoDS_Face &shape = TopoDS::Face(cad->face_map(face + 1));
    BRepGProp_Face integrand(shape);
    BRepGProp_Domain edges(shape);
    double volume = BRepGProp_Vinert(integrand, edges, gp_Pnt(0, 0, 0)).Mass();
    return (cad->inside_out ? -volume : volume) * cad->unit * cad->unit * cad->unit;
  } catch (const Standard_Failure &) {
    return 0;
  }
}

double cw_cad_face_curvature(const CwCad *cad, int face, const double uv[2], double *lesser) {
  const CwCadFace &f = cad->face[face];
  if (lesser) *lesser = 0;
  if (f.surface.GetType() == GeomAbs_Plane) return 0;
  gp_Pnt p;
  gp_Vec first[2];
  CwCadSecond second;
  evaluate(cad, face, [&] { f.derive(uv, p, first, &second); });
  const gp_Vec &su = first[0], &sv = first[1], &suu = second.uu, &svv = second.vv, &suv = second.uv;
  gp_Vec normal = su.Crossed(sv);
  double area = normal.Magnitude();
  // A pole has no curvature of its own.
  if (!(area > 1e-12 * su.Magnitude() * sv.Magnitude()) || !(area > 0)) return 0;
  // Principal curvatures from the fundamental forms: mean H and Gauss K, k = H +- sqrt(H^2 - K).
  double e = su.SquareMagnitude(), g = sv.SquareMagnitude(), m = su.Dot(sv), det = e * g - m * m;
  double l = suu.Dot(normal) / area, n = svv.Dot(normal) / area, k = suv.Dot(normal) / area;
  double mean = (e * n - 2 * m * k + g * l) / (2 * det);
  double gauss = (l * n - k * k) / det;
  double apart = std::sqrt(std::max(0.0, mean * mean - gauss));
  double sign = (mean > 0) != (cw_cad_face_reversed(cad, face) != 0) ? 1 : -1;
  if (lesser) *lesser = sign * (std::fabs(mean) - apart) / cad->unit;
  return sign * ((std::fabs(mean) + apart) / cad->unit);
}

// One damped Newton step for the nearest point, in the B-rep's unit: from u, v with the vector d from x to the surface.
static void nearest_step(const gp_Vec &d, const gp_Vec first[2], const CwCadSecond &second, const bool fixed[2],
                         double step[2]) {
  const gp_Vec &su = first[0], &sv = first[1];
  double gu = d.Dot(su), gv = d.Dot(sv);
  double a = su.Dot(su) + d.Dot(second.uu), b = su.Dot(sv) + d.Dot(second.uv), c = sv.Dot(sv) + d.Dot(second.vv);
  if (!(a > 0 && c > 0 && a * c - b * b > 1e-6 * a * c)) {
    // Not convex here: Gauss-Newton, kept from being singular.
    a = su.Dot(su) * (1 + 1e-9) + 1e-30;
    b = su.Dot(sv);
    c = sv.Dot(sv) * (1 + 1e-9) + 1e-30;
  }
  double det = a * c - b * b;
  step[0] = fixed[0] ? 0 : fixed[1] ? -gu / a : -(c * gu - b * gv) / det;
  step[1] = fixed[1] ? 0 : fixed[0] ? -gv / c : -(a * gv - b * gu) / det;
}

static bool pushes_out(double value, const double range[2], double gradient) {
  return (value <= range[0] && gradient > 0) || (value >= range[1] && gradient < 0);
}

// Nearest point by Newton from `at`, which it updates; returns the distance, in the B-rep's unit.
static double nearest_of(const CwCadFace &f, const gp_Pnt &target, double at[2]) {
  f.keep_in_ranges(at);
  gp_Pnt p;
  gp_Vec first[2];
  CwCadSecond second;
  f.derive(at, p, first, &second);
  double distance = p.Distance(target);
  for (int iteration = 0; iteration < 50 && distance > 0; iteration++) {
    gp_Vec d(target, p);
    bool fixed[2] = {!f.pole.is && pushes_out(at[0], f.u_range, d.Dot(first[0])),
                     !f.pole.is && pushes_out(at[1], f.v_range, d.Dot(first[1]))};
    double step[2];
    nearest_step(d, first, second, fixed, step);
    double moved = (first[0] * step[0] + first[1] * step[1]).Magnitude();
    if (!(moved > 1e-11)) break; // of the B-rep's unit
    bool nearer = false;
    for (int halving = 0; halving < 12 && !nearer; halving++, step[0] /= 2, step[1] /= 2) {
      double next[2] = {at[0] + step[0], at[1] + step[1]};
      f.keep_in_ranges(next);
      if (f.point(next).Distance(target) >= distance) continue;
      nearer = true;
      std::copy(next, next + 2, at);
    }
    if (!nearer) break;
    f.derive(at, p, first, &second);
    distance = p.Distance(target);
  }
  return distance;
}

double cw_cad_face_project(const CwCad *cad, int face, const double x[3], double uv[2]) {
  const gp_Pnt target(x[0] / cad->unit, x[1] / cad->unit, x[2] / cad->unit);
  double distance = 0;
  evaluate(cad, face, [&] { distance = nearest_of(cad->face[face], target, uv); });
  return distance * cad->unit;
}

// From the nearest of some places all over the face.
static double searched_distance(const CwCad *cad, int face, const double x[3]) {
  double range[4], nearest[2] = {0, 0}, best = INFINITY;
  BRepTools::UVBounds(TopoDS::Face(cad->face_map(face + 1)), range[0], range[1], range[2], range[3]);
  for (int i = 0; i <= SEARCH_PARTS; i++) {
    for (int j = 0; j <= SEARCH_PARTS; j++) {
      double uv[2] = {range[0] + (range[1] - range[0]) * i / SEARCH_PARTS,
                      range[2] + (range[3] - range[2]) * j / SEARCH_PARTS},
             p[3];
      if (cad->face[face].pole.is) cad->face[face].pole.to_plane(uv);
      cw_cad_face_point(cad, face, uv, p, nullptr, nullptr);
      double distance = cw_distance(p, x);
      if (distance >= best) continue;
      best = distance;
      std::copy(uv, uv + 2, nearest);
    }
  }
  return cw_cad_face_project(cad, face, x, nearest);
}

double cw_cad_face_distance(const CwCad *cad, int face, const double x[3]) {
  const GeomAdaptor_Surface &surface = cad->face[face].surface;
  const gp_Pnt p(x[0] / cad->unit, x[1] / cad->unit, x[2] / cad->unit);
  switch (surface.GetType()) {
  case GeomAbs_Plane:
    return surface.Plane().Distance(p) * cad->unit;
  case GeomAbs_Cylinder:
    return std::fabs(gp_Lin(surface.Cylinder().Axis()).Distance(p) - surface.Cylinder().Radius()) * cad->unit;
  case GeomAbs_Sphere:
    return std::fabs(surface.Sphere().Location().Distance(p) - surface.Sphere().Radius()) * cad->unit;
  default:
    return searched_distance(cad, face, x);
  }
}

int cw_cad_edge_count(const CwCad *cad) {
  return (int)cad->edge.size();
}

void cw_cad_edge_range(const CwCad *cad, int edge, double t[2]) {
  t[0] = cad->edge[edge].range[0];
  t[1] = cad->edge[edge].range[1];
}

void cw_cad_edge_vertices(const CwCad *cad, int edge, int vertex[2]) {
  vertex[0] = cad->edge[edge].vertex[0];
  vertex[1] = cad->edge[edge].vertex[1];
}

void cw_cad_edge_faces(const CwCad *cad, int edge, int face[2]) {
  face[0] = cad->edge[edge].face[0];
  face[1] = cad->edge[edge].face[1];
}

// The end of an edge that lies at t, if it was brought to another vertex; else -1.
static int moved_end(const CwCadEdge &e, double t) {
  for (int end = 0; end < 2; end++) {
    if (e.moved[end].is && std::fabs(t - e.range[end]) <= same_parameter * (e.range[1] - e.range[0])) return end;
  }
  return -1;
}

void cw_cad_edge_point(const CwCad *cad, int edge, double t, double x[3], double xt[3]) {
  const CwCadEdge &e = cad->edge[edge];
  gp_Pnt p;
  gp_Vec tangent;
  evaluate(cad, e.face[0], [&] {
    if (xt)
      e.curve.D1(e.knots.snap(t), p, tangent);
    else
      e.curve.D0(e.knots.snap(t), p);
  });
  if (xt) to_metres(cad, tangent.XYZ(), xt);
  int end = moved_end(e, t);
  if (end >= 0) p = cad->vertex[e.vertex[end]];
  to_metres(cad, p.XYZ(), x);
}

// (u,v) of an edge on a face that it lies on; `moved`: an end that was brought to another vertex, or -1.
static void uv_on_face(const CwCad *cad, const CwCadEdge &e, int side, double t, int moved, double uv[2]) {
  const int face = e.face[side];
  gp_Pnt2d p;
  gp_Pnt at;
  evaluate(cad, face, [&] {
    e.pcurve[side].D0(e.pcurve_knots[side].snap(t), p);
    e.curve.D0(e.knots.snap(t), at);
  });
  uv[0] = p.X();
  uv[1] = p.Y();
  if (cad->face[face].pole.is) cad->face[face].pole.to_plane(uv);
  if (moved >= 0 && e.moved[moved].slides[side]) at = cad->vertex[e.vertex[moved]];
  double on_edge[3], on_face[3];
  to_metres(cad, at.XYZ(), on_edge);
  cw_cad_face_point(cad, face, uv, on_face, nullptr, nullptr);
  double off = std::hypot(on_edge[0] - on_face[0], on_edge[1] - on_face[1], on_edge[2] - on_face[2]);
  if (off > pcurve_tolerance * cad->unit) cw_cad_face_project(cad, face, on_edge, uv);
}

void cw_cad_edge_uv(const CwCad *cad, int edge, int face, double t, double uv[2]) {
  const CwCadEdge &e = cad->edge[edge];
  int side = e.face[0] == face ? 0 : 1;
  if (e.replaced && e.replaced->side == side) {
    const CwCadEdge &other = *e.replaced->edge;
    uv_on_face(cad, other, other.face[0] == face ? 0 : 1,
               e.replaced->parameter((t - e.range[0]) / (e.range[1] - e.range[0])), -1, uv);
  } else {
    uv_on_face(cad, e, side, t, moved_end(e, t), uv);
  }
}

int cw_cad_vertex_count(const CwCad *cad) {
  return (int)cad->vertex.size();
}

void cw_cad_vertex_point(const CwCad *cad, int vertex, double x[3]) {
  to_metres(cad, cad->vertex[vertex].XYZ(), x);
}
