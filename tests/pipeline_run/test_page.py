# SPDX-License-Identifier: AGPL-3.0-or-later
"""The report in a browser (chromium without a screen): no error on the console, the picture that turns answers to each
control, the page fits a phone, and is light. Skipped where there is no chromium."""
import sys
import unittest

import browser
from cutwater import RUN, fresh

class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.source = RUN / "report/index.html"
        cls.page = browser.watched(cls.source, fresh("page") / "index.html", browser.HANDS)
        cls.all, cls.console = browser.browse(cls.page, 1400)

    def test_no_fault(self):
        self.assertEqual(self.all["faults"], [])
        self.assertEqual(self.console, [])

    def test_the_picture_answers_to_each_control(self):
        told = self.all["told"]
        home = told["home"]
        self.assertGreater(home["ink"], 0.1)
        self.assertEqual(told["home again"], home)
        for name in ("suction", "back", "side", "turned", "shifted", "farther", "key", "pinched", "cut", "part off"):
            self.assertNotEqual(told[name]["sum"], home["sum"], name)
        for name in ("farther", "pinched", "cut"):
            self.assertLess(told[name]["ink"], home["ink"], name)
        self.assertNotEqual(told["cut"]["sum"], told["other side"]["sum"])
        self.assertAlmostEqual(told["cut at the end"]["ink"], home["ink"], delta=0.01)  # all lies on its other side
        self.assertEqual(told["whole again"], home)
        self.assertEqual(told["part on"], home)
        self.assertEqual(told["all off"]["ink"], 0)

    def test_it_is_light_and_fits_a_phone(self):
        narrow = browser.fits_a_phone(self, self.source, self.page, browser.HANDS)
        self.assertGreater(narrow["told"]["home"]["ink"], 0.03)

    def test_it_fits_a_screen(self):
        self.assertLessEqual(self.all["needed"], self.all["width"])


if __name__ == "__main__":
    if not browser.THERE:
        print(f"skipped: {browser.MISSING}")
        sys.exit(77)
    unittest.main()
