# SPDX-License-Identifier: AGPL-3.0-or-later
"""The account of a run with more cells, from those of two runs on one rank: each step's seconds and bytes grow with the
power of the cells that they had between the two, 0 to 1, and its tasks with them, so that there are as many."""
import copy
import math

TASKS = " (tasks)"


def accounts(results):
    """All accounts of a record: of all ranks together, and of each domain."""
    return [results["together"], *(side for step in results["side_by_side"] for side in step["side"])]


def sums(results):
    """Seconds and bytes by name of part or step, over the run."""
    found = {}
    for account in accounts(results):
        for part in account["every_rank"]:
            found[part["part"]] = found.get(part["part"], 0) + part["seconds"]
        for step in account["tasks"]:
            for name, value in ((step["step"] + TASKS, sum(step["task_seconds"])), (step["step"], step["bytes"])):
                found[TASKS, name] = found.get((TASKS, name), 0) + value
    return found


def growth(small, large, ratio, factor):
    """By how much more what was `small` and, with `ratio` times the cells, `large`, is with `factor` times these."""
    power = math.log(large / small) / math.log(ratio) if small > 0 and large > 0 else 0
    return factor ** min(max(power, 0), 1)


def growths(small, large, ratio, factor):
    """The same by name, of sums."""
    return {name: growth(small.get(name, 0), value, ratio, factor) for name, value in large.items()}


def with_cells(small, large, cells):
    """The results of a run with so many cells, from those of two runs."""
    factor = cells / large["cells"]
    by = growths(sums(small), sums(large), large["cells"] / small["cells"], factor)
    made = copy.deepcopy(large)
    made["cells"] = cells
    for account in accounts(made):
        for part in account["every_rank"]:
            part["seconds"] *= by[part["part"]]
        for step in account["tasks"]:
            step["task_seconds"] = [by[TASKS, step["step"] + TASKS] * value for value in step["task_seconds"]]
            step["bytes"] *= by[TASKS, step["step"]]
    return made
