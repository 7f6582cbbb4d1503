"""Bricks and tetrahedra that fill a design, with their materials: what `ombre fea` makes, as arrays."""
from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy

import ombre

from .._arguments import Point
from .vtu import read_grid

# Criteria of Ombre's mesher for tetrahedra, as shares of their size: radii of the balls around facets and around cells,
# and the greatest distance of facets from the surface.
_share_of_radius, _share_of_distance = 0.8, 0.05


class Elements(NamedTuple):
    """Elements of a design.

    Attributes:
        nodes: of the shape (n, 3), mm; each belongs to an element.
        cells: of the shape (m, 8) for bricks and (m, 4) for tetrahedra, from 0; in the order of VTK and Abaqus.
        fractions: {id of a material: (m,)}, at the middles of the elements.
        material_ids: (m,), drawn by the odds of the fractions.
        attributes: {name: (m,) or (m, components)}, at the middles of the elements.
    """

    nodes: numpy.ndarray
    cells: numpy.ndarray
    fractions: dict[int, numpy.ndarray]
    material_ids: numpy.ndarray
    attributes: dict[str, numpy.ndarray]

    @property
    def centroids(self) -> numpy.ndarray:
        """Centroids of the shape (m, 3), mm."""
        middles: numpy.ndarray = self.nodes[self.cells].mean(axis=1)
        return middles

    def greatest(self) -> numpy.ndarray:
        """The id of the material that each element has most of; of equals the lowest."""
        ids = numpy.array(sorted(self.fractions))
        chosen: numpy.ndarray = ids[numpy.argmax([self.fractions[i] for i in ids], axis=0)]
        return chosen


def bricks_of(design: ombre.Design, cell: Point, seed: int = 0, progress: Callable[[float], Any] | None = None
              ) -> Elements:
    """A brick for each voxel whose centre is inside. Raises DesignError where there is none."""
    return _elements_of(design, seed, progress, {"cell": ",".join(map(repr, cell))})


class TetraCriteria(NamedTuple):
    """How fine tetrahedra are, mm, by the words of CGAL: radii of the balls around facets of the surface and around
    tetrahedra, and the distance of facets from the surface."""

    facet_size: float
    facet_distance: float
    cell_size: float | tuple[float, float]  # or the least and the greatest, by the formula
    formula: str = "min_cell + h*(max_cell - min_cell)"

    def options(self) -> dict[str, Any]:
        """Options of `ombre fea`, as fine as the finest of these requires."""
        limit = min(self.facet_size / _share_of_radius, self.facet_distance / _share_of_distance)
        if not isinstance(self.cell_size, tuple):
            return {"size": min(self.cell_size / _share_of_radius, limit)}
        formula = self.formula
        for name, value in zip(("min_cell", "max_cell"), self.cell_size):
            formula = re.sub(rf"\b{name}\b", f"({value!r})", formula)
        low, high = (min(value / _share_of_radius, limit) for value in self.cell_size)
        return {"size_by": f"min(({formula})/{_share_of_radius!r}, {limit!r})", "min_cell": low, "max_cell": high}


def tetrahedra_of(design: ombre.Design, criteria: TetraCriteria, seed: int = 0,
                  progress: Callable[[float], Any] | None = None) -> Elements:
    """Tetrahedra with four nodes, up to the surface. Raises DesignError."""
    return _elements_of(design, seed, progress, {"elements": "tet4", **criteria.options()})


def _elements_of(design: ombre.Design, seed: int, progress: Callable[[float], Any] | None, options: dict[str, Any]
                 ) -> Elements:
    names = list(design.materials.names)
    # A study that needs only one property of the materials, and that holds every piece.
    study = {"physics": "heat", "materials": {name: {"conductivity_w_mk": 1} for name in names[1:]},
             "supports": [{"on": {"where": "1"}, "temperature_c": 0}]}
    with tempfile.TemporaryDirectory(prefix="ombre_") as folder:
        path = os.path.join(folder, "elements.vtu")
        report = design.fea(path, progress, study=study, seed=seed, **options)
        grid = read_grid(path)
    fields = dict(grid.cell_fields)
    fractions = {names.index(name.removeprefix("fraction of ")): fields.pop(name).astype(float)
                 for name in list(fields) if name.startswith("fraction of ")}
    ids = numpy.array([names.index(section["name"]) for section in report["sections"]])
    material_ids = ids[fields["section"].astype(int)]
    own = {name: fields[name].astype(float) for name in design.attributes if name in fields}
    return Elements(grid.points, grid.cells, fractions, material_ids, own)
