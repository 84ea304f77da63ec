# SPDX-License-Identifier: AGPL-3.0-or-later
"""What the function objects of an OpenFOAM case have reported so far (export/templates/openfoam/system/functions)."""

GRAVITY = 9.80665  # m/s2, standard


def files(case, name, file):
    """(first iteration, lines) of each file of a function object, those of later starts after the others. A second
    start from the same fields writes NAME_START.dat, for NAME.dat is there; a third writes it anew."""
    folder = case / "postProcessing" / name
    for start in sorted(folder.iterdir(), key=lambda path: float(path.name)) if folder.is_dir() else ():
        for path in (start / file, start / file.replace(".dat", f"_{start.name}.dat")):
            if path.exists():
                yield float(start.name), path.read_text().splitlines()


def words_of(lines):
    """(names of the columns, words) of each line. A line may be unfinished where the solver is at work."""
    names = []
    for text in lines:
        words = text.lstrip("# ").replace("(", " ").replace(")", " ").split()
        if text.startswith("#"):
            names = words
        elif words:
            yield names, words


def column(case, name, file, read):
    """By iteration what `read` makes of (names, words); lines that are still being written are left out, and what a
    solver reported that was stopped, behind the fields from which the next one has started."""
    found = {}
    for first, lines in files(case, name, file):
        found = {iteration: row for iteration, row in found.items() if iteration <= first}
        for names, words in words_of(lines):
            try:
                found[int(float(words[0]))] = read(names, words)
            except (ValueError, IndexError, KeyError):
                continue
    return found


def residuals(names, words):
    if len(words) != len(names):
        raise ValueError("unfinished")
    row = dict(zip(names, words))
    return {"residual_p": float(row["p_initial"]), "residual_u": max(float(row[f"U{axis}_initial"]) for axis in "xyz")}


def history(case):
    """By iteration: head (m), torque (N m), where they were reported the NPSH at which cavitation begins (m: total
    pressure at the inlet, 0, less the least pressure), and the initial residuals of p and of U (their greatest)."""
    heads = column(case, "head", "fieldValueDelta.dat", lambda names, words: {"head_m": float(words[1])})
    torques = column(case, "torque", "moment.dat", lambda names, words: {"torque_n_m": -float(words[3])})
    least = column(case, "leastPressure", "fieldMinMax.dat",
                   lambda names, words: {"npsh_inception_m": -float(words[1]) / GRAVITY})
    solver = column(case, "solverInfo", "solverInfo.dat", residuals)
    return {iteration: {**heads[iteration], **torques[iteration], **least.get(iteration, {}),
                        **solver.get(iteration, {})}
            for iteration in sorted(heads.keys() & torques.keys())}


def y_plus(case):
    """Least, mean and greatest y+ of each wall, of the last report."""
    rows = {}
    for _, lines in files(case, "yPlus", "yPlus.dat"):
        for _, words in words_of(lines):
            if len(words) >= 5:
                rows[words[1]] = {"least": float(words[2]), "most": float(words[3]), "mean": float(words[4])}
    return rows


def converged(case):
    """Whether the solver has ended by itself, with all residuals below residualControl of system/fvSolution."""
    log = case / "log.simpleFoam"
    last = log.read_text(errors="replace").rpartition("Starting time loop")[2] if log.exists() else ""
    return "SIMPLE solution converged" in last
