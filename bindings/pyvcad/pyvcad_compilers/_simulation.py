"""Meshes for simulations from trees: decks of Abaqus, XDMF for FEniCSx, and arrays."""
from __future__ import annotations

import enum
import os
import xml.sax.saxutils
from dataclasses import dataclass, field, fields
from typing import Any

import numpy

from pyvcad._arguments import boolean, voxel_size
from pyvcad._defined import FRACTIONS
from pyvcad._simulation.element_meshes import described, tetra_criteria
from pyvcad._simulation.elements import Elements, bricks_of, tetrahedra_of
from pyvcad._simulation.hdf5 import h5py
from pyvcad._simulation.inp import write_inp
from pyvcad._materials import MaterialDefs, default_materials, expect_table
from pyvcad._simulation.simulation_model import SimulationCellType, SimulationModel
from pyvcad._tree import as_node

from ._attribute_compilers import _AttributeCompiler
from ._compilers import Path, _place, _voxel


class SimulationBackend(enum.Enum):
    """The output: a deck PREFIX.inp; PREFIX.xdmf and PREFIX.h5; nothing, the arrays are in model()."""

    ABAQUS_INP = 0
    FENICSX_XDMF = 1
    GENERIC = 2


class SimulationMeshKind(enum.Enum):
    """Bricks where voxels have their centre inside, or tetrahedra up to the surface."""

    HEX = 0
    TET = 1


class _Settings:
    """Settings by their names; other names are mistakes."""

    def __setattr__(self, name: str, value: Any) -> None:
        known = [member.name for member in fields(self)]  # type: ignore[arg-type]
        if name not in known:
            raise AttributeError(f"{type(self).__name__} has no member {name!r}; it has {', '.join(known)}")
        super().__setattr__(name, value)


@dataclass
class SimulationHexMeshSettings(_Settings):
    """Settings of bricks: their size, mm, a length or a Vec3."""

    voxel_size: Any = 1.0


@dataclass
class SimulationTetFixedMeshSettings(_Settings):
    """Settings of tetrahedra, mm: radii of the balls around facets and cells, and the distance of facets from
    the surface. The mesh is as fine as the finest of the three asks; the angle and the ratio are always 25 degrees and 2.2."""

    facet_size: float = 1.0
    facet_distance: float = 0.25
    cell_size: float = 1.0
    facet_angle: float = 25.0
    cell_radius_edge_ratio: float = 3.0


@dataclass
class SimulationCompilerSettings(_Settings):
    """Settings of a SimulationCompiler.

    Attributes:
        output_directory: made where it is missing; files of the same names are replaced.
        file_prefix: names of files without their ending.
        random_seed: of the draws that give each element a material.
        material_defs: a MaterialDefs; None for the default one.
        direct_attributes: names of attributes, whose values at the middles of elements are in .xdmf files and model().
    """

    output_directory: Path = "."
    file_prefix: str = "simulation"
    backend: SimulationBackend = SimulationBackend.ABAQUS_INP
    mesh_kind: SimulationMeshKind = SimulationMeshKind.HEX
    hex_settings: SimulationHexMeshSettings = field(default_factory=SimulationHexMeshSettings)
    tet_fixed_settings: SimulationTetFixedMeshSettings = field(default_factory=SimulationTetFixedMeshSettings)
    random_seed: int = 0
    material_defs: Any = None
    direct_attributes: list[str] = field(default_factory=list)


class SimulationCompiler(_AttributeCompiler):
    """Fills a tree with elements, each of one material: SimulationCompiler(root, settings).

    Materials are drawn by the odds of the fractions at the middles of elements: the same seed gives the same files.
    """

    def __init__(self, root: Any, settings: SimulationCompilerSettings) -> None:
        if not isinstance(settings, SimulationCompilerSettings):
            raise TypeError(f"SimulationCompiler: expected SimulationCompilerSettings, found {type(settings).__name__}")
        self._root, self._settings = as_node(root), settings
        self._table: MaterialDefs = expect_table("SimulationCompiler", settings.material_defs) or default_materials
        self._files: list[str] = []
        self._model: SimulationModel | None = None

    def supported_attributes(self) -> list[str]:
        return ["volume_fractions", *self._settings.direct_attributes]

    def compile(self) -> None:
        """Makes the mesh, and the files. Raises ombre.DesignError, RuntimeError for an attribute that is not there,
        ImportError for XDMF without h5py."""
        settings = self._settings
        _expect("backend", settings.backend, SimulationBackend)
        _expect("mesh_kind", settings.mesh_kind, SimulationMeshKind)
        names = list(settings.direct_attributes)
        if names and settings.backend is SimulationBackend.ABAQUS_INP:
            raise ValueError("SimulationCompiler: decks hold materials alone; direct_attributes need the backend "
                             "FENICSX_XDMF or GENERIC")
        taken = [name for name in names if name == "material_id" or name.startswith("volume_fraction_")]
        if taken:
            raise ValueError(f"SimulationCompiler: {taken[0]!r} cannot be a direct attribute, since it is a field of its "
                             "own")
        absent = [name for name in names if name not in self._root.attribute_list()]
        if absent:
            raise RuntimeError(f"SimulationCompiler: no node of the tree has the attribute {', '.join(absent)}")
        if settings.backend is SimulationBackend.FENICSX_XDMF:
            h5py("SimulationCompiler with FENICSX_XDMF")
        self._files = []
        elements = self._elements()
        self._check_elements(elements, names)
        self._model = self._described(elements, names)
        if settings.backend is not SimulationBackend.GENERIC:
            self._write(elements)
        self._report(1.0)

    def written_files(self) -> list[str]:
        """Paths of the files that compile() wrote."""
        return list(self._files)

    def model(self) -> SimulationModel:
        """The arrays, with the backend GENERIC. Raises RuntimeError with another, and before compile()."""
        if self._settings.backend is not SimulationBackend.GENERIC:
            raise RuntimeError("SimulationCompiler: model() needs the backend GENERIC")
        if self._model is None:
            raise RuntimeError("SimulationCompiler: there is no model yet; call compile()")
        return self._model

    def _elements(self) -> Elements:
        settings, design = self._settings, self._root._ombre_design_(self._table)
        if settings.mesh_kind is SimulationMeshKind.HEX:
            cell = voxel_size(settings.hex_settings.voxel_size)
            return bricks_of(design, cell, settings.random_seed, self._share)
        return tetrahedra_of(design, tetra_criteria(settings.tet_fixed_settings), settings.random_seed, self._share)

    def _check_elements(self, elements: Elements, names: list[str]) -> None:
        """In strict mode, checks that all elements have the attributes, and fractions if some have them."""
        if self._is_strict:
            middles = elements.centroids[self._root._design().inside(elements.centroids)]
            for name in [*names, *({FRACTIONS} & {*self._root.attribute_list()})]:
                self._check_points(name, middles)

    def _described(self, elements: Elements, names: list[str]) -> SimulationModel:
        each = elements.cells.shape[1]
        used = sorted({*elements.fractions, *map(int, numpy.unique(elements.material_ids))})
        return SimulationModel(SimulationCellType(each), each, elements.nodes, elements.cells.reshape(-1),
                               elements.centroids, elements.material_ids, {i: self._table.name(i) for i in used},
                               {f"volume_fraction_{i}": values for i, values in elements.fractions.items()},
                               {name: _scalar(name, elements.attributes) for name in names})

    def _write(self, elements: Elements) -> None:
        folder, prefix = _place(self._settings.output_directory, self._settings.file_prefix)
        is_deck = self._settings.backend is SimulationBackend.ABAQUS_INP
        with self._new_files(folder) as made:
            path = os.path.join(made, prefix)
            if is_deck:
                write_inp(path + ".inp", elements.nodes, elements.cells, elements.material_ids, described(self._table))
            else:
                assert self._model is not None
                _write_xdmf(path, self._model)
        self._files = [os.path.join(folder, prefix + ending) for ending in ([".inp"] if is_deck else [".xdmf", ".h5"])]


class InpWriter:
    """Writes bricks for simulations: InpWriter().write(path, root, voxel_size, material_defs, use_volumetric_dither)."""

    def write(self, path: Path, root: Any, voxel_size: Any, material_defs: Any = None,
              use_volumetric_dither: bool = True) -> None:
        """Writes a deck with a set of elements for each material.

        Args:
            path: the file; one of that name is replaced.
            voxel_size: of the bricks, mm; a length or a Vec3.
            material_defs: a MaterialDefs; None for the default one.
            use_volumetric_dither: each element's material is drawn by the odds of its fractions; else it is the one that
                has most of it.
        """
        cell = _voxel("InpWriter", voxel_size)
        table = expect_table("InpWriter", material_defs) or default_materials
        elements = bricks_of(as_node(root)._ombre_design_(table), cell)
        ids = elements.material_ids if boolean(use_volumetric_dither) else elements.greatest()
        write_inp(os.fspath(path), elements.nodes, elements.cells, ids, described(table))


def _expect(what: str, value: Any, kind: type[enum.Enum]) -> None:
    if not isinstance(value, kind):
        raise TypeError(f"SimulationCompiler, {what}: expected a {kind.__name__}, found {type(value).__name__}")


def _scalar(name: str, attributes: dict[str, numpy.ndarray]) -> numpy.ndarray:
    if name not in attributes or attributes[name].ndim != 1:
        raise RuntimeError(f"SimulationCompiler: direct attributes are numbers; {name!r} is none")
    return attributes[name]


def _write_xdmf(path: str, model: SimulationModel) -> None:
    """Writes one grid, OpenVCADMesh, and beside it a file of HDF5 with its numbers."""
    cells = model.connectivity.reshape(-1, model.nodes_per_cell)
    numbered = {"material_id": model.material_ids.astype(numpy.int32), **model.volume_fraction_fields,
              **model.scalar_fields}
    arrays = {"/Mesh/Topology": cells.astype(numpy.int64), "/Mesh/Geometry": model.nodes,
              **{f"/CellData/{name}": values for name, values in numbered.items()}}
    kind = "Hexahedron" if model.cell_type is SimulationCellType.HEX8 else "Tetrahedron"
    numbers = os.path.basename(path) + ".h5"

    def item(place: str) -> str:
        array = arrays[place]
        sizes = " ".join(map(str, array.shape))
        return (f'<DataItem Dimensions="{sizes}" NumberType="{"Int" if array.dtype.kind == "i" else "Float"}" '
                f'Precision="{array.dtype.itemsize}" Format="HDF">{xml.sax.saxutils.escape(numbers + ":" + place)}'
                "</DataItem>")
    text = ('<?xml version="1.0"?>\n<Xdmf Version="3.0">\n<Domain>\n<Grid Name="OpenVCADMesh" GridType="Uniform">\n'
            f'<Topology TopologyType="{kind}" NumberOfElements="{len(cells)}" '
            f'NodesPerElement="{model.nodes_per_cell}">{item("/Mesh/Topology")}</Topology>\n'
            f'<Geometry GeometryType="XYZ">{item("/Mesh/Geometry")}</Geometry>\n')
    for name in numbered:
        text += (f"<Attribute Name={xml.sax.saxutils.quoteattr(name)} AttributeType=\"Scalar\" Center=\"Cell\">"
                 f'{item(f"/CellData/{name}")}</Attribute>\n')
    text += "</Grid>\n</Domain>\n</Xdmf>\n"
    with h5py("SimulationCompiler with FENICSX_XDMF").File(path + ".h5", "w") as file:
        for place, array in arrays.items():
            file.create_dataset(place, data=array, track_times=False)
    with open(path + ".xdmf", "w", encoding="utf-8") as text_file:
        text_file.write(text)
