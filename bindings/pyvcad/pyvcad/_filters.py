"""Weighted means of the composition and the attributes around each place, and voxels out of images."""
from __future__ import annotations

import itertools
import numbers
from typing import Any

import ombre

from ._arguments import Optional, Point, instance_of, length, number, read, size, text, vector, voxel_size
from ._materials import MaterialDefs
from ._solids import _Leaf
from ._tree import Unary, as_node

Kernel = list[list[list[float]]]
_finest = 7  # greatest number of voxels on each side of the middle of a box in mm


def _whole(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"expected a whole number, found {type(value).__name__}")
    if value < 0:
        raise ValueError(f"expected 0 or more, found {value}")
    return int(value)


def _counts(x: Any, y: Any, z: Any) -> tuple[int, int, int]:
    counts = _whole(x), _whole(y), _whole(z)
    if 0 in counts:
        raise ValueError(f"expected at least one voxel along each axis, found {counts}")
    return counts


def _kernel(value: Any) -> Kernel:
    rows = value.tolist() if hasattr(value, "tolist") else value
    try:
        kernel = [[[number(weight) for weight in row] for row in plane] for plane in rows]
    except TypeError:
        raise TypeError("expected weights in lists along x of lists along y of lists along z") from None
    if not kernel or not kernel[0] or any(len(plane) != len(kernel[0]) for plane in kernel) or any(
            len(row) != len(kernel[0][0]) or not row for plane in kernel for row in plane):
        raise ValueError("expected lists of equal length along x, y and z")
    return kernel


def _names(value: Any) -> list[str]:
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        raise TypeError(f"expected a list of names, found {type(value).__name__}")
    return [text(name) for name in value]


class BoxKernel:
    """Equal weights, for voxels up to so many away along each axis: BoxKernel(r), BoxKernel(rx, ry, rz)."""

    def __init__(self, rx: int, ry: int | None = None, rz: int | None = None) -> None:
        self.radii = _whole(rx), _whole(rx if ry is None else ry), _whole(rx if rz is None else rz)

    @property
    def weights(self) -> Kernel:
        x, y, z = (2 * r + 1 for r in self.radii)
        return [[[1.0] * z for _ in range(y)] for _ in range(x)]


class CustomKernel:
    """Weights in one list, z fastest, then y, then x: CustomKernel(weights, rx, ry, rz)."""

    def __init__(self, weights: Any, rx: int, ry: int, rz: int) -> None:
        self.radii = _whole(rx), _whole(ry), _whole(rz)
        flat = [number(weight) for weight in weights]
        x, y, z = (2 * r + 1 for r in self.radii)
        if len(flat) != x * y * z:
            raise ValueError(f"CustomKernel: expected {x} x {y} x {z} = {x * y * z} weights, found {len(flat)}")
        values = iter(flat)
        self.weights: Kernel = [[list(itertools.islice(values, z)) for _ in range(y)] for _ in range(x)]


class Convolution(Unary):
    """Each voxel gets the weighted mean of those around it: Convolution(kernel[x][y][z], child)."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        values = read("Convolution", ({"kernel": _kernel, "child": Optional(as_node, None)},), arguments, named)
        super().__init__(values["child"])
        self._weights: Kernel = values["kernel"]

    @staticmethod
    def BlendKernel(x: int, y: int, z: int) -> Kernel:
        """Equal weights."""
        nx, ny, nz = _counts(x, y, z)
        return [[[1.0] * nz for _ in range(ny)] for _ in range(nx)]

    @staticmethod
    def PassKernel(x: int, y: int, z: int) -> Kernel:
        """One weight, in the middle: everything stays as it is."""
        nx, ny, nz = _counts(x, y, z)
        kernel = [[[0.0] * nz for _ in range(ny)] for _ in range(nx)]
        kernel[nx // 2][ny // 2][nz // 2] = 1.0
        return kernel

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.convolve(self._weights, solids[0])


class Convolve(Unary):
    """Filters the composition and attributes: Convolve(child, [names], kernel, [rx, ry, rz]), radii in mm."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        form = {"child": as_node, "names": _names, "kernel": instance_of(BoxKernel, CustomKernel), "radius": vector,
                "override_voxel_size": Optional(voxel_size, None)}
        values = read("Convolve", (form,), arguments, named)
        super().__init__(values["child"])
        self._names: list[str] = values["names"]
        self._box: BoxKernel | CustomKernel = values["kernel"]
        self._pitch: Point = values["override_voxel_size"] or tuple(  # type: ignore[assignment]
            length(mm) / max(1, voxels) for mm, voxels in zip(values["radius"], self._box.radii))

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.convolve(self._box.weights, solids[0], attributes=_filtered(self._names, self),
                              pitch=self._pitch)


class Blend(Unary):
    """Mean values of a box: Blend(radius, child), mm; Blend(child, [names], [rx, ry, rz], num_passes=1)."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        values = read("Blend", ({"radius": length, "child": Optional(as_node, None)},
                                {"child": as_node, "names": _names, "radius": size, "num_passes": Optional(_whole, 1),
                                 "override_voxel_size": Optional(voxel_size, None)}), arguments, named)
        super().__init__(values["child"])
        radius = values["radius"]
        self._radii: Point = (radius, radius, radius) if isinstance(radius, float) else radius
        self._names: list[str] = values.get("names", [])
        self._passes: int = values.get("num_passes", 1)
        self._pitch: Point = values.get("override_voxel_size") or tuple(  # type: ignore[assignment]
            2 * r / (2 * _finest + 1) for r in self._radii)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        solid = solids[0]
        box = BoxKernel(*(max(0, round(r / step - 0.5)) for r, step in zip(self._radii, self._pitch)))  # 2 r wide
        for _ in range(self._passes):
            solid = ombre.convolve(box.weights, solid, attributes=_filtered(self._names, self), pitch=self._pitch)
        return solid


class Voxels(_Leaf):
    """Voxels with the materials of their colours: Voxels(file, voxel_size, min, material_defs), or Voxels(voxel_size,
    min) and populate_with_png_stack(folder, min, voxel_size)."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        place = {"voxel_size": voxel_size, "min": vector}
        forms = ({"file": text, **place, "material_defs": instance_of(MaterialDefs)}, place)
        values = read("Voxels", forms, arguments, named)
        self._file: str | None = values.get("file")
        self._size: Point = values["voxel_size"]
        self._min: Point = values["min"]
        self._defs: MaterialDefs | None = values.get("material_defs")

    def populate_with_png_stack(self, folder: Any, min: Any, voxel_size: Any) -> None:  # pylint: disable=redefined-builtin
        """Takes the images of a folder, in the order of their numbers, from the lowest layer up."""
        values = read("populate_with_png_stack", ({"folder": text, "min": vector, "voxel_size": _voxels},),
                      (folder, min, voxel_size), {})
        self._file, self._min, self._size = values["folder"], values["min"], values["voxel_size"]

    def populate_with_equation(self, *_: Any) -> None:
        """Is not there: Function takes formulas."""
        raise NotImplementedError("Voxels.populate_with_equation is not in Ombre yet; write Function(expression)")

    def _says_material(self) -> bool:
        return True

    def _own_materials(self) -> set[int]:
        return set()

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        if self._file is None:
            raise ValueError("Voxels holds nothing yet; call populate_with_png_stack(folder, min, voxel_size)")
        return ombre.voxel(self._file, self._size, min=self._min)


_voxels = voxel_size


def _filtered(names: list[str], node: Unary) -> list[str]:
    """The attributes to filter beside the composition; no names: all."""
    wanted = names or node.attribute_list()
    return [name for name in wanted if name != "volume_fractions"]
