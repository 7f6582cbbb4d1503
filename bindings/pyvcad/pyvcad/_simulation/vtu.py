"""Grids of VTK (.vtu), as Ombre's jobs write them and its nodes read them."""
from __future__ import annotations

import hashlib
import os
import re
from typing import NamedTuple

import numpy

from ombre._volumes import _folder  # type: ignore[attr-defined]

_types = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "UInt8": "u1"}
_tetrahedron = 10


class Grid(NamedTuple):
    """A mesh whose elements are all of one kind.

    Attributes:
        points: of the shape (n, 3), mm.
        cells: of the shape (m, nodes of an element), from 0.
        cell_fields: {name: (m,) or (m, components)}, in the order of the file. Names have no unit.
    """

    points: numpy.ndarray
    cells: numpy.ndarray
    cell_fields: dict[str, numpy.ndarray]


def read_grid(path: str) -> Grid:
    """A file that `ombre fea` wrote."""
    with open(path, "rb") as file:
        data = file.read()
    head, _, appended = data.partition(b'<AppendedData encoding="raw">\n_')
    text = head.decode("utf-8")
    points = _array(text, appended, "points")
    offsets = _array(text, appended, "offsets")
    cells = _array(text, appended, "connectivity").reshape(len(offsets), -1)
    fields: dict[str, numpy.ndarray] = {}
    for name in re.findall(r'Name="([^"]*)"', text.partition("<CellData>")[2]):
        fields.setdefault(_plain(name), _array(text, appended, name))
    return Grid(points, cells, fields)


def _plain(name: str) -> str:
    """Returns a name without its unit, and as it was before it was escaped for XML."""
    name = re.sub(r" \[[^\]]*\]$", "", name)
    for entity, sign in (("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&amp;", "&")):
        name = name.replace(entity, sign)
    return name


def _array(text: str, appended: bytes, name: str) -> numpy.ndarray:
    found = re.search(rf'type="(\w+)" Name="{re.escape(name)}" NumberOfComponents="(\d+)" format="appended" '
                      r'offset="(\d+)"', text)
    if not found:
        raise ValueError(f"the grid has no array {name!r}")
    kind, components, start = _types[found[1]], int(found[2]), int(found[3])
    size = int.from_bytes(appended[start:start + 8], "little")
    values = numpy.frombuffer(appended, kind, size // numpy.dtype(kind).itemsize, start + 8)
    return values if components == 1 else values.reshape(-1, components)


def stored_tetrahedra(points: numpy.ndarray, cells: numpy.ndarray, values: numpy.ndarray, is_of_points: bool) -> str:
    """The path of a file with one field, which lasts as long as the process.

    Args:
        points: of the shape (n, 3), mm.
        cells: of the shape (m, 4), from 0.
        values: a number or three for each point or cell.
    """
    arrays: list[bytes] = []

    def tag(kind: str, name: str, array: numpy.ndarray) -> str:
        offset = sum(map(len, arrays))
        data = numpy.ascontiguousarray(array, dtype=_types[kind]).tobytes()
        arrays.append(len(data).to_bytes(8, "little") + data)
        components = array.shape[1] if name in ("points", "value") and array.ndim == 2 else 1
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="appended" '
                f'offset="{offset}"/>\n')
    text = ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
            f'header_type="UInt64">\n<UnstructuredGrid>\n<Piece NumberOfPoints="{len(points)}" '
            f'NumberOfCells="{len(cells)}">\n<Points>\n' + tag("Float64", "points", points) + "</Points>\n<Cells>\n"
            + tag("Int64", "connectivity", cells) + tag("Int64", "offsets", 4 * numpy.arange(1, len(cells) + 1))
            + tag("UInt8", "types", numpy.full(len(cells), _tetrahedron)) + "</Cells>\n")
    place = "PointData" if is_of_points else "CellData"
    text += (f"<{place}>\n" + tag("Float64", "value", values) + f"</{place}>\n</Piece>\n</UnstructuredGrid>\n"
             '<AppendedData encoding="raw">\n_')
    return _stored(text.encode("ascii") + b"".join(arrays) + b"\n</AppendedData>\n</VTKFile>\n")


def _stored(data: bytes) -> str:
    path = _folder() / f"{hashlib.sha256(data).hexdigest()[:24]}.vtu"
    if not path.exists():
        part = path.with_suffix(f".{os.getpid()}.part")
        part.write_bytes(data)
        part.replace(path)
    return str(path)
