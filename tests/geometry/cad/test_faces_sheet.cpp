// SPDX-License-Identifier: AGPL-3.0-or-later
// The table of the faces of a box: a row for each, with what is known by hand.
#include <fstream>
#include <sstream>
#include <vector>

#include "cad/small_parts.hpp"
#include "tests/test_folder.h"

extern "C" {
#include "geometry/cad/faces_sheet.h"
}

static std::vector<std::string> rows_of(SmallParts &small, const CwFaceRole *role) {
  const std::string path = in_test_folder("faces.csv");
  if (cw_faces_sheet_write(&small.cad, &small_frame, &small.parts, &small.survey, role, nullptr, path.c_str()))
    fail_msg("%s", cw_fail_message());
  std::ifstream in(path);
  std::vector<std::string> rows;
  for (std::string row; std::getline(in, row);) rows.push_back(row);
  remove(path.c_str());
  return rows;
}

static std::vector<std::string> cells_of(const std::string &row) {
  std::vector<std::string> cells;
  std::istringstream in(row);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

static void a_row_tells_a_face(void **) {
  SmallParts small({{"water", small_box(0, 0, 0, 2, 3, 4)}});
  const CwFaceRole role[6] = {CW_ROLE_INLET, CW_ROLE_WALL, CW_ROLE_WALL, CW_ROLE_WALL, CW_ROLE_WALL, CW_ROLE_WALL};
  small.parts.part[0].origin[0] = {"a \"b\"", {"wet", "fine"}, 0x00ff00, 0};
  if (small.look()) fail_msg("%s", cw_fail_message());
  const std::vector<std::string> rows = rows_of(small, role);
  assert_int_equal(rows.size(), 7);
  const std::vector<std::string> head = cells_of(rows[0]), first = cells_of(rows[1]);
  assert_string_equal(head[0].c_str(), "face");
  assert_string_equal(first[0].c_str(), "1");
  assert_string_equal(first[1].c_str(), "water");
  assert_string_equal(first[2].c_str(), "\"a \"\"b\"\"\"");
  assert_string_equal(first[3].c_str(), "#00ff00");
  assert_string_equal(first[4].c_str(), "\"wet; fine\"");
  assert_string_equal(first[5].c_str(), "plane");
  assert_string_equal(first[16].c_str(), "inlet");
  double area = 0;
  for (int f = 1; f <= 6; f++) {
    const std::vector<std::string> cells = cells_of(rows[f]);
    area += std::stod(cells[6]);
    std::istringstream neighbours(cells[15]);
    int count = 0;
    for (int other, last = 0; neighbours >> other; count++, last = other) assert_true(other > last && other != f);
    assert_int_equal(count, 4);
  }
  assert_near(area, 52, 1e-4);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_row_tells_a_face)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
