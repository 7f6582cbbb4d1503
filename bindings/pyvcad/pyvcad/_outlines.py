"""Solids from outlines: texts and polygons with a height."""
from __future__ import annotations

from typing import Any

import ombre

from ._arguments import Optional, Point, boolean, length, read, text, vector
from ._enums import FontAspect, HorizontalAlignment, VerticalAlignment
from ._solids import _Leaf, _one, _unset

_free_font = "DejaVu Sans Mono"  # replaces Consolas, the default of pyvcad
_styles = {FontAspect.Regular: "regular", FontAspect.Bold: "bold", FontAspect.Italic: "italic",
           FontAspect.BoldItalic: "bold_italic"}
_sides = {HorizontalAlignment.Left: "left", HorizontalAlignment.Center: "center", HorizontalAlignment.Right: "right"}
_levels = {VerticalAlignment.Bottom: "bottom", VerticalAlignment.Center: "center", VerticalAlignment.Top: "top",
           VerticalAlignment.TopFirstLine: "top_first_line"}


def _choice(words: dict[Any, str]) -> Any:
    kind = type(next(iter(words)))

    def read_choice(value: Any) -> str:
        if not isinstance(value, kind):
            raise TypeError(f"expected a {kind.__name__}, found {type(value).__name__}")
        return words[value]
    return read_choice


class Text(_Leaf):
    """Letters with a depth, half of it to each side of z = 0: Text(text, height, depth, material=1, aspect, font,
    h_align, v_align), or without the material: Text(text, height, depth, aspect, font, h_align, v_align).

    The height is that of all lines together, from the lowest point of the letters to the highest. Lines end with a line
    feed. The letters stand upright along y.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        sizes = {"text": text, "height": length, "depth": length}
        styles = {"aspect": Optional(_choice(_styles), "regular"), "font": Optional(text, None),
                  "h_align": Optional(_choice(_sides), "center"), "v_align": Optional(_choice(_levels), "center")}
        has_material = len(arguments) < 4 or not isinstance(arguments[3], FontAspect)
        material: dict[str, Any] = {"material": _one} if has_material else {}
        form: dict[str, Any] = {**sizes, **material, **styles}
        values = read("Text", (form,), arguments, named)
        self._material = values.pop("material", _unset)
        self._values = values
        if not values["text"].strip():
            raise ValueError("Text: expected a text with letters")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        v = self._values
        font = v["font"] or _free_font
        return ombre.text(v["text"], v["height"], v["depth"], self._material, style=v["aspect"], font=font,
                          h_align=v["h_align"], v_align=v["v_align"], measure="letters")


def _vertices(value: Any) -> list[Point]:
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        raise TypeError(f"expected a list of Vec3, found {type(value).__name__}")
    points = [vector(point) for point in value]
    if len(points) < 3:
        raise ValueError(f"expected at least 3 points, found {len(points)}")
    return points


_unit_square: dict[str, Any] = {"vertices": [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)], "height": 1.0,
                                "symmetric": False, "material": _unset}


class PolygonExtrude(_Leaf):
    """Polygon with a height: PolygonExtrude(vertices, height, symmetric=False, material=1).

    At least 3 points in a plane; it rises along the normal around which they go counterclockwise, or by half of its
    height to each side. Without arguments it is a square of 1 mm from the origin, 1 mm high.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        form = {"vertices": _vertices, "height": length, "symmetric": Optional(boolean, False), "material": _one}
        values = {**_unit_square, **read("PolygonExtrude", ({}, form), arguments, named)}
        self._vertices, self._height = values["vertices"], values["height"]
        self._symmetric, self._material = values["symmetric"], values["material"]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.polygon_extrude(self._vertices, self._height, self._symmetric, self._material)
