// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/blocks.h"

#include <stdlib.h>
#include <string.h>

CwStatus cw_blocks_open(CwBlocks *blocks) {
  CwStatus status = CW_OK;
  blocks->out = open_memstream(&blocks->text, &blocks->size);
  CW_REQUIRE(blocks->out, CW_ERR_MEMORY, "out of memory");
done:
  return status;
}

CwStatus cw_blocks_add(CwBlocks *blocks, const char *name, const CwValues *values) {
  CwStatus status = CW_OK;
  char *filled = NULL;
  const CwTemplate *part = cw_template_find(name);
  CW_REQUIRE(part, CW_ERR_EXPORT, "no template %s", name);
  CW_TRY(cw_template_fill(name, strchr(part->text, '\n') + 1, values, &filled));
  fputs(filled, blocks->out);
done:
  free(filled);
  return status;
}

CwStatus cw_blocks_close(CwBlocks *blocks, const char *key, CwValues *values) {
  CwStatus status = CW_OK;
  if (!blocks->out) return status;
  int failed = fclose(blocks->out) != 0;
  CW_REQUIRE(!failed, CW_ERR_MEMORY, "out of memory");
  if (key) CW_TRY(cw_values_set(values, key, "%s", blocks->text));
done:
  free(blocks->text);
  *blocks = (CwBlocks){0};
  return status;
}
