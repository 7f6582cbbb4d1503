"""Solids of meshes with colours."""
from __future__ import annotations

import warnings
from typing import Any

import ombre

from ._arguments import Optional, boolean, length, read, text, vector
from ._solids import _centered, _find, _Leaf, _maybe_size, _unset

_color = "color_rgba"


def _maybe_color(value: Any) -> Any:
    return None if value is None else vector(value)


class TexturedMesh(_Leaf):
    """Solid of a file with colours or textures, with the attribute "color_rgba": TexturedMesh(path, color_depth=1.0,
    core_color=Vec3(1, 1, 1), fallback_color=None, center=False, obj_unit_scale=1.0, override_voxel_size=None,
    disable_validation=False).

    Down to `color_depth` below the surface (mm) it has the colour of the nearest place of the surface, deeper the core's.
    A file without colours has `fallback_color`, and without that it is an error. `obj_unit_scale` is the unit of an .obj
    file, mm; `override_voxel_size` is accepted, and nothing is sampled.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__()
        values = read("TexturedMesh", ({
            "path": text, "color_depth": Optional(length, 1.0), "core_color": Optional(vector, (1.0, 1.0, 1.0)),
            "fallback_color": Optional(_maybe_color, None), "center": Optional(boolean, False),
            "obj_unit_scale": Optional(length, 1.0), "override_voxel_size": Optional(_maybe_size, None),
            "disable_validation": Optional(boolean, False)},), arguments, named)
        self._path = _find("TexturedMesh", values["path"])
        self._depth, self._core, self._fallback = values["color_depth"], values["core_color"], values["fallback_color"]
        self._is_centered, self._any_winding = values["center"], values["disable_validation"]
        self._scale = values["obj_unit_scale"] if self._path.lower().endswith(".obj") else 1.0
        self._material = _unset

    def attribute_list(self) -> list[str]:
        return sorted({*super().attribute_list(), _color})

    def _computed(self) -> dict[str, list[str]]:
        return {_color: []}

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        winding: dict[str, Any] = {"inside": "generalized"} if self._any_winding else {}
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", ".*which do not become materials", ombre.DesignWarning)  # but the attribute
            solid: ombre.Solid = ombre.mesh(self._path, self._material, **winding)
        is_near = ombre.Expression(f"d >= -{self._depth / self._scale!r}")
        shades = [ombre.where(is_near, near, core) for near, core in zip(self._surface_colour(), self._core)]
        solid = ombre.attribute(solid, _color, [*shades, 1.0], type="colour")
        if self._scale != 1:
            solid = ombre.scale(solid, (self._scale,) * 3)
        return _centered(solid) if self._is_centered else solid

    def _surface_colour(self) -> list[Any]:
        try:
            colour = ombre.surface_colour(self._path).colour
            ombre.attribute(ombre.cube(1), "probe", colour.x).bounds  # noqa: B018  # reads the file, or refuses
            return [colour.x, colour.y, colour.z]
        except ombre.DesignError:
            if self._fallback is None:
                raise
            return list(self._fallback)
