"""Where in a tree an attribute is given: elsewhere designs have 0 for it, and scripts no sample."""
from __future__ import annotations

import ombre

from ._attributes import FloatAttribute
from ._tree import Node, in_order

FRACTIONS = "volume_fractions"


def marker(name: str) -> str:
    """The attribute that is 1 where the one of this name is given."""
    return f"defined_{name}"


def marked(root: Node, names: list[str]) -> Node:
    """A copy of the tree with the markers of these attributes."""
    tree = root.clone()
    for node in in_order(tree):
        computed = node._computed()
        node._mark_parts(marker, FloatAttribute(1))
        for name in names:
            if name in node._attributes:
                node._attributes[marker(name)] = FloatAttribute(1)
            elif name in computed:
                node._attributes[marker(name)] = _all_of(computed[name])
            elif name == FRACTIONS and node._fractions() is not None:
                node._attributes[marker(name)] = FloatAttribute(1)
    return tree


def _all_of(names: list[str]) -> FloatAttribute:
    """1 where all of these are given."""
    return FloatAttribute(ombre.Expression("*".join(map(marker, names))) if names else 1)


def are_everywhere(root: Node, names: list[str]) -> bool:
    """True if the root itself gives these attributes."""
    return all(name in root._attributes for name in names)
