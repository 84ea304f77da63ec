#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""The periodic impeller beside the whole one: processor seconds of the mesher, and the seconds of its regions, for the
same case with mesh.periodic_impeller true and false, in turn, on one rank. The least of a number of runs counts."""

import argparse
import json
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
KEYS = {"periodic": "true", "whole": "false"}


def with_key(text, value):
    """The text of a case with mesh.periodic_impeller set."""
    text = re.sub(r"(?m)^  periodic_impeller:.*\n", "", text)
    if re.search(r"(?m)^mesh:", text):
        return re.sub(r"(?m)^mesh:.*\n", f"mesh:\n  periodic_impeller: {value}\n", text)
    return text + f"\nmesh:\n  periodic_impeller: {value}\n"


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def mesh(arguments, case, geometry):
    """One run in a fresh folder: processor seconds and the record."""
    with tempfile.TemporaryDirectory(prefix="cutwater-periodic-") as run:
        shutil.copytree(geometry, pathlib.Path(run) / "geometry")
        begun = processor_seconds()
        subprocess.run([arguments.bin / "cutwater-mesh", "--case", case, "--run", run, "--cells", arguments.cells],
                       check=True, stderr=subprocess.DEVNULL)
        return processor_seconds() - begun, json.loads((pathlib.Path(run) / "mesh/record.json").read_text())


def rotor_seconds(record):
    """Regions of the rotor: seconds to make them, copies and files included."""
    return sum(region["seconds"] for region in record["results"]["domains"][0]["region_list"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", default="1M")
    parser.add_argument("--case", type=pathlib.Path, default=SOURCE / "cases/paper/case.yaml")
    parser.add_argument("--bin", type=pathlib.Path, default=SOURCE / "build/bin")
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    best = {}
    with tempfile.TemporaryDirectory(prefix="cutwater-periodic-") as folder:
        folder = pathlib.Path(folder)
        subprocess.run([arguments.bin / "cutwater-geometry", "--case", arguments.case, "--run", folder / "run"],
                       check=True, stderr=subprocess.DEVNULL)
        for way, value in KEYS.items():
            (folder / f"{way}.yaml").write_text(with_key(arguments.case.read_text(), value))
        for _ in range(arguments.runs):
            for way in KEYS:
                seconds, record = mesh(arguments, folder / f"{way}.yaml", folder / "run/geometry")
                if way not in best or seconds < best[way][0]:
                    best[way] = seconds, record
    print("way         cells  CPU s   layers  rotor's regions  stator's regions  rotor's tetrahedra: least dihedral")
    for way, (seconds, record) in best.items():
        steps = {}
        for step in record["steps"]:
            steps[step["name"]] = steps.get(step["name"], 0) + step["seconds"]
        rotor, stator = record["results"]["domains"]
        print(f"{way:8s} {record['results']['cells']:9,d} {seconds:6.2f} {steps['layers']:8.2f} "
              f"{rotor_seconds(record):16.2f} {sum(region['seconds'] for region in stator['region_list']):17.2f}"
              f" {rotor['least_dihedral_deg']:36.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
