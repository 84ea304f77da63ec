# SPDX-License-Identifier: AGPL-3.0-or-later
"""When a history has settled.

A quantity has settled when what is left of its way is less than a stated share of it; of a head the share is that of
the design head where that is larger, for at great flow rates the head goes through zero. What is left is estimated from
the means of the last three windows of iterations by Aitken's delta-squared process (A. C. Aitken, 1926): with the
changes d1, d2 from window to window and q = d2 / d1, d2 q / (1 - q) is left where 0 < q < 1; else, where the means go
to and fro, d2 counts. Windows of half the length tell of a slow way that the end of a quick one hides in the long
ones: the worse of both counts."""
import math
from typing import NamedTuple

WINDOW = 100  # iterations of one mean
FALLS = 0.9   # what falls comes in two windows to this share of its mean at most


class Rest(NamedTuple):
    """When a flow counts as settled."""
    within: float        # share of its way that a quantity may have left
    head_m: float = 0.0  # the design head


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


def ratio_of(means):
    """The last change of three means over the one before."""
    first, second = means[1] - means[0], means[2] - means[1]
    return second / first if first else 0.0


def left_of_way(means):
    """How far a quantity has still to go, from three means."""
    second, ratio = means[2] - means[1], ratio_of(means)
    if not 0 < ratio < 1:
        return abs(second)
    return abs(second * ratio / (1 - ratio))


def ways(table, rest):
    """For head and torque, and for windows of either length: (the length, the share of its way that is left, and the
    ratio of the last change to the one before); None before there are three windows of finite means."""
    found = []
    for key, least in (("head_m", rest.head_m), ("torque_n_m", 0)):
        for length in (WINDOW, WINDOW // 2):
            of_key = windows(table, key, length)
            if not of_key or not math.isfinite(sum(of_key[0])):
                return None
            means = of_key[0]
            left = left_of_way(means) / max(abs(means[-1]), least, 1e-300)
            found.append((length, left, ratio_of(means)))
    return found


def settled(table, rest):
    """(whether head and torque have settled, share of its way that either has left at the most)."""
    worst = max(left for _, left, _ in ways(table, rest) or [(0, math.inf, 0)])
    return worst <= rest.within, worst


def iterations_left(table, rest):
    """Iterations until head and torque have settled if they go on at the rate of their last windows, which multiplies
    what is left by the ratio of the changes; None where one has no such rate yet."""
    most = 0.0
    for length, left, ratio in ways(table, rest) or [(0, math.inf, 0)]:
        if left <= rest.within:
            continue
        if not 0 < ratio < 1:
            return None
        most = max(most, length * math.log(rest.within / left) / math.log(ratio))
    return most


def falls(table, key):
    """Whether the mean of what the iterations have of table[iteration][key] has fallen from each of the last three
    windows to the next, and by a tenth in all; None before there are three."""
    found = windows({iteration: row for iteration, row in table.items() if key in row}, key)
    if not found:
        return None
    first, before, last = found[0]
    return first > before > last and last < FALLS * first
