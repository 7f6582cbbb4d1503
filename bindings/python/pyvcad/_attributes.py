"""Attributes of nodes, as scripts of pyvcad 3 have them in place of materials: values that vary through a solid."""
from __future__ import annotations

from typing import Any

import ombre

from ._arguments import material
from ._errors import missing
from ._functions import expression


class DefaultAttributes:
    """Names of attributes that programs know."""


for _name in ("MODULUS VOLUME_FRACTIONS COLOR_RGBA COLOR_RGB TEMPERATURE FLOW_RATE DENSITY HU TOUGHNESS ELONGATION "
              "SHORE_HARDNESS POISSONS_RATIO INTENSITY INFILL_DENSITY FUZZY_SKIN_POINT_DISTANCE FUZZY_SKIN_THICKNESS "
              "BRIDGE_SPEED EXTERNAL_PERIMETER_SPEED GAP_FILL_SPEED INFILL_SPEED IRONING_SPEED PERIMETER_SPEED "
              "SMALL_PERIMETER_SPEED SOLID_INFILL_SPEED TOP_SOLID_INFILL_SPEED EXTRUSION_WIDTH "
              "EXTERNAL_PERIMETER_EXTRUSION_WIDTH INFILL_EXTRUSION_WIDTH PERIMETER_EXTRUSION_WIDTH "
              "SOLID_INFILL_EXTRUSION_WIDTH SUPPORT_MATERIAL_EXTRUSION_WIDTH TOP_INFILL_EXTRUSION_WIDTH "
              "IRONING_FLOWRATE LAYER_HEIGHT PERIMETERS NONE").split():
    setattr(DefaultAttributes, _name, _name.lower())


class Attribute:
    """A value that varies through the node that it is set on; formulas know x, y, z, rho, ... and the distance d."""

    def _given_to(self, solid: ombre.Solid, name: str) -> ombre.Solid:
        raise NotImplementedError

    def _materials(self) -> set[int] | None:
        """The ids that it names, if it says of what the node is."""
        return None


class FloatAttribute(Attribute):
    """A number, a formula or a function: FloatAttribute("0.2 + z/10")."""

    def __init__(self, value: Any = 0.0) -> None:
        self._value = expression(value)

    def _given_to(self, solid: ombre.Solid, name: str) -> ombre.Solid:
        return ombre.attribute(solid, name, self._value)


class VolumeFractionsAttribute(Attribute):
    """How much of each material there is: VolumeFractionsAttribute([(definition, id), ...]), or two lists."""

    def __init__(self, fractions: Any = (), materials: Any = None) -> None:
        pairs = list(fractions) if materials is None else list(zip(fractions, materials))
        if materials is not None and len(pairs) != max(len(fractions), len(materials)):
            raise ValueError(f"VolumeFractionsAttribute: expected a definition for each material, found "
                             f"{len(fractions)} definitions and {len(materials)} materials")
        self._fractions: list[tuple[Any, int]] = []
        for pair in pairs:
            if not isinstance(pair, (tuple, list)) or len(pair) != 2:
                raise TypeError("VolumeFractionsAttribute: expected pairs (definition, material's id), found "
                                f"{type(pair).__name__}")
            self._add(pair)

    def _add(self, arguments: Any) -> None:
        if len(arguments) == 1:
            arguments = arguments[0]
        definition, id = arguments
        self._fractions.append((expression(definition), material(id)))

    def add_value(self, *value_and_id: Any) -> None:
        self._add(value_and_id)

    def add_expression(self, *expression_and_id: Any) -> None:
        self._add(expression_and_id)

    def add_function(self, *function_and_id: Any) -> None:
        self._add(function_and_id)

    def _given_to(self, solid: ombre.Solid, name: str) -> ombre.Solid:
        functions, materials = [f for f, _ in self._fractions], [m for _, m in self._fractions]
        return ombre.fgrade(solid, functions, materials, mode="prob")

    def _materials(self) -> set[int] | None:
        return {id for _, id in self._fractions}


def checked(name: Any, attribute: Any) -> tuple[str, Attribute]:
    """What set_attribute is given."""
    if not isinstance(name, str):
        raise TypeError(f"set_attribute: expected a name, found {type(name).__name__}")
    if not isinstance(attribute, Attribute):
        raise TypeError(f"set_attribute: expected an attribute such as FloatAttribute(...), found "
                        f"{type(attribute).__name__}")
    is_fractions = isinstance(attribute, VolumeFractionsAttribute)
    if is_fractions != (name == "volume_fractions"):
        raise TypeError('set_attribute: "volume_fractions" is a VolumeFractionsAttribute, and no other attribute is; '
                        f"found {name!r} with a {type(attribute).__name__}")
    if name in ("color_rgba", "color_rgb"):
        raise missing(f"the attribute {name}", "name materials by \"volume_fractions\"")
    return name, attribute
