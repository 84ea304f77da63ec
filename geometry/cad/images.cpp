// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/images.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Tool.hxx>
#include <gp.hxx>

#include "geometry/cad/cad_part.hpp"
#include "geometry/cad/face_distance.hpp"

namespace {

const int EDGE_STEPS = 8, FACE_LATTICE = 8;
const size_t FACE_SAMPLES = 9;

double distance(const gp_Pnt &point, const TopoDS_Shape &shape) {
  BRepExtrema_DistShapeShape extrema(BRepBuilderAPI_MakeVertex(point).Vertex(), shape);
  return extrema.IsDone() ? extrema.Value() : INFINITY;
}

std::string fails(const char *what, const gp_Pnt &at, double off, double unit) {
  char text[240];
  if (std::isfinite(off))
    snprintf(text, sizeof text, "%s at radius %.3f, z %.3f mm is %.3g mm off its image", what,
             1e3 * unit * std::hypot(at.X(), at.Y()), 1e3 * unit * at.Z(), 1e3 * unit * off);
  else
    snprintf(text, sizeof text, "%s at radius %.3f, z %.3f mm has no image", what,
             1e3 * unit * std::hypot(at.X(), at.Y()), 1e3 * unit * at.Z());
  return text;
}

std::set<int> images_of(const std::set<int> &items, const std::vector<int> &next) {
  std::set<int> found;
  for (const int item : items) found.insert(next[item]);
  return found;
}

// Sets of `count` items, or of one where that is allowed, from `next`. False where they do not close.
bool close_sets(int count, bool allow_fixed, CwImageSet &set) {
  const int items = (int)set.next.size();
  set.first.assign(items, -1);
  set.turns.assign(items, 0);
  for (int i = 0; i < items; i++) {
    if (set.first[i] >= 0) continue;
    int size = 0, item = i;
    do {
      if (set.first[item] >= 0 || size == count) return false;
      set.first[item] = i;
      set.turns[item] = size++;
      item = set.next[item];
    } while (item != i);
    if (size != count && !(allow_fixed && size == 1)) return false;
  }
  return true;
}

// `item` becomes the first of its set.
void put_first(int item, CwImageSet &set) {
  int turns = 0, i = item;
  do {
    set.first[i] = item;
    set.turns[i] = turns++;
    i = set.next[i];
  } while (i != item);
}

} // namespace

gp_Trsf CwImagesOfSolid::turn(int turns) const {
  gp_Trsf motion;
  if (turns) motion.SetRotation(gp::OZ(), 2 * M_PI * turns / count);
  return motion;
}

std::string CwImagesOfSolid::find(const TopoDS_Shape &solid, int passages, double tolerance, double unit) {
  count = passages;
  off = 0;
  faces.Clear(), edges.Clear(), vertices.Clear();
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  TopExp::MapShapes(solid, TopAbs_EDGE, edges);
  TopExp::MapShapes(solid, TopAbs_VERTEX, vertices);
  vertex.next.assign(vertices.Extent(), -1);
  edge.next.assign(edges.Extent(), -1);
  face.next.assign(faces.Extent(), -1);
  const gp_Trsf once = turn(1);
  for (int v = 0; v < vertices.Extent(); v++) {
    const gp_Pnt point = BRep_Tool::Pnt(TopoDS::Vertex(vertices(v + 1))), turned = point.Transformed(once);
    double nearest = INFINITY;
    for (int w = 0; w < vertices.Extent(); w++) {
      const double far = BRep_Tool::Pnt(TopoDS::Vertex(vertices(w + 1))).Distance(turned);
      if (far < nearest) nearest = far, vertex.next[v] = w;
    }
    off = std::max(off, nearest);
    if (nearest > tolerance) return fails("a corner", point, nearest, unit);
  }
  std::vector<std::set<int>> ends, outline;
  for (int e = 0; e < edges.Extent(); e++) ends.push_back(cw_cad_numbers(edges(e + 1), TopAbs_VERTEX, vertices));
  std::vector<int> pole(faces.Extent(), -1); // of each face: the side that is a point, which its outline leaves out
  for (int f = 0; f < faces.Extent(); f++) {
    outline.push_back(cw_cad_numbers(faces(f + 1), TopAbs_EDGE, edges));
    for (const int e : outline[f])
      if (BRep_Tool::Degenerated(TopoDS::Edge(edges(e + 1)))) pole[f] = e;
    outline[f].erase(pole[f]);
  }
  for (int e = 0; e < edges.Extent(); e++) {
    const TopoDS_Edge &from = TopoDS::Edge(edges(e + 1));
    if (BRep_Tool::Degenerated(from)) continue;
    const std::set<int> wanted = images_of(ends[e], vertex.next);
    const std::vector<gp_Pnt> points = cw_cad_edge_points(from, EDGE_STEPS);
    double nearest = INFINITY;
    for (int g = 0; g < edges.Extent(); g++) {
      if (ends[g] != wanted || BRep_Tool::Degenerated(TopoDS::Edge(edges(g + 1)))) continue;
      double far = 0;
      for (int i = 1; i < EDGE_STEPS; i++) // the ends are vertices
        far = std::max(far, distance(points[i].Transformed(once), edges(g + 1)));
      if (far < nearest) nearest = far, edge.next[e] = g;
    }
    off = std::max(off, nearest);
    if (nearest > tolerance) return fails("an edge", points[EDGE_STEPS / 2], nearest, unit);
  }
  CwFaceDistance to_face(solid);
  for (int f = 0; f < faces.Extent(); f++) {
    const TopoDS_Face &from = TopoDS::Face(faces(f + 1));
    const std::set<int> wanted = images_of(outline[f], edge.next);
    const std::vector<gp_Pnt> points = cw_cad_inner_points(from, FACE_LATTICE, FACE_SAMPLES);
    double nearest = INFINITY;
    for (int g = 0; g < faces.Extent(); g++) {
      if (outline[g] != wanted) continue;
      double far = 0;
      for (const gp_Pnt &point : points) far = std::max(far, to_face.at(g, point.Transformed(once), INFINITY));
      if (far < nearest) nearest = far, face.next[f] = g;
    }
    off = std::max(off, nearest);
    if (nearest > tolerance) return fails("a face", points.empty() ? gp_Pnt() : points[0], nearest, unit);
    if (pole[f] >= 0) edge.next[pole[f]] = pole[face.next[f]];
  }
  for (const int next : edge.next)
    if (next < 0) return "it has a pole that no face's is the image of";
  if (!close_sets(count, true, face) || !close_sets(count, false, edge) || !close_sets(count, true, vertex))
    return "its faces are no sets of " + std::to_string(count);
  return "";
}

void CwImagesOfSolid::choose() {
  std::vector<std::set<int>> outline;
  for (int f = 0; f < faces.Extent(); f++) outline.push_back(cw_cad_numbers(faces(f + 1), TopAbs_EDGE, edges));
  std::vector<bool> settled(faces.Extent()), taken(edges.Extent()), kept(vertices.Extent());
  std::vector<int> queue;
  for (int seed = 0; seed < faces.Extent(); seed++) {
    if (settled[face.first[seed]]) continue;
    settled[face.first[seed]] = true;
    queue.push_back(seed);
    for (size_t i = queue.size() - 1; i < queue.size(); i++) {
      if (is_fixed(queue[i])) continue;
      for (int f = 0; f < faces.Extent(); f++) {
        if (settled[face.first[f]] || is_fixed(f)) continue;
        std::vector<int> common;
        std::set_intersection(outline[queue[i]].begin(), outline[queue[i]].end(), outline[f].begin(), outline[f].end(),
                              std::back_inserter(common));
        if (common.empty()) continue;
        settled[face.first[f]] = true;
        queue.push_back(f);
      }
    }
  }
  for (const int f : queue) put_first(f, face);
  for (const int f : queue)
    for (const int e : outline[f]) {
      if (taken[edge.first[e]]) continue;
      put_first(e, edge);
      taken[e] = true;
      for (const int v : cw_cad_numbers(edges(e + 1), TopAbs_VERTEX, vertices)) {
        if (kept[vertex.first[v]]) continue;
        put_first(v, vertex);
        kept[v] = true;
      }
    }
}
