"""Trees as text for Mermaid."""
from __future__ import annotations

from ._tree import Node, in_order


def diagram(root: Node) -> str:
    """A flow chart of Mermaid: a box for each node with its attributes, and an arrow to each child."""
    numbers: dict[int, int] = {}
    lines = ["flowchart TD"]
    for node in in_order(root):
        number = numbers[id(node)] = len(numbers)
        names = sorted(node._attributes)
        label = node.type() + "".join(f"<br/>{name.replace(chr(34), chr(39))}" for name in names)
        lines.append(f'    n{number}["{label}"]')
        lines += [f"    n{number} --> n{numbers[id(child)]}" for child in node._inputs()]
    return "\n".join(lines) + "\n"


def _to_diagram(node: Node) -> str:
    return diagram(node)


# It is set here instead of in the class, whose module the walk over trees is in.
setattr(Node, "to_diagram", _to_diagram)
