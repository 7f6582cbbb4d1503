"""Colours for Hounsfield units.

The palettes are formulas: a ramp of greys, the usual "jet", and ramps through a few colours in between.
"""
from __future__ import annotations

import importlib
import math
from collections.abc import Callable, Sequence
from typing import Any

from pyvcad import LookupTableEntry, Vec4

__all__ = ["create_linear_gradient_hu_map", "get_color_palette", "plot_hu_color_map", "plot_opacity_function",
           "raw_color_palettes", "sigmoid_opacity_base"]

Color = tuple[float, float, float]
_entries = 256  # colours of a palette


def _ramp(*stops: Color) -> list[Color]:
    """Straight lines between colours at equal distances."""
    def at(t: float) -> Color:
        place = t * (len(stops) - 1)
        n = min(int(place), len(stops) - 2)
        r, g, b = ((1 - place + n) * u + (place - n) * v for u, v in zip(stops[n], stops[n + 1]))
        return r, g, b
    return [at(n / (_entries - 1)) for n in range(_entries)]


def _jet() -> list[Color]:
    """Blue, cyan, yellow, red; each of the three rises and falls by straight lines."""
    def part(t: float, middle: float) -> float:
        return min(max(1.5 - abs(4 * t - middle), 0.0), 1.0)
    return [(part(t, 3), part(t, 2), part(t, 1)) for t in (n / (_entries - 1) for n in range(_entries))]


raw_color_palettes: dict[str, list[Color]] = {
    "grayscale": _ramp((0, 0, 0), (1, 1, 1)),
    "jet": _jet(),
    "hot": _ramp((0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)),
    "cool": _ramp((0, 1, 1), (1, 0, 1)),
    "tissue": _ramp((0.35, 0.1, 0.1), (0.8, 0.35, 0.3), (0.95, 0.75, 0.65), (1, 1, 0.95)),
}


def get_color_palette(name: str) -> list[Color]:
    """256 colours (red, green, blue), 0 to 1, from the least value to the greatest."""
    if name not in raw_color_palettes:
        raise ValueError(f"there is no palette {name!r}; there are {', '.join(sorted(raw_color_palettes))}")
    return list(raw_color_palettes[name])


def sigmoid_opacity_base(t: float, k: float = 10.0, x0: float = 0.5) -> float:
    """1 / (1 + exp(-k (t - x0))): from clear to opaque, half at x0, steeper for larger k."""
    return 1 / (1 + math.exp(-max(min(k * (t - x0), 700.0), -700.0)))


def create_linear_gradient_hu_map(lo: float, hi: float, palette: str | Sequence[Sequence[float]] = "grayscale",
                                  steps: int = 64, opacity_function: Callable[[float], float] | None = None
                                  ) -> list[LookupTableEntry]:
    """Entries of a table for STEP: `steps` equal parts of `lo` to `hi`, each with the palette's colour in its middle.

    Args:
        lo: the first part's lower bound, HU.
        hi: the last part's upper bound.
        palette: a name, or a list of colours.
        steps: how many parts.
        opacity_function: the opacity, 0 to 1, of t from 0 (at lo) to 1; without it all is opaque.
    """
    if not lo < hi:
        raise ValueError(f"create_linear_gradient_hu_map: expected lo below hi, found {lo} and {hi}")
    if steps < 1:
        raise ValueError(f"create_linear_gradient_hu_map: expected at least one step, found {steps}")
    colors: Sequence[Sequence[float]] = get_color_palette(palette) if isinstance(palette, str) else palette
    if not colors:
        raise ValueError("create_linear_gradient_hu_map: the palette is empty")
    entries = []
    for n in range(steps):
        t = (n + 0.5) / steps
        red, green, blue = colors[min(int(t * len(colors)), len(colors) - 1)][:3]
        opacity = 1.0 if opacity_function is None else min(max(float(opacity_function(t)), 0.0), 1.0)
        entries.append(LookupTableEntry(lo + (hi - lo) * n / steps, lo + (hi - lo) * (n + 1) / steps,
                                        Vec4(red, green, blue, opacity)))
    return entries


def _axes(what: str) -> Any:
    try:
        return importlib.import_module("matplotlib.pyplot")
    except ImportError:
        raise ImportError(f"{what} draws with matplotlib, which is not installed: pip install matplotlib") from None


def plot_opacity_function(f: Callable[[float], float]) -> None:
    """Shows an opacity function."""
    plot = _axes("plot_opacity_function")
    places = [n / 200 for n in range(201)]
    plot.plot(places, [f(t) for t in places])
    plot.xlabel("t")
    plot.ylabel("opacity")
    plot.show()


def plot_hu_color_map(map: Sequence[LookupTableEntry], lo: float, hi: float) -> None:
    """Shows the colours of a table from `lo` to `hi` HU."""
    plot = _axes("plot_hu_color_map")
    for entry in map:
        plot.axvspan(entry.input_low, entry.input_high, color=tuple(entry.output_values[0]))
    plot.xlim(lo, hi)
    plot.xlabel("HU")
    plot.show()
