// SPDX-License-Identifier: AGPL-3.0-or-later
// Fills closed surfaces and prints a row: triangles, tetrahedra, seconds of one core, tetrahedra per second,
// bytes a tetrahedron (peak memory less that before), mean and greatest longest/shortest edge, least dihedral
// angle in degrees, mean ratio.
// Use: fill ring EDGE_LENGTH SURFACE       writes a ring-shaped surface with six blade-shaped voids
//      fill region REGION.h5 SURFACE       writes the inner boundary of a region of the mesher
//      fill kernel|tetgen SURFACE GROWTH   fills it; sizes are those of the surface and grow from it so
//      fill sizes SURFACE GROWTH SCALE FIELD   writes these sizes, so much scaled, as a structured field of gmsh
//      fill quality MESH                   of a mesh of somebody else
//      fill shape FILE ...                 shapes of the tetrahedra of regions or meshes together, see print_shapes
// Surfaces and meshes are MSH 2.2 files (text).
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "mesher/common/box.h"
#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/fill/fill_shape.h"
#include "mesher/fill/kernel.h"
#include "mesher/fill/tetgen_fill.h"
#include "mesher/region/region_file.h"
#include "mesher/size/size_grid.h"
#include "pipeline/log.h"
#include "tests/mesher/closed_surfaces.h"

static CwLog *test_log;

typedef struct {
  int32_t point_count, triangle_count, tetrahedron_count;
  double (*x)[3];
  int32_t (*triangle)[3], (*tetrahedron)[4];
} Mesh;

static void *take(size_t count, size_t size) {
  void *memory = calloc(count ? count : 1, size);
  if (!memory) {
    fprintf(stderr, "out of memory\n");
    exit(5);
  }
  return memory;
}

static void check(CwStatus status) {
  if (status == CW_OK) return;
  fprintf(stderr, "%s\n", cw_fail_message());
  exit((int)status);
}

static void check_kernel(const CwFillInput *input, CwFill *fill) {
  CwKernelOutcome outcome;
  check(cw_kernel_fill(input, fill, &outcome));
  if (outcome == CW_KERNEL_FILLED) return;
  fprintf(stderr, "the boundary was not recovered\n");
  exit(1);
}

enum { BLADES = 6 };

// shell_end: one past the last triangle of each closed part, which is a surface of its own number.
static void write_surface(const char *path, const Mesh *mesh, const int32_t *shell_end) {
  int shell = 1;
  FILE *file = fopen(path, "w");
  if (!file) perror(path), exit(4);
  fprintf(file, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n", mesh->point_count);
  for (int32_t p = 0; p < mesh->point_count; p++)
    fprintf(file, "%d %.17g %.17g %.17g\n", p + 1, mesh->x[p][0], mesh->x[p][1], mesh->x[p][2]);
  fprintf(file, "$EndNodes\n$Elements\n%d\n", mesh->triangle_count);
  for (int32_t t = 0; t < mesh->triangle_count; t++) {
    if (t == shell_end[shell - 1]) shell++;
    fprintf(file, "%d 2 2 1 %d %d %d %d\n", t + 1, shell, mesh->triangle[t][0] + 1, mesh->triangle[t][1] + 1,
            mesh->triangle[t][2] + 1);
  }
  fprintf(file, "$EndElements\n");
  if (fclose(file)) perror(path), exit(4);
}

static void read_mesh(const char *path, Mesh *mesh) {
  char line[512];
  int32_t items, number, *name = NULL, names = 0;
  FILE *file = fopen(path, "r");
  if (!file) perror(path), exit(4);
  memset(mesh, 0, sizeof *mesh);
  while (fgets(line, sizeof line, file)) {
    if (!strncmp(line, "$Nodes", 6)) {
      if (fscanf(file, "%d", &mesh->point_count) != 1) break;
      mesh->x = take((size_t)mesh->point_count, sizeof *mesh->x);
      name = take(16 * (size_t)mesh->point_count + 1024, sizeof *name);
      names = 16 * mesh->point_count + 1024;
      for (int32_t p = 0; p < mesh->point_count; p++) {
        if (fscanf(file, "%d %lf %lf %lf", &number, &mesh->x[p][0], &mesh->x[p][1], &mesh->x[p][2]) != 4 ||
            number < 0 || number >= names)
          fprintf(stderr, "%s: bad node\n", path), exit(3);
        name[number] = p;
      }
    } else if (!strncmp(line, "$Elements", 9)) {
      if (fscanf(file, "%d\n", &items) != 1) break;
      mesh->triangle = take((size_t)items, sizeof *mesh->triangle);
      mesh->tetrahedron = take((size_t)items, sizeof *mesh->tetrahedron);
      for (int32_t e = 0; e < items && fgets(line, sizeof line, file); e++) {
        int kind, tags, at = 0, more;
        if (sscanf(line, "%d %d %d%n", &number, &kind, &tags, &at) != 3) continue;
        for (int k = 0; k < tags; k++, at += more) sscanf(line + at, "%*d%n", &more);
        int32_t p[4];
        if (kind == 2 && sscanf(line + at, "%d %d %d", p, p + 1, p + 2) == 3) {
          for (int k = 0; k < 3; k++) mesh->triangle[mesh->triangle_count][k] = name[p[k]];
          mesh->triangle_count++;
        } else if (kind == 4 && sscanf(line + at, "%d %d %d %d", p, p + 1, p + 2, p + 3) == 4) {
          for (int k = 0; k < 4; k++) mesh->tetrahedron[mesh->tetrahedron_count][k] = name[p[k]];
          mesh->tetrahedron_count++;
        }
      }
    }
  }
  free(name);
  fclose(file);
}

// A torus of triangles; rows are shifted by half a triangle.
static void add_torus(Surface *s, double great, double small, double edge) {
  int rows = 2 * (int)ceil(3.141592653589793 * 2.0 * small / (edge * 0.8660254) / 2.0);
  int columns = (int)ceil(6.283185307179586 * great / edge);
  int32_t base = s->point_count;
  for (int r = 0; r < rows; r++) {
    for (int c = 0; c < columns; c++) {
      double u = 6.283185307179586 * (c + 0.5 * (r % 2)) / columns, v = 6.283185307179586 * r / rows;
      const double x[3] = {(great + small * cos(v)) * cos(u), (great + small * cos(v)) * sin(u), small * sin(v)};
      int d = (c + 1) % columns, above = (r + 1) % rows;
      int32_t a = base + r * columns + c, b = base + r * columns + d;
      int32_t e = base + above * columns + c, f = base + above * columns + d;
      surface_point(s, x);
      surface_triangle(s, a, b, r % 2 ? f : e);
      surface_triangle(s, r % 2 ? a : b, f, e);
    }
  }
}

// An ellipsoid across the ring at angle `turn`, its chord at 35 degrees to the way round; normals inward.
static void add_blade(Surface *s, double great, double turn, double edge) {
  static const double half[3] = {0.018, 0.013, 0.006}; // chord, span, thickness
  int level = 0;
  int32_t point = s->point_count, triangle = s->triangle_count;
  while (level < 5 && 1.05 * 0.015 / (1 << level) > edge) level++;
  surface_add_sphere(s, (double[3]){0, 0, 0}, 1.0, level, 0);
  for (; point < s->point_count; point++) {
    double *x = s->x[point], c = half[0] * x[0], r = half[1] * x[1], n = half[2] * x[2];
    double round = c * cos(0.61) - n * sin(0.61), up = c * sin(0.61) + n * cos(0.61);
    x[0] = (great + r) * cos(turn) - round * sin(turn);
    x[1] = (great + r) * sin(turn) + round * cos(turn);
    x[2] = up;
  }
  for (; triangle < s->triangle_count; triangle++) { // the map to (round, outward, up) mirrors
    int32_t *t = s->triangle[triangle], first = t[0];
    t[0] = t[2], t[2] = first;
  }
}

// Open faces of the tetrahedra of a region: its layer top, open patches and faces on partition planes.
static void region_surface(const char *path, Mesh *mesh) {
  static const int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  CwRegionMesh region;
  check(cw_region_read(path, &region));
  int32_t(*neighbour)[4] = take((size_t)region.cells.tetrahedron_count, sizeof *neighbour);
  int32_t *number = take((size_t)region.cells.point_count, sizeof *number);
  check(cw_tet_neighbours(region.cells.tetrahedron_count, (const int32_t(*)[4])region.cells.tetrahedra, neighbour));
  memset(mesh, 0, sizeof *mesh);
  mesh->x = take((size_t)region.cells.point_count, sizeof *mesh->x);
  mesh->triangle = take(4 * (size_t)region.cells.tetrahedron_count, sizeof *mesh->triangle);
  for (int32_t t = 0; t < region.cells.tetrahedron_count; t++) {
    for (int i = 0; i < 4; i++) {
      if (neighbour[t][i] >= 0) continue;
      int32_t *made = mesh->triangle[mesh->triangle_count++];
      for (int k = 0; k < 3; k++) {
        int32_t p = region.cells.tetrahedra[t][face[i][k]];
        if (!number[p]) {
          memcpy(mesh->x[mesh->point_count], region.cells.points[p], sizeof *mesh->x);
          number[p] = ++mesh->point_count;
        }
        made[k] = number[p] - 1;
      }
    }
  }
  free(neighbour);
  free(number);
  cw_region_free(&region);
}

static double size_at(const void *context, const double x[3]) {
  return cw_size_grid_at(context, x);
}

// Sizes as the surface has them, growing by `growth` a length into the inside.
static void make_size(const Mesh *mesh, double growth, CwSizeGrid *grid) {
  CwBox box = cw_box_of_points(mesh->point_count, (const double(*)[3])mesh->x);
  double mean = 0.0;
  double *length = take((size_t)mesh->triangle_count, sizeof *length);
  for (int32_t t = 0; t < mesh->triangle_count; t++) {
    for (int k = 0; k < 3; k++)
      length[t] += cw_distance(mesh->x[mesh->triangle[t][k]], mesh->x[mesh->triangle[t][(k + 1) % 3]]) / 3.0;
    mean += length[t] / mesh->triangle_count;
  }
  check(cw_size_grid_make(box.low, box.high, mean, 2000000, grid));
  for (int32_t t = 0; t < mesh->triangle_count; t++) {
    double x[3] = {0, 0, 0};
    for (int k = 0; k < 9; k++) x[k % 3] += mesh->x[mesh->triangle[t][k / 3]][k % 3] / 3.0;
    cw_size_grid_seed(grid, x, length[t]);
  }
  check(cw_size_grid_spread(grid, growth, NULL));
  free(length);
}

static double third(const void *context, const double x[3]) {
  return 1.0 / 3.0;
}

// A small box: from then on the program's own pages are in memory, which are none of a fill's.
static void fill_box(void) {
  Surface box = {0};
  CwFill fill;
  surface_add_box(&box, (double[3]){0, 0, 0}, (double[3]){1, 1, 1}, (int[3]){3, 3, 3}, 1);
  CwFillInput input = surface_fill_input(&box, third, NULL);
  input.offset_count = box.triangle_count;
  check_kernel(&input, &fill);
  cw_fill_free(&fill);
  surface_free(&box);
}

// On a regular grid over the surface: corner, spacing and number of nodes, then the sizes, the last axis first.
static void write_sizes(const char *path, const Mesh *mesh, const CwSizeGrid *grid, double scale) {
  enum { NODES = 96 }; // along the longest side
  CwBox box = cw_box_of_points(mesh->point_count, (const double(*)[3])mesh->x);
  const double *low = box.low, step = cw_box_longest(&box) / (NODES - 1);
  int nodes[3];
  FILE *file = fopen(path, "w");
  if (!file) perror(path), exit(4);
  for (int i = 0; i < 3; i++) nodes[i] = 2 + (int)((box.high[i] - low[i]) / step);
  fprintf(file, "%.17g %.17g %.17g\n%.17g %.17g %.17g\n%d %d %d\n", low[0], low[1], low[2], step, step, step, nodes[0],
          nodes[1], nodes[2]);
  for (int k = 0; k < nodes[0] * nodes[1] * nodes[2]; k++) {
    const double x[3] = {low[0] + step * (k / (nodes[1] * nodes[2])), low[1] + step * (k / nodes[2] % nodes[1]),
                         low[2] + step * (k % nodes[2])};
    fprintf(file, "%.6g\n", scale * size_at(grid, x));
  }
  if (fclose(file)) perror(path), exit(4);
}

// Of this process and of those that ended, as TetGen's.
static double seconds(void) {
  struct rusage own, ended;
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &ended);
  return (double)(own.ru_utime.tv_sec + ended.ru_utime.tv_sec) +
         1e-6 * (double)(own.ru_utime.tv_usec + ended.ru_utime.tv_usec);
}

// Of the larger of these processes.
static double peak(void) {
  struct rusage ended;
  getrusage(RUSAGE_CHILDREN, &ended);
  return fmax((double)cw_peak_memory_bytes(), 1024.0 * (double)ended.ru_maxrss);
}

static double resident(void) {
  long pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (file && fscanf(file, "%*d %ld", &pages) != 1) pages = 0;
  if (file) fclose(file);
  return (double)pages * (double)sysconf(_SC_PAGESIZE);
}

// Shapes of tetrahedra: all, those with a corner on a partition plane, the others.
typedef struct {
  int64_t count, aspect_class[8];
  double aspect_sum, aspect_most, dihedral_least, dihedral_greatest, ratio_sum, ratio_least;
} Shapes;

static void add_shape(Shapes *shapes, const double *corner[4]) {
  static const double limit[7] = {1.5, 2, 3, 4, 5, 7, 10}; // paper, Table 1
  CwTetShape shape;
  if (cw_tet_volume6(corner[0], corner[1], corner[2], corner[3]) < 0.0) {
    const double *swap = corner[0];
    corner[0] = corner[1];
    corner[1] = swap;
  }
  cw_tet_shape(corner, &shape);
  double aspect = shape.edge_longest / shape.edge_shortest;
  int class = 0;
  while (class < 7 && aspect > limit[class]) class ++;
  if (shapes->count++ == 0) shapes->dihedral_least = 180.0, shapes->ratio_least = 1.0;
  shapes->aspect_class[class]++;
  shapes->aspect_sum += aspect;
  shapes->aspect_most = fmax(shapes->aspect_most, aspect);
  shapes->dihedral_least = fmin(shapes->dihedral_least, shape.dihedral_least);
  shapes->dihedral_greatest = fmax(shapes->dihedral_greatest, shape.dihedral_greatest);
  shapes->ratio_sum += shape.mean_ratio;
  shapes->ratio_least = fmin(shapes->ratio_least, shape.mean_ratio);
}

static void add_shapes(Shapes shapes[3], int32_t count, const int32_t (*tetrahedron)[4], const double (*x)[3],
                       int32_t shared_count) {
  for (int32_t t = 0; t < count; t++) {
    const double *corner[4];
    int beside = 0;
    for (int i = 0; i < 4; i++) {
      corner[i] = x[tetrahedron[t][i]];
      beside |= tetrahedron[t][i] < shared_count;
    }
    add_shape(&shapes[0], corner);
    add_shape(&shapes[beside ? 1 : 2], corner);
  }
}

static void print_quality(int32_t count, const int32_t (*tetrahedron)[4], const double (*x)[3]) {
  Shapes shapes[3] = {{0}};
  add_shapes(shapes, count, tetrahedron, x, 0);
  printf("%.3f %.2f %.2f %.3f\n", shapes->aspect_sum / count, shapes->aspect_most, shapes->dihedral_least,
         shapes->ratio_sum / count);
}

// Three lines: name, number, the eight classes, aspect mean and most, dihedral angles, mean ratio mean and least.
static void print_shapes(int count, char **path) {
  static const char *const name[3] = {"all", "beside", "apart"};
  Shapes shapes[3] = {{0}};
  for (int k = 0; k < count; k++) {
    size_t length = strlen(path[k]);
    if (length > 3 && !strcmp(path[k] + length - 3, ".h5")) {
      CwRegionMesh region;
      check(cw_region_read(path[k], &region));
      add_shapes(shapes, region.cells.tetrahedron_count, (const int32_t(*)[4])region.cells.tetrahedra,
                 (const double(*)[3])region.cells.points, region.cells.shared_count);
      cw_region_free(&region);
    } else {
      Mesh mesh = {0};
      read_mesh(path[k], &mesh);
      add_shapes(shapes, mesh.tetrahedron_count, (const int32_t(*)[4])mesh.tetrahedron, (const double(*)[3])mesh.x, 0);
      free(mesh.x);
      free(mesh.triangle);
      free(mesh.tetrahedron);
    }
  }
  for (int k = 0; k < 3; k++) {
    const Shapes *s = &shapes[k];
    double number = s->count ? (double)s->count : 1.0;
    printf("%s %lld", name[k], (long long)s->count);
    for (int c = 0; c < 8; c++) printf(" %lld", (long long)s->aspect_class[c]);
    printf(" %.4f %.3f %.2f %.2f %.5f %.4f\n", s->aspect_sum / number, s->aspect_most, s->dihedral_least,
           s->dihedral_greatest, s->ratio_sum / number, s->ratio_least);
  }
}

int main(int argc, char **argv) {
  Mesh mesh = {0};
  if (argc == 4 && !strcmp(argv[1], "ring")) {
    double edge = atof(argv[2]);
    int32_t shell_end[1 + BLADES];
    Surface ring = {0};
    add_torus(&ring, 0.1, 0.03, edge);
    shell_end[0] = ring.triangle_count;
    for (int k = 0; k < BLADES; k++) {
      add_blade(&ring, 0.1, 6.283185307179586 * k / BLADES, 0.7 * edge);
      shell_end[k + 1] = ring.triangle_count;
    }
    mesh = (Mesh){ring.point_count, ring.triangle_count, 0, ring.x, ring.triangle, NULL};
    write_surface(argv[3], &mesh, shell_end);
  } else if (argc == 4 && !strcmp(argv[1], "region")) {
    region_surface(argv[2], &mesh);
    write_surface(argv[3], &mesh, &mesh.triangle_count);
  } else if (argc >= 3 && !strcmp(argv[1], "shape")) {
    print_shapes(argc - 2, argv + 2);
  } else if (argc == 3 && !strcmp(argv[1], "quality")) {
    read_mesh(argv[2], &mesh);
    printf("%d %d ", mesh.triangle_count, mesh.tetrahedron_count);
    print_quality(mesh.tetrahedron_count, (const int32_t(*)[4])mesh.tetrahedron, (const double(*)[3])mesh.x);
  } else if (argc == 6 && !strcmp(argv[1], "sizes")) {
    CwSizeGrid grid;
    read_mesh(argv[2], &mesh);
    make_size(&mesh, atof(argv[3]), &grid);
    write_sizes(argv[5], &mesh, &grid, atof(argv[4]));
    cw_size_grid_free(&grid);
  } else if (argc == 4 && (!strcmp(argv[1], "kernel") || !strcmp(argv[1], "tetgen"))) {
    CwSizeGrid grid;
    CwFill fill;
    check(cw_log_open("bench", NULL, 1, getenv("CUTWATER_VERBOSE") != NULL, &test_log));
    read_mesh(argv[2], &mesh);
    make_size(&mesh, atof(argv[3]), &grid);
    fill_box();
    CwFillInput input = {.point_count = mesh.point_count,
                         .x = (const double(*)[3])mesh.x,
                         .triangle_count = mesh.triangle_count,
                         .triangle = (const int32_t(*)[3])mesh.triangle,
                         .offset_count = mesh.triangle_count,
                         .size = size_at,
                         .size_context = &grid,
                         .name = "surface"};
    double before = resident(), start = seconds();
    if (argv[1][0] == 'k')
      check_kernel(&input, &fill);
    else
      check(cw_tetgen_fill(&input, &fill));
    double used = seconds() - start, bytes = peak() - before;
    printf("%d %d %.3f %.0f %.0f ", mesh.triangle_count, fill.tetrahedron_count, used, fill.tetrahedron_count / used,
           bytes / fill.tetrahedron_count);
    print_quality(fill.tetrahedron_count, (const int32_t(*)[4])fill.tetrahedron, (const double(*)[3])fill.x);
    cw_fill_free(&fill);
    cw_size_grid_free(&grid);
  } else {
    fprintf(stderr, "use: fill ring EDGE_LENGTH SURFACE | region REGION.h5 SURFACE | kernel|tetgen SURFACE GROWTH | "
                    "quality MESH | shape FILE ...\n");
    return 2;
  }
  free(mesh.x);
  free(mesh.triangle);
  free(mesh.tetrahedron);
  return 0;
}
