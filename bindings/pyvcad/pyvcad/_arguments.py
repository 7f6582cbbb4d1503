"""Arguments of constructors, which have several forms: Sphere(center, radius) and Sphere(cx, cy, cz, radius)."""
from __future__ import annotations

import math
import numbers
from collections.abc import Callable
from typing import Any, NamedTuple

import ombre

from ._errors import WrongValue
from ._vectors import Vec3

Point = tuple[float, float, float]


class Optional(NamedTuple):
    """A parameter with a default."""

    read: Callable[[Any], Any]
    default: Any


Form = dict[str, Any]  # how each parameter is read: a function, or an Optional


def read(what: str, forms: tuple[Form, ...], positional: tuple[Any, ...], named: dict[str, Any]) -> dict[str, Any]:
    """The values of the first form that the arguments fit, by parameter.

    Raises TypeError where they fit none, ValueError for a wrong value.
    """
    fitting = [(form, given) for form in forms if (given := _by_name(form, positional, named)) is not None]
    best, reason = 0, ""
    for form, given in fitting:
        values: dict[str, Any] = {}
        try:
            _read_form(form, given, values)
        except TypeError as error:
            if len(values) > best or len(fitting) == 1:  # most likely the intended form
                best, reason = len(values), str(error)
        except ombre.DesignError:  # has the place of the mistake
            raise
        except ValueError as error:
            raise WrongValue(f"{what}, {error}") from None
        else:
            return values
    raise TypeError(f"{what}, {reason}" if reason else _no_form(what, forms, positional, named))


def _by_name(form: Form, positional: tuple[Any, ...], named: dict[str, Any]) -> dict[str, Any] | None:
    names = list(form)
    if len(positional) > len(names):
        return None
    given = dict(zip(names, positional))
    if any(name not in form or name in given for name in named):
        return None
    given.update(named)
    required = [name for name, kind in form.items() if not isinstance(kind, Optional)]
    return given if all(name in given for name in required) else None


def _read_form(form: Form, given: dict[str, Any], values: dict[str, Any]) -> None:
    for name, kind in form.items():
        reader = kind.read if isinstance(kind, Optional) else kind
        if name not in given:
            values[name] = kind.default
            continue
        try:
            values[name] = reader(given[name])
        except TypeError as error:
            raise TypeError(f"{name}: {error}") from None
        except ombre.DesignError:
            raise
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from None


def _no_form(what: str, forms: tuple[Form, ...], positional: tuple[Any, ...], named: dict[str, Any]) -> str:
    found = [type(value).__name__ for value in positional]
    found += [f"{name}={type(value).__name__}" for name, value in named.items()]
    choices = " or ".join(what + _form_text(form) for form in forms)
    return f"{what}({', '.join(found)}) is none of its forms; write {choices}"


def _form_text(form: Form) -> str:
    texts = [f"{name}={kind.default!r}" if isinstance(kind, Optional) else name for name, kind in form.items()]
    return f"({', '.join(texts)})"


def _expected(what: str, value: Any) -> TypeError:
    return TypeError(f"expected {what}, found {type(value).__name__}")


# Readers of values. TypeError: not of this kind. ValueError: of this kind, but wrong.


def number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise _expected("a number", value)
    if not math.isfinite(value):
        raise ValueError(f"expected a finite number, found {value}")
    return float(value)


def length(value: Any) -> float:
    size = number(value)
    if size <= 0:
        raise ValueError(f"expected a length above 0 (mm), found {size:g}")
    return size


def not_negative(value: Any, what: str = "0 or more") -> float:
    size = number(value)
    if size < 0:
        raise ValueError(f"expected {what}, found {size:g}")
    return size


def radius_of_blend(value: Any) -> float:
    return not_negative(value, "a radius of 0 or more (mm)")


def instance_of(*kinds: type[Any]) -> Callable[[Any], Any]:
    """The reader of values of these classes."""
    def read_instance(value: Any) -> Any:
        if not isinstance(value, kinds):
            raise _expected("a " + " or ".join(kind.__name__ for kind in kinds), value)
        return value
    return read_instance


def boolean(value: Any) -> bool:
    if not isinstance(value, bool) and type(value).__name__ not in ("bool_", "bool"):
        raise _expected("True or False", value)
    return bool(value)


def text(value: Any) -> str:
    if hasattr(value, "__fspath__"):
        value = value.__fspath__()
    if not isinstance(value, str):
        raise _expected("a text", value)
    return value


def material(value: Any) -> int:
    if isinstance(value, str):
        raise TypeError(f"expected a material's id, found the name {value!r}; write materials.id({value!r})")
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise _expected("a material's id", value)
    if value < 0:
        raise ValueError(f"expected a material's id, 0 or more, found {value}")
    return int(value)


def vector(value: Any) -> Point:
    if isinstance(value, str) or not isinstance(value, Vec3) and not hasattr(value, "__len__"):
        raise _expected("a Vec3", value)
    if len(value) != 3:
        raise TypeError(f"expected a Vec3, found {len(value)} numbers")
    x, y, z = value
    return number(x), number(y), number(z)


def size(value: Any) -> Point:
    x, y, z = vector(value)
    if not (x > 0 and y > 0 and z > 0):
        raise ValueError(f"expected lengths above 0 (mm), found ({x:g}, {y:g}, {z:g})")
    return x, y, z


def voxel_size(value: Any) -> Point:
    if isinstance(value, numbers.Real):
        v = length(value)
        return v, v, v
    return size(value)
