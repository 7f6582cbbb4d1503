"""Fields on tetrahedra from files of XDMF."""
from __future__ import annotations

import os
import xml.etree.ElementTree as xml
from typing import Any

import numpy

from .field_datasets import UnstructuredFieldDataset
from .hdf5 import h5py
from .._solids import _find


class XDMFFieldLoader:
    """Reads one uniform grid of XDMF 3: tetrahedra with four nodes, the geometry XYZ, numbers in files of HDF5, fields of
    nodes or cells with one number or three. Whatever else there is, is a ValueError. Needs h5py."""

    @staticmethod
    def load(path: Any, grid_name: str | None = None) -> UnstructuredFieldDataset:
        """The grid of a file, relative to the script, then to the working directory.

        Args:
            path: a file that ends in .xdmf; files of HDF5 are found beside it.
            grid_name: which grid it is; None where there is one alone.

        Raises FileNotFoundError, ImportError, ValueError.
        """
        return _Reader(_find("XDMFFieldLoader", os.fspath(path))).read(grid_name)


class _Reader:
    def __init__(self, path: str) -> None:
        self._path, self._files = path, h5py("XDMFFieldLoader")

    def read(self, grid_name: str | None) -> UnstructuredFieldDataset:
        try:
            root = xml.parse(self._path).getroot()
        except xml.ParseError as error:
            raise ValueError(f"{self._path}: {error}") from None
        grid = self._grid(root, grid_name)
        geometry, topology = self._child(grid, "Geometry"), self._child(grid, "Topology")
        self._expect(geometry, ("GeometryType", "Type"), ("XYZ",), "XYZ")
        self._expect(topology, ("TopologyType", "Type"), ("Tetrahedron",), "")
        points, cells = self._numbers(geometry), self._numbers(topology)
        try:
            fields = UnstructuredFieldDataset.from_tetrahedra(points.reshape(-1, 3), cells.reshape(-1, 4))
            for attribute in grid.findall("Attribute"):
                self._add(fields, attribute)
        except ValueError as error:
            raise error if str(error).startswith(self._path) else self._error(str(error)) from None
        return fields

    def _grid(self, root: xml.Element, name: str | None) -> xml.Element:
        grids = root.findall("./Domain/Grid") if root.tag == "Xdmf" else []
        names = [grid.get("Name", "") for grid in grids]
        if name is not None and name not in names:
            raise self._error(f"there is no grid {name!r}; there are {', '.join(map(repr, names)) or 'none'}")
        found = [grid for grid in grids if name is None or grid.get("Name", "") == name]
        if len(found) != 1:
            raise self._error(f"expected one grid, found {len(found)}; choose one by grid_name"
                              if found else "expected a grid in a domain")
        self._expect(found[0], ("GridType",), ("Uniform",), "Uniform")
        if found[0].find("Time") is not None:
            raise self._error("grids of steps in time are not read")
        return found[0]

    def _add(self, fields: UnstructuredFieldDataset, attribute: xml.Element) -> None:
        name = attribute.get("Name", "")
        self._expect(attribute, ("Center",), ("Node", "Cell"), "Node")
        self._expect(attribute, ("AttributeType", "Type"), ("Scalar", "Vector"), "Scalar")
        is_of_points = attribute.get("Center", "Node") == "Node"
        is_vector = attribute.get("AttributeType", attribute.get("Type", "Scalar")) == "Vector"
        numbers = self._numbers(attribute)
        if is_vector:
            numbers = numbers.reshape(-1, 3) if numbers.size % 3 == 0 else numbers
            (fields.add_point_vector if is_of_points else fields.add_cell_vector)(name, numbers)
        else:
            (fields.add_point_scalar if is_of_points else fields.add_cell_scalar)(name, numbers.reshape(-1))

    def _numbers(self, parent: xml.Element) -> numpy.ndarray:
        """Numbers of a part's only DataItem: "part.h5:/Mesh/geometry"."""
        items = parent.findall("DataItem")
        if len(items) != 1:
            raise self._error(f"{_named(parent)}: expected one DataItem, found {len(items)}")
        self._expect(items[0], ("ItemType",), ("Uniform",), "Uniform")
        self._expect(items[0], ("Format",), ("HDF",), "XML")
        file_name, colon, place = (items[0].text or "").strip().rpartition(":/")
        if not colon:
            raise self._error(f"{_named(parent)}: expected a file and a path in it, as part.h5:/Mesh/geometry, found "
                              f"{(items[0].text or '').strip()!r}")
        file_path = os.path.join(os.path.dirname(self._path), file_name)
        if not os.path.isfile(file_path):
            raise FileNotFoundError(f"{self._path}: {_named(parent)}: there is no file {file_path}")
        try:
            with self._files.File(file_path, "r") as file:
                if not isinstance(file.get(place), self._files.Dataset):
                    raise self._error(f"{_named(parent)}: {file_name} has no numbers at /{place}")
                return self._checked(parent, items[0], numpy.asarray(file[place]))
        except OSError as error:
            raise self._error(f"{_named(parent)}: {file_name} cannot be read: {error}") from None

    def _checked(self, parent: xml.Element, item: xml.Element, numbers: numpy.ndarray) -> numpy.ndarray:
        """Numbers whose count is the product of the dimensions and fits what they are for."""
        if numbers.dtype.kind not in "iuf":
            raise self._error(f"{_named(parent)}: expected numbers, found {numbers.dtype}")
        words = item.get("Dimensions", "").split()
        if not words or not all(word.isdecimal() for word in words):
            raise self._error(f"{_named(parent)}: expected dimensions, found {item.get('Dimensions', '')!r}")
        each = {"Geometry": 3, "Topology": 4}.get(parent.tag, 1)
        count = int(numpy.prod([int(word) for word in words]))
        if count != numbers.size or count % each:
            raise self._error(f"{_named(parent)}: expected {' x '.join(words)} numbers"
                              f"{f', {each} each' if each > 1 else ''}, found {numbers.size}")
        return numbers

    def _child(self, grid: xml.Element, tag: str) -> xml.Element:
        found = grid.find(tag)
        if found is None:
            raise self._error(f"expected {tag} in the grid")
        return found

    def _expect(self, element: xml.Element, names: tuple[str, ...], values: tuple[str, ...], default: str) -> None:
        value = next((element.get(name) for name in names if element.get(name) is not None), default) or ""
        if value.lower() not in [choice.lower() for choice in values]:
            raise self._error(f"{_named(element)}: {names[0]} is {value or 'not said'!r}; read is {' or '.join(values)}")

    def _error(self, message: str) -> ValueError:
        return ValueError(f"{self._path}: {message}")


def _named(element: xml.Element) -> str:
    name = element.get("Name")
    return f"{element.tag} {name!r}" if name else element.tag
