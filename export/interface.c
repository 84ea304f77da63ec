// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/interface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double RELATIVE_TOLERANCE = 1e-4;

// Donor faces by the bins of (angle, z) that they reach into.
typedef struct {
  int angles, heights;
  double z0, dz, dangle;
  int64_t *start; // angles * heights + 1
  int64_t *faces;
} Bins;

void cw_interface_free(CwInterface *interface) {
  for (int d = 0; d < CW_EXPORT_DOMAINS; ++d) {
    free(interface->donor[d]);
    free(interface->place[d]);
  }
  memset(interface, 0, sizeof *interface);
}

// `angle` brought within half a turn of `near`.
static double unwrap(double angle, double near) {
  return near + remainder(angle - near, 2 * M_PI);
}

// The nodes of a face as (angle, z), continuous across the half plane where atan2 jumps.
static void unroll(const CwInterfaceFace *face, double flat[4][2]) {
  for (int i = 0; i < face->count; ++i) {
    double angle = atan2(face->nodes[i][1], face->nodes[i][0]);
    flat[i][0] = i ? unwrap(angle, flat[0][0]) : angle;
    flat[i][1] = face->nodes[i][2];
  }
}

// Calls for the bins that the box of a face reaches: counts (faces NULL) or fills.
static void bin_face(const Bins *bins, const CwInterfaceFace *face, int64_t place, int64_t *start,
                     int64_t *faces) {
  double flat[4][2], low[2], high[2];
  unroll(face, flat);
  for (int k = 0; k < 2; ++k) {
    low[k] = high[k] = flat[0][k];
    for (int i = 1; i < face->count; ++i) {
      low[k] = fmin(low[k], flat[i][k]);
      high[k] = fmax(high[k], flat[i][k]);
    }
  }
  int a0 = (int)floor((low[0] + M_PI) / bins->dangle), a1 = (int)floor((high[0] + M_PI) / bins->dangle);
  int h0 = (int)floor((low[1] - bins->z0) / bins->dz), h1 = (int)floor((high[1] - bins->z0) / bins->dz);
  if (a1 >= a0 + bins->angles)
    a1 = a0 + bins->angles - 1;
  for (int a = a0; a <= a1; ++a)
    for (int h = h0 < 0 ? 0 : h0; h <= (h1 >= bins->heights ? bins->heights - 1 : h1); ++h) {
      int bin = ((a % bins->angles + bins->angles) % bins->angles) * bins->heights + h;
      if (faces)
        faces[start[bin]++] = place;
      else
        ++start[bin + 1];
    }
}

static CwStatus make_bins(const CwInterfaceFace *faces, int64_t count, const CwInterfaceSide *side,
                          Bins *bins) {
  CwStatus status = CW_OK;
  double height = side->z_most - side->z_least, around = 2 * M_PI * side->radius_most;
  // About as many bins as faces, and square ones.
  double size = sqrt(around * height / (double)count);
  bins->angles = (int)fmax(1, around / size);
  bins->heights = (int)fmax(1, height / size);
  bins->z0 = side->z_least;
  bins->dz = height / bins->heights * (1 + 1e-12);
  bins->dangle = 2 * M_PI / bins->angles;
  int bin_count = bins->angles * bins->heights;
  CW_NEW(bins->start, bin_count + 1);
  for (int64_t i = 0; i < count; ++i)
    bin_face(bins, &faces[i], i, bins->start, NULL);
  for (int b = 0; b < bin_count; ++b)
    bins->start[b + 1] += bins->start[b];
  CW_NEW(bins->faces, bins->start[bin_count]);
  for (int64_t i = 0; i < count; ++i)
    bin_face(bins, &faces[i], i, bins->start, bins->faces);
  // Each start has moved to the end of its bin: shift back.
  memmove(bins->start + 1, bins->start, (size_t)bin_count * sizeof *bins->start);
  bins->start[0] = 0;
done:
  return status;
}

// Where (angle, z) lies in a face: r, s. Returns how far inside, below 0 outside, in parts of the face.
static double locate(const CwInterfaceFace *face, const double point[2], double rs[2]) {
  double f[4][2], x[2];
  unroll(face, f);
  x[0] = unwrap(point[0], f[0][0]);
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
    if (determinant == 0)
      return -INFINITY;
    double dr = (residual[0] * m[1][1] - residual[1] * m[0][1]) / determinant;
    double ds = (m[0][0] * residual[1] - m[1][0] * residual[0]) / determinant;
    r += dr;
    s += ds;
    if (fabs(dr) + fabs(ds) < 1e-13)
      break;
  }
  rs[0] = r;
  rs[1] = s;
  double inside = face->count == 3 ? fmin(fmin(r, s), 1 - r - s) : fmin(fmin(r, 1 - r), fmin(s, 1 - s));
  return isnan(inside) ? -INFINITY : inside;
}

// The donor that holds the point, or where rounding leaves it just outside all of them, the nearest in its
// own parameters. Looks into wider rings of bins until one has been found.
static int64_t find_donor(const Bins *bins, const CwInterfaceFace *donors, const double point[2],
                          double rs[2]) {
  int a0 = (int)floor((point[0] + M_PI) / bins->dangle), h0 = (int)floor((point[1] - bins->z0) / bins->dz);
  h0 = h0 < 0 ? 0 : h0 >= bins->heights ? bins->heights - 1 : h0;
  int64_t best = -1;
  double best_inside = -INFINITY;
  int widest = bins->angles > bins->heights ? bins->angles : bins->heights;
  for (int ring = 0; ring <= widest; ++ring) {
    for (int a = a0 - ring; a <= a0 + ring; ++a)
      for (int h = h0 - ring; h <= h0 + ring; ++h) {
        int rim = abs(a - a0) == ring || abs(h - h0) == ring;
        if (!rim || h < 0 || h >= bins->heights)
          continue;
        int bin = ((a % bins->angles + bins->angles) % bins->angles) * bins->heights + h;
        for (int64_t i = bins->start[bin]; i < bins->start[bin + 1]; ++i) {
          double here[2] = {0};
          double inside = locate(&donors[bins->faces[i]], point, here);
          if (inside > best_inside || (inside == best_inside && bins->faces[i] < best)) {
            best_inside = inside;
            best = bins->faces[i];
            memcpy(rs, here, sizeof here);
          }
        }
      }
    if (best_inside > -1e-6 || (best >= 0 && ring > 0))
      break;
  }
  for (int k = 0; k < 2; ++k)
    rs[k] = fmin(1, fmax(0, rs[k]));
  return best;
}

static CwStatus measure_side(const CwAssembly *a, int d, int64_t count, double radius,
                             CwInterfaceSide *side) {
  CwStatus status = CW_OK;
  const CwInterfaceFace *faces = a->interface[d];
  int patch = cw_mesh_patch_of_kind(a->mesh, d, CW_KIND_INTERFACE);
  *side = (CwInterfaceSide){INFINITY, 0, INFINITY, -INFINITY, a->patches[patch].area};
  for (int64_t i = 0; i < count; ++i)
    for (int n = 0; n < faces[i].count; ++n) {
      const double *x = faces[i].nodes[n];
      double r = hypot(x[0], x[1]);
      CW_REQUIRE(
          fabs(r - radius) <= RELATIVE_TOLERANCE * radius, CW_ERR_INPUT,
          "patch '%s': node at (%.6g, %.6g, %.6g) mm has the radius %.6g mm; the interface has %.6g mm",
          a->mesh->patches[patch].name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2], 1e3 * r, 1e3 * radius);
      side->radius_least = fmin(side->radius_least, r);
      side->radius_most = fmax(side->radius_most, r);
      side->z_least = fmin(side->z_least, x[2]);
      side->z_most = fmax(side->z_most, x[2]);
    }
done:
  return status;
}

CwStatus cw_interface_make(const CwAssembly *a, double radius, CwInterface *interface) {
  CwStatus status = CW_OK;
  Bins bins = {0};
  for (int d = 0; d < CW_EXPORT_DOMAINS; ++d) {
    int patch = cw_mesh_patch_of_kind(a->mesh, d, CW_KIND_INTERFACE);
    interface->count[d] = a->patches[patch].triangles + a->patches[patch].quads;
    CW_TRY(measure_side(a, d, interface->count[d], radius, &interface->sides[d]));
  }
  const CwInterfaceSide *s = interface->sides;
  CW_REQUIRE(
      fabs(s[0].z_least - s[1].z_least) <= RELATIVE_TOLERANCE * radius &&
          fabs(s[0].z_most - s[1].z_most) <= RELATIVE_TOLERANCE * radius,
      CW_ERR_INPUT,
      "the interface reaches from z = %.6g to %.6g mm in the rotor, but from %.6g to %.6g mm in the stator",
      1e3 * s[0].z_least, 1e3 * s[0].z_most, 1e3 * s[1].z_least, 1e3 * s[1].z_most);
  for (int d = 0; d < CW_EXPORT_DOMAINS; ++d) {
    int other = 1 - d;
    CW_TRY(make_bins(a->interface[other], interface->count[other], &s[other], &bins));
    CW_NEW(interface->donor[d], interface->count[d]);
    CW_NEW(interface->place[d], interface->count[d]);
    for (int64_t i = 0; i < interface->count[d]; ++i) {
      const CwInterfaceFace *face = &a->interface[d][i];
      double flat[4][2], centre[2] = {0};
      unroll(face, flat);
      for (int n = 0; n < face->count; ++n)
        for (int k = 0; k < 2; ++k)
          centre[k] += flat[n][k] / face->count;
      centre[0] = remainder(centre[0], 2 * M_PI);
      interface->donor[d][i] = find_donor(&bins, a->interface[other], centre, interface->place[d][i]);
      CW_REQUIRE(interface->donor[d][i] >= 0, CW_ERR_INPUT,
                 "interface face %lld has no face on the other side", (long long)i);
    }
    free(bins.start);
    free(bins.faces);
    bins = (Bins){0};
  }
done:
  free(bins.start);
  free(bins.faces);
  return status;
}
