// SPDX-License-Identifier: AGPL-3.0-or-later
// one_zone FILE ZONE: deletes all other zones of a CGNS file, and what connects this one with them. For programs that
// hold a file's zones in memory together, on a copy.
#include <stdio.h>
#include <string.h>

#include <cgnslib.h>

static int failed(const char *path) {
  fprintf(stderr, "one_zone: %s: %s\n", path, cg_get_error());
  return 1;
}

int main(int count, char **word) {
  int file, zones;
  if (count != 3) {
    fprintf(stderr, "usage: one_zone FILE ZONE\n");
    return 2;
  }
  if (cg_open(word[1], CG_MODE_MODIFY, &file) || cg_nzones(file, 1, &zones)) return failed(word[1]);
  int kept = 0;
  for (int z = zones; z >= 1; z--) {
    char name[33];
    cgsize_t size[9];
    if (cg_zone_read(file, 1, z, name, size)) return failed(word[1]);
    const int keep = !strcmp(name, word[2]);
    kept += keep;
    if (keep ? cg_goto(file, 1, "Zone_t", z, "end") : cg_goto(file, 1, "end")) return failed(word[1]);
    if (cg_delete_node(keep ? "ZoneGridConnectivity" : name)) return failed(word[1]);
  }
  if (cg_close(file)) return failed(word[1]);
  if (!kept) fprintf(stderr, "one_zone: %s has no zone %s\n", word[1], word[2]);
  return !kept;
}
