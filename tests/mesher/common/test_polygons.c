// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/polygons.h"
#include "tests/unit_test.h"

enum { MOST = 200 };

typedef struct {
  int32_t points, edges;
  double point[MOST][2];
  int32_t edge[MOST][2];
  uint8_t boundary[MOST];
} Graph;

static void add_edge(Graph *graph, int32_t a, int32_t b, int boundary) {
  graph->edge[graph->edges][0] = a;
  graph->edge[graph->edges][1] = b;
  graph->boundary[graph->edges++] = (uint8_t)boundary;
}

// A regular polygon; a square when corners is 4.
static void add_ring(Graph *graph, double x, double y, double radius, int corners) {
  int32_t first = graph->points;
  for (int i = 0; i < corners; i++) {
    double angle = 2 * M_PI * (i + 0.5) / corners;
    graph->point[graph->points][0] = x + radius * cos(angle);
    graph->point[graph->points++][1] = y + radius * sin(angle);
    add_edge(graph, first + i, first + (i + 1) % corners, 1);
  }
}

static CwStatus find(const Graph *graph, CwPolygons *polygons) {
  return cw_polygons_find(graph->points, (const double(*)[2])graph->point, graph->edges,
                          (const int32_t(*)[2])graph->edge, graph->boundary, polygons);
}

static double loop_area(const Graph *graph, const CwPolygons *polygons, int32_t loop) {
  double twice = 0;
  int32_t first = polygons->loop_start[loop], count = polygons->loop_start[loop + 1] - first;
  for (int32_t i = 0; i < count; i++) {
    const double *a = graph->point[polygons->corner[first + i]],
                 *b = graph->point[polygons->corner[first + (i + 1) % count]];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

static void ring_with_six_blades_is_one_polygon_with_seven_holes(void **state) {
  Graph graph = {0};
  add_ring(&graph, 0, 0, 10, 40);
  add_ring(&graph, 0, 0, 2, 20);
  for (int b = 0; b < 6; b++) add_ring(&graph, 6 * cos(b * M_PI / 3), 6 * sin(b * M_PI / 3), 1, 8);
  CwPolygons polygons;
  assert_int_equal(find(&graph, &polygons), CW_OK);
  assert_int_equal(polygons.polygon_count, 1);
  assert_int_equal(polygons.loop_count, 8);
  assert_true(loop_area(&graph, &polygons, 0) > 0);
  for (int l = 1; l < 8; l++) assert_true(loop_area(&graph, &polygons, l) < 0);
  cw_polygons_free(&polygons);
}

static void island_in_a_hole_is_a_polygon_of_its_own(void **state) {
  Graph graph = {0};
  add_ring(&graph, 0, 0, 3, 4);
  add_ring(&graph, 0, 0, 2, 4);
  add_ring(&graph, 0, 0, 1, 4);
  CwPolygons polygons;
  assert_int_equal(find(&graph, &polygons), CW_OK);
  assert_int_equal(polygons.polygon_count, 2);
  assert_int_equal(polygons.loop_count, 3);
  double area = 0;
  for (int l = 0; l < 3; l++) area += loop_area(&graph, &polygons, l);
  assert_true(fabs(area - (2 * 9 - 2 * 4 + 2)) < 1e-12); // a square of radius r has area 2 r^2
  cw_polygons_free(&polygons);
}

// A square divided by a line that carries no boundary: two polygons, which cover it without overlap.
static void line_of_another_plane_divides(void **state) {
  Graph graph = {.points = 6, .point = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}};
  for (int i = 0; i < 6; i++) add_edge(&graph, i, (i + 1) % 6, 1);
  add_edge(&graph, 1, 4, 0);
  CwPolygons polygons;
  assert_int_equal(find(&graph, &polygons), CW_OK);
  assert_int_equal(polygons.polygon_count, 2);
  assert_true(fabs(loop_area(&graph, &polygons, 0) - 1) < 1e-12);
  assert_true(fabs(loop_area(&graph, &polygons, 1) - 1) < 1e-12);
  cw_polygons_free(&polygons);
}

static void open_outline_is_named_with_its_place(void **state) {
  Graph graph = {.points = 4, .point = {{0, 0}, {0.001, 0}, {0.001, 0.002}, {0, 0.002}}};
  for (int i = 0; i < 3; i++) add_edge(&graph, i, i + 1, 1);
  CwPolygons polygons;
  assert_int_equal(find(&graph, &polygons), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "(0.0000, 0.0000) mm"));
}

static void edges_that_cross_are_found(void **state) {
  Graph graph = {0};
  int32_t count, (*crossing)[4];
  add_ring(&graph, 0, 0, 3, 30);
  add_ring(&graph, 1, 0, 0.5, 12);
  for (int apart = 1; apart >= 0; apart--) {
    assert_int_equal(cw_polygons_crossings(graph.points, (const double(*)[2])graph.point, graph.edges,
                                           (const int32_t(*)[2])graph.edge, &count, &crossing),
                     CW_OK);
    assert_int_equal(count, apart ? 0 : 2);
    free(crossing);
    add_ring(&graph, 3, 0, 0.7, 9); // crosses the large ring twice
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edges_that_cross_are_found),
      cmocka_unit_test(ring_with_six_blades_is_one_polygon_with_seven_holes),
      cmocka_unit_test(island_in_a_hole_is_a_polygon_of_its_own),
      cmocka_unit_test(line_of_another_plane_divides),
      cmocka_unit_test(open_outline_is_named_with_its_place),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
