// SPDX-License-Identifier: AGPL-3.0-or-later
// What the solids are for another program that goes on with them: OpenCASCADE's check of the arguments of boolean
// operations, as FreeCAD's "check geometry" runs it, finds nothing. It looks for faces and edges of a solid that cross
// or touch one another and for curves that leave their surface by more than the edge's tolerance, among others.
//
//   geometry_test_boolean_ready [crossings]     with all faces held against one another too, which takes minutes
//   geometry_test_boolean_ready CASE            of the pump of this case file; 77: it is refused
#include <cstdio>
#include <string>

#include <BOPAlgo_ArgumentAnalyzer.hxx>

#include "geometry/hydraulic_design.h"
#include "geometry/pump.h"
#include "geometry/solid.hpp"
#include "pipeline/case_read.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static bool crossings = false;

static const char *status_name(BOPAlgo_CheckStatus status) {
  switch (status) {
  case BOPAlgo_SelfIntersect:
    return "crosses itself";
  case BOPAlgo_TooSmallEdge:
    return "has too small an edge";
  case BOPAlgo_NonRecoverableFace:
    return "has a face that its edges do not bound";
  case BOPAlgo_IncompatibilityOfVertex:
  case BOPAlgo_IncompatibilityOfEdge:
  case BOPAlgo_IncompatibilityOfFace:
    return "has parts that lie on one another";
  case BOPAlgo_GeomAbs_C0:
    return "has a kink in a curve or surface";
  case BOPAlgo_InvalidCurveOnSurface:
    return "has an edge off its surface";
  default:
    return "cannot be checked";
  }
}

static void expect_no_fault(const CwSolid *solid) {
  BOPAlgo_ArgumentAnalyzer check;
  check.SetShape1(solid->solid);
  check.SelfInterMode() = crossings;
  check.ArgumentTypeMode() = check.SmallEdgeMode() = Standard_True;
  check.RebuildFaceMode() = check.MergeVertexMode() = check.MergeEdgeMode() = Standard_True;
  check.ContinuityMode() = check.CurveOnSurfaceMode() = Standard_True;
  check.Perform();
  for (const BOPAlgo_CheckResult &fault : check.GetCheckResult()) {
    std::string where;
    for (const TopoDS_Shape &shape : fault.GetFaultyShapes1())
      for (const CwSolidFace &face : solid->faces)
        if (face.face.IsSame(shape)) where += " " + face.name;
    fail_msg("%s %s:%s", solid->domain.c_str(), status_name(fault.GetCheckStatus()), where.c_str());
  }
}

static void expect_no_fault_in(const CwPump &pump) {
  for (int i = 0; i < pump.count; i++) expect_no_fault(pump.solid[i]);
}

static const char *case_file;
static bool refused;

static void case_of_the_command_line(void **) {
  CwCase table;
  CwDesign design;
  CwPipeStubs stubs;
  CwPump pump = {};
  if (cw_case_read(case_file, &table) != CW_OK) fail_msg("%s", cw_fail_message());
  refused = cw_hydraulic_design(&table, &design) != CW_OK || cw_pump_pipe_stubs(&table, &design, &stubs) != CW_OK ||
            cw_pump_build(&table, &design, &stubs, &pump) != CW_OK;
  if (refused) printf("%s\n", cw_fail_message());
  if (!refused) expect_no_fault_in(pump);
  cw_pump_free(&pump);
  cw_case_free(&table);
}

static void expect_no_fault_in(const CwCase &table) {
  CwDesign design;
  CwPump pump = pump_of(&table, &design);
  expect_no_fault_in(pump);
  cw_pump_free(&pump);
}

static void papers_pump(void **) {
  expect_no_fault_in(case_of("paper"));
}

static void splitters_and_zones(void **) {
  CwCase table = case_of("splitters");
  table.impeller.suction_pipe_zone = CW_PIPE_OWN_ZONE;
  table.volute.discharge_pipe_zone = CW_PIPE_OWN_ZONE;
  expect_no_fault_in(table);
}

static void fillets_round_edges_shaft_and_radial_discharge(void **) {
  CwCase table = case_of("paper");
  table.impeller.root_fillet_radius = 1e-3;
  table.impeller.trailing_edge = CW_EDGE_ROUNDED;
  table.impeller.through_shaft_diameter = 20e-3;
  table.impeller.rotation = CW_ROTATION_CLOCKWISE;
  table.volute.discharge = CW_DISCHARGE_RADIAL;
  expect_no_fault_in(table);
}

static void sharp_edges(void **) {
  CwCase table = case_of("paper");
  table.impeller.trailing_edge = CW_EDGE_SHARP;
  expect_no_fault_in(table);
}

int main(int argc, char **argv) {
  crossings = argc > 1 && std::string(argv[1]) == "crossings";
  if (argc > 1 && !crossings) {
    case_file = argv[1];
    const CMUnitTest of_case[] = {cmocka_unit_test(case_of_the_command_line)};
    const int failed = cmocka_run_group_tests(of_case, NULL, NULL);
    return !failed && refused ? 77 : failed;
  }
  const CMUnitTest tests[] = {
      cmocka_unit_test(papers_pump),
      cmocka_unit_test(splitters_and_zones),
      cmocka_unit_test(fillets_round_edges_shaft_and_radial_discharge),
      cmocka_unit_test(sharp_edges),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
