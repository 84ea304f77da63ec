#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""pictures.py [--cells 500k] [--bin build/bin]

Makes the pictures of docs/mesher.md anew, but for that of the rule of region numbers (rule_picture.py): runs the
paper's pump through all stages and takes them from its report."""
import argparse
import base64
import re
import sys
import tempfile
from pathlib import Path

from programs import MPIRUN, SOURCE, execute

PICTURES = {"mesher-regions.png": "Regions of the rotor", "mesher-surface.png": "Tongue",
            "mesher-layers.png": "b: layers on the shroud", "mesher-volume.png": "a: neck and step"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", default="500k")
    parser.add_argument("--bin", type=Path, default=SOURCE / "build/bin")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        for stage in ("geometry", "mesh", "export", "report"):
            launch = [*MPIRUN, 2] if stage in ("mesh", "export") else []
            execute(*launch, options.bin / f"cutwater-{stage}", "--case", SOURCE / "cases/paper/case.yaml", "--run",
                    work, "--cells", options.cells)
        page = (Path(work) / "report/index.html").read_text()
    for name, title in PICTURES.items():
        found = re.search(rf'alt="{re.escape(title)}" src="data:image/png;base64,([^"]+)"', page)
        if not found:
            sys.exit(f"pictures: the report has no picture '{title}'")
        (SOURCE / "docs" / name).write_bytes(base64.b64decode(found[1]))
        print(f"docs/{name}: {title}")


if __name__ == "__main__":
    main()
