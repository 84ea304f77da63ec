// SPDX-License-Identifier: AGPL-3.0-or-later
// The command files of CFX, parsed, beside pump.cgns as the CGNS library reads it: every place that they name is there
// and of its kind, every patch has one boundary, every expression that is used is defined.
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include <cgnslib.h>

#include "tests/export/stage_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

enum { ITEMS_MOST = 2000, NAME_SIZE = 200, VALUE_SIZE = 1000, DEPTH_MOST = 20 };

// A line of a command file: an object with the objects around it as its path, or a parameter of one.
typedef struct {
  char path[NAME_SIZE];  // "FLOW/DOMAIN/BOUNDARY": types of the objects around it and, of an object, its own
  char owner[NAME_SIZE]; // name of the nearest named object around it
  char name[NAME_SIZE];  // of the object or parameter
  char value[VALUE_SIZE];
  int is_object;
} Item;

static char output[STAGE_OUTPUT_SIZE];
static Item items[ITEMS_MOST];
static int item_count;
static int file;

static int open_export(void **state) {
  SyntheticPump pump = synthetic_pump();
  return make_test_folder(state) || stage_cgns_open(test_folder, &pump, output, &file);
}

static int close_export(void **state) {
  cg_close(file);
  return clear_test_folder(state);
}

static char *trimmed(char *text) {
  while (isspace((unsigned char)*text)) ++text;
  for (char *end = text + strlen(text); end > text && isspace((unsigned char)end[-1]);) *--end = '\0';
  return text;
}

// Reads cfx/`name` into the items.
static void parse(const char *name) {
  char line[4000], path[DEPTH_MOST][NAME_SIZE] = {""}, owner[DEPTH_MOST][NAME_SIZE] = {""};
  int depth = 0;
  snprintf(line, sizeof line, "%s/run/export/cfx/%s", test_folder, name);
  FILE *in = fopen(line, "r");
  assert_non_null(in);
  item_count = 0;
  while (fgets(line, sizeof line, in)) {
    char *text = trimmed(line);
    if (!*text || *text == '#') continue;
    if (strcmp(text, "END") == 0) {
      if (--depth < 0) fail_msg("%s: an END too many", name);
      continue;
    }
    assert_true(item_count < ITEMS_MOST && depth + 1 < DEPTH_MOST);
    Item *item = &items[item_count++];
    memset(item, 0, sizeof *item);
    char *equals = strchr(text, '='), *colon = strchr(text, ':');
    if (equals && (!colon || equals < colon)) { // of an object a name may hold no '='
      *equals = '\0';
      snprintf(item->path, NAME_SIZE, "%s", path[depth]);
      snprintf(item->owner, NAME_SIZE, "%s", owner[depth]);
      snprintf(item->name, NAME_SIZE, "%s", trimmed(text));
      snprintf(item->value, VALUE_SIZE, "%s", trimmed(equals + 1));
      if (!*item->name || !*item->value) fail_msg("%s: '%s' has no name or value", name, text);
      continue;
    }
    if (!colon) fail_msg("%s: '%s' is neither an object nor a parameter", name, text);
    *colon = '\0';
    snprintf(item->name, NAME_SIZE, "%s", trimmed(colon + 1));
    char inner[NAME_SIZE];
    snprintf(inner, sizeof inner, "%.80s%s%.80s", path[depth], depth ? "/" : "", trimmed(text));
    memcpy(path[depth + 1], inner, sizeof inner);
    snprintf(owner[depth + 1], NAME_SIZE, "%s", *item->name ? item->name : owner[depth]);
    snprintf(item->owner, NAME_SIZE, "%s", owner[depth]);
    snprintf(item->path, NAME_SIZE, "%s", path[++depth]);
    item->is_object = 1;
  }
  fclose(in);
  if (depth) fail_msg("%s: %d objects have no END", name, depth);
}

static const Item *find_object(const char *path, const char *owner, const char *name) {
  for (int i = 0; i < item_count; ++i)
    if (items[i].is_object && !strcmp(items[i].path, path) && !strcmp(items[i].name, name) &&
        (!owner || !strcmp(items[i].owner, owner)))
      return &items[i];
  return NULL;
}

static const char *find_value(const char *path, const char *owner, const char *name) {
  for (int i = 0; i < item_count; ++i)
    if (!items[i].is_object && !strcmp(items[i].path, path) && !strcmp(items[i].owner, owner) &&
        !strcmp(items[i].name, name))
      return items[i].value;
  return "";
}

// The condition of a family of pump.cgns, or NULL where there is no such family.
static const char *condition_of(const char *family) {
  static char name[33], condition[33];
  int count = 0, conditions, geometries;
  BCType_t type;
  assert_int_equal(cg_nfamilies(file, 1, &count), CG_OK);
  for (int f = 1; f <= count; ++f) {
    assert_int_equal(cg_family_read(file, 1, f, name, &conditions, &geometries), CG_OK);
    if (strcmp(name, family) != 0 || conditions != 1) continue;
    assert_int_equal(cg_fambc_read(file, 1, f, 1, condition, &type), CG_OK);
    return BCTypeName[type];
  }
  return NULL;
}

static int zone_there(const char *wanted) {
  char name[33];
  cgsize_t size[3];
  int zones = 0;
  assert_int_equal(cg_nzones(file, 1, &zones), CG_OK);
  for (int z = 1; z <= zones; ++z) {
    assert_int_equal(cg_zone_read(file, 1, z, name, size), CG_OK);
    if (strcmp(name, wanted) == 0) return 1;
  }
  return 0;
}

static const char boundary_path[] = "FLOW/DOMAIN/BOUNDARY";

// Whether a list with commas has the word.
static int in_list(const char *list, const char *word) {
  const size_t length = strlen(word);
  for (const char *at = list; (at = strstr(at, word)); at += length)
    if ((at == list || at[-1] == ',') && (at[length] == ',' || !at[length])) return 1;
  return 0;
}

static void check_boundary(const char *name) {
  static const char *const kinds[][2] = {{"INLET", "BCInflow"},
                                         {"OUTLET", "BCOutflow"},
                                         {"WALL", "BCWallViscous"},
                                         {"INTERFACE", "UserDefined"},
                                         {"SYMMETRY", "BCSymmetryPlane"}};
  char list[VALUE_SIZE], *rest = list;
  const char *kind = find_value(boundary_path, name, "Boundary Type"), *wanted = NULL;
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k)
    if (strcmp(kind, kinds[k][0]) == 0) wanted = kinds[k][1];
  if (!wanted) fail_msg("boundary %s: type '%s'", name, kind);
  snprintf(list, sizeof list, "%s", find_value(boundary_path, name, "Location"));
  for (char *place; (place = strsep(&rest, ","));) {
    const char *condition = condition_of(place);
    if (!condition) fail_msg("boundary %s: pump.cgns has no family '%s'", name, place);
    assert_string_equal(condition, wanted);
  }
}

static void check_file(const char *name) {
  int domains = 0, boundaries = 0;
  parse(name);
  for (int i = 0; i < item_count; ++i) {
    const Item *item = &items[i];
    if (item->is_object && strcmp(item->path, "FLOW/DOMAIN") == 0) {
      ++domains;
      if (!zone_there(find_value("FLOW/DOMAIN", item->name, "Location"))) fail_msg("%s: no zone", item->name);
    }
    if (item->is_object && strcmp(item->path, boundary_path) == 0) {
      ++boundaries;
      for (int k = 0; k < i; ++k) // CFX finds a boundary by its name
        if (items[k].is_object && !strcmp(items[k].path, boundary_path))
          assert_string_not_equal(items[k].name, item->name);
      check_boundary(item->name);
    }
  }
  assert_int_equal(domains, 2);
  assert_true(boundaries >= 6);
}

static void every_place_is_in_the_mesh(void **state) {
  static const char *const names[] = {"steady.ccl",       "transient.ccl",    "points/q0600.ccl",
                                      "points/q0800.ccl", "points/q1000.ccl", "points/q1200.ccl"};
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) check_file(names[i]);
}

static void every_patch_has_one_boundary(void **state) {
  int count = 0, conditions, geometries, patches = 0;
  char name[33];
  parse("steady.ccl");
  assert_int_equal(cg_nfamilies(file, 1, &count), CG_OK);
  for (int f = 1; f <= count; ++f) {
    int found = 0;
    assert_int_equal(cg_family_read(file, 1, f, name, &conditions, &geometries), CG_OK);
    if (!conditions) continue; // of a zone
    for (int i = 0; i < item_count; ++i)
      found += !items[i].is_object && !strcmp(items[i].path, boundary_path) && !strcmp(items[i].name, "Location") &&
               in_list(items[i].value, name);
    if (found != 1) fail_msg("patch %s has %d boundaries", name, found);
    ++patches;
  }
  assert_true(patches > 8);
}

static void interfaces_join_two_boundaries(void **state) {
  int count = 0;
  parse("steady.ccl");
  for (int i = 0; i < item_count; ++i) {
    if (!items[i].is_object || strcmp(items[i].path, "FLOW/DOMAIN INTERFACE") != 0) continue;
    ++count;
    for (int side = 1; side <= 2; ++side) {
      char key[40];
      snprintf(key, sizeof key, "Boundary List%d", side);
      const char *boundary = find_value("FLOW/DOMAIN INTERFACE", items[i].name, key);
      snprintf(key, sizeof key, "Filter Domain List%d", side);
      const char *domain = find_value("FLOW/DOMAIN INTERFACE", items[i].name, key);
      snprintf(key, sizeof key, "Interface Region List%d", side);
      const char *region = find_value("FLOW/DOMAIN INTERFACE", items[i].name, key);
      if (!find_object(boundary_path, domain, boundary)) fail_msg("%s has no boundary %s", domain, boundary);
      assert_string_equal(find_value(boundary_path, boundary, "Location"), region);
    }
  }
  assert_int_equal(count, 1);
}

// Names behind an @ in the expressions are boundaries; they end before an operator, a bracket or the end.
static void expressions_and_monitors_name_what_is_there(void **state) {
  static const char expressions[] = "LIBRARY/CEL/EXPRESSIONS";
  int monitors = 0, places = 0;
  parse("steady.ccl");
  for (int i = 0; i < item_count; ++i) {
    if (items[i].is_object) continue;
    if (strcmp(items[i].name, "Expression Value") == 0) {
      ++monitors;
      assert_true(*find_value(expressions, "", items[i].value) != '\0');
    }
    for (const char *at = items[i].value; (at = strchr(at, '@')); ++at) {
      char name[NAME_SIZE];
      snprintf(name, sizeof name, "%.*s", (int)strcspn(at + 1, ")+-*/"), at + 1);
      if (!find_object(boundary_path, NULL, trimmed(name))) fail_msg("no boundary '%s' for %s", name, items[i].value);
      ++places;
    }
  }
  static const char *const wanted[] = {"head",
                                       "shaft torque",
                                       "shaft power",
                                       "hydraulic efficiency",
                                       "mean y plus of impeller",
                                       "greatest y plus of casing"};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; ++i) {
    if (!*find_value(expressions, "", wanted[i])) fail_msg("no expression %s", wanted[i]);
    if (!find_object("FLOW/OUTPUT CONTROL/MONITOR OBJECTS/MONITOR POINT", NULL, wanted[i]))
      fail_msg("no monitor %s", wanted[i]);
  }
  assert_true(monitors >= 6 && places >= 8);
}

// How many objects or parameters have such a name, or objects such a type, which ends their path.
static int count_named(const char *name) {
  int count = 0;
  for (int i = 0; i < item_count; ++i) {
    const char *last = strrchr(items[i].path, '/');
    count += !strcmp(items[i].is_object && last ? last + 1 : items[i].name, name);
  }
  return count;
}

// The transient file is loaded alone: it has all that the steady one has, and nothing that only a steady run or a
// model with transported turbulence takes.
static void the_transient_file_is_whole(void **state) {
  static const char *const both[] = {"EXPRESSIONS", "MATERIAL", "SOLUTION UNITS",  "DOMAIN",       "DOMAIN INTERFACE",
                                     "BOUNDARY",    "RESULTS",  "MONITOR OBJECTS", "MONITOR POINT"};
  static const char *const steady[] = {"Physical Timescale", "Length Scale Option", "Maximum Number of Iterations",
                                       "Turbulence Numerics", "TURBULENCE"};
  int count[sizeof both / sizeof *both];
  parse("steady.ccl");
  for (size_t i = 0; i < sizeof both / sizeof *both; ++i) assert_true((count[i] = count_named(both[i])) > 0);
  for (size_t i = 0; i < sizeof steady / sizeof *steady; ++i) assert_true(count_named(steady[i]) > 0);
  assert_string_equal(find_value("FLOW/DOMAIN INTERFACE/INTERFACE MODELS/FRAME CHANGE", "ROTOR STATOR", "Option"),
                      "Frozen Rotor");
  parse("transient.ccl");
  for (size_t i = 0; i < sizeof both / sizeof *both; ++i) assert_int_equal(count_named(both[i]), count[i]);
  for (size_t i = 0; i < sizeof steady / sizeof *steady; ++i)
    if (count_named(steady[i])) fail_msg("transient.ccl has %s", steady[i]);
  assert_string_equal(find_value("FLOW/ANALYSIS TYPE", "Flow Analysis 1", "Option"), "Transient");
  assert_string_equal(find_value("FLOW/DOMAIN INTERFACE/INTERFACE MODELS/FRAME CHANGE", "ROTOR STATOR", "Option"),
                      "Transient Rotor Stator");
  assert_string_equal(find_value("FLOW/DOMAIN/FLUID MODELS/TURBULENCE MODEL", "STATOR", "Option"), "LES Smagorinsky");
  // Appended to another file, values would mix.
  assert_int_equal(stage_shell(output, "grep importccl '%s/run/export/cfx/transient.pre'", test_folder), 0);
  assert_string_equal(output, ">importccl filename=transient.ccl, mode=replace, autoLoadLibrary=none\n");
}

static int count_values_with(const char *words) {
  int count = 0;
  for (int i = 0; i < item_count; ++i) count += strstr(items[i].value, words) != NULL;
  return count;
}

// Wall functions where all walls ask for them, the automatic treatment where a wall is resolved, and in laminar flow
// nothing of turbulence at all.
static void turbulence_follows_from_the_walls(void **state) {
  static const struct {
    const char *y_plus, *model, *functions, *in_time;
  } walls[] = {{"null", "Laminar", "", "Laminar"},
               {"1.0", "SST", "Automatic", "LES Smagorinsky"},
               {"30.0", "k epsilon", "Scalable", "LES Smagorinsky"}};
  static const char model[] = "FLOW/DOMAIN/FLUID MODELS/TURBULENCE MODEL",
                    functions[] = "FLOW/DOMAIN/FLUID MODELS/TURBULENT WALL FUNCTIONS";
  const char *run = in_test_folder("run");
  for (size_t i = 0; i < sizeof walls / sizeof *walls; ++i) {
    const int laminar = i == 0;
    assert_int_equal(stage_walls_set(run, NULL, walls[i].y_plus, output), 0);
    assert_int_equal(stage_export(run, 1, output), 0);
    for (int transient = 0; transient < 2; ++transient) {
      parse(transient ? "transient.ccl" : "steady.ccl");
      for (int d = 0; d < 2; ++d) {
        const char *domain = d ? "STATOR" : "ROTOR";
        assert_string_equal(find_value(model, domain, "Option"), transient ? walls[i].in_time : walls[i].model);
        assert_string_equal(find_value(functions, domain, "Option"),
                            transient && !laminar ? "Automatic" : walls[i].functions);
      }
      assert_int_equal(count_named("TURBULENCE"), laminar || transient ? 0 : 3); // the inlet, and both sides
      assert_int_equal(count_named("Turbulence Numerics"), !laminar && !transient);
      assert_int_equal(count_named("WALL ROUGHNESS") == 0, laminar);
      assert_int_equal(count_values_with("Yplus") == 0, laminar);
      assert_int_equal(count_values_with("y plus") == 0, laminar);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_place_is_in_the_mesh),     cmocka_unit_test(every_patch_has_one_boundary),
      cmocka_unit_test(interfaces_join_two_boundaries), cmocka_unit_test(expressions_and_monitors_name_what_is_there),
      cmocka_unit_test(the_transient_file_is_whole),    cmocka_unit_test(turbulence_follows_from_the_walls),
  };
  return cmocka_run_group_tests(tests, open_export, close_export);
}
