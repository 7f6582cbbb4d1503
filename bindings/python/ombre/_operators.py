"""Operators of libraries, by the names of their files.

`ombre.operators.cellular.honeycomb_walls(size=8)` calls what a script calls after `use <ombre/cellular.vcad>`. Modules give
solids, and take solids as their children; functions give values.
"""
import inspect
import keyword

from . import _core
from ._functions import adapt
from ._materials import current_factory
from ._solid import Solid, _as_value, _is_solids, _nodes


def _factory_of(children, arguments):
    used = [node for child in children for node in _nodes(child)]
    used += [argument._ombre_node_ for argument in arguments if getattr(argument, "_ombre_node_", None) is not None]
    return next((node.factory for node in used), None) or current_factory()


def _signature(info):
    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    return inspect.Signature([inspect.Parameter(p["name"], kind, default=p["default"])
                              for p in info["parameters"] if not keyword.iskeyword(p["name"])])


def _doc(info):
    lines = [info["sentence"], "", f"use <{info['library']}>", ""]
    if info["parameters"]:
        lines.append("Args:")
    for parameter in info["parameters"]:
        unit = f", {parameter['unit']}" if parameter["unit"] else ""
        given = "required" if parameter["required"] else f"default {parameter['written_default']}"
        lines.append(f"    {parameter['name']}: {parameter['doc']} ({parameter['kind']}{unit}; {given})")
    if info["source"]:
        lines += ["", f"Source: {info['source']}"]
    return "\n".join(lines) + "\n"


def _function(info):
    is_module = info["gives"] == "solid"

    def call(*positional, **named):
        children = [value for value in positional if _is_solids(value)] if is_module else []
        values = [_as_value(value) for value in positional if not any(value is child for child in children)]
        named = {name: _as_value(value) for name, value in named.items()}
        factory = _factory_of(children, [*values, *named.values()])
        return factory.call(info["library"], info["name"], is_module, tuple(adapt(v, None) for v in values),
                            {name: adapt(v, None) for name, v in named.items()},
                            [node for child in children for node in _nodes(child)])

    call.__name__ = call.__qualname__ = info["name"]
    call.__doc__ = _doc(info)
    call.__signature__ = _signature(info)
    return call


class Library:
    """The operators of one file, or the files of one folder."""

    def __init__(self, name):
        self._name, self._members = name, {}

    def __getattr__(self, name):
        members = self.__dict__.get("_members", {})
        if name not in members:
            raise AttributeError(f"{self._name} has no {name!r}; it has {', '.join(sorted(members)) or 'nothing'}")
        return members[name]

    def __dir__(self):
        return sorted(self._members)

    def __repr__(self):
        return f"<{self._name}: {', '.join(sorted(self._members))}>"


class Operators(Library):
    """All libraries, which are read when one of them is first asked for."""

    def __getattr__(self, name):
        self._read()
        return super().__getattr__(name)

    def __dir__(self):
        self._read()
        return super().__dir__()

    def _read(self):
        if self._members:
            return
        for info in _core.operators():
            at, path = self, info["library"].removesuffix(".vcad").removeprefix("ombre/").split("/")
            for part in path:
                at = at._members.setdefault(part, Library(f"{at._name}.{part}"))
            at._members[info["name"]] = _function(info)


operators = Operators("ombre.operators")
