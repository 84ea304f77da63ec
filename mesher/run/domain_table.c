// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/domain_table.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_SIZE = 512, WORDS = 5 };

// Splits a line in place at its commas; returns the number of words, at most one more than `most`.
static int split(char *line, char *word[WORDS + 1]) {
  int count = 0;
  line[strcspn(line, "\r\n")] = '\0';
  for (char *rest = line; rest && count <= WORDS;) {
    char *comma = strchr(rest, ',');
    if (comma) *comma = '\0';
    word[count++] = rest;
    rest = comma ? comma + 1 : NULL;
  }
  return count;
}

static int find(const CwDomainTable *table, const char *name) {
  for (int d = 0; d < table->count; d++) {
    if (!strcmp(table->name[d], name)) return d;
  }
  return -1;
}

typedef struct {
  char domain[CW_NAME_SIZE], patch[CW_NAME_SIZE];
  int coupled; // in that line of interfaces.csv
} Side;

// Domains and interface patches from faces.csv, whose rows cw_face_table_read checks for each domain.
static CwStatus read_faces(const char *path, CwDomainTable *table, int *side_count, Side **sides) {
  CwStatus status = CW_OK;
  char line[LINE_SIZE], *word[WORDS + 1];
  FILE *file = fopen(path, "r");
  CW_REQUIRE(file, CW_ERR_IO, "%s: cannot be read: %s; made by cutwater-geometry", path, strerror(errno));
  for (int number = 1; fgets(line, sizeof line, file); number++) {
    if (split(line, word) != WORDS || number == 1) continue;
    CW_REQUIRE(word[0][0] && strlen(word[0]) < CW_NAME_SIZE && strlen(word[2]) < CW_NAME_SIZE, CW_ERR_INPUT,
               "%s:%d: names have 1 to %d characters", path, number, CW_NAME_SIZE - 1);
    if (find(table, word[0]) < 0) {
      CW_REQUIRE(table->count < CW_DOMAINS_MOST, CW_ERR_INPUT, "%s:%d: more than %d domains", path, number,
                 CW_DOMAINS_MOST);
      strcpy(table->name[table->count++], word[0]);
    }
    if (strcmp(word[3], "interface") != 0) continue;
    Side *grown = realloc(*sides, (size_t)(*side_count + 1) * sizeof **sides);
    CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d faces of interfaces", *side_count + 1);
    *sides = grown;
    Side *side = &grown[(*side_count)++];
    side->coupled = 0;
    strcpy(side->domain, word[0]);
    strcpy(side->patch, word[2]);
  }
  CW_REQUIRE(table->count > 0, CW_ERR_INPUT, "%s: no domain", path);
done:
  if (file) fclose(file);
  return status;
}

static CwStatus read_interface(const char *path, int number, char *const *word, int side_count, Side *sides,
                               CwDomainTable *table) {
  CwStatus status = CW_OK;
  CW_REQUIRE(table->interface_count < CW_DOMAINS_MOST, CW_ERR_INPUT, "%s:%d: more than %d interfaces", path, number,
             CW_DOMAINS_MOST);
  CwDomainInterface *made = &table->interface[table->interface_count++];
  for (int side = 0; side < 2; side++) {
    const char *domain = word[2 * side], *patch = word[2 * side + 1];
    int known = 0, before = 0;
    for (int i = 0; i < side_count; i++) {
      if (strcmp(sides[i].domain, domain) || strcmp(sides[i].patch, patch)) continue;
      known = 1;
      before = sides[i].coupled;
      sides[i].coupled = number;
    }
    CW_REQUIRE(known, CW_ERR_INPUT, "%s:%d: domain '%s' has no patch '%s' of kind interface", path, number, domain,
               patch);
    CW_REQUIRE(!before, CW_ERR_INPUT, "%s:%d: patch '%s' of domain '%s' is coupled in line %d already", path, number,
               patch, domain, before);
    made->domain[side] = find(table, domain);
    strcpy(made->patch[side], patch);
  }
  CW_REQUIRE(made->domain[0] != made->domain[1], CW_ERR_INPUT, "%s:%d: both sides lie in domain '%s'", path, number,
             word[0]);
done:
  return status;
}

CwStatus cw_domain_table_read(const char *geometry_dir, CwDomainTable *table) {
  CwStatus status = CW_OK;
  char path[4096], line[LINE_SIZE], *word[WORDS + 1];
  Side *sides = NULL;
  int side_count = 0;
  FILE *file = NULL;
  memset(table, 0, sizeof *table);
  snprintf(path, sizeof path, "%s/faces.csv", geometry_dir);
  CW_TRY(read_faces(path, table, &side_count, &sides));
  snprintf(path, sizeof path, "%s/interfaces.csv", geometry_dir);
  file = fopen(path, "r");
  CW_REQUIRE(file, CW_ERR_IO, "%s: cannot be read: %s; made by cutwater-geometry", path, strerror(errno));
  for (int number = 1; fgets(line, sizeof line, file); number++) {
    int count = split(line, word);
    CW_REQUIRE(count == 4, CW_ERR_INPUT,
               "%s:%d: the row has %d columns; they are domain,patch,other_domain,other_patch", path, number, count);
    if (number > 1) CW_TRY(read_interface(path, number, word, side_count, sides, table));
  }
  for (int i = 0; i < side_count; i++) {
    CW_REQUIRE(sides[i].coupled, CW_ERR_INPUT,
               "%s: patch '%s' of domain '%s' is of kind interface, but coupled to none", path, sides[i].patch,
               sides[i].domain);
  }
done:
  if (file) fclose(file);
  free(sides);
  return status;
}
