#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""verify.py [PART ...] [--runs runs/verify] [--small]

Holds solved flow against what others published, and writes docs/verification.md with its pictures. Each part is a
section of the page; parts that are not named stay, and those of older sources are marked (page.py). All take
some hours on two cores; a call that was killed goes on where it was. --small takes tiny meshes and ends early, to try
the program: its page goes to the folder of runs.

  heads       the head over the number of cells (figure 4 of the paper), with Celik's index
  readings    which entry of the paper's Table 3 decides about the head
  walls       y+ of a mesh that resolves the walls (figure 5)
  velocities  relative velocity at 0.8, 1 and 1.2 times the design flow, from the large eddy simulation (figure 7)
  solvers     OpenFOAM and code_saturne on one mesh
  ubaldi      a pump that was measured: ERCOFTAC's test case U3"""
import csv
import json
import math
import re
import shutil
import sys
from collections import namedtuple

import foam_read
from page import Page, stamp
from programs import SOURCE, execute, options_of
from runs import BIN, record, save_picture, stage_line, with_key

CAD, RULES = SOURCE / "tests/cad", SOURCE / "tests/bench/verify.mk"
sys.path.insert(0, str(CAD))
import u3  # noqa: E402  (tests/cad/u3.py)

RATED_HEAD = 10           # m, of the paper's pump
SHARES = (0.8, 1, 1.2)    # of the design flow, as in the paper
LIMITS = (1, 3, 5)        # of y+, as in the paper
Sizes = namedtuple("Sizes", "heads readings walls velocities solvers ubaldi iterations transient_turns les_turns")
FULL = Sizes(("150k", "300k", "600k", "1200k", "2400k"), 300000, 1500000, 200000, 300000, 600000, 4000, 2, 1)
SMALL = Sizes(("40k", "60k", "90k"), 40000, 60000, 40000, 60000, 80000, 100, 1 / 36, 1 / 36)


class Bench:
    """Cases of this bench, in its folder, and their runs by the rules of cases/Makefile: what is done stays, what is of
    another case or of other programs is made anew."""

    def __init__(self, options):
        folder, self.sizes = options.runs.resolve(), SMALL if options.small else FULL
        self.folder, self.cases, self.runs = folder, folder / "cases", folder / "runs"
        self.docs = folder if options.small else SOURCE / "docs"

    def case(self, name, text):
        """Writes a case where it is another one; the folder of its run."""
        case = self.cases / name / "case.yaml"
        case.parent.mkdir(parents=True, exist_ok=True)
        if not case.exists() or case.read_text() != text:
            case.write_text(text)
        return self.runs / name

    def say(self, run, what):
        print(f"verify: {run.name}: {what}", file=sys.stderr, flush=True)

    def make(self, run, end, **variables):
        """Calls make for RUN-END, with its variables; what it says."""
        self.say(run, end)
        return execute("env", "-u", "MAKEFLAGS", "-u", "MAKELEVEL", "make", "-C", self.folder, "-f", RULES,
                       f"{run.name}-{end}", f"BUILD={SOURCE}/build", f"MOST={self.sizes.iterations}",
                       *(f"{name}={value}" for name, value in variables.items())).text

    def solved(self, run, cells, end="solve"):
        """Meshes the run and solves its steady flow; what the flow came to."""
        self.make(run, end, CELLS=cells)
        return record(run, "solve")["results"]

    def picture(self, run, title, name):
        """A picture of the run's report, beside the page; how the page shows it."""
        save_picture(run, title, self.docs / f"verification-{name}.png")
        return f"![{title}](verification-{name}.png)"


def is_newer(made, *sources):
    """As make has it: what was made is there, and none of its sources changed after."""
    return made.exists() and all(made.stat().st_mtime >= source.stat().st_mtime for source in sources)


def design(run):
    return json.loads((run / "geometry/design.json").read_text())


def table(names, rows):
    return "\n".join("| " + " | ".join(str(word) for word in row) + " |"
                     for row in [names, ["---"] * len(names), *rows])


def case_text(name, **changes):
    """The text of cases/NAME with other values of some keys; one that is not there goes into operating_point."""
    text = (SOURCE / "cases" / name / "case.yaml").read_text()
    for key, value in changes.items():
        text = with_key(text, "operating_point", key, value)
    return text


def settled_word(result):
    return "settled" if result["settled"] else "NOT settled"


# ---- the parts: each prints nothing and returns its section


def heads(bench):
    """The paper's head rises with the cells, is within 5 % of the tested one at 8 million and changes by less than 1 %
    from 16 million on; its figure has no numbers."""
    run = bench.case("heads", case_text("paper", test_head_m=RATED_HEAD))
    told = bench.make(run, "sweep", SWEEP=" ".join(bench.sizes.heads), SOLVE=1)
    rows = []
    for cells in bench.sizes.heads:
        result = record(bench.runs / f"heads-{cells}", "solve")["results"]
        rows.append((f"{result['cells']:,}", f"{result['head_m']:.3f}", f"{result['head_scatter_m'] or 0:.2g}",
                     f"{result['torque_n_m']:.3f}", result["iterations"], settled_word(result),
                     f"{result['residual_p']:.1e}"))
    shutil.copy(bench.runs / "heads-sweep.svg", bench.docs / "verification-heads.svg")
    index = [line for line in told.splitlines() if "grid convergence index" in line or "monotonously" in line]
    return "\n".join([table(("cells", "head, m", "scatter, m", "torque, N m", "iterations", "", "residual of p"), rows),
                      "", "![Head, torque and efficiency over the cells](verification-heads.svg)", "",
                      "The three finest, by Celik's method:", "", "```", *index, "```"])


def root(of, low, high):
    """Where the increasing or decreasing of() is 0, by halving; None where it has one sign at both ends."""
    at_low = of(low)
    if at_low * of(high) > 0:
        return None
    for _ in range(7):
        middle = (low + high) / 2
        value = of(middle)
        low, high, at_low = (low, middle, at_low) if at_low * value < 0 else (middle, high, value)
    return (low + high) / 2


def readings(bench):
    """Table 3 is over-determined: what each of its entries would have to be for the rated head."""
    entries = {"wrap_angle_deg": (71, 150), "outlet_diameter_mm": (170, 200), "outlet_width_mm": (3, 8),
               "blade_count": (2, 6)}

    def predicted(key, value):
        value = round(value) if key == "blade_count" else round(value, 2)
        more = {"base_diameter_mm": round(1.02 * value, 2)} if key == "outlet_diameter_mm" else {}
        run = bench.case(f"readings-{key}-{value}", case_text("paper", **{key: value}, **more))
        bench.make(run, "faces")
        return design(run)["predicted_head_m"] - RATED_HEAD

    rows = []
    for key, (low, high) in entries.items():
        asked = re.search(rf"(?m)^  {key}: (\S+)", case_text("paper"))[1]
        found = root(lambda value, key=key: predicted(key, value), low, high)
        rows.append((f"`{key}`", asked, "none" if found is None else f"{found:.3g}",
                     "-" if found is None else f"{100 * (found / float(asked) - 1):+.0f} %"))
    solved = []
    for name, text in (("as it stands (`priority: wrap`)", case_text("paper")),
                       ("the head first (`priority: head`)", case_text("paper", priority="head"))):
        run = bench.case(f"readings-{'head' if 'head first' in name else 'wrap'}", text)
        result, made = bench.solved(run, bench.sizes.readings), design(run)
        solved.append((name, f"{made['wrap_angle_deg']:.1f}", f"{made['outlet_blade_angle_deg']:.1f}",
                       f"{made['predicted_head_m']:.2f}", f"{result['head_m']:.2f}", settled_word(result)))
    return "\n".join(["The head that the hydraulic design predicts is the rated one of 10 m with one entry changed to:",
                      "", table(("entry of Table 3", "there", "for 10 m", "change"), rows), "",
                      f"Solved on {bench.sizes.readings:,} cells:", "",
                      table(("Table 3", "wrap, degrees", "beta2, degrees", "predicted head, m", "solved head, m", ""),
                            solved)])


def walls(bench):
    """In the paper's mesh L y+ is mostly within 3 on hub and shroud, and within 1 on the blades."""
    run = bench.case("walls", case_text("paper-l"))
    result = bench.solved(run, bench.sizes.walls)
    case = run / "solve/steady"
    areas, y_plus = foam_read.patch_areas(case), foam_read.patch_values(foam_read.latest(case) / "yPlus")
    rows = []
    for patch in ("hub", "shroud", "blade_pressure", "blade_suction", "blade_leading_edge", "blade_trailing_edge"):
        pairs = list(zip(y_plus[patch], areas[patch]))
        whole = sum(area for _, area in pairs)
        rows.append((patch, f"{sum(y * area for y, area in pairs) / whole:.2f}",
                     *(f"{100 * sum(area for y, area in pairs if y <= limit) / whole:.1f} %" for limit in LIMITS)))
    return "\n".join([f"The case `paper-l` with {result['cells']:,} cells; {settled_word(result)} after "
                      f"{result['iterations']} iterations.", "",
                      table(("wall", "mean y+", *(f"area with y+ up to {limit}" for limit in LIMITS)), rows), "",
                      bench.picture(run, "y+, rotor obliquely", "walls")])


def velocities(bench):
    """The paper compares with particle images, which are not published as numbers: only the pictures can be compared.
    Mesh and cells are as the machine allows."""
    cells, lines = bench.sizes.velocities, []
    run = bench.case("velocities", f"{case_text('paper')}\noperating_points:\n  flow_shares: {list(SHARES)}\n")
    bench.solved(run, cells, "curve")
    for share in SHARES:
        flow = bench.runs / f"velocities-{share:g}"
        eddies(bench, run, flow, share)
        execute(*stage_line(BIN, "report", bench.cases / "velocities/case.yaml", flow, cells, 2))
        lines += [f"{share:g} Q:", "", bench.picture(flow, "Relative velocity at mid-span",
                                                     f"velocities-{round(1000 * share):04d}"), ""]
    return "\n".join([f"{record(run, 'export')['results']['cells']:,} cells; k-omega SST for "
                      f"{bench.sizes.transient_turns:g} turns, then Smagorinsky's model for {bench.sizes.les_turns:g}.",
                      "", *lines])


def eddies(bench, run, flow, share):
    """The run `flow`: the mesh of `run`, with the fields at the end of the large eddy simulation at a share of the
    flow, when the rotor stands where it was meshed."""
    name = f"q{round(1000 * share):04d}"
    steady = run / ("solve/steady" if share == 1 else f"solve/points/{name}")
    case = flow / "export/openfoam"
    done = flow / "done"
    if is_newer(done, run / "export/record.json"):
        return
    shutil.rmtree(flow, ignore_errors=True)
    flow.mkdir()
    for stage in ("geometry", "mesh", "log"):
        (flow / stage).symlink_to(run / stage)
    shutil.copytree(run / "export", flow / "export", symlinks=True, ignore=shutil.ignore_patterns("polyMesh", "points"))
    (case / "constant/polyMesh").symlink_to(run / "export/openfoam/constant/polyMesh")
    latest = foam_read.latest(steady)
    shutil.copytree(latest, case / latest.name)
    exported = (run / "export/openfoam/points" / name / "0/U").read_text()
    asked = re.search(r"volumetricFlowRate constant \S+;", exported)[0]
    turn = 60 / 1450
    for part, turns in (("transient", bench.sizes.transient_turns), ("les", bench.sizes.les_turns)):
        for file, pattern, put in ((f"{part}/0/U", r"volumetricFlowRate constant \S+;", asked),
                                   (f"{part}/system/controlDict", r"(?m)^endTime .*",
                                    f"endTime {turns * turn:.10g};"),
                                   (f"{part}/system/controlDict", r"(?m)^writeInterval .*",  # so that it writes its end
                                    f"writeInterval {math.gcd(90, round(360 * turns))};")):
            path = case / file
            path.write_text(re.sub(pattern, put, path.read_text()))
        if part == "les":
            script = case / "les/Allrun"
            script.write_text(re.sub(r"\$turns \* \S+", f"$turns * {turns * turn:.10g}", script.read_text()))
        bench.say(flow, part)
        execute(case / part / "Allrun", 2, *([1] if part == "les" else []), folder=case / part)
    end, put = foam_read.latest(case / "les"), flow / "solve/steady/1"
    put.mkdir(parents=True)
    for field in ("U", "p", "yPlus"):
        shutil.copy(end / field, put / field)
    shutil.copy(run / "solve/record.json", flow / "solve/record.json")  # without it the report shows no flow
    done.touch()


def upwind(bench, run):
    """Head and torque of OpenFOAM's case with the velocity upwind, as code_saturne's has it, from the settled flow on;
    means of the last iterations, and how many there were."""
    case, iterations = run / "solve/upwind", min(bench.sizes.iterations, 600)
    shutil.rmtree(case, ignore_errors=True)
    start = foam_read.latest(run / "solve/steady")
    for part in ("constant", "system", start.name):
        shutil.copytree(run / "solve/steady" / part, case / part, symlinks=True)
    for name, pattern, put in (("fvSchemes", r"div\(phi,U\).*", "div(phi,U) bounded Gauss upwind;"),
                               ("controlDict", r"(?m)^endTime .*", f"endTime {int(start.name) + iterations};"),
                               ("fvSolution", r"(?s)residualControl\s*\{.*?\}", "residualControl { }")):
        path = case / "system" / name
        path.write_text(re.sub(pattern, put, path.read_text()))
    bench.say(run, "upwind")
    text = execute("simpleFoam", folder=case).text
    heads = re.findall(r"subtract\(weightedAverage\(outlet,totalHead\),.*?\) = (\S+)", text)[-10:]
    torques = re.findall(r"Sum of moments\s*\n\s*Total\s*: \(\S+ \S+ (\S+)\)", text)[-10:]
    return sum(map(float, heads)) / len(heads), -sum(map(float, torques)) / len(torques), iterations


def solvers(bench):
    """Both with a frozen rotor, the k-epsilon model and wall functions. code_saturne's case has the velocity upwind: by
    second order its flow does not come to rest."""
    text = case_text("paper") + "\nexport: {formats: [openfoam, code_saturne]}\n"
    run = bench.case("solvers", text)
    mine = bench.solved(run, bench.sizes.solvers)
    other = run / "export/code_saturne"
    if not is_newer(other / "head.csv", run / "export/record.json"):
        numbers = other / "SRC/pump.h"
        numbers.write_text(re.sub(r"PUMP_ITERATIONS \d+", f"PUMP_ITERATIONS {min(bench.sizes.iterations, 600)}",
                                  numbers.read_text()))
        bench.say(run, "code_saturne")
        execute(other / "run", 1, folder=other)
    with open(other / "head.csv", encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-100:]
    flows = {"OpenFOAM": (mine["head_m"], mine["torque_n_m"], mine["iterations"]),
             "OpenFOAM, upwind": upwind(bench, run),
             "code_saturne": (*(sum(float(row[key]) for row in last) / len(last) for key in ("head_m", "torque_n_m")),
                              last[-1]["iteration"])}
    head, torque, _ = flows["code_saturne"]
    rows = [(name, f"{of[0]:.3f}", f"{100 * (head / of[0] - 1):+.1f} %", f"{of[1]:.4f}",
             f"{100 * (torque / of[1] - 1):+.1f} %", of[2]) for name, of in flows.items()]
    return "\n".join([f"{mine['cells']:,} cells.", "",
                      table(("solver", "head, m", "code_saturne's from it", "torque, N m", "code_saturne's from it",
                             "iterations"), rows)])


# ERCOFTAC's test case U3 (tests/cad/ubaldi.py names its sources). Velocities are means of the files crcu0 to crcu3 over
# two passages, and from 0.05 to 0.95 of the width; pressures are those of cp.dat over the circumference: R / R2, and
# 2 (p - pt0) / (rho U2^2).
U3_RING = 1.02  # R / R2 where velocities were measured
U3_RADIAL, U3_TANGENTIAL = 0.131, 0.382  # velocities over U2
U3_PRESSURE = ((0.53333, -0.024), (0.59524, -0.017), (0.66667, 0.093), (0.7381, 0.230), (0.78571, 0.286),
               (0.83333, 0.361), (0.88095, 0.455), (0.92857, 0.511), (0.97619, 0.571), (1.01905, 0.584))
SAMPLING = """functions
{
    sampled
    {
        type surfaces; libs (sampling); writeControl writeTime; surfaceFormat vtk;
        formatOptions { vtk { legacy true; format ascii; } }
        fields (U p); interpolationScheme cell;
        surfaces
        (
            ring { type distanceSurface; distance 0; signed true; surfaceType searchableCylinder;
                   point1 (0 0 -0.001); point2 (0 0 0.05); radius @radius@; }
            casing { type patch; patches (casing); interpolate false; }
        );
    }
}
"""


def ubaldi(bench):
    """Measured in air; the flow with a frozen rotor stands for the mean over all positions of the wheel."""
    case, run = bench.cases / "ubaldi", bench.runs / "ubaldi"
    if not is_newer(case / "case.yaml", *(CAD / f"{name}.py" for name in ("draw", "u3", "ubaldi"))):
        execute("/usr/bin/python3", CAD / "ubaldi.py", case)
    result = bench.solved(run, bench.sizes.ubaldi)
    case = run / "solve/steady"
    control = (case / "system/controlDict").read_text()
    (case / "system/controlDict").write_text(control[:control.index("functions")] +
                                             SAMPLING.replace("@radius@", str(U3_RING * u3.RADIUS)))
    execute("simpleFoam", "-postProcess", "-latestTime", folder=case)
    (case / "system/controlDict").write_text(control)
    sampled = foam_read.latest(case / "postProcessing/sampled")
    means = foam_read.ring_means(sampled / "ring.vtk", 0.05e-3 * u3.WIDTH, 0.95e-3 * u3.WIDTH)
    radial, tangential = (speed / u3.TIP_SPEED for speed in means)
    head = 2 * 9.80665 * result["head_m"] / u3.TIP_SPEED**2

    def angle(radial, tangential):
        return f"{math.degrees(math.atan2(U3_RING - tangential, radial)):.1f}"

    rows = [("head coefficient, 2 g H / U2^2", u3.HEAD_COEFFICIENT, f"{head:.3f}"),
            ("radial velocity / U2 at 1.02 R2", U3_RADIAL, f"{radial:.3f}"),
            ("tangential velocity / U2 there", U3_TANGENTIAL, f"{tangential:.3f}"),
            ("relative flow angle there, degrees from the radius", angle(U3_RADIAL, U3_TANGENTIAL),
             angle(radial, tangential))]
    pressure = foam_read.radial_means(sampled / "casing.vtk", [r * u3.RADIUS for r, _ in U3_PRESSURE])
    places = [(f"{r:.3f}", f"{measured:.3f}", f"{2 * p / u3.TIP_SPEED**2:.3f}")
              for (r, measured), p in zip(U3_PRESSURE, pressure) if not math.isnan(p)]
    return "\n".join([f"{result['cells']:,} cells; {settled_word(result)} after {result['iterations']} iterations.", "",
                      table(("", "measured", "solved"), rows), "",
                      "Static pressure on the casing, 2 (p - pt0) / (rho U2^2), mean over the circumference:", "",
                      table(("R / R2", "measured", "solved"), places)])


PARTS = {"heads": ("The head over the number of cells", heads), "readings": ("What decides about the head", readings),
         "walls": ("y+ of resolved walls", walls), "velocities": ("Relative velocity in the impeller", velocities),
         "solvers": ("Two solvers", solvers), "ubaldi": ("A pump that was measured", ubaldi)}


HEAD = """<!-- SPDX-License-Identifier: AGPL-3.0-or-later -->
<!-- Made by tests/bench/verify.py (`make verify`): change that, not this page. -->
# Verification

Solved flows beside what others published. "The paper" is that of the README; its section 4 has the figures.
"""


def main():
    parser = options_of(__doc__, runs=SOURCE / "runs/verify", small=False)
    parser.add_argument("parts", nargs="*", metavar="PART")
    options = parser.parse_args()
    unknown = set(options.parts) - set(PARTS)
    if unknown:
        sys.exit(f"verify: no part is called '{min(unknown)}'; allowed: {', '.join(PARTS)}")
    bench = Bench(options)
    bench.runs.mkdir(parents=True, exist_ok=True)
    page = Page(bench.docs / "verification.md", HEAD, {name: f"tests/bench/verify.py {name}" for name in PARTS},
                'make verify PARTS="..."')
    for name in options.parts or PARTS:
        title, part = PARTS[name]
        text = part(bench)
        page.write({name: page.section(name, title, " ".join(part.__doc__.split()), text,
                                       f"{stamp(page.commands[name])}.")})


if __name__ == "__main__":
    main()
