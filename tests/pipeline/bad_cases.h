// SPDX-License-Identifier: AGPL-3.0-or-later
// Case files with one fault each: the line of a good case that is replaced, and what the reader says.
#pragma once

typedef struct {
  int line;
  const char *replacement;
  const char *expected; // all of the message behind "FILE:"
} BadCase;

static const BadCase bad_cases[] = {
    // Wrong units in the key.
    {12, "  wrap_angle: 71",
     "12:3: impeller.wrap_angle: the key lacks its unit, degrees; allowed: wrap_angle_deg, 20 to 300 "
     "degrees"},
    {10, "  outlet_diameter_in: 0.2",
     "10:23: impeller.outlet_diameter_in: 0.2 is out of range (it is 5.08 mm); allowed: 10 to 10000 mm"},
    {10, "  outlet_diameter_mm: 200\n  outlet_diameter_in: 8",
     "11:3: impeller.outlet_diameter_in: given twice, first in line 10; allowed: once"},
    {10, "  outlet_diameter_IN: 8",
     "10:3: impeller.outlet_diameter_IN: wrong unit in the key, in instead of mm; allowed: outlet_diameter_mm, "
     "10 to 10000 mm (8 in is 203.2 mm)"},
    {4, "  head_bar: 1",
     "4:3: operating_point.head_bar: wrong unit in the key, bar instead of m; allowed: head_m, 0.01 to 5000 "
     "m"},
    {8, "  blade_count_mm: 6",
     "8:3: impeller.blade_count_mm: wrong unit in the key, mm; allowed: blade_count without unit, a whole "
     "number from "
     "2 to 12"},
    // Unknown keys.
    {8, "  blade_cuont: 6",
     "8:3: impeller.blade_cuont: unknown key; allowed: the keys of docs/case-reference.md, the nearest is "
     "blade_count"},
    {4, "  flow_m3_h: 25",
     "4:3: operating_point.flow_m3_h: unknown key; allowed: the keys of docs/case-reference.md, the nearest is "
     "flow_rate_m3_per_h"},
    {19, "mseh:", "19:1: mseh: unknown key; allowed: the keys of docs/case-reference.md, the nearest is mesh"},
    {20, "  layer_count: 5", "20:3: mesh.layer_count: unknown key here; allowed: the key layer_count in section walls"},
    {20, "  name: x", "20:3: mesh.name: unknown key here; allowed: the key name in the top of the file"},
    {1, "name: test\ncells: 5", "2:1: cells: unknown key here; allowed: the key cells in section mesh"},
    {20, "  <<: {cells: 5}",
     "20:3: mesh.<<: unknown key; allowed: the keys of docs/case-reference.md, the nearest is fill"},
    {8, "  blade_count: 6\n  : 7",
     "8:16: impeller.(nothing): the key is empty; allowed: the keys of docs/case-reference.md"},
    // Wrong types.
    {8, "  blade_count: six", "8:16: impeller.blade_count: six is not a number; allowed: a whole number from 2 to 12"},
    {8, "  blade_count: 6.5",
     "8:16: impeller.blade_count: 6.5 is not a whole number; allowed: a whole number from 2 to 12"},
    {20, "  cells: 2m",
     "20:10: mesh.cells: 2m is not a whole number; allowed: a whole number from 10000 to 2000000000, as 500000, 500k "
     "or "
     "2M"},
    {11, "  outlet_width_mm: \"8\"",
     "11:20: impeller.outlet_width_mm: 8 is text, not a number (it stands in quotes); allowed: 0.05 to 2000 "
     "mm"},
    {11, "  outlet_width_mm:",
     "11:3: impeller.outlet_width_mm: (nothing) is no value (leave the key out for its default); allowed: "
     "0.05 to 2000 mm"},
    {12, "  wrap_angle_deg: ~",
     "12:19: impeller.wrap_angle_deg: ~ is no value (leave the key out for its default); allowed: 20 to 300 "
     "degrees"},
    {11, "  outlet_width_mm: [8, 9]",
     "11:20: impeller.outlet_width_mm: it is a list, not one value; allowed: 0.05 to 2000 mm"},
    {11, "  outlet_width_mm: {a: 8}",
     "11:20: impeller.outlet_width_mm: it is a mapping, not one value; allowed: 0.05 to 2000 mm"},
    {11, "  outlet_width_mm: *width",
     "11:20: impeller.outlet_width_mm: it is an alias (*name), not one value; allowed: 0.05 to 2000 mm"},
    {11, "  outlet_width_mm: !!float 8",
     "11:28: impeller.outlet_width_mm: it has a tag (!...); allowed: without tag, 0.05 to 2000 mm"},
    {7, "  priority: warp",
     "7:13: impeller.priority: warp is not one of the choices; allowed: wrap, head, beta or auto"},
    {7, "  priority: Wrap",
     "7:13: impeller.priority: Wrap is not one of the choices; allowed: wrap, head, beta or auto"},
    {16, "walls:\n  y_plus_at: 1", "17:14: walls.y_plus_at: 1 is not one of the choices; allowed: node or cell_centre"},
    {1, "name: my/pump",
     "1:7: name: my/pump is not a name that files and solvers take; allowed: 1 to 32 letters, digits, _ and "
     "-, a "
     "letter first"},
    {1, "name: \"a\\0b\"",
     "1:7: name: a?b is not a name that files and solvers take; allowed: 1 to 32 letters, digits, _ and -, a "
     "letter "
     "first"},
    {1, "name: a23456789012345678901234567890123",
     "1:7: name: a23456789012345678901234567890123 is not a name that files and solvers take; allowed: 1 to "
     "32 "
     "letters, digits, _ and -, a letter first"},
    // Numbers that are none.
    {4, "  head_m: .nan", "4:11: operating_point.head_m: .nan is not a finite number; allowed: 0.01 to 5000 m"},
    {4, "  head_m: nan", "4:11: operating_point.head_m: nan is not a finite number; allowed: 0.01 to 5000 m"},
    {4, "  head_m: -.inf", "4:11: operating_point.head_m: -.inf is not a finite number; allowed: 0.01 to 5000 m"},
    {4, "  head_m: 1e999", "4:11: operating_point.head_m: 1e999 is not a finite number; allowed: 0.01 to 5000 m"},
    {4, "  head_m: 0x10", "4:11: operating_point.head_m: 0x10 is not a decimal number; allowed: 0.01 to 5000 m"},
    {4, "  head_m: 0o17", "4:11: operating_point.head_m: 0o17 is not a decimal number; allowed: 0.01 to 5000 m"},
    {4, "  head_m: 010", "4:11: operating_point.head_m: 010 has a leading zero; allowed: 0.01 to 5000 m"},
    {4, "  head_m: 10,5",
     "4:11: operating_point.head_m: 10,5 has a comma (decimals follow a point); allowed: 0.01 to 5000 m"},
    {4, "  head_m: 10 m",
     "4:11: operating_point.head_m: 10 m has text behind the number (the unit stands in the key); allowed: "
     "0.01 to 5000 "
     "m"},
    {4, "  head_m: 1e",
     "4:11: operating_point.head_m: 1e has text behind the number (the unit stands in the key); "
     "allowed: 0.01 to 5000 m"},
    {4, "  head_m: .", "4:11: operating_point.head_m: . is not a number; allowed: 0.01 to 5000 m"},
    {4, "  head_m: 1\n   2",
     "4:11: operating_point.head_m: 1 2 has text behind the number (the unit stands in the key); allowed: "
     "0.01 to 5000 "
     "m"},
    // Out of range, at both ends.
    {8, "  blade_count: 1", "8:16: impeller.blade_count: 1 is out of range; allowed: a whole number from 2 to 12"},
    {8, "  blade_count: 13", "8:16: impeller.blade_count: 13 is out of range; allowed: a whole number from 2 to 12"},
    {8, "  blade_count: 99999999999999999999",
     "8:16: impeller.blade_count: 99999999999999999999 is out of range; allowed: a whole number from 2 to 12"},
    {10, "  outlet_diameter_mm: -200",
     "10:23: impeller.outlet_diameter_mm: -200 is out of range; allowed: 10 to 10000 mm"},
    {10, "  outlet_diameter_mm: 0.2",
     "10:23: impeller.outlet_diameter_mm: 0.2 is out of range; allowed: 10 to 10000 mm"},
    {18, "  growth_ratio: 2.01", "18:17: walls.growth_ratio: 2.01 is out of range; allowed: 1 to 2, or auto"},
    {17, "  layer_count: 0",
     "17:16: walls.layer_count: 0 is out of range; allowed: a whole number from 1 to 40, or auto"},
    {17, "  layer_count: Auto",
     "17:16: walls.layer_count: Auto is not a number; allowed: a whole number from 1 to 40, or auto"},
    {20, "  gradation: auto", "20:14: mesh.gradation: auto is not a number; allowed: 0.05 to 1"},
    {20, "  cells: 9999",
     "20:10: mesh.cells: 9999 is out of range; allowed: a whole number from 10000 to 2000000000, "
     "as 500000, 500k or 2M"},
    // Missing.
    {1, "", "1:1: name: the key is missing; allowed: 1 to 32 letters, digits, _ and -, a letter first"},
    {5, "", "2:1: operating_point.speed_rpm: the key is missing; allowed: 10 to 100000 rpm"},
    // Twice.
    {9, "  inlet_diameter_mm: 74\n  inlet_diameter_mm: 75",
     "10:3: impeller.inlet_diameter_mm: given twice, first in line 9; allowed: once"},
    {20, "  cells: 1000000\nname: again", "21:1: name: given twice, first in line 1; allowed: once"},
    {20, "  cells: 1000000\nwalls:\n  roughness_um: 1", "21:1: walls: given twice, first in line 16; allowed: once"},
    // Sections that are none.
    {19, "mesh: 5\nwalls2:",
     "19:7: mesh: 5 is not a mapping; allowed: the section's keys, one a line, indented below "
     "it"},
    {19, "mesh: [1]\nwalls2:",
     "19:7: mesh: a list is not a mapping; allowed: the section's keys, one a line, indented "
     "below it"},
    {20, "", "19:1: mesh: (nothing) is not a mapping; allowed: the section's keys, one a line, indented below it"},
    {20, "  [a, b]: 5", "20:3: mesh: a key is a list; allowed: a plain word"},
    {1, "{a: 1}: 5", "1:1: case file: a key is a mapping; allowed: a plain word"},
    // No YAML.
    {9, " inlet_diameter_mm: 74",
     "9:2: case file: it is not YAML, invalid indentation in mapping; allowed: one \"key: value\" a line, "
     "sections "
     "indented by blanks"},
    {2, "operating_point:\n\thead_m: 10",
     "3:1: case file: it is not YAML, tab character may not be used as indentation; allowed: one \"key: "
     "value\" a line, "
     "sections indented by blanks"},
    {1, "name: \"test",
     "1:7: case file: it is not YAML, wrongly indented double-quoted scalar; allowed: one \"key: value\" a "
     "line, "
     "sections indented by blanks"},
    {4, "  head_m: 10: 5",
     "4:13: case file: it is not YAML, invalid nested block mapping on the same line; allowed: one \"key: "
     "value\" a "
     "line, sections indented by blanks"},
    {20, "  cells: 1000000\n---\nname: second", "21:1: case file: a second document begins; allowed: one document"},
    // Not text.
    {1,
     "name: te\xff"
     "st",
     "1:9: case file: byte 0xff is no text; allowed: UTF-8 text"},
    {1, "# caf\xc3\xa9 \xc3(\nname: test", "1:8: case file: byte 0xc3 is no text; allowed: UTF-8 text"},
    {4, "  head_m: 10 # \x01", "4:16: case file: byte 0x01 is no text; allowed: UTF-8 text"},
    {1, "name: \xed\xa0\x80", "1:7: case file: byte 0xed is no text; allowed: UTF-8 text"},
    // Contradictions.
    {15, "  inlet_width_mm: 7.9",
     "15:19: volute.inlet_width_mm: 7.9 contradicts impeller.outlet_width_mm (the volute takes the "
     "impeller's outlet); "
     "allowed: at least 8 mm"},
    {14, "  base_diameter_mm: 200",
     "14:21: volute.base_diameter_mm: 200 contradicts impeller.outlet_diameter_mm (the volute lies around "
     "the "
     "impeller); allowed: above 200 mm"},
    {15, "  inlet_width_mm: 12\n  tongue_gap_mm: 7\n  tongue_angle_deg: 35",
     "17:21: volute.tongue_angle_deg: 35 contradicts volute.tongue_gap_mm, from which it follows; allowed: one "
     "of them"},
    {15, "  inlet_width_mm: 12\n  diffuser_angle_deg: 8\n  diffuser_length_mm: 100",
     "16:23: volute.diffuser_angle_deg: 8 contradicts volute.diffuser_length_mm, from which it follows; "
     "allowed: one of them"},
    {15, "  inlet_width_mm: 12\n  diffuser_area_ratio: 1.5\n  outlet_diameter_mm: 50",
     "16:24: volute.diffuser_area_ratio: 1.5 contradicts volute.outlet_diameter_mm, from which it follows; "
     "allowed: one of them"},
    {15, "  inlet_width_mm: 12\n  velocity_factor: 0.4",
     "16:20: volute.velocity_factor: 0.4 is of no use with the area_law angular_momentum; allowed: with "
     "area_law velocity"},
    {15, "  inlet_width_mm: 12\n  section: circle\n  corner_radius_mm: 3",
     "17:21: volute.corner_radius_mm: 3 is of no use with the section circle; allowed: with section trapezoid "
     "or rectangle"},
    {15, "  inlet_width_mm: 12\n  section: square",
     "16:12: volute.section: square is not one of the choices; allowed: trapezoid, rectangle or circle"},
    {9, "  inlet_diameter_mm: 200",
     "9:22: impeller.inlet_diameter_mm: 200 contradicts impeller.outlet_diameter_mm (the flow goes "
     "outwards); allowed: "
     "below 200 mm"},
    {12, "  wrap_angle_deg: 71\n  hub_diameter_mm: 80",
     "13:20: impeller.hub_diameter_mm: 80 contradicts impeller.inlet_diameter_mm (the eye must stay open); "
     "allowed: "
     "below 74 mm"},
    {12, "  wrap_angle_deg: 71\n  leading_edge_radius_shroud_mm: 100",
     "13:34: impeller.leading_edge_radius_shroud_mm: 100 contradicts half of impeller.outlet_diameter_mm "
     "(the leading "
     "edge lies inside D2/2); allowed: below 100 mm"},
    {12, "  wrap_angle_deg: 71\n  hub_diameter_mm: 30\n  leading_edge_radius_hub_mm: 14",
     "14:31: impeller.leading_edge_radius_hub_mm: 14 contradicts half of impeller.hub_diameter_mm (the "
     "leading edge "
     "meets the hub outside its nut); allowed: at least 15 mm"},
    {12, "  wrap_angle_deg: 71\n  blade_thickness_mm: 3\n  leading_edge_thickness_mm: 3.5",
     "14:30: impeller.leading_edge_thickness_mm: 3.5 contradicts impeller.blade_thickness_mm (this is the "
     "largest "
     "thickness of the blade); allowed: at most 3 mm"},
    {12, "  wrap_angle_deg: 71\n  leading_edge_radius_hub_mm: 101",
     "13:31: impeller.leading_edge_radius_hub_mm: 101 contradicts half of impeller.outlet_diameter_mm (the "
     "leading edge lies inside D2/2); allowed: below 100 mm"},
    {12, "  leading_edge_radius_shroud_mm: 15\n  wrap_angle_deg: 71\n  hub_diameter_mm: 30",
     "12:34: impeller.leading_edge_radius_shroud_mm: 15 contradicts half of impeller.hub_diameter_mm (the "
     "leading edge meets the shroud outside the hub); allowed: above 15 mm"},
    {12, "  wrap_angle_deg: 71\n  blade_thickness_mm: 3\n  trailing_edge_thickness_mm: 3.1",
     "14:31: impeller.trailing_edge_thickness_mm: 3.1 contradicts impeller.blade_thickness_mm (this is the "
     "largest thickness of the blade); allowed: at most 3 mm"},
    {12, "  wrap_angle_deg: 71\n  blade_thickness_mm: 20",
     "13:23: impeller.blade_thickness_mm: 20 contradicts blade_count and inlet_diameter_mm (the blades fill "
     "the inlet); "
     "allowed: below 19.37 mm"},
    {11, "  outlet_width_mm: 100",
     "11:20: impeller.outlet_width_mm: 100 contradicts half of impeller.outlet_diameter_mm (the impeller is "
     "radial); "
     "allowed: below 100 mm"},
    {18, "  total_thickness_mm: 4",
     "18:23: walls.total_thickness_mm: 4 contradicts half of impeller.outlet_width_mm (layers on hub and "
     "shroud would "
     "meet); allowed: below 4 mm"},
    {12, "",
     "7:13: impeller.priority: wrap needs the key wrap_angle_deg, which is missing; allowed: wrap_angle_deg "
     "from 20 to "
     "300 degrees, or priority auto, head or beta"},
    {7, "  priority: beta",
     "7:13: impeller.priority: beta needs the key outlet_blade_angle_deg, which is missing; allowed: "
     "outlet_blade_angle_deg from 5 to 85 degrees, or priority auto, wrap or head"},
    {18, "  treatment: rough",
     "18:14: walls.treatment: rough contradicts roughness_um, which is 0; allowed: smooth, or roughness_um "
     "above 0 to "
     "5000 um"},
    // u2 = pi 0.2 1450/60 = 15.18 m/s, u2^2/g = 23.51 m. nq = 1450 sqrt(25/3600) / 24^0.75 = 11.1 is fine.
    {4, "  head_m: 24",
     "4:11: operating_point.head_m: 24 contradicts speed_rpm and impeller.outlet_diameter_mm, which give the "
     "tip speed "
     "15.18 m/s; allowed: below 23.51 m (u2^2/g)"},
    // nq = 1450 sqrt(25/3600) / 0.1^0.75 = 120.83 / 0.17783 = 679.5; 90 0.17783 / 0.083333 = 192.05
    {4, "  head_m: 0.1",
     "5:14: operating_point.speed_rpm: 1450 contradicts flow rate and head, together they give the specific "
     "speed nq = "
     "679.5; allowed: nq from 5 to 160 (of n in rpm, Q in m3/s, H in m), such as speed_rpm: 192.054 with nq = 90"},
    // nq = 120.83 / 2000^0.75 = 120.83 / 299.07 = 0.404; 7 299.07 / 0.083333 = 25121.9
    {4, "  head_m: 2000",
     "5:14: operating_point.speed_rpm: 1450 contradicts flow rate and head, together they give the specific "
     "speed nq = 0.404; allowed: nq from 5 to 160 (of n in rpm, Q in m3/s, H in m), such as speed_rpm: 25121.9 with "
     "nq = 7"},
};
