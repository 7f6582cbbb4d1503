"""Compositions from the results of a simulation: a mesh of elements (.inp) and a table of its nodes' displacements."""
from __future__ import annotations

from typing import Any

import ombre

from ._arguments import Optional, boolean, material, read, text
from ._functions import expression
from ._operations import _list_of
from ._solids import _find, _Leaf


def _of_displacements(value: Any) -> Any:
    """An expression of dx, dy, dz and len, which are known once there is a solid."""
    return expression(value, is_checked=False)


class SimulationField(_Leaf):
    """Solid within a mesh of elements: SimulationField(inp_path, csv_path, expressions, materials, prob_mode=True).

    The table has a line for each node: its number, then dx, dy and dz. There is an expression for each material, of dx,
    dy, dz and len, the length of the displacement, besides the coordinates. With prob_mode their values are shares of a
    mixture, without it the greatest takes all.
    """

    _solid_path: str | None = None

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        self._read({}, {"prob_mode": Optional(boolean, True)}, arguments, named)

    def _read(self, first: dict[str, Any], mode: dict[str, Any], arguments: tuple[Any, ...], named: dict[str, Any]
              ) -> None:
        name = type(self).__name__
        lists = ("functions" if first else "expressions", "materials")
        form = {**first, "inp_path": text, "csv_path": text, lists[0]: _list_of(_of_displacements),
                lists[1]: _list_of(material), **mode}
        values = read(name, (form,), arguments, named)
        self._functions, self._materials = values[lists[0]], values["materials"]
        self._mode = "prob" if values["prob_mode"] else "thresh"
        self._mesh, self._table = _find(name, values["inp_path"]), _find(name, values["csv_path"])
        if first:
            self._solid_path = _find(name, values["mesh_path"])
        if len(self._functions) != len(self._materials):
            raise ValueError(f"{name}: expected an expression for each material, found {len(self._functions)} "
                             f"expressions and {len(self._materials)} materials")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        moves: Any = ombre.results(self._mesh, "displacement", values=self._table, outside="nearest")
        solid: ombre.Solid = ombre.mesh(self._solid_path or self._mesh, self._materials[0])
        for name, value in zip(self._own_attributes(), (moves.vector.x, moves.vector.y, moves.vector.z, moves.magnitude)):
            solid = ombre.attribute(solid, name, value)
        return ombre.fgrade(solid, self._functions, self._materials, mode=self._mode)

    def _own_attributes(self) -> list[str]:
        return ["dx", "dy", "dz", "len"]

    def _says_material(self) -> bool:
        return True

    def _own_materials(self) -> set[int]:
        return set(self._materials)


class PointMap(SimulationField):
    """Materials by results, for the solid of another file.

    PointMap(mesh_path, inp_path, csv_path, functions, materials, prob_mode)

    Where the solid reaches beyond the elements, the nearest place of their border counts.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        _Leaf.__init__(self)
        self._read({"mesh_path": text}, {"prob_mode": boolean}, arguments, named)
