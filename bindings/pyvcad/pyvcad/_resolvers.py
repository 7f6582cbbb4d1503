"""Rules for what an attribute is where children overlap."""
from __future__ import annotations

import enum
from typing import Any

import ombre

from ._functions import pointwise


class Vec4Mode(enum.Enum):
    """How vectors are compared: number by number, or as a whole by their length."""

    PerChannel = 0
    Magnitude = 1


class Resolver:
    """One rule. `_rule` is Ombre's word for it, where it has one."""

    _rule = ""

    def _combine(self, left: list[Any], right: list[Any]) -> list[Any]:
        """The numbers of the attribute where two children overlap, from those of both."""
        raise NotImplementedError


class AverageConflictResolver(Resolver):
    _rule = "mean"


def _length(numbers: list[Any]) -> Any:
    return sum(n * n for n in numbers)


class _ByMode(Resolver):
    _least = True

    def __init__(self, mode: Vec4Mode = Vec4Mode.PerChannel) -> None:
        self._rule = "" if mode is Vec4Mode.Magnitude else "min" if self._least else "max"

    def _combine(self, left: list[Any], right: list[Any]) -> list[Any]:
        is_less = _length(right) < _length(left)
        return [ombre.where(is_less, b if self._least else a, a if self._least else b) for a, b in zip(left, right)]


class MinConflictResolver(_ByMode):
    """The least: number by number, or of vectors the shortest."""


class MaxConflictResolver(_ByMode):
    """The greatest: number by number, or of vectors the longest."""

    _least = False


class CustomFloatConflictResolver(Resolver):
    """A function of the left and the right number, such as a numba.cfunc float64(left, right). Children are taken
    pairwise from the first on, with what came out so far on the left."""

    _count = 1

    def __init__(self, *functions: Any) -> None:
        if len(functions) != self._count or not all(map(callable, functions)):
            raise TypeError(f"{type(self).__name__}: expected {self._count} function{'s'[:self._count - 1]} of (left, right)")
        self._functions = [self._of_a_place(function) for function in functions]

    @staticmethod
    def _of_a_place(function: Any) -> Any:
        def at(x: float, y: float, z: float) -> float:
            return float(function(x, y))
        return pointwise(at)

    def _combine(self, left: list[Any], right: list[Any]) -> list[Any]:
        if len(left) != self._count:
            raise TypeError(f"{type(self).__name__}: the attribute has {len(left)} numbers, not {self._count}")
        return [ombre.at(function, (a, b, 0)) for function, a, b in zip(self._functions, left, right)]


class CustomVec4ConflictResolver(CustomFloatConflictResolver):
    """Four such functions: of red, green, blue and alpha."""

    _count = 4


def numbers_of(solid: ombre.Solid, name: str) -> list[Any]:
    """The numbers of a solid's attribute, as values."""
    value = ombre.attribute_of(solid, name)
    outputs = dir(value)
    if "value" in outputs:
        return [value.value]
    return [*value.vector, *([value.alpha] if "alpha" in outputs else [])]


def with_numbers(solid: ombre.Solid, name: str, numbers: list[Any]) -> ombre.Solid:
    """The solid with an attribute of one number, of a vector's three or of a colour's four."""
    if len(numbers) == 1:
        return ombre.attribute(solid, name, numbers[0])
    return ombre.attribute(solid, name, numbers, type="colour" if len(numbers) == 4 else "vector")


def given(whole: ombre.Solid, name: str, resolver: Resolver, solids: list[ombre.Solid]) -> ombre.Solid:
    """The solid with the attribute that the rule makes of the solids' own, which all have it."""
    now, have = numbers_of(solids[0], name), ombre.distance_to(solids[0]).inside
    for solid in solids[1:]:
        mine, inside = numbers_of(solid, name), ombre.distance_to(solid).inside
        both = (have > 0.5) & (inside > 0.5)
        # Each step is a value of its own, since the next uses it several times.
        now = [ombre.formula(ombre.where(both, combined, ombre.where(inside > 0.5, m, n)))
               for combined, m, n in zip(resolver._combine(now, mine), mine, now)]
        have = ombre.formula(ombre.where((have > 0.5) | (inside > 0.5), 1, 0))
    return with_numbers(whole, name, now)


class resolvers:
    """How an attribute combines where children overlap; without one, the first child that has it wins."""

    Vec4Mode = Vec4Mode
    AverageConflictResolver = AverageConflictResolver
    MinConflictResolver = MinConflictResolver
    MaxConflictResolver = MaxConflictResolver
    CustomFloatConflictResolver = CustomFloatConflictResolver
    CustomVec4ConflictResolver = CustomVec4ConflictResolver
