// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_clear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/predicates.h"
#include "mesher/common/vec.h"

static const int8_t tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
static const int8_t tet_edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

enum { GROUP = 8, SIDES = 4 * CW_FLIP, GROWTH = 12 };

typedef struct {
  int32_t corner[3]; // seen from inside the hollow: with a point inside a positive tetrahedron
  int32_t outer;     // tetrahedron beyond, -1 for none
  int part;          // 0 or 1: of the two that the facets make
} Wall;

typedef struct {
  CwFlips *flips;
  const CwFacets *facets;
  int32_t group[GROUP]; // facets
  int group_count;
  int32_t rim[3 * GROUP][2], cut[3 * GROUP][2]; // edges of the group: once, as the facet goes; missing, twice
  int rim_count, cut_count;
  int32_t tet[CW_FLIP];
  int tet_count;
  Wall wall[SIDES];
  int wall_count;
} Hollow;

int cw_kernel_meet(const CwDelaunay *mesh, int32_t a, int32_t b, const int32_t t[3]) {
  const CwDelaunayPoint *p = mesh->point;
  int below = cw_orient3d(p[t[0]].x, p[t[1]].x, p[t[2]].x, p[a].x);
  int above = cw_orient3d(p[t[0]].x, p[t[1]].x, p[t[2]].x, p[b].x), low = 0, high = 0;
  if (below * above > 0 || (below == 0 && above == 0)) return 0;
  for (int k = 0; k < 3; k++) {
    int s = cw_orient3d(p[a].x, p[b].x, p[t[k]].x, p[t[(k + 1) % 3]].x);
    low |= s < 0;
    high |= s > 0;
  }
  return !(low && high);
}

static int has(const int32_t *list, int count, int32_t item) {
  for (int k = 0; k < count; k++) {
    if (list[k] == item) return 1;
  }
  return 0;
}

// The missing facets that hang together over missing edges, and the edges of that group. 0: too many.
static CwStatus gather_group(Hollow *h, int32_t facet, int *good) {
  CwStatus status = CW_OK;
  *good = 0;
  h->group[h->group_count++] = facet;
  for (int head = 0; head < h->group_count; head++) {
    const int32_t *p = h->facets->corner[h->group[head]];
    for (int k = 0; k < 3; k++) {
      int32_t a = p[k], b = p[(k + 1) % 3], t;
      CW_TRY(cw_flips_find_edge(h->flips, a, b, &t));
      int other = -1;
      for (int32_t f = 0; f < h->facets->count && t < 0; f++) { // rare: no need of a table
        const int32_t *q = h->facets->corner[f];
        if (h->facets->inner[f] >= 0 || !has(q, 3, a) || !has(q, 3, b) || f == h->group[head]) continue;
        if (other >= 0) goto done; // more than two facets at an edge
        other = f;
      }
      int32_t *edge = t >= 0 ? h->rim[h->rim_count++] : h->cut[h->cut_count++];
      edge[0] = a;
      edge[1] = b;
      if (t >= 0) continue;
      if (other < 0) goto done;
      if (has(h->group, h->group_count, other)) continue;
      if (h->group_count == GROUP) goto done;
      h->group[h->group_count++] = other;
    }
  }
  *good = 1;
done:
  return status;
}

static int crosses(const Hollow *h, const CwDelaunayTet *tet) {
  for (int e = 0; e < 6; e++) {
    int32_t a = tet->corner[tet_edge[e][0]], b = tet->corner[tet_edge[e][1]];
    for (int g = 0; g < h->group_count; g++) {
      const int32_t *p = h->facets->corner[h->group[g]];
      if (!has(p, 3, a) && !has(p, 3, b) && cw_kernel_meet(h->flips->mesh, a, b, p)) return 1;
    }
  }
  for (int i = 0; i < 4; i++) {
    const int32_t f[3] = {tet->corner[tet_face[i][0]], tet->corner[tet_face[i][1]], tet->corner[tet_face[i][2]]};
    for (int c = 0; c < h->cut_count; c++) {
      const int32_t *e = h->cut[c];
      if (!has(f, 3, e[0]) && !has(f, 3, e[1]) && cw_kernel_meet(h->flips->mesh, e[0], e[1], f)) return 1;
    }
  }
  return 0;
}

// Tetrahedra that cross the group, from the stars of its points on. 0: too many.
static CwStatus gather_tets(Hollow *h, int *good) {
  CwStatus status = CW_OK;
  const CwDelaunay *mesh = h->flips->mesh;
  *good = 0;
  for (int g = 0; g < 3 * h->group_count; g++) {
    CW_TRY(cw_flips_star(h->flips, h->facets->corner[h->group[g / 3]][g % 3]));
    for (int32_t k = 0; k < h->flips->star_count; k++) {
      int32_t t = h->flips->star[k];
      if (has(h->tet, h->tet_count, t) || !crosses(h, &mesh->tet[t])) continue;
      if (h->tet_count == CW_FLIP / 2) goto done;
      h->tet[h->tet_count++] = t;
    }
  }
  for (int head = 0; head < h->tet_count; head++) {
    for (int i = 0; i < 4; i++) {
      int32_t next = mesh->tet[h->tet[head]].neighbour[i] / 4;
      if (mesh->tet[h->tet[head]].neighbour[i] < 0 || has(h->tet, h->tet_count, next) || !crosses(h, &mesh->tet[next]))
        continue;
      if (h->tet_count == CW_FLIP / 2) goto done;
      h->tet[h->tet_count++] = next;
    }
  }
  *good = h->tet_count > 0;
done:
  return status;
}

static int on_rim(const Hollow *h, int32_t a, int32_t b) {
  for (int k = 0; k < h->rim_count; k++) {
    if ((h->rim[k][0] == a && h->rim[k][1] == b) || (h->rim[k][0] == b && h->rim[k][1] == a)) return 1;
  }
  return 0;
}

// The walls of the hollow, each with its part; false where no facet may be taken away, a point would be lost,
// or the group does not part the hollow in two. Part 0 lies where the facets' normals point.
static int find_walls(Hollow *h) {
  const CwDelaunay *mesh = h->flips->mesh;
  h->wall_count = 0;
  for (int k = 0; k < h->tet_count; k++) {
    const CwDelaunayTet *tet = &mesh->tet[h->tet[k]];
    for (int i = 0; i < 4; i++) {
      const int32_t f[3] = {tet->corner[tet_face[i][0]], tet->corner[tet_face[i][1]], tet->corner[tet_face[i][2]]};
      int32_t next = tet->neighbour[i] < 0 ? -1 : tet->neighbour[i] / 4;
      if (next >= 0 && has(h->tet, h->tet_count, next)) {
        if (cw_facets_find(h->facets, f) >= 0) return 0;
        continue;
      }
      h->wall[h->wall_count++] = (Wall){{f[0], f[2], f[1]}, next, -1};
    }
  }
  for (int k = 0; k < 4 * h->tet_count; k++) {
    int32_t point = mesh->tet[h->tet[k / 4]].corner[k % 4];
    int seen = 0;
    for (int w = 0; w < h->wall_count && !seen; w++) seen = has(h->wall[w].corner, 3, point);
    if (!seen) return 0;
  }
  // Walls at a rim edge: the one that runs along it as the facet does lies beyond the normal, with the facet
  // turned.
  for (int w = 0; w < h->wall_count; w++) {
    for (int e = 0; e < 3; e++) {
      for (int k = 0; k < h->rim_count; k++) {
        int32_t a = h->wall[w].corner[e], b = h->wall[w].corner[(e + 1) % 3];
        int part = a == h->rim[k][1] && b == h->rim[k][0] ? 0 : a == h->rim[k][0] && b == h->rim[k][1] ? 1 : -1;
        if (part < 0) continue;
        if (h->wall[w].part == 1 - part) return 0;
        h->wall[w].part = part;
      }
    }
  }
  for (int changed = 1; changed;) {
    changed = 0;
    for (int w = 0; w < h->wall_count; w++) {
      for (int e = 0; e < 3; e++) {
        int32_t a = h->wall[w].corner[e], b = h->wall[w].corner[(e + 1) % 3];
        int others = 0;
        for (int v = 0; v < h->wall_count; v++) {
          if (v == w || !has(h->wall[v].corner, 3, a) || !has(h->wall[v].corner, 3, b)) continue;
          others++;
          if (on_rim(h, a, b)) continue;
          if (h->wall[w].part >= 0 && h->wall[v].part < 0) {
            h->wall[v].part = h->wall[w].part;
            changed = 1;
          } else if (h->wall[w].part >= 0 && h->wall[v].part != h->wall[w].part) {
            return 0;
          }
        }
        if (others != 1) return 0;
      }
    }
  }
  int count[2] = {0, 0}, rims = 0;
  for (int w = 0; w < h->wall_count; w++) {
    if (h->wall[w].part < 0) return 0;
    count[h->wall[w].part]++;
    for (int e = 0; e < 3; e++) rims += on_rim(h, h->wall[w].corner[e], h->wall[w].corner[(e + 1) % 3]);
  }
  return count[0] > 0 && count[1] > 0 && rims == 2 * h->rim_count;
}

// Faces of one part, walls first, then the facets turned to it; with a point inside each is a positive
// tetrahedron.
static int part_faces(const Hollow *h, int part, int32_t (*face)[4], int32_t *outer) {
  int count = 0;
  for (int w = 0; w < h->wall_count; w++) {
    if (h->wall[w].part != part) continue;
    memcpy(face[count], h->wall[w].corner, sizeof h->wall[w].corner);
    outer[count++] = h->wall[w].outer;
  }
  for (int g = 0; g < h->group_count; g++) {
    const int32_t *p = h->facets->corner[h->group[g]];
    const int32_t up[3] = {p[0], p[1], p[2]}, down[3] = {p[0], p[2], p[1]};
    memcpy(face[count], part == 0 ? up : down, sizeof up);
    outer[count++] = -1;
  }
  return count;
}

// The point that is furthest above the lowest of all planes, nearly; gives its least height and that face.
static double highest_point(const CwDelaunay *mesh, int count, int32_t (*face)[4], double p[3], int *lowest) {
  double normal[CW_FLIP][3], size = 0.0, best = -INFINITY, now[3] = {0, 0, 0};
  for (int k = 0; k < count; k++) {
    const double *a = mesh->point[face[k][0]].x, *b = mesh->point[face[k][1]].x, *c = mesh->point[face[k][2]].x;
    double u[3], v[3];
    cw_sub(b, a, u);
    cw_sub(c, a, v);
    cw_cross(u, v, normal[k]);
    size = fmax(size, sqrt(cw_unit(normal[k])));
    for (int i = 0; i < 3; i++) now[i] += (a[i] + b[i] + c[i]) / (3.0 * count);
  }
  for (double step = 0.3 * size; step > 1e-4 * size; step *= 0.97) {
    double least = INFINITY;
    int worst = 0;
    for (int k = 0; k < count; k++) {
      double d[3];
      cw_sub(now, mesh->point[face[k][0]].x, d);
      double height = cw_dot(d, normal[k]);
      if (height >= least) continue;
      least = height;
      worst = k;
    }
    if (least > best) {
      best = least;
      *lowest = worst;
      memcpy(p, now, sizeof now);
    }
    for (int i = 0; i < 3; i++) now[i] += step * normal[worst][i];
  }
  for (int k = 0; k < count; k++) {
    if (cw_orient3d(mesh->point[face[k][0]].x, mesh->point[face[k][1]].x, mesh->point[face[k][2]].x, p) <= 0)
      return -1.0;
  }
  return best / size;
}

CwStatus cw_kernel_clear(CwFlips *flips, const CwFacets *facets, int32_t facet, int32_t *source_count, int *found) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = flips->mesh;
  Hollow *h = NULL;
  int32_t face[2][CW_FLIP][4], outer[2][CW_FLIP], made[CW_FLIP][4], slot[CW_FLIP];
  int good;
  *found = 0;
  CW_NEW(h, 1);
  h->flips = flips;
  h->facets = facets;
  CW_TRY(gather_group(h, facet, &good));
  if (good) CW_TRY(gather_tets(h, &good));
  for (int growth = 0; growth < GROWTH && good && h->tet_count <= CW_FLIP / 2; growth++) {
    if (!find_walls(h) || h->wall_count + 2 * h->group_count > CW_FLIP) goto done;
    double p[2][3], height[2];
    int count[2], lowest[2] = {0, 0};
    for (int part = 0; part < 2; part++) {
      count[part] = part_faces(h, part, face[part], outer[part]);
      height[part] = highest_point(mesh, count[part], face[part], p[part], &lowest[part]);
    }
    int part = height[0] < height[1] ? 0 : 1;
    if (height[part] <= 1e-6) { // a part does not see all of its walls: take away what the lowest one hides
      int32_t next = outer[part][lowest[part]];
      if (next < 0 || cw_facets_find(facets, face[part][lowest[part]]) >= 0) goto done;
      h->tet[h->tet_count++] = next;
      continue;
    }
    int total = 0;
    for (part = 0; part < 2; part++) {
      int32_t point;
      CW_TRY(cw_flips_add_point(flips, p[part], (*source_count)++, &point));
      for (int k = 0; k < count[part]; k++) {
        memcpy(made[total], face[part][k], 3 * sizeof(int32_t));
        made[total++][3] = point;
      }
    }
    CW_TRY(cw_flips_replace(flips, h->tet_count, h->tet, total, (const int32_t(*)[4])made, slot));
    *found = 1;
    goto done;
  }
done:
  free(h);
  return status;
}
