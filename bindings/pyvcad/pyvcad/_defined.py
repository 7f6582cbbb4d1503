"""Where in a tree an attribute is given: elsewhere designs have 0 for it, or the material 1, and scripts no sample."""
from __future__ import annotations

from typing import cast

import numpy

import ombre

from ._attributes import FloatAttribute
from ._tree import Node, in_order

FRACTIONS = "volume_fractions"


def marker(name: str) -> str:
    """The attribute that is 1 where the one of this name is given."""
    return f"defined_{name}"


def names_of(root: Node) -> list[str]:
    """The attributes of the tree, and those that its solids bring along."""
    return sorted({*root.attribute_list(), *(name for node in in_order(root) for name in node._own_attributes())})


def marked(root: Node) -> Node:
    """A copy of the tree with the markers of its attributes, and with that of fractions."""
    names = {*names_of(root), FRACTIONS}
    tree = root.clone()
    for node in in_order(tree):
        own, computed = {*node._attributes, *node._own_attributes()}, node._computed()
        node._mark_parts(marker, FloatAttribute(1))
        for name in names:
            if name in own:
                node._attributes[marker(name)] = FloatAttribute(1)
            elif name in computed:
                node._attributes[marker(name)] = _all_of([taken for taken in computed[name] if taken in names])
            elif name == FRACTIONS and node._says_material():
                node._attributes[marker(name)] = FloatAttribute(1)
    return tree


def _all_of(names: list[str]) -> FloatAttribute:
    """1 where all of these are given."""
    return FloatAttribute(ombre.Expression("*".join(map(marker, names))) if names else 1)


def are_everywhere(root: Node, names: list[str]) -> bool:
    """True if the root itself gives these attributes."""
    return all(name in root._attributes for name in names)


def marked_design(root: Node) -> ombre.Design:
    """The design of the marked tree, kept until the tree changes."""
    root._design()
    if root._marked is None or root._marked[0] is not root._solid:
        root._marked = root._solid, marked(root)._design()
    return cast("ombre.Design", root._marked[1])


def given(root: Node, name: str, points: numpy.ndarray) -> numpy.ndarray:
    """True at the points of the part where the tree gives the attribute."""
    if are_everywhere(root, [name]):
        return numpy.ones(points.shape[:-1], dtype=bool)
    design = marked_design(root)
    if marker(name) not in design.attributes:
        return numpy.zeros(points.shape[:-1], dtype=bool)
    return cast("numpy.ndarray", design.attribute(marker(name), points) > 0.5)
