#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""The periodic impeller beside the whole one: processor seconds of the mesher, and the seconds of its regions, for the
same case with mesh.periodic_impeller true and false, in turn, on one rank. The least of a number of runs counts."""
import shutil
import tempfile
from pathlib import Path

from programs import execute, options_of
from runs import BIN, PAPER_CASE, record, seconds_by_step, stage_line, with_key

KEYS = {"periodic": "true", "whole": "false"}


def mesh(arguments, case, geometry):
    """One run in a fresh folder: processor seconds and the record."""
    with tempfile.TemporaryDirectory(prefix="cutwater-periodic-") as name:
        run = Path(name)
        shutil.copytree(geometry, run / "geometry")
        seconds = execute(arguments.bin / "cutwater-mesh", "--case", case, "--run", run, "--cells",
                          arguments.cells).processor
        return seconds, record(run)


def regions_seconds(domain):
    """Regions of a domain: seconds to make them, copies and files included."""
    return sum(region["seconds"] for region in domain["region_list"])


def main():
    arguments = options_of(__doc__, cells="1M", case=PAPER_CASE, bin=BIN, runs=3).parse_args()
    best = {}
    with tempfile.TemporaryDirectory(prefix="cutwater-periodic-") as name:
        folder = Path(name)
        execute(*stage_line(arguments.bin, "geometry", arguments.case, folder / "run"))
        for way, value in KEYS.items():
            text = with_key(arguments.case.read_text(), "mesh", "periodic_impeller", value)
            (folder / f"{way}.yaml").write_text(text)
        for _ in range(arguments.runs):
            for way in KEYS:
                seconds, made = mesh(arguments, folder / f"{way}.yaml", folder / "run/geometry")
                if way not in best or seconds < best[way][0]:
                    best[way] = seconds, made
    print("way         cells  CPU s   layers  rotor's regions  stator's regions  rotor's tetrahedra: least dihedral")
    for way, (seconds, made) in best.items():
        rotor, stator = made["results"]["domains"]
        print(f"{way:8s} {made['results']['cells']:9,d} {seconds:6.2f} {seconds_by_step(made)['layers']:8.2f} "
              f"{regions_seconds(rotor):16.2f} {regions_seconds(stator):17.2f} {rotor['least_dihedral_deg']:36.1f}")


if __name__ == "__main__":
    main()
