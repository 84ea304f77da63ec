# SPDX-License-Identifier: AGPL-3.0-or-later
"""Lines as SVG pictures: values over the number of cells, by powers of ten, or over the flow rate."""
import math

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 560, 300, 70, 50, 30, 24  # px of one chart, and its margins
COLOURS, MARK = ("#0b5c8a", "#d9822b", "#4f8f68", "#a8577a", "#6d63a8", "#7a6a55"), "#b3402e"
WORDS = 'font-family="sans-serif" font-size="12" fill="#334"'
LABEL = 48  # px between two numbers below the axis


def colour(k):
    """That of line k of a chart."""
    return COLOURS[k % len(COLOURS)]


def steps(least, most):
    """Round numbers from about `least` to `most`, 4 to 8 of them."""
    rough = (most - least) / 5
    power = 10.0**math.floor(math.log10(rough))
    step = min((factor * power for factor in (1, 2, 5, 10)), key=lambda step: abs(step - rough))
    first = math.floor(least / step)
    return [step * k for k in range(first, math.ceil(most / step) + 1)]


def count_text(cells):
    for unit, size in (("G", 1e9), ("M", 1e6), ("k", 1e3)):
        if cells >= size:
            return f"{cells / size:.3g} {unit}"
    return f"{cells:.0f}"


def numbers_below(places, bottom):
    """(px, words) below the axis; those that would lie on others are left out."""
    taken = -math.inf
    for x, words in sorted(set(places)):
        if x - taken >= LABEL:
            yield f'<text x="{x:.1f}" y="{bottom}" text-anchor="middle" {WORDS}>{words}</text>'
            taken = x


def lines(name, axis, series, marks, top):
    """One chart: a line with a point for each value of each of `series` [(x, values)]; marks: [(value, words)], broken
    lines across. `axis` is "cells", which are drawn by powers of ten, or what else x is."""
    scale, words_of = (math.log10, count_text) if axis == "cells" else (float, "{:.4g}".format)
    found = [value for _, values in series for value in values] + [value for value, _ in marks]
    least, most = min(found), max(found)
    margin = 0.1 * (most - least) or 0.01 * abs(most) or 1
    ticks = steps(least - margin, most + margin)
    places = [scale(x) for xs, _ in series for x in xs]
    margin = 0.1 if axis == "cells" else 0.05 * (max(places) - min(places)) or 1
    first, last = min(places) - margin, max(places) + margin

    def across(x):
        return LEFT + (WIDTH - LEFT - RIGHT) * (scale(x) - first) / (last - first)

    def up(value):
        return top + TOP + (HEIGHT - TOP - BOTTOM) * (ticks[-1] - value) / (ticks[-1] - ticks[0])

    yield f'<text x="{LEFT}" y="{top + 18}" {WORDS} font-weight="bold">{name}</text>'
    for tick in ticks:
        yield (f'<path d="M{LEFT} {up(tick):.1f}H{WIDTH - RIGHT}" stroke="#dde4ea"/>'
               f'<text x="{LEFT - 8}" y="{up(tick) + 4:.1f}" text-anchor="end" {WORDS}>{tick:.6g}</text>')
    for k, (value, words) in enumerate(marks):  # words at the left, then at the right: the lines may be one
        place = f'x="{WIDTH - RIGHT}" text-anchor="end"' if k else f'x="{LEFT + 6}"'
        yield (f'<path d="M{LEFT} {up(value):.1f}H{WIDTH - RIGHT}" stroke="{MARK}" stroke-dasharray="5 4"/>'
               f'<text {place} y="{up(value) - 5:.1f}" {WORDS}>{words}</text>')
    for k, (xs, values) in enumerate(series):
        points = [(across(x), up(value)) for x, value in zip(xs, values)]
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        yield f'<polyline fill="none" stroke="{colour(k)}" stroke-width="1.5" points="{line}"/>'
        yield from (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour(k)}"/>' for x, y in points)
    yield from numbers_below([(across(x), words_of(x)) for xs, _ in series for x in xs], top + HEIGHT - BOTTOM + 18)
    yield f'<text x="{WIDTH / 2}" y="{top + HEIGHT - 12}" text-anchor="middle" {WORDS}>{axis}</text>'


def chart(name, cells, values, marks, top):
    """One chart of a single line over the cells."""
    return lines(name, "cells", [(cells, values)], marks, top)


def svg(body, count=1):
    """A picture of so many charts, one below another."""
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT * count}" width="{WIDTH}" '
            f'height="{HEIGHT * count}">\n<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(body) +
            "\n</svg>\n")


def picture(charts):
    """The picture of charts [(name, cells, values, marks)], one below another."""
    return svg([line for k, one in enumerate(charts) for line in chart(*one, k * HEIGHT)], len(charts))
