// SPDX-License-Identifier: AGPL-3.0-or-later
// The one table of every key of the case file. Reading, validation, defaults and the page
// docs/case-reference.md all follow from it: a new key is one new row here and one field in case.h.
#pragma once

#include <stddef.h>
#include <stdio.h>

#include "pipeline/case.h"
#include "pipeline/case_unit.h"

#ifdef __cplusplus
extern "C" {
#endif

// The field at `offset` is a double, an int, an int64_t, an enum, an int with the bit 1 << i for each
// choice i of several, a char[CW_NAME_SIZE], or a CwList of doubles.
typedef enum {
  CW_KEY_REAL,
  CW_KEY_INT,
  CW_KEY_INT64,
  CW_KEY_CHOICE,
  CW_KEY_CHOICES,
  CW_KEY_NAME,
  CW_KEY_LIST
} CwKeyType;

// A key left out is an error, has its default, is left to the hydraulic design, or means that there is nothing of the
// kind. An automatic key may also be given as "auto", which is its default: the mesher then finds the value. A value
// left open is NAN, or 0 of a count.
typedef enum { CW_KEY_REQUIRED, CW_KEY_DEFAULT, CW_KEY_COMPUTED, CW_KEY_OPTIONAL, CW_KEY_AUTO } CwKeyPresence;

typedef struct {
  const char *section; // "" for the top of the file
  const char *key;     // ends in its unit, when it has one
  CwKeyType type;
  CwKeyPresence presence;
  const char *unit;           // suffix of the key, an entry of the table of units; "" without
  double least, most;         // in the unit, both allowed
  double fallback;            // the default in the unit; of a choice: its index; of several: their bits
  const char *const *choices; // NULL-terminated, in the order of the enum
  size_t offset;              // into CwCase
  const char *meaning;
} CwCaseKey;

// All keys, section after section, in the order of the page.
extern const CwCaseKey cw_case_keys[];
extern const size_t cw_case_key_count;

enum { CW_KEY_PATH_SIZE = 80, CW_KEY_ALLOWED_SIZE = 160 };

// Index of `key` in `section`, or -1.
int cw_case_key_find(const char *section, const char *key);

// The same for a key that may end in another unit of the same quantity ("outlet_diameter_in"). `*unit`: the one that
// it ends in, or NULL.
int cw_case_key_find_in(const char *section, const char *key, const CwUnit **unit);

// Whether the hydraulic design and its solids follow from the key: those of walls and mesh and the step of time only
// shape what comes after, or nothing but the solver's files.
int cw_case_key_shapes_pump(const CwCaseKey *key);

// Whether the schema has keys in `section`.
int cw_case_section_known(const char *section);

// "impeller.blade_count"; "name" at the top.
void cw_case_key_path(const CwCaseKey *key, char path[CW_KEY_PATH_SIZE]);

// "wrap, head or beta", of words that end with NULL.
void cw_case_words(const char *const *words, char *text, size_t size);

// What the key may be, for messages and the page: "10 to 5000 mm", "a whole number from 3 to 9", "wrap, head
// or beta".
void cw_case_key_allowed(const CwCaseKey *key, char allowed[CW_KEY_ALLOWED_SIZE]);

// Value of the key's field in the unit of the key; of a choice: its index; of several: their bits; NAN of
// names and lists.
double cw_case_key_value(const CwCaseKey *key, const CwCase *table);

// Sets the key's field from a value in the unit of the key; adds it to a list that has room. Not for names. No check
// of the range.
void cw_case_key_set(const CwCaseKey *key, double value, CwCase *table);

// The same from a value in `unit`, or NULL for none.
void cw_case_key_set_in(const CwCaseKey *key, const CwUnit *unit, double value, CwCase *table);

// The word of a key of one choice for a value of its enum. The key must be there.
const char *cw_case_choice(const char *section, const char *key, int value);

// A value of a key of choices as people write it: "wrap", of several "[cgns, openfoam]".
void cw_case_key_chosen(const CwCaseKey *key, double value, char text[CW_KEY_ALLOWED_SIZE]);

// Every key at its default, as for an empty file: keys that the hydraulic design computes are NAN, required ones NAN, 0
// or "".
void cw_case_defaults(CwCase *table);

// Writes the sections and their tables as docs/case-reference.md holds them.
void cw_case_schema_markdown(FILE *stream);

#ifdef __cplusplus
}
#endif
