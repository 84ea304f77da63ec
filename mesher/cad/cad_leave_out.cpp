// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/cad_leave_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <new>
#include <set>

#include "mesher/cad/cad_strips.h"
#include "mesher/common/vec.h"

namespace {

const int STEPS = 256;          // of an edge, between the places that are told
const double BY_LENGTH = 0.1;   // of a place, by its share of the length: two never fall together
const double SAME_PLACE = 1e-6; // of the distance of two vertices
typedef std::array<double, 3> Point;

// What leaving out a chain does to the solid.
struct Change {
  std::map<int, int> vertex;           // that goes, and the one in its place
  std::map<int, std::set<int>> slides; // faces on which a vertex that goes has slid to the other
  std::set<int> edges;                 // that go
};

std::vector<Point> sample(const CwCad *cad, const CwCadUse &use, bool backwards) {
  std::vector<Point> made(STEPS + 1);
  for (int i = 0; i <= STEPS; i++) {
    double share = (double)i / STEPS;
    cw_cad_edge_point(cad, use.edge, cw_cad_use_at(cad, use, backwards ? 1 - share : share), made[i].data(), nullptr);
  }
  return made;
}

// Lengths from the beginning, over the whole.
std::vector<double> length_shares(const std::vector<Point> &x) {
  std::vector<double> made(x.size(), 0);
  for (size_t i = 1; i < x.size(); i++) made[i] = made[i - 1] + cw_distance(x[i - 1].data(), x[i].data());
  for (double &share : made) share /= made.back();
  return made;
}

// The place, as a share of its parameter, of a polyline nearest to x.
double nearest_share(const std::vector<Point> &line, const double x[3]) {
  double best = INFINITY, share = 0;
  for (size_t i = 0; i + 1 < line.size(); i++) {
    double s = cw_nearest_share(line[i].data(), line[i + 1].data(), x), p[3];
    cw_lerp(line[i].data(), line[i + 1].data(), s, p);
    double distance = cw_distance(p, x);
    if (distance >= best) continue;
    best = distance;
    share = ((double)i + s) / STEPS;
  }
  return share;
}

double share_at_length(const std::vector<double> &length, double want) {
  size_t i = std::upper_bound(length.begin(), length.end(), want) - length.begin();
  if (i >= length.size()) return 1;
  double span = length[i] - length[i - 1];
  return ((double)(i - 1) + (span > 0 ? (want - length[i - 1]) / span : 0)) / STEPS;
}

// Places of the side that goes, as shares from its beginning as the other side runs, for all samples of that side.
std::vector<double> places_beside(const std::vector<Point> &stays, const std::vector<Point> &goes) {
  std::vector<double> made, own = length_shares(stays), other = length_shares(goes);
  double nearest = 0;
  for (size_t i = 0; i < stays.size(); i++) {
    nearest = std::max(nearest, nearest_share(goes, stays[i].data()));
    made.push_back((1 - BY_LENGTH) * nearest + BY_LENGTH * share_at_length(other, own[i]));
  }
  made.front() = 0;
  made.back() = 1;
  return made;
}

// Gives the edges of the side that stays what they have on the face beyond the other side.
void replace_side(CwCad *cad, const CwCadChainStrip &strip, Change &change) {
  const std::vector<CwCadUse> &stays = strip.side[strip.stays];
  const CwCadUse goes = strip.side[1 - strip.stays][0];
  const auto other = std::make_shared<const CwCadEdge>(cad->edge[goes.edge]);
  const int face = cw_cad_beyond(cad, goes.edge, strip.face);
  std::vector<Point> along, line = sample(cad, goes, true);
  for (const CwCadUse &use : stays) {
    std::vector<Point> more = sample(cad, use, false);
    along.insert(along.end(), more.begin() + (along.empty() ? 0 : 1), more.end());
  }
  std::vector<double> place = places_beside(along, line);
  for (size_t k = 0; k < stays.size(); k++) {
    CwCadEdge &edge = cad->edge[stays[k].edge];
    auto made = std::make_shared<CwCadReplaced>();
    made->strip = strip.face;
    made->side = edge.face[0] == strip.face ? 0 : 1;
    made->edge = other;
    made->gap = 0;
    for (int i = 0; i <= STEPS; i++) {
      size_t at = k * STEPS + (size_t)(stays[k].reversed ? STEPS - i : i);
      double x[3], t = cw_cad_use_at(cad, goes, 1 - place[at]);
      made->t.push_back(t);
      cw_cad_edge_point(cad, goes.edge, t, x, nullptr);
      made->gap = std::max(made->gap, cw_distance(x, along[at].data()) / cad->unit);
    }
    edge.face[made->side] = face;
    edge.replaced = made;
  }
  change.edges.insert(goes.edge);
}

// Faces that go with the strips about them, all their edges being ends of theirs, as where three fillets meet, and
// their vertices, which become one.
typedef std::map<int, std::set<int>> Corners;

// Where all these chains go.
Corners corners_between(const CwCad *cad, const std::vector<const CwCadChain *> &chains) {
  std::vector<int> edges(cad->face.size(), 0);
  std::map<int, int> ends;
  Corners corners;
  for (const CwCadEdge &edge : cad->edge)
    for (int f : edge.face) edges[f]++;
  for (const CwCadChain *chain : chains)
    for (const CwCadChainStrip &strip : *chain)
      for (const CwCadUse &end : strip.end) ends[cw_cad_beyond(cad, end.edge, strip.face)]++;
  for (const auto &end : ends)
    if (end.second == edges[end.first] && cw_cad_face_is_wall(cad, end.first)) corners[end.first] = {};
  for (const CwCadEdge &edge : cad->edge)
    for (int f : edge.face)
      if (corners.count(f)) corners[f].insert(edge.vertex, edge.vertex + 2);
  return corners;
}

// What has been planned for.
struct Taken {
  std::set<int> strips;            // faces
  std::set<int> touched, cornered; // vertices of chains: at sides and ends, at corners
  std::vector<int> left_in_patch;  // faces
};

// Takes these faces, unless no other is left in one of their patches.
bool take_faces(const CwCad *cad, const std::set<int> &faces, Taken &taken) {
  std::map<int, int> of_patch;
  for (int f : faces) of_patch[cw_cad_face_patch(cad, f)]++;
  for (auto &patch : of_patch)
    if (patch.second >= taken.left_in_patch[patch.first]) return false;
  for (auto &patch : of_patch) taken.left_in_patch[patch.first] -= patch.second;
  return true;
}

// Whether the chain can go beside what went before; adds what goes with it but for its sides.
bool plan_chain(const CwCad *cad, const CwCadChain &chain, const Corners &corners, Taken &taken, Change &change) {
  std::set<int> faces, own, cornered;
  Change made;
  for (const CwCadChainStrip &strip : chain) faces.insert(strip.face);
  for (const CwCadChainStrip &strip : chain) {
    for (const CwCadUse &end : strip.end) {
      int a = cw_cad_use_vertex(cad, end, 0), b = cw_cad_use_vertex(cad, end, 1),
          other = cw_cad_beyond(cad, end.edge, strip.face);
      if (!cw_cad_side_ends_at(cad, strip.side[strip.stays], a)) std::swap(a, b);
      made.edges.insert(end.edge);
      if (corners.count(other)) {
        cornered.insert({a, b});
        continue;
      }
      if (made.vertex.count(b) && made.vertex[b] != a) return false;
      made.vertex[b] = a;
      if (!faces.count(other)) made.slides[b].insert(other);
    }
    for (const auto &side : strip.side) {
      for (const CwCadUse &use : side) {
        own.insert(cad->edge[use.edge].vertex[0]);
        own.insert(cad->edge[use.edge].vertex[1]);
        int other = cw_cad_beyond(cad, use.edge, strip.face);
        if (faces.count(other) || taken.strips.count(other)) return false;
      }
    }
  }
  for (auto &moved : made.vertex)
    if (made.vertex.count(moved.second) || cornered.count(moved.first) || cornered.count(moved.second)) return false;
  for (int v : own)
    if (taken.touched.count(v) || (taken.cornered.count(v) && !cornered.count(v))) return false;
  if (!take_faces(cad, faces, taken)) return false;
  for (int v : own) (cornered.count(v) ? taken.cornered : taken.touched).insert(v);
  taken.strips.insert(faces.begin(), faces.end());
  change.vertex.insert(made.vertex.begin(), made.vertex.end());
  change.slides.insert(made.slides.begin(), made.slides.end());
  change.edges.insert(made.edges.begin(), made.edges.end());
  return true;
}

// Of the vertices of a corner the one that stays: with the least z, of these the one nearest the axis; a turn takes it
// to that of the image.
int vertex_of(const CwCad *cad, const std::set<int> &corner) {
  auto before = [&](int a, int b) {
    const gp_Pnt &p = cad->vertex[a], &q = cad->vertex[b];
    double same = SAME_PLACE * p.Distance(q), nearer = std::hypot(q.X(), q.Y()) - std::hypot(p.X(), p.Y());
    return std::fabs(p.Z() - q.Z()) > same ? p.Z() < q.Z() : std::fabs(nearer) > same ? nearer > 0 : a < b;
  };
  return *std::min_element(corner.begin(), corner.end(), before);
}

// Brings the vertices of a corner to one of them. Returns how far, in the unit of the B-rep.
double close_corner(const CwCad *cad, const std::set<int> &corner, Change &change) {
  int stays = vertex_of(cad, corner);
  double width = 0;
  for (int v : corner) {
    if (v != stays) change.vertex[v] = stays;
    width = std::max(width, cad->vertex[v].Distance(cad->vertex[stays]));
  }
  return width;
}

// Plans for all these chains and the corners between them. False: that one cannot go, *fails, for which no room is
// left.
bool plan_change(const CwCad *cad, const std::vector<const CwCadChain *> &chains, const Corners &corners,
                 Change &change, size_t *fails) {
  Taken taken = {{}, {}, {}, std::vector<int>(cw_cad_patch_count(cad), 0)};
  std::map<int, size_t> last; // of the chains at a corner
  for (int f = 0; f < cw_cad_face_count(cad); f++) taken.left_in_patch[cw_cad_face_patch(cad, f)]++;
  for (size_t i = 0; i < chains.size(); i++) {
    *fails = i;
    if (!plan_chain(cad, *chains[i], corners, taken, change)) return false;
    for (const CwCadChainStrip &strip : *chains[i])
      for (const CwCadUse &end : strip.end) last[cw_cad_beyond(cad, end.edge, strip.face)] = i;
  }
  for (const auto &corner : corners) {
    *fails = last[corner.first];
    if (!take_faces(cad, {corner.first}, taken)) return false;
  }
  return true;
}

// Brings the edges that ended at vertices which go to those in their place.
void move_ends(CwCad *cad, const Change &change) {
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    CwCadEdge &edge = cad->edge[e];
    for (int end = 0; end < 2 && !change.edges.count(e); end++) {
      auto to = change.vertex.find(edge.vertex[end]);
      if (to == change.vertex.end()) continue;
      CwCadMovedEnd &moved = edge.moved[end];
      moved.is = true;
      moved.gap = cad->vertex[to->first].Distance(cad->vertex[to->second]);
      auto slides = change.slides.find(to->first);
      for (int side = 0; side < 2 && slides != change.slides.end(); side++)
        moved.slides[side] = slides->second.count(edge.face[side]) > 0;
      edge.vertex[end] = to->second;
    }
  }
}

// Takes out the edges and vertices that went, and numbers the others anew.
void number_anew(CwCad *cad, const Change &change) {
  std::vector<CwCadEdge> edge;
  std::vector<gp_Pnt> vertex;
  std::vector<int> number(cad->vertex.size(), -1);
  for (size_t v = 0; v < cad->vertex.size(); v++) {
    if (change.vertex.count((int)v)) continue;
    number[v] = (int)vertex.size();
    vertex.push_back(cad->vertex[v]);
  }
  for (size_t e = 0; e < cad->edge.size(); e++) {
    if (change.edges.count((int)e)) continue;
    edge.push_back(cad->edge[e]);
    for (int &v : edge.back().vertex) v = number[v];
  }
  for (CwCadFace &face : cad->face)
    if (face.pole.vertex >= 0) face.pole.vertex = number[face.pole.vertex];
  cad->edge.swap(edge);
  cad->vertex.swap(vertex);
}

int leave_out(CwCad *cad, int chain_count, const int *number) {
  const std::vector<CwCadChain> chains = cw_cad_chains(cad);
  std::vector<const CwCadChain *> going;
  Corners corners;
  Change change;
  int faces = 0;
  for (int i = 0; i < chain_count; i++) going.push_back(&chains[number[i]]);
  for (size_t fails = 0;; going.erase(going.begin() + (std::ptrdiff_t)fails)) {
    change = Change();
    corners = corners_between(cad, going);
    if (plan_change(cad, going, corners, change, &fails)) break;
  }
  for (const CwCadChain *chain : going) {
    for (const CwCadChainStrip &strip : *chain) {
      replace_side(cad, strip, change);
      cad->face[strip.face].left_out = *std::max_element(strip.width, strip.width + CW_CAD_STRIP_SAMPLES) / cad->unit;
    }
    faces += (int)chain->size();
  }
  for (const auto &corner : corners) {
    cad->face[corner.first].left_out = close_corner(cad, corner.second, change);
    faces++;
  }
  move_ends(cad, change);
  number_anew(cad, change);
  return faces;
}

CwCadStrip measures_of(const CwCadChainStrip &strip, int chain) {
  static_assert((int)CW_STRIP_SAMPLES == (int)CW_CAD_STRIP_SAMPLES);
  CwCadStrip made = {};
  made.face = strip.face;
  made.chain = chain;
  made.length = strip.length;
  std::copy(strip.width, strip.width + CW_STRIP_SAMPLES, made.width);
  std::copy(&strip.x[0][0], &strip.x[0][0] + 3 * CW_STRIP_SAMPLES, &made.x[0][0]);
  return made;
}

} // namespace

CwStatus cw_cad_strips_find(const CwCad *cad, int *count, CwCadStrip **strips) {
  CwStatus status = CW_OK;
  *count = 0;
  *strips = nullptr;
  try {
    const std::vector<CwCadChain> chains = cw_cad_chains(cad);
    size_t all = 0;
    for (const CwCadChain &chain : chains) all += chain.size();
    CwCadStrip *made = (CwCadStrip *)calloc(all ? all : 1, sizeof *made);
    if (!made) throw std::bad_alloc();
    for (size_t c = 0; c < chains.size(); c++)
      for (const CwCadChainStrip &strip : chains[c]) made[(*count)++] = measures_of(strip, (int)c);
    *strips = made;
  } catch (const std::bad_alloc &) {
    status = CW_FAIL(CW_ERR_MEMORY, "out of memory: narrow faces of %d", cw_cad_face_count(cad));
  }
  return status;
}

CwStatus cw_cad_leave_out(CwCad *cad, int chain_count, const int *chain, int *faces) {
  CwStatus status = CW_OK;
  try {
    *faces = leave_out(cad, chain_count, chain);
  } catch (const std::bad_alloc &) {
    status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %d chains of narrow faces", chain_count);
  }
  return status;
}

int cw_cad_face_is_left_out(const CwCad *cad, int face) {
  return cad->face[face].left_out > 0;
}

int cw_cad_face_is_meshed_wall(const CwCad *cad, int face) {
  return cw_cad_face_is_wall(cad, face) && !cw_cad_face_is_left_out(cad, face);
}

double cw_cad_face_left_out_width(const CwCad *cad, int face) {
  return cad->face[face].left_out * cad->unit;
}

int cw_cad_edge_stands_for(const CwCad *cad, int edge, double *gap) {
  const CwCadEdge &e = cad->edge[edge];
  if (gap) *gap = e.replaced ? e.replaced->gap * cad->unit : 0;
  return e.replaced ? e.replaced->strip : -1;
}

int cw_cad_edge_borders(const CwCad *cad, int edge, int face, int other) {
  const CwCadEdge &e = cad->edge[edge];
  if ((e.face[0] == face && e.face[1] == other) || (e.face[0] == other && e.face[1] == face)) return 1;
  const int strip = e.replaced ? e.replaced->strip : -1;
  if (strip < 0 || (strip != face && strip != other)) return 0;
  const int beside = strip == face ? other : face;
  return e.face[0] == beside || e.face[1] == beside;
}

double cw_cad_edge_gap(const CwCad *cad, int edge, int face) {
  const CwCadEdge &e = cad->edge[edge];
  return e.replaced && e.face[e.replaced->side] == face ? e.replaced->gap * cad->unit : 0;
}

double cw_cad_edge_end_gap(const CwCad *cad, int edge, int end) {
  const CwCadEdge &e = cad->edge[edge];
  return e.moved[end].is ? e.moved[end].gap * cad->unit : 0;
}
