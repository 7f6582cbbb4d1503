"""Python functions in place of expressions: called with the numbers of one point at a time."""
from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

import ombre

_names = ("x", "y", "z", "rho", "phic", "r", "theta", "phis", "d")


def expression(value: Any, is_checked: bool = True) -> Any:
    """A string, a number or a callable, which comes back as Ombre takes it; raises TypeError for anything else.

    A text that is no formula of coordinates is an error, unless it is not checked.
    """
    if isinstance(value, str):
        if is_checked:
            _check_formula(value)
        return value
    if hasattr(value, "_ombre_text_"):
        return value
    if callable(value):
        return pointwise(value)
    if isinstance(value, (int, float)) or hasattr(value, "__float__"):
        return float(value)
    raise TypeError(f"expected an expression (a text), a number or a function of (x, y, z, rho, phic, r, theta, phis), "
                    f"found {type(value).__name__}")


def _check_formula(text: str) -> None:
    """Raises DesignError for a text that is no formula, on the line of the script that writes it."""
    from ._tree import _call_place
    try:
        ombre.attribute(ombre.cube(1), "value", text)
    except ombre.DesignError as error:
        diagnostics = getattr(error, "diagnostics", [])
        reasons = "; ".join(d["message"] + (f"; {d['hint']}" if d.get("hint") else "") for d in diagnostics)
        file, line = _call_place()
        raise ombre.DesignError(f"{file}:{line}: the formula {text!r} is wrong: {reasons or error}") from None


def pointwise(function: Callable[..., float]) -> Callable[..., Any]:
    """A function of arrays that asks `function` point by point.

    Its parameters go by position, whatever their names are: three are (x, y, z), eight all coordinates, nine these
    and d. With another count they go by name.
    """
    wanted = _parameters(function)
    many = ombre.pointwise(_named(function, wanted))
    many.__name__ = getattr(function, "__name__", type(function).__name__)
    return many


def _parameters(function: Callable[..., float]) -> tuple[str, ...]:
    try:
        parameters = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):  # some compiled functions have no signature
        return _names[:8]
    if any(p.kind is p.VAR_POSITIONAL for p in parameters):
        return _names[:8]
    names = tuple(p.name for p in parameters if p.default is p.empty and p.kind is not p.VAR_KEYWORD)
    if all(name in _names for name in names):
        return names
    if len(names) in (3, 8, 9):
        return _names[:len(names)]
    unknown = next(name for name in names if name not in _names)
    raise TypeError(f"{getattr(function, '__name__', 'the function')} has {len(names)} parameters, among them "
                    f"{unknown!r}; write (x, y, z) or ({', '.join(_names[:8])}), and d behind it in FGrade")


def _named(function: Callable[..., float], names: tuple[str, ...]) -> Callable[..., float]:
    """The function, which says that its parameters have these names."""
    def call(*values: float) -> float:
        return function(*values)
    call.__name__ = getattr(function, "__name__", type(function).__name__)
    call.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD) for name in names])
    return call
