"""Conversions between attributes, and the shortest paths along them."""
from __future__ import annotations

import dataclasses
from typing import Any, Callable, Iterable

from pyvcad import AttributeConverterBase, AttributeModifier, Node


class ResolverError(Exception):
    """The attributes of a design do not lead to those that are wanted."""


class NoPathError(ResolverError):
    """No conversions lead to an attribute."""


class AmbiguousPathError(ResolverError):
    """Several paths to an attribute are equally short, and have the same priority."""

    def __init__(self, message: str, paths: list[list[str]] | None = None) -> None:
        super().__init__(message)
        self.paths = paths or []


class OneToOne(AttributeConverterBase):
    """Makes an attribute of another one."""

    def __init__(self, source: str, target: str) -> None:
        self._source, self._target = source, target

    def required_attributes(self) -> list[str]:
        return [self._source]

    def output_attributes(self) -> list[str]:
        return [self._target]


@dataclasses.dataclass(frozen=True)
class ConversionEntry:
    """A conversion that is registered."""
    source: str
    target: str
    converter_factory: Callable[[], AttributeConverterBase]
    name: str
    priority: int = 0
    tags: frozenset[str] = frozenset()
    required_inputs: tuple[str, ...] = ()


_conversions: dict[str, ConversionEntry] = {}


def register_conversion(source: str, target: str, converter_factory: Callable[[], AttributeConverterBase],
                        name: str | None = None, priority: int = 0, tags: Iterable[str] | None = None,
                        required_inputs: Iterable[str] | None = None) -> str:
    """Registers a conversion, in place of one with the same name; returns its name.

    Args:
        converter_factory: returns a new converter at each call.
        name: `source_to_target` if it is left out.
        priority: the greater one decides between equally short paths.
        required_inputs: all attributes that the converter reads; the source alone if it is left out.
    """
    if not callable(converter_factory):
        raise TypeError(f"register_conversion: expected a function that returns a converter, found {converter_factory!r}")
    known_as = name or f"{source}_to_{target}"
    _conversions[known_as] = ConversionEntry(source, target, converter_factory, known_as, priority, frozenset(tags or ()),
                                             tuple(required_inputs or (source,)))
    return known_as


def unregister_conversion(name: str) -> None:
    if name not in _conversions:
        raise KeyError(f"unregister_conversion: there is no conversion {name!r}; there are {', '.join(_conversions) or 'none'}")
    del _conversions[name]


def list_conversions() -> list[ConversionEntry]:
    return list(_conversions.values())


def clear_conversions() -> None:
    _conversions.clear()


def list_modules() -> list[str]:
    """The tags of the conversions that are registered."""
    return sorted({tag for entry in _conversions.values() for tag in entry.tags})


def _steps_to(target: str, given: set[str], entries: list[ConversionEntry], max_depth: int) -> list[ConversionEntry]:
    """The conversions of the shortest path to an attribute, in the order in which they are applied."""
    known, found = set(given), {}
    for _ in range(max_depth):
        new: dict[str, list[ConversionEntry]] = {}
        for entry in entries:
            if entry.target not in known and known.issuperset(entry.required_inputs):
                new.setdefault(entry.target, []).append(entry)
        if not new or target in known:
            break
        found.update(new)
        known |= new.keys()
    if target not in known:
        raise NoPathError(f"no conversions lead to {target!r} from {', '.join(sorted(given)) or 'no attributes'}; "
                          f"{_sources_of(target, entries)}")
    return _path(target, given, found)


def _sources_of(target: str, entries: list[ConversionEntry]) -> str:
    sources = [f"{' and '.join(entry.required_inputs)} ({entry.name})" for entry in entries if entry.target == target]
    return f"it could come from {' or '.join(sources)}" if sources else "register_conversion adds some"


def _path(target: str, given: set[str], found: dict[str, list[ConversionEntry]]) -> list[ConversionEntry]:
    if target in given:
        return []
    best = max(entry.priority for entry in found[target])
    entries = [entry for entry in found[target] if entry.priority == best]
    paths = []
    for entry in entries:
        path: list[ConversionEntry] = []
        for needed in entry.required_inputs:
            path += [step for step in _path(needed, given, found) if step not in path]
        paths.append([*path, entry])
    if len(paths) > 1:
        names = [[step.name for step in path] for path in paths]
        raise AmbiguousPathError(f"several paths lead to {target!r}: {'; '.join(', '.join(path) for path in names)}; give one "
                                 "a greater priority, or name those that are allowed", names)
    return paths[0]


def adapt(design: Node, target_attributes: Iterable[str], allowed_conversions: Iterable[str] | None = None,
          tags: Iterable[str] | None = None, max_depth: int = 10) -> Node:
    """The design with these attributes, computed by the shortest paths of conversions from those that it has.

    Args:
        allowed_conversions: names of the conversions to choose from; all if it is left out.
        tags: only conversions with one of these tags are used; all if it is left out.
    """
    if isinstance(target_attributes, str):
        raise TypeError("adapt: expected a list of names of attributes")
    allowed = None if allowed_conversions is None else set(allowed_conversions)
    if allowed is not None and (unknown := allowed - _conversions.keys()):
        raise KeyError(f"adapt: there is no conversion {', '.join(map(repr, sorted(unknown)))}")
    wanted_tags = None if tags is None else set(tags)
    entries = [entry for entry in _conversions.values() if (allowed is None or entry.name in allowed)
               and (wanted_tags is None or wanted_tags & entry.tags)]
    for target in target_attributes:
        given: set[str] = set(design.attribute_list())
        if target in given:
            continue
        for step in _steps_to(target, given, entries, max_depth):
            design = AttributeModifier(_made_by(step), design)
    return design


def _made_by(entry: ConversionEntry) -> Any:
    converter = entry.converter_factory()
    if not isinstance(converter, AttributeConverterBase):
        raise TypeError(f"the conversion {entry.name!r} made {converter!r}, which is no converter")
    return converter
