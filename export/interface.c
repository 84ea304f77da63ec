// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/interface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "export/interface_near.h"
#include "pipeline/mesh/cell.h"
#include "pipeline/vec.h"

static const double ROUNDING = 1e-9; // of the size of the interface
// Of the longest edge there. A chord of an arc of a radius as short as itself is 0.13 of its length off.
static const double WIDEST_GAP = 0.25;

// Donor faces by the bins of the surface's coordinates that they reach into. On a cylinder the first goes round.
typedef struct {
  int round;
  int number[2];
  double first[2], step[2];
  int64_t *start; // number[0] * number[1] + 1
  int64_t *faces;
} Bins;

void cw_interface_free(CwInterface *interface) {
  for (int s = 0; s < 2; ++s) {
    free(interface->donor[s]);
    free(interface->place[s]);
  }
  memset(interface, 0, sizeof *interface);
}

int cw_interfaces_before(const CwMesh *mesh, int number, int side) {
  int count = 0;
  const CwModelPatch *patch = mesh->patches;
  for (int i = 0; i < number; ++i)
    for (int s = 0; s < 2; ++s)
      count += patch[mesh->interfaces[i].patch[s]].domain == patch[mesh->interfaces[number].patch[side]].domain &&
               patch[mesh->interfaces[i].patch[1 - s]].domain == patch[mesh->interfaces[number].patch[1 - side]].domain;
  return count;
}

// `angle` brought within half a turn of `near`.
static double unwrap(double angle, double near) {
  return near + remainder(angle - near, 2 * M_PI);
}

// The nodes of a face in the surface's coordinates, continuous across the half plane where atan2 jumps.
static void unroll(const CwInterface *in, const CwInterfaceFace *face, double flat[4][2]) {
  for (int i = 0; i < face->count; ++i) {
    const double *x = face->nodes[i];
    if (in->is_flat) {
      double off[3];
      cw_sub(x, in->centre, off);
      for (int k = 0; k < 2; ++k) flat[i][k] = cw_dot(off, in->axis[k]);
      continue;
    }
    double angle = atan2(x[1], x[0]);
    flat[i][0] = i ? unwrap(angle, flat[0][0]) : angle;
    flat[i][1] = x[2];
  }
}

static int within(int value, int number) {
  return value < 0 ? 0 : value >= number ? number - 1 : value;
}

static int bin_at(const Bins *bins, int k, double value) {
  return (int)floor((value - bins->first[k]) / bins->step[k]);
}

static int around(const Bins *bins, int a) {
  return (a % bins->number[0] + bins->number[0]) % bins->number[0];
}

// Calls for the bins that the box of a face reaches: counts (faces NULL) or fills.
static void bin_face(const CwInterface *in, const Bins *bins, const CwInterfaceFace *face, int64_t place,
                     int64_t *start, int64_t *faces) {
  double flat[4][2];
  int low[2], high[2];
  unroll(in, face, flat);
  for (int k = 0; k < 2; ++k) {
    double least = flat[0][k], most = flat[0][k];
    for (int i = 1; i < face->count; ++i) {
      least = fmin(least, flat[i][k]);
      most = fmax(most, flat[i][k]);
    }
    low[k] = bin_at(bins, k, least);
    high[k] = bin_at(bins, k, most);
    if (k || !bins->round) {
      low[k] = within(low[k], bins->number[k]);
      high[k] = within(high[k], bins->number[k]);
    }
  }
  if (high[0] >= low[0] + bins->number[0]) high[0] = low[0] + bins->number[0] - 1;
  for (int a = low[0]; a <= high[0]; ++a)
    for (int h = low[1]; h <= high[1]; ++h) {
      const int64_t bin = (int64_t)around(bins, a) * bins->number[1] + h;
      if (faces)
        faces[start[bin]++] = place;
      else
        ++start[bin + 1];
    }
}

static CwStatus make_bins(const CwInterface *in, const CwInterfaceFace *faces, int64_t count,
                          const CwInterfaceSide *side, Bins *bins) {
  CwStatus status = CW_OK;
  double height = side->most[1] - side->least[1];
  double width = in->is_flat ? side->most[0] - side->least[0] : 2 * M_PI * in->radius;
  // About as many bins as faces, and square ones.
  double size = sqrt(width * height / (double)count);
  bins->round = !in->is_flat;
  bins->number[0] = (int)fmax(1, width / size);
  bins->number[1] = (int)fmax(1, height / size);
  bins->first[0] = in->is_flat ? side->least[0] : -M_PI;
  bins->first[1] = side->least[1];
  bins->step[0] = (in->is_flat ? width * (1 + 1e-12) : 2 * M_PI) / bins->number[0];
  bins->step[1] = height / bins->number[1] * (1 + 1e-12);
  const int64_t bin_count = (int64_t)bins->number[0] * bins->number[1];
  CW_NEW(bins->start, bin_count + 1);
  for (int64_t i = 0; i < count; ++i) bin_face(in, bins, &faces[i], i, bins->start, NULL);
  for (int64_t b = 0; b < bin_count; ++b) bins->start[b + 1] += bins->start[b];
  CW_NEW(bins->faces, bins->start[bin_count]);
  for (int64_t i = 0; i < count; ++i) bin_face(in, bins, &faces[i], i, bins->start, bins->faces);
  // Each start has moved to the end of its bin: shift back.
  memmove(bins->start + 1, bins->start, (size_t)bin_count * sizeof *bins->start);
  bins->start[0] = 0;
done:
  return status;
}

// Where a point lies in a face: r, s. Returns how far inside, below 0 outside, in parts of the face.
static double locate(const CwInterface *in, const CwInterfaceFace *face, const double point[2], double rs[2]) {
  double f[4][2], x[2];
  unroll(in, face, f);
  x[0] = in->is_flat ? point[0] : unwrap(point[0], f[0][0]);
  x[1] = point[1];
  // A triangle is linear: one step is exact. A quadrilateral takes Newton steps on its bilinear map.
  double r = face->count == 3 ? 0 : 0.5, s = r;
  for (int step = 0; step < (face->count == 3 ? 1 : 20); ++step) {
    double m[2][2], residual[2];
    for (int k = 0; k < 2; ++k) {
      double bend = face->count == 3 ? 0 : f[0][k] - f[1][k] + f[2][k] - f[3][k];
      double along_s = (face->count == 3 ? f[2][k] : f[3][k]) - f[0][k];
      m[k][0] = f[1][k] - f[0][k] + s * bend;
      m[k][1] = along_s + r * bend;
      residual[k] = x[k] - f[0][k] - r * (f[1][k] - f[0][k]) - s * along_s - r * s * bend;
    }
    double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    if (determinant == 0) return -INFINITY;
    double dr = (residual[0] * m[1][1] - residual[1] * m[0][1]) / determinant;
    double ds = (m[0][0] * residual[1] - m[1][0] * residual[0]) / determinant;
    r += dr;
    s += ds;
    if (fabs(dr) + fabs(ds) < 1e-13) break;
  }
  rs[0] = r;
  rs[1] = s;
  double inside = face->count == 3 ? fmin(fmin(r, s), 1 - r - s) : fmin(fmin(r, 1 - r), fmin(s, 1 - s));
  return isnan(inside) ? -INFINITY : inside;
}

// The donor that holds the point, or where rounding leaves it just outside all of them, the nearest in its
// own parameters. Looks into wider rings of bins until one has been found.
static int64_t find_donor(const CwInterface *in, const Bins *bins, const CwInterfaceFace *donors, const double point[2],
                          double rs[2]) {
  int a0 = bin_at(bins, 0, point[0]), h0 = within(bin_at(bins, 1, point[1]), bins->number[1]);
  if (!bins->round) a0 = within(a0, bins->number[0]);
  int64_t best = -1;
  double best_inside = -INFINITY;
  int widest = bins->number[0] > bins->number[1] ? bins->number[0] : bins->number[1];
  for (int ring = 0; ring <= widest; ++ring) {
    for (int a = a0 - ring; a <= a0 + ring; ++a)
      for (int h = h0 - ring; h <= h0 + ring; ++h) {
        int rim = abs(a - a0) == ring || abs(h - h0) == ring;
        int off = !bins->round && (a < 0 || a >= bins->number[0]);
        if (!rim || off || h < 0 || h >= bins->number[1]) continue;
        const int64_t bin = (int64_t)around(bins, a) * bins->number[1] + h;
        for (int64_t i = bins->start[bin]; i < bins->start[bin + 1]; ++i) {
          double here[2] = {0};
          double inside = locate(in, &donors[bins->faces[i]], point, here);
          if (inside > best_inside || (inside == best_inside && bins->faces[i] < best)) {
            best_inside = inside;
            best = bins->faces[i];
            memcpy(rs, here, sizeof here);
          }
        }
      }
    if (best_inside > -1e-6 || (best >= 0 && ring > 0)) break;
  }
  for (int k = 0; k < 2; ++k) rs[k] = fmin(1, fmax(0, rs[k]));
  return best;
}

// The plane of a flat interface: through the mean of the nodes of side 0, normal to its area vector.
static void make_plane(const CwAssembly *a, int number, CwInterface *in) {
  const CwPatchPart *part = &a->patches[a->mesh->interfaces[number].patch[0]];
  const double length = cw_norm(part->vector);
  double nodes = 0;
  int least = 0;
  for (int64_t i = 0; i < in->count[0]; ++i)
    for (int n = 0; n < a->interface[number][0][i].count; ++n, ++nodes)
      for (int k = 0; k < 3; ++k) in->centre[k] += a->interface[number][0][i].nodes[n][k];
  double *n = in->axis[2], *u = in->axis[0];
  for (int k = 0; k < 3; ++k) {
    in->centre[k] /= nodes;
    n[k] = part->vector[k] / length;
    if (fabs(n[k]) < fabs(n[least])) least = k;
  }
  double across = sqrt(1 - n[least] * n[least]);
  for (int k = 0; k < 3; ++k) u[k] = ((k == least) - n[least] * n[k]) / across;
  cw_cross(n, u, in->axis[1]);
}

// How far a node is off the surface, m.
static double off_surface(const CwInterface *in, const double x[3]) {
  if (!in->is_flat) return fabs(hypot(x[0], x[1]) - in->radius);
  double off[3];
  cw_sub(x, in->centre, off);
  return fabs(cw_dot(in->axis[2], off));
}

// *longest: edge of a face.
static CwStatus measure_side(const CwAssembly *a, int number, int s, CwInterface *in, double *longest) {
  CwStatus status = CW_OK;
  int patch = a->mesh->interfaces[number].patch[s];
  CwInterfaceSide *side = &in->sides[s];
  *side = (CwInterfaceSide){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  for (int64_t i = 0; i < in->count[s]; ++i) {
    const CwInterfaceFace *face = &a->interface[number][s][i];
    const double *nodes[4];
    double flat[4][2];
    unroll(in, face, flat);
    for (int n = 0; n < face->count; ++n) nodes[n] = face->nodes[n];
    double tolerance = cw_interface_tolerance(face->count, nodes);
    for (int n = 0; n < face->count; ++n) {
      const double *x = nodes[n], *next = nodes[(n + 1) % face->count];
      double off = off_surface(in, x);
      *longest = fmax(*longest, hypot(hypot(next[0] - x[0], next[1] - x[1]), next[2] - x[2]));
      CW_REQUIRE(off <= tolerance || in->is_flat, CW_ERR_INPUT,
                 "patch '%s': node at (%.6g, %.6g, %.6g) mm has the radius %.9g mm; the interface has %.9g mm; allowed "
                 "beside edges as short as there: %.3g mm more or less",
                 a->mesh->patches[patch].name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2], 1e3 * hypot(x[0], x[1]),
                 1e3 * in->radius, 1e3 * tolerance);
      CW_REQUIRE(off <= tolerance, CW_ERR_INPUT,
                 "patch '%s': node at (%.6g, %.6g, %.6g) mm is %.3g mm off the interface's plane; allowed: %.3g mm",
                 a->mesh->patches[patch].name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2], 1e3 * off, 1e3 * tolerance);
      for (int k = 0; k < 2; ++k) {
        side->least[k] = fmin(side->least[k], flat[n][k]);
        side->most[k] = fmax(side->most[k], flat[n][k]);
      }
    }
  }
done:
  return status;
}

static CwStatus check_ends(const CwAssembly *a, int number, double tolerance, const CwInterface *in) {
  CwStatus status = CW_OK;
  const int *patch = a->mesh->interfaces[number].patch;
  const CwInterfaceSide *s = in->sides;
  for (int k = in->is_flat ? 0 : 1; k < 2; ++k)
    CW_REQUIRE(fabs(s[0].least[k] - s[1].least[k]) <= tolerance && fabs(s[0].most[k] - s[1].most[k]) <= tolerance,
               CW_ERR_INPUT,
               "the interface reaches from %s = %.6g to %.6g mm on patch '%s', but from %.6g to %.6g mm on '%s'; "
               "allowed: ends %.3g mm apart",
               in->is_flat ? (k ? "v" : "u") : "z", 1e3 * s[0].least[k], 1e3 * s[0].most[k],
               a->mesh->patches[patch[0]].name, 1e3 * s[1].least[k], 1e3 * s[1].most[k],
               a->mesh->patches[patch[1]].name, 1e3 * tolerance);
done:
  return status;
}

static CwStatus find_donors(const CwAssembly *a, int number, int side, CwInterface *in) {
  CwStatus status = CW_OK;
  Bins bins = {0};
  const int *patch = a->mesh->interfaces[number].patch;
  const CwInterfaceFace *mine = a->interface[number][side], *others = a->interface[number][1 - side];
  CW_TRY(make_bins(in, others, in->count[1 - side], &in->sides[1 - side], &bins));
  CW_NEW(in->donor[side], in->count[side]);
  CW_NEW(in->place[side], in->count[side]);
  for (int64_t i = 0; i < in->count[side]; ++i) {
    double flat[4][2], centre[2] = {0};
    unroll(in, &mine[i], flat);
    for (int n = 0; n < mine[i].count; ++n)
      for (int k = 0; k < 2; ++k) centre[k] += flat[n][k] / mine[i].count;
    if (!in->is_flat) centre[0] = remainder(centre[0], 2 * M_PI);
    in->donor[side][i] = find_donor(in, &bins, others, centre, in->place[side][i]);
    const double *x = mine[i].nodes[0];
    CW_REQUIRE(in->donor[side][i] >= 0, CW_ERR_INPUT,
               "patch '%s': no face of patch '%s' lies over its face at (%.6g, %.6g, %.6g) mm",
               a->mesh->patches[patch[side]].name, a->mesh->patches[patch[1 - side]].name, 1e3 * x[0], 1e3 * x[1],
               1e3 * x[2]);
  }
done:
  free(bins.start);
  free(bins.faces);
  return status;
}

// The donors on a surface of any shape.
static CwStatus find_nearest(const CwAssembly *a, int number, CwInterface *in) {
  CwStatus status = CW_OK;
  for (int s = 0; s < 2; ++s) {
    const int patch = a->mesh->interfaces[number].patch[s], other = a->mesh->interfaces[number].patch[1 - s];
    const CwInterfaceFace *mine = a->interface[number][s];
    double gap;
    int64_t worst;
    CW_NEW(in->donor[s], in->count[s]);
    CW_NEW(in->place[s], in->count[s]);
    CW_TRY(cw_interface_near(mine, in->count[s], a->interface[number][1 - s], in->count[1 - s], in->donor[s],
                             in->place[s], &gap, &worst));
    const double *x = mine[worst].nodes[0];
    CW_REQUIRE(gap <= WIDEST_GAP, CW_ERR_INPUT,
               "patch '%s': its face at (%.6g, %.6g, %.6g) mm is %.2g of its longest edge off patch '%s'; allowed: "
               "%.2g",
               a->mesh->patches[patch].name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2], gap, a->mesh->patches[other].name,
               WIDEST_GAP);
  }
done:
  return status;
}

CwStatus cw_interface_make(const CwAssembly *a, int number, CwInterface *in) {
  CwStatus status = CW_OK;
  const CwInterfaceSurface surface = a->mesh->interfaces[number].surface;
  const double radius = a->mesh->interfaces[number].radius;
  in->is_flat = surface == CW_SURFACE_PLANE;
  in->radius = radius;
  for (int s = 0; s < 2; ++s) in->count[s] = cw_face_count(a->patches[a->mesh->interfaces[number].patch[s]].faces);
  if (surface == CW_SURFACE_OTHER) return find_nearest(a, number, in);
  if (in->is_flat) make_plane(a, number, in);
  double size = in->is_flat ? sqrt(a->patches[a->mesh->interfaces[number].patch[0]].area / M_PI) : radius, longest = 0;
  for (int s = 0; s < 2; ++s) CW_TRY(measure_side(a, number, s, in, &longest));
  // The ends of a disc are corners of a polygon, within it by the rise of an arc over its longest edge at most.
  CW_TRY(check_ends(a, number, in->is_flat ? longest * longest / (8 * size) : ROUNDING * size, in));
  for (int s = 0; s < 2; ++s) CW_TRY(find_donors(a, number, s, in));
done:
  return status;
}
