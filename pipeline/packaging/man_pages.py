#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""man_pages.py BIN FOLDER: writes the manual pages of the programs in BIN, and of the front door, from their --help
into FOLDER. That text is a usage line, sentences, an empty line, and entries: two blanks, an option or a word, blanks,
what it means."""
import re
import subprocess
import sys
from pathlib import Path

PROGRAMS = ["cutwater", "cutwater-geometry", "cutwater-mesh", "cutwater-export", "cutwater-report"]
FRONT = Path(__file__).with_name("cutwater.in")


def escaped(text):
    return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", r"\e").replace("-", r"\-"))


def page(program, text):
    """The page of a program with this help."""
    head, _, entries = text.partition("\n\n")
    usage, *sentences = head.splitlines()
    told = " ".join(sentences)
    lines = [".\\\" SPDX-License-Identifier: AGPL-3.0-or-later", f'.TH {program.upper()} 1 "" Cutwater', ".SH NAME",
             escaped(f"{program} - {re.split('[:;.](?: |$)', told)[0]}"), ".SH SYNOPSIS",
             escaped(usage.removeprefix("usage: ")), ".SH DESCRIPTION", escaped(told), ".SH OPTIONS"]
    for line in entries.splitlines():
        given, meaning = re.fullmatch(r"  (--[a-z-]+(?: [A-Z]+)?|\S.*?(?=  )) +(\S.*)", line).groups()
        lines += [".TP", r"\fB" + escaped(given) + r"\fR", escaped(meaning)]
    others = [name for name in PROGRAMS if name != program]
    lines += [".SH SEE ALSO", ", ".join(rf"\fB{escaped(name)}\fR(1)" for name in others)]
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.splitlines()[0])
    for program in PROGRAMS:
        line = ["sh", FRONT] if program == "cutwater" else [Path(sys.argv[1]) / program]
        text = subprocess.run([*line, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        (Path(sys.argv[2]) / f"{program}.1").write_text(page(program, text), encoding="utf-8")


main()
