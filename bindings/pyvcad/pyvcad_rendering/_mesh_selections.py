"""Selections of triangles in files."""
from __future__ import annotations

import hashlib
import json
import os
from typing import Any

from pyvcad import MeshSelection, SurfaceMesh
from pyvcad._tree import Node

_version = 1
Path = str | os.PathLike[str]


def resolve_selection_mesh(node: Any, voxel_size: Any = None) -> SurfaceMesh:
    """The triangles that are selected from: a SurfaceMesh itself, or the surface of a node."""
    if isinstance(node, SurfaceMesh):
        return node
    if not isinstance(node, Node):
        raise TypeError(f"resolve_selection_mesh: expected a SurfaceMesh or a node, found {type(node).__name__}")
    if voxel_size is None:
        raise TypeError("resolve_selection_mesh: a node needs a voxel_size, mm")
    return SurfaceMesh(node, voxel_size)


def save_mesh_selection(selection: MeshSelection, file: Path) -> None:
    """Writes the numbers of the triangles, and which mesh they are of, as JSON."""
    if not isinstance(selection, MeshSelection):
        raise TypeError(f"save_mesh_selection: expected a MeshSelection, found {type(selection).__name__}")
    with open(file, "w", encoding="utf-8") as out:
        json.dump({"version": _version, "mesh": _identity(selection._mesh), "triangles": selection.triangle_ids}, out)


def load_mesh_selection(file: Path, mesh: SurfaceMesh) -> MeshSelection:
    """The selection of a file. Raises RuntimeError for a mesh that is not the one that it was made of."""
    with open(file, encoding="utf-8") as source:
        try:
            stored = json.load(source)
        except ValueError as error:
            raise RuntimeError(f"load_mesh_selection: {os.fspath(file)} is no selection: {error}") from None
    if not isinstance(stored, dict) or stored.get("version") != _version or not isinstance(stored.get("triangles"), list):
        raise RuntimeError(f"load_mesh_selection: {os.fspath(file)} is no selection of version {_version}; save it again by "
                           "save_mesh_selection")
    if stored.get("mesh") != _identity(mesh):
        raise RuntimeError("load_mesh_selection: the mesh is not the one that the selection was made of; select again, for "
                           "example by mesh.nearest_triangle(point) and mesh.select_linked_by_face_angle")
    return MeshSelection(mesh, stored["triangles"])


def _identity(mesh: SurfaceMesh) -> str:
    """A hash of the mesh, which changes with every vertex and triangle."""
    digest = hashlib.sha256(mesh.vertices.astype("<f8").tobytes())
    digest.update(mesh.triangles.astype("<i8").tobytes())
    return digest.hexdigest()
