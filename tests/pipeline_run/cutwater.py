# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the tests of whole runs share: where things lie, how a stage is started, what its files say.

The environment names the folders: CUTWATER_BIN (the programs), CUTWATER_SOURCE (top of the source), CUTWATER_WORK
(where the tests write) and CUTWATER_CELLS (asked number of cells of the run that they share)."""
import hashlib
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

BIN = Path(os.environ["CUTWATER_BIN"])
SOURCE = Path(os.environ["CUTWATER_SOURCE"])
WORK = Path(os.environ["CUTWATER_WORK"])
CELLS = int(os.environ.get("CUTWATER_CELLS", 200000))
PAPER = SOURCE / "cases/paper/case.yaml"
RUN = WORK / f"paper-{CELLS}"  # the run that the tests share

MPI_ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
ENVIRONMENT = {**os.environ, **MPI_ENVIRONMENT, "WM_PROJECT_DIR": "/usr/share/openfoam"}
MPI_STAGES = ("mesh", "export", "report")


def command(stage, run, case=PAPER, cells=None, ranks=1):
    """The command line of a stage, as pipeline/run.mk has it."""
    line = [str(BIN / f"cutwater-{stage}"), "--case", str(case), "--run", str(run)]
    if cells:
        line += ["--cells", str(cells)]
    if stage in MPI_STAGES:
        line = ["mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] + line
    return line


def start(stage, run, **options):
    """Starts a stage in a process group of its own; its standard error can be read."""
    return subprocess.Popen(command(stage, run, **options), env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)


def pass_over_without_gmsh():
    """Ends a test as passed over where gmsh's module for Python is not there."""
    if importlib.util.find_spec("gmsh") is None:
        print("gmsh's module for Python is not there")
        sys.exit(77)


def execute(line, folder=None, timeout=1500, environment=ENVIRONMENT):
    return subprocess.run([str(word) for word in line], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=timeout)


def without_make(path=None):
    """The environment without what a make above has put there; with a path, programs are looked for there first."""
    clean = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "CELLS")}
    return clean | ({"PATH": f"{path}:{clean['PATH']}"} if path else {})


def within(words, line):
    """The line of a stage whose program these words start, on each rank."""
    program = next(k for k, word in enumerate(line) if word.startswith(f"{BIN}/cutwater-"))
    return [*line[:program], *words, *line[program:]]


def said(test, line, folder=None, timeout=1500):
    """Runs a program that must succeed; what it says."""
    result = execute(line, folder, timeout)
    test.assertEqual(result.returncode, 0, result.stdout[-5000:])
    return result.stdout


def rows_said(test, line):
    """The rows of the table that a program writes, by the names in its first line."""
    head, *lines = said(test, line).splitlines()
    return [dict(zip(head.split(), words.split())) for words in lines]


def stage(name, run, **options):
    """Runs a stage to its end; gives what it returned, its lines in .stdout."""
    return execute(command(name, run, **options))


def done(test, name, run, **options):
    """Runs a stage that must succeed."""
    result = stage(name, run, **options)
    test.assertEqual(result.returncode, 0, f"cutwater-{name}:\n{result.stdout}")
    return result


def said_until(test, process, words):
    """Reads what a stage that was started says, until a line holds these words."""
    test.assertTrue(any(words in line for line in process.stderr), f"not said: {words}")


def on_a_small_disk(test, name, run, size, **options):
    """Runs a stage whose folder is a file system of so many bytes while it lasts, and then holds what was in that."""
    folder, left = run / name, run / "left"
    folder.mkdir(parents=True)
    if execute(["unshare", "-rm", "mount", "-t", "tmpfs", "tmpfs", folder]).returncode:
        test.skipTest("no file system can be mounted here")
    line = " ".join(f"'{word}'" for word in command(name, run, **options))
    result = execute(["unshare", "-rm", "sh", "-c", f"mount -t tmpfs -o size={size} tmpfs '{folder}' && {line}; "
                      f"code=$?; cp -a '{folder}' '{left}'; exit $code"])
    folder.rmdir()
    left.rename(folder)
    return result


def read_json(run, name):
    return json.loads((Path(run) / name).read_text())


def record(run, name):
    return read_json(run, f"{name}/record.json")


def fresh(name):
    """An empty folder of the test."""
    folder = WORK / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def with_stages(name, *stages):
    """A run folder with what these stages made in the shared run and nothing else."""
    folder = fresh(name)
    for made in stages:
        shutil.copytree(RUN / made, folder / made, symlinks=True)
    return folder


def with_geometry(name):
    return with_stages(name, "geometry")


def changed_case(folder, *changes):
    """The paper's case as a file of this folder, with parts of its text changed: (old, new)."""
    text = PAPER.read_text()
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    case = folder / "case.yaml"
    case.write_text(text)
    return case


def seal(test, folder):
    """Makes the digests of a stage's record those of its files as they are now: for files that a test has changed."""
    said(test, [BIN / "seal_files", folder])


def interfaces_agree(test, run):
    """The two sides of all interfaces have the same faces, as many as the rule of region numbers has made, though no
    region has waited for another: only a periodic image waits for the region that it is made from."""
    results = record(run, "mesh")["results"]
    domains = results["domains"]
    told = said(test, [BIN / "interface_sides", run / "mesh", *(domain["name"] for domain in domains)])
    after = []
    for domain, line in zip(domains, told.splitlines(), strict=True):
        rule, (name, *counts) = domain["region_rule"], line.split()
        regions, triangles = map(int, counts)
        test.assertEqual((name, regions), (domain["name"], domain["regions"]))
        test.assertGreater(regions, 1)
        test.assertEqual(triangles, rule["final_triangles"], name)
        test.assertEqual(triangles, rule["planned_triangles"] + 2 * rule["inserted_centres"], name)
        before = len(after)
        after += [-1 if region["copy_of"] == region["region"] else before + region["copy_of"] - 1
                  for region in domain["region_list"]]
    step = [tasks for tasks in results["together"]["tasks"] if tasks["step"] == "regions"][-1]
    test.assertEqual(step["task_after"] or [-1] * len(after), after)


def rule_on_all_regions(test, run):
    """Each region that is the lower number beside an interface has applied the rule of region numbers, in all domains;
    where it found triangles to divide, it divided them or left them to both sides. A line of its counts by domain."""
    results, owners, lines = record(run, "mesh")["results"], set(), []
    for domain in results["domains"]:
        name, rule = domain["name"], domain["region_rule"]
        first = {region["region"]: region["copy_of"] for region in domain["region_list"]}
        number = {region["region"]: region["number"] for region in domain["region_list"]}
        owners |= {(name, min((first[a], first[b]), key=number.get)) for a, b in domain["adjacent_regions"]}
        planned, encroached, inserted, left, final = (rule[f"{key}_{what}"] for key, what in (
            ("planned", "triangles"), ("encroached", "triangles"), ("inserted", "centres"), ("left", "triangles"),
            ("final", "triangles")))
        test.assertEqual(planned > 0, domain["regions"] > 1, name)
        test.assertLessEqual(encroached, planned, name)
        test.assertLessEqual(left, final, name)
        test.assertEqual(inserted + left > 0, encroached > 0, name)
        lines.append(f"{name}: {domain['regions']} regions, {planned} interface triangles, {encroached} with new "
                     f"points in their spheres, {inserted} centres inserted, {left} triangles left to both sides")
    step = [tasks for tasks in results["together"]["tasks"] if tasks["step"] == "region rule"][-1]
    test.assertEqual(len(step["task_seconds"]), len(owners))
    return lines


def digests(folder, pattern="*", leave_out=("record.json",)):
    """SHA-256 of every file of a folder, by its path in it."""
    folder = Path(folder)
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob(pattern)) if path.is_file() and path.name not in leave_out}


def surface(path):
    """The points, m, and the triangles (numbers of points) of a surface that the mesher has drawn as VTK."""
    with open(path) as lines:
        count = next(line for line in lines if line.startswith("POINTS")).split()[1]
        points = [tuple(map(float, next(lines).split())) for _ in range(int(count))]
        count = next(line for line in lines if line.startswith("POLYGONS")).split()[1]
        return points, [tuple(map(int, next(lines).split()[1:])) for _ in range(int(count))]


def regions(run):
    """The region files of a run that are whole."""
    return sorted((Path(run) / "mesh").glob("[!.]*.h5"))


def error_lines(text, name):
    return [line for line in text.splitlines() if line.startswith(f"cutwater-{name}: error: ")]


def state(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"


def left_behind(ranks, seconds=30):
    """Waits until these ranks have ended, which may be a moment after their mpirun has; those that have not."""
    deadline = time.monotonic() + seconds
    while (left := [pid for pid in ranks if state(pid) != "Z"]) and time.monotonic() < deadline:
        time.sleep(0.05)
    return left


def ranks_of(mpirun):
    """The ranks that an mpirun has started."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            program = (entry / "comm").read_text().strip()
        except OSError:
            continue
        if parent == mpirun and program.startswith("cutwater"):
            found.append(int(entry.name))
    return sorted(found)
