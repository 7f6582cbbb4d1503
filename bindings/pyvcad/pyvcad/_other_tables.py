"""Solids of one table of materials, made again with those of another: ids stay."""
from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import ombre
from ombre._materials import current_factory
from ombre._solid import wrap


def solids_of(root: ombre.Solid) -> Iterator[ombre.Solid]:
    """Every solid once, those below first; solids nest a few hundred levels at most."""
    done: set[int] = set()

    def visit(solid: ombre.Solid) -> Iterator[ombre.Solid]:
        if solid._node.address in done:
            return
        done.add(solid._node.address)
        for below in solid.inputs:
            yield from visit(below)
        yield solid
    return visit(root)


def _material_parameters(solid: ombre.Solid) -> list[str]:
    info: Any = solid._info
    return [p["name"] for p in info["parameters"]
            if p["kind"] in ("material", "material or mixture", "list of materials")]


def _names_in(value: Any) -> list[str]:
    """The materials of a parameter: one, a list, or a mixture of ombre.mix."""
    if isinstance(value, str):
        return [value]
    parts = [value._node.parameters[p] for p in ("a", "b")] if isinstance(value, ombre.Value) else value
    return [name for part in parts for name in _names_in(part)]


def named_materials(solid: ombre.Solid) -> list[str]:
    """The materials that the parameters of a solid name."""
    parameters = solid.parameters
    return [name for p in _material_parameters(solid) for name in _names_in(parameters[p])]


def _in_current_table(value: Any, ids: dict[str, int]) -> Any:
    """Makes the solid again with the current table of materials."""
    if isinstance(value, str):
        return ids[value]
    if not isinstance(value, ombre.Value):
        return [ids[v] for v in value]
    names = [entry["name"] for entry in current_factory().materials]

    def named(part: Any) -> Any:
        return names[ids[part]] if isinstance(part, str) else _in_current_table(part, ids)
    mixed = value._node.parameters
    return ombre.mix(named(mixed["a"]), named(mixed["b"]), mixed["t"])


def with_current_materials(root: ombre.Solid, ids: dict[str, int]) -> ombre.Solid:
    """The solid, made again with the current table of materials, in which its materials have these ids."""
    factory = current_factory()
    made: dict[int, Any] = {}
    for solid in solids_of(root):
        parameters = {name: value for name, value in solid.parameters.items() if value is not None}
        for name in _material_parameters(solid):
            parameters[name] = _in_current_table(parameters[name], ids)
        inputs = [made[below._node.address] for below in solid.inputs]
        made[solid._node.address] = factory.make(solid.type, (), parameters, inputs)
    return wrap(made[root._node.address])
