"""Solids: nodes of a design, with queries and operations."""
import contextvars

import numpy

from . import _core
from ._functions import adapt
from ._materials import current_factory, setting
from ._volumes import is_array, stored

_classes = {}  # by the name of the node
_place = contextvars.ContextVar("ombre_place", default=None)


def made_at(place):
    """Within, solids count as made at this (file, line): for packages that make them for somebody else's script."""
    return setting(_place, place)


def wrap(node):
    """The solid that stands for a node."""
    solid = object.__new__(_classes.get(node.type, Solid))
    solid._node = node
    solid._design = solid._operands = None
    return solid


def _nodes(value):
    """The nodes of solids, one by one or in lists."""
    if isinstance(value, Solid):
        return [value._node]
    if hasattr(value, "_ombre_solid_"):
        return [value._ombre_solid_()._node]
    if isinstance(value, (list, tuple)):
        return [node for element in value for node in _nodes(element)]
    raise TypeError(f"expected a solid, found {type(value).__name__}")


def _is_solid(value):
    return isinstance(value, Solid) or hasattr(value, "_ombre_solid_")


def _is_solids(value):
    return _is_solid(value) or isinstance(value, (list, tuple)) and len(value) > 0 and all(map(_is_solids, value))


def _is_no_solids(value):
    return isinstance(value, (list, tuple)) and len(value) == 0


def _split(positional, most):
    """The nodes of the solids among the arguments, None for an empty list in the place of some, and what is no solid."""
    inputs, values = [], []
    for value in positional:
        if _is_solids(value):
            inputs += _nodes(value)
        elif _is_no_solids(value) and not values and (most is None or len(inputs) < most):
            inputs.append(None)
        else:
            values.append(value)
    return inputs, tuple(values)


def _as_value(argument):
    """A solid as it is given to values that are measured on it; anything else as it is."""
    return wrap(_nodes(argument)[0]) if _is_solid(argument) else argument


def _mixtures(argument):
    """The nodes among an argument that are mixtures of materials."""
    if isinstance(argument, (list, tuple)):
        return [node for element in argument for node in _mixtures(element)]
    node = getattr(argument, "_ombre_node_", None)
    return [node] if node and node.outputs and node.outputs[0][1] == "mixture" else []


def make(name, info, positional, named):
    """A node of the type `name`; solids among the positional arguments are its inputs. An empty list of solids is
    nothing."""
    least, most = info["inputs"]["least"], info["inputs"]["most"]
    takes_solids_as_values = most == 0 and any(p["kind"] == "solid" for p in info["parameters"])
    inputs, values = ([], positional) if takes_solids_as_values else _split(positional, most)
    values, named = tuple(map(_as_value, values)), {key: _as_value(value) for key, value in named.items()}
    if len(inputs) < least:
        raise TypeError(f"{name} needs {'a solid' if least == 1 else f'{least:.0f} solids'} to work on; "
                        f"write {name}(sphere(5), ...) or sphere(5).{name}(...)")
    if inputs and most == 0:
        raise TypeError(f"{name} takes no solids")
    if name in ("volume", "volume_solid") and values and is_array(values[0]):
        values, named = (stored(values[0], named.get("affine")), *values[1:]), {**named}
        named.pop("affine", None)
    mixtures = [node for argument in (*values, *named.values()) for node in _mixtures(argument)]
    mixtures += [value._node for value in (*values, *named.values()) if isinstance(value, Solid)]
    factory = next((node.factory for node in (*inputs, *mixtures) if node), None) or current_factory()
    if not all(node.names_materials_of(factory) for node in mixtures):
        raise ValueError(f"{name}: a mixture or a solid was made with other materials; give all of them the same")
    inputs = [node or factory.make("empty", (), {}, [], _place.get()) for node in inputs]
    child = wrap(inputs[0]) if inputs else None
    try:
        return factory.make(name, tuple(adapt(v, child) for v in values),
                            {key: adapt(v, child) for key, v in named.items()}, inputs, _place.get())
    except TypeError as error:
        raise error.with_traceback(None) from None


def _chained(name, left, right):
    """`a | b | c` is one union of three, however long the chain: nested ones would soon be too deep."""
    chain = left._operands if left._operands and left.type == name else [left._node]
    operands = [*chain, *_nodes(right)]
    solid = wrap(operands[0].factory.make(name, (), {}, operands, _place.get()))
    solid._operands = operands
    return solid


class Solid:
    """A solid whose material may vary: what every node gives. It never changes; operations give new ones.

    `a | b` is their union, `a & b` their intersection, `a - b` their difference, and `a + (x, y, z)` is `a` moved. A
    chain such as `a | b | c` is one union of three.
    Every operation is a method too: `sphere(10).translate(z=3)`.
    """

    __slots__ = ("_node", "_design", "_operands")
    _info = None

    def __init__(self, *arguments, **named):
        if self._info is None:
            raise TypeError("a Solid is made by its node: ombre.sphere(5), ombre.cube(10), ...")
        self._node = make(self._info["name"], self._info, arguments, named)
        self._design = self._operands = None

    @property
    def _ombre_node_(self):
        return self._node

    # Properties.

    @property
    def type(self):
        """The name of its node: "sphere"."""
        return self._node.type

    @property
    def parameters(self):
        """Parameters of the node, with defaults filled in; lengths are mm, angles degrees."""
        return self._node.parameters

    @property
    def inputs(self):
        """The solids that it is made from."""
        return [wrap(node) for node in self._node.inputs]

    @property
    def place(self):
        """(file, line) of the code that made it, or None."""
        return self._node.place

    @property
    def metric(self):
        """Meaning of the distance: "exact", "bounded" (never more than the true one) or "implicit" (the sign only)."""
        return self._node.metric

    def design(self):
        """The design of which this is the only part."""
        if self._design is None:
            from ._design import Design
            self._design = Design(self)
        return self._design

    def __repr__(self):
        shown = ", ".join(f"{key}={value!r}" for key, value in self.parameters.items()
                          if value != _defaults(type(self)).get(key))
        inputs = ", ".join(repr(i) for i in self.inputs[:3]) + (", ..." if len(self.inputs) > 3 else "")
        return f"{self.type}({', '.join(part for part in (inputs, shown) if part)})"

    def __eq__(self, other):
        if not isinstance(other, Solid):
            return NotImplemented
        return self._node.address == other._node.address or self.design().hash == other.design().hash

    def __hash__(self):
        return hash(self.design().hash)

    def __reduce__(self):
        return _unpickle, (self.design().to_json(),)

    # Operators.

    def __or__(self, other):
        return _chained("union", self, other) if _is_solid(other) else NotImplemented

    def __and__(self, other):
        return _chained("intersection", self, other) if _is_solid(other) else NotImplemented

    def __sub__(self, other):
        if _is_solid(other):
            return _chained("difference", self, other)
        return self.translate(-numpy.asarray(other, dtype=float)) if _is_vector(other) else NotImplemented

    def __add__(self, other):
        if _is_solid(other):
            return _chained("union", self, other)
        return self.translate(numpy.asarray(other, dtype=float)) if _is_vector(other) else NotImplemented

    def __invert__(self):
        return _classes["negate"](self)

    def grade(self, fractions, mode="prob"):
        """Sets the composition by formulas, one for each material.

        Args:
            fractions: {material: number, expression, string or function}; d is the distance to this solid's surface.
            mode: "prob", the values are shares of a mixture; "thresh", the greatest value takes all.

        >>> from ombre import cube, x
        >>> bar = cube(10).grade({"red": 0.5 + x/10, "blue": 0.5 - x/10})
        >>> bar.material([[-5, 0, 0], [0, 0, 0]])["blue"]
        array([1. , 0.5])
        """
        return _classes["fgrade"](self, list(fractions.values()), list(fractions), mode=mode)

    def with_material(self, *arguments, **named):
        """ombre.material, as a method: sets the composition, one material or a mixture.

        >>> import ombre
        >>> float(ombre.sphere(5).with_material(["red", "blue"], [3, 1]).material([0, 0, 0])["red"])
        0.75
        """
        return _classes["material"](self, *arguments, **named)

    def with_attribute(self, *arguments, **named):
        """ombre.attribute, as a method: gives a named value, constant or by a formula.

        >>> import ombre
        >>> float(ombre.sphere(5).with_attribute("infill", "0.2 + z/10").attribute("infill", [0, 0, 3]))
        0.5
        """
        return _classes["attribute"](self, *arguments, **named)

    # Queries; see Design.

    def __getattr__(self, name):
        from ._design import Design
        if name.startswith("_"):
            raise AttributeError(name)
        if self._node.has_constant(name):
            return self._node.constant(name)
        if self._node.has_output(name):
            made = _classes["output_of"](self, name)
            return getattr(made, made._node.outputs[0][0])
        if not hasattr(Design, name):
            raise AttributeError(_no_attribute(self, name))
        return getattr(self.design(), name)

    def __dir__(self):
        from ._design import Design
        return sorted(set(super().__dir__()) | {n for n in dir(Design) if not n.startswith("_")})

    def _repr_png_(self):
        return self.design()._repr_png_()

    def _repr_html_(self):
        return self.design()._repr_html_()


def _no_attribute(solid, name):
    import difflib
    close = difflib.get_close_matches(name, dir(solid), 1)
    return f"a solid has no attribute {name!r}" + (f"; did you mean {close[0]!r}?" if close else "")


def _is_vector(value):
    return not isinstance(value, str) and numpy.shape(value) == (3,)


def _defaults(cls):
    return {p["name"]: p["default"] for p in cls._info["parameters"]} if cls._info else {}


def _unpickle(text):
    from ._design import Design
    return wrap(Design.from_json(text)._core.parts[0][1])


def solid_for_values(expression):
    """A solid with an attribute "value"; it is defined everywhere."""
    return _classes["attribute"](_classes["cube"](1), "value", expression)


def _doc(info):
    lines = [info["sentence"], "", "Args:"]
    most = info["inputs"]["most"]
    if info["inputs"]["least"]:
        lines.append("    solids: what it works on, one or several (several are joined where it takes one)"
                     if most is None else "    solid: what it works on" if most == 1 else
                     f"    solids: the {most:.0f} that it works on, in their order")
    for p in info["parameters"]:
        unit = f" ({p['unit']})" if p["unit"] else ""
        choices = f" One of {', '.join(p['choices'])}." if p["choices"] else ""
        default = "" if p["required"] else f" Default: {p['default']!r}."
        lines.append(f"    {p['name']}: {p['doc']}{unit}. {p['kind'].capitalize()}.{choices}{default}")
    if info["outputs"]:
        lines += ["", "Attributes:"] + [f"    {o['name']}: {o['doc']}. {o['type'].capitalize()}." for o in info["outputs"]]
    lines += ["", "As a .vcad script has it:", "", f"    {info['example']}"]
    return "\n".join(lines)


def node_infos():
    """Descriptions of all nodes, from the registry."""
    events = []
    _core.run_job("nodes", {}, None, events.append)
    return [e for e in events if e["event"] == "node"]


def node_classes(value_class):
    """A class for every node of the registry, and a method of Solid for those that work on one."""
    from ._design import Design
    for info in node_infos():
        name = info["name"]
        base = Solid if info["gives"] == "solid" else value_class
        _classes[name] = type(name, (base,), {"__slots__": (), "_info": info, "__doc__": _doc(info),
                                              "__module__": "ombre"})
        if info["inputs"]["least"] and not hasattr(Solid, name) and not hasattr(Design, name):
            setattr(Solid, name, _method(name, info))
    return dict(_classes)


def _method(name, info):
    def method(self, *arguments, **named):
        return _classes[name](self, *arguments, **named)
    method.__name__, method.__qualname__, method.__doc__ = name, f"Solid.{name}", _doc(info)
    return method
