"""Open surfaces on which maps of cells lie: patches of meshes."""
from __future__ import annotations

import os
import tempfile
from typing import Any

import numpy

import ombre

from ._arguments import number, vector
from ._cell_maps import CellMap, TrimMode, inverted_from, whole_counts
from ._errors import missing
from ._triangles import Triangles

_methods = ("lscm", "arap", "authalic")


class OpenSurface:
    """A surface with an open border: a face of a CADModel or a TriangleMeshSurface."""

    def _part(self) -> tuple[str, dict[str, Any]]:
        """The file of the surface, and the options with which ombre.surface_cells takes it alone."""
        raise NotImplementedError

    def _layout(self) -> dict[str, Any]:
        """The options of ombre.surface_cells that lay it out."""
        return {}

    def _starts(self) -> numpy.ndarray:
        """Points near the surface, from which places are sought."""
        raise NotImplementedError


def cells_on(what: str, surface: OpenSurface, counts: tuple[int, int, int], **options: Any) -> Any:
    """The value of ombre.surface_cells on a surface, whose mistakes are RuntimeErrors, as in pyvcad."""
    path, part = surface._part()
    try:
        value = ombre.surface_cells(path, count=counts, **part, **surface._layout(), **options)
        value.region.bounds  # noqa: B018  # loads the surface
    except ombre.DesignError as error:
        raise RuntimeError(f"{what}: {error}") from None
    return value


class TriangleMeshSurface(OpenSurface, Triangles):
    """A patch of triangles that is laid out in a plane: TriangleMeshSurface(vertices, triangles, u_axis_hint=None,
    method="lscm").

    The patch is in one piece and has an open border; holes are allowed. Its winding gives the side of positive heights.
    Raises RuntimeError, with what is wrong and where, for other surfaces.

    Args:
        u_axis_hint: the direction of u, as far as possible; none: along the patch.
        method: "lscm" keeps angles, "arap" lengths; "authalic" fills a circle.
    """

    def __init__(self, vertices: Any, triangles: Any, u_axis_hint: Any = None, method: str = "lscm") -> None:
        if method not in _methods:
            raise ValueError(f"TriangleMeshSurface, method: expected one of {', '.join(_methods)}, found {method!r}")
        self._vertices = numpy.array([vector(v) for v in vertices], dtype=float).reshape(-1, 3)
        self._triangles = numpy.array(triangles, dtype=numpy.int64).reshape(-1, 3)
        if not self._triangles.size:
            raise RuntimeError("TriangleMeshSurface: there are no triangles")
        if not 0 <= self._triangles.min() <= self._triangles.max() < len(self._vertices):
            raise RuntimeError("TriangleMeshSurface: a triangle names a vertex that is not there")
        self._toward = self._longest_direction() if u_axis_hint is None else vector(u_axis_hint)
        self.parameterization_method = method
        self._folder = tempfile.TemporaryDirectory(prefix="ombre_")
        self._path = self._written()
        # Lays it out, or refuses.
        cells_on("TriangleMeshSurface", self, (1, 1, 1), height=1e-6 * float(numpy.ptp(self._vertices, axis=0).max()))

    @staticmethod
    def from_selection(mesh: Any, ids: Any, u_axis_hint: Any = None, method: str = "lscm") -> TriangleMeshSurface:
        """The triangles with these numbers of a SurfaceMesh."""
        chosen = numpy.asarray(mesh.triangles)[sorted(int(n) for n in ids)]
        used, numbers = numpy.unique(chosen, return_inverse=True)
        return TriangleMeshSurface(numpy.asarray(mesh.vertices)[used], numbers.reshape(-1, 3), u_axis_hint, method)

    @property
    def uv_bounds(self) -> Any:
        raise missing("TriangleMeshSurface.uv_bounds", "u and v of a map on it run from 0 to its counts of cells")

    def _longest_direction(self) -> tuple[float, float, float]:
        centred = self._vertices - self._vertices.mean(axis=0)
        x, y, z = numpy.linalg.svd(centred, full_matrices=False)[2][0]
        return float(x), float(y), float(z)

    def _written(self) -> str:
        """An OFF file, which keeps the numbers as they are."""
        path = os.path.join(self._folder.name, "surface.off")
        with open(path, "w", encoding="ascii") as file:
            file.write(f"OFF\n{len(self._vertices)} {len(self._triangles)} 0\n")
            file.writelines(" ".join(repr(float(c)) for c in v) + "\n" for v in self._vertices)
            file.writelines("3 " + " ".join(str(int(n)) for n in t) + "\n" for t in self._triangles)
        return path

    def _part(self) -> tuple[str, dict[str, Any]]:
        return self._path, {}

    def _layout(self) -> dict[str, Any]:
        return {"toward": self._toward, "method": self.parameterization_method}

    def _starts(self) -> numpy.ndarray:
        return self.vertices


def _expect_surface(what: str, value: Any) -> OpenSurface:
    if not isinstance(value, OpenSurface):
        raise TypeError(f"{what}: expected a CADFace or a TriangleMeshSurface, found {type(value).__name__}")
    return value


def options_of_map(what: str, cells: Any, height: Any, trim: Any,
                   standoff: Any) -> tuple[tuple[int, int, int], TrimMode, dict[str, Any]]:
    """The numbers of cells, and the options of ombre.surface_cells for a layer on a surface."""
    counts, tall, (mode, options) = whole_counts("cells", cells), number(height), _trimmed(trim)
    if tall == 0:
        raise ValueError(f"{what}, height: expected a height above or below 0 (mm)")
    side = "inside" if tall < 0 else "outside"
    return counts, mode, {"height": abs(tall), "standoff": number(standoff), "side": side, **options}


def _trimmed(trim: Any) -> tuple[TrimMode, dict[str, str]]:
    mode = TrimMode(trim) if isinstance(trim, str) else trim
    return mode, {"trim": "border" if mode is TrimMode.boundary else mode.value}


def made_map(value: Any, counts: tuple[int, int, int], mode: TrimMode, starts: numpy.ndarray, *sources: Any) -> CellMap:
    """A map on surfaces, whose files stay as long as it is held; `starts` are points on or near its lowest cells."""
    made = CellMap(value, counts, inverted_from(value, counts, starts))
    made.trim_mode, made.has_boundary_trim = mode, mode is TrimMode.boundary
    made._sources = sources
    return made


def from_surface(surface: Any, cells: Any, height: float, linear: bool = True, trim: Any = TrimMode.boundary,
                 standoff: float = 0.0) -> CellMap:
    """Cells on a surface: u and v along it, w along its normal.

    Args:
        surface: a TriangleMeshSurface or a CADFace.
        cells: their numbers along u, v and w.
        height: of all cells together, mm; below 0 on the other side.
        linear: accepted; walls and struts follow the surface.
        trim: TrimMode.boundary cuts cells at the border, TrimMode.cells keeps whole ones; with TrimMode.none cells on a
            face of a CAD file go on beyond its border.
        standoff: distance of the first cells from the surface, mm.
    """
    what = "cell_map_from_surface"
    one = _expect_surface(what, surface)
    counts, mode, options = options_of_map(what, cells, height, trim, standoff)
    return made_map(cells_on(what, one, counts, **options), counts, mode, one._starts(), one)


def paired(what: str, a: Any, b: Any, cells: Any, trim: Any, pairing: str) -> CellMap:
    """Cells from a surface to another one, whose places at equal shares of u and v are joined."""
    first, second = (_expect_surface(what, one) for one in (a, b))
    counts, (mode, options) = whole_counts("cells", cells), _trimmed(trim)
    path, part = second._part()
    of_second = {f"to_{name}": value for name, value in part.items()}
    value = cells_on(what, first, counts, to=path, pairing=pairing, **of_second, **options)
    return made_map(value, counts, mode, first._starts(), first, second)


def between_surfaces(a: Any, b: Any, cells: Any, linear: bool = True, trim: Any = TrimMode.boundary) -> CellMap:
    """Cells from a surface to another one; u and v are those of the first, and places at equal shares of u and v are
    joined such that the ways between them are short.

    Args:
        a, b: a CADFace or a TriangleMeshSurface each.
        cells: their numbers along u, v and w.
        linear: accepted; walls and struts follow the surfaces.
        trim: TrimMode.boundary cuts cells at the border, TrimMode.cells keeps whole ones; with TrimMode.none cells on a
            face of a CAD file go on beyond its border.
    """
    return paired("cell_map_between_surfaces", a, b, cells, trim, "nearest")


CellMap.from_surface, CellMap.between_surfaces = staticmethod(from_surface), staticmethod(between_surfaces)
