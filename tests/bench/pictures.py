#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""pictures.py [--cells 500k] [--bin build/bin]

Makes the pictures of docs/mesher.md anew, but for that of the rule of region numbers (rule_picture.py): runs the
paper's pump through all stages and takes them from its report."""
import tempfile
from pathlib import Path

from programs import SOURCE, execute, options_of
from runs import BIN, PAPER_CASE, save_picture, stage_line

PICTURES = {"mesher-regions.png": "Regions of the rotor", "mesher-surface.png": "Tongue",
            "mesher-layers.png": "b: layers on the shroud", "mesher-volume.png": "a: neck and step"}


def main():
    options = options_of(__doc__, cells="500k", bin=BIN).parse_args()
    with tempfile.TemporaryDirectory() as work:
        run = Path(work)
        for stage in ("geometry", "mesh", "export", "report"):
            execute(*stage_line(options.bin, stage, PAPER_CASE, run, options.cells, 2))
        for name, title in PICTURES.items():
            save_picture(run, title, SOURCE / "docs" / name)
            print(f"docs/{name}: {title}")


if __name__ == "__main__":
    main()
