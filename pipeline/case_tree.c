// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_tree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/case_value.h"

enum { DEPTH_MOST = 6 };

static CwStatus read_node(CwEventStream *stream, const CwEvent *first, int depth, CwCaseNode *node);

static CwStatus copy_text(const char *text, char **copy) {
  CwStatus status = CW_OK;
  CW_NEW(*copy, strlen(text) + 1);
  strcpy(*copy, text);
done:
  return status;
}

// Adds an item to a list, or to a mapping with its key.
static CwStatus add_item(CwCaseNode *node, const char *key, CwCaseNode **item) {
  CwStatus status = CW_OK;
  char shown[CW_SHOWN_SIZE] = "";
  CwCaseNode *grown = realloc(node->item, (size_t)(node->count + 1) * sizeof *grown);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %s", node->path);
  node->item = grown;
  *item = &grown[node->count++];
  memset(*item, 0, sizeof **item);
  if (key) CW_TRY(copy_text(key, &(*item)->key));
  if (key) cw_show(key, shown);
  const size_t size = strlen(node->path) + strlen(shown) + 2;
  CW_NEW((*item)->path, size);
  snprintf((*item)->path, size, "%s%s%s", node->path, key ? "." : "", shown);
done:
  return status;
}

static CwStatus read_map(CwEventStream *stream, int depth, CwCaseNode *node) {
  CwStatus status = CW_OK;
  CwEvent key, value;
  for (;;) {
    CwCaseNode *item = NULL;
    CW_TRY(cw_event_next_key(stream, node->path, &key));
    if (key.type == FYET_MAPPING_END) break;
    const CwCaseNode *before = cw_case_tree_find(node, key.text);
    CW_REQUIRE(!before, CW_ERR_INPUT, "%s:%d:%d: %s: given twice, first in line %d; allowed: once", stream->path,
               key.place.line, key.place.column, before->path, before->place.line);
    CW_TRY(cw_event_next(stream, &value));
    CW_TRY(add_item(node, key.text, &item));
    CW_TRY(read_node(stream, &value, depth + 1, item));
  }
done:
  return status;
}

static CwStatus read_list(CwEventStream *stream, int depth, CwCaseNode *node) {
  CwStatus status = CW_OK;
  CwEvent value;
  for (;;) {
    CwCaseNode *item = NULL;
    CW_TRY(cw_event_next(stream, &value));
    if (value.type == FYET_SEQUENCE_END) break;
    CW_TRY(add_item(node, NULL, &item));
    CW_TRY(read_node(stream, &value, depth + 1, item));
  }
done:
  return status;
}

static CwStatus read_node(CwEventStream *stream, const CwEvent *first, int depth, CwCaseNode *node) {
  CwStatus status = CW_OK;
  node->place = first->place;
  CW_REQUIRE(!first->tagged, CW_ERR_INPUT, "%s:%d:%d: %s: it has a tag (!...); allowed: without tag", stream->path,
             node->place.line, node->place.column, node->path);
  CW_REQUIRE(depth <= DEPTH_MOST, CW_ERR_INPUT,
             "%s:%d:%d: %s: nested too deep; allowed: as docs/case-reference.md has it", stream->path, node->place.line,
             node->place.column, node->path);
  switch (first->type) {
  case FYET_SCALAR:
    node->type = CW_NODE_SCALAR;
    CW_REQUIRE(strlen(first->text) < CW_EVENT_TEXT_SIZE - 1, CW_ERR_INPUT,
               "%s:%d:%d: %s: the text is too long; allowed: %d bytes", stream->path, node->place.line,
               node->place.column, node->path, CW_EVENT_TEXT_SIZE - 2);
    CW_TRY(copy_text(first->text, &node->text));
    break;
  case FYET_MAPPING_START:
    node->type = CW_NODE_MAP;
    CW_TRY(read_map(stream, depth, node));
    break;
  case FYET_SEQUENCE_START:
    node->type = CW_NODE_LIST;
    CW_TRY(read_list(stream, depth, node));
    break;
  default:
    status = CW_FAIL(CW_ERR_INPUT, "%s:%d:%d: %s: it is %s; allowed: a value, a list or a mapping", stream->path,
                     node->place.line, node->place.column, node->path, cw_event_words(first->type));
  }
done:
  return status;
}

CwStatus cw_case_tree_read(CwEventStream *stream, const char *path, const CwEvent *first, CwCaseNode *node) {
  CwStatus status = CW_OK;
  CW_TRY(copy_text(path, &node->path));
  CW_TRY(read_node(stream, first, 0, node));
done:
  return status;
}

void cw_case_tree_free(CwCaseNode *node) {
  for (int i = 0; i < node->count; i++) cw_case_tree_free(&node->item[i]);
  free(node->item);
  free(node->path);
  free(node->key);
  free(node->text);
  memset(node, 0, sizeof *node);
}

const CwCaseNode *cw_case_tree_find(const CwCaseNode *map, const char *key) {
  for (int i = 0; i < map->count; i++)
    if (!strcmp(map->item[i].key, key)) return &map->item[i];
  return NULL;
}
