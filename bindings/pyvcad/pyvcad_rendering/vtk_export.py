"""Surfaces and grids of designs as files of VTK, with their attributes."""
from __future__ import annotations

import os
import xml.sax.saxutils
from collections.abc import Callable
from typing import Any

import numpy

from pyvcad import SurfaceMesh
from pyvcad._tree import Node, as_node

_voxels_along = {"low": 32, "medium": 64, "high": 128, "ultra": 256}


def _voxel(node: Node, quality: str) -> float:
    if quality not in _voxels_along:
        raise ValueError(f"quality: expected {', '.join(_voxels_along)}, found {quality!r}")
    low, high = node._design().bounds
    return float(max(b - a for a, b in zip(low, high))) / _voxels_along[quality]


def _names(node: Node) -> list[str]:
    design = node._design()
    return [name for name in node.attribute_list() if name != "volume_fractions" and name in design.attributes]


def _array(name: str, values: numpy.ndarray, kind: str = "Float64") -> str:
    count = 1 if values.ndim == 1 else values.shape[1]
    numbers = " ".join(map(repr, values.ravel().tolist()))
    title = xml.sax.saxutils.quoteattr(name)
    return (f'<DataArray type="{kind}" Name={title} NumberOfComponents="{count}" format="ascii">'
            f"{numbers}</DataArray>\n")


def export_iso_surface_vtk(root: Any, file: str | os.PathLike[str], quality: str = "high", use_blending: bool = True,
                           progress_callback: Callable[[int], Any] | None = None) -> None:
    """Writes the surface (.vtp) with an array of each attribute at its vertices; callbacks get 0 to 100."""
    node = as_node(root)
    tell = progress_callback or (lambda percent: None)
    tell(0)
    surface = SurfaceMesh(node, _voxel(node, quality))
    vertices, triangles = numpy.asarray(surface.vertices), numpy.asarray(surface.triangles)
    tell(60)
    arrays = "".join(_array(name, numpy.nan_to_num(node._design().attribute(name, vertices))) for name in _names(node))
    ends = 3 * numpy.arange(1, len(triangles) + 1)
    with open(os.fspath(file), "w", encoding="utf-8") as out:
        out.write('<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian">\n<PolyData>\n'
                  f'<Piece NumberOfPoints="{len(vertices)}" NumberOfPolys="{len(triangles)}">\n<PointData>\n{arrays}'
                  f"</PointData>\n<Points>\n{_array('Points', vertices)}</Points>\n<Polys>\n"
                  f"{_array('connectivity', triangles.ravel(), 'Int64')}{_array('offsets', ends, 'Int64')}"
                  "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n")
    tell(100)


def export_volume_vtk(root: Any, file: str | os.PathLike[str], quality: str = "high", use_blending: bool = True,
                      progress_callback: Callable[[int], Any] | None = None) -> None:
    """Writes a grid (.vti) of the distance and of each attribute; callbacks get 0 to 100."""
    node = as_node(root)
    tell = progress_callback or (lambda percent: None)
    node._design().write_voxels(os.fspath(file), voxel=repr(_voxel(node, quality)), force=True,
                                what=",".join(["distance", *_names(node)]),
                                progress=lambda share: tell(round(100 * share)))
    tell(100)
