"""Meshes of elements that fill a tree: bricks and tetrahedra."""
from __future__ import annotations

import os
from typing import Any

import numpy

from .._arguments import Optional, Point, length, number, read, text, voxel_size
from .elements import Elements, TetraCriteria, bricks_of, tetrahedra_of
from .inp import write_inp
from .._materials import MaterialDefs, default_materials, expect_table
from .._tree import Node, as_node
from .._vectors import Vec3


class _Array(numpy.ndarray):
    """An array that gives itself when it is called: `mesh.nodes` and `mesh.nodes()` are the same."""

    def __call__(self) -> _Array:
        return self


def _callable(array: numpy.ndarray) -> _Array:
    return array.view(_Array)


class _ElementMesh:
    """Base of meshes of both kinds; `nodes`, `elements` and `cell_centroids` may be called, too."""

    _elements: Elements | None = None

    def _made(self) -> Elements:
        if self._elements is None:
            raise RuntimeError(f"{type(self).__name__}: it is not computed yet; call compute()")
        return self._elements

    @property
    def nodes(self) -> _Array:
        """Places of the nodes, of the shape (n, 3), mm."""
        return _callable(self._made().nodes)

    @property
    def elements(self) -> _Array:
        """Numbers of nodes, from 0; of the shape (m, 8) for bricks, (m, 4) for tetrahedra."""
        return _callable(self._made().cells)

    @property
    def cell_centroids(self) -> _Array:
        """Centroids of the shape (m, 3), mm."""
        return _callable(self._made().centroids)

    def number_of_nodes(self) -> int:
        return len(self._made().nodes)

    def number_of_elements(self) -> int:
        return len(self._made().cells)

    def bounding_box(self) -> tuple[Vec3, Vec3]:
        """The least and the greatest corner of the mesh, mm."""
        nodes = self._made().nodes
        return Vec3(*map(float, nodes.min(axis=0))), Vec3(*map(float, nodes.max(axis=0)))

    def material_assignments(self) -> numpy.ndarray:
        """An id for each element, drawn by the odds of the fractions at its middle."""
        return self._made().material_ids


class HexahedralMesh(_ElementMesh):
    """Bricks where voxels have their centre inside: HexahedralMesh.from_tree(root, settings), or
    HexahedralMesh(node, nx, ny, nz), so many voxels along the sides of the bounding box, and compute()."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        form = {"node": as_node, "nx": _count, "ny": _count, "nz": _count}
        values = read("HexahedralMesh", (form,), arguments, named)
        self._root: Node = values["node"]
        low, high = self._root.bounding_box()
        x, y, z = ((b - a) / values[n] for a, b, n in zip(low, high, ("nx", "ny", "nz")))
        self._cell: Point = (x, y, z)

    @classmethod
    def from_tree(cls, root: Any, settings: Any = None) -> HexahedralMesh:
        """Bricks of the size `settings.voxel_size`; instead of settings also that length itself, or a Vec3; mm.

        Raises ombre.DesignError where no voxel has its centre inside.
        """
        mesh = object.__new__(cls)
        mesh._root = as_node(root)
        mesh._cell = voxel_size(getattr(settings, "voxel_size", 1.0 if settings is None else settings))
        mesh.compute()
        return mesh

    def compute(self) -> None:
        """Makes the bricks."""
        self._elements = bricks_of(self._root._design(), self._cell)

    def voxel_size(self) -> Vec3:
        return Vec3(*self._cell)


class TetrahedralMesh(_ElementMesh):
    """Tetrahedra up to the surface, by TetrahedralMesh.from_tree."""

    def __init__(self) -> None:
        raise TypeError("a TetrahedralMesh is made by TetrahedralMesh.from_tree(root, ...)")

    @classmethod
    def from_tree(cls, *arguments: Any, **named: Any) -> TetrahedralMesh:
        """from_tree(root, settings), from_tree(root, facet_angle, facet_size, facet_distance, cell_radius_edge_ratio,
        cell_size), or with cell_size_lower, cell_size_upper and variable_cell_size_expression in place of the last.

        The formula knows min_cell, max_cell and h, which is 1 where there is one material, and 0 in an even mixture. The
        mesh is as fine as the finest of the lengths asks; the angle and the ratio are always 25 degrees and 2.2. Raises
        ombre.DesignError.
        """
        common: dict[str, Any] = {"root": as_node, "facet_angle": number, "facet_size": length, "facet_distance": length,
                                  "cell_radius_edge_ratio": number}
        forms = ({"root": as_node, "settings": Optional(tetra_criteria, TetraCriteria(1.0, 0.25, 1.0))},
                 {**common, "cell_size": length},
                 {**common, "cell_size_lower": length, "cell_size_upper": length,
                  "variable_cell_size_expression": Optional(text, TetraCriteria._field_defaults["formula"])})
        values = read("TetrahedralMesh.from_tree", forms, arguments, named)
        mesh = object.__new__(cls)
        mesh._root = values["root"]
        mesh._elements = tetrahedra_of(mesh._root._design(), _criteria(values))
        return mesh

    _root: Node

    def write_to_inp(self, filename: Any, material_defs: Any = None, root: Any = None) -> None:
        """Writes a deck with a set of tetrahedra for each material.

        Args:
            material_defs: a MaterialDefs, for names and properties; None: the default one.
            root: the tree that says of what the tetrahedra are; None: that of the mesh. Raises ValueError where it is
                another one and the middle of a tetrahedron is outside.
        """
        table = expect_table("write_to_inp", material_defs) or default_materials
        ids = self._made().material_ids
        if root is not None and as_node(root) is not self._root:
            ids = drawn_at(as_node(root), table, self._made().centroids)
        write_inp(os.fspath(filename), self._made().nodes, self._made().cells, ids, described(table))


def _count(value: Any) -> int:
    if isinstance(value, bool) or number(value) != int(number(value)) or value < 1:
        raise ValueError(f"expected a count, 1 or more, found {value!r}")
    return int(value)


def tetra_criteria(settings: Any) -> TetraCriteria:
    """Criteria of a SimulationTetFixedMeshSettings."""
    try:
        lengths = settings.facet_size, settings.facet_distance, settings.cell_size
    except AttributeError:
        raise TypeError(f"expected a SimulationTetFixedMeshSettings, found {type(settings).__name__}") from None
    facet_size, facet_distance, cell_size = (length(value) for value in lengths)
    return TetraCriteria(facet_size, facet_distance, cell_size)


def _criteria(values: dict[str, Any]) -> TetraCriteria:
    if "settings" in values:
        criteria: TetraCriteria = values["settings"]
        return criteria
    if "cell_size" in values:
        return TetraCriteria(values["facet_size"], values["facet_distance"], values["cell_size"])
    low, high = values["cell_size_lower"], values["cell_size_upper"]
    if low > high:
        raise ValueError(f"TetrahedralMesh.from_tree: expected cell_size_lower <= cell_size_upper, found {low:g} and "
                         f"{high:g}")
    return TetraCriteria(values["facet_size"], values["facet_distance"], (low, high),
                         values["variable_cell_size_expression"])


def described(table: MaterialDefs) -> dict[int, dict[str, Any]]:
    """Names and properties by id."""
    return {entry["id"]: entry for entry in table._entries()}


def drawn_at(root: Node, table: MaterialDefs, points: numpy.ndarray) -> numpy.ndarray:
    """An id for each point, drawn by the odds of the tree's fractions there. Raises ValueError for points outside."""
    design = root._ombre_design_(table)
    outside = int((design.distance(points) > 0).sum())
    if outside:
        raise ValueError(f"write_to_inp: the middles of {outside} elements lie outside the tree that has the materials")
    shares = {design.materials.names.index(name): values for name, values in design.material(points).items()}
    ids = numpy.array(sorted(shares))
    limits = numpy.cumsum([shares[i] for i in ids], axis=0)
    draws = numpy.random.default_rng(0).random(len(points)) * limits[-1]
    chosen: numpy.ndarray = ids[(limits <= draws).sum(axis=0)]
    return chosen
