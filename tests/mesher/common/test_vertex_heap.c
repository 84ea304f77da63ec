// SPDX-License-Identifier: AGPL-3.0-or-later

#include "mesher/common/vertex_heap.h"
#include "tests/unit_test.h"

enum { COUNT = 1000 };

static void least_first_and_ties_by_number(void **state) {
  CwHeap heap = {0};
  CwHeapItem last = {-1, -1};
  for (int32_t i = 0; i < COUNT; i++) {
    int32_t v = (int32_t)(((int64_t)i * 617) % COUNT);
    assert_int_equal(cw_heap_push(&heap, v % 10, v), CW_OK);
  }
  for (int i = 0; i < COUNT; i++) {
    CwHeapItem top = cw_heap_pop(&heap);
    assert_true(top.key > last.key || (top.key == last.key && top.v > last.v));
    assert_int_equal(top.v % 10, (int)top.key);
    last = top;
  }
  assert_int_equal(heap.count, 0);
  cw_heap_free(&heap);
}

// All orders in which up to six items can come.
static void any_order_comes_out_sorted(void **state) {
  for (int count = 1, orders = 1; count <= 6; orders *= ++count)
    for (int order = 0; order < orders; order++) {
      CwHeap heap = {0};
      int left[6], rest = order;
      for (int i = 0; i < count; i++) left[i] = i;
      for (int n = count; n > 0; rest /= n--) {
        int chosen = rest % n;
        assert_int_equal(cw_heap_push(&heap, left[chosen], left[chosen]), CW_OK);
        left[chosen] = left[n - 1];
      }
      for (int i = 0; i < count; i++) assert_int_equal(cw_heap_pop(&heap).v, i);
      cw_heap_free(&heap);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(least_first_and_ties_by_number),
                                     cmocka_unit_test(any_order_comes_out_sorted)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
