// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DASH "\342\200\223"
#define NARROW_SPACE "\342\200\257"
#define MINUS "\342\210\222"

// Groups the digits before the point of `plain`, a number as printf writes it.
static char *group(const char *plain, char text[CW_FORMAT_SIZE]) {
  size_t used = 0;
  if (*plain == '-') {
    used += (size_t)snprintf(text, CW_FORMAT_SIZE, MINUS);
    plain++;
  }
  size_t whole = strspn(plain, "0123456789");
  for (size_t i = 0; i < whole && used < CW_FORMAT_SIZE; i++) {
    int gap = i > 0 && (whole - i) % 3 == 0 && whole > 4;
    used += (size_t)snprintf(text + used, CW_FORMAT_SIZE - used, "%s%c", gap ? NARROW_SPACE : "", plain[i]);
  }
  if (used < CW_FORMAT_SIZE) snprintf(text + used, CW_FORMAT_SIZE - used, "%s", plain + whole);
  return text;
}

char *cw_format_count(int64_t count, char text[CW_FORMAT_SIZE]) {
  char plain[32];
  snprintf(plain, sizeof plain, "%lld", (long long)count);
  return group(plain, text);
}

// 1.004 x 10 to the power of -6, with raised digits.
static char *scientific(double value, int significant, char text[CW_FORMAT_SIZE]) {
  static const char *const raised[] = {"\342\201\260", "\302\271",     "\302\262",     "\302\263",     "\342\201\264",
                                       "\342\201\265", "\342\201\266", "\342\201\267", "\342\201\270", "\342\201\271"};
  char plain[64], power[16];
  snprintf(plain, sizeof plain, "%.*e", significant - 1, fabs(value));
  char *mark = strchr(plain, 'e'), *end = mark;
  snprintf(power, sizeof power, "%ld", strtol(mark + 1, NULL, 10));
  if (memchr(plain, '.', (size_t)(end - plain))) {
    while (end[-1] == '0') end--;
    if (end[-1] == '.') end--;
  }
  size_t used = (size_t)snprintf(text, CW_FORMAT_SIZE, "%s%.*s" NARROW_SPACE "\303\227" NARROW_SPACE "10",
                                 value < 0 ? MINUS : "", (int)(end - plain), plain);
  for (const char *c = power; *c && used < CW_FORMAT_SIZE; c++)
    used += (size_t)snprintf(text + used, CW_FORMAT_SIZE - used, "%s", *c == '-' ? "\342\201\273" : raised[*c - '0']);
  return text;
}

char *cw_format_number(double value, int significant, char text[CW_FORMAT_SIZE]) {
  char plain[64];
  if (!isfinite(value)) {
    snprintf(text, CW_FORMAT_SIZE, DASH);
    return text;
  }
  if (value == 0) return strcpy(text, "0");
  // The power of ten of the value as it will be rounded.
  snprintf(plain, sizeof plain, "%.*e", significant - 1, value);
  int power = 0;
  sscanf(strchr(plain, 'e') + 1, "%d", &power);
  if (power >= 15 || power < -4) return scientific(value, significant, text);
  int decimals = significant - 1 - power;
  snprintf(plain, sizeof plain, "%.*f", decimals > 0 ? decimals : 0, value);
  if (strchr(plain, '.')) { // 74.000 says no more than 74
    char *end = plain + strlen(plain);
    while (end[-1] == '0') *--end = '\0';
    if (end[-1] == '.') *--end = '\0';
  }
  return group(plain, text);
}

char *cw_format_si(double value, int significant, char text[CW_FORMAT_SIZE]) {
  static const struct {
    double scale;
    const char *prefix;
  } prefixes[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "\302\265"}, {1e-9, "n"}};
  char plain[CW_FORMAT_SIZE], number[CW_FORMAT_SIZE];
  size_t at = 3;
  if (isfinite(value) && value != 0) {
    // Rounded first, so that 999.7 k becomes 1 M.
    snprintf(plain, sizeof plain, "%.*e", significant - 1, fabs(value));
    double rounded = 0;
    sscanf(plain, "%lf", &rounded);
    for (at = 0; at < 6 && rounded < prefixes[at].scale * (1 - 1e-12); at++) continue;
  }
  cw_format_number(value / prefixes[at].scale, significant, number);
  snprintf(text, CW_FORMAT_SIZE, "%.40s%s%s", number, *prefixes[at].prefix ? NARROW_SPACE : "", prefixes[at].prefix);
  return text;
}

char *cw_format_seconds(double seconds, char text[CW_FORMAT_SIZE]) {
  char number[CW_FORMAT_SIZE];
  if (!isfinite(seconds)) {
    snprintf(text, CW_FORMAT_SIZE, DASH);
  } else if (seconds < 100) {
    snprintf(text, CW_FORMAT_SIZE, "%.40s s", cw_format_number(seconds, seconds < 0.1 ? 2 : 3, number));
  } else if (seconds < 5999.5) {
    long whole = lround(seconds);
    snprintf(text, CW_FORMAT_SIZE, "%ld min %02ld s", whole / 60, whole % 60);
  } else {
    long minutes = lround(seconds / 60);
    snprintf(text, CW_FORMAT_SIZE, "%ld h %02ld min", minutes / 60, minutes % 60);
  }
  return text;
}

char *cw_format_bytes(double bytes, char text[CW_FORMAT_SIZE]) {
  static const char *const units[] = {"B", "kB", "MB", "GB", "TB"};
  char number[CW_FORMAT_SIZE];
  int at = 0;
  while (bytes >= 999.5 && at < 4) {
    bytes /= 1000;
    at++;
  }
  snprintf(text, CW_FORMAT_SIZE, "%.40s %s", cw_format_number(bytes, 3, number), units[at]);
  return text;
}

char *cw_format_percent(double share, char text[CW_FORMAT_SIZE]) {
  double percent = 100 * share;
  if (!isfinite(share)) {
    snprintf(text, CW_FORMAT_SIZE, DASH);
  } else if (share == 1 || share == 0) {
    snprintf(text, CW_FORMAT_SIZE, "%.0f %%", percent);
  } else {
    // Rounding must not say that all or nothing is meant.
    if (share > 0 && share < 1) percent = fmin(fmax(percent, 0.01), 99.99);
    int decimals = fabs(percent) < 1 || (percent > 99.5 && percent < 100) ? 2 : 1;
    snprintf(text, CW_FORMAT_SIZE, "%.*f %%", decimals, percent);
  }
  return text;
}
