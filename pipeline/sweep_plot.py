# SPDX-License-Identifier: AGPL-3.0-or-later
"""Values over the number of cells as an SVG picture: one chart for each quantity, cells by powers of ten."""
import math

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 560, 300, 70, 50, 30, 24  # px of one chart, and its margins
LINE, MARK, WORDS = "#0b5c8a", "#b3402e", 'font-family="sans-serif" font-size="12" fill="#334"'


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


def chart(name, cells, values, marks, top):
    """One chart: a point for each of `cells`; marks: [(value, words)], broken lines across."""
    found = [value for value in values] + [value for value, _ in marks]
    least, most = min(found), max(found)
    margin = 0.1 * (most - least) or 0.01 * abs(most) or 1
    ticks = steps(least - margin, most + margin)
    first, last = math.log10(min(cells)) - 0.1, math.log10(max(cells)) + 0.1

    def across(count):
        return LEFT + (WIDTH - LEFT - RIGHT) * (math.log10(count) - first) / (last - first)

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
    points = [(across(count), up(value)) for count, value in zip(cells, values)]
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    yield f'<polyline fill="none" stroke="{LINE}" stroke-width="1.5" points="{line}"/>'
    below = top + HEIGHT - BOTTOM + 18
    for (x, y), count in zip(points, cells):
        yield (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{LINE}"/>'
               f'<text x="{x:.1f}" y="{below}" text-anchor="middle" {WORDS}>{count_text(count)}</text>')
    yield f'<text x="{WIDTH / 2}" y="{top + HEIGHT - 12}" text-anchor="middle" {WORDS}>cells</text>'


def picture(charts):
    """The picture of charts [(name, cells, values, marks)], one below another."""
    body = [line for k, one in enumerate(charts) for line in chart(*one, k * HEIGHT)]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT * len(charts)}">\n'
            '<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(body) + "\n</svg>\n")
