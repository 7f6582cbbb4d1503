"""Samples a tree at points and on grids, attribute by attribute."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import numpy

import ombre

from . import _grids
from ._arguments import number
from ._arguments import voxel_size as read_voxel
from ._attributes import FloatAttribute
from ._colour_maps import ColorMap
from ._defined import FRACTIONS, are_everywhere, given, marked_design, marker, names_of
from ._errors import WrongValue
from ._materials import MaterialDefs, expect_table
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
    """The distance at each point, of the shape (N, 3), and the attributes that are given there; None outside."""
    own = names_of(node)
    is_everywhere = are_everywhere(node, own)
    design = node._design() if is_everywhere else marked_design(node)
    found = design.sample(points)
    markers = {name: found.attribute.pop(marker(name), None) for name in {*own, FRACTIONS}}
    columns = {name: _values(values) for name, values in found.attribute.items()}
    if FRACTIONS in own and (is_everywhere or markers[FRACTIONS] is not None):
        columns[FRACTIONS] = _distributions(design, found.material)
    rows: list[dict[str, Any]] = [{} for _ in points]
    for name, values in columns.items():
        found_marker = markers.get(name)
        is_given = numpy.ones(len(points), dtype=bool) if found_marker is None else found_marker > 0.5
        if name in found.attribute:
            _check_finite(name, found.attribute[name], points, (found.distance <= 0) & is_given)
        for row, value, has in zip(rows, values, _listed(is_given)):
            if has:
                row[name] = value
    return [(distance, AttributeSamples(row) if distance <= 0 else None)
            for distance, row in zip(_listed(found.distance), rows)]


def _check_finite(name: str, values: numpy.ndarray, points: numpy.ndarray, where: numpy.ndarray) -> None:
    bad = numpy.flatnonzero(where & ~numpy.isfinite(values.reshape(len(points), -1)).all(axis=1))
    if len(bad):
        place = ", ".join(f"{c:g}" for c in points[bad[0]])
        raise RuntimeError(f"the attribute {name!r} has no finite value at ({place}): a formula divides by 0 there, or a "
                           "table has no valid entry")


class TreeSampler:
    """Samples a tree on the voxels of its bounding box: TreeSampler(root, voxel_size, material_defs=None).

    Arrays have the shape (nx, ny, nz), with one more axis for vectors, colours and materials. They are 0 outside, and where
    nothing gives the attribute.
    """

    def __init__(self, root: Any, voxel_size: Any, material_defs: Any = None) -> None:
        self._root, self._voxel = as_node(root), read_voxel(voxel_size)
        self._materials = None if material_defs is None else expect_table("TreeSampler", material_defs)
        self._design: ombre.Design = self._root._ombre_design_(self._materials) if self._materials \
            else self._root._design()
        self._range: tuple[float, float] | None = None  # of numbers, for colours
        self._override: tuple[float, float] | None = None
        self._shows_undefined = True

    def _in_layers(self, take: Callable[[numpy.ndarray], numpy.ndarray], progress: Any) -> numpy.ndarray:
        """What a function gives for points, at all voxels: of the shape (nz, ny, nx, ...)."""
        axes = _grids.centers(self._design.bounds, self._voxel)
        return numpy.concatenate([take(points) for _, points in _grids.slabs(axes, progress)])

    def _on_grid(self, take: Callable[[numpy.ndarray], numpy.ndarray], progress: Any) -> numpy.ndarray:
        """The same, of the shape (nx, ny, nz, ...)."""
        return numpy.ascontiguousarray(self._in_layers(take, progress).swapaxes(0, 2))

    def sample_dimensions(self) -> tuple[int, int, int]:
        x, y, z = (len(axis) for axis in _grids.centers(self._design.bounds, self._voxel))
        return x, y, z

    def as_signed_distance_array(self, progress: Any = None) -> tuple[int, int, int, numpy.ndarray]:
        grid = _grids.distances(self._design, self._voxel, progress)
        nx, ny, nz = grid.shape
        return nx, ny, nz, grid.transpose(2, 1, 0).reshape(-1)

    def as_float_array(self, name: str, progress: Any = None) -> numpy.ndarray:
        return self._on_grid(lambda points: self._attribute(name, 1, points), progress)

    def as_vec3_array(self, name: str, progress: Any = None) -> numpy.ndarray:
        return self._on_grid(lambda points: self._attribute(name, 3, points), progress)

    def as_vec4_array(self, name: str, progress: Any = None) -> numpy.ndarray:
        return self._on_grid(lambda points: self._attribute(name, 4, points), progress)

    def _attribute(self, name: str, size: int, points: numpy.ndarray) -> numpy.ndarray:
        values = self._design.attribute(name, points)
        found = 1 if values.ndim == points.ndim - 1 else values.shape[-1]
        if found != size:
            raise RuntimeError(f"TreeSampler: the attribute {name!r} has {found} numbers, not {size}")
        values[~self._is_given(name, points)] = 0
        return values.astype(numpy.float32)

    def _is_given(self, name: str, points: numpy.ndarray) -> numpy.ndarray:
        """True within the part where the tree gives the attribute."""
        return cast("numpy.ndarray", self._design.inside(points) & given(self._root, name, points))

    def as_material_fraction_array(self, name: str = "volume_fractions", progress: Any = None) -> numpy.ndarray:
        grid = self._on_grid(lambda points: self._fractions(name, points), progress)
        return grid.reshape(-1, grid.shape[-1])

    def _fractions(self, name: str, points: numpy.ndarray) -> numpy.ndarray:
        if self._materials is None:
            raise RuntimeError("TreeSampler: fractions of materials need material_defs")
        if name != FRACTIONS:
            raise RuntimeError(f"TreeSampler: fractions are those of the attribute {FRACTIONS!r}, found {name!r}")
        design = self._design
        names = design.materials.names
        result = numpy.zeros((*points.shape[:-1], len(names)), dtype=numpy.float32)
        for material, values in design.material(points).items():
            result[..., names.index(material)] = values
        result[~self._is_given(name, points)] = 0
        return result

    # Colours.

    def get_double_attribute_min_max(self) -> tuple[float, float]:
        """The numbers of the first and the last colour: those that were set, else the range of the numbers coloured last."""
        found = self._override or self._range
        if found is None:
            raise RuntimeError("TreeSampler: no number has been coloured; call as_rgba_array first")
        return found

    def set_double_attribute_range_override(self, min: float, max: float) -> None:
        """Sets the numbers of the first and the last colour."""
        if not number(min) < number(max):
            raise WrongValue(f"set_double_attribute_range_override: expected min < max, found {min} and {max}")
        self._override = float(min), float(max)

    def clear_double_attribute_range_override(self) -> None:
        self._override = None

    def set_undefined_attribute_pattern_enabled(self, is_enabled: bool) -> None:
        """Whether places without the attribute are gray; else they are transparent."""
        self._shows_undefined = bool(is_enabled)

    def as_rgba_array(self, name: str, color_map: Any, blend: bool = True,
                      progress: Any = None) -> tuple[int, int, int, numpy.ndarray]:
        """The counts of voxels, and their colours in bytes, x fastest, then y, then z: red, green, blue, opacity; 0 outside.

        Numbers have the colour of the map at 0 to 1, for the least to the greatest of them. Vectors and colours are colours
        themselves; fractions are those of the materials, mixed or that of the greatest.
        """
        shades = self._in_layers(self._shades_of(name, blend), progress)
        nz, ny, nx, columns = shades.shape
        return nx, ny, nz, self._colours(shades.reshape(-1, columns), name, color_map).reshape(-1)

    def sample_points_to_colors(self, points: Any, name: str, color_map: Any, blend: bool = True) -> list[Vec4]:
        """Red, green, blue and opacity of each point, 0 to 1."""
        return [Vec4(*row) for row in _listed(self._colours(self._shades_of(name, blend)(_array(points)), name, color_map) / 255)]

    def _shades_of(self, name: str, blend: bool) -> Callable[[numpy.ndarray], numpy.ndarray]:
        """A function of points: whether they are inside, whether the attribute is given there, and its numbers, or the colour of
        fractions."""
        own = self._root.attribute_list()
        if name not in own:
            raise RuntimeError(f"TreeSampler: no node of the tree has the attribute {name!r}; it has {', '.join(own) or 'none'}")

        def at(points: numpy.ndarray) -> numpy.ndarray:
            values = self._fraction_colours(points, blend) if name == FRACTIONS else self._design.attribute(name, points)
            numbers = values[..., None] if values.ndim < points.ndim else values
            claims = [self._design.inside(points)[..., None], self._is_given(name, points)[..., None]]
            return numpy.concatenate([*claims, numbers], axis=-1)
        return at

    def _colours(self, shades: numpy.ndarray, name: str, color_map: Any) -> numpy.ndarray:
        inside, is_given, values = shades[:, 0] > 0, shades[:, 1] > 0, shades[:, 2:]
        colours = values if name == FRACTIONS else self._value_colours(values, is_given, color_map)
        colours[inside & ~is_given] = (128, 128, 128, 255) if self._shows_undefined else 0
        colours[~inside] = 0
        return numpy.rint(colours).astype(numpy.uint8)

    def _fraction_colours(self, points: numpy.ndarray, blend: bool) -> numpy.ndarray:
        fractions, table = self._fractions(FRACTIONS, points), cast("MaterialDefs", self._materials)
        palette = numpy.array([list(table.color(id)) for id in range(fractions.shape[-1])])
        return fractions @ palette if blend else palette[fractions.argmax(axis=-1)].astype(float)

    def _value_colours(self, values: numpy.ndarray, is_given: numpy.ndarray, color_map: Any) -> numpy.ndarray:
        if values.shape[1] == 1:
            values = self._mapped(values[:, 0], is_given, color_map)
        opaque = numpy.ones((len(values), 1))
        return 255 * numpy.clip(values if values.shape[1] == 4 else numpy.concatenate([values, opaque], axis=1), 0, 1)

    def _mapped(self, values: numpy.ndarray, is_given: numpy.ndarray, color_map: Any) -> numpy.ndarray:
        if not isinstance(color_map, ColorMap):
            raise TypeError(f"TreeSampler: expected a ColorMap, found {type(color_map).__name__}")
        shown = values[is_given & numpy.isfinite(values)]
        self._range = (float(shown.min()), float(shown.max())) if len(shown) else (0.0, 1.0)
        low, high = self.get_double_attribute_min_max()
        return color_map._colors((values - low) / (high - low or 1.0))

    def save_openvdb_occupancy_grid(self, path: Any) -> None:
        """Writes a grid "occupancy" of OpenVDB: 1 in voxels whose middle is inside."""
        with_occupancy(self._root)._design().write_voxels(str(path), voxel=",".join(map(repr, self._voxel)), what=OCCUPANCY,
                                                          force=True)

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
        return self._fractions(name, _array(points))


OCCUPANCY = "occupancy"


def with_occupancy(root: Node) -> Node:
    """A copy of the tree with an attribute that is 1 inside; grids have 0 outside."""
    tree = root.clone()
    tree._attributes[OCCUPANCY] = FloatAttribute(1)
    return tree


def _array(points: Any) -> numpy.ndarray:
    if not isinstance(points, numpy.ndarray):
        points = [tuple(point) for point in points]
    return numpy.asarray(points, dtype=float).reshape(-1, 3)


# It is set here instead of in the class, which samples know.
setattr(Node, "sample", lambda self, x, y, z: sampled(self, _array([(x, y, z)]))[0])
