# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the benchmarks share about runs of the stages: how a stage is called, what its files say, and rows of results
that a later call takes up."""
import base64
import json
import re
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from programs import MPIRUN, SOURCE, execute

sys.path.insert(0, str(SOURCE / "pipeline"))
import needs  # noqa: E402  (pipeline/needs.py)

BIN, PAPER_CASE = SOURCE / "build/bin", SOURCE / "cases/paper/case.yaml"


def stage_line(programs, stage, case, run, cells=None, ranks=1):
    """The command line of a stage, its program in the folder `programs`; the geometry runs by itself."""
    line = [programs / f"cutwater-{stage}", "--case", case, "--run", run]
    return line if stage == "geometry" else [*MPIRUN, ranks, *line, *(["--cells", cells] if cells else [])]


def record(run, stage="mesh"):
    return json.loads((run / stage / "record.json").read_text())


def domain_alone(programs, geometry, domain, folder):
    """Copies a geometry with one domain of it alone, whose interfaces are outlets."""
    shutil.copytree(geometry, folder)
    model = json.loads((folder / "model.json").read_text())
    model["domains"] = [one for one in model["domains"] if one["name"] == domain]
    if not model["domains"]:
        sys.exit(f"{Path(sys.argv[0]).stem}: {folder}: no domain is called '{domain}'")
    model["interfaces"] = []
    for patch in model["domains"][0]["patches"]:
        if patch["kind"] == "interface":
            patch.update(kind="outlet", flow_share=1.0)
    (folder / "model.json").write_text(json.dumps(model))
    head, *faces = (folder / "faces.csv").read_text().splitlines()
    rows = [line.split(",") for line in faces if line.startswith(f"{domain},")]
    kind = head.split(",").index("kind")
    for row in rows:
        row[kind] = row[kind].replace("interface", "outlet")
    (folder / "faces.csv").write_text("".join(f"{line}\n" for line in [head, *map(",".join, rows)]))
    execute(programs / "seal_files", folder)


def cases_named(names):
    """Name and case file of these pumps of cases/, of all of them where none is named."""
    found = names or sorted(path.parent.name for path in (SOURCE / "cases").glob("*/case.yaml"))
    return [(name, SOURCE / "cases" / name / "case.yaml") for name in found]


def with_key(text, section, key, value):
    """The text of a case with another value of a key, or with the key in its section."""
    line = f"  {key}: {value}\n"
    text, found = re.subn(rf"(?m)^  {key}:.*\n", lambda _: line, text)
    if not found:
        text, found = re.subn(rf"(?m)^{section}:.*\n", lambda head: head[0] + line, text)
    return text if found else f"{text}\n{section}:\n{line}"


def seconds_by_step(made):
    """Of a record: the seconds of all steps of a name."""
    seconds = {}
    for step in made["steps"]:
        seconds[step["name"]] = seconds.get(step["name"], 0) + step["seconds"]
    return seconds


def quality(results):
    """Of the mesher's results: mean aspect of the tetrahedra, and the shares of the faces of walls with their first
    height and with volumes alike across the layer top."""
    domains = results["domains"]
    walls = [wall for domain in domains for wall in domain["layer_coverage"]]
    faces = sum(wall["wall_faces"] for wall in walls)
    tetrahedra = sum(domain["tetrahedra"] for domain in domains)
    return {"aspect": sum(domain["tetrahedron_aspect_mean"] * domain["tetrahedra"] for domain in domains) / tetrahedra,
            "first_height": sum(wall["first_height_met_faces"] for wall in walls) / faces,
            "even": 1 - sum(wall["thin_last_layer_faces"] + wall["thick_last_layer_faces"] for wall in walls) / faces}


def failed_checks(run):
    """The checks of OpenFOAM's checkMesh that a run's mesh fails."""
    text = execute("checkMesh", "-allGeometry", "-allTopology", "-case", run / "export/openfoam", check=False).text
    failed = [line.strip(" *") for line in re.findall(r"^ *\*\*\*.*", text, re.M)]
    return failed or ([] if "Mesh OK." in text else ["ends without a verdict"])


def save_picture(run, title, path):
    """Writes the picture of this title of a run's report to a file."""
    page = run / "report/index.html"
    found = re.search(rf'alt="{re.escape(title)}" src="data:image/png;base64,([^"]+)"', page.read_text())
    if not found:
        sys.exit(f"{Path(sys.argv[0]).stem}: {page}: no picture is called '{title}'")
    path.write_bytes(base64.b64decode(found[1]))


def rows_before(path):
    """The rows that earlier calls have written, by their key; the last of each."""
    lines = path.read_text().splitlines() if path.exists() else []
    return {row["key"]: row for row in map(json.loads, lines)}


def run_tasks(path, tasks, jobs):
    """Calls tasks (function, arguments...) on as many threads, and writes the row that each returns as a line of the
    file. Yields them as they end: how many have ended, minutes left, the row."""
    began = time.monotonic()
    with ThreadPoolExecutor(jobs) as pool, path.open("a") as file:
        running = [pool.submit(*task) for task in tasks]
        for number, future in enumerate(as_completed(running), 1):
            if future.exception():
                pool.shutdown(cancel_futures=True)
            row = future.result()
            file.write(json.dumps(row) + "\n")
            file.flush()
            yield number, (time.monotonic() - began) / number * (len(running) - number) / 60, row
