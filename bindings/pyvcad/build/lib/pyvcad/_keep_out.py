"""A design without liquid near its surface."""
from __future__ import annotations

from typing import Any

import ombre

from ._materials import MaterialDefs, default_materials
from ._tree import Unary

_liquids = ("liquid", "m.cleanser")


class KeepOut(Unary):
    """The child, whose mixtures hold no liquid nearer to the surface than a distance, mm; the other materials share its
    place. Points of liquid alone stay liquid. Raises RuntimeError where the table has no material called "liquid" or
    "M.Cleanser".
    """

    def __init__(self, child: Any, distance: float, table: MaterialDefs | None) -> None:
        super().__init__(child)
        self._distance, self._table = distance, table or default_materials
        self._liquid = {id for id in self._table.palette() if self._table.name(id).lower() in _liquids}
        if not self._liquid:
            raise RuntimeError('the materials have no liquid to keep out: none is called "liquid" or "M.Cleanser"')

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        solid, ids = solids[0], self._composing()[0].material_list()
        if not self._liquid & set(ids):
            return solid
        depth = ombre.distance_to(solid).distance
        shares = []
        for id in ids:
            share = ombre.composition_of(solid, self._table.name(id)).share
            shares.append(ombre.where(depth < -self._distance, share, 0) if id in self._liquid else share)
        return ombre.fgrade(solid, shares, ids)
