# SPDX-License-Identifier: AGPL-3.0-or-later
"""When a history has settled.

A quantity has settled when what is left of its way is less than a stated share of it. What is left is estimated from
the means of the last three windows of iterations by Aitken's delta-squared process (A. C. Aitken, 1926): with the
changes d1, d2 from window to window and q = d2 / d1, d2 q / (1 - q) is left where 0 < q < 1; else, where the means go
to and fro, d2 counts. Windows of half the length tell of a slow way that the end of a quick one hides in the long
ones: the worse of both counts."""
import math

WINDOW = 100  # iterations of one mean


def windows(table, key, length=WINDOW):
    """Means of the last three windows of table[iteration][key], oldest first, and the scatter (half the range) of the
    last; None before there are three of WINDOW."""
    iterations = sorted(table)
    if not iterations or iterations[-1] - iterations[0] < 3 * WINDOW:
        return None
    last, means = iterations[-1], []
    for back in (2, 1, 0):
        part = [table[i][key] for i in iterations if last - (back + 1) * length < i <= last - back * length]
        if not part:
            return None
        means.append(sum(part) / len(part))
    return means, (max(part) - min(part)) / 2


def last_mean(table, key):
    """Mean over the last window of what its iterations have of table[iteration][key]; None where none has it."""
    part = [row[key] for iteration, row in table.items() if iteration > max(table) - WINDOW and key in row]
    return sum(part) / len(part) if part else None


def left_of_way(means):
    """How far a quantity has still to go, from three means."""
    first, second = means[1] - means[0], means[2] - means[1]
    ratio = second / first if first else 0.0
    if not 0 < ratio < 1:
        return abs(second)
    return abs(second * ratio / (1 - ratio))


def settled(table, within):
    """(whether head and torque have settled, share of its way that either has left at the most)."""
    worst = 0.0
    for key in ("head_m", "torque_n_m"):
        for length in (WINDOW, WINDOW // 2):
            found = windows(table, key, length)
            share = left_of_way(found[0]) / max(abs(found[0][-1]), 1e-300) if found else math.inf
            if not math.isfinite(share):
                return False, math.inf
            worst = max(worst, share)
    return worst <= within, worst
