# SPDX-License-Identifier: AGPL-3.0-or-later
"""Every module has a test: tests/ROOM/test_MODULE, another test of its stage that calls one of its functions, or one
whose comment at the top names the module (the file name without its ending). With --list: each module and its tests.
Templates are sources of others' programs, and no modules.
The README of each room of the mesher names all its modules, in ROOM lines; docs/mesher.md has PAGE words at most."""
import os
import pathlib
import re
import sys

STAGES = ["pipeline", "geometry", "mesher", "export"]
PROGRAMS = {"main"}  # run by the tests of whole runs
ROOM, PAGE = range(20, 41), 2500
source = pathlib.Path(os.environ.get("CUTWATER_SOURCE", pathlib.Path(__file__).resolve().parents[1]))


def comment_of(text):
    """The comment, or docstring, at the top of a file."""
    return re.match(r'((//|#!|# )[^\n]*\n)*("""[\s\S]*?""")?', text)[0]


def functions_of(text):
    """The functions with external linkage that a source defines."""
    return set(re.findall(r"^(?!static|typedef|#|\}|//)[A-Za-z_][\w \*]*?\b(cw_\w+)\(", text, re.M))


def tests_of(stage):
    """(path, text) of the tests of single modules of a stage, and of whole runs."""
    return [(path, path.read_text()) for path in sorted((source / "tests").rglob("test_*"))
            if path.suffix in (".c", ".cpp", ".py") and path.relative_to(source).parts[1] in (stage, "pipeline_run")]


# The judge itself.
assert comment_of('// A\n// b: c.\n#include "d"\n// e\n') == "// A\n// b: c.\n"
assert comment_of('# A\n"""b\nc"""\nimport d\n') == '# A\n"""b\nc"""'
assert functions_of("int cw_a(int x) {\n}\nstatic int cw_b(void) {\n}\n  cw_c();\n") == {"cw_a"}

faults, seen = [], 0
for stage in STAGES:
    tests = tests_of(stage)
    for path in sorted((source / stage).rglob("*")):
        if path.suffix not in (".c", ".cpp") or path.stem in PROGRAMS or "templates" in path.parts:
            continue
        name, functions = path.relative_to(source), functions_of(path.read_text())
        own = [test for test, _ in tests if test.stem == f"test_{path.stem}"]
        others = [test for test, text in tests if re.search(rf"\b{path.stem}\b", comment_of(text))
                  or functions & set(re.findall(r"\bcw_\w+", text))]
        seen += 1
        if "--list" in sys.argv:
            print(name, *(test.relative_to(source) for test in own or others))
        if not own and not others:
            faults.append(f"{name}: no tests/{name.parent}/test_{path.stem}, and no test calls or names it")
for readme in sorted((source / "mesher").glob("*/README.md")):
    text = readme.read_text()
    named, lines = set(re.findall(r"\b\w+\b", text)), text.count("\n")
    if lines not in ROOM:
        faults.append(f"{readme.relative_to(source)}: {lines} lines; allowed: {ROOM[0]} to {ROOM[-1]}")
    faults += [f"{readme.relative_to(source)}: does not name {module}" for module in sorted(
        {path.stem for path in readme.parent.iterdir() if path.suffix in (".c", ".h", ".cpp")} - named)]
words = len((source / "docs/mesher.md").read_text().split())
if words > PAGE:
    faults.append(f"docs/mesher.md: {words} words; allowed: {PAGE}")
print("\n".join(faults) or f"{seen} modules, each with a test")
sys.exit(1 if faults or not seen else 0)
