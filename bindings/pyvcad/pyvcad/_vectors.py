"""Vectors, as designs write points, sizes and colours."""
from __future__ import annotations

import math
import numbers
from collections.abc import Iterator
from typing import Any


class _Vector:
    """Numbers by the names x, y, z, w, and by index; equal to sequences of the same numbers."""

    __slots__: tuple[str, ...] = ()
    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, *values: Any) -> None:
        names = self.__slots__
        if len(values) == 1 and not isinstance(values[0], numbers.Real):
            values = tuple(values[0])
        if len(values) not in (0, len(names)):
            raise TypeError(f"{type(self).__name__} has {len(names)} numbers ({', '.join(names)}), not {len(values)}")
        for name, value in zip(names, values or (0.0,) * len(names)):
            setattr(self, name, float(value))

    def __iter__(self) -> Iterator[float]:
        return (getattr(self, name) for name in self.__slots__)

    def __len__(self) -> int:
        return len(self.__slots__)

    def __getitem__(self, index: int) -> float:
        return tuple(self)[index]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{value:g}' for value in self)})"

    def __eq__(self, other: object) -> bool:
        try:
            return tuple(self) == tuple(other)  # type: ignore[arg-type]
        except TypeError:
            return NotImplemented

    def __add__(self, other: Any) -> Any:
        return type(self)(*(a + b for a, b in zip(self, other, strict=True)))

    def __sub__(self, other: Any) -> Any:
        return type(self)(*(a - b for a, b in zip(self, other, strict=True)))

    def __mul__(self, factor: float) -> Any:
        return type(self)(*(a * factor for a in self))

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> Any:
        return type(self)(*(a / divisor for a in self))

    def __neg__(self) -> Any:
        return type(self)(*(-a for a in self))

    def length(self) -> float:
        return math.hypot(*self)


class Vec2(_Vector):
    """Two numbers: Vec2(x, y), or Vec2() for zeros."""

    __slots__ = ("x", "y")
    x: float
    y: float


class Vec3(_Vector):
    """Three numbers: Vec3(x, y, z), or Vec3() for zeros.

    >>> size = Vec3(15, 10, 5)
    >>> size.x = 100
    >>> size
    Vec3(100, 10, 5)
    """

    __slots__ = ("x", "y", "z")
    x: float
    y: float
    z: float


class Vec4(_Vector):
    """Four numbers: Vec4(x, y, z, w), or Vec4() for zeros; r, g, b and a are the same numbers.

    Colours of materials are red, green, blue and opacity from 0 to 255, those of attributes from 0 to 1.
    """

    __slots__ = ("x", "y", "z", "w")
    x: float
    y: float
    z: float
    w: float

    r = property(lambda self: self.x, lambda self, value: setattr(self, "x", float(value)))
    g = property(lambda self: self.y, lambda self, value: setattr(self, "y", float(value)))
    b = property(lambda self: self.z, lambda self, value: setattr(self, "z", float(value)))
    a = property(lambda self: self.w, lambda self, value: setattr(self, "w", float(value)))
