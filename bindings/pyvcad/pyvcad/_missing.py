"""Names of pyvcad that Ombre does not have yet: each reports that when it is made."""
from __future__ import annotations

import difflib
import functools
from typing import Any

from ._errors import missing
from ._tree import Node

_grids = "ombre voxels writes grids, and node.toSignedDistanceArray and toRGBAArray give arrays"
_beams = "Mesh(path) reads a 3MF file with its beams; BeamLattice(vertices, beams, radius) makes them"
_tables = "its measurements are not free to copy; register_calibration(name or file) takes a calibration of your own"

# Names that are missing, by the package that has them in pyvcad 3, each with what to use instead.
MISSING: dict[str, dict[str, str]] = {
    "pyvcad": {
        "ThreeMFBeamLattice": _beams, "read_3mf_beam_lattice": _beams, "ClipMode": _beams,
        "Mix": "pyvcad_metamaterials.mix(left, right, weight)",
        "FloatGrid": _grids, "BoolGrid": _grids,
        "Point2": "Vec2"} | dict.fromkeys(
        ("Segment2", "Polygon2", "Polyline2", "Arrangement2"),
        "PolygonExtrude(vertices, height) and PolygonRevolve(profile, axis_start, axis_end, degrees) take lists of Vec3"),
    "pyvcad_compilers": dict.fromkeys(
        ("GCVFCompiler",),
        "ColorInkjetCompiler and MaterialInkjetCompiler write the images of a material printer"),
    "pyvcad_metamaterials": {
        "plate_lattice": "simple_cubic_plate, cubic_octet_plate and reentrant_honeycomb are walls",
        "idw_weight": "ombre.morph(first, second, third, seeds=[...]), whose weights fall with the distance from a seed for each body"},
    "pyvcad_metamaterials.properties": {"characterize_mesh": "characterize(Mesh(surface), voxel_size)"},
    "pyvcad_rendering": dict.fromkeys(
        ("select_mesh_patch", "replay_mesh_selection"),
        "the studio picks; in a script, surface.select_linked_by_face_angle(surface.nearest_triangle(point).triangle_id, angle)"),
    "pyvcad_attribute_resolver": dict.fromkeys(
        ("register_pla_conversions", "register_tpu_conversions", "register_foaming_conversions",
         "register_j750_shore_hardness_conversions", "register_j750_modulus_toughness_conversions",
         "generate_j750_modulus_toughness_lookup_table", "generate_j750_modulus_toughness_reachable_region_plot",
         "register_stratasys_radiomatrix_conversions"), _tables),
}

_cells = "points are in the list that sample_points_in_host gives, and properties.characterize measures the whole"

# Methods of nodes that are missing, with what to use instead.
_methods = {
    "set_attribute_conflict_resolver": "it is a method of nodes with several children, such as Union",
    "attribute_conflict_resolvers": "it is a method of nodes with several children, such as Union",
    "component_parameter": "it is an attribute of what pyvcad_metamaterials.octet and other struts give",
    "segment_info": "struts[i].direction, struts.with_tag(tag) and struts.where(condition) tell struts apart",
    "save_openvdb_sdf_grid": "pyvcad_rendering.Export(node, path=\"part.vdb\") writes the grid \"distance\"",
    "save_openvdb_occupancy_grid": "TreeSampler(node, voxel_size).save_openvdb_occupancy_grid(path) writes it",
} | dict.fromkeys(("boundary_caps", "boundary_contact_patches", "boundary_seams", "tessellation_edges", "tessellation_faces",
                   "confined_edges", "delaunay_cells", "voronoi_cells"), _cells)


class _Absent(type):
    """The class of what is missing: each use of it raises an error that says so."""

    _instead: str

    def __call__(cls, *arguments: Any, **named: Any) -> Any:
        raise missing(cls.__name__, cls._instead)

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        raise missing(f"{cls.__name__}.{name}", cls._instead)


@functools.lru_cache(maxsize=None)
def _absent(package: str, name: str) -> type:
    return _Absent(name, (), {"_instead": MISSING[package][name], "__module__": package})


def attribute_of(package: str, known: list[str], name: str) -> Any:
    """Returns the stand-in for a missing name, for `__getattr__` of a package. Raises AttributeError for other names."""
    if name in MISSING.get(package, {}):
        return _absent(package, name)
    close = difflib.get_close_matches(name, [*known, *MISSING.get(package, {})], 1)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    raise AttributeError(f"module {package!r} has no attribute {name!r}{hint}")


def _method_of(node: Node, name: str) -> Any:
    if name in _methods:
        raise missing(f"{node.type()}.{name}", _methods[name])
    close = [] if name.startswith("_") else difflib.get_close_matches(name, [n for n in dir(node) if n[0] != "_"], 1)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    raise AttributeError(f"{type(node).__name__!r} has no attribute {name!r}{hint}")


# It is set here instead of in the class, so that type checkers still find misspelt names.
Node.__getattr__ = _method_of  # type: ignore[attr-defined]


class _Missing(Node):
    def __init__(self, *arguments: Any, **named: Any) -> None:
        raise missing(type(self).__name__)


class Map(_Missing):
    """Coordinates along a surface."""
