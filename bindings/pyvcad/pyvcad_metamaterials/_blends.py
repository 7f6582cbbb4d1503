"""Lattices that turn into others in space."""
from __future__ import annotations

from typing import Any

import ombre
from pyvcad import FloatAttribute, Vec3Attribute
from pyvcad._arguments import length, number
from pyvcad._cell_maps import control
from pyvcad._tree import Binary, Node, as_node


def ramp(lo: float, hi: float, axis: str = "x", smooth: bool = False,
         coordinates: Vec3Attribute | None = None) -> FloatAttribute:
    """0 below lo, 1 above hi, between them along a line, or with `smooth` along a curve that starts and ends level.

    Args:
        axis: "x", "y" or "z"; "u", "v" or "w" with coordinates=map.logical_position.
        coordinates: what the axis counts, in place of the place in mm.
    """
    low, high = number(lo), number(hi)
    if not low < high:
        raise ValueError(f"ramp: expected lo below hi, found {low:g} and {high:g}")
    if axis not in tuple("xyzuvw"):
        raise ValueError(f'ramp, axis: expected "x", "y" or "z", or "u", "v" or "w", found {axis!r}')
    if axis in "uvw" and coordinates is None:
        raise TypeError(f'ramp: the axis "{axis}" is one of a map; write coordinates=map.logical_position')
    place = Vec3Attribute("x", "y", "z") if coordinates is None else coordinates
    share = place.component("xyzuvw".index(axis) % 3).normalize(low, high).clamp(0, 1)
    return share * share * (3 - 2 * share) if smooth else share


class Mix(Binary):
    """Two bodies, of which the weight says how much there is of the right one; distances and attributes are mixed."""

    def __init__(self, left: Any, right: Any, weight: Any, region: Node | None = None, half_width: float = 0.0) -> None:
        super().__init__(left, right)
        self._weight, self._region, self._half_width = weight, region, half_width

    def _inputs(self) -> list[Node]:
        return [*super()._inputs(), *([self._region] if self._region else [])]

    def _replace(self, of: Any) -> None:
        super()._replace(of)
        if self._region:
            self._region = of(self._region)

    def _composing(self) -> list[Node]:
        return super()._inputs()

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        if self._region is None:
            weight = control(self._weight)
        else:
            weight = ombre.formula(0.5 + ombre.distance_to(solids[2]).distance / (2 * self._half_width)).value
        return ombre.morph(solids[0], solids[1], weight=weight)


def mix(left: Any, right: Any, weight: Any = None, region: Any = None, half_width: float | None = None) -> Mix:
    """A body between two: mix(left, right, weight), 0 for the left and 1 for the right one.

    Or mix(left, right, region=node, half_width=2): the left one inside of the region and the right one outside, with a
    band of half_width mm to both sides of its surface.
    """
    if (weight is None) == (region is None):
        raise TypeError("mix: expected either a weight, or a region and a half_width")
    if region is None:
        return Mix(as_node(left), as_node(right), weight)
    if half_width is None:
        raise TypeError("mix: a region needs the half_width of the band about its surface, mm")
    return Mix(as_node(left), as_node(right), None, as_node(region), length(half_width))


def mix_many(bodies: Any, weights: Any) -> Node:
    """A body between several: each counts with its weight over the sum of all weights.

    Args:
        bodies: nodes.
        weights: a number or a FloatAttribute for each, 0 or more, and not all 0 anywhere.
    """
    nodes, shares = [as_node(body) for body in bodies], list(weights)
    if not nodes or len(nodes) != len(shares):
        raise ValueError(f"mix_many: expected a weight for each body, found {len(nodes)} bodies and {len(shares)} weights")
    mixed, total = nodes[0], _weight(shares[0])
    for node, share in zip(nodes[1:], shares[1:]):
        total = total + _weight(share)
        mixed = Mix(mixed, node, _weight(share) / total)
    return mixed


def _weight(value: Any) -> FloatAttribute:
    return value if isinstance(value, FloatAttribute) else FloatAttribute(value)
