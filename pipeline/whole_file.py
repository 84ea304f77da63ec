# SPDX-License-Identifier: AGPL-3.0-or-later
"""Files that are whole or not there."""
import os
from pathlib import Path


def write_whole(path, text):
    """Writes a file under its name only once all of it is on the disk."""
    path = Path(path)
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    with open(part, "w", encoding="utf-8", newline="") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    part.replace(path)
