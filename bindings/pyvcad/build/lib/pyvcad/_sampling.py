"""Samples a tree at points and on grids, attribute by attribute."""
from __future__ import annotations

from typing import Any, cast

import numpy

import ombre

from . import _grids
from ._arguments import voxel_size as read_voxel
from ._materials import expect_table
from ._samples import AttributeSamples
from ._tree import Node, as_node
from ._vectors import Vec3, Vec4


def _listed(array: numpy.ndarray) -> list[Any]:
    """The array as a list, of lists if it has several axes."""
    return cast("list[Any]", array.tolist())


def _values(found: numpy.ndarray) -> list[Any]:
    """An attribute's values, one a point, as numbers or as vectors."""
    kind = {3: Vec3, 4: Vec4}.get(found.shape[1]) if found.ndim == 2 else None
    if kind is not None:
        return [kind(*numbers) for numbers in _listed(found)]
    return _listed(found[:, 0] if found.ndim == 2 else found)


def _distributions(design: ombre.Design, fractions: dict[str, numpy.ndarray]) -> list[dict[int, float]]:
    """{material's id: volume fraction} of each point."""
    names = design.materials.names
    ids = [names.index(name) for name in fractions]
    rows = _listed(numpy.stack(list(fractions.values()), axis=-1))
    return [{material: share for material, share in zip(ids, row) if share > 0} for row in rows]


def sampled(node: Node, points: numpy.ndarray) -> list[tuple[float, AttributeSamples | None]]:
    """The distance at each point, of the shape (N, 3), and the attributes there; None outside."""
    design = node._design()
    found = design.sample(points)
    columns = {name: _values(values) for name, values in found.attribute.items()}
    if "volume_fractions" in node.attribute_list():
        columns["volume_fractions"] = _distributions(design, found.material)
    names = list(columns)
    rows = zip(*columns.values()) if columns else [()] * len(points)
    return [(distance, AttributeSamples(dict(zip(names, row))) if distance <= 0 else None)
            for distance, row in zip(_listed(found.distance), rows)]


class TreeSampler:
    """Samples a tree on the voxels of its bounding box: TreeSampler(root, voxel_size, material_defs=None).

    Arrays have the shape (nx, ny, nz), with one more axis for vectors, colours and materials.
    """

    def __init__(self, root: Any, voxel_size: Any, material_defs: Any = None) -> None:
        self._root, self._voxel = as_node(root), read_voxel(voxel_size)
        self._materials = None if material_defs is None else expect_table("TreeSampler", material_defs)
        self._design: ombre.Design = self._root._ombre_design_(self._materials) if self._materials \
            else self._root._design()

    def _points(self) -> numpy.ndarray:
        axes = _grids.centers(self._design.bounds, self._voxel)
        return numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1)

    def sample_dimensions(self) -> tuple[int, int, int]:
        x, y, z = (len(axis) for axis in _grids.centers(self._design.bounds, self._voxel))
        return x, y, z

    def as_signed_distance_array(self, progress: Any = None) -> tuple[int, int, int, numpy.ndarray]:
        grid = _grids.distances(self._design, self._voxel, progress)
        nx, ny, nz = grid.shape
        return nx, ny, nz, grid.transpose(2, 1, 0).reshape(-1)

    def as_float_array(self, name: str, progress: Any = None) -> numpy.ndarray:
        return self._attribute(name, 1)

    def as_vec3_array(self, name: str, progress: Any = None) -> numpy.ndarray:
        return self._attribute(name, 3)

    def as_vec4_array(self, name: str, progress: Any = None) -> numpy.ndarray:
        return self._attribute(name, 4)

    def _attribute(self, name: str, size: int, points: Any = None) -> numpy.ndarray:
        values = self._design.attribute(name, self._points() if points is None else points)
        found = 1 if values.ndim == (4 if points is None else 2) - 1 else values.shape[-1]
        if found != size:
            raise RuntimeError(f"TreeSampler: the attribute {name!r} has {found} numbers, not {size}")
        return values.astype(numpy.float32)

    def as_material_fraction_array(self, name: str = "volume_fractions", progress: Any = None) -> numpy.ndarray:
        if self._materials is None:
            raise RuntimeError("TreeSampler: fractions of materials need material_defs")
        points = self._points().reshape(-1, 3)
        return self._fractions(points)

    def _fractions(self, points: numpy.ndarray) -> numpy.ndarray:
        design = self._design
        names = design.materials.names
        result = numpy.zeros((len(points), len(names)), dtype=numpy.float32)
        for material, values in design.material(points).items():
            result[:, names.index(material)] = values
        return result

    def evaluate_points(self, points: Any) -> list[float]:
        return [float(d) for d in self._design.distance(_array(points))]

    def sample_points(self, points: Any) -> list[tuple[float, AttributeSamples | None]]:
        return sampled(self._root, _array(points))

    def sample_line(self, start: Any, end: Any, count: int) -> list[tuple[float, AttributeSamples | None]]:
        if count < 2:
            raise ValueError(f"sample_line: expected 2 points or more, found {count}")
        a, b = numpy.array(list(start)), numpy.array(list(end))
        return self.sample_points([a + (b - a) * n / (count - 1) for n in range(count)])

    def sample_points_to_float_array(self, points: Any, name: str) -> list[float]:
        return [float(v) for v in self._attribute(name, 1, _array(points))]

    def sample_points_to_vec3_array(self, points: Any, name: str) -> list[Vec3]:
        return [Vec3(*map(float, v)) for v in self._attribute(name, 3, _array(points))]

    def sample_points_to_vec4_array(self, points: Any, name: str) -> list[Vec4]:
        return [Vec4(*map(float, v)) for v in self._attribute(name, 4, _array(points))]

    def sample_points_to_material_fraction_array(self, points: Any, name: str = "volume_fractions") -> numpy.ndarray:
        if self._materials is None:
            raise RuntimeError("TreeSampler: fractions of materials need material_defs")
        return self._fractions(_array(points))


def _array(points: Any) -> numpy.ndarray:
    if not isinstance(points, numpy.ndarray):
        points = [tuple(point) for point in points]
    return numpy.asarray(points, dtype=float).reshape(-1, 3)


# It is set here instead of in the class, which samples know.
Node.sample = lambda self, x, y, z: sampled(self, _array([(x, y, z)]))[0]  # type: ignore[attr-defined]
