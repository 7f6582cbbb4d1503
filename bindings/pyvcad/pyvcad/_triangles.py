"""Surfaces of triangles, from files, arrays and nodes."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable
from typing import Any

import numpy

from ._arguments import boolean, length, size
from ._selections import Selecting
from ._solids import Mesh, _find
from ._tree import Node


class Triangles:
    """Triangles with shared vertices."""

    _vertices: numpy.ndarray
    _triangles: numpy.ndarray

    @property
    def vertices(self) -> numpy.ndarray:
        """Vertices of the shape (n, 3), mm."""
        return self._vertices

    @property
    def triangles(self) -> numpy.ndarray:
        """Triangles of the shape (n, 3): numbers of vertices, from 0."""
        return self._triangles


class SurfaceMesh(Triangles, Selecting):
    """A closed surface of triangles, mm: SurfaceMesh(path), (vertices, triangles) or (node, voxel_size).

    `vertices` are points, `triangles` three numbers of vertices each, counterclockwise from outside. A node's surface lies
    within an eighth of the voxel size. Mesh(surface) is the solid within. Raises RuntimeError for triangles that name
    vertices which are not there, or that leave edges open unless disable_validation is set.
    """

    def __init__(self, first: Any, second: Any = None, disable_validation: bool = False) -> None:
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        if isinstance(first, (str, os.PathLike)):
            self._read(_find("SurfaceMesh", os.fspath(first)))
        elif isinstance(first, Node):
            self._read_node(first, second)
        else:
            self._take(first, second)
        if not boolean(disable_validation):
            self._check()

    def write_stl(self, path: Any) -> None:
        """Binary STL, mm."""
        triangles = self._vertices[self._triangles].astype("<f4")
        normals = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
        rows = numpy.zeros(len(triangles), dtype=[("numbers", "<f4", (4, 3)), ("unused", "<u2")])
        rows["numbers"][:, 0] = numpy.divide(normals, lengths, out=numpy.zeros_like(normals), where=lengths > 0)
        rows["numbers"][:, 1:] = triangles
        with open(path, "wb") as file:
            file.write(b"triangles".ljust(80, b" ") + len(rows).to_bytes(4, "little") + rows.tobytes())

    def _stl_path(self) -> str:
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(prefix="ombre_")
            self.write_stl(os.path.join(self._folder.name, "surface.stl"))
        return os.path.join(self._folder.name, "surface.stl")

    def _take(self, vertices: Iterable[Any], triangles: Any) -> None:
        points = [tuple(v) if not hasattr(v, "x") else (v.x, v.y, v.z) for v in vertices]
        self._vertices = numpy.array(points, dtype=float).reshape(-1, 3)
        self._triangles = numpy.array(triangles, dtype=numpy.int64).reshape(-1, 3)
        if self._triangles.size and not 0 <= self._triangles.min() <= self._triangles.max() < len(self._vertices):
            raise RuntimeError("SurfaceMesh: a triangle names a vertex that is not there")

    def _read_node(self, node: Node, voxel_size: Any) -> None:
        voxel = min(size(voxel_size)) if hasattr(voxel_size, "x") else length(voxel_size)
        self._read_design(node._design(), tolerance=voxel / 8)

    def _read(self, path: str) -> None:
        if path.lower().endswith(".stl"):
            self._read_stl(path)
        else:
            self._read_design(Mesh(path)._design())

    def _read_design(self, design: Any, **options: Any) -> None:
        with tempfile.TemporaryDirectory(prefix="ombre_") as folder:
            path = os.path.join(folder, "surface.stl")
            design.mesh(path, **options)
            self._read_stl(path)

    def _read_stl(self, path: str) -> None:
        with open(path, "rb") as file:
            data = file.read()
        count = int.from_bytes(data[80:84], "little")
        if len(data) == 84 + 50 * count:
            rows = numpy.frombuffer(data, dtype=[("numbers", "<f4", (4, 3)), ("unused", "<u2")], offset=84)
            points: numpy.ndarray = rows["numbers"][:, 1:].reshape(-1, 3).astype(float)
        else:
            lines = [line.split() for line in data.decode("ascii", "replace").splitlines()]
            points = numpy.array([[float(n) for n in line[1:4]] for line in lines if line[:1] == ["vertex"]])
        self._vertices, numbers = numpy.unique(points.reshape(-1, 3), axis=0, return_inverse=True)
        self._triangles = numbers.reshape(-1, 3)

    def _check(self) -> None:
        if not len(self._triangles):
            raise RuntimeError("SurfaceMesh: there are no triangles")
        edges = numpy.concatenate([self._triangles[:, [0, 1]], self._triangles[:, [1, 2]], self._triangles[:, [2, 0]]])
        there, counts = numpy.unique(edges, axis=0, return_counts=True)
        back, back_counts = numpy.unique(edges[:, ::-1], axis=0, return_counts=True)
        if not (numpy.array_equal(there, back) and numpy.array_equal(counts, back_counts)):
            raise RuntimeError("SurfaceMesh: the surface is not closed; pass disable_validation=True to take it as it is")
