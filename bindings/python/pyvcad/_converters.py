"""Attributes that are computed from others: AttributeModifier and its converters; and rules where children overlap."""
from __future__ import annotations

import enum
from typing import Any

import ombre

from ._arguments import material, number
from ._errors import missing
from ._tree import Unary


class InterpolationMode(enum.Enum):
    STEP = 0
    LINEAR = 1


class Vec4Mode(enum.Enum):
    PerChannel = 0
    Magnitude = 1


class _Resolver:
    _rule = ""


class _Average(_Resolver):
    _rule = "mean"


class _ByMode(_Resolver):
    def __init__(self, mode: Vec4Mode = Vec4Mode.PerChannel) -> None:
        if mode is not Vec4Mode.PerChannel:
            raise missing(f"{type(self).__name__}(Vec4Mode.Magnitude)", "Vec4Mode.PerChannel combines number by number")


class _Min(_ByMode):
    _rule = "min"


class _Max(_ByMode):
    _rule = "max"


class _Custom(_Resolver):
    def __init__(self, *functions: Any) -> None:
        raise missing("resolvers by functions", "AverageConflictResolver, MinConflictResolver, MaxConflictResolver")


class resolvers:
    """How an attribute combines where children overlap; without one, the first child that has it wins."""

    AverageConflictResolver = _Average
    MinConflictResolver = _Min
    MaxConflictResolver = _Max
    CustomFloatConflictResolver = _Custom
    CustomVec4ConflictResolver = _Custom


class AttributeConverterBase:
    """A converter of attributes. Those below are formulas; classes of one's own cannot be compiled."""

    def required_attributes(self) -> list[str]:
        raise missing("an AttributeConverterBase of one's own", "ExpressionConverter takes formulas")

    def output_attributes(self) -> list[str]:
        raise missing("an AttributeConverterBase of one's own", "ExpressionConverter takes formulas")

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        raise missing("an AttributeConverterBase of one's own", "ExpressionConverter takes formulas")

    def _materials(self) -> set[int] | None:
        return None


def _names(what: str, names: Any) -> list[str]:
    if isinstance(names, str) or not all(isinstance(name, str) for name in names):
        raise TypeError(f"{what}: expected a list of names of attributes")
    return list(names)


class ExpressionConverter(AttributeConverterBase):
    """A formula for each output, in which inputs are called by their names."""

    def __init__(self, input_attributes: Any, output_attributes: Any, expressions: Any) -> None:
        self._inputs = _names("ExpressionConverter", input_attributes)
        self._outputs = _names("ExpressionConverter", output_attributes)
        self._expressions = [str(expression) for expression in expressions]
        if len(self._outputs) != len(self._expressions):
            raise ValueError(f"ExpressionConverter: expected a formula for each output, found {len(self._expressions)} "
                             f"for {len(self._outputs)}")

    def required_attributes(self) -> list[str]:
        return list(self._inputs)

    def output_attributes(self) -> list[str]:
        return list(self._outputs)

    def clone(self) -> ExpressionConverter:
        return ExpressionConverter(self._inputs, self._outputs, self._expressions)

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        for name, formula in zip(self._outputs, self._expressions):
            solid = ombre.attribute(solid, name, formula)
        return solid


class VolumeFractionsExpressionConverter(AttributeConverterBase):
    """A formula for each material."""

    def __init__(self, input_attributes: Any, materials: Any, expressions: Any) -> None:
        self._inputs = _names("VolumeFractionsExpressionConverter", input_attributes)
        self._ids, self._expressions = [material(id) for id in materials], [str(e) for e in expressions]
        if len(self._ids) != len(self._expressions):
            raise ValueError("VolumeFractionsExpressionConverter: expected a formula for each material")

    def required_attributes(self) -> list[str]:
        return list(self._inputs)

    def output_attributes(self) -> list[str]:
        return ["volume_fractions"]

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        return ombre.fgrade(solid, self._expressions, self._ids)

    def _materials(self) -> set[int] | None:
        return set(self._ids)


class Vec3ToScalarsConverter(ExpressionConverter):
    def __init__(self, source: str, x: str, y: str, z: str) -> None:
        super().__init__([source], [x, y, z], [f"{source}.{axis}" for axis in "xyz"])


class _Joined(AttributeConverterBase):
    _type = "vector"

    def __init__(self, *names: str) -> None:
        *self._inputs, self._output = names

    def required_attributes(self) -> list[str]:
        return list(self._inputs)

    def output_attributes(self) -> list[str]:
        return [self._output]

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        return ombre.attribute(solid, self._output, list(self._inputs), type=self._type)


class ScalarsToVec3Converter(_Joined):
    def __init__(self, x: str, y: str, z: str, destination: str) -> None:
        super().__init__(x, y, z, destination)


class ScalarsToVec4Converter(_Joined):
    _type = "colour"

    def __init__(self, x: str, y: str, z: str, w: str, destination: str) -> None:
        super().__init__(x, y, z, w, destination)


class LookupTableEntry:
    """A row of a table: (low, high, value) for steps, (key, value) for lines; a value, or a list of one for each output."""

    def __init__(self, *row: Any) -> None:
        if len(row) not in (2, 3):
            raise TypeError(f"LookupTableEntry: expected (low, high, value) or (key, value), found {len(row)} arguments")
        if not all(isinstance(bound, (int, float)) for bound in row[:-1]):
            raise missing("a LookupTableEntry of several inputs", "ombre.table takes rows of one, two or three inputs")
        self.input_low, self.input_high = number(row[0]), number(row[-2])
        value = row[-1]
        self.output_values = list(value) if isinstance(value, (list, tuple)) else [value]
        self.is_valid = True


class LookupTableConverter(AttributeConverterBase):
    """What a table gives for one attribute: in steps, or in straight lines from key to key."""

    def __init__(self, input_attributes: Any, output_attributes: Any, entries: Any,
                 mode: InterpolationMode = InterpolationMode.STEP) -> None:
        self._inputs = _names("LookupTableConverter", input_attributes)
        self._outputs = _names("LookupTableConverter", output_attributes)
        self._entries: list[LookupTableEntry] = list(entries)
        if len(self._inputs) != 1:
            raise missing("a LookupTableConverter of several inputs", "ombre.table takes one, two or three")
        if not self._entries:
            raise ValueError("LookupTableConverter: expected at least one entry")
        for entry in self._entries:
            if len(entry.output_values) != len(self._outputs):
                raise ValueError(f"LookupTableConverter: expected {len(self._outputs)} values in an entry, found "
                                 f"{len(entry.output_values)}")
        self._mode = mode
        if mode is InterpolationMode.LINEAR:
            self._entries.sort(key=lambda entry: entry.input_low)

    def required_attributes(self) -> list[str]:
        return list(self._inputs)

    def output_attributes(self) -> list[str]:
        return list(self._outputs)

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        for n, name in enumerate(self._outputs):
            values = [entry.output_values[n] for entry in self._entries]
            if isinstance(values[0], dict):
                ids = sorted({material(id) for value in values for id in value})
                solid = ombre.fgrade(solid, [self._formula([value.get(id, 0.0) for value in values]) for id in ids], ids)
            elif isinstance(values[0], (int, float)):
                solid = ombre.attribute(solid, name, self._formula(values))
            else:
                parts = [self._formula([value[i] for value in values]) for i in range(len(values[0]))]
                solid = ombre.attribute(solid, name, parts, type="colour" if len(parts) == 4 else "vector")
        return solid

    def _formula(self, values: list[Any]) -> str:
        key, entries = self._inputs[0], self._entries
        texts = [repr(float(value)) for value in values]
        if self._mode is InterpolationMode.STEP:
            formula = "0/0"  # where no entry holds the number
            for entry, text in zip(reversed(entries), reversed(texts)):
                formula = f"if({key} >= {entry.input_low!r} and {key} <= {entry.input_high!r}, {text}, {formula})"
            return formula
        formula = texts[-1]
        for n in reversed(range(1, len(entries))):
            low, high = entries[n - 1].input_low, entries[n].input_low
            if low == high:
                raise ValueError(f"LookupTableConverter: the key {low:g} stands there twice")
            slope = (float(values[n]) - float(values[n - 1])) / (high - low)
            formula = f"if({key} < {high!r}, {texts[n - 1]} + ({key} - {low!r})*{slope!r}, {formula})"
        return f"if({key} < {entries[0].input_low!r}, {texts[0]}, {formula})"

    def _materials(self) -> set[int] | None:
        found = {id for entry in self._entries for value in entry.output_values if isinstance(value, dict)
                 for id in value}
        return found or None


class AttributeModifier(Unary):
    """Its child, with the attributes that a converter computes from the child's: AttributeModifier(converter, child)."""

    def __init__(self, converter: AttributeConverterBase, child: Any = None) -> None:
        if not isinstance(converter, AttributeConverterBase):
            raise TypeError(f"AttributeModifier: expected a converter, found {type(converter).__name__}")
        super().__init__(child)
        self._converter = converter

    def set_attribute(self, name: str, attribute: Any) -> None:
        raise RuntimeError("set_attribute: an AttributeModifier has the attributes that it computes; set it on another node")

    def get_attribute(self, name: str) -> Any:
        raise RuntimeError("get_attribute: an AttributeModifier has no attributes of its own")

    def attribute_list(self) -> list[str]:
        return sorted({*super().attribute_list(), *self._converter.output_attributes()})

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return self._converter._apply(solids[0])

    def _fractions(self) -> set[int] | None:
        return self._converter._materials()
