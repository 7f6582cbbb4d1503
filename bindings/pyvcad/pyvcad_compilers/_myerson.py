"""Layers in black and white, one file for each material."""
from __future__ import annotations

import os
import struct
from typing import Any

import numpy

from pyvcad._arguments import length, number
from pyvcad._defined import FRACTIONS, given
from pyvcad._errors import missing
from pyvcad._grids import centers, slabs
from pyvcad._materials import default_materials, expect_table
from pyvcad._tree import as_node

from ._attribute_compilers import _AttributeCompiler
from ._compilers import Path
from ._drawn_materials import drawn_materials

_mm_per_inch = 25.4


class MyersonCompiler(_AttributeCompiler):
    """Writes a BMP of one bit for each material and layer, black where it is: MATERIAL_00000.bmp, ... from below.

    A draw for each pixel picks the material by "volume_fractions", the same in each run; where nothing gives them there is none.
    The upper row has the greatest y.

    Args:
        layer_height: mm.
        x_dpi, y_dpi: pixels for each inch.
        taper_angle_deg, extra_width: 0; what others mean is not documented.
        output_path: the folder.
        root: a node.
        material_defs: a MaterialDefs.
    """

    _required = ("volume_fractions",)

    def __init__(self, layer_height: float, x_dpi: float, y_dpi: float, taper_angle_deg: float, extra_width: float,
                 output_path: Path, root: Any, material_defs: Any = None) -> None:
        what = type(self).__name__
        if number(taper_angle_deg) or number(extra_width):
            raise missing(f"{what} with a taper or an extra width", "0 for both, and ombre.offset or ombre.taper for the part")
        x, y = (_mm_per_inch / length(number(dpi)) for dpi in (x_dpi, y_dpi))
        self._voxel = (x, y, length(number(layer_height)))
        self._root, self._folder = as_node(root), os.fspath(output_path)
        self._materials = expect_table(what, material_defs) or default_materials

    def compile(self) -> None:
        self._check_attributes()
        names = [self._materials.name(id) for id in sorted(set(self._root.material_list()) - {0})]
        design = self._root._ombre_design_(self._materials)
        self._check_strictly(self._required)
        with self._new_files(self._folder) as made:
            for layers, points in slabs(centers(design.bounds, self._voxel), self._share):
                for n, layer in enumerate(range(layers.start, layers.stop)):
                    chosen = drawn_materials(type(self).__name__, design, points[n], names, numpy.random.default_rng(layer))
                    is_said = given(self._root, FRACTIONS, points[n])
                    for material, name in enumerate(names):
                        _write_bits(os.path.join(made, f"{name}_{layer:05}.bmp"), is_said & (chosen == material))
        self._report(1.0)


def _write_bits(path: str, black: numpy.ndarray) -> None:
    """A BMP of one bit; rows of the array go upwards, as those of the file do."""
    rows, columns = black.shape
    packed = numpy.packbits(~black, axis=1)
    padded = numpy.zeros((rows, (packed.shape[1] + 3) // 4 * 4), dtype=numpy.uint8)
    padded[:, :packed.shape[1]] = packed
    palette = bytes((0, 0, 0, 0, 255, 255, 255, 0))
    offset = 14 + 40 + len(palette)
    header = struct.pack("<2sIHHI", b"BM", offset + padded.size, 0, 0, offset)
    header += struct.pack("<IiiHHIIiiII", 40, columns, rows, 1, 1, 0, padded.size, 0, 0, 2, 2)
    with open(path, "wb") as file:
        file.write(header + palette + padded.tobytes())
