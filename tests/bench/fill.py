#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""Compares the ways to fill a closed surface: our kernel, TetGen behind the same call, and gmsh's HXT.

Use, from the top of the source:
  tests/bench/fill.py BUILD_DIR [--ring EDGE_LENGTH ...] [--run RUN_DIR ...] [--growth G] [--repeat N] [--cores N ...]
    [--equal]
Surfaces are a ring (0.26 m across) with six blade-shaped voids, for each edge length in m, and the inner
boundaries of the regions that a run of the mesher left in RUN_DIR/mesh. Sizes grow from the surface by G a
length, 0.15 by default; gmsh follows its own rule. Seconds are user time of one core, the
least of N runs in turn; memory is the peak less what stood before, for the kernel after the fill of a small box.
Each way runs alone (cores 1) and as two processes at once (cores 2, the mean of both), which share the memory. gmsh
chooses its own number of tetrahedra; with --equal HXT fills each surface a second time ("hxt, ="), with the sizes that
the kernel has, scaled so that it makes as many. The last column is our rate over that of the way; the last line tells
the greatest memory and the least rate of the kernel on one core. A run of gmsh has 10 minutes.
"""
import shutil
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from programs import execute, gmsh_steps, options_of

LIMIT = 600  # seconds
NEAR = 0.05  # of as many tetrahedra
TRIES = 6  # of a scale that gives them
HEAD = (f"{'surface':18s} {'facets':>7s} {'way':8s} {'cores':>5s} {'tets':>8s} {'seconds':>8s} "
        f"{'tets/s':>8s} {'B/tet':>5s} {'aspect':>6s} {'max':>5s} {'least':>5s} {'ratio':>5s} {'ours/it':>7s}")


def run_ours(program, way, surface, growth):
    """triangles, tets, seconds, bytes a tet, aspect mean, aspect max, least dihedral, mean ratio"""
    done = subprocess.run([str(program), way, str(surface), str(growth)], capture_output=True, text=True)
    if done.returncode:
        return done.stderr.strip().split("\n")[-1]
    words = done.stdout.split()
    return [int(words[0]), int(words[1]), float(words[2]), float(words[4]), *map(float, words[5:9])]


def run_gmsh(folder, surface, shells, sizes, *options, limit=LIMIT):
    """gmsh within a surface of so many closed parts, with a file of sizes, or None for its own rule: the run, and the
    file of its mesh, if it made one."""
    mesh = folder / "gmsh.msh"
    script = folder / "gmsh.geo"
    loops = "".join(f"Surface Loop({k}) = {{{k}}};\n" for k in range(1, shells + 1))
    numbers = ", ".join(str(k) for k in range(1, shells + 1))
    field = (f'Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeFromPoints = 0;\nField[1] = Structured;\n'
             f'Field[1].FileName = "{sizes}";\nField[1].TextFormat = 1;\nBackground Field = 1;\n') if sizes else ""
    script.write_text(f'Merge "{surface}";\n{loops}Volume(1) = {{{numbers}}};\nMesh.SaveAll = 1;\n{field}')
    mesh.unlink(missing_ok=True)
    return execute("gmsh", *options, "-nt", 1, "-format", "msh2", "-o", mesh, script, check=False, limit=limit), mesh


def fill_by_hxt(program, surface, shells, sizes=None):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        before, _ = run_gmsh(folder, surface, shells, sizes, "-2")
        run, mesh = run_gmsh(folder, surface, shells, sizes, "-3", "-algo", "hxt")
        steps = gmsh_steps(run.text)
        if "meshing 3D" not in steps or not mesh.exists():
            return "failed" if run.wall < LIMIT else f"not done in {LIMIT} s"
        words = execute(program, "quality", mesh).text.split()
    tets = int(words[1])
    if tets == 0:
        return "failed"
    seconds = steps["meshing 3D"] + steps.get("optimizing mesh", 0)
    return [int(words[0]), tets, seconds, max(0, run.peak - before.peak) / tets, *map(float, words[2:6])]


def at_once(way, cores):
    """A row that is the mean of as many runs at the same time."""
    with ThreadPoolExecutor(cores) as pool:
        rows = [task.result() for task in [pool.submit(way) for _ in range(cores)]]
    for row in rows:
        if isinstance(row, str):
            return row
    return [sum(column) / cores for column in zip(*rows)]


def equal_sizes(program, surface, shells, growth, folder):
    """A file of sizes with which HXT makes as many tetrahedra as the kernel, and None; or None and the reason."""
    sizes = folder / "sizes.txt"
    ours = run_ours(program, "kernel", surface, growth)
    if isinstance(ours, str):
        return None, ours
    scale = 1.0
    for _ in range(TRIES):
        execute(program, "sizes", surface, growth, f"{scale:.6g}", sizes)
        row = fill_by_hxt(program, surface, shells, sizes)
        if isinstance(row, str):
            return None, f"{row}, sizes times {scale:.3g}"
        if abs(row[1] / ours[1] - 1) <= NEAR:
            return sizes, None
        scale *= (row[1] / ours[1]) ** (1 / 3)
    return None, f"no scale of the sizes gives {ours[1]} tetrahedra"


def compare(program, title, surface, shells, words, folder):
    """Prints the rows of a surface. Those of the kernel on one core."""
    ways = [(name, lambda name=name: run_ours(program, name, surface, words.growth)) for name in ("kernel", "tetgen")]
    if shutil.which("gmsh"):
        ways.append(("hxt", lambda: fill_by_hxt(program, surface, shells)))
    if shutil.which("gmsh") and words.equal:
        sizes, reason = equal_sizes(program, surface, shells, words.growth, folder)
        ways.append(("hxt, =", lambda: reason or fill_by_hxt(program, surface, shells, sizes)))
    best = {}
    for _ in range(words.repeat):
        for cores in words.cores:
            for name, way in ways:
                row = at_once(way, cores)
                key = name, cores
                if key not in best or isinstance(best[key], str) or \
                        (not isinstance(row, str) and row[2] < best[key][2]):
                    best[key] = row
    for cores in words.cores:
        ours = best["kernel", cores]
        for name, _ in ways:
            row = best[name, cores]
            if isinstance(row, str):
                print(f"{title:18s} {'':7s} {name:8s} {cores:5d} {row}", flush=True)
                continue
            facets, tets, seconds, size, mean, most, least, ratio = row
            times = "" if isinstance(ours, str) else f"{ours[1] / ours[2] / (tets / seconds):7.2f}"
            print(f"{title:18s} {facets:7.0f} {name:8s} {cores:5d} {tets:8.0f} {seconds:8.3f} "
                  f"{tets / seconds:8.0f} {size:5.0f} {mean:6.3f} {most:5.2f} {least:5.2f} {ratio:5.3f} {times}",
                  flush=True)
    return [best[key] for key in best if key == ("kernel", 1) and not isinstance(best[key], str)]


def main():
    parser = options_of(__doc__, growth=0.15, repeat=1)
    parser.add_argument("build", type=Path)
    parser.add_argument("--ring", type=float, nargs="*", default=[0.004, 0.0025, 0.0016])
    parser.add_argument("--run", type=Path, nargs="*", default=[])
    parser.add_argument("--cores", type=int, nargs="*", default=[1, 2])
    parser.add_argument("--equal", action="store_true", help="HXT with as many tetrahedra as the kernel, too")
    words = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = words.build / "bin/fill"
        print(HEAD, flush=True)
        surface = folder / "surface.msh"
        kernel = []
        for edge in words.ring:
            execute(program, "ring", edge, surface)
            kernel += compare(program, f"ring {edge}", surface, 7, words, folder)
        for run in words.run:
            for region in sorted((run / "mesh").glob("[!.]*.h5")):
                execute(program, "region", region, surface)
                kernel += compare(program, region.stem, surface, 1, words, folder)
        if kernel:
            print(f"kernel, {len(kernel)} surfaces: at most {max(row[3] for row in kernel):.0f} bytes a tetrahedron, "
                  f"at least {min(row[1] / row[2] for row in kernel):.0f} tetrahedra a second; aspect at most "
                  f"{max(row[4] for row in kernel):.3f} in the mean, dihedral angles at least "
                  f"{min(row[6] for row in kernel):.2f} degrees")


if __name__ == "__main__":
    main()
