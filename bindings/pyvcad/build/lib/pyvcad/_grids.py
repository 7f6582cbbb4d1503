"""Designs on grids of voxels that fill the bounding box; arrays are indexed [x, y, z]."""
from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy

import ombre

from ._arguments import Point, voxel_size

_points_at_once = 1 << 20


def distances(design: ombre.Design, size: Any, progress: Callable[[float], Any] | None) -> numpy.ndarray:
    axes = centers(design.bounds, voxel_size(size))
    grid = numpy.empty([len(axis) for axis in reversed(axes)], dtype=numpy.float32)
    for layers, points in slabs(axes, progress):
        grid[layers] = design.distance(points)
    return grid.transpose(2, 1, 0)


def colors(design: ombre.Design, size: Any, blend: bool, progress: Callable[[float], Any] | None) -> numpy.ndarray:
    voxel = voxel_size(size)
    palette = numpy.array([design.materials[i]["colour"] for i in range(len(design.materials))], dtype=numpy.uint8)
    if not blend:
        ids = design.voxels(voxel, progress=progress).values
        return palette[ids].transpose(2, 1, 0, 3)
    axes = centers(design.bounds, voxel)
    grid = numpy.zeros([*(len(axis) for axis in reversed(axes)), 4], dtype=numpy.uint8)
    for layers, points in slabs(axes, progress):
        grid[layers] = _mixed(design.material(points), design.materials.names, palette)
    return grid.transpose(2, 1, 0, 3)


def _mixed(fractions: dict[str, numpy.ndarray], names: list[str], palette: numpy.ndarray) -> numpy.ndarray:
    total: Any = 0.0
    for name, values in fractions.items():
        total = total + values[..., None] * palette[names.index(name)].astype(float)
    return numpy.rint(total).astype(numpy.uint8)


def centers(bounds: tuple[Any, Any], voxel: Point) -> list[numpy.ndarray]:
    """Coordinates of the voxels' centres along x, y and z, mm."""
    axes = []
    for low, high, v in zip(*bounds, voxel):
        count = max(math.ceil((high - low) / v - 1e-6), 1)
        axes.append(low + (numpy.arange(count) + 0.5) * v)
    return axes


def slabs(axes: list[numpy.ndarray], progress: Callable[[float], Any] | None = None
          ) -> Iterator[tuple[slice, numpy.ndarray]]:
    """Layers of a grid, some at once, with their points of the shape (layers, y, x, 3)."""
    x, y, z = axes
    step = max(_points_at_once // (len(x) * len(y)), 1)
    for first in range(0, len(z), step):
        part = z[first:first + step]
        points = numpy.empty((len(part), len(y), len(x), 3))
        points[..., 0], points[..., 1], points[..., 2] = x, y[:, None], part[:, None, None]
        yield slice(first, first + len(part)), points
        if progress:
            progress(min((first + step) / len(z), 1.0))
