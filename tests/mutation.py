#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""mutation.py [N] [--seed S] [--only K ...] [--room ROOM] [--work DIR] [--jobs J] [--near]

Mutation testing: do the quick tests notice small faults? N mutations (200 unless given), spread over all rooms by their
lines, are drawn from the C and C++ sources of the programs; mutation K follows from seed and K alone. Each changes one
token of a copy of the tree in --work:

  comparison  < <= > >= == !=     to the neighbouring one
  sign        a + b, a - b, a * b, a / b    to its opposite
  logic       && to ||, || to &&
  number      0 to 1, any other to its double
  condition   if (c) to if (!(c))
  call        a statement that only calls a function is left out, unless it frees memory or tells of progress

The copy is built and tested: first the test of the module and those of its room, then the others (with --near not). A
mutation is caught where a test fails, the program does not end in time, or the compiler refuses it (these are told
apart; a mutation that the compiler refuses does not count). What every mutation came to is kept in
DIR/mutations.jsonl, one line each, and not tried again. At the end: caught of tried by room, and the survivors, each as
file, line, what was changed. Reasons for survivors that cannot be caught stand in tests/mutation_survivors.txt, which
is read: `file: old line: reason` (a change without effect, or one of speed alone)."""
import argparse
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
STAGES = ["pipeline", "geometry", "mesher", "export"]
TEST_LIMIT, SUITE_LIMIT = 300, 1500  # s; a quick test takes less than a minute, all of them some minutes
OPPOSITE = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
            "&&": "||", "||": "&&"}
# Binary operators stand between blanks, as clang-format leaves them; a pointer's star and a sign do not.
TOKENS = [("comparison", r"(?<= )(<=|>=|==|!=|<|>)(?= )"), ("sign", r"(?<= )([-+*/])(?= )"),
          ("logic", r"(?<= )(&&|\|\|)(?= )"),
          ("number", r"(?<![\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?)(?![\w.])"),
          ("condition", r"(?<=\bif )(\([^;{}]*\))(?= [^)])"),
          ("call", r"^ +((?!free|cw_log|cw_progress|\w+_free)[a-z]\w*\([^;{}=]*\);)$")]


def code_of(text):
    """The text with comments, strings and preprocessor lines blanked out, all else in its place."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match[0])
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', blank, text, flags=re.S)
    return re.sub(r"^#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)


def balanced(text):
    """The leading parenthesis of the text up to its own end; '' where it has none."""
    depth = 0
    for place, letter in enumerate(text):
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if depth == 0:
            return text[:place + 1]
    return ""


def places(text):
    """All (kind, begin, end, replacement) of a source file."""
    code = code_of(text)
    for kind, pattern in TOKENS:
        for match in re.finditer(pattern, code, re.M):
            begin, old = match.start(1), match[1]
            if kind == "condition":
                old = balanced(old)
                new = f"(!{old})"
            elif kind == "number":
                new = "1" if float(old) == 0 else f"2 * {old}"
            elif kind == "call":
                new = ";"
            else:
                new = OPPOSITE[old]
            if old:
                yield kind, begin, begin + len(old), new


def room_of(path):
    parts = path.relative_to(SOURCE).parts
    return "/".join(parts[:2]) if len(parts) > 2 else parts[0]


def draw(seed, number, files, only_room):
    """Mutation `number`: a room by its lines, a file of it likewise, a kind, a place of that kind."""
    dice = random.Random(f"{seed}/{number}")
    chosen = [path for path in files if not only_room or room_of(path) == only_room]
    while True:
        path = dice.choices(chosen, [files[path] for path in chosen])[0]
        text = path.read_text()
        found = list(places(text))
        if not found:
            continue
        kind = dice.choice(sorted({place[0] for place in found}))
        _, begin, end, new = dice.choice([place for place in found if place[0] == kind])
        return path, kind, begin, end, new


def run(command, folder, limit, log):
    """Exit status of a command; 'late' where it does not end in time. All its processes end with it."""
    with open(log, "wb") as out:
        child = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=out,
                                 start_new_session=True)
        try:
            return child.wait(limit)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            child.wait()
            return "late"


def test_of(path, tree):
    """Names of the module's own test and of those of its room, as ctest knows them."""
    stage = path.relative_to(SOURCE).parts[0]
    folder = tree / "tests" / path.relative_to(SOURCE).parent
    own = f"{stage}/test_{path.stem}"
    room = sorted(f"{stage}/{test.stem}" for pattern in ("test_*.c", "test_*.cpp") for test in folder.glob(pattern))
    return own if own in room else None, room


def judge(path, tree, build, jobs, near, log):
    """What a mutated tree comes to: 'refused' by the compiler, the step that caught it, or 'survived'."""
    own, room = test_of(path, tree)
    steps = [[own]] if own else []
    if room and room != [own]:
        steps.append(room)
    for names in steps:
        targets = [name.replace("/", "_") for name in names]
        if run(["cmake", "--build", build, "-j", str(jobs), "--target", *targets], tree, SUITE_LIMIT, log) != 0:
            return "refused"
        pattern = "^(" + "|".join(map(re.escape, names)) + ")$"
        if run(["ctest", "-R", pattern, "-j", str(jobs), "--timeout", str(TEST_LIMIT), "--stop-on-failure"], build,
               SUITE_LIMIT, log) != 0:
            return "own test" if names == [own] else "test of its room"
    if run(["cmake", "--build", build, "-j", str(jobs)], tree, SUITE_LIMIT, log) != 0:
        return "refused"
    if near:
        return "survived"
    if run(["ctest", "-L", "^quick$", "-j", str(jobs), "--stop-on-failure"], build, SUITE_LIMIT, log) != 0:
        return "another test"
    return "survived"


def explained():
    """(file, line of code) of the survivors with a reason."""
    listed = SOURCE / "tests/mutation_survivors.txt"
    rows = listed.read_text().splitlines() if listed.exists() else []
    return {tuple(part.strip() for part in row.split(": ")[:2]) for row in rows if row and not row.startswith("#")}


def report(rows):
    counted = [row for row in rows if row["end"] != "refused"]
    caught = [row for row in counted if row["end"] != "survived"]
    print(f"{'room':24}{'tried':>7}{'caught':>8}   by its own test, its room's, others")
    for room in sorted({row["room"] for row in counted}):
        here = [row for row in counted if row["room"] == room]
        ends = [sum(row["end"] == end for row in here) for end in ("own test", "test of its room", "another test")]
        print(f"{room:24}{len(here):7}{sum(ends):8}   {ends[0]}, {ends[1]}, {ends[2]}")
    known = explained()
    for row in counted:
        if row["end"] == "survived":
            told = "" if (row["file"], row["line_text"]) not in known else " (explained)"
            print(f"survived: {row['file']}:{row['line']}: {row['kind']}: {row['old']} to {row['new']}{told}: "
                  f"{row['line_text']}")
    share = 100 * len(caught) / len(counted) if counted else 0
    print(f"{len(caught)} of {len(counted)} caught, {share:.0f} %; {len(rows) - len(counted)} that no compiler takes")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", nargs="?", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="*", type=int)
    parser.add_argument("--room")
    parser.add_argument("--work", type=Path, default=Path("/tmp/cutwater-mutation"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--near", action="store_true")
    options = parser.parse_args()
    files = {path: len(path.read_text().splitlines()) for stage in STAGES
             for path in sorted((SOURCE / stage).rglob("*")) if path.suffix in (".c", ".cpp")}
    tree, build, kept = options.work / "tree", options.work / "build", options.work / "mutations.jsonl"
    options.work.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(tree, ignore_errors=True)
    shutil.copytree(SOURCE, tree, ignore=shutil.ignore_patterns(".git", "build", "build-*", "runs", "__pycache__"))
    log = options.work / "log"
    if run(["cmake", "-S", tree, "-B", build], tree, SUITE_LIMIT, log) or run(
            ["cmake", "--build", build, "-j", str(options.jobs)], tree, 3 * SUITE_LIMIT, log):
        sys.exit(f"mutation: the tree without a mutation does not build: see {log}")
    rows = [json.loads(row) for row in kept.read_text().splitlines()] if kept.exists() else []
    done = {(row["seed"], row["room_asked"], row["number"]) for row in rows}
    wanted = options.only or range(1, options.count + 1)
    began, tried = time.monotonic(), 0
    for number in wanted:
        if (options.seed, options.room, number) in done:
            continue
        path, kind, begin, end, new = draw(options.seed, number, files, options.room)
        text, name = path.read_text(), path.relative_to(SOURCE)
        copy = tree / name
        copy.write_text(text[:begin] + new + text[end:])
        came_to = judge(path, tree, build, options.jobs, options.near, log)
        shutil.copyfile(path, copy)
        line = text.count("\n", 0, begin)
        row = {"seed": options.seed, "room_asked": options.room, "number": number, "room": room_of(path),
               "file": str(name), "line": line + 1, "kind": kind, "old": text[begin:end], "new": new,
               "line_text": text.splitlines()[line].strip(), "end": came_to}
        rows.append(row)
        with open(kept, "a", encoding="utf-8") as out:
            out.write(json.dumps(row) + "\n")
        tried += 1
        left = (time.monotonic() - began) / tried * (len(wanted) - number)
        print(f"{number} of {len(wanted)}: {name}:{line + 1}: {kind}: {text[begin:end]} to {new}: {came_to}; "
              f"{left / 60:.0f} minutes left", file=sys.stderr, flush=True)
    report([row for row in rows if row["seed"] == options.seed and row["room_asked"] == options.room])


if __name__ == "__main__":
    main()
