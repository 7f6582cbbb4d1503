"""Lattices by their names."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import ombre
from pyvcad import CellMapCollection, GraphUnitCell, ImplicitUnitCell, MappedGraphLattice, MappedImplicitLattice, Union
from pyvcad._arguments import number
from pyvcad._cell_maps import control
from pyvcad._lattices import MappedWalls


def _joined(map: Any, make: Callable[[Any], Any]) -> Any:
    """What is made of a map, or the union of what is made of several."""
    return Union(0.0, [make(one) for one in map.maps]) if isinstance(map, CellMapCollection) else make(map)


def tpms(map: Any, cell: str | ImplicitUnitCell, mode: str = "sheet", wall_thickness: Any = None,
         level: Any = None) -> Any:
    """Walls along a periodic surface, or one side of it; the surface is one of TPMS_NAMES or an ImplicitUnitCell.

    Args:
        map: a CellMap, or several.
        mode: "sheet", a wall of the thickness; "solid", where the function is at most the level.
        wall_thickness: mm, a number or a FloatAttribute.
        level: a number or a FloatAttribute; none: 0.
    """
    return _joined(map, lambda one: MappedImplicitLattice(one, cell, mode, wall_thickness, level))


def _surface(name: str) -> Callable[..., Any]:
    def make(map: Any, mode: str = "sheet", wall_thickness: Any = None, level: Any = None) -> Any:
        return tpms(map, name, mode, wall_thickness, level)
    make.__name__ = make.__qualname__ = name
    make.__doc__ = f"The surface {name}: tpms(map, {name!r}, mode, wall_thickness, level)."
    return make


gyroid, schwarz_p, schwarz_d, iwp = _surface("gyroid"), _surface("schwarz_p"), _surface("schwarz_d"), _surface("iwp")
neovius, lidinoid, split_p = _surface("neovius"), _surface("lidinoid"), _surface("split_p")


def graph_lattice(map: Any, cell: str | GraphUnitCell, beam_radius: Any = None, node_radius: Any = None,
                  curve_tolerance: float = 0.05) -> Any:
    """Struts of a graph, which is one of LATTICE_NAMES or a GraphUnitCell.

    Args:
        map: a CellMap, or several.
        beam_radius: mm, a number or a FloatAttribute.
        node_radius: radius of balls at the ends of struts, mm; none: no balls.
        curve_tolerance: accepted; struts follow the map exactly.
    """
    if beam_radius is None:
        raise TypeError("graph_lattice: struts need their radius; write beam_radius=0.4")
    return _joined(map, lambda one: MappedGraphLattice(one, cell, beam_radius, node_radius, curve_tolerance))


def _graph(name: str) -> Callable[..., Any]:
    def make(map: Any, beam_radius: Any = None, node_radius: Any = None, curve_tolerance: float = 0.05) -> Any:
        return graph_lattice(map, name, beam_radius, node_radius, curve_tolerance)
    make.__name__ = make.__qualname__ = name
    make.__doc__ = f"The struts of {name}: graph_lattice(map, {name!r}, beam_radius, node_radius)."
    return make


octet, cubic, bcc, fcc = _graph("octet"), _graph("cubic"), _graph("bcc"), _graph("fcc")
kelvin, diamond = _graph("kelvin"), _graph("diamond")


def _plates(map: Any, kind: str, thickness: Any) -> Any:
    value = control(thickness)
    return _joined(map, lambda one: MappedWalls(
        one, lambda cells, material: ombre.plates(cells, kind, value, material)))


def simple_cubic_plate(map: Any, wall_thickness: Any) -> Any:
    """Walls on the borders of cells; thickness in mm, a number or a FloatAttribute."""
    return _plates(map, "cubic", wall_thickness)


def cubic_octet_plate(map: Any, cubic_wall_thickness: Any, octet_wall_thickness: Any) -> Any:
    """Walls on the borders of cells, and others that are the faces of octahedra and tetrahedra."""
    return Union(0.0, [_plates(map, "cubic", cubic_wall_thickness), _plates(map, "octet", octet_wall_thickness)])


def rim(map: Any, width: Any) -> Any:
    """A band along the border of the surface of a map, inward; mm, a number or a FloatAttribute."""
    value = control(width)
    return _joined(map, lambda one: MappedWalls(one, lambda cells, material: ombre.rim(cells, value, material)))


def reentrant_honeycomb(map: Any, wall_thickness: Any, angle_degrees: float = -30.0, rib_ratio: float = 2.0) -> Any:
    """Walls along w in hexagons, two for each cell; with a negative angle, hexagons whose sides point inwards."""
    value, angle, ratio = control(wall_thickness), number(angle_degrees), number(rib_ratio)
    return _joined(map, lambda one: MappedWalls(
        one, lambda cells, material: ombre.honeycomb(cells, value, angle, ratio, material)))


def reentrant_hex_prism_reference_aspect_ratio(angle_degrees: float = -30.0, rib_ratio: float = 2.0) -> float:
    """The length of a cell along u over that along v for which no wall is stretched."""
    angle = math.radians(number(angle_degrees))
    return math.cos(angle) / (number(rib_ratio) + math.sin(angle))
