// SPDX-License-Identifier: AGPL-3.0-or-later
// A solid made 2^POWER times as large, without a bit lost: as a binary B-rep, for the text format rounds to 15 digits.
//
//   scaled_solid SOLID.brep SCALED.brep POWER
#include <cstdio>
#include <cstdlib>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>

#include "mesher/cad/cad_shape.h"

int main(int argc, char **argv) {
  TopoDS_Shape shape;
  BRep_Builder builder;
  if (argc != 4 || !BRepTools::Read(shape, argv[1], builder)) {
    fprintf(stderr, "scaled_solid SOLID.brep SCALED.brep POWER\n");
    return 1;
  }
  return BinTools::Write(cw_cad_scaled_shape(shape, atoi(argv[3])), argv[2]) ? 0 : 1;
}
