# SPDX-License-Identifier: AGPL-3.0-or-later
"""How the benchmarks run programs and time them, and gmsh on the solids of a pump."""
import argparse
import json
import os
import re
import subprocess
import sys
import threading
import time
from collections import namedtuple
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "WM_PROJECT_DIR": "/usr/share/openfoam"}
MPIRUN = ["mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n"]

# What a program said, wall and processor seconds, peak memory in bytes, exit status (less than 0: its signal).
Run = namedtuple("Run", "text wall processor peak status")
# Also the processor seconds of gmsh's own steps by name, without reading and writing, and how much it made.
Gmsh = namedtuple("Gmsh", "wall processor steps peak triangles tetrahedra")


def made_folder(text):
    """The type of an option: a folder, which is made where there is none."""
    path = Path(text)
    path.mkdir(parents=True, exist_ok=True)
    return path


def options_of(text, **defaults):
    """The parser of a benchmark: --KEY for each default, of its type; a default of False makes a switch."""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    for key, default in defaults.items():
        kind = {"action": "store_true"} if default is False else {"type": type(default), "default": default}
        parser.add_argument(f"--{key.replace('_', '-')}", **kind)
    return parser


def execute(*line, folder=None, check=True, limit=None, processor=None):
    """Runs a program to its end, or for `limit` seconds, or until one of its processes has had `processor` seconds of
    the processor; with `check` the benchmark ends where it fails."""
    line = ["prlimit", f"--cpu={processor}:{processor + 1}", *line] if processor else line
    line = [str(word) for word in line]
    began = time.monotonic()
    child = subprocess.Popen(line, cwd=folder, env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, errors="replace")
    timer = threading.Timer(limit, child.kill) if limit else None
    if timer:
        timer.start()
    text = child.stdout.read()
    if timer:
        timer.cancel()
    _, status, use = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if check and child.returncode:
        sys.exit(f"{Path(sys.argv[0]).stem}: {' '.join(line)}:\n{text[-2000:]}")
    return Run(text, time.monotonic() - began, use.ru_utime + use.ru_stime, 1024 * use.ru_maxrss,
               child.returncode)


def gmsh_steps(text):
    """Processor seconds of gmsh's steps by name. HXT improves within its own time, the Delaunay mesher after it."""
    done = r"Done (meshing [123]D|optimizing mesh) \(Wall [\d.e-]+s, CPU ([\d.e-]+)s\)"
    return {name: float(seconds) for name, seconds in re.findall(done, text)}


def gmsh(step, size, algorithm, folder, threads=1, dimension=3, mesh=None, more=()):
    """gmsh on a STEP file with this largest size, mm, and where asked its mesh in a binary file. It makes no layers."""
    script = folder / "gmsh.geo"
    script.write_text(f'Merge "{step}";\nMesh {dimension};\n' + (f'Save "{mesh}";\n' if mesh else "") +
                      'Printf("made %.0f triangles, %.0f tetrahedra", Mesh.NbTriangles, Mesh.NbTetrahedra);\n')
    run = execute("gmsh", "-", script, "-nt", threads, "-algo", algorithm, "-clmax", f"{size:.6g}", "-bin", *more)
    made = re.search(r"^made (\d+) triangles, (\d+) tetrahedra", run.text, re.M)
    if not made:
        sys.exit(f"{Path(sys.argv[0]).stem}: gmsh, {script}:\n{run.text[-2000:]}")
    return Gmsh(run.wall, run.processor, gmsh_steps(run.text), run.peak, *map(int, made.groups()))


def gmsh_first_size(geometry, cells):
    """About the size, mm, at which gmsh fills the solids of a geometry stage with so many tetrahedra."""
    design = json.loads((geometry / "design.json").read_text())
    return (8e9 * (design["rotor_volume_m3"] + design["stator_volume_m3"]) / cells) ** (1 / 3)


def size_for(wanted, size, dimension, near, make):
    """The size at which make(size) counts `wanted` elements, but for a share of `near`."""
    for _ in range(8):
        made = make(size)
        print(f"{Path(sys.argv[0]).stem}: gmsh -clmax {size:.4g} makes {made:,} elements", file=sys.stderr)
        if abs(made / wanted - 1) <= near:
            return size
        size *= (made / wanted) ** (1 / dimension)
    sys.exit(f"{Path(sys.argv[0]).stem}: no size of gmsh gives {wanted} elements")
