#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""mutation.py [N] [--seed S] [--only K ...] [--room ROOM] [--work DIR] [--jobs J] [--seconds T] [--again] [--report]

Mutation testing: do the quick tests notice small faults? N mutations (200 unless given), spread over all rooms by their
lines, are drawn from the C and C++ sources of the programs. Mutation K follows from seed and K alone, so that those
from 1 to any K are a fair sample of all. Each changes one token:

  comparison  < <= > >= == !=     to the neighbouring one
  sign        a + b, a - b, a * b, a / b    to its opposite
  logic       && to ||, || to &&
  number      0 to 1, any other to its double
  condition   if (c) to if (!(c))
  call        a statement that only calls a function is left out, unless it frees memory or tells of progress

A copy of the tree in DIR/tree is built once, its rooms as shared libraries. For a mutation its file alone is compiled,
and its library linked into DIR/K; the tests load that one (LD_LIBRARY_PATH) and write into DIR/K, so that J mutations
are tried at a time and none sees another. In turn: the tests of the module, those of its room, all other quick tests
that use its library, cheapest first, those of whole runs among them; up to the first that fails. With --seconds no more
of its room's and the others than fit into T seconds of the processor: the others are left to a run with --again.

A mutation is caught where a test fails or takes 10 times as long as without it (a test that fails without it is left
out); one that the compiler refuses, or makes the same code of (Papadakis et al. 2015), does not count, nor does one of
a template for other compilers. What each came to is a line of DIR/mutations.jsonl, and not tried again but with
--again, which tries what survived before the tests and sources as they are now, and draws anew those whose line is
gone. At the end, or with --report alone: caught of tried by room, and the survivors. Those that docs/testing.md gives a
reason for are marked. Tests in C start a program where it was built: a mutant of a program's own main.c is seen by
tests of whole runs alone."""
import argparse
import json
import os
import random
import re
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
STAGES = ["pipeline", "geometry", "mesher", "export"]
ENDS = ("its own test", "its room's", "another")
OF_TEXT = ("rooms", "run/make_rules", "install/", "bench/")  # tests that run none of the programs, or others than built
OPPOSITE = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
            "&&": "||", "||": "&&"}
# Binary operators stand between blanks, as clang-format leaves them; a pointer's star and a sign do not.
TOKENS = [("comparison", r"(?<= )(<=|>=|==|!=|<|>)(?= )"), ("sign", r"(?<= )([-+*/])(?= )"),
          ("logic", r"(?<= )(&&|\|\|)(?= )"),
          ("number", r"(?<![\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?)(?![\w.])"),
          ("condition", r"(?<=\bif )(\([^;{}]*\))(?= [^)])"),
          ("call", r"^ +((?!free|return|cw_log|cw_progress|\w+_free)[a-z]\w*\([^;{}=]*\);)$")]


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


def room_of(name):
    parts = Path(name).parts
    return "/".join(parts[:2]) if len(parts) > 2 else parts[0]


def draw(seed, number, files, only_room):
    """Mutation `number` as a row: a file by its lines, a kind, a place of that kind. files: text by name."""
    dice = random.Random(f"{seed}/{number}")
    chosen = [name for name in files if not only_room or room_of(name) == only_room]
    while True:
        name = dice.choices(chosen, [files[name].count("\n") for name in chosen])[0]
        text = files[name]
        found = list(places(text))
        if not found:
            continue
        kind = dice.choice(sorted({place[0] for place in found}))
        _, begin, end, new = dice.choice([place for place in found if place[0] == kind])
        start = text.rfind("\n", 0, begin) + 1
        return {"seed": seed, "room_asked": only_room, "number": number, "room": room_of(name), "file": name,
                "line": text.count("\n", 0, begin) + 1, "column": begin - start, "kind": kind, "old": text[begin:end],
                "new": new, "line_text": text[start:].split("\n", 1)[0].strip()}


def mutated(row, text):
    """The text with the mutation of a row, found by its line's text nearest to where it was; None where it is gone."""
    lines = text.split("\n")
    found = [place for place, line in enumerate(lines) if line.strip() == row["line_text"]]
    if not found:
        return None
    place = min(found, key=lambda place: abs(place + 1 - row["line"]))
    begin = sum(len(line) + 1 for line in lines[:place]) + row["column"]
    if text[begin:begin + len(row["old"])] != row["old"]:
        return None
    row["line"] = place + 1
    return text[:begin] + row["new"] + text[begin + len(row["old"]):]


def processes_of(session):
    """The processes of a session that were started here."""
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if int((entry / "stat").read_text().rpartition(")")[2].split()[3]) == session:
                yield int(entry.name)
        except OSError:
            continue


def run(command, folder, log, seconds, environment=None):
    """(exit status or 'late', seconds of processor) of a command; all its processes end with it."""
    limits = ["prlimit", f"--cpu={seconds + 1:.0f}:{seconds + 6:.0f}", f"--as={8 << 30}", f"--fsize={4 << 30}",
              "--core=0", "--"]
    with open(log, "wb") as out:
        child = subprocess.Popen(limits + command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=out,
                                 start_new_session=True, env=environment)
        ends = time.monotonic() + 30 * seconds  # by the clock: the machine may be busy
        done = status = used = 0
        while not done and time.monotonic() < ends:
            done, status, used = os.wait4(child.pid, os.WNOHANG)
            time.sleep(0 if done else 0.02)
        for process in processes_of(child.pid):
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        if not done:
            child.wait()
            return "late", 30 * seconds
        child.returncode = os.waitstatus_to_exitcode(status)
        late = child.returncode in (-signal.SIGXCPU, 128 + signal.SIGXCPU)
        return "late" if late else child.returncode, used.ru_utime + used.ru_stime


class Bench:
    """The copy of the tree, its build, its tests and what they take without a mutation."""

    def __init__(self, work, jobs):
        self.work, self.tree, self.build = work, work / "tree", work / "tree/build"
        kept = subprocess.run(["git", "ls-files", "-z"], cwd=SOURCE, capture_output=True, check=True).stdout.decode()
        built = self.build / "built"
        for name in filter(None, kept.split("\0")):
            here, there = SOURCE / name, self.tree / name
            if here.exists() and not (there.exists() and there.read_bytes() == here.read_bytes()):
                built.unlink(missing_ok=True)
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(here, there)
        quick = "-fuse-ld=lld " if shutil.which("ld.lld") else ""
        linker = f"-DCMAKE_{{}}_LINKER_FLAGS={quick}-Wl,--enable-new-dtags"
        for step in (["cmake", "-S", self.tree, "-B", self.build, "-DBUILD_SHARED_LIBS=ON",
                      "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", linker.format("EXE"), linker.format("SHARED")],
                     ["cmake", "--build", self.build, "-j", str(jobs)]):
            if not built.exists() and run(step, work, work / "log", 7200)[0]:
                sys.exit(f"mutation: the tree without a mutation does not build: see {work / 'log'}")
        built.touch()
        self.compiled = {str(Path(entry["file"]).relative_to(self.tree)): entry for entry in json.loads(
            (self.build / "compile_commands.json").read_text()) if self.build not in Path(entry["file"]).parents}
        told = subprocess.run(["ctest", "--show-only=json-v1", "-L", "^quick$"], cwd=self.build, capture_output=True)
        self.tests = {test["name"]: test for test in json.loads(told.stdout)["tests"]
                      if not test["name"].startswith(OF_TEXT)}
        listed = subprocess.run([sys.executable, "-B", self.tree / "tests/test_modules.py", "--list"], check=True,
                                capture_output=True, env={**os.environ, "CUTWATER_SOURCE": str(self.tree)}).stdout
        self.named = {line.split()[0]: line.split()[1:] for line in listed.decode().splitlines() if ".c" in line}
        self.loads = {test: subprocess.run(["ldd", entry["command"][0]], capture_output=True, text=True).stdout
                      for test, entry in self.tests.items() if test.split("/")[0] in STAGES}
        self.costs_file = work / "costs.jsonl"
        rows = self.costs_file.read_text().splitlines() if self.costs_file.exists() else []
        self.costs = dict(json.loads(row) for row in rows)
        self.lock, self.busy = threading.Lock(), {}

    def name_of(self, test):
        """A test's name before ctest of its file, a path from the top of the tree."""
        parts = Path(test).parts
        if parts[1] == "pipeline_run":
            return next((name for name, entry in self.tests.items() if entry["command"][-1].endswith(test)), None)
        return f"{parts[1]}/{Path(test).stem}"

    def target_of(self, name):
        """The folder of the object files of a file's target, whose name it has: NAME.dir."""
        entry = self.compiled[name]
        words = shlex.split(entry["command"])
        return Path(entry["directory"], *Path(words[words.index("-o") + 1]).parts[:2])

    def steps(self, name):
        """The tests that judge a mutation of a file, in turn."""
        folder = self.tree / "tests" / Path(name).parent
        while not folder.exists():
            folder = folder.parent
        own = [self.name_of(test) for test in self.named.get(name, [])]
        room = [f"{Path(name).parts[0]}/{path.stem}" for path in folder.glob("test_*.c*")]
        library = f"lib{self.target_of(name).stem}.so"
        rest = [test for test in self.tests if library in self.loads.get(test, library)]
        done, steps = set(), []
        for tests in (own, room, rest):
            fresh = {test for test in tests if test in self.tests} - done
            done |= fresh
            steps.append(sorted(fresh, key=lambda test: (self.cost(test), test)))
        return steps

    def cost(self, test):
        """Seconds of processor of a test; twice those in which it did not end."""
        known = self.costs.get(test, 1 if test.split("/")[0] in STAGES else 60)
        return known if known >= 0 else -2 * known

    def properties(self, test):
        return {entry["name"]: entry["value"] for entry in self.tests[test].get("properties", [])}

    def execute(self, test, folder, seconds):
        """Runs a test in a folder, with the libraries in its lib/ and the programs in its bin/ where it has them."""
        environment = dict(os.environ, LD_LIBRARY_PATH=str(folder / "lib"))
        environment.update(entry.split("=", 1) for entry in self.properties(test).get("ENVIRONMENT", []))
        environment["CUTWATER_WORK"] = str(folder / "runs")
        if (folder / "bin").exists():
            environment["CUTWATER_BIN"] = str(folder / "bin")
        return run(self.tests[test]["command"], folder, folder / "log", seconds, environment)

    def plain(self, test, most):
        """Seconds of processor that a test takes without a mutation; 0 where it fails or takes more than `most`."""
        with self.lock:
            turn = self.busy.setdefault(test, threading.Lock())
        with turn:
            if test not in self.costs or 0 > self.costs[test] > -most:
                if "FIXTURES_REQUIRED" in self.properties(test):
                    self.plain("run/quick", most)
                folder = self.work / "plain"
                if test.split("/")[0] in STAGES:
                    folder = folder / test.replace("/", "_")
                folder.mkdir(parents=True, exist_ok=True)
                status, used = self.execute(test, folder, most)
                with self.lock:
                    self.costs[test] = -most if status == "late" else 0 if status else max(used, 0.01)
                    with open(self.costs_file, "a", encoding="utf-8") as out:
                        out.write(json.dumps([test, self.costs[test]]) + "\n")
            return max(self.costs[test], 0)

    def compile(self, name, text, made):
        """Compiles a text in place of a file; whether it compiles."""
        entry, source = self.compiled[name], self.tree / name
        copy = made.parent / source.name
        copy.write_text(text)
        words = shlex.split(entry["command"])
        words[words.index("-o") + 1] = str(made)
        words[words.index(str(source))] = str(copy)
        words += ["-iquote", str(source.parent), "-w", "-g0"]
        return run(words, entry["directory"], made.parent / "log", 600)[0] == 0

    def link(self, name, folder):
        """Links the mutant of a file into a folder's lib/, or bin/ where it is a program's own."""
        entry, target = self.compiled[name], self.target_of(name)
        words, compiled = shlex.split((target / "link.txt").read_text()), shlex.split(entry["command"])
        words[words.index(compiled[compiled.index("-o") + 1])] = str(folder / "mutant.o")
        made = Path(words[words.index("-o") + 1])
        place = folder / ("lib" if made.suffix == ".so" else "bin")
        place.mkdir()
        if place.name == "bin":
            for program in (self.build / "bin").iterdir():
                if program.name != made.name:
                    (place / program.name).symlink_to(program)
        words[words.index("-o") + 1] = str(place / made.name)
        return run(words, entry["directory"], folder / "log", 600)[0] == 0

    def judge(self, row, seconds):
        """Puts what a mutation comes to into its row: 'refused', 'same code', 'survived' or the step that caught it."""
        folder, name = self.work / str(row["number"]), row["file"]
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        text = (self.tree / name).read_text()
        row.update(end="survived", test=None, left_out=[])
        try:
            if name not in self.compiled:  # a template, for other people's compilers
                row["end"] = "refused"
                return
            if not self.compile(name, mutated(row, text), folder / "mutant.o") or not self.link(name, folder):
                row["end"] = "refused"
                return
            done = set()
            for step, tests in zip(ENDS, self.steps(name)):
                if step == ENDS[-1] and self.compile(name, text, folder / "plain.o") and (
                        folder / "plain.o").read_bytes() == (folder / "mutant.o").read_bytes():
                    row["end"] = "same code"
                    return
                for test in tests:
                    if step != ENDS[0] and seconds < self.cost(test):
                        row["left_out"].append(test)
                        continue
                    before = ["run/quick"] if "FIXTURES_REQUIRED" in self.properties(test) else []
                    for turn in before + [test]:
                        most = max(seconds, 60) if step == ENDS[0] else seconds
                        usual = 0 if turn in done else self.plain(turn, most)
                        if not usual:
                            continue
                        done.add(turn)
                        seconds -= usual
                        status = self.execute(turn, folder, 10 * usual + 10)[0]
                        if status:
                            row.update(end=step, test=turn, how="late" if status == "late" else "failed")
                            return
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def report(rows):
    listed = SOURCE / "docs/testing.md"
    known = listed.read_text().splitlines() if listed.exists() else []
    counted = [row for row in rows if row["end"] not in ("refused", "same code")]
    print(f"{'room':24}{'tried':>7}{'caught':>8}   by {', '.join(ENDS)}")
    for room in sorted({row["room"] for row in counted}):
        here = [row for row in counted if row["room"] == room]
        found = [sum(row["end"] == end for row in here) for end in ENDS]
        print(f"{room:24}{len(here):7}{sum(found):8}   {', '.join(map(str, found))}")
    for row in counted:
        if row["end"] == "survived":
            told = any(Path(row["file"]).name in line and row["line_text"] in line.replace("\\|", "|")
                       for line in known)
            print(f"survived: {row['number']}: {row['file']}:{row['line']}: {row['kind']}: {row['old']} to {row['new']}"
                  f"{' (explained)' if told else ''}: {row['line_text']}")
    caught = [row for row in counted if row["end"] != "survived"]
    late = sum(row.get("how") == "late" for row in caught)
    share = 100 * len(caught) / len(counted) if counted else 0
    print(f"{len(caught)} of {len(counted)} caught, {share:.0f} % ({late} by the time that a test takes); "
          f"{len(rows) - len(counted)} more that the compiler refuses or makes the same code of")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", nargs="?", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="*", type=int)
    parser.add_argument("--room")
    parser.add_argument("--work", type=Path, default=Path("/tmp/cutwater-mutation"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--report", action="store_true")
    options = parser.parse_args()
    kept = options.work / "mutations.jsonl"
    rows = [json.loads(row) for row in kept.read_text().splitlines()] if kept.exists() else []
    rows = {(row["seed"], row["room_asked"], row["number"]): row for row in rows}  # the last line of each holds
    if not options.report:
        options.work.mkdir(parents=True, exist_ok=True)
        bench = Bench(options.work, options.jobs)
        files = {str(path.relative_to(bench.tree)): path.read_text() for stage in STAGES
                 for path in sorted((bench.tree / stage).rglob("*")) if path.suffix in (".c", ".cpp")}

        def attempt(number):
            row = rows.get((options.seed, options.room, number))
            gone = not row or mutated(row, files.get(row["file"], "")) is None
            if row and not (options.again and (gone or row["end"] == "survived")):
                return
            if gone:
                row = draw(options.seed, number, files, options.room)
            bench.judge(row, options.seconds)
            with bench.lock:
                rows[(options.seed, options.room, number)] = row
                with open(kept, "a", encoding="utf-8") as out:
                    out.write(json.dumps(row) + "\n")
                print(f"{number}: {row['file']}:{row['line']}: {row['kind']}: {row['old']} to {row['new']}: "
                      f"{row['end']} {row['test'] or ''}", file=sys.stderr, flush=True)

        with ThreadPoolExecutor(options.jobs) as pool:
            list(pool.map(attempt, options.only or range(1, options.count + 1)))
    report([row for row in rows.values() if row["seed"] == options.seed and row["room_asked"] == options.room])


if __name__ == "__main__":
    main()
