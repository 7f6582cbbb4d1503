"""Places on the surface of a tree, and angles that turn parts to them."""
from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy

from ._arguments import vector
from ._errors import WrongValue
from ._tree import as_node
from ._vectors import Vec3

_on_surface = 1e-9  # of the longest side of the part's box
_least_step, _longest_step = 1e-6, 1 / 256  # of it


class Probe(NamedTuple):
    """A place on the surface; without a hit, position and normal are None."""

    hit: bool
    position: Vec3 | None
    normal: Vec3 | None


_none = Probe(False, None, None)


def probe_point(root: Any, point: Any) -> Probe:
    """The nearest place of the surface to a point."""
    node = as_node(root)
    position = node.snap(Vec3(*vector(point)))
    return Probe(True, position, surface_normal(node, position))


def surface_normal(root: Any, point: Any) -> Vec3:
    """The direction of length 1 in which the distance grows fastest at a point: outward on the surface."""
    gradient = numpy.array(list(as_node(root).gradient(Vec3(*vector(point)))))
    size = float(numpy.linalg.norm(gradient))
    if size == 0 or not math.isfinite(size):
        raise WrongValue(f"surface_normal: the distance has no direction of growth at {tuple(vector(point))}")
    return Vec3(*map(float, gradient / size))


def probe_ray(root: Any, origin: Any, direction: Any) -> Probe:
    """The first place of the surface that a ray meets.

    The ray goes on by the distance to the surface (J. C. Hart, 1996), at least by a millionth of the part's size. Steps are
    at most 1/256 of it, since the distance of a Function may be too great.
    """
    node = as_node(root)
    start, way = numpy.array(vector(origin)), numpy.array(vector(direction))
    if not way.any():
        raise WrongValue("probe_ray: expected a direction, found (0, 0, 0)")
    way = way / numpy.linalg.norm(way)
    design = node._design()
    low, high = (numpy.array(corner) for corner in design.bounds)
    span = _span_in_box(start, way, low, high)
    if span is None:
        return _none
    size = float((high - low).max())

    def distance(along: float) -> float:
        return float(design.distance(start + along * way))
    before = along = span[0]
    here = distance(along)
    is_outside = here > 0
    while (here > 0) == is_outside and abs(here) > _on_surface * size:
        before, along = along, along + min(max(abs(here), _least_step * size), _longest_step * size)
        if along > span[1]:
            return _none
        here = distance(along)
    return _met(node, start, way, distance, before, along)


def _span_in_box(start: numpy.ndarray, way: numpy.ndarray, low: numpy.ndarray,
                 high: numpy.ndarray) -> tuple[float, float] | None:
    """Where a ray is in a box, widened by a thousandth."""
    margin = 1e-3 * float((high - low).max())
    first, last = 0.0, math.inf
    for s, w, a, b in zip(start, way, low - margin, high + margin):
        if w == 0:
            if not a <= s <= b:
                return None
            continue
        near, far = sorted(((a - s) / w, (b - s) / w))
        first, last = max(first, near), min(last, far)
    return (first, last) if first <= last else None


def _met(node: Any, start: numpy.ndarray, way: numpy.ndarray, distance: Any, before: float, after: float) -> Probe:
    """The place between two of a ray where the distance changes its sign."""
    is_outside = distance(before) > 0
    for _ in range(60):
        middle = (before + after) / 2
        if (distance(middle) > 0) == is_outside:
            before = middle
        else:
            after = middle
    position = Vec3(*map(float, start + after * way))
    return Probe(True, position, surface_normal(node, position))


def alignment_angles(normal: Any, up: Any) -> Vec3:
    """The angles for Rotate(angles, child), degrees, that turn the child's +z to `normal`, and its +y as far to `up` as that
    allows. Raises where `up` lies along the normal."""
    z, y = numpy.array(vector(normal)), numpy.array(vector(up))
    if not z.any():
        raise WrongValue("alignment_angles, normal: expected a direction, found (0, 0, 0)")
    z = z / numpy.linalg.norm(z)
    y = y - (y @ z) * z
    if numpy.linalg.norm(y) < 1e-9 * max(1.0, float(numpy.linalg.norm(vector(up)))):
        raise WrongValue("alignment_angles, up: expected a direction that does not lie along the normal")
    y = y / numpy.linalg.norm(y)
    turned = numpy.stack([numpy.cross(y, z), y, z], axis=1)  # its columns are where x, y and z go
    # About fixed axes, z comes first, then y, then x: turned = X(pitch) Y(yaw) Z(roll).
    yaw = math.asin(max(-1.0, min(1.0, float(turned[0, 2]))))
    if abs(turned[0, 2]) < 1 - 1e-12:
        pitch, roll = math.atan2(-turned[1, 2], turned[2, 2]), math.atan2(-turned[0, 1], turned[0, 0])
    else:  # both turn about the same axis
        pitch, roll = math.atan2(turned[2, 1], turned[1, 1]), 0.0
    return Vec3(*(math.degrees(angle) for angle in (pitch, yaw, roll)))
