"""Nodes that work on others: transforms, booleans, materials."""
from __future__ import annotations

from typing import Any, Literal

import ombre
from ombre._materials import current_factory

from ._arguments import Optional, Point, boolean, length, material, number, radius_of_blend, read, vector
from ._errors import WrongValue
from ._functions import expression
from ._resolvers import given
from ._tree import Binary, NAry, Node, Unary, as_node, as_nodes


class Translate(Unary):
    """Moves its child: Translate(x, y, z, child), mm."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        values = read("Translate", _moves, arguments, named)
        super().__init__(values.get("child"))
        self._by: Point = tuple(values.get(axis, 0.0) for axis in "xyz")  # type: ignore[assignment]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.translate(solids[0], self._by)


class Scale(Unary):
    """Stretches its child, away from the origin: Scale(x, y, z, child), Scale(k, child)."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        values = read("Scale", (*_moves, {"k": number, **_child}), arguments, named)
        super().__init__(values.get("child"))
        self._by: Point = tuple(values.get(axis, values.get("k", 1.0)) for axis in "xyz")  # type: ignore[assignment]
        if values.get("k", 1.0) <= 0:
            raise WrongValue(f"Scale: expected a factor above 0, found {values['k']:g}; Mirror gives mirror images")
        if 0 in self._by:
            raise WrongValue(f"Scale: expected factors other than 0, found {self._by}")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.scale(solids[0], self._by)


class Rotate(Unary):
    """Turns its child, right-handed, in degrees: Rotate(pitch, yaw, roll, around, child).

    About fixed axes: z by roll, then y by yaw, then x by pitch. The point `around` stays where it is; without it, as in
    pyvcad 3, the middle of the child's bounding box.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        around = Optional(vector, None)
        form = {"pitch": number, "yaw": number, "roll": number, "around": around, "child": Optional(as_node, None)}
        angles = {"pitch": number, "yaw": number, "roll": number}
        values = read("Rotate", ({}, form, {**angles, "child": as_node}, {"angles": vector, **_child}), arguments, named)
        super().__init__(values.get("child"))
        self._angles = values.get("angles") or tuple(values.get(angle, 0.0) for angle in angles)
        self._around: Point | None = values.get("around")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        around = self._around
        if around is None and solids[0].type != "empty":
            low, high = solids[0].bounds
            around = tuple((a + b) / 2 for a, b in zip(low, high))  # type: ignore[assignment]
        return ombre.rotate(solids[0], self._angles, around=around or (0.0, 0.0, 0.0))


class Mirror(Unary):
    """The mirror image of its child: Mirror("x", child), Mirror("x", offset, child), Mirror(point, normal, child)."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        axis = {"axis": _axis}
        values = read("Mirror", ({**axis, "child": as_node}, {**axis, "offset": number, "child": as_node},
                                 {"point": vector, "normal": vector, "child": as_node}), arguments, named)
        super().__init__(values["child"])
        self._normal: Point = values.get("axis") or values["normal"]
        if self._normal == (0, 0, 0):
            raise ValueError("Mirror, normal: expected a direction, found (0, 0, 0)")
        offset = values.get("offset", 0.0)
        self._point: Point = values.get("point") or tuple(offset * n for n in self._normal)  # type: ignore[assignment]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        length_2 = sum(n * n for n in self._normal)
        twice = 2 * sum(n * p for n, p in zip(self._normal, self._point)) / length_2
        return ombre.translate(ombre.mirror(solids[0], self._normal), tuple(twice * n for n in self._normal))


class Identity(Unary):
    """The child, unchanged: a place for attributes."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(read("Identity", (_child,), arguments, named)["child"])

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return solids[0]


def _resolved(node: NAry, whole: ombre.Solid, solids: list[ombre.Solid]) -> ombre.Solid:
    """The solid with the attributes for which a resolver is given that Ombre has no word for."""
    for name, resolver in node._rules.items():
        own = [solid for child, solid in zip(node._inputs(), solids) if name in child.attribute_list()]
        if not resolver._rule and own:
            whole = given(whole, name, resolver, own)
    return whole


def _completed(node: NAry, solids: list[ombre.Solid], rule: Literal["first", "mix"]) -> list[ombre.Solid]:
    """The solids. If some have fractions, those of which nothing says a material have the one of the others where they meet."""
    children = node._inputs()
    if not any(child._has_fractions for child in children) or all(child._has_material for child in children):
        return solids
    others = ombre.union([solid for child, solid in zip(children, solids) if child._has_material], materials=rule)
    is_there = ombre.distance_to(others).inside > 0.5
    ids = sorted({id for child in children for id in child.material_list()})
    names = ombre.Materials(_factory=current_factory()).names
    theirs = [ombre.composition_of(others, names[id]).share for id in ids]

    def completed(child: Node, solid: ombre.Solid) -> ombre.Solid:
        own = child.material_list()  # the one that stands for none
        return ombre.fgrade(solid, [ombre.where(is_there, share, float(id in own)) for id, share in zip(ids, theirs)], ids)
    return [solid if child._has_material else completed(child, solid) for child, solid in zip(children, solids)]


class _Boolean(NAry):
    """Forms: (), (mix), (mix, children), (k), (k, mix), (k, mix, children), (k, children), (children), (a, b, ...).

    Where children overlap, mix=False takes the composition of the first that is there, mix=True all in equal parts.
    The radius k (mm) rounds the seams.
    """

    _operation = ""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        values = read(type(self).__name__, _boolean_forms, _with_list(arguments), named)
        super().__init__(values.get("children"))
        self._mix: bool = values.get("mix", False)
        self._blend: float = values.get("k", 0.0)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        rule: Literal["first", "mix"] = "mix" if self._mix or self._mixes() else "first"
        whole: ombre.Solid = getattr(ombre, self._operation)(_completed(self, solids, rule), materials=rule, blend=self._blend,
                                                             attributes=self._attribute_rules())
        return _resolved(self, whole, solids)


class Union(_Boolean):
    """Points in any child: Union(mix=False, children=[...])."""

    _operation = "union"


class Intersection(_Boolean):
    """Points in all children: Intersection(mix=False, children=[...])."""

    _operation = "intersection"


class BBoxUnion(NAry):
    """A union, of which the first child wins: BBoxUnion(children). Every union has an index in space."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        children = Optional(as_nodes, None)
        values = read("BBoxUnion", ({"children": children}, {"k": radius_of_blend, "children": children}),
                      _with_list(arguments), named)
        super().__init__(values["children"])
        self._blend: float = values.get("k", 0.0)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        rule: Literal["first", "mix"] = "mix" if self._mixes() else "first"
        whole: ombre.Solid = ombre.union(_completed(self, solids, rule), materials=rule, blend=self._blend,
                                         attributes=self._attribute_rules())
        return _resolved(self, whole, solids)


class BBoxIntersection(NAry):
    """An intersection, of which the first child wins: BBoxIntersection(children)."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        values = read("BBoxIntersection", ({"children": Optional(as_nodes, None)},), _with_list(arguments), named)
        super().__init__(values["children"])

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        rule: Literal["first", "mix"] = "mix" if self._mixes() else "first"
        whole: ombre.Solid = ombre.intersection(_completed(self, solids, rule), materials=rule,
                                                attributes=self._attribute_rules())
        return _resolved(self, whole, solids)


class Difference(Binary):
    """Points in the left child and not in the right one: Difference(left, right). With more children, the first without
    the rest."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        sides = {"left": as_node, "right": as_node}
        k = {"k": radius_of_blend}
        some = {"children": as_nodes}
        if len(arguments) > 2 or any(isinstance(a, (list, tuple)) for a in arguments):
            arguments = _with_list(arguments)
        values = read("Difference", ({}, sides, k, {**k, **sides}, some, {**k, **some}), arguments, named)
        left, right = values.get("left"), values.get("right")
        if "children" in values:
            if not values["children"]:
                raise ValueError("Difference, children: expected at least one node, since the first is what is left")
            left, right = values["children"][0], _joined(values["children"][1:])
        super().__init__(left, right)
        self._blend: float = values.get("k", 0.0)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.difference(solids, blend=self._blend)

    def _composing(self) -> list[Node]:
        return self._inputs()[:1]


class Sum(NAry):
    """Points where the distances of the children add up to `iso` mm or less: Sum(iso=0, children=[...])."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        some = {"children": Optional(as_nodes, None)}
        values = read("Sum", ({"iso": Optional(number, 0.0), **some}, {**some, "iso": Optional(number, 0.0)}),
                      _with_list(arguments), named)
        super().__init__(values["children"])
        self._iso: float = values["iso"]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.sum(solids, iso=self._iso)


class Offset(Unary):
    """The child, grown by a distance, or shrunk by a negative one: Offset(d, child), mm."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        values = read("Offset", ({"distance": number, **_child},), arguments, named)
        super().__init__(values["child"])
        self._distance: float = values["distance"]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.offset(solids[0], self._distance)


class Shell(Unary):
    """A wall along its child's surface, inward: Shell(thickness, child), mm."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        values = read("Shell", ({"thickness": length, **_child},), arguments, named)
        super().__init__(values["child"])
        self._thickness: float = values["thickness"]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.shell(solids[0], self._thickness)


class ConformalMap(Binary):
    """A flat pattern (right) along the surface of a base (left): ConformalMap(base, pattern, ref_dir=Vec3(0, 0, 1)).

    The pattern's z is the height above the base. Its x and y are the place on the surface, as it is seen along ref_dir.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        form = {"base": as_node, "pattern": as_node, "ref_dir": Optional(vector, (0.0, 0.0, 1.0))}
        values = read("ConformalMap", ({}, form), arguments, named)
        super().__init__(values.get("base"), values.get("pattern"))
        self._direction: Point = values.get("ref_dir", (0.0, 0.0, 1.0))
        if self._direction == (0, 0, 0):
            raise ValueError("ConformalMap, ref_dir: expected a direction, found (0, 0, 0)")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.conformal_map(*solids, ref_dir=self._direction)

    def _composing(self) -> list[Node]:
        return self._inputs()[1:]


class FGrade(Unary):
    """Sets its child's composition: FGrade(functions, materials, prob_mode, child).

    A function for each material: a text, a number, or a function of (x, y, z, rho, phic, r, theta, phis) or these and
    d, the distance to the child's surface. With prob_mode their values are shares of a mixture, without it the
    greatest takes all.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        form = {"functions": _list_of(expression), "materials": _list_of(material), "prob_mode": boolean,
                "child": Optional(as_node, None)}
        values = read("FGrade", (form,), arguments, named)
        super().__init__(values["child"])
        self._functions, self._materials = values["functions"], values["materials"]
        self._mode = "prob" if values["prob_mode"] else "thresh"
        if len(self._functions) != len(self._materials):
            raise ValueError(f"FGrade: expected a function for each material, found {len(self._functions)} functions "
                             f"and {len(self._materials)} materials")

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.fgrade(solids[0], self._functions, self._materials, mode=self._mode)

    def _says_material(self) -> bool:
        return True

    def _own_materials(self) -> set[int]:
        return set(self._materials)

    def _composing(self) -> list[Node]:
        return []


class Tile(Unary):
    """The child, repeated without end: Tile(child), Tile(cx, cy, cz, child) with the steps in mm; 0: not along that axis.

    Without steps, those of the unit cell that the child is; of another child, the lengths of its bounding box. Cut it
    with an Intersection.
    """

    def __init__(self, *arguments: Any, **named: Any) -> None:
        steps = {"cx": number, "cy": number, "cz": number}
        values = read("Tile", ({}, {"child": as_node}, {**steps, **_child}), arguments, named)
        super().__init__(values.get("child"))
        self._steps: Point | None = tuple(values[c] for c in steps) if "cx" in values else None  # type: ignore[assignment]

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        assert self._child is not None
        return ombre.tile(self._child._tiled(solids[0]), self._steps)


def _list_of(reader: Any) -> Any:
    def read_list(value: Any) -> list[Any]:
        if isinstance(value, str) or not hasattr(value, "__iter__"):
            raise TypeError(f"expected a list, found {type(value).__name__}")
        elements = [reader(element) for element in value]
        if not elements:
            raise ValueError("expected at least one element")
        return elements
    return read_list


def _is_node(value: Any) -> bool:
    return isinstance(value, (Node, ombre.Solid))


def _with_list(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """The arguments, with nodes that stand one by one behind the others as the list that they are."""
    first = next((n for n, value in enumerate(arguments) if _is_node(value)), None)
    if first is None or not all(map(_is_node, arguments[first:])):
        return arguments
    return (*arguments[:first], list(arguments[first:]))


def _joined(nodes: list[Node]) -> Node:
    return nodes[0] if len(nodes) == 1 else Union(False, nodes)


def _axis(value: Any) -> Point:
    directions: dict[str, Point] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
    if not isinstance(value, str):
        raise TypeError(f"expected an axis, found {type(value).__name__}")
    if value.lower() not in directions:
        raise ValueError(f'expected "x", "y" or "z", found {value!r}')
    return directions[value.lower()]


_child = {"child": Optional(as_node, None)}
_moves: tuple[dict[str, Any], ...] = ({}, {"x": number, "y": number, "z": number, **_child})
_some = {"children": Optional(as_nodes, None)}
_boolean_forms: tuple[dict[str, Any], ...] = (
    {}, {"mix": boolean, **_some}, {"k": radius_of_blend, "mix": Optional(boolean, False), **_some},
    {"children": as_nodes}, {"k": radius_of_blend, "children": as_nodes})
