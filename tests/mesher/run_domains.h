// SPDX-License-Identifier: AGPL-3.0-or-later
// A run of one process, over domains that a test has made up to some product.
#pragma once

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

extern "C" {
#include "mesher/run/run_step.h"

const CwTeam *cw_team_of(const CwContext *context); // team.h, which includes that of MPI
}

#include "domain_surfaces.h"
#include "solids.h"

struct DomainRun {
  std::unique_ptr<CwMeshRun> run = std::make_unique<CwMeshRun>();
  CwCase table = {};
  TemporaryFolder folder;
  std::vector<double> triangles = std::vector<double>(100, 1); // asked of each face

  DomainRun() {
    run->table = &table;
    run->run_path = folder.path.c_str();
    run->context.team = cw_team_of(nullptr);
    check(cw_record_start("mesh", nullptr, &run->record));
  }
  ~DomainRun() {
    cw_record_free(run->record);
  }
  CwDomain &domain(int d) {
    return run->domain[d];
  }
  // Adds a domain with the products there are; they stay those of `boundary`.
  void add(const char *name, CwCad *cad, const CwBackground &background, const CwPlan &plan,
           const DomainSurfaces &boundary) {
    CwDomain &domain = run->domain[run->model.domain_count++];
    assert_true(cw_cad_face_count(cad) <= (int)triangles.size());
    domain.name = name;
    domain.cad = cad;
    domain.background = background;
    domain.plan = plan;
    domain.face_triangles = triangles.data();
    domain.prism_integral = 1;
    domain.network = boundary.network;
    domain.images = boundary.images;
    domain.wall_curves = boundary.wall_curves;
    domain.surface = boundary.surface;
    domain.layers = boundary.layers;
    domain.input = {cad,    &domain.plan, &domain.network, &domain.images, boundary.input.size_at, boundary.input.size,
                    nullptr};
  }
  // The record as it stands.
  std::string record() const {
    const std::string path = folder.path + "/record.json";
    check(cw_record_write(run->record, path.c_str()));
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
};
