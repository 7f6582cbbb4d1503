"""Lattices in the cells of maps, for scripts of pyvcad 3.

    import pyvcad as pv
    import pyvcad_metamaterials as mm

    cells = mm.rectangular_cell_map((pv.Vec3(0, 0, 0), pv.Vec3(9, 9, 9)), cells=(3, 3, 3))
    root = mm.gyroid(cells, wall_thickness=cells.logical_position.x.map_range(0, 3, 0.4, 1))
"""
from __future__ import annotations

from pyvcad import CellMap, CellMapCollection, GraphUnitCell, ImplicitUnitCell, TrimMode
from pyvcad._missing import attribute_of
from pyvcad._unit_cells import LATTICE_NAMES, TPMS_NAMES

from . import properties
from ._blends import mix, mix_many, ramp
from ._lattices import (bcc, cubic, cubic_octet_plate, diamond, fcc, graph_lattice, gyroid, iwp, kelvin, lidinoid, neovius,
                        octet, reentrant_hex_prism_reference_aspect_ratio, reentrant_honeycomb, rim, schwarz_d, schwarz_p,
                        simple_cubic_plate, split_p, tpms)
from ._scattered import (ScatteredPoints, delaunay_graph_lattice, delaunay_plate_lattice, sample_points_in_host,
                         voronoi_graph_lattice, voronoi_plate_lattice)
from ._maps import (cell_map_between_cad_faces, cell_map_between_surfaces, cell_map_from_cad_face,
                    cell_map_from_surface, cylindrical_cell_map, rectangular_cell_map, spherical_cell_map, warp_cell_map)

__all__ = ["CellMap", "CellMapCollection", "GraphUnitCell", "ImplicitUnitCell", "LATTICE_NAMES", "ScatteredPoints", "TPMS_NAMES",
           "TrimMode", "delaunay_graph_lattice", "delaunay_plate_lattice", "sample_points_in_host", "voronoi_graph_lattice",
           "voronoi_plate_lattice", "bcc", "cell_map_between_cad_faces", "cell_map_between_surfaces", "cell_map_from_cad_face", "cell_map_from_surface",
           "cubic", "cubic_octet_plate", "cylindrical_cell_map", "diamond", "fcc", "graph_lattice", "gyroid", "iwp",
           "kelvin", "lidinoid", "mix", "mix_many", "neovius", "octet", "properties", "ramp", "rectangular_cell_map",
           "reentrant_hex_prism_reference_aspect_ratio", "reentrant_honeycomb", "rim", "schwarz_d", "schwarz_p",
           "simple_cubic_plate", "spherical_cell_map", "split_p", "tpms", "warp_cell_map"]


def __getattr__(name: str) -> object:
    return attribute_of(__name__, __all__, name)
