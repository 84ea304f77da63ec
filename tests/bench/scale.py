#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""scale.py [CELLS ...] [--ranks 2] [--kill] [--judge] [--audit] [--report] [--formats F ...]
         [--work DIR] [--bin build/bin] [--case cases/paper/case.yaml]

Whole runs at growing numbers of cells (8M 20M unless others are given), one after the other: cells made and how far
from those asked, seconds and memory of each stage, balance and least dihedral angle. With --kill the mesher is run once
more in a folder of its own, all its ranks are killed (SIGKILL) when half of the regions are whole, it is called again,
and its files must have the same bytes as those of the run that nobody killed. With --judge cgnscheck and OpenFOAM's
checkMesh (-allGeometry -allTopology) look at what was written; checkMesh takes about 1 GB per million cells. With
--audit build/bin/cgns_audit looks at pump.cgns as a stream, at any size. --formats: of the export (those of the case);
--report: the page is made too.

Every run is removed before the next one begins; what it takes in --work (the system's folder for temporary files unless
given) tells pipeline/needs.py: 1000 million cells 46 GB with CGNS alone."""
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from programs import ENVIRONMENT, execute, made_folder, options_of
from runs import BIN, PAPER_CASE, needs, record, seconds_by_step, stage_line, with_key


def command(options, stage, run, cells):
    return [str(word) for word in stage_line(options.bin, stage, options.case, run, cells, options.ranks)]


def digests(mesh):
    """SHA-256 of the files that are the mesh, by name; a record tells of times too."""
    found = {}
    for path in sorted(mesh.iterdir()):
        if path.name != "record.json":
            with path.open("rb") as file:
                found[path.name] = hashlib.file_digest(file, "sha256").hexdigest()
    return found


def table_row(run, cells):
    mesh, export = record(run, "mesh"), record(run, "export")
    results = mesh["results"]
    domains = results["domains"]

    def of_domains(key, form):
        return " / ".join(form.format(domain[key]) for domain in domains)

    balance = " / ".join(f"{d['region_balance_least']:.2f}-{d['region_balance']:.2f}" for d in domains)
    print(f"{cells:>8}{results['cells']:>15,}{results['passes']:>7}{mesh['seconds']:>9.1f}{export['seconds']:>9.1f}"
          f"{mesh['peak_memory_bytes'] / 2**30:>9.2f}{export['peak_memory_bytes'] / 2**30:>9.2f}"
          f"  {of_domains('regions', '{}'):>11} {balance:>23} {of_domains('least_dihedral_deg', '{:.1f}'):>14}"
          f" {of_domains('tetrahedron_aspect_mean', '{:.2f}'):>14}", flush=True)
    long = [f"{name} {seconds:.1f}" for name, seconds in seconds_by_step(mesh).items() if seconds >= 0.1]
    print("         mesher, s: " + ", ".join(long), flush=True)


def audit(options, run):
    """Prints what the audit of pump.cgns finds; it ends with a line and 1 at the first fault."""
    result = execute(options.bin / "cgns_audit", run / "export/pump.cgns")
    zones = [json.loads(line) for line in result.text.splitlines() if line.startswith("{")]
    total = sum(zone["cells"] for zone in zones)
    print(f"         cgns_audit: {len(zones)} zones, {total:,} cells sound, "
          f"{sum(zone['memory_bytes'] for zone in zones) / 2**30:.2f} GiB, {result.wall:.0f} s", flush=True)
    if total != record(run)["results"]["cells"]:
        sys.exit("scale: the audit counts other cells than the mesher")


def case_with_formats(options, folder):
    """A copy of the case with other formats, beside the run."""
    path = Path(folder) / "case.yaml"
    path.write_text(with_key(options.case.read_text(), "export", "formats", f"[{', '.join(options.formats)}]"))
    return path


def kill_half_way(options, run, cells, regions):
    """Seconds until all ranks were killed, regions that were whole then, seconds of the second call."""
    began = time.monotonic()
    process = subprocess.Popen(command(options, "mesh", run, cells), env=ENVIRONMENT, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, start_new_session=True)
    while len(list((run / "mesh").glob("[!.]*.h5"))) < regions // 2:
        if process.poll() is not None:
            sys.exit("scale: the run ended before it could be killed")
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    killed = time.monotonic()
    time.sleep(2)  # ranks end when they see their mpirun gone
    whole = len(list((run / "mesh").glob("[!.]*.h5")))
    return killed - began, whole, execute(*command(options, "mesh", run, cells)).wall


def judge(run):
    """Prints what cgnscheck and checkMesh say."""
    text = execute("cgnscheck", run / "export/pump.cgns").text
    print(f"         cgnscheck: {len(re.findall('ERROR', text))} errors, {len(re.findall('WARNING', text))} warnings")
    text = execute("checkMesh", "-allGeometry", "-allTopology", "-case", run / "export/openfoam").text
    told = re.findall(r"^ *\*+.*|.*non-orthogonality Max.*|Max skewness.*|Mesh OK.*|Failed \d+ mesh checks.*", text,
                      re.M)
    print("\n".join(f"         checkMesh: {line.strip()}" for line in told), flush=True)


def main():
    parser = options_of(__doc__, ranks=2, kill=False, judge=False, audit=False, report=False, bin=BIN, case=PAPER_CASE)
    parser.add_argument("cells", nargs="*", default=["8M", "20M"])
    parser.add_argument("--formats", nargs="+")
    parser.add_argument("--work", type=made_folder)
    options = parser.parse_args()
    print(f"{options.ranks} ranks on {os.cpu_count()} cores; seconds of the mesher and the exporter, peak memory of "
          "all ranks in GiB; regions, cells of a region over their mean, least dihedral angle in degrees, mean aspect: "
          "rotor / stator")
    print(f"{'asked':>8}{'made':>15}{'passes':>7}{'mesher':>9}{'export':>9}{'mesher':>9}{'export':>9}  {'regions':>11} "
          f"{'balance':>23} {'least dihedral':>14} {'aspect':>14}")
    for cells in options.cells:
        options.work and options.work.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=options.work) as name:
            run = Path(name) / "run"
            began = time.monotonic()
            given = options.case
            if options.formats:
                options.case = case_with_formats(options, name)
            for stage in ("geometry", "mesh", "export") + ("report",) * options.report:
                execute(*command(options, stage, run, cells))
            table_row(run, cells)
            print(f"         {time.monotonic() - began:.0f} s in all, "
                  f"{record(run)['results']['cells'] / needs.read_count(cells) - 1:+.2%} off the asked number",
                  flush=True)
            if options.audit:
                audit(options, run)
            if options.judge:
                judge(run)
            if options.kill:
                unkilled = digests(run / "mesh")
                regions = sum(domain["regions"] for domain in record(run)["results"]["domains"])
                shutil.rmtree(run / "export")
                shutil.rmtree(run / "mesh")
                first, whole, again = kill_half_way(options, run, cells, regions)
                same = digests(run / "mesh") == unkilled
                print(f"         killed after {first:.1f} s with {whole} of {regions} regions whole; called again "
                      f"{again:.1f} s: " + ("the same bytes" if same else "OTHER BYTES"), flush=True)
                if not same:
                    sys.exit(1)
            options.case = given


main()
