# SPDX-License-Identifier: AGPL-3.0-or-later
"""tally.py NAME FILE: tells in one last line what ctest's JUnit file says; exit status 0 where every test passed."""
import sys
import xml.etree.ElementTree as xml

name, path = sys.argv[1:]
try:
    suite = xml.parse(path).getroot()
except (OSError, xml.ParseError) as error:
    sys.exit(f"{name}: error: no results: {error}")
count = {"passed": 0, "failed": 0, "skipped": 0}
for test in suite.iter("testcase"):
    verdict = {"run": "passed", "fail": "failed"}.get(test.get("status"), "skipped")
    count[verdict] += 1
    if verdict != "passed":
        print(f"{verdict}: {test.get('name')}")
seconds = float(suite.get("time", 0))
print(f"{name}: {count['passed']} passed, {count['failed']} failed, {count['skipped']} skipped in {seconds:.0f} s")
sys.exit(0 if count["passed"] and not count["failed"] and not count["skipped"] else 1)
