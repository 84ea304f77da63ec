# SPDX-License-Identifier: AGPL-3.0-or-later
"""A page of docs/ that a bench writes, in sections, each by a command. It keeps the sections that a call does not make.
The digest of the sources that a section follows from, of its bench and of the stages that it runs, stands beside it:
where they have changed since, a line says so. A change of docs, of comments in C or of other benches does not count.
"""
import hashlib
import re
import subprocess
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
PROGRAMS = ["pipeline", "geometry", "mesher", "export", "cases", "CMakeLists.txt"]
MORE = {"table1": ["tests/measure/chew*"], "verify": ["tests/bench/verify.mk", "tests/cad"],
        "cad.py": ["tests/measure/cad_solids.cpp"], "fill": ["tests/bench/fill.c"],
        "patch_mesh": ["tests/bench/patch_mesh.c"]}  # by a word of the command
ROOMS = {"export": "export", "report": "pipeline/report"}  # of stages that a bench without the word does not run


def run_text(*line):
    return subprocess.run(line, cwd=SOURCE, capture_output=True, text=True, check=True).stdout.strip()


def with_imports(path, found=()):
    """A bench and the benches that it imports, and so on, as paths from SOURCE."""
    found = [*found, path]
    for name in re.findall(r"^(?:from|import) (\w+)", (SOURCE / path).read_text(), re.M):
        imported = f"tests/bench/{name}.py"
        if imported not in found and (SOURCE / imported).exists():
            found = with_imports(imported, found)
    return found


def sources_digest(command):
    """Of all tracked files that a section follows from, those in C and C++ without their comments."""
    script = command.split()[0]
    is_bench = script.startswith("tests/bench/")
    bench = with_imports(script) if is_bench else ["tests/mesher"]
    said = (SOURCE / script).read_text() if is_bench else ""
    bench += [f":(exclude){room}" for word, room in ROOMS.items() if word not in said]
    for word, files in MORE.items():
        bench += files if word in command else []
    digest = hashlib.sha256()
    for name in run_text("git", "ls-files", *PROGRAMS, *bench).splitlines():
        text = (SOURCE / name).read_bytes()
        if name.endswith((".c", ".h", ".cpp")):
            text = re.sub(rb"(?m)(^|[ \t])//.*", b"", text)
        if not name.endswith((".md", "/page.py")):
            digest.update(name.encode() + b"\0" + text)
    return digest.hexdigest()


def stamp(command):
    """How and when a section was made."""
    changed = run_text("git", "status", "--porcelain", "--untracked-files=no", *PROGRAMS)
    commit = run_text("git", "rev-parse", "--short=9", "HEAD") + (" with changes" if changed else "")
    return f"`{command}`, commit {commit}, {time.strftime('%Y-%m-%d')}"


OLDER = "*Not made on these sources, but on those of the commit below.*\n\n"


class Page:
    """Its file, its text before the sections, the command of each section by name, and the call that makes some."""

    def __init__(self, path, head, commands, again):
        self.path, self.head, self.commands, self.again = path, head, commands, again

    def section(self, name, title, *paragraphs):
        """The text of a section that is made on the present sources."""
        mark = f"<!-- section {name} {sources_digest(self.commands[name])} -->"
        return "\n\n".join([f"{mark}\n## {title}", *filter(None, paragraphs)]) + "\n"

    def kept(self):
        """The sections of the page by name, each with the line OLDER where its sources have changed since."""
        text = self.path.read_text() if self.path.exists() else ""
        found = re.findall(r"(<!-- section (\w+) (\w+) -->\n.*?\n)\n*(?=<!-- section |<!-- missing -->|\Z)", text, re.S)
        sections = {}
        for section, name, digest in found:
            if name in self.commands:
                older = OLDER if digest != sources_digest(self.commands[name]) else ""
                heading, rest = section.replace(OLDER, "").split("\n\n", 1)
                sections[name] = f"{heading}\n\n{older}{rest}"
        return sections

    def write(self, made):
        """The page with these sections, by name, and those that it keeps."""
        sections = {**self.kept(), **made}
        missing = [name for name in self.commands if name not in sections]
        lines = [self.head, *(sections[name] for name in self.commands if name in sections)]
        if missing:
            lines.append(f"<!-- missing -->\nNot made: {', '.join(missing)} (`{self.again}`).\n")
        part = self.path.with_suffix(".part")
        part.write_text("\n".join(lines))
        part.replace(self.path)
        older = sum(OLDER in section for section in sections.values())
        print(f"{self.path}: {len(sections)} of {len(self.commands)} sections, {older} of older sources", flush=True)
