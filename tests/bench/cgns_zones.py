#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""cgns_zones.py PUMP_CGNS [--work DIR] [--bin build/bin]

CGNS's own cgnscheck on each zone of a file alone, from a copy without the others and without their connectivity:
cgnscheck keeps the faces of all zones that it looks at, about 330 bytes a cell, so that on 24 GiB 145 million cells
are too many together. Errors, warnings, seconds and peak memory of each; ends with 1 where one has anything to say."""
import re
import shutil
import sys
import tempfile
from pathlib import Path

from programs import execute, made_folder, options_of
from runs import BIN


def main():
    parser = options_of(__doc__, bin=BIN)
    parser.add_argument("file", type=Path)
    parser.add_argument("--work", type=made_folder)
    options = parser.parse_args()
    names = re.findall(r"^    \+-(\w+)\n    [| ] \+-ZoneType", execute("cgnslist", options.file).text, re.M)
    if not names:
        sys.exit(f"cgns_zones: {options.file} has no zone")
    bad = 0
    for name in names:
        with tempfile.TemporaryDirectory(dir=options.work) as folder:
            copy = Path(folder) / "zone.cgns"
            shutil.copyfile(options.file, copy)
            execute(options.bin / "one_zone", copy, name)
            run = execute("cgnscheck", "-v", copy, check=False)
            errors, warnings = len(re.findall("ERROR", run.text)), len(re.findall("WARNING", run.text))
            whole = run.status == 0 and "checking complete" in run.text
            bad += not whole or errors > 0 or warnings > 0
            print(f"{name}: " + (f"{errors} errors, {warnings} warnings" if whole else f"ended with {run.status}")
                  + f", {run.wall:.0f} s, {run.peak / 2**30:.1f} GiB", flush=True)
    sys.exit(bad > 0)


main()
