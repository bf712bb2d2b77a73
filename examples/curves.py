"""Curves as SVG, for the studies' pages."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests/bench/peers"))
from plots import INK, PALE, line, svg, text  # noqa: E402

COLOURS = ("#c2410c", "#1d4ed8", "#15803d", "#7c3aed", "#475569")


def ticks(low, high):
    """Round numbers within, some five to ten of them."""
    step = 10 ** math.floor(math.log10((high - low) / 5))
    step *= next(s for s in (1, 2, 5, 10) if (high - low) / (s * step) <= 10)
    first = math.ceil(low / step - 1e-9)
    return [step * i for i in range(first, math.floor(high / step + 1e-9) + 1)]


def decades(low, high):
    """1, 2 and 5 times the powers of ten within."""
    found = [digit * 10 ** power for power in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for digit in (1, 2, 5)]
    return [value for value in found if low <= value <= high]


def curves(title, x_title, y_title, series, x_range, y_range, log=False, dots=True):
    """`series`: name -> [(x, y), ...]. `log`: both axes are logarithmic. `dots`: each point is seen, not the line alone."""
    left, top, wide, tall = 60, 40, 520, 340
    scale = math.log10 if log else float
    place = lambda value, ends: (scale(value) - scale(ends[0])) / (scale(ends[1]) - scale(ends[0]))
    x_of, y_of = lambda x: left + wide * place(x, x_range), lambda y: top + tall * (1 - place(y, y_range))
    marks = decades if log else ticks
    parts = [text(10, 18, title, 12), text(left + wide / 2, top + tall + 36, x_title, 11, "middle"), text(10, top - 8, y_title)]
    for x in marks(*x_range):
        parts += [line(x_of(x), top, x_of(x), top + tall), text(x_of(x), top + tall + 16, f"{x:,.10g}", 10, "middle", PALE)]
    for y in marks(*y_range):
        parts += [line(left, y_of(y), left + wide, y_of(y)), text(left - 6, y_of(y) + 4, f"{y:.10g}", 10, "end", PALE)]
    for index, (name, points) in enumerate(series.items()):
        colour, key = COLOURS[index], top + 10 + 18 * index
        path = " ".join(f"{x_of(x):.1f},{y_of(y):.1f}" for x, y in points)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        if dots:
            parts += [f'<circle cx="{x_of(x):.1f}" cy="{y_of(y):.1f}" r="4" fill="{colour}" stroke="white"/>' for x, y in points]
        parts += [line(left + wide + 14, key, left + wide + 34, key, colour, 2), text(left + wide + 40, key + 4, name, colour=INK)]
    return svg(left + wide + 250, top + tall + 46, parts)
