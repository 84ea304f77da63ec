# SPDX-License-Identifier: AGPL-3.0-or-later
"""An OpenFOAM case on its way to a settled flow: its folder, its start, and the solver's run."""
import ctypes
import functools
import hashlib
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import reports
import settling

sys.path.append(str(Path(__file__).resolve().parents[1]))
from whole_file import write_whole  # noqa: E402  (what the scripts of pipeline/ share)

LOOK_EVERY = 2.0  # s between looks at the solver's reports
TELL_EVERY = 10.0  # s between lines of progress
WRITTEN, REPORTED = 100, 10  # iterations between fields and between reports, as the case is exported
END = b"***** //\n"  # of each file that OpenFOAM has written whole
LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1  # linux/prctl.h
PROGRAMS = ("simpleFoam", "decomposePar", "reconstructPar", "mapFields", "foamDictionary", "renumberMesh", "mpirun")
ENVIRONMENT = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1",
               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


class Trouble(Exception):
    """Ends the stage with one line."""


def say(text):
    print(f"cutwater-solve: {text}", file=sys.stderr, flush=True)


def require_programs():
    missing = [name for name in PROGRAMS if not shutil.which(name)]
    if missing:
        raise Trouble(f"{missing[0]} is not there; install OpenFOAM (Debian: apt-get install openfoam)")


def end_with(parent):
    """Called in a child of the process `parent`: SIGTERM ends it when the parent ends, however that ends, for the lock
    of the run ends too. An mpirun then ends its ranks."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if LIBC.prctl(PR_SET_PDEATHSIG, ctypes.c_ulong(signal.SIGTERM)) or os.getppid() != parent:
        os._exit(1)


def child_options(folder, out):
    """How programs are started, in a folder, with their words into a file."""
    return {"cwd": folder, "env": ENVIRONMENT, "stdin": subprocess.DEVNULL, "stdout": out, "stderr": subprocess.STDOUT,
            "preexec_fn": functools.partial(end_with, os.getpid())}


def call(folder, log, *line):
    """Runs a program to its end, its words into folder/log."""
    words = [str(word) for word in line]
    with open(folder / log, "w", encoding="utf-8") as out:
        status = subprocess.run(words, check=False, **child_options(folder, out)).returncode
    if status:
        raise Trouble(f"{words[0]} ended with {status}: see {folder / log}")


def mpirun(ranks, *line):
    return ["mpirun", "-q", "--bind-to", "none", "-n", str(ranks), *line]


def set_entry(folder, file, entry, value):
    call(folder, "log.foamDictionary", "foamDictionary", "-entry", entry, "-set", value, file)


def link(path, target):
    """Makes `path` a link to `target` that holds where the run is moved, too."""
    path.unlink(missing_ok=True)
    path.symlink_to(os.path.relpath(target.resolve(), path.parent.resolve()))


def digest_of(source, mesh):
    """What a case is made from: its texts, and the digest of its mesh."""
    found = hashlib.sha256(json.dumps(mesh, sort_keys=True).encode())
    for path in sorted(path for name in ("0", "constant", "system") for path in (source / name).rglob("*")):
        if path.is_file() and "polyMesh" not in path.parts:
            found.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return found.hexdigest()


def times(folder):
    """The times after 0 of which a case folder, or a part of one, has fields, the latest first."""
    return sorted((int(path.parent.name) for path in folder.glob("[1-9]*/U")), reverse=True)


def is_whole(path):
    with open(path, "rb") as file:
        file.seek(max(path.stat().st_size - len(END), 0))
        return file.read() == END


def whole_fields(folder):
    """The names of the files of a time, or None where one ends early."""
    files = [path for path in folder.rglob("*") if path.is_file()]
    return {str(path.relative_to(folder)) for path in files} if all(map(is_whole, files)) else None


def drop_unfinished(case):
    """Removes the latest times that a killed program has not finished: where a part has files that end early, lacks
    some of the others', or all lack some of the first fields. Of epsilon and omega a turbulence model has one."""
    first = {path.name for path in case.glob("0/*") if path.is_file()}
    for parts in ([case], sorted(case.glob("processor*"))):
        written = {int(path.name) for part in parts for path in part.glob("[1-9]*") if path.name.isdigit()}
        for iteration in sorted(written, reverse=True):
            found = [whole_fields(part / str(iteration)) for part in parts]
            if found[0] and found.count(found[0]) == len(parts) and first - found[0] < {"epsilon", "omega"}:
                break
            say(f"{case}: the fields of iteration {iteration} were not finished; goes on from those before")
            for part in parts:
                shutil.rmtree(part / str(iteration), ignore_errors=True)


def rejoin(case):
    """Puts the latest fields of all parts together in the case folder."""
    latest = max(times(case / "processor0"), default=0)
    if latest > max(times(case), default=0):
        call(case, "log.reconstructPar", "reconstructPar", "-time", latest)


def divide(case, ranks):
    """The mesh and its latest fields, for the ranks."""
    dictionary = "system/decomposeParDict"
    set_entry(case, dictionary, "numberOfSubdomains", ranks)
    if "hierarchical" in (case / dictionary).read_text():  # scotch follows the number alone
        set_entry(case, dictionary, "coeffs/n", f"({ranks} 1 1)")
    call(case, "log.decomposePar", "decomposePar", "-force", "-latestTime", "-copyUniform")
    call(case, "log.renumberMesh", *mpirun(ranks, "renumberMesh", "-parallel", "-overwrite"))


def begin(source, case, solved):
    """The case folder made anew from the exported case, with its start from a solved case folder, or from rest."""
    shutil.rmtree(case, ignore_errors=True)
    case.mkdir(parents=True)
    for name in ("0", "system"):
        shutil.copytree(source / name, case / name)
    shutil.copytree(source / "constant", case / "constant", ignore=shutil.ignore_patterns("polyMesh"))
    link(case / "constant/polyMesh", source / "constant/polyMesh")
    if solved:
        call(case, "log.mapFields", "mapFields", solved.resolve(), "-consistent", "-sourceTime", "latestTime",
             "-mapMethod", "mapNearest")


def prepare(source, case, ranks, mesh, start):
    """The case folder `case` made from the exported case `source`, decomposed for the ranks, with its start from what
    the call start() gives: a solved case folder, or None for rest. As an earlier call left it where that was of the
    same source and mesh (any value that tells it), without what that had not finished; then start is not called, and
    for other ranks the latest fields are put together and decomposed again."""
    mark = {"source": digest_of(source, mesh), "ranks": ranks}
    kept = case / "made_from.json"
    before = json.loads(kept.read_text()) if kept.exists() else {}
    if before.get("source") != mark["source"]:
        begin(source, case, start())
    else:
        drop_unfinished(case)
        if before == mark:
            return
        say(f"{case}: ranks: {ranks} in the place of {before['ranks']}; goes on from the latest fields")
        if before["ranks"] > 1:
            rejoin(case)
    write_whole(kept, json.dumps({**mark, "ranks": 1}))  # the folder has all that goes on from here
    for part in case.glob("processor*"):
        shutil.rmtree(part)
    if ranks > 1:
        divide(case, ranks)
        write_whole(kept, json.dumps(mark))


def stop_solver(child):
    """Ends the solver and all its ranks."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(child.pid, number)
            child.wait(20)
            return
        except ProcessLookupError:
            child.wait()
            return
        except subprocess.TimeoutExpired:
            continue


def progress(table, most, rate, rest, name):
    """One line: `rate` is in iterations a second. The time left is that until head and torque settle, where their last
    windows tell it, else that until `most` iterations are done."""
    iteration = max(table)
    row = table[iteration]
    left, wanted = settling.settled(table, rest)[1], settling.iterations_left(table, rest)
    way = f"{100 * left:.2f} % of its way left" if math.isfinite(left) else "before the third window"
    residuals = f", residuals: p {row['residual_p']:.1e}, U {row['residual_u']:.1e}" if "residual_p" in row else ""
    known = wanted is not None and wanted < most - iteration
    minutes = (wanted if known else most - iteration) / rate / 60
    say(f"{name}: iteration {iteration} of {most} at most, {rate:.2f} a second: head {row['head_m']:.3f} m, torque "
        f"{row['torque_n_m']:.4g} N m{residuals}; {way}; {'about' if known else 'at most'} {minutes:.0f} min left")


def remedy(case):
    return f"the flow diverges: try relaxationFactors of U 0.5 in {case / 'system/fvSolution'}, or more cells"


def require_bounded(table, case, name):
    """Ends where the last report is of a flow that diverges."""
    last = max(table)
    head, torque = (table[last][key] for key in ("head_m", "torque_n_m"))
    if not math.isfinite(head + torque) or abs(head) > 1e6:
        raise Trouble(f"{name}: iteration {last}: see {case / 'log.simpleFoam'}; {remedy(case)}")


def solved(case):
    """The iteration of the latest fields, from which the solver goes on."""
    part = case / "processor0"
    return max(times(part if part.is_dir() else case), default=0)


def watch(child, case, most, rest, name):
    """Looks at the reports of the running solver until it ends; asks it to end where head and torque have settled. What
    a solver reported that was stopped before, maybe behind the fields from which this one goes on, does not count.

    It asks again and again: OpenFOAM takes no notice of a change within 10 s (fileModificationSkew) after it has read
    a file."""
    before, first = max(reports.history(case), default=0), solved(case)
    began = told = time.monotonic()
    stopping = False
    while child.poll() is None:
        time.sleep(LOOK_EVERY)
        table = reports.history(case)
        last = max(table, default=before)
        if last == before:
            continue
        require_bounded(table, case, name)
        if last > first and time.monotonic() - told > TELL_EVERY:
            told = time.monotonic()
            progress(table, most, (last - first) / (told - began), rest, name)
        if stopping:
            (case / "system/controlDict").touch()
        elif settling.settled(table, rest)[0]:
            set_entry(case, "system/controlDict", "stopAt", "writeNow")
            stopping = True


def run_solver(case, ranks, most, rest, name):
    """One run of the solver, until it has settled or `most` iterations are done."""
    set_entry(case, "system/controlDict", "stopAt", "endTime")
    line = mpirun(ranks, "simpleFoam", "-parallel") if ranks > 1 else ["simpleFoam"]
    with open(case / "log.simpleFoam", "a", encoding="utf-8") as out:
        child = subprocess.Popen(line, start_new_session=True, **child_options(case, out))
    try:
        watch(child, case, most, rest, name)
    except BaseException:
        stop_solver(child)
        raise
    if child.returncode:
        words = (case / "log.simpleFoam").read_text(errors="replace").rpartition("Build  :")[2]  # of this run
        fatal = next((f", {text.strip(' :')}" for text in words.splitlines() if "FOAM FATAL" in text), "")
        raise Trouble(f"{name}: simpleFoam ended with {child.returncode}{fatal}: see {case / 'log.simpleFoam'}"
                      + (f"; {remedy(case)}" if "sigFpe::" in words else ""))


def history(case):
    """What was reported up to the latest fields."""
    last = solved(case)
    return {iteration: row for iteration, row in reports.history(case).items() if iteration <= last}


def iterate(case, ranks, most, rest, name):
    """Runs the solver until it has settled, by its last iteration too, or `most` iterations are done, up to the next
    report; its history. The fields of the last iteration are then whole in the case folder. A solver that was killed
    may have reported more than it has written: then it goes on from its fields."""
    most = REPORTED * math.ceil(most / REPORTED)
    set_entry(case, "system/controlDict", "endTime", most)
    set_entry(case, "system/controlDict", "writeInterval", math.gcd(WRITTEN, most))  # the solver writes no other end
    table = history(case)
    done = -1  # iterations; the last ones may lie between two reports
    while done < max(table, default=0) < most and not settling.settled(table, rest)[0]:
        done = max(table, default=0)
        run_solver(case, ranks, most, rest, name)
        table = history(case)
    require_bounded(table, case, name)
    if ranks > 1:
        call(case, "log.reconstructPar", "reconstructPar", "-latestTime")
    return table
