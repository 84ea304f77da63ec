// SPDX-License-Identifier: AGPL-3.0-or-later
// The files of a pump of two blocks: each is what its own writer makes of them.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>

#include "tests/geometry/hand_solids.hpp"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

extern "C" {
#include "geometry/pump_files.h"
#include "geometry/step_file.h"
#include "pipeline/file_digest.h"
}

static CwSolid block_at(const char *domain, double x) {
  CwSolid solid =
      hand_prism({gp_Pnt(x, 0, 0), gp_Pnt(x + 1, 0, 0), gp_Pnt(x + 1, 1, 0), gp_Pnt(x, 1, 0)}, gp_Vec(0, 0, 1), 1e-3);
  const std::string walls = std::string(domain) + "_wall";
  solid.domain = domain;
  for (CwSolidFace &face : solid.faces) face.patch = walls;
  solid.faces[3].patch = solid.faces[3].name = x < 1 ? "inlet" : "outlet";
  solid.faces[3].kind = x < 1 ? CW_PATCH_INLET : CW_PATCH_OUTLET;
  return solid;
}

static const char faces_table[] = "domain,face,patch,kind,name\n"
                                  "rotor,1,rotor_wall,wall,wall_1\n"
                                  "rotor,2,rotor_wall,wall,wall_2\n"
                                  "rotor,3,rotor_wall,wall,wall_3\n"
                                  "rotor,4,inlet,inlet,inlet\n"
                                  "rotor,5,rotor_wall,wall,wall_5\n"
                                  "rotor,6,rotor_wall,wall,wall_6\n"
                                  "stator,1,stator_wall,wall,wall_1\n"
                                  "stator,2,stator_wall,wall,wall_2\n"
                                  "stator,3,stator_wall,wall,wall_3\n"
                                  "stator,4,outlet,outlet,outlet\n"
                                  "stator,5,stator_wall,wall,wall_5\n"
                                  "stator,6,stator_wall,wall,wall_6\n";

static std::string text_of(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

// Writes "KEY: NUMBER" in place of a picture; fails on the one that it is told to.
struct Other {
  const char *key;
  int fails;
};
static CwStatus write_other(const void *given, int k, const char *path) {
  const Other *other = (const Other *)given;
  if (k == other->fails) return CW_FAIL(CW_ERR_DESIGN, "no picture %d", k);
  std::ofstream(path) << other->key << ": " << k;
  return CW_OK;
}

struct Run {
  CwSolid rotor = block_at("rotor", 0), stator = block_at("stator", 5);
  CwSolid *const solid[2] = {&rotor, &stator};
  const char *other[2] = {"first.svg", "second.svg"};
  Other given = {"picture", -1};
  CwModel model = {};
  CwStageArgs args = {};
  CwRecord *record = nullptr;
  CwPumpFiles files = {2, solid, &model, 2, other, write_other, &given};
  std::string folder = std::string(test_folder) + "/geometry/";

  Run() {
    CwModelPatch *patch;
    args.run_path = test_folder;
    std::filesystem::create_directory(folder);
    model.unit = 1e-3;
    model.flow = {2, 0.05, 7, 0.01, 0.2, 6};
    if (cw_model_add_domain(&model, "rotor", 1) || cw_model_add_patch(&model, "inlet", CW_PATCH_INLET, &patch) ||
        cw_model_add_domain(&model, "stator", 0) || cw_model_add_patch(&model, "outlet", CW_PATCH_OUTLET, &patch) ||
        cw_record_start("geometry", nullptr, &record))
      fail_msg("%s", cw_fail_message());
  }
  ~Run() {
    cw_record_free(record);
    cw_model_free(&model);
    std::filesystem::remove_all(folder);
  }
  CwStatus write() {
    return cw_pump_files_write(&args, &files, record);
  }
  // As the folder has them, those of temporary names too.
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto &entry : std::filesystem::directory_iterator(folder)) all.insert(entry.path().filename());
    return all;
  }
  // What the writer of a file makes of its own.
  std::string alone(const std::function<CwStatus(const char *)> &writer) const {
    const char *path = in_test_folder("alone");
    if (writer(path)) fail_msg("%s", cw_fail_message());
    const std::string text = text_of(path);
    std::filesystem::remove(path);
    return text;
  }
};

static void paths_lie_in_the_run(void **) {
  CwStageArgs args = {};
  char *path = nullptr;
  args.run_path = "some/run";
  assert_int_equal(cw_geometry_path(&args, "faces.csv", &path), CW_OK);
  assert_string_equal(path, "some/run/geometry/faces.csv");
  free(path);
}

static void each_file_is_its_writers(void **) {
  Run run;
  if (run.write()) fail_msg("%s", cw_fail_message());
  const std::set<std::string> wanted = {"rotor.brep", "stator.brep", "faces.csv",  "model.json",
                                        "pump.step",  "first.svg",   "second.svg", "pump_faces.step"};
  assert_true(run.names() == wanted);
  const CwSolid *const solids[] = {&run.rotor, &run.stator};
  const auto same = [&](const char *name, const std::function<CwStatus(const char *)> &writer) {
    const std::string text = text_of(run.folder + name);
    assert_true(text.size() > 100 && text == run.alone(writer));
  };
  same("rotor.brep", [&](const char *path) { return cw_solid_write_brep(&run.rotor, path); });
  same("stator.brep", [&](const char *path) { return cw_solid_write_brep(&run.stator, path); });
  same("model.json", [&](const char *path) { return cw_model_write(&run.model, path); });
  same("pump.step", [&](const char *path) { return cw_step_write(solids, 2, path); });
  same("pump_faces.step", [&](const char *path) {
    CwBeside *beside = nullptr;
    const CwStatus status = cw_step_write_with_faces(solids, 2, path, &beside);
    return status ? status : cw_beside_end(&beside, path);
  });
  assert_string_equal(text_of(run.folder + "faces.csv").c_str(), faces_table);
  assert_string_equal(text_of(run.folder + "first.svg").c_str(), "picture: 0");
  assert_string_equal(text_of(run.folder + "second.svg").c_str(), "picture: 1");
}

// The record has the digest of each, by its name alone, and the step.
static void the_record_has_all_digests(void **) {
  Run run;
  const char *path = in_test_folder("record.json");
  if (run.write() || cw_record_write(run.record, path)) fail_msg("%s", cw_fail_message());
  json_t *root = json_load_file(path, 0, nullptr), *files = json_object_get(root, "files");
  std::filesystem::remove(path);
  assert_int_equal(json_object_size(files), 8);
  for (const std::string &name : run.names()) {
    char digest[CW_HASH_TEXT];
    assert_int_equal(cw_file_digest((run.folder + name).c_str(), digest), CW_OK);
    assert_string_equal(json_string_value(json_object_get(files, name.c_str())), digest);
  }
  json_t *step = json_array_get(json_object_get(root, "steps"), 0);
  assert_string_equal(json_string_value(json_object_get(step, "name")), "files");
  assert_int_equal(json_integer_value(json_object_get(step, "items")), 8);
  json_decref(root);
}

static void no_others_are_no_fault(void **) {
  Run run;
  run.files.other_count = 0;
  if (run.write()) fail_msg("%s", cw_fail_message());
  assert_int_equal(run.names().size(), 6);
}

static bool has_temporary_files(const Run &run) {
  const std::set<std::string> all = run.names();
  return std::any_of(all.begin(), all.end(), [](const std::string &name) { return name[0] == '.'; });
}

// What fails says so itself, and nothing is left under a temporary name, neither here nor by the process beside.
static void failures_are_told(void **) {
  {
    Run run;
    run.given.fails = 1;
    assert_int_equal(run.write(), CW_ERR_DESIGN);
    assert_string_equal(cw_fail_message(), "no picture 1");
    assert_int_equal(run.names().count("first.svg"), 1);
    assert_false(has_temporary_files(run));
  }
  for (const char *taken : {"pump_faces.step", "stator.brep", "faces.csv"}) { // a folder has the name
    Run run;
    std::filesystem::create_directories(run.folder + taken + "/x");
    assert_int_equal(run.write(), CW_ERR_IO);
    assert_non_null(strstr(cw_fail_message(), taken));
    assert_false(has_temporary_files(run));
  }
  cw_fail_clear();
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(paths_lie_in_the_run),       cmocka_unit_test(each_file_is_its_writers),
      cmocka_unit_test(the_record_has_all_digests), cmocka_unit_test(no_others_are_no_fault),
      cmocka_unit_test(failures_are_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
