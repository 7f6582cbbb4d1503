"""Nodes as scripts hold them: trees that can change, from which solids are built when they are queried."""
from __future__ import annotations

import copy
import math
import operator
import os
import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy

import ombre
from ombre._materials import current_factory, using
from ombre._solid import made_at

from . import _grids
from ._arguments import length
from ._attributes import Attribute, Changes, checked
from ._errors import WrongDesign, WrongValue
from ._materials import MaterialDefs, default_materials, expect_table, numbered
from ._other_tables import named_materials, solids_of, with_current_materials
from ._vectors import Vec3

if TYPE_CHECKING:
    from ._samples import AttributeSamples

# The names of files of these packages begin with this: .../pyvcad/, .../pyvcad_metamaterials/ and so on.
_packages = os.path.dirname(os.path.abspath(__file__))

_usual_epsilon = 1e-4  # mm

Place = tuple[str, int]  # a file, and a line of it


class Node:
    """A solid whose material may vary, as a node of a tree.

    Lengths are mm, z is up, distances are negative inside. A query of a node is answered by the tree below it as
    it is at that time.
    """

    def __init__(self) -> None:
        self._solid: ombre.Solid | None = None  # the solid that was built last
        self._factory: Any = None  # has the materials that the solid names
        self._built_from: list[ombre.Solid] = []  # solids of the children
        self._built_with: list[int] = []  # versions of the attributes
        self._checked_at = -1  # Changes.count at the last check that nothing below had changed
        self._attributes: dict[str, Attribute] = {}
        self._marked: Any = None  # the design with markers of attributes, and the solid that it is of
        self._has_fractions = self._has_material = False  # whether it, or what it is composed of, says some; set by _refresh
        self._epsilon: float | None = None  # the step of gradients, if it was set
        self._place = _call_place()
        self._home: Any = current_factory()  # the materials in use where it was made

    def __getstate__(self) -> dict[str, Any]:
        """Returns the state for copies, which build their own solids."""
        return {**self.__dict__, "_solid": None, "_factory": None, "_built_from": [], "_marked": None, "_checked_at": -1, "_home": None}

    # Properties of a kind of node.

    def _inputs(self) -> list[Node]:
        """The nodes below, in order. Raises DesignError where one is missing."""
        return []

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        """The solid, from those of the inputs; names the materials in use."""
        raise NotImplementedError(f"{self.type()} says no solid")

    def _own_materials(self) -> set[int]:
        return set()

    def _composing(self) -> list[Node]:
        """The inputs whose composition can be that of the node."""
        return self._inputs()

    def _replace(self, of: Callable[[Node], Node]) -> None:
        """Puts `of(child)` in place of every child."""

    def _take_copies(self) -> None:
        """Makes lists that a copy shares with its original its own."""

    def _fractions(self) -> set[int] | None:
        """The materials that its attribute names, if it has one that says of what it is."""
        attribute = self._attributes.get("volume_fractions")
        return attribute._materials() if attribute else None

    def _says_material(self) -> bool:
        """True if all of it is of what it says itself: of fractions, or of a material that it was given."""
        return "volume_fractions" in self._attributes

    def _computed(self) -> dict[str, list[str]]:
        """The attributes that it computes, each with those that it takes."""
        return {}

    def _own_attributes(self) -> list[str]:
        """The attributes that its solid has before any are set."""
        return []

    def _part_names(self) -> set[str]:
        """The attributes that parts of it have."""
        return set()

    def _mark_parts(self, marker: Callable[[str], str], mark: Attribute) -> None:
        """Gives the parts an attribute of the name marker(name) beside each of their own."""

    # Attributes.

    def set_attribute(self, name: str, attribute: Any) -> None:
        """Gives the node a value that varies through it, in place of those that nodes below have by this name."""
        name, attribute = checked(name, attribute)
        if name in self._attributes:
            raise RuntimeError(f"set_attribute: this {self.type()} has the attribute {name!r} already")
        self._attributes[name] = attribute
        self._changed()

    def get_attribute(self, name: str) -> Attribute:
        if name not in self._attributes:
            raise RuntimeError(f"get_attribute: this {self.type()} has no attribute {name!r}")
        return self._attributes[name]

    def attribute_list(self) -> list[str]:
        """The names that the node and those below it have or compute."""
        return sorted({name for node in in_order(self)
                       for name in (*node._attributes, *node._computed(), *node._part_names())})

    # Building.

    def _changed(self) -> None:
        if self._checked_at >= 0:
            Changes.count += 1
        self._solid = None

    def _build(self, factory: Any) -> ombre.Solid:
        """The solid of the tree. Parts of it that have not changed are the same solids as before."""
        if not (self._checked_at == Changes.count and self._factory is factory and self._solid is not None):
            with using(factory):
                for node in in_order(self):
                    node._refresh(factory)
        assert self._solid is not None
        return self._solid

    def _refresh(self, factory: Any) -> None:
        solids = [_solid_of(node) for node in self._inputs()]
        versions = [attribute._version for attribute in self._attributes.values()]
        is_same = (versions == self._built_with and len(solids) == len(self._built_from)
                   and all(map(operator.is_, solids, self._built_from)))
        if self._solid is None or self._factory is not factory or not is_same:
            composing = self._composing()
            self._has_fractions = self._fractions() is not None or any(node._has_fractions for node in composing)
            self._has_material = self._has_fractions or self._says_material() or any(node._has_material for node in composing)
            try:
                with made_at(self._place):
                    self._solid = self._with_attributes(self._make(solids))
            except (ombre.DesignError, TypeError) as error:
                raise self._error(_text_of(error)) from None
            self._factory, self._built_from, self._built_with = factory, solids, versions
        self._checked_at = Changes.count

    def _with_attributes(self, solid: ombre.Solid) -> ombre.Solid:
        """The solid with the attributes that were set on the node."""
        for name, attribute in self._attributes.items():
            solid = attribute._given_to(solid, name)
        return solid

    def _tiled(self, solid: ombre.Solid) -> ombre.Solid:
        """The solid that Tile repeats, from the node's own."""
        return solid

    def _error(self, text: str) -> WrongDesign:
        file, line = self._place
        return WrongDesign(f"{file}:{line}: {self.type()}: {text}")

    def _design(self) -> ombre.Design:
        """Returns the design for questions, which need ids but no materials."""
        if self._solid is not None and self._checked_at == Changes.count:
            return self._solid.design()
        greatest = max((max(node._own_materials() | (node._fractions() or set()), default=0) for node in in_order(self)),
                       default=0)
        known = default_materials._materials()
        if greatest > 255:
            raise self._error(f"there is no material {greatest}; 255 is the greatest id")
        return self._build((known if greatest < len(known) else numbered(greatest))._factory).design()

    if TYPE_CHECKING:  # what other files add
        def sample(self, x: float, y: float, z: float) -> tuple[float, AttributeSamples | None]: ...
        def to_diagram(self) -> str: ...

    # For `ombre`.

    def _ombre_solid_(self) -> ombre.Solid:
        return self._build(current_factory())

    def _ombre_design_(self, materials: Any = None) -> ombre.Design:
        """The design, compiled with materials; anything but a MaterialDefs stands for the default ones.

        These are the ones that were in use when the node was made: a script's may have been given to it.
        """
        if not isinstance(materials, MaterialDefs):
            materials = default_materials
        is_given = materials is not default_materials or default_materials._colors or self._home is None
        return self._build(materials._materials()._factory if is_given else self._home).design()

    # Questions.

    def type(self) -> str:
        """The name of the kind of node: "Sphere"."""
        return type(self).__name__

    def bounding_box(self) -> tuple[Vec3, Vec3]:
        """The least and the greatest corner of a box that encloses everything, mm."""
        low, high = self._design().bounds
        return Vec3(*low), Vec3(*high)

    def evaluate(self, x: float, y: float, z: float) -> float:
        """Signed distance at a point, mm.

        >>> import pyvcad as pv
        >>> pv.Sphere(pv.Vec3(0, 0, 0), 10).evaluate(15, 0, 0)
        5.0
        """
        return float(self._design().distance([x, y, z]))

    def volume(self, voxel_size: Any = None) -> float:
        """mm3, by the cells whose centres are inside; without a size, the longest side has 128 of them."""
        design = self._design()
        if voxel_size is None:
            low, high = design.bounds
            voxel_size = max(b - a for a, b in zip(low, high)) / 128
        try:
            return float(design.volume(_voxel_size(voxel_size)))
        except ValueError as error:
            raise WrongValue(f"volume: {error}") from None

    def gradient(self, *point: Any) -> Vec3:
        """Gradient of the distance at (x, y, z) or a Vec3; by central differences once their step has been set."""
        place = _point("gradient", point)
        if self._epsilon is None:
            return Vec3(*map(float, self._design().gradient(place)))
        steps = self._epsilon * numpy.eye(3)
        distances = self._design().distance(numpy.concatenate([place + steps, place - steps]))
        return Vec3(*map(float, (distances[:3] - distances[3:]) / (2 * self._epsilon)))

    def get_gradient_epsilon(self) -> float:
        """The step of differences, mm."""
        return _usual_epsilon if self._epsilon is None else self._epsilon

    def set_gradient_epsilon(self, epsilon: float) -> None:
        """Makes gradients differences over this step to both sides, mm."""
        self._epsilon = length(epsilon)

    def snap(self, point: Any) -> Vec3:
        """The nearest point of the surface, mm."""
        return Vec3(*map(float, self._design().nearest(_point("snap", (point,)))))

    def distribution(self, x: float, y: float, z: float) -> dict[int, float]:
        """{material's id: volume fraction} at a point; empty outside."""
        design = self._design()
        fractions = design.material([x, y, z])
        names = design.materials.names
        return {names.index(name): float(value) for name, value in fractions.items() if value > 0}

    def distribution_gradient(self, x: float, y: float, z: float, delta: float = 1) -> dict[int, Vec3]:
        """{material's id: gradient of its fraction, 1/mm}, by central differences over `delta` mm to each side."""
        if not delta > 0:
            raise ValueError(f"distribution_gradient: expected a delta above 0 (mm), found {delta}")
        step = delta * numpy.eye(3)
        design = self._design()
        fractions = design.material(numpy.concatenate([(x, y, z) + step, (x, y, z) - step]))
        names = design.materials.names
        return {names.index(name): Vec3(*map(float, (values[:3] - values[3:]) / (2 * delta)))
                for name, values in fractions.items() if values.any()}

    def heterogeneity(self, x: float, y: float, z: float) -> float:
        """1 where the material is pure, 0 where all n materials of the design have equal shares; 0 outside.

        sqrt(sum (f_i - 1/n)^2) / sqrt(1 - 1/n); 1 where the design has one material only.
        """
        found = self.distribution(x, y, z)
        if not found:
            return 0.0
        materials = (set(self.material_list()) | set(found)) - {0}
        n = len(materials)
        if n <= 1:
            return 1.0
        return math.sqrt(sum((found.get(i, 0.0) - 1 / n) ** 2 for i in materials)) / math.sqrt(1 - 1 / n)

    def material_list(self) -> list[int]:
        """The ids of the materials that the design can have."""
        found: set[int] = set()
        for node in in_order(self, lambda node: node._composing() if node._fractions() is None else []):
            fractions = node._fractions()
            found |= node._own_materials() if fractions is None else fractions
        return sorted(found)

    def prepare(self, voxel_size: Any = None, interior_bandwidth: Any = None, exterior_bandwidth: Any = None) -> None:
        """Builds the design, so that what is wrong with it shows; nothing is sampled before a job starts."""
        self._design()

    def clone(self) -> Node:
        """A copy of the tree; what it uses several times stays shared within the copy."""
        copies: dict[int, Node] = {}
        for node in in_order(self):
            twin = copy.copy(node)
            twin._home, twin._attributes = node._home, dict(node._attributes)
            twin._take_copies()
            twin._replace(lambda child: copies[id(child)])
            copies[id(node)] = twin
        return copies[id(self)]

    # Grids.

    def toSignedDistanceArray(self, voxel_size: Any, progress: Any = None) -> numpy.ndarray:
        """Signed distances, mm, at the centres of voxels that fill the bounding box.

        Args:
            voxel_size: mm; a number or a Vec3.
            progress: a function of the share that is done, 0 to 1.

        Returns:
            An array of the shape (nx, ny, nz).
        """
        return _grids.distances(self._design(), voxel_size, progress)

    def toRGBAArray(self, voxel_size: Any, material_defs: Any = None, blend: bool = True,
                    progress: Any = None) -> numpy.ndarray:
        """Colours at the centres of voxels that fill the bounding box; 0 outside.

        Args:
            voxel_size: mm; a number or a Vec3.
            material_defs: whose colours.
            blend: the mixture's colour; False: that of the one material which slicing would put there.
            progress: a function of the share that is done, 0 to 1.

        Returns:
            An array of bytes of the shape (nx, ny, nz, 4): red, green, blue, opacity.
        """
        expect_table("toRGBAArray", material_defs)
        return _grids.colors(self._ombre_design_(material_defs), voxel_size, blend, progress)

    def __repr__(self) -> str:
        return f"<{self.type()}>"


class Unary(Node):
    """A node with one child."""

    def __init__(self, child: Any = None) -> None:
        super().__init__()
        self._child: Node | None = as_node(child) if child is not None else None

    def child(self) -> Node | None:
        return self._child

    def set_child(self, child: Any) -> None:
        self._child = as_node(child)
        self._changed()

    def _inputs(self) -> list[Node]:
        if self._child is None:
            raise self._error("it has no child; give it one with set_child(node)")
        return [self._child]

    def _replace(self, of: Callable[[Node], Node]) -> None:
        if self._child is not None:
            self._child = of(self._child)


class _Resolving(Node):
    """A node whose children may have an attribute by the same name."""

    def __init__(self) -> None:
        super().__init__()
        self._rules: dict[str, Any] = {}  # resolvers, by attributes

    def set_attribute_conflict_resolver(self, name: str, resolver: Any) -> None:
        """How an attribute combines where children overlap, in place of the first child that has it. Of a difference no
        children overlap."""
        if not isinstance(name, str) or not hasattr(resolver, "_combine"):
            raise TypeError("set_attribute_conflict_resolver: expected a name and a resolver such as "
                            "resolvers.AverageConflictResolver()")
        if name == "volume_fractions" and resolver._rule != "mean":
            raise WrongValue(f"set_attribute_conflict_resolver: {name} have a mean and no other rule, found a "
                             f"{type(resolver).__name__}; write resolvers.AverageConflictResolver()")
        self._rules[name] = resolver
        self._changed()

    def attribute_conflict_resolvers(self) -> dict[str, Any]:
        return dict(self._rules)

    def _take_copies(self) -> None:
        self._rules = dict(self._rules)


class Binary(_Resolving):
    """A node with a left and a right child."""

    def __init__(self, left: Any = None, right: Any = None) -> None:
        super().__init__()
        self._left: Node | None = as_node(left) if left is not None else None
        self._right: Node | None = as_node(right) if right is not None else None

    def left(self) -> Node | None:
        return self._left

    def right(self) -> Node | None:
        return self._right

    def set_left(self, left: Any) -> None:
        self._left = as_node(left)
        self._changed()

    def set_right(self, right: Any) -> None:
        self._right = as_node(right)
        self._changed()

    def _inputs(self) -> list[Node]:
        if self._left is None:
            raise self._error("it has no left child; give it one with set_left(node)")
        if self._right is None:
            raise self._error("it has no right child; give it one with set_right(node)")
        return [self._left, self._right]

    def _replace(self, of: Callable[[Node], Node]) -> None:
        if self._left is not None:
            self._left = of(self._left)
        if self._right is not None:
            self._right = of(self._right)


class NAry(_Resolving):
    """A node with any number of children."""

    def __init__(self, children: Any = None) -> None:
        super().__init__()
        self._is_given = children is not None  # an empty list is nothing, no list a mistake
        self._children: list[Node] = list(children or ())

    def add_child(self, child: Any) -> bool:
        """Adds a child behind the others, and returns True."""
        self._children.append(as_node(child))
        self._changed()
        return True

    def child(self, index: int) -> Node:
        return self._children[index]

    def children(self) -> list[Node]:
        return list(self._children)

    def num_children(self) -> int:
        return len(self._children)

    def _attribute_rules(self) -> list[tuple[str, str]]:
        return [(name, resolver._rule) for name, resolver in self._rules.items()
                if name != "volume_fractions" and resolver._rule]

    def _mixes(self) -> bool:
        return "volume_fractions" in self._rules

    def _inputs(self) -> list[Node]:
        if not self._children and not self._is_given:
            raise self._error("it has no children; give it some with add_child(node)")
        return self._children

    def _replace(self, of: Callable[[Node], Node]) -> None:
        self._children = [of(child) for child in self._children]


class Wrapped(Node):
    """A solid that was made elsewhere: by `ombre`, or from a .vcad text."""

    def __init__(self, design: ombre.Design) -> None:
        super().__init__()
        self._given = design
        parts = [solid for _, solid in design.parts]
        self._whole: ombre.Solid = parts[0]
        if len(parts) > 1:
            with using(design._core.factory):
                self._whole = ombre.union(*parts)

    def _says_material(self) -> bool:
        return True

    def _own_attributes(self) -> list[str]:
        return self._given.attributes

    def _own_materials(self) -> set[int]:
        return {self._given.materials[name]["id"] for solid in solids_of(self._whole)
                for name in named_materials(solid)}

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        if self._whole._node.factory is current_factory():
            return self._whole
        return with_current_materials(self._whole, {name: i for i, name in enumerate(self._given.materials.names)})

    def _ombre_design_(self, materials: Any = None) -> ombre.Design:
        # As a whole design it keeps its box, its parts and its materials.
        is_changed = isinstance(materials, MaterialDefs) or self._attributes
        return super()._ombre_design_(materials) if is_changed else self._given


def as_node(value: Any) -> Node:
    """A node, also of a solid of `ombre`. Raises TypeError."""
    if isinstance(value, Node):
        return value
    if isinstance(value, ombre.Solid):
        return Wrapped(value.design())
    if isinstance(value, type) and issubclass(value, Node):
        raise TypeError(f"expected a node, found the class {value.__name__}; write {value.__name__}(...)")
    raise TypeError(f"expected a node, found {type(value).__name__}")


def as_nodes(value: Any) -> list[Node]:
    if not isinstance(value, (list, tuple)):
        raise TypeError(f"expected a list of nodes, found {type(value).__name__}")
    return [as_node(element) for element in value]


def in_order(root: Node, inputs: Callable[[Node], list[Node]] | None = None) -> Iterator[Node]:
    """Every node of the tree once, those below before those above. Raises DesignError for a cycle.

    Goes without recursion, since chains of nodes may be long.
    """
    below = inputs or (lambda node: node._inputs())
    open_nodes, done = {id(root)}, set()
    stack = [(root, iter(below(root)))]
    while stack:
        node, rest = stack[-1]
        child = next((c for c in rest if id(c) not in done), None)
        if child is None:
            stack.pop()
            open_nodes.discard(id(node))
            done.add(id(node))
            yield node
        elif id(child) in open_nodes:
            raise child._error(f"it lies below itself: a {node.type()} further down has it as a child again. "
                               "Give that one a clone() instead")
        else:
            open_nodes.add(id(child))
            stack.append((child, iter(below(child))))


def _solid_of(node: Node) -> ombre.Solid:
    assert node._solid is not None
    return node._solid


def _call_place() -> Place:
    """File and line of the script's code that runs."""
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_packages):
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno


def _text_of(error: Exception) -> str:
    diagnostics = getattr(error, "diagnostics", [])
    texts = [d["message"] + (f"; {d['hint']}" if d.get("hint") else "") for d in diagnostics]
    return "; ".join(texts) or str(error)


def _voxel_size(value: Any) -> Any:
    from ._arguments import voxel_size
    return voxel_size(value)


def _point(what: str, values: tuple[Any, ...]) -> list[float]:
    if len(values) == 1 and hasattr(values[0], "__iter__"):
        values = tuple(values[0])
    if len(values) != 3:
        raise TypeError(f"{what}: expected x, y and z or a Vec3, found {len(values)} values")
    return [float(v) for v in values]
