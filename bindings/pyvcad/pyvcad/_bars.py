"""Cones, bars that change their radius, and polygons that turn about an axis."""
from __future__ import annotations

import enum
import math
from typing import Any, cast

import numpy

import ombre

from ._arguments import Point, instance_of, length, number, read, vector
from ._solids import _Leaf, _one, _unset, is_unset


class CapMode(enum.Enum):
    """How a bar ends: flat, in a whole ball of the end's radius, or in the half of it that lies beyond the end."""

    Butt = 0
    Sphere = 1
    HemiSphere = 2


def _frame(start: numpy.ndarray, along: numpy.ndarray, toward: numpy.ndarray | None = None) -> list[list[float]]:
    """The rows of the affine map that takes the origin to `start`, z to `along`, and x near to `toward`."""
    z = along / numpy.linalg.norm(along)
    if toward is None:
        toward = numpy.eye(3)[int(numpy.argmin(numpy.abs(z)))]
    x = toward - numpy.dot(toward, z) * z
    x /= numpy.linalg.norm(x)
    return cast("list[list[float]]", numpy.column_stack([x, numpy.cross(z, x), z, start]).tolist())


class Cone(_Leaf):
    """Cone along z, its point up, half of its height above z = 0: Cone(angle, height).

    The angle is that between the axis and the side, in radians.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        values = read("Cone", ({}, {"angle": number, "height": length, "material": _one}), arguments, named)
        angle, self._height = values.get("angle", 0.5), values.get("height", 1.0)
        self._base, self._material = self._height * math.tan(angle), values.get("material", _unset)
        if not 0 < self._base < 1e6:
            raise ValueError(f"Cone, angle: expected radians between 0 and pi/2, found {angle}")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.cone(self._base, 0, self._height, self._material)


def _end_of(cap: CapMode, radius: float, side: int, height: float, material: int) -> list[ombre.Solid]:
    """A ball around an end of a bar along z, or the half beyond it."""
    if cap is CapMode.Butt or radius == 0:
        return []
    ball: ombre.Solid = ombre.sphere(radius, material)
    if cap is CapMode.HemiSphere:
        half = ombre.rectprism((4 * radius, 4 * radius, 2 * radius), material)
        ball = ombre.intersection([ball, ombre.translate(half, (0, 0, side * radius))])
    return [ombre.translate(ball, (0, 0, side * height / 2))]


class Strut(_Leaf):
    """Bar from one point to another with round ends: Strut(start, end, radius); with a material, Strut(start, end, radius,
    material), its ends are flat.

    Or one whose radius changes, and whose ends are closed as requested: Strut(start, end, r1, r2, cap1, cap2).
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        ends = {"start": vector, "end": vector}
        plain = {**ends, "radius": length, "material": _one}
        cap = instance_of(CapMode)
        capped = {**ends, "r1": number, "r2": number, "cap1": cap, "cap2": cap, "material": _one}
        values = read("Strut", ({}, plain, capped), arguments, named)
        self._start: Point = values.get("start", (0, 0, 0))
        self._end: Point = values.get("end", (10, 0, 0))
        self._radius, self._material = values.get("radius", 1.0), values.get("material", _unset)
        self._caps = (values["cap1"], values["cap2"]) if "cap1" in values else None
        self._radii: tuple[float, float] = (values.get("r1", 0.0), values.get("r2", 0.0))
        if self._caps and (min(self._radii) < 0 or max(self._radii) <= 0 or self._start == self._end):
            raise ValueError("Strut: expected two points, and radii of which one is above 0 and none below")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        if not self._caps:
            ends = "round" if is_unset(self._material) else "flat"
            return ombre.strut(self._start, self._end, self._radius, self._material, caps=ends)
        start, end = numpy.array(self._start), numpy.array(self._end)
        height = float(numpy.linalg.norm(end - start))
        parts: list[ombre.Solid] = [ombre.cone(*self._radii, height, self._material)]
        for cap, radius, side in zip(self._caps, self._radii, (-1, 1)):
            parts += _end_of(cap, radius, side, height, self._material)
        return ombre.matrix(ombre.union(parts), _frame((start + end) / 2, end - start))


class PolygonRevolve(_Leaf):
    """A polygon that turns about an axis: PolygonRevolve(profile, axis_start, axis_end, degrees).

    Its corners lie in one plane with the axis, all on one side of it. It turns right-handed about the axis, from where it
    is; with less than 360 degrees both ends are flat.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        form = {"profile": _corners, "axis_start": vector, "axis_end": vector, "degrees": length, "material": _one}
        values = read("PolygonRevolve", (form,), arguments, named)
        start, end = numpy.array(values["axis_start"]), numpy.array(values["axis_end"])
        self._degrees, self._material = values["degrees"], values["material"]
        if not numpy.linalg.norm(end - start) > 0:
            raise ValueError("PolygonRevolve: the axis has no direction")
        z = (end - start) / numpy.linalg.norm(end - start)
        corners = numpy.array(values["profile"]) - start
        across = corners - numpy.outer(corners @ z, z)
        x = across[int(numpy.argmax(numpy.linalg.norm(across, axis=1)))]
        size = float(numpy.abs(corners).max())
        rho = across @ x / max(float(numpy.linalg.norm(x)), 1e-300)
        if numpy.abs(across - numpy.outer(rho, x / max(float(numpy.linalg.norm(x)), 1e-300))).max() > 1e-6 * size:
            raise RuntimeError("PolygonRevolve: the profile does not lie in one plane with the axis")
        if rho.min() < -1e-9 * size:
            raise RuntimeError("PolygonRevolve: the profile lies on both sides of the axis")
        self._frame = _frame(start, z, x)
        self._profile = [(max(0.0, float(r)), float(h)) for r, h in zip(rho, corners @ z)]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.matrix(ombre.revolve(self._profile, self._degrees, self._material), self._frame)


def _corners(value: Any) -> list[Point]:
    corners = [vector(point) for point in value]
    if len(corners) < 3:
        raise ValueError("expected three corners or more")
    return corners
