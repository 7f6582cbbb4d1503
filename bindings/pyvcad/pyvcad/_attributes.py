"""Attributes of nodes, as scripts of pyvcad 3 have them in place of materials: values that vary through a solid."""
from __future__ import annotations

import copy
import enum
import math
import numbers
import operator
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import ombre

from ._arguments import material
from ._functions import expression
from ._vectors import Vec3, Vec4
from ._volumes import FloatVolume, Vec3sVolume, Vec4sVolume, Volume


class ReturnType(str, enum.Enum):
    """What an attribute gives at a point: a number, a vector, a colour, or a dict of fractions."""

    dbl = "dbl"
    vec3 = "vec3"
    vec4 = "vec4"
    vfm_ptr = "vfm_ptr"
    none = "none"


class _Names(type):
    if TYPE_CHECKING:
        def __getattr__(cls, name: str) -> Any: ...


class DefaultAttributes(metaclass=_Names):
    """Names of attributes that programs know; NAME_TYPE is what each gives."""

    @staticmethod
    def get_return_type_by_name(name: str) -> ReturnType:
        """Returns what an attribute of this name gives; ReturnType.none for unknown names."""
        return _types.get(name, ReturnType.none)


_types: dict[str, ReturnType] = {}
_others = {"VOLUME_FRACTIONS": ReturnType.vfm_ptr, "COLOR_RGBA": ReturnType.vec4, "COLOR_RGB": ReturnType.vec3,
           "NONE": ReturnType.none}

for _name in ("MODULUS VOLUME_FRACTIONS COLOR_RGBA COLOR_RGB TEMPERATURE FLOW_RATE DENSITY HU TOUGHNESS ELONGATION "
              "SHORE_HARDNESS POISSONS_RATIO INTENSITY INFILL_DENSITY FUZZY_SKIN_POINT_DISTANCE FUZZY_SKIN_THICKNESS "
              "BRIDGE_SPEED EXTERNAL_PERIMETER_SPEED GAP_FILL_SPEED INFILL_SPEED IRONING_SPEED PERIMETER_SPEED "
              "SMALL_PERIMETER_SPEED SOLID_INFILL_SPEED TOP_SOLID_INFILL_SPEED EXTRUSION_WIDTH "
              "EXTERNAL_PERIMETER_EXTRUSION_WIDTH INFILL_EXTRUSION_WIDTH PERIMETER_EXTRUSION_WIDTH "
              "SOLID_INFILL_EXTRUSION_WIDTH SUPPORT_MATERIAL_EXTRUSION_WIDTH TOP_INFILL_EXTRUSION_WIDTH "
              "IRONING_FLOWRATE LAYER_HEIGHT PERIMETERS NONE").split():
    _types[_name.lower()] = _others.get(_name, ReturnType.dbl)
    setattr(DefaultAttributes, _name, _name.lower())
    setattr(DefaultAttributes, f"{_name}_TYPE", _types[_name.lower()])
setattr(DefaultAttributes, "TOUGHNSS_TYPE", ReturnType.dbl)  # as scripts spell it


class Changes:
    """The number of changes so far of nodes that something was built from, and of attributes."""

    count = 0


class Attribute:
    """A value that varies through the node that it is set on; formulas know x, y, z, rho, ... and the distance d."""

    ReturnType = ReturnType
    _version = 0  # the number of its changes

    def _changed(self) -> None:
        self._version += 1
        Changes.count += 1

    def clone(self) -> Attribute:
        """Returns an attribute that changes of this one do not change."""
        return copy.deepcopy(self)

    def _given_to(self, solid: ombre.Solid, name: str) -> ombre.Solid:
        raise NotImplementedError

    def _materials(self) -> set[int] | None:
        """The ids that it names, if it says of what the node is."""
        return None


def _formula(value: Any, what: str) -> ombre.Expression:
    """Returns a formula for arithmetic, which cannot use functions."""
    if isinstance(value, FloatAttribute):
        value = ombre.Expression(value._value) if isinstance(value._value, str) else value._value
    if isinstance(value, FloatVolume):
        value = value._component(0)
    if isinstance(value, ombre.Expression):
        return value
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        return ombre.Expression("0") + float(value)
    raise TypeError(f"{what}: arithmetic of attributes takes numbers and attributes of formulas, found "
                    f"{type(value).__name__}")


def _combined(name: str, reverse: bool = False) -> Any:
    def method(self: FloatAttribute, other: Any) -> FloatAttribute:
        a, b = _formula(self, name), _formula(other, name)
        return FloatAttribute(getattr(operator, name)(b, a) if reverse else getattr(operator, name)(a, b))
    return method


class FloatAttribute(Attribute):
    """A number, a formula, a function or a FloatVolume: FloatAttribute("0.2 + z/10"). Arithmetic of attributes gives new
    ones."""

    _value: Any
    _volume: Volume | None = None

    def __init__(self, value: Any = 0.0) -> None:
        self._set(value)

    def _set(self, value: Any) -> None:
        self._changed()
        self._volume = value if isinstance(value, FloatVolume) else None
        self._value = self._volume._component(0) if self._volume else expression(
            value._value if isinstance(value, FloatAttribute) else value)

    __add__, __radd__ = _combined("add"), _combined("add", True)
    __sub__, __rsub__ = _combined("sub"), _combined("sub", True)
    __mul__, __rmul__ = _combined("mul"), _combined("mul", True)
    __truediv__, __rtruediv__ = _combined("truediv"), _combined("truediv", True)
    __pow__, __rpow__ = _combined("pow"), _combined("pow", True)

    def __neg__(self) -> FloatAttribute:
        return FloatAttribute(-_formula(self, "-"))

    def __abs__(self) -> FloatAttribute:
        return FloatAttribute(abs(_formula(self, "abs")))

    def clamp(self, low: float, high: float) -> FloatAttribute:
        """Limits the value to at least `low` and at most `high`."""
        if low > high:
            raise ValueError(f"clamp: expected low <= high, found {low} and {high}")
        return FloatAttribute(ombre.clamp(low, _formula(self, "clamp"), high))

    def map_range(self, in_0: float, in_1: float, out_0: float, out_1: float) -> FloatAttribute:
        """Maps the value linearly, so that in_0 becomes out_0 and in_1 becomes out_1."""
        if in_0 == in_1:
            raise ValueError(f"map_range: expected two different numbers to begin with, found {in_0} twice")
        return FloatAttribute(out_0 + (_formula(self, "map_range") - in_0) * ((out_1 - out_0) / (in_1 - in_0)))

    def normalize(self, low: float, high: float) -> FloatAttribute:
        """So that `low` becomes 0 and `high` becomes 1."""
        return self.map_range(low, high, 0.0, 1.0)

    def sample(self, x: float, y: float, z: float, d: float = 0.0) -> float:
        """Returns the value at a point, at the signed distance d from its solid."""
        return _sampled(self._value, (x, y, z), d)

    def return_type(self) -> ReturnType:
        return ReturnType.dbl

    def set_value(self, value: Any) -> None:
        self._set(value)

    set_expression = set_function = set_volume = set_value

    def is_volume_backed(self) -> bool:
        """Is it a volume, as it was given?"""
        return self._volume is not None

    def volume_type_name(self) -> str:
        return self._volume.grid_type() if self._volume else ""

    def _given_to(self, solid: ombre.Solid, name: str) -> ombre.Solid:
        return ombre.attribute(solid, name, self._value)


def _sampled(value: Any, point: tuple[float, float, float], d: float) -> float:
    """A definition at a point. Of formulas with d, at that distance. Raises RuntimeError where it is not finite."""
    if isinstance(value, (int, float)):
        return float(value)
    # The distance of a ball of radius r is d at r + d from its middle.
    radius = max(1.0, 1.0 - d)
    ball = ombre.translate(ombre.sphere(radius), (point[0] - radius - d, point[1], point[2]))
    found = float(ombre.attribute(ball, "value", value).attribute("value", point))
    if not math.isfinite(found):
        raise RuntimeError(f"the attribute has no finite value at ({', '.join(f'{c:g}' for c in point)})")
    return found


def with_names(formula: str, texts: dict[str, str], other: Callable[[str], str] = str) -> str:
    """The formula, in which texts stand for names: for a name as it is spelt, or else without regard to case, as formulas
    have it. `other` gives the text for other names and for words."""
    by_lower = {name.lower(): text for name, text in texts.items()}

    def put(word: re.Match[str]) -> str:
        return texts.get(word[0]) or by_lower.get(word[0].lower()) or other(word[0])
    return re.sub(r"(?<![\w.])[A-Za-z_]\w*", put, formula)


class DerivedFloatAttribute(FloatAttribute):
    """A formula of other attributes: DerivedFloatAttribute("a + 2*b", {"a": FloatAttribute("x"), "b": 3})."""

    def __init__(self, formula: str, inputs: dict[str, Any]) -> None:
        if not isinstance(formula, str) or not isinstance(inputs, dict):
            raise TypeError("DerivedFloatAttribute: expected a formula and a dict of the attributes that it names")
        formulas = {name: _formula(value, name) for name, value in inputs.items()}
        functions: Any = ombre._functions
        known = {"pi", "e", "true", "false", "and", "or", "not", "nor", "nand", "xor", "if", *functions}

        def put(word: str) -> str:
            if word.lower() not in known:
                raise ValueError(f"DerivedFloatAttribute: the formula names {word!r}, which is none of its inputs")
            return word
        volumes: dict[str, Any] = {}
        for part in formulas.values():
            volumes.update(getattr(part, "_ombre_values_"))
        whole = with_names(formula, {name: f"({text})" for name, text in formulas.items()}, put)
        super().__init__(ombre.Expression(whole, "?", volumes))  # type: ignore[call-arg]

    def set_value(self, value: Any) -> None:
        raise RuntimeError("a DerivedFloatAttribute does not change")

    set_expression = set_function = set_volume = set_value


class _VectorAttribute(Attribute):
    _size, _kind, _names = 3, "vec3", "xyz"
    _volumes: type[Volume] = Vec3sVolume
    _volume: Volume | None = None

    def __init__(self, *parts: Any) -> None:
        if len(parts) == 1 and isinstance(parts[0], self._volumes):
            self.set_volume(parts[0])
            return
        self._set(parts or [0.0] * self._size)

    def component(self, i: int) -> FloatAttribute:
        return FloatAttribute(self._parts[i])

    def set_volume(self, volume: Volume) -> None:
        """Takes its numbers from the volume's channels."""
        if not isinstance(volume, self._volumes):
            raise TypeError(f"{type(self).__name__}: expected a {self._volumes.__name__}, found {type(volume).__name__}")
        self._changed()
        self._volume = volume
        self._parts = [FloatAttribute(volume._component(i)) for i in range(self._size)]

    def is_volume_backed(self) -> bool:
        return self._volume is not None

    def volume_type_name(self) -> str:
        return self._volume.grid_type() if self._volume else ""

    def sample(self, x: float, y: float, z: float, d: float = 0.0) -> Any:
        return [part.sample(x, y, z, d) for part in self._parts]

    def return_type(self) -> ReturnType:
        return ReturnType(self._kind)

    def set_value(self, *parts: Any) -> None:
        """Takes a number, a formula or a function for each component."""
        self._volume = None
        self._set(parts)

    set_expression = set_function = set_value

    def _set(self, parts: Any) -> None:
        if len(parts) != self._size:
            raise TypeError(f"{type(self).__name__}: expected {self._size} numbers, formulas or functions, found "
                            f"{len(parts)}")
        self._changed()
        self._parts = [FloatAttribute(part) for part in parts]

    def _given_to(self, solid: ombre.Solid, name: str) -> ombre.Solid:
        kind = "colour" if self._size == 4 else "vector"
        return ombre.attribute(solid, name, [part._value for part in self._parts], type=kind)


class Vec3Attribute(_VectorAttribute):
    """Three numbers, formulas or functions: Vec3Attribute("x", 0, 1)."""

    x = property(lambda self: self.component(0))
    y = property(lambda self: self.component(1))
    z = property(lambda self: self.component(2))

    def sample(self, x: float, y: float, z: float, d: float = 0.0) -> Vec3:
        return Vec3(*super().sample(x, y, z, d))

    def _each(self, other: Any, change: Any) -> Vec3Attribute:
        others = other._parts if isinstance(other, Vec3Attribute) else [other] * 3
        return Vec3Attribute(*(change(a, b) for a, b in zip(self._parts, others)))

    def __add__(self, other: Vec3Attribute) -> Vec3Attribute:
        return self._each(other, operator.add)

    def __sub__(self, other: Vec3Attribute) -> Vec3Attribute:
        return self._each(other, operator.sub)

    def __mul__(self, other: Any) -> Vec3Attribute:
        return self._each(other, operator.mul)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Vec3Attribute:
        return self._each(other, operator.truediv)

    def __neg__(self) -> Vec3Attribute:
        return self._each(0, lambda a, _: -a)

    def dot(self, other: Any) -> FloatAttribute:
        """Returns the product with another attribute, or with a Vec3."""
        x, y, z = (a * b for a, b in zip(self._parts, other._parts if isinstance(other, Vec3Attribute) else other))
        return x + y + z

    def magnitude(self) -> FloatAttribute:
        return self.dot(self) ** 0.5

    def normalized(self) -> Vec3Attribute:
        return self / self.magnitude()


class Vec4Attribute(_VectorAttribute):
    """Red, green, blue and alpha from 0 to 1, each a number, a formula or a function."""

    _size, _kind, _names = 4, "vec4", "rgba"
    _volumes = Vec4sVolume

    def sample(self, x: float, y: float, z: float, d: float = 0.0) -> Vec4:
        return Vec4(*super().sample(x, y, z, d))


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
        self._changed()
        self._fractions.append((expression(definition), material(id)))

    def add_value(self, *value_and_id: Any) -> None:
        self._add(value_and_id)

    def add_expression(self, *expression_and_id: Any) -> None:
        self._add(expression_and_id)

    def add_function(self, *function_and_id: Any) -> None:
        self._add(function_and_id)

    def return_type(self) -> ReturnType:
        return ReturnType.vfm_ptr

    def sample(self, x: float, y: float, z: float, d: float = 0.0) -> dict[int, float]:
        """Returns {material's id: fraction} at a point, at the signed distance d from its solid."""
        shares: dict[int, float] = {}
        for definition, id in self._fractions:
            shares[id] = shares.get(id, 0.0) + _sampled(definition, (x, y, z), d)
        return shares

    @staticmethod
    def get_value(samples: Any) -> dict[int, float]:
        """Returns {material's id: fraction} of the samples of a point."""
        return dict(samples.get_sample("volume_fractions"))

    def _given_to(self, solid: ombre.Solid, name: str) -> ombre.Solid:
        functions, materials = [f for f, _ in self._fractions], [m for _, m in self._fractions]
        return ombre.fgrade(solid, functions, materials, mode="prob")

    def _materials(self) -> set[int] | None:
        return {id for _, id in self._fractions}


def checked(name: Any, attribute: Any) -> tuple[str, Attribute]:
    """Checks the arguments of set_attribute."""
    if not isinstance(name, str):
        raise TypeError(f"set_attribute: expected a name, found {type(name).__name__}")
    if not isinstance(attribute, Attribute):
        raise TypeError(f"set_attribute: expected an attribute such as FloatAttribute(...), found "
                        f"{type(attribute).__name__}")
    is_fractions = isinstance(attribute, VolumeFractionsAttribute)
    if is_fractions != (name == "volume_fractions"):
        raise TypeError('set_attribute: "volume_fractions" is a VolumeFractionsAttribute, and no other attribute is; '
                        f"found {name!r} with a {type(attribute).__name__}")
    return name, attribute
