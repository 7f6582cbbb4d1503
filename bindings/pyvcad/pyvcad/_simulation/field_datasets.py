"""Fields on meshes of tetrahedra, as results of other programs are, and attributes from them."""
from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy

import ombre

from .._arguments import length
from .._attributes import FloatAttribute, Vec3Attribute
from .._vectors import Vec3
from .vtu import stored_tetrahedra

_most_failures = 10
_share_of_tolerance, _share_of_rounding = 1e-7, 1e-12  # shares of the mesh's longest side


class FieldAssociation(enum.Enum):
    """The kind of places that have the numbers of a field."""

    POINT = 0
    CELL = 1


@dataclass(frozen=True)
class FieldMetadata:
    """The description of a field. `minimum` and `maximum` are those of its numbers; for vectors those of their lengths."""

    name: str
    association: FieldAssociation
    component_count: int
    value_count: int
    minimum: float
    maximum: float
    units: str
    step_identifier: str
    description: str


@dataclass(frozen=True)
class FieldDomain:
    """How large a mesh is."""

    point_count: int
    cell_count: int


@dataclass(frozen=True)
class CoverageFailure:
    """A point that has no value."""

    position: Vec3
    boundary_distance: float  # mm


@dataclass(frozen=True)
class FieldCoverage:
    """How many points have a value. Those outside by at most a ten-millionth of the mesh's
    longest side count as adjusted.

    `representative_failures` are the ten that lie farthest outside, the farthest first.
    """

    total_queries: int
    inside_count: int
    tolerance_adjusted_count: int
    boundary_clamped_count: int
    outside_count: int
    maximum_clamp_distance: float  # mm
    representative_failures: list[CoverageFailure] = field(default_factory=list)


class UnstructuredFieldDataset:
    """Fields on tetrahedra: made by `from_tetrahedra`, or read by `XDMFFieldLoader`.

    Fields of points are interpolated linearly in each tetrahedron, those of cells are the same in all of it. A field is
    never made one of the other kind, and displacements do not move the mesh.
    """

    def __init__(self, points: Any, cells: Any) -> None:
        self._points = _finite("points", points)
        self._cells = _checked_cells(cells, self._points)
        self._fields: dict[str, tuple[FieldMetadata, numpy.ndarray]] = {}

    @classmethod
    def from_tetrahedra(cls, points: Any, cells: Any) -> UnstructuredFieldDataset:
        """A mesh without fields.

        Args:
            points: of the shape (n, 3), mm.
            cells: of the shape (m, 4): numbers of points, from 0, in any order.

        Raises ValueError for arrays of other shapes, points that are not finite or not there, flat tetrahedra.
        """
        return cls(points, cells)

    @property
    def domain(self) -> FieldDomain:
        return FieldDomain(len(self._points), len(self._cells))

    @property
    def field_names(self) -> list[str]:
        """Names of the fields, in the order in which they were added."""
        return list(self._fields)

    def field_metadata(self, name: str) -> FieldMetadata:
        """Returns the description of a field. Raises KeyError."""
        return self._field(name)[0]

    def add_point_scalar(self, name: str, values: Any, units: str = "", step_identifier: str = "",
                         description: str = "") -> None:
        """A number for each point, of the shape (n,). Raises ValueError."""
        self._add(name, values, FieldAssociation.POINT, 1, units, step_identifier, description)

    def add_point_vector(self, name: str, values: Any, units: str = "", step_identifier: str = "",
                         description: str = "") -> None:
        """Three numbers for each point, of the shape (n, 3). Raises ValueError."""
        self._add(name, values, FieldAssociation.POINT, 3, units, step_identifier, description)

    def add_cell_scalar(self, name: str, values: Any, units: str = "", step_identifier: str = "",
                        description: str = "") -> None:
        """A number for each tetrahedron, of the shape (m,). Raises ValueError."""
        self._add(name, values, FieldAssociation.CELL, 1, units, step_identifier, description)

    def add_cell_vector(self, name: str, values: Any, units: str = "", step_identifier: str = "",
                        description: str = "") -> None:
        """Three numbers for each tetrahedron, of the shape (m, 3). Raises ValueError."""
        self._add(name, values, FieldAssociation.CELL, 3, units, step_identifier, description)

    def float_attribute(self, name: str, outside: str = "error", max_distance: float | None = None) -> FloatAttribute:
        """A field of numbers over space.

        Args:
            outside: "error" (a sample of a point outside raises RuntimeError; in jobs there is no number, of which
                those that mix materials warn), or "boundary_clamp" (the value of the nearest place of the mesh's border).
            max_distance: how far that place may be, mm; None: however far.
        """
        return FloatAttribute(self._results(name, 1, outside, max_distance).value)

    def vec3_attribute(self, name: str, outside: str = "error", max_distance: float | None = None) -> Vec3Attribute:
        """An attribute of a field of vectors."""
        vector = self._results(name, 3, outside, max_distance).vector
        return Vec3Attribute(vector.x, vector.y, vector.z)

    def coverage(self, points: Any, outside: str = "error", max_distance: float | None = None) -> FieldCoverage:
        """How many of the points, of the shape (n, 3), an attribute with the same arguments has a value at."""
        self._rule(outside, max_distance)
        places = _finite("points", points)
        here: Any = ombre.results(stored_tetrahedra(self._points, self._cells, self._points, True), outside="nearest")
        nearest = numpy.stack([part(places) for part in (here.vector.x, here.vector.y, here.vector.z)], axis=-1)
        distances = numpy.linalg.norm(places - nearest, axis=1)
        inside = distances <= self._tolerance() * _share_of_rounding / _share_of_tolerance
        adjusted = ~inside & (distances <= self._tolerance())
        most = -1.0 if outside == "error" else numpy.inf if max_distance is None else max_distance
        clamped = ~inside & ~adjusted & (distances <= most)
        failed = numpy.flatnonzero(~inside & ~adjusted & ~clamped)
        worst = failed[numpy.argsort(-distances[failed], kind="stable")][:_most_failures]
        failures = [CoverageFailure(Vec3(*map(float, places[n])), float(distances[n])) for n in worst]
        return FieldCoverage(len(places), int(inside.sum()), int(adjusted.sum()), int(clamped.sum()), len(failed),
                             float(distances[clamped].max(initial=0.0)), failures)

    def transformed(self, position_transform: Any = None, vector_transform: Any = None) -> UnstructuredFieldDataset:
        """A new dataset in another frame. Numbers and units stay what they are.

        Args:
            position_transform: of the points; a matrix of 3 x 3, 3 x 4 or 4 x 4 numbers that multiplies columns, or a
                function of an array of the shape (n, 3) that gives another. None: points stay.
            vector_transform: of the fields of vectors, likewise; of matrices the 3 x 3 to the left counts.
        """
        result = UnstructuredFieldDataset(_transformed(position_transform, self._points, True), self._cells)
        for name, (about, values) in self._fields.items():
            if about.component_count == 3:
                values = _transformed(vector_transform, values, False)
            result._add(name, values, about.association, about.component_count, about.units, about.step_identifier,
                        about.description)
        return result

    def _add(self, name: str, values: Any, association: FieldAssociation, components: int, units: str,
             step_identifier: str, description: str) -> None:
        if not isinstance(name, str) or not name:
            raise ValueError(f"expected the name of a field, found {name!r}")
        if name in self._fields:
            raise ValueError(f"there is a field {name!r} already")
        numbers = numpy.array(values, dtype=float)
        count = len(self._points if association is FieldAssociation.POINT else self._cells)
        shape = (count,) if components == 1 else (count, components)
        if numbers.shape != shape:
            raise ValueError(f"the field {name!r}: expected numbers of the shape {shape}, found {numbers.shape}")
        if not numpy.isfinite(numbers).all():
            raise ValueError(f"the field {name!r} has numbers that are not finite")
        sizes = numbers if components == 1 else numpy.linalg.norm(numbers, axis=1)
        about = FieldMetadata(name, association, components, count, float(sizes.min()), float(sizes.max()), units,
                              step_identifier, description)
        self._fields[name] = about, numbers

    def _field(self, name: str) -> tuple[FieldMetadata, numpy.ndarray]:
        if name not in self._fields:
            raise KeyError(f"there is no field {name!r}; there are {', '.join(self._fields) or 'none'}")
        return self._fields[name]

    def _results(self, name: str, components: int, outside: str, max_distance: float | None) -> Any:
        about, values = self._field(name)
        if about.component_count != components:
            right = "float_attribute" if about.component_count == 1 else "vec3_attribute"
            raise TypeError(f"the field {name!r} has {about.component_count} numbers at a place; ask {right}")
        path = stored_tetrahedra(self._points, self._cells, values, about.association is FieldAssociation.POINT)
        return ombre.results(path, **self._rule(outside, max_distance))

    def _rule(self, outside: str, max_distance: float | None) -> dict[str, Any]:
        if outside not in ("error", "boundary_clamp"):
            raise ValueError(f"outside: expected 'error' or 'boundary_clamp', found {outside!r}")
        if outside == "error":
            if max_distance is not None:
                raise ValueError("max_distance goes with outside='boundary_clamp'")
            return {"outside": "nearest", "within": self._tolerance()}
        return {"outside": "nearest"} | ({} if max_distance is None else {"within": length(max_distance)})

    def _tolerance(self) -> float:
        used = self._points[self._cells]
        return float(_share_of_tolerance * numpy.ptp(used.reshape(-1, 3), axis=0).max())


def _finite(what: str, values: Any) -> numpy.ndarray:
    array = numpy.array([list(v) for v in values], dtype=float) if isinstance(values, list) else numpy.array(
        values, dtype=float)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{what}: expected the shape (n, 3), found {array.shape}")
    if not numpy.isfinite(array).all():
        raise ValueError(f"{what}: not all numbers are finite")
    return array


def _checked_cells(cells: Any, points: numpy.ndarray) -> numpy.ndarray:
    """The cells, each with its corners in the order in which its volume is above 0."""
    numbers = numpy.array(cells)
    if numbers.ndim != 2 or numbers.shape[1] != 4 or not len(numbers):
        raise ValueError(f"cells: expected the shape (m, 4), found {numbers.shape}")
    if numbers.dtype.kind not in "iu":
        raise ValueError(f"cells: expected whole numbers, found {numbers.dtype}")
    wrong = numpy.flatnonzero((numbers < 0).any(axis=1) | (numbers >= len(points)).any(axis=1))
    if len(wrong):
        raise ValueError(f"cells: cell {wrong[0]} names a point that is not there; there are {len(points)}")
    edges = points[numbers[:, 1:]] - points[numbers[:, :1]]
    volumes = numpy.linalg.det(edges)
    flat = numpy.flatnonzero(numpy.abs(volumes) <= 1e-13 * numpy.abs(edges).max(axis=(1, 2)) ** 3)
    if len(flat):
        raise ValueError(f"cells: cell {flat[0]} is flat")
    numbers[volumes < 0] = numbers[volumes < 0][:, [0, 2, 1, 3]]
    return numbers.astype(numpy.int64)


def _transformed(transform: Any | Callable[[numpy.ndarray], Any], values: numpy.ndarray, is_moved: bool
                 ) -> numpy.ndarray:
    if transform is None:
        return values
    if callable(transform):
        result = numpy.array(transform(values.copy()), dtype=float)
        if result.shape != values.shape:
            raise ValueError(f"a transform has to give the shape {values.shape}, found {result.shape}")
        return result
    matrix = numpy.array(transform, dtype=float)
    if matrix.shape not in ((3, 3), (3, 4), (4, 4)):
        raise ValueError(f"expected a matrix of 3 x 3, 3 x 4 or 4 x 4 numbers, or a function, found the shape "
                         f"{matrix.shape}")
    result = values @ matrix[:3, :3].T
    return result + matrix[:3, 3] if is_moved and matrix.shape[1] == 4 else result
