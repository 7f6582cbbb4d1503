"""The compilers, over Ombre's jobs."""
from __future__ import annotations

import contextlib
import functools
import os
import tempfile
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy

import ombre
from pyvcad import Vec2
from pyvcad._arguments import Point, size, vector, voxel_size
from pyvcad._grids import centers, slabs
from pyvcad._keep_out import KeepOut
from pyvcad._materials import expect_table
from pyvcad._operations import Intersection
from pyvcad._solids import RectPrism
from pyvcad._tree import as_node

from ._png import write_gray

Path = str | os.PathLike[str]


def _begun(compile: Callable[[Any], None]) -> Callable[[Any], None]:
    """The method, which forgets an earlier cancel() and keeps how long it took."""
    @functools.wraps(compile)
    def run(self: Any) -> None:
        self._is_stopped = False
        begin = time.perf_counter()
        compile(self)
        self._seconds = time.perf_counter() - begin
    return run


class _Compiler:
    _callback: Callable[[float], Any] | None = None
    _is_stopped = False
    _seconds: float | None = None  # what the last compile() took, once it has ended well

    def __init_subclass__(cls, **named: Any) -> None:
        super().__init_subclass__(**named)
        if "compile" in vars(cls):
            setattr(cls, "compile", _begun(vars(cls)["compile"]))

    def setProgressCallback(self, callback: Callable[[float], Any] | None) -> None:
        """A function of the share that is done, 0 to 1."""
        if callback is not None and not callable(callback):
            raise TypeError(f"setProgressCallback: expected a function, found {type(callback).__name__}")
        self._callback = callback

    set_progress_callback = setProgressCallback

    def supported_attributes(self) -> list[str]:
        """The names of attributes that it reads: none."""
        return []

    def report_stats(self) -> None:
        """Prints the settings and results of the last compile(): the box, the size of voxels, seconds and so on."""
        if self._seconds is None:
            print(f"{type(self).__name__}: compile() has not ended yet")
            return
        root = getattr(self, "_root", None)
        if root is not None:
            print("box:", *root.bounding_box())
        for name, value in sorted(vars(self).items()):
            if isinstance(value, (int, float, str, tuple)) and not isinstance(value, bool):
                print(f"{name.strip('_').replace('_', ' ')}: {value}")
        print(f"threads: {os.cpu_count()}")

    def _report(self, share: float) -> None:
        if self._callback:
            self._callback(share)

    def cancel(self) -> None:
        """Ends a compile() under way, from its callback or another thread; it raises RuntimeError and writes nothing."""
        self._is_stopped = True

    def _share(self, share: float) -> None:
        self._stop_if_cancelled()
        self._report(share)
        self._stop_if_cancelled()

    def _stop_if_cancelled(self) -> None:
        if self._is_stopped:
            raise RuntimeError(f"{type(self).__name__}: cancelled")

    @contextlib.contextmanager
    def _new_files(self, folder: str) -> Iterator[str]:
        """Makes a folder for new files, which are moved into `folder` in the end: all, or after an error or cancel() none."""
        os.makedirs(folder, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix="ombre_", dir=folder) as made:
            yield made
            self._stop_if_cancelled()
            for name in sorted(os.listdir(made)):
                os.replace(os.path.join(made, name), os.path.join(folder, name))

    @contextlib.contextmanager
    def _new_file(self, path: str) -> Iterator[str]:
        """A path for a new file, which is moved to `path` in the end as those of _new_files() are."""
        folder, name = os.path.split(os.path.abspath(path))
        with self._new_files(folder) as made:
            yield os.path.join(made, name)


class DirectMaterialCompiler(_Compiler):
    """Writes an image for each layer, in the colours of the materials: PREFIX_00000.png, ... from below.

    Args:
        root: a node.
        voxel_size: mm; a Vec3 or a number.
        material_defs: a MaterialDefs.
        output_directory: made where it is missing; images of the same names are replaced.
        file_prefix: what the names of the images start with.
        liquid_keep_out, liquid_keep_out_distance: whether mixtures hold no liquid nearer to the surface than this, mm.
    """

    def __init__(self, root: Any, voxel_size: Any, material_defs: Any, output_directory: Path, file_prefix: str,
                 liquid_keep_out: bool = False, liquid_keep_out_distance: float = 0) -> None:
        self._root, self._voxel = as_node(root), _voxel("DirectMaterialCompiler", voxel_size)
        self._materials = expect_table("DirectMaterialCompiler", material_defs)
        if liquid_keep_out:
            self._root = KeepOut(self._root, liquid_keep_out_distance, self._materials)
        self._folder, self._prefix = _place(output_directory, file_prefix)

    def compile(self) -> None:
        design = self._root._ombre_design_(self._materials)
        with self._new_files(self._folder) as made, tempfile.TemporaryDirectory(prefix="ombre_", dir=self._folder) as work:
            job = os.path.join(work, "job")
            design.slice(job, voxel=self._voxel, progress=self._share)
            images = sorted(name for name in os.listdir(job) if name.endswith(".png"))
            for number, image in enumerate(images):
                os.replace(os.path.join(job, image), _image_path(made, self._prefix, number))
        self._report(1.0)


class GrayscaleCompiler(_Compiler):
    """Writes a gray image for each layer: the fraction of the high material, 0 to 255; 0 outside.

    Images cover the printer's volume, with the part in their middle; there are as many as the part has layers.

    Args:
        root: a node that has these two materials only.
        voxel_size: mm; a Vec3 or a number.
        printer_volume: lengths along x, y and z, mm.
        low_material, high_material: ids.
        output_directory, file_prefix: as for DirectMaterialCompiler.
    """

    def __init__(self, root: Any, voxel_size: Any, printer_volume: Any, low_material: int, high_material: int,
                 output_directory: Path, file_prefix: str) -> None:
        self._root, self._voxel = as_node(root), _voxel("GrayscaleCompiler", voxel_size)
        self._volume = size(printer_volume)
        self._low, self._high = int(low_material), int(high_material)
        self._folder, self._prefix = _place(output_directory, file_prefix)

    def compile(self) -> None:
        others = set(self._root.material_list()) - {0, self._low, self._high}
        if others:
            raise ombre.DesignError(f"GrayscaleCompiler: the design has the material {min(others)} beside the low one "
                                    f"({self._low}) and the high one ({self._high})")
        design = self._root._design()
        axes = self._axes(design.bounds)
        high = design.materials.names[self._high] if self._high < len(design.materials) else ""
        with self._new_files(self._folder) as made:
            for layers, points in slabs(axes, self._share):
                shares = design.material(points).get(high, numpy.zeros(points.shape[:3]))
                for layer, number in enumerate(range(layers.start, layers.stop)):
                    pixels = numpy.rint(255 * shares[layer, ::-1]).astype(numpy.uint8)
                    write_gray(_image_path(made, self._prefix, number), pixels)
        self._report(1.0)

    def _axes(self, bounds: tuple[Point, Point]) -> list[numpy.ndarray]:
        low, high = numpy.array(bounds)
        if (high - low > numpy.array(self._volume) + 1e-6).any():
            raise ombre.DesignError("GrayscaleCompiler: the part measures "
                                    + " × ".join(f"{length:.4g}" for length in high - low)
                                    + " mm, more than the printer's volume of "
                                    + " × ".join(f"{length:.4g}" for length in self._volume) + " mm")
        middle, half = (low + high) / 2, numpy.array(self._volume) / 2
        tray = centers((middle - half, middle + half), self._voxel)
        return [tray[0], tray[1], centers((low, high), self._voxel)[2]]


class MeshCompiler(_Compiler):
    """Writes closed surfaces: PREFIX.3mf, with a body for each of several bands of the fraction that varies most.

    Args:
        root: a node.
        voxel_size: mm; surfaces lie within an eighth of the least of it.
        output_directory: made where it is missing; a file of the same name is replaced.
        file_prefix: the file's name without its ending.
        num_iso_slices: number of bands; 1 for one body.
        material_defs: a MaterialDefs; without it the default ones.
    """

    def __init__(self, root: Any, voxel_size: Any, output_directory: Path, file_prefix: str, num_iso_slices: int = 1,
                 material_defs: Any = None) -> None:
        if isinstance(num_iso_slices, bool) or not isinstance(num_iso_slices, int) or num_iso_slices < 1:
            raise ValueError(f"MeshCompiler, num_iso_slices: expected 1 or more, found {num_iso_slices!r}")
        self._root, self._voxel, self._bands = as_node(root), _voxel("MeshCompiler", voxel_size), num_iso_slices
        self._materials = expect_table("MeshCompiler", material_defs)
        self._folder, self._prefix = _place(output_directory, file_prefix)

    def compile(self) -> None:
        design = self._root._ombre_design_(self._materials)
        bands: dict[str, Any] = {"bands": self._bands} if self._bands > 1 and len(self._root.material_list()) > 1 else {"by": "whole"}
        with self._new_files(self._folder) as made:
            design.mesh(os.path.join(made, self._prefix + ".3mf"), tolerance=min(self._voxel) / 8, progress=self._share, **bands)
        self._report(1.0)


class CrossSectionSlicer:
    """Outlines of a node within a box.

    Args:
        root: a node.
        min, max: corners of the box, mm.
        voxel_size: mm; outlines lie within an eighth of the least of it.
    """

    def __init__(self, root: Any, min: Any, max: Any, voxel_size: Any) -> None:
        low, high = vector(min), vector(max)
        center = tuple((a + b) / 2 for a, b in zip(low, high))
        box = RectPrism(center, tuple(b - a for a, b in zip(low, high)))
        self._within = Intersection(False, [as_node(root), box])
        self._voxel = _voxel("CrossSectionSlicer", voxel_size)

    def slice_geometry(self, z: float) -> list[list[Vec2]]:
        """Closed outlines at a height, mm; each lists its corners once, counterclockwise around the solid."""
        low, high = self._within.bounding_box()
        if not low.z <= z <= high.z:
            return []
        tolerance = sorted(self._voxel)[0] / 8
        with tempfile.TemporaryDirectory(prefix="ombre_") as folder:
            path = os.path.join(folder, "layer.cli")
            self._within._design().contours(path, z=z, tolerance=tolerance)
            with open(path, encoding="ascii") as file:
                return [_outline(line) for line in file if line.startswith("$$POLYLINE/")]


def _outline(line: str) -> list[Vec2]:
    numbers = [float(text) for text in line.split("/", 1)[1].split(",")[3:]]
    corners = [Vec2(x, y) for x, y in zip(numbers[::2], numbers[1::2])]
    return corners[:-1]  # the last one is the first again


def _image_path(folder: str, prefix: str, number: int) -> str:
    return os.path.join(folder, f"{prefix}_{number:05}.png")


def _place(folder: Path, prefix: str) -> tuple[str, str]:
    """Splits what paths of files begin with into their folder and what their names begin with."""
    return os.path.split(os.path.join(folder, prefix))


def _voxel(what: str, value: Any) -> Point:
    try:
        return voxel_size(value)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{what}, voxel_size: {error}") from None
