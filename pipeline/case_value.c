// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_value.h"

#include <ctype.h>
#include <float.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

void cw_show(const char *text, char shown[CW_SHOWN_SIZE]) {
  enum { LIMIT = 48 };
  size_t length = strlen(text), kept = length;
  if (!length) {
    strcpy(shown, "(nothing)");
    return;
  }
  if (kept > LIMIT)
    for (kept = LIMIT; kept > 0 && ((unsigned char)text[kept] & 0xc0) == 0x80;) --kept;
  for (size_t i = 0; i < kept; ++i) {
    unsigned char c = (unsigned char)text[i];
    shown[i] = c < 0x20 || c == 0x7f ? ' ' : (char)c;
  }
  strcpy(shown + kept, kept < length ? "..." : "");
}

// The end of the decimal number at the start of `text`; `text` itself when there is none.
static const char *number_end(const char *text) {
  const char *c = text, *digits;
  int count = 0;
  if (*c == '+' || *c == '-') ++c;
  for (; isdigit((unsigned char)*c); ++c) ++count;
  if (*c == '.')
    for (++c; isdigit((unsigned char)*c); ++c) ++count;
  if (!count) return text;
  if (*c == 'e' || *c == 'E') {
    digits = c + 1;
    if (*digits == '+' || *digits == '-') ++digits;
    if (isdigit((unsigned char)*digits)) {
      for (c = digits; isdigit((unsigned char)*c);) ++c;
    }
  }
  return c;
}

const char *cw_number_text_read(const char *text, double *number) {
  const char *bare = text + (*text == '+' || *text == '-');
  const char *end = number_end(text);
  if (!strcasecmp(bare, ".inf") || !strcasecmp(bare, "inf") || !strcasecmp(bare, "infinity") ||
      !strcasecmp(bare, ".nan") || !strcasecmp(bare, "nan"))
    return "is not a finite number";
  if (bare[0] == '0' && bare[1] && strchr("xXoObB", bare[1])) return "is not a decimal number";
  if (end == text) return "is not a number";
  if (*end == ',') return "has a comma (decimals follow a point)";
  if (*end) return "has text behind the number (the unit stands in the key)";
  if (bare[0] == '0' && isdigit((unsigned char)bare[1])) return "has a leading zero";
  *number = strtod(text, NULL); // the locale is never set, so the point is a point
  return isfinite(*number) ? NULL : "is not a finite number";
}

const char *cw_count_text_read(const char *text, double *count) {
  static const char *const wrong = "is not a whole number";
  char digits[40];
  size_t length = strlen(text);
  if (!isdigit((unsigned char)text[0]) || length >= sizeof digits) return wrong;
  memcpy(digits, text, length + 1);
  char last = text[length - 1];
  double factor = last == 'k' || last == 'K' ? 1e3 : last == 'M' ? 1e6 : last == 'G' ? 1e9 : 1;
  if (factor > 1) digits[length - 1] = '\0';
  if (cw_number_text_read(digits, count)) return wrong;
  const double product = *count * factor;
  *count = round(product); // 1.1 M is 1100000 and not its neighbour: two roundings are forgiven
  return fabs(product - *count) <= 2 * DBL_EPSILON * product ? NULL : wrong;
}

static int is_name(const char *text, double most) {
  if (!isalpha((unsigned char)text[0]) || strlen(text) > (size_t)most) return 0;
  for (const char *c = text; *c; ++c)
    if ((unsigned char)*c >= 0x80 || (!isalnum((unsigned char)*c) && *c != '_' && *c != '-')) return 0;
  return 1;
}

int cw_case_value_read(const CwCaseKey *key, const CwUnit *unit, const char *text, int plain, CwCase *table,
                       char wrong[CW_WRONG_SIZE]) {
  char shown[CW_SHOWN_SIZE], allowed[CW_KEY_ALLOWED_SIZE];
  const char *what = NULL;
  const CwUnit *own = cw_unit_find(key->unit);
  char converted[64] = "";
  double number = NAN;
  if (plain && (!*text || !strcmp(text, "~") || !strcasecmp(text, "null"))) {
    what = key->presence == CW_KEY_REQUIRED   ? "is no value"
           : key->presence == CW_KEY_OPTIONAL ? "is no value (leave the key out)"
                                              : "is no value (leave the key out for its default)";
  } else if (key->presence == CW_KEY_AUTO && plain && !strcmp(text, "auto")) {
    cw_case_key_set(key, key->fallback, table);
    return 1;
  } else if (key->type == CW_KEY_NAME) {
    if (is_name(text, key->most))
      snprintf((char *)table + key->offset, CW_NAME_SIZE, "%s", text);
    else
      what = "is not a name that files and solvers take";
  } else if (key->type == CW_KEY_CHOICE || key->type == CW_KEY_CHOICES) {
    what = "is not one of the choices";
    for (int i = 0; key->choices[i]; ++i)
      if (!strcmp(text, key->choices[i])) {
        what = NULL;
        number = key->type == CW_KEY_CHOICE ? i : (int)cw_case_key_value(key, table) | 1 << i;
      }
  } else {
    what = !plain                      ? "is text, not a number (it stands in quotes)"
           : key->type == CW_KEY_INT64 ? cw_count_text_read(text, &number)
                                       : cw_number_text_read(text, &number);
    if (!what && key->type == CW_KEY_INT && strspn(text, "+-0123456789") < strlen(text)) what = "is not a whole number";
    double in_own = number;
    if (!what && own && unit != own) {
      in_own = number * unit->numerator / unit->denominator * own->denominator / own->numerator;
      snprintf(converted, sizeof converted, " (it is %.6g %s)", in_own, own->text);
    }
    if (!what && (in_own < key->least || in_own > key->most)) what = "is out of range";
  }
  if (!what) {
    if (key->type != CW_KEY_NAME) cw_case_key_set_in(key, unit, number, table);
    return 1;
  }
  cw_show(text, shown);
  cw_case_key_allowed(key, allowed);
  snprintf(wrong, CW_WRONG_SIZE, "%s %s%s; allowed: %s", shown, what, converted, allowed);
  return 0;
}

// Levenshtein distance of what was written from a key, without regard to case; a letter left out counts less than a
// wrong one, since people shorten. -1 when a text is too long to be worth it.
static int edit_distance(const char *a, const char *b) {
  enum { LIMIT = 80, WRONG = 3 };
  int row[LIMIT + 1];
  size_t n = strlen(a), m = strlen(b);
  if (n > LIMIT || m > LIMIT) return -1;
  for (size_t j = 0; j <= m; ++j) row[j] = (int)j;
  for (size_t i = 1; i <= n; ++i) {
    int diagonal = row[0];
    row[0] = WRONG * (int)i;
    for (size_t j = 1; j <= m; ++j) {
      int change = diagonal + WRONG * (tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]));
      int least = row[j] + WRONG < row[j - 1] + 1 ? row[j] + WRONG : row[j - 1] + 1;
      diagonal = row[j];
      row[j] = change < least ? change : least;
    }
  }
  return row[m];
}

// The key of `section` that is `name` but for its unit, or NULL.
static const CwCaseKey *key_of_other_unit(const char *section, const char *name) {
  size_t stem, key_stem;
  const CwUnit *unit = cw_unit_of_key(name, &stem);
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    if (strcmp(key->section, section)) continue;
    const CwUnit *key_unit = cw_unit_of_key(key->key, &key_stem);
    if (unit != key_unit && stem == key_stem && !strncasecmp(name, key->key, stem)) return key;
  }
  return NULL;
}

static void wrong_unit(const CwCaseKey *key, const char *name, const char *text, char wrong[CW_WRONG_SIZE]) {
  size_t stem;
  char allowed[CW_KEY_ALLOWED_SIZE], converted[64] = "";
  const CwUnit *unit = cw_unit_of_key(name, &stem), *asked = cw_unit_find(key->unit);
  double number;
  cw_case_key_allowed(key, allowed);
  if (!asked) {
    snprintf(wrong, CW_WRONG_SIZE, "wrong unit in the key, %s; allowed: %s without unit, %s", unit->text, key->key,
             allowed);
    return;
  }
  if (!unit) {
    snprintf(wrong, CW_WRONG_SIZE, "the key lacks its unit, %s; allowed: %s, %s", asked->text, key->key, allowed);
    return;
  }
  if (text && !strcmp(unit->quantity, asked->quantity) && !cw_number_text_read(text, &number))
    snprintf(converted, sizeof converted, " (%.6g %s is %.6g %s)", number, unit->text,
             number * unit->numerator / unit->denominator * asked->denominator / asked->numerator, asked->text);
  snprintf(wrong, CW_WRONG_SIZE, "wrong unit in the key, %s instead of %s; allowed: %s, %s%s", unit->text, asked->text,
           key->key, allowed, converted);
}

void cw_case_key_unknown(const char *section, const char *name, const char *text, char wrong[CW_WRONG_SIZE]) {
  const CwCaseKey *key = key_of_other_unit(section, name);
  const char *nearest = NULL;
  int least = -1;
  if (!name[0]) {
    snprintf(wrong, CW_WRONG_SIZE, "the key is empty; allowed: the keys of docs/case-reference.md");
    return;
  }
  if (key) {
    wrong_unit(key, name, text, wrong);
    return;
  }
  for (size_t i = 0; i < cw_case_key_count; ++i)
    if (!strcmp(cw_case_keys[i].key, name)) {
      const char *home = cw_case_keys[i].section;
      snprintf(wrong, CW_WRONG_SIZE, "unknown key here; allowed: the key %s in %s%s", name,
               home[0] ? "section " : "the top of the file", home);
      return;
    }
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    // At the top of the file the sections are keys like any other.
    const char *here = cw_case_keys[i].key;
    if (strcmp(cw_case_keys[i].section, section)) {
      if (section[0]) continue;
      here = cw_case_keys[i].section;
    }
    int distance = edit_distance(name, here);
    if (distance < 0 || (nearest && distance >= least)) continue;
    nearest = here;
    least = distance;
  }
  snprintf(wrong, CW_WRONG_SIZE, "unknown key; allowed: the keys of docs/case-reference.md, the nearest is %s",
           nearest ? nearest : cw_case_keys[0].key);
}
