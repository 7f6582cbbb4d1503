"""Images for printers with several vats of resin, one for each material."""
from __future__ import annotations

import enum
import os
import shutil
import tempfile
import zipfile
from typing import Any

import numpy

from pyvcad import Vec3
from pyvcad._arguments import number
from pyvcad._materials import expect_table
from pyvcad._tree import as_node

from ._attribute_compilers import _AttributeCompiler
from ._compilers import Path
from ._drawn_materials import drawn_materials
from ._png import write_gray

_pixels = (1280, 800)
_volume = (55.01, 34.38, 150.0)  # mm
_least_thickness = 0.01  # mm


class MultiMaterialVatSystem(enum.Enum):
    """Printers by their numbers of vats."""

    DUAL = 2
    QUAD = 4


class MultiMaterialVatOutputMode(enum.Enum):
    DIRECTORY = "directory"
    ZIP = "zip"
    DIRECTORY_AND_ZIP = "directory_and_zip"


class MultiMaterialVatCompiler(_AttributeCompiler):
    """Writes a gray PNG for each vat and layer: vat_a/vata_layer_0000.png, ... from below.

    A draw for each pixel picks the vat by "volume_fractions"; its gray is the attribute MATERIAL_intensity, from 0 to 1, or
    255 where nothing gives it. The share of the material 0 stays black. The part lies in the middle of 1280 x 800 pixels,
    which are 55.01 x 34.38 mm, x to the right and y downward; the first layer begins at its lowest point.

    Args:
        root: a node.
        output_path: the folder; the archive is OUTPUT_PATH.zip.
        material_defs: a MaterialDefs.
        vat_material_names: the material of each vat, the first of vat a.
        layer_thickness: mm.
        system: a MultiMaterialVatSystem.
        output_mode: a MultiMaterialVatOutputMode.
        random_seed: equal seeds give equal images.
    """

    _required = ("volume_fractions",)

    def __init__(self, root: Any, output_path: Path, material_defs: Any, vat_material_names: Any,
                 layer_thickness: float = 0.05, system: MultiMaterialVatSystem = MultiMaterialVatSystem.DUAL,
                 output_mode: MultiMaterialVatOutputMode = MultiMaterialVatOutputMode.DIRECTORY, random_seed: int = 0) -> None:
        what = type(self).__name__
        self._root, self._path = as_node(root), os.fspath(output_path)
        table = expect_table(what, material_defs)
        if table is None:
            raise TypeError(f"{what}: expected a MaterialDefs, found None")
        self._materials, self._names = table, [str(name) for name in vat_material_names]
        self._ids = [table.id(name) for name in self._names]
        if not 1 <= len(self._names) <= system.value or len(set(self._ids)) < len(self._ids) or 0 in self._ids:
            raise ValueError(f"{what}, vat_material_names: expected 1 to {system.value} materials for {system.name}, each once "
                             f"and none with the id 0, found {', '.join(self._names) or 'none'}")
        self._thickness = number(layer_thickness)
        if self._thickness < _least_thickness:
            raise ValueError(f"{what}, layer_thickness: expected {_least_thickness} mm or more, found {self._thickness:g}")
        self._mode, self._seed = MultiMaterialVatOutputMode(output_mode), int(random_seed)
        self._voxel = (_volume[0] / _pixels[0], _volume[1] / _pixels[1], self._thickness)

    def printer_volume(self) -> Vec3:
        return Vec3(*_volume)

    def archive_path(self) -> str:
        """The archive that is written, or "" in the mode DIRECTORY."""
        return "" if self._mode is MultiMaterialVatOutputMode.DIRECTORY else f"{self._path}.zip"

    def compile(self) -> None:
        what = type(self).__name__
        self._check_attributes()
        others = set(self._root.material_list()) - {0, *self._ids}
        if others:
            raise RuntimeError(f"{what}: no vat has the material {', '.join(map(self._materials.name, sorted(others)))}")
        design = self._root._ombre_design_(self._materials)
        low, high = (numpy.array(corner) for corner in design.bounds)
        if (high - low > numpy.array(_volume) + 1e-6).any():
            raise RuntimeError(f"{what}: the part measures " + " x ".join(f"{c:.4g}" for c in high - low)
                               + " mm, more than the printer's " + " x ".join(f"{c:g}" for c in _volume))
        self._check_given("volume_fractions")
        folder = tempfile.mkdtemp(prefix="ombre_", dir=os.path.dirname(os.path.abspath(self._path)))
        try:
            self._write_layers(design, low, high, folder)
            self._hand_over(folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)
        self._report(1.0)

    def _write_layers(self, design: Any, low: numpy.ndarray, high: numpy.ndarray, folder: str) -> None:
        vats = [chr(ord("a") + n) for n in range(len(self._ids))]
        for vat in vats:
            os.makedirs(os.path.join(folder, f"vat_{vat}"))
        middle = (low + high) / 2
        axes = [middle[n] + (numpy.arange(_pixels[n]) + 0.5 - _pixels[n] / 2) * self._voxel[n] for n in (0, 1)]
        # Pixels beyond the part are black.
        near = [numpy.flatnonzero((axis >= low[n]) & (axis <= high[n])) for n, axis in enumerate(axes)]
        names = [self._materials.name(id) for id in self._ids]
        count = max(1, int(numpy.ceil((high[2] - low[2]) / self._thickness - 1e-9)))
        for layer in range(count):
            self._share(layer / count)
            z = low[2] + (layer + 0.5) * self._thickness
            y, x = numpy.meshgrid(axes[1][near[1]], axes[0][near[0]], indexing="ij")
            points = numpy.stack([x, y, numpy.full(x.shape, z)], axis=-1)
            random = numpy.random.default_rng((self._seed, layer))
            chosen = drawn_materials(type(self).__name__, design, points, names, random)
            for n, (vat, name) in enumerate(zip(vats, names)):
                gray = numpy.where(chosen == n, self._gray(design, name, points), 0).astype(numpy.uint8)
                image = numpy.zeros((_pixels[1], _pixels[0]), dtype=numpy.uint8)
                image[numpy.ix_(near[1], near[0])] = gray
                write_gray(os.path.join(folder, f"vat_{vat}", f"vat{vat}_layer_{layer:04}.png"), image)

    def _gray(self, design: Any, name: str, points: numpy.ndarray) -> numpy.ndarray:
        return numpy.rint(255 * numpy.clip(self._numbers(f"{name}_intensity", design, points, 1.0), 0, 1))

    def _hand_over(self, folder: str) -> None:
        """Moves the images to where they are wanted."""
        self._stop_if_cancelled()
        vats = sorted(os.listdir(folder))
        if self._mode is not MultiMaterialVatOutputMode.DIRECTORY:
            with self._new_file(f"{self._path}.zip") as path, zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
                for vat in vats:
                    for image in sorted(os.listdir(os.path.join(folder, vat))):
                        entry = zipfile.ZipInfo(f"{vat}/{image}")  # without the time, so that equal images are equal bytes
                        with open(os.path.join(folder, vat, image), "rb") as file:
                            archive.writestr(entry, file.read())
        if self._mode is not MultiMaterialVatOutputMode.ZIP:
            for vat in vats:
                target = os.path.join(self._path, vat)
                shutil.rmtree(target, ignore_errors=True)
                os.makedirs(self._path, exist_ok=True)
                shutil.move(os.path.join(folder, vat), target)
