# SPDX-License-Identifier: AGPL-3.0-or-later
"""The rooms of the code include each other one way: each only what stands before it here."""
import os
import pathlib
import re
import sys

STAGES = {"pipeline": ["pipeline"], "geometry": ["pipeline", "geometry"], "mesher": ["pipeline", "mesher"],
          "export": ["pipeline", "export"]}
MESHER = ["parallel", "common", "cad", "size", "surface", "plan", "network", "layers", "skeleton", "heights", "fill",
          "region", "run"]

source = pathlib.Path(os.environ["CUTWATER_SOURCE"])
faults, seen = [], 0
for stage, allowed in STAGES.items():
    for path in sorted((source / stage).rglob("*")):
        if path.suffix not in (".c", ".h", ".cpp"):
            continue
        name = path.relative_to(source)
        for number, line in enumerate(path.read_text().splitlines(), 1):
            include = re.match(r'#include "([^"]+)"', line)
            if not include:
                continue
            seen += 1
            there = include[1].split("/")
            if there[0] not in allowed:
                faults.append(f"{name}:{number}: {stage}/ includes {include[1]}; it may include {', '.join(allowed)}")
            if stage == there[0] == "mesher" and len(name.parts) == 3 and len(there) == 3:
                room, other = name.parts[1], there[1]
                unknown = {room, other} - set(MESHER)
                if unknown:
                    faults.append(f"{name}:{number}: room {min(unknown)} has no place in the order of {__file__}")
                elif MESHER.index(other) > MESHER.index(room):
                    faults.append(f"{name}:{number}: {room}/ includes {include[1]}, of a room after it")
print("\n".join(faults) or f"{seen} includes, all one way")
sys.exit(1 if faults or not seen else 0)
