# SPDX-License-Identifier: AGPL-3.0-or-later
"""Limits of the sources: LINES of a file, WIDTH of a line, FUNCTION lines of a function, FIELDS of a struct or class. A
struct may have more where the comment right above it says why, with the word "fields"."""
import os
import pathlib
import re
import sys

LINES, WIDTH, FUNCTION, FIELDS = 500, 120, 70, 15
FOLDERS = ["pipeline", "geometry", "mesher", "export", "tests"]
source = pathlib.Path(os.environ["CUTWATER_SOURCE"])


def code_of(text):
    """The text with comments, literals and preprocessor lines blanked out, all else in its place."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match[0])
    text = re.sub(r'R"(\w*)\(.*?\)\1"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'',
                  blank, text, flags=re.S)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)


def kind_of(head):
    """What a block is by the text before its brace."""
    head = re.sub(r"\b(public|private|protected):", "", head).strip()
    if re.match(r"(inline )?namespace\b|extern\s*$", head):
        return "open"
    if re.match(r"(template\s*<[^{}]*>\s*)?(typedef |static |const )*(struct|class|union)\b[^()=]*$", head):
        return "struct"
    no_function = re.match(r"[^=]*\benum\b|[^(]*=", head.replace("operator=", ""))
    return "other" if no_function or "(" not in head or head.endswith("=") else "function"


def fields_in(body):
    """How many fields the declarations of a struct name; blocks in it count by the name behind them."""
    count = 0
    while body != (body := re.sub(r"\{[^{}]*\}", "", body)):
        pass  # initialisers
    for part in body.split(";"):
        part = re.sub(r"\b(public|private|protected):", "", part).strip()
        part = re.sub(r"\[[^\]]*\]|<[^<>]*>", "", re.sub(r"<[^<>]*>", "", part))
        if not part or re.match(r"(using|friend|static|enum|typedef|struct \w+$|class \w+$)\b", part):
            continue
        pointers = re.sub(r"\(\*", "", part)  # (*name)[3], (*name)(arguments)
        if "(" in pointers and part == pointers:
            continue  # a member function
        part = re.sub(r"\([^()]*\)", "", re.sub(r"\(\*(\w+)\)", r"\1", part))
        count += 1 + part.count(",")
    return count


def blocks(text):
    """(kind, first line, last line, head, body) of the structs and functions of a source; in a body the blocks that are
    no initialisers are left out."""
    code, stack, begin = code_of(text), [], 0
    for match in re.finditer(r"[{};]|\b(?:public|private|protected):", code):
        place = match.start()
        if match[0] == "{":
            head = code[begin:place]
            inner = any(kind in ("function", "other") for kind, *_ in stack)
            kind = "other" if inner else kind_of(head)
            stack.append((kind, begin + len(head) - len(head.lstrip()), place, head, []))
            if kind == "other" and not inner:
                continue
            begin = place + 1
        elif match[0] == "}":
            if not stack:
                return
            kind, start, brace, head, holes = stack.pop()
            if stack and kind != "other":
                stack[-1][4].append((start if kind == "function" else brace, place + 1, kind))
            if kind in ("struct", "function"):
                body = code[brace + 1:place]
                for first, last, of in reversed(holes):
                    body = body[:first - brace - 1] + (";" if of == "function" else "") + body[last - brace - 1:]
                yield kind, 1 + code.count("\n", 0, start), 1 + code.count("\n", 0, place), " ".join(head.split()), body
            if kind != "other":
                begin = place + 1
        elif not any(kind in ("function", "other") for kind, *_ in stack):
            begin = match.end()


def comment_above(lines, number):
    """The comment right above a line."""
    found = []
    while number >= 2 and lines[number - 2].lstrip().startswith("//"):
        number -= 1
        found.append(lines[number - 1])
    return " ".join(found)


def faults_of(name, text):
    lines = text.splitlines()
    if len(lines) > LINES:
        yield f"{name}: {len(lines)} lines; allowed: {LINES}"
    for number, line in enumerate(lines, 1):
        if len(line) > WIDTH:
            yield f"{name}:{number}: {len(line)} characters; allowed: {WIDTH}"
    if not name.endswith((".c", ".h", ".cpp", ".hpp")):
        return
    for kind, first, last, head, body in blocks(text):
        if kind == "function" and last - first + 1 > FUNCTION:
            yield f"{name}:{first}: {last - first + 1} lines in {head.split('(')[0]}; allowed: {FUNCTION}"
        fields = fields_in(body) if kind == "struct" else 0
        if fields > FIELDS and not re.search(r"\bfields\b", comment_above(lines, first)):
            yield (f"{name}:{first}: {fields} fields; allowed: {FIELDS}, or a comment right above that says why, with "
                   "the word 'fields'")


# The judge itself.
LONG = "".join(f"  int x{i} = {i};\n" for i in range(FUNCTION))
METHOD = f"class A {{\npublic:\n  int f() const {{\n{LONG}  }}\n}};\n"
assert [fault.split(":")[1] for fault in faults_of("a.c", f"int y;\nint f(int (*g)(int)) {{\n{LONG}}}\n")] == ["2"]
assert [fault.split(":")[1] for fault in faults_of("a.cpp", METHOD)] == ["3"]
assert not list(faults_of("a.c", f"static const int a[] = {{\n{LONG.replace('int x', 'X').replace(';', ',')}}};\n"))
MANY = """typedef struct {
  int a, b, (*c)[3], d[2][3];
  double (*f)(int x, int y), g[2] = {1, 2};
  struct {
    int p, q;
  } h;
} A;
"""
assert [fields_in(body) for kind, _, _, head, body in blocks(MANY) if head == "typedef struct"] == [7]
WIDE = "// All fields.\ntypedef struct {\n" + "".join(f"  int a{i}, b{i};\n" for i in range(8)) + "} A;\n"
assert not list(faults_of("a.h", WIDE)) and len(list(faults_of("a.h", WIDE.replace("All fields", "All")))) == 1
assert len(list(faults_of("a.py", "x\n" * (LINES + 1) + "y" * (WIDTH + 1)))) == 2

faults, seen = [], 0
for folder in FOLDERS:
    for path in sorted((source / folder).rglob("*")):
        if path.suffix in (".c", ".h", ".cpp", ".hpp", ".py", ".mk", ".cmake", ".sh") or path.name in (
                "CMakeLists.txt", "Makefile"):
            seen += 1
            faults += faults_of(str(path.relative_to(source)), path.read_text())
print("\n".join(faults) or f"{seen} files within the limits")
sys.exit(1 if faults or not seen else 0)
