# SPDX-License-Identifier: AGPL-3.0-or-later
"""What each tuned number of the mesher is worth: every one is made smaller and greater, and the pump meshed again.

policy.py --bin BUILD/bin [--cells 300k] [--case CASE] [--by 1.25] [NAME ...]

BUILD is configured with -DCUTWATER_EXPERIMENT=ON. A row tells the number, its value, and what comes of value / BY and
value * BY, each as the difference to the pump as it is: mean aspect, least dihedral angle in degrees, tetrahedra in
percent, processor seconds in percent. Without names all numbers of fill_policy.h take their turn."""
import json
import re
import sys
import tempfile
from pathlib import Path

import programs


def numbers():
    """name: (type, value, unit, meaning) as mesher/fill/fill_policy.h lists them."""
    text = (programs.SOURCE / "mesher/fill/fill_policy.h").read_text().replace("\\\n", "")
    text = re.sub(r'"\s*"', "", text)
    row = r'X\((\w+), (\w+), ([-\d.e]+), "([^"]*)",\s*"([^"]*)"\)'
    return {name: (kind, float(value), unit, meaning) for kind, name, value, unit, meaning in re.findall(row, text)}


def mesh(options, folder, change=None):
    """Aspect, angle, tetrahedra and processor seconds of the pump with one number changed."""
    if change:
        (folder / "policy").write_text(f"{change[0]} {change[1]:.17g}\n")
        programs.ENVIRONMENT["CUTWATER_POLICY"] = str(folder / "policy")
    run = programs.execute(*programs.MPIRUN, 1, options.bin / "cutwater-mesh", "--case", options.case, "--run", folder,
                           "--cells", options.cells, check=False)
    programs.ENVIRONMENT.pop("CUTWATER_POLICY", None)
    if run.status:
        return None
    domains = json.loads((folder / "mesh/record.json").read_text())["results"]["domains"]
    tets = sum(domain["tetrahedra"] for domain in domains)
    aspect = sum(domain["tetrahedra"] * domain["tetrahedron_aspect_mean"] for domain in domains) / tets
    return aspect, min(domain["least_dihedral_deg"] for domain in domains), tets, run.processor


def difference(usual, got):
    return (f"aspect {got[0] - usual[0]:+.4f}, {got[1] - usual[1]:+.2f} degrees, "
            f"{100 * (got[2] / usual[2] - 1):+.2f} % tetrahedra, {100 * (got[3] / usual[3] - 1):+.1f} % time")


def main():
    parser = programs.options_of(__doc__, "300k")
    parser.add_argument("--by", type=float, default=1.25)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    listed = numbers()
    unknown = set(options.names) - set(listed)
    if unknown:
        sys.exit(f"policy.py: no number {min(unknown)}; there are {', '.join(listed)}")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        programs.execute(options.bin / "cutwater-geometry", "--case", options.case, "--run", folder)
        usual = mesh(options, folder)
        print(f"as it is: aspect {usual[0]:.4f}, {usual[1]:.2f} degrees, {usual[2]} tetrahedra, {usual[3]:.1f} s")
        for name in options.names or listed:
            kind, value, unit, meaning = listed[name]
            print(f"{name} = {value:g} ({unit}): {meaning}")
            for other in (value / options.by, value * options.by):
                if kind == "int32_t":
                    step = 1 if other > value else -1
                    other = max(1, round(other) if round(other) != value else value + step)
                got = mesh(options, folder, (name, other))
                print(f"  {other:10.5g}  {difference(usual, got) if got else 'fails'}", flush=True)


if __name__ == "__main__":
    main()
