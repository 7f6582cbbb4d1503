"""Colours for numbers."""
from __future__ import annotations

import bisect
from typing import Any

import numpy

from ombre._materials import palettes

from ._arguments import number, vector
from ._errors import WrongValue
from ._vectors import Vec3


class ColorMap:
    """Colours at numbers, straight between them and those of the ends beyond: ColorMap(), then add_color(value, Vec3)."""

    def __init__(self) -> None:
        self._stops: list[tuple[float, tuple[float, float, float]]] = []

    def add_color(self, value: float, color: Any) -> None:
        """Sets the colour at a number: red, green and blue from 0 to 1."""
        channels, at = vector(color), number(value)
        if not all(0 <= c <= 1 for c in channels):
            raise WrongValue(f"add_color: expected red, green and blue from 0 to 1, found {channels}")
        if any(at == other for other, _ in self._stops):
            raise WrongValue(f"add_color: there is a colour at {at:g} already")
        bisect.insort(self._stops, (at, channels))

    def get_color(self, value: float) -> Vec3:
        return Vec3(*map(float, self._colors(numpy.array([number(value)]))[0]))

    def _colors(self, values: numpy.ndarray) -> numpy.ndarray:
        """Red, green and blue of each number."""
        if not self._stops:
            raise WrongValue("ColorMap: it has no colour; give it some with add_color(value, color)")
        at = [value for value, _ in self._stops]
        return numpy.stack([numpy.interp(values, at, [color[i] for _, color in self._stops]) for i in range(3)], axis=-1)

    @staticmethod
    def create_viridis() -> ColorMap:
        return _palette("viridis")

    @staticmethod
    def create_plasma() -> ColorMap:
        return _palette("plasma")

    @staticmethod
    def create_inferno() -> ColorMap:
        return _palette("inferno")

    @staticmethod
    def create_grayscale() -> ColorMap:
        return _palette("gray")


def _palette(name: str) -> ColorMap:
    """One of Ombre's palettes, from 0 to 1."""
    colours = palettes()[name]
    found = ColorMap()
    for n, colour in enumerate(colours):
        found.add_color(n / (len(colours) - 1), tuple(c / 255 for c in colour))
    return found
