"""Raised volumes on faces of CAD files and patches of meshes, whose height follows an image or a formula."""
from __future__ import annotations

import os
import struct
from typing import Any

import ombre

from ._arguments import length, not_negative, number
from ._attributes import FloatAttribute
from ._solids import _find, _Leaf, _unset
from ._surfaces import OpenSurface, cells_on

_channels = {"red": 0, "green": 1, "blue": 2}


class HeightField:
    """The height of a relief over u and v, which run from 0 to 1; (0, 0) is the lower left."""

    def __init__(self, what: str, amplitude_mm: Any) -> None:
        self.amplitude_mm = length(number(amplitude_mm))
        self._what = what

    def _share(self, u: Any, v: Any) -> Any:
        """The height as a share of the amplitude, from 0 to 1."""
        raise NotImplementedError


class FunctionalHeightField(HeightField):
    """Heights by a formula: FunctionalHeightField(FloatAttribute("0.5 + 0.5*sin(20*x)"), amplitude_mm=1).

    In the formula x is u and y is v; the result is limited to 0 to 1.
    """

    def __init__(self, function: Any, amplitude_mm: float) -> None:
        super().__init__("FunctionalHeightField", amplitude_mm)
        self._function = function if isinstance(function, FloatAttribute) else FloatAttribute(function)

    def _share(self, u: Any, v: Any) -> Any:
        return ombre.clamp(0, ombre.at(self._function._value, (u, v, 0)).value, 1)


class ImageHeightField(HeightField):
    """Heights by an image: white is the amplitude, black 0.

    Args:
        path: a PNG file.
        amplitude_mm: the greatest height.
        channel: "luminance", "red", "green" or "blue".
        mapping: "fit" stretches the image over the surface, "repeat" repeats it.
        repeats: times along u and v, for the mapping "repeat".
    """

    def __init__(self, path: Any, amplitude_mm: float, channel: str = "luminance", mapping: str = "fit",
                 repeats: Any = (1, 1)) -> None:
        what = "ImageHeightField"
        super().__init__(what, amplitude_mm)
        if channel != "luminance" and channel not in _channels:
            raise ValueError(f"{what}, channel: expected luminance, {', '.join(_channels)}, found {channel!r}")
        if mapping not in ("fit", "repeat"):
            raise ValueError(f'{what}, mapping: expected "fit" or "repeat", found {mapping!r}')
        self._path, self._channel = _find(what, os.fspath(path)), channel
        self._repeats = [length(number(n)) for n in repeats] if mapping == "repeat" else [1.0, 1.0]
        self._wrap = "repeat" if mapping == "repeat" else "clamp"

    def _share(self, u: Any, v: Any) -> Any:
        columns, rows = _size_of_png(self._what, self._path)
        image = ombre.texture(self._path, 1, wrap=self._wrap)  # 1 mm wide, and centred on the origin
        value = image.value if self._channel == "luminance" else image.colour[_channels[self._channel]]
        place = (u * self._repeats[0] - 0.5, (v * self._repeats[1] - 0.5) * (rows / columns), 0)
        return ombre.at(value, place).value


def _size_of_png(what: str, path: str) -> tuple[int, int]:
    with open(path, "rb") as file:
        begin = file.read(24)
    if begin[:8] != b"\x89PNG\r\n\x1a\n" or len(begin) < 24:
        raise ValueError(f"{what}: {path} is no PNG file")
    columns, rows = struct.unpack(">II", begin[16:])
    return columns, rows


class SurfaceReliefVolume(_Leaf):
    """A raised volume on a surface: SurfaceReliefVolume(surface, height_field, embed_mm=0, edge_falloff_mm=0).

    Args:
        surface: a CADFace or a TriangleMeshSurface; the relief lies on its outer side.
        height_field: an ImageHeightField or a FunctionalHeightField.
        embed_mm: how far it reaches into the part, so that both overlap.
        edge_falloff_mm: width of a band along the border in which the relief sinks to the surface.
    """

    def __init__(self, surface: Any, height_field: Any, embed_mm: float = 0.0, edge_falloff_mm: float = 0.0) -> None:
        super().__init__()
        what = type(self).__name__
        if not isinstance(surface, OpenSurface):
            raise TypeError(f"{what}: expected a CADFace or a TriangleMeshSurface, found {type(surface).__name__}")
        if not isinstance(height_field, HeightField):
            raise TypeError(f"{what}: expected an ImageHeightField or a FunctionalHeightField, found "
                            f"{type(height_field).__name__}")
        self._surface, self._heights = surface, height_field
        self._embed, self._falloff = not_negative(number(embed_mm)), not_negative(number(edge_falloff_mm))
        self._material = _unset
        amplitude = height_field.amplitude_mm
        self._above = cells_on(what, surface, (1, 1, 1), height=amplitude)
        self._below = cells_on(what, surface, (1, 1, 1), height=self._embed, side="inside") if self._embed > 0 else None

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        u, v, w = self._above.place
        amplitude = self._heights.amplitude_mm
        height = amplitude * self._heights._share(u, v)
        if self._falloff > 0:
            height = height * ombre.clamp(0, self._above.border / self._falloff, 1)
        raised = ombre.intersection(ombre.solid_of(self._above.region),
                                    ombre.function(amplitude * w - height, self._material), materials="last")
        if self._below is None:
            return raised
        return ombre.union(raised, ombre.material(ombre.solid_of(self._below.region), [self._material]), materials="first")
