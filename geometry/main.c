// SPDX-License-Identifier: AGPL-3.0-or-later
// cutwater-geometry: from the case file to the pump's solids. Writes RUN/geometry.
#include <math.h>
#include <stdlib.h>

#include "geometry/design_file.h"
#include "geometry/faces_table.h"
#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "geometry/rotor.h"
#include "geometry/step_file.h"
#include "pipeline/atomic_file.h"
#include "pipeline/log.h"
#include "pipeline/record.h"
#include "pipeline/stage_args.h"

static const CwStageUsage usage = {
    .stage = "geometry",
    .summary = "Designs the pump of the case file and writes its solids, with named faces, to DIR/geometry:\n"
               "rotor.brep, stator.brep, faces.csv, pump.step, design.json, record.json.\n",
};

static const double degree = M_PI / 180;

static void show_design(const CwDesign *design) {
  char line[200];
  cw_log("%-52s %10d       case", "blade number z", design->blade_count);
  for (int i = 0; i < CW_DESIGN_COUNT; i++) {
    cw_hydraulic_design_row(design, i, line, sizeof line);
    cw_log("%s", line);
  }
}

static CwStatus check_solid(const CwSolid *solid, const CwMeasuredSolid *measured) {
  CwStatus status = CW_OK;
  CW_REQUIRE(measured->valid && measured->closed && measured->largest_tolerance < 1e-6, CW_ERR_GEOMETRY,
             "%s: the solid is %s and %s, its largest tolerance is %.3g mm; it must be valid, closed and under "
             "0.001 mm",
             cw_solid_domain(solid), measured->valid ? "valid" : "not valid",
             measured->closed ? "closed" : "not closed", measured->largest_tolerance * 1e3);
  cw_log("%s: %d faces, %.3f cm3, largest tolerance %.1e mm, valid and closed", cw_solid_domain(solid),
         measured->face_count, measured->volume * 1e6, measured->largest_tolerance * 1e3);
done:
  return status;
}

// Creases sharper than this leave prism layers with more than the skewness that solvers accept.
static void show_rotor(const CwMeasuredRotor *rotor) {
  const double least = fmin(rotor->hub_crease.angle, rotor->shroud_crease.angle) / degree;
  cw_log("measured: wrap %.4f deg, D1 %.4f, D2 %.4f, b2 %.4f mm", rotor->wrap_angle / degree,
         rotor->inlet_diameter * 1e3, rotor->outlet_diameter * 1e3, rotor->outlet_width * 1e3);
  cw_log("measured: blade to hub %.1f deg, blade to shroud %.1f deg at the least; sharpest wedge of the trailing edge "
         "%.1f deg",
         rotor->hub_crease.angle / degree, rotor->shroud_crease.angle / degree,
         360 - rotor->trailing_edge.angle / degree);
  if (least < 66)
    cw_log_warn("blades meet hub or shroud at %.1f deg; under 66 deg the prism layers there are skewed: move the "
                "leading edge outward",
                least);
  if (360 - rotor->trailing_edge.angle / degree < 75)
    cw_log_warn("the trailing edge has a wedge of %.1f deg; under 75 deg the prism layers there are skewed: lengthen "
                "the bevel",
                360 - rotor->trailing_edge.angle / degree);
}

static CwStatus in_folder(const CwStageArgs *args, const char *name, char **path) {
  char inside[64];
  snprintf(inside, sizeof inside, "geometry/%s", name);
  return cw_stage_path(args, inside, path);
}

static CwStatus make_geometry(const CwStageArgs *args, const CwCase *table, CwRecord *record) {
  CwStatus status = CW_OK;
  CwDesign design;
  CwMeasuredPump measured = {0};
  CwSolid *rotor = NULL;
  char *path[6] = {NULL};
  double begin = cw_seconds();
  CW_TRY(cw_hydraulic_design(table, &design));
  show_design(&design);
  CW_TRY(cw_rotor_build(&design, &rotor));
  CW_TRY(cw_record_step(record, "rotor", cw_seconds() - begin, cw_solid_face_count(rotor), "faces"));
  begin = cw_seconds();
  CW_TRY(cw_measure_solid(rotor, &measured.rotor));
  CW_TRY(check_solid(rotor, &measured.rotor));
  CW_TRY(cw_measure_rotor(rotor, &measured.rotor_dimensions));
  show_rotor(&measured.rotor_dimensions);
  const CwSolid *solids[] = {rotor};
  CW_TRY(cw_record_step(record, "measure", cw_seconds() - begin, measured.rotor.face_count, "faces"));
  begin = cw_seconds();
  CW_TRY(cw_stage_path(args, "geometry", &path[0]));
  CW_TRY(cw_make_directory(path[0]));
  CW_TRY(in_folder(args, "rotor.brep", &path[1]));
  CW_TRY(cw_solid_write_brep(rotor, path[1]));
  CW_TRY(in_folder(args, "faces.csv", &path[3]));
  CW_TRY(cw_faces_table_write(solids, 1, path[3]));
  CW_TRY(in_folder(args, "pump.step", &path[4]));
  CW_TRY(cw_step_write(solids, 1, path[4]));
  CW_TRY(in_folder(args, "design.json", &path[5]));
  CW_TRY(cw_design_file_write(&design, &measured, path[5]));
  CW_TRY(cw_record_step(record, "files", cw_seconds() - begin, 5, "files"));
  CW_TRY(cw_record_json(record, "measured", cw_measured_json(&measured)));
  CW_TRY(cw_record_number(record, "predicted_head_m", design.predicted_head));
  CW_TRY(cw_record_number(record, "head_residual_m", design.head_residual));
  CW_TRY(cw_record_number(record, "specific_speed_ns", design.specific_speed_ns));
done:
  for (size_t i = 0; i < sizeof path / sizeof *path; i++)
    free(path[i]);
  cw_solid_free(&rotor);
  return status;
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CwStageArgs args;
  CwCase table;
  CwRecord *record = NULL;
  char *record_path = NULL;
  CW_TRY(cw_stage_begin(argc, argv, &usage, 1, &args, &table));
  if (args.finished)
    goto done;
  CW_TRY(cw_record_start("geometry", &record));
  CW_TRY(make_geometry(&args, &table, record));
  CW_TRY(in_folder(&args, "record.json", &record_path));
  CW_TRY(cw_record_write(record, record_path));
done:;
  const int code = cw_log_error(status);
  free(record_path);
  cw_record_free(record);
  cw_log_close();
  return code;
}
