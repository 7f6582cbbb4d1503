"""Supports that parts need while they are printed."""
from __future__ import annotations

from typing import Any

import ombre

from ._arguments import Point, read, voxel_size
from ._solids import _one, is_unset
from ._tree import Node, Unary, as_node


class _Support(Unary):
    """The volume below what hangs over, down to the build plate or to the part."""

    def __init__(self, model: Node, cell: Point, material_id: int) -> None:
        super().__init__(model)
        self._cell, self._material = cell, material_id

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.support(solids[0], material=self._material, pitch=self._cell)

    def _says_material(self) -> bool:
        return super()._says_material() or not is_unset(self._material)

    def _own_materials(self) -> set[int]:
        return {self._material}

    def _composing(self) -> list[Node]:
        return []


class SupportAnalyzer:
    """Finds the volume that needs support in layered printing: SupportAnalyzer(input_model, voxel_size, material_id=1).

    All that hangs is supported, straight up from the build plate or from the part.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        form = {"input_model": as_node, "voxel_size": voxel_size, "material_id": _one}
        values = read(type(self).__name__, (form,), arguments, named)
        self._support = _Support(values["input_model"], values["voxel_size"], values["material_id"])

    def analyze(self) -> Node:
        """The volume, as a node."""
        return self._support


class SupportAnalyzerParallel(SupportAnalyzer):
    """A SupportAnalyzer; both use all cores."""
