// SPDX-License-Identifier: AGPL-3.0-or-later
// Which domains the geometry stage made, and which of their patches are the two sides of one interface.
#ifndef CUTWATER_MESHER_RUN_DOMAIN_TABLE_H
#define CUTWATER_MESHER_RUN_DOMAIN_TABLE_H

#include "pipeline/case.h"

enum { CW_DOMAINS_MOST = 8 };

typedef struct {
  int domain[2];
  char patch[2][CW_NAME_SIZE];
} CwDomainInterface;

typedef struct {
  int count, interface_count;
  char name[CW_DOMAINS_MOST][CW_NAME_SIZE]; // in the order of their first row in faces.csv
  CwDomainInterface interface[CW_DOMAINS_MOST];
} CwDomainTable;

// Reads faces.csv and interfaces.csv of the folder. CW_ERR_IO; CW_ERR_INPUT with FILE:LINE for more domains or
// interfaces than CW_DOMAINS_MOST, and for an interface of an unknown domain or of a patch that is none.
CwStatus cw_domain_table_read(const char *geometry_dir, CwDomainTable *table);

#endif
