// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "mesher/run/domain_table.h"

static char folder[] = "domain-table-XXXXXX";

static void write_file(const char *name, const char *text) {
  char path[128];
  sprintf(path, "%s/%s", folder, name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs(text, file);
  fclose(file);
}

static int make_folder(void **state) {
  return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state) {
  char path[128];
  sprintf(path, "%s/faces.csv", folder);
  unlink(path);
  sprintf(path, "%s/interfaces.csv", folder);
  unlink(path);
  return rmdir(folder);
}

#define HEAD "domain,face,patch,kind,name\n"
#define PAIRS "domain,patch,other_domain,other_patch\n"
#define THREE                                                                                                          \
  HEAD "rotor,1,hub,wall,hub_1\nrotor,2,a,interface,a_1\nrotor,3,a,interface,a_2\nstator,1,b,interface,b\n"            \
       "rotor,4,c,interface,c\nsuction,1,d,interface,d\n"

static void domains_come_in_the_order_of_their_first_rows(void **state) {
  CwDomainTable table;
  write_file("faces.csv", THREE);
  write_file("interfaces.csv", PAIRS "rotor,a,stator,b\nsuction,d,rotor,c\n");
  assert_int_equal(cw_domain_table_read(folder, &table), CW_OK);
  assert_int_equal(table.count, 3);
  assert_string_equal(table.name[0], "rotor");
  assert_string_equal(table.name[1], "stator");
  assert_string_equal(table.name[2], "suction");
  assert_int_equal(table.interface_count, 2);
  assert_int_equal(table.interface[1].domain[0], 2);
  assert_int_equal(table.interface[1].domain[1], 0);
  assert_string_equal(table.interface[1].patch[0], "d");
  assert_string_equal(table.interface[1].patch[1], "c");
}

static void expect(const char *faces, const char *pairs, const char *message) {
  CwDomainTable table;
  write_file("faces.csv", faces);
  write_file("interfaces.csv", pairs);
  assert_int_equal(cw_domain_table_read(folder, &table), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), message));
}

static void wrong_pairs_are_named(void **state) {
  expect(THREE, PAIRS "rotor,hub,stator,b\n", "interfaces.csv:2: domain 'rotor' has no patch 'hub' of kind interface");
  expect(THREE, PAIRS "rotor,a,stator,b\nrotor,c,pipe,d\n",
         "interfaces.csv:3: domain 'pipe' has no patch 'd' of kind interface");
  expect(THREE, PAIRS "rotor,a,rotor,c\n", "interfaces.csv:2: both sides lie in domain 'rotor'");
  expect(THREE, PAIRS "rotor,a,stator\n", "interfaces.csv:2: the row has 3 columns");
  expect(THREE, PAIRS "rotor,a,stator,b\n",
         "interfaces.csv: patch 'c' of domain 'rotor' is of kind interface, but coupled to none");
  expect(THREE, PAIRS "rotor,a,stator,b\nsuction,d,rotor,a\n",
         "interfaces.csv:3: patch 'a' of domain 'rotor' is coupled in line 2 already");
  expect(HEAD, PAIRS, "faces.csv: no domain");
}

static void a_missing_file_is_named(void **state) {
  CwDomainTable table;
  assert_int_equal(cw_domain_table_read("nowhere", &table), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "nowhere/faces.csv"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(domains_come_in_the_order_of_their_first_rows),
                                     cmocka_unit_test(wrong_pairs_are_named),
                                     cmocka_unit_test(a_missing_file_is_named)};
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
