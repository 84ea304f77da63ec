# SPDX-License-Identifier: AGPL-3.0-or-later
"""The pages that verify.py and measurements.py write: what stays, what goes, and what is named as missing."""
import re
import unittest
from unittest import mock

import measurements
import page
from cutwater import fresh


class Written(unittest.TestCase):
    def setUp(self):
        self.path = fresh("page") / "page.md"
        self.page = page.Page(self.path, "# Page\n", {"a": "bench a", "b": "bench b", "c": "bench c"}, "make page")

    def write(self, digest, *names):
        with mock.patch.object(page, "sources_digest", lambda command: f"{digest}{command[-1]}"):
            self.page.write({name: self.page.section(name, f"Section {name}", "", f"Of {digest}.", "```\nx\n\ny\n```")
                             for name in names})
        return self.path.read_text()

    def test_sections_stay_and_tell_of_older_sources(self):
        text = self.write("1", "c", "a")
        self.assertEqual(text, "# Page\n\n<!-- section a 1a -->\n## Section a\n\nOf 1.\n\n```\nx\n\ny\n```\n\n"
                               "<!-- section c 1c -->\n## Section c\n\nOf 1.\n\n```\nx\n\ny\n```\n\n"
                               "<!-- missing -->\nNot made: b (`make page`).\n")
        self.assertEqual(self.write("1"), text)
        whole = self.write("1", "b")
        self.assertEqual(whole.count("<!-- missing -->"), 0)
        text = self.write("2", "b")
        older = "*Not made on these sources, but on those of the commit below.*\n\n"
        for name in "ac":
            self.assertIn(f"<!-- section {name} 1{name} -->\n## Section {name}\n\n{older}Of 1.\n", text)
        self.assertIn("<!-- section b 2b -->\n## Section b\n\nOf 2.\n", text)
        self.assertEqual(self.write("3"), self.write("3"))  # the line stands there once
        self.assertEqual(self.write("1", "b"), whole)

    def test_a_section_of_no_command_goes(self):
        """Also from a page without the mark of its end, whatever stands there."""
        self.path.write_text("# Old\n\n<!-- section b 2b -->\n## Section b\n\n"
                             "Kept.\n\n<!-- section gone 2d -->\n## Gone\n\nNot measured on these sources: c.\n")
        self.assertEqual(self.write("2"), "# Page\n\n<!-- section b 2b -->\n## Section b\n\nKept.\n\n<!-- missing -->\n"
                                          "Not made: a, c (`make page`).\n")

    def test_the_page_of_the_measurements_has_or_names_each_section(self):
        text = measurements.PAGE.path.read_text()
        made = re.findall(r"<!-- section (\w+) ", text)
        missing = re.search(r"<!-- missing -->\nNot made: (.*) \(", text)
        self.assertEqual(sorted(made + (missing[1].split(", ") if missing else [])), sorted(measurements.SECTIONS))

    def test_the_sources_of_a_section(self):
        read = []
        with mock.patch.object(page, "run_text", lambda *line: read.append(line) or ""):
            for command in ("tests/bench/verify.py heads", "tests/bench/table1.py --cells 21M", "build/bin/x 500"):
                page.sources_digest(command)
        verify, table1, tests = read
        self.assertLessEqual({"tests/bench/foam_read.py", "tests/bench/verify.mk", "tests/cad"}, set(verify))
        self.assertNotIn(":(exclude)export", verify)
        self.assertLessEqual({"tests/bench/fill.py", "tests/measure/chew*", ":(exclude)export"}, set(table1))
        self.assertNotIn("tests/bench/foam_read.py", table1)
        self.assertLessEqual({"tests/mesher", ":(exclude)export", ":(exclude)pipeline/report"}, set(tests))


if __name__ == "__main__":
    unittest.main()
