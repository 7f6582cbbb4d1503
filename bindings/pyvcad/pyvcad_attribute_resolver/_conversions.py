"""Conversions between vectors, colours and their numbers."""
from __future__ import annotations

import ombre

from pyvcad import ExpressionConverter, ScalarsToVec3Converter, ScalarsToVec4Converter, Vec3ToScalarsConverter

from ._registry import OneToOne, register_conversion


class _Joined(OneToOne):
    """A vector or colour of formulas."""

    def __init__(self, source: str, target: str, formulas: list[str], type: str) -> None:
        super().__init__(source, target)
        self._formulas, self._type = formulas, type

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        return ombre.attribute(solid, self._target, list(self._formulas), type=self._type)


def register_generic_color_conversions(alpha: float = 1.0) -> list[str]:
    """Between color_rgb and color_rgba, whose alpha is given."""
    rgb, rgba = "color_rgb", "color_rgba"
    shades = [f"{rgb}.{axis}" for axis in "xyz"]
    return [register_conversion(rgb, rgba, lambda: _Joined(rgb, rgba, [*shades, repr(float(alpha))], "colour")),
            register_conversion(rgba, rgb, lambda: _Joined(rgba, rgb, [f"{rgba}.{part}" for part in "rgb"], "vector"))]


def register_vec3_to_scalars_conversions(source: str, x: str, y: str, z: str) -> list[str]:
    return [register_conversion(source, target, lambda: Vec3ToScalarsConverter(source, x, y, z)) for target in (x, y, z)]


def register_vec4_to_scalars_conversions(source: str, x: str, y: str, z: str, w: str) -> list[str]:
    names = [x, y, z, w]
    parts = [f"{source}.{part}" for part in "rgba"]
    return [register_conversion(source, target, lambda: ExpressionConverter([source], names, parts)) for target in names]


def register_scalars_to_vec3_conversions(x: str, y: str, z: str, target: str) -> str:
    return register_conversion(x, target, lambda: ScalarsToVec3Converter(x, y, z, target), required_inputs=[x, y, z])


def register_scalars_to_vec4_conversions(x: str, y: str, z: str, w: str, target: str) -> str:
    return register_conversion(x, target, lambda: ScalarsToVec4Converter(x, y, z, w, target),
                               required_inputs=[x, y, z, w])


def register_vector_component_conversions(vector: str, x: str, y: str, z: str) -> list[str]:
    """Between a vector and its numbers, in both directions."""
    return [*register_vec3_to_scalars_conversions(vector, x, y, z), register_scalars_to_vec3_conversions(x, y, z, vector)]
