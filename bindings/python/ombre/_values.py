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
        self._outputs = dict(node.outputs)
        first, kind = node.outputs[0]
        name = f"{node.type}{next(_counts[node.type])}"
        super().__init__(name, "atom", {name: (node, first)} if kind == "number" else None)

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
        kind = self._outputs[name]
        if kind == "mixture":
            return self
        if kind == "number":
            return output(self._node, name)
        return Vector(*(output(self._node, f"{name}.{axis}") for axis in "xyz"))

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


def from_node(node):
    """The value that a node is."""
    value = object.__new__(Value)
    value._set(node)
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
