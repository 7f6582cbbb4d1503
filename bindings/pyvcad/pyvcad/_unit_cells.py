"""What repeats in the cells of a map: functions whose surface is a wall, and graphs whose edges are struts."""
from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy

import ombre

from ._arguments import vector
from ._cell_maps import CellMap, control
from ._functions import expression
from ._vectors import Vec3

TPMS_NAMES = ("gyroid", "schwarz_p", "schwarz_d", "iwp", "neovius", "lidinoid", "split_p")
LATTICE_NAMES = ("octet", "cubic", "bcc", "fcc", "kelvin", "diamond")


class ImplicitUnitCell:
    """A periodic function of u, v and w from 0 to 1: ImplicitUnitCell(f), where f is a formula or a function.

    ImplicitUnitCell.standard("gyroid") is that of a minimal surface, ImplicitUnitCell.mixed(a, b, weight) one between two.
    """

    def __init__(self, function: Any, gradient: Any = None, name: str = "custom") -> None:
        if not isinstance(function, str) and not callable(function):
            raise TypeError(f"ImplicitUnitCell: expected a formula or a function of u, v and w, found "
                            f"{type(function).__name__}")
        self.name, self._function = name, function
        self._surface: str | None = None
        self._mixed: tuple[ImplicitUnitCell, ImplicitUnitCell, Any] | None = None

    @staticmethod
    def standard(name: str) -> ImplicitUnitCell:
        if name not in TPMS_NAMES:
            raise ValueError(f"ImplicitUnitCell.standard: expected one of {', '.join(TPMS_NAMES)}, found {name!r}")
        cell = ImplicitUnitCell("0", name=name)
        cell._surface = name
        return cell

    @staticmethod
    def mixed(a: Any, b: Any, weight: Any) -> ImplicitUnitCell:
        """Where the weight is 0, the first; where it is 1, the second; values are mixed before walls are made."""
        first, second = implicit_cell(a), implicit_cell(b)
        cell = ImplicitUnitCell("0", name=f"{first.name}_{second.name}")
        cell._mixed = first, second, control(weight)
        return cell

    def validate_periodicity(self, tolerance: float = 1e-6) -> bool:
        """Is the function the same on opposite faces of the cell?"""
        if self._mixed:
            return all(cell.validate_periodicity(tolerance) for cell in self._mixed[:2])
        if self._surface:
            return True
        at = numpy.linspace(0.03, 0.97, 7)
        a, b = (axis.ravel() for axis in numpy.meshgrid(at, at))
        for axis in range(3):
            low = numpy.insert(numpy.stack([a, b], axis=-1), axis, 0.0, axis=-1)
            high = numpy.insert(numpy.stack([a, b], axis=-1), axis, 1.0, axis=-1)
            if numpy.abs(self._sampled(low) - self._sampled(high)).max() > tolerance:
                return False
        return True

    def _sampled(self, points: numpy.ndarray) -> numpy.ndarray:
        if not isinstance(self._function, str):
            return numpy.array([self._function(*map(float, p)) for p in points])
        return numpy.asarray(ombre.Expression(_in_space(self._function))(points))

    def _on(self, map: CellMap) -> Any:
        """The function in the cells of a map, as an expression."""
        if self._mixed:
            first, second, weight = self._mixed
            share = weight if isinstance(weight, (int, float)) else ombre.formula(weight).value
            return (1 - share) * first._on(map) + share * second._on(map)
        if self._surface:
            return ombre.tpms_value(self._surface, map._value).value
        if isinstance(self._function, str):
            return ombre.at(_in_space(self._function), map._value.place).value
        return ombre.at(expression(self._function), map._value.local).value

    def _parameters(self, map: CellMap) -> dict[str, Any]:
        """The parameters of ombre.tpms that say which surface it is."""
        if self._surface:
            return {"surface": self._surface}
        if isinstance(self._function, str) and not self._mixed:
            return {"equation": self._function}
        return {"equation": self._on(map)}


def _in_space(formula: str) -> str:
    """The formula with x, y and z in place of u, v and w."""
    names = {"u": "x", "v": "y", "w": "z"}
    return re.sub(r"(?<![\w.])[uvw](?!\w)", lambda word: names[word[0]], formula)


def _cell(value: Any, kind: Any, names: Any) -> Any:
    """A cell of this kind, which may be given by the name of a standard one."""
    if isinstance(value, kind):
        return value
    if isinstance(value, str):
        return kind.standard(value)
    raise TypeError(f"expected a cell of the type {kind.__name__} or one of {', '.join(names)}, found {type(value).__name__}")


def implicit_cell(value: Any) -> ImplicitUnitCell:
    cell: ImplicitUnitCell = _cell(value, ImplicitUnitCell, TPMS_NAMES)
    return cell


class Edge:
    """A strut of a unit cell, as `where` is asked about it."""

    def __init__(self, index: int, start: Vec3, end: Vec3, tag: int, orientation_tag: int, material: int | None) -> None:
        self.index, self.start, self.end = index, start, end
        self.tag, self.orientation_tag, self.material = tag, orientation_tag, material

    @property
    def direction(self) -> Vec3:
        """The direction from its start to its end, of length 1 among cells."""
        way = self.end - self.start
        return Vec3(*(c / way.length() for c in way))

    @property
    def length(self) -> float:
        return float((self.end - self.start).length())

    def __repr__(self) -> str:
        return f"Edge({self.index}, {self.start!r}, {self.end!r}, tag={self.tag})"


class GraphUnitCell:
    """Struts in a cell: vertices from 0 to 1, edges as pairs of their numbers; tags are whole numbers, one for each."""

    def __init__(self, vertices: Any, edges: Any, vertex_tags: Any = (), edge_tags: Any = (), orientation_tags: Any = (),
                 material_tags: Any = (), name: str = "custom") -> None:
        self.name = name
        self._is_named = False
        self.vertices = [Vec3(*vector(v)) for v in vertices]
        self.edges = [(int(a), int(b)) for a, b in edges]
        for n, (a, b) in enumerate(self.edges):
            if not (0 <= a < len(self.vertices) and 0 <= b < len(self.vertices)) or a == b:
                raise ValueError(f"GraphUnitCell: edge {n} joins the vertices {a} and {b}; expected two of the "
                                 f"{len(self.vertices)} vertices, counted from 0")
        for n, vertex in enumerate(self.vertices):
            if not all(-1e-9 <= c <= 1 + 1e-9 for c in vertex):
                raise ValueError(f"GraphUnitCell: vertex {n} is {vertex!r}; expected numbers from 0 to 1")
        self.vertex_tags = _tags("vertex_tags", vertex_tags, len(self.vertices))
        self.edge_tags = _tags("edge_tags", edge_tags, len(self.edges))
        self.orientation_tags = _tags("orientation_tags", orientation_tags, len(self.edges))
        self.material_tags = _tags("material_tags", material_tags, len(self.edges)) if len(material_tags) else None

    @staticmethod
    def standard(name: str) -> GraphUnitCell:
        if name not in LATTICE_NAMES:
            raise ValueError(f"GraphUnitCell.standard: expected one of {', '.join(LATTICE_NAMES)}, found {name!r}")
        struts = ombre.lattice(name, (1, 1, 1), 0.1)._node.constant("struts")
        vertices: list[tuple[float, ...]] = []
        edges = []
        for strut in struts:
            ends = [tuple(round(float(c) + 0.5, 12) for c in point) for point in strut[:2]]
            vertices += [end for end in dict.fromkeys(ends) if end not in vertices]
            edges.append((vertices.index(ends[0]), vertices.index(ends[1])))
        cell = GraphUnitCell(vertices, edges, name=name)
        cell._is_named = True
        return cell

    def struts(self) -> list[Edge]:
        return [Edge(n, self.vertices[a], self.vertices[b], self.edge_tags[n], self.orientation_tags[n],
                     self.material_tags[n] if self.material_tags else None)
                for n, (a, b) in enumerate(self.edges)]


def _tags(what: str, tags: Any, count: int) -> list[int]:
    found = [int(tag) for tag in tags]
    if found and len(found) != count:
        raise ValueError(f"GraphUnitCell, {what}: expected {count} whole numbers, found {len(found)}")
    return found or [0] * count


def graph_cell(value: Any) -> GraphUnitCell:
    cell: GraphUnitCell = _cell(value, GraphUnitCell, LATTICE_NAMES)
    return cell


Condition = Callable[[Edge], bool]
