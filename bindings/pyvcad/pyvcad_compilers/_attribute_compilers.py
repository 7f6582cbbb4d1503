"""Compilers of pyvcad 3, which take attributes: material inkjet, vat, OpenVDB."""
from __future__ import annotations

import os
import struct
from collections.abc import Iterable
from typing import Any

import numpy

import ombre
from pyvcad._arguments import number, size
from pyvcad._defined import are_everywhere, given
from pyvcad._grids import centers, slabs
from pyvcad._sampling import OCCUPANCY, with_occupancy
from pyvcad._materials import expect_table
from pyvcad._tree import as_node

from ._compilers import Path, _Compiler, _place, _voxel


class _AttributeCompiler(_Compiler):
    _required: tuple[str, ...] = ()
    _root: Any
    _voxel: tuple[float, float, float]
    _is_strict = False

    def supported_attributes(self) -> list[str]:
        return list(self._required)

    def set_strict_mode(self, strict: bool) -> None:
        """Makes places of the part without the attribute an error, before anything is written."""
        self._is_strict = bool(strict)

    def _check_strictly(self, names: Iterable[str]) -> None:
        """In strict mode, checks that all of the part has these attributes."""
        for name in names if self._is_strict else ():
            self._check_given(name)

    def _check_given(self, name: str) -> None:
        """Raises RuntimeError at the first voxel of the part where nothing gives the attribute."""
        if are_everywhere(self._root, [name]):
            return
        design = self._root._design()
        for _, points in slabs(centers(design.bounds, self._voxel), lambda share: self._share(0.0)):
            self._check_points(name, points[design.inside(points)])

    def _check_points(self, name: str, points: numpy.ndarray) -> None:
        """Raises RuntimeError at the first of these points of the part where nothing gives the attribute."""
        bad = ~given(self._root, name, points)
        if bad.any():
            x, y, z = (float(c) for c in points[bad][0])
            raise RuntimeError(f"{type(self).__name__}: nothing gives {name} at ({x:g}, {y:g}, {z:g}); set it on a node above, "
                               "or on each child")

    def _numbers(self, name: str, design: ombre.Design, points: numpy.ndarray, usual: float) -> numpy.ndarray:
        """The attribute at points, or where nothing gives it the usual number. Raises RuntimeError where one is not finite."""
        if name not in design.attributes:
            return numpy.full(points.shape[:-1], usual)
        numbers = numpy.where(given(self._root, name, points), design.attribute(name, points), usual)
        bad = design.inside(points) & ~numpy.isfinite(numbers)
        if bad.any():
            x, y, z = (float(c) for c in points[bad][0])
            raise RuntimeError(f"{type(self).__name__}: {name} is not finite at ({x:g}, {y:g}, {z:g})")
        return numpy.nan_to_num(numbers)

    def _check_attributes(self) -> None:
        absent = [name for name in self._required if name not in self._root.attribute_list()]
        if absent:
            raise RuntimeError(f"{type(self).__name__}: no node of the tree has the attribute {', '.join(absent)}")


def _write_bmp(path: str, pixels: numpy.ndarray) -> None:
    """Gray bytes of the shape (rows, columns), the upper row first, as a BMP file."""
    rows, columns = pixels.shape
    stride = (columns + 3) // 4 * 4
    padded = numpy.zeros((rows, stride), dtype=numpy.uint8)
    padded[:, :columns] = pixels[::-1]
    palette = numpy.repeat(numpy.arange(256, dtype=numpy.uint8), 4).reshape(256, 4)
    palette[:, 3] = 0
    offset = 14 + 40 + palette.size
    header = struct.pack("<2sIHHI", b"BM", offset + padded.size, 0, 0, offset)
    header += struct.pack("<IiiHHIIiiII", 40, columns, rows, 1, 8, 0, padded.size, 0, 0, 256, 256)
    with open(path, "wb") as file:
        file.write(header + palette.tobytes() + padded.tobytes())


class VatCompiler(_AttributeCompiler):
    """Writes "intensity" (0 to 1) as gray BMP images of layers: PREFIX0.bmp, ... from below; 0 outside.

    Forms: VatCompiler(root, voxel_size, output_directory, file_prefix), or with the printer's volume after the voxel
    size, in the middle of which the part lies in x and y.
    """

    def __init__(self, root: Any, voxel_size: Any, *arguments: Any, **named: Any) -> None:
        names = ("printer_volume", "output_directory", "file_prefix")
        given = dict(zip(names[-len(arguments):] if arguments else (), arguments)) | named
        if len(arguments) > 3 or not {"output_directory", "file_prefix"} <= set(given) <= set(names):
            raise TypeError("VatCompiler: expected (root, voxel_size, [printer_volume,] output_directory, file_prefix)")
        self._root, self._voxel = as_node(root), _voxel("VatCompiler", voxel_size)
        self._volume = size(given["printer_volume"]) if "printer_volume" in given else None
        self._folder, self._prefix = _place(given["output_directory"], given["file_prefix"])
        self._fallback = 1.0
        self._resolution = (0, 0, 0)

    def supported_attributes(self) -> list[str]:
        return ["intensity"]

    def set_fallback_intensity(self, value: float) -> None:
        self._fallback = min(1.0, max(0.0, number(value)))

    def compile(self) -> None:
        self._check_strictly(["intensity"])
        design = self._root._design()
        low, high = (list(map(float, corner)) for corner in design.bounds)
        if self._volume:
            for axis in (0, 1):
                if high[axis] - low[axis] > self._volume[axis] + 1e-9:
                    raise RuntimeError("VatCompiler: the part is larger than the printer's volume")
                middle = (low[axis] + high[axis]) / 2
                low[axis], high[axis] = middle - self._volume[axis] / 2, middle + self._volume[axis] / 2
        axes = centers((tuple(low), tuple(high)), self._voxel)
        layers = []
        for _, points in slabs(axes, self._share):
            value = self._numbers("intensity", design, points, self._fallback)
            gray = numpy.where(design.distance(points) <= 0, numpy.clip(value, 0, 1), 0)
            layers += list(numpy.rint(255 * gray).astype(numpy.uint8)[:, ::-1])
        while layers and not layers[0].any():
            layers.pop(0)
        while layers and not layers[-1].any():
            layers.pop()
        with self._new_files(self._folder) as made:
            for n, layer in enumerate(layers):
                _write_bmp(os.path.join(made, f"{self._prefix}{n}.bmp"), layer)
        self._resolution = (len(axes[0]), len(axes[1]), len(layers))
        self._report(1.0)

    def resolution(self) -> tuple[int, int, int]:
        return self._resolution


class VdbCompiler(_AttributeCompiler):
    """Writes grids of OpenVDB: "distance" (a narrow band), one for each number of the attributes, and "occupancy", which is 1
    inside, if it is to be included. Without names all attributes are written."""

    def __init__(self, root: Any, voxel_size: Any, path: Path, attributes_to_export: Any = None,
                 include_occupancy: bool = False) -> None:
        self._root, self._voxel = as_node(root), _voxel("VdbCompiler", voxel_size)
        self._path, self._names = os.fspath(path), list(attributes_to_export or [])
        self._has_occupancy = bool(include_occupancy)

    def compile(self) -> None:
        design = (with_occupancy(self._root) if self._has_occupancy else self._root)._design()
        names = self._names or [name for name in self._root.attribute_list() if name != "volume_fractions"]
        absent = [name for name in names if name not in design.attributes]
        if absent:
            raise RuntimeError(f"VdbCompiler: no node of the tree has the attribute {', '.join(absent)}")
        self._check_strictly(names)
        what = ["distance", *names, *([OCCUPANCY] if self._has_occupancy else [])]
        with self._new_file(self._path) as path:
            design.write_voxels(path, voxel=",".join(map(repr, self._voxel)), what=",".join(what), progress=self._share)
        self._report(1.0)
