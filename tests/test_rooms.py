# SPDX-License-Identifier: AGPL-3.0-or-later
"""The rooms of the code include each other one way: each only what stands before it here. Inside a room its modules (a
header and the source of its name) use each other one way too: by includes, and by calls of functions of the other.
Templates are sources of others' programs, and in no room."""
import os
import pathlib
import re
import sys

STAGES = {"pipeline": ["pipeline"], "geometry": ["pipeline", "geometry"], "mesher": ["pipeline", "mesher"],
          "export": ["pipeline", "export"]}
MESHER = ["parallel", "common", "cad", "size", "surface", "plan", "network", "layers", "boundary", "thickness", "fill",
          "region", "run"]
SOURCES, HEADERS = (".c", ".cpp"), (".h", ".hpp")

source = pathlib.Path(os.environ["CUTWATER_SOURCE"])


def definitions(text):
    """The functions with external linkage that a source defines."""
    for match in re.finditer(r"^(?!static|typedef|#|\}|//)[A-Za-z_][\w \*]*?\b(cw_\w+)\(", text, re.M):
        depth, at = 0, match.end() - 1
        while True:
            depth += {"(": 1, ")": -1}.get(text[at], 0)
            at += 1
            if depth == 0:
                break
        if text[at:].lstrip().startswith("{"):
            yield match[1]


def uses(room):
    """Of each module of a folder those of the same folder that it uses."""
    files = {path: re.sub(r"//.*", "", path.read_text()) for path in sorted(room.iterdir())
             if path.suffix in SOURCES + HEADERS}
    owner = {name: path.stem for path, text in files.items() if path.suffix in SOURCES for name in definitions(text)}
    used = {path.stem: set() for path in files}
    for path, text in files.items():
        used[path.stem] |= {owner[name] for name in re.findall(r"\bcw_\w+\b", text)
                            if name in owner and path.suffix in SOURCES}
        for include in re.findall(r'#include "([^"]+)"', text):
            if (source / include).parent == room:
                used[path.stem].add(pathlib.Path(include).stem)
    return used


def circles(used):
    """Modules that use one another, directly or by others: sets of more than one."""
    reach = {module: set(others) for module, others in used.items()}
    for middle in reach:
        for module in reach:
            if middle in reach[module]:
                reach[module] |= reach[middle]
    found = {frozenset(b for b in reach if b == a or (b in reach[a] and a in reach[b])) for a in reach}
    return sorted((sorted(circle) for circle in found if len(circle) > 1))


# The judge itself: a uses b by a call and b uses a by an include.
assert circles({"a": {"b"}, "b": {"c"}, "c": {"a", "c"}, "d": {"a"}}) == [["a", "b", "c"]]
assert circles({"a": {"a", "b"}, "b": set()}) == []
SOURCE = "int cw_a(int (*f)(int));\nint cw_b(void) {\n  cw_c();\n}\nstatic int cw_d(void) {\n}\n"
assert list(definitions(SOURCE)) == ["cw_b"]

faults, seen = [], 0
for stage, allowed in STAGES.items():
    for path in sorted((source / stage).rglob("*")):
        if path.suffix not in SOURCES + HEADERS or "templates" in path.parts:
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
for stage in STAGES:
    for room in [source / stage] + sorted(path for path in (source / stage).rglob("*") if path.is_dir()):
        faults += [f"{room.relative_to(source)}/: a circle of modules: {', '.join(circle)}"
                   for circle in circles(uses(room))]
print("\n".join(faults) or f"{seen} includes, all one way")
sys.exit(1 if faults or not seen else 0)
