"""Attributes that are computed from others: AttributeModifier and its converters."""
from __future__ import annotations

import enum
import math
import numbers
from typing import Any

import ombre

from ._arguments import material, number
from ._attributes import with_names
from ._errors import missing
from ._functions import pointwise
from ._resolvers import numbers_of, with_numbers
from ._samples import AttributeSamples
from ._tree import Unary
from ._vectors import Vec3


class InterpolationMode(enum.Enum):
    STEP = 0
    LINEAR = 1


class AttributeConverterBase:
    """A converter of attributes. A class of one's own says required_attributes(), output_attributes() and convert().

    It may read three numbers in all (or one vector) and gives numbers. Python runs it at every point that is asked for, so
    ExpressionConverter is much faster where a formula will do.
    """

    def required_attributes(self) -> list[str]:
        raise NotImplementedError(f"{type(self).__name__}: required_attributes() is missing")

    def output_attributes(self) -> list[str]:
        raise NotImplementedError(f"{type(self).__name__}: output_attributes() is missing")

    def convert(self, samples: AttributeSamples) -> AttributeSamples:
        """The samples of one point, with the outputs set."""
        raise NotImplementedError(f"{type(self).__name__}: convert(samples) is missing")

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        inputs = {name: numbers_of(solid, name) for name in self.required_attributes()}
        numbers = [number for each in inputs.values() for number in each]
        if len(numbers) > 3:
            raise missing(f"{type(self).__name__} of {len(numbers)} numbers", "three, or an ExpressionConverter")
        place = (*numbers, 0, 0, 0)[:3]
        for name in self.output_attributes():
            solid = ombre.attribute(solid, name, ombre.at(pointwise(self._output_of(name, inputs)), place))
        return solid

    def _output_of(self, name: str, inputs: dict[str, list[Any]]) -> Any:
        """A function of the numbers of all inputs."""
        def at(x: float, y: float, z: float) -> float:
            left = [x, y, z]
            samples = AttributeSamples()
            for source, numbers in inputs.items():
                mine, left = left[:len(numbers)], left[len(numbers):]
                samples.set_sample(source, mine[0] if len(mine) == 1 else Vec3(*mine))
            return float(self.convert(samples).get_sample(name))
        return at

    def _materials(self) -> set[int] | None:
        return None


def _with_aliases(solid: ombre.Solid, inputs: list[str]) -> tuple[ombre.Solid, dict[str, str]]:
    """The solid, whose inputs have names that mean nothing else in formulas and no output has; and these names."""
    whole, aliases = solid, {}
    for n, name in enumerate(inputs):
        parts = numbers_of(solid, name)
        # The names of numbers, vectors and colours differ, since a name has one type in a whole design.
        aliases[name] = f"input_{n}_of_{len(parts)}"
        whole = with_numbers(whole, aliases[name], parts)
    return whole, aliases


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
        solid, aliases = _with_aliases(solid, self._inputs)
        for name, formula in zip(self._outputs, self._expressions):
            solid = ombre.attribute(solid, name, with_names(formula, aliases))
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
        solid, aliases = _with_aliases(solid, self._inputs)
        return ombre.fgrade(solid, [with_names(formula, aliases) for formula in self._expressions], self._ids)

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
        solid, aliases = _with_aliases(solid, self._inputs)
        return ombre.attribute(solid, self._output, list(aliases.values()), type=self._type)


class ScalarsToVec3Converter(_Joined):
    def __init__(self, x: str, y: str, z: str, destination: str) -> None:
        super().__init__(x, y, z, destination)


class ScalarsToVec4Converter(_Joined):
    _type = "colour"

    def __init__(self, x: str, y: str, z: str, w: str, destination: str) -> None:
        super().__init__(x, y, z, w, destination)


_unknown = "0/0"  # the formula of values that no entry has


def _pair(value: Any) -> tuple[float, float]:
    low, high = value
    return number(low), number(high)


class LookupTableEntry:
    """A row of a table; a value, or a list of one for each output.

    In steps of one input (low, high, value), of several ([(low, high), ...], [value of each]); in lines (key, value), of two
    inputs ([key, key], value). Where `is_valid` is False the table gives no number.
    """

    def __init__(self, *row: Any) -> None:
        if len(row) not in (2, 3):
            raise TypeError(f"LookupTableEntry: expected (low, high, value) or (key, value), found {len(row)} arguments")
        key = row[0]
        self.input_points: list[float] = []
        self.input_ranges: list[tuple[float, float]] = []
        if isinstance(key, (list, tuple)) and key and isinstance(key[0], (list, tuple)):
            self.input_ranges = [_pair(bounds) for bounds in key]
        elif isinstance(key, (list, tuple)):
            self.input_points = [number(value) for value in key]
        else:
            self.input_ranges = [(number(key), number(row[-2]))]
            self.input_points = [number(key)]
        value = row[-1]
        self.output_values = list(value) if isinstance(value, (list, tuple)) else [value]
        self.is_valid = True

    @property
    def input_low(self) -> float:
        return self.input_ranges[0][0]

    @property
    def input_high(self) -> float:
        return self.input_ranges[0][1]


def _steps(key: str, ranges: list[tuple[float, float]], texts: list[str]) -> str:
    """The text of the first range that holds the key."""
    formula = _unknown
    for (low, high), text in zip(reversed(ranges), reversed(texts)):
        formula = f"if({key} >= {low!r} and {key} <= {high!r}, {text}, {formula})"
    return formula


def _lines(key: str, keys: list[float], texts: list[str]) -> str:
    """Straight lines between formulas at keys that rise, and the ends beyond them."""
    formula = texts[-1]
    for n in reversed(range(1, len(keys))):
        low, high = keys[n - 1], keys[n]
        if low == high:
            raise ValueError(f"LookupTableConverter: the key {low:g} stands there twice")
        line = f"{texts[n - 1]} + ({key} - {low!r})/{high - low!r}*({texts[n]} - ({texts[n - 1]}))"
        if _unknown in texts[n]:  # the value at the key before is known all the same
            line = f"if({key} <= {low!r}, {texts[n - 1]}, {line})"
        formula = f"if({key} < {high!r}, {line}, {formula})"
    return f"if({key} < {keys[0]!r}, {texts[0]}, {formula})"


class LookupTableConverter(AttributeConverterBase):
    """Values of a table for attributes: in steps, or linear from key to key.

    In steps each of several inputs is looked up in its own ranges and gives its own output, or its number of the one vector
    or colour. Lines have an entry for each combination of the inputs' keys.
    """

    def __init__(self, input_attributes: Any, output_attributes: Any, entries: Any,
                 mode: InterpolationMode = InterpolationMode.STEP) -> None:
        self._inputs = _names("LookupTableConverter", input_attributes)
        self._outputs = _names("LookupTableConverter", output_attributes)
        self._entries: list[LookupTableEntry] = list(entries)
        self._mode = mode
        if not self._entries or not self._inputs:
            raise ValueError("LookupTableConverter: expected at least one entry and one input")
        if mode is InterpolationMode.LINEAR:
            self._check_lines()
        else:
            self._check_steps()

    def required_attributes(self) -> list[str]:
        return list(self._inputs)

    def output_attributes(self) -> list[str]:
        return list(self._outputs)

    def _check_steps(self) -> None:
        count = len(self._inputs)
        for entry in self._entries:
            if len(entry.input_ranges) != count:
                raise ValueError(f"LookupTableConverter: expected {count} ranges in an entry, found "
                                 f"{len(entry.input_ranges)}")
            self._check_values(entry, count if count > 1 else len(self._outputs))
        if count > 1 and len(self._outputs) not in (1, count):
            raise ValueError(f"LookupTableConverter: expected one output, or {count}, found {len(self._outputs)}")

    def _check_lines(self) -> None:
        count = len(self._inputs)
        for entry in self._entries:
            if len(entry.input_points) != count:
                raise ValueError(f"LookupTableConverter: expected {count} keys in an entry, found {len(entry.input_points)}")
            self._check_values(entry, len(self._outputs))
        self._entries.sort(key=lambda entry: entry.input_points)
        self._keys = [sorted({entry.input_points[i] for entry in self._entries}) for i in range(count)]
        if len(self._entries) != math.prod(map(len, self._keys)):
            raise ValueError("LookupTableConverter: expected one entry for each combination of keys, found "
                             f"{len(self._entries)} for {' times '.join(str(len(keys)) for keys in self._keys)}")

    @staticmethod
    def _check_values(entry: LookupTableEntry, count: int) -> None:
        if len(entry.output_values) != count:
            raise ValueError(f"LookupTableConverter: expected {count} values in an entry, found {len(entry.output_values)}")

    def _apply(self, solid: ombre.Solid) -> ombre.Solid:
        solid, aliases = _with_aliases(solid, self._inputs)
        keys = list(aliases.values())
        if len(self._inputs) > 1 and self._mode is InterpolationMode.STEP:
            return self._apply_steps(solid, keys)
        for n, name in enumerate(self._outputs):
            values = [entry.output_values[n] for entry in self._entries]
            if isinstance(values[0], dict):
                ids = sorted({material(id) for value in values for id in value})
                solid = ombre.fgrade(solid, [self._formula(keys, [value.get(id, 0.0) for value in values]) for id in ids], ids)
            elif isinstance(values[0], numbers.Real):
                solid = ombre.attribute(solid, name, self._formula(keys, values))
            else:
                parts = [self._formula(keys, [value[i] for value in values]) for i in range(len(values[0]))]
                solid = ombre.attribute(solid, name, parts, type="colour" if len(parts) == 4 else "vector")
        return solid

    def _apply_steps(self, solid: ombre.Solid, keys: list[str]) -> ombre.Solid:
        formulas = []
        for n, key in enumerate(keys):
            texts = [repr(float(entry.output_values[n])) if entry.is_valid else _unknown for entry in self._entries]
            formulas.append(_steps(key, [entry.input_ranges[n] for entry in self._entries], texts))
        if len(self._outputs) > 1:
            for name, formula in zip(self._outputs, formulas):
                solid = ombre.attribute(solid, name, formula)
            return solid
        return ombre.attribute(solid, self._outputs[0], formulas, type="colour" if len(formulas) == 4 else "vector")

    def _formula(self, keys: list[str], values: list[Any]) -> str:
        texts = [repr(float(value)) if entry.is_valid else _unknown for value, entry in zip(values, self._entries)]
        if self._mode is InterpolationMode.STEP:
            return _steps(keys[0], [entry.input_ranges[0] for entry in self._entries], texts)
        return self._in_lines(keys, texts)

    def _in_lines(self, keys: list[str], texts: list[str]) -> str:
        """The formula between the values of the first of the last keys and those of the next ones, from the texts of the
        entries in order."""
        values = self._keys[len(self._inputs) - len(keys)]
        size = len(texts) // len(values)
        rows = texts if size == 1 else [self._in_lines(keys[1:], texts[n:n + size]) for n in range(0, len(texts), size)]
        return _lines(keys[0], values, rows)

    def _materials(self) -> set[int] | None:
        found = {id for entry in self._entries for value in entry.output_values if isinstance(value, dict)
                 for id in value}
        return found or None


class AttributeModifier(Unary):
    """The child, with the attributes that a converter computes from the child's: AttributeModifier(converter, child)."""

    def __init__(self, converter: AttributeConverterBase, child: Any = None) -> None:
        if not isinstance(converter, AttributeConverterBase):
            raise TypeError(f"AttributeModifier: expected a converter, found {type(converter).__name__}")
        super().__init__(child)
        self._converter = converter

    def set_attribute(self, name: str, attribute: Any) -> None:
        raise RuntimeError("set_attribute: an AttributeModifier has the attributes that it computes; set it on another node")

    def get_attribute(self, name: str) -> Any:
        raise RuntimeError("get_attribute: an AttributeModifier has no attributes of its own")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return self._converter._apply(solids[0])

    def _computed(self) -> dict[str, list[str]]:
        return {name: self._converter.required_attributes() for name in self._converter.output_attributes()}

    def _fractions(self) -> set[int] | None:
        return self._converter._materials()
