"""Solids that need no others."""
from __future__ import annotations

import os
from typing import Any

import numpy

import ombre

from ._arguments import (Optional, Point, boolean, instance_of, length, material, not_negative, number, read, size, text,
                         vector)
from ._enums import LatticeType
from ._functions import expression
from ._tree import Node, _call_place, in_order
from ._volumes import FloatVolume

class _Unset(int):
    """The material of a node that was given none."""


_unset = _Unset(1)
_one = Optional(material, _unset)


def is_unset(material: int) -> bool:
    """True if it stands for no material that was given."""
    return isinstance(material, _Unset)


def with_unset(tree: Node, material: int) -> Node:
    """The tree, in which nodes that were given no material are of this one, as if it were the one that they have anyway."""
    for node in in_order(tree):
        if is_unset(getattr(node, "_material", 0)):
            node._material = _Unset(material)  # type: ignore[attr-defined]
    return tree


class _Leaf(Node):
    _material: int

    def _says_material(self) -> bool:
        return super()._says_material() or not is_unset(self._material)

    def _own_materials(self) -> set[int]:
        return {self._material}


def _at(center: Point, solid: ombre.Solid) -> ombre.Solid:
    return solid if center == (0, 0, 0) else ombre.translate(solid, center)


class RectPrism(_Leaf):
    """Block with edges along the axes: RectPrism(center, size, material=1)."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        values = read("RectPrism", ({}, {"center": vector, "size": size, "material": _one}), arguments, named)
        self._center: Point = values.get("center", (0, 0, 0))
        self._size: Point = values.get("size", (1, 1, 1))
        self._material = values.get("material", _unset)

    @staticmethod
    def FromMinAndMax(min: Any, max: Any, material: int = _unset) -> RectPrism:
        """The block between two opposite corners."""
        low, high = vector(min), vector(max)
        center = tuple((a + b) / 2 for a, b in zip(low, high))
        given = {} if is_unset(material) else {"material": material}
        return RectPrism(center, tuple(b - a for a, b in zip(low, high)), **given)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return _at(self._center, ombre.rectprism(self._size, self._material))


class Sphere(_Leaf):
    """Ball: Sphere(center, radius, material=1), or the centre as three numbers."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        values = read("Sphere", ({}, {"center": vector, "radius": length, "material": _one},
                                 {"cx": number, "cy": number, "cz": number, "radius": length, "material": _one}),
                      arguments, named)
        self._center: Point = values.get("center") or (
            values.get("cx", 0.0), values.get("cy", 0.0), values.get("cz", 0.0))
        self._radius = values.get("radius", 1.0)
        self._material = values.get("material", _unset)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return _at(self._center, ombre.sphere(self._radius, self._material))


class Torus(_Leaf):
    """Ring in the plane z = 0: Torus(ring, tube, material=1), of the radii of its middle line and of its tube."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        values = read("Torus", ({}, {"r1": length, "r2": length, "material": _one}), arguments, named)
        self._ring, self._tube = values.get("r1", 2.0), values.get("r2", 1.0)
        self._material = values.get("material", _unset)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.torus(self._ring, self._tube, self._material)


class Cylinder(_Leaf):
    """Cylinder along z: Cylinder(center, radius, height, material=1)."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        form = {"center": vector, "radius": length, "height": length, "material": _one}
        values = read("Cylinder", ({}, form), arguments, named)
        self._center: Point = values.get("center", (0, 0, 0))
        self._radius, self._height = values.get("radius", 1.0), values.get("height", 1.0)
        self._material = values.get("material", _unset)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return _at(self._center, ombre.cylinder(self._radius, self._height, self._material))


def _edges(value: Any) -> list[tuple[Point, Point]]:
    if isinstance(value, (str, LatticeType)) or not hasattr(value, "__iter__"):
        raise TypeError(f"expected a list of pairs of Vec3, found {type(value).__name__}")
    edges = []
    for i, edge in enumerate(value):
        if not hasattr(edge, "__len__") or len(edge) != 2:
            raise TypeError(f"edge {i}: expected a pair of Vec3")
        edges.append((vector(edge[0]), vector(edge[1])))
    if not edges:
        raise ValueError("expected at least one edge")
    return edges


_cells = {LatticeType.BodyCenteredCubic: "bcc", LatticeType.FaceCenteredCubic: "fcc", LatticeType.Cubic: "cubic",
          LatticeType.KelvinCell: "kelvin"}


class GraphLattice(_Leaf):
    """Struts with round ends along edges: GraphLattice(edges, radius, material=1); an edge is a pair of Vec3.

    Or those of a unit cell, centred on the origin and cut at its box: GraphLattice(type, size, radius, material=1). Tile
    joins whole struts.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        struts: dict[str, Any] = {"radius": length, "material": _one}
        forms = ({"edges": _edges, **struts}, {"type": instance_of(LatticeType), "size": size, **struts})
        values = read("GraphLattice", forms, arguments, named)
        shape = ({"edges": values["edges"]} if "edges" in values
                 else {"cell": _cells[values["type"]], "size": values["size"]})
        self._shape: dict[str, Any] = shape
        self._radius, self._material = values["radius"], values["material"]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        struts: ombre.Solid = self._struts()
        if "cell" not in self._shape:
            return struts
        return ombre.intersection(struts, ombre.rectprism(self._shape["size"], self._material), materials="first")

    def _struts(self) -> ombre.Solid:
        return ombre.lattice(**self._shape, radius=self._radius, material=self._material)

    def _tiled(self, solid: ombre.Solid) -> ombre.Solid:
        return self._with_attributes(self._struts()) if "cell" in self._shape else solid


class Function(_Leaf):
    """Points of a box where an expression is 0 or less: Function(expr, material=1, min=Vec3(-10, ...), max=Vec3(10, ...)),
    or without the material: Function(expr, min, max).

    The expression is a text, or a function of (x, y, z, rho, phic, r, theta, phis), which is slow.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        corner = (10.0, 10.0, 10.0)
        box = {"min": Optional(vector, tuple(-c for c in corner)), "max": Optional(vector, corner)}
        has_material = len(arguments) < 2 or not hasattr(arguments[1], "__len__")
        material: dict[str, Any] = {"material": _one} if has_material else {}
        form: dict[str, Any] = {"expr": expression, **material, **box}
        values = read("Function", (form,), arguments, named)
        self._expression, self._material = values["expr"], values.get("material", _unset)
        self._min, self._max = values["min"], values["max"]
        if not all(a < b for a, b in zip(self._min, self._max)):
            raise ValueError(f"Function: expected min below max along x, y and z, found {self._min} and {self._max}")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.function(self._expression, self._material, min=self._min, max=self._max)


def _sample_size(value: Any) -> Point | float:
    return length(value) if isinstance(value, float) else size(value)


def _maybe_size(value: Any) -> Any:
    return None if value is None else _sample_size(value)


class Mesh(_Leaf):
    """Solid of a file's triangles: Mesh(path, material=1, disable_validation=False), or of a SurfaceMesh; or without the
    material: Mesh(path, center=False, disable_validation=False, override_voxel_size=None, compensate_slicer_ras=False).

    `center` puts the middle of the box on the origin, `compensate_slicer_ras` mirrors along y. A second argument that is a
    float or a Vec3 is a sample size: it is accepted, as override_voxel_size is, and nothing is sampled, since rows of voxels
    are found exactly. Without validation open meshes are closed by their winding number.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        options = {"material": _one, "disable_validation": Optional(boolean, False)}
        placed = {"center": Optional(boolean, False), "disable_validation": Optional(boolean, False),
                  "override_voxel_size": Optional(_maybe_size, None), "compensate_slicer_ras": Optional(boolean, False)}
        if arguments and hasattr(arguments[0], "_stl_path"):  # a SurfaceMesh, whose file stays as long as it is held
            self._surface = arguments[0]
            arguments = (self._surface._stl_path(), *arguments[1:])
        sampled = {"path": text, "sample_size": _sample_size}
        values = read("Mesh", ({"path": text, **options}, {**sampled, **options}, {"path": text, **placed},
                               {**sampled, **placed}), arguments, named)
        self._path = _find("Mesh", values["path"])
        self._material, self._any_winding = values.get("material", _unset), values["disable_validation"]
        self._is_centered = values.get("center", False)
        self._is_mirrored = values.get("compensate_slicer_ras", False)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        winding: dict[str, Any] = {"inside": "generalized"} if self._any_winding else {}
        solid: ombre.Solid = ombre.mesh(self._path, self._material, **winding)
        if self._is_mirrored:
            solid = ombre.mirror(solid, (0.0, 1.0, 0.0))
        return _centered(solid) if self._is_centered else solid


def _centered(solid: ombre.Solid) -> ombre.Solid:
    """The solid with the middle of its box on the origin."""
    low, high = solid.bounds
    return ombre.translate(solid, tuple(-(a + b) / 2 for a, b in zip(low, high)))


class CAD(_Leaf):
    """Solid of a STEP or IGES file: CAD(path, use_fast_mode=True, material=1).

    The fast mode works by triangles, which are as fine as a job's voxels ask for; the other asks the surfaces themselves.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        form = {"path": text, "use_fast_mode": Optional(boolean, True), "material": _one}
        self._model: Any = None
        values = read("CAD", (form,), arguments, named)
        self._path = _find("CAD", values["path"])
        self._is_fast, self._material = values["use_fast_mode"], values["material"]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.cad(self._path, self._material, mode="fast" if self._is_fast else "exact")


class SignedDistanceField(_Leaf):
    """Solid of a grid in a .vdb file, or of a FloatVolume: distances in mm, negative inside, or with the name "occupancy"
    flags of voxels that are inside.

    SignedDistanceField(vdb_path, grid_name="occupancy", half_width_voxels=3, closing_steps=0, dilation_voxels=0,
    smoothing_steps=3); steps and voxels are for flags. A step of smoothing is the mean over 3 x 3 x 3 voxels; all steps
    together are the Gaussian of the same width.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        none, three = Optional(not_negative, 0), Optional(not_negative, 3)
        form = {"vdb_path": text, "grid_name": Optional(text, "occupancy"), "half_width_voxels": three,
                "closing_steps": none, "dilation_voxels": none, "smoothing_steps": three, "material": _one}
        own = {"volume": instance_of(FloatVolume), "material": _one}
        values = read("SignedDistanceField", (form, own), arguments, named)
        self._material = values["material"]
        self._closing, self._dilation = values.get("closing_steps", 0), values.get("dilation_voxels", 0)
        self._smoothing, self._is_binary = values.get("smoothing_steps", 0), False
        if "volume" in values:
            self._grid: FloatVolume = values["volume"]
            return
        path = _find("SignedDistanceField", values["vdb_path"])
        self._grid = FloatVolume(path, None, False, values["grid_name"], margin=1.0)
        self._is_binary = self._grid._range[0] >= 0

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        grid = self._grid
        options = {**grid._options, **({"series": grid._series} if grid._series else {})}
        solid: ombre.Solid = ombre.volume_solid(grid._path, self._material, level=0.5 if self._is_binary else 0.0,
                                                above=self._is_binary, **options)
        if not self._is_binary:
            return solid
        pitch = tuple(float(numpy.linalg.norm(step)) for step in grid._steps)
        if self._closing:
            solid = ombre.closing(solid, self._closing * min(pitch), pitch=pitch)
        if self._dilation:
            solid = ombre.dilate(solid, self._dilation * min(pitch), pitch=pitch)
        width = (2 / 3 * self._smoothing) ** 0.5  # the mean over three voxels in a row has a variance of 2/3
        return ombre.smooth(solid, width * min(pitch), pitch=pitch) if self._smoothing else solid


def _find(node: str, path: str) -> str:
    """A file, relative to the script, then to the working directory. Raises FileNotFoundError."""
    script = _call_place()[0]
    for folder in (os.path.dirname(os.path.abspath(script)), os.getcwd()):
        if os.path.isfile(os.path.join(folder, path)):
            return os.path.normpath(os.path.join(folder, path))
    raise FileNotFoundError(f"{node}: there is no file {path}, neither beside {os.path.basename(script)} nor in "
                            f"{os.getcwd()}")
