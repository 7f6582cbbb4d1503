"""Maps of cells in boxes, around axes and around centres."""
from __future__ import annotations

import math
from typing import Any

import numpy

import ombre
from pyvcad import CellMap
from pyvcad._arguments import length, number, vector
from pyvcad._cell_maps import fitting_counts, frame_of, placed, whole_counts


def rectangular_cell_map(bounds: Any, cells: Any = None, cell_size: Any = None) -> CellMap:
    """Boxes: rectangular_cell_map((min, max), cells=(4, 4, 2)), or cell_size=Vec3(5, 5, 5).

    Of a size, as many cells are laid as are needed so that none is larger; the bounds stay.
    """
    if not hasattr(bounds, "__len__") or len(bounds) != 2:
        raise TypeError("rectangular_cell_map, bounds: expected (min, max), for example what bounding_box() gives")
    low, high = vector(bounds[0]), vector(bounds[1])
    x, y, z = (b - a for a, b in zip(low, high))
    return CellMap.rectangular(low, high, _counts("rectangular_cell_map", cells, cell_size, (x, y, z)))


def _counts(what: str, cells: Any, sizes: Any, lengths: tuple[float, float, float]) -> tuple[int, int, int]:
    if (cells is None) == (sizes is None):
        raise TypeError(f"{what}: expected either cells or their size, found {'none' if cells is None else 'both'}")
    return whole_counts(f"{what}, cells", cells) if sizes is None else fitting_counts(lengths, sizes)


def _around(what: str, cells: Any, around: Any, along: Any, outward: Any) -> tuple[int, int, int]:
    """The counts that are given as they are, or as a count around and two that are computed."""
    others = (around, along, outward)
    if cells is not None and all(other is None for other in others):
        return whole_counts(f"{what}, cells", cells)
    if cells is None and all(other is not None for other in others):
        return whole_counts(f"{what}, cells", others)
    raise TypeError(f"{what}: expected either cells=(around, along, outward), or all of the counts and sizes")


def _sized(what: str, total: float, value: Any) -> Any:
    return None if value is None else max(1, math.ceil(total / length(value) - 1e-9))


def cylindrical_cell_map(center: Any = (0, 0, 0), inner_radius: float = 8.0, outer_radius: float = 10.0,
                         height: float = 20.0, axis: Any = (0, 0, 1), reference_direction: Any = (1, 0, 0),
                         cells: Any = None, arc_count: Any = None, axial_cell_size: Any = None,
                         radial_cell_size: Any = None) -> CellMap:
    """Cells in the wall of a pipe, whose middle is the centre: u runs around, v along the axis, w outward."""
    what = "cylindrical_cell_map"
    inner, outer, tall, middle = length(inner_radius), length(outer_radius), length(height), vector(center)
    counts = _around(what, cells, arc_count, _sized(what, tall, axial_cell_size),
                     _sized(what, outer - inner, radial_cell_size))
    frame = frame_of(axis, reference_direction)
    value = ombre.cylinder_cells(inner, outer, tall, count=counts, origin=middle, axis=vector(axis),
                                 toward=vector(reference_direction))

    def forward(u: Any, v: Any, w: Any) -> tuple[Any, Any, Any]:
        angle, radius = u * (2 * math.pi / counts[0]), inner + w * ((outer - inner) / counts[2])
        return placed(frame, middle, (radius * numpy.cos(angle), radius * numpy.sin(angle), (v / counts[1] - 0.5) * tall))
    return CellMap(value, counts, forward, "u")


def spherical_cell_map(center: Any = (0, 0, 0), inner_radius: float = 8.0, outer_radius: float = 10.0,
                       latitude_bounds_degrees: Any = (-60, 60), north_axis: Any = (0, 0, 1),
                       reference_direction: Any = (1, 0, 0), cells: Any = None, longitude_count: Any = None,
                       latitude_count: Any = None, radial_cell_size: Any = None) -> CellMap:
    """Cells in the wall of a hollow ball, between two latitudes: u runs around, v to the north, w outward."""
    what = "spherical_cell_map"
    inner, outer, middle = length(inner_radius), length(outer_radius), vector(center)
    south, north = (number(degrees) for degrees in latitude_bounds_degrees)
    counts = _around(what, cells, longitude_count, latitude_count, _sized(what, outer - inner, radial_cell_size))
    frame = frame_of(north_axis, reference_direction)
    value = ombre.ball_cells(inner, outer, south, north, count=counts, origin=middle, axis=vector(north_axis),
                             toward=vector(reference_direction))

    def forward(u: Any, v: Any, w: Any) -> tuple[Any, Any, Any]:
        angle, radius = u * (2 * math.pi / counts[0]), inner + w * ((outer - inner) / counts[2])
        latitude = (south + v * ((north - south) / counts[1])) * (math.pi / 180)
        rho = radius * numpy.cos(latitude)
        return placed(frame, middle, (rho * numpy.cos(angle), rho * numpy.sin(angle), radius * numpy.sin(latitude)))
    return CellMap(value, counts, forward, "u")


warp_cell_map = CellMap.warp
cell_map_from_cad_face, cell_map_between_cad_faces = CellMap.from_cad_face, CellMap.between_cad_faces
cell_map_from_surface, cell_map_between_surfaces = CellMap.from_surface, CellMap.between_surfaces
