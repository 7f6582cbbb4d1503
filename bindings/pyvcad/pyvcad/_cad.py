"""Models of CAD programs, and their faces."""
from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterable
from typing import Any

import numpy

import ombre
from ombre._commands import run

from ._arguments import number, vector
from ._cell_maps import CellMap, CellMapCollection, TrimMode
from ._errors import missing
from ._solids import CAD, _find
from ._surfaces import OpenSurface, cells_on, made_map, options_of_map, paired
from ._vectors import Vec3


_kinds = ("plane", "cylinder", "cone", "sphere", "torus", "bezier", "bspline", "revolution", "extrusion", "offset", "other")


class CADFace(OpenSurface):
    """A face of a CADModel. Areas are mm2; the normal is the mean one, out of the solid."""

    def __init__(self, model: CADModel, index: int, face: dict[str, Any]) -> None:
        self._model, self._face = model, face
        self.index = index

    @property
    def area(self) -> float:
        return float(self._face["area_mm2"])

    @property
    def surface_type(self) -> str:
        """The kind of its surface, such as "plane", "cylinder" or "bspline"."""
        return str(self._face["kind"])

    @property
    def centroid(self) -> Vec3:
        return Vec3(*self._face["center"])

    @property
    def normal(self) -> Vec3:
        return Vec3(*self._face["normal"])

    @property
    def bounding_box(self) -> tuple[Vec3, Vec3]:
        low, high = self._face["box"]
        return Vec3(*low), Vec3(*high)

    @property
    def is_trimmed(self) -> bool:
        raise missing("CADFace.is_trimmed", "area and surface_type tell faces apart")

    @property
    def boundary_loop_count(self) -> int:
        raise missing("CADFace.boundary_loop_count", "area and surface_type tell faces apart")

    def __repr__(self) -> str:
        return f"CADFace({self.index}, {self.surface_type!r}, area={self.area:g})"

    def _part(self) -> tuple[str, dict[str, Any]]:
        low, high = (numpy.array(corner) for corner in self.bounding_box)
        room = 0.02 * float(numpy.linalg.norm(high - low)) + 1e-6
        center = numpy.array(list(self.centroid))
        return self._model._path, {
            "kind": self.surface_type, "least_area": 0.98 * self.area, "most_area": 1.02 * self.area,
            "min": tuple(map(float, center - room)), "max": tuple(map(float, center + room))}

    def _starts(self) -> numpy.ndarray:
        low, high = (numpy.array(corner) for corner in self.bounding_box)
        axes = [numpy.linspace(a, b, 7) for a, b in zip(low, high)]
        return numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


class CADModel:
    """A file of a CAD program: CADModel.from_step(path) or CADModel.from_iges(path), or a part of CadQuery."""

    def __init__(self, path: str, folder: tempfile.TemporaryDirectory[str] | None = None) -> None:
        self._path, self._folder = path, folder
        try:
            report, _ = run("info", {"file": path}, {})
        except (ombre.DesignError, ombre.MachineError) as error:
            raise RuntimeError(f"CADModel: {error}") from None
        found = [face for solid in report["solids"] for face in solid["surfaces"]]
        self._faces = [CADFace(self, index, face) for index, face in enumerate(found)]

    @staticmethod
    def from_step(path: Any) -> CADModel:
        return CADModel(_find("CADModel.from_step", os.fspath(path)))

    @staticmethod
    def from_iges(path: Any) -> CADModel:
        return CADModel(_find("CADModel.from_iges", os.fspath(path)))

    @staticmethod
    def from_brep(path: Any) -> CADModel:
        """A .brep file of Open CASCADE, which has neither names nor colours."""
        return CADModel(_find("CADModel.from_brep", os.fspath(path)))

    @staticmethod
    def from_brep_bytes(data: bytes) -> CADModel:
        """What such a file holds."""
        folder = tempfile.TemporaryDirectory(prefix="ombre_")
        path = os.path.join(folder.name, "part.brep")
        with open(path, "wb") as file:
            file.write(data)
        return CADModel(path, folder)

    @staticmethod
    def from_cadquery(part: Any) -> CADModel:
        """A workplane, a shape or several shapes of CadQuery, or shapes of build123d, through a STEP file."""
        folder = tempfile.TemporaryDirectory(prefix="ombre_")
        path = os.path.join(folder.name, "part.step")
        if _is_of_build123d(part):
            _export_build123d(part, path)
            return CADModel(path, folder)
        shapes = part.vals() if hasattr(part, "vals") else list(part) if isinstance(part, Iterable) else [part]
        if shapes and all(map(_is_of_build123d, shapes)):
            _export_build123d(shapes, path)
            return CADModel(path, folder)
        if not shapes or not all(hasattr(shape, "exportStep") for shape in shapes):
            raise TypeError("CADModel.from_cadquery: expected a workplane or shapes of CadQuery, or shapes of build123d, found "
                            f"{type(part).__name__}; CADModel.from_step reads the STEP files of other programs")
        shape = shapes[0] if len(shapes) == 1 else _compound(shapes)
        shape.exportStep(path)
        return CADModel(path, folder)

    @property
    def faces(self) -> list[CADFace]:
        return list(self._faces)

    def face(self, index: int) -> CADFace:
        return self._faces[index]

    def select_faces(self, indices: Any = (), surface_type: str | None = None, normal: Any = None, min_dot: float = -1.0,
                     area_range: Any = None, bounding_box_intersection: Any = None) -> list[CADFace]:
        """The faces that fit all conditions.

        Args:
            indices: numbers of faces.
            surface_type: "plane", "cylinder", "cone", "sphere", "torus", "bezier", "bspline", "revolution", "extrusion",
                "offset" or "other".
            normal: a direction; min_dot is the least cosine of the angle between it and the mean normal.
            area_range: (least, greatest), mm2.
            bounding_box_intersection: (min, max); the box of a face meets it.
        """
        chosen = set(int(n) for n in indices)
        unknown = sorted(n for n in chosen if not 0 <= n < len(self._faces))
        if unknown:
            raise ValueError(f"select_faces, indices: there is no face {unknown[0]}; the model has {len(self._faces)}, "
                             "counted from 0")
        found = [face for face in self._faces if not chosen or face.index in chosen]
        if surface_type is not None:
            if surface_type not in _kinds:
                raise ValueError(f"select_faces, surface_type: expected {', '.join(_kinds)}, found {surface_type!r}")
            found = [face for face in found if face.surface_type == surface_type]
        if normal is not None:
            way = numpy.array(vector(normal))
            if not way.any():
                raise ValueError("select_faces, normal: expected a direction, found (0, 0, 0)")
            found = [face for face in found
                     if float(numpy.dot(list(face.normal), way) / numpy.linalg.norm(way)) >= number(min_dot)]
        if area_range is not None:
            least, most = (number(a) for a in area_range)
            found = [face for face in found if least <= face.area <= most]
        if bounding_box_intersection is not None:
            low, high = (vector(corner) for corner in bounding_box_intersection)
            found = [face for face in found
                     if all(a <= d and c <= b for a, b, c, d in zip(low, high, *face.bounding_box))]
        return found

    def to_node(self, use_fast_mode: bool = False) -> CAD:
        """The solids of the file as a node."""
        node = CAD(self._path, use_fast_mode)
        node._model = self  # whose file stays as long as the node is held
        return node

    def write_step(self, path: Any) -> None:
        """Copies the file."""
        shutil.copyfile(self._path, path)


def _is_of_build123d(part: Any) -> bool:
    return type(part).__module__.split(".")[0] == "build123d"


def _export_build123d(part: Any, path: str) -> None:
    """Writes a shape, a builder (whose part it is) or a list of shapes, with labels and colours."""
    import build123d  # type: ignore
    shape = build123d.Compound(children=list(part)) if isinstance(part, list) else getattr(part, "part", part)
    build123d.export_step(shape, path)


def _compound(shapes: list[Any]) -> Any:
    from cadquery import Compound  # type: ignore
    return Compound.makeCompound(shapes)


def from_cad_face(face: Any, cells: Any, height: float, linear: bool = True, trim: Any = "boundary",
                  standoff: float = 0.0) -> CellMap | CellMapCollection:
    """Cells on a face, or on each of several: u and v are those of the face, w runs along its normal.

    Args:
        face: a CADFace, or a list of them.
        cells: their numbers along u, v and w.
        height: of all cells together, mm; below 0 on the inner side.
        linear: accepted; walls and struts follow the face.
        trim: "boundary" cuts cells at the border, "cells" keeps whole ones.
        standoff: distance of the first cells from the face, mm.
    """
    if not isinstance(face, CADFace):
        return CellMapCollection([from_cad_face(one, cells, height, linear, trim, standoff) for one in face])
    counts, mode, options = options_of_map("cell_map_from_cad_face", cells, height, trim, standoff)
    return made_map(cells_on("cell_map_from_cad_face", face, counts, **options), counts, mode, face._starts(), face._model)


def between_cad_faces(a: Any, b: Any, cells: Any, linear: bool = True, trim: Any = TrimMode.boundary,
                      auto_align: bool = True, flip_u: bool = False, flip_v: bool = False, exchange_uv: bool = False,
                      first_origin: Any = None, second_origin: Any = None) -> CellMap:
    """Cells from a face to another one; places at equal shares of u and v are joined.

    Args:
        a, b: CADFaces; u and v are those of the first.
        cells: their numbers along u, v and w.
        linear: accepted; walls and struts follow the faces.
        trim: TrimMode.boundary cuts cells at the border, TrimMode.cells keeps whole ones.
        auto_align: of all pairings, takes the one whose ways are shortest.
        flip_u, flip_v: without auto_align: u, or v, of the first face runs against that of the second.
        exchange_uv: without auto_align: u of the first face runs along v of the second, and v along u.
    """
    what = "cell_map_between_cad_faces"
    for face in (a, b):
        if not isinstance(face, CADFace):
            raise TypeError(f"{what}: expected two CADFaces, found {type(face).__name__}")
    if first_origin is not None or second_origin is not None:
        raise missing(f"{what} with origins", "flip_u, flip_v and exchange_uv, with auto_align=False")
    if auto_align and (flip_u or flip_v or exchange_uv):
        raise ValueError(f"{what}: auto_align finds flips by itself; write auto_align=False to give them")
    flips = "_flip_both" if flip_u and flip_v else "_flip_u" if flip_u else "_flip_v" if flip_v else ""
    named = ("vu" if exchange_uv else "uv") + flips
    return paired(what, a, b, cells, trim, "nearest" if auto_align else named)


CellMap.from_cad_face, CellMap.between_cad_faces = staticmethod(from_cad_face), staticmethod(between_cad_faces)
