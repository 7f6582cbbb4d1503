"""Finds the conversions between attributes that lead to those which a process needs.

    import pyvcad_attribute_resolver as resolver

    resolver.register_conversion("density", "temperature", lambda: pv.ExpressionConverter(...))
    part = resolver.adapt(part, ["temperature"])

Measured tables of others are not part of it: register_calibration takes a calibration of Ombre, or a file of one's own.
"""
from pyvcad._missing import attribute_of

from ._calibrations import register_calibration
from ._conversions import (register_generic_color_conversions, register_scalars_to_vec3_conversions,
                           register_scalars_to_vec4_conversions, register_vec3_to_scalars_conversions,
                           register_vec4_to_scalars_conversions, register_vector_component_conversions)
from ._registry import (AmbiguousPathError, ConversionEntry, NoPathError, ResolverError, adapt, clear_conversions,
                        list_conversions, list_modules, register_conversion, unregister_conversion)

__all__ = ["AmbiguousPathError", "ConversionEntry", "NoPathError", "ResolverError", "adapt", "clear_conversions",
           "list_conversions", "list_modules", "register_calibration", "register_conversion",
           "register_generic_color_conversions", "register_scalars_to_vec3_conversions",
           "register_scalars_to_vec4_conversions", "register_vec3_to_scalars_conversions",
           "register_vec4_to_scalars_conversions", "register_vector_component_conversions", "unregister_conversion"]


def __getattr__(name: str) -> object:
    return attribute_of(__name__, __all__, name)
