"""Expressions: formulas over space, built with Python's operators.

    >>> from ombre import x, rho, sin
    >>> 0.5 + x / 20
    Expression("0.5 + x/20")
    >>> sin(2 * rho) ** 2
    Expression("sin(2*rho)^2")

An expression goes wherever a string with the same text goes, and means the same.
"""
import math
import numbers

from . import _core

_level = {"?": 0, "or": 1, "and": 2, "compare": 3, "add": 4, "multiply": 5, "sign": 6, "power": 7, "atom": 8}


def _number_text(value):
    value = float(value)
    if math.isnan(value) or math.isinf(value):
        raise ValueError(f"an expression cannot hold {value}")
    return repr(int(value)) if value == int(value) and abs(value) < 2**53 else repr(value)


def _as_expression(value):
    if isinstance(value, Expression):
        return value
    if isinstance(value, numbers.Real) or hasattr(value, "__float__") and getattr(value, "ndim", 0) == 0:
        number = float(value)
        return Expression(_number_text(number), "sign" if number < 0 else "atom")
    if isinstance(value, str):
        return Expression(value)
    return None


def _binary(operator, level, reverse=False):
    def method(self, other):
        other = _as_expression(other)
        if other is None:
            return NotImplemented
        a, b = (other, self) if reverse else (self, other)
        # An operand to the right of an operator of the same level needs brackets.
        left = a._within(level + ("!" if level in ("power", "compare") else ""))
        return Expression(left + operator + b._within(level + "!"), level, {**a._ombre_values_, **b._ombre_values_})
    return method


class Expression:
    """A formula over space; see the module's text.

    Args:
        text: the formula, as strings have it: "0.5 + x/20".
    """

    # _ombre_values_: outputs of nodes, by the names that the text has for them.
    __slots__ = ("_ombre_text_", "_ombre_values_", "_at")
    __hash__ = object.__hash__

    def __init__(self, text, _level_name="?", _values=None):
        self._ombre_text_ = str(text)
        self._ombre_values_ = _values or {}
        self._at = _level[_level_name]

    def _text(self):
        return self._ombre_text_

    def _within(self, level):
        strict = level.endswith("!")
        least = _level[level.rstrip("!")] + (1 if strict else 0)
        return self._text() if self._at >= least else f"({self._text()})"

    __add__, __radd__ = _binary(" + ", "add"), _binary(" + ", "add", True)
    __sub__, __rsub__ = _binary(" - ", "add"), _binary(" - ", "add", True)
    __mul__, __rmul__ = _binary("*", "multiply"), _binary("*", "multiply", True)
    __truediv__, __rtruediv__ = _binary("/", "multiply"), _binary("/", "multiply", True)
    __mod__, __rmod__ = _binary("%", "multiply"), _binary("%", "multiply", True)
    __pow__, __rpow__ = _binary("^", "power"), _binary("^", "power", True)
    __lt__, __le__ = _binary(" < ", "compare"), _binary(" <= ", "compare")
    __gt__, __ge__ = _binary(" > ", "compare"), _binary(" >= ", "compare")
    __eq__, __ne__ = _binary(" == ", "compare"), _binary(" != ", "compare")
    __and__, __rand__ = _binary(" and ", "and"), _binary(" and ", "and", True)
    __or__, __ror__ = _binary(" or ", "or"), _binary(" or ", "or", True)

    def __neg__(self):
        return Expression("-" + self._within("power"), "sign", self._ombre_values_)

    def __pos__(self):
        return self

    def __abs__(self):
        return _call("abs", self)

    def __invert__(self):
        return Expression("not " + self._within("power"), "sign", self._ombre_values_)

    def __bool__(self):
        raise TypeError("an expression is neither true nor false: its value varies in space. "
                        "Write where(condition, a, b), and & | ~ in place of and, or, not")

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        name = _ufuncs.get(ufunc.__name__)
        if name is None or method != "__call__" or options:
            return NotImplemented
        return name(*inputs)

    def __str__(self):
        return self._text()

    def __repr__(self):
        return f'Expression("{self._ombre_text_}")'

    def __reduce__(self):
        from . import _values
        if self._ombre_values_ or isinstance(self, _values.Value):
            return _values.read, (_values.written(self),)
        return Expression, (self._ombre_text_,)

    def __call__(self, points):
        """Values at points of the shape (..., 3), mm, in double precision.

        >>> from ombre import x, y
        >>> (x + 2*y)([[1, 2, 3], [0, 1, 0]])
        array([5., 2.])
        """
        from ._solid import solid_for_values
        return solid_for_values(self).attribute("value", points)


def _call(name, *arguments):
    texts, values = [], {}
    for argument in arguments:
        expression = _as_expression(argument)
        if expression is None:
            raise TypeError(f"{name} takes numbers and expressions, not {type(argument).__name__}")
        texts.append(str(expression))
        values.update(expression._ombre_values_)
    return Expression(f"{name}({', '.join(texts)})", "atom", values)


def _function(name, arguments, meaning):
    def function(*values):
        return _call(name, *values)
    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"{name}({arguments}): {meaning}"
    return function


def where(condition, yes, no):
    """`yes` where the condition holds, `no` elsewhere.

    >>> from ombre import x, where
    >>> where(x < 0, 0, 1)
    Expression("if(x < 0, 0, 1)")
    """
    return _call("if", condition, yes, no)


functions = {name: _function(name, arguments, meaning) for name, arguments, meaning in _core.functions()}
coordinates = {name: Expression(name, "atom") for name in _core.coordinates()}
d = Expression("d", "atom")
t = Expression("t", "atom")

_ufuncs = {name: functions[name] for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "log10", "log2",
                                              "sqrt", "hypot", "floor", "ceil", "trunc") if name in functions}
_ufuncs.update({"absolute": functions["abs"], "fabs": functions["abs"], "arcsin": functions["asin"],
                "arccos": functions["acos"], "arctan": functions["atan"], "arctan2": functions["atan2"],
                "minimum": functions["min"], "maximum": functions["max"], "sign": functions["sgn"],
                "power": lambda a, b: _as_expression(a) ** b, "add": lambda a, b: _as_expression(a) + b,
                "subtract": lambda a, b: _as_expression(a) - b, "multiply": lambda a, b: _as_expression(a) * b,
                "divide": lambda a, b: _as_expression(a) / b, "negative": lambda a: -_as_expression(a)})
