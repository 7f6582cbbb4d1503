"""What lattices and their cells are like."""
from __future__ import annotations

import math
from collections import Counter
from typing import Any, NamedTuple

from pyvcad._arguments import length, vector
from pyvcad._arguments import voxel_size as _voxel_size
from pyvcad._missing import attribute_of
from pyvcad._tree import as_node
from pyvcad._unit_cells import graph_cell
from pyvcad._vectors import Vec3


class GraphCellProperties(NamedTuple):
    """A cell of struts as it stands, with the struts on its faces. Lengths are mm."""

    node_count: int
    strut_count: int
    component_count: int
    cycle_rank: int
    degree_histogram: dict[int, int]
    minimum_length: float
    mean_length: float
    maximum_length: float
    total_length: float
    mean_aspect_ratio: float
    mean_slenderness_ratio: float
    maxwell_number: int


def characterize_graph_cell(cell: Any, cell_size: Any = 1.0, beam_radius: float = 0.1) -> GraphCellProperties:
    """Counts and lengths of a cell of struts.

    Args:
        cell: one of LATTICE_NAMES, or a GraphUnitCell.
        cell_size: mm, a number or a Vec3.
        beam_radius: mm.

    The aspect ratio of a strut is L / 2r, its slenderness 2L / r, and Maxwell's number is struts - 3 nodes + 6.
    """
    graph, radius = graph_cell(cell), length(beam_radius)
    sizes = Vec3(*([length(cell_size)] * 3)) if isinstance(cell_size, (int, float)) else Vec3(*cell_size)
    lengths = []
    for a, b in graph.edges:
        way = graph.vertices[b] - graph.vertices[a]
        lengths.append(math.hypot(*(c * s for c, s in zip(way, sizes))))
    degrees = Counter(end for edge in graph.edges for end in edge)
    nodes, struts = len(graph.vertices), len(graph.edges)
    components = _component_count(nodes, graph.edges)
    mean = sum(lengths) / struts
    return GraphCellProperties(
        nodes, struts, components, struts - nodes + components,
        dict(sorted(Counter(degrees[n] for n in range(nodes)).items())), min(lengths), mean, max(lengths), sum(lengths),
        mean / (2 * radius), 2 * mean / radius, struts - 3 * nodes + 6)


class CrossSections(NamedTuple):
    """The solid areas of slices across an axis."""

    positions: list[float]  # middles of the slices, mm
    solid_areas: list[float]  # mm2
    area_fractions: list[float]
    minimum_area_fraction: float
    mean_area_fraction: float
    maximum_area_fraction: float
    coefficient_of_variation: float


class LatticeProperties(NamedTuple):
    """What a piece of a body is like; lengths are mm. The interface is the surface without what lies in the faces of the box."""

    envelope_volume: float
    solid_volume: float
    void_volume: float
    relative_density: float
    porosity: float
    surface_area: float
    interface_area: float
    surface_area_to_solid_volume: float
    interface_area_to_solid_volume: float
    specific_surface_area: float
    normalized_interface_area: float
    hydraulic_diameter: float
    centroid: Vec3
    solid_component_count: int
    euler_characteristic: int
    genus: int | None
    voxel_size: Vec3
    cross_sections: dict[str, CrossSections]


def characterize(node: Any, voxel_size: Any, bounds: Any = None, periodic_axes: str = "") -> LatticeProperties:
    """Measures a body in its box, or in the box (min, max), which repeats along the periodic axes, such as "xyz".

    Pieces hang together by the faces of voxels; those that touch by edges or corners alone count apart.
    """
    pitch = min(_voxel_size(voxel_size))
    options: dict[str, Any] = {"periodic": periodic_axes} if periodic_axes else {}
    if bounds is not None:
        options["box"] = ",".join(repr(c) for corner in bounds for c in vector(corner))
    found = as_node(node)._design().characterise(voxel=pitch, **options)
    low, high = found["box"]
    envelope = math.prod(b - a for a, b in zip(low, high))
    solid, surface, inner = found["volume_mm3"], found["surface_mm2"], found["inner_surface_mm2"]
    sections = {}
    for n, axis in enumerate("xyz"):
        areas, step, own = found["sections"][axis]["areas_mm2"], found["voxel_mm"][n], found["sections"][axis]
        whole = envelope / (high[n] - low[n])
        sections[axis] = CrossSections([low[n] + (i + 0.5) * step for i in range(len(areas))], areas,
                                       [area / whole for area in areas], own["least"], own["mean"], own["greatest"],
                                       own["variation"])
    genus = found.get("genus")
    return LatticeProperties(
        envelope, solid, envelope - solid, solid / envelope, 1 - solid / envelope, surface, inner, surface / solid,
        inner / solid, surface / envelope, inner / envelope ** (2 / 3),
        4 * (envelope - solid) / inner if inner else math.inf, Vec3(*found["centroid"]), int(found["pieces"]),
        int(found["euler_number"]), None if genus is None else int(genus), Vec3(*found["voxel_mm"]), sections)


def _component_count(count: int, edges: list[tuple[int, int]]) -> int:
    root = list(range(count))

    def find(n: int) -> int:
        while root[n] != n:
            root[n] = root[root[n]]
            n = root[n]
        return n
    for a, b in edges:
        root[find(a)] = find(b)
    return len({find(n) for n in range(count)})


__all__ = ["CrossSections", "GraphCellProperties", "LatticeProperties", "characterize", "characterize_graph_cell"]


def __getattr__(name: str) -> object:
    return attribute_of(__name__, __all__, name)
