// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/html.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/draw.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static void html_is_escaped_and_encoded(void **state) {
  char *text = NULL;
  size_t size = 0;
  FILE *page = open_memstream(&text, &size);
  cw_html_text(page, "<b>", "<a & \"b\">", "</b>");
  cw_html_text(page, "<i>", NULL, "</i>");
  cw_html_label(page, "", "|outlet_width", "");
  cw_html_label(page, "", "outlet_width", "");
  cw_html_label(page, "", "y_plus_blade", "");
  cw_html_label(page, "", "|", "");
  cw_html_label(page, "", "npsh_required", "");
  cw_html_label(page, "", "predicted_head_wiesner", "");
  cw_html_label(page, "", "guelich", "");
  cw_html_number_cell(page, "12.87");
  cw_html_number_cell(page, "74");
  for (size_t n = 0; n < 4; n++) cw_html_base64(page, (const unsigned char *)"Man", n);
  cw_html_base64(page, (const unsigned char *)"\377\373\360", 3);
  fclose(page);
  assert_string_equal(text, "<b>&lt;a &amp; &quot;b&quot;&gt;</b><i></i>|outlet widthOutlet widthy<sup>+</sup> blade"
                            "|NPSH requiredPredicted head WiesnerG&uuml;lich"
                            "<td class=\"n\">12<span>.87</span></td><td class=\"n\">74<span></span></td>"
                            "TQ==TWE=TWFu//vw");
  free(text);
}

static CwStatus embed(const char *content, char **text) {
  const char *path = in_test_folder("drawing.svg");
  size_t size = 0;
  write_text(path, content);
  FILE *page = open_memstream(text, &size);
  CwStatus status = cw_html_svg_file(page, path);
  fclose(page);
  unlink(path);
  return status;
}

static void drawings_are_embedded_alone(void **state) {
  char *text;
  assert_int_equal(embed("<?xml version=\"1.0\"?>\n<svg width=\"3\"><rect/></svg>\n<!-- end -->", &text), CW_OK);
  assert_string_equal(text, "<svg width=\"3\"><rect/></svg>\n");
  free(text);
  static const char *const refused[] = {"",
                                        "<html></html>",
                                        "<svg width=\"3\"><rect/>",
                                        "<svg><script>x</script></svg>",
                                        "<svg><image href=\"http://a.b/c.png\"/></svg>",
                                        "<svg><rect fill=\"url(#a)\"/></svg>"};
  for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
    assert_int_equal(embed(refused[k], &text), CW_ERR_INPUT);
    assert_string_equal(text, "");
    free(text);
  }
}

// Every byte but 0 comes back when the escapes are undone, and none is left that opens a tag or ends an attribute.
static void every_character_comes_back(void **state) {
  static const char *const escape[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  char given[256], *text = NULL, back[256];
  size_t size = 0, used = 0;
  for (int c = 1; c < 256; c++) given[c - 1] = (char)c;
  given[255] = '\0';
  FILE *page = open_memstream(&text, &size);
  cw_html_text(page, "", given, "");
  fclose(page);
  assert_null(strpbrk(text, "<>\"'"));
  for (const char *c = text; *c && used < 255; used++) {
    back[used] = *c;
    for (int e = 0; e < 5; e++)
      if (!strncmp(c, escape[e], strlen(escape[e]))) {
        back[used] = "&<>\"'"[e];
        c += strlen(escape[e]) - 1;
      }
    c++;
  }
  assert_int_equal(used, 255);
  assert_memory_equal(back, given, 255);
  free(text);
}

static int digit_of(char c) {
  return c >= 'A' && c <= 'Z'   ? c - 'A'
         : c >= 'a' && c <= 'z' ? c - 'a' + 26
         : c >= '0' && c <= '9' ? c - '0' + 52
         : c == '+'             ? 62
         : c == '/'             ? 63
                                : -1;
}

// Bytes of any number, read back bit by bit: four digits for each three bytes, = for what lacks (RFC 4648).
static void base64_brings_every_bit_back(void **state) {
  uint64_t seed = 4;
  for (size_t size = 0; size < 100; size++) {
    unsigned char bytes[100], back[100] = {0};
    char *text = NULL;
    size_t length = 0, bits = 0;
    for (size_t i = 0; i < size; i++) bytes[i] = (unsigned char)draw_below(&seed, 256);
    FILE *page = open_memstream(&text, &length);
    cw_html_base64(page, bytes, size);
    fclose(page);
    assert_int_equal(length, (size + 2) / 3 * 4);
    assert_int_equal(strspn(text + (length - (3 - size % 3) % 3), "="), (3 - size % 3) % 3);
    for (; bits < 8 * size; bits++) {
      const int digit = digit_of(text[bits / 6]);
      assert_true(digit >= 0);
      back[bits / 8] |= (unsigned char)((digit >> (5 - bits % 6) & 1) << (7 - bits % 8));
    }
    assert_memory_equal(back, bytes, size);
    free(text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(html_is_escaped_and_encoded),
      cmocka_unit_test(drawings_are_embedded_alone),
      cmocka_unit_test(every_character_comes_back),
      cmocka_unit_test(base64_brings_every_bit_back),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
