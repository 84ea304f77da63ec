// SPDX-License-Identifier: AGPL-3.0-or-later
// The domains of a case's pump as the mesher has them before they are planned, with sizes and layers, for tests of what
// plans them. Its solids are made by cutwater-geometry.
#pragma once

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesher/cad/background_tessellate.h"
#include "mesher/cad/symmetry.h"
#include "mesher/run/domain_size.h"
#include "mesher/thickness/layer_count.h"
#include "pipeline/case_read.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static const char *case_name = "paper";
static CwCase table;
static CwModel model;
static CwDomain domain[CW_DOMAINS_MOST];
static CwSymmetry *symmetry; // of the rotor
static double prism_factor;
static const double TET_FACTOR = 11.6;

static inline void check(CwStatus status) {
  if (status != CW_OK) fail_msg("%s", cw_fail_message());
}

static inline void open_domain(CwDomain *made, int number, const char *folder) {
  void **part, **seed, **field;
  int64_t size;
  check(cw_domain_open(made, &model, number, folder));
  check(cw_domain_ask(made, &table));
  cw_domain_set_layers(made, &table, table.walls.layer_count > 0 ? table.walls.layer_count : CW_LAYERS_LEAST,
                       CW_LOG_LAYER_Y_PLUS);
  int faces = cw_cad_face_count(made->cad);
  part = calloc((size_t)faces, sizeof *part);
  assert_non_null(part);
  check(cw_domain_start_background(made, 4e-5));
  made->base_size = 2e-3;
  for (int f = 0; f < faces; f++) check(cw_tessellation_face(made->tessellation, f, &part[f], &size));
  check(cw_domain_take_background(NULL, made, part));
  for (int f = 0; f < faces; f++) free(part[f]);
  free(part);
  made->face_radius = calloc((size_t)faces, sizeof *made->face_radius);
  assert_non_null(made->face_radius);
  check(cw_face_radii(made->cad, &made->background, made->face_radius));
  int seeds = cw_size_seed_parts(made->cad);
  seed = calloc((size_t)seeds, sizeof *seed);
  assert_non_null(seed);
  for (int i = 0; i < seeds; i++) check(cw_domain_seed(made, &table, i, &seed[i], &size));
  int parts = cw_domain_size_parts(made);
  field = calloc((size_t)parts, sizeof *field);
  assert_non_null(field);
  for (int i = 0; i < parts; i++)
    check(cw_domain_make_size(made, &table, table.mesh.gradation, 0, 0, NULL, seed, i, &field[i], &size));
  check(cw_domain_take_size(NULL, made, 0, field));
  for (int i = 0; i < seeds; i++) free(seed[i]);
  free(seed);
  for (int i = 0; i < parts; i++) free(field[i]);
  free(field);
}

static inline int open_pump(void **state) {
  char command[1024], case_path[512];
  assert_int_equal(make_test_folder(state), 0);
  snprintf(case_path, sizeof case_path, "%s/cases/%s/case.yaml", CUTWATER_SOURCE_DIR, case_name);
  snprintf(command, sizeof command, "%s/cutwater-geometry --case %s --run %s > /dev/null 2>&1", CUTWATER_BIN_DIR,
           case_path, test_folder);
  assert_int_equal(system(command), 0);
  check(cw_case_read(case_path, &table));
  check(cw_model_read(in_test_folder("geometry/model.json"), &model));
  for (int d = 0; d < model.domain_count; d++) open_domain(&domain[d], d, in_test_folder("geometry"));
  prism_factor = 2.45 * domain[0].layer_count;
  check(cw_symmetry_find(domain[0].cad, &domain[0].background, &symmetry));
  assert_true(symmetry || strcmp(case_name, "paper") != 0);
  assert_int_equal(clear_test_folder(state), 0);
  return 0;
}

static inline int close_pump(void **state) {
  for (int d = 0; d < model.domain_count; d++) cw_domain_close(&domain[d]);
  cw_symmetry_free(&symmetry);
  cw_model_free(&model);
  return 0;
}

// Predicted cells of a domain.
static inline double cells_at(const CwDomain *of, double scale) {
  return prism_factor * of->prism_integral / (scale * scale) +
         TET_FACTOR * cw_domain_tet_integral(of, scale) / (scale * scale * scale);
}
