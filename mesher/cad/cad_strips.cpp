// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/cad_strips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "mesher/common/vec.h"

namespace {

const int LENGTH_PARTS = 32;        // of an edge, for its length
const double CORNER_COSINE = 0.866; // 30 degrees: the loop turns by more at the corners of a strip
const double MOST_CREST = 0.17;     // sine of 10 degrees: of the way across, out of the flow beside either wall
const double LEAST_COSINE = -0.866; // 30 degrees of flow between the walls beyond the sides
const double MOST_UNEVEN = 0.5;     // of the sines of the angles across from either wall: a riser has 0 and 1
const double ELONGATED = 2;         // sides over ends, from which on they are told apart by their lengths
const double SAME_LENGTH = 1e-6;    // relative: rows of one length

typedef std::vector<CwCadUse> Side;
typedef std::array<Side, 4> Quad; // the four sides of a face, in the order of its loop

double use_length(const CwCad *cad, const CwCadUse &use) {
  double before[3], x[3], length = 0;
  for (int i = 0; i <= LENGTH_PARTS; i++) {
    cw_cad_edge_point(cad, use.edge, cw_cad_use_at(cad, use, (double)i / LENGTH_PARTS), x, nullptr);
    if (i > 0) length += cw_distance(before, x);
    cw_copy(x, before);
  }
  return length;
}

double side_length(const CwCad *cad, const Side &side) {
  double length = 0;
  for (const CwCadUse &use : side) length += use_length(cad, use);
  return length;
}

// The loop of a face; empty where it has more than one, or touches itself.
Side loop_of(const CwCad *cad, const std::vector<int> &edges) {
  Side loop{{edges[0], false}};
  std::map<int, int> ends;
  for (int e : edges)
    for (int v : cad->edge[e].vertex) ends[v]++;
  for (auto &end : ends)
    if (end.second != 2) return Side();
  while (loop.size() < edges.size()) {
    int at = cw_cad_use_vertex(cad, loop.back(), 1), next = -1;
    for (int e : edges)
      if (e != loop.back().edge && (cad->edge[e].vertex[0] == at || cad->edge[e].vertex[1] == at)) next = e;
    if (next < 0 || next == loop[0].edge) return Side();
    loop.push_back({next, cad->edge[next].vertex[1] == at});
  }
  return loop;
}

// Cosine of the angle by which the loop turns where `next` follows `use`.
double turn_cosine(const CwCad *cad, const CwCadUse &use, const CwCadUse &next) {
  double x[3], in[3], out[3];
  cw_cad_edge_point(cad, use.edge, cw_cad_use_at(cad, use, 1), x, in);
  cw_cad_edge_point(cad, next.edge, cw_cad_use_at(cad, next, 0), x, out);
  cw_unit(in);
  cw_unit(out);
  return cw_dot(in, out) * (use.reversed == next.reversed ? 1 : -1);
}

// Divides a loop at its four corners: all there are, or those that are no smooth joint.
bool quad_of(const CwCad *cad, const Side &loop, Quad &quad) {
  const size_t n = loop.size();
  std::vector<size_t> corner; // the first use after each
  if (n < 4) return false;
  for (size_t i = 0; i < n; i++)
    if (n == 4 || turn_cosine(cad, loop[(i + n - 1) % n], loop[i]) < CORNER_COSINE) corner.push_back(i);
  if (corner.size() != 4) return false;
  for (size_t k = 0; k < 4; k++) {
    quad[k].clear();
    for (size_t i = corner[k]; i != corner[(k + 1) % 4]; i = (i + 1) % n) quad[k].push_back(loop[i]);
  }
  return true;
}

// A face that may be a strip.
struct Candidate {
  int face;
  Quad quad;
  int odd;     // whether its sides are the odd ones of the quad; -1: not known
  bool fits;   // once that is known
  bool broken; // a neighbour that would follow does not fit
};

int elongated(const CwCad *cad, const Quad &quad) {
  double length[4];
  for (int k = 0; k < 4; k++) length[k] = side_length(cad, quad[k]);
  for (int odd = 0; odd < 2; odd++) {
    double sides = std::min(length[odd], length[odd + 2]), ends = std::max(length[1 - odd], length[(3 - odd)]);
    if (sides > ELONGATED * ends) return odd;
  }
  return -1;
}

// A place on a side, and the normal of the face beyond it there.
void beyond_side(const CwCad *cad, const Side &side, int face, double share, double x[3], double n[3]) {
  double uv[2], along = share * (double)side.size();
  size_t i = std::min((size_t)along, side.size() - 1);
  int other = cw_cad_beyond(cad, side[i].edge, face);
  double t = cw_cad_use_at(cad, side[i], along - (double)i);
  cw_cad_edge_point(cad, side[i].edge, t, x, nullptr);
  cw_cad_edge_uv(cad, side[i].edge, other, t, uv);
  cw_cad_face_normal(cad, other, uv, n);
}

// Places along a side at even steps of length.
std::vector<std::array<double, 3>> places(const CwCad *cad, const Side &side, int steps, bool backwards) {
  std::vector<std::array<double, 3>> fine, made;
  std::vector<double> length;
  for (const CwCadUse &use : side) {
    for (int i = 0; i <= 2 * LENGTH_PARTS; i++) {
      std::array<double, 3> x;
      cw_cad_edge_point(cad, use.edge, cw_cad_use_at(cad, use, i / (2.0 * LENGTH_PARTS)), x.data(), nullptr);
      length.push_back(fine.empty() ? 0 : length.back() + cw_distance(fine.back().data(), x.data()));
      fine.push_back(x);
    }
  }
  for (int i = 0; i < steps; i++) {
    double want = length.back() * i / (steps - 1);
    size_t k =
        std::min((size_t)(std::lower_bound(length.begin(), length.end(), want) - length.begin()), length.size() - 1);
    std::array<double, 3> x = fine[k];
    if (k > 0 && length[k] > length[k - 1])
      cw_lerp(fine[k - 1].data(), fine[k].data(), (want - length[k - 1]) / (length[k] - length[k - 1]), x.data());
    made.push_back(x);
  }
  if (backwards) std::reverse(made.begin(), made.end());
  return made;
}

// Whether the faces beyond the sides allow the strip to be left out: both are walls, and at like places the flow lies
// in a concave edge between them, or on one surface. Beside a crest, such as the nose of a blade, or a step it does
// not.
bool sides_fit(const CwCad *cad, int face, const Side &a, const Side &b) {
  for (const Side *side : {&a, &b})
    for (const CwCadUse &use : *side)
      if (!cw_cad_face_is_wall(cad, cw_cad_beyond(cad, use.edge, face))) return false;
  for (const CwCadUse &p : a)
    for (const CwCadUse &q : b)
      if (cw_cad_beyond(cad, p.edge, face) == cw_cad_beyond(cad, q.edge, face)) return false;
  for (int i = 0; i < CW_CAD_STRIP_SAMPLES; i++) {
    double s = (i + 0.5) / CW_CAD_STRIP_SAMPLES, x[3], y[3], across[3], n[3], m[3];
    beyond_side(cad, a, face, s, x, n);
    beyond_side(cad, b, face, 1 - s, y, m);
    cw_sub(y, x, across);
    cw_unit(across);
    double from_n = cw_dot(across, n), from_m = cw_dot(across, m);
    if (!(cw_dot(n, m) > LEAST_COSINE && from_n < MOST_CREST && from_m > -MOST_CREST)) return false;
    if (!(std::fabs(from_n + from_m) < MOST_UNEVEN)) return false;
  }
  return true;
}

void measure(const CwCad *cad, CwCadChainStrip &strip) {
  auto a = places(cad, strip.side[0], CW_CAD_STRIP_SAMPLES, false),
       b = places(cad, strip.side[1], CW_CAD_STRIP_SAMPLES, true);
  strip.length = std::max(side_length(cad, strip.side[0]), side_length(cad, strip.side[1]));
  for (int i = 0; i < CW_CAD_STRIP_SAMPLES; i++) {
    strip.width[i] = cw_distance(a[i].data(), b[i].data());
    cw_lerp(a[i].data(), b[i].data(), 0.5, strip.x[i]);
  }
}

bool fits(const CwCad *cad, const Candidate &c) {
  return c.quad[1 - c.odd].size() == 1 && c.quad[3 - c.odd].size() == 1 &&
         sides_fit(cad, c.face, c.quad[c.odd], c.quad[c.odd + 2]);
}

// Where lengths do not tell sides from ends, the end of a neighbour is an end here too.
void settle_sides(const CwCad *cad, std::vector<Candidate> &candidates, const std::vector<int> &of_face) {
  std::vector<size_t> queue;
  for (size_t i = 0; i < candidates.size(); i++) {
    Candidate &c = candidates[i];
    c.fits = c.odd >= 0 && fits(cad, c);
    if (c.fits) queue.push_back(i);
  }
  for (size_t done = 0; done < queue.size(); done++) {
    const Candidate from = candidates[queue[done]];
    for (int k = 1 - from.odd; k < 4; k += 2) {
      int edge = from.quad[k][0].edge, other = of_face[cw_cad_beyond(cad, edge, from.face)], odd = -1;
      if (other < 0) continue;
      Candidate &to = candidates[other];
      for (int j = 0; j < 4; j++)
        if (to.quad[j].size() == 1 && to.quad[j][0].edge == edge) odd = 1 - j % 2;
      if (odd < 0 || (to.odd >= 0 && to.odd != odd)) continue;
      if (to.odd < 0) {
        to.odd = odd;
        to.fits = fits(cad, to);
        if (to.fits) queue.push_back((size_t)other);
      }
      candidates[queue[done]].broken |= !to.fits;
    }
  }
}

double mean_width(const CwCadChainStrip &strip) {
  double sum = 0;
  for (double width : strip.width) sum += width;
  return sum / CW_CAD_STRIP_SAMPLES;
}

// Whether a strip beside a side is narrower: that one is the detail, this one the surface.
bool beside_narrower(const CwCad *cad, const std::vector<CwCadChainStrip> &strips, const CwCadChainStrip &strip) {
  for (const Side &side : strip.side)
    for (const CwCadUse &use : side)
      for (const CwCadChainStrip &other : strips)
        if (other.face == cw_cad_beyond(cad, use.edge, strip.face) && mean_width(other) < mean_width(strip))
          return true;
  return false;
}

std::vector<CwCadChainStrip> find_strips(const CwCad *cad) {
  std::vector<std::vector<int>> edges(cad->face.size());
  std::vector<Candidate> candidates;
  std::vector<int> of_face(cad->face.size(), -1);
  std::vector<CwCadChainStrip> strips;
  for (int e = 0; e < cw_cad_edge_count(cad); e++)
    for (int f : cad->edge[e].face) edges[f].push_back(e);
  for (int f = 0; f < cw_cad_face_count(cad); f++) {
    Candidate candidate{f, {}, -1, false, false};
    if (!cw_cad_face_is_wall(cad, f) || cad->face[f].pole.is || edges[f].size() < 4) continue;
    Side loop = loop_of(cad, edges[f]);
    if (loop.empty() || !quad_of(cad, loop, candidate.quad)) continue;
    candidate.odd = elongated(cad, candidate.quad);
    of_face[f] = (int)candidates.size();
    candidates.push_back(candidate);
  }
  settle_sides(cad, candidates, of_face);
  for (const Candidate &c : candidates) {
    if (!c.fits) continue;
    CwCadChainStrip strip = {};
    strip.face = c.face;
    strip.broken = c.broken;
    for (int k = 0; k < 2; k++) {
      strip.side[k] = c.quad[c.odd + 2 * k];
      strip.end[k] = c.quad[(c.odd + 1 + 2 * k) % 4][0];
    }
    measure(cad, strip);
    strips.push_back(strip);
  }
  return strips;
}

// Turns the strip about, so that its other side is side[0].
void turn(CwCadChainStrip &strip) {
  std::swap(strip.side[0], strip.side[1]);
  std::swap(strip.end[0], strip.end[1]);
}

// The strips that hang together by their ends, each with its side[0] in the same row; empty where a row runs into the
// other.
CwCadChain chain_from(const CwCad *cad, std::vector<CwCadChainStrip> &strips, const std::vector<int> &of_face,
                      size_t seed, std::vector<bool> &taken) {
  std::vector<size_t> queue{seed};
  bool whole = true;
  taken[seed] = true;
  for (size_t done = 0; done < queue.size(); done++) {
    const CwCadChainStrip from = strips[queue[done]];
    for (const CwCadUse &end : from.end) {
      int next = of_face[cw_cad_beyond(cad, end.edge, from.face)];
      if (next < 0) continue;
      CwCadChainStrip &to = strips[next];
      if (to.end[0].edge != end.edge && to.end[1].edge != end.edge) continue; // its side: it does not follow
      int begin = cw_cad_use_vertex(cad, end, 0);
      int vertex = cw_cad_side_ends_at(cad, from.side[0], begin) ? begin : cw_cad_use_vertex(cad, end, 1);
      bool in_row = cw_cad_side_ends_at(cad, to.side[0], vertex);
      if (taken[next]) {
        whole = whole && in_row;
        continue;
      }
      if (!in_row) turn(to);
      taken[next] = true;
      queue.push_back((size_t)next);
    }
  }
  CwCadChain chain;
  for (size_t i : queue)
    if (whole) chain.push_back(strips[i]);
  return chain;
}

int least_patch(const CwCad *cad, const CwCadChain &chain, int row) {
  int least = cw_cad_patch_count(cad);
  for (const CwCadChainStrip &strip : chain)
    for (const CwCadUse &use : strip.side[row])
      least = std::min(least, cw_cad_face_patch(cad, cw_cad_beyond(cad, use.edge, strip.face)));
  return least;
}

// The patch behind an end of a strip.
int patch_behind(const CwCad *cad, const CwCadChainStrip &strip, int end) {
  return cw_cad_face_patch(cad, cw_cad_beyond(cad, strip.end[end].edge, strip.face));
}

// 1 where a strip's loop runs anticlockwise seen from out of the fluid, -1 where it runs clockwise.
int loop_sense(const CwCad *cad, const CwCadChainStrip &strip) {
  const CwCadUse &use = strip.side[0][strip.side[0].size() / 2];
  double x[3], along[3], across[3], uv[2], normal[3], up[3], t = cw_cad_use_at(cad, use, 0.5);
  cw_cad_edge_point(cad, use.edge, t, x, along);
  for (int k = 0; k < 3 && use.reversed; k++) along[k] = -along[k];
  cw_sub(strip.x[CW_CAD_STRIP_SAMPLES / 2], x, across);
  cw_cad_edge_uv(cad, use.edge, strip.face, t, uv);
  cw_cad_face_normal(cad, strip.face, uv, normal);
  cw_cross(along, across, up);
  return cw_dot(up, normal) > 0 ? 1 : -1;
}

// Which of two rows of one length between the same patches stays: that on the right of the way from the shorter end to
// the longer one, or to the end before the later patch, seen from out of the fluid. Images of a chain under a turn
// decide alike, wherever their loops begin.
int row_by_hand(const CwCad *cad, const CwCadChain &chain) {
  double longer = 0, length = 0;
  int later = 0;
  for (const CwCadChainStrip &strip : chain) { // its loop runs along row 0 from end[1] to end[0]
    int sense = loop_sense(cad, strip);
    double end[2] = {use_length(cad, strip.end[0]), use_length(cad, strip.end[1])};
    longer += sense * (end[0] - end[1]);
    later += sense * (patch_behind(cad, strip, 0) - patch_behind(cad, strip, 1));
    length += end[0] + end[1];
  }
  return std::fabs(longer) > SAME_LENGTH * length ? longer < 0 : later < 0;
}

// Settles which row stays: the longer one of those beside which the other has one edge a strip. False where none is.
bool settle_row(const CwCad *cad, CwCadChain &chain) {
  double length[2] = {0, 0};
  bool can_go[2] = {true, true};
  for (const CwCadChainStrip &strip : chain) {
    for (int row = 0; row < 2; row++) {
      length[row] += side_length(cad, strip.side[row]);
      can_go[row] = can_go[row] && strip.side[row].size() == 1;
    }
  }
  if (!can_go[0] && !can_go[1]) return false;
  bool alike = std::fabs(length[0] - length[1]) <= SAME_LENGTH * (length[0] + length[1]);
  int patch[2] = {least_patch(cad, chain, 0), least_patch(cad, chain, 1)};
  int longer = !alike ? length[1] > length[0] : patch[0] != patch[1] ? patch[1] < patch[0] : row_by_hand(cad, chain);
  for (CwCadChainStrip &strip : chain) strip.stays = can_go[1 - longer] ? longer : 1 - longer;
  return true;
}

} // namespace

int cw_cad_beyond(const CwCad *cad, int edge, int face) {
  const CwCadEdge &e = cad->edge[edge];
  return e.face[0] == face ? e.face[1] : e.face[0];
}

double cw_cad_use_at(const CwCad *cad, const CwCadUse &use, double share) {
  const double *range = cad->edge[use.edge].range;
  return use.reversed ? range[1] + share * (range[0] - range[1]) : range[0] + share * (range[1] - range[0]);
}

int cw_cad_use_vertex(const CwCad *cad, const CwCadUse &use, int end) {
  return cad->edge[use.edge].vertex[use.reversed ? 1 - end : end];
}

bool cw_cad_side_ends_at(const CwCad *cad, const std::vector<CwCadUse> &side, int vertex) {
  return cw_cad_use_vertex(cad, side.front(), 0) == vertex || cw_cad_use_vertex(cad, side.back(), 1) == vertex;
}

std::vector<CwCadChain> cw_cad_chains(const CwCad *cad) {
  std::vector<CwCadChainStrip> strips = find_strips(cad);
  std::vector<int> of_face(cad->face.size(), -1);
  std::vector<bool> taken(strips.size());
  std::vector<CwCadChain> chains;
  for (size_t i = 0; i < strips.size(); i++) of_face[strips[i].face] = (int)i;
  for (size_t i = 0; i < strips.size(); i++) {
    if (taken[i]) continue;
    CwCadChain chain = chain_from(cad, strips, of_face, i, taken);
    bool whole = !chain.empty();
    for (const CwCadChainStrip &strip : chain) whole = whole && !strip.broken && !beside_narrower(cad, strips, strip);
    if (!whole || !settle_row(cad, chain)) continue;
    chains.push_back(chain);
  }
  return chains;
}
