"""Values: nodes that give numbers, vectors and mixtures of materials, which solids take as parameters.

    >>> import ombre
    >>> t = ombre.noise(size=3)
    >>> bump = ombre.sphere(10 + 0.4*t, ombre.mix("white", "black", t))
"""
import collections
import itertools
import re

from ._expressions import Expression
from ._solid import make

Vector = collections.namedtuple("Vector", "x y z")
_number = ("numbers", "")
_counts = collections.defaultdict(lambda: itertools.count(1))


class Value(Expression):
    """The result of a node that is no solid; see the module's text. It stands for its first output, a number in most cases,
    and is then an expression; all its outputs are attributes.
    """

    __slots__ = ("_node", "_outputs")
    _info = None

    def __init__(self, *arguments, **named):
        if self._info is None:
            raise TypeError("a Value is made by its node: ombre.noise(size=3), ...")
        self._set(make(self._info["name"], self._info, arguments, named))

    def _set(self, node):
        self._node = node
        self._outputs = {name: (form, parts) for name, form, parts in node.outputs}
        first, kind = next(iter(self._outputs.items()))
        name = f"{node.type}{next(_counts[node.type])}"
        super().__init__(name, "atom", {name: (node, first)} if kind == _number else None)

    @property
    def _ombre_node_(self):
        return self._node

    def _text(self):
        if not self._ombre_values_:
            raise TypeError(f"{self._node.type} is not a number here; it gives {', '.join(self._outputs)}")
        return super()._text()

    def __getattr__(self, name):
        if name.startswith("_") or name not in self._outputs:
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")
        form, parts = self._outputs[name]
        if form == "constant":
            return self._node.constant(name)
        if form == "solid":
            from ._solid import _classes
            return _classes["solid_of"](_Output(self._node, name))
        if form == "mixture":
            return from_node(self._node, name)
        numbers = [output(self._node, f"{name}.{part}") for part in parts]
        return Vector(*numbers) if parts == "xyz" else tuple(numbers) or output(self._node, name)

    def __dir__(self):
        return sorted({*super().__dir__(), *self._outputs})

    def __repr__(self):
        return f"<{self._node.type}: {', '.join(self._outputs)}>"


def _new_name(node, name):
    return f"{node.type}_{name.replace('.', '_')}{next(_counts[node.type])}"


def output(node, name):
    """The expression of a number that a node gives: "value", "index.x"."""
    text = _new_name(node, name)
    return Expression(text, "atom", {text: (node, name)})


def from_parameter(formula, values):
    """The expression of a formula with values by their names, as nodes keep them."""
    if not formula:
        return output(*values["v"])
    names = {name: _new_name(*value) for name, value in values.items()}
    text = re.sub(r"[a-z_]\w*", lambda word: names.get(word[0], word[0]), formula)
    return Expression(text, "?", {names[name]: value for name, value in values.items()})


class _Output:
    """An output that is no number, as an argument."""

    def __init__(self, node, name):
        self._ombre_output_ = node, name


class _Mixture(Value, _Output):
    """A mixture that is not the first output of its node."""


def from_node(node, name=""):
    """The value of a node's first output, or of its output `name`, a mixture."""
    is_first = name in ("", node.outputs[0][0])
    value = object.__new__(Value if is_first else _Mixture)
    value._set(node)
    if not is_first:
        value._ombre_output_ = node, name
    return value


def read(text):
    """The value in a design that was made by `written`."""
    from ._design import Design
    parameters = Design.from_json(text)._core.parts[0][1].parameters
    return parameters.get("value", parameters.get("material"))


def written(value):
    """A design that holds the value, as JSON."""
    from ._solid import _classes, solid_for_values
    is_number = bool(value._ombre_values_)
    return (solid_for_values(value) if is_number else _classes["sphere"](1, value)).to_json()
