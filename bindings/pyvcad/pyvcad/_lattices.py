"""Lattices in the cells of maps: walls of surfaces, struts of graphs, flat walls."""
from __future__ import annotations

import copy
from collections.abc import Callable, Iterator
from typing import Any

import ombre

from ._attributes import Attribute, FloatAttribute, VolumeFractionsAttribute, checked
from ._cell_maps import CellMap, control
from ._solids import _Leaf, _unset
from ._unit_cells import Edge, GraphUnitCell, ImplicitUnitCell, graph_cell, implicit_cell


def _expect_map(what: str, value: Any) -> CellMap:
    if not isinstance(value, CellMap):
        raise TypeError(f"{what}: expected a CellMap, found {type(value).__name__}; write for example "
                        "rectangular_cell_map((Vec3(0, 0, 0), Vec3(10, 10, 10)), cells=(2, 2, 2))")
    return value


def _moved(attribute: Attribute, place: tuple[Any, Any, Any]) -> Attribute:
    """The attribute, whose formulas take x, y and z of another place."""
    def at(value: Any) -> Any:
        return value if isinstance(value, (int, float)) else ombre.at(value, place).value
    twin = copy.copy(attribute)
    if isinstance(twin, VolumeFractionsAttribute):
        twin._fractions = [(at(value), id) for value, id in twin._fractions]
    elif isinstance(twin, FloatAttribute):
        twin._value = at(twin._value)
    else:
        parts: Any = twin
        parts._parts = [_moved(part, place) for part in parts._parts]
    return twin


class MappedLattice(_Leaf):
    """A lattice in the cells of a map. Attributes of its parts go before those of the whole."""

    def __init__(self, map: Any) -> None:
        super().__init__()
        self._map = _expect_map(self.type(), map)
        self._material = _unset
        self._parts: list[tuple[frozenset[int] | None, str, Attribute]] = []

    def set_attribute(self, name: str, attribute: Any, coordinates: str | None = None) -> None:
        """Gives the lattice a value. With coordinates, x, y and z of its formulas are places of the map.

        Args:
            coordinates: "map" for 0 to 1 over the whole map, "cell" for 0 to 1 in each cell, "cell_index" for the numbers
                of cells from 0; without it, x, y and z in mm.
        """
        super().set_attribute(name, self._in(attribute, coordinates))

    def _in(self, attribute: Any, coordinates: str | None) -> Any:
        if coordinates is None or not isinstance(attribute, Attribute):
            return attribute
        return _moved(attribute, self._map._place_in(coordinates))

    def _set_part(self, edges: frozenset[int] | None, name: str, attribute: Any, coordinates: str | None) -> None:
        name, attribute = checked(name, self._in(attribute, coordinates))
        self._parts.append((edges, name, attribute))
        self._changed()

    def _take_copies(self) -> None:
        self._parts = list(self._parts)

    def _part_names(self) -> set[str]:
        return {name for _, name, _ in self._parts}

    def _mark_parts(self, marker: Callable[[str], str], mark: Attribute) -> None:
        self._parts += [(edges, marker(name), mark) for edges, name, _ in self._parts]

    def _fractions(self) -> set[int] | None:
        whole, parts = super()._fractions(), [attribute._materials() for _, _, attribute in self._parts]
        named = [ids for ids in (whole, *parts) if ids is not None]
        return set().union(*named) if named else None


class Shell:
    """The wall of a surface's lattice, to which attributes are given."""

    def __init__(self, lattice: MappedLattice) -> None:
        self._lattice = lattice

    def set_attribute(self, name: str, attribute: Any, coordinates: str | None = None) -> None:
        self._lattice._set_part(None, name, attribute, coordinates)


class MappedImplicitLattice(MappedLattice):
    """Walls along the surface of a periodic function, or one side of it: MappedImplicitLattice(map, cell,
    mode="sheet", wall_thickness=None, level=None).

    Args:
        map: a CellMap.
        cell: an ImplicitUnitCell, or the name of a surface.
        mode: "sheet", a wall of that thickness; "solid", where the function is at most the level.
        wall_thickness: mm, a number or a FloatAttribute; also where cells are bent.
        level: value of the function at the surface, a number or a FloatAttribute; none: 0.
    """

    def __init__(self, map: Any, cell: Any, mode: str = "sheet", wall_thickness: Any = None, level: Any = None) -> None:
        super().__init__(map)
        self._cell: ImplicitUnitCell = implicit_cell(cell)
        if mode not in ("sheet", "solid"):
            raise ValueError(f'{self.type()}, mode: expected "sheet" or "solid", found {mode!r}')
        if mode == "sheet" and wall_thickness is None:
            raise TypeError(f'{self.type()}: a sheet needs its thickness; write wall_thickness=0.5, or mode="solid"')
        self._mode = mode
        self._sizes: dict[str, Any] = {} if wall_thickness is None else {"thickness": control(wall_thickness)}
        if level is not None:
            self._sizes["level"] = control(level)

    @property
    def shell(self) -> Shell:
        """The wall, for attributes of its own."""
        return Shell(self)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return ombre.tpms(kind=self._mode, material=self._material, map=self._map._value, **self._sizes,
                          **self._cell._parameters(self._map))

    def _with_attributes(self, solid: ombre.Solid) -> ombre.Solid:
        solid = super()._with_attributes(solid)
        for _, name, attribute in self._parts:
            solid = attribute._given_to(solid, name)
        return solid


class Struts:
    """Struts of a lattice, to which attributes are given: `lattice.struts.where(lambda strut: strut.direction.z > 0.9)`."""

    def __init__(self, lattice: MappedGraphLattice, edges: list[Edge]) -> None:
        self._lattice, self._edges = lattice, edges

    def where(self, condition: Callable[[Edge], bool]) -> Struts:
        """Those for which the function is true."""
        return Struts(self._lattice, [edge for edge in self._edges if condition(edge)])

    def with_tag(self, tag: int) -> Struts:
        return self.where(lambda edge: edge.tag == tag)

    def set_attribute(self, name: str, attribute: Any, coordinates: str | None = None) -> None:
        self._lattice._set_part(frozenset(edge.index for edge in self._edges), name, attribute, coordinates)

    def __len__(self) -> int:
        return len(self._edges)

    def __iter__(self) -> Iterator[Struts]:
        return (Struts(self._lattice, [edge]) for edge in self._edges)

    def __getitem__(self, index: int) -> Struts:
        return Struts(self._lattice, [self._edges[index]])

    @property
    def direction(self) -> Any:
        """The direction of the first of them, among cells."""
        return self._edges[0].direction


class MappedGraphLattice(MappedLattice):
    """Struts in the cells of a map: MappedGraphLattice(map, cell, beam_radius, node_radius=None, curve_tolerance=0.05).

    Args:
        map: a CellMap.
        cell: a GraphUnitCell, or its name, such as "octet".
        beam_radius: mm, a number or a FloatAttribute.
        node_radius: radius of balls at the ends of struts, mm; none: struts end in half balls of their own radius.
        curve_tolerance: accepted; struts follow the map exactly.
    """

    def __init__(self, map: Any, cell: Any, beam_radius: Any, node_radius: Any = None,
                 curve_tolerance: float = 0.05) -> None:
        super().__init__(map)
        self._cell: GraphUnitCell = graph_cell(cell)
        self._sizes = {"radius": control(beam_radius)}
        if node_radius is not None:
            self._sizes["joint"] = control(node_radius)

    @property
    def struts(self) -> Struts:
        """All struts of the cell."""
        return Struts(self, self._cell.struts())

    @property
    def component_parameter(self) -> FloatAttribute:
        """The position along the nearest strut, from 0 to 1, for attributes of the lattice."""
        return FloatAttribute(ombre.t)

    def _says_material(self) -> bool:
        return super()._says_material() or bool(self._cell.material_tags)

    def _own_materials(self) -> set[int]:
        return {self._material, *(self._cell.material_tags or ())}

    def _part_names(self) -> set[str]:
        return super()._part_names() | ({"volume_fractions"} if self._cell.material_tags else set())

    def _fractions(self) -> set[int] | None:
        tags = set(self._cell.material_tags or ())
        named = super()._fractions()
        return named if not tags else tags | (named or set())

    def _lattice_of(self, edges: list[int], material: int) -> ombre.Solid:
        options: dict[str, Any] = {"map": self._map._value, "material": material, **self._sizes}
        if self._cell._is_named and len(edges) == len(self._cell.edges):
            return ombre.lattice(self._cell.name, **options)
        ends = [[tuple(self._cell.vertices[n]) for n in self._cell.edges[edge]] for edge in edges]
        return ombre.lattice(edges=ends, **options)

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return self._lattice_of(list(range(len(self._cell.edges))), self._material)

    def _groups(self) -> dict[tuple[Any, ...], list[int]]:
        """The edges by what they have of their own: their material and the parts that they are in."""
        tags, groups = self._cell.material_tags, dict[tuple[Any, ...], list[int]]()
        for edge in range(len(self._cell.edges)):
            parts = tuple(n for n, (edges, _, _) in enumerate(self._parts) if edges is not None and edge in edges)
            groups.setdefault((tags[edge] if tags else self._material, parts), []).append(edge)
        return groups

    def _with_attributes(self, solid: ombre.Solid) -> ombre.Solid:
        groups = self._groups()
        if list(groups) == [(self._material, ())]:
            return super()._with_attributes(solid)
        made = []
        # Struts with more parts of their own come first, which counts where struts meet.
        for (material, parts), edges in sorted(groups.items(), key=lambda item: (-len(item[0][1]), item[1])):
            one = super()._with_attributes(self._lattice_of(edges, material))
            for n in parts:
                one = self._parts[n][2]._given_to(one, self._parts[n][1])
            made.append(one)
        return ombre.union(made, materials="first")


class MappedWalls(MappedLattice):
    """Flat walls in the cells of a map, made by a function of the map's value and the material."""

    def __init__(self, map: Any, make: Callable[[Any, int], ombre.Solid]) -> None:
        super().__init__(map)
        self._walls = make

    def _make(self, solids: list[ombre.Solid]) -> ombre.Solid:
        return self._walls(self._map._value, self._material)
