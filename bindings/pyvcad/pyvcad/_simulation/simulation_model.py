"""Meshes for simulations as arrays."""
from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy


class SimulationCellType(enum.Enum):
    """Bricks of eight nodes, tetrahedra of four."""

    HEX8 = 8
    TET4 = 4


@dataclass(frozen=True)
class SimulationModel:
    """A mesh with its materials, as arrays.

    Attributes:
        cell_type, nodes_per_cell: HEX8 and 8, or TET4 and 4.
        nodes: of the shape (n, 3), mm.
        connectivity: (m * nodes_per_cell,), numbers of nodes from 0, element after element.
        cell_centroids: (m, 3), mm.
        material_ids: (m,)
        material_names: {id: name} of the materials that the fractions or the elements have.
        volume_fraction_fields: {"volume_fraction_ID": (m,)}
        scalar_fields: {name: (m,)} of the direct attributes.
    """

    cell_type: SimulationCellType
    nodes_per_cell: int
    nodes: numpy.ndarray
    connectivity: numpy.ndarray
    cell_centroids: numpy.ndarray
    material_ids: numpy.ndarray
    material_names: dict[int, str]
    volume_fraction_fields: dict[str, numpy.ndarray]
    scalar_fields: dict[str, numpy.ndarray]
