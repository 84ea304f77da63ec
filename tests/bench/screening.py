# SPDX-License-Identifier: AGPL-3.0-or-later
"""Screening designs: many factors of two levels, all changed at once, each main effect estimated from all runs.

R. Plackett, J. Burman, 1946: the columns of a Hadamard matrix but its first are balanced, and orthogonal to one
another. With the same runs at the opposite levels (G. Box, K. Wilson, 1951: fold-over) main effects are also orthogonal
to the interactions of two factors: the mean of the effects of a design and of its opposite. Columns to which no factor
belongs estimate nothing but noise and higher interactions: their root mean square is the standard error of an
effect."""
import math

DUMMIES_LEAST = 8  # columns without a factor: the standard error is known within 25 % (1 / sqrt(2 * 8))


def paley_order(least):
    """The least n >= `least` for which n - 1 is a prime and n a multiple of 4."""
    def is_prime(number):
        return number > 1 and all(number % k for k in range(2, math.isqrt(number) + 1))

    order = 4 * math.ceil(least / 4)
    while not is_prime(order - 1):
        order += 4
    return order


def design(factors):
    """Rows of -1 and 1, one a run. Column k is factor k; those past `factors` are dummies.

    R. Paley, 1933: with q a prime, q = 3 modulo 4, row i of the matrix has 1 where j - i is a square modulo q."""
    prime = paley_order(factors + 1 + DUMMIES_LEAST) - 1
    squares = {k * k % prime for k in range(1, prime)}
    return [[1 if (j - i) % prime in squares else -1 for j in range(prime)] for i in range(prime)] + [[1] * prime]


def opposite(rows):
    return [[-level for level in row] for row in rows]


def effects(rows, responses):
    """Mean response of the runs at 1 less that of those at -1, for each column."""
    half = len(rows) / 2
    return [sum(row[k] * value for row, value in zip(rows, responses)) / half for k in range(len(rows[0]))]


def standard_error(dummy_effects):
    return math.sqrt(sum(effect**2 for effect in dummy_effects) / len(dummy_effects))
